"""A line contact: plane strain, on one row of pixels."""

from dataclasses import dataclass

from .halfspace import HalfSpace


@dataclass(frozen=True)
class Line(HalfSpace):
    """The free surface under a load that is the same all along y; the depth of a half-space needs a datum."""

    def _elastic(self, grid):
        return self.kernel.line(grid)

    def _flowing(self, grid, instantaneous, shares, lengths, shift):
        return self.kernel.line_flowing(grid, instantaneous, shares, lengths, shift)
