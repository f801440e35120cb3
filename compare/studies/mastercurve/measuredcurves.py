"""Curves of pooled measurements, at the speeds to which their temperatures are shifted."""

from itertools import groupby

import numpy as np

from ...statistics.frictioncurves import Curve, MeasuredCurves
from .pooling import Point, Pooled
from .temperatureshifts import Isotherm, TemperatureShifts

LEAST_LOADS = 2
MOST_SPEEDS, MOST_POINTS = 100, 5_000


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
