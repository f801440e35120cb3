"""Curves of friction against load, and how far they are from one common polynomial once they are shifted.

Shifts are sought with the polynomial projected out (variable projection; Golub and Pereyra 1973).
"""

from dataclasses import dataclass
from itertools import pairwise
from math import nan, sqrt

import numpy as np
from numpy.polynomial import chebyshev
from scipy.optimize import least_squares

# Neighbouring curves share at least this part of the shorter one's range of ln F: a fit that wants less is no fit.
LEAST_OVERLAP = 0.25
# Exponents of the speed from which the fit starts.
STARTS = np.linspace(-3.0, 3.0, 7)
# Of the largest singular value, what still counts.
_TOLD = 1e-12
# Of the range between the bounds, what counts as at one of them.
_CLEAR = 1e-3
# Of Gauss-Newton: steps at most, and the square of what a step still changes over the sum of squares.
_NEAR, _SETTLED = 20, 1e-12


@dataclass(frozen=True)
class Curve:
    """Friction against load at one speed [m/s]: ln F, ln mu and its standard error, NaN if unknown, each (N,)."""

    speed: float
    log_load: np.ndarray
    log_friction: np.ndarray
    error: np.ndarray


@dataclass(frozen=True)
class Misfit:
    """How far curves are from one: rms of ln mu, and chi square per degree of freedom, NaN without errors."""

    rms: float
    chi_square: float
    freedom: int

    @property
    def verdict(self) -> str:
        """holds, fails or undecided: whether the misfit is no more than scatter, to two standard deviations."""
        if not np.isfinite(self.chi_square):
            return "undecided"
        return "holds" if self.chi_square <= 1 + 2 * sqrt(2 / self.freedom) else "fails"


@dataclass(frozen=True)
class Common:
    """The best common polynomial of curves shifted in some way; arrays over all points (N,), over their errors.

    basis, orthonormal : polynomials and levels (N, M), as they are and orthonormal
    slopes : of the polynomial
    coefficients : of the polynomial, then the increments of the level (M,)
    domain : least and greatest ln F, shifted as the first curve is
    """

    basis: np.ndarray
    orthonormal: np.ndarray
    slopes: np.ndarray
    coefficients: np.ndarray
    domain: tuple[float, float]


class Fit:
    """Misfit of the curves to their best common polynomial, given the increments of the shifts."""

    def __init__(self, curves, degree, lifted=False):
        self.curves, self.degree, self.lifted = curves, degree, lifted
        self.owner = np.repeat(np.arange(len(curves)), [curve.log_load.size for curve in curves])
        self.log_load = np.concatenate([curve.log_load for curve in curves])
        self.log_friction = np.concatenate([curve.log_friction for curve in curves])
        self.error = np.concatenate([curve.error for curve in curves])
        self.known = bool(np.all(np.isfinite(self.error) & (self.error > 0)))
        self.weight = 1 / self.error if self.known else np.ones_like(self.log_load)
        # An increment moves every later curve.
        self.later = (self.owner[:, None] > np.arange(len(curves) - 1)).astype(float)
        # One of the level moves it down.
        self.levels = self.later if lifted else self.later[:, :0]
        self._last = None

    def misfits(self, increments):
        """ln mu minus the best polynomial, (N,)."""
        return self.residuals(increments) / self.weight

    def residuals(self, increments):
        """Misfits over errors, (N,)."""
        basis, _, wanted = self._projected(increments)
        return wanted - basis @ (basis.T @ wanted)

    def jacobian(self, increments):
        """Of the residuals, (N, increments), but for what lies in the span of the polynomials.

        Kaufman, BIT 15, 49 (1975). The gradient of the sum of squares is exact, as residuals do not lie there.
        """
        basis, slopes, _ = self._projected(increments)
        moved = slopes[:, None] * self.later
        return basis @ (basis.T @ moved) - moved

    def tangent(self, increments):
        """What the fit can change to first order: polynomials, levels and shifts (N, M), over the error."""
        common = self.common(increments)
        return np.hstack([common.basis, common.slopes[:, None] * self.later])

    def lifts(self, increments):
        """Increments of the level (K - 1,), zero where curves are not lifted."""
        return (
            self.common(increments).coefficients[self.degree + 1 :] if self.lifted else np.zeros(len(increments))
        )

    def linearised(self, increments):
        """Increments of the level (K - 1,), and the covariance of those of both shifts for unit errors."""
        common = self.common(increments)
        levels = slice(self.degree + 1, None)
        moved = common.slopes[:, None] * self.later
        design = np.hstack([moved, common.basis[:, levels], common.basis[:, : self.degree + 1]])
        scale = np.linalg.norm(design, axis=0)
        inverse = np.linalg.pinv((design / scale).T @ (design / scale)) / np.outer(scale, scale)
        count = 2 * len(increments)
        return common.coefficients[levels], inverse[:count, :count]

    def _projected(self, increments):
        """Orthonormal polynomials and levels (N, M), slope of the best curve and ln mu (N,), over the error."""
        common = self.common(increments)
        return common.orthonormal, common.slopes, self.log_friction * self.weight

    def common(self, increments):
        """The best polynomial once the curves are shifted; kept, as residuals and slopes are asked for in turn."""
        if self._last is None or not np.array_equal(self._last[0], increments):
            self._last = np.array(increments), self._common(increments)
        return self._last[1]

    def _common(self, increments):
        x = self.log_load + np.concatenate([[0], np.cumsum(increments)])[self.owner]
        middle, half = (x.max() + x.min()) / 2, (x.max() - x.min()) / 2
        scaled = (x - middle) / half
        basis = np.hstack([chebyshev.chebvander(scaled, self.degree), -self.levels]) * self.weight[:, None]
        left, sizes, right = np.linalg.svd(basis, full_matrices=False)
        # Where loads coincide once shifted, fewer polynomials are told apart than there are.
        told = sizes > _TOLD * sizes[0]
        orthonormal = left[:, told]
        coefficients = right[told].T @ (orthonormal.T @ (self.log_friction * self.weight) / sizes[told])
        slopes = chebyshev.chebval(scaled, chebyshev.chebder(coefficients[: self.degree + 1])) / half
        return Common(
            basis=basis,
            orthonormal=orthonormal,
            slopes=slopes * self.weight,
            coefficients=coefficients,
            domain=(x.min(), x.max()),
        )

    def misfit(self, increments, shifts):
        """shifts : how many of the increments were fitted."""
        misfits = self.misfits(increments)
        freedom = misfits.size - self.degree - 1 - self.levels.shape[1] - shifts
        chi_square = float(np.sum(np.square(misfits * self.weight)) / freedom) if self.known else nan
        return Misfit(rms(misfits), chi_square, freedom)


