"""Expected error of a mean over rough surfaces: what grid and scatter leave, and what either costs."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil, inf, isfinite, nan, sqrt
from typing import Protocol, Self

import numpy as np
from scipy import special

from .intervals import Estimated

LEVEL = 0.95


@dataclass(frozen=True)
class Scatter:
    """Standard deviation between surfaces, from so many degrees of freedom; NaN from none."""

    value: float
    dof: int

    @classmethod
    def of(cls, values: Sequence[float] | np.ndarray) -> Self:
        """Scatter of the finite ones of some values."""
        known = np.asarray(values, float)
        known = known[np.isfinite(known)]
        return cls(float(known.std(ddof=1)) if known.size > 1 else nan, max(known.size - 1, 0))

    def interval(self) -> tuple[float, float]:
        """Interval of 95 % by the chi-square distribution of normal deviates; what is skewed scatters more."""
        if self.dof < 1:
            return nan, nan
        low, high = special.chdtri(self.dof, [(1 - LEVEL) / 2, (1 + LEVEL) / 2])
        return self.value * sqrt(self.dof / low), self.value * sqrt(self.dof / high)


@dataclass(frozen=True)
class Bias:
    """Error that remains however many surfaces are averaged, of which only the size counts.

    value : signed, found less true
    low, high : ends of its interval of 95 %, with what the truth itself may be off by; NaN where not known
    """

    value: float
    low: float
    high: float

    @classmethod
    def of(cls, found: Estimated, left: float) -> Self:
        """Bias whose truth is off by as much as is left beside the scatter."""
        low, high = found.interval()
        return cls(float(found.value), float(low) - left, float(high) + left)

    @property
    def size(self) -> float:
        """Magnitude of the bias."""
        return abs(self.value)

    @property
    def least(self) -> float:
        """Smallest size in the interval."""
        return max(self.low, -self.high, 0.0)

    @property
    def most(self) -> float:
        """Largest size in the interval."""
        return max(-self.low, self.high)


@dataclass(frozen=True)
class Level:
    """Surfaces that are drawn independently of others, of which a mean is taken.

    points : of the grid, or of both grids whose difference is taken on the same surface
    scatter : of one surface
    seconds : processor time of one surface [s]
    """

    points: tuple[int, ...]
    scatter: Scatter
    seconds: float

    @property
    def label(self) -> str:
        """Grids in words."""
        return " against ".join(str(points) for points in self.points)


@dataclass(frozen=True)
class Effort:
    """Effort for a wanted error.

    solver : by name; settings : in words; seconds : of processor time
    counts : surfaces on each level of a plan
    """

    solver: str
    settings: str
    seconds: float
    counts: tuple[int, ...] = ()


class Way(Protocol):
    """A way to an answer."""

    def effort(self, level: float) -> Effort | None:
        """Effort for a wanted error; None where it is not reached."""


@dataclass(frozen=True)
class SamplingPlan:
    """One way to the mean over surfaces: a mean of answers, or of coarse answers and of their corrections.

    With n_k surfaces on each level the expected error is sqrt(bias^2 + sum_k s_k^2 / n_k), and n_k as
    s_k / sqrt(t_k) gives the least for the time sum_k n_k t_k: sqrt(bias^2 + (sum_k s_k sqrt(t_k))^2 / time).
    Giles, Oper. Res. 56, 607 (2008). Scatter and bias are relative, as errors are.

    solver : by name
    setup : processor time before the first surface [s]
    """

    solver: str
    bias: Bias
    levels: tuple[Level, ...]
    setup: float = 0.0

    @property
    def label(self) -> str:
        """Parameter grids of its levels in words, the finest of a correction first."""
        return " + ".join(level.label for level in self.levels)

    def error(self, seconds: np.ndarray | float) -> np.ndarray | float:
        """Error expected after so much processor time [s], with any broken numbers of surfaces."""
        return np.sqrt(self.bias.size**2 + self._work**2 / (seconds - self.setup))

    def error_of(self, counts: np.ndarray | float) -> np.ndarray | float:
        """Error expected of so many answers of the first level, corrections aside."""
        return np.sqrt(self.bias.size**2 + self.levels[0].scatter.value ** 2 / counts)

    @property
    def certain(self) -> float:
        """Error that is reached with enough surfaces, by the largest bias of its interval."""
        return self.bias.most

    def effort(self, level: float) -> Effort | None:
        """Effort for a wanted error (rms) with the largest bias of its interval; None where that is more.

        Corrections are few, and scatter by as much as their interval allows.
        """
        scatters = [self.levels[0].scatter.value, *(each.scatter.interval()[1] for each in self.levels[1:])]
        drawn = list(zip(scatters, self.levels, strict=True))
        work, room = sum(scatter * sqrt(each.seconds) for scatter, each in drawn), level**2 - self.bias.most**2
        if not (room > 0 and isfinite(work)):
            return None
        shares = [scatter * work / sqrt(each.seconds) / room for scatter, each in drawn]
        counts = tuple(max(1, ceil(share)) for share in shares)
        seconds = self.setup + sum(count * each.seconds for count, each in zip(counts, self.levels, strict=True))
        return Effort(self.solver, self._settings(counts), seconds, counts)

    @property
    def least_seconds(self) -> float:
        """Shortest time at which there is one surface on each level, shared out as it should be [s]."""
        shared = [
            self._work * sqrt(level.seconds) / level.scatter.value
            for level in self.levels
            if level.scatter.value > 0
        ]
        return self.setup + max([sum(level.seconds for level in self.levels), *shared])

    @property
    def _work(self):
        return sum(level.scatter.value * sqrt(level.seconds) for level in self.levels)

    def _settings(self, counts):
        """Surfaces and points in words."""
        what = "surfaces" if self.solver == "BEM" else "profiles"
        (count, *more), (level, *finer) = counts, self.levels
        told = f"{count:,} {what if count > 1 else what[:-1]} of {level.points[0]} points"
        for number, correction in zip(more, finer, strict=True):
            told += f", corrected by {number:,} of {correction.points[0]}"
        return told


@dataclass(frozen=True)
class Mean:
    """Mean over surfaces of one quantity of a regime, and where the models stand with it.

    contact, title : of the regime; quantity, label : its name, and for people
    plans : to it; relative to the scale of the truth
    grid_error : of the truth, relative: what the finest grid leaves if the error falls with the first power of its
        points, as much as halving them changes; NaN where too many of the surfaces have no answer
    failed : number of solves that failed on all grids
    """

    contact: str
    title: str
    quantity: str
    label: str
    plans: tuple[SamplingPlan, ...]
    grid_error: float
    failed: int

    def of(self, solver: str) -> list[SamplingPlan]:
        """Plans of one solver."""
        return [plan for plan in self.plans if plan.solver == solver]

    @property
    def plain(self) -> list[SamplingPlan]:
        """Plans of the 3D solver on one grid each."""
        return [plan for plan in self.of("BEM") if len(plan.levels) == 1]

    def floor(self, solver: str = "MDR") -> Bias:
        """Error of a 1D model on its finest grid: no number of profiles passes it."""
        own = self.of(solver)
        return own[-1].bias if own else Bias(nan, nan, nan)


def cheapest(ways: Sequence[Way], level: float) -> Effort | None:
    """Least effort of all ways that reach a wanted error; None if none does."""
    found = [effort for each in ways if (effort := each.effort(level)) is not None]
    return min(found, key=lambda effort: effort.seconds, default=None)


def envelope(plans: Sequence[SamplingPlan], seconds: np.ndarray) -> np.ndarray:
    """Least expected error of all plans after so much time; infinite before the first surface is solved.

    Plans whose bias has no interval do not count.
    """
    best = np.full(np.shape(seconds), inf)
    for plan in plans:
        if isfinite(plan.least_seconds) and isfinite(plan.bias.most):
            known = np.where(seconds >= plan.least_seconds, plan.error(seconds), inf)
            best = np.fmin(best, known)
    return best
