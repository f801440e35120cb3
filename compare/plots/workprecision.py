"""Error against processor time: a panel for each contact and quantity, the settings written at the points."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from math import ceil, isfinite
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import LogLocator
from pandas import DataFrame

from ..amounts import digits
from ..page import Plot, Tables
from . import style
from .lettering import Letter, letter, write

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


def plot(name: str, tables: Tables) -> Plot:
    """Plot of a diagram, of its table of steps and of its table of orders."""
    steps, orders = tables
    return Plot(
        name, figure, tables,
        "Relative error against processor time of one solve, the least of its repeats; settings at the points "
        "where there is room. Grey, error of the reference, within which points are hollow; dotted, fitted power "
        "of a ladder of points. Other estimates are those of the first ladder.",
        "Panels of falling curves: relative error over processor time.", {"steps": steps, "orders": orders},
    )  # fmt: skip


@dataclass(frozen=True)
class Curve:
    """One ladder by one estimate: arrays (steps,), NaN where a solve failed."""

    ladder: str
    solver: str
    setting: str
    estimate: str
    values: np.ndarray
    seconds: np.ndarray
    errors: np.ndarray
    failed: tuple[float, ...]
    power: tuple[float, float]  # order and constant of the error by points; NaN without

    @property
    def points(self) -> list[tuple[tuple[float, float], float]]:
        """Place and setting of each step that was solved."""
        return [
            ((x, y), value)
            for x, y, value in zip(self.seconds, self.errors, self.values, strict=True)
            if isfinite(x) and isfinite(y)
        ]

    @property
    def guide(self) -> tuple[np.ndarray, np.ndarray, float] | None:
        """Times, errors by the power law fitted to a ladder of points, and its order; None where there is none."""
        order, constant = self.power
        if self.setting != "points" or not order > 0:
            return None
        solved = np.isfinite(self.seconds)
        return self.seconds[solved], constant * self.values[solved] ** -order, order


@dataclass(frozen=True)
class Panel:
    """A contact by one quantity: all ladders by the first estimate, and the first of them by the others too."""

    title: str
    reference_error: float
    curves: tuple[Curve, ...]
    estimates: tuple[str, ...]

    @property
    def answers(self) -> list[Curve]:
        """Curves of the first estimate."""
        return [each for each in self.curves if each.estimate == self.estimates[0]]


def panels(steps: DataFrame, orders: DataFrame | None = None) -> list[Panel]:
    """Panels in the order of contacts and quantities."""
    steps = steps.fillna({"estimate": "", "reason": ""})
    powers = {}
    if orders is not None:
        keys = zip(*(orders[name] for name in ("contact", "quantity", "ladder")), strict=True)
        powers = dict(zip(keys, zip(orders["order"], orders["constant"], strict=True), strict=True))
    found = []
    for (contact, label), rows in steps.groupby(["contact", "label"], sort=False):
        estimates, labels = tuple(rows["estimate"].unique()), tuple(rows["ladder"].unique())
        curves = []
        for estimate, ladder in [(estimates[0], each) for each in labels] + [
            (e, labels[0]) for e in estimates[1:]
        ]:
            own = rows[(rows["estimate"] == estimate) & (rows["ladder"] == ladder)]
            first = own.iloc[0]
            curves.append(
                Curve(
                    ladder,
                    first["solver"],
                    first["setting"],
                    estimate,
                    own["value"].to_numpy(float),
                    own["processor"].to_numpy(float),
                    np.maximum(own["relative_error"].to_numpy(float), LEAST),
                    tuple(own["value"][own["reason"] != ""]),
                    powers.get((contact, first["quantity"], ladder), (np.nan, np.nan)),
                )
            )
        first = rows.iloc[0]
        title = f"{first['title']}\n{label}"
        found.append(Panel(title, float(first["reference_error"]), tuple(curves), estimates))
    return found


def figure(tables: Tables, steps: str, orders: str) -> Figure:
    """All panels, and one legend below. steps, orders : names of the tables"""
    drawn = panels(tables[steps], tables[orders])
    columns = min(COLUMNS, len(drawn)) if len(drawn) != 4 else 2
    rows = ceil(len(drawn) / columns)
    drawing = style.canvas("double", rows * HEIGHT + 0.6)
    looks, all_axes = _looks(drawn), []
    for k, panel in enumerate(drawn):
        axes = drawing.add_subplot(rows, columns, k + 1)
        style.head(axes, f"({letter(k)}) {panel.title}", columns)
        _panel(axes, panel, looks)
        axes.set_xlabel("processor time [s]")
        if k % columns == 0:
            axes.set_ylabel("relative error [1]")
        all_axes.append(axes)
    _legend(drawing, drawn, looks)
    style.lay_out(drawing)
    for axes, panel in zip(all_axes, drawn, strict=True):
        write(axes, list(_letters(panel)), style.tiny())
    return drawing


def _looks(drawn) -> Mapping[str, Mapping[str, Any]]:
    """Colour, marker and line of each ladder by its label, the same in all panels."""
    solvers: dict[str, dict[str, None]] = {}
    for panel in drawn:
        for curve in panel.curves:
            solvers.setdefault(curve.solver, {})[curve.ladder] = None
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
    solved = [curve for curve in panel.curves if np.isfinite(curve.errors).any()]
    for curve in solved:
        look = dict(_look(panel, curve, looks))
        marker = look.pop("marker")
        axes.plot(curve.seconds, curve.errors, **look)
        hollow = (curve.errors <= panel.reference_error) & (curve.estimate != "indicator")
        dots(axes, curve.seconds, curve.errors, hollow, marker, look["color"])
    if not solved:
        axes.text(0.5, 0.5, "not solved", transform=axes.transAxes, ha="center", va="center")
        return
    _room(axes, panel)
    if panel.reference_error > 0:
        axes.axhspan(axes.get_ylim()[0], panel.reference_error, color=style.grey(0.9), zorder=0, linewidth=0)
    for curve in panel.answers:
        if curve.guide:
            guide(axes, *curve.guide[:2])
    failed = [f"{curve.setting} {digits(value)}" for curve in panel.answers for value in curve.failed]
    if failed:
        corner(axes, f"failed: {', '.join(failed)}")


def dots(
    axes: Axes, x: np.ndarray, y: np.ndarray, hollow: np.ndarray, marker: str, colour, size: float = 1.0
) -> None:
    """Markers at points, hollow where the error of the reference hides them."""
    for part, face in ((hollow, style.paper()), (~hollow, colour)):
        own = {"marker": marker, "markersize": style.mark(size), "color": colour, "markerfacecolor": face}
        axes.plot(x[part], y[part], linestyle="none", zorder=3, **own)


def guide(axes: Axes, x: np.ndarray, y: np.ndarray) -> None:
    """The power that errors follow."""
    axes.plot(x, y, color=style.grey(0.3), linestyle=(0, (1, 1.5)), linewidth=style.width(0.7), zorder=1)


def corner(axes: Axes, text: str) -> None:
    """A small text in the lower left corner."""
    axes.text(
        0.02, 0.02, text, transform=axes.transAxes, fontsize=style.tiny(), color=style.grey(0.3), va="bottom"
    )


def _look(panel, curve, looks):
    k = panel.estimates.index(curve.estimate)
    return looks[curve.ladder] if k == 0 else {**BESIDE[(k - 1) % len(BESIDE)], "linewidth": style.width(0.7)}


def _room(axes, panel):
    """Limits around all points, with room for what is written; at least a decade of errors."""
    x = np.concatenate([curve.seconds for curve in panel.curves])
    y = np.concatenate([curve.errors for curve in panel.curves])
    low, high = np.nanmin(y), np.nanmax(y)
    if panel.reference_error > 0:
        low = min(low, panel.reference_error)
    room = max((high / low) ** 0.16, 10 ** (0.5 - np.log10(high / low) / 2))
    axes.set_ylim(low / room, high * room)
    low, high = np.nanmin(x), np.nanmax(x)
    room = max((high / low) ** 0.12, 1.3)
    axes.set_xlim(low / room, high * room)
    style.decades(axes)
    span = high / low
    # Multiples of powers of ten that are written, the fewer the more decades there are.
    axes.xaxis.set_major_locator(LogLocator(subs=(1, 2, 3, 5) if span < 5 else (1, 2, 5) if span < 30 else (1,)))


def _letters(panel) -> Iterator[Letter]:
    """Settings at the points, then the exponents of the powers at their ends."""
    for curve in panel.answers:
        for point, value in curve.points:
            yield Letter(digits(value), point)
    for curve in panel.answers:
        if curve.guide:
            x, y, order = curve.guide
            yield Letter(f"$n^{{-{order:.1f}}}$", (x[-1], y[-1]), style.grey(0.35), needed=False)


def _legend(drawing, drawn, looks):
    entries = {
        label: Line2D([], [], **look, label=label, markersize=style.mark()) for label, look in looks.items()
    }
    for panel in drawn:
        for k, estimate in enumerate(panel.estimates[1:]):
            look = {**BESIDE[k % len(BESIDE)], "markersize": style.mark(), "linewidth": style.width(0.7)}
            entries.setdefault(estimate, Line2D([], [], **look, label=estimate))
    style.legend(drawing, list(entries.values()), "outside lower center", len(entries))
