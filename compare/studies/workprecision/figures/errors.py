"""Error against processor time: a panel for each contact and quantity, the settings written at the points."""

from collections.abc import Iterator, Mapping, Sequence
from math import ceil
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from pandas import DataFrame

from ....figures import style
from ....figures.lettering import MARKER, Letter, letter, write
from ....figures.prefixes import prefixed
from ....report.page import Plot, Tables
from ....statistics.convergence import MeasuredLadder, ladders

# Columns of panels, their height and that around all of them [inch].
COLUMNS, HEIGHT, AROUND = 3, 2.2, 0.6
# Errors below are of rounding in sums over thousands of points, those above leave nothing of an answer: both are
# drawn there.
ROUNDING, WHOLE = 1e-12, 1.0
HIDDEN = 0.9  # between ink and paper
ALONG = "points along x"  # numbers at curves


def plots(name: str, tables: Tables) -> Iterator[Plot]:
    """Plot of tables, of which the first is of steps."""
    table, *_ = tables
    yield Plot(
        name, figure, tables,
        "Relative error against processor time of one solve, the least of its repeats; numbers, settings at the "
        "ends of curves where there is room. Grey, error of the reference, or of rounding "
        f"({ROUNDING:g}), within which points are hollow; dotted, fitted power of a ladder of points; ↑, errors "
        "beyond the panel.",
        "Panels of falling curves: relative error over processor time.",
        {"steps": table},
    )  # fmt: skip


def figure(tables: Tables, steps: str) -> Figure:
    """A panel a contact and quantity, on the same axes as errors and times are compared, and one legend below.

    steps : name of the table
    """
    drawn = _panels(tables[steps])
    times, unit = prefixed([min(time, 1.0) for panel in drawn for curve in panel for time in curve.processor], "s")
    drawing, all_axes = framed([f"{first.title}\n{first.label}" for first, *_ in drawn], unit)
    looks = _looks(drawn)
    for axes, panel in zip(all_axes, drawn, strict=True):
        _panel(axes, panel, looks)
    _room(all_axes, drawn, times)
    for axes, (first, *_) in zip(all_axes, drawn, strict=True):
        hidden(axes, axes.get_ylim()[0], _told(first))
    handles: list[Artist] = [
        Line2D([], [], **look, label=style.LABEL.get(label, label), markersize=style.mark())
        for label, look in looks.items()
    ]
    if any(axes.patches for axes in all_axes):
        label = "error of the reference, or of rounding"
        handles.append(Patch(color=style.grey(HIDDEN), linewidth=0, label=label))
    settings = dict.fromkeys(curve.setting for panel in drawn for curve in panel)
    written = f"numbers: {', '.join(settings)}".replace("points", ALONG)
    style.legend(drawing, handles, "outside lower center", len(handles), title=written)
    style.lay_out(drawing)
    for axes, panel in zip(all_axes, drawn, strict=True):
        write(axes, list(_letters(axes, panel, looks)), style.tiny())
    return drawing


def _panels(steps: DataFrame) -> list[list[MeasuredLadder]]:
    """Ladders of each contact by each quantity."""
    groups: dict[tuple[str, str], list[MeasuredLadder]] = {}
    for each in ladders(steps):
        groups.setdefault((each.contact, each.label), []).append(each)
    return list(groups.values())


def framed(titles: Sequence[str], unit: str = "s") -> tuple[Figure, list[Axes]]:
    """Empty panels with letters and titles on the same axes. unit : of time"""
    count = len(titles)
    columns = min(COLUMNS, count) if count != 4 else 2
    rows = ceil(count / columns)
    drawing = style.canvas("double", rows * HEIGHT + AROUND)
    every: list[Axes] = []
    for k, title in enumerate(titles):
        first = every[0] if every else None
        axes = drawing.add_subplot(rows, columns, k + 1, sharex=first, sharey=first, xscale="log", yscale="log")
        style.head(axes, f"({letter(k)}) {title}" if count > 1 else title, columns)
        if k % columns == 0:
            axes.set_ylabel("relative error [1]")
        if k + columns >= count:
            axes.set_xlabel(f"processor time [{unit}]")
        every.append(axes)
    return drawing, every


def _looks(drawn) -> Mapping[str, Mapping[str, Any]]:
    """Colour, marker and line of each ladder by its label, the same in all panels."""
    solvers: dict[str, dict[str, None]] = {}
    for curve in (curve for panel in drawn for curve in panel):
        solvers.setdefault(curve.solver, {})[curve.ladder] = None
    looks: dict[str, Mapping[str, Any]] = {}
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


def _told(curve: MeasuredLadder) -> float:
    """The error from which on one is told from that of the reference, or of rounding."""
    return float(np.nanmax([curve.reference_error, ROUNDING]))


