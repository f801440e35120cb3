"""A surface that ends nowhere: what a pressure does to a half-space, or to what else lies below.

Pressures are in units of the relaxed E* and displacements in pixels. The surface arrives undisturbed.
"""

from dataclasses import dataclass, replace

import numpy as np

from .convolution import FreeConvolution, PeriodicFilter
from .engine import Engine
from .grid import Grid
from .ground import HALF_SPACE, Ground
from .sliding import Flow

LEAST_DIFFERENCE = 1e-3  # memory [pixel] down to which losses are taken from differences of kernels


@dataclass(frozen=True)
class HalfSpace:
    """The free surface of a half-space, unless the ground is another."""

    flow: Flow
    engine: Engine
    ground: Ground = HALF_SPACE

    def operator(self, grid: Grid) -> FreeConvolution:
        """Pressure -> displacement at the points of collocation."""
        flow = self.flow
        if flow.at_rest:
            return self._convolution(self._elastic(grid))
        shift = flow.collocation(grid) / grid.pixel
        return self._convolution(self._flowing(grid, flow.instantaneous, flow.shares, flow.in_pixels(grid), shift))

    def slope(self, grid: Grid) -> FreeConvolution:
        """Pressure -> slope of the displacement along the flow, as far as it dissipates.

        A mode's displacement obeys w + l dw/dx = w_elastic, so its slope is (w_elastic - w)/l without any
        difference quotient. Of its kernel only the part even in x does work on the pressure: int p dw/dx dA is the
        energy lost per length slid, the sum of the loss compliance over the spectrum of the pressure.
        """
        shares, lengths = self._seen(grid)
        rates = shares / lengths
        return self._convolution(self._flowing(grid, rates.sum(), -rates, lengths, 0.0))

    def gain(self, grid: Grid) -> FreeConvolution:
        """Pressure -> slope of the displacement as the difference between the pixels on both sides."""
        wider = replace(grid, points=grid.points + 2)  # a column more at each end
        shares, lengths = self._seen(grid)
        kernel = self._flowing(wider, 0.0, shares, lengths, 0.0)[: grid.rows]
        return self._convolution((kernel[:, 3:-1] - kernel[:, 1:-3]) / 2)

    def _seen(self, grid):
        """Shares and lengths [pixel] of the modes, none shorter than leaves digits to the even part of a kernel.

        That is in proportion to the length, up to its square.
        """
        lengths = self.flow.lengths / grid.pixel
        seen = np.maximum(lengths, LEAST_DIFFERENCE)
        return self.flow.shares * lengths / seen, seen

    def preconditioners(self, grid: Grid) -> list[PeriodicFilter]:
        """Approximate inverse of the operator: one over the compliance of the modes on pixels, then the ground.

        Two factors, because a contact discards what the first gives outside: of a displacement known on the
        contact alone, a jump to nothing behind its trailing edge, as large as the memory is long.
        """

        def elastic(q_y, q_x):
            q = np.hypot(q_y, q_x)
            q[0, 0] = np.pi / grid.points  # half the lowest: a mean pressure on a free surface does push it in
            return self.ground.stiffness(q, grid.pixel)

        def flow(_, q_x):
            return 1 / _discrete_compliance(self.flow, grid, q_x)

        symbols = [elastic] if self.flow.at_rest else [flow, elastic]
        return [PeriodicFilter(grid.shape, symbol, self.engine) for symbol in symbols]

    def _convolution(self, kernel):
        return FreeConvolution(kernel, self.engine)

    def _elastic(self, grid):
        return self.ground.elastic(grid)

    def _flowing(self, grid, instantaneous, shares, lengths, shift):
        return self.ground.flowing(grid, instantaneous, shares, lengths, shift)


def _discrete_compliance(flow, grid, q_x):
    """Of pressure held from pixel to pixel, at q_x [rad/pixel], over the relaxed one."""
    compliance = np.full(q_x.shape, complex(flow.instantaneous))
    for share, length in zip(flow.shares, flow.in_pixels(grid), strict=True):
        gone = -np.expm1(-1 / length)
        # 1 - exp(-1/length - i q_x), with its digits where both are small.
        compliance += share * gone / (gone - (1 - gone) * np.expm1(-1j * q_x))
    return compliance
