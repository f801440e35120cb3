"""Rough contacts in strata: many surfaces on coarse grids, few on finer ones, as an interval is wanted."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import islice
from typing import TYPE_CHECKING

from ..models.table import Models
from ..solving.parameter_grid import LEVELS, Instead, ParameterGrid, on_levels, pilot, width

if TYPE_CHECKING:
    import xarray

# Means over draws: of a variable, or of one over another.
MEANS = {
    "friction_coefficient": ("friction_force", "normal_force"),
    "normal_force": ("normal_force", None),
    "depth_reached": ("depth_reached", None),
}
WORDS = {"friction_coefficient": "friction", "normal_force": "force", "depth_reached": "depth"}


def wanted(prescribed: str, speeds: tuple[float, ...], slides: bool) -> Iterator[tuple[str, tuple[float, ...]]]:
    """Names of the means that an interval is asked for, with their speeds: what is not prescribed, and friction.

    slides : whether there is friction to speak of
    """
    yield "normal_force" if prescribed == "depth" else "depth_reached", speeds
    if slides:
        yield "friction_coefficient", tuple(speed for speed in speeds if speed > 0)


def levels(models: Models, grids: Sequence[ParameterGrid], most: int = len(LEVELS)) -> dict[str, dict]:
    """Grids of each model, halved as long as they can solve all of some parameter grids, at most so many."""
    corners = sorted((corner for each in grids for corner in each.corners), key=lambda each: -width(each))
    return {each.name: on_levels(each.solver, corners, most) for each in models}


def in_strata(
    grids: Sequence[ParameterGrid],
    models: Models,
    strata: Mapping[str, tuple[int, ...]],
    most: int = len(LEVELS),
    least: Mapping[str, int] = {},
) -> list[ParameterGrid]:
    """Parameter grids that share their surfaces, on all grids that hold them.

    strata : numbers of surfaces on each grid, by model; those of a pilot where absent. Fewer numbers than grids
        leave out the coarsest
    most : grids
    least : numbers of surfaces of a pilot on the coarsest grid, by model, where more than usual are wanted
    """
    found = {name: own for name, own in levels(models, grids, most).items() if name in grids[0].grids}
    drawing = [each.name for each in models.drawn if each.name in found]
    first = {name: pilot(len(found[name]), least.get(name, 0)) for name in drawing}
    drawn = {name: strata.get(name, counts) for name, counts in first.items()}
    kept = {name: dict(islice(each.items(), len(drawn.get(name, each)))) for name, each in found.items()}
    return [replace(each, grids=kept, draws={**each.draws, **drawn}) for each in grids]


def answered(grids: Mapping[str, ParameterGrid], instead: Mapping[str, frozenset]) -> dict[str, ParameterGrid]:
    """Parameter grids with the contacts that finer grids answer, by the name of the parameter grid."""
    made = {name: replace(grids[name], instead=contacts) for name, contacts in instead.items()}
    return {**grids, **made}


def unanswered(grids: Mapping[str, ParameterGrid], answers: xarray.DataTree) -> dict[str, frozenset[Instead]]:
    """Contacts that a grid of a stratum has no answer to, by the name of the parameter grid; none without any."""
    found = {}
    for name, each in grids.items():
        own = {solver: answers[f"{name}/{solver}"].to_dataset(inherit=False) for solver in each.grids}  # type: ignore
        if contacts := each.unanswered(own):
            found[name] = contacts
    return found
