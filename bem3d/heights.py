"""Heights of a scene on a grid, as input for another contact code."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from scene import Elastic, Indent, Measured, Plane, Program, Result, Scene, Topography
from scene.quantities import PASCAL, takes

from . import window
from .grid import Grid
from .problem import Problem
from .response.engine import Engine
from .solver import BEM


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


@takes(modulus=PASCAL)
def press(
    heights: Any,
    pixel: Any,
    modulus: float,
    *,
    pressure: Any = None,
    gap: Any = None,
    load: Any = None,
    depth: Any = None,
    unit: str | None = None,
    **settings: Any,
) -> Result:
    """Press a rigid surface, given by its heights, into an elastic half-space.

    heights : of the surface (M, N) [m], rows along y; the highest point touches first
    pixel : side of a pixel [m]
    modulus : contact modulus E* = E / (1 - nu^2) [Pa]
    pressure, gap : mean pressure [Pa] or mean gap [m] of a plane, which repeats beyond the map
    load, depth : load [N] or depth [m] of a body that ends where the map does, free of images
    unit : of the heights, "um" for example; absent, metres
    settings : of `BEM`; absent, the pixels of a square map are those of the grid

    One of pressure, gap, load and depth is given. Returns a Result with the fields pressure [Pa], gap and
    height [m] on the grid, and the measure contact_area [m^2]; a plane also has contact_fraction,
    mean_pressure and mean_gap. Raises InvalidInput; Refused, also of a plane that is no square; and SolveError.

    >>> import numpy as np
    >>> from bem3d import press
    >>> wave = np.cos(2 * np.pi * np.arange(32) / 32) * np.ones((32, 1))
    >>> answer = press(wave, unit="um", pixel="1 um", modulus="1 MPa", pressure="0.15 MPa")
    >>> print(f"{answer.measures['contact_fraction']:.0%}, {answer.fields['pressure'].max():.4g} Pa")
    100%, 2.482e+05 Pa
    """
    motion, free = Indent(pressure=pressure, gap=gap, load=load, depth=depth), pressure is gap is None
    read: dict[str, Any] = {"heights": heights, "pixel": pixel, "unit": unit}
    surface = Measured(**read) if free else Topography(**read, repeat="periodic", level="mean")
    grid = {"points": max(surface.heights.shape), "extent": max(surface.size) if free else None}
    placed: Any = (surface, None) if free else (Plane(), surface)
    return BEM(**(grid | settings)).solve(Scene(placed[0], Elastic(modulus / 4), motion, placed[1]))
