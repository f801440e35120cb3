"""Error against the true answer of three dimensions over time: the models in one picture, in several regimes."""

from collections.abc import Sequence
from math import ceil, isfinite
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from ..page import Plot, Tables
from ..statistics.sampling import Mean, SamplingPlan, envelope
from . import style
from .lettering import Letter, letter, write
from .workprecision import Panel, corner, dots, guide, hidden, marks, panels
from .workprecision_surfaces import means, plan_look

# Models of one dimension, as a legend calls them.
LINES = {"MDR": "1D", "CorrectedMDR": "corrected 1D"}
# Size of a panel [inch], and of what surrounds them all.
HEIGHT, AROUND = 1.75, 0.55
# Errors below are drawn there: the solvers stop before.
LEAST = 1e-7
# Times that curves of a mean are drawn to, over that of one surface.
LONGEST = 1e5
# Numbers of surfaces that are marked on a curve.
MARKED = np.array([1.0, 10, 100, 1000, 10_000])
# Errors of the first and the last step by less than this factor apart are labelled together.
CLOSE = 3.0
# Least order of an error of which the power is drawn.
FALLS = 0.3


def plot(name: str, tables: Tables) -> Plot:
    """Plot of all regimes, from its tables of steps, plans and answers."""
    kinds = {name.split("-")[2]: name for name in tables}
    return Plot(
        name, figure, tables,
        "Error against the true answer of three dimensions, over processor time. Smooth: points of the grid; "
        "grey, error of the reference. Rough: expected error of a mean of 1, 10, 100, ... surfaces on so many "
        "points; thick, cheapest plan in 3D. Bands, intervals of 95 % of errors that 1D keeps, as it is and "
        "corrected.",
        "Panels of error over time: 1D is quick and level, 1D corrected lower, 3D slower and falling.",
        {kind: kinds.get(kind, "") for kind in ("steps", "plans")},
    )  # fmt: skip


def figure(tables: Tables, steps: str, plans: str) -> Figure:
    """All regimes, smooth ones above rough ones, and one legend below.

    steps, plans : names of the tables, empty where there is none
    """
    found: list[Panel | Mean] = [
        *(panels(tables[steps]) if steps else []),
        *(means(tables[plans]) if plans else []),
    ]
    drawn = sorted(found, key=lambda panel: (_rough(panel), _first(panel).quantity != "friction"))
    rows, columns, places = _places(drawn)
    drawing = style.canvas("double" if columns > 1 else "single", rows * HEIGHT + AROUND)
    first: dict[bool, Axes] = {}
    for k, (panel, place) in enumerate(zip(drawn, places, strict=True)):
        beside = first.get(_rough(panel))
        axes = drawing.add_subplot(rows, columns, place + 1, sharex=beside, sharey=beside)
        first.setdefault(_rough(panel), axes)
        style.head(axes, f"({letter(k)}) {_headed(_first(panel))}", columns)
        axes.set(xscale="log", yscale="log")
        if isinstance(panel, Mean):
            _draw_mean(axes, panel)
        else:
            _draw_ladders(axes, panel)
        if place % columns == 0 or beside is None:
            axes.set_ylabel("relative error [1]")
        if place + columns not in places or (not _rough(panel) and _rough(drawn[places.index(place + columns)])):
            axes.set_xlabel("processor time [s]")
    for rough in (False, True):
        _share([axes for axes, panel in zip(drawing.axes, drawn, strict=True) if _rough(panel) == rough], rough)
    _legend(drawing, drawn)
    style.lay_out(drawing)
    for axes, panel in zip(drawing.axes, drawn, strict=True):
        write(axes, _ends(panel) if isinstance(panel, Mean) else _settings(panel), style.tiny())
    return drawing


def _rough(panel):
    return isinstance(panel, Mean)


def _first(panel):
    """Row that names contact and quantity."""
    return panel if isinstance(panel, Mean) else panel.first


def _headed(told) -> str:
    """The body, and below it the motion and the quantity."""
    body, _, motion = told.title.rpartition(", ")
    return f"{body}\n{motion}: {told.quantity}" if body else f"{motion}\n{told.quantity}"


def _draw_ladders(axes: Axes, panel: Panel):
    """Errors of the ladders of a smooth contact, and the powers they follow."""
    own = panel.first.reference_error
    for curve in panel.curves:
        colour, errors = style.COLOUR[curve.solver], np.maximum(curve.errors, LEAST)
        line: dict[str, Any] = {"linestyle": style.LINE[curve.solver], "linewidth": style.width(0.8)}
        axes.plot(curve.processor, errors, color=colour, **line)
        dots(axes, curve.processor, errors, errors <= own, style.MARKER[curve.solver], colour, 0.8)
        if curve.order.order > FALLS:
            solved = np.isfinite(curve.processor)
            guide(axes, curve.processor[solved], np.maximum(curve.order.at(curve.values)[solved], LEAST))
    if own > 0:
        hidden(axes, LEAST / 10, own)
    if failed := sum(len(curve.failures) for curve in panel.curves):
        corner(axes, f"not solved: {failed}")


