"""From rows to curves: means over surfaces with their scatter, ratios with their errors."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from math import hypot, nan, sqrt

import numpy as np

from .outcome import Outcome, Row
from .store import Task as AnyTask
from .study import Point


@dataclass(frozen=True)
class Estimate:
    """Mean of a sample.

    mean : NaN without a value
    deviation : standard deviation of one surface; NaN with fewer than two values
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


def pooled_scatter(estimates: Iterable[Estimate]) -> float:
    """Standard deviation of one value over the mean, taken for the same of all estimates; NaN with none repeated.

    A few values say too little of their own scatter: one in twenty of three has less than a quarter of it.
    """
    repeated = [each for each in estimates if each.count > 1]
    freedom = sum(each.count - 1 for each in repeated)
    squares = sum((each.count - 1) * (each.deviation / each.mean) ** 2 for each in repeated)
    return sqrt(squares / freedom) if freedom else nan


def ratio(above: Estimate, below: Estimate) -> tuple[float, float]:
    """Ratio of two independent means and its standard error, to first order; NaN where it cannot be had.

    A mean without scatter, of a smooth body, has an error of NaN, and so has the ratio.
    """
    if not below.mean or not above.mean:
        return nan, nan
    value = above.mean / below.mean
    return value, abs(value) * hypot(above.error / above.mean, below.error / below.mean)


def relative_deviation(above: Estimate, below: Estimate) -> tuple[float, float]:
    """above / below - 1 and its standard error."""
    value, error = ratio(above, below)
    return value - 1, error


@dataclass(frozen=True)
class Record:
    """One point of one curve, averaged.

    kind, solver, smooth : which curve
    speed [m/s], load [N] or depth [m] : what was prescribed, NaN what was not
    points : of the solver's grid in one direction, 0 without a grid
    normal_force [N], depth_reached [m], friction_force [N], friction_coefficient : averages over surfaces
    friction_spread : |by traction - by energy lost| / friction force in 3D, mean over surfaces; NaN elsewhere
    rms_slope : of the roughness as the solver's own measure defines it
    pixel [m], points_across_contact : mean over surfaces, NaN if not measured
    residual : the worst
    seconds : processor time of all its solves [s]
    failures : reasons, one for each failed surface
    """

    kind: str
    solver: str
    smooth: bool
    speed: float
    load: float
    depth: float
    points: int
    normal_force: Estimate
    depth_reached: Estimate
    friction_force: Estimate
    friction_coefficient: Estimate
    friction_spread: float
    rms_slope: Estimate
    pixel: float
    points_across_contact: float
    residual: float
    seconds: float
    failures: tuple[str, ...]

    @property
    def columns(self) -> dict[str, object]:
        """Flat, for a table: each estimate as name, name_deviation, name_error; units in Record's docstring."""
        flat: dict[str, object] = {}
        for name, value in vars(self).items():
            if isinstance(value, Estimate):
                flat |= {name: value.mean, f"{name}_deviation": value.deviation, f"{name}_error": value.error}
            else:
                flat[name] = len(value) if name == "failures" else value
        return flat | {"surfaces": self.normal_force.count}


def records(points: Sequence[Point], outcomes: Mapping[AnyTask, Outcome]) -> list[Record]:
    """Every point averaged over its surfaces."""
    return [_record(point, [row for task in point.tasks for row in outcomes[task].rows]) for point in points]


def select(table: Sequence[Record], kind: str, solver: str, smooth: bool | None = None) -> list[Record]:
    """One curve: the records of a kind and solver, in the order of load or depth, then speed."""
    chosen = [
        record
        for record in table
        if record.kind == kind and record.solver == solver and (smooth is None or record.smooth == smooth)
    ]
    return sorted(
        chosen, key=lambda record: (record.speed, np.nan_to_num(record.load), np.nan_to_num(record.depth))
    )


def by_speed(curve: Sequence[Record]) -> dict[float, list[Record]]:
    """The records of a curve at each speed, ascending."""
    return {speed: [r for r in curve if r.speed == speed] for speed in sorted({r.speed for r in curve})}


def pairs(table: Sequence[Record], kind: str, smooth: bool | None = None) -> list[tuple[Record, Record]]:
    """The same points in one and in three dimensions: (MDR, BEM)."""
    below = {_place(record): record for record in select(table, kind, "BEM", smooth)}
    above = select(table, kind, "MDR", smooth)
    return [(record, below[_place(record)]) for record in above if _place(record) in below]


def discretisation(table: Sequence[Record], record: Record, quantity: str) -> float:
    """Relative change of a 3D quantity as the pixel is halved, where a record lies; NaN if not solved there."""
    coarse, refined = (
        next((found for found in select(table, kind, "BEM") if _place(found) == _place(record)), None)
        for kind in ("coarse", "refined")
    )
    if coarse is None or refined is None:
        return nan
    return abs(relative_deviation(getattr(coarse, quantity), getattr(refined, quantity))[0])


def _place(record):
    """What was prescribed; NaN, which equals nothing, as None."""
    prescribed = (record.speed, record.load, record.depth)
    return record.smooth, *(None if np.isnan(value) else value for value in prescribed)


def _spread(row):
    """Of the two estimates of a 3D friction force, relative; NaN without both or without friction."""
    both = [row.measures.get(f"friction_by_{way}", nan) for way in ("traction", "loss")]
    return abs(both[0] - both[1]) / abs(row.friction_force) if row.friction_force else nan


def _record(point: Point, rows: list[Row]) -> Record:
    motion = point.scene.motion
    solver = point.tasks[0].solver
    solved = [row for row in rows if row.reason is None]
    return Record(
        kind=point.kind,
        solver=point.solver,
        smooth=point.scene.roughness is None,
        speed=motion.speed,
        load=nan if motion.load is None else motion.load,
        depth=nan if motion.depth is None else motion.depth,
        points=getattr(solver, "points", 0),
        normal_force=estimate(row.normal_force for row in rows),
        depth_reached=estimate(row.depth for row in rows),
        friction_force=estimate(row.friction_force for row in rows),
        friction_coefficient=estimate(row.friction_coefficient for row in rows),
        friction_spread=estimate(_spread(row) for row in rows).mean,
        rms_slope=estimate(row.measures.get("rms_slope", nan) for row in rows),
        pixel=estimate(row.measures.get("pixel", nan) for row in rows).mean,
        points_across_contact=estimate(row.measures.get("points_across_contact", nan) for row in rows).mean,
        residual=max((row.residual for row in solved), default=nan),
        seconds=float(np.nansum([row.seconds for row in rows])),
        failures=tuple(row.reason for row in rows if row.reason is not None),
    )
