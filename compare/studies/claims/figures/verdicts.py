"""Verdicts on each claim in every series, and the distance of a number from the one claimed."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import isfinite
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Rectangle
from pandas import DataFrame

from ....report.page import Tables
from ....report.plots import style
from ....report.plots.lettering import literal
from ....statistics import digits
from ....statistics.finding import BOTH, FAILS, HOLDS, UNDECIDED

SOLVER = {"1D": "MDR", "3D": "BEM", BOTH: "exact"}
# Share of the width for claims. For text of 8 points: heights of a row, of a line of a claim and between claims,
# width of the column of dimensionalities, and lengths of headings that stand upright, of which the first that lets
# all of them fit is taken [inch].
CLAIMS, ROW, LINE, GAP, DIMENSION = 0.34, 0.27, 0.125, 0.07, 0.42
UPRIGHT = 0.8, 1.1, 1.4, 1.8, 2.3
# A column as wide has room for a heading that lies [inch].
WIDE = 0.75
# Shades of the distance from the claimed number: up to so many tolerances, and grey between ink (0) and paper (1).
SHADES = {1.0: 0.97, 3.0: 0.85, 10.0: 0.72, np.inf: 0.58}
# Stands for the tolerance of a claim that has none: what is off is beyond the axis.
EXACTLY = 1e-12
# In tolerances, where the axis of effects ends; what lies beyond is an arrow there.
END = 100.0


@dataclass(frozen=True)
class _Claim:
    """A claim, with a row for each dimensionality that it is judged in.

    text : in lines; rows : findings by dimension; top, height : of its place from above [inch]
    """

    text: str
    rows: dict[str, DataFrame]
    top: float
    height: float

    def place(self, dimension: str) -> float:
        """Middle of a row, from above [inch]."""
        return self.top + self.height * (list(self.rows).index(dimension) + 0.5) / len(self.rows)


def _claims(found: DataFrame, inches: float) -> list[_Claim]:
    """Claims on one dimensionality alone, then those on both, one below the other; inches : width of a claim."""
    both = found["dimension"] == BOTH
    claims, top, times = [], 0.0, style.small() / (style.SMALL * style.TEXT)
    for sentence, own in (each for part in (found[~both], found[both]) for each in _by(part, "sentence")):
        text = style.fill(f"{literal(sentence)}\n{_claimed(own)}", inches, style.small())
        rows = dict(_by(own, "dimension"))
        height = times * (max(ROW * len(rows), LINE * (text.count("\n") + 1)) + GAP)
        claims.append(_Claim(text, rows, top, height))
        top += height
    return claims


def _by(found: DataFrame, name: str):
    return list(found.groupby(name, sort=False))


def _claimed(own: DataFrame) -> str:
    """Number claimed with its tolerance, in words; the range of both where they differ from place to place."""
    said = []
    for name in ("expected", "tolerance"):
        ends = dict.fromkeys(digits.number(own[name].agg(end), 3) for end in ("min", "max"))
        said.append(" to ".join(ends))
    return f"claimed: {said[0]}" + (f" ± {said[1]}" if own["tolerance"].any() else "")


def verdicts(tables: Tables, titles: Sequence[tuple[str, str]] = ()) -> Figure:
    """Rows: claims by dimensionality, those that compare both last. Columns: series.

    titles : name and title of each column
    """
    found = tables["verdicts"]
    places = dict(titles) or {name: name for name in dict.fromkeys(found["where"])}
    claims = _claims(found, CLAIMS * style.across("double"))
    times = style.small() / (style.SMALL * style.TEXT)
    cell = ((1 - CLAIMS) * style.across("double") - (DIMENSION + 0.15) * times) / len(places)
    lying = cell >= WIDE * times
    lengths = [0.84 * cell] if lying else [inches * times for inches in UPRIGHT]
    for length in lengths:
        heads = [style.fill(literal(title), length, style.small()) for title in places.values()]
        lines = max(head.count("\n") + 1 for head in heads)
        if lines * LINE * times <= cell:
            break
    bottom = claims[-1].top + claims[-1].height
    above = LINE * lines if lying else length / times
    drawing = style.canvas("double", bottom / times + above + 0.5)
    axes = drawing.subplots()
    axes.set(xlim=(-DIMENSION * times / cell - 0.5, len(places) - 0.5), ylim=(bottom, 0))
    _numbers(axes, list(places), claims, cell)
    _ruled(axes, claims)
    axes.xaxis.tick_top()
    for spine in axes.spines.values():
        spine.set_visible(False)
    upright: dict[str, Any] = {} if lying else {"rotation": 90, "va": "bottom", "ha": "center"}
    axes.set_xticks(range(len(places)), heads, fontsize=style.small(), **upright)
    looks = {name: {"color": style.grey(0.3), **look} for name, look in _marks().items()}
    handles: list = [Line2D([], [], linestyle="none", label=name, **look) for name, look in looks.items()]
    ends = ("within the tolerance", "to 3 tolerances off", "to 10", "farther")
    handles += [
        Patch(facecolor=style.grey(level), edgecolor=style.grey(0.5), linewidth=style.width(0.4), label=end)
        for level, end in zip(SHADES.values(), ends, strict=True)
    ]
    style.legend(drawing, handles, "outside lower right", len(handles), handletextpad=0.4, handlelength=1.2)
    return drawing


def _ruled(axes: Axes, claims: Sequence[_Claim]) -> None:
    """Texts of the claims at left, and lines between them, a thick one before those that compare both."""
    axes.tick_params(length=0)
    axes.set_yticks([each.top + each.height / 2 for each in claims], [each.text for each in claims])
    axes.tick_params(axis="y", labelsize=style.small())
    for before, each in pairwise(claims):
        compared = BOTH in each.rows and BOTH not in before.rows
        axes.axhline(each.top, **(style.line(0, 0.55) if compared else style.line(0.8, 0.3)), zorder=0)


def _numbers(axes, columns, claims, cell):
    """A field for each finding: shade, mark of the verdict, and the number."""
    small = {"ha": "center", "va": "center", "fontsize": style.tiny(), "color": style.ink()}
    for claim in claims:
        high = claim.height / len(claim.rows)
        for dimension, rows in claim.rows.items():
            y, colour = claim.place(dimension), style.COLOUR[SOLVER[dimension]]
            axes.text(-0.55, y, dimension, ha="right", va="center", fontsize=style.small(), color=colour)
            for each in rows.to_dict("records"):
                x = columns.index(each["where"])
                field = {"facecolor": style.grey(_shade(each)), "linewidth": 0, "zorder": 0.5}
                axes.add_patch(Rectangle((x - 0.48, y - 0.47 * high), 0.96, 0.94 * high, **field))
                (aside, up), text, (right, down) = _written(each, cell)
                mark = _marks()[each["verdict"]]
                axes.plot(x + aside, y - up * high, linestyle="none", color=colour, **mark)
                axes.text(x + right, y + down * high, text, **small)


def _written(each, cell: float) -> tuple[tuple[float, float], str, tuple[float, float]]:
    """Place of the mark, text, and its place, all of the field: the number with its interval where it has room."""
    value = each["value"]
    if not isfinite(value):
        return (0.0, 0.0), "", (0.0, 0.0)
    whole = digits.interval(value, each["low"], each["high"], 2).replace(" (", "\n(", 1)
    texts = {
        whole: ((-0.39, 0.0), (0.08, 0.0), 0.76),
        digits.number(value, 2): ((0.0, 0.22), (0.0, 0.2), 0.96),
        digits.number(value, 1): ((0.0, 0.22), (0.0, 0.2), 0.96),
    }
    for text, (mark, place, share) in texts.items():
        if max(style.text_width(line, style.tiny()) for line in text.split("\n")) <= share * cell:
            return mark, text, place
    return (0.0, 0.0), "", (0.0, 0.0)


def _shade(each) -> float:
    """Grey of a finding by its distance from the claimed number; paper where none is known."""
    off = abs(_tolerances(each["value"], each))
    return next((level for end, level in SHADES.items() if off <= end), 1.0)


def _tolerances(value, found) -> float:
    """Distance of a number from the one claimed, in tolerances; beyond all bounds of a claim without any."""
    return (value - found["expected"]) / (found["tolerance"] or EXACTLY)


def _marks():
    """Marker of each verdict."""
    return {
        HOLDS: {"marker": "o", "markersize": style.mark(1.2)},
        FAILS: {"marker": "x", "markersize": style.mark(1.2), "markeredgewidth": style.width(1.3)},
        UNDECIDED: {"marker": "o", "markersize": style.mark(1.2), "markerfacecolor": style.paper()},
    }


def effects(tables: Tables) -> Figure:
    """A row for each claim and dimensionality: distance from the number claimed; at right, verdict and number."""
    found = tables["effects"]
    claims = _claims(found, CLAIMS * style.across("double"))
    bottom = claims[-1].top + claims[-1].height
    drawing = style.canvas("double", bottom * style.TEXT * style.SMALL / style.small() + 0.75)
    axes = drawing.subplots()
    axes.axvspan(-1, 1, color=style.grey(0.9), linewidth=0, zorder=0)
    axes.axvline(0, **style.line(0.45, 0.8, zorder=1))
    axes.set_xscale("symlog", linthresh=1, linscale=0.7)
    axes.set(xlim=(-END, END), ylim=(bottom, 0), xlabel="measured less claimed, in tolerances [1]")
    ticks = [sign * 10**power for power in (2, 1, 0) for sign in (-1, 1)]
    axes.set_xticks([0, *ticks], [digits.number(tick) for tick in (0, *ticks)])
    axes.set_xticks([], minor=True)
    _ruled(axes, claims)
    for claim in claims:
        for dimension, rows in claim.rows.items():
            for each in rows.to_dict("records"):
                _effect(axes, claim.place(dimension), each)
    return drawing


def _effect(axes, y, found):
    colour = style.COLOUR[SOLVER[found["dimension"]]]

    for names, width in ((("low", "high"), 0.65), (("scatter_low", "scatter_high"), 2.0)):
        ends = [_tolerances(found[name], found) for name in names]
        if all(map(isfinite, ends)):
            axes.plot(np.clip(ends, -END, END), [y, y], color=colour, linewidth=style.width(width), zorder=2)
    effect, look = _tolerances(found["value"], found), {"linestyle": "none", "color": colour, "zorder": 3}
    if abs(effect) <= END:
        axes.plot(effect, y, **look | _marks()[found["verdict"]])
    elif isfinite(effect):
        arrow = {"marker": ">" if effect > 0 else "<", "markersize": style.mark(1.25), "clip_on": False}
        axes.plot(np.sign(effect) * END, y, **look | arrow)
    measured = digits.interval(found["value"], found["low"], found["high"], 2)
    told = f"{found['dimension']} {found['verdict']}:\n{measured if isfinite(found['value']) else 'not known'}"
    said = {"va": "center", "fontsize": style.tiny(), "color": colour, "linespacing": 1.1}
    axes.annotate(told, (1.03, y), xycoords=("axes fraction", "data"), **said)
