"""Curves of pooled measurements, at the speeds to which their temperatures are shifted."""

from dataclasses import dataclass, replace
from itertools import groupby
from math import inf, nan
from typing import Self

import numpy as np

from ...statistics.frictioncurves import Curve, Statistic
from ...statistics.jackknife import Replicates
from .pooling import Point, Pooled
from .temperatureshifts import Isotherm, TemperatureShifts

LEAST_LOADS = 2
MOST_SPEEDS, MOST_POINTS = 100, 5_000


@dataclass(frozen=True)
class MeasuredCurves:
    """Curves of which every point was measured by itself.

    curves : with the standard error of each ln mu, NaN where unknown
    dof : degrees of freedom of the one relative scatter behind these errors; infinite if it is known exactly
    levers : change of ln v of each curve with ln mu of each point (S, N), where friction itself says by how much
        speeds are shifted, in the order of the curves, which is that of their speeds; None of speeds as measured
    """

    curves: tuple[Curve, ...]
    dof: float = inf
    levers: np.ndarray | None = None

    @property
    def speeds(self) -> np.ndarray:
        """(S,) [m/s]."""
        return np.array([curve.speed for curve in self.curves])

    @property
    def points(self) -> int:
        """Number of points."""
        return sum(curve.log_load.size for curve in self.curves)

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
    curves = _curves(pooled)
    if not 2 <= len(curves) <= MOST_SPEEDS:
        raise ValueError(f"{len(curves):,} speeds: 2 to {MOST_SPEEDS} are shifted onto one curve")
    if (count := len(pooled.points)) > MOST_POINTS:
        raise ValueError(f"{count:,} loads at all speeds: at most {MOST_POINTS:,} are shifted onto one curve")
    for each in curves:
        if len(each) < LEAST_LOADS:
            point = pooled.points[each[0]]
            warm = "" if point.temperature is None else f"T = {point.temperature:.5g} K, "
            raise ValueError(
                f"{warm}v = {point.speed:g} has {len(each)} load: at least {LEAST_LOADS} are needed for a curve"
            )


def isotherms(pooled: Pooled) -> tuple[Isotherm, ...]:
    """Points by their temperatures; none where no temperature was measured."""
    if pooled.points[0].temperature is None:
        return ()
    warmth = np.array([each.temperature for each in pooled.points])
    logs = np.log([[each.speed, each.load, each.friction] for each in pooled.points]).T
    errors = np.array([pooled.error(each) for each in pooled.points])
    speed, load, friction = logs
    parts = ((at, warmth == at) for at in np.unique(warmth).tolist())
    return tuple(Isotherm(at, speed[own], load[own], friction[own], errors[own]) for at, own in parts)


def curves_of(pooled: Pooled, shifts: TemperatureShifts | None = None) -> MeasuredCurves:
    """Curves of points against load, each with the standard error that its repeats leave of the common scatter."""
    order = in_order(pooled, shifts)
    curves = tuple(_curve([pooled.points[k] for k in places], speed, pooled) for speed, places in order)
    if shifts is None or not shifts.found:
        return MeasuredCurves(curves, pooled.dof)
    warm = {at: number for number, at in enumerate(shifts.temperatures.tolist())}
    owner = [warm[pooled.points[places[0]].temperature] for _, places in order]
    every = np.concatenate([places for _, places in order])
    return MeasuredCurves(curves, pooled.dof, shifts.levers[owner][:, every])


def in_order(pooled: Pooled, shifts: TemperatureShifts | None = None) -> list[tuple[float, list[int]]]:
    """Speed of each curve once its temperature is shifted [m/s], ascending, and the places of its points."""
    factors = (
        {}
        if shifts is None
        else dict(zip(shifts.temperatures.tolist(), np.exp(shifts.shifts.value).tolist(), strict=True))
    )

    def speed(places):
        point = pooled.points[places[0]]
        return point.speed * factors.get(point.temperature, 1.0)

    return sorted(((speed(each), each) for each in _curves(pooled)), key=lambda curve: curve[0])


def _curves(pooled):
    """Places of the points of each curve."""
    points = pooled.points
    same = groupby(range(len(points)), key=lambda k: (points[k].temperature, points[k].speed))
    return [list(each) for _, each in same]


def _curve(points: list[Point], speed: float, pooled: Pooled) -> Curve:
    load, friction = np.log([(each.load, each.friction) for each in points]).T
    return Curve(speed, load, friction, np.array([pooled.error(each) for each in points]))
