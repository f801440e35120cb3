"""Collapse of ln mu (ln F) at several speeds onto one curve by horizontal shifts, Eq. 23, and whether it holds.

All shifts are found at once, with the curve itself projected out (variable projection; Golub and Pereyra 1973).
Whether vertical shifts are needed beside them is asked afterwards: Eq. 23 has none.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import nan, sqrt

import numpy as np
from numpy.polynomial import chebyshev
from scipy.optimize import least_squares
from scipy.stats import f as f_distribution

# Stiff enough not to follow the scatter, and close enough to Eq. 19 over three decades of xi for 1 % in mu. Where
# the scatter is less than that, the curve gets more freedom as long as that pays.
DEGREE, MOST_FREE = 4, 10
# Neighbouring curves share at least this part of the shorter one's range of ln F: a fit that wants less is no fit.
LEAST_OVERLAP = 0.25
# Of the largest singular value, what still counts.
_TOLD = 1e-12
# Of a vertical shift that is not needed, taken for one that is.
CHANCE = 0.01
# Exponents of the speed from which the fit starts.
STARTS = np.linspace(-3.0, 3.0, 7)


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
class Collapse:
    """What horizontal shifting achieves.

    speeds : (K,) [m/s], ascending
    shifts, shift_errors : ln p(v)/p(v_ref) (K,) and standard errors, NaN if unknown or where not the fit but the
        demand for overlap decides; reference is the middle speed
    reference : its index
    before, after : misfit to one common curve, without and with the shifts
    scatter : rms standard error of ln mu, NaN if unknown
    exponent, exponent_error : of p ~ v^exponent, by generalised least squares; its error is NaN where theirs are
    overlaps : whether neighbouring curves still share a stretch of the common curve
    separable : False if straight parallel lines fit within scatter: then a horizontal shift is a vertical one
    curves : what was fitted
    degree : of the common polynomial
    """

    speeds: np.ndarray
    shifts: np.ndarray
    shift_errors: np.ndarray
    reference: int
    before: Misfit
    after: Misfit
    scatter: float
    exponent: float
    exponent_error: float
    overlaps: bool
    separable: bool
    curves: tuple[Curve, ...]
    degree: int

    @property
    def verdict(self) -> str:
        """holds, fails or undecided: whether horizontal shifts bring the curves onto one."""
        return self.after.verdict if self.overlaps and self.separable else "undecided"


def collapse(curves: Sequence[Curve]) -> Collapse:
    """Shift curves onto one polynomial in ln F + b_v, jointly, b = 0 at the middle speed.

    Points weigh by 1/error, or all alike where an error is unknown. Raises ValueError with fewer than two curves
    or fewer points than unknowns.
    """
    curves = tuple(sorted(curves, key=lambda curve: curve.speed))
    unknowns = len(curves) - 1 + DEGREE + 1
    if len(curves) < 2 or sum(curve.log_load.size for curve in curves) <= unknowns:
        raise ValueError(f"{len(curves)} curves with too few points for {unknowns} unknowns: add loads or speeds")
    lower, upper = _bounds(curves)
    speeds = np.array([curve.speed for curve in curves])
    fit, best = _freed(*_best(_Fit(curves, DEGREE), np.diff(np.log(speeds)), lower, upper), lower, upper)
    inside = bool(np.all(np.minimum(best.x - lower, upper - best.x) > 1e-3 * (upper - lower)))
    certain = fit.known and inside
    covariance = _covariance(fit, best)
    reference = len(curves) // 2
    shifts, covariance = _from_increments(best.x, covariance, reference)
    exponent, exponent_error = _exponent(np.log(speeds / speeds[reference]), shifts, covariance, reference)
    return Collapse(
        speeds=speeds,
        shifts=shifts,
        shift_errors=np.sqrt(np.diag(covariance)) if certain else np.full(len(curves), nan),
        reference=reference,
        before=fit.misfit(np.zeros_like(best.x), shifts=0),
        after=fit.misfit(best.x, shifts=best.x.size),
        scatter=_rms(fit.error) if fit.known else nan,
        exponent=exponent,
        exponent_error=exponent_error if certain else nan,
        overlaps=inside,
        separable=not _straight(fit),
        curves=curves,
        degree=fit.degree,
    )


@dataclass(frozen=True)
class Vertical:
    """What vertical shifts beside the horizontal ones achieve, ln mu + c_v against ln F + b_v.

    shifts, shift_errors : c_v (K,), zero at the reference speed, and standard errors
    exponent, exponent_error : of exp(c_v) ~ v^exponent
    horizontal_exponent, horizontal_exponent_error : of p(v), now with vertical shifts beside it
    after : misfit with both
    chance : of a misfit that falls as much if no vertical shift is needed (F test); errors need not be known, but
        points must be independent
    separable : False where straight parallel lines fit: then one shift is the other
    """

    shifts: np.ndarray
    shift_errors: np.ndarray
    exponent: float
    exponent_error: float
    horizontal_exponent: float
    horizontal_exponent_error: float
    after: Misfit
    chance: float
    separable: bool

    @property
    def needed(self) -> str:
        """yes, no or undecided, at 1 in 100."""
        if not self.separable or not np.isfinite(self.chance):
            return "undecided"
        return "yes" if self.chance < CHANCE else "no"


def vertical(result: Collapse) -> Vertical:
    """Shift curves vertically too, and ask whether that is needed.

    The polynomial has at least the degree of the collapse, and a higher one where that pays (Schwarz 1978): a
    stiff curve would ask for vertical shifts of its own. Raises ValueError where there are too few points for as
    many shifts.
    """
    count = len(result.curves) - 1
    lower, upper = _bounds(result.curves)
    logs = np.log(result.speeds / result.speeds[result.reference])
    start = np.diff(result.shifts)
    fit, best = _lifted(result, [start, *(power * np.diff(logs) for power in STARTS)], lower, upper)
    freedom = fit.log_load.size - fit.degree - 1 - 2 * count
    level = _minimum(_Fit(result.curves, fit.degree), start, lower, upper)
    reduced = 2 * best.cost / freedom
    levels, covariance = fit.linearised(best.x)
    covariance = covariance * (max(1.0, reduced) if fit.known else reduced)
    horizontal, raised = (
        _from_increments(values, covariance[part, part], result.reference)
        for values, part in ((best.x, slice(count)), (levels, slice(count, 2 * count)))
    )
    exponent, exponent_error = _exponent(logs, *raised, result.reference)
    horizontal_exponent, horizontal_error = _exponent(logs, *horizontal, result.reference)
    gain = 2 * (level.cost - best.cost) / count / reduced if reduced else nan
    return Vertical(
        shifts=raised[0],
        shift_errors=np.sqrt(np.diag(raised[1])),
        exponent=exponent,
        exponent_error=exponent_error,
        horizontal_exponent=horizontal_exponent,
        horizontal_exponent_error=horizontal_error,
        after=fit.misfit(best.x, shifts=count),
        chance=float(f_distribution.sf(gain, count, freedom)),
        separable=result.separable,
    )


def _lifted(result, guesses, lower, upper):
    """The fit with both shifts, on the polynomial of which a degree more does not pay."""
    size, chosen = sum(curve.log_load.size for curve in result.curves), None
    for degree in range(result.degree, MOST_FREE + 1, 2):
        if size <= degree + 1 + 2 * len(guesses[0]):
            break
        fit = _Fit(result.curves, degree, lifted=True)
        best = min((_minimum(fit, guess, lower, upper) for guess in guesses), key=lambda found: found.cost)
        price = size * np.log(max(best.cost, np.finfo(float).tiny)) + degree * np.log(size)
        if chosen is None or price < chosen[0]:
            chosen = price, fit, best
        guesses = [best.x]
    if chosen is None:
        raise ValueError(f"too few points for {2 * len(guesses[0])} shifts and a curve: add loads")
    return chosen[1:]


def misfit_at(result: Collapse, exponent: float) -> Misfit:
    """Misfit once shifted by a power of the speed; NaN where that leaves neighbours without the least overlap."""
    increments = exponent * np.diff(np.log(result.speeds))
    lower, upper = _bounds(result.curves)
    if np.any((increments < lower) | (increments > upper)):
        return Misfit(nan, nan, 0)
    return _Fit(result.curves, result.degree).misfit(increments, shifts=0)


def shifted(result: Collapse) -> list[np.ndarray]:
    """ln F + b_v of each curve."""
    return [curve.log_load + shift for curve, shift in zip(result.curves, result.shifts, strict=True)]


class _Fit:
    """Misfit of the curves to their best common polynomial, given the increments of the shifts."""

    def __init__(self, curves, degree, lifted=False):
        self.curves, self.degree = curves, degree
        self.owner = np.repeat(np.arange(len(curves)), [curve.log_load.size for curve in curves])
        self.log_load = np.concatenate([curve.log_load for curve in curves])
        self.log_friction = np.concatenate([curve.log_friction for curve in curves])
        self.error = np.concatenate([curve.error for curve in curves])
        self.known = bool(np.all(np.isfinite(self.error) & (self.error > 0)))
        self.weight = 1 / self.error if self.known else np.ones_like(self.log_load)
        # An increment of the level moves every later curve down.
        self.levels = (self.owner[:, None] > np.arange(len(curves) - 1 if lifted else 0)).astype(float)

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
        # An increment moves every later curve.
        moved = slopes[:, None] * (self.owner[:, None] > np.arange(len(increments)))
        return basis @ (basis.T @ moved) - moved

    def linearised(self, increments):
        """Increments of the level (K - 1,), and the covariance of those of both shifts for unit errors."""
        basis, _, slopes, coefficients = self._linear(increments)
        moved = slopes[:, None] * (self.owner[:, None] > np.arange(len(increments)))
        levels = slice(self.degree + 1, None)
        design = np.hstack([moved, basis[:, levels], basis[:, : self.degree + 1]])
        scale = np.linalg.norm(design, axis=0)
        inverse = np.linalg.pinv((design / scale).T @ (design / scale)) / np.outer(scale, scale)
        count = 2 * len(increments)
        return coefficients[levels], inverse[:count, :count]

    def _projected(self, increments):
        """Orthonormal polynomials and levels (N, M), slope of the best curve and ln mu (N,), over the error."""
        _, orthonormal, slopes, _ = self._linear(increments)
        return orthonormal, slopes, self.log_friction * self.weight

    def _linear(self, increments):
        """Polynomials and levels (N, M), the same orthonormal, slope of the best curve (N,), over the error; and
        its coefficients (M,)."""
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
        return basis, orthonormal, slopes * self.weight, coefficients

    def misfit(self, increments, shifts):
        """shifts : how many of the increments were fitted."""
        misfits = self.misfits(increments)
        freedom = misfits.size - self.degree - 1 - self.levels.shape[1] - shifts
        chi_square = float(np.sum(np.square(misfits * self.weight)) / freedom) if self.known else nan
        return Misfit(_rms(misfits), chi_square, freedom)


def _bounds(curves):
    """Increments that leave neighbouring curves the least overlap."""
    lower, upper = [], []
    for left, right in pairwise(curves):
        a, b = left.log_load, right.log_load
        shared = LEAST_OVERLAP * min(np.ptp(a), np.ptp(b))
        lower.append(a.min() - b.max() + shared)
        upper.append(a.max() - b.min() - shared)
    return np.array(lower), np.array(upper)


def _best(fit, lengths, lower, upper):
    """The fit and its least misfit of several starts, powers of the speed: one can end in a local minimum."""
    guesses = (start * lengths for start in STARTS)
    return fit, min((_minimum(fit, guess, lower, upper) for guess in guesses), key=lambda found: found.cost)


def _freed(fit, best, lower, upper):
    """The first fit with a curve of a higher degree that misses no more than the errors allow, else the one given.

    Each new coefficient must lower chi square by more than ln N: Schwarz, Ann. Stat. 6, 461 (1978).
    """
    if not fit.known or fit.misfit(best.x, best.x.size).verdict != "fails":
        return fit, best
    for degree in range(fit.degree + 2, MOST_FREE + 1, 2):
        if fit.log_load.size <= best.x.size + degree + 1:
            break
        freer, price = _Fit(fit.curves, degree), (degree - fit.degree) * np.log(fit.log_load.size)
        found = _minimum(freer, best.x, lower, upper)
        holds = freer.misfit(found.x, found.x.size).verdict == "holds"
        if holds and 2 * (best.cost - found.cost) > price:
            return freer, found
    return fit, best


def _minimum(fit, guess, lower, upper):
    margin = 1e-3 * (upper - lower)
    guess = np.clip(guess, lower + margin, upper - margin)
    return least_squares(
        fit.residuals, guess, fit.jacobian, bounds=(lower, upper), xtol=1e-14, ftol=1e-14, gtol=1e-14
    )


def _covariance(fit, best):
    """Of the increments, from the projected Jacobian; widened where the misfit exceeds the errors."""
    freedom = fit.log_load.size - best.x.size - fit.degree - 1
    reduced = 2 * best.cost / freedom
    return np.linalg.pinv(best.jac.T @ best.jac) * (max(1.0, reduced) if fit.known else reduced)


def _from_increments(increments, covariance, reference):
    """Shifts against the reference speed, and their covariance."""
    count = len(increments) + 1
    sums = np.tril(np.ones((count, count - 1)), -1)
    sums -= sums[reference]
    return sums @ increments, sums @ covariance @ sums.T


def _exponent(log_speed, shifts, covariance, reference):
    """Slope of the shifts through the reference; with the full covariance it does not depend on which that is."""
    others = np.arange(len(shifts)) != reference
    inverse = np.linalg.pinv(covariance[np.ix_(others, others)], hermitian=True)
    weight = log_speed[others] @ inverse
    information = weight @ log_speed[others]
    if not information > 0:
        return nan, nan
    return float(weight @ shifts[others] / information), 1 / sqrt(information)


def _straight(fit):
    """Whether parallel straight lines, one intercept each, fit as well as the errors ask for.

    Without errors the question is whether they fit to rounding.
    """
    intercepts = np.equal.outer(fit.owner, np.unique(fit.owner)).astype(float)
    basis = np.column_stack([intercepts, fit.log_load])
    weighted = basis * fit.weight[:, None]
    coefficients = np.linalg.lstsq(weighted, fit.log_friction * fit.weight)[0]
    misfits = (fit.log_friction - basis @ coefficients) * fit.weight
    freedom = misfits.size - basis.shape[1]
    if not fit.known:
        return _rms(misfits) < 1e-9
    return misfits @ misfits / freedom < 1 + 2 * sqrt(2 / freedom)


def _rms(values):
    return float(np.sqrt(np.mean(np.square(values))))
