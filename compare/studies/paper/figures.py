"""Figures of the paper: contacts of a rough cone and sphere, slow friction, and the law up to the plateau."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from pandas import DataFrame, concat

from mdr1d.equations import interpolation

from ...figures import shades, style
from ...figures.contact import section
from ...figures.curves import intervals
from ...figures.plot import Plot, Tables

CONTACTS, STUDIES, LAW = "paper-contacts", "paper-studies", "paper-law"
ALPHA = f"{LAW}-alpha"
# Length of the whole picture over the length of the contact, and width of the close-up [m].
SHOWN, CLOSE = 1.5, 2e-4
BETWEEN = Normalize(0, 1)  # of the Hurst exponent
MARKERS = ("o", "s", "^", "D", "v", "P")
# Marker, its size, line and colour of the shapes as they come, ink without one: the first, small, is drawn over
# the second.
LOOKS = (("o", 0.65, "--", ""), ("s", 1.15, "-.", "#009E73"))


def plot_contacts(sections: Mapping[str, DataFrame]) -> Plot | None:
    """Fig. 1: some contacts, x, indenter, surface, touching by the name of the shape; None without any."""
    if not sections:
        return None
    return Plot(
        CONTACTS,
        draw_contacts,
        {f"{CONTACTS}-{shape}": table for shape, table in sections.items()},
        "Rigid rough profile and surface of the elastomer in steady sliding, heights from the undeformed "
        "surface (dashed). The indenter slides to the left; real contact is bold. Below, "
        f"{CLOSE * 1e3:g} mm (marked above) in which the elastomer leaves the indenter most often: behind each "
        "asperity it is free and returns exponentially.",
        f"The {' and the '.join(sections)} touch with the tips of their roughness, fewer behind than in front.",
    )


def draw_contacts(tables: Tables) -> Figure:
    """A column for each shape. Above: the contact. Below: where it ends most often."""
    drawing = style.canvas("double", 4.4)
    panels = drawing.subplots(2, len(tables), squeeze=False)
    for (above, below), (name, table) in zip(panels.T, tables.items(), strict=True):
        touched = table["x"][table["touching"]]
        margin = (SHOWN - 1) / 2 * np.ptp(touched)
        whole, close = (touched.min() - margin, touched.max() + margin), _close_up(table)
        for axes, span, title in ((above, whole, name.rpartition("-")[2]), (below, close, "close-up")):
            section(axes, table, "MDR", span, _limits(table, span))
            axes.set_title(title)
        along = style.prefixed(whole, "m")[0]
        above.axvspan(along * close[0], along * close[1], **style.line(0.0, 0.4, fill=False, zorder=5))
    style.lettered(panels.flat)
    style.legend(drawing, panels.flat, 3)
    return drawing


def _limits(table, span):
    """Heights [m] around the surface of the elastomer."""
    shown = table["surface"][table["x"].between(*span)]
    room = float(np.ptp(shown))
    return shown.min() - 0.35 * room, shown.max() + 0.45 * room


def _close_up(table):
    """Ends [m] of the stretch with the most ends of contact."""
    x, touched = table["x"], table["touching"].astype(int)
    ends = np.convolve(np.abs(np.diff(touched)), np.ones(round(CLOSE / (x[1] - x[0]))), "valid")
    first = float(x[np.argmax(ends)])
    return first, first + CLOSE


def plot_studies(points: DataFrame) -> Plot:
    """Fig. 3: slow friction on a rough cone in six studies, and what parts it from Eq. 17."""
    return Plot(
        STUDIES,
        draw_studies,
        {STUDIES: points.drop(columns="slow")},
        "Slow friction on a rough cone in six studies, each of a single parameter. (a) μ̃ against ξ with Eqs. 17 "
        "and 19; hollow where a condition of Eq. 17 breaks. (b) μ̃/ξ against r, the ratio of the rms slopes of "
        "macroscopic profile and roughness; Eq. 10 gives 1 + r².",
        "Friction lies on a line of slope one where the conditions hold, and above it where the macroscopic slope "
        "counts.",
    )


def draw_studies(tables: Tables) -> Figure:
    """(a) mu-tilde against xi. (b) Over xi, against the macroscopic slope."""
    points = tables[STUDIES].dropna()
    drawing = style.canvas("double", 3.6)
    left, right = drawing.subplots(1, 2)
    xi, ratio, friction = (points[name] for name in ("xi", "macro_over_rough", "normalised_friction"))
    studies = dict(zip(points["study"].unique(), MARKERS, strict=False))
    for study, marker in studies.items():
        at = points["study"] == study
        edges = shades.PRESS(BETWEEN(points["hurst"][at]))
        look = {"edgecolors": edges, "facecolors": edges * points["holds"][at].to_numpy()[:, None]}
        for axes, x, y in ((left, xi, friction), (right, ratio, friction / xi)):
            axes.scatter(x[at], y[at], style.mark() ** 2, marker=marker, linewidths=0.4, rasterized=True, **look)
    line, r = np.geomspace(xi.min(), xi.max(), 101), np.geomspace(ratio.min(), ratio.max(), 101)
    left.plot(line, line, label=r"Eq. 17, $\tilde{\mu} = \xi$", **style.line(0, 0.7))
    left.plot(line, interpolation(line), "--", label="Eq. 19, α = 1.5", **style.line(0.35, 0.7))
    right.plot(r, 1 + r**2, ":", **style.line(0, 0.7, label="Eq. 10, 1 + r²"))
    for axes, across, up in (
        (left, r"$\xi$ [1]", r"$\tilde{\mu}$ [1]"),
        (right, "rms slope, smooth over rough, r [1]", r"$\tilde{\mu}/\xi$ [1]"),
    ):
        axes.set(xscale="log", yscale="log", xlabel=across, ylabel=up)
    style.decades(left, right)
    style.lettered((left, right))
    drawing.colorbar(ScalarMappable(BETWEEN, shades.PRESS), ax=[left, right], label="Hurst exponent [1]")
    hollow = style.entry("a condition breaks", markerfacecolor="none")
    style.legend(
        drawing, (left, right), 4, *(style.entry(name, marker=each) for name, each in studies.items()), hollow
    )
    return drawing


def plot_law(points: Sequence[DataFrame], fits: DataFrame) -> Plot:
    """Fig. 4: friction of some shapes against Eq. 19.

    points : of each shape; fits : exponents of Eq. 19, a row for each shape
    """
    return Plot(
        LAW,
        draw_law,
        {LAW: concat(points, ignore_index=True), ALPHA: fits},
        "μ̃ against ξ: means over profiles with intervals of 95 %, and Eq. 19 with α = 1.5. Below: deviation "
        "from it of the points and of Eq. 19 with the best α of each shape. Hollow: a condition breaks.",
        "Friction follows one law up to its plateau, with an exponent that depends on the shape.",
    )


def draw_law(tables: Tables) -> Figure:
    """Above: mu-tilde with Eq. 19. Below: its deviation from Eq. 19 with alpha = 1.5."""
    points, fits = tables[LAW], tables[ALPHA]
    drawing = style.canvas("single", 5.0)
    above, below = panels = drawing.subplots(2, 1, sharex=True, height_ratios=(2, 1.7))
    xi = np.geomspace(points["xi"].min(), points["xi"].max(), 201)
    above.plot(xi, interpolation(xi), **style.line(0.5, 0.8, label="Eq. 19, α = 1.5"))
    below.axhline(0, **style.line(0.6, 0.45))
    for fit, (marker, size, line, colour) in zip(fits.itertuples(), LOOKS, strict=False):
        own, colour = points[points["shape"] == fit.shape], colour or style.ink()
        off = own.filter(like="normalised_friction").div(interpolation(own["xi"].to_numpy()), axis=0) - 1
        label = f"{fit.shape}: best α = {fit.alpha:.2f} ({fit.alpha_low:.2f} to {fit.alpha_high:.2f})"
        look: dict[str, Any] = {"color": colour, "fmt": marker, "markersize": style.mark(size), "label": label}
        look |= {"zorder": 3 - size / 2} | ({} if own["holds"].all() else {"markerfacecolor": style.paper()})
        intervals(above, own["xi"], own, "normalised_friction", **look)
        intervals(below, own["xi"], off, "normalised_friction", 100, **look)
        best = interpolation(xi, fit.alpha) / interpolation(xi) - 1
        below.plot(xi, 100 * best, line, color=colour, linewidth=style.width(0.8))
    above.set(xscale="log", yscale="log", ylabel=r"$\tilde{\mu}$ [1]")
    below.set(xlabel=r"$\xi$ [1]", ylabel="deviation from Eq. 19,\nα = 1.5 [%]")
    style.lettered(panels)
    style.decades(*panels)
    style.legend(drawing, [above], 1)
    return drawing
