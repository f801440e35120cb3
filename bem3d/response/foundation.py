"""The elastomer without the half-space: under the flow its modes are a foundation, and no point feels another.

The displacement of a half-space is that of this foundation, spread by the elastic kernel. What spreads is inverted
wave by wave; the foundation is inverted exactly, pixel by pixel downstream, on any set of contact.
"""

from dataclasses import dataclass

import numpy as np

from ..grid import Grid
from ..motion.steady import Flow

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
        """Foundation of a flow on a grid, with a relaxed compliance of one; None at rest."""
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
