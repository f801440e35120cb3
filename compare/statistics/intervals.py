"""Intervals of means over draws, and of what follows from them: Student's, corrected for skewness; of sizes too.

A mean of skewed draws lies off its sample to one side more often than to the other. Hall's transformation (J. R.
Stat. Soc. B 54, 221, 1992) moves the ends by what the skewness of the sample says, and leaves the interval of
symmetric draws nearly as Student has it.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from math import hypot, inf, nan, sqrt
from typing import Any, ClassVar, Generic, Self, TypeVar

import numpy as np
from scipy import special
from scipy.optimize import brentq

# Degrees of freedom of what counts as known exactly.
KNOWN = 1e9
# Few draws show too little of their skewness, by about this over the root of their number.
UNSEEN = 1.5
# Skewness times Student's quantile counts up to this: beyond, the interval widens and holds no more for it. Its
# longer side is then 1.6 times the other.
MOST_SKEWED = 0.65
NO_SKEWNESS = 1e-12
# Endings of the names of columns: a number, and the ends of its interval.
ENDS = ("", "_low", "_high")
NUMBERS = "value", "error", "dof", "skewness", "bias", "grid"

Value = TypeVar("Value", float, np.ndarray)


def student(level: float, dof: float | np.ndarray) -> float:
    """Number of standard errors to either end of an interval that covers as often as stated."""
    # scipy.stats has the same function, and takes a second to import.
    return special.stdtrit(np.where(np.asarray(dof) > 0, dof, nan), (1 + level) / 2)


def sides(level: float, dof: float | np.ndarray, skewed: float | np.ndarray) -> tuple:
    """Number of standard errors to the lower and to the upper end of such an interval of a skewed number."""
    quantile = student(level, dof)
    most = MOST_SKEWED / np.maximum(quantile, 1.0)
    seen = np.clip(skewed * (1 + UNSEEN / np.sqrt(np.asarray(dof) + 1)), -most, most)
    # Without skewness the limit.
    seen = np.where(np.abs(seen) > NO_SKEWNESS, seen, NO_SKEWNESS)
    lower, upper = (3 * np.expm1(np.log1p(seen * (by - seen / 6)) / 3) / seen for by in (quantile, -quantile))
    return lower, -upper


def skewness(deviations: np.ndarray) -> np.ndarray:
    """Skewness of a sum of independent deviations, along the first axis; 0 where all are zero."""
    squares = np.sum(np.square(deviations), axis=0)
    return np.sum(deviations**3, axis=0) / np.where(squares > 0, squares, 1.0) ** 1.5


@dataclass(frozen=True)
class Estimated(Generic[Value]):
    """A number or an array of them, with standard errors over surfaces; NaN where they cannot be had.

    Without an error it is exact, like a number that no random surface changes.

    dof : degrees of freedom of the error
    skewness : third moment of what the number is off by, over the cube of its error
    bias : largest error to either side in addition to the scatter
    parts : share in the square of the error by solver and stratum of the surfaces; empty where these are not known
    grid : error of discretisation, absolute; NaN if unknown
    size : whether the number is never negative. Its interval is then found for its logarithm; a sum of differences
        may be negative by chance, and its interval is found for the sum
    drawn : number of surfaces or profiles by solver, where these are known
    """

    value: Value
    error: Value | float = 0.0
    dof: float | np.ndarray = inf
    skewness: float | np.ndarray = 0.0
    bias: float | np.ndarray = 0.0
    parts: Mapping[Any, Any] = field(default_factory=dict)
    grid: Value | float = 0.0
    size: bool = False
    drawn: Mapping[str, int] = field(default_factory=dict)

    def at(self, place: Any) -> "Estimated":
        """Some of the numbers of an array."""

        def own(each):
            return np.broadcast_to(each, np.shape(self.value))[place]

        numbers = {name: own(getattr(self, name)) for name in NUMBERS}
        return replace(self, **numbers, parts={source: own(each) for source, each in self.parts.items()})

    def columns(self, name: str) -> dict[str, Any]:
        """Number and the ends of its interval, by the names of columns."""
        return dict(zip((f"{name}{end}" for end in ENDS), self.ends, strict=True))

    def interval(self, level: float = 0.95) -> tuple:
        """Ends between which scatter and bias leave the number, as often as stated."""
        below, above = sides(level, self.dof, self.skewness)
        low, high = self.value - self.error * below - self.bias, self.value + self.error * above + self.bias
        if not self.size:
            return low, high
        with np.errstate(invalid="ignore", divide="ignore", over="ignore"):  # of a sum that is not positive
            share = self.error / np.asarray(self.value)
            ends = self.value * np.exp([-share * below, share * above])
        return tuple(np.maximum(np.where(np.asarray(self.value) > 0, ends, (low, high)), 0.0))

    @property
    def ends(self) -> tuple:
        """Number and the ends of its interval of 95 %, which counts scatter and grid."""
        low, high = self.interval()
        found = self.value, low - self.grid, high + self.grid
        return tuple(np.maximum(found, 0.0)) if self.size else found

    def less(self, other: Self) -> "Estimated":
        """Difference from a number of independent draws, with the degrees of freedom of Welch."""
        parts = np.array([self.error, other.error])
        error = np.sqrt(np.sum(np.square(parts), axis=0))
        with np.errstate(invalid="ignore", divide="ignore"):
            dof = error**4 / np.sum(parts**4 / [self.dof, other.dof], axis=0)
            skewed = (parts[0] ** 3 * self.skewness - parts[1] ** 3 * other.skewness) / error**3
        return Estimated(self.value - other.value, error, dof, skewed)

    def apart(self, other: Self) -> float:
        """Distance from another number."""
        return abs(float(self.value) - float(other.value))


@dataclass(frozen=True)
class RmsMisfit:
    """Root mean square of numbers that are known with scatter, less what the scatter adds.

    Without any field it stands for numbers that are not known, or whose scatter is not known.

    square : mean of the squares less their variances; negative by chance where there is little but scatter
    noise : mean of the variances
    along : of that, what changes the size to first order
    modes : number of terms of independent noise whose sum would have the same spread (Box 1954)
    dof : degrees of freedom of the noise
    pooled : whether these dof belong to a scatter that all numbers share, and not to the scatter of each mode
    skewness : of what changes the size to first order
    parts : share in the noise by solver and stratum of the surfaces; empty where these are not known
    grid : error of discretisation, absolute; NaN if unknown
    """

    square: float = nan
    noise: float = nan
    along: float = nan
    modes: float = nan
    dof: float = 0
    pooled: bool = False
    skewness: float = 0.0
    parts: Mapping[tuple[str, int], Any] = field(default_factory=dict)
    grid: float = 0.0
    size: ClassVar[bool] = True

    @property
    def value(self) -> float:
        """Root mean square without scatter; zero where the scatter explains all, NaN where it is not known."""
        return sqrt(max(self.square, 0.0)) if np.isfinite(self.square) else nan

    def interval(self, level: float = 0.95) -> tuple[float, float]:
        """Sizes that the data do not contradict.

        To first order the square is off by 2 size sqrt(along) t, and where there is nothing but noise by an F
        quantile of the noise; both are added as squares, at the size asked about. Where the size is zero the
        second decides, as a jackknife of the square itself sees no derivative. Downwards, `along` stops at zero.
        """
        if not np.isfinite(self.noise + self.square):
            return nan, nan
        if self.noise == 0:
            return self.value, self.value
        down, up = (self.along * side**2 for side in sides(level, self.dof, self.skewness))
        known = self.dof * (1.0 if self.pooled else self.modes)
        second = (special.fdtri(self.modes, min(known, KNOWN), level) - 1) * self.noise
        middle = self.square + 2 * down
        above = self.square**2 - second**2
        low = above / (middle + sqrt(middle**2 - above)) if self.square > second else 0.0
        second = max(second, self.noise)

        def beyond(square):
            first = square + self.along - max(sqrt(square) - sqrt(up), 0.0) ** 2
            return square - hypot(first, second) - self.square

        least = max(self.square, 0.0)
        most = 2 * (least + 4 * up + self.along + second)
        high = brentq(beyond, least, most, xtol=1e-12 * most)
        return sqrt(low), sqrt(high)

    def apart(self, other: Self) -> float:
        """Distance from another misfit, by roots with the sign of the square: two zero sizes need not be equal."""
        squares = np.array([self.square, other.square])
        return float(np.ptp(np.sign(squares) * np.sqrt(np.abs(squares))))
