"""The surface around a solved contact and behind it, evaluated from its pressure; nothing is solved.

A steady contact leaves a wake that recovers over the way the elastomer moves within its times of retardation, and
a grid fitted to the contact ends before that. Beyond it nothing is pressed, so that the displacement there is the
same convolution on a longer piece of surface.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from scene import Plane, Program, Scene, SolveError

from ..grid import Grid, Piece
from ..problem import Problem

AGREEMENT = 1e-3  # of the gap at a pixel and what displacements span: as well the pressure displaces the surface


@dataclass(frozen=True)
class Surroundings:
    """Surroundings of a contact: arrays (M, N) in m on rectangular pixels.

    x, y : centres of the pixels (N,), (M,), along and across the flow from the indenter's axis
    lag : how far downstream of them indenter and surface are seen, less than a pixel
    indenter : z of its surface, roughness included, from the macroscopic tip
    displacement : of the elastomer's surface, > 0 into the elastomer
    depth : of the macroscopic tip below the undeformed surface; NaN where nothing presses
    """

    x: np.ndarray
    y: np.ndarray
    lag: float
    indenter: np.ndarray
    displacement: np.ndarray
    depth: float

    @property
    def gap(self) -> np.ndarray:
        """Between indenter and elastomer; zero in contact."""
        return self.displacement + self.indenter - self.depth


def surroundings(
    solver,
    scene: Scene,
    fields: Mapping[str, np.ndarray],
    upstream: float = 0.0,
    downstream: float = 0.0,
    aside: float = 0.0,
) -> Surroundings:
    """Surface and indenter on the grid of an answer and beyond.

    solver, scene : the `BEM` that answered, and what; of a contact heated by its friction the scene as warm as it
        has become
    fields : of the answer: x, y, pressure, gap and, of a Program, depth and surface_displacement
    upstream, downstream, aside : lengths [m] by which it reaches beyond the grid, along -x, x and both ways of y;
        a Plane repeats and ends with its cell, and what a Program has done elsewhere is not in its last pressure:
        both have what is on the grid

    Raises SolveError where the pressure does not displace the surface of this scene as the gap says.
    """
    if isinstance(scene.motion, Program):
        return _at_the_end(solver, scene, fields)
    problem, grid = Problem(scene, solver.engine, solver.terms), _grid_of(fields)
    if grid.shape[0] == 1:
        grid, aside = Grid(grid.points, grid.extent, grid.centre, problem.width), 0.0
    left, right, sides = (int(np.ceil(length / grid.pixel)) for length in (upstream, downstream, aside))
    if isinstance(scene.indenter, Plane):
        left = right = sides = 0
    piece = _extended(grid, left, right, sides)
    pressure = np.pad(fields["pressure"] / problem.flow.modulus, ((sides, sides), (left, right)))
    displacement = problem.medium.operator(piece)(pressure) * grid.pixel
    lag = problem.flow.collocation(grid)
    indenter = problem.heights(piece, problem.surface(grid), lag)
    inside = slice(sides, sides + grid.rows), slice(left, left + grid.points)
    depths = (displacement + indenter)[inside] - fields["gap"]
    # Only in contact is the depth known to all digits: a blunt body is many orders higher at the corners.
    depth = float(np.mean(depths[fields["pressure"] > 0]))
    apart, least = np.abs(depths - depth), np.ptp(displacement[inside])
    if not (apart <= AGREEMENT * (least + np.abs(fields["gap"]))).all():
        raise SolveError(
            f"the pressure displaces the surface of this scene other than by the gap, by {apart.max():g} m: it is "
            "the answer to another one"
        )
    return Surroundings(piece.x, piece.y, lag, indenter, displacement, depth)


def heights(solver, scene: Scene, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """z [m] of the indenter of an answer (M, N) at places x (N,), y (M,) [m], as close together as its pixels."""
    held = replace(scene, motion=scene.motion.held) if isinstance(scene.motion, Program) else scene
    surface = Problem(held, solver.engine, solver.terms).surface(_grid_of({"x": x, "y": y}))
    macroscopic = scene.indenter.height(x[None, :], y[:, None])
    return macroscopic if surface is None else macroscopic + surface.heights(x, y)


def _at_the_end(solver, scene, fields):
    """Surface at the end of a program, on the grid."""
    indenter, displacement = heights(solver, scene, fields["x"], fields["y"]), fields["surface_displacement"]
    touched = fields["pressure"] > 0
    depths = (displacement + indenter - fields["gap"])[touched]
    depth = float(np.mean(depths)) if touched.any() else float(fields["depth"][-1])
    return Surroundings(fields["x"], fields["y"], 0.0, indenter, displacement, depth)


def _grid_of(fields):
    x, y = fields["x"], fields["y"]
    pixel = float(x[-1] - x[0]) / (len(x) - 1)
    centre = float(x[0] + x[-1]) / 2, float(y[0] + y[-1]) / 2
    return Piece(len(x), pixel * len(x), centre, lines=len(y))


def _extended(grid, left, right, aside):
    """Grid with this many more pixels on its sides."""
    points = grid.points + left + right
    x, y = grid.centre
    return Piece(
        points,
        grid.pixel * points,
        (x + (right - left) / 2 * grid.pixel, y),
        grid.width,
        lines=grid.rows + 2 * aside,
    )
