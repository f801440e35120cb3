"""Friction from slow to the plateau for a rough cone and a rough sphere against Eq. 19 (paper, Fig. 4)."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from pandas import DataFrame, concat

from mdr1d.equations import interpolation

from ....figures import style
from ....figures.curves import intervals
from ....figures.lettering import clear, lettered
from ....report.page import Plot, Tables

NAME = "paper-law"
ALPHA = f"{NAME}-alpha"
# Marker, its size, line and colour of the shapes as they come, ink without one: the first, small, is drawn over
# the second.
LOOKS = (("o", 0.65, "--", ""), ("s", 1.15, "-.", "#009E73"))


def plot(points: Sequence[DataFrame], fits: DataFrame) -> Plot:
    """The plot of some shapes.

    points : of each shape; fits : exponents of Eq. 19, a row for each shape
    """
    return Plot(
        NAME,
        figure,
        {NAME: concat(points, ignore_index=True), ALPHA: fits},
        "μ̃ against ξ: means over profiles with intervals of 95 %, and Eq. 19 with α = 1.5. Below: deviation "
        "from it of the points and of Eq. 19 with the best α of each shape. Hollow: a condition breaks.",
        "Friction follows one law up to its plateau, with an exponent that depends on the shape.",
    )


def figure(tables: Tables) -> Figure:
    """Above: mu-tilde with Eq. 19. Below: its deviation from Eq. 19 with alpha = 1.5."""
    points, fits = tables[NAME], tables[ALPHA]
    drawing = style.canvas("single", 5.0)
    above, below = drawing.subplots(2, 1, sharex=True, height_ratios=(2, 1.7))
    xi = np.geomspace(points["xi"].min(), points["xi"].max(), 201)
    above.plot(xi, interpolation(xi), **style.line(0.5, 0.8, label="Eq. 19, α = 1.5", zorder=1))
    below.axhline(0, **style.line(0.6, 0.45, zorder=0))
    for fit, (marker, size, line, colour) in zip(fits.itertuples(), LOOKS, strict=False):
        own, colour = points[points["shape"] == fit.shape], colour or style.ink()
        off = own.filter(like="normalised_friction").div(interpolation(own["xi"].to_numpy()), axis=0)
        label = f"{fit.shape}: best α = {fit.alpha:.2f} ({fit.alpha_low:.2f} to {fit.alpha_high:.2f})"
        look: dict[str, Any] = {"color": colour, "fmt": marker, "markersize": style.mark(size), "label": label}
        look |= {"zorder": 3 - size / 2} | ({} if own["holds"].all() else {"markerfacecolor": style.paper()})
        intervals(above, own["xi"], own, "normalised_friction", **look)
        intervals(below, own["xi"], off, "normalised_friction", 100, less=1, **look)
        best = interpolation(xi, fit.alpha) / interpolation(xi) - 1
        below.plot(xi, 100 * best, line, color=colour, linewidth=style.width(0.8), zorder=1)
    style.span(above, xi)
    above.set(xscale="log", yscale="log", ylabel=r"$\tilde{\mu}$ [1]")
    above.legend(loc="lower right")
    below.set(xlabel=r"$\xi$ [1]", ylabel="deviation from Eq. 19,\nα = 1.5 [%]")
    lettered((above, below))
    style.decades(above, below)
    clear(drawing, (above,))
    return drawing
