"""Error against the true answer of three dimensions over time: the models in one picture, in several regimes."""

from collections.abc import Iterator, Sequence
from math import ceil, isfinite
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from ....report.page import Plot, Tables
from ....report.plots import style
from ....report.plots.lettering import Letter, letter, write
from ....statistics.convergence import MeasuredLadder
from ....statistics.sampling import Mean, SamplingPlan, envelope
from .errors import Panel, corner, dots, guide, hidden, marks, panels
from .surfaces import means, plan_look

# Models of one dimension, as a legend calls them.
LINES = {"MDR": "1D", "CorrectedMDR": "corrected 1D"}
# Panels side by side, their height, and that of what surrounds them all [inch].
COLUMNS, HEIGHT, AROUND = 3, 1.9, 0.6
# The same of one panel, whose legend is a column [inch].
BELOW = 1.5
# Dashes of what is forecast.
FORECAST = (0, (4, 2))
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


def plots(name: str, tables: Tables) -> Iterator[Plot]:
    """Plots of all regimes, of smooth contacts and of rough ones, from the tables of steps, plans and answers."""
    kinds = {name.split("-")[2]: name for name in tables}
    if "steps" in kinds:
        yield Plot(
            f"{name}-smooth", smooth, tables,
            "Smooth contacts: error against the true answer of three dimensions, over processor time. Numbers: "
            "points of the grid; dotted, fitted power. Grey, error of the reference; hollow, within it.",
            "Panels of error over time: 1D is quick and level, 3D slower and falling.", {"steps": kinds["steps"]},
        )  # fmt: skip
    if "plans" in kinds:
        yield Plot(
            f"{name}-rough", rough, tables,
            "Rough contacts: expected error of a mean of 1, 10, 100, ... surfaces against the true answer of 3D, "
            "over processor time; dashed, forecast beyond the surfaces solved. Numbers: points of the grid; "
            "thick, cheapest plan in 3D. Bands, intervals of 95 % of errors that 1D keeps.",
            "Panels of error over time: 1D is quick and level, 1D corrected lower, 3D slower and falling.",
            {"plans": kinds["plans"]},
        )  # fmt: skip


def smooth(tables: Tables, steps: str) -> Figure:
    """Smooth contacts, a panel a regime and quantity. steps : name of the table"""
    drawn = sorted(panels(tables[steps]), key=lambda panel: panel.first.quantity != "friction")
    drawing, axes = _panels([panel.first for panel in drawn])
    for each, panel in zip(axes, drawn, strict=True):
        _draw_ladders(each, panel)
    _share(axes, 5.0, 2.5)
    _legend(drawing, _solvers())
    for each, panel in zip(axes, drawn, strict=True):
        write(each, _settings(panel), style.tiny())
    return drawing


def rough(tables: Tables, plans: str) -> Figure:
    """Means over rough surfaces, a panel a regime and quantity. plans : name of the table"""
    drawn = sorted(means(tables[plans]), key=lambda mean: mean.quantity != "friction")
    drawing, axes = _panels(drawn)
    for each, mean in zip(axes, drawn, strict=True):
        _draw_mean(each, mean)
    _share(axes, 2.0, 1.5)
    forecast = style.line(0.3, 0.8, linestyle=FORECAST, label="forecast")
    _legend(drawing, [*_solvers(), forecast, _cheapest() | {"label": "cheapest plan in 3D"}], bands=True)
    for each, mean in zip(axes, drawn, strict=True):
        write(each, _ends(mean), style.tiny())
    return drawing


def _solvers() -> list[dict[str, Any]]:
    """Looks of all solvers in the legend; dashes are left to what is forecast."""
    return [style.look(solver, markersize=style.mark(0.8), linestyle="-") for solver in (*LINES, "BEM")]


def _panels(told: Sequence[MeasuredLadder | Mean]) -> tuple[Figure, list[Axes]]:
    """Empty panels with titles, all of the same axes."""
    columns = min(COLUMNS, len(told))
    rows = ceil(len(told) / columns)
    drawing = style.canvas(
        "double" if columns > 1 else "single", rows * HEIGHT + (AROUND if columns > 1 else BELOW)
    )
    every: list[Axes] = []
    for k, each in enumerate(told):
        first = every[0] if every else None
        axes = drawing.add_subplot(rows, columns, k + 1, sharex=first, sharey=first, xscale="log", yscale="log")
        style.head(axes, f"({letter(k)}) {_headed(each)}", columns)
        if k % columns == 0:
            axes.set_ylabel("relative error [1]")
        if k + columns >= len(told):
            axes.set_xlabel("processor time [s]")
        every.append(axes)
    return drawing, every


def _headed(told) -> str:
    """The body, and below it the motion and the quantity."""
    body, _, motion = told.title.rpartition(", ")
    return f"{body}\n{motion}: {told.quantity}" if body else f"{motion}\n{told.quantity}"


def _draw_ladders(axes: Axes, panel: Panel):
    """Errors of the ladders of a smooth contact, and the powers they follow."""
    own = panel.first.reference_error
    for curve in panel.curves:
        colour, errors = style.COLOUR[curve.solver], np.maximum(curve.errors, LEAST)
        line: dict[str, Any] = {"linestyle": "-", "linewidth": style.width(0.8)}
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
    solved = level.scatter.dof + 1
    for first, last, line in ((1, solved, "-"), (solved, LONGEST, FORECAST)):
        counts = np.geomspace(first, last, 120)
        drawn = look | {"linestyle": line, "zorder": 3}
        axes.plot(plan.setup + counts * level.seconds, plan.error_of(counts), **drawn)
    marks = {"marker": style.MARKER[plan.solver], "markersize": style.mark(0.65), "color": look["color"]}
    axes.plot(plan.setup + MARKED * level.seconds, plan.error_of(MARKED), linestyle="none", zorder=4, **marks)


def _cheapest():
    return {"color": style.grey(0.1), "linewidth": style.width(2), "alpha": 0.35, "linestyle": "-"}


def _share(group: Sequence[Axes], high: float, wide: float) -> None:
    """Limits that all panels share, with room by these factors: errors and times are compared across regimes."""
    lines = [line for axes in group for line in axes.lines]
    if not lines:
        return
    x, y = (np.concatenate([np.asarray(line.get_data()[k], float) for line in lines]) for k in (0, 1))
    known = np.isfinite(x) & np.isfinite(y) & (y > 0)
    if not known.any():
        return
    for axes in group:
        axes.set_xlim(x[known].min() / 2.5, x[known].max() * wide)
        axes.set_ylim(max(y[known].min() / high, LEAST / 5), y[known].max() * high)
        style.decades(axes)


def _legend(drawing: Figure, looks: Sequence[dict[str, Any]], bands: bool = False) -> None:
    """Below all panels; then the panels have their places."""
    entries: list = [Line2D([], [], **look) for look in looks]
    for solver, name in LINES.items() if bands else ():
        band: dict[str, Any] = {"color": style.COLOUR[solver], "alpha": 0.2, "linewidth": 0}
        entries.append(Patch(**band, label=f"error that {name} keeps, 95 %"))
    entries.append(Patch(color=style.grey(0.88), linewidth=0, label="error of the reference"))
    style.legend(drawing, entries, "outside lower center", len(entries))
    style.lay_out(drawing)
