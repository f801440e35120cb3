"""Friction of the smooth body from slow to fast, and the ratio of one dimension to three, which tends to 2."""

from collections.abc import Mapping

import numpy as np
from matplotlib.figure import Figure
from pandas import DataFrame, concat

from ....figures import style
from ....figures.curves import unanswered
from ....figures.lettering import clear, lettered
from ....report.page import Plot, Tables

NAME = "smooth-limit"
RATIO = f"{NAME}-ratio"
# v tau / a up to which the first order in the speed is drawn.
SLOW = 0.5


def plot(points: DataFrame, limits: Mapping[str, float], reference: str, folder: str = "") -> Plot | None:
    """Plot of friction over the slope of the body at the edge of the contact; None unless something slides.

    points : solver, v_tau_over_a, and friction_over_slope
    limits : friction over slope for v tau / a = 1 by the closed form of low speed, by the name of the model
    reference : the model that the others are over
    """
    if points.empty:
        return None
    low = points["v_tau_over_a"] * points["solver"].map(limits)
    curves = points.pivot(index="v_tau_over_a", columns="solver", values="friction_over_slope")
    ratio = concat(
        DataFrame({"solver": name, "v_tau_over_a": curves.index, "ratio": (curves[name] / below).to_numpy()})
        for below in [curves[reference]]
        for name in dict.fromkeys(points["solver"])
        if name != reference
    )
    caption = (
        "The smooth body at the scene's load or depth: friction over the slope of the body at the edge of the "
        "smooth relaxed contact of radius a. Lines: closed forms of first order in the speed. At low speed 1D "
        "over 3D tends to 2. Smooth: there is no scatter."
    )
    alternative = "Friction of both models against speed on logarithmic axes; below, their ratio falls from 2."
    tables = {NAME: points.assign(friction_over_slope_low_speed=low), RATIO: ratio}
    return Plot(f"{folder}{NAME}", figure, tables, caption, alternative)


def figure(tables: Tables) -> Figure:
    """Above: friction over slope. Below: 1D over 3D."""
    points, ratios = tables[NAME], tables[RATIO]
    drawing = style.canvas("single", 3.9)
    above, below = drawing.subplots(2, 1, sharex=True, height_ratios=(2.2, 1))
    above.set(xscale="log", yscale="log", ylabel=r"$\mu$ / slope at the edge [1]")
    style.span(above, points["v_tau_over_a"])
    curves = {
        str(solver): curve.sort_values("v_tau_over_a") for solver, curve in points.groupby("solver", sort=False)
    }
    for solver, curve in curves.items():
        look = style.look(solver, linestyle="none")
        above.plot(curve["v_tau_over_a"], curve["friction_over_slope"], **look)
        unanswered(above, curve["v_tau_over_a"], curve["friction_over_slope"], look["color"], look["label"])
    for solver, curve in curves.items():
        slowest = curve.iloc[0]
        # Straight through the slow half, where the first order in the speed is meant to hold.
        slow = np.array([slowest["v_tau_over_a"], SLOW])
        limit = slowest["friction_over_slope_low_speed"] / slowest["v_tau_over_a"]
        label = f"{style.label(solver).split(' ')[0]} limit"
        above.plot(slow, limit * slow, **style.look(solver, marker="", label=label, linewidth=style.width(0.7)))
    slowest = points["v_tau_over_a"].min()
    below.plot([slowest, SLOW], [2, 2], **style.line(0.45, 0.8))
    place = {"xytext": (0, 4), "textcoords": "offset points", "fontsize": style.small()}
    below.annotate("2, derived for low speed", (slowest, 2), **place)
    several = ratios["solver"].nunique() > 1
    for solver, rows in ratios.groupby("solver", sort=False):
        colour = style.COLOUR[str(solver)] if several else style.ink()
        below.plot(rows["v_tau_over_a"], rows["ratio"], color=colour, marker="o")
        unanswered(below, rows["v_tau_over_a"], rows["ratio"], colour)
    over = "1D / 3D" if set(points["solver"]) <= {"MDR", "BEM"} else "over reference"
    ends = min(0.9, ratios["ratio"].min()) - 0.1, max(2.2, ratios["ratio"].max()) + 0.1
    below.set(xlabel=r"$v\tau / a$ [1]", ylabel=f"{over} [1]", ylim=ends)
    above.legend()
    lettered((above, below))
    style.decades(above, below)
    clear(drawing, (above,))
    return drawing
