"""Coefficient of friction against speed, and against load at several speeds, in one and in three dimensions."""

from collections.abc import Callable, Sequence
from math import nan
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from pandas import DataFrame

from ....figures import style
from ....figures.curves import averaged, intervals, of_curves, unanswered
from ....figures.lettering import clear, lettered
from ....report.page import Plot, Tables
from ....statistics.finding import Finding

SPEED, LOAD = "friction-speed", "friction-load"
RATIO, LAW = f"{SPEED}-ratio", f"{SPEED}-law"
SPEED_THEORY, LOAD_THEORY = f"{SPEED}-theory", f"{LOAD}-theory"
EQ_19 = "Eq. 19 with exponent 1.5 and the rms slope of the 1D profiles, without the slope of the smooth shape."
THIN = " Thin: Persson's theory, P(q) as published in 2001, not judged here."
# Neighbouring markers are drawn apart by this factor of the speed, either way.
APART = 1.04
# mu of Eq. 19 at loads [N], speeds [m/s] and an rms slope.
Law = Callable[[Any, Any, float], Any]


def against_speed(
    points: DataFrame,
    ratios: Sequence[tuple[str, float, Finding]],
    law: Law,
    held: str,
    theory: DataFrame,
    folder: str = "",
) -> Plot | None:
    """Plot of friction against speed; None unless something slides.

    ratios : model, speed [m/s], and the finding on it over the reference
    law : Eq. 19; held : what is prescribed at all speeds, in words
    theory : points of what is drawn beside the models and not judged; may be empty
    """
    own = of_curves(points, points["curve"] == SPEED)
    if own.empty:
        return None
    rows = [
        {"solver": solver, "speed": speed, "ratio": found.value, "ratio_low": low, "ratio_high": high}
        for solver, speed, found in ratios
        for low, high in [found.interval]
    ]
    tables = {SPEED: own, RATIO: DataFrame(rows), LAW: _law(own, law)}
    told = f" Dotted: {EQ_19}" if len(tables[LAW]) else ""
    if len(beside := of_curves(theory, theory["curve"] == SPEED)):
        tables[SPEED_THEORY] = beside
        told += THIN
    caption = f"Coefficient of friction against speed at a {held}; below, 1D over 3D.{told} {averaged(own)}"
    alternative = "Friction of both models rises to a maximum and falls; below, their ratio."
    return Plot(f"{folder}{SPEED}", speed_figure, tables, caption, alternative)


def speed_figure(tables: Tables) -> Figure:
    """Above: friction. Below: 1D over 3D."""
    points, ratios, law = tables[SPEED], tables[RATIO], tables[LAW]
    drawing = style.canvas("double" if points["solver"].nunique() > 2 else "single", 3.9)
    above, below = drawing.subplots(2, 1, sharex=True, height_ratios=(2.2, 1))
    above.set(xscale="log", yscale="log", ylabel="coefficient of friction [1]")
    style.span(above, points["speed"])
    curves = list(points.sort_values("speed").groupby("solver", sort=False))
    for index, (solver, curve) in enumerate(curves):
        look = style.look(str(solver), markersize=style.mark(0.7), capsize=style.mark(0.7))
        speed = curve["speed"] * APART ** (2 * index - len(curves) + 1)
        intervals(above, speed, curve, "friction_coefficient", **look)
        unanswered(above, speed, curve["friction_coefficient_mean"], look["color"], look["label"])
    for solver, curve in _theories(tables, SPEED_THEORY).groupby("solver"):
        curve = curve.sort_values("speed")
        above.plot(curve["speed"], curve["friction_coefficient_mean"], **_thin(str(solver)))
    lowest = above.get_ylim()[0]
    if len(law):
        look = style.line(0.3, 0.9, label="Eq. 19, roughness alone")
        above.plot(law["speed"], law["friction_coefficient"], ":", **look)
    # Where the smooth shape rules, Eq. 19 lies decades below: it must not press the curves together.
    above.set_ylim(bottom=max(above.get_ylim()[0], lowest / 3))
    above.legend()
    below.axhline(1, **style.line(0.6, 0.55))
    look = {"color": style.ink(), "marker": "o", "markersize": style.mark(0.7), "capsize": style.mark(0.7)}
    several = ratios["solver"].nunique() > 1
    for solver, rows in ratios.groupby("solver", sort=False):
        own = {"color": style.COLOUR[str(solver)]} if several else {}
        intervals(below, rows["speed"], rows, "ratio", **(look | own))
        unanswered(below, rows["speed"], rows["ratio"], (look | own)["color"])
    over = "1D / 3D" if set(points["solver"]) <= {"MDR", "BEM"} else "over reference"
    below.set(xlabel="speed [m/s]", ylabel=f"{over} [1]")
    below.set_ylim(0, 1.1 * np.nanmax([1, *ratios["ratio"], *ratios["ratio_high"]]))
    lettered((above, below))
    style.decades(above, below)
    clear(drawing, (above,))
    return drawing


