"""Normal force against depth at rest, rough and smooth, and the deviation of one dimension from three."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from pandas import DataFrame

from ..finding import Finding
from ..page import Plot, Tables
from . import style
from .curves import averaged, banded, intervals, of_curves

NAME = "force-depth"
DEVIATIONS = f"{NAME}-deviations"
MICRONS = 1e6


def plot(points: DataFrame, deviations: Sequence[tuple[str, float, Finding]], folder: str = "") -> Plot | None:
    """Plot of force against depth; None without points.

    deviations : body, depth [m], and the finding on 1D over 3D less one
    """
    own = of_curves(points, points["curve"].str.startswith(NAME))
    if own.empty:
        return None
    rows = [
        {"body": body, "depth": depth, "deviation": found.value, "deviation_low": low, "deviation_high": high}
        for body, depth, found in deviations
        for low, high in [found.interval]
    ]
    names = ["body", "depth", "deviation", "deviation_low", "deviation_high"]
    caption = (
        "Force against depth, pressed in at rest. Below: the force in 1D over that in 3D, less one; an arrow "
        f"marks a bar that goes on. {averaged(own)}"
    )
    alternative = "Force grows with depth; below, deviations of 1D from 3D around zero."
    tables = {NAME: own, DEVIATIONS: DataFrame(rows, columns=names)}
    return Plot(f"{folder}{NAME}", figure, tables, caption, alternative)


def figure(tables: Tables) -> Figure:
    """Above: force. Below: 1D over 3D."""
    points = tables[NAME]
    drawing = style.canvas("single", 3.9)
    above, below = drawing.subplots(2, 1, sharex=True, height_ratios=(2, 1))
    above.set(ylabel="normal force [N]", xscale="log", yscale="log")
    style.span(above, MICRONS * points["depth"])
    exact = points[points["solver"] == "exact"]
    if len(exact):
        known = style.line(0.45, 0.8, label="smooth, closed form")
        above.plot(MICRONS * exact["depth"], exact["normal_force"], "-", **known)
    hollow = {"markerfacecolor": style.paper(), "linestyle": "none"}
    for solver in ("MDR", "BEM"):
        behind = {"markersize": style.mark(1.6), "zorder": 1} if solver == "BEM" else {}
        for body, look in (("smooth", hollow | behind), ("rough", {})):
            curve = points[(points["solver"] == solver) & (points["body"] == body)]
            if len(curve):
                label = f"{style.LABEL[solver]}, {body}"
                banded(above, curve, "depth", "normal_force", solver, MICRONS, label=label, **look)
    _deviations(below, tables[DEVIATIONS])
    below.set(xlabel="depth [µm]", ylabel="1D / 3D - 1 [%]")
    style.legend(drawing, above.get_legend_handles_labels()[0], "outside upper left", 2)
    style.decades(above, below)
    return drawing


def _deviations(axes: Axes, found: DataFrame) -> None:
    axes.axhline(0, **style.line(0.6, 0.55))
    looks: dict[str, dict[str, Any]] = {
        "rough": {"color": style.ink(), "marker": "o", "linestyle": "-"},
        "smooth": {"color": style.grey(0.45), "marker": "D", "linestyle": ":"},
    }
    for body, look in looks.items():
        curve = found[found["body"] == body]
        if len(curve):
            intervals(axes, MICRONS * curve["depth"], curve, "deviation", 100, label=body, **look)
        if body == "rough" and np.isfinite(curve["deviation_high"] - curve["deviation_low"]).any():
            _limit(axes, MICRONS * curve["depth"].to_numpy(float), 100 * curve.drop(columns="body"))
    if len(found):
        axes.legend(ncols=2, loc="lower right", bbox_to_anchor=(1, 1), borderaxespad=0.1)


def _limit(axes, depths, percent):
    """Limits from all values and the shorter half of the bars; an arrow where a bar goes on beyond them."""
    values, low, high = (percent[f"deviation{end}"].to_numpy(float) for end in ("", "_low", "_high"))
    short = (high - low) <= np.nanmedian(high - low)
    bottom = min(0, np.nanmin(np.where(short, low, values)))
    top = max(0, np.nanmax(np.where(short, high, values)))
    margin = 0.15 * (top - bottom) or 1.0
    bottom, top = bottom - margin, top + margin
    axes.set_ylim(bottom, top)
    for edge, marker, beyond in ((bottom, "v", low < bottom), (top, "^", high > top)):
        look = {"color": style.ink(), "markersize": style.mark(), "clip_on": False, "linestyle": "none"}
        axes.plot(depths[beyond], np.full(beyond.sum(), edge), marker=marker, **look)
