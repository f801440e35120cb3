"""Many curves in one panel: a shade for each speed, or for each load or depth, and the bar that says which."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colorbar import Colorbar
from matplotlib.colors import Colormap, LinearSegmentedColormap, LogNorm
from matplotlib.figure import Figure, SubFigure

from . import style

# Low to high; without the yellow end, which is lost on white.
SPEED = LinearSegmentedColormap.from_list("speed", colormaps["plasma"](np.linspace(0, 0.88, 256)))
PRESS = LinearSegmentedColormap.from_list("press", colormaps["viridis"](np.linspace(0, 0.88, 256)))


def between(values: Sequence[float] | np.ndarray) -> LogNorm:
    """The scale of shades for positive values; one alone lies in its middle."""
    low, high = min(values), max(values)
    return LogNorm(low, high) if high > low else LogNorm(low / 2, 2 * high)


def bar(
    drawing: Figure | SubFigure,
    panels: Sequence[Axes] | np.ndarray,
    shades: Colormap,
    scale: LogNorm,
    label: str,
    **place: Any,
) -> Colorbar:
    """Beside or below some panels."""
    drawn = colours(drawing, ScalarMappable(scale, shades), label, ax=panels, **place)
    style.decades(drawn.ax)
    return drawn


def colours(drawing: Figure | SubFigure, image: ScalarMappable, label: str, **place: Any) -> Colorbar:
    """Bar of the colours of an image, with a thin frame."""
    drawn = drawing.colorbar(image, **place)
    drawn.set_label(label)
    drawn.outline.set_linewidth(style.width(0.45))
    return drawn
