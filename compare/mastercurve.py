"""Collapse of ln mu (ln F) at several speeds onto one curve by horizontal shifts, Eq. 23, and whether it holds.

All shifts are found at once.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import nan, sqrt

import numpy as np

from .commoncurve import (
    Curve,
    Fit,
    Misfit,
    best_of_starts,
    bounds,
    from_increments,
    inside,
    minimum,
    power_of_speed,
    rms,
)

# Stiff enough not to follow the scatter, and close enough to Eq. 19 over three decades of xi for 1 % in mu. Where
# the scatter is less than that, the curve gets more freedom as long as that pays.
DEGREE, MOST_FREE = 4, 10


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
    lower, upper = bounds(curves)
    speeds = np.array([curve.speed for curve in curves])
    started, least = best_of_starts(Fit(curves, DEGREE), np.diff(np.log(speeds)), lower, upper)
    fit, best = _freed(started, least, lower, upper)
    overlaps = inside(best.x, lower, upper)
    certain = fit.known and overlaps
    covariance = _covariance(fit, best)
    reference = len(curves) // 2
    shifts, covariance = from_increments(best.x, covariance, reference)
    exponent, exponent_error = power_of_speed(np.log(speeds / speeds[reference]), shifts, covariance, reference)
    return Collapse(
        speeds=speeds,
        shifts=shifts,
        shift_errors=np.sqrt(np.diag(covariance)) if certain else np.full(len(curves), nan),
        reference=reference,
        before=fit.misfit(np.zeros_like(best.x), shifts=0),
        after=fit.misfit(best.x, shifts=best.x.size),
        scatter=rms(fit.error) if fit.known else nan,
        exponent=exponent,
        exponent_error=exponent_error if certain else nan,
        overlaps=overlaps,
        separable=not _straight(fit),
        curves=curves,
        degree=fit.degree,
    )


def misfit_at(result: Collapse, exponent: float) -> Misfit:
    """Misfit once shifted by a power of the speed; NaN where that leaves neighbours without the least overlap."""
    increments = exponent * np.diff(np.log(result.speeds))
    lower, upper = bounds(result.curves)
    if np.any((increments < lower) | (increments > upper)):
        return Misfit(nan, nan, 0)
    return Fit(result.curves, result.degree).misfit(increments, shifts=0)


def shifted(result: Collapse) -> list[np.ndarray]:
    """ln F + b_v of each curve."""
    return [curve.log_load + shift for curve, shift in zip(result.curves, result.shifts, strict=True)]


def _freed(fit, best, lower, upper):
    """The first fit with a curve of a higher degree that misses no more than the errors allow, else the one given.

    Each new coefficient must lower chi square by more than ln N: Schwarz, Ann. Stat. 6, 461 (1978).
    """
    if not fit.known or fit.misfit(best.x, best.x.size).verdict != "fails":
        return fit, best
    for degree in range(fit.degree + 2, MOST_FREE + 1, 2):
        if fit.log_load.size <= best.x.size + degree + 1:
            break
        freer, price = Fit(fit.curves, degree), (degree - fit.degree) * np.log(fit.log_load.size)
        found = minimum(freer, best.x, lower, upper)
        holds = freer.misfit(found.x, found.x.size).verdict == "holds"
        if holds and 2 * (best.cost - found.cost) > price:
            return freer, found
    return fit, best


def _covariance(fit, best):
    """Of the increments, from the projected Jacobian; widened where the misfit exceeds the errors."""
    freedom = fit.log_load.size - best.x.size - fit.degree - 1
    reduced = 2 * best.cost / freedom
    return np.linalg.pinv(best.jac.T @ best.jac) * (max(1.0, reduced) if fit.known else reduced)


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
        return rms(misfits) < 1e-9
    return misfits @ misfits / freedom < 1 + 2 * sqrt(2 / freedom)
