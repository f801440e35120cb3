"""A surface, or a line, that ends nowhere: what a pressure does to a half-space, or to what else lies below.

Pressures are in units of the relaxed E* and displacements in pixels. The surface arrives undisturbed.
"""

from dataclasses import dataclass

import numpy as np

from ..grid import Grid, Piece, cached_on_small_grids
from ..motion.steady import Flow
from .convolution import FreeConvolution, PeriodicFilter, autocorrelation, free_symbol
from .engine import Engine
from .medium import HALF_SPACE, Foundation, ResponseKernel

LEAST_DIFFERENCE = 1e-3  # memory [pixel] down to which losses are taken from differences of kernels


@dataclass(frozen=True)
class HalfSpace:
    """The free surface of a half-space, unless the kernel is another."""

    flow: Flow
    engine: Engine
    kernel: ResponseKernel = HALF_SPACE

    def operator(self, grid: Grid) -> FreeConvolution:
        """Pressure -> displacement at the points of collocation."""
        return FreeConvolution(grid.shape, self._symbol(grid), self.engine)

    @cached_on_small_grids
    def _symbol(self, grid):
        flow = self.flow
        if flow.at_rest:
            return free_symbol(self._elastic(grid), self.engine)
        shift = flow.collocation(grid) / grid.pixel
        kernel = self._flowing(grid, flow.instantaneous, flow.shares, flow.in_pixels(grid), shift)
        return free_symbol(kernel, self.engine)

    def lost(self, grid: Grid, pressure: np.ndarray) -> tuple[float, float]:
        """sum p dw/dx over a pressure (rows, points), the energy lost per pixel slid: by the slope of the
        displacement along the flow, and by its difference between the pixels on both sides.

        A mode's displacement obeys w + l dw/dx = w_elastic, so its slope is (w_elastic - w)/l without any
        difference quotient. Only the part of its kernel that is even in x does work on the pressure: the sum of
        the loss compliance over the spectrum of the pressure. Of the kernel of the displacement it is the odd
        part.
        """
        pairs = np.zeros((grid.rows, grid.points + 2))
        pairs[:, :-2] = autocorrelation(pressure, self.engine)
        even, at_once, odd = self._losing(grid)
        loss = np.sum(even * pairs[:, 1:-1]) + at_once @ pairs[:, 0]
        return float(loss), float(np.sum(odd * (pairs[:, :-2] - pairs[:, 2:])) / 2)

    @cached_on_small_grids
    def _losing(self, grid):
        """Slope of the displacement by a pixel: its even part from one pixel on (rows, points), and at the pixel
        (rows,); odd part of the displacement (rows, points).
        """
        middle = grid.points + 1
        wider = Piece(middle, middle * grid.pixel, width=grid.width, lines=grid.rows)
        shares, lengths = self._seen(grid)
        rates = shares / lengths
        slope, moved = self._flowing(wider, np.array([rates.sum(), 0.0]), np.array([-rates, shares]), lengths, 0.0)
        even = slope[:, middle + 1 :] + slope[:, middle - 1 : 0 : -1]
        odd = moved[:, middle + 1 :] - moved[:, middle - 1 : 0 : -1]
        return even, slope[:, middle].copy(), odd

    def _seen(self, grid):
        """Shares and lengths [pixel] of the modes, none shorter than leaves digits to the even part of a kernel.

        That is in proportion to the length, up to its square.
        """
        lengths = self.flow.lengths / grid.pixel
        seen = np.maximum(lengths, LEAST_DIFFERENCE)
        return self.flow.shares * lengths / seen, seen

    def preconditioner(self, grid: Grid) -> PeriodicFilter:
        """Approximate inverse of the operator without the foundation."""

        def elastic(q_y, q_x):
            q = np.hypot(q_y, q_x)
            q[0, 0] = np.pi / grid.points  # half the lowest: a mean pressure on a free surface does push it in
            return self.kernel.stiffness(q, grid.pixel)

        return PeriodicFilter(grid.shape, elastic, self.engine)

    @cached_on_small_grids
    def foundation(self, grid: Grid) -> Foundation | None:
        """Part of the operator that the elastic half-space does not have; None at rest."""
        return Foundation.of(self.flow, grid)

    def _elastic(self, grid):
        return self.kernel.elastic(grid)

    def _flowing(self, grid, instantaneous, shares, lengths, shift):
        return self.kernel.flowing(grid, instantaneous, shares, lengths, shift)


@dataclass(frozen=True)
class Line(HalfSpace):
    """The free surface under a load that is the same all along y; the depth of a half-space needs a datum."""

    def _elastic(self, grid):
        return self.kernel.line(grid)

    def _flowing(self, grid, instantaneous, shares, lengths, shift):
        return self.kernel.line_flowing(grid, instantaneous, shares, lengths, shift)
