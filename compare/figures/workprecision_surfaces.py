"""Expected error of a mean over surfaces, of its scatter and of its grid together, against their number."""

from collections.abc import Sequence
from math import ceil, isfinite

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from ..workprecision.answers import LEVELS, title
from ..workprecision.ensemble import JudgedEnsemble, Standing
from ..workprecision.records import ways
from ..workprecision.statistics import Reached, Way, cheapest
from ..workprecision.surfaces import plain
from ..workprecision.wording import seconds, share
from ..plots import style
from ..plots.lettering import Letter, letter, write
from .workprecision_models import way_look

NAME = "workprecision-surfaces"
COLUMNS, HEIGHT, AROUND = 3, 2.2, 0.55
# Surfaces that curves are drawn to at least.
MOST = 1e4
# Grids that leave errors less than this factor apart are labelled together; errors are drawn from here on.
APART, LEAST = 1.5, 1e-5
TAKEN = {False: "*", True: "D"}


def figure(found: Sequence[JudgedEnsemble]) -> Figure | None:
    """A panel a regime and quantity, and one legend below. None without any."""
    drawn = _panels(found)
    if not drawn:
        return None
    columns = min(COLUMNS, len(drawn))
    rows = ceil(len(drawn) / columns)
    drawing = style.canvas("double" if columns > 1 else "single", rows * HEIGHT + AROUND)
    panels = drawing.subplots(rows, columns, sharex=True, sharey=True, squeeze=False)
    for k, (axes, (each, standing)) in enumerate(zip(panels.flat, drawn, strict=False)):
        style.head(axes, f"({letter(k)}) {title(each)}\n{standing.quantity.label}", columns)
        axes.set(xscale="log", yscale="log")
        _panel(axes, standing)
        if k % columns == 0:
            axes.set_ylabel("expected relative error [1]")
        if k + columns >= len(drawn):
            axes.set_xlabel("surfaces [1]")
            axes.tick_params(labelbottom=True)
    for axes in list(panels.flat)[len(drawn) :]:
        axes.remove()
    _limits(panels[0, 0], [standing for _, standing in drawn])
    _legend(drawing, drawn)
    drawing.draw_without_rendering()
    for axes, (_, standing) in zip(panels.flat, drawn, strict=False):
        taken = _taken(standing)
        write(
            axes,
            [Letter(seconds(way.seconds), (way.counts[0], level)) for level, way in taken.items()],
            style.tiny(),
        )
    return drawing


def sheets(found: Sequence[JudgedEnsemble]) -> dict[str, list[dict]]:
    """Both parts of the error of every way, and what wanted errors take on each."""
    parts = [row for each in found for row in ways(each)]
    recipes = [row for each, standing in _panels(found) for row in _recipes(each, standing)]
    return {name: rows for name, rows in ((NAME, parts), (f"{NAME}-recipes", recipes)) if rows}


def caption(found: Sequence[JudgedEnsemble]) -> str:
    """What the figure shows."""
    wanted = ", ".join(share(level) for level in LEVELS)
    return (
        "Expected error of a mean over rough surfaces in 3D against their number, on grids of as many points as "
        "are written at what each leaves however many surfaces are solved (level lines); falling dotted line, "
        f"what the scatter leaves. Markers, the cheapest way to {wanted}, with its processor time: a star where "
        "it is a mean on one grid, a diamond where it is a mean on the coarsest grid, of as many surfaces as the "
        "diamond says, corrected by fewer on two grids. Grey, what the truth itself may be off by for its grid; "
        "its scatter does not count, as grids are compared on the same surfaces. Depth is relative to that of the "
        "smooth body at rest under the load."
    )


def _panels(found):
    return [(each, each.standings[quantity.name]) for each in found for quantity in each.ensemble.quantities]


