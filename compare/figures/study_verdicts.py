"""What becomes of each claim of a study, in every series, in one dimension and in three."""

import textwrap
from math import isfinite

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from ..finding import Finding
from ..studies.judgement import JudgedStudy
from ..studies.question import BOTH
from ..studies.tableau import DIMENSIONS, claims, columns, every, rows
from . import style

NAME = "study-verdicts"
COLOUR = {"1D": style.COLOUR["MDR"], "3D": style.COLOUR["BEM"], BOTH: "black"}
MARKS = {
    "holds": {"marker": "o", "markersize": 6},
    "fails": {"marker": "x", "markersize": 6, "markeredgewidth": 1.6},
    "undecided": {"marker": "o", "markersize": 6, "markerfacecolor": "white"},
}
# Inches: width of the claims, of a cell with room for its number, height of a line of a claim, and between claims.
CLAIMS, ROOM, LINE, GAP = 2.9, 0.38, 0.115, 0.13
LETTERS = 48
# Series with room for their titles; more are called by their numbers.
FEW = 5


def figure(judged: JudgedStudy) -> Figure | None:
    """Rows: claims, those on both dimensionalities last. Columns: series. None without findings."""
    alone, both = claims(every(judged))
    if not alone and not both:
        return None
    asked, places = [*alone, *both], columns(judged)
    written = [textwrap.fill(claim, LETTERS) for claim in asked]
    room = (style.DOUBLE - CLAIMS) / (2 * len(places)) > ROOM
    height = LINE * max(2, *(text.count("\n") + 1 for text in written)) + (GAP if room else GAP / 3)
    drawing = style.canvas(style.DOUBLE, 0.9 + height * len(asked))
    axes = drawing.subplots()
    _grid(axes, len(alone), len(asked), len(places))
    for row, claim in enumerate(asked):
        for column, place in enumerate(places):
            for x, dimension in ((-0.25, "1D"), (0.25, "3D"), (0.0, BOTH)):
                found = place.find(claim, dimension)
                if found:
                    _cell(axes, column + x, row, found, room)
    axes.set_yticks(range(len(asked)), written, fontsize=6.5)
    axes.set_xticks(range(len(places)), _titles(places), fontsize=6.5)
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


def _titles(places):
    """Of the columns; those of series are numbers where they are many."""
    if len(places) <= FEW:
        return [textwrap.fill(place.title, 16) for place in places]
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
        axes.axvspan(column - 0.5, column + 0.5, color="0.95", linewidth=0, zorder=0)
    if 0 < alone < count:
        axes.axhline(alone - 0.5, color="black", linewidth=0.6)
    axes.set(xlim=(-0.5, width - 0.5), ylim=(count - 0.5, -0.5))
    axes.xaxis.tick_top()
    axes.tick_params(length=0)
    for spine in axes.spines.values():
        spine.set_visible(False)


def _cell(axes, x, row, found: Finding, room):
    colour = COLOUR[found.dimension]
    axes.plot(
        x, row - (0.12 if room else 0), linestyle="none", color=colour, clip_on=False, **MARKS[found.verdict]
    )
    if room and isfinite(found.value):
        axes.text(x, row + 0.32, f"{found.value:.2g}", ha="center", va="center", fontsize=5.5, color="0.25")


def _legend(drawing):
    handles = [
        Line2D([], [], linestyle="none", color="0.3", label=verdict, **look) for verdict, look in MARKS.items()
    ]
    handles += [
        Line2D([], [], linestyle="none", marker="s", color=COLOUR[dimension], label=dimension)
        for dimension in (*DIMENSIONS, BOTH)
    ]
    drawing.legend(handles=handles, loc="outside lower right", ncols=len(handles), handletextpad=0.2)
