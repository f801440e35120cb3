"""Measurements of friction that repeat one point: as points, and as curves at their shifted speeds."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from math import inf, isnan, nan, sqrt
from typing import Self

import numpy as np
from pandas import DataFrame

from ...statistics.frictioncurves import Curve, Statistic
from ...statistics.jackknife import Replicates
from .temperatureshifts import Isotherm, TemperatureShifts

WARMTH = 2.0  # [K]: temperatures no farther apart are one, unless only equal numbers are


@dataclass(frozen=True)
class Pooled:
    """Measurements as points, in the order of temperature, speed and load.

    Within a point friction follows load and speed, so it is taken to the means of both along the slope of a
    parabola in their logarithms through all measurements at the temperature. What is left scatters, relative to
    friction, alike everywhere: two or three measurements say too little of their own.

    points : a row for each: `temperature` [K], NaN where none was measured, and `speed` [m/s] as means over its
        curve; `load` [N] and `friction` at this load and speed as means over its `repeats`; standard `error` of
        ln mu; `press`, the number of its load among the distinct loads, ascending
    scatter : standard deviation of a measurement relative to the mean of its point; NaN without repeats
    dof : degrees of freedom of the scatter; 0 where no point was measured twice
    """

    points: DataFrame
    scatter: float
    dof: int

    @property
    def loads(self) -> int:
        """Number of distinct loads."""
        return int(self.points["press"].max()) + 1


def pooled(
    friction: np.ndarray, load: np.ndarray, speed: np.ndarray, temperature: np.ndarray | None, tolerance: float
) -> Pooled:
    """Measurements (N,) as points.

    temperature : (N,) [K], or None
    tolerance : relative; loads that differ by less count as equal, and so do speeds. At 0 only equal ones do
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
        return np.stack([np.ones_like(x), x, z, x * x, x * z, z * z], axis=-1)

    found = np.linalg.lstsq(terms(x, z), y, rcond=5e-3)[0]
    return lambda x, z: np.sum(terms(x, z) * found, axis=-1)


CURVE = "temperature", "speed"  # that the points of a curve share
MOST_SPEEDS, MOST_POINTS = 100, 5_000


@dataclass(frozen=True)
class MeasuredCurves:
    """Curves whose points were all measured independently.

    curves : with the standard error of each ln mu, NaN where unknown
    dof : degrees of freedom of the one relative scatter behind these errors; infinite if it is known exactly
    levers : change of ln v of each curve with ln mu of each point (S, N), where friction itself says by how much
        speeds are shifted, in the order of the curves, which is the order of their speeds; None for speeds as
        measured
    """

    curves: tuple[Curve, ...]
    dof: float = inf
    levers: np.ndarray | None = None

    @property
    def speeds(self) -> np.ndarray:
        """(S,) [m/s]."""
        return np.array([curve.speed for curve in self.curves])

    @property
    def surfaces(self) -> int:
        """1, as none is random."""
        return 1

    def complete(self) -> Self:
        """Curves of more than one point, speeds ascending."""
        kept = (curve for curve in self.curves if curve.log_load.size > 1)
        return replace(self, curves=tuple(sorted(kept, key=lambda curve: curve.speed)))

    def resampled(self, statistic: Statistic) -> dict[str, Replicates]:
        """Statistics with the scatter that follows from moving each point by its standard error, both ways."""
        whole, errors = statistic(self), self._errors
        if not np.all(np.isfinite(errors)):
            return {
                name: self.replicates(value, np.full((1, *np.shape(value)), nan)) for name, value in whole.items()
            }
        moved = [
            [statistic(self._moved(point, by)) for by in (error, -error)] for point, error in enumerate(errors)
        ]
        return {
            name: self.replicates(value, np.array([(up[name] - down[name]) / 2 for up, down in moved]))
            for name, value in whole.items()
        }

    def deviations(self, slopes: float | np.ndarray = 0.0) -> np.ndarray:
        """Errors of the points (N, N); loads are known exactly."""
        return np.diag(self._errors)

    def replicates(self, value: float | np.ndarray, deviations: np.ndarray) -> Replicates:
        """Numbers whose deviations follow from those of independent points."""
        return Replicates(value, deviations, self.dof)

    @property
    def _errors(self):
        return np.concatenate([curve.error for curve in self.curves])

    def _moved(self, point, by):
        quicker = np.ones(len(self.curves)) if self.levers is None else np.exp(by * self.levers[:, point])
        moved = []
        for curve, times in zip(self.curves, quicker.tolist(), strict=True):
            here = np.arange(curve.log_load.size) == point
            moved.append(replace(curve, speed=times * curve.speed, log_friction=curve.log_friction + by * here))
            point -= curve.log_load.size
        return replace(self, curves=tuple(moved))


def check(pooled: Pooled) -> None:
    """Raise ValueError for too few or too many speeds, loads or points."""
    curves = pooled.points.groupby([*CURVE], dropna=False).ngroups
    if not 2 <= curves <= MOST_SPEEDS:
        raise ValueError(f"{curves:,} speeds: 2 to {MOST_SPEEDS} are shifted onto one curve")
    if (count := len(pooled.points)) > MOST_POINTS:
        raise ValueError(f"{count:,} loads at all speeds: at most {MOST_POINTS:,} are shifted onto one curve")
    for each in pooled.points.drop_duplicates([*CURVE], keep=False).itertuples():
        warm = "" if isnan(each.temperature) else f"T = {each.temperature:.5g} K, "
        raise ValueError(f"{warm}v = {each.speed:g} has 1 load: at least 2 are needed for a curve")


def isotherms(pooled: Pooled) -> tuple[Isotherm, ...]:
    """Points by their temperatures; none where no temperature was measured."""
    found = []
    for warmth, own in pooled.points.groupby("temperature"):
        speed, load, friction = np.log(own[["speed", "load", "friction"]].to_numpy()).T
        found.append(Isotherm(float(warmth), speed, load, friction, own["error"].to_numpy()))
    return tuple(found)


def curves_of(pooled: Pooled, shifts: TemperatureShifts | None = None) -> MeasuredCurves:
    """Curves of points against load, each with the standard error that its repeats leave of the common scatter."""
    order, curves = in_order(pooled, shifts), []
    for own in order:
        load, friction = np.log(own[["load", "friction"]].to_numpy()).T
        curves.append(Curve(float(own["reduced_speed"].iloc[0]), load, friction, own["error"].to_numpy()))
    if shifts is None or not shifts.found:
        return MeasuredCurves(tuple(curves), pooled.dof)
    owner = np.searchsorted(shifts.temperatures, [own["temperature"].iloc[0] for own in order])
    every = np.concatenate([own.index for own in order])
    return MeasuredCurves(tuple(curves), pooled.dof, shifts.levers[owner][:, every])


def in_order(pooled: Pooled, shifts: TemperatureShifts | None = None) -> list[DataFrame]:
    """Points of each curve with the speed to which its temperature is shifted, ascending [m/s]."""
    quicker = np.ones(len(pooled.points))
    if shifts is not None:
        quicker = np.exp(shifts.shifts.value)[np.searchsorted(shifts.temperatures, pooled.points["temperature"])]
    points = pooled.points.assign(reduced_speed=pooled.points["speed"] * quicker)
    curves = [own for _, own in points.groupby([*CURVE], dropna=False)]
    return sorted(curves, key=lambda own: own["reduced_speed"].iloc[0])
