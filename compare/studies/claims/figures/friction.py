"""Friction of one series: curves shifted onto one, shifts, level against speed; and several series at once."""

from itertools import cycle
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import EngFormatter
from pandas import DataFrame

from ....figures import shades, style
from ....figures.curves import intervals
from ....figures.lettering import clear, lettered, literal
from ....report.page import Tables
from ....solving.words import interval
from ....statistics.collapse import ENDS

SOLVER = {"1D": "MDR", "3D": "BEM"}
FITTED, PREDICTED, ALONE = "fitted", "predicted", "not shifted"
COMMON, LAW = "common curve", "Eq. 19 with p(v)"
FIGURES = 3  # significant digits of a number without an interval, as in the answer
# Neighbouring markers are drawn apart by this factor of the speed, either way.
APART = 1.05
# Unit of what is prescribed, and what the bar of shades is in.
UNITS = {"load": "N", "depth": "m"}
BAR = {"load": (1.0, "normal force [N]"), "depth": (1e6, "depth [µm]")}
# What makes slow friction depend on the load, each over its number under the least load.
BEHIND = {"contact": "real contact", "drag": "friction / contact", "slope": "slope in contact"}
THEORY = "levels-theory"  # table of what is drawn beside the models
MARKERS = ("o", "s", "^", "v", "D", "<", ">")  # of bodies
MEMORIES = {"rough": ("memory_over_shortest", "v τ q$_s$ [1]"), "smooth": ("memory_over_contact", "v τ / a [1]")}


def collapse(tables: Tables, tolerance: float = 0.05) -> Figure:
    """Columns: 1D, 3D. Rows: friction against load; shifted; off the common curve, where both have one."""
    points, curves, fits = tables["collapse"], tables["collapse-curves"], tables["collapse-fits"]
    fitted = set(points.loc[points["shifted_as"] == FITTED, "dimension"])
    rows = (1, 1, 0.7) if len(fitted) == len(SOLVER) else (1, 1)
    drawing = style.canvas("double", 1.1 + 1.9 * sum(rows))
    panels = drawing.subplots(len(rows), 2, sharex="row", sharey="row", height_ratios=rows)
    scale = shades.between(points["speed"])
    for column, (dimension, solver) in zip(panels.T, SOLVER.items(), strict=True):
        own = points[points["dimension"] == dimension]
        (fit,) = fits[fits["dimension"] == dimension].to_dict("records")
        column[0].set(xlabel="normal force [N]", xscale="log", yscale="log")
        column[1].set(xlabel="shifted normal force [N]", xscale="log", yscale="log")
        _curves(column[0], own, "normal_force", "friction_coefficient", solver, scale)
        marks: Any = {"linestyle": "none"} if dimension in fitted else {}
        lifted = "shifted_friction" in own and own["shifted_friction"].notna().any()
        shown = "shifted_friction" if lifted else "friction_coefficient"
        _curves(column[1], own, "shifted_force", shown, solver, scale, **marks)
        for name, curve in curves[curves["dimension"] == dimension].groupby("curve", sort=False):
            line, look = ("-", style.line(0, 0.8)) if name == COMMON else ("--", style.line(0.5))
            mu = curve["friction_coefficient"]
            column[1].plot(curve["shifted_force"], mu, line, zorder=1, label=literal(name), **look)
        column[1].legend(loc="lower left")
        if len(rows) > 2:
            _left_over(column[2], own, fit, solver, scale, tolerance)
        fit_to = "shifted both ways as fitted" if lifted else "shifted as fitted"
        titles = (style.LABEL[solver], fit_to if dimension in fitted else "shifted by p(v) of Eq. 22")
        for axes, title in zip(column, titles, strict=False):
            axes.set_title(title)
    labels = ("friction coefficient [1]", "friction coefficient [1]", "off the curve [%]")
    for axes, label in zip(panels[:, 0], labels, strict=False):
        axes.set_ylabel(label)
    lettered(panels.flat)
    style.decades(*panels.flat)
    place = {"location": "bottom", "aspect": 60, "shrink": 0.7, "fraction": 0.03, "pad": 0.02}
    shades.bar(drawing, panels, shades.SPEED, scale, "speed [m/s]", **place)
    clear(drawing, panels[1])
    return drawing


def _left_over(axes: Axes, own: DataFrame, fit, solver: str, scale, tolerance: float) -> None:
    """Misfit from the common curve, with the tolerance."""
    axes.set(xlabel="shifted normal force [N]", xscale="log")
    axes.axhspan(-100 * tolerance, 100 * tolerance, color=style.grey(0.9), linewidth=0)
    axes.axhline(0, **style.line(0, 0.65))
    axes.set_title(misfit(fit))
    kept = own[own["shifted_as"] == FITTED]
    _curves(axes, kept, "shifted_force", "off_curve", solver, scale, 100, linewidth=style.width(0.55))