def _panel(axes: Axes, standing: Standing):
    own = plain(standing)
    most = max([MOST, *(reached.counts[0] for reached in _taken(standing).values())]) * 2
    counts = np.geomspace(1, most, 160)
    known = [way for way in own if np.isfinite(way.error_of(counts)).all()]
    for way in known:
        look = way_look(way, own)
        axes.plot(counts, way.error_of(counts), **look)
        axes.axhline(
            way.bias.size, color=look["color"], linewidth=style.width(0.55), linestyle=(0, (1, 3)), zorder=1
        )
    _label(axes, known)
    scatter = own[0].draws[0].scatter.value
    if isfinite(scatter):
        axes.plot(counts, scatter / np.sqrt(counts), **_scatter(), zorder=1)
    if isfinite(standing.discretisation) and standing.discretisation > 0:
        axes.axhspan(LEAST / 10, standing.discretisation, color=style.grey(0.9), zorder=0, linewidth=0)
    for level, reached in _taken(standing).items():
        axes.plot(
            reached.counts[0],
            level,
            marker=TAKEN[reached.way.corrected],
            markersize=style.mark(0.9) if reached.way.corrected else 6,
            color=style.ink(),
            linestyle="none",
            zorder=5,
        )


def _scatter():
    return {"color": style.grey(0.45), "linewidth": style.width(0.8), "linestyle": ":"}


def _taken(standing) -> dict[float, Reached]:
    """The cheapest way to each wanted error that is reached."""
    ways = standing.of("BEM")
    return {level: reached for level in LEVELS if (reached := cheapest(ways, level)) is not None}


def _label(axes, known: Sequence[Way]):
    """Points beside what their grids leave, together where these lie close."""
    together: list[list[Way]] = []
    for way in sorted(known, key=lambda way: way.bias.size):
        if together and way.bias.size < APART * together[-1][0].bias.size:
            together[-1].append(way)
        else:
            together.append([way])
    for close in together:
        points = sorted(way.draws[0].points[0] for way in close)
        axes.annotate(
            ", ".join(map(str, points)),
            (1.0, close[0].bias.size),
            xycoords=axes.get_yaxis_transform(),
            xytext=(2, 0),
            textcoords="offset points",
            fontsize=style.tiny(),
            va="center",
        )


def _recipes(found: JudgedEnsemble, standing: Standing):
    """A row for each wanted error and way: surfaces of each draw, and the time."""
    for level in LEVELS:
        best = cheapest(standing.of("BEM"), level)
        for way in standing.of("BEM"):
            reached = way.reaching(level)
            yield {
                "regime": found.ensemble.name,
                "quantity": standing.quantity.name,
                "wanted": level,
                "way": way.label,
                "surfaces": "" if reached is None else " + ".join(str(count) for count in reached.counts),
                "seconds": np.nan if reached is None else reached.seconds,
                "cheapest": best is not None and best.way is way,
                "grid_error": way.bias.size,
                "scatter": way.draws[0].scatter.value,
            }


def _limits(axes, standings):
    """Around what all grids leave and what one surface scatters by."""
    ways = [way for standing in standings for way in plain(standing)]
    sizes = [value for way in ways for value in (way.bias.size, way.draws[0].scatter.value) if value > 0]
    if sizes:
        axes.set_ylim(max(min(sizes) / 2, LEAST), 2 * max(sizes))
    style.decades(axes)


def _legend(drawing, drawn):
    own = plain(drawn[0][1])
    entries = [
        Line2D([], [], **way_look(own[-1], own), label=f"3D, error of a mean on {own[-1].label} points"),
        Line2D([], [], **_scatter(), label="of scatter alone"),
        Line2D(
            [],
            [],
            color=style.ink(),
            marker=TAKEN[False],
            linestyle="none",
            markersize=style.mark(1.5),
            label="cheapest: one grid",
        ),
        Line2D(
            [],
            [],
            color=style.ink(),
            marker=TAKEN[True],
            linestyle="none",
            markersize=style.mark(0.9),
            label="cheapest: corrected",
        ),
        Patch(color=style.grey(0.88), linewidth=0, label="error of the reference"),
    ]
    style.legend(drawing, entries, "outside lower center", 3)