def bounds(curves):
    """Increments that leave neighbouring curves the least overlap."""
    lower, upper = [], []
    for left, right in pairwise(curves):
        a, b = left.log_load, right.log_load
        shared = LEAST_OVERLAP * min(np.ptp(a), np.ptp(b))
        lower.append(a.min() - b.max() + shared)
        upper.append(a.max() - b.min() - shared)
    return np.array(lower), np.array(upper)


def best_of_starts(fit, lengths, lower, upper):
    """The fit and its least misfit of several starts, powers of the speed: one can end in a local minimum."""
    guesses = (start * lengths for start in STARTS)
    return fit, min((minimum(fit, guess, lower, upper) for guess in guesses), key=lambda found: found.cost)


def minimum(fit, guess, lower, upper):
    guess = within(guess, lower, upper)
    return least_squares(
        fit.residuals, guess, fit.jacobian, bounds=(lower, upper), xtol=1e-14, ftol=1e-14, gtol=1e-14
    )


def near(fit, guess, lower, upper):
    """Increments of least misfit close to a guess (Gauss-Newton), from `minimum` where they are not that close."""
    at, least = guess, np.inf
    for _ in range(_NEAR):
        residuals, jacobian = fit.residuals(at), fit.jacobian(at)
        cost = residuals @ residuals
        if not cost <= least or np.any((at <= lower) | (at >= upper)):
            break
        least = cost
        step = np.linalg.lstsq(jacobian, -residuals, rcond=_TOLD)[0]
        gain = jacobian @ step
        at = at + step
        if gain @ gain <= _SETTLED * (cost + _TOLD**2):
            return at
    return minimum(fit, guess, lower, upper).x


def within(increments, lower, upper):
    """The nearest increments that keep clear of the bounds."""
    margin = _CLEAR * (upper - lower)
    return np.clip(increments, lower + margin, upper - margin)


def inside(increments, lower, upper):
    """Whether the demand for overlap leaves the increments free."""
    return bool(np.all(np.minimum(increments - lower, upper - increments) > _CLEAR * (upper - lower)))


def from_increments(increments, covariance, reference):
    """Shifts against the reference speed, and their covariance."""
    count = len(increments) + 1
    sums = np.tril(np.ones((count, count - 1)), -1)
    sums -= sums[reference]
    return sums @ increments, sums @ covariance @ sums.T


def power_of_speed(log_speed, shifts, covariance, reference):
    """Slope of the shifts through the reference; with the full covariance it does not depend on which that is."""
    others = np.arange(len(shifts)) != reference
    inverse = np.linalg.pinv(covariance[np.ix_(others, others)], hermitian=True)
    weight = log_speed[others] @ inverse
    information = weight @ log_speed[others]
    if not information > 0:
        return nan, nan
    return float(weight @ shifts[others] / information), 1 / sqrt(information)


def rms(values):
    return float(np.sqrt(np.mean(np.square(values))))
