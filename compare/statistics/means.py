"""Means over draws at every point of a Dataset, with intervals of 95 %."""

from __future__ import annotations

from dataclasses import replace
from math import nan
from typing import TYPE_CHECKING

import numpy as np

from ..solving.curve import EMPTY, FAILED, FINE
from .intervals import Estimated
from .jackknife import estimated
from .multilevel import MEANS, pooled

if TYPE_CHECKING:
    import xarray
    from pandas import DataFrame

# Means with an interval; and means alone, of numbers that are never negative.
ESTIMATED = ("normal_force", "depth_reached", "friction_force", "friction_coefficient", "rms_slope", "contact")
AVERAGED = ("friction_spread", "pixel", "points_across_contact")
# Never negative: their intervals are those of their logarithms.
SIZES = ("rms_slope",)
ENDS = "_mean", "_low", "_high"
# Ends of the interval that a model states of its own coefficient of friction.
STATED = "friction_low", "friction_high"


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


def means(dataset: xarray.Dataset) -> DataFrame:
    """A row for each speed, and load or depth, on the fine grid.

    Each mean has an interval of 95 % that counts scatter and grid.
    """
    from pandas import MultiIndex

    every, prescribed = with_spread(dataset), pressed(dataset)
    dataset = pooled(every)
    fine = dataset.sel(level=FINE)
    places = [fine["speed"].values, fine[prescribed].values]
    columns: dict[str, np.ndarray] = {}
    for name in ESTIMATED:
        above, below = MEANS.get(name, (name, None))
        if above not in fine:
            continue
        ends = interval(dataset, above, below, name in SIZES).ends
        columns |= {f"{name}{end}": each for end, each in zip(ENDS, ends, strict=True)}
    columns |= {name: interval(dataset, name, size=True).ends[0] for name in AVERAGED if name in fine}
    columns |= {
        "residual": _over_draws(fine["residual"], "max"),
        "seconds": _over_draws(fine["seconds"], "sum"),
        "surfaces": _over_draws(fine["normal_force"].notnull(), "sum"),
        "failures": _over_draws(fine["status"] == FAILED, "sum"),
    }
    found = MultiIndex.from_product(places, names=["speed", prescribed]).to_frame(index=False)
    found.insert(0, "points", int(fine["points"]))
    return found.assign(**{name: np.ravel(values) for name, values in columns.items()})


def failures(dataset: xarray.Dataset) -> DataFrame:
    """Solves that failed: grid, speed, load or depth, draw and reason."""
    frame = dataset[["status", "reason"]].to_dataframe().reset_index()
    return frame[frame["status"] == FAILED].drop(columns=["status", "points"], errors="ignore")


def touches(dataset: xarray.Dataset) -> np.ndarray:
    """Whether anything touches on the fine grid (S, P)."""
    return _over_draws(dataset["status"].sel(level=FINE) != EMPTY, "any")


def interval(dataset: xarray.Dataset, above: str, below: str | None = None, size: bool = False) -> Estimated:
    """Mean over draws of a variable, or ratio of two means, on the fine grid at every speed, and load or depth.

    Its grid counts the interval of friction that a model states of its own.

    size : whether the variable is never negative
    """
    ordered = dataset.transpose("speed", pressed(dataset), ...)
    fine, *others = (estimated(ordered.sel(level=name), above, below) for name in ordered["level"].values.tolist())
    # A model without points has no error of a grid.
    grid = 0.0 if "points" in dataset.coords and not dataset["points"].values.any() else nan
    for coarse in others:
        grid = np.abs(fine.value - coarse.value)
    if (upper := at_upper_end(ordered.sel(level=FINE))) is not None:
        grid = grid + np.abs(estimated(upper, above, below).value - fine.value)
    return replace(fine, grid=grid, size=size)


def at_upper_end(dataset: xarray.Dataset) -> xarray.Dataset | None:
    """Answers with friction at the upper end of the interval that their model states of it; None without one."""
    if not {*STATED, "friction_force"} <= set(dataset.variables):
        return None
    half = (dataset["friction_high"] - dataset["friction_low"]).fillna(0.0) / 2
    half = half.mean("surface") if "surface" in half.dims else half
    return dataset.assign(friction_force=dataset["friction_force"] + half * dataset["normal_force"])


def _over_draws(array, how):
    """Statistic over the draws of each point (S, P); the value of the point where there are no draws."""
    array = array.transpose("speed", ...)
    return (getattr(array, how)("surface") if "surface" in array.dims else array).values
