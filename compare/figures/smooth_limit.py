"""Friction of the smooth body from slow to fast, and the ratio of one dimension to three, which tends to 2."""

from math import nan

import numpy as np
from matplotlib.figure import Figure

from scene.scales import elastic_contact

from .. import exact, metrics
from ..verdict import DIMENSIONS, Judgement, smooth_speed
from ..plots import style
from ..plots.lettering import clear

NAME = "smooth-limit"


def figure(judgement: Judgement) -> Figure | None:
    """Above: mu over the slope at the contact's edge. Below: 1D over 3D. None unless something slides."""
    pairs = metrics.pairs(judgement.table, "smooth")
    if not pairs:
        return None
    drawing = style.canvas("single", 3.9)
    above, below = drawing.subplots(2, 1, sharex=True, height_ratios=(2.2, 1))
    above.set(xscale="log", yscale="log", ylabel=r"$\mu$ / slope at the edge [1]")
    slope = exact.edge_slope(judgement.case.indenter, elastic_contact(judgement.case.scene).radius)
    x = [smooth_speed(judgement.case, a) for a, _ in pairs]
    style.span(above, x)
    for index, solver in enumerate(("MDR", "BEM")):
        friction = [pair[index].friction_coefficient.mean / slope for pair in pairs]
        above.plot(x, friction, color=style.COLOUR[solver], marker=style.MARKER[solver], linestyle="none",
                   label=style.LABEL[solver])  # fmt: skip
    # Straight through the slow half, where the first order in the speed is meant to hold.
    slow = np.array([min(x), 0.5])
    for (solver, dimension), limit in zip(DIMENSIONS.items(), _limits(judgement), strict=True):
        above.plot(slow, limit * slow / slope, style.LINE[solver], color=style.COLOUR[solver],
                   linewidth=style.width(0.7), label=f"{dimension} limit")  # fmt: skip
    ratios = [metrics.ratio(a.friction_coefficient, b.friction_coefficient)[0] for a, b in pairs]
    below.axhline(2, color=style.grey(0.45), linewidth=style.width(0.8), linestyle="-")
    below.annotate(
        "2, derived", (max(x), 2), xytext=(0, 2), textcoords="offset points", ha="right", fontsize=style.small()
    )
    below.plot(x, ratios, color=style.ink(), marker="o")
    below.set(
        xlabel=r"$v\tau / a$ [1]", ylabel="1D / 3D [1]", ylim=(min(0.9, *ratios) - 0.1, max(2.2, *ratios) + 0.1)
    )
    above.legend()
    for axes in (above, below):
        style.decades(axes)
    clear(drawing, (above,))
    return drawing


def sheets(judgement: Judgement):
    """Every point of the figure, and friction by the closed form of first order in the speed."""
    rows = [record for record in judgement.table if record.kind == "smooth"]
    if not rows:
        return {}
    limits = dict(zip(DIMENSIONS, _limits(judgement), strict=True))
    speeds = [smooth_speed(judgement.case, record) for record in rows]
    return {
        NAME: [
            {"v_tau_over_a": speed}
            | record.columns
            | {"friction_coefficient_low_speed": limits[record.solver] * speed if record.solver in limits else nan}
            for speed, record in zip(speeds, rows, strict=True)
        ]
    }


def caption(judgement: Judgement) -> str:
    """What the figure shows."""
    return (
        "The smooth body at the scene's load or depth: friction over the slope of the body at the edge of the "
        "smooth relaxed contact of radius a. Lines: closed forms of first order in the speed. At low speed the "
        "ratio of one dimension to three tends to 2. Smooth: there is no scatter."
    )


def _limits(judgement):
    """mu per unit of v tau / a at low speed, 1D and 3D."""
    case, contact = judgement.case, elastic_contact(judgement.case.scene)
    shape = (case.indenter.mdr_coefficient, case.indenter.exponent)
    modulus = case.scene.solid.indentation_modulus
    # The speed at which v tau = a.
    speed = contact.radius / float(case.scene.solid.retardation()[2][0])
    return [
        law(speed, contact.radius, exact.mean_lag(case.scene.solid), modulus, *shape) / contact.load
        for law in (exact.slow_friction_1d, exact.slow_friction_3d)
    ]