def _panel(axes: Axes, panel, looks):
    """Curves, fitted powers and failures of a panel."""
    solved = [curve for curve in panel if np.isfinite(curve.errors).any()]
    for curve in solved:
        look, errors = dict(looks[curve.ladder]), _shown(curve)
        marker, hollow = look.pop("marker"), errors <= _told(panel[0])
        axes.plot(curve.processor, errors, **look)
        for part, face in ((hollow, style.paper()), (~hollow, look["color"])):
            dots = {"marker": marker, "markersize": style.mark(), "color": look["color"], "markerfacecolor": face}
            axes.plot(curve.processor[part], errors[part], linestyle="none", zorder=3, **dots)
    if not solved:
        axes.text(0.5, 0.5, "not solved", transform=axes.transAxes, ha="center", va="center")
        return
    for curve in panel:
        if _falls(curve):
            axes.plot(*_power(curve), **style.line(0.3, 0.7, linestyle=(0, (1, 1.5)), zorder=1))
    failed = [f"{curve.setting} {_written(value)}" for curve in panel for value, _ in curve.failures]
    if failed:
        corner(axes, f"failed: {', '.join(failed)}")


def _falls(curve):
    """Whether a power is fitted to the errors of a ladder of points."""
    return curve.setting == "points" and curve.order.order > 0


def _power(curve):
    """Times, and errors by the power."""
    solved = np.isfinite(curve.processor)
    return curve.processor[solved], curve.order.at(curve.values[solved])


def hidden(axes: Axes, least: float, error: float) -> None:
    """Band of errors that are not told from that of the reference, as far as it is in view."""
    if error > least:
        axes.axhspan(least, error, color=style.grey(HIDDEN), zorder=0, linewidth=0)


def corner(axes: Axes, text: str) -> None:
    """A small text in the lower left corner."""
    look: dict[str, Any] = {"fontsize": style.tiny(), "color": style.grey(0.3), "va": "bottom"}
    axes.text(0.02, 0.02, text, transform=axes.transAxes, **look)


def _room(panels, drawn, times):
    """Limits of all panels, with room for what is written; at least a decade of errors. times : for their unit"""
    curves = [curve for panel in drawn for curve in panel]
    x = np.concatenate([curve.processor for curve in curves])
    y = np.concatenate([_shown(curve) for curve in curves])
    if np.isnan(y).all():
        return
    known = [first.reference_error for first, *_ in drawn if first.reference_error > 0]
    low, high = min([np.nanmin(y), *known]), np.nanmax(y)
    room = max((high / low) ** 0.16, 10 ** (0.5 - np.log10(high / low) / 2))
    panels[0].set_ylim(low / room, high * room)
    low, high = np.nanmin(x), np.nanmax(x)
    room = max((high / low) ** 0.12, 1.3)
    panels[0].set_xlim(low / room, high * room)
    style.decades(*panels)
    panels[0].xaxis.set_major_formatter(lambda value, _: f"{times * value:g}")


def _shown(curve):
    """Errors as they are drawn."""
    return np.clip(curve.errors, ROUNDING, WHOLE)


def _written(value: float) -> str:
    """A setting as it stands in a figure, with a power of ten where it is small."""
    text = f"{value:g}" if value >= 0.01 else f"{value:.0e}".replace("e-0", "e-")
    times, _, power = text.partition("e")
    return rf"$\mathdefault{{{times} · 10^{{{power}}}}}$".replace("1 · ", "") if power else times


def _letters(axes, panel, looks) -> Iterator[Letter]:
    """Settings at both ends of the answer, errors beyond the panel, then the exponents of the powers."""
    for curve in panel:
        colour, at = looks[curve.ladder]["color"], np.column_stack([curve.processor, _shown(curve)])
        known = np.flatnonzero(np.isfinite(at).all(axis=1))
        ends = known[[0, -1]] if known.size else known
        if len(ends):
            texts = [_written(curve.values[k]) for k in ends]
            if np.hypot(*np.diff(axes.transData.transform(at[ends]), axis=0)[0]) < MARKER * axes.figure.dpi / 36:
                texts = [" to ".join(dict.fromkeys(texts))]
            yield from (Letter(text, tuple(at[k]), colour) for text, k in zip(texts, ends, strict=False))
        for k in ends[-1:]:
            if curve.errors[k] > WHOLE:
                yield Letter(f"↑ {curve.errors[k]:.3g}", tuple(at[k]), colour)
    for curve in panel:
        if _falls(curve):
            x, y = _power(curve)
            yield Letter(f"$n^{{-{curve.order.order:.1f}}}$", (x[-1], y[-1]), style.grey(0.35))
