"""Friction against speed, or against load or depth, of every model in up to three panels; below, ratios."""

from math import ceil
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from pandas import DataFrame

from . import style
from .curves import AXES, PANELS, about, curves, limit, over, panels_of, tables_of
from .plot import Plot, Tables

SPEED, LOAD, SMOOTH_SPEED = "friction-speed", "friction-load", "smooth-speed"
SLOW = 2  # friction of a smooth body in 1D over that in 3D at low speed, as derived for a sphere
RATIOS, LINES = "-ratios", "-lines"
QUANTITY = "friction_coefficient"
THEORY, EQ_19, SMOOTH = KINDS = "theory", "Eq. 19", "smooth"


def plot(
    points: DataFrame,
    ratios: DataFrame | None = None,
    lines: DataFrame | None = None,
    caption: str = "",
    folder: str = "",
    name: str = SPEED,
) -> Plot | None:
    """Plot of friction; None where nothing slides.

    points : model, speed [m/s], friction_coefficient_mean, _low and _high; load [N] or depth [m] where there
        are several
    ratios : model, body ("rough", "smooth"), speed, load or depth, ratio, ratio_low and ratio_high: friction over
        the friction of the reference
    lines : model, speed, load or depth, friction_coefficient, and kind, one of KINDS
    name : SPEED, with a panel for each load or depth; LOAD, with one for each speed; SMOOTH_SPEED, of a smooth
        body
    """
    if not (points["speed"] > 0).any():
        return None
    across = "load or depth" if name == LOAD else "speed"
    text = caption or f"Coefficient of friction against {across}; below, its ratio to the reference."
    alternative = f"Friction of all models against {across} on logarithmic axes; below, their ratio."
    tables = tables_of({name: points, f"{name}{RATIOS}": ratios, f"{name}{LINES}": lines})
    return Plot(f"{folder}{name}", figure, tables, text, alternative, {"name": name})


def figure(tables: Tables, name: str = SPEED) -> Figure:
    """Three panels side by side at most; below, over the reference where it is known."""
    points, ratios, lines = tables[name], tables.get(f"{name}{RATIOS}"), tables.get(f"{name}{LINES}")
    pressed = "load" if "load" in points else "depth"
    across, panel = (pressed, "speed") if name == LOAD else ("speed", pressed)
    places, (scale, label) = panels_of(points, (ratios, lines), panel), AXES[across]
    heights = (1.0,) if ratios is None else (2.2, 1.0)
    wide, deep = min(len(places), PANELS), ceil(len(places) / PANELS)
    drawing = style.canvas("single" if wide == 1 else "double", 0.9 + deep * sum(heights))
    shape: dict[str, Any] = {"sharex": True, "sharey": "row", "squeeze": False, "height_ratios": heights * deep}
    grid = drawing.subplots(deep * len(heights), wide, **shape)
    stacks = [column for row in np.split(grid, deep) for column in row.T]
    for (above, *below), (title, (own, over_reference, known)) in zip(stacks, places, strict=False):
        above.set(xscale="log", yscale="log", title=title)
        curves(above, own, across, QUANTITY)
        if lines is not None:
            for (kind, model), line in known.sort_values(across).groupby(["kind", "model"], sort=False):
                above.plot(scale * line[across], line[QUANTITY], **line_look(kind, model))
        limit(above, points, QUANTITY)
        for axes in below:
            if name == SMOOTH_SPEED:
                axes.axhline(SLOW, **style.line(0.75, 4.0, zorder=0, label="2, derived for low speed"))
            about(axes, 1, over_reference, across, "ratio")
        (above, *below)[-1].set_xlabel(label)
    for row, axes in enumerate(grid[:, 0]):
        if row % len(heights):  # once all panels of the row are drawn, which have one axis
            axes.set_ylim(0, max(1.1, axes.get_ylim()[1]))
        axes.set_ylabel(f"{over(points)} [1]" if row % len(heights) else "friction coefficient [1]")
    for spare in np.ravel(stacks[len(places) :]):
        spare.remove()
    style.finish(drawing, 2 if wide == 1 else 5)
    return drawing


def line_look(kind: str, model: str) -> dict[str, Any]:
    """Look of a line drawn with the models, thin and without markers."""
    look = style.look(model, marker="", linewidth=style.width(0.7))
    if kind != THEORY:
        look["label"] += f", {kind}"
    if kind == EQ_19:  # dashes of 1D and of 3D lie in the gaps of each other: the laws of both may coincide
        look["linestyle"] = (0 if model == "MDR" else 3, (3, 3))
    elif model not in style.COLOURS:
        look |= {"color": style.ink(), "linestyle": ":"}
    return look