def against_load(points: DataFrame, law: Law, theory: DataFrame, folder: str = "") -> Plot | None:
    """Plot of friction against load at several speeds; None unless something slides.

    theory : points of what is drawn beside the models and not judged; may be empty
    """
    own = of_curves(points, points["curve"] == LOAD)
    if own.empty:
        return None
    slope = _slope(own)
    known = (own["solver"] == "MDR") & np.isfinite(slope)
    own = own.assign(eq_19=nan)
    if known.any():
        own.loc[known, "eq_19"] = law(own["normal_force_mean"][known], own["speed"][known], slope)
    pressed = "" if "load" in own else " The depth is prescribed: loads are means."
    told = f" Dotted, in the shade of each speed: {EQ_19}" if known.any() else ""
    tables = {LOAD: own}
    if len(beside := of_curves(theory, theory["curve"] == LOAD)):
        tables[LOAD_THEORY] = beside
        told += THIN
    caption = (
        f"Coefficient of friction against normal force, a curve for each speed.{pressed}{told} {averaged(own)}"
    )
    alternative = "Friction of both models against load in two panels of the same axes, a curve for each speed."
    return Plot(f"{folder}{LOAD}", load_figure, tables, caption, alternative)


def load_figure(tables: Tables) -> Figure:
    """A panel for each model, the same axes."""
    points = tables[LOAD]
    drawing = style.canvas("double", 2.9)
    solvers = list(points["solver"].unique())
    panels = drawing.subplots(1, len(solvers), sharex=True, sharey=True, squeeze=False)[0]
    panels[0].set(xscale="log", yscale="log")
    style.span(panels[0], points["normal_force_mean"][points["normal_force_mean"] > 0])
    for axes, solver in zip(panels, solvers, strict=True):
        axes.set(xlabel="normal force [N]", title=style.label(solver))
        curves = list(points[points["solver"] == solver].groupby("speed"))
        for shade, form, (speed, curve) in zip(
            style.shades(solver, len(curves)), style.forms(), curves, strict=False
        ):
            look = style.look(solver, color=shade, **form, label=f"{speed:.3g} m/s", capsize=style.mark(0.6))
            own = curve.sort_values("normal_force_mean")
            intervals(axes, own["normal_force_mean"], own, "friction_coefficient", **look)
            if "load" in own:
                unanswered(axes, own["load"], own["friction_coefficient_mean"], shade, look["label"])
        _beside(axes, solver, _theories(tables, LOAD_THEORY))
    _eq_19(panels[0], points[points["eq_19"].notna()])
    for axes in panels:
        axes.legend()
    style.decades(*panels)
    panels[0].set_ylabel("coefficient of friction [1]")
    lettered(panels)
    clear(drawing, panels)
    return drawing


def _theories(tables, name):
    """Points of a theory; none where no one was drawn."""
    return tables.get(name, DataFrame(columns=["solver", "speed"]))


def _thin(solver, **other):
    """Look of what is not judged."""
    return style.look(solver, marker="", linewidth=style.width(0.7), **other)


def _beside(axes, solver, points):
    """A theory at each speed in a panel of a model, in its shades, with one entry for all."""
    for theory, own in points.groupby("solver"):
        curves = list(own.groupby("speed"))
        for shade, (_, curve) in zip(style.shades(solver, len(curves)), curves, strict=True):
            curve = curve.sort_values("normal_force_mean")
            look = _thin(str(theory), color=shade, label="")
            axes.plot(curve["normal_force_mean"], curve["friction_coefficient_mean"], **look)
        axes.plot([], [], **_thin(str(theory), color=style.grey(0.3)))


def _eq_19(axes, points):
    """Eq. 19 at each speed, without pressing the curves together where it lies far below them."""
    lowest, curves = axes.get_ylim()[0], list(points.groupby("speed"))
    for shade, (_, curve) in zip(style.shades("MDR", len(curves)), curves, strict=True):
        curve = curve.sort_values("normal_force_mean")
        axes.plot(curve["normal_force_mean"], curve["eq_19"], ":", color=shade, linewidth=style.width(1.1))
    axes.set_ylim(bottom=max(axes.get_ylim()[0], lowest / 3))
    if curves:  # one entry for the lines of all speeds
        seen = "" if points["eq_19"].max() > axes.get_ylim()[0] else ": below"
        axes.plot([], [], ":", **style.line(0.3, 1.1, label=f"Eq. 19 at each speed{seen}"))


def _slope(points) -> float:
    """Rms slope of the first model that measures it, of 1D profiles; NaN of a smooth body."""
    known = points[points["rms_slope_mean"].notna()] if "rms_slope_mean" in points else points[:0]
    profiles = known[known["solver"] == known["solver"].iloc[0]] if len(known) else known
    return float(profiles["rms_slope_mean"].iloc[0]) if "rms_slope_mean" in profiles and len(profiles) else nan


def _law(points, law) -> DataFrame:
    """Eq. 19 over the speeds; empty of a smooth body, where a depth is prescribed, or at one speed."""
    slope = _slope(points)
    if not np.isfinite(slope) or "load" not in points or points["speed"].nunique() < 2:
        return DataFrame(columns=["speed", "friction_coefficient"])
    speed = np.geomspace(points["speed"].min(), points["speed"].max(), 101)
    return DataFrame({"speed": speed, "friction_coefficient": law(points["load"].iloc[0], speed, slope)})
