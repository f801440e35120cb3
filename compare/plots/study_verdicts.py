"""Verdicts on each claim in every series, and the distance of a number from the one claimed."""

from collections.abc import Sequence
from math import isfinite

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from pandas import DataFrame

from ..finding import BOTH, FAILS, HOLDS, UNDECIDED
from ..page import Tables
from . import style
from .lettering import literal

SOLVER = {"1D": "MDR", "3D": "BEM", BOTH: "exact"}
# In the legend of verdicts: one dimension stands left in a column, three right.
SIDE = {"1D": "<", "3D": ">", BOTH: "D"}
MARKER = {"1D": "o", "3D": "s", BOTH: "D"}
# In a column of verdicts, and in a row of effects, where each dimensionality is drawn.
ACROSS = {"1D": -0.25, "3D": 0.25, BOTH: 0.0}
ABOVE = {"1D": -0.17, "3D": 0.17, BOTH: 0.0}
# Of the width, for the claims; of a cell with room for its number [inch], and for text of 8 points the height of a
# line of a claim, between claims, and of a row of effects [inch].
CLAIMS, ROOM, LINE, GAP, ROW = 0.38, 0.38, 0.125, 0.14, 0.4
# Series with room for their titles; more are called by their numbers.
FEW = 5
# In tolerances, where the axis of effects ends; what lies beyond is an arrow there.
END = 100.0


def verdicts(tables: Tables, titles: Sequence[tuple[str, str]] = ()) -> Figure:
    """Rows: claims, those on both dimensionalities last. Columns: series.

    titles : name and title of each column
    """
    found = tables["verdicts"]
    places = dict(titles) or {name: name for name in dict.fromkeys(found["where"])}
    page = style.across("double")
    alone, claims = _claims(found)
    written = [style.fill(claim, CLAIMS * page, style.small()) for claim in claims]
    cell = (1 - CLAIMS) * page / len(places)
    room = cell > 2 * ROOM
    height = LINE * max(2, *(text.count("\n") + 1 for text in written)) + (GAP if room else GAP / 3)
    drawing = style.canvas("double", 0.9 + height * len(claims))
    axes = drawing.subplots()
    for column in range(0, len(places), 2):
        axes.axvspan(column - 0.5, column + 0.5, color=style.grey(0.95), linewidth=0, zorder=0)
    if 0 < alone < len(claims):
        axes.axhline(alone - 0.5, color=style.ink(), linewidth=style.width(0.55))
    axes.set(xlim=(-0.5, len(places) - 0.5), ylim=(len(claims) - 0.5, -0.5))
    axes.xaxis.tick_top()
    axes.tick_params(length=0)
    for spine in axes.spines.values():
        spine.set_visible(False)
    columns, rows = list(places), list(claims)
    for each in found.to_dict("records"):
        x = columns.index(each["where"]) + ACROSS[each["dimension"]]
        _cell(axes, x, rows.index(each["sentence"]), each, room)
    axes.set_yticks(range(len(claims)), written, fontsize=style.small())
    heads = [style.fill(literal(title), 0.9 * cell, style.small()) for title in places.values()]
    if len(places) > FEW:
        heads = [str(number) for number in range(1, len(places) + 1)]
    axes.set_xticks(range(len(places)), heads, fontsize=style.small())
    looks = {verdict: {"color": style.grey(0.3), **look} for verdict, look in _marks().items()}
    looks |= {name: {"marker": SIDE[name], "color": style.COLOUR[solver]} for name, solver in SOLVER.items()}
    handles = [Line2D([], [], linestyle="none", label=name, **look) for name, look in looks.items()]
    style.legend(drawing, handles, "outside lower right", len(handles), handletextpad=0.2)
    return drawing


def _claims(found: DataFrame) -> tuple[int, list[str]]:
    """Number of claims on one dimensionality alone, and all claims, these first."""
    both = found["dimension"] == BOTH
    alone = list(dict.fromkeys(found.loc[~both, "sentence"]))
    return len(alone), [*alone, *dict.fromkeys(found.loc[both, "sentence"])]


