"""Colours of what touches in pictures of a contact: the elastomer, its surface, and the rigid indenter."""

import numpy as np
from matplotlib.colors import to_rgb

from . import style

# Sand, of which the elastomer is a tint.
SAND = "#8A7A45"


def elastomer() -> tuple[float, float, float]:
    """The inside, light on paper that is light and dark on dark."""
    return tuple((0.25 * np.array(to_rgb(SAND)) + 0.75 * np.array(to_rgb(style.paper()))).tolist())


def surface() -> tuple[float, float, float]:
    """The line where it ends."""
    return tuple((0.75 * np.array(to_rgb(SAND)) + 0.25 * np.array(to_rgb(style.ink()))).tolist())


def indenter() -> tuple[float, float, float]:
    """The inside of what is rigid."""
    return style.grey(0.7)
