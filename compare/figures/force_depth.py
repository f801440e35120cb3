"""Normal force against depth at rest, rough and smooth, and how far one dimension is from three."""

from typing import Any

import numpy as np
from matplotlib.figure import Figure

from .. import metrics
from ..verdict import Judgement
from ..plots import style

NAME = "force-depth"


def figure(judgement: Judgement) -> Figure | None:
    """Above: force. Below: 1D over 3D. None without points."""
    table = judgement.table
    if not metrics.pairs(table, "force-depth"):
        return None
    drawing = style.canvas("single", 3.9)
    above, below = drawing.subplots(2, 1, sharex=True, height_ratios=(2, 1))
    above.set(ylabel="normal force [N]", xscale="log", yscale="log")
    style.span(above, [r.depth * 1e6 for r in table if r.kind == "force-depth"])
    exact = metrics.select(table, "force-depth", "exact", True)
    if exact:
        known = [r.normal_force.mean for r in exact]
        above.plot([r.depth * 1e6 for r in exact], known, "-", color=style.grey(0.45),
                   linewidth=style.width(0.8), label="smooth, closed form")  # fmt: skip
    for solver in ("MDR", "BEM"):
        for smooth in (True, False):
            curve = metrics.select(table, "force-depth", solver, smooth)
            if not curve:
                continue
            body: dict[str, Any] = {"markerfacecolor": style.paper(), "linestyle": "none"} if smooth else {}
            label = f"{style.LABEL[solver]}, {'smooth' if smooth else 'rough'}"
            if smooth and solver == "BEM":
                body |= {"markersize": style.mark(1.6), "zorder": 1}
            style.line(above, [r.depth * 1e6 for r in curve], [r.normal_force for r in curve], solver,
                       label=label, **body)  # fmt: skip
    _deviation(below, table)
    below.set(xlabel="depth [µm]", ylabel="1D / 3D - 1 [%]")
    style.legend(drawing, above.get_legend_handles_labels()[0], "outside upper left", 2)
    for axes in (above, below):
        style.decades(axes)

    return drawing


def sheets(judgement: Judgement):
    """Every point of the figure."""
    return {NAME: [record.columns for record in judgement.table if record.kind == "force-depth"]}


def caption(judgement: Judgement) -> str:
    """What the figure shows."""
    return (
        "Force against depth, pressed in at rest. Below: deviation of the one-dimensional force from the "
        "three-dimensional one at the same depth; an arrow marks an error bar that goes on. "
        f"{averaged(judgement, 'force-depth')}"
    )


def averaged(judgement: Judgement, kind: str) -> str:
    """How many surfaces, and what bars and bands mean."""
    rough = [r for r in judgement.table if r.kind == kind and not r.smooth]
    if not rough:
        return "The body is smooth: there is no scatter."
    count = {s: max((r.normal_force.count for r in rough if r.solver == s), default=0) for s in ("MDR", "BEM")}
    return (
        f"Rough: mean over {count['MDR']} profiles (1D) and {count['BEM']} surfaces (3D); bars are standard "
        "errors of the mean, bands the standard deviation of one surface."
    )


def _scale(axes, depths, values, errors):
    """Limits from all values and the better half of the error bars; an arrow where a bar goes on beyond them."""
    bars = np.where(errors <= np.nanmedian(errors), errors, 0)
    low, high = min(0, np.nanmin(values - bars)), max(0, np.nanmax(values + bars))
    margin = 0.15 * (high - low) or 1.0
    low, high = low - margin, high + margin
    axes.set_ylim(low, high)
    for edge, marker, beyond in ((low, "v", values - errors < low), (high, "^", values + errors > high)):
        axes.plot(
            depths[beyond],
            np.full(beyond.sum(), edge),
            marker,
            color=style.ink(),
            markersize=style.mark(),
            clip_on=False,
        )


def _deviation(axes, table):
    axes.axhline(0, color=style.grey(0.6), linewidth=style.width(0.55))
    for smooth, look in (
        (False, {"color": style.ink(), "marker": "o"}),
        (True, {"color": style.grey(0.45), "marker": "D"}),
    ):
        pairs = metrics.pairs(table, "force-depth", smooth)
        if not pairs:
            continue
        deviations = [metrics.relative_deviation(a.normal_force, b.normal_force) for a, b in pairs]
        values, errors = 100 * np.array(deviations).T
        depths = np.array([a.depth * 1e6 for a, _ in pairs])
        axes.errorbar(depths, values, yerr=None if smooth else np.nan_to_num(errors),
                      linestyle=":" if smooth else "-", label="smooth" if smooth else "rough", **look)  # fmt: skip
        if not smooth and np.isfinite(errors).any():
            _scale(axes, depths, values, errors)
    axes.legend(ncols=2, loc="lower right", bbox_to_anchor=(1, 1), borderaxespad=0.1)
