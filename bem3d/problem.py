"""A scene on grids: heights and operators on each, and the way from the coarsest grid to the finest."""

from dataclasses import dataclass, replace
from math import nan
from typing import Any

import numpy as np

from scene import CrossedWaves, Cylinder, EmptyContact, Measured, Plane, Result, Scene, SolveError, Wave
from scene.scales import elastic_contact
from scene.terms import Table, terms_of

from .contact import activeset, sums
from .grid import Grid
from .motion.steady import Flow
from .response.engine import Engine
from .response.halfspace import Cell, HalfSpace, Line
from .response.medium import Foundation, HalfSpaceKernel
from .surface import RoughSurface
from .terms import TERMS

LEAST_ON_A_ROW = 1e-7  # tolerance of sliding lines: next to nothing is felt of a fast contact's edges in the gap
COARSEST = 32  # points a side from which a solve starts, or all there are below twice as many
GUESSED = 1 / 64  # of the pixels: in contact to begin with, where nothing is known of the body
COARSE_TOLERANCE = 1e-5  # on all grids but the finest: a set of contact right to the pixel pays on the next


class Unseen(SolveError):
    """A smooth contact lies between the centres of pixels; its forces are not zero."""


def row_width(scene: Scene) -> float | None:
    """Width of the single row of pixels [m] that stands for a contact alike all along y; else None."""
    match scene:
        case Scene(indenter=Cylinder()):
            return 1.0  # forces are per metre
        case Scene(indenter=Plane(), roughness=Wave() as wave) if not isinstance(wave, CrossedWaves):
            return wave.period
        case _:
            return None


def _medium(indenter, flow, engine):
    match indenter:
        case Plane():
            return Cell(flow, engine)
        case Cylinder(radius=radius):
            return Line(flow, engine, HalfSpaceKernel(datum=radius))
        case _:
            return HalfSpace(flow, engine)


@dataclass(frozen=True, eq=False)
class Start:
    """A solved contact from which the next solve starts: on another grid, or of a neighbouring scene.

    pressure : in units of the relaxed E* (rows, points)
    foundation : of its flow on its grid; None at rest
    """

    grid: Grid
    pressure: np.ndarray
    foundation: Foundation | None

    def on(self, grid: Grid, foundation: Foundation | None) -> np.ndarray:
        """Pressure on a grid that displaces its foundation as much as here; where it would pull it is zero.

        The pressure itself is no good start: it has spikes at leading edges, and depends on the speed.
        """
        sunk = self.pressure.copy()
        if self.foundation is not None:
            sums.foundation_displacement(sunk, self.foundation)
        contact = grid.nearest(self.pressure > 0, self.grid)
        taken = grid.resample(sunk, self.grid)
        if foundation is None:
            return taken * contact
        sums.foundation_pressure(taken, contact, foundation, least=0.0)
        return taken


