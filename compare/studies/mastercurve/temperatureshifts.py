"""Shifts of friction along the speed from temperature to temperature: those that are stated, or that data ask for.

Friction of equal loads is one function of ln v + ln a_T at all temperatures (time-temperature superposition). That
function is a polynomial in the logarithms of speed and load, common to all temperatures, and projected out.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise
from math import log

import numpy as np
from numpy.polynomial import chebyshev

from ...statistics.collapse import STRAIGHT
from ...statistics.commoncurve import (
    LEAST_OVERLAP,
    Common,
    Projected,
    inside,
    near,
    scaled_to_one,
    unsettled,
    within,
)
from ...statistics.intervals import Estimated, RmsMisfit
from ...statistics.jackknife import Replicates

# Degrees of the polynomial, of which the least information criterion has one; a third of the points stays free.
DEGREES = range(1, 11)
POWERS = (
    "friction is one power of speed and load at all temperatures: a shift along the speed cannot be told from one "
    "along friction"
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
    """Shifts ln a_T along ln v, by which friction at each temperature is that of one reference.

    isotherms : what was shifted, (K,) by their temperatures
    shifts : ln a_T of each (K,), exact where they were stated
    levers : change of ln a_T with ln mu of each point (K, N); none where they were stated
    misfit : of ln mu about the one function, without what scatter adds
    unshifted : the same with no shift
    straight : of parallel planes, one a temperature, to ln mu of ln v and ln F
    degree : of the polynomial
    found : whether the shifts are those that data ask for
    """

    isotherms: tuple[Isotherm, ...] = field(repr=False)
    shifts: Estimated
    levers: np.ndarray = field(repr=False)
    misfit: RmsMisfit
    unshifted: RmsMisfit
    straight: RmsMisfit
    degree: int
    found: bool

    @property
    def temperatures(self) -> np.ndarray:
        """(K,) [K], ascending."""
        return np.array([each.temperature for each in self.isotherms])

    @property
    def covariance(self) -> np.ndarray:
        """Of ln a_T, where the shifts are found (K, K)."""
        errors = np.concatenate([each.error for each in self.isotherms])
        return self.levers * errors**2 @ self.levers.T

    @property
    def inseparable(self) -> str:
        """Reason why found shifts cannot be told from shifts along friction; empty where they can."""
        return POWERS if self.found and self.straight.interval()[0] <= STRAIGHT else ""

    @property
    def reference(self) -> float:
        """Temperature that is not shifted, where the shifts are found [K]."""
        return float(self.temperatures[len(self.isotherms) // 2])


class Surface(Projected):
    """Misfit of isotherms to a polynomial in ln v and ln F of this total degree, given their shifts along ln v.

    loads : number of loads that are told apart, which bounds the power of ln F
    """

    def __init__(self, isotherms: Sequence[Isotherm], degree: int, loads: int):
        super().__init__([each.log_speed for each in isotherms], [each.log_friction for each in isotherms])
        self.isotherms, self.degree, self.loads = isotherms, degree, loads
        self.log_load, self.errors = (
            np.concatenate([getattr(each, name) for each in isotherms]) for name in ("log_load", "error")
        )
        across = min(degree, loads - 1)
        self._across = chebyshev.chebvander(scaled_to_one(self.log_load)[0], across)
        self._powers = [(i, k) for k in range(across + 1) for i in range(degree - k + 1)]

    def _common(self, x):
        scaled, half = scaled_to_one(x)
        along = chebyshev.chebvander(scaled, self.degree)
        # Columns are the derivatives of the polynomials.
        slopes = along[:, :-1] @ chebyshev.chebder(np.eye(self.degree + 1)) / half
        i, k = np.transpose(self._powers)
        basis = along[:, i] * self._across[:, k]
        orthonormal, coefficients = self.projected(basis)
        return Common(
            basis, orthonormal, slopes[:, i] * self._across[:, k] @ coefficients, coefficients, (x.min(), x.max())
        )


def stated(isotherms: Sequence[Isotherm], shifts: np.ndarray, loads: int, dof: float) -> TemperatureShifts:
    """What shifts ln a_T (K,) that are stated make of isotherms."""
    increments = np.diff(shifts)
    surface = _freest(isotherms, loads, lambda each: increments)
    levers = np.zeros((len(shifts), surface.y.size))
    return _shifted(surface, increments, Estimated(np.asarray(shifts, float)), levers, dof, found=False)


def found(isotherms: Sequence[Isotherm], loads: int, dof: float) -> TemperatureShifts:
    """Shifts that bring isotherms closest to one function; that of the middle temperature is nil.

    loads : number of loads that are told apart
    dof : degrees of freedom of the one relative scatter behind the errors

    Raises ValueError where neighbours share too little of their loads or speeds to be brought together.
    """
    _check_shared(isotherms)
    start = np.concatenate([_of_pair(pair, loads) for pair in pairwise(isotherms)])
    surface = _freest(isotherms, loads, lambda each: near(each, start))
    increments = near(surface, start)
    if not inside(increments, *surface.bounds):
        lower, upper = surface.bounds
        margin = np.minimum(increments - lower, upper - increments) / (upper - lower)
        first = int(np.argmin(margin))
        _refuse(isotherms[first], isotherms[first + 1], "speeds once shifted")
    # Against the middle temperature.
    against = np.tri(len(isotherms), len(increments), -1)
    against = against - against[len(isotherms) // 2]
    levers = -against @ np.linalg.pinv(surface.jacobian(increments))
    scattered = Replicates(against @ increments, (levers * surface.errors).T, dof).estimated
    shifts = replace(scattered, bias=_unfollowed(surface, against, increments))
    return _shifted(surface, increments, shifts, levers, dof, found=True)


def _unfollowed(surface, against, increments):
    """What shifts against one temperature (K,) may be off by, as no polynomial is the law."""

    def changed(degree):
        other = Surface(surface.isotherms, degree, surface.loads)
        return np.abs(against @ (near(other, increments) - increments)), other.common(increments).basis.shape[1]

    after, unknowns = changed(surface.degree + 2)
    before = changed(surface.degree - 2)[0] if surface.degree > 2 else after
    return unsettled(before, after if unknowns + len(increments) < surface.y.size else before)


def _shifted(surface, increments, shifts, levers, dof, found):
    levels = surface.owner[:, None] == np.arange(len(surface.isotherms))
    unshifted, shifted = (surface.common(each).basis for each in (np.zeros_like(increments), increments))
    return TemperatureShifts(
        tuple(surface.isotherms),
        shifts,
        levers,
        misfit=_misfit(surface, dof, surface.tangent(increments) if found else shifted),
        unshifted=_misfit(surface, dof, unshifted),
        straight=_misfit(surface, dof, np.column_stack([levels, surface.x, surface.log_load])),
        degree=surface.degree,
        found=found,
    )


def _misfit(surface, dof, fitted):
    """Misfit to the best sum of functions (N, M), which take scatter away."""
    basis, _ = surface.projected(fitted)
    deviations = np.diag(surface.errors) - surface.errors[:, None] * basis @ basis.T
    return Replicates(surface.y - basis @ (basis.T @ surface.y), deviations, dof).rms


def _freest(isotherms, loads, sought):
    """The surface of the degree with the least information criterion, corrected for few points."""
    points = sum(each.log_speed.size for each in isotherms)
    best, least = None, np.inf
    for degree in DEGREES:
        surface = Surface(isotherms, degree, loads)
        increments = sought(surface)
        unknowns = surface.common(increments).orthonormal.shape[1] + len(increments)
        if best is not None and points - unknowns < max(points / 3, 2):
            break
        square = max(float(np.sum(np.square(surface.residuals(increments)))), 1e-24 * points)
        criterion = points * log(square / points) + 2 * unknowns * points / max(points - unknowns - 1, 1)
        if criterion < least:
            best, least = surface, criterion
    return best


def _of_pair(pair, loads):
    """The increment that brings two neighbours closest."""
    surface = Surface(pair, 2, loads)
    lower, upper = surface.bounds
    tried = within(np.where(STARTS < 0, -STARTS * lower, STARTS * upper)[:, None], lower, upper)
    costs = [float(np.sum(np.square(surface.residuals(each)))) for each in tried]
    return near(surface, tried[int(np.argmin(costs))])


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
