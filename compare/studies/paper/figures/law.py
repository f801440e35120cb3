"""Friction from slow to the plateau for a rough cone and a rough sphere against Eq. 19 (paper, Fig. 4)."""

from collections.abc import Sequence

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
# Marker, its size and line of the shapes, in the order in which they come: the first, small and dark, is drawn
# over the second.
LOOKS = (("o", 0.65, "--"), ("s", 1.15, "-."))


def plot(points: Sequence[DataFrame], fits: DataFrame) -> Plot | None:
    """The plot of some shapes; None without any.

    points : of each shape; fits : exponents of Eq. 19, a row for each shape
    """
    if not points:
        return None
    told = [
        f"{fit.shape}: best α {fit.alpha:.2f} ({fit.alpha_low:.2f} to {fit.alpha_high:.2f}), of planes "
        f"{fit.alpha_of_planes:.2f}"
        for fit in fits.itertuples()
    ]
    return Plot(
        NAME,
        figure,
        {NAME: concat(points, ignore_index=True), ALPHA: fits},
        "μ̃ against ξ: means over profiles with intervals of 95 %, and Eq. 19 with α = 1.5. Below: deviation "
        "from it of the points and of Eq. 19 with the best α of each shape. Dotted: every place of the contact "
        "a rough plane pressed as deep as it is there. Hollow: a condition breaks.",
        f"Friction follows one law up to its plateau. {'; '.join(told)}.",
    )


def figure(tables: Tables) -> Figure:
    """Above: mu-tilde with Eq. 19. Below: its deviation from Eq. 19 with alpha = 1.5."""
    points, fits = tables[NAME], tables[ALPHA]
    drawing = style.canvas("single", 5.0)
    above, below = drawing.subplots(2, 1, sharex=True, height_ratios=(2, 1.7))
    xi = np.geomspace(points["xi"].min(), points["xi"].max(), 201)
    above.plot(xi, interpolation(xi), **style.line(0.5, 0.8, label="Eq. 19, α = 1.5", zorder=1))
    below.axhline(0, **style.line(0.6, 0.45, zorder=0))
    for fit, (colour, tint), (marker, size, line) in zip(fits.itertuples(), _colours(), LOOKS, strict=False):
        own = points[points["shape"] == fit.shape]
        own = own[np.isfinite(own["normalised_friction"])]
        unit = interpolation(own["xi"].to_numpy())
        look = {
            "color": colour,
            "marker": marker,
            "linestyle": "none",
            "markersize": style.mark(size),
            "elinewidth": style.width(0.7),
            "markerfacecolor": tint if own["holds"].all() else style.paper(),
            "markeredgewidth": style.width(0.7),
            "zorder": 3 - size / 2,
        }
        label = f"{fit.shape}: best α = {fit.alpha:.2f} ({fit.alpha_low:.2f} to {fit.alpha_high:.2f})"
        intervals(above, own["xi"], own, "normalised_friction", label=label, **look)
        off = own[[name for name in own if name.startswith("normalised_friction")]].div(unit, axis=0) - 1
        intervals(below, own["xi"], off, "normalised_friction", 100, **look)
        best = interpolation(xi, fit.alpha) / interpolation(xi) - 1
        thin = {"color": colour, "linewidth": style.width(0.8), "zorder": 1}
        below.plot(xi, 100 * best, line, label=f"{fit.shape}, best α", **thin)
        planes, thin["linewidth"] = 100 * off["normalised_friction_of_planes"], style.width()
        below.plot(own["xi"], planes, ":", label=f"{fit.shape}, planes", **thin)
    style.span(above, xi)
    above.set(xscale="log", yscale="log", ylabel=r"$\tilde{\mu}$ [1]")
    above.legend(loc="lower right")
    slopes = ", ".join(f"{slope:.2g}" for slope in sorted(set(points["rms_slope"])))
    above.text(0.03, 0.95, f"rms slope {slopes}", transform=above.transAxes, va="top", fontsize=style.small())
    below.set(xlabel=r"$\xi$ [1]", ylabel="deviation from Eq. 19,\nα = 1.5 [%]")
    labels = below.get_legend_handles_labels()[1]
    columns = style.columns(labels, 0.8 * drawing.get_figwidth(), 2)
    below.legend(ncols=columns, loc="lower right", bbox_to_anchor=(1, 1), borderaxespad=0.1)
    lettered((above, below))
    style.decades(above, below)
    clear(drawing, (above,))
    return drawing


def _colours():
    """Colours of the shapes: of lines and edges, and of the inside of markers."""
    return (style.ink(), style.ink()), ("#009E73", "#A6DCCB")
