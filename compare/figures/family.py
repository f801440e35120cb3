"""Friction over that of Eq. 19 against xi: one curve for all series of a shape, if they count through xi alone."""

from matplotlib.figure import Figure
from pandas import DataFrame

from . import shades, style
from .curves import curves, limit
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
    points = tables[NAME].dropna(subset="normal_force")
    models, shapes = points["model"].unique(), points["shape"].unique()
    drawing = style.canvas("double", 3.1)
    panels = drawing.subplots(1, len(models), sharex=True, sharey=True, squeeze=False)[0]
    scale = shades.between(points["normal_force"])
    markers = dict(zip(shapes, style.SERIES_MARKERS, strict=False))
    thin = {"linestyle": "none", "elinewidth": style.width(0.5)}

    def look(shape, force):
        return {"color": shades.PRESS(scale(force)), "marker": markers[shape], **thin}

    for axes, model in zip(panels, models, strict=True):
        axes.axhline(1, **style.line(0.5, 0.8))
        own = points[points["model"] == model]
        curves(axes, own, "xi", "over_eq_19", by=("shape", "normal_force"), look=look)
        axes.set(xscale="log", yscale="log", title=style.label(str(model)), xlabel=r"$\xi$ [1]")
    limit(panels[0], points, "over_eq_19")
    panels[0].set_ylabel("friction / Eq. 19 [1]")
    entries = (style.entry(shape, marker=marker, markerfacecolor="none") for shape, marker in markers.items())
    style.finish(drawing, 6, *entries, *shades.key(shades.PRESS, points["normal_force"], "N"))
    return drawing
