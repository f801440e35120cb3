"""What makes slow friction depend on the load: real contact, friction over it, and the slope in contact."""

from matplotlib.figure import Figure
from pandas import DataFrame

from . import style
from .curves import curves
from .plot import Plot, Tables

NAME = "slow-friction"
# Each over its number under the least load.
CAUSES = {"contact": "real contact", "drag": "friction / contact", "slope": "slope in contact"}


def plot(points: DataFrame, folder: str = "") -> Plot:
    """Plot of the causes at the slowest speed.

    points : model, normal_force [N], and each of CAUSES over its number under the least load, NAME, NAME_low and
        NAME_high, with NAME_law, as the paper derives it
    """
    caption = (
        "Behind Eq. 17, at the slowest speed, over the numbers under the least load: (a) real contact, a length "
        "in 1D and an area in 3D; (b) friction over it; (c) rms slope of what touches. Thin dashes: as the paper "
        "derives it, contact like the nominal one, the others constant. Bars: 95 %."
    )
    return Plot(f"{folder}{NAME}", figure, {NAME: points}, caption, "Three causes against load, in 1D and 3D")


def figure(tables: Tables) -> Figure:
    """A panel for each cause."""
    points = tables[NAME]
    drawing = style.canvas("double", 2.7)
    panels = drawing.subplots(1, len(CAUSES), sharex=True)
    for axes, (name, title) in zip(panels, CAUSES.items(), strict=True):
        curves(axes, points, "normal_force", name)
        for k, (model, own) in enumerate(points.groupby("model", sort=False)):
            law = style.look(str(model), marker="", linewidth=style.width(0.8), linestyle=(3 * k, (3, 3)))
            axes.plot(own["normal_force"], own[f"{name}_law"], **law | {"label": f"{law['label']}, the paper"})
        axes.set(xscale="log", xlabel="normal force [N]", title=title)
        axes.set_ylabel(f"over that at {points['normal_force'].min():.3g} N [1]")
    panels[0].set_yscale("log")
    style.finish(drawing, 4)
    return drawing