def _curves(axes: Axes, points: DataFrame, across: str, name: str, solver: str, scale, times=1.0, **other) -> None:
    """A curve for each speed, with its intervals."""
    look = style.look(solver, label=None, linewidth=style.width(0.7), markersize=style.mark(0.75))
    look |= {"elinewidth": style.width(0.65), "capsize": 0} | other
    for speed, curve in points.groupby("speed"):
        look["color"] = shades.SPEED(scale(speed))
        intervals(axes, curve[across], curve, name, times, **look)


def misfit(fit) -> str:
    """Misfit of a fit in words."""
    if not np.isfinite(fit["misfit"]):
        return f"δ unknown, the means miss the curve by {fit['rms']:.1%}"
    value, low, high = (100 * fit[f"misfit{end}"] for end in ENDS)
    return f"δ = {interval(value, low, high, FIGURES)} %"


def shifts(tables: Tables, tolerance: float = 0.05) -> Figure:
    """Left: shift along the load. Middle: less what theory has. Right: shift along friction, both fitted."""
    every, fits = tables["shifts"], tables["shifts-fits"]
    drawing = style.canvas("double", 2.7)
    left, middle, right = panels = drawing.subplots(1, 3)
    for index, (dimension, own) in enumerate(every.groupby("dimension")):
        solver, apart = SOLVER[dimension], APART ** (2 * index - 1)
        look = style.look(solver, label=None, linestyle="none")
        for axes, name, less in (
            (left, "log_shift", 0.0),
            (middle, "log_shift", own["theory"]),
            (right, "log_lift", 0.0),
        ):
            intervals(axes, own["speed"] * apart, own, name, less=less, **look)
        (fit,) = fits[fits["dimension"] == dimension].to_dict("records")
        value, low, high = (fit[f"exponent{end}"] for end in ENDS)
        told = interval(value, low, high, FIGURES)
        power = f", power of v:\n{told}" if np.isfinite(value) else ""
        left.plot([], [], **look | {"label": f"{dimension}{power}"})
    grey = style.line(0.45, 0.8, zorder=1)
    left.plot(own["speed"], own["theory"], "-", label="theory, ln p(v)", **grey)
    for axes in (middle, right):
        axes.axhline(0, **grey)
    right.axhspan(-tolerance, tolerance, color=style.grey(0.9), linewidth=0, zorder=0)
    left.set(ylabel="horizontal shift $b_v$ [1]", title="(a)")
    middle.set(ylabel="$b_v$ less ln p(v) [1]", title="(b)")
    right.set(ylabel="vertical shift $c_v$, both fitted [1]", title="(c)")
    left.legend(loc="best", handlelength=1.4)
    for axes in panels:
        axes.set(xscale="log", xlabel="speed [m/s]")
        style.span(axes, every["speed"])
    style.decades(*panels)
    clear(drawing, (left,))
    return drawing


