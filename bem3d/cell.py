"""A surface that repeats: every wave of pressure has its own displacement, the wake included.

Pressures are in units of the relaxed E* and displacements in pixels. The mean displacement is not defined: depths
are counted from the mean of the deformed surface.
"""

from dataclasses import dataclass

import numpy as np

from .convolution import PeriodicFilter
from .engine import Engine
from .grid import Grid
from .sliding import Flow


@dataclass(frozen=True)
class Cell:
    """One period of the surface of a half-space, w(q) = 2 J(q_x v) p(q) / |q|."""

    flow: Flow
    engine: Engine

    def operator(self, grid: Grid) -> PeriodicFilter:
        """Pressure -> displacement, free of mean, at the points of collocation."""
        return self._filter(grid, lambda q, response: 2 / q * response, mean=0.0)

    def preconditioners(self, grid: Grid) -> list[PeriodicFilter]:
        """The inverse of the operator, in factors as `HalfSpace`; a mean pressure is taken for the lowest wave."""
        elastic = self._filter(grid, lambda q, _: q / 2, mean=np.pi / grid.points)
        if self.flow.at_rest:
            return [elastic]
        return [PeriodicFilter(grid.shape, lambda _, q_x: 1 / self._response(grid, q_x), self.engine), elastic]

    def slope(self, grid: Grid) -> PeriodicFilter:
        """Pressure -> slope of the displacement along the flow, as far as it dissipates."""
        return self._loss(grid, lambda q_x: q_x)

    def gain(self, grid: Grid) -> PeriodicFilter:
        """Pressure -> slope of the displacement as the difference between the pixels on both sides."""
        return self._loss(grid, np.sin)

    def _loss(self, grid, step):
        def symbol(q_y, q_x):
            q = np.hypot(q_y, q_x)
            q[0, 0] = 1.0
            return -2 / q * step(q_x) * self.flow.compliance(q_x, grid.pixel).imag

        return PeriodicFilter(grid.shape, symbol, self.engine)

    def _filter(self, grid, of, mean):
        def symbol(q_y, q_x):
            q = np.hypot(q_y, q_x)
            q[0, 0] = 1.0
            values = of(q, self._response(grid, q_x))
            values[0, 0] = mean
            return values

        return PeriodicFilter(grid.shape, symbol, self.engine)

    def _response(self, grid, q_x):
        """Compliance, seen from the points of collocation; real at rest."""
        if self.flow.at_rest:
            return 1.0
        shift = self.flow.collocation(grid) / grid.pixel
        return self.flow.compliance(q_x, grid.pixel) * np.exp(1j * q_x * shift)
