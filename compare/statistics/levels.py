"""Means over many surfaces on coarse grids and few on finer ones, as draws of one grid (multilevel Monte Carlo).

The mean on the finest grid is that on the coarsest plus that of each difference between neighbouring grids, each
over surfaces of its own (Giles, Oper. Res. 56, 607, 2008), whatever the coarser grids answer: where one has no
answer to a surface, that of the next finer grid stands in its place, in both strata. Statistics ask for
draws of one grid: each surface is one that lies off this mean by as much as it moves it, so that mean, scatter and
skewness of these draws are those of the sum. A stratum holds the surfaces of one difference, for Welch's degrees
of freedom.

Where moments of a known mean, nil, go with the surfaces on the coarsest grid, a regression takes their part out of
the scatter (Lavenberg and Welch, Manage. Sci. 27, 322, 1981).
"""

import numpy as np
import xarray

from ..solving.parameter_grid import EMPTY

# What is spent or left over on a grid, and is no number of the contact.
SPENT = "seconds", "operator_applications", "residual"

MOMENTS = "local_moments"
EACH = 4  # surfaces for each moment at least: what a regression leaves of few surfaces is known roughly
ALIKE = 1e-8  # of a size, within which numbers are alike: they tell nothing apart


def pooled(dataset: xarray.Dataset) -> xarray.Dataset:
    """Draws of the fine and of the coarse grid from those of all grids; one without a stratum is returned.

    dataset : grids from fine to coarse; draws of stratum k have answers on the grids k and k + 1, if there is one.
        `local_moments` of the draws on the coarsest grid, if it has them, are left out of what is returned
    """
    if "stratum" not in dataset.coords:
        return dataset
    moments = dataset.get(MOMENTS)
    dataset = dataset.drop_vars(MOMENTS, errors="ignore")
    if "status" in dataset and "friction_force" in dataset:
        # What does not touch adds nothing to either force.
        dataset = dataset.assign(friction_force=dataset["friction_force"].where(dataset["status"] != EMPTY, 0.0))
    drawn = {name: each for name, each in dataset.data_vars.items() if "seed" in each.dims and name not in SPENT}
    numbers = [name for name, each in drawn.items() if each.dtype.kind == "f"]
    strata = dataset["stratum"].values
    made = {}
    for name in numbers:
        ordered = dataset[name].transpose("grid", ..., "seed")
        values = _answered(ordered.values, strata)
        if moments is not None:
            rows = np.flatnonzero(strata == len(values) - 1)
            controls = moments.transpose(*ordered.dims[1:], "moment").values[..., rows, :]
            values[-1][..., rows] = controlled(values[-1][..., rows], controls)
        made[name] = np.stack([_draws(values, strata, first) for first in range(len(values))[:2]])
    both = dataset.isel(grid=slice(2))
    dims = {name: [each for each in dataset[name].dims if each not in ("grid", "seed")] for name in numbers}
    return both.assign(
        {name: (("grid", *dims[name], "seed"), each, dataset[name].attrs) for name, each in made.items()}
    )


def controlled(values: np.ndarray, moments: np.ndarray) -> np.ndarray:
    """Values (..., n) less what moments (..., n, K) of mean nil tell of each, by least squares a point.

    The slopes for a value are those of all others, so that the mean has no bias (Avramidis and Wilson, Oper. Res.
    Lett. 14, 187, 1993), and the scatter that is left has the errors of the slopes in it. NaN is left
    out, and stays. Where there are fewer than 4 values for each moment, the first moments alone are used.
    """
    known = np.isfinite(values)
    count = known.sum(axis=-1, keepdims=True)
    used = known[..., None] & (np.arange(moments.shape[-1]) < count[..., None] // EACH)
    with np.errstate(invalid="ignore", divide="ignore"):
        mean = np.where(known, values, 0.0).sum(axis=-1, keepdims=True) / count
        middle = np.where(used, moments, 0.0).sum(axis=-2, keepdims=True) / count[..., None]
        about = np.where(used, moments - middle, 0.0)
        size = np.sqrt(np.square(about).sum(axis=-2, keepdims=True))
        told = size > ALIKE * np.abs(middle)
        about, middle = (np.where(told, each / size, 0.0) for each in (about, middle))
        apart, strength, turn = np.linalg.svd(about, full_matrices=False)
        apart = np.where((strength > ALIKE)[..., None, :], apart, 0.0)
        shift = np.where(strength > ALIKE, (turn @ np.swapaxes(middle, -1, -2))[..., 0] / strength, 0.0)
        answers = np.where(known, values - mean, 0.0)
        slopes = np.sum(apart * answers[..., None], axis=-2, keepdims=True)
        rest = answers - np.sum(apart * slopes, axis=-1)
        # What a value moves the slopes by: its distance from the plane through all others.
        moved = rest / np.maximum(1 - np.sum(np.square(apart), axis=-1) - 1 / count, ALIKE)
        others = slopes - apart * moved[..., None]
        told_of_it = np.sum((apart + shift[..., None, :]) * others, axis=-1)
    return np.where(known, values - told_of_it, values)


def _answered(values, strata):
    """Values (grids, ..., seeds) where the next finer grid answers for one that has no answer to a draw."""
    found = values.copy()
    for grid in range(1, len(values)):
        asked = (strata == grid) | (strata == grid - 1)
        found[grid] = np.where(np.isfinite(found[grid]) | ~asked, found[grid], found[grid - 1])
    return found


def _draws(values, strata, first):
    """Draws (..., seeds) whose mean is that on one grid: a surface for each, NaN where it has no answer.

    NaN too where a stratum has fewer than two, which tell no scatter.

    values : (grids, ..., seeds); first : number of the grid
    """
    mean, changes = 0.0, np.zeros(values.shape[1:])
    known = np.zeros(values.shape[1:], bool)
    for stratum in range(len(values)):
        rows = np.flatnonzero(strata == stratum)
        if stratum < first:  # of finer grids nothing is seen
            known[..., rows] = np.isfinite(values[stratum + 1][..., rows])
            continue
        part = values[stratum][..., rows]
        if stratum + 1 < len(values):
            part = part - values[stratum + 1][..., rows]
        here = np.isfinite(part)
        count = here.sum(axis=-1, keepdims=True)
        with np.errstate(invalid="ignore", divide="ignore"):
            middle = np.where(here, part, 0.0).sum(axis=-1, keepdims=True) / count
            # Fewer surfaces move the mean by more each.
            weight = 1 / np.sqrt(count * (count - 1.0))
        middle = np.where(count > 1, middle, np.nan)
        changes[..., rows] = np.where(here, weight * (part - middle), 0.0)
        known[..., rows] = here
        mean = mean + middle[..., 0]
    total = known.sum(axis=-1, keepdims=True)
    return np.where(known, np.expand_dims(mean, -1) + np.sqrt(total * (total - 1.0)) * changes, np.nan)
