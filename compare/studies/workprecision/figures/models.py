"""Error against the true answer of three dimensions over time: the models in one picture, in several regimes."""

from collections.abc import Iterator, Sequence
from math import isfinite
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from pandas import DataFrame

from ....figures import style
from ....report.page import Plot, Tables
from ....statistics.sampling import Bias, Level, Mean, SamplingPlan, Scatter, envelope
from . import errors

# Models of one dimension, as a legend calls them.
LINES = {"MDR": "1D", "CorrectedMDR": "corrected 1D"}
# Dashes of what is forecast.
FORECAST = (0, (4, 2))
# Errors below are drawn there: the solvers stop before.
LEAST = 1e-7
# Times that curves of a mean are drawn to, over that of one surface.
LONGEST = 1e5
# Numbers of surfaces that are marked on a curve.
MARKED = np.array([1.0, 10, 100, 1000, 10_000])


def plots(name: str, tables: Tables) -> Iterator[Plot]:
    """Plots of all regimes, of smooth contacts and of rough ones, from the tables of steps, plans and answers."""
    kinds = {name.split("-")[2]: name for name in tables}
    if "steps" in kinds:
        yield from errors.plots(f"{name}-smooth", tables)
    if "plans" in kinds:
        yield Plot(
            f"{name}-rough", rough, tables,
            "Rough contacts: expected error of a mean of 1, 10, 100, ... surfaces against the true answer of 3D, "
            "over processor time; dashed, forecast beyond the surfaces solved. Points: along x; "
            "thick, cheapest plan in 3D. Bands, intervals of 95 % of errors that 1D keeps.",
            "Panels of error over time: 1D is quick and level, 1D corrected lower, 3D slower and falling.",
            {"plans": kinds["plans"]},
        )  # fmt: skip


def rough(tables: Tables, plans: str) -> Figure:
    """Means over rough surfaces, a panel a regime and quantity. plans : name of the table"""
    drawn = means(tables[plans])
    drawing, axes = errors.framed([f"{mean.title}\n{mean.label}" for mean in drawn])
    for each, mean in zip(axes, drawn, strict=True):
        _draw_mean(each, mean)
    _share(axes)
    _legend(drawing, drawn)
    return drawing


def means(table: DataFrame) -> list[Mean]:
    """Means of a table of plans."""
    found = []
    for _, rows in table.groupby(["contact", "quantity"], sort=False):
        plans = tuple(_plan(own) for _, own in rows.groupby(["solver", "plan"], sort=False))
        told = {name: rows[name].iloc[0] for name in ("contact", "title", "quantity", "label")}
        failed = rows.drop_duplicates(["solver", "points"])["failed"].sum()
        own = float(rows["truth_grid_error"].iloc[0])
        found.append(Mean(**told, plans=plans, grid_error=own, failed=int(failed)))
    return found


def _plan(rows: DataFrame) -> SamplingPlan:
    first = rows.iloc[0]
    levels = tuple(
        Level(
            (int(row.points), *([int(row.coarser_points)] if row.coarser_points else [])),
            Scatter(float(row.scatter), int(row.scatter_dof)),
            float(row.processor),
        )
        for row in rows.itertuples()
    )
    bias = Bias(abs(float(first["bias"])), float(first["bias_least"]), float(first["bias_most"]))
    return SamplingPlan(first["solver"], bias, levels, float(first["setup"]))


def _draw_mean(axes: Axes, mean: Mean):
    """Expected error of means on each grid, the cheapest plan, and what cannot be passed."""
    for plan, colour in _coloured(mean):
        _mean_curve(axes, plan, colour)
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
    errors.hidden(axes, LEAST / 10, mean.grid_error)
    if mean.failed:
        errors.corner(axes, f"not solved: {mean.failed}")


def _coloured(mean: Mean) -> Iterator[tuple[SamplingPlan, Any]]:
    """Plans that are drawn, each grid of 3D and the finest of 1D, with their colours."""
    for solver, own in {"BEM": mean.plain, **{solver: mean.of(solver)[-1:] for solver in LINES}}.items():
        shades = style.shades(solver, len(own))[::-1] if len(own) > 1 else [style.COLOUR[solver]]
        yield from zip(own, shades, strict=False)


def _mean_curve(axes, plan: SamplingPlan, colour):
    """Expected error as the number of surfaces grows."""
    (level,) = plan.levels
    if not (isfinite(level.seconds) and isfinite(plan.bias.size) and isfinite(level.scatter.value)):
        return
    solved = level.scatter.dof + 1
    for first, last, line in ((1, solved, "-"), (solved, LONGEST, FORECAST)):
        counts = np.geomspace(first, last, 120)
        look = {"color": colour, "linestyle": line, "linewidth": style.width(0.8), "zorder": 3}
        axes.plot(plan.setup + counts * level.seconds, plan.error_of(counts), **look)
    marks = {"marker": style.look(plan.solver)["marker"], "markersize": style.mark(0.65), "color": colour}
    axes.plot(plan.setup + MARKED * level.seconds, plan.error_of(MARKED), linestyle="none", zorder=4, **marks)


def _cheapest():
    return {"color": style.grey(0.1), "linewidth": style.width(2), "alpha": 0.35, "linestyle": "-"}


def _share(group: Sequence[Axes]) -> None:
    """Limits that all panels share: errors and times are compared across regimes."""
    points = [line.get_xydata() for axes in group for line in axes.lines]
    x, y = np.concatenate([np.empty((0, 2)), *points]).T
    known = np.isfinite(x) & np.isfinite(y) & (y > 0)
    if known.any():
        group[0].set_xlim(x[known].min() / 2.5, x[known].max() * 1.5)
        group[0].set_ylim(max(y[known].min() / 2, LEAST / 5), y[known].max() * 2)
        style.decades(*group)


def _legend(drawing: Figure, drawn: Sequence[Mean]) -> None:
    """Below all panels; then the panels have their places."""
    labels = {
        f"{style.LABEL[plan.solver]}, {plan.levels[0].label} points": (plan.solver, colour)
        for mean in drawn
        for plan, colour in _coloured(mean)
    }
    # Dashes are left to what is forecast.
    own = {"linestyle": "-", "markersize": style.mark(0.8)}
    looks = (style.look(solver, label=label, color=at, **own) for label, (solver, at) in labels.items())
    entries: list = [
        *(Line2D([], [], **look) for look in looks),
        Line2D([], [], **style.line(0.3, 0.8, linestyle=FORECAST), label="forecast"),
        Line2D([], [], **_cheapest(), label="cheapest plan in 3D"),
    ]
    for solver, name in LINES.items():
        band: dict[str, Any] = {"color": style.COLOUR[solver], "alpha": 0.2, "linewidth": 0}
        entries.append(Patch(**band, label=f"error that {name} keeps, 95 %"))
    entries.append(Patch(color=style.grey(errors.HIDDEN), linewidth=0, label="error of the reference"))
    style.legend(drawing, entries, "outside lower center", len(entries))
    style.lay_out(drawing)