def _draw_mean(axes: Axes, mean: Mean):
    """Expected error of means on each grid, the cheapest plan, and what cannot be passed."""
    for own in (mean.plain, *(mean.of(solver)[-1:] for solver in LINES)):
        for plan in own:
            _mean_curve(axes, plan, plan_look(plan, own))
    every = mean.of("BEM")
    known = [plan.least_seconds for plan in every if isfinite(plan.least_seconds)]
    if known:
        seconds = np.geomspace(min(known), LONGEST * min(known), 200)
        axes.plot(seconds, envelope(every, seconds), **_cheapest(), zorder=2)
    for solver in LINES:
        floor = mean.floor(solver)
        if isfinite(floor.most):
            band: dict[str, Any] = {"color": style.COLOUR[solver], "alpha": 0.13, "zorder": 0, "linewidth": 0}
            axes.axhspan(max(floor.least, LEAST), floor.most, **band)
    if mean.grid_error > 0:
        hidden(axes, LEAST / 10, mean.grid_error)
    if mean.failed:
        corner(axes, f"not solved: {mean.failed}")


def _ends(mean: Mean) -> list[Letter]:
    """Points at the first marks of the coarsest and of the finest grid."""
    ends = [plan for own in (mean.plain, mean.of("MDR")[-1:]) for plan in (*own[:1], *own[:0:-1][:1])]
    found = [(plan.levels[0].label, plan.levels[0].seconds, float(plan.error_of(1.0))) for plan in ends]
    return [Letter(text, (x, y)) for text, x, y in found if isfinite(x) and isfinite(y)]


def _settings(panel: Panel) -> list[Letter]:
    """Points of the grids: first and last of each ladder first, all in one where the error stays the same."""
    found = []
    for curve in panel.curves:
        solved = marks(curve, LEAST)
        if not solved:
            continue
        x, y = np.array([point for point, _ in solved]).T
        values = [f"{value:g}" for _, value in solved]
        if len(values) > 1 and np.ptp(np.log(y)) < np.log(CLOSE):
            found.append(Letter(f"{values[0]} to {values[-1]}", (x[np.argsort(x)[len(x) // 2]], y.max())))
        else:
            order = sorted(range(len(values)), key=lambda k: min(k, len(values) - 1 - k))
            found += [Letter(values[k], (x[k], y[k])) for k in order]
    return found


def _mean_curve(axes, plan: SamplingPlan, look):
    """Expected error as the number of surfaces grows."""
    (level,) = plan.levels
    if not (isfinite(level.seconds) and isfinite(plan.bias.size) and isfinite(level.scatter.value)):
        return
    counts = np.geomspace(1, LONGEST, 120)
    axes.plot(plan.setup + counts * level.seconds, plan.error_of(counts), **look, zorder=3)
    marks = {"marker": style.MARKER[plan.solver], "markersize": style.mark(0.65), "color": look["color"]}
    axes.plot(plan.setup + MARKED * level.seconds, plan.error_of(MARKED), linestyle="none", zorder=4, **marks)


def _cheapest():
    return {"color": style.grey(0.1), "linewidth": style.width(2), "alpha": 0.35, "linestyle": "-"}


def _share(group: Sequence[Axes], rough):
    """Limits that all panels of a kind share: errors and times are compared across regimes."""
    lines = [line for axes in group for line in axes.lines]
    if not lines:
        return
    x, y = (np.concatenate([np.asarray(line.get_data()[k], float) for line in lines]) for k in (0, 1))
    known = np.isfinite(x) & np.isfinite(y) & (y > 0)
    if not known.any():
        return
    for axes in group:
        axes.set_xlim(x[known].min() / 2.5, x[known].max() * (1.5 if rough else 2.5))
        axes.set_ylim(max(y[known].min() / (2 if rough else 5), LEAST / 5), y[known].max() * (2 if rough else 4))
        style.decades(axes)


def _legend(drawing, drawn):
    looks = (style.look(solver, markersize=style.mark(0.8)) for solver in (*LINES, "BEM"))
    entries: list = [Line2D([], [], **look) for look in looks]
    if any(map(_rough, drawn)):
        entries.append(Line2D([], [], **_cheapest(), label="cheapest plan in 3D"))
        for solver, name in LINES.items():
            band = {"color": style.COLOUR[solver], "alpha": 0.2, "linewidth": 0}
            entries.append(Patch(**band, label=f"error that {name} keeps, 95 %"))
    entries.append(Patch(color=style.grey(0.88), linewidth=0, label="error of the reference"))
    style.legend(drawing, entries, "outside lower center", len(entries))


def _places(drawn):
    """Rows, columns, and the place of each panel: kinds begin a row of their own, unless all fit into one."""
    counts = [count for rough in (False, True) if (count := sum(_rough(panel) == rough for panel in drawn))]
    if len(drawn) <= 4:
        return 1, len(drawn), list(range(len(drawn)))

    def size(columns):
        rows = sum(ceil(count / columns) for count in counts)
        return rows, rows * columns

    columns = min((3, 4), key=size)
    places, start = [], 0
    for count in counts:
        places += range(start, start + count)
        start += ceil(count / columns) * columns
    return start // columns, columns, places
