"""Coefficient of friction against load at several speeds, in one and in three dimensions."""

from math import nan
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from .. import metrics
from ..verdict import Judgement
from ..plots import style
from .force_depth import averaged
from .friction_speed import LAW, law
from ..plots.lettering import clear

NAME = "friction-load"


def figure(judgement: Judgement) -> Figure | None:
    """Left 1D, right 3D, the same axes. None unless something slides."""
    if not metrics.pairs(judgement.table, "load"):
        return None
    drawing = style.canvas("double", 2.9)
    panels = drawing.subplots(1, 2, sharex=True, sharey=True)
    panels[0].set(xscale="log", yscale="log")
    loads = [r.normal_force.mean for r in judgement.table if r.kind == "load" and r.normal_force.mean > 0]
    style.span(panels[0], loads)
    for axes, solver in zip(panels, ("MDR", "BEM"), strict=True):
        axes.set(xlabel="normal force [N]", title=style.LABEL[solver])
        curves = metrics.by_speed(metrics.select(judgement.table, "load", solver))
        shades = style.shades(solver, len(curves))
        for index, (speed, curve) in enumerate(curves.items()):
            look: dict[str, Any] = {
                "color": shades[index],
                "marker": style.SERIES_MARKERS[index % len(style.SERIES_MARKERS)],
                "linestyle": style.SERIES_LINES[index % len(style.SERIES_LINES)],
                "label": f"{speed:.3g} m/s",
            }
            forces = np.array([r.normal_force.mean for r in curve])
            style.line(axes, forces, [r.friction_coefficient for r in curve], solver, **look)
    lowest = panels[0].get_ylim()[0]
    highest = _paper(panels[0], judgement)
    # Where the smooth shape rules, Eq. 19 lies decades below: it must not press the curves together.
    panels[0].set_ylim(bottom=max(panels[0].get_ylim()[0], lowest / 3))
    if highest is not None:  # one entry for the lines of all speeds
        seen = "" if highest > panels[0].get_ylim()[0] else ": below"
        look = {"color": style.grey(0.3), "linewidth": style.width(1.1), "label": f"Eq. 19 at each speed{seen}"}
        panels[0].plot([], [], ":", **look)
    for axes in panels:
        axes.legend()
        style.decades(axes)
    panels[0].set_ylabel("coefficient of friction [1]")
    clear(drawing, panels)
    return drawing


def sheets(judgement: Judgement):
    """Every point of the figure, and what Eq. 19 has at those of one dimension, else NaN."""
    known = {
        id(record): float(friction)
        for _, curve, values in _known(judgement)
        for record, friction in zip(curve, values, strict=True)
    }
    return {
        NAME: [
            record.columns | {"eq_19": known.get(id(record), nan)}
            for record in judgement.table
            if record.kind == "load"
        ]
    }


def caption(judgement: Judgement) -> str:
    """What the figure shows."""
    pressed = "" if judgement.case.motion.load is not None else " The depth is prescribed: loads are means."
    paper = "" if judgement.case.roughness is None else f" Dotted, in the shade of each speed: {LAW}"
    return (
        "Coefficient of friction against normal force at several speeds, left in one and right in three "
        f"dimensions.{pressed}{paper} {averaged(judgement, 'load')}"
    )


def _paper(axes, judgement):
    """Draw Eq. 19; its highest value, None without roughness."""
    known = list(_known(judgement))
    for shade, (loads, _, friction) in zip(style.shades("MDR", len(known)), known, strict=True):
        axes.plot(loads, friction, ":", color=shade, linewidth=style.width(1.1))
    return max((friction.max() for _, _, friction in known), default=None)


def _known(judgement):
    """Of each speed of one dimension: loads, records, and Eq. 19 there; nothing without roughness."""
    curves = metrics.by_speed(metrics.select(judgement.table, "load", "MDR"))
    if not all(np.isfinite(curve[0].rms_slope.mean) for curve in curves.values()):
        return
    for speed, curve in curves.items():
        loads = np.array([record.normal_force.mean for record in curve])
        yield loads, curve, law(judgement, loads, speed, curve[0].rms_slope.mean)
