"""Elastomer and rigid indenter where they touch, as a section along x."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from pandas import DataFrame

from . import style
from .prefixes import prefixed

ELASTOMER, SKIN = ("#8A7A45", 0.25), "#6E6237"  # inside of the elastomer, and the line where it ends


def section(
    axes: Axes, table: DataFrame, solver: str, span: Sequence[float], limits: Sequence[float], elements: int = 0
) -> None:
    """Both bodies over a span of x between two heights [m], real contact in bold.

    table : x, heights of indenter and surface above the undeformed surface [m], and where they are touching
    elements : how many are drawn of the row that stands for the elastomer in 1D
    """
    (along, metres), (up, unit) = prefixed(span, "m"), prefixed(limits, "m")
    x, indenter, surface = along * table["x"], up * table["indenter"], up * table["surface"]
    bottom, top = (up * limit for limit in limits)
    colour, touching = style.colour(solver), table["touching"].astype(bool)
    axes.fill_between(x, np.maximum(surface, bottom), bottom, color=ELASTOMER, linewidth=0)
    axes.fill_between(x, np.minimum(indenter, top), top, color=style.grey(0.7), linewidth=0)
    if elements:
        some = slice(None, None, max(1, round(len(x) / elements)))
        colours = np.where(touching[some], colour, SKIN)
        axes.vlines(x[some], bottom, surface[some], color=colours, linewidth=style.width(0.6))
    axes.axhline(0.0, **style.line(0.35, 0.5, linestyle=(0, (5, 3)), label="undeformed surface"))
    axes.plot(x, surface, color=SKIN, linewidth=style.width(0.65), label="surface")
    # A marker, too, since contact may be at one point.
    bold: dict[str, Any] = {"color": colour, "linewidth": style.width(2.2), "solid_capstyle": "butt"}
    bold |= {"marker": ".", "markersize": style.width(2.2), "markeredgewidth": 0}
    axes.plot(x, surface.where(touching), label="real contact", **bold)
    axes.set(xlim=[along * end for end in span], ylim=(bottom, top))
    axes.set(xlabel=f"x [{metres}]", ylabel=f"height [{unit}]")
