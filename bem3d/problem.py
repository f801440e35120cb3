"""One scene put on grids: heights and operators for each, and the way from a coarse grid to a fine one."""

import numpy as np

from scene import EmptyContact, Scene, SolveError
from scene.scales import elastic_contact

from . import contact
from .grid import Grid
from .sliding import Flow
from .surface import RoughSurface

COARSEST = 64  # points a side from which a solve starts, or all there are below twice as many
COARSE_TOLERANCE = 1e-3  # on all grids but the finest: they only provide the start


class Problem:
    """A scene on any grid. `work` counts operator applications times the points they acted on."""

    def __init__(self, scene: Scene, threads: int):
        self.scene, self.threads = scene, threads
        self.flow = Flow.of(scene.elastomer, scene.motion.speed)
        self.work = 0
        self._cut_off, self._surface = None, None

    def surface(self, grid: Grid) -> RoughSurface | None:
        """The rough surface as a grid cuts it off; None for a smooth indenter."""
        rough = self.scene.roughness
        if rough is None or rough.rms_height == 0:
            return None
        q_max = rough.q_max(grid.pixel)
        if q_max != self._cut_off:
            self._cut_off, self._surface = q_max, RoughSurface.draw(rough, q_max)
        return self._surface

    def heights(self, grid: Grid, surface: RoughSurface | None, shift: float = 0.0) -> np.ndarray:
        """z [m] of indenter and roughness, `shift` [m] behind the pixels' centres."""
        x, y = grid.x + shift, grid.y
        macroscopic = self.scene.indenter.height(x[None, :], y[:, None])
        return macroscopic if surface is None else macroscopic + surface.heights(x, y)

    def slopes(self, grid: Grid, surface: RoughSurface | None) -> np.ndarray:
        """dz/dx [1] at the pixels' centres."""
        macroscopic = self.scene.indenter.slope(grid.x[None, :], grid.y[:, None])
        return macroscopic if surface is None else macroscopic + surface.slopes(grid.x, grid.y)

    def operator(self, grid: Grid):
        """Pressure over E* -> displacement over the pixel."""
        return self.flow.operator(grid, self.threads)

    def lost(self, grid: Grid, pressure: np.ndarray) -> float:
        """Energy [J] lost per length [m] slid under a pressure [Pa]: friction without looking at the indenter."""
        loss = self.flow.loss(grid, self.threads)
        if loss is None:
            return 0.0
        self.work += grid.points**2
        return float(np.sum(pressure * loss(pressure)) * grid.pixel**2 / self.flow.modulus)

    def solve(self, finest: Grid, tolerance: float) -> contact.Contact:
        """From the coarsest grid to the finest, each started from the one before; in units of `solve_on`."""
        grids = [finest]
        while grids[-1].points >= 2 * COARSEST:
            grids.append(grids[-1].coarser())
        surface, start = self.surface(finest), None
        for grid in reversed(grids[1:]):
            try:
                start = self.solve_on(grid, surface, start, max(tolerance, COARSE_TOLERANCE)).pressure
            except EmptyContact:
                start = None  # the coarse grid misses the peaks that the finer one has
        return self.solve_on(finest, surface, start, tolerance)

    def solve_on(self, grid: Grid, surface, start, tolerance) -> contact.Contact:
        """One grid, lengths in pixels, pressure in units of the relaxed E*. Raises SolveError."""
        motion = self.scene.motion
        heights = self.heights(grid, surface, self.flow.collocation(grid)) / grid.pixel
        depth = None if motion.depth is None else motion.depth / grid.pixel
        load = None if motion.load is None else motion.load / (self.flow.modulus * grid.pixel**2)
        if depth is not None and depth <= heights.min():
            raise EmptyContact(
                f"motion.depth = {motion.depth:g} m leaves the contact empty: the indenter's lowest point is "
                f"{heights.min() * grid.pixel:g} m above the undeformed surface, take a larger depth"
            )
        operator = self.operator(grid)
        try:
            return contact.solve(
                operator,
                heights,
                self._first_guess(heights, grid, depth) if start is None else grid.resample(start),
                tolerance,
                depth=depth,
                load=load,
                precondition=self.flow.preconditioner(grid, self.threads),
                symmetric=self.flow.at_rest,
            )
        except contact.NotConverged as error:
            raise SolveError(f"no converged contact on {grid.points} x {grid.points} points: {error}") from error
        finally:
            self.work += operator.applications * grid.points**2

    def _first_guess(self, heights, grid, depth):
        """Pressure in proportion to the overlap with the undeformed surface.

        At given load, on as many of the lowest points as the smooth contact at rest would cover.
        """
        if depth is None:
            smooth = elastic_contact(self.scene).radius / grid.pixel
            count = int(np.clip(np.pi * smooth**2, 4, heights.size / 4))
            depth = np.partition(heights, count, axis=None)[count]
        overlap = np.maximum(depth - heights, 0.0)
        return overlap / np.sqrt(np.count_nonzero(overlap))
