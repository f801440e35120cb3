"""Normal force at rest at given depths: what roughness adds to it, and one dimension against three."""

from collections.abc import Sequence
from itertools import product
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from pandas import DataFrame, concat

from ....figures import style
from ....figures.curves import averaged, intervals, of_curves, unanswered
from ....figures.lettering import lettered
from ....report.page import Plot, Tables
from ....statistics.finding import Finding

NAME = "force-depth"
DEVIATIONS = f"{NAME}-deviations"
MICRONS = 1e6
# Neighbouring markers are drawn apart by this factor of the depth, either way.
APART = 1.02


def plot(
    points: DataFrame, deviations: Sequence[tuple[str, str, float, Finding]], folder: str = ""
) -> Plot | None:
    """Plot of force against depth; None without points.

    deviations : body, model, depth [m], and the finding on it over the reference less one
    """
    own = of_curves(points, points["curve"].str.startswith(NAME))
    if own.empty:
        return None
    rows = [
        {"body": body, "solver": solver, "depth": depth}
        | {"deviation": found.value, "deviation_low": low, "deviation_high": high}
        for body, solver, depth, found in deviations
        for low, high in [found.interval]
    ]
    names = ["body", "solver", "depth", "deviation", "deviation_low", "deviation_high"]
    caption = (
        "Force at a depth at rest: (a) over that on the smooth body in closed form, or else in 3D, less one; (b) "
        f"in 1D over that in 3D, less one. An arrow marks a bar that goes on. {averaged(own)}"
    )
    alternative = "Deviations of force fall with depth, of rough bodies from the smooth one and of 1D from 3D."
    tables = {NAME: own, DEVIATIONS: DataFrame(rows, columns=names)}
    return Plot(f"{folder}{NAME}", figure, tables, caption, alternative)


def figure(tables: Tables) -> Figure:
    """Above: force less that on the smooth body. Below: 1D over 3D."""
    points = tables[NAME]
    several = len(set(points["solver"]) - {"exact"}) > 2
    drawing = style.canvas("double" if several else "single", 4.6 if several else 3.9)
    above, below = drawing.subplots(2, 1, sharex=True)
    above.set(ylabel="force / smooth - 1 [%]", xscale="log")
    above.axhline(0, **style.line(0.6, 0.55))
    style.span(above, MICRONS * points["depth"])
    _over_smooth(above, points)
    _deviations(below, tables[DEVIATIONS])
    over = "1D / 3D" if set(points["solver"]) <= {"MDR", "BEM", "exact"} else "over reference"
    below.set(xlabel="depth [µm]", ylabel=f"force {over} - 1 [%]")
    lettered((above, below))
    style.legend(drawing, above.get_legend_handles_labels()[0], "outside upper left", 4 if several else 2)
    style.decades(above, below)
    return drawing


def _over_smooth(axes: Axes, points: DataFrame) -> None:
    """Force over that on the smooth body at the same depth, less one, in both dimensionalities."""
    smooth = points[points["body"] == "smooth"].sort_values("depth")
    known = next((own for solver in ("exact", "BEM") if len(own := smooth[smooth["solver"] == solver])), smooth)
    if known.empty:
        return
    rows, names = [], ["normal_force_mean", "normal_force_low", "normal_force_high"]
    hollow = {"markerfacecolor": style.paper(), "linestyle": "none"}
    solvers = [each for each in points["solver"].unique() if each != "exact"]
    for index, solver in enumerate(solvers):
        for body, look in (("smooth", hollow), ("rough", {})):
            curve = points[(points["solver"] == solver) & (points["body"] == body)]
            force = np.interp(curve["depth"], known["depth"], known["normal_force_mean"])
            if len(curve):
                own = 100 * (curve[names].div(force, axis=0) - 1)
                x = MICRONS * curve["depth"].to_numpy(float) * APART ** (2 * index - len(solvers) + 1)
                label = f"{style.label(solver)}, {body}"
                intervals(axes, x, own, "normal_force", **style.look(solver, label=label, **look))
                unanswered(axes, x, own["normal_force_mean"], style.COLOUR[solver], label)
                rows += [own.set_axis(x)] if body == "rough" else []
    if rows:
        _limit(axes, *concat(rows).reset_index().to_numpy(float).T)


def _deviations(axes: Axes, found: DataFrame) -> None:
    axes.axhline(0, **style.line(0.6, 0.55))
    looks: dict[str, dict[str, Any]] = {
        "rough": {"color": style.ink(), "marker": "o", "linestyle": "-"},
        "smooth": {"color": style.grey(0.45), "marker": "D", "linestyle": ":"},
    }
    rough: list[tuple[Any, DataFrame]] = []
    several = found["solver"].nunique() > 1
    solvers = list(found["solver"].unique())
    for (body, look), (index, solver) in product(looks.items(), enumerate(solvers)):
        curve = found[(found["body"] == body) & (found["solver"] == solver)]
        if several:
            look = look | {"color": style.COLOUR[solver]}
        if len(curve):
            label = f"{style.label(solver)}, {body}" if several else body
            x = MICRONS * curve["depth"] * APART ** (2 * index - len(solvers) + 1)
            intervals(axes, x, curve, "deviation", 100, label=label, **look)
            rough += [(x, curve)] if body == "rough" else []
    if rough:
        names = ["deviation", "deviation_low", "deviation_high"]
        ends = concat(curve[names] for _, curve in rough).to_numpy(float).T
        _limit(axes, concat(x for x, _ in rough).to_numpy(float), *(100 * ends))
    if len(found):
        axes.legend(ncols=2, loc="lower right", bbox_to_anchor=(1, 1), borderaxespad=0.1)


def _limit(axes, depths, values, low, high):
    """Limits from all values and the shorter half of the bars; an arrow where a bar goes on beyond them."""
    if not np.isfinite(high - low).any():
        return
    short = (high - low) <= np.nanmedian(high - low)
    bottom = min(0, np.nanmin(np.where(short, low, values)))
    top = max(0, np.nanmax(np.where(short, high, values)))
    margin = 0.15 * (top - bottom) or 1.0
    bottom, top = bottom - margin, top + margin
    axes.set_ylim(bottom, top)
    for edge, marker, beyond in ((bottom, "v", low < bottom), (top, "^", high > top)):
        look = {"color": style.ink(), "markersize": style.mark(), "clip_on": False, "linestyle": "none"}
        if beyond.any():  # a line without points counts in the layout, at the corner of the figure
            axes.plot(depths[beyond], np.full(beyond.sum(), edge), marker=marker, **look)
