"""Friction against load or depth, a curve for each speed: a panel for each model, or one for all at one speed."""

from typing import Any

from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from pandas import DataFrame

from . import shades, style
from .curves import AXES, curves, limit, tables_of
from .friction_speed import THEORY, line_look
from .plot import Plot, Tables
from .shades import CURVES, few

NAME = "friction-load"
LINES = f"{NAME}-lines"


def plot(points: DataFrame, lines: DataFrame | None = None, caption: str = "", folder: str = "") -> Plot | None:
    """Plot of friction against load or depth; None where nothing slides.

    points : model, speed [m/s], load [N] or depth [m], friction_coefficient_mean, _low and _high
    lines : model, speed, load or depth, friction_coefficient, and kind: a theory, which all panels show, or
        another of `friction_speed.KINDS` of a model, which its own panel shows
    """
    if not (points["speed"] > 0).any():
        return None
    told = caption or f"Coefficient of friction against load or depth, at up to {CURVES} speeds."
    alternative = "Friction of each model against load or depth, a curve for each speed."
    return Plot(f"{folder}{NAME}", figure, tables_of({NAME: points, LINES: lines}), told, alternative)


def figure(tables: Tables) -> Figure:
    """Panel for each model, on the same axes."""
    points, lines = tables[NAME], tables.get(LINES)
    across = "load" if "load" in points else "depth"
    scale, label = AXES[across]
    speeds = few(points["speed"][points["speed"] > 0], CURVES)
    points = points[points["speed"].isin(speeds)]
    several, models = len(speeds) > 1, list(points["model"].unique())
    by_speed = shades.looks(speeds, "m/s")
    drawing = style.canvas("double" if several else "single", 3.3)
    panels = drawing.subplots(1, len(models) if several else 1, sharex=True, sharey=True, squeeze=False)[0]
    grey: list[Line2D] = []
    for axes, model in zip(panels if several else panels.repeat(len(models)), models, strict=True):
        axes.set(xscale="log", yscale="log", xlabel=label, title=style.label(model) if several else "")
        by: tuple[str, Any] = ("speed", by_speed) if several else ("model", style.look)
        curves(axes, points[points["model"] == model], across, "friction_coefficient", by=by[:1], look=by[1])
        if lines is not None:
            shown = lines[(lines["kind"] == THEORY) | (lines["model"] == model)].sort_values(across)
            for (kind, name, speed), own in shown[shown["speed"].isin(speeds)].groupby(["kind", "model", "speed"]):
                look = line_look(kind, name)
                grey += [Line2D([], [], **look | {"color": style.grey(0.3)})] * several
                look |= {"color": by_speed(speed)["color"]} if several else {}
                axes.plot(scale * own[across], own["friction_coefficient"], **look)
    panels[0].set_ylabel("friction coefficient [1]")
    limit(panels[0], points, "friction_coefficient")
    style.finish(drawing, 5 if several else 2, *grey)
    return drawing
