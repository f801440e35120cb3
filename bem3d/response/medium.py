"""Medium below the surface: a kernel that spreads a pressure, and modes under the flow that remember it.

Lengths are in pixels and pressures in units of the relaxed E*, as in `influence`. The modes alone are a
foundation, whose points do not interact across the flow: a half-space is displaced as this foundation, spread by
the elastic kernel. The spreading is inverted wave by wave, approximately; the foundation exactly, pixel by pixel
downstream, on any set of contact.
"""

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from ..grid import Grid
from ..motion.steady import Flow
from . import influence

MERGED = 10.0  # modes shorter than that times the first of them are one with it: the inverse is approximate anyway
LONGEST = 1e4  # rows that repeat: what lasts longer is as long, and leaves digits to what a row does to it


@dataclass(frozen=True)
class Foundation:
    """Modes from pixel to pixel, the pressure held on each: u = at_once p + sum of states.

    A state keeps a share of itself from pixel to pixel, and gains from the pressure on the pixel left behind.

    at_once : displacement by a unit of pressure on the pixel itself
    kept, gained : of the state of each mode (K,)
    wraps : whether what leaves at the end of a row comes in at its start
    """

    at_once: float
    kept: np.ndarray
    gained: np.ndarray
    wraps: bool = False

    @classmethod
    def of(cls, flow: Flow, grid: Grid, wraps: bool = False) -> "Foundation | None":
        """Foundation of a flow on a grid, with a unit relaxed compliance; None at rest."""
        if flow.at_rest:
            return None
        lengths = flow.in_pixels(grid)
        shares, lengths = _merged(flow.shares, np.minimum(lengths, LONGEST * grid.points) if wraps else lengths)
        gone = -np.expm1(-1 / lengths)
        return cls(float(flow.instantaneous + shares @ gone), 1 - gone, shares * gone, wraps)


def _merged(shares, lengths):
    """Modes of neighbouring lengths joined: shares (K,) and lengths (K,) [pixel] of fewer."""
    octaves = np.floor(np.log(lengths / lengths.min()) / np.log(MERGED))
    _, group = np.unique(octaves, return_inverse=True)
    total = np.bincount(group, shares)
    return total, np.exp(np.bincount(group, shares * np.log(lengths)) / total)


class ResponseKernel(Protocol):
    """Displacement by a loaded pixel, by a loaded strip and by a wave of pressure."""

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
