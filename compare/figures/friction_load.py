"""Coefficient of friction against load at several speeds, in one and in three dimensions."""

import numpy as np
from matplotlib.figure import Figure

from .. import metrics
from ..verdict import Judgement
from . import style
from .force_depth import averaged
from .friction_speed import LAW, law

NAME = "friction-load"


def figure(judgement: Judgement) -> Figure | None:
    """Left 1D, right 3D, the same axes. None unless something slides."""
    if not metrics.pairs(judgement.table, "load"):
        return None
    drawing = style.canvas(style.DOUBLE, 2.9)
    panels = drawing.subplots(1, 2, sharex=True, sharey=True)
    panels[0].set(xscale="log", yscale="log")
    loads = [r.normal_force.mean for r in judgement.table if r.kind == "load" and r.normal_force.mean > 0]
    style.span(panels[0], loads)
    for axes, solver in zip(panels, ("MDR", "BEM"), strict=True):
        axes.set(xlabel="normal force [N]", title=style.LABEL[solver])
        curves = metrics.by_speed(metrics.select(judgement.table, "load", solver))
        shades = style.shades(solver, len(curves))
        for index, (speed, curve) in enumerate(curves.items()):
            look = {
                "color": shades[index],
                "marker": style.SERIES_MARKERS[index % len(style.SERIES_MARKERS)],
                "linestyle": style.SERIES_LINES[index % len(style.SERIES_LINES)],
                "label": f"{speed:.3g} m/s",
            }
            loads = np.array([r.normal_force.mean for r in curve])
            style.line(axes, loads, [r.friction_coefficient for r in curve], solver, **look)
    lowest = panels[0].get_ylim()[0]
    _paper(panels[0], judgement)
    # Where the smooth shape rules, Eq. 19 lies decades below: it must not press the curves together.
    panels[0].set_ylim(bottom=max(panels[0].get_ylim()[0], lowest / 3))
    for axes in panels:
        axes.legend()
        style.decades(axes)
    panels[0].set_ylabel("coefficient of friction [1]")
    return drawing


def sheets(judgement: Judgement):
    """Every point of the figure."""
    return {NAME: [record.columns for record in judgement.table if record.kind == "load"]}


def caption(judgement: Judgement) -> str:
    """What the figure shows."""
    pressed = "" if judgement.case.motion.load is not None else " The depth is prescribed: loads are means."
    paper = "" if judgement.case.roughness is None else f" Dotted, in the shade of each speed: {LAW}"
    return (
        "Coefficient of friction against normal force at several speeds, left in one and right in three "
        f"dimensions.{pressed}{paper} {averaged(judgement, 'load')}"
    )


def _paper(axes, judgement):
    curves = metrics.by_speed(metrics.select(judgement.table, "load", "MDR"))
    for shade, (speed, curve) in zip(style.shades("MDR", len(curves)), curves.items(), strict=True):
        slope = curve[0].rms_slope.mean
        if not np.isfinite(slope):
            return
        loads = np.array([r.normal_force.mean for r in curve])
        axes.plot(loads, law(judgement, loads, speed, slope), ":", color=shade, linewidth=1.2)
    # One entry for the lines of all speeds.
    axes.plot([], [], ":", color="0.3", linewidth=1.2, label="Eq. 19 at each speed")
