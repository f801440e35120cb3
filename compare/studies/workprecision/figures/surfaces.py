"""Expected error of a mean over surfaces, of its scatter and of its grid together, against their number."""

from collections.abc import Sequence
from math import ceil, isfinite

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from pandas import DataFrame

from ....report.page import Plot, Tables
from ....report.plots import style
from ....report.plots.lettering import Letter, letter, write
from ....solving.amounts import seconds, share
from ....statistics.sampling import Bias, Effort, Level, Mean, SamplingPlan, Scatter, cheapest
from .errors import hidden

COLUMNS, HEIGHT, AROUND = 3, 2.2, 0.55
# Surfaces that curves are drawn to at least.
MOST = 1e4
# Grids that leave errors less than this factor apart are labelled together; errors are drawn from here on.
APART, LEAST = 1.5, 1e-5
TAKEN = {False: "*", True: "D"}


def plot(name: str, tables: Tables, levels: Sequence[float]) -> Plot:
    """Plot of all regimes. levels : wanted errors of which the cheapest plans are marked"""
    return Plot(
        name, figure, tables,
        "Expected error of a mean over rough surfaces in 3D against their number, on grids of so many points; "
        f"dotted, what scatter leaves. Markers, the cheapest plan to {', '.join(map(share, levels))} with its "
        "time: star, one grid; diamond, the coarsest corrected on finer ones. Grey, grid error of the truth.",
        "Panels of curves that fall with the number of surfaces and flatten at the error of their grid.",
        {"plans": name, "levels": list(levels)},
    )  # fmt: skip


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


def figure(tables: Tables, plans: str, levels: Sequence[float]) -> Figure:
    """A panel a regime and quantity, and one legend below. plans : name of the table"""
    drawn = means(tables[plans])
    columns = min(COLUMNS, len(drawn))
    rows = ceil(len(drawn) / columns)
    drawing = style.canvas("double" if columns > 1 else "single", rows * HEIGHT + AROUND)
    panels = drawing.subplots(rows, columns, sharex=True, sharey=True, squeeze=False)
    for k, (axes, each) in enumerate(zip(panels.flat, drawn, strict=False)):
        style.head(axes, f"({letter(k)}) {each.title}\n{each.label}", columns)
        axes.set(xscale="log", yscale="log")
        _panel(axes, each, _taken(each, levels))
        if k % columns == 0:
            axes.set_ylabel("expected relative error [1]")
        if k + columns >= len(drawn):
            axes.set_xlabel("surfaces [1]")
            axes.tick_params(labelbottom=True)
    for axes in list(panels.flat)[len(drawn) :]:
        axes.remove()
    _limits(panels[0, 0], drawn)
    _legend(drawing, drawn)
    style.lay_out(drawing)
    for axes, each in zip(panels.flat, drawn, strict=False):
        taken = _taken(each, levels).items()
        letters = [Letter(seconds(effort.seconds), (effort.counts[0], level)) for level, effort in taken]
        write(axes, letters, style.tiny())
    return drawing


def plan_look(plan: SamplingPlan, plans: Sequence[SamplingPlan]) -> dict:
    """Look of the plans of one solver on one grid each: shades, the finest grid darkest."""
    shades = style.shades(plan.solver, len(plans))[::-1] if len(plans) > 1 else [style.COLOUR[plan.solver]]
    k = plans.index(plan)
    return {"color": shades[k], "linestyle": style.LINE[plan.solver], "linewidth": style.width(0.8)}


def _panel(axes: Axes, each: Mean, taken):
    own = each.plain
    most = max([MOST, *(effort.counts[0] for effort in taken.values())]) * 2
    counts = np.geomspace(1, most, 160)
    known = [plan for plan in own if np.isfinite(plan.error_of(counts)).all()]
    for plan in known:
        look = plan_look(plan, own)
        axes.plot(counts, plan.error_of(counts), **look)
        level = {"color": look["color"], "linewidth": style.width(0.55), "linestyle": (0, (1, 3))}
        axes.axhline(plan.bias.size, zorder=1, **level)
    _label(axes, known)
    scatter = own[0].levels[0].scatter.value
    if isfinite(scatter):
        axes.plot(counts, scatter / np.sqrt(counts), **_scatter(), zorder=1)
    if isfinite(each.grid_error) and each.grid_error > 0:
        hidden(axes, LEAST / 10, each.grid_error)
    for level, effort in taken.items():
        corrected = len(effort.counts) > 1
        size = style.mark(0.9) if corrected else 6
        axes.plot(effort.counts[0], level, TAKEN[corrected], color=style.ink(), markersize=size, zorder=5)


def _scatter():
    return style.line(0.45, 0.8, linestyle=":")


def _taken(each, levels) -> dict[float, Effort]:
    """The cheapest plan to each wanted error that is reached."""
    return {level: effort for level in levels if (effort := cheapest(each.of("BEM"), level)) is not None}


def _label(axes, known: Sequence[SamplingPlan]):
    """Points beside what their grids leave, together where these lie close."""
    together: list[list[SamplingPlan]] = []
    for plan in sorted(known, key=lambda plan: plan.bias.size):
        if together and plan.bias.size < APART * together[-1][0].bias.size:
            together[-1].append(plan)
        else:
            together.append([plan])
    place = {"xytext": (2, 0), "textcoords": "offset points", "fontsize": style.tiny(), "va": "center"}
    for close in together:
        text = ", ".join(map(str, sorted(plan.levels[0].points[0] for plan in close)))
        axes.annotate(text, (1.0, close[0].bias.size), xycoords=axes.get_yaxis_transform(), **place)


def _limits(axes, drawn):
    """Around what all grids leave and what one surface scatters by."""
    plans = [plan for each in drawn for plan in each.plain]
    sizes = [value for plan in plans for value in (plan.bias.size, plan.levels[0].scatter.value) if value > 0]
    if sizes:
        axes.set_ylim(max(min(sizes) / 2, LEAST), 2 * max(sizes))
    style.decades(axes)


def _legend(drawing, drawn):
    own = drawn[0].plain
    marked = {"color": style.ink(), "linestyle": "none"}
    entries = [
        Line2D([], [], **plan_look(own[-1], own), label=f"3D, error of a mean on {own[-1].label} points"),
        Line2D([], [], **_scatter(), label="of scatter alone"),
        Line2D([], [], marker=TAKEN[False], markersize=style.mark(1.5), label="cheapest: one grid", **marked),
        Line2D([], [], marker=TAKEN[True], markersize=style.mark(0.9), label="cheapest: corrected", **marked),
        Patch(color=style.grey(0.88), linewidth=0, label="error of the reference"),
    ]
    style.legend(drawing, entries, "outside lower center", 3)
