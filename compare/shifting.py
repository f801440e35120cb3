"""Whether mean curves of friction on the same random surfaces fall onto one when shifted, Eq. 23.

Points share their surfaces, so what counts as scatter comes from leaving surfaces out, never points.
"""

from dataclasses import dataclass, replace
from math import nan

import numpy as np
from numpy.polynomial import Chebyshev

from .commoncurve import Curve, Fit, bounds, inside, near, rms, within
from .mastercurve import DEGREE, MOST_FREE
from .resampling import Estimated, Replicates, Size, resample
from .samples import Samples

# Of ln mu: parallel straight lines that miss no more are straight. Friction is solved, and Eq. 19 is followed by a
# polynomial of the fourth degree, to about that, so less curvature does not tell one shift from the other.
STRAIGHT = 0.01
# Of coefficients that scatter alone asks for, at each rise of the degree.
CHANCE = 0.05
# Powers of the speed from which shifts are sought, and how many are followed to their minimum.
POWERS, FOLLOWED = np.linspace(-3.0, 3.0, 25), 3
# What rounding leaves of ln mu.
ROUNDING = 1e-9
_PARTED = "the fit asks for less than the least overlap of neighbours"
_PARALLEL = "parallel straight lines: one shift is the other"


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
    reason : why the shifts are not known and all but rms is NaN; None where they are
    """

    horizontal: Estimated
    vertical: Estimated
    exponent: Estimated
    vertical_exponent: Estimated
    raised: Size
    rms: float
    misfit: Size
    mended: Size
    curve: Chebyshev | None
    reason: str | None = None

    @classmethod
    def undecided(cls, speeds: int, missed: float, reason: str) -> "Alignment":
        """One of which no shift is known."""
        number, shifts = Estimated(nan, nan, 0), Estimated(np.full(speeds, nan), np.full(speeds, nan), 0)
        size = Size.unknown()
        return cls(shifts, shifts, number, number, size, missed, size, size, None, reason)


@dataclass(frozen=True)
class Shifting:
    """Curves on the same surfaces, and how far from one they are for each choice of shifts.

    samples : what was fitted; points_left_out, surfaces_left_out : how many were not
    curves : with standard errors over the surfaces, to first order
    degree : of the common polynomial
    straight : misfit of parallel straight lines, one a speed
    none, horizontal, vertical, both : which shifts are fitted
    """

    samples: Samples
    points_left_out: int
    surfaces_left_out: int
    curves: tuple[Curve, ...]
    degree: int
    straight: Size
    none: Alignment
    horizontal: Alignment
    vertical: Alignment
    both: Alignment

    @property
    def speeds(self) -> np.ndarray:
        """(S,) [m/s], ascending."""
        return self.samples.speeds

    @property
    def separable(self) -> bool:
        """False where curves may be straight parallel lines: then a horizontal shift is a vertical one."""
        return _bent(self.straight)

    def collapses(self, tolerance: float) -> str:
        """holds, fails or undecided: whether horizontal shifts bring the curves this close, in ln mu, to one."""
        return self.horizontal.misfit.verdict(tolerance) if self.separable else "undecided"

    def level(self, tolerance: float) -> str:
        """holds, fails or undecided: whether vertical shifts beside the horizontal ones are at most that (rms).

        It fails only where vertical shifts also mend some of what the horizontal ones leave: where they hardly do,
        shifts are so uncertain that their errors are, too.
        """
        verdict, mends = self.both.raised.verdict(tolerance), self.horizontal.mended.interval()[0] > 0
        return "undecided" if verdict == "fails" and not mends else verdict


def shift(samples: Samples) -> Shifting:
    """Find all shifts at once, for each choice of them; points weigh alike.

    Raises ValueError with fewer than two speeds or fewer points than unknowns.
    """
    complete = samples.complete()
    curves = complete.curves
    unknowns = 2 * (len(curves) - 1) + DEGREE + 1
    if len(curves) < 2 or complete.known.sum() <= unknowns:
        raise ValueError(f"{len(curves)} speeds with too few points for {unknowns} unknowns: add loads or speeds")
    still = np.zeros(len(curves) - 1)
    straight = _size(complete, 1, still, lifted=True)
    along = _best(Fit(curves, DEGREE), still)
    lifted, both = _freed(complete, Fit(curves, DEGREE, lifted=True), along)
    level = Fit(curves, lifted.degree)
    return Shifting(
        samples=complete,
        points_left_out=int(samples.known.size - complete.known.sum()),
        surfaces_left_out=samples.surfaces - complete.surfaces,
        curves=_with_errors(complete, curves),
        degree=lifted.degree,
        straight=straight,
        none=_still(complete, level),
        horizontal=_moved(complete, level, along),
        vertical=_still(complete, lifted),
        both=_moved(complete, lifted, both) if _bent(straight) else _undecided(lifted, both, _PARALLEL),
    )


def misfit_at(found: Shifting, shifts: np.ndarray) -> Size:
    """Misfit of the curves once shifted by b_v (S,), as where a theory predicts ln p(v).

    Unknown where that leaves neighbours less than the least overlap.
    """
    increments = np.diff(shifts)
    lower, upper = bounds(found.curves)
    if not np.all((lower <= increments) & (increments <= upper)):
        return Size.unknown()
    return _size(found.samples, found.degree, increments)


def _with_errors(samples, curves):
    """To first order."""
    load, friction = samples.deviations
    errors = Replicates.first_order(np.zeros(len(load)), (friction - load).T).estimated.error
    parts = np.split(errors, np.cumsum([curve.log_load.size for curve in curves])[:-1])
    return tuple(replace(curve, error=error) for curve, error in zip(curves, parts, strict=True))


def _size(samples, degree, increments, lifted=False):
    """Misfit of the curves with given increments of the shifts."""
    return resample(lambda part: {"": Fit(part.curves, degree, lifted).residuals(increments)}, samples)[""].size


def _bent(straight):
    """Whether curves are not straight parallel lines."""
    return straight.interval()[0] > STRAIGHT


def _best(fit, *guesses):
    """Increments of least misfit of several starts, those given and powers of the speed."""
    lower, upper = bounds(fit.curves)
    lengths = np.diff(np.log([curve.speed for curve in fit.curves]))

    def cost(increments):
        return np.sum(np.square(fit.residuals(increments)))

    starts = [within(guess, lower, upper) for guess in (*guesses, *np.multiply.outer(POWERS, lengths))]
    followed = sorted(starts, key=cost)[:FOLLOWED]
    return min((near(fit, start, lower, upper) for start in followed), key=cost)


def _freed(samples, fit, guess):
    """The fit with the least degree from which a higher one takes no more than scatter, and its increments."""
    best = _best(fit, guess)
    while fit.degree < MOST_FREE and _pays(samples, fit, best):
        fit = Fit(fit.curves, fit.degree + 2, lifted=True)
        best = near(fit, best, *bounds(fit.curves))
    return fit, best


def _pays(samples, fit, increments):
    """Whether two more coefficients take from the misfit what scatter of the surfaces does not explain.

    The two components of the misfit are asked whether they are scatter. A third of the points stays free.
    """
    common, tangent = fit.common(increments), fit.tangent(increments)
    if len(tangent) - tangent.shape[1] - 2 < len(tangent) / 3:
        return False
    freer = Fit(fit.curves, fit.degree + 2).common(increments).basis[:, -2:]
    new = _outside(tangent, freer)
    load, friction = samples.deviations
    scatter = new.T @ (friction - (1 + common.slopes[:, None]) * load)
    missed = Replicates.first_order(new.T @ fit.residuals(increments), scatter.T)
    return missed.size.interval(1 - CHANCE)[0] > ROUNDING


def _outside(tangent, others):
    """Orthonormal vectors (N, M) that others reach beyond a tangent space."""
    left, sizes, _ = np.linalg.svd(tangent, full_matrices=False)
    taken = left[:, sizes > ROUNDING * sizes[0]]
    left, sizes, _ = np.linalg.svd(others - taken @ (taken.T @ others), full_matrices=False)
    return left[:, sizes > ROUNDING * np.linalg.norm(others)]


def _still(samples, fit):
    """Curves that are not shifted horizontally."""
    return _aligned(samples, fit, lambda each: np.zeros(len(each.curves) - 1))


def _moved(samples, fit, guess):
    """Curves that are, from a guess; undecided where they part."""
    lower, upper = bounds(fit.curves)
    best = near(fit, guess, lower, upper)
    if not inside(best, lower, upper):
        return _undecided(fit, best, _PARTED)
    return _aligned(samples, fit, lambda each: near(each, best, *bounds(each.curves)))


def _undecided(fit, increments, reason):
    return Alignment.undecided(len(fit.curves), rms(fit.residuals(increments)), reason)


def _aligned(samples, fit, sought):
    """sought : increments of the best horizontal shifts of a fit."""
    logs = np.log(samples.speeds) - np.mean(np.log(samples.speeds))
    lever = logs / (logs @ logs)

    def numbers(part):
        each = Fit(part.curves, fit.degree, fit.lifted)
        increments = sought(each)
        missed, mending = each.residuals(increments), _outside(each.tangent(increments), each.later)
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
    sizes = {name: found.pop(name).size for name in ("raised", "misfit", "mended")}
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
