"""Error against processor time: a panel for each contest and quantity, the settings written at the points."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import ceil, isfinite
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import LogLocator

from ..workprecision.contest import Climbed, Judged, Quantity
from ..workprecision.listing import orders, rungs
from ..workprecision.wording import digits, share
from ..plots import style
from ..plots.lettering import Letter, letter, write

NAME = "workprecision"
# Columns of panels, and their size [inch].
COLUMNS, HEIGHT = 3, 2.2
# Errors below are those of rounding, and drawn there.
LEAST = 1e-16
# Estimates beside the answer itself: distinct from both dimensions and from one another in grey.
BESIDE = (
    {"color": "#009E73", "marker": "^", "linestyle": ":"},
    {"color": "#CC79A7", "marker": "v", "linestyle": "-."},
    {"color": "#56B4E9", "marker": "D", "linestyle": (0, (5, 1, 1, 1, 1, 1))},
    {"color": "#E69F00", "marker": "P", "linestyle": (0, (3, 1))},
    {"color": "0.45", "marker": "x", "linestyle": (0, (1, 3))},
)


@dataclass(frozen=True)
class Panel:
    """A contest and the estimates of one of its quantities."""

    judged: Judged
    estimates: tuple[Quantity, ...]

    @property
    def title(self) -> str:
        """What is answered, and which quantity of it."""
        return f"{self.judged.contest.title}\n{self.estimates[0].label}"

    @property
    def curves(self) -> list[tuple[Climbed, Quantity]]:
        """All ladders by the first estimate, and the first of them by the others too."""
        first, *others = self.estimates
        return [(each, first) for each in self.judged.climbed] + [
            (self.judged.climbed[0], each) for each in others
        ]

    @property
    def reference_error(self) -> float:
        """Of what is known, relative."""
        return self.judged.known[self.estimates[0].name].relative_error


def panels(found: Sequence[Judged]) -> list[Panel]:
    """In the order of contests and quantities; what the truth does not know is left out."""
    drawn = []
    for judged in found:
        known = [each for each in judged.contest.quantities if each.name in judged.known]
        for label in dict.fromkeys(each.label for each in known):
            drawn.append(Panel(judged, tuple(each for each in known if each.label == label)))
    return drawn


def figure(found: Sequence[Judged]) -> Figure | None:
    """All panels, and one legend below. None without any."""
    drawn = panels(found)
    if not drawn:
        return None
    columns = min(COLUMNS, len(drawn)) if len(drawn) != 4 else 2
    rows = ceil(len(drawn) / columns)
    drawing = style.canvas("double", rows * HEIGHT + 0.6)
    looks, all_axes = _looks(found), []
    for k, panel in enumerate(drawn):
        axes = drawing.add_subplot(rows, columns, k + 1)
        style.head(axes, f"({letter(k)}) {panel.title}", columns)
        _panel(axes, panel, looks)
        axes.set_xlabel("processor time [s]")
        if k % columns == 0:
            axes.set_ylabel("relative error [1]")
        all_axes.append(axes)
    _legend(drawing, drawn, looks)
    drawing.draw_without_rendering()
    for axes, panel in zip(all_axes, drawn, strict=True):
        _write(axes, panel)
    return drawing


def sheets(found: Sequence[Judged]) -> dict[str, list[dict]]:
    """Every rung with all its errors and costs, and the orders observed."""
    rows = rungs(found)
    return {NAME: rows, f"{NAME}-orders": orders(found)} if rows else {}


def caption(found: Sequence[Judged]) -> str:
    """What the figure shows."""
    sources: dict[str, list[str]] = {}
    for k, panel in enumerate(panels(found)):
        own = panel.reference_error
        doubt = f", known to {share(own)}" if own > 0 else "" if isfinite(own) else ", not solved"
        sources.setdefault(f"against {panel.judged.contest.truth.source}{doubt}", []).append(f"({letter(k)})")
    said = "; ".join(f"{', '.join(letters)} {source}" for source, letters in sources.items())
    several = any(len(panel.estimates) > 1 for panel in panels(found))
    estimates = " Estimates beside the answer are those of the first ladder." if several else ""
    return (
        "Relative error against the processor time of one solve, the least of its repeats; the setting is written "
        f"at the points where there is room. {said}. Grey, the error of the reference itself, within which "
        "points are hollow; dotted, the power fitted to the error of a ladder of points, with its exponent. "
        f"Errors below {LEAST:.0e} are drawn there; solves that failed are named and not drawn.{estimates}"
    )


def _looks(found) -> Mapping[str, Mapping[str, Any]]:
    """Colour, marker and line of each ladder by its label, the same in all panels."""
    solvers: dict[str, list[str]] = {}
    for judged in found:
        for climbed in judged.climbed:
            labels = solvers.setdefault(climbed.ladder.rungs[0].solver.name, [])
            if climbed.ladder.label not in labels:
                labels.append(climbed.ladder.label)
    looks = {}
    for solver, labels in solvers.items():
        start = style.SERIES_MARKERS.index(style.MARKER.get(solver, "o"))
        for k, (label, colour) in enumerate(zip(labels, style.shades(solver, max(len(labels), 2)), strict=False)):
            own = style.COLOUR[solver] if k == 0 else colour if k > 1 else style.shades(solver, 2)[0]
            looks[label] = {
                "color": own,
                "marker": style.SERIES_MARKERS[(start + 2 * k) % len(style.SERIES_MARKERS)],
                "linestyle": style.SERIES_LINES[k % len(style.SERIES_LINES)],
            }
    return looks


def _panel(axes: Axes, panel, looks):
    axes.set(xscale="log", yscale="log")
    solved = False
    for climbed, quantity in panel.curves:
        errors = np.maximum(climbed.errors[quantity.name], LEAST)
        if not np.isfinite(errors).any():
            continue
        solved = True
        look = dict(_look(panel, climbed, quantity, looks))
        marker = look.pop("marker")
        axes.plot(climbed.processor, errors, **look)
        hollow = errors <= panel.reference_error if quantity.by != "indicator" else np.zeros(len(errors), bool)
        for part, face in ((hollow, style.paper()), (~hollow, look["color"])):
            axes.plot(
                climbed.processor[part],
                errors[part],
                linestyle="none",
                marker=marker,
                markersize=style.mark(),
                color=look["color"],
                markerfacecolor=face,
                zorder=3,
            )
    if not solved:
        axes.text(0.5, 0.5, "not solved", transform=axes.transAxes, ha="center", va="center")
        return
    _room(axes, panel)
    if panel.reference_error > 0:
        axes.axhspan(axes.get_ylim()[0], panel.reference_error, color=style.grey(0.9), zorder=0, linewidth=0)
    for climbed in panel.judged.climbed:
        _guide(axes, panel, climbed)
    _failed(axes, panel)


def _look(panel, climbed, quantity, looks):
    k = panel.estimates.index(quantity)
    return (
        looks[climbed.ladder.label] if k == 0 else {**BESIDE[(k - 1) % len(BESIDE)], "linewidth": style.width(0.7)}
    )


def _room(axes, panel):
    """Limits around all points, with room for what is written; at least a decade of errors."""
    x = np.concatenate([climbed.processor for climbed, _ in panel.curves])
    y = np.concatenate([climbed.errors[quantity.name] for climbed, quantity in panel.curves])
    y = np.maximum(y[np.isfinite(y)], LEAST)
    low, high = y.min(), y.max()
    if panel.reference_error > 0:
        low = min(low, panel.reference_error)
    room = max((high / low) ** 0.16, 10 ** (0.5 - np.log10(high / low) / 2))
    axes.set_ylim(low / room, high * room)
    low, high = np.nanmin(x), np.nanmax(x)
    room = max((high / low) ** 0.12, 1.3)
    axes.set_xlim(low / room, high * room)
    style.decades(axes)
    axes.xaxis.set_major_locator(LogLocator(subs=_ticks(high / low)))


def _ticks(span):
    """Multiples of powers of ten that are written, the fewer the more decades there are."""
    return (1, 2, 3, 5) if span < 5 else (1, 2, 5) if span < 30 else (1,)


def _guide(axes, panel, climbed):
    if (power := _power(panel, climbed)) is not None:
        x, y, _ = power
        axes.plot(x, y, color=style.grey(0.3), linestyle=(0, (1, 1.5)), linewidth=style.width(0.7), zorder=1)


def _power(panel, climbed):
    """Times, errors by the power law fitted to a ladder of points, and its order; None where there is none."""
    order = panel.judged.order(climbed, panel.estimates[0].name)
    if climbed.ladder.setting != "points" or not order.order > 0:
        return None
    solved = np.isfinite(climbed.processor)
    return climbed.processor[solved], order.at(climbed.ladder.values)[solved], order.order


def _failed(axes, panel):
    failed = [
        f"{climbed.ladder.setting} {digits(climbed.ladder.values[k])}"
        for climbed in panel.judged.climbed
        for k, reason in enumerate(climbed.reasons)
        if reason is not None
    ]
    if failed:
        said = f"failed: {', '.join(failed)}"
        axes.text(
            0.02, 0.02, said, transform=axes.transAxes, fontsize=style.tiny(), color=style.grey(0.3), va="bottom"
        )


def _write(axes: Axes, panel):
    """Settings at the points, then the exponents of the powers at their ends."""
    quantity = panel.estimates[0]
    settings = [
        Letter(digits(value), point)
        for climbed in panel.judged.climbed
        for point, value in _points(climbed, quantity)
    ]
    powers = []
    for climbed in panel.judged.climbed:
        if (power := _power(panel, climbed)) is not None:
            x, y, order = power
            powers.append(Letter(f"$n^{{-{order:.1f}}}$", (x[-1], y[-1]), style.grey(0.35), needed=False))
    write(axes, settings + powers, style.tiny())


def _points(climbed, quantity):
    errors = np.maximum(climbed.errors[quantity.name], LEAST)
    return [
        ((x, y), value)
        for x, y, value in zip(climbed.processor, errors, climbed.ladder.values, strict=True)
        if np.isfinite(x) and np.isfinite(y)
    ]


def _legend(drawing, drawn, looks):
    entries = {
        label: Line2D([], [], **look, label=label, markersize=style.mark()) for label, look in looks.items()
    }
    for panel in drawn:
        for k, quantity in enumerate(panel.estimates[1:]):
            look = BESIDE[k % len(BESIDE)]
            entries.setdefault(
                quantity.by,
                Line2D([], [], **look, label=quantity.by, markersize=style.mark(), linewidth=style.width(0.7)),
            )
    style.legend(drawing, list(entries.values()), "outside lower center", len(entries))
