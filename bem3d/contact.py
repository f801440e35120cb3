"""The complementarity problem of contact: operator and heights in, pressure out. Knows no physics.

Find p >= 0 with gap = A p + z - d >= 0 and p * gap = 0 on every point, for a depth d given or such that
sum(p) = load. The operator A is positive definite; it need not be symmetric.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from .krylov import conjugate_gradients, gmres

ROUNDS = 400  # sets of contact tried before giving up; 5 to 30 are usual
ACCURACY = 0.5  # of the error on one set of contact: more is wasted while the set still changes
READMITTED = 0.1  # of the contact: when more of what was dropped penetrates, the solves were too rough,
CLOSER = 30.0  # and from then on are closer by this factor
PATIENCE = 30  # rounds after which they are closer by half, each time: rough solves can cycle, close ones do not
INNER_ITERATIONS = 60


class NotConverged(RuntimeError):
    """No set of contact was found on which all conditions hold to the tolerance."""


@dataclass(frozen=True)
class Contact:
    """Pressure and gap (ny, nx), depth, violation as `tolerance` measures it, and the sets of contact tried."""

    pressure: np.ndarray
    gap: np.ndarray
    depth: float
    violation: float
    rounds: int


def solve(
    operator: Callable,
    heights: np.ndarray,
    start: np.ndarray,
    tolerance: float,
    depth: float | None = None,
    load: float | None = None,
    precondition: Callable | None = None,
    symmetric: bool = False,
) -> Contact:
    """Solve roughly on a set of contact and drop what pulls; add what penetrates once that outweighs what is left.

    start : pressure to begin with (ny, nx), >= 0; its support is the first set of contact
    tolerance : largest |gap| in contact and penetration outside, over the depth of the lowest height, d - min(z)
    depth, load : exactly one; load is sum(p)
    precondition : approximate inverse of the operator on the whole grid
    symmetric : conjugate gradients, else GMRES, on each set

    Raises NotConverged.
    """
    krylov = conjugate_gradients if symmetric else gmres
    pressure, accuracy = _balanced(start, load), ACCURACY
    dropped = np.zeros(heights.shape, bool)
    for rounds in range(1, ROUNDS + 1):
        contact = pressure > 0
        free = operator(pressure) + heights
        level = free[contact].mean() if depth is None else depth
        gap = free - level
        aim = tolerance * (level - heights.min())
        inside = np.abs(gap[contact]).max()
        outside = -gap.min(where=~contact, initial=0.0)
        if inside <= aim and outside <= aim:
            return Contact(pressure, gap, float(level), float(max(inside, outside) / aim * tolerance), rounds)
        if rounds % PATIENCE == 0:
            accuracy /= 2
        if inside <= max(aim, accuracy * outside):
            penetrating = gap < -aim
            if np.count_nonzero(penetrating & dropped) > READMITTED * np.count_nonzero(contact):
                accuracy /= CLOSER
            contact |= penetrating
            dropped[:] = False
        on_set = _OnSet(operator, precondition, contact, mean_free=depth is None)
        correction = krylov(
            on_set.operator, -on_set.restrict(gap), on_set.precondition, accuracy, aim, INNER_ITERATIONS
        )
        pressure = np.maximum(pressure + on_set.extend(correction), 0.0)
        dropped |= contact & (pressure == 0)
        if not pressure.any():  # a poor start, solved too roughly: begin again with what overlaps, and closer
            pressure, accuracy = np.maximum(level - heights, 0.0), accuracy / 4
        pressure = _balanced(pressure, load)
    violation = max(inside, outside) / aim * tolerance
    raise NotConverged(f"after {ROUNDS} sets of contact the violation is {violation:.2e}, wanted {tolerance:.2e}")


def _balanced(pressure, load):
    return pressure if load is None else pressure * (load / pressure.sum())


class _OnSet:
    """The operator on the points of contact alone; at given load on corrections that keep the load."""

    def __init__(self, operator, precondition, contact, mean_free):
        self._operator, self._precondition = operator, precondition
        self._contact, self._mean_free = contact, mean_free
        self._plane = np.zeros(contact.shape)

    def extend(self, values):
        plane = np.zeros(self._contact.shape)
        plane[self._contact] = values
        return plane

    def restrict(self, plane):
        values = plane[self._contact]
        return values - values.mean() if self._mean_free else values

    def operator(self, values):
        self._plane[self._contact] = values
        return self.restrict(self._operator(self._plane))

    def precondition(self, values):
        if self._precondition is None:
            return values
        self._plane[self._contact] = values
        return self.restrict(self._precondition(self._plane))
