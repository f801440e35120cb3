"""Force against depth, or depth against load, rough and smooth; off the smooth body; one dimension against three.

At rest, and pressed in at up to three rates.
"""

from matplotlib.figure import Figure
from pandas import DataFrame

from . import style
from .curves import AXES, about, curves, limit, over, panels_of, tables_of
from .plot import Plot, Tables

NAME = "force-depth"
DIFFERENCES = f"{NAME}-differences"
# What is measured, its label and its factor, where load or depth is prescribed.
MEASURED = {"load": ("depth_reached", "depth [µm]", 1e6), "depth": ("normal_force", "normal force [N]", 1.0)}
# Factor and unit of what it is off by: of depths in micrometres, of forces in percent.
OFF = {"load": (1e6, "µm"), "depth": (100.0, "%")}


def plot(points: DataFrame, differences: DataFrame, caption: str = "", folder: str = "") -> Plot | None:
    """Plot of force and depth; None without points.

    points : model, body ("rough", "smooth"), load [N] or depth [m] as prescribed, the other as depth_reached or
        normal_force with _mean, _low and _high, and closed_form, the value of the smooth body in closed form;
        without that column the model "exact" on the smooth body is taken, else "BEM" or another. rate [m/s] of
        pressing in, 0 at rest
    differences : model, body, load or depth, rate, and difference, _low and _high: force divided by the force of
        the reference, minus one, or depth minus the depth of the reference [m]
    """
    if points.empty:
        return None
    if "closed_form" not in points:
        smooth = points[points["body"] == "smooth"]
        known = {model: own.set_index("depth")["normal_force_mean"] for model, own in smooth.groupby("model")}
        points = points[points["model"] != "exact"]
        model = next((each for each in ("exact", "BEM", *known) if each in known), None)
        points = points.assign(closed_form=points["depth"].map(known.get(model, {})))
    text = caption or (
        "Force at a depth at rest, rough and of the smooth body in closed form, or else in 3D; off that; 1D off "
        "3D. Bars: 95 %."
    )
    alternative = "Deviations fall with depth, of rough bodies from the smooth one and of 1D from 3D."
    tables = tables_of({NAME: points, DIFFERENCES: differences})
    return Plot(f"{folder}{NAME}", figure, tables, text, alternative)


def figure(tables: Tables) -> Figure:
    """A column at rest, or for up to three rates."""
    points, differences = tables[NAME], tables.get(DIFFERENCES)
    prescribed = "load" if "load" in points else "depth"
    name, label, times = MEASURED[prescribed]
    (scale, across), (factor, unit) = AXES[prescribed], OFF[prescribed]
    places = panels_of(points, (differences,), "rate")
    drawing = style.canvas("double" if len(places) > 1 else "single", 5.8)
    panels = drawing.subplots(3, len(places), sharex=True, sharey="row", squeeze=False, height_ratios=(1.5, 1, 1))
    for (above, middle, below), (title, (own, apart)) in zip(panels.T, places, strict=True):
        above.set(xscale="log", yscale="log" if prescribed == "depth" else "linear", title=title)
        closed = own.drop_duplicates(prescribed).sort_values(prescribed)
        line = style.line(0.5, 0.8, label="closed form")
        above.plot(scale * closed[prescribed], times * closed["closed_form"], **line)
        curves(above, own[own["body"] == "rough"], prescribed, name, times)
        off = own.filter(regex=f"^{name}_").sub(own["closed_form"], axis=0)
        off = off.div(own["closed_form"], axis=0) if prescribed == "depth" else off
        about(middle, 0, own.assign(**off), prescribed, name, factor)
        if apart is not None:
            about(below, 0, apart, prescribed, "difference", factor)
        below.set_xlabel(across)
    against = over(points).replace("1D / 3D", "1D off 3D").replace("over", "off")
    for axes, text in zip(panels[:, 0], (label, f"off smooth [{unit}]", f"{against} [{unit}]"), strict=True):
        axes.set_ylabel(text)
    if prescribed == "depth":
        limit(panels[0, 0], points, name)
    style.finish(drawing, 2 if len(places) == 1 else 4)
    return drawing
