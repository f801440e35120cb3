"""Friction of several scenes in the same axes, in one and in three dimensions."""

from collections.abc import Mapping
from math import log

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from pandas import DataFrame, concat

from ....figures import shades, style
from ....figures.curves import intervals
from ....figures.lettering import lettered, literal
from ....report.page import Plot, Tables
from ....solving.vocabulary import head
from ..curves import LOAD, SPEED
from .friction_curves import APART

NAME = "cases"
# Panels: curve, and the column that stands across.
PANELS = {SPEED: "speed", LOAD: "normal_force_mean"}


def plot(points: Mapping[str, DataFrame], speeds: Mapping[str, float]) -> Plot | None:
    """Plot of friction of scenes by name; None where none slides. speeds : of the scenes as they stand [m/s]"""
    tables = {}
    for curve, across in PANELS.items():
        rows = [_nearest(own[own["curve"] == curve], curve, speeds[case]) for case, own in points.items()]
        names = ["solver", across, *(f"friction_coefficient_{end}" for end in ("mean", "low", "high"))]
        every = concat([each[names].assign(case=case) for case, each in zip(points, rows, strict=True)])
        if not every.empty:
            tables[f"{NAME}-{curve}"] = every
    caption = (
        "Coefficient of friction of all scenes against speed, each at its own load or depth, and against normal "
        "force, each at its own speed or the nearest solved; markers are drawn apart. Bars are intervals of 95 %."
    )
    return Plot(NAME, figure, tables, caption, "Curves of all scenes in both models.") if tables else None


def _nearest(points, curve, speed):
    """Points of a curve; of those against load, at the speed nearest to one [m/s]."""
    if curve == SPEED or points.empty:
        return points
    return points[points["speed"] == min(points["speed"], key=lambda each: abs(log(each / (speed or each))))]


def figure(tables: Tables) -> Figure:
    """A panel for each curve: scenes by colour, models by marker and line."""
    every = concat(tables.values())
    cases, solvers = every["case"].unique(), every["solver"].unique()
    colours = dict(zip(cases, shades.PRESS(np.linspace(0, 1, len(cases))), strict=True))
    drawing = style.canvas("double", 3.1)
    panels = drawing.subplots(1, len(tables), sharey=True, squeeze=False)[0]
    for axes, (name, points) in zip(panels, tables.items(), strict=True):
        across = PANELS[name.removeprefix(f"{NAME}-")]
        for (case, solver), curve in points.groupby(["case", "solver"], sort=False):
            own, apart = curve.sort_values(across), APART ** (list(colours).index(case) - (len(cases) - 1) / 2)
            intervals(axes, own[across] * apart, own, "friction_coefficient", **_look(solver, colours[case], ""))
        axes.set(xscale="log", yscale="log", xlabel=head(across.removesuffix("_mean")))
        style.span(axes, points[across][points[across] > 0])
    panels[0].set_ylabel("coefficient of friction [1]")
    style.decades(*panels)
    lettered(panels)
    named = [Line2D([], [], color=colours[case], label=literal(str(case))) for case in cases]
    style.legend(drawing, named, "outside upper left", 3)
    models = [Line2D([], [], **_look(each, style.ink(), style.label(str(each)))) for each in solvers]
    style.legend(drawing, models, "outside upper right", 1)
    return drawing


def _look(solver, colour, label):
    """Look of a model in the colour of a scene; all but one dimension have hollow markers."""
    hollow = {} if solver == "MDR" else {"markerfacecolor": style.paper()}
    return style.look(str(solver), color=colour, label=label, markersize=style.mark(0.9), **hollow)
