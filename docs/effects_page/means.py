"""Means over surfaces, lines or places, as every chapter writes them: ± is half of an interval of 95 %."""

from collections.abc import Iterable
from dataclasses import dataclass
from math import hypot, nan, sqrt

import numpy as np

from compare.statistics.jackknife import student

LEVEL = 0.95
# Of the mean: bodies that differ by less do not scatter, and the mean stands alone.
ALIKE = 1e-6
# Said once on the page, where the first of them stands.
MEANING = (
    "Here and in every chapter ± is half of an interval of 95 % by Student, of a mean over surfaces, lines or\n"
    "places or of a ratio of such means; a number without it is of one body, or of bodies alike to six digits."
)


@dataclass(frozen=True)
class Estimate:
    """Mean of a sample.

    mean : NaN without a value
    deviation : standard deviation of one value; NaN with fewer than two values
    error : standard error of the mean; NaN with fewer than two values
    count : how many values
    """

    mean: float
    deviation: float
    error: float
    count: int


def estimate(values: Iterable[float]) -> Estimate:
    """Mean, standard deviation (n - 1) and standard error of the finite ones of some values."""
    sample = np.array([value for value in values if np.isfinite(value)])
    count = sample.size
    mean = float(sample.mean()) if count else nan
    deviation = float(sample.std(ddof=1)) if count > 1 else nan
    return Estimate(mean, deviation, deviation / sqrt(count) if count else nan, count)


def ratio(above: Estimate, below: Estimate) -> tuple[float, float]:
    """Ratio of two independent means and its standard error, to first order; NaN where it cannot be had.

    A mean without scatter, of a smooth body, has an error of NaN, and so has the ratio.
    """
    if not below.mean or not above.mean:
        return nan, nan
    value = above.mean / below.mean
    return value, abs(value) * hypot(above.error / above.mean, below.error / below.mean)


def plus_minus(value: float, error: float, unit: str = "") -> str:
    """Value ± error with the unit, to two digits of the error."""
    unit = f" {unit}" if unit else ""
    if not np.isfinite(value):
        return "undecided"
    if not np.isfinite(error):
        return f"{value:.3g}{unit}, error undecided"
    digits = 4 if error == 0 else int(np.clip(1 - np.floor(np.log10(error)), 0, 6))
    return f"{value:.{digits}f} ± {error:.{digits}f}{unit}"


def half(value: Estimate) -> float:
    """Half of the interval of a mean; NaN with fewer than two values."""
    return float(value.error * student(LEVEL, value.count - 1)) if value.count > 1 else nan


def written(value: Estimate, unit: str = "") -> str:
    """Mean ± half, to two digits of the latter; the mean alone of one body, or of bodies that are alike."""
    if value.count and not value.deviation > ALIKE * abs(value.mean):
        return f"{value.mean:.4g} {unit}".strip()
    return plus_minus(value.mean, half(value), unit)


def mean(values: Iterable[float]) -> str:
    """Mean of values ± half of its interval."""
    return written(estimate(values))
