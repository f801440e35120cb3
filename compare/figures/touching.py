"""The bodies of a contact in a section: colours of both, the undeformed surface, and where they touch."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from . import style

SAND = "#8A7A45"  # of which the elastomer is a tint


def elastomer() -> tuple[float, float, float]:
    """Colour of the inside of the elastomer, light on paper that is light and dark on dark."""
    return style.mixed(style.paper(), SAND, 0.25)


def skin() -> tuple[float, float, float]:
    """Colour of the line where the elastomer ends."""
    return style.mixed(style.ink(), SAND, 0.75)


def rigid() -> tuple[float, float, float]:
    """Colour of the inside of what is rigid."""
    return style.grey(0.7)


def bodies(axes: Axes, x, indenter, surface, touching, ends: Sequence[float], **look: Any) -> list[Line2D]:
    """Elastomer and rigid indenter between two heights, in the units of the axes.

    Returns the lines of the surface and of real contact, which is in bold; look : of that.
    """
    bottom, top = ends
    axes.fill_between(x, np.maximum(surface, bottom), bottom, color=elastomer(), linewidth=0)
    axes.fill_between(x, np.minimum(indenter, top), top, color=rigid(), linewidth=0)
    look = {"color": style.COLOUR["MDR"], "linewidth": style.width(2.2), "solid_capstyle": "butt", **look}
    thin = axes.plot(x, surface, color=skin(), linewidth=style.width(0.65))
    return [*thin, *axes.plot(x, np.where(touching, surface, np.nan), **look)]


def flow(speed: float) -> str:
    """Which way the indenter slides, against the flow of the elastomer along x."""
    return "at rest" if speed == 0 else "← indenter slides" if speed > 0 else "indenter slides →"
