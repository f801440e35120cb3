"""Collapse of friction at several speeds onto one curve by shifts along ln F and ln mu, Eq. 23 of the paper.

All shifts are found at once, and the misfit that they leave is told without what scatter adds, with its interval.
"""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from math import isfinite, nan, sqrt

import numpy as np
from numpy.polynomial import Chebyshev
from pandas import DataFrame

from .commoncurve import Fit, exponent_bias, inside, near, within
from .frictioncurves import Curve, FrictionCurves
from .intervals import ENDS as ENDS
from .intervals import Estimated, RmsMisfit

# Stiff enough not to follow the scatter, and close enough to Eq. 19 over three decades of xi for 1 % in mu. Where
# the scatter is less than that, the curve gets more freedom as long as that pays.
DEGREE, HIGHEST_DEGREE = 4, 10
# Misfit in ln mu up to which parallel lines count as straight. Friction is solved, and Eq. 19 is followed by a
# polynomial of the fourth degree, to about that, so less curvature does not tell one shift from the other.
STRAIGHT = 0.01
# Share of coefficients that scatter alone asks for, at each rise of the degree.
CHANCE = 0.05
# Powers of the speed from which shifts are sought, and how many are followed to their minimum.
POWERS, FOLLOWED = np.linspace(-3.0, 3.0, 25), 3
# Misfit of ln mu that rounding leaves.
ROUNDING = 1e-9
PARALLEL = "straight parallel lines fit: a horizontal shift cannot be told from a vertical one"
PARTED = "once shifted, curves of neighbouring speeds share too small a range of loads"
UNSCATTERED = "scatter is not known, nor whether the curves are bent"


@dataclass(frozen=True)
class Alignment:
    """Curves shifted to ln mu + c_v against ln F + b_v; what is not fitted is exactly zero.

    horizontal, vertical : b_v and c_v (S,), zero at the middle speed
    exponent, vertical_exponent : of exp(b_v) and exp(c_v) as powers of the speed, least squares
    rms : of ln mu about the common curve, with scatter
    misfit : of ln mu about the common curve, without what scatter adds
    mended : of that misfit, what vertical shifts would take away to first order
    curve : ln mu of ln F, that of the middle speed
    reason : why the shifts are not known; empty where they are. Where the curves part, misfit and mended are those
        at the least overlap of neighbours, and all else but rms is NaN
    """

    horizontal: Estimated
    vertical: Estimated
    exponent: Estimated
    vertical_exponent: Estimated
    rms: float
    misfit: RmsMisfit
    mended: RmsMisfit
    curve: Chebyshev | None = field(repr=False)
    reason: str = ""


@dataclass(frozen=True)
class Collapse:
    """Curves, and how far from one they are for each choice of shifts.

    data : what was fitted; points_left_out, surfaces_left_out : how many were not
    log_friction : of every point of every curve, with standard errors to first order
    degree : of the common polynomial of curves shifted along the load
    straight : misfit of parallel straight lines, one a speed
    unshifted, horizontal, vertical, both : which shifts are fitted
    """

    data: FrictionCurves = field(repr=False)
    points_left_out: int
    surfaces_left_out: int
    log_friction: Estimated = field(repr=False)
    degree: int
    straight: RmsMisfit
    unshifted: Alignment
    horizontal: Alignment
    vertical: Alignment
    both: Alignment

    @property
    def speeds(self) -> np.ndarray:
        """(S,) [m/s], ascending."""
        return self.data.speeds

    @property
    def scatter(self) -> float:
        """Rms standard error of ln mu; NaN if unknown."""
        return _rms(self.log_friction.error)

    @property
    def curves(self) -> tuple[Curve, ...]:
        """The curves that were fitted."""
        return self.data.curves

    @property
    def inseparable(self) -> str:
        """Reason why a horizontal shift cannot be told from a vertical one; empty where it can."""
        return _inseparable(self.straight)

    def points(self, shifts: np.ndarray | None = None, lifts: np.ndarray | None = None) -> DataFrame:
        """Every point of every curve, with intervals of 95 % of friction, as it is and shifted.

        shifts : ln p(v) by which the force is shifted (S,); the best horizontal shifts if None
        lifts : of ln mu (S,), by which friction is shifted too; not shifted if None
        """
        counts = [curve.log_load.size for curve in self.curves]
        along = np.repeat(self.horizontal.horizontal.value if shifts is None else shifts, counts)
        load = np.exp(np.concatenate([curve.log_load for curve in self.curves]))
        frame = DataFrame({"speed": np.repeat(self.speeds, counts), "normal_force": load})
        frame["shifted_force"] = load * np.exp(along)
        for name, by in (("friction_coefficient", 0.0 * self.speeds), ("shifted_friction", lifts)):
            if by is not None:
                moved = replace(self.log_friction, value=self.log_friction.value + np.repeat(by, counts))
                frame = frame.join(np.exp(DataFrame(moved.columns(name))))
        return frame

    def shifts(self, lead: Alignment) -> DataFrame:
        """Shifts of each speed with intervals of 95 %: along the force, of one alignment; along friction."""
        along, lift = lead.horizontal.columns("log_shift"), self.both.vertical.columns("log_lift")
        return DataFrame({"speed": self.speeds, **along, **lift})

    def misfit_at(self, shifts: np.ndarray) -> RmsMisfit:
        """Misfit of the curves once shifted by b_v (S,), as where a theory predicts ln p(v).

        Unknown where that leaves neighbours less than the least overlap.
        """
        fit, increments = Fit(self.curves, self.degree), np.diff(shifts)
        lower, upper = fit.bounds
        if not np.all((lower <= increments) & (increments <= upper)):
            return RmsMisfit.unknown()
        return _misfit(self.data, fit, lambda each: increments)


