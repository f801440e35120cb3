"""Collapse of friction at several speeds onto one curve by shifts along ln F and ln mu, Eq. 23 of the paper.

All shifts are found at once. The misfit that they leave has an interval, and what scatter adds is taken off.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from math import isfinite, nan, sqrt
from operator import attrgetter
from typing import TYPE_CHECKING

import numpy as np
from numpy.polynomial import Chebyshev
from scipy.linalg import orth

from .commoncurve import Common, Fit, exponent_bias, near
from .frictioncurves import Curve, FrictionCurves
from .intervals import Estimated, RmsMisfit

if TYPE_CHECKING:
    from pandas import DataFrame

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
UNKNOWN = RmsMisfit()
PARALLEL = "straight parallel lines fit: horizontal and vertical shifts cannot be distinguished"
PARTED = "once shifted, curves of neighbouring speeds share too small a range of loads"
UNSCATTERED = "scatter is not known, nor whether the curves are bent"


@dataclass(frozen=True)
class Alignment:
    """Curves shifted to ln mu + c_v against ln F + b_v; what is not fitted is exactly zero.

    shifts : b_v and c_v, zero at the middle speed, and last the exponents of exp(b_v) and exp(c_v) as powers
        of the speed, least squares (2, S + 1)
    rms : of ln mu about the common curve, with scatter
    misfit : of ln mu about the common curve, without what scatter adds
    gain_from_vertical_shift : of that misfit, what vertical shifts would take away to first order
    curve : the common curve, ln mu of ln F at the middle speed
    reason : why the shifts are not known; empty where they are. Where the curves part, misfit and gain are those
        at the least overlap of neighbours, and all else but rms is NaN
    """

    shifts: Estimated
    rms: float
    misfit: RmsMisfit = UNKNOWN
    gain_from_vertical_shift: RmsMisfit = UNKNOWN
    curve: Chebyshev | None = field(default=None, repr=False)
    reason: str = ""

    @property
    def horizontal(self) -> Estimated:
        """Shifts along the load, b_v (S,)."""
        return self.shifts.at(np.s_[0, :-1])

    @property
    def vertical(self) -> Estimated:
        """Shifts along friction, c_v (S,)."""
        return self.shifts.at(np.s_[1, :-1])

    @property
    def exponent(self) -> Estimated:
        """Exponent of the shifts along the load."""
        return self.shifts.at((0, -1))

    @property
    def vertical_exponent(self) -> Estimated:
        """Exponent of the shifts along friction."""
        return self.shifts.at((1, -1))


@dataclass(frozen=True)
class Collapse:
    """Curves, and how far from one they are for each choice of shifts.

    data : what was fitted
    log_friction : of every point of every curve, with standard errors to first order
    degree : of the common polynomial of curves shifted along the load
    straight : misfit of parallel straight lines, one a speed
    unshifted, horizontal, vertical, both : which shifts are fitted
    """

    data: FrictionCurves = field(repr=False)
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
        """Reason why horizontal and vertical shifts cannot be distinguished; empty where they can."""
        return _inseparable(self.straight)

    def points(self, shifts: np.ndarray, lifts: np.ndarray | None = None) -> DataFrame:
        """Every point of every curve, with intervals of 95 % of friction, as it is and shifted.

        shifts : ln p(v) by which the force is shifted (S,)
        lifts : of ln mu (S,), by which friction is shifted too; not shifted if None
        """
        from pandas import DataFrame

        counts = [curve.log_load.size for curve in self.curves]
        load = np.exp(np.concatenate([curve.log_load for curve in self.curves]))
        frame = DataFrame({"speed": np.repeat(self.speeds, counts), "normal_force": load})
        frame["shifted_force"] = load * np.exp(np.repeat(shifts, counts))
        for name, by in (("friction_coefficient", np.zeros_like(self.speeds)), ("shifted_friction", lifts)):
            if by is not None:
                moved = replace(self.log_friction, value=self.log_friction.value + np.repeat(by, counts))
                frame = frame.join(np.exp(DataFrame(moved.columns(name))))
        return frame

    def shifts(self, lead: Alignment) -> DataFrame:
        """Shifts of each speed with intervals of 95 %: along the force from `lead`, along friction."""
        from pandas import DataFrame

        along, lift = lead.horizontal.columns("log_shift"), self.both.vertical.columns("log_lift")
        return DataFrame({"speed": self.speeds, **along, **lift})

    def misfit_at(self, shifts: np.ndarray) -> RmsMisfit:
        """Misfit of the curves once shifted by b_v (S,), as where a theory predicts ln p(v).

        Unknown where that leaves neighbours less than the least overlap.
        """
        fit, increments = Fit(self.curves, self.degree), np.diff(shifts)
        lower, upper = fit.bounds
        if not np.all((lower <= increments) & (increments <= upper)):
            return UNKNOWN
        return _aligned(self.data, fit, lambda each: each.at(increments)).misfit


def collapse(data: FrictionCurves) -> Collapse:
    """Find all shifts at once, for each choice of them; points weigh alike.

    Raises ValueError with fewer than two speeds or fewer points than unknowns.
    """
    complete = data.complete()
    curves = complete.curves
    count, unknowns = sum(each.log_load.size for each in curves), 2 * (len(curves) - 1) + DEGREE + 1
    if len(curves) < 2 or count <= unknowns:
        raise ValueError(f"{len(curves)} speeds with too few points for {unknowns} unknowns: add loads or speeds")
    unmoved = np.zeros(len(curves) - 1)

    def still(fit):
        return fit.at(unmoved)

    straight = _aligned(complete, Fit(curves, 1, lifted=True), still).misfit
    along = _best(Fit(curves, DEGREE), unmoved)
    both = _freed(complete, Fit(curves, DEGREE, lifted=True), along.increments)
    level = replace(both.fit, lifted=False)
    # Points that shifts along friction would take are free.
    along = near(level, along.increments) if _spare(both) else _freed(complete, level, along.increments)
    horizontal = _moved(complete, along)
    why = _inseparable(straight)
    raised = _undecided(both, why) if why else _moved(complete, both)
    if not raised.reason:
        # At worst all of the misfit lies along the gradient.
        raised = _widened(raised, exponent_bias(both, sqrt(count) * _known(raised.misfit)))
    if not horizontal.reason:
        # Of a misfit of any direction as much lies along a gradient, 19 times in 20.
        horizontal = _widened(horizontal, exponent_bias(along, 2 * _known(horizontal.misfit)))
    elif not raised.reason:
        horizontal = replace(horizontal, gain_from_vertical_shift=_taken(complete, along, both))
    return Collapse(
        data=complete,
        log_friction=complete.replicates(along.fit.y, complete.deviations()).estimated,
        degree=along.fit.degree,
        straight=straight,
        unshifted=_aligned(complete, along.fit, still),
        horizontal=horizontal,
        vertical=_aligned(complete, both.fit, still),
        both=raised,
    )


def _inseparable(straight):
    """Reason why curves may be straight parallel lines, by the misfit of such lines; empty where they are not."""
    if straight.interval()[0] > STRAIGHT:
        return ""
    return PARALLEL if isfinite(straight.value) else UNSCATTERED


def _best(fit, guess):
    """The fit of least misfit of several starts, that given and powers of the speed."""
    lengths = np.diff(fit.log_speeds)
    starts = [fit.at(fit.within(each)) for each in (guess, *np.multiply.outer(POWERS, lengths))]
    followed = sorted(starts, key=attrgetter("cost"))[:FOLLOWED]
    return min((near(fit, each.increments) for each in followed), key=attrgetter("cost"))


def _freed(data, fit, guess):
    """The fit with the least degree from which a higher one takes no more than scatter."""
    best = _best(fit, guess)
    while best.fit.degree < HIGHEST_DEGREE and _pays(data, best):
        best = near(replace(best.fit, degree=best.fit.degree + 2), best.increments)
    return best


def _pays(data, best):
    """Whether two more coefficients take from the misfit what scatter does not explain.

    The two components of the misfit are asked whether they are scatter.
    """
    if not _spare(best):
        return False
    freer = replace(best.fit, degree=best.fit.degree + 2, lifted=False).at(best.increments)
    new = _outside(best.tangent, freer.basis[:, -2:])
    deviations = data.deviations(best.slopes) @ new
    return data.replicates(new.T @ best.residuals, deviations).rms.interval(1 - CHANCE)[0] > ROUNDING


def _spare(best):
    """Whether a third of the points stays free with two more coefficients."""
    points = best.fit.y.size
    return points - best.fit.unknowns - 2 >= points / 3


def _moved(data, best):
    """Curves that are shifted at best; where they part, only the misfit that the least overlap leaves is known."""
    found = _aligned(data, best.fit, lambda each: near(each, best.increments))
    return found if best.inside else replace(_undecided(best, PARTED), misfit=found.misfit)


def _taken(data, along, both):
    """Misfit that vertical shifts remove in addition to horizontal ones, at the least overlap."""

    def taken(part):
        one, other = (
            near(replace(each.fit, curves=part.curves), each.increments).residuals for each in (along, both)
        )
        return {"": one - other}

    return data.resampled(taken)[""].rms


def _known(misfit):
    """Size of a misfit that scatter does not explain; 0 where scatter explains it."""
    return misfit.value if misfit.interval()[0] > 0 else 0.0


def _widened(aligned, bias):
    """An alignment whose shifts and exponents may be off by so much."""
    return replace(aligned, shifts=replace(aligned.shifts, bias=bias))


def _undecided(best, reason):
    """Alignment whose shifts are not known, for a reason."""
    return Alignment(Estimated(np.full_like(best.shifts, nan), nan, 0), _rms(best.residuals), reason=reason)


def _aligned(data: FrictionCurves, fit: Fit, sought: Callable[[Fit], Common]) -> Alignment:
    """Alignment at the best horizontal shifts of a fit; sought : function that finds them."""

    def numbers(part):
        found = sought(replace(fit, curves=part.curves))
        missed, mending = found.residuals, _outside(found.tangent, found.fit.later)
        return {
            "shifts": found.shifts,
            "misfit": missed,
            "gain_from_vertical_shift": mending @ (mending.T @ missed),
        }

    found, best = data.resampled(numbers), sought(fit)
    # The common polynomial as the curve of the middle speed has it.
    along, lift = -best.shifts[:, 0]
    curve = Chebyshev(best.coefficients, domain=np.array([best.x.min(), best.x.max()]) - along) - lift
    misfit, gain_from_vertical_shift = (found[name].rms for name in ("misfit", "gain_from_vertical_shift"))
    return Alignment(found["shifts"].estimated, _rms(best.residuals), misfit, gain_from_vertical_shift, curve)


def _outside(tangent, others):
    """Orthonormal vectors (N, M) that others reach beyond a tangent space."""
    taken = orth(tangent, ROUNDING)
    left, sizes, _ = np.linalg.svd(others - taken @ (taken.T @ others), full_matrices=False)
    return left[:, sizes > ROUNDING * np.linalg.norm(others)]


def _rms(values):
    return float(np.sqrt(np.mean(np.square(values))))
