"""Costs of solves: measured ones, their power laws, and the forecast for the largest grid."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from pandas import DataFrame

from ....report.page import Plot, Tables
from ....report.plots import style

GIBIBYTE = 2.0**30
# Forecasts of neighbours are drawn apart by this factor; an interval wider than the other says nothing.
APART, USELESS = 1.06, 100.0
# Markers of ladders by name. Rough contacts are drawn filled.
MARKERS = {
    "plane": "s",
    "rest": "^",
    "rest-rough": "^",
    "slide": "o",
    "slide-rough": "o",
    "mdr": "D",
    "mdr-rough": "D",
    "modes-march": "s",
    "modes-slide": "^",
    "modes-mdr-march": "D",
    "modes-mdr-slide": "v",
    "steps-march": "o",
    "steps-mdr": "P",
    "speed": "s",
    "speed-rough": "s",
    "speed-mdr": "D",
    "contact": "s",
}
FILLED = {"plane", "rest-rough", "slide-rough", "mdr-rough", "speed-rough", "speed-mdr", "contact"}


def plot(name: str, tables: Tables, axes: Mapping[str, str], options: Mapping[str, Any]) -> Plot:
    """Plot of its tables of steps, laws and forecasts. axes : label of each setting; options : see figure"""
    return Plot(
        name, figure, tables,
        "Cost of a solve; 3D vermilion, 1D blue, rough bodies filled; lines, fitted powers where they hold; "
        f"dashed, forecasts for {options['largest']}² points with intervals of 95 %. (a) Processor "
        "time. (b) Operator applications. (c) Memory, and what machines have. (d) Time against modes or steps, "
        "(e) speed, (f) real contact.",
        "Six panels of costs that rise with points, modes and steps, and vary with speed and contact.",
        {"name": name, "labels": dict(axes), **options},
    )  # fmt: skip


def figure(
    tables: Tables, name: str, labels: Mapping[str, str], largest: int, memories: Sequence[float], memory_from: int
) -> Figure:
    """Time, applications and memory against points; time against modes and steps, speed and contact.

    name : of the tables; labels : of the axes by setting
    largest : points a side that forecasts are for; memories : of machines [GiB]
    memory_from : nodes from which on memory is drawn
    """
    steps, laws = tables[name], tables[f"{name}-laws"]
    forecasts = tables[f"{name}-forecasts"]
    by_points = _along(steps, "points")
    drawing = style.canvas("double", 7.6)
    panels = drawing.subplots(3, 2)
    times, applications, memory, counts, speeds, contact = panels.flat
    _against_points(times, by_points, laws, "processor", "processor time [s]")
    _forecasts(times, by_points, laws, forecasts, "time", "processor", largest)
    deep = {each: rows for each, rows in by_points.items() if rows["dimension"].iloc[0] == "3D"}
    _against_points(applications, deep, laws, "operator_applications", "operator applications [1]")
    held = {}
    for each, rows in by_points.items():
        nodes = rows["x"] if rows["dimension"].iloc[0] == "1D" else rows["x"] ** 2
        held[each] = rows[nodes >= memory_from]
    _against_points(memory, held, laws, "memory", "memory [GiB]", 1 / GIBIBYTE)
    _machines(memory, memories, largest)
    _forecasts(memory, by_points, laws, forecasts, "memory", "memory", largest, 1 / GIBIBYTE)
    for axes in (times, applications, memory):
        axes.set_xlabel(f"{labels['points']} [1]")
    _counts(counts, _along(steps, "modes") | _along(steps, "steps"))
    for axes, setting in ((speeds, "speed"), (contact, "contact")):
        _times(axes, _along(steps, setting), f"{labels[setting]} [1]")
    for axes, letter in zip(panels.flat, "abcdef", strict=True):
        axes.set_title(f"({letter})")
    style.decades(*panels.flat)
    _shares(contact)
    style.legend(drawing, times.get_legend_handles_labels()[0], "outside upper center", 3)
    return drawing


def _along(steps: DataFrame, setting: str) -> dict[str, DataFrame]:
    """Ladders of one setting by name."""
    return dict(tuple(steps[steps["along"] == setting].groupby("ladder", sort=False)))


def _look(name, rows):
    colour = style.COLOUR[rows["solver"].iloc[0]]
    face, own = colour if name in FILLED else style.paper(), {"linestyle": "-", "linewidth": style.width(0.8)}
    return own | {"color": colour, "marker": MARKERS[name], "markerfacecolor": face, "markersize": style.mark()}


def _law(laws: DataFrame, ladder: str, cost: str):
    """The fitted power as a row; None where there is none."""
    found = laws[(laws["ladder"] == ladder) & (laws["variable"] == cost) & laws["exponent"].notna()]
    return None if found.empty else found.iloc[0]


def _at(law, x):
    return law["overhead"] + law["factor"] * (x / law["centre"]) ** law["exponent"]


def _against_points(axes: Axes, ladders, laws, cost, label, times=1.0):
    for name, rows in ladders.items():
        if rows.empty:
            continue
        look, values = _look(name, rows), times * rows[cost]
        shown, none = values > 0, {"linestyle": "none", "zorder": 3}
        axes.plot(rows["x"][shown], values[shown], label=rows["title"].iloc[0], **look | none)
        law = _law(laws, name, cost)
        if law is not None:
            x = np.geomspace(law["lowest"], law["highest"], 60)
            axes.plot(x, times * _at(law, x), **look | {"marker": "", "zorder": 2})
    axes.set(xscale="log", yscale="log", ylabel=label)


def _forecasts(axes: Axes, ladders, laws, forecasts, what, cost, largest, times=1.0):
    """Forecasts at the largest grid, neighbours apart, where there are any that say something."""
    known = forecasts[(forecasts["kind"] == f"largest-{what}") & (forecasts["high"] <= USELESS * forecasts["low"])]
    for k, (_, each) in enumerate(known.iterrows()):
        law, rows = _law(laws, each["ladder"], cost), ladders[each["ladder"]]
        place = largest * APART ** (2 * k - len(known) + 1)
        x = np.geomspace(law["highest"], largest, 40)
        look: dict[str, Any] = {"color": style.COLOUR[rows["solver"].iloc[0]], "linewidth": style.width(0.65)}
        axes.plot(x, times * _at(law, x), **look | {"linestyle": "--"}, zorder=1)
        look |= {"marker": MARKERS[each["ladder"]], "markersize": style.mark(0.65), "linestyle": "none"}
        axes.errorbar(
            [place], [each["value"]], style.bars(*[[each[end]] for end in ("value", "low", "high")]), **look
        )


def _machines(axes: Axes, memories, largest):
    axes.set_xlim(right=max(2 * largest, axes.get_xlim()[1]))
    for k, size in enumerate(memories):
        axes.axhline(size, **style.line(0.6, 0.65, zorder=0))
        said: dict[str, Any] = {"fontsize": style.tiny(), "color": style.grey(0.35), "va": "bottom"}
        axes.annotate(f"{size:g} GiB", (0.01 + 0.12 * k, size), xycoords=("axes fraction", "data"), **said)


def _counts(axes: Axes, ladders):
    """Time over that of the first: what modes or steps add."""
    for name, rows in ladders.items():
        label = f"{rows['title'].iloc[0]}: {rows['along'].iloc[0]}"
        axes.plot(rows["x"], rows["processor"] / rows["processor"].iloc[0], label=label, **_look(name, rows))
    axes.set(xscale="log", yscale="log", xlabel="modes, or steps in time [1]")
    axes.set_ylabel("time over that of the first [1]")
    if ladders:
        axes.legend(fontsize=style.tiny())


def _times(axes: Axes, ladders, label):
    for name, rows in ladders.items():
        rows = rows.sort_values("x", kind="stable")
        axes.plot(rows["x"], rows["processor"], label=rows["title"].iloc[0], **_look(name, rows))
    axes.set(xscale="log", yscale="log", xlabel=label, ylabel="processor time [s]")
    # A decade at least: a cost that hardly varies is to look so.
    found = np.concatenate([[np.nan], *(rows["processor"] for rows in ladders.values())])
    found = found[np.isfinite(found) & (found > 0)]
    if len(found):
        middle = np.sqrt(found.min() * found.max())
        axes.set_ylim(min(found.min() / 2, middle / 4), max(found.max() * 2, middle * 4))
    if ladders:
        axes.legend(fontsize=style.tiny())


def _shares(axes: Axes):
    """Ticks of a share of contact, from next to nothing to nearly all."""
    x = np.concatenate([[np.nan], *(line.get_xdata() for line in axes.lines)])
    if not ((x > 0) & (x < 1)).any():
        return
    axes.set_xscale("logit")
    ticks = [0.001, 0.01, 0.1, 0.5, 0.9, 0.99, 0.999]
    axes.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    axes.set_xticks([], minor=True)
    axes.set_xlim(np.nanmin(x) / 2, 1 - (1 - np.nanmax(x)) / 2)
