"""A surface that repeats: every wave of pressure has its own displacement, the wake included.

Pressures are in units of the relaxed E* and displacements in pixels. The mean displacement is not defined: depths
are counted from the mean of the deformed surface.
"""

from dataclasses import dataclass

import numpy as np
from scipy.fft import fftfreq, rfft2, rfftfreq

from ..grid import Grid, cached_on_small_grids
from ..motion.steady import Flow
from .convolution import PeriodicFilter
from .engine import Engine
from .medium import HALF_SPACE, Foundation, ResponseKernel


@dataclass(frozen=True)
class Cell:
    """One period of the surface: of a half-space, w(q) = 2 J(q_x v) p(q) / |q|, unless the kernel is another."""

    flow: Flow
    engine: Engine
    kernel: ResponseKernel = HALF_SPACE

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

    @cached_on_small_grids
    def foundation(self, grid: Grid) -> Foundation | None:
        """Part of the operator that the elastic half-space does not have; None at rest."""
        return Foundation.of(self.flow, grid, wraps=True)

    def lost(self, grid: Grid, pressure: np.ndarray) -> tuple[float, float]:
        """sum p dw/dx over a pressure (rows, points), the energy lost per pixel slid: by the slope of the
        displacement along the flow, and by its difference between the pixels on both sides.
        """
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
