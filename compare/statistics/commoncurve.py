"""Common polynomial of curves of friction against load that are shifted, and how far they are from it.

Shifts are sought with the polynomial projected out (variable projection; Golub and Pereyra 1973).
"""

from collections.abc import Sequence
from dataclasses import dataclass

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
        low, high = (np.array([end(each) for each in places]) for end in (np.min, np.max))
        shared = LEAST_OVERLAP * np.minimum((high - low)[:-1], (high - low)[1:])
        # Least and greatest increments that leave neighbours the least overlap.
        self.bounds = low[:-1] - high[1:] + shared, high[:-1] - low[1:] - shared
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

    def projected(self, basis):
        """Orthonormal basis and coefficients of y in a basis; functions that coincide there count as one."""
        left, sizes, right = np.linalg.svd(basis, full_matrices=False)
        told = sizes > _LEAST_SINGULAR * sizes[0]
        return left[:, told], right[told].T @ (left[:, told].T @ self.y / sizes[told])


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

    @property
    def sums(self) -> np.ndarray:
        """Weights (S + 1, S - 1) of increments in shifts against the middle speed, and in the exponent of these.

        The exponent is that of the power of the speed that is closest to the shifts, least squares.
        """
        logs = np.log([curve.speed for curve in self.curves])
        logs -= logs.mean()
        shifts = np.tri(logs.size, logs.size - 1, -1)
        return np.vstack([shifts - shifts[logs.size // 2], logs @ shifts / (logs @ logs)])

    def shifts(self, increments: np.ndarray) -> np.ndarray:
        """Shifts against the middle speed along load and friction, the exponents of both last (2, S + 1)."""
        return np.array([increments, self.lifts(increments)]) @ self.sums.T

    def _common(self, x):
        scaled, half = scaled_to_one(x)
        basis = np.hstack([chebyshev.chebvander(scaled, self.degree), -self.levels])
        # Where loads coincide once shifted, fewer polynomials are told apart than there are.
        orthonormal, coefficients = self.projected(basis)
        slopes = chebyshev.chebval(scaled, chebyshev.chebder(coefficients[: self.degree + 1])) / half
        return Common(basis, orthonormal, slopes, coefficients, (x.min(), x.max()))


def scaled_to_one(x: np.ndarray) -> tuple[np.ndarray, float]:
    """Places between -1 and 1, and half of the range that they had; 1 of a single place."""
    middle, half = (x.max() + x.min()) / 2, np.ptp(x) / 2 or 1.0
    return (x - middle) / half, half


def near(fit: Projected, guess: np.ndarray) -> np.ndarray:
    """Increments of least misfit close to a guess (Gauss-Newton), or of a search within the bounds."""
    (lower, upper), at, least = fit.bounds, guess, np.inf
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

    def gradient(at):
        return np.where(free, fit.jacobian(at).T @ fit.residuals(at), at - found)

    # About the least of them squares differ by less than rounding; their gradient does not.
    at = root(gradient, found, tol=1e-13).x
    before, now = (np.linalg.norm(fit.residuals(each)) for each in (found, at))
    return at if now <= before * (1 + _ROUNDING) and np.all((lower <= at) & (at <= upper)) else found


def within(increments: np.ndarray, lower: np.ndarray, upper: np.ndarray) -> np.ndarray:
    """The nearest increments that keep clear of the bounds."""
    margin = _CLEAR * (upper - lower)
    return np.clip(increments, lower + margin, upper - margin)


def inside(increments: np.ndarray, lower: np.ndarray, upper: np.ndarray) -> bool:
    """Whether the demand for overlap leaves the increments free."""
    return np.array_equal(within(increments, lower, upper), increments)


def exponent_bias(fit: Fit, guess: np.ndarray, missed: float) -> np.ndarray:
    """What shifts against the middle speed and their exponents may be off by, as no polynomial is the law.

    missed : ln mu, root of the sum of squares, by which the fit may miss along the gradient of a number

    Returns (2, S + 1), along load and friction, the exponents last. Where points are no more than the unknowns of
    a higher degree, the change from a lower one decides alone.
    """

    def at(degree):
        each = Fit(fit.curves, degree, fit.lifted)
        return each.shifts(near(each, guess))

    here, before = at(fit.degree), at(fit.degree - 2)
    tangent = fit.tangent(near(fit, guess))
    after = at(fit.degree + 2) if len(tangent) > tangent.shape[1] + 2 else before
    # The last columns of the tangent are the shifts along the load, those before them the levels.
    inverse = np.linalg.pinv(tangent)[-(1 + fit.lifted) * guess.size :].reshape(-1, guess.size, len(tangent))[::-1]
    most = missed * np.linalg.norm(fit.sums @ inverse, axis=2)
    return np.maximum(np.pad(most, ((0, 1 - fit.lifted), (0, 0))), unsettled(here - before, here - after))


def unsettled(before: np.ndarray, after: np.ndarray) -> np.ndarray:
    """What numbers of a polynomial may be off by, after their changes to its degree and from it to a higher one.

    From one degree to the next numbers change less and less, or do not settle: they may be off by the geometric
    mean of both changes, or by the latter where it is larger.
    """
    before, after = np.abs(before), np.abs(after)
    return np.sqrt(after * np.maximum(before, after))
