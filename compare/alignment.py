"""One choice of shifts of curves on the same surfaces: what they are, and how far it leaves the curves from one.

Points share their surfaces, so what counts as scatter comes from leaving surfaces out, never points.
"""

from dataclasses import dataclass, replace
from math import nan

import numpy as np
from numpy.polynomial import Chebyshev

from .commoncurve import Fit, bounds, inside, near, rms
from .statistics.jackknife import Estimated, RmsMisfit, resample

# What rounding leaves of ln mu.
ROUNDING = 1e-9
_PARTED = "the fit asks for less than the least overlap of neighbours"


@dataclass(frozen=True)
class Alignment:
    """Curves shifted to ln mu + c_v against ln F + b_v; what is not fitted is exactly zero.

    horizontal, vertical : b_v and c_v (S,), zero at the middle speed
    exponent, vertical_exponent : of exp(b_v) and exp(c_v) as powers of the speed, least squares
    raised : rms of c_v over the speeds about its mean, as a level common to all is no shift
    rms : of ln mu about the common curve, with scatter
    misfit : the same without what scatter of the surfaces adds
    mended : of that, what vertical shifts would take away to first order
    curve : ln mu of ln F, that of the middle speed
    reason : why the shifts are not known; None where they are. Where the curves part, misfit and mended are those
        at the least overlap of neighbours, and all else but rms is NaN
    """

    horizontal: Estimated
    vertical: Estimated
    exponent: Estimated
    vertical_exponent: Estimated
    raised: RmsMisfit
    rms: float
    misfit: RmsMisfit
    mended: RmsMisfit
    curve: Chebyshev | None
    reason: str | None = None

    @classmethod
    def undecided(cls, speeds: int, missed: float, reason: str) -> "Alignment":
        """One of which no shift is known."""
        number, shifts = Estimated(nan, nan, 0), Estimated(np.full(speeds, nan), np.full(speeds, nan), 0)
        size = RmsMisfit.unknown()
        return cls(shifts, shifts, number, number, size, missed, size, size, None, reason)


def still(samples, fit):
    """Curves that are not shifted horizontally."""
    return _aligned(samples, fit, lambda each: np.zeros(len(each.curves) - 1))


def moved(samples, fit, guess):
    """Curves that are, from a guess; where they part, only the misfit that the least overlap leaves is known."""
    lower, upper = bounds(fit.curves)
    best = near(fit, guess, lower, upper)

    def sought(each):
        return near(each, best, *bounds(each.curves))

    if inside(best, lower, upper):
        return _aligned(samples, fit, sought)

    def missed(part):
        each = Fit(part.curves, fit.degree, fit.lifted)
        return {"": each.residuals(sought(each))}

    return replace(undecided(fit, best, _PARTED), misfit=resample(missed, samples)[""].rms)


def taken(samples, level, lifted, along, both):
    """What vertical shifts take from the misfit that horizontal ones leave at the least overlap.

    along, both : guesses of the increments of either fit
    """

    def missed(fit, guess, part):
        each = Fit(part.curves, fit.degree, fit.lifted)
        return each.residuals(near(each, guess, *bounds(each.curves)))

    return resample(lambda part: {"": missed(level, along, part) - missed(lifted, both, part)}, samples)[""].rms


def undecided(fit, increments, reason):
    return Alignment.undecided(len(fit.curves), rms(fit.residuals(increments)), reason)


def _aligned(samples, fit, sought):
    """sought : increments of the best horizontal shifts of a fit."""
    logs = np.log(samples.speeds) - np.mean(np.log(samples.speeds))
    lever = logs / (logs @ logs)

    def numbers(part):
        each = Fit(part.curves, fit.degree, fit.lifted)
        increments = sought(each)
        missed, mending = each.residuals(increments), outside(each.tangent(increments), each.later)
        moved, lifted = _shifts(increments), _shifts(each.lifts(increments))
        return {
            "horizontal": moved,
            "vertical": lifted,
            "exponent": lever @ moved,
            "vertical_exponent": lever @ lifted,
            "raised": lifted - lifted.mean(),
            "misfit": missed,
            "mended": mending @ (mending.T @ missed),
        }

    found, increments = resample(numbers, samples), sought(fit)
    sizes = {name: found.pop(name).rms for name in ("raised", "misfit", "mended")}
    return Alignment(
        **{name: each.estimated for name, each in found.items()},
        **sizes,
        rms=rms(fit.residuals(increments)),
        curve=_curve(fit, increments),
    )


def _shifts(increments):
    """Against the middle speed (S,)."""
    sums = np.concatenate([[0], np.cumsum(increments)])
    return sums - sums[sums.size // 2]


def _curve(fit, increments):
    """The common polynomial as the curve of the middle speed has it."""
    common = fit.common(increments)
    along, lift = (-_shifts(each)[0] for each in (increments, fit.lifts(increments)))
    polynomial = Chebyshev(common.coefficients[: fit.degree + 1], domain=np.array(common.domain) - along)
    return polynomial - lift


def size_at(samples, degree, increments, lifted=False):
    """Misfit of the curves with given increments of the shifts."""
    return resample(lambda part: {"": Fit(part.curves, degree, lifted).residuals(increments)}, samples)[""].rms


def outside(tangent, others):
    """Orthonormal vectors (N, M) that others reach beyond a tangent space."""
    left, sizes, _ = np.linalg.svd(tangent, full_matrices=False)
    taken = left[:, sizes > ROUNDING * sizes[0]]
    left, sizes, _ = np.linalg.svd(others - taken @ (taken.T @ others), full_matrices=False)
    return left[:, sizes > ROUNDING * np.linalg.norm(others)]
