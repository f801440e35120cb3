"""Distance of each number from the one claimed, with its verdict."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import isfinite

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from pandas import DataFrame

from ....report.page import Tables
from ....report.plots import style
from ....report.plots.lettering import literal
from ....statistics import digits
from ....statistics.finding import BOTH, FAILS, HOLDS, UNDECIDED

SOLVER = {"1D": "MDR", "3D": "BEM", BOTH: "exact"}
# Share of the width for the words of the claims, and, for text of 8 points, heights of a row, of a line of a claim
# and between claims [inch].
CLAIMS, ROW, LINE, GAP = 0.34, 0.27, 0.125, 0.07
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


def _ruled(axes: Axes, claims: Sequence[_Claim]) -> None:
    """Texts of the claims at left, and lines between them, a thick one before those that compare both."""
    axes.tick_params(length=0)
    axes.set_yticks([each.top + each.height / 2 for each in claims], [each.text for each in claims])
    axes.tick_params(axis="y", labelsize=style.small())
    for before, each in pairwise(claims):
        compared = BOTH in each.rows and BOTH not in before.rows
        axes.axhline(each.top, **(style.line(0, 0.55) if compared else style.line(0.8, 0.3)), zorder=0)


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
    colour = style.COLOUR[SOLVER.get(found["dimension"], str(found["dimension"]))]

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
