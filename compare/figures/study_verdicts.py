"""What becomes of each claim of a study, in every series, in one dimension and in three."""

from math import isfinite

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from ..finding import Finding
from ..studies.judgement import JudgedStudy
from ..studies.question import BOTH
from ..studies.tableau import DIMENSIONS, claims, columns, every, rows
from ..plots import style

NAME = "study-verdicts"
SOLVER = {"1D": "MDR", "3D": "BEM", BOTH: "exact"}
# In the legend: one dimension stands left in a column, three right.
SIDE = {"1D": "<", "3D": ">", BOTH: "D"}
# Of the width, for the claims; of a cell with room for its number [inch], and for text of 8 points the height of a
# line of a claim, and between claims [inch].
CLAIMS, ROOM, LINE, GAP = 0.38, 0.38, 0.125, 0.14
# Series with room for their titles; more are called by their numbers.
FEW = 5


def figure(judged: JudgedStudy) -> Figure | None:
    """Rows: claims, those on both dimensionalities last. Columns: series. None without findings."""
    alone, both = claims(every(judged))
    if not alone and not both:
        return None
    asked, places, page = [*alone, *both], columns(judged), style.across("double")
    written = [style.fill(claim, CLAIMS * page, style.small()) for claim in asked]
    cell = (1 - CLAIMS) * page / len(places)
    room = cell > 2 * ROOM
    height = LINE * max(2, *(text.count("\n") + 1 for text in written)) + (GAP if room else GAP / 3)
    drawing = style.canvas("double", 0.9 + height * len(asked))
    axes = drawing.subplots()
    _grid(axes, len(alone), len(asked), len(places))
    for row, claim in enumerate(asked):
        for column, place in enumerate(places):
            for x, dimension in ((-0.25, "1D"), (0.25, "3D"), (0.0, BOTH)):
                found = place.find(claim, dimension)
                if found:
                    _cell(axes, column + x, row, found, room)
    axes.set_yticks(range(len(asked)), written, fontsize=style.small())
    axes.set_xticks(range(len(places)), _titles(places, 0.9 * cell), fontsize=style.small())
    _legend(drawing)
    return drawing


def sheets(judged: JudgedStudy) -> dict[str, list[dict]]:
    """Every finding."""
    found = list(rows(judged))
    return {NAME: found} if found else {}


def caption(judged: JudgedStudy) -> str:
    """What the figure shows."""
    return (
        "Verdicts: rows are claims, columns are series, each with one dimension left (blue) and three right "
        "(vermillion); below, claims that compare both (black). Filled: the claim holds; cross: it fails; "
        f"hollow: undecided; empty: not asked. Numbers in cells are what was measured.{_listed(columns(judged))}"
    )


def _titles(places, inches):
    """Of the columns; those of series are numbers where they are many."""
    if len(places) <= FEW:
        return [style.fill(place.title, inches, style.small()) for place in places]
    return [str(number) if place.name else "all" for number, place in enumerate(places, 1)]


def _listed(places):
    """Which series the numbers are."""
    if len(places) <= FEW:
        return ""
    return (
        " " + "; ".join(f"{number}: {place.title}" for number, place in enumerate(places, 1) if place.name) + "."
    )


def _grid(axes: Axes, alone, count, width):
    """Bands of the series, and a line between both kinds of claims."""
    for column in range(0, width, 2):
        axes.axvspan(column - 0.5, column + 0.5, color=style.grey(0.95), linewidth=0, zorder=0)
    if 0 < alone < count:
        axes.axhline(alone - 0.5, color=style.ink(), linewidth=style.width(0.55))
    axes.set(xlim=(-0.5, width - 0.5), ylim=(count - 0.5, -0.5))
    axes.xaxis.tick_top()
    axes.tick_params(length=0)
    for spine in axes.spines.values():
        spine.set_visible(False)


def _cell(axes, x, row, found: Finding, room):
    colour = style.COLOUR[SOLVER[found.dimension]]
    axes.plot(
        x, row - (0.12 if room else 0), linestyle="none", color=colour, clip_on=False, **_marks()[found.verdict]
    )
    if room and isfinite(found.value):
        axes.text(
            x,
            row + 0.32,
            f"{found.value:.2g}",
            ha="center",
            va="center",
            fontsize=style.tiny(),
            color=style.grey(0.25),
        )


def _marks():
    """Of each verdict."""
    return {
        "holds": {"marker": "o", "markersize": style.mark(1.5)},
        "fails": {"marker": "x", "markersize": style.mark(1.5), "markeredgewidth": style.width(1.5)},
        "undecided": {"marker": "o", "markersize": style.mark(1.5), "markerfacecolor": style.paper()},
    }


def _legend(drawing):
    handles = [
        Line2D([], [], linestyle="none", color=style.grey(0.3), label=verdict, **look)
        for verdict, look in _marks().items()
    ]
    handles += [
        Line2D(
            [],
            [],
            linestyle="none",
            marker=SIDE[dimension],
            color=style.COLOUR[SOLVER[dimension]],
            label=dimension,
        )
        for dimension in (*DIMENSIONS, BOTH)
    ]
    style.legend(drawing, handles, "outside lower right", len(handles), handletextpad=0.2)
