"""Error against the true answer of three dimensions over time: both models in one picture, in several regimes."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import ceil, isfinite

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from ..workprecision.answers import Found, quantities, table, title
from ..workprecision.contest import Climbed, Judged, Quantity
from ..workprecision.ensemble import JudgedEnsemble, Standing
from ..workprecision.listing import rungs
from ..workprecision.records import ways
from ..workprecision.statistics import Way, envelope
from ..plots import style
from ..plots.lettering import Letter, letter, write

NAME = "workprecision-models"
# Size of a panel [inch], and of what surrounds them all.
HEIGHT, AROUND = 1.75, 0.55
# Errors below are drawn there: the solvers stop before.
LEAST = 1e-7
# Times that curves of a mean are drawn to, over that of one surface.
LONGEST = 1e5
# Numbers of surfaces that are marked on a curve.
MARKED = (1, 10, 100, 1000, 10_000)
# Errors of the first and the last rung by less than this factor apart are labelled together.
CLOSE = 3.0


@dataclass(frozen=True)
class Panel:
    """One quantity in one regime."""

    found: Found
    quantity: Quantity

    @property
    def rough(self) -> bool:
        """Whether its answer is a mean over surfaces."""
        return isinstance(self.found, JudgedEnsemble)


def panels(found: Sequence[Found]) -> list[Panel]:
    """Smooth bodies first, and of each kind friction."""
    drawn = [Panel(each, quantity) for each in found for quantity in quantities(each)]
    return sorted(drawn, key=lambda panel: (panel.rough, panel.quantity.name != "friction"))


def figure(found: Sequence[Found]) -> Figure | None:
    """All regimes, smooth ones above rough ones, and one legend below. None without any."""
    drawn = panels(found)
    if not drawn:
        return None
    rows, columns, places = _places(drawn)
    drawing = style.canvas("double" if columns > 1 else "single", rows * HEIGHT + AROUND)
    first: dict[bool, Axes] = {}
    for k, (panel, place) in enumerate(zip(drawn, places, strict=True)):
        beside = first.get(panel.rough)
        axes = drawing.add_subplot(rows, columns, place + 1, sharex=beside, sharey=beside)
        first.setdefault(panel.rough, axes)
        style.head(axes, f"({letter(k)}) {_headed(panel)}", columns)
        axes.set(xscale="log", yscale="log")
        (_rough if panel.rough else _smooth)(axes, panel)
        if place % columns == 0 or beside is None:
            axes.set_ylabel("relative error [1]")
        if place + columns not in places or (not panel.rough and drawn[places.index(place + columns)].rough):
            axes.set_xlabel("processor time [s]")
    for rough in (False, True):
        _share([axes for axes, panel in zip(drawing.axes, drawn, strict=True) if panel.rough == rough], rough)
    _legend(drawing, drawn)
    drawing.draw_without_rendering()
    for axes, panel in zip(drawing.axes, drawn, strict=True):
        write(axes, _letters(panel), style.tiny())
    return drawing


def sheets(found: Sequence[Found]) -> dict[str, list[dict]]:
    """What each setting gives and costs, and what a wanted error takes."""
    smooth = rungs([each for each in found if isinstance(each, Judged)])
    rough = [row for each in found if isinstance(each, JudgedEnsemble) for row in ways(each)]
    content: Mapping[str, list[dict]] = {
        f"{NAME}-rungs": smooth,
        f"{NAME}-ways": rough,
        f"{NAME}-answers": table(found),
    }
    return {name: rows for name, rows in content.items() if rows}


def caption(found: Sequence[Found]) -> str:
    """What the figure shows."""
    drawn = panels(found)
    labels = dict.fromkeys(panel.quantity.label for panel in drawn)
    said = [f"Error in {' and '.join(labels)} against the true answer of three dimensions, over processor time."]
    if not all(panel.rough for panel in drawn):
        said.append(
            "Smooth bodies: points of the grid are written where there is room; grey, the error of the "
            "reference, within which points are hollow; dotted, the power of the points that the error follows."
        )
    if any(panel.rough for panel in drawn):
        said.append(
            "Rough ones, of which the answer is the mean over surfaces: expected error of a mean as their number "
            "grows, marked at 1, 10, 100, ..., on as many points as are written at the first mark of the coarsest "
            "and the finest grid; it flattens at what the grid or the model leaves. Blue band, interval of 95 % "
            "of the error that 1D keeps; thick, the cheapest way in 3D, means on the coarsest grid corrected on "
            "finer ones among them; grey, what the truth itself may be off by for its grid."
        )
    if "depth" in {panel.quantity.name for panel in drawn}:
        said.append("Depth is relative to that of the smooth body at rest under the load.")
    return " ".join(said)


def way_look(way: Way, ways: Sequence[Way]) -> dict:
    """Of the ways of one solver on one grid each: shades, the finest grid darkest."""
    shades = style.shades(way.solver, len(ways))[::-1] if len(ways) > 1 else [style.COLOUR[way.solver]]
    k = ways.index(way)
    return {"color": shades[k], "linestyle": style.LINE[way.solver], "linewidth": style.width(0.8)}


def _headed(panel) -> str:
    """The body, and below it the motion and the quantity."""
    body, _, motion = title(panel.found).rpartition(", ")
    return f"{body}\n{motion}: {panel.quantity.name}" if body else f"{motion}\n{panel.quantity.name}"


def _smooth(axes: Axes, panel):
    judged, name = panel.found, panel.quantity.name
    own = judged.known[name].relative_error
    for climbed in judged.climbed:
        solver = climbed.ladder.rungs[0].solver.name
        errors, colour = np.maximum(climbed.errors[name], LEAST), style.COLOUR[solver]
        axes.plot(
            climbed.processor, errors, color=colour, linestyle=style.LINE[solver], linewidth=style.width(0.8)
        )
        for hollow in (False, True):
            part = (errors <= own) == hollow
            axes.plot(
                climbed.processor[part],
                errors[part],
                linestyle="none",
                marker=style.MARKER[solver],
                markersize=style.mark(0.8),
                color=colour,
                markerfacecolor=style.paper() if hollow else colour,
                zorder=3,
            )
        _guide(axes, climbed, judged.order(climbed, name))
    if own > 0:
        axes.axhspan(LEAST / 10, own, color=style.grey(0.9), zorder=0, linewidth=0)
    _say_failed(axes, [reason for climbed in judged.climbed for reason in climbed.reasons if reason is not None])


def _letters(panel) -> list[Letter]:
    """Points of the rungs, or of the first marks of the coarsest and the finest grid; the first matter most."""
    if panel.rough:
        standing = panel.found.standings[panel.quantity.name]
        ends = [way for own in (_plain(standing), standing.of("MDR")[-1:]) for way in (*own[:1], *own[:0:-1][:1])]
        draws = [(way.draws[0], float(way.error_of(1.0))) for way in ends]
        found = [(draw.label, draw.seconds, error) for draw, error in draws]
    else:
        found = [each for climbed in panel.found.climbed for each in _settings(climbed, panel.quantity.name)]
    return [Letter(text, (x, y)) for text, x, y in found if isfinite(x) and isfinite(y)]


def _settings(climbed: Climbed, name):
    """First and last first, all in one where the error stays the same."""
    solved = np.flatnonzero(np.isfinite(climbed.errors[name]) & np.isfinite(climbed.processor))
    if not solved.size:
        return []
    values = [f"{climbed.ladder.values[k]:g}" for k in solved]
    x, y = climbed.processor[solved], np.maximum(climbed.errors[name][solved], LEAST)
    if len(values) > 1 and np.ptp(np.log(y)) < np.log(CLOSE):
        return [(f"{values[0]} to {values[-1]}", x[np.argsort(x)[len(x) // 2]], y.max())]
    order = sorted(range(len(values)), key=lambda k: min(k, len(values) - 1 - k))
    return [(values[k], x[k], y[k]) for k in order]


def _guide(axes, climbed, order):
    if not (isfinite(order.order) and order.order > 0.3):
        return
    solved = np.isfinite(climbed.processor)
    axes.plot(
        climbed.processor[solved],
        np.maximum(order.at(climbed.ladder.values)[solved], LEAST),
        color=style.grey(0.3),
        linestyle=(0, (1, 1.5)),
        linewidth=style.width(0.7),
        zorder=1,
    )


def _rough(axes: Axes, panel):
    standing = panel.found.standings[panel.quantity.name]
    for own in (_plain(standing), standing.of("MDR")[-1:]):
        for way in own:
            _curve(axes, way, way_look(way, own))
    every = standing.of("BEM")
    known = [way.least_seconds for way in every if isfinite(way.least_seconds)]
    if known:
        seconds = np.geomspace(min(known), LONGEST * min(known), 200)
        axes.plot(seconds, envelope(every, seconds), **_cheapest(), zorder=2)
    _bands(axes, standing)
    reasons = [reason for sample in panel.found.samples for reason in sample.reasons]
    _say_failed(axes, reasons)


def _plain(standing: Standing) -> list[Way]:
    return [way for way in standing.of("BEM") if not way.corrected]


def _curve(axes, way: Way, look):
    """Expected error as the number of surfaces grows, written at its end with the points."""
    (draw,) = way.draws
    if not (isfinite(draw.seconds) and isfinite(way.bias.size) and isfinite(draw.scatter.value)):
        return
    counts = np.geomspace(1, LONGEST, 120)
    axes.plot(counts * draw.seconds, way.error_of(counts), **look, zorder=3)
    marks = np.array(MARKED, float)
    axes.plot(
        marks * draw.seconds,
        way.error_of(marks),
        linestyle="none",
        marker=style.MARKER[way.solver],
        markersize=style.mark(0.65),
        color=look["color"],
        zorder=4,
    )


def _cheapest():
    return {"color": style.grey(0.1), "linewidth": style.width(2), "alpha": 0.35, "linestyle": "-"}


def _bands(axes, standing: Standing):
    floor = standing.floor
    if floor is not None and isfinite(floor.most):
        axes.axhspan(
            max(floor.least, LEAST), floor.most, color=style.COLOUR["MDR"], alpha=0.13, zorder=0, linewidth=0
        )
    if standing.discretisation > 0:
        axes.axhspan(LEAST / 10, standing.discretisation, color=style.grey(0.9), zorder=0, linewidth=0)


def _say_failed(axes, reasons):
    if reasons:
        said = f"not solved: {len(reasons)}"
        axes.text(
            0.02, 0.02, said, transform=axes.transAxes, fontsize=style.tiny(), color=style.grey(0.3), va="bottom"
        )


def _share(group: Sequence[Axes], rough):
    """The same limits for all panels of a kind: errors and times are compared across regimes."""
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
    entries = [
        Line2D(
            [],
            [],
            color=style.COLOUR[solver],
            marker=style.MARKER[solver],
            linestyle=style.LINE[solver],
            markersize=style.mark(0.8),
            label=style.LABEL[solver],
        )
        for solver in ("MDR", "BEM")
    ]
    if any(panel.rough for panel in drawn):
        entries.append(Line2D([], [], **_cheapest(), label="cheapest way in 3D"))
        entries.append(Patch(color=style.COLOUR["MDR"], alpha=0.2, linewidth=0, label="error that 1D keeps, 95 %"))
    entries.append(Patch(color=style.grey(0.88), linewidth=0, label="error of the reference"))
    style.legend(drawing, entries, "outside lower center", len(entries))


def _places(drawn):
    """Rows, columns, and the place of each panel: kinds begin a row of their own, unless all fit into one."""
    counts = [count for rough in (False, True) if (count := sum(panel.rough == rough for panel in drawn))]
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
