"""Numbers of surfaces for intervals of a wanted width, from what scatters and what costs, at few looks.

The least cost of a variance sum s_k^2 / n_k has n_k as s_k / sqrt(c_k), with s_k the scatter of one surface of a
stratum and c_k its planned cost (Giles, Oper. Res. 56, 607, 2008): never a measured time, so that equal seeds give
equal numbers on every machine. Sampling stops when every interval is as narrow as wanted (Chow and Robbins, Ann.
Math. Stat. 36, 457, 1965). A pilot large enough to show the scatter, and few looks, each after as many surfaces as
the last one asked for, keep the level; the tests measure it.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil, nan

import numpy as np
import xarray

from ..solving.parameter_grid import TOGETHER
from .jackknife import mean_ratio
from .levels import pooled

PILOT, DIFFERENCES = 32, 8  # surfaces on the coarsest grid, and of each difference, before anything is decided
GROWTH = 4  # times the surfaces at most from one look to the next: the scatter of few is known roughly
MARGIN = 1.1  # surfaces beyond those that just suffice: they spare most of the second looks
OWN_SHARE = 0.5  # of the wanted width that is left to the scatter at least, however much the grid takes


@dataclass(frozen=True)
class Needed:
    """Numbers of surfaces of each stratum, the finest first.

    counts : that are asked for next
    widest : half-width of the widest interval so far, relative; NaN where one is not known
    """

    counts: tuple[int, ...]
    widest: float


def pilot(grids: int) -> tuple[int, ...]:
    """Numbers of surfaces before anything is known of their scatter."""
    return (DIFFERENCES,) * (grids - 1) + (PILOT,)


def needed(
    dataset: xarray.Dataset, numbers: Sequence[tuple[str, str | None]], costs: Sequence[float], interval: float
) -> Needed:
    """Surfaces for intervals of 95 % of a half-width at every point, relative; as many as now once it is reached.

    dataset : like that of `levels.pooled`
    numbers : means of variables, or ratios of two
    costs : planned of one surface of each stratum, on all of its grids
    """
    strata = dataset["stratum"].values
    now = np.bincount(strata, minlength=len(costs))
    both, cost, asked, widest = pooled(dataset), np.sqrt(costs), np.zeros(now.size), 0.0
    for above, below in numbers:
        # A model without another grid has no error of it.
        fine, coarse = (_columns(both.isel(grid=k), above, below) for k in (0, -1))
        found, other = (mean_ratio(over, under, strata) for over, under in (fine, coarse))
        low, high = found.interval()
        size = np.abs(found.value)
        with np.errstate(invalid="ignore", divide="ignore"):
            scatter, grid = (high - low) / 2 / size, np.abs(other.value - found.value) / size
            least = np.maximum(interval - grid, OWN_SHARE * interval)
            left = (fine[0] - found.value[..., None] * fine[1]) / np.mean(fine[1], axis=-1, keepdims=True)
            parts = np.array([np.nansum(np.square(left[..., strata == k]), axis=-1) for k in range(now.size)])
            # Standard deviation of one surface of each stratum, over that of the mean.
            share = np.sqrt(parts / parts.sum(axis=0) * now.reshape(-1, *(1,) * size.ndim))
            by_cost = cost.reshape(-1, *(1,) * size.ndim)
            needs = share / by_cost * np.sum(share * by_cost, axis=0) * np.square(scatter / least)
        wide = ~(scatter + grid <= interval)
        asked = np.maximum(
            asked, np.max(np.where(wide, np.nan_to_num(needs), 0.0), axis=tuple(range(1, size.ndim + 1)))
        )
        widest = max(widest, float(np.max(scatter + grid))) if np.all(np.isfinite(scatter + grid)) else nan
    if not asked.any():
        return Needed(tuple(now.tolist()), widest)
    counts = [
        max(had, min(TOGETHER * ceil(MARGIN * more / TOGETHER), GROWTH * had))
        for had, more in zip(now.tolist(), asked.tolist(), strict=True)
    ]
    return Needed(tuple(counts), widest)


def _columns(dataset, above, below):
    over = dataset[above].transpose(..., "seed").values
    return over, np.ones_like(over) if below is None else dataset[below].transpose(..., "seed").values