def collapse(data: FrictionCurves) -> Collapse:
    """Find all shifts at once, for each choice of them; points weigh alike.

    Raises ValueError with fewer than two speeds or fewer points than unknowns.
    """
    complete = data.complete()
    curves = complete.curves
    count = _counted(curves, 2)
    unmoved = np.zeros(len(curves) - 1)

    def still(fit):
        return unmoved

    straight = _misfit(complete, Fit(curves, 1, lifted=True), still)
    along = _best(Fit(curves, DEGREE), unmoved)
    lifted, both = _freed(complete, Fit(curves, DEGREE, lifted=True), along)
    level = Fit(curves, lifted.degree)
    if not _spare(lifted.tangent(both)):  # points that shifts along friction would take are free
        level, along = _freed(complete, level, along)
    horizontal = _moved(complete, level, along)
    why = _inseparable(straight)
    raised = _undecided(lifted, both, why) if why else _moved(complete, lifted, both)
    if not raised.reason:
        # At worst all of the misfit lies along the gradient.
        raised = _widened(raised, exponent_bias(lifted, both, sqrt(count) * _known(raised.misfit)))
    if not horizontal.reason:
        # Of a misfit of any direction as much lies along a gradient, 19 times in 20.
        horizontal = _widened(horizontal, exponent_bias(level, along, 2 * _known(horizontal.misfit)))
    elif not raised.reason:
        horizontal = replace(horizontal, mended=_taken(complete, level, lifted, along, both))
    return Collapse(
        data=complete,
        points_left_out=data.points - count,
        surfaces_left_out=data.surfaces - complete.surfaces,
        log_friction=complete.replicates(level.y, complete.deviations()).estimated,
        degree=level.degree,
        straight=straight,
        unshifted=_aligned(complete, level, still),
        horizontal=horizontal,
        vertical=_aligned(complete, lifted, still),
        both=raised,
    )


def along_load(data: FrictionCurves) -> Alignment:
    """The best horizontal shifts alone, of curves such as those of a law that ask no other question.

    Raises ValueError with fewer than two speeds or fewer points than unknowns.
    """
    complete = data.complete()
    _counted(complete.curves, 1)
    fit = Fit(complete.curves, DEGREE)
    return _moved(complete, fit, _best(fit, np.zeros(len(fit.curves) - 1)))


def _counted(curves, kinds):
    """Number of points of curves. Raises ValueError where they are too few for shifts of so many kinds."""
    count, unknowns = sum(curve.log_load.size for curve in curves), kinds * (len(curves) - 1) + DEGREE + 1
    if len(curves) < 2 or count <= unknowns:
        raise ValueError(f"{len(curves)} speeds with too few points for {unknowns} unknowns: add loads or speeds")
    return count


def _inseparable(straight):
    """Reason why curves may be straight parallel lines, by the misfit of such lines; empty where they are not."""
    if straight.interval()[0] > STRAIGHT:
        return ""
    return PARALLEL if isfinite(straight.value) else UNSCATTERED


def _best(fit, *guesses):
    """Increments of least misfit of several starts, those given and powers of the speed."""
    lower, upper = fit.bounds
    lengths = np.diff(np.log([curve.speed for curve in fit.curves]))

    def cost(increments):
        return np.sum(np.square(fit.residuals(increments)))

    starts = [within(guess, lower, upper) for guess in (*guesses, *np.multiply.outer(POWERS, lengths))]
    followed = sorted(starts, key=cost)[:FOLLOWED]
    return min((near(fit, start) for start in followed), key=cost)


