"""Means over draws at every point of a Dataset, and numbers of several Datasets, with intervals of 95 %."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from math import nan
from typing import NamedTuple

import numpy as np
import xarray
from pandas import DataFrame

from ..solving.curve import COARSE, EMPTY, FAILED, FINE
from .intervals import Estimated
from .jackknife import DrawSet, Source, estimated, resample
from .multilevel import pooled

# Means of friction: the two forces whose means are divided.
FRICTION = ("friction_force", "normal_force")
RATIOS = {"friction_coefficient": FRICTION}
# Told with deviation and interval; told as a mean alone, of what is never negative.
ESTIMATED = ("normal_force", "depth_reached", "friction_force", "friction_coefficient", "rms_slope", "contact")
AVERAGED = ("friction_spread", "pixel", "points_across_contact")
# Never negative: their intervals are those of their logarithms.
SIZES = ("rms_slope",)
ENDS = "_mean", "_deviation", "_low", "_high"


class Interval(NamedTuple):
    """Numbers at every point, and the ends of their intervals of 95 %, scatter and grid; NaN where unknown."""

    value: np.ndarray
    low: np.ndarray
    high: np.ndarray

    @classmethod
    def of(cls, found: Estimated, grid: np.ndarray | float, size: bool = False) -> "Interval":
        """Interval of the scatter, wider at both ends by the error of the grid. size : see `Finding`"""
        value, low, high = found.size() if size else (found.value, *found.interval())
        return cls(value, np.maximum(low - grid, 0.0) if size else low - grid, high + grid)


def pressed(dataset: xarray.Dataset) -> str:
    """Name of the dimension that is prescribed: load or depth."""
    return next(name for name in map(str, dataset.dims) if name not in ("level", "speed", "surface"))


def with_spread(dataset: xarray.Dataset) -> xarray.Dataset:
    """Dataset with the spread of both estimates of friction in 3D, where it has both."""
    if not {"friction_by_traction", "friction_by_loss"} <= set(dataset.variables):
        return dataset
    force = dataset["friction_force"].where(dataset["friction_force"] != 0)
    apart = dataset["friction_by_traction"] - dataset["friction_by_loss"]
    return dataset.assign(friction_spread=abs(apart) / abs(force))


def means(dataset: xarray.Dataset, both: xarray.Dataset | None = None) -> DataFrame:
    """A row for each speed, and load or depth, on the fine grid.

    Each mean has the standard deviation of one draw and an interval of 95 % that counts scatter and grid. Of draws
    in strata that is the deviation on the coarsest grid, which has the most of them.

    both : draws of two grids that `multilevel.pooled` makes of it, where these are known
    """
    every = with_spread(dataset)
    drawn, dataset = _most_drawn(every), pooled(every) if both is None else both
    fine, prescribed = dataset.sel(level=FINE), pressed(dataset)
    speed, value = np.meshgrid(dataset["speed"].values, dataset[prescribed].values, indexing="ij")
    columns = {"points": np.full(speed.size, int(fine["points"])), "speed": speed, prescribed: value}
    for name in ESTIMATED:
        above, below = RATIOS.get(name, (name, None))
        if above not in fine:
            continue
        found = interval(dataset, above, below, name in SIZES)
        one = drawn[above] if below is None else drawn[above] / drawn[below].where(drawn[below] != 0)
        deviation = one.std("surface", ddof=1) if "surface" in one.dims else xarray.full_like(one, nan)
        numbers = found.value, deviation.transpose("speed", prescribed).values, found.low, found.high
        columns |= {f"{name}{end}": each for end, each in zip(ENDS, numbers, strict=True)}
    columns |= {name: interval(dataset, name, size=True).value for name in AVERAGED if name in fine}
    columns |= {
        "residual": _over_draws(fine["residual"], "max"),
        "seconds": _over_draws(fine["seconds"], "sum"),
        "surfaces": _over_draws(fine["normal_force"].notnull(), "sum"),
        "failures": _over_draws(fine["status"] == FAILED, "sum"),
    }
    return DataFrame({name: np.ravel(values) for name, values in columns.items()})


@dataclass(frozen=True)
class Compared:
    """Numbers of several Datasets, and their errors: arrays of one shape.

    value, low, high : numbers, and the ends of their intervals of 95 % from the scatter of draws alone
    grid : change from half the points to all; NaN if not solved there
    drawn : number of draws of each solver; none of smooth bodies
    parts : like those of `Estimated`
    """

    value: np.ndarray
    low: np.ndarray
    high: np.ndarray
    grid: np.ndarray
    drawn: Mapping[str, int]
    parts: Mapping[Source, np.ndarray] = field(default_factory=dict)

    @property
    def interval(self) -> Interval:
        """Numbers with intervals that count scatter and grid."""
        return Interval(self.value, self.low - self.grid, self.high + self.grid)


def compared(
    statistic: Callable[[Mapping], np.ndarray], fine: DrawSet, coarse: Mapping | None, size: bool = False
) -> Compared:
    """Numbers that a statistic of Datasets gives; `coarse` are those on half the points, None if not solved.

    size : whether the numbers are never negative
    """
    with np.errstate(invalid="ignore", divide="ignore"):
        found = resample(lambda sample: {"": statistic(sample)}, fine)[""].estimated
        grid = np.full(np.shape(found.value), nan) if coarse is None else np.abs(statistic(coarse) - found.value)
    value, low, high = found.size() if size else (found.value, *found.interval())
    return Compared(value, low, high, grid, fine.drawn, found.parts)


def failures(dataset: xarray.Dataset) -> DataFrame:
    """Solves that failed: grid, speed, load or depth, draw and reason."""
    frame = dataset[["status", "reason"]].to_dataframe().reset_index()
    return frame[frame["status"] == FAILED].drop(columns=["status", "points"], errors="ignore")


def touches(dataset: xarray.Dataset) -> np.ndarray:
    """Whether anything touches on the fine grid (S, P)."""
    return _over_draws(dataset["status"].sel(level=FINE) != EMPTY, "any")


def interval(dataset: xarray.Dataset, above: str, below: str | None = None, size: bool = False) -> Interval:
    """Mean over draws of a variable, or ratio of two means, on the fine grid at every speed, and load or depth.

    size : whether the variable is never negative
    """
    ordered = dataset.transpose("speed", pressed(dataset), ...)
    found = {name: estimated(ordered.sel(level=name), above, below) for name in ordered["level"].values.tolist()}
    fine = found[FINE]
    # A model without points has no error of a grid.
    unknown = 0.0 if "points" in dataset.coords and not dataset["points"].values.any() else nan
    grid = np.abs(fine.value - found[COARSE].value) if COARSE in found else unknown
    return Interval.of(fine, grid, size)


def _most_drawn(dataset):
    """Draws of one grid: all of them, or those of the stratum that is solved on the coarsest grid alone."""
    if "stratum" not in dataset.coords:
        return dataset.sel(level=FINE)
    return dataset.isel(level=-1, surface=np.flatnonzero(dataset["stratum"] == dataset.sizes["level"] - 1))


def _over_draws(array, how):
    """A number over the draws of each point (S, P); that of the point where there are none."""
    array = array.transpose("speed", ...)
    return (getattr(array, how)("surface") if "surface" in array.dims else array).values
