"""What solves cost: measured, the powers that this follows, and what those say of the largest grid."""

from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..workprecision.bill import LABELS, MEMORY_FROM, Bill
from ..workprecision.costladders import AXES
from ..workprecision.costs import Costed
from ..workprecision.forecast import GIBIBYTE, LARGEST, MEMORIES, USELESS, largest, name_of
from ..workprecision.laws import Law, NoLaw
from ..plots import style

NAME = "workprecision-costs"
# Forecasts of neighbours are drawn apart by this factor.
APART = 1.06
# Of ladders by name: marker and line. What is rough is drawn filled.
LOOKS = {
    "plane": ("s", "-"),
    "rest": ("^", "--"),
    "rest-rough": ("^", "--"),
    "slide": ("o", "-."),
    "slide-rough": ("o", "-."),
    "mdr": ("D", ":"),
    "mdr-rough": ("D", ":"),
    "modes-march": ("s", "-"),
    "modes-slide": ("^", "--"),
    "modes-mdr-march": ("s", "-"),
    "modes-mdr-slide": ("^", "--"),
    "steps-march": ("o", "-."),
    "steps-mdr": ("o", "-."),
    "speed": ("s", "-"),
    "speed-rough": ("s", "-"),
    "speed-mdr": ("D", ":"),
    "contact": ("s", "-"),
}
FILLED = {"plane", "rest-rough", "slide-rough", "mdr-rough", "speed-rough", "speed-mdr", "contact"}


def figure(costed: Costed) -> Figure | None:
    """Time, applications and memory against points; time against modes and steps, speed and contact.

    None without any ladder against points.
    """
    by_points = _along(costed, "points")
    if not by_points:
        return None
    drawing = style.canvas("double", 7.6)
    panels = drawing.subplots(3, 2)
    times, applications, memory, counts, speeds, contact = panels.flat
    _against_points(times, by_points, "processor", "processor time [s]")
    _forecasts(times, costed, "time", "processor")
    deep = {name: bill for name, bill in by_points.items() if bill.dimension == "3D"}
    _against_points(applications, deep, "applications", "operator applications [1]")
    _against_points(memory, by_points, "memory", "memory [GiB]", 1 / GIBIBYTE)
    _machines(memory)
    _forecasts(memory, costed, "memory", "memory", 1 / GIBIBYTE)
    _counts(counts, _along(costed, "modes") | _along(costed, "steps"))
    _times(speeds, _along(costed, "speed"))
    _times(contact, _along(costed, "contact"))
    for axes, letter in zip(panels.flat, "abcdef", strict=True):
        axes.set_title(f"({letter})")
        style.decades(axes)
    _shares(contact)
    style.legend(drawing, times.get_legend_handles_labels()[0], "outside upper center", 3)
    return drawing


def sheets(costed: Costed) -> dict[str, list[dict]]:
    """Every rung, every law and every forecast."""
    rungs = [row for name, bill in costed.bills.items() for row in _rungs(name, bill)]
    laws = [
        {"ladder": name, "dimension": bill.dimension, "cost": LABELS[cost], **_law(law)}
        for name, bill in costed.bills.items()
        for cost, law in bill.laws.items()
    ]
    forecasts = [{**asdict(each), "held": each.held} for each in costed.forecasts]
    return {NAME: rungs, f"{NAME}-laws": laws, f"{NAME}-forecasts": forecasts}


def caption(costed: Costed) -> str:
    """What the figure shows."""
    return (
        "Costs of a solve, each the least of some repeats alone in a process of one thread; 3D vermilion, 1D "
        "blue, rough bodies filled. Lines are powers fitted, with a fixed cost where there is one, over the range "
        "where they hold; points without a line follow none. (a) Processor time, and its forecast for "
        f"{LARGEST}² points (small, drawn apart, with intervals of 95 % for one measurement). "
        "(b) Operator applications, in equivalents of the finest grid. (c) Memory that a solve adds to its "
        "process, from 256² points on, its forecast, and what machines have (grey). (d) Time against modes of "
        "relaxation or steps in time, over that of the first. (e) Time against speed, over a the radius of the "
        "smooth contact at rest and τ the retardation time. (f) Time against the real contact of a rough plane."
    )


def _along(costed, setting) -> dict[str, Bill]:
    return {name: bill for name, bill in costed.bills.items() if bill.ladder.setting == setting}


def _look(name, bill):
    marker, line = LOOKS[name]
    colour = style.COLOUR[bill.solver]
    face = colour if name in FILLED else style.paper()
    return {"color": colour, "marker": marker, "markerfacecolor": face, "markersize": style.mark()}, line


def _against_points(axes: Axes, bills, cost, label, times=1.0):
    for name, bill in bills.items():
        points, line = _look(name, bill)
        law, values = bill.laws[cost], times * getattr(bill, cost)
        shown = values > 0
        if cost == "memory":
            shown &= bill.nodes >= MEMORY_FROM
        axes.plot(bill.x[shown], values[shown], linestyle="none", label=name_of(bill), zorder=3, **points)
        if isinstance(law, Law):
            x = np.geomspace(law.lowest, law.highest, 60)
            axes.plot(
                x, times * law.at(x), color=points["color"], linestyle=line, linewidth=style.width(0.8), zorder=2
            )
    axes.set(xscale="log", yscale="log", xlabel=f"{AXES['points'].label} [1]", ylabel=label)


