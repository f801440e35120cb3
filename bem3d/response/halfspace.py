"""Response of a half-space to a pressure: a free surface, a line alike along y, and a cell that repeats.

Pressures are in units of the relaxed E* and displacements in pixels. A free surface arrives undisturbed. In a cell
every wave of pressure has its own displacement, the wake included. The mean displacement is not defined there:
depths are counted from the mean of the deformed surface.
"""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from scipy.fft import fftfreq, rfft2, rfftfreq

from ..grid import Grid, Piece, cached_on_small_grids
from ..motion.steady import Flow
from .convolution import FreeConvolution, PeriodicFilter, autocorrelation, free_symbol
from .engine import Engine
from .medium import HALF_SPACE, Foundation, ResponseKernel

LEAST_DIFFERENCE = 1e-3  # memory [pixel] down to which losses are taken from differences of kernels


@dataclass(frozen=True)
class Medium:
    """The surface of a half-space, unless the kernel is another. wraps : whether it repeats"""

    wraps: ClassVar[bool] = False

    flow: Flow
    engine: Engine
    kernel: ResponseKernel = HALF_SPACE

    @cached_on_small_grids
    def foundation(self, grid: Grid) -> Foundation | None:
        """Part of the operator that the elastic half-space does not have; None at rest."""
        return Foundation.of(self.flow, grid, self.wraps)


class HalfSpace(Medium):
    """A free surface."""

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
        """Energy lost per pixel slid, sum p dw/dx over a pressure (rows, points): two estimates.

        The first is by the slope of the displacement along the flow, the second by its difference between the
        pixels on both sides.

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
        """Kernels of the loss by a pixel of pressure.

        Slope of the displacement: its even part from one pixel on (rows, points), and at the pixel (rows,). Odd
        part of the displacement (rows, points).
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

    def _elastic(self, grid):
        return self.kernel.elastic(grid)

    def _flowing(self, grid, instantaneous, shares, lengths, shift):
        return self.kernel.flowing(grid, instantaneous, shares, lengths, shift)


class Line(HalfSpace):
    """The free surface under a load that is the same all along y; the depth of a half-space needs a datum."""

    def _elastic(self, grid):
        return self.kernel.line(grid)

    def _flowing(self, grid, instantaneous, shares, lengths, shift):
        return self.kernel.line_flowing(grid, instantaneous, shares, lengths, shift)


class Cell(Medium):
    """One period of a surface that repeats: on a half-space, w(q) = 2 J(q_x v) p(q) / |q|."""

    wraps = True

    def operator(self, grid: Grid) -> PeriodicFilter:
        """Pressure -> displacement, free of mean, at the points of collocation."""

        def symbol(q_y, q_x):
            values = self.kernel.compliance(_lengths(q_y, q_x, 1.0), grid.pixel) * self._response(grid, q_x)
            values[0, 0] = 0.0
            return values

        return PeriodicFilter(grid.shape, symbol, self.engine)

    def preconditioner(self, grid: Grid) -> PeriodicFilter:
        """Inverse of the operator without the foundation; a mean pressure is taken for the lowest wave."""

        def elastic(q_y, q_x):
            return self.kernel.stiffness(_lengths(q_y, q_x, 2 * np.pi / grid.points), grid.pixel)

        return PeriodicFilter(grid.shape, elastic, self.engine)

    def lost(self, grid: Grid, pressure: np.ndarray) -> tuple[float, float]:
        """Energy lost per pixel slid, as by `HalfSpace.lost`."""
        (ny, nx), spectrum = grid.shape, np.square(np.abs(rfft2(pressure)))
        q_y, q_x = 2 * np.pi * np.abs(fftfreq(ny))[:, None], 2 * np.pi * np.abs(rfftfreq(nx))
        yielding = self.kernel.compliance(_lengths(q_y, q_x, 1.0), grid.pixel)
        lost = -np.sum(yielding * spectrum, axis=0) * self.flow.compliance(q_x, grid.pixel).imag / (ny * nx)
        lost[1 : (nx + 1) // 2] *= 2  # with those of the opposite waves
        return float(q_x @ lost), float(np.sin(q_x) @ lost)

    def _response(self, grid, q_x):
        """Compliance, seen from the points of collocation; real at rest."""
        if self.flow.at_rest:
            return 1.0
        shift = self.flow.collocation(grid) / grid.pixel
        return self.flow.compliance(q_x, grid.pixel) * np.exp(1j * q_x * shift)


def _lengths(q_y, q_x, mean):
    """|q| of all waves [rad/pixel], with something else where it is zero."""
    q = np.hypot(q_y, q_x)
    q[0, 0] = mean
    return q
