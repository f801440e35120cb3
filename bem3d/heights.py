"""Heights of a scene on a grid, as input for another contact code."""

from dataclasses import dataclass, replace

import numpy as np

from scene import Plane, Program, Scene

from . import window
from .grid import Grid
from .problem import Problem
from .response.engine import Engine


@dataclass(frozen=True, eq=False)
class Heights:
    """Indenter and roughness on a grid of square pixels.

    x, y : centres of the pixels (N,), (M,) [m], from the axis of the indenter; M is N, or 1 where nothing varies
        along y
    height : above the macroscopic tip, away from the elastomer (M, N) [m], rows along y; of a Plane the roughness,
        of zero mean over its period, which the grid spans
    pixel : spacing of the grid [m]
    """

    x: np.ndarray
    y: np.ndarray
    height: np.ndarray
    pixel: float


def heights(scene: Scene, points: int, extent: float | None = None) -> Heights:
    """Heights of indenter and roughness on the grid of `BEM`.

    points : along each side of the grid

    extent : side of the grid [m], around the axis of the indenter. Without it, of a Plane the period of its
        roughness; of other bodies a square around the contact, for which a few coarse contacts are solved

    Raises SolveError where the grid cannot carry the roughness.
    """
    if isinstance(scene.motion, Program):
        scene = replace(scene, motion=scene.motion.held)
    problem = Problem(scene, Engine())
    if isinstance(scene.indenter, Plane):
        extent = scene.roughness.period
    if extent is None:
        grid = window.fitted(problem, points).grid(points, problem.width)
    else:
        grid = Grid(points, extent, width=problem.width)
    window.check_waves(scene, grid, extent)
    return Heights(grid.x, grid.y, problem.heights(grid, problem.surface(grid)), grid.pixel)