def _cell(axes, x, row, found, room):
    colour = style.COLOUR[SOLVER[found["dimension"]]]
    mark = _marks()[found["verdict"]]
    axes.plot(x, row - (0.12 if room else 0), linestyle="none", color=colour, clip_on=False, **mark)
    if room and isfinite(found["value"]):
        small = {"ha": "center", "va": "center", "fontsize": style.tiny(), "color": style.grey(0.25)}
        axes.text(x, row + 0.32, f"{found['value']:.2g}", **small)


def _marks():
    """Marker of each verdict."""
    return {
        HOLDS: {"marker": "o", "markersize": style.mark(1.5)},
        FAILS: {"marker": "x", "markersize": style.mark(1.5), "markeredgewidth": style.width(1.5)},
        UNDECIDED: {"marker": "o", "markersize": style.mark(1.5), "markerfacecolor": style.paper()},
    }


def effects(tables: Tables) -> Figure:
    """A row for each claim: measured less claimed in tolerances, with both errors, and the verdict at right."""
    found = tables["effects"]
    alone, claims = _claims(found)
    drawing = style.canvas("double", 0.9 + ROW * len(claims))
    axes = drawing.subplots()
    axes.axvspan(-1, 1, color=style.grey(0.9), linewidth=0, zorder=0)
    axes.axvline(0, **style.line(0.45, 0.8, zorder=1))
    if 0 < alone < len(claims):
        axes.axhline(alone - 0.5, color=style.ink(), linewidth=style.width(0.45))
    for each in found.to_dict("records"):
        _effect(axes, claims.index(each["sentence"]) + ABOVE[each["dimension"]], each)
    axes.set_xscale("symlog", linthresh=1, linscale=0.7)
    axes.set(xlim=(-END, END), ylim=(len(claims) - 0.5, -0.5), xlabel="measured less claimed, in tolerances [1]")
    ticks = [sign * 10**power for power in (2, 1, 0) for sign in (-1, 1)]
    axes.set_xticks([0, *ticks], [f"{tick:g}" for tick in (0, *ticks)])
    axes.set_xticks([], minor=True)
    texts = [style.fill(claim, CLAIMS * drawing.get_figwidth(), style.small()) for claim in claims]
    axes.set_yticks(range(len(claims)), texts, fontsize=style.small())
    axes.tick_params(axis="y", length=0)
    for dimension in SOLVER:
        if (found["dimension"] == dimension).any():
            axes.plot([], [], label=dimension, **_look(dimension))
    style.legend(drawing, axes.get_legend_handles_labels()[0], "outside upper right", 3, handletextpad=0.2)
    return drawing


def _look(dimension):
    return {"color": style.COLOUR[SOLVER[dimension]], "marker": MARKER[dimension], "linestyle": "none"}


def _effect(axes, y, found):
    look = _look(found["dimension"])

    def tolerances(value):
        return (value - found["expected"]) / found["tolerance"]

    for names, width in ((("low", "high"), 0.65), (("scatter_low", "scatter_high"), 2.0)):
        ends = [tolerances(found[name]) for name in names]
        if all(map(isfinite, ends)):
            line = {"color": look["color"], "linewidth": style.width(width), "zorder": 2}
            axes.plot(np.clip(ends, -END, END), [y, y], **line)
    inside, effect = style.paper() if found["verdict"] == UNDECIDED else look["color"], tolerances(found["value"])
    if abs(effect) <= END:
        axes.plot(effect, y, markersize=style.mark(), markerfacecolor=inside, zorder=3, **look)
    elif isfinite(effect):
        arrow = look | {"marker": ">" if effect > 0 else "<", "markersize": style.mark(1.25), "clip_on": False}
        axes.plot(np.sign(effect) * END, y, markerfacecolor=inside, zorder=3, **arrow)
    said = {"va": "center", "fontsize": style.tiny(), "color": look["color"]}
    axes.annotate(found["verdict"], (1.02, y), xycoords=("axes fraction", "data"), **said)
