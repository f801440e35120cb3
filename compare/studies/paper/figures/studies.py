"""Slow friction on a rough cone in six studies against Eq. 17, and what parts them from it (paper, Fig. 3)."""

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from pandas import DataFrame

from mdr1d.equations import interpolation

from ....figures import shades, style
from ....figures.curves import scatter
from ....figures.lettering import clear
from ....report.page import Plot, Tables

NAME = "paper-studies"
BETWEEN = Normalize(0, 1)  # of the Hurst exponent
MARKERS = ("o", "s", "^", "D", "v", "P")


def plot(points: DataFrame) -> Plot:
    """The plot of all studies."""
    return Plot(
        NAME,
        figure,
        {NAME: points.drop(columns="slow")},
        "Slow friction on a rough cone in six studies of one parameter each. (a) μ̃ against ξ with Eqs. 17 and "
        "19; hollow where a condition of Eq. 17 breaks. (b) μ̃/ξ against the rms slope of the macroscopic "
        "profile over that of the roughness, r; Eq. 10 gives 1 + r².",
        "Friction lies on a line of slope one where the conditions hold, and above it where the macroscopic slope "
        "counts.",
    )


def figure(tables: Tables) -> Figure:
    """(a) mu-tilde against xi. (b) Over xi, against the macroscopic slope."""
    points = tables[NAME].dropna()
    drawing = style.canvas("double", 3.6)
    left, right = drawing.subplots(1, 2)
    xi, ratio, friction = (points[name] for name in ("xi", "macro_over_rough", "normalised_friction"))
    colours = shades.PRESS(BETWEEN(points["hurst"]))
    studies = dict(zip(points["study"].unique(), MARKERS, strict=False))
    for study, marker in studies.items():
        at = points["study"] == study
        for axes, x, y in ((left, xi, friction), (right, ratio, friction / xi)):
            look = {"marker": marker, "empty": "none", "rasterized": True, "zorder": 2}
            scatter(axes, x[at], y[at], points["holds"][at], colours[at], 0.75, 0.3, **look)
    line, r = np.geomspace(xi.min(), xi.max(), 101), np.geomspace(ratio.min(), ratio.max(), 101)
    left.plot(line, line, label=r"Eq. 17, $\tilde{\mu} = \xi$", **style.line(0, 0.55, zorder=3))
    left.plot(line, interpolation(line), "--", label="Eq. 19, α = 1.5", **style.line(0.35, 0.55, zorder=3))
    right.plot(r, 1 + r**2, **style.line(0, 0.7, zorder=3, label="Eq. 10, 1 + r²"))
    for axes, across, up, title in (
        (left, r"$\xi$ [1]", r"$\tilde{\mu}$ [1]", "(a)"),
        (right, "rms slope, smooth over rough, r [1]", r"$\tilde{\mu}/\xi$ [1]", "(b)"),
    ):
        axes.set(xscale="log", yscale="log", xlabel=across, ylabel=up, title=title)
        axes.legend(loc="upper left")
    style.span(left, xi)
    style.span(right, ratio)
    style.decades(left, right)
    shades.colours(drawing, ScalarMappable(BETWEEN, shades.PRESS), "Hurst exponent [1]", ax=[left, right])
    look = {"linestyle": "none", "color": style.grey(0.3)}
    handles = [Line2D([], [], marker=marker, label=study, **look) for study, marker in studies.items()]
    handles.append(Line2D([], [], marker="o", markerfacecolor="none", label="a condition breaks", **look))
    style.legend(drawing, handles, "outside lower center", 7, handletextpad=0.1, columnspacing=1.0)
    clear(drawing, [left, right])
    return drawing
