"""A contact over time, or over the displacement: force, depth and tangential force of every model."""

from matplotlib.figure import Figure
from pandas import DataFrame

from . import style
from .lettering import lettered
from .panels import legend
from .plot import Plot, Tables

NAME = "history"
# Factor and label of an axis across, and of each quantity.
ACROSS = {
    "time": (1.0, "time [s]"),
    "displacement": (1e6, "displacement [µm]"),
    "force": (1.0, "tangential force [N]"),
}
QUANTITIES = {
    "normal_force": (1.0, "normal force [N]"),
    "depth_reached": (1e6, "depth [µm]"),
    "friction_force": (1.0, "tangential force [N]"),
}


def plot(points: DataFrame, across: str, folder: str = "") -> Plot:
    """Plot of a history.

    points : model, what is across, and normal_force [N], depth_reached [m] and friction_force [N], each with
        _mean, _low and _high
    across : time [s], displacement [m] or force [N]
    """
    told = {"time": "time", "displacement": "the displacement", "force": "the tangential force"}[across]
    caption = f"Forces and depth of every model over {told}; bands: intervals of 95 %."
    return Plot(f"{folder}{NAME}", figure, {NAME: points}, caption, "Histories of both models", {"across": across})


def figure(tables: Tables, across: str) -> Figure:
    """A panel for each quantity that changes."""
    points, (scale, label) = tables[NAME], ACROSS[across]
    shown = [name for name in QUANTITIES if points[f"{name}_mean"].abs().max() > 1e-9 * _size(points, name)]
    drawing = style.canvas("single", 0.8 + 1.6 * len(shown))
    panels = drawing.subplots(len(shown), 1, sharex=True, squeeze=False)[:, 0]
    for axes, name in zip(panels, shown, strict=True):
        times, words = QUANTITIES[name]
        for model, own in points.sort_values(across).groupby("model", sort=False):
            look = style.look(str(model), marker="")
            axes.plot(scale * own[across], times * own[f"{name}_mean"], **look)
            ends = times * own[f"{name}_low"], times * own[f"{name}_high"]
            axes.fill_between(scale * own[across], *ends, color=look["color"], alpha=0.2, linewidth=0)
        axes.set_ylabel(words)
    panels[-1].set_xlabel(label)
    lettered(panels)
    legend(drawing, panels, 2)
    return drawing


def _size(points, name):
    """What counts as rounding of a quantity: a force against the largest force."""
    return points["normal_force_mean"].abs().max() if name.endswith("force") else 0.0
