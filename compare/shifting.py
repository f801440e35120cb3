"""Whether mean curves of friction on the same random surfaces fall onto one when shifted, Eq. 23.

Points share their surfaces, so what counts as scatter comes from leaving surfaces out, never points.
"""

from dataclasses import dataclass, replace

import numpy as np

from .alignment import ROUNDING, Alignment, moved, outside, size_at, still, taken, undecided
from .commoncurve import Curve, Fit, bounds, near, within
from .mastercurve import DEGREE, MOST_FREE
from .statistics.jackknife import Replicates, RmsMisfit
from .samples import Samples

# Of ln mu: parallel straight lines that miss no more are straight. Friction is solved, and Eq. 19 is followed by a
# polynomial of the fourth degree, to about that, so less curvature does not tell one shift from the other.
STRAIGHT = 0.01
# Of coefficients that scatter alone asks for, at each rise of the degree.
CHANCE = 0.05
# Powers of the speed from which shifts are sought, and how many are followed to their minimum.
POWERS, FOLLOWED = np.linspace(-3.0, 3.0, 25), 3
_PARALLEL = "parallel straight lines: one shift is the other"


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
    straight: RmsMisfit
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
        """holds, fails or undecided: whether horizontal shifts bring the curves this close, in ln mu, to one.

        Curves that part miss by more at any larger overlap: they can fail, but not hold.
        """
        found = self.horizontal.misfit.verdict(tolerance) if self.separable else "undecided"
        return "undecided" if found == "holds" and self.horizontal.reason else found

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
    unmoved = np.zeros(len(curves) - 1)
    straight = size_at(complete, 1, unmoved, lifted=True)
    along = _best(Fit(curves, DEGREE), unmoved)
    lifted, both = _freed(complete, Fit(curves, DEGREE, lifted=True), along)
    level = Fit(curves, lifted.degree)
    horizontal = moved(complete, level, along)
    raised = moved(complete, lifted, both) if _bent(straight) else undecided(lifted, both, _PARALLEL)
    if horizontal.reason and not raised.reason:
        horizontal = replace(horizontal, mended=taken(complete, level, lifted, along, both))
    return Shifting(
        samples=complete,
        points_left_out=int(samples.known.size - complete.known.sum()),
        surfaces_left_out=samples.surfaces - complete.surfaces,
        curves=_with_errors(complete, curves),
        degree=lifted.degree,
        straight=straight,
        none=still(complete, level),
        horizontal=horizontal,
        vertical=still(complete, lifted),
        both=raised,
    )


def misfit_at(found: Shifting, shifts: np.ndarray) -> RmsMisfit:
    """Misfit of the curves once shifted by b_v (S,), as where a theory predicts ln p(v).

    Unknown where that leaves neighbours less than the least overlap.
    """
    increments = np.diff(shifts)
    lower, upper = bounds(found.curves)
    if not np.all((lower <= increments) & (increments <= upper)):
        return RmsMisfit.unknown()
    return size_at(found.samples, found.degree, increments)


def _with_errors(samples, curves):
    """To first order."""
    load, friction = samples.deviations
    errors = Replicates.first_order(np.zeros(len(load)), (friction - load).T).estimated.error
    parts = np.split(errors, np.cumsum([curve.log_load.size for curve in curves])[:-1])
    return tuple(replace(curve, error=error) for curve, error in zip(curves, parts, strict=True))


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
    new = outside(tangent, freer)
    load, friction = samples.deviations
    scatter = new.T @ (friction - (1 + common.slopes[:, None]) * load)
    missed = Replicates.first_order(new.T @ fit.residuals(increments), scatter.T)
    return missed.rms.interval(1 - CHANCE)[0] > ROUNDING
