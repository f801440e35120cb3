"""Stick and slip under a given pressure: from an operator and limits to tractions, without physics.

Find tractions q with |q| <= limit on every point such that the slip s = u - A q vanishes where |q| < limit, and
points along q where it does not; for a displacement u along x given or such that the sum of q_x is a force. That
is the least of q A q / 2 - u sum(q_x) on discs, one to a point: convex, with one solution. Tractions have one
component, along x, or two; A is symmetric and positive definite. Everything may be multiplied by one number.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from .activeset import NotConverged

ROUNDS = 200  # sets of slip tried before giving up; 3 to 15 are usual
ACCURACY = 0.1  # of the error on one set of slip
INNER_ITERATIONS = 40
ROUNDING = 1e-10  # of its limit, by which a traction may fall short of it and still be at it
STIFFNESS = 0.3  # of the preconditioner against the traction on a single point
BEYOND = 2.0  # limits, by which a traction that nothing resists is carried past them


@dataclass(frozen=True)
class Traction:
    """Traction and slip (components, ny, nx), which points slip (ny, nx), and the displacement along x.

    violation : slip where it sticks, and slip not along the traction where it slips, the largest over the
        displacement; or the relative misfit of a force if that is more
    rounds : sets of slip tried
    """

    traction: np.ndarray
    slip: np.ndarray
    slipping: np.ndarray
    displacement: float
    violation: float
    rounds: int


def solve(
    operator: Callable,
    precondition: Callable,
    limits: np.ndarray,
    start: np.ndarray,
    tolerance: float,
    displacement: float | None = None,
    force: float | None = None,
) -> Traction:
    """Solve on a set of slip, on which tractions turn but do not grow, and take what results back to the limits.

    A step is Newton's: a point that slips moves along its circle, and the way that this circle bends adds to the
    operator. Points are taken from the set that would slip against their traction.

    operator, precondition : planes (components, ny, nx) -> planes; the second is an approximate inverse
    limits : of |q| (ny, nx), zero where nothing touches
    start : tractions to begin with (components, ny, nx), not all zero under a force; what is beyond the limits is
        taken back to them
    tolerance : largest violation, over the displacement; where that is next to nothing, over the displacement of
        a pixel by the mean traction
    displacement, force : what is given, above zero: the displacement alone; or the force, which is sum(q_x) and
        less than sum(limits); a displacement given with a force is used in the first round alone

    All points may slip: with one component that takes a displacement, with two also a force a little less than
    sum(limits). Squares of limits, displacement and force have to be numbers. Raises NotConverged.
    """
    where = np.flatnonzero(limits > 0)
    limits_there = limits.reshape(-1)[where]
    q = _clipped(start.reshape(len(start), -1)[:, where], limits_there)
    along_x = np.zeros((len(q), 1))
    along_x[0] = 1.0
    for rounds in range(1, ROUNDS + 1):
        image = _on(operator, q, where, limits.shape)
        length = np.sqrt((q * q).sum(axis=0))
        at_limit = length >= limits_there * (1 - ROUNDING)
        direction = q / np.where(length > 0, length, 1.0)
        held = force is not None and (rounds > 1 or displacement is None)
        drawn: Any = _level(image, direction, at_limit) if held else displacement
        slip = drawn * along_x - image
        forward = (direction * slip).sum(axis=0)
        slipping = at_limit & (forward > 0)
        wrong = slip - np.where(slipping, forward, 0.0) * direction
        aim = tolerance * max(drawn, float(length.mean()))
        missing = 0.0 if force is None else force - float(q[0].sum())
        left = float(np.sqrt((wrong * wrong).sum(axis=0)).max()) / aim
        if force is not None:
            left = max(left, abs(missing) / (tolerance * force))
        if left <= 1:
            planes = _spread(np.stack([*q, *slip, slipping.astype(float)]), where, limits.shape)
            traction, slips = planes[: len(q)], planes[len(q) : -1]
            return Traction(traction, slips, planes[-1] > 0, drawn, left * tolerance, rounds)
        bend = np.where(slipping, forward / limits_there, 0.0)
        face = _Face(operator, precondition, where, limits.shape, slipping, direction, bend, held)
        q = _clipped(q + face.step(slip, missing, aim, float(limits_there.max())), limits_there)
    raise NotConverged(
        f"after {ROUNDS} sets of slip the violation is {left * tolerance:.2e}, wanted {tolerance:.2e}"
    )


def _level(image, direction, at_limit):
    """The displacement that fits a traction best where points stick.

    Where nothing does, the one that leaves the least slip across; if all tractions point along x, the least at
    which everything but one point slips forward.
    """
    if not bool(at_limit.all()):
        return float(image[0][~at_limit].mean())
    if len(image) == 1 or not bool(direction[1].any()):
        return float(image[0].max())
    across = np.stack([-direction[1], direction[0]])
    return float((across[0] * (across * image).sum(axis=0)).sum() / (across[0] ** 2).sum())


def _clipped(q, limits):
    """The nearest tractions within the limits."""
    length = np.sqrt((q * q).sum(axis=0))
    return q * np.minimum(1.0, limits / np.where(length > 0, length, 1.0))


def _spread(values, where, shape):
    """Values (components, m) on planes, zero elsewhere."""
    planes = np.zeros((len(values), *shape))
    planes.reshape(len(values), -1)[:, where] = values
    return planes


def _on(product, values, where, shape):
    """A product of planes on vectors (components, m) of values at some places."""
    return product(_spread(values, where, shape)).reshape(len(values), -1)[:, where]


class _Face:
    """The problem for one set of slip: points that stick move freely, those that slip along their circles.

    held : whether corrections keep the force
    """

    def __init__(self, operator, precondition, where, shape, slipping, direction, bend, held):
        self._operator, self._precondition, self._where, self._shape = operator, precondition, where, shape
        self._normal, self._bend = np.where(slipping, direction, 0.0), bend
        self._ease = 1 / np.sqrt(1 + STIFFNESS * bend)  # what bends much is stiff by that alone
        pull = np.zeros(direction.shape)
        pull[0] = 1.0
        self._pull = self._along_circles(pull)
        self._pull_square = _inner(self._pull, self._pull)
        self._held = held and self._pull_square > 0
        if self._held:  # tractions by a unit pull; corrections have no share of them
            answer = self._eased(self._pull)
            self._answer = answer / _inner(self._pull, answer)

    def step(self, slip, missing, aim, most):
        """The correction that undoes a slip and brings a force that is missing, by conjugate gradients."""
        residual, start = self._free(slip), 0.0
        if missing and self._held:
            start = self._answer * missing
            residual = self._free(residual - self._applied(start))
        return start + self._solved(residual, aim, most)

    def _solved(self, residual, aim, most):
        """Preconditioned, and Polak-Ribiere as in `krylov.conjugate_gradients`."""
        x, enough = np.zeros(residual.shape), ACCURACY * _norm(residual)
        if enough == 0:
            return x
        z = self._preconditioned(residual)
        direction, descent = z, _inner(residual, z)
        for _ in range(INNER_ITERATIONS):
            image = self._applied(direction)
            along = _inner(direction, image)
            if along <= 0:  # the mean of a cell moves freely, until it slips
                return x + direction * (BEYOND * most / float(abs(direction).max()))
            step = descent / along
            x = x + step * direction
            residual = residual - step * image
            if _norm(residual) <= enough or float(abs(residual).max()) <= aim / 2:
                break
            z, before = self._preconditioned(residual), descent
            descent = _inner(residual, z)
            direction = z - step * _inner(z, image) / before * direction
        return x

    def _applied(self, values):
        return self._free(_on(self._operator, values, self._where, self._shape) + self._bend * values)

    def _preconditioned(self, values):
        values = self._eased(values)
        return values - self._answer * _inner(self._pull, values) if self._held else values

    def _eased(self, values):
        image = _on(self._precondition, self._ease * values, self._where, self._shape)
        return self._along_circles(self._ease * image)

    def _free(self, values):
        """The part of vectors along which tractions may move."""
        values = self._along_circles(values)
        return values - self._pull * (_inner(self._pull, values) / self._pull_square) if self._held else values

    def _along_circles(self, values):
        return values - self._normal * (self._normal * values).sum(axis=0)


def _inner(one, other):
    return float((one * other).sum())


def _norm(values):
    return _inner(values, values) ** 0.5
