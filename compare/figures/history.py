"""A contact over time, or over the displacement: force, depth and tangential force of every model."""

from matplotlib.figure import Figure
from pandas import DataFrame

from scene import Cylinder, Scene

from . import style
from .plot import Plot, Tables

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
    points = tables[NAME].sort_values(across)
    least = {name: ROUNDING * points["normal_force"].abs().max() for name in ("normal_force", "friction_force")}
    shown = [name for name in QUANTITIES if points[name].abs().max() > least.get(name, 0)]
    drawing = style.canvas("single", 0.8 + 1.6 * len(shown))
    panels = drawing.subplots(len(shown), 1, sharex=True, squeeze=False)[:, 0]
    factors = {name: style.prefixed(points[name], UNITS.get(name, unit)) for name in (across, *shown)}
    for axes, name in zip(panels, shown, strict=True):
        for model, own in points.groupby("model", sort=False):
            look, x = style.look(str(model), marker=""), factors[across][0] * own[across]
            low, middle, high = (
                factors[name][0] * own.get(f"{name}{end}", own[name]) for end in ("_low", "", "_high")
            )
            axes.plot(x, middle, **look)
            axes.fill_between(x, low, high, color=look["color"], alpha=0.2, linewidth=0)
        axes.set_ylabel(f"{WORDS[name]} [{factors[name][1]}]")
    panels[-1].set_xlabel(f"{WORDS[across]} [{factors[across][1]}]")
    style.finish(drawing, 2)
    return drawing
