"""Friction over that of Eq. 19 against xi: one curve for all series of a shape, if they count through xi alone."""

from matplotlib.figure import Figure
from pandas import DataFrame

from . import shades, style
from .curves import intervals, limit
from .plot import Plot, Tables

NAME = "family"


def plot(points: DataFrame) -> Plot:
    """Plot of several series.

    points : model, shape, series, normal_force [N], xi (Eq. 18), over_eq_19, over_eq_19_low and over_eq_19_high
    """
    caption = (
        "Friction over that of Eq. 19 at the same ξ (Eq. 18) and plateau (Eq. 14), for all roughness and solids "
        "of a shape, by colour of the load. If they count through ξ alone, the points of a shape are one curve. "
        "Bars: 95 %, cut at the frame."
    )
    return Plot(NAME, figure, {NAME: points}, caption, "Friction over Eq. 19 against ξ, left 1D, right 3D")


def figure(tables: Tables) -> Figure:
    """A panel for each model: a marker for each shape, a shade for each load."""
    points = tables[NAME]
    models, shapes = points["model"].unique(), points["shape"].unique()
    drawing = style.canvas("double", 3.1)
    panels = drawing.subplots(1, len(models), sharex=True, sharey=True, squeeze=False)[0]
    scale = shades.between(points["normal_force"].dropna())
    markers = dict(zip(shapes, style.SERIES_MARKERS, strict=False))
    for axes, model in zip(panels, models, strict=True):
        axes.axhline(1, **style.line(0.5, 0.8))
        own = points[points["model"] == model].dropna(subset="normal_force")
        for (shape, force), curve in own.groupby(["shape", "normal_force"]):
            look = {"color": shades.PRESS(scale(force)), "marker": markers[shape], "linestyle": "none"}
            intervals(axes, curve["xi"], curve, "over_eq_19", elinewidth=style.width(0.5), **look)
        axes.set(xscale="log", yscale="log", title=style.label(str(model)), xlabel=r"$\xi$ [1]")
    limit(panels[0], points, "over_eq_19")
    panels[0].set_ylabel("friction / Eq. 19 [1]")
    style.lettered(panels)
    style.decades(*panels)
    entries = (style.entry(shape, marker=marker, markerfacecolor="none") for shape, marker in markers.items())
    style.legend(drawing, (), 6, *entries, *shades.key(shades.PRESS, points["normal_force"].dropna(), "N"))
    return drawing
