"""Theories that stand beside the models where nobody asks for them: solved, stored and drawn, not judged."""

from collections.abc import Sequence
from dataclasses import replace

from scene import SolveError
from scene.protocol import trusted, why_not

from ..models.law.persson import Persson
from ..models.table import Model
from ..solving.parameter_grid import FINE, ParameterGrid
from ..trustmap.friction_law import FrictionLaw

THEORY, LAW = THEORIES = Persson(), FrictionLaw()


def with_theory(grid: ParameterGrid, theories: Sequence[Persson | FrictionLaw] = (THEORY,)) -> ParameterGrid:
    """A rough parameter grid with theories beside the models, those that are none of them and answer all of it."""
    if grid.scene.roughness is None or grid.scene.roughness.flat:
        return grid
    beside = {each.name: {FINE: each} for each in theories if each.name not in grid.grids and _answers(each, grid)}
    return replace(grid, grids={**grid.grids, **beside}) if beside else grid


def _answers(theory, grid):
    """Whether a theory answers a parameter grid; not where its numbers are too far apart, which others tell."""
    motion = grid.scene.motion
    if not Model.of(theory).tells(motion.pressed_by, motion.speed > 0):
        return False
    try:
        with trusted():
            return not any(why_not(theory, scene) for scene in grid.corners)
    except SolveError:
        return False
