"""The bodies of a contact in a section: colours of both, the undeformed surface, and where they touch."""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from pandas import DataFrame

from . import style
from .prefixes import prefixed

SAND = "#8A7A45"  # of which the elastomer is a tint


class Section(NamedTuple):
    """Heights of both bodies along x above the undeformed surface [m], and where they touch (N,)."""

    x: np.ndarray
    indenter: np.ndarray
    surface: np.ndarray
    touching: np.ndarray


def section_of(table: DataFrame) -> Section:
    """Section that a table holds."""
    return Section(*(table[name].to_numpy() for name in Section._fields))


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


def section(
    axes: Axes, seen: Section, solver: str, span: Sequence[float], limits: Sequence[float], elements: int = 0
) -> None:
    """Both bodies over a span of x between two heights [m], real contact in bold.

    elements : how many are drawn of the row that stands for the elastomer in 1D
    """
    (along, metres), (up, unit) = prefixed(span, "m"), prefixed(limits, "m")
    x, surface, ends = along * seen.x, up * seen.surface, [up * limit for limit in limits]
    if elements:
        some = slice(None, None, max(1, round(len(x) / elements)))
        colours = [style.COLOUR[solver] if pressed else skin() for pressed in seen.touching[some]]
        axes.vlines(x[some], ends[0], surface[some], color=colours, linewidth=style.width(0.6))
    level = style.line(0.35, 0.5, linestyle=(0, (5, 3)), zorder=1.5, label="undeformed surface")
    axes.axhline(0.0, **level)
    # A marker, too, since contact may be at one point.
    bold = {"color": style.COLOUR[solver], "marker": ".", "markersize": style.width(2.2), "markeredgewidth": 0}
    lines = bodies(axes, x, up * seen.indenter, surface, seen.touching, ends, **bold)
    for line, label in zip(lines, ("surface", "real contact"), strict=True):
        line.set_label(label)
    axes.set(xlim=[along * end for end in span], ylim=ends, xlabel=f"x [{metres}]", ylabel=f"height [{unit}]")


def exaggeration(axes: Axes, span: Sequence[float], limits: Sequence[float]) -> None:
    """Say how often heights are drawn larger than lengths, above a section that has its place in the figure."""
    box = axes.get_window_extent()
    times = box.height / (limits[1] - limits[0]) / (box.width / (span[1] - span[0]))
    beside(axes, f"heights × {times:.2g}")


def beside(axes: Axes, text: str) -> None:
    """A remark at the right of the title of a panel."""
    axes.set_title(text, loc="right", fontsize=style.small(), fontweight="normal")


def flow(speed: float) -> str:
    """Which way the indenter slides, against the flow of the elastomer along x."""
    return "at rest" if speed == 0 else "← indenter slides" if speed > 0 else "indenter slides →"
