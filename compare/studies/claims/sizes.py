"""Sizes of a study: number of contacts that are solved."""

from dataclasses import dataclass, replace
from typing import Self

import numpy as np

# Points a side below which the shortest wave is not resolved.
LEAST_POINTS = 128


@dataclass(frozen=True)
class Size:
    """Size of a study.

    range : of speeds [m/s]
    speeds, values : how many speeds, and loads or depths
    surfaces, profiles : drawn in three and in one dimension
    points : a side of the finer grid in three dimensions
    hurst : the Hurst exponents compared
    few : speeds, and loads or depths, at most, where many parameters are changed
    indentations : rates and depths of pressing in
    steps : in time, of pressing in
    interval : the half-width that is wanted of intervals, see `Series`
    """

    range: tuple[float, float]
    speeds: int
    values: int
    surfaces: int
    profiles: int
    points: int
    hurst: tuple[float, ...]
    few: int
    indentations: int
    steps: int
    interval: float | None = None

    @property
    def rates(self) -> tuple[float, ...]:
        """Speeds [m/s] in equal ratios."""
        return between(*self.range, self.speeds)

    def values_of(self, low: float, high: float) -> tuple[float, ...]:
        """Loads or depths in equal ratios, from the least to the greatest."""
        return between(low, high, self.values)

    def at_most(self, **counts: int) -> Self:
        """Size with no more of what is named: speeds, values, surfaces."""
        return replace(self, **{name: min(getattr(self, name), most) for name, most in counts.items()})

    def within(self, low: float, high: float) -> Self:
        """Size without speeds [m/s] beyond these."""
        return replace(self, range=(max(self.range[0], low), min(self.range[1], high)))

    @property
    def coarser(self) -> Self:
        """Size for many series: the pixel doubled, where that still resolves the waves."""
        return replace(self, points=max(LEAST_POINTS, self.points // 2))


def between(low: float, high: float, count: int) -> tuple[float, ...]:
    """Numbers in equal ratios."""
    return tuple(float(value) for value in np.geomspace(low, high, count))
