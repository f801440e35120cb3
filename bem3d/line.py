"""A line contact: the half-space in plane strain, on one row of pixels."""

from dataclasses import dataclass

from . import influence
from .halfspace import HalfSpace


@dataclass(frozen=True)
class Line(HalfSpace):
    """The free surface under a load that is the same all along y.

    datum : distance [m] from a line load at which the relaxed surface is left at its level: without one the
        surface sinks without bound
    """

    datum: float

    def _elastic(self, grid):
        return influence.line(grid.points, self.datum / grid.pixel)

    def _flowing(self, grid, instantaneous, shares, lengths, shift):
        return influence.line_flowing(grid.points, instantaneous, shares, lengths, shift, self.datum / grid.pixel)
