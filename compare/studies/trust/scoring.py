"""Score of a model on scenes that it never saw: its errors, the scatter of the truth in them, its coverage."""

from dataclasses import dataclass, fields
from functools import cached_property

import numpy as np
from scipy.special import betaincinv, ndtr, ndtri

from ...trustmap.model import NORMAL, Measurements, Predicted
from ...trustmap.verdict import SOLVE, advice_on

# Quantiles of a normal distribution that stand for it.
_QUANTILES = ndtri((np.arange(99) + 0.5) / 99)


@dataclass(frozen=True, eq=False)
class Score:
    """Ratios predicted beside measured ones, of scenes with one quantity (N,).

    measured, predicted : of the same scenes; where a mean is not above zero there is no ratio, and no error
    """

    measured: Measurements
    predicted: Predicted

    def taken(self, chosen: np.ndarray) -> "Score":
        """Score of some scenes: a mask or numbers of scenes."""
        return Score(self.measured.taken(chosen), Predicted(*(each[chosen] for each in self.predicted)))

    def best(self, other: "Score") -> "Score":
        """Score that takes for each scene the narrower of two intervals, and is usable where either is."""
        first = np.where(self.usable == other.usable, self.predicted.error <= other.predicted.error, self.usable)

        def picked(ours, theirs):
            return np.where(first.reshape(-1, *[1] * (ours.ndim - 1)), ours, theirs)

        measured = (
            picked(getattr(self.measured, each.name), getattr(other.measured, each.name))
            for each in fields(Measurements)
        )
        predicted = (picked(*each) for each in zip(self.predicted, other.predicted, strict=True))
        return Score(Measurements(*measured), Predicted(*predicted))

    @cached_property
    def variance(self) -> np.ndarray:
        """Variance of the measured logarithms (N,)."""
        return self.measured.variance(self.predicted.scatter)

    @cached_property
    def advice(self) -> np.ndarray:
        """Advice on each scene (N,)."""
        ratio, error = np.exp(self.predicted.logarithm), self.predicted.error
        return np.array([advice_on(*each) for each in zip(ratio, error, strict=True)])

    @property
    def usable(self) -> np.ndarray:
        """Mask of the scenes that get "use" or "multiply" (N,)."""
        return self.advice != SOLVE

    @property
    def used(self) -> "Score":
        """Score of the scenes that are usable and have a ratio: whose errors count."""
        return self.taken(self.usable & np.isfinite(self.measured.logarithm))

    @cached_property
    def errors(self) -> np.ndarray:
        """Relative errors of corrected 1D (N,), the scatter of the truth in them."""
        return np.expm1(self.measured.logarithm - self.predicted.logarithm)

    @cached_property
    def own(self) -> np.ndarray:
        """Errors of the map alone (N, 99), as quantiles: each measured error is split as variances stand."""
        apart = self.measured.logarithm - self.predicted.logarithm
        model = self.predicted.error**2
        share = model / (model + self.variance)
        return np.expm1((apart * share)[:, None] + np.sqrt(self.variance * share)[:, None] * _QUANTILES)

    @cached_property
    def held(self) -> np.ndarray:
        """Mask of the measured ratios within the interval of 95 % (N,), widened by the noise of the truth."""
        apart = self.measured.logarithm - self.predicted.logarithm
        return np.abs(apart) < NORMAL * np.sqrt(self.predicted.error**2 + self.variance)

    @property
    def covered(self) -> float:
        """Share of the measured ratios within the interval of 95 %."""
        return float(np.mean(self.held))

    @property
    def surfaces_covered(self) -> float:
        """Share of single surfaces within the interval of one surface, where it has one, as they were measured."""
        if not self.predicted.surface_told.all():
            return self.taken(self.predicted.surface_told).surfaces_covered
        apart = self.measured.logarithm - self.predicted.logarithm
        width = NORMAL * np.hypot(self.predicted.error, self.predicted.scatter)
        scatter = np.maximum(np.nan_to_num(self.measured.scatter), 1e-9)
        return float(np.mean(ndtr((width - apart) / scatter) - ndtr((-width - apart) / scatter)))


def of_count(held: int, tried: int) -> tuple[float, float]:
    """Interval of 95 % of a share, from how many of those tried it held for (Clopper and Pearson)."""
    low = betaincinv(held, tried - held + 1, 0.025) if held else 0.0
    high = betaincinv(held + 1, tried - held, 0.975) if held < tried else 1.0
    return float(low), float(high)
