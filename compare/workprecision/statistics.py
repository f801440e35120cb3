"""The expected error of a mean over surfaces: what grid and scatter leave, and what either costs."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil, inf, isfinite, nan, sqrt
from typing import Self

import numpy as np
from scipy import stats

from ..statistics.jackknife import student

LEVEL = 0.95


@dataclass(frozen=True)
class Scatter:
    """Standard deviation between surfaces, from so many degrees of freedom; NaN from none."""

    value: float
    freedom: int

    @classmethod
    def of(cls, values: Sequence[float] | np.ndarray) -> Self:
        """Of the finite ones of some values."""
        known = np.asarray(values, float)
        known = known[np.isfinite(known)]
        return cls(float(known.std(ddof=1)) if known.size > 1 else nan, max(known.size - 1, 0))

    def interval(self) -> tuple[float, float]:
        """Of 95 %, by the chi-square distribution of normal deviates; what is skewed scatters more widely."""
        if self.freedom < 1:
            return nan, nan
        low, high = stats.chi2.ppf([(1 + LEVEL) / 2, (1 - LEVEL) / 2], self.freedom)
        return self.value * sqrt(self.freedom / low), self.value * sqrt(self.freedom / high)

    @property
    def of_mean(self) -> float:
        """Standard error of the mean of as many values."""
        return self.value / sqrt(self.freedom + 1)


@dataclass(frozen=True)
class Bias:
    """What remains however many surfaces are averaged, of which only the size counts.

    value : signed, found less true
    reach : half of its interval of 95 %, with what the truth itself may be off by; NaN where that is not known
    """

    value: float
    reach: float

    @property
    def size(self) -> float:
        """Without its sign."""
        return abs(self.value)

    @property
    def least(self) -> float:
        """The smallest that the interval has."""
        return max(self.size - self.reach, 0.0)

    @property
    def most(self) -> float:
        """The largest that the interval has."""
        return self.size + self.reach


@dataclass(frozen=True)
class Draw:
    """Surfaces that are drawn independently of others, of which a mean is taken.

    points : of the grid, or of both grids whose difference is taken on the same surface
    scatter : of one
    seconds : processor time of one [s]
    """

    points: tuple[int, ...]
    scatter: Scatter
    seconds: float

    @property
    def label(self) -> str:
        """Short description for people."""
        return " against ".join(str(points) for points in self.points)


@dataclass(frozen=True)
class Way:
    """One way to the mean over surfaces: a mean of answers, or of coarse answers and of their corrections.

    With n_k of each draw the expected error is sqrt(bias^2 + sum_k s_k^2 / n_k), and n_k ~ s_k / sqrt(t_k) gives
    the least for the time sum_k n_k t_k: sqrt(bias^2 + (sum_k s_k sqrt(t_k))^2 / time). Giles, Oper. Res. 56, 607
    (2008). Scatter and bias are relative, as errors are.

    solver : by name
    """

    solver: str
    bias: Bias
    draws: tuple[Draw, ...]

    @property
    def label(self) -> str:
        """The grids, the finest of a correction first."""
        return " + ".join(draw.label for draw in self.draws)

    @property
    def corrected(self) -> bool:
        """Whether coarse answers are corrected by finer ones."""
        return len(self.draws) > 1

    def error(self, seconds: np.ndarray | float) -> np.ndarray | float:
        """Expected after so much processor time [s]; numbers of surfaces count as if they could be broken."""
        return np.sqrt(self.bias.size**2 + self._work**2 / seconds)

    def error_of(self, counts: np.ndarray | float) -> np.ndarray | float:
        """Expected of so many answers of the first draw, corrections aside."""
        return np.sqrt(self.bias.size**2 + self.draws[0].scatter.value ** 2 / counts)

    def reaching(self, level: float) -> "Reached | None":
        """What it takes for a wanted error (rms) with the largest bias of its interval; None where that is more.

        Corrections are few, and scatter by as much as their interval allows.
        """
        scatters = [self.draws[0].scatter.value, *(draw.scatter.interval()[1] for draw in self.draws[1:])]
        drawn = list(zip(scatters, self.draws, strict=True))
        work, room = sum(scatter * sqrt(draw.seconds) for scatter, draw in drawn), level**2 - self.bias.most**2
        if not (room > 0 and isfinite(work)):
            return None
        shares = [scatter * work / sqrt(draw.seconds) / room for scatter, draw in drawn]
        counts = tuple(max(1, ceil(share)) for share in shares)
        return Reached(
            self, counts, sum(count * draw.seconds for count, draw in zip(counts, self.draws, strict=True))
        )

    @property
    def least_seconds(self) -> float:
        """Of the shortest time at which there is one surface of each draw, shared out as it should be [s]."""
        shared = [
            self._work * sqrt(draw.seconds) / draw.scatter.value for draw in self.draws if draw.scatter.value > 0
        ]
        return max([sum(draw.seconds for draw in self.draws), *shared])

    @property
    def _work(self):
        return sum(draw.scatter.value * sqrt(draw.seconds) for draw in self.draws)


@dataclass(frozen=True)
class Reached:
    """A way taken so far that it reaches a wanted error: numbers of surfaces of its draws, and the time [s]."""

    way: Way
    counts: tuple[int, ...]
    seconds: float


def cheapest(ways: Sequence[Way], level: float) -> Reached | None:
    """The shortest of all that reach a wanted error; None if none does."""
    found = [reached for way in ways if (reached := way.reaching(level)) is not None]
    return min(found, key=lambda reached: reached.seconds, default=None)


def envelope(ways: Sequence[Way], seconds: np.ndarray) -> np.ndarray:
    """Least expected error of all ways after so much time; infinite before the first surface is solved.

    Ways whose bias has no interval do not count.
    """
    best = np.full(np.shape(seconds), inf)
    for way in ways:
        if isfinite(way.least_seconds) and isfinite(way.bias.most):
            known = np.where(seconds >= way.least_seconds, way.error(seconds), inf)
            best = np.fmin(best, known)
    return best


def half_width(error: float, freedom: float) -> float:
    """Half of the interval of 95 % of a mean with a standard error."""
    return float(student(LEVEL, freedom)) * error if freedom > 0 else nan
