"""Means over surfaces, lines or places, as every chapter writes them: with an interval of 95 % in brackets."""

from collections.abc import Iterable
from dataclasses import dataclass
from math import nan, sqrt

import numpy as np

from compare.statistics import digits
from compare.statistics.intervals import Estimated
from compare.statistics.jackknife import mean_ratio

# Relative to the mean: bodies that differ by less do not scatter, and the mean stands alone.
ALIKE = 1e-6


@dataclass(frozen=True)
class Estimate:
    """Mean of so many values; NaN without any."""

    found: Estimated
    count: int

    @property
    def mean(self) -> float:
        """Mean."""
        return float(self.found.value)


def estimate(values: Iterable[float]) -> Estimate:
    """Mean of the finite ones of some values."""
    sample = np.array([value for value in values if np.isfinite(value)])
    return Estimate(mean_ratio(sample), sample.size)


def ratio(above: Estimate, below: Estimate) -> Estimated:
    """Ratio of two independent means, to first order; NaN where it cannot be had.

    A mean without scatter, of a smooth body, has an error of NaN, and so has the ratio.
    """
    if not below.mean or not above.mean:
        return Estimated(nan, nan, 0)
    value = above.mean / below.mean
    off = _relative(above).less(_relative(below))
    return Estimated(value, abs(value) * off.error, off.dof, np.sign(value) * off.skewness)


def _relative(one):
    found = one.found
    return Estimated(1.0, found.error / abs(one.mean), found.dof, np.sign(one.mean) * found.skewness)


def between(found: Estimated, unit: str = "") -> str:
    """Number with its interval and the unit, to two digits of half of it."""
    value, (low, high) = float(found.value), found.interval()
    if not np.isfinite(value):
        return "undecided"
    text = digits.interval(value, low, high, 3)
    return digits.with_unit(text, unit) if np.isfinite(low) else f"{digits.with_unit(text, unit)}, error undecided"


def written(value: Estimate, unit: str = "") -> str:
    """Mean with its interval; the mean alone of one body, or of bodies that are alike."""
    if value.count and not value.found.error * sqrt(value.count) > ALIKE * abs(value.mean):
        return f"{value.mean:.4g} {unit}".strip()
    return between(value.found, unit)


def mean(values: Iterable[float]) -> str:
    """Mean of values with its interval."""
    return written(estimate(values))
