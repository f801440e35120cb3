"""Friction against load at many speeds, the curves shifted onto one, how far they are from it, and the shifts.

Paper, Figs. 5 to 7.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from math import nan
from typing import Any, TypeAlias

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.polynomial import Chebyshev
from pandas import DataFrame, concat

from ..solving.words import interval, number
from ..statistics import eq23
from ..statistics.collapse import Alignment, Collapse
from ..statistics.finding import FAILS, Claim, Finding
from ..statistics.intervals import ENDS
from . import shades, style
from .curves import curves, intervals
from .plot import Plot, Tables
from .shades import CURVES, few

NAME = "collapse"
_, SHIFTS, FITS = ENDINGS = "", "-shifts", "-fits"
LOG10 = np.log(10)
# Degree of the one curve through those that no shift brings together: it only says where their middle is.
APART = 2
# Significant digits of a number without an interval, as in the answer.
FIGURES = 3
FITTED, BOTH, UNSHIFTED = "fitted", "both", "none"
# What is done to the curves, in the words of a title.
SHIFTED = {
    FITTED: "shifted along the force",
    BOTH: "shifted along force and friction",
    UNSHIFTED: "no shift brings them onto one",
}


Look: TypeAlias = Callable[[float], dict[str, Any]]  # of the curve at a speed


@dataclass(frozen=True)
class ShiftedCurves:
    """A row of the figure.

    title : what the curves are
    collapse : what shifts make of them
    findings : on the collapse, by the claims of `eq23`: those on misfits and exponents, which the figure names
    expected : exponent of the shifts as a power of the speed that is expected; NaN if none is
    lead : alignment of the collapse that is the answer; that along the load if None
    predicted : ln p(v) of each curve that is expected, where that is no power of the speed
    """

    title: str
    collapse: Collapse
    findings: Mapping[str, Finding]
    expected: float = nan
    lead: Alignment | None = None
    predicted: np.ndarray | None = None

    def found(self, name: str, *claims: Claim) -> dict[str, float]:
        """Number and interval of the first of some claims on which there is a finding, as columns; NaN without."""
        own = [self.findings[each.id] for each in claims if each.id in self.findings]
        numbers = (own[0].value, *own[0].interval) if own else 3 * (nan,)
        return {f"{name}{end}": number for end, number in zip(ENDS, numbers, strict=True)}


def plot(rows: Sequence[ShiftedCurves], name: str = NAME, folder: str = "", speed: str = "speed") -> Plot | None:
    """The plot of some sets of curves; None without any. speed : label of what tells curves apart"""
    if not rows:
        return None
    every = zip(*map(_tables, rows), strict=True)
    tables = {
        f"{name}{ending}": concat(parts, ignore_index=True) for ending, parts in zip(ENDINGS, every, strict=True)
    }
    caption = (
        f"Friction against normal force at up to {CURVES} speeds; shifted along the force (Eq. 23), and along "
        "friction where that is shifted too (squares), with the one curve nearest to all (grey) and the "
        "deviations from it; the shifts. Bars: 95 %. Hollow shifts leave curves apart; curves that no shift "
        "brings together are drawn unshifted."
    )
    text = "; ".join(f"{fit.curves}: {_missed(fit)} off one curve" for fit in tables[f"{name}{FITS}"].itertuples())
    return Plot(f"{folder}{name}", figure, tables, caption, text, {"name": name, "speed": speed})


def _tables(row: ShiftedCurves) -> tuple[DataFrame, DataFrame, DataFrame]:
    """Points, shifts, and the misfit and exponents of a row of the figure."""
    found, lead = row.collapse, row.lead or row.collapse.horizontal
    both, middle = lead is found.both, found.speeds.size // 2
    how = BOTH if both else UNSHIFTED if lead.reason else FITTED
    missed = {BOTH: eq23.BOTH, UNSHIFTED: eq23.UNSHIFTED, FITTED: eq23.COLLAPSE}[how]
    along = 0 * found.speeds if how == UNSHIFTED else lead.horizontal.value
    points = found.points(along, lead.vertical.value if both else 0 * along)
    load = np.log(points["shifted_force"].to_numpy())
    curve = lead.curve or Chebyshev.fit(load, np.log(points["shifted_friction"].to_numpy()), APART)
    for end in ENDS:
        points[f"deviation{end}"] = points[f"shifted_friction{end}"] / np.exp(curve(load)) - 1
    known = row.expected * np.log(found.speeds) if row.predicted is None else row.predicted
    decided = both or not (found.horizontal.reason or row.findings[eq23.COLLAPSE.id].verdict == FAILS)
    fit: dict[str, Any] = row.found("misfit", missed)
    fit |= row.found("load_exponent", *(eq23.EXPONENT, eq23.JOINT if both else eq23.ALONE)[: 2 * decided])
    fit |= row.found("friction_exponent", *(eq23.NOT_SHIFTED,)[:both]) | {"expected": row.expected}
    fit |= {"shifted_as": how, "decided": decided}
    frames = points, found.shifts(lead).assign(expected=known - known[middle]), DataFrame([fit])
    for frame in frames:
        frame.insert(0, "curves", row.title)
    return frames


def figure(tables: Tables, name: str = NAME, speed: str = "speed") -> Figure:
    """A row for each set of curves: as they are, shifted, and the shifts. speed : what tells them apart"""
    speeds = few(tables[f"{name}{SHIFTS}"]["speed"], CURVES)
    points, shifts = (each[each["speed"].isin(speeds)] for each in (tables[name], tables[f"{name}{SHIFTS}"]))
    fits, scale = tables[f"{name}{FITS}"], shades.between(speeds)
    drawing = style.canvas("double", 0.6 + 2.6 * len(fits))

    def look(at):
        return {"color": shades.SPEED(scale(at))}

    for rows, fit in zip(drawing.subfigures(len(fits), 1, squeeze=False).flat, fits.itertuples(), strict=True):
        own, moved = (each[each["curves"] == fit.curves] for each in (points, shifts))
        last = ["shifts", "shifts"] if moved["log_shift"].notna().any() else ["above", "below"]
        shape = [["left", first, second] for first, second in zip(("above", "below"), last, strict=True)]
        panels = rows.subplot_mosaic(shape, height_ratios=(3, 1))
        _collapse(panels["left"], panels["above"], panels["below"], fit, own, look)
        if "shifts" in panels:
            _shifts(panels["shifts"], fit, moved, look)
            panels["shifts"].set_xlabel(f"{speed} [m/s]")
    style.decades(*drawing.axes)
    style.lettered(drawing.axes)
    style.legend(drawing, (), CURVES, *shades.key(shades.SPEED, speeds, "m/s"))
    return drawing


def _collapse(left: Axes, above: Axes, below: Axes, fit, points: DataFrame, look: Look) -> None:
    """Curves of a fit as they are, shifted, and how far they are off one curve."""
    above.sharey(left)
    below.sharex(above)

    def thin(speed):
        return look(speed) | {"marker": ".", "linewidth": style.width(0.5)}

    for axes, across, up, times in (
        (left, "normal_force", "friction_coefficient", 1.0),
        (above, "shifted_force", "shifted_friction", 1.0),
        (below, "shifted_force", "deviation", 100.0),
    ):
        curves(axes, points, across, up, times, ("speed",), thin)
    common = points.sort_values("shifted_force")
    curve = common["shifted_friction"] / (1 + common["deviation"])
    above.plot(common["shifted_force"], curve, **style.line(0.75, 2.0, zorder=1))
    above.tick_params(labelbottom=False)
    below.axhline(0, **style.line(0.6, 0.55))
    left.set(xscale="log", yscale="log", xlabel="normal force [N]", ylabel="friction coefficient [1]")
    left.set_title(style.literal(fit.curves))
    above.set(xscale="log", title=SHIFTED[fit.shifted_as])
    shifted = "" if fit.shifted_as == UNSHIFTED else "shifted "
    below.set(xlabel=f"{shifted}normal force [N]", ylabel="off [%]", title=f"off by {_missed(fit)}")


def _missed(fit) -> str:
    """Misfit with its interval as findings have it."""
    return f"{_number(fit, 'misfit', 100)} %".replace("– %", "an unknown share")


def _number(fit, name: str, times: float = 1.0) -> str:
    """A number of a fit with its interval as the answer has it."""
    value, low, high = (times * getattr(fit, f"{name}{end}") for end in ENDS)
    return interval(value, low, high, FIGURES)


def _shifts(axes: Axes, fit, shifts: DataFrame, look: Look) -> None:
    """Shifts with intervals, hollow where curves do not collapse, and exponents of the speed in words."""
    form: dict[str, Any] = {"marker": "o", "linestyle": "none"}
    form |= {} if fit.decided else {"markerfacecolor": style.paper()}
    curves(axes, shifts, "speed", "log_shift", 1 / LOG10, ("speed",), lambda at: look(at) | form)
    entries = [style.entry(f"along the load{_power(fit, 'load_exponent')}", **form)]
    if fit.shifted_as == BOTH:
        lifts = {"color": style.ink(), "marker": "s", "linestyle": "none"}
        intervals(axes, shifts["speed"], shifts, "log_lift", 1 / LOG10, **lifts)
        entries.append(style.entry(f"along friction{_power(fit, 'friction_exponent')}", **lifts))
    if shifts["expected"].notna().all():
        power = f" power {number(fit.expected, FIGURES)}" if np.isfinite(fit.expected) else ""
        expected = style.line(0, 0.8, linestyle="--", label=f"expected{power}")
        entries += axes.plot(shifts["speed"], shifts["expected"] / LOG10, **expected)
    low, high = axes.get_ylim()
    axes.set(xscale="log", ylabel="decades of the shift [1]", title="shifts", ylim=(low, 2.2 * high - 1.2 * low))
    axes.legend(handles=entries, loc="upper right", handlelength=1.5)


def _power(fit, name: str) -> str:
    """The power of the speed that shifts follow, on a line of its own; empty where it is not known."""
    return f"\npower {_number(fit, name)}".replace(" (", "\n(") if np.isfinite(getattr(fit, name)) else ""