def _freed(data, fit, guess):
    """The fit with the least degree from which a higher one takes no more than scatter, and its increments."""
    best = _best(fit, guess)
    while fit.degree < HIGHEST_DEGREE and _pays(data, fit, best):
        fit = Fit(fit.curves, fit.degree + 2, fit.lifted)
        best = near(fit, best)
    return fit, best


def _pays(data, fit, increments):
    """Whether two more coefficients take from the misfit what scatter does not explain.

    The two components of the misfit are asked whether they are scatter.
    """
    tangent = fit.tangent(increments)
    if not _spare(tangent):
        return False
    new = _outside(tangent, Fit(fit.curves, fit.degree + 2).common(increments).basis[:, -2:])
    deviations = data.deviations(fit.common(increments).slopes) @ new
    return data.replicates(new.T @ fit.residuals(increments), deviations).rms.interval(1 - CHANCE)[0] > ROUNDING


def _spare(tangent):
    """Whether a third of the points stays free with two more coefficients."""
    points, unknowns = tangent.shape
    return points - unknowns - 2 >= points / 3


def _moved(data, fit, guess):
    """Curves that are, from a guess; where they part, only the misfit that the least overlap leaves is known."""
    best = near(fit, guess)

    def sought(each):
        return near(each, best)

    if inside(best, *fit.bounds):
        return _aligned(data, fit, sought)
    return replace(_undecided(fit, best, PARTED), misfit=_misfit(data, fit, sought))


def _taken(data, level, lifted, along, both):
    """Misfit that vertical shifts take from that of horizontal ones at the least overlap.

    along, both : guesses of the increments of either fit
    """

    def missed(fit, guess):
        return fit.residuals(near(fit, guess))

    def taken(part):
        return {"": missed(level.of(part.curves), along) - missed(lifted.of(part.curves), both)}

    return data.resampled(taken)[""].rms


def _known(misfit):
    """A misfit that scatter does not explain; nil of any other."""
    return misfit.value if misfit.interval()[0] > 0 else 0.0


def _widened(aligned, bias):
    """An alignment whose shifts and exponents may be off by so much along load and friction, exponents last."""
    found = {}
    for name, power, by in zip(("horizontal", "vertical"), ("exponent", "vertical_exponent"), bias, strict=True):
        found[name] = replace(getattr(aligned, name), bias=by[:-1])
        found[power] = replace(getattr(aligned, power), bias=by[-1])
    return replace(aligned, **found)


def _undecided(fit, increments, reason):
    """Alignment of which no shift is known."""
    unknown, number = RmsMisfit.unknown(), Estimated(nan, nan, 0)
    shifts = replace(number, value=np.full(len(fit.curves), nan))
    missed = _rms(fit.residuals(increments))
    return Alignment(shifts, shifts, number, number, missed, unknown, unknown, None, reason)


def _aligned(data: FrictionCurves, fit: Fit, sought: Callable[[Fit], np.ndarray]) -> Alignment:
    """Alignment at the best horizontal shifts of a fit; sought : function that finds their increments."""

    def numbers(part):
        each = fit.of(part.curves)
        increments = sought(each)
        missed, mending = each.residuals(increments), _outside(each.tangent(increments), each.later)
        along, across = each.shifts(increments)
        return {
            "horizontal": along[:-1],
            "vertical": across[:-1],
            "exponent": along[-1],
            "vertical_exponent": across[-1],
            "misfit": missed,
            "mended": mending @ (mending.T @ missed),
        }

    found, increments = data.resampled(numbers), sought(fit)
    misfits = {name: found.pop(name).rms for name in ("misfit", "mended")}
    return Alignment(
        **{name: each.estimated for name, each in found.items()},
        **misfits,
        rms=_rms(fit.residuals(increments)),
        curve=_curve(fit, increments),
    )


def _curve(fit, increments):
    """The common polynomial as the curve of the middle speed has it."""
    common = fit.common(increments)
    along, lift = -fit.shifts(increments)[:, 0]
    polynomial = Chebyshev(common.coefficients[: fit.degree + 1], domain=np.array(common.domain) - along)
    return polynomial - lift


def _misfit(data, fit, sought):
    """Misfit of the curves at increments of the shifts that are sought for each part of the data."""

    def missed(part):
        each = fit.of(part.curves)
        return {"": each.residuals(sought(each))}

    return data.resampled(missed)[""].rms


def _outside(tangent, others):
    """Orthonormal vectors (N, M) that others reach beyond a tangent space."""
    left, sizes, _ = np.linalg.svd(tangent, full_matrices=False)
    taken = left[:, sizes > ROUNDING * sizes[0]]
    left, sizes, _ = np.linalg.svd(others - taken @ (taken.T @ others), full_matrices=False)
    return left[:, sizes > ROUNDING * np.linalg.norm(others)]


def _rms(values):
    return float(np.sqrt(np.mean(np.square(values))))
