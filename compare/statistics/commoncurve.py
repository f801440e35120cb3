"""Common polynomial of curves of friction against load that are shifted, and how far they are from it.

Shifts are sought with the polynomial projected out (variable projection; Golub and Pereyra 1973).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.polynomial import chebyshev
from scipy.optimize import least_squares, root

from .frictioncurves import Curve

# Neighbouring curves share at least this part of the shorter one's range of ln F: a fit that wants less is no fit.
LEAST_OVERLAP = 0.25
# Singular values below this share of the largest do not count.
_LEAST_SINGULAR = 1e-12
# Increments closer to a bound than this share of the range between the bounds count as at it.
_CLEAR = 1e-3
# Steps of Gauss-Newton at most, and the square of the change at which it ends, over the sum of squares.
_STEPS, _SETTLED = 40, 1e-22
# By how much rounding may raise a sum of squares, relative: every processor settles on the same numbers.
_ROUNDING = 1e-12


@dataclass(frozen=True)
class Common:
    """The best common function of curves shifted in some way; arrays over all points (N,).

    basis, orthonormal : functions and levels (N, M), as they are and orthonormal
    slopes : of the function along x
    coefficients : of the functions, then the increments of the level (M,)
    domain : least and greatest x, shifted as the first curve is
    """

    basis: np.ndarray
    orthonormal: np.ndarray
    slopes: np.ndarray
    coefficients: np.ndarray
    domain: tuple[float, float]


class Projected:
    """Misfit of curves to a common function, linear in its coefficients, given the increments of their shifts.

    Curves are shifted along x one against the next. The function is projected out: shifts alone are sought.

    places, heights : x and y of each curve
    """

    def __init__(self, places: Sequence[np.ndarray], heights: Sequence[np.ndarray]):
        self.owner = np.repeat(np.arange(len(places)), [each.size for each in places])
        self.x, self.y = np.concatenate(places), np.concatenate(heights)
        # An increment moves every later curve.
        self.later = (self.owner[:, None] > np.arange(len(places) - 1)).astype(float)
        self.bounds = _overlapping(places)
        self._last: tuple[np.ndarray, Common] | None = None

    def residuals(self, increments: np.ndarray) -> np.ndarray:
        """y minus the best function, (N,)."""
        basis = self.common(increments).orthonormal
        return self.y - basis @ (basis.T @ self.y)

    def jacobian(self, increments: np.ndarray) -> np.ndarray:
        """Derivatives of the residuals, (N, increments), except the part in the span of the functions.

        Kaufman, BIT 15, 49 (1975). The gradient of the sum of squares is exact, as residuals do not lie there.
        """
        common = self.common(increments)
        moved = common.slopes[:, None] * self.later
        return common.orthonormal @ (common.orthonormal.T @ moved) - moved

    def tangent(self, increments: np.ndarray) -> np.ndarray:
        """Tangent of the fit: changes to first order of functions, levels and shifts (N, M)."""
        common = self.common(increments)
        return np.hstack([common.basis, common.slopes[:, None] * self.later])

    def common(self, increments: np.ndarray) -> Common:
        """The best function once the curves are shifted; kept, as residuals and slopes are asked for in turn."""
        if self._last is None or not np.array_equal(self._last[0], increments):
            shifted = self.x + np.concatenate([[0], np.cumsum(increments)])[self.owner]
            self._last = np.array(increments), self._common(shifted)
        return self._last[1]

    def _common(self, x: np.ndarray) -> Common:
        """The best function of the places once they are shifted."""
        raise NotImplementedError

    def _projected(self, basis):
        """Orthonormal basis and coefficients of y in a basis; functions that coincide there count as one."""
        left, sizes, right = np.linalg.svd(basis, full_matrices=False)
        told = sizes > _LEAST_SINGULAR * sizes[0]
        orthonormal = left[:, told]
        return orthonormal, right[told].T @ (orthonormal.T @ self.y / sizes[told])


class Fit(Projected):
    """Misfit of curves of ln mu against ln F to their best common polynomial.

    degree : of the polynomial
    lifted : whether each curve is shifted vertically too, as fits best
    """

    def __init__(self, curves: Sequence[Curve], degree: int, lifted: bool = False):
        super().__init__([curve.log_load for curve in curves], [curve.log_friction for curve in curves])
        self.curves, self.degree, self.lifted = curves, degree, lifted
        # An increment of the level moves a curve down.
        self.levels = self.later if lifted else self.later[:, :0]

    def of(self, curves: Sequence[Curve]) -> "Fit":
        """The fit of other curves."""
        return Fit(curves, self.degree, self.lifted)

    def lifts(self, increments: np.ndarray) -> np.ndarray:
        """Increments of the level (K - 1,), zero where curves are not lifted."""
        lifts = self.common(increments).coefficients[self.degree + 1 :]
        return lifts if self.lifted else np.zeros(len(increments))

    def _common(self, x):
        scaled, half = scaled_to_one(x)
        basis = np.hstack([chebyshev.chebvander(scaled, self.degree), -self.levels])
        # Where loads coincide once shifted, fewer polynomials are told apart than there are.
        orthonormal, coefficients = self._projected(basis)
        slopes = chebyshev.chebval(scaled, chebyshev.chebder(coefficients[: self.degree + 1])) / half
        return Common(basis, orthonormal, slopes, coefficients, (x.min(), x.max()))


def scaled_to_one(x: np.ndarray) -> tuple[np.ndarray, float]:
    """Places between -1 and 1, and half of the range that they had; 1 of a single place."""
    middle, half = (x.max() + x.min()) / 2, (x.max() - x.min()) / 2 or 1.0
    return (x - middle) / half, half


def bounds(curves: Sequence[Curve]) -> tuple[np.ndarray, np.ndarray]:
    """Least and greatest increments that leave neighbouring curves the least overlap."""
    return _overlapping([curve.log_load for curve in curves])


def _overlapping(places):
    lower, upper = [], []
    for a, b in pairwise(places):
        shared = LEAST_OVERLAP * min(np.ptp(a), np.ptp(b))
        lower.append(a.min() - b.max() + shared)
        upper.append(a.max() - b.min() - shared)
    return np.array(lower), np.array(upper)


def near(fit: Projected, guess: np.ndarray) -> np.ndarray:
    """Increments of least misfit close to a guess (Gauss-Newton), or of a search within the bounds."""
    lower, upper = fit.bounds
    at, least = guess, np.inf
    for _ in range(_STEPS):
        residuals, jacobian = fit.residuals(at), fit.jacobian(at)
        cost = residuals @ residuals
        if not cost <= least * (1 + _ROUNDING) or np.any((at <= lower) | (at >= upper)):
            break
        least = cost
        step = np.linalg.lstsq(jacobian, -residuals, rcond=_LEAST_SINGULAR)[0]
        gain = jacobian @ step
        at = at + step
        if gain @ gain <= _SETTLED * (cost + _LEAST_SINGULAR**2):
            return at
    start = within(guess, lower, upper)
    found = least_squares(fit.residuals, start, fit.jacobian, bounds=(lower, upper), method="dogbox").x
    free = (lower < found) & (found < upper)

    def moved(values):
        at = found.copy()
        at[free] = values
        return at

    def gradient(values):
        at = moved(values)
        return (fit.jacobian(at).T @ fit.residuals(at))[free]

    # About the least of them squares differ by less than rounding; their gradient does not.
    at = moved(root(gradient, found[free], tol=1e-13).x) if free.any() else found
    before, now = (np.sum(np.square(fit.residuals(each))) for each in (found, at))
    better = now <= before * (1 + _ROUNDING) and np.all((lower <= at) & (at <= upper))
    return at if better else found


def within(increments: np.ndarray, lower: np.ndarray, upper: np.ndarray) -> np.ndarray:
    """The nearest increments that keep clear of the bounds."""
    margin = _CLEAR * (upper - lower)
    return np.clip(increments, lower + margin, upper - margin)


def inside(increments: np.ndarray, lower: np.ndarray, upper: np.ndarray) -> bool:
    """Whether the demand for overlap leaves the increments free."""
    return bool(np.all(np.minimum(increments - lower, upper - increments) > _CLEAR * (upper - lower)))


def against_middle(increments: np.ndarray) -> np.ndarray:
    """Shifts against the middle speed (S,)."""
    sums = np.concatenate([[0], np.cumsum(increments)])
    return sums - sums[sums.size // 2]


def exponents(fit: Fit, increments: np.ndarray) -> np.ndarray:
    """Powers of the speed that are closest to the shifts along load and friction (2,)."""
    return np.array([increments, fit.lifts(increments)]) @ _lever(fit)


def _lever(fit):
    """Weights of increments of a shift in the exponent of its power of the speed, least squares."""
    logs = np.log([curve.speed for curve in fit.curves])
    logs -= logs.mean()
    return np.cumsum(logs[:0:-1])[::-1] / (logs @ logs)


def exponent_bias(fit: Fit, guess: np.ndarray, missed: float) -> np.ndarray:
    """What shifts against the middle speed and their exponents may be off by, as no polynomial is the law.

    missed : ln mu, root of the sum of squares, by which the fit may miss along the gradient of a number

    Returns (2, S + 1), along load and friction, the exponents last. Where points are no more than the unknowns of
    a higher degree, the change from a lower one decides alone.
    """
    count = len(fit.curves) - 1
    # Shifts and exponent as sums of increments.
    sums = np.vstack([np.transpose([against_middle(each) for each in np.eye(count)]), _lever(fit)])

    def at(degree):
        each = Fit(fit.curves, degree, fit.lifted)
        increments = near(each, guess)
        return np.array([increments, each.lifts(increments)]) @ sums.T

    here, before = at(fit.degree), at(fit.degree - 2)
    tangent = fit.tangent(near(fit, guess))
    after = at(fit.degree + 2) if len(tangent) > tangent.shape[1] + 2 else before
    # The last columns of the tangent are the shifts along the load, those before them the levels.
    inverse = np.linalg.pinv(tangent)[-(1 + fit.lifted) * count :].reshape(-1, count, len(tangent))[::-1]
    most = missed * np.linalg.norm(sums @ inverse, axis=2)
    return np.maximum(np.pad(most, ((0, 1 - fit.lifted), (0, 0))), unsettled(here - before, here - after))


def unsettled(before: np.ndarray, after: np.ndarray) -> np.ndarray:
    """What numbers of a polynomial may be off by, after their changes to its degree and from it to a higher one.

    From one degree to the next numbers change less and less, or do not settle: they may be off by the geometric
    mean of both changes, or by the latter where it is larger.
    """
    before, after = np.abs(before), np.abs(after)
    return np.sqrt(after * np.maximum(before, after))
