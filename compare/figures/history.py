"""A contact over time, or over the displacement: force, depth and tangential force of every model."""

from matplotlib.figure import Figure
from pandas import DataFrame

from scene import Cylinder, Scene

from . import style
from .plot import Plot, Tables
from .prefixes import prefixed

NAME = "history"
# Words of each quantity, and its unit; those without one are forces.
WORDS = {
    "time": "time",
    "displacement": "displacement",
    "force": "tangential force",
    "normal_force": "normal force",
    "depth_reached": "depth",
    "friction_force": "tangential force",
}
UNITS = {"time": "s", "displacement": "m", "depth_reached": "m"}
QUANTITIES = "normal_force", "depth_reached", "friction_force"
ROUNDING = 1e-9  # of the largest normal force, below which a force is none


def plot(points: DataFrame, across: str, scene: Scene, folder: str = "") -> Plot:
    """Plot of a history.

    points : model, what is across, and normal_force [N], depth_reached [m] and friction_force [N], each alone or
        with _low and _high
    across : time [s], displacement [m] or force [N]
    """
    caption = f"Forces and depth of every model over {WORDS[across]}"
    caption += "; bands: intervals of 95 %." if "depth_reached_low" in points else "."
    options = {"across": across, "unit": "N/m" if isinstance(scene.indenter, Cylinder) else "N"}
    return Plot(f"{folder}{NAME}", figure, {NAME: points}, caption, "Histories of both models", options)


def figure(tables: Tables, across: str, unit: str = "N") -> Figure:
    """A panel for each quantity that changes. unit : of forces"""
    points = tables[NAME]
    least = {name: ROUNDING * points["normal_force"].abs().max() for name in ("normal_force", "friction_force")}
    shown = [name for name in QUANTITIES if points[name].abs().max() > least.get(name, 0)]
    drawing = style.canvas("single", 0.8 + 1.6 * len(shown))
    panels = drawing.subplots(len(shown), 1, sharex=True, squeeze=False)[:, 0]
    scale, label = _scaled(points, across, unit)
    for axes, name in zip(panels, shown, strict=True):
        up, words = _scaled(points, name, unit)
        for model, own in points.sort_values(across).groupby("model", sort=False):
            look = style.look(str(model), marker="")
            axes.plot(scale * own[across], up * own[name], **look)
            if f"{name}_low" in own:
                ends = up * own[f"{name}_low"], up * own[f"{name}_high"]
                axes.fill_between(scale * own[across], *ends, color=look["color"], alpha=0.2, linewidth=0)
        axes.set_ylabel(words)
    panels[-1].set_xlabel(label)
    style.lettered(panels)
    style.legend(drawing, panels, 2)
    return drawing


def _scaled(points: DataFrame, name: str, unit: str) -> tuple[float, str]:
    """Factor on a quantity, and its label with the unit that it then has."""
    up, told = prefixed(points[name], UNITS.get(name, unit))
    return up, f"{WORDS[name]} [{told}]"
