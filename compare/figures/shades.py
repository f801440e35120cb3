"""Colours of many curves in one panel, one for each speed, load or depth, and the legend that says which."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.colors import Colormap, LinearSegmentedColormap, LogNorm
from matplotlib.lines import Line2D

from . import style

CURVES = 8  # most of them in a panel
# Low to high; without the yellow end, which is lost on white.
SPEED = LinearSegmentedColormap.from_list("speed", colormaps["plasma"](np.linspace(0, 0.88, 256)))
PRESS = LinearSegmentedColormap.from_list("press", colormaps["viridis"](np.linspace(0, 0.88, 256)))


def between(values: Sequence[float] | np.ndarray) -> LogNorm:
    """The scale of shades for positive values; one alone lies in its middle."""
    low, high = min(values), max(values)
    return LogNorm(low, high) if high > low else LogNorm(low / 2, 2 * high)


def few(values: Any, most: int) -> np.ndarray:
    """At most `most` of the distinct values, evenly chosen from the least to the greatest."""
    values = np.unique(values)
    return values[np.unique(np.linspace(0, len(values) - 1, min(most, len(values))).round().astype(int))]


def key(shades: Colormap, values: Any, unit: str) -> list[Line2D]:
    """Entries of a legend for up to CURVES of some values."""
    scale = between(values)
    return [style.entry(f"{each:.3g} {unit}", color=shades(scale(each))) for each in few(values, CURVES)]
