"""Media below the surface: displacement by a loaded pixel, by a loaded strip and by a wave of pressure.

Lengths are in pixels and pressures in units of the relaxed E*, as in `influence`.
"""

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from ..grid import Grid
from . import influence


class ResponseKernel(Protocol):
    """ResponseKernel below the surface, as a medium uses it."""

    def elastic(self, grid: Grid) -> np.ndarray:
        """Elastic kernel of a pixel, as `influence.elastic`."""

    def flowing(self, grid: Grid, instantaneous, shares, lengths, shift) -> np.ndarray:
        """Kernel of a pixel in flow, as `influence.flowing`."""

    def line(self, grid: Grid) -> np.ndarray:
        """Elastic kernel of a strip, as `influence.line`."""

    def line_flowing(self, grid: Grid, instantaneous, shares, lengths, shift) -> np.ndarray:
        """Kernel of a strip in flow, as `influence.line_flowing`."""

    def compliance(self, q: np.ndarray, pixel: float) -> np.ndarray:
        """Displacement by a wave of pressure; q > 0 [rad/pixel], pixel [m]."""

    def stiffness(self, q: np.ndarray, pixel: float) -> np.ndarray:
        """Pressure that a wave of displacement takes."""


@dataclass(frozen=True)
class HalfSpaceKernel:
    """The elastomer has no end: a half-space.

    datum : of lines, distance [m] from a line load at which the relaxed surface is left at its level: without
        one the surface sinks without bound
    """

    datum: float = np.nan

    def elastic(self, grid):
        return influence.elastic(*grid.shape[::-1])

    def flowing(self, grid, instantaneous, shares, lengths, shift):
        return influence.flowing(*grid.shape[::-1], instantaneous, shares, lengths, shift)

    def line(self, grid):
        return influence.line(grid.points, self.datum / grid.pixel)

    def line_flowing(self, grid, instantaneous, shares, lengths, shift):
        return influence.line_flowing(grid.points, instantaneous, shares, lengths, shift, self.datum / grid.pixel)

    def compliance(self, q, pixel):
        return 2 / q

    def stiffness(self, q, pixel):
        return q / 2


HALF_SPACE = HalfSpaceKernel()
