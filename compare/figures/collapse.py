"""Friction against load at many speeds, the curves shifted onto one, how far they are from it, and the shifts.

Paper, Figs. 5 to 7.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from itertools import cycle
from math import nan
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.polynomial import Chebyshev
from pandas import DataFrame, Series, concat

from ..report.page import Plot, Tables
from ..solving.words import interval
from ..statistics import eq23
from ..statistics.collapse import ENDS, Alignment, Collapse
from ..statistics.finding import FAILS, Claim, Finding
from . import shades, style
from .curves import intervals
from .lettering import lettered, literal
from .panels import CURVES, few

NAME = "collapse"
SHIFTS, POWERS, FITS = "-shifts", "-powers", "-fits"
LOG10 = np.log(10)
# Degree of the one curve through those that no shift brings together: it only says where their middle is.
APART = 2
# Significant digits of a number without an interval, as in the answer.
FIGURES = 3
FITTED, EXPECTED, BOTH, UNSHIFTED, ACROSS = "fitted", "expected", "both", "none", "along friction"
# What is done to the curves, in the words of a title.
SHIFTED = {
    FITTED: "shifted along the force",
    EXPECTED: "shifted as expected",
    BOTH: "shifted along force and friction",
    UNSHIFTED: "no shift brings them onto one",
}
# Lines of other powers of the speed, in the order in which they come.
OTHERS = (("#009E73", ":"), ("#CC79A7", "-."))


@dataclass(frozen=True)
class ShiftedCurves:
    """A row of the figure.

    title : what the curves are
    collapse : what shifts make of them
    findings : on the collapse, by the claims of `eq23`: those on misfits and exponents, which the figure names
    expected : exponent of the shifts as a power of the speed that is expected; NaN if none is
    powers : other exponents, by name
    conditions : further columns of the points, in their order; where the column `holds` is false points are hollow
    lead : alignment of the collapse that is the answer; that along the load if None
    warmth : temperature and measured speed of each curve, where its own speed is one that its temperature shifts
    predicted : ln p(v) of each curve that is expected, where that is no power of the speed
    """

    title: str
    collapse: Collapse
    findings: Mapping[str, Finding]
    expected: float = nan
    powers: Mapping[str, float] = field(default_factory=dict)
    conditions: DataFrame | None = None
    lead: Alignment | None = None
    warmth: DataFrame | None = None
    predicted: np.ndarray | None = None

    def found(self, *claims: Claim) -> tuple[float, float, float]:
        """Number and interval of the first of some claims on which there is a finding; NaN where there is none."""
        own = [self.findings[each.id] for each in claims if each.id in self.findings]
        return (own[0].value, *own[0].interval) if own else (nan, nan, nan)

    @property
    def both(self) -> bool:
        """Whether the curves are shifted along friction too."""
        return self.lead is self.collapse.both

    @property
    def shifts(self) -> np.ndarray:
        """Expected ln p(v) of each curve over that of the middle one; NaN where none is expected."""
        speeds = self.collapse.speeds
        known = self.expected * np.log(speeds) if self.predicted is None else self.predicted
        return known - known[known.size // 2]

    @property
    def decided(self) -> bool:
        """Whether the shifts mean anything: not where they bring the curves onto none, or the curves part."""
        fails = self.findings[eq23.COLLAPSE.id].verdict == FAILS
        return self.both or not (self.collapse.horizontal.reason or fails)


def plot(rows: Sequence[ShiftedCurves], name: str = NAME, folder: str = "") -> Plot | None:
    """The plot of some sets of curves; None without any."""
    if not rows:
        return None
    parts: dict[str, list[DataFrame]] = {"": [], SHIFTS: [], POWERS: [], FITS: []}
    for each in rows:
        for table, frame in _tables(each).items():
            frame.insert(0, "curves", each.title)
            parts[table].append(frame)
    tables = {f"{name}{ending}": concat(frames, ignore_index=True) for ending, frames in parts.items()}
    caption = (
        f"Friction against normal force at up to {CURVES} speeds; shifted along the force (Eq. 23), and along "
        "friction where that is shifted too (squares), beside the one curve nearest to all (grey), and how far "
        "off it; the shifts. Bars: 95 %. Curves that no shift brings together are shifted as expected, if at all; "
        "hollow shifts leave curves apart."
    )
    fits = tables[f"{name}{FITS}"].itertuples()
    told = "; ".join(f"{fit.curves}: {_missed(fit) or 'not known how far'} off one curve" for fit in fits)
    return Plot(f"{folder}{name}", figure, tables, caption, told, {"name": name})


def _tables(row: ShiftedCurves) -> dict[str, DataFrame]:
    """Tables of one row of the figure, by the endings of their names."""
    found, lead = row.collapse, row.lead or row.collapse.horizontal
    known = bool(np.isfinite(row.shifts).all())
    along, missed, how = (
        lead.horizontal.value,
        eq23.BOTH if row.both else eq23.COLLAPSE,
        BOTH if row.both else FITTED,
    )
    if lead.reason:
        missed, how = (eq23.PREDICTED, EXPECTED) if known else (eq23.UNSHIFTED, UNSHIFTED)
        along = row.shifts if known else np.zeros(found.speeds.size)
    points = found.points(along, lead.vertical.value if row.both else None)
    friction = "shifted_friction" if row.both else "friction_coefficient"
    load = np.log(points["shifted_force"].to_numpy())
    curve = lead.curve or Chebyshev.fit(load, np.log(points[friction].to_numpy()), APART)
    for end in ENDS:
        points[f"deviation{end}"] = points[f"{friction}{end}"] / np.exp(curve(load)) - 1
    if row.conditions is not None:
        points = points.join(row.conditions.reset_index(drop=True))
    shifts = found.shifts(lead).assign(expected=row.shifts)
    if row.warmth is not None:
        shifts, counts = _warm(shifts, row.warmth), [each.log_load.size for each in found.curves]
        points = _warm(points, row.warmth.loc[np.repeat(row.warmth.index, counts)].reset_index(drop=True))
    fitted = row.found(eq23.EXPONENT, eq23.BESIDE if row.both else eq23.ALONE) if row.decided else (nan, nan, nan)
    across = row.found(eq23.NOT_SHIFTED) if row.both else (nan, nan, nan)
    others = {name: (power, nan, nan) for name, power in {EXPECTED: row.expected, **row.powers}.items()}
    powers = [
        (name, *each) for name, each in ({FITTED: fitted, ACROSS: across} | others).items() if np.isfinite(each[0])
    ]
    fit = dict(zip([f"misfit{end}" for end in ENDS], row.found(missed), strict=True))
    fit |= {"decided": row.decided, "shifted_as": how, "reference_speed": found.speeds[found.speeds.size // 2]}
    fit |= {"degree": APART if lead.reason else found.degree}
    columns = ["power", "exponent", "exponent_low", "exponent_high"]
    return {"": points, SHIFTS: shifts, POWERS: DataFrame(powers, columns=columns), FITS: DataFrame([fit])}


def _warm(table: DataFrame, warmth: DataFrame) -> DataFrame:
    """A table whose speeds are those to which temperatures shift the measured ones."""
    return table.rename(columns={"speed": "reduced_speed"}).join(warmth)


def figure(tables: Tables, name: str = NAME) -> Figure:
    """A row for each set of curves: as they are, shifted, and the shifts."""
    points, shifts, powers, fits = (tables[f"{name}{each}"] for each in ("", SHIFTS, POWERS, FITS))
    along = "speed times $a_T$ [m/s]" if "reduced_speed" in points else "speed [m/s]"
    points, shifts = _few(points), _few(shifts)
    speeds = np.unique(shifts["speed"])
    scale = shades.between(speeds)
    drawing = style.canvas("double", 0.6 + 2.4 * len(fits))
    grid = drawing.add_gridspec(2 * len(fits), 3, height_ratios=(3, 1) * len(fits))
    panels: list[Axes] = []
    for k, fit in enumerate(fits.itertuples()):
        own, moved, lines = (each[each["curves"] == fit.curves] for each in (points, shifts, powers))
        known, rows = moved["log_shift"].notna().any(), slice(2 * k, 2 * k + 2)
        across = slice(1, 2 if known else 3)
        left = drawing.add_subplot(grid[rows, 0])
        above = drawing.add_subplot(grid[2 * k, across], sharey=left)
        below = drawing.add_subplot(grid[2 * k + 1, across], sharex=above)
        _collapse(left, above, below, fit, own, scale)
        panels += [left, above, below]
        if known:
            panels.append(drawing.add_subplot(grid[rows, 2], title="shifts", xlabel=along, xscale="log"))
            _shifts(panels[-1], fit, moved, lines, scale)
    style.decades(*panels)
    lettered(panels, 3)
    entries: list[Line2D] = []
    if len(speeds) > CURVES:
        place = {"location": "bottom", "aspect": 60, "shrink": 0.7, "fraction": 0.03, "pad": 0.04 / len(fits)}
        shades.bar(drawing, panels, shades.SPEED, scale, along, **place)
    else:
        entries = [_entry(f"{each:.3g}", color=shades.SPEED(scale(each)), marker="o") for each in speeds]
    if "temperature" in points:
        warmth = points.drop_duplicates("temperature").sort_values("temperature")
        entries += [_entry(f"{each.temperature:.4g} K", marker=each.marker) for each in warmth.itertuples()]
    if entries:
        title = along if len(speeds) <= CURVES else None
        style.legend(drawing, entries, "outside lower center", CURVES, title=title)
    return drawing


def _entry(label: str, **look: Any) -> Line2D:
    """Entry of a legend."""
    return Line2D([], [], label=label, linestyle="none", **({"color": style.ink()} | look))


def _few(table: DataFrame) -> DataFrame:
    """Rows of as many speeds of each set of curves as are told apart, with their markers.

    A speed is that to which its temperature shifts it, and each temperature has a marker.
    """
    if "reduced_speed" in table:
        table = table.drop(columns="speed").rename(columns={"reduced_speed": "speed"})
    warmth = table.get("temperature", Series(0.0, table.index))
    table = table.assign(marker=warmth.map(dict(zip(np.unique(warmth), cycle(style.SERIES_MARKERS)))))
    groups = table.groupby("curves", sort=False)
    return concat(own[own["speed"].isin(few(own["speed"], CURVES))] for _, own in groups)


def _collapse(left: Axes, above: Axes, below: Axes, fit, points: DataFrame, scale) -> None:
    """Curves of a fit as they are, shifted, and how far they are off one curve."""
    friction = "shifted_friction" if fit.shifted_as == BOTH else "friction_coefficient"
    _curves(left, points, "normal_force", "friction_coefficient", scale)
    _curves(above, points, "shifted_force", friction, scale)
    _curves(below, points, "shifted_force", "deviation", scale, 100.0)
    common = points.sort_values("shifted_force")
    curve = common[friction] / (1 + common["deviation"])
    above.plot(common["shifted_force"], curve, **style.line(0.75, 2.0, zorder=1))
    below.axhline(0, **style.line(0.6, 0.55))
    labels = {"xlabel": "normal force [N]", "ylabel": "friction coefficient [1]"}
    left.set(xscale="log", yscale="log", title=literal(fit.curves), **labels)
    above.set(xscale="log", title=SHIFTED[fit.shifted_as])
    above.tick_params(labelbottom=False)
    missed, shifted = _missed(fit), "" if fit.shifted_as == UNSHIFTED else "shifted "
    title = f"off by {missed}" if missed else "off one curve"
    below.set(title=title, xlabel=f"{shifted}normal force [N]", ylabel="off [%]")


def _missed(fit) -> str:
    """Misfit with its interval as findings have it; empty where it is not known."""
    misfit, low, high = (100 * getattr(fit, f"misfit{end}") for end in ENDS)
    return f"{interval(misfit, low, high, FIGURES)} %" if np.isfinite(misfit) else ""


def _curves(axes: Axes, points: DataFrame, across: str, up: str, scale, times: float = 1.0) -> None:
    """A curve for each speed with intervals; points filled where the conditions of the laws hold, or none are known."""
    for speed, own in points.groupby("speed"):
        look: dict[str, Any] = {"color": shades.SPEED(scale(speed)), "marker": own["marker"].iloc[0]}
        look |= {"markersize": style.mark(0.6), "markeredgewidth": style.width(0.35)}
        thin = {"linewidth": style.width(0.45), "elinewidth": style.width(0.8), "capsize": 0}
        intervals(axes, own[across], own, up, times, **look, **thin)
        if "holds" in own:
            hollow = own[~own["holds"].astype(bool)]
            look |= {"linestyle": "none", "markerfacecolor": style.paper()}
            axes.plot(hollow[across], times * hollow[up], **look, zorder=2.5)


def _shifts(axes: Axes, fit, shifts: DataFrame, powers: DataFrame, scale) -> None:
    """Shifts with intervals, hollow where curves do not collapse; fitted exponents in words, others as lines."""
    told = {each.power: _told(each) for each in powers.itertuples()}
    marks: dict[str, Any] = {"linestyle": "none", "capsize": 0, "markersize": style.mark(0.9)}
    hollow = {} if fit.decided else {"markerfacecolor": style.paper()}
    look = (
        marks
        | hollow
        | {"marker": "o", "color": style.grey(0.3), "label": f"along the load{told.pop(FITTED, '')}"}
    )
    intervals(axes, shifts["speed"], shifts, "log_shift", 1 / LOG10, **look)
    for speed, own in shifts.groupby("speed"):
        look = marks | hollow | {"color": shades.SPEED(scale(speed)), "marker": own["marker"].iloc[0]}
        intervals(axes, own["speed"], own, "log_shift", 1 / LOG10, **look)
    if fit.shifted_as == BOTH:
        look = marks | {"marker": "s", "color": style.ink(), "label": f"{ACROSS}{told.pop(ACROSS, '')}"}
        intervals(axes, shifts["speed"], shifts, "log_lift", 1 / LOG10, **look)
    if shifts["expected"].notna().all():
        label = f"{EXPECTED}{told.pop(EXPECTED, '')}"
        axes.plot(shifts["speed"], shifts["expected"] / LOG10, **style.line(0, 0.8, linestyle="--", label=label))
    decades = np.log10(shifts["speed"] / fit.reference_speed)
    for power, (colour, line) in zip(powers[powers["power"].isin(told)].itertuples(), OTHERS, strict=False):
        label = f"{power.power}{told[power.power]}"
        axes.plot(
            shifts["speed"], power.exponent * decades, line, color=colour, linewidth=style.width(0.8), label=label
        )
    style.span(axes, shifts["speed"])
    axes.set_ylabel("decades of the shift [1]")
    low, high = axes.get_ylim()
    axes.set_ylim(low, high + 0.5 * (high - low))
    axes.legend(loc="upper right", fontsize=style.tiny(), borderaxespad=0.1, handlelength=1.5)


def _told(power) -> str:
    """An exponent with its interval as the answer has it."""
    told = interval(power.exponent, power.exponent_low, power.exponent_high, FIGURES)
    exponent, _, ends = told.partition(" ")
    if "×" in told:  # a power of ten behind an interval belongs to the number too
        return f" v^{told}"
    return f" $v^{{{exponent}}}$" + (f"\n{ends}" if ends else "")