def levels(tables: Tables) -> Figure:
    """Above: friction against speed at three loads or depths. Below: 1D over 3D, rough and smooth."""
    every, ratios = tables["levels"], tables["levels-ratios"]
    prescribed = "load" if "load" in every else "depth"
    drawing = style.canvas("double", 5.2)
    above, below = drawing.subfigures(2, 1, squeeze=False, height_ratios=(1.15, 1))[:, 0]
    values = sorted(set(every[prescribed]))
    chosen = [values[k] for k in sorted({0, len(values) // 2, len(values) - 1})]
    panels = above.subplots(1, len(chosen), sharey=True, sharex=True, squeeze=False)[0]
    panels[0].set(xscale="log", yscale="log", ylabel="friction coefficient [1]")
    for axes, value in zip(panels, chosen, strict=True):
        for index, (dimension, curve) in enumerate(every[every[prescribed] == value].groupby("dimension")):
            _level(axes, curve, dimension, index)
        if THEORY in tables:
            own = tables[THEORY][tables[THEORY][prescribed] == value]
            for solver, curve in own.groupby("solver"):
                look = style.look(str(solver), marker="", linewidth=style.width(0.7))
                if solver not in style.COLOURS:
                    look |= {"color": style.ink(), "linestyle": ":"}
                axes.plot(curve["speed"], curve["friction_coefficient"], **look)
        axes.set(xlabel="speed [m/s]", title=EngFormatter(UNITS[prescribed])(float(f"{value:.3g}")))
    style.legend(above, panels[0].get_legend_handles_labels()[0], "outside lower center", 6)
    lower = below.subplots(1, 2, sharey=True)
    _ratios(below, lower, ratios, prescribed)
    lettered([*panels, *lower])
    style.decades(*panels, *lower)
    return drawing


def _level(axes, curve, dimension, index):
    """Curves of one dimensionality at one load or depth."""
    solver, speeds = SOLVER[dimension], curve["speed"]
    colour = style.COLOUR[solver]
    # Dashes of one lie in the gaps of the other: the laws of both may coincide.
    law = {"color": colour, "alpha": 0.5, "linewidth": style.width(1.1)}
    axes.plot(speeds, curve["eq_19"], linestyle=(6 * index, (6, 6)), zorder=1, label=f"{dimension}, Eq. 19", **law)
    look = style.look(solver, label=f"{dimension}, rough", markersize=style.mark(0.9))
    intervals(axes, speeds, curve, "friction_coefficient", **look)
    thin = {"linestyle": style.LINE[solver], "linewidth": style.width(0.55), "alpha": 0.8}
    axes.plot(speeds, curve["smooth"], color=colour, label=f"{dimension}, smooth", **thin)


def behind(tables: Tables) -> Figure:
    """Causes of the load in slow friction: real contact, its drag and its slope, each over its first value."""
    every = tables["behind"]
    drawing = style.canvas("double", 2.7)
    panels = drawing.subplots(1, len(BEHIND), sharex=True)
    for axes, (name, label), letter in zip(panels, BEHIND.items(), "abc", strict=True):
        for index, (dimension, own) in enumerate(every.groupby("dimension")):
            solver, load = SOLVER[dimension], own["normal_force"]
            intervals(axes, load * APART ** (2 * index - 1), own, name, **style.look(solver, label=dimension))
            law = {"color": style.COLOUR[solver], "alpha": 0.5, "linestyle": (6 * index, (6, 6)), "zorder": 1}
            axes.plot(load, own[f"{name}_law"], label=f"{dimension}, the paper", **law)
        over = f"over that at {every['normal_force'].min():.3g} N [1]"
        axes.set(xscale="log", xlabel="normal force [N]", ylabel=over, title=f"({letter}) {label}")
    panels[0].set_yscale("log")
    style.decades(*panels)
    style.legend(drawing, panels[0].get_legend_handles_labels()[0], "outside lower center", 4)
    return drawing


def _ratios(drawing, panels, ratios, prescribed):
    """Friction in 1D over that in 3D: rough at left, smooth at right, a shade for each load or depth."""
    unit, label = BAR[prescribed]
    scale = shades.between(unit * ratios[prescribed])
    for axes, (body, (memory, name)) in zip(panels, MEMORIES.items(), strict=True):
        for level, line in ((1, "-"), (2, ":")):
            axes.axhline(level, **style.line(0.6, 0.65, linestyle=line, zorder=0))
        own = ratios[ratios["body"] == body].groupby(prescribed)
        for (value, curve), marker in zip(own, cycle(style.SERIES_MARKERS), strict=False):
            thin = {"linewidth": style.width(0.65), "elinewidth": style.width(0.65)}
            look = {"color": shades.PRESS(scale(unit * value)), "marker": marker, "markersize": style.mark(0.75)}
            intervals(axes, curve[memory], curve, "friction_1d_over_3d", **look, **thin)
        axes.set(xscale="log", xlabel=name, title=body)
        axes.set_ylim(bottom=0)
    panels[0].set_ylabel("friction 1D / 3D [1]")
    shades.bar(drawing, panels, shades.PRESS, scale, label, location="right", fraction=0.04, pad=0.02)


def family(tables: Tables) -> Figure:
    """Friction over that of Eq. 19 against xi in 1D and 3D: a marker for each shape, a shade for each load."""
    every = tables["family"]
    drawing = style.canvas("double", 3.1)
    panels = drawing.subplots(1, len(SOLVER), sharex=True, sharey=True)
    scale = shades.between(every["normal_force"].dropna())
    shapes = dict(zip(dict.fromkeys(every["shape"]), MARKERS, strict=False))
    grey: dict[str, Any] = {"linestyle": "none", "color": style.grey(0.3)}
    place = ["shape", *(name for name in ("load", "depth") if name in every)]
    for axes, (dimension, solver) in zip(panels, SOLVER.items(), strict=True):
        axes.axhline(1, **style.line(0.5, 0.8), zorder=1)
        for (shape, *_), own in every[every["dimension"] == dimension].groupby(place, dropna=False):
            look = {"color": shades.PRESS(scale(own["normal_force"].mean())), "linestyle": "none", "capsize": 0}
            look |= {"marker": shapes[shape], "markersize": style.mark(0.75), "elinewidth": style.width(0.5)}
            intervals(axes, own["xi"], own, "over_eq_19", **look)
        axes.set(xscale="log", yscale="log", title=f"{dimension} ({solver})", xlabel=r"$\xi$ [1]")
    known = every["over_eq_19"][every["over_eq_19"] > 0]
    panels[0].set(ylim=(known.min() / 1.5, known.max() * 1.5), ylabel="friction / Eq. 19 [1]")
    lettered(panels)
    style.decades(*panels)
    shades.bar(drawing, panels, shades.PRESS, scale, "normal force [N]", fraction=0.03, pad=0.01, aspect=40)
    handles = [Line2D([], [], marker=marker, label=shape, **grey) for shape, marker in shapes.items()]
    style.legend(drawing, handles, "outside lower center", 4)
    return drawing
