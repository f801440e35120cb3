"""How much is solved of a study."""

from dataclasses import dataclass, replace
from typing import Self

import numpy as np

# Points a side below which the shortest wave is not resolved.
LEAST_POINTS = 128


@dataclass(frozen=True)
class Size:
    """How much is solved.

    range : of speeds [m/s]
    speeds, presses : how many
    surfaces, profiles : drawn in three and in one dimension
    points : a side of the finer grid in three dimensions
    hurst : the Hurst exponents compared
    few : speeds and presses at most, where many parameters are changed
    indentations : rates and depths of pressing in
    steps : in time, of pressing in
    """

    range: tuple[float, float]
    speeds: int
    presses: int
    surfaces: int
    profiles: int
    points: int
    hurst: tuple[float, ...]
    few: int
    indentations: int
    steps: int

    @property
    def rates(self) -> tuple[float, ...]:
        """The speeds [m/s]."""
        return between(*self.range, self.speeds)

    def presses_of(self, low: float, high: float) -> tuple[float, ...]:
        """From the least to the greatest."""
        return between(low, high, self.presses)

    def at_most(self, **counts: int) -> Self:
        """The same with no more of what is named: speeds, presses, surfaces."""
        return replace(self, **{name: min(getattr(self, name), most) for name, most in counts.items()})

    def within(self, low: float, high: float) -> Self:
        """The same with no speeds [m/s] beyond."""
        return replace(self, range=(max(self.range[0], low), min(self.range[1], high)))

    @property
    def coarser(self) -> Self:
        """For many series: the pixel doubled, where that still resolves the waves."""
        return replace(self, points=max(LEAST_POINTS, self.points // 2))


def between(low: float, high: float, count: int) -> tuple[float, ...]:
    """Numbers in equal ratios."""
    return tuple(float(value) for value in np.geomspace(low, high, count))
