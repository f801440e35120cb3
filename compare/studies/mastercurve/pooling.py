"""Measurements of friction that repeat one point, though loads, speeds and temperatures scatter a little."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from math import nan, sqrt

import numpy as np
from pandas import DataFrame

WARMTH = 2.0  # [K]: temperatures no farther apart are one, unless only equal numbers are


@dataclass(frozen=True)
class Pooled:
    """Measurements as points, in the order of temperature, speed and load.

    Within a point friction follows load and speed, so it is taken to the means of both along the slope of a
    parabola in their logarithms through all measurements at the temperature. What is left scatters, relative to
    friction, alike everywhere: two or three measurements say too little of their own.

    points : a row for each: `temperature` [K], NaN where none was measured, and `speed` [m/s] as means over its
        curve; `load` [N] and `friction` at this load and speed as means over its `repeats`; standard `error` of
        ln mu; `press`, the number of its load of those that are told apart, ascending
    scatter : standard deviation of a measurement relative to the mean of its point; NaN without repeats
    dof : degrees of freedom of the scatter; 0 where no point was measured twice
    """

    points: DataFrame
    scatter: float
    dof: int

    @property
    def loads(self) -> int:
        """Number of loads that are told apart."""
        return int(self.points["press"].max()) + 1


def pooled(
    friction: np.ndarray, load: np.ndarray, speed: np.ndarray, temperature: np.ndarray | None, tolerance: float
) -> Pooled:
    """Measurements (N,) as points.

    temperature : (N,) [K], or None
    tolerance : relative; loads within it of one another are one, and so are speeds. At 0 only equal ones are
    """

    def alike(low):
        return low * (1 + tolerance)

    rows, squares = [], 0.0
    kelvins = np.zeros(friction.size) if temperature is None else temperature
    for warm in _groups(kelvins, lambda low: low + WARMTH * (tolerance > 0)):
        warmth = nan if temperature is None else mean(temperature[warm])
        falls = _parabola(np.log(friction[warm]), np.log(load[warm]), np.log(speed[warm]))
        for slide in _groups(speed[warm], alike):
            curve = warm[slide]
            v = mean(speed[curve])
            for press in _groups(load[curve], alike):
                own = curve[press]
                f = mean(load[own])
                at = falls(np.log(f), np.log(v)) - falls(np.log(load[own]), np.log(speed[own]))
                repeats = friction[own] * np.exp(at)
                rows.append((warmth, v, f, float(np.mean(repeats)), own.size))
                squares += float(np.sum(np.square(repeats / rows[-1][3] - 1)))
    points = DataFrame(rows, columns=["temperature", "speed", "load", "friction", "repeats"])
    dof = friction.size - len(points)
    scatter = sqrt(squares / dof) if dof else nan
    for number, same in enumerate(_groups(points["load"].to_numpy(), alike)):
        points.loc[same, "press"] = number
    return Pooled(points.assign(error=scatter / np.sqrt(points["repeats"])), scatter, dof)


def mean(values: np.ndarray) -> float:
    """The mean, which lies between them whatever is rounded: equal values are their mean."""
    return float(np.clip(np.mean(values), values.min(), values.max()))


def _groups(values: np.ndarray, reach: Callable[[float], float]) -> Iterator[np.ndarray]:
    """Places of values that are one, in their order.

    reach : the largest value that is one with a smallest. What reaches farther is parted at a wide gap: of those
    at least half as wide as the widest, at that in the middle. So a run without gaps is halved, never chained.
    """
    order = np.argsort(values, kind="stable")
    ranked = values[order]
    steps = np.diff(ranked)
    left = [(0, values.size)]
    while left:
        start, end = left.pop()
        if ranked[end - 1] <= reach(ranked[start]):
            yield np.sort(order[start:end])
            continue
        inner = steps[start : end - 1] / ranked[start : end - 1]
        wide = np.flatnonzero(inner >= inner.max() / 2)
        middle = (ranked[start] + ranked[end - 1]) / 2
        cut = start + 1 + wide[np.argmin(np.abs(ranked[start + wide] + steps[start + wide] / 2 - middle))]
        left += [(cut, end), (start, cut)]


def _parabola(y, x, z):
    """The best polynomial of second degree in two variables; what hardly varies has no slope."""
    middle = mean(x), mean(z)

    def terms(x, z):
        x, z = x - middle[0], z - middle[1]
        return np.stack([np.ones_like(x * z), x + 0 * z, z + 0 * x, x * x + 0 * z, x * z, z * z + 0 * x], axis=-1)

    found = np.linalg.lstsq(terms(x, z), y, rcond=5e-3)[0]
    return lambda x, z: np.sum(terms(x, z) * found, axis=-1)