def _forecasts(axes: Axes, costed, what, cost, times=1.0):
    """At the largest grid, neighbours apart, where there are any that say something."""
    known = {each.ladder: each for each in costed.forecasts if each.what == largest(what) and each.reason is None}
    bills = [bill for bill in _along(costed, "points").values() if bill.dimension == "3D"]
    drawn = [(bill, known[name_of(bill)]) for bill in bills if name_of(bill) in known]
    drawn = [(bill, each) for bill, each in drawn if each.high <= USELESS * each.low]
    for k, (bill, each) in enumerate(drawn):
        law, place = bill.laws[cost], LARGEST * APART ** (2 * k - len(drawn) + 1)
        x = np.geomspace(law.highest, LARGEST, 40)
        look: dict[str, Any] = {"color": style.COLOUR[bill.solver], "linewidth": style.width(0.65)}
        axes.plot(x, times * law.at(x), **look | {"linewidth": style.width(0.45), "alpha": 0.6}, zorder=1)
        marker, _ = LOOKS[next(name for name, other in costed.bills.items() if other is bill)]
        bars = [[each.value - each.low], [each.high - each.value]]
        axes.errorbar(
            [place], [each.value], bars, marker=marker, markersize=style.mark(0.65), linestyle="none", **look
        )


def _machines(axes: Axes):
    axes.set_xlim(right=max(2 * LARGEST, axes.get_xlim()[1]))
    for k, size in enumerate(MEMORIES):
        axes.axhline(size, color=style.grey(0.6), linewidth=style.width(0.65), zorder=0)
        axes.annotate(
            f"{size} GiB",
            (0.01 + 0.12 * k, size),
            xycoords=("axes fraction", "data"),
            fontsize=style.tiny(),
            color=style.grey(0.35),
            va="bottom",
        )


def _counts(axes: Axes, bills):
    """Over the first: what modes or steps add."""
    for name, bill in bills.items():
        first = bill.processor[0]
        points, line = _look(name, bill)
        label = f"{name_of(bill)}: {bill.ladder.setting}"
        axes.plot(
            bill.x, bill.processor / first, linestyle=line, linewidth=style.width(0.8), label=label, **points
        )
    axes.set(
        xscale="log", yscale="log", xlabel="modes, or steps in time [1]", ylabel="time over that of the first [1]"
    )
    _legend(axes, bills)


def _times(axes: Axes, bills):
    for name, bill in bills.items():
        points, line = _look(name, bill)
        order = np.argsort(bill.x)
        axes.plot(
            bill.x[order],
            bill.processor[order],
            linestyle=line,
            linewidth=style.width(0.8),
            label=name_of(bill),
            **points,
        )
    label = next((f"{AXES[bill.ladder.setting].label} [1]" for bill in bills.values()), "")
    axes.set(xscale="log", yscale="log", xlabel=label, ylabel="processor time [s]")
    _widened(axes, bills)
    _legend(axes, bills)


def _widened(axes: Axes, bills):
    """A decade at least: a cost that hardly varies is to look so."""
    found = np.concatenate([[np.nan], *(bill.processor for bill in bills.values())])
    found = found[np.isfinite(found) & (found > 0)]
    if len(found):
        middle = np.sqrt(found.min() * found.max())
        axes.set_ylim(min(found.min() / 2, middle / 4), max(found.max() * 2, middle * 4))


def _legend(axes: Axes, bills):
    if bills:
        axes.legend(fontsize=style.tiny())


def _shares(axes: Axes):
    """Ticks of a share of contact, from next to nothing to nearly all."""
    if not axes.lines:
        return
    x = np.concatenate([line.get_xdata() for line in axes.lines])
    if not ((x > 0) & (x < 1)).any():
        return
    axes.set_xscale("logit")
    ticks = [0.001, 0.01, 0.1, 0.5, 0.9, 0.99, 0.999]
    axes.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    axes.set_xticks([], minor=True)
    axes.set_xlim(np.nanmin(x) / 2, 1 - (1 - np.nanmax(x)) / 2)


def _rungs(name, bill: Bill) -> Sequence[dict]:
    return [
        {
            "ladder": name,
            "label": bill.ladder.label,
            "dimension": bill.dimension,
            "along": bill.ladder.setting,
            "x": bill.x[k],
            "points": rung.solver.points,
            "steps": rung.solver.steps,
            "tolerance": getattr(rung.solver, "tolerance", None),
            "precision": getattr(rung.solver, "precision", "double"),
            "processor": bill.processor[k],
            "wall": bill.wall[k],
            "repeats": bill.repeats[k],
            "memory": bill.memory[k],
            "bytes_a_point": bill.bytes_a_point[k],
            "applications": bill.applications[k],
            "transform_pairs": bill.products[k],
            "seconds_an_application": bill.per_application[k],
            "over_limit": bill.over_limit[k],
            "stored_bytes": bill.stored[k],
            "reason": bill.reasons[k],
        }
        for k, rung in enumerate(bill.ladder.rungs)
    ]


def _law(law: Law | NoLaw) -> dict:
    fitted = ("exponent", "low", "high", "overhead", "factor", "centre", "scatter", "lowest", "highest", "count")
    missed = ("reason", "least", "most", "at_most")
    if isinstance(law, NoLaw):
        return dict.fromkeys(fitted) | {name: getattr(law, name) for name in missed}
    low, high = law.exponent_interval
    found = {name: getattr(law, name) for name in fitted if name not in ("low", "high")}
    return dict.fromkeys(fitted) | found | {"low": low, "high": high} | dict.fromkeys(missed)
