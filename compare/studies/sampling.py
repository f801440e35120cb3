"""Rough contacts in strata: many surfaces on coarse grids, few on finer ones, as an interval is wanted."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import islice

from ..models.table import Models
from ..solving.parameter_grid import LEVELS, ParameterGrid, on_levels, pilot, width


def levels(models: Models, grids: Sequence[ParameterGrid], most: int = len(LEVELS)) -> dict[str, dict]:
    """Grids of each model, halved as long as they can solve all of some parameter grids, at most so many."""
    corners = sorted((corner for each in grids for corner in each.corners), key=lambda each: -width(each))
    return {each.name: on_levels(each.solver, corners, most) for each in models}


def in_strata(
    grids: Sequence[ParameterGrid], models: Models, strata: Mapping[str, tuple[int, ...]], most: int = len(LEVELS)
) -> list[ParameterGrid]:
    """Parameter grids that share their surfaces, on all grids that hold them.

    strata : numbers of surfaces on each grid, by model; those of a pilot where absent. Fewer numbers than grids
        leave out the coarsest
    most : grids
    """
    found = levels(models, grids, most)
    drawn = {each.name: strata.get(each.name, pilot(len(found[each.name]))) for each in models.drawn}
    kept = {name: dict(islice(each.items(), len(drawn.get(name, each)))) for name, each in found.items()}
    return [replace(each, grids=kept, draws={**each.draws, **drawn}) for each in grids]