class Problem:
    """A scene on any grid. `work` counts operator applications times the points they acted on.

    medium : the response of the elastomer; bare : the same without what the terms of the scene change of it
    """

    def __init__(self, scene: Scene, engine: Engine, table: Table = TERMS):
        self.scene = scene
        self._terms = terms_of(table, scene)
        # A single row costs nothing, and what it is solved to is beyond single precision.
        self.engine = engine if self.width is None else replace(engine, precision="double")
        self.flow = Flow.of(scene.solid, scene.motion.speed)
        self.medium: Any = _medium(scene.indenter, self.flow, self.engine)
        self.bare = self.medium
        for term in self._terms:
            self.medium = term.medium(self.medium, scene)
        self.work, self.transforms = 0, 0
        self._cut_off: float | None = None
        self._surface: RoughSurface | None = None

    @property
    def width(self) -> float | None:
        """Width of the single row of pixels [m], see `row_width`."""
        return row_width(self.scene)

    def completed(self, result: Result, grid: Grid) -> Result:
        """An answer on the grid, completed by the terms of the scene."""
        for term in self._terms:
            result = term.completed(result, self, grid)
        return result

    def surface(self, grid: Grid) -> RoughSurface | None:
        """The rough surface as a grid cuts it off; None for a smooth indenter."""
        rough = self.scene.roughness
        if rough is None or rough.flat:
            return None
        q_max = rough.q_max(grid.pixel)
        if q_max != self._cut_off:
            self._cut_off, self._surface = q_max, RoughSurface.of(rough, q_max)
        return self._surface

    def shortest(self, grid: Grid) -> float | None:
        """Shortest wavelength [m] of roughness or of a measured body on a grid; else None."""
        if self.surface(grid) is not None:
            return 2 * np.pi / self.scene.roughness.q_max(grid.pixel)
        return self.scene.indenter.shortest if isinstance(self.scene.indenter, Measured) else None

    def points_per_wave(self, grid: Grid) -> float:
        """Points on the shortest wave; nan if there is none."""
        shortest = self.shortest(grid)
        return nan if shortest is None else float(shortest / grid.pixel)

    def heights(self, grid: Grid, surface: RoughSurface | None, shift: float = 0.0) -> np.ndarray:
        """z [m] of indenter and roughness, `shift` [m] behind the pixels' centres."""
        x, y = grid.x + shift, grid.y
        macroscopic = self.scene.indenter.height(x[None, :], y[:, None])
        return macroscopic if surface is None else macroscopic + surface.heights(x, y)

    def slopes(self, grid: Grid, surface: RoughSurface | None) -> np.ndarray:
        """dz/dx [1] at the pixels' centres."""
        macroscopic = self.scene.indenter.slope(*grid.places)
        return macroscopic if surface is None else macroscopic + grid.sampled(surface.slopes)

    def lost(self, grid: Grid, pressure: np.ndarray) -> tuple[float, float]:
        """Energy lost per length slid [J/m] under a pressure [Pa], from the displacement alone.

        By the slope of the displacement, the sum of the loss compliance over the spectrum of the pressure; and by
        the work done on the surface on its way from pixel to pixel.
        """
        if self.flow.at_rest:
            return 0.0, 0.0
        self.transforms += grid.points * grid.rows
        loss, work = self.medium.lost(grid, pressure / self.flow.modulus)
        return loss * self.flow.modulus * grid.patch, work * self.flow.modulus * grid.patch

    def solve(
        self, finest: Grid, tolerance: float, start: Start | None = None, neighbour: Start | None = None
    ) -> activeset.Contact:
        """Contact on the finest grid, each grid started from the coarser one; in units of `solve_on`.

        start : contact on a coarser grid, whose points are doubled until the finest is reached
        neighbour : contact of a neighbouring scene; the finest grid starts from it where that is closer
        """
        grids = finest.ladder(COARSEST if start is None else 2 * start.grid.points)
        surface = self.surface(finest)
        for grid in reversed(grids[1:]):
            try:
                answer = self.solve_on(grid, surface, max(tolerance, COARSE_TOLERANCE), start)
                start = self.start(grid, answer.pressure)
            except (EmptyContact, Unseen):
                start = None  # the coarse grid misses the peaks that the finer one has
        return self.solve_on(finest, surface, tolerance, start, neighbour)

    def start(self, grid: Grid, pressure: np.ndarray) -> Start:
        """Start of the next solve, from a pressure in units of the relaxed E*."""
        return Start(grid, pressure, self.medium.foundation(grid))

    def solve_on(self, grid: Grid, surface, tolerance: float, *starts: Start | None) -> activeset.Contact:
        """Contact on a single grid, lengths in pixels, pressure in units of the relaxed E*. Raises SolveError.

        starts : the one closest to the answer is used
        """
        heights = self.heights(grid, surface, self.flow.collocation(grid)) / grid.pixel
        depth, load = self._pressed(grid, heights)
        if grid.rows == 1 and not self.flow.at_rest:
            tolerance = min(tolerance, LEAST_ON_A_ROW)
        operator, preconditioner = self.medium.operator(grid), self.medium.preconditioner(grid)
        foundation = self.medium.foundation(grid)
        begun = [each.on(grid, foundation) for each in starts if each is not None]
        begun = [each for each in begun if each.any()] or [self._first_guess(heights, grid, depth, load)]
        if len(begun) > 1:
            begun.sort(key=lambda pressure: activeset.misfit(operator, heights, pressure, depth, load))
        try:
            return activeset.solve(
                operator,
                heights,
                begun[0],
                tolerance,
                depth=depth,
                load=load,
                precondition=preconditioner,
                foundation=foundation,
                symmetric=self.flow.at_rest,
            )
        except activeset.NotConverged as error:
            advice = "a larger tolerance" if self.engine.precision == "double" else 'precision = "double"'
            raise SolveError(
                f"no converged contact on {grid.points} x {grid.rows} points: {error}; "
                f"take {advice} or more points"
            ) from error
        finally:
            self._count(grid, operator)
            self.transforms += preconditioner.operator_applications * grid.points * grid.rows

    def _count(self, grid, product):
        self.work += product.operator_applications * grid.points * grid.rows
        self.transforms += product.operator_applications * grid.points * grid.rows

    def _pressed(self, grid, heights):
        """Depth [pixel] or load [pixels times E*], the other None. Raises EmptyContact, Unseen."""
        motion, prescribed = self.scene.motion, self.scene.motion.pressed_by
        value, patches = getattr(motion, prescribed), self.flow.modulus * grid.patch
        if prescribed in ("load", "line_load"):
            return None, value / patches
        if prescribed == "pressure":
            return None, value / self.flow.modulus * grid.points * grid.rows
        depth = (value if prescribed == "depth" else -value) / grid.pixel
        lowest = heights.min()
        if depth <= lowest:
            if prescribed == "depth" and self.surface(grid) is None:
                raise Unseen(
                    f"the contact lies between the centres of pixels of {grid.pixel:g} m: take more points or a "
                    f"smaller extent than {grid.extent:g} m"
                )
            wanted = "larger depth" if prescribed == "depth" else f"gap below {-lowest * grid.pixel:g} m"
            raise EmptyContact(
                f"motion.{prescribed} = {value:g} m leaves the contact empty: the indenter's lowest point is "
                f"{(lowest - depth) * grid.pixel:g} m short of the undeformed surface, take a {wanted}"
            )
        return depth, None

    def _first_guess(self, heights, grid, depth, load):
        """Pressure in proportion to the overlap with the undeformed surface.

        At given load, on as many of the lowest points as the smooth contact at rest would cover; of a plane, as
        many as carry the load at its rms slope.
        """
        if depth is None:
            count = int(np.clip(self._smooth_count(grid, load), 4, heights.size - 1))
            overlap = activeset.first_guess(heights, count)
        else:
            overlap = np.maximum(depth - heights, 0.0)
        return overlap / np.sqrt(np.count_nonzero(overlap))

    def _smooth_count(self, grid, load):
        """Pixels in contact, roughly: half of them at a mean pressure of E* rms slope / 2, and so on (Persson).

        Of a measured body nothing is known beforehand.
        """
        if isinstance(self.scene.indenter, Measured):
            return grid.points * grid.rows * GUESSED
        if not isinstance(self.scene.indenter, Plane):
            radius = elastic_contact(self.scene).radius / grid.pixel
            return min(2 * radius if grid.width else np.pi * radius**2, grid.points * grid.rows / 4)
        slope = self._surface.rms_slope
        return grid.points * grid.rows * np.tanh(2 * load / (grid.points * grid.rows) / slope)
