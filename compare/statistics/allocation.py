"""Numbers of surfaces for intervals of a wanted width, from what scatters and what costs, at few looks.

The least cost of a variance sum s_k^2 / n_k has n_k as s_k / sqrt(c_k), with s_k the scatter of one surface of a
stratum and c_k its planned cost (Giles, Oper. Res. 56, 607, 2008): never a measured time, so that equal seeds give
equal numbers on every machine. Sampling stops when every interval is as narrow as wanted (Chow and Robbins, Ann.
Math. Stat. 36, 457, 1965). A pilot large enough to show the scatter, and few looks, each after as many surfaces as
the last one asked for, keep the level; the tests measure it.
"""

from collections.abc import Sequence
from math import ceil
from typing import NamedTuple

import numpy as np
import xarray

from ..solving.cost import MOST_DRAWS
from ..solving.parameter_grid import TOGETHER
from .jackknife import mean_ratio, off_the_ratio
from .levels import pooled

PILOT, DIFFERENCES = 32, 8  # surfaces on the coarsest grid, and of each difference, before anything is decided
GROWTH = 4  # times the surfaces at most from one look to the next: the scatter of few is known roughly
MARGIN = 1.1  # surfaces beyond those that just suffice: they spare most of the second looks
OWN_SHARE = 0.5  # of the wanted width that is left to the scatter at least, however much the grid takes


class Enough(NamedTuple):
    """Surfaces that just suffice at every point (...), NaN where that is not known.

    surfaces : of each stratum (K, ...)
    scatter : half-width of the interval of 95 % with those that are there, relative
    grid : what half the points change, relative, which adds to it
    """

    surfaces: np.ndarray
    scatter: np.ndarray
    grid: np.ndarray


def pilot(grids: int) -> tuple[int, ...]:
    """Numbers of surfaces before anything is known of their scatter."""
    return (DIFFERENCES,) * (grids - 1) + (PILOT,)


def needed(
    dataset: xarray.Dataset, above: str, below: str | None, costs: Sequence[float], interval: float
) -> tuple[int, ...]:
    """Surfaces of each stratum for intervals of 95 % of a half-width, relative; as many as now once it is reached.

    What is nil or not known asks for none. Of no stratum there are more than MOST_DRAWS.

    dataset : like that of `levels.pooled`
    above, below : variable whose mean is wanted at every point, over the mean of another if that is named
    costs : planned of one surface of each stratum, on all of its grids
    """
    now = np.bincount(dataset["stratum"].values, minlength=len(costs))
    needs, scatter, grid = enough(dataset, above, below, costs, interval)
    asked = np.where((scatter + grid > interval) & np.isfinite(needs), needs, 0.0)
    return tuple(
        min(max(had, min(rounded(more), GROWTH * had)), MOST_DRAWS)
        for had, more in zip(now.tolist(), asked.reshape(now.size, -1).max(axis=1).tolist(), strict=True)
    )


def rounded(surfaces: float) -> int:
    """Surfaces that are solved where so many just suffice."""
    return TOGETHER * ceil(MARGIN * surfaces / TOGETHER)


def enough(
    dataset: xarray.Dataset, above: str, below: str | None, costs: Sequence[float], interval: float
) -> Enough:
    """Surfaces of each stratum that just suffice for such intervals, at the least cost; see `needed`."""
    strata, both = dataset["stratum"].values, pooled(dataset)
    now = np.bincount(strata, minlength=len(costs))
    # A model without another grid has no error of it.
    fine, coarse = (_columns(both.isel(grid=k), above, below) for k in (0, -1))
    found, other = (mean_ratio(over, under, strata) for over, under in (fine, coarse))
    low, high = found.interval()
    size, squares = np.abs(found.value), np.square(off_the_ratio(*fine)[1])
    by_cost, drawn = (np.reshape(each, (-1, *(1,) * size.ndim)) for each in (np.sqrt(costs), now))
    with np.errstate(invalid="ignore", divide="ignore"):
        scatter, grid = (high - low) / 2 / size, np.abs(other.value - found.value) / size
        parts = np.array([squares[..., strata == k].sum(axis=-1) for k in range(now.size)])
        # Standard deviation of one surface of each stratum, over that of the mean.
        share = np.sqrt(parts / parts.sum(axis=0) * drawn)
        least = np.maximum(interval - grid, OWN_SHARE * interval)
        needs = share / by_cost * np.sum(share * by_cost, axis=0) * np.square(scatter / least)
    return Enough(needs, scatter, grid)


def _columns(dataset, above, below):
    over = dataset[above].transpose(..., "seed").values
    return over, np.ones_like(over) if below is None else dataset[below].transpose(..., "seed").values
