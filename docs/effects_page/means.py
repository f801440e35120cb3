"""Means over surfaces, lines or places, as every chapter writes them: ± is half of an interval of 95 %."""

from collections.abc import Iterable
from math import nan

from compare.metrics import Estimate, estimate
from compare.statistics.jackknife import student
from compare.wording import plus_minus

LEVEL = 0.95
# Of the mean: bodies that differ by less do not scatter, and the mean stands alone.
ALIKE = 1e-6
# Said once on the page, where the first of them stands.
MEANING = (
    "Here and in every chapter ± is half of an interval of 95 % by Student, of a mean over surfaces, lines or\n"
    "places or of a ratio of such means; a number without it is of one body, or of bodies alike to six digits."
)


def half(value: Estimate) -> float:
    """Half of the interval of a mean; NaN with fewer than two values."""
    return float(value.error * student(LEVEL, value.count - 1)) if value.count > 1 else nan


def written(value: Estimate, unit: str = "") -> str:
    """Mean ± half, to two digits of the latter; the mean alone of one body, or of bodies that are alike."""
    if value.count and not value.deviation > ALIKE * abs(value.mean):
        return f"{value.mean:.4g} {unit}".strip()
    return plus_minus(value.mean, half(value), unit)


def mean(values: Iterable[float]) -> str:
    """The same of values."""
    return written(estimate(values))
