"""Common polynomial of curves of friction that are shifted, and how far they are from it.

Shifts are sought with the polynomial projected out (variable projection; Golub and Pereyra 1973).
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from operator import attrgetter
from typing import Any

import numpy as np
from numpy.polynomial import chebyshev
from scipy.optimize import least_squares, root

# Neighbouring curves share at least this part of the shorter one's range of ln F: a fit that wants less is no fit.
LEAST_OVERLAP = 0.25
# Singular values below this share of the largest do not count.
LEAST_SINGULAR = 1e-12
# Increments closer to a bound than this share of the range between the bounds count as at it.
_CLEAR = 1e-3
# Steps of Gauss-Newton at most, and the square of the change at which it ends, over the sum of squares.
_STEPS, _SETTLED = 40, 1e-22
# By how much rounding may raise a sum of squares, relative: every processor settles on the same numbers.
_ROUNDING = 1e-12


@dataclass(frozen=True, eq=False)
class Fit:
    """Curves that are shifted along x one against the next, onto their best common polynomial, for ln mu.

    curves : a `Curve` for each speed, or others with the same columns
    degree : of the polynomial
    lifted : whether each curve is shifted along ln mu too, as fits best
    along : name of the column that is x
    loads : number of different loads: where x is another column, the polynomial has ln F as a second
        variable, in powers below this
    """

    curves: Sequence[Any]
    degree: int
    lifted: bool = False
    along: str = "log_load"
    loads: int = 1

    def column(self, name: str) -> np.ndarray:
        """A column of all curves (N,)."""
        return np.concatenate([getattr(each, name) for each in self.curves])

    @cached_property
    def owner(self) -> np.ndarray:
        """Number of the curve of each point (N,)."""
        return np.repeat(np.arange(len(self.curves)), [each.log_load.size for each in self.curves])

    @cached_property
    def y(self) -> np.ndarray:
        """ln mu of all points (N,)."""
        return self.column("log_friction")

    @cached_property
    def later(self) -> np.ndarray:
        """Whether each increment moves a point: those of every later curve (N, K - 1)."""
        return (self.owner[:, None] > np.arange(len(self.curves) - 1)).astype(float)

    @cached_property
    def bounds(self) -> tuple[np.ndarray, np.ndarray]:
        """Least and greatest increments that leave neighbours the least overlap."""
        low, high = np.array([(x.min(), x.max()) for x in map(attrgetter(self.along), self.curves)]).T
        shared = LEAST_OVERLAP * np.minimum((high - low)[:-1], (high - low)[1:])
        return low[:-1] - high[1:] + shared, high[:-1] - low[1:] - shared

    @cached_property
    def against(self) -> np.ndarray:
        """Weights (K, K - 1) of increments in shifts against the middle curve."""
        shifts = np.tri(len(self.curves), len(self.curves) - 1, -1)
        return shifts - shifts[len(shifts) // 2]

    @property
    def log_speeds(self) -> np.ndarray:
        """ln v of the curves (K,)."""
        return np.log([each.speed for each in self.curves])

    @property
    def sums(self) -> np.ndarray:
        """Weights (K + 1, K - 1) of increments in shifts against the middle curve, and in their exponent.

        The exponent belongs to the power of the speed that fits the shifts best, least squares.
        """
        logs = self.log_speeds - self.log_speeds.mean()
        return np.vstack([self.against, logs @ self.against / (logs @ logs)])

    @cached_property
    def terms(self) -> np.ndarray:
        """Powers of x and of the second variable in each function of the polynomial (2, M)."""
        most = min(self.loads - 1, self.degree)
        return np.array([(i, k) for k in range(most + 1) for i in range(self.degree - k + 1)]).T

    @cached_property
    def derivatives(self) -> np.ndarray:
        """Columns are the derivatives of the polynomials (degree, degree + 1)."""
        return chebyshev.chebder(np.eye(self.degree + 1))

    @cached_property
    def across(self) -> np.ndarray:
        """Polynomials of the second variable in each function, at every point (points, M)."""
        _, others = self.terms
        return chebyshev.chebvander(scaled_to_one(self.column("log_load"))[0], others.max())[:, others]

    @property
    def unknowns(self) -> int:
        """Number of functions, levels and shifts."""
        return self.terms.shape[1] + (1 + self.lifted) * self.later.shape[1]

    def at(self, increments: np.ndarray) -> "Common":
        """The best polynomial of the curves once they are shifted."""
        x = self.column(self.along) + np.concatenate([[0], np.cumsum(increments)])[self.owner]
        scaled, half = scaled_to_one(x)
        along = chebyshev.chebvander(scaled, self.degree)
        slopes = along[:, :-1] @ self.derivatives / half
        powers, _ = self.terms
        functions, rates = (each[:, powers] * self.across for each in (along, slopes))
        # An increment of the level moves a curve down.
        basis = np.hstack([functions, -self.later]) if self.lifted else functions
        # Where places coincide once shifted, fewer functions are independent than there are.
        left, sizes, right = np.linalg.svd(basis, full_matrices=False)
        independent = sizes > LEAST_SINGULAR * sizes[0]
        coefficients = right[independent].T @ (left[:, independent].T @ self.y / sizes[independent])
        found, lifts = np.split(coefficients, [powers.size])
        lifts = lifts if self.lifted else 0 * increments
        return Common(self, increments, lifts, x, basis, left[:, independent], rates @ found, found)

    def within(self, increments: np.ndarray) -> np.ndarray:
        """The nearest increments that keep clear of the bounds."""
        lower, upper = self.bounds
        margin = _CLEAR * (upper - lower)
        return np.clip(increments, lower + margin, upper - margin)

    def unsettled(self, increments: np.ndarray, numbers: Callable[["Common"], np.ndarray]) -> np.ndarray:
        """What numbers near some increments may be off by, as no polynomial is the law.

        From one degree to the next numbers change less and less, or do not settle: they may be off by the
        geometric mean of the changes to this degree and from it to a higher one, or by the latter where it is
        larger. Where points are no more than the unknowns of a higher degree, the change from a lower one decides
        alone, and of the lowest degree that to a higher one.
        """
        here = numbers(near(self, increments))
        lower, higher = (replace(self, degree=self.degree + by) for by in (-2, 2))
        others = [lower] * (lower.degree > 0) + [higher] * (higher.unknowns < self.y.size)
        changes = [np.abs(numbers(near(each, increments)) - here) for each in others or [higher]]
        return np.sqrt(changes[-1] * np.maximum(changes[0], changes[-1]))


@dataclass(frozen=True)
class Common:
    """Curves once they are shifted, and their best common polynomial; arrays over all points (N,).

    increments, lifts : of the shifts along x and along y (K - 1,); the latter are zero where curves are not lifted
    x : places, shifted as the first curve is
    basis, orthonormal : functions and levels (N, M), as they are and orthonormal
    slopes : of the polynomial along x
    coefficients : of the functions (M,)
    """

    fit: Fit
    increments: np.ndarray
    lifts: np.ndarray
    x: np.ndarray
    basis: np.ndarray
    orthonormal: np.ndarray
    slopes: np.ndarray
    coefficients: np.ndarray

    @property
    def residuals(self) -> np.ndarray:
        """y minus the best polynomial (N,)."""
        return self.fit.y - self.orthonormal @ (self.orthonormal.T @ self.fit.y)

    @property
    def cost(self) -> float:
        """Sum of squares of the residuals."""
        return float(np.sum(np.square(self.residuals)))

    @property
    def jacobian(self) -> np.ndarray:
        """Derivatives of the residuals (N, K - 1), except the part in the span of the functions.

        Kaufman, BIT 15, 49 (1975). The gradient of the sum of squares is exact, as residuals do not lie there.
        """
        moved = self.slopes[:, None] * self.fit.later
        return self.orthonormal @ (self.orthonormal.T @ moved) - moved

    @property
    def tangent(self) -> np.ndarray:
        """Tangent of the fit: changes to first order of functions, levels and shifts (N, M)."""
        return np.hstack([self.basis, self.slopes[:, None] * self.fit.later])

    @property
    def inside(self) -> bool:
        """Whether the demand for overlap leaves the increments free."""
        return np.array_equal(self.fit.within(self.increments), self.increments)

    @property
    def shifts(self) -> np.ndarray:
        """Shifts against the middle curve along x and y, the exponents of both last (2, K + 1)."""
        return np.array([self.increments, self.lifts]) @ self.fit.sums.T


def scaled_to_one(x: np.ndarray) -> tuple[np.ndarray, float]:
    """Places between -1 and 1, and half of the range that they had; 1 of a single place."""
    middle, half = (x.max() + x.min()) / 2, np.ptp(x) / 2 or 1.0
    return (x - middle) / half, half


def near(fit: Fit, guess: np.ndarray) -> Common:
    """The fit of least misfit close to a guess of increments (Gauss-Newton), or of a search within the bounds."""
    (lower, upper), found, least = fit.bounds, fit.at(guess), np.inf
    rounding = np.finfo(float).eps ** 2 * fit.y @ fit.y  # of the residuals: no step changes them by less
    for _ in range(_STEPS):
        at, jacobian, cost = found.increments, found.jacobian, found.cost
        if not cost <= least * (1 + _ROUNDING) or np.any((at <= lower) | (at >= upper)):
            break
        least = cost
        step = np.linalg.lstsq(jacobian, -found.residuals, rcond=LEAST_SINGULAR)[0]
        gain = jacobian @ step
        found = fit.at(at + step)
        if gain @ gain <= _SETTLED * cost + rounding:
            return found
    searched = least_squares(
        lambda each: fit.at(each).residuals,
        fit.within(guess),
        lambda each: fit.at(each).jacobian,
        bounds=(lower, upper),
        method="dogbox",
    ).x
    free = (lower < searched) & (searched < upper)

    def gradient(at):
        here = fit.at(at)
        return np.where(free, here.jacobian.T @ here.residuals, at - searched)

    # About the least of them squares differ by less than rounding; their gradient does not.
    at = root(gradient, searched, tol=1e-13).x
    before, now = fit.at(searched), fit.at(at)
    better = now.cost <= before.cost * (1 + 2 * _ROUNDING)
    return now if better and np.all((lower <= at) & (at <= upper)) else before


def exponent_bias(found: Common, missed: float) -> np.ndarray:
    """What shifts against the middle curve and their exponents may be off by, as no polynomial is the law.

    missed : ln mu, root of the sum of squares, by which the fit may miss along the gradient of a number

    Returns (2, K + 1), along load and friction, the exponents last.
    """
    fit, count = found.fit, found.increments.size
    # The last columns of the tangent are the shifts along the load, those before them the levels.
    inverse = np.linalg.pinv(found.tangent)[-(1 + fit.lifted) * count :].reshape(-1, count, fit.y.size)[::-1]
    most = missed * np.linalg.norm(fit.sums @ inverse, axis=2)
    settled = fit.unsettled(found.increments, lambda each: each.shifts)
    return np.maximum(np.pad(most, ((0, 1 - fit.lifted), (0, 0))), settled)
