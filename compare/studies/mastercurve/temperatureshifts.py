"""Shifts of friction along the speed from temperature to temperature: those that are stated, or that data ask for.

Friction of equal loads is one function of ln v + ln a_T at all temperatures (time-temperature superposition). That
function is a polynomial in the logarithms of speed and load, common to all temperatures, and projected out.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise
from math import log

import numpy as np
from scipy.linalg import orth

from ...statistics.collapse import STRAIGHT
from ...statistics.commoncurve import LEAST_OVERLAP, LEAST_SINGULAR, Common, Fit, near
from ...statistics.intervals import Estimated, RmsMisfit
from ...statistics.jackknife import Replicates

# Candidate degrees of the polynomial; the least information criterion chooses, and a third of the points stays
# free.
DEGREES = range(1, 11)
POWERS = (
    "friction is one power of speed and load at all temperatures: a shift along the speed cannot be "
    "distinguished from a shift along friction"
)
STARTS = np.linspace(-1.0, 1.0, 41)  # shares of the largest shift to either side from which shifts are sought


@dataclass(frozen=True)
class Isotherm:
    """Points at one temperature [K]: ln v, ln F, ln mu and its standard error, NaN if unknown, each (N,)."""

    temperature: float
    log_speed: np.ndarray
    log_load: np.ndarray
    log_friction: np.ndarray
    error: np.ndarray


@dataclass(frozen=True)
class TemperatureShifts:
    """Shifts ln a_T along ln v that bring friction at each temperature onto friction at a reference temperature.

    isotherms : what was shifted, (K,) by their temperatures
    shifts : ln a_T of each (K,), exact where they were stated
    levers : change of ln a_T with ln mu of each point (K, N); none where they were stated
    misfit : of ln mu about the one function, without what scatter adds
    unshifted : the same with no shift
    straight : of parallel planes, one a temperature, to ln mu of ln v and ln F
    found : whether the shifts are those that data ask for
    """

    isotherms: tuple[Isotherm, ...] = field(repr=False)
    shifts: Estimated
    levers: np.ndarray = field(repr=False)
    misfit: RmsMisfit
    unshifted: RmsMisfit
    straight: RmsMisfit
    found: bool

    @property
    def temperatures(self) -> np.ndarray:
        """(K,) [K], ascending."""
        return np.array([each.temperature for each in self.isotherms])

    @property
    def inseparable(self) -> str:
        """Reason why found shifts cannot be distinguished from shifts along friction; empty where they can."""
        return POWERS if self.found and self.straight.interval()[0] <= STRAIGHT else ""


def stated(isotherms: Sequence[Isotherm], shifts: np.ndarray, loads: int, dof: float) -> TemperatureShifts:
    """What shifts ln a_T (K,) that are stated make of isotherms."""
    increments = np.diff(shifts)
    best = _freest(isotherms, loads, lambda fit: fit.at(increments))
    levers = np.zeros((len(shifts), best.x.size))
    return _shifted(best, Estimated(np.asarray(shifts, float)), levers, dof, found=False)


def found(isotherms: Sequence[Isotherm], loads: int, dof: float) -> TemperatureShifts:
    """Shifts that bring isotherms closest to one function; the shift of the middle temperature is zero.

    loads : number of distinct loads
    dof : degrees of freedom of the one relative scatter behind the errors

    Raises ValueError where neighbours share too little of their loads or speeds to be brought together.
    """
    _check_shared(isotherms)
    start = np.concatenate([_of_pair(pair, loads) for pair in pairwise(isotherms)])
    best = _freest(isotherms, loads, lambda fit: near(fit, start))
    fit, increments = best.fit, best.increments
    if not best.inside:
        lower, upper = fit.bounds
        margin = np.minimum(increments - lower, upper - increments) / (upper - lower)
        first = int(np.argmin(margin))
        _refuse(isotherms[first], isotherms[first + 1], "speeds once shifted")
    levers = -fit.against @ np.linalg.pinv(best.jacobian)
    scattered = Replicates(fit.against @ increments, (levers * fit.column("error")).T, dof).estimated
    bias = fit.unsettled(increments, lambda each: fit.against @ each.increments)
    return _shifted(best, replace(scattered, bias=bias), levers, dof, found=True)


def _shifted(best, shifts, levers, dof, found):
    fit, errors = best.fit, best.fit.column("error")
    levels = fit.owner[:, None] == np.arange(len(fit.curves))
    planes = np.column_stack([levels, fit.column("log_speed"), fit.column("log_load")])

    def misfit(functions):
        """Misfit to the best sum of functions (N, M), which take scatter away."""
        basis = orth(functions, LEAST_SINGULAR)
        deviations = np.diag(errors) - errors[:, None] * basis @ basis.T
        return Replicates(fit.y - basis @ (basis.T @ fit.y), deviations, dof).rms

    return TemperatureShifts(
        tuple(fit.curves),
        shifts,
        levers,
        misfit=misfit(best.tangent if found else best.basis),
        unshifted=misfit(fit.at(0 * best.increments).basis),
        straight=misfit(planes),
        found=found,
    )


def _freest(isotherms: Sequence[Isotherm], loads: int, sought: Callable[[Fit], Common]) -> Common:
    """The fit of the degree with the least information criterion, corrected for few points."""
    best, least = None, np.inf
    for degree in DEGREES:
        tried = sought(Fit(isotherms, degree, along="log_speed", loads=loads))
        points = tried.x.size
        unknowns = tried.orthonormal.shape[1] + tried.increments.size
        if best is not None and points - unknowns < max(points / 3, 2):
            break
        square = max(tried.cost, 1e-24 * points)
        criterion = points * log(square / points) + 2 * unknowns * points / max(points - unknowns - 1, 1)
        if criterion < least:
            best, least = tried, criterion
    assert best is not None  # the first degree is always tried
    return best


def _of_pair(pair, loads):
    """The increment that brings two neighbours closest."""
    fit = Fit(pair, 2, along="log_speed", loads=loads)
    lower, upper = fit.bounds
    tried = fit.within(np.where(STARTS < 0, -STARTS * lower, STARTS * upper)[:, None])
    return near(fit, min(tried, key=lambda each: fit.at(each).cost)).increments


def _check_shared(isotherms):
    """Raise ValueError for neighbours without common loads, and for single speeds."""
    for each in isotherms:
        if not np.ptp(each.log_speed) > 0:
            raise ValueError(
                f"{each.temperature:g} K has a single speed: shifts along the speed are found from several at "
                "each temperature, or stated as c1, c2 and reference"
            )
    for cold, warm in pairwise(isotherms):
        a, b = cold.log_load, warm.log_load
        shared = min(a.max(), b.max()) - max(a.min(), b.min())
        if shared < LEAST_OVERLAP * min(np.ptp(a), np.ptp(b)):
            _refuse(cold, warm, "loads")


def _refuse(cold, warm, what):
    raise ValueError(
        f"{cold.temperature:g} K and {warm.temperature:g} K share less than {LEAST_OVERLAP:.0%} of their {what}: "
        "their shift is not found from them; measure more speeds, loads or temperatures between, or state c1, c2 "
        "and reference of the elastomer"
    )
