"""A theory that is drawn beside the models where nobody asks for it: solved and stored with them, not judged."""

from dataclasses import replace

from scene import SolveError
from scene.protocol import trusted, why_not

from ..models.law.persson import Persson
from ..solving.parameter_grid import FINE, ParameterGrid

THEORY = Persson()


def with_theory(grid: ParameterGrid) -> ParameterGrid:
    """A rough parameter grid with the theory beside the models, if it is none of them and answers all of it."""
    rough = grid.scene.roughness is not None and not grid.scene.roughness.flat
    if not rough or THEORY.name in grid.grids or not _answers(grid):
        return grid
    return replace(grid, grids={**grid.grids, THEORY.name: {FINE: THEORY}})


def _answers(grid):
    """Whether the theory answers a parameter grid; not where its numbers are too far apart, which others tell."""
    try:
        with trusted():
            return not any(why_not(THEORY, scene) for scene in grid.corners)
    except SolveError:
        return False
