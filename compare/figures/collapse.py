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
from numpy.polynomial import Chebyshev
from pandas import DataFrame, Series, concat

from ..solving.words import interval
from ..statistics import eq23
from ..statistics.collapse import ENDS, Alignment, Collapse
from ..statistics.finding import FAILS, Claim, Finding
from . import shades, style
from .curves import intervals
from .lettering import lettered, literal
from .panels import CURVES, entry, few, legend, speed_key
from .plot import Plot, Tables

NAME = "collapse"
SHIFTS, POWERS, FITS = "-shifts", "-powers", "-fits"
LOG10 = np.log(10)
# Degree of the one curve through those that no shift brings together: it only says where their middle is.
APART = 2
# Significant digits of a number without an interval, as in the answer.
FIGURES = 3
FITTED, EXPECTED, BOTH, UNSHIFTED = "fitted", "expected", "both", "none"
ALONG, ACROSS = "along the load", "along friction"
# What is done to the curves, in the words of a title.
SHIFTED = {
    FITTED: "shifted along the force",
    EXPECTED: "shifted as expected",
    BOTH: "shifted along force and friction",
    UNSHIFTED: "no shift brings them onto one",
}
# Height above the shifts that a line of the legend takes, over theirs.
ROOM = 0.18
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
    along, lifts = lead.horizontal.value, lead.vertical.value if row.both else None
    missed, how = (eq23.BOTH, BOTH) if row.both else (eq23.COLLAPSE, FITTED)
    if lead.reason and np.isfinite(row.shifts).all():
        along, missed, how = row.shifts, eq23.PREDICTED, EXPECTED
    elif lead.reason:
        along, missed, how = np.zeros(found.speeds.size), eq23.UNSHIFTED, UNSHIFTED
    points = found.points(along, lifts)
    friction = "shifted_friction" if row.both else "friction_coefficient"
    load = np.log(points["shifted_force"].to_numpy())
    curve = lead.curve or Chebyshev.fit(load, np.log(points[friction].to_numpy()), APART)
    for end in ENDS:
        points[f"deviation{end}"] = points[f"{friction}{end}"] / np.exp(curve(load)) - 1
    if row.conditions is not None:
        points = points.join(row.conditions.reset_index(drop=True))
    shifts = found.shifts(lead).assign(expected=row.shifts)
    if row.warmth is not None:
        counts = [each.log_load.size for each in found.curves]
        each = row.warmth.loc[np.repeat(row.warmth.index, counts)].reset_index(drop=True)
        points, shifts = (
            table.rename(columns={"speed": "reduced_speed"}).join(own)
            for table, own in ((points, each), (shifts, row.warmth))
        )
    exponents = {name: (power, nan, nan) for name, power in {EXPECTED: row.expected, **row.powers}.items()}
    if row.decided:
        exponents[ALONG] = row.found(eq23.EXPONENT, eq23.BESIDE if row.both else eq23.ALONE)
    if row.both:
        exponents[ACROSS] = row.found(eq23.NOT_SHIFTED)
    powers = DataFrame(exponents, ["exponent", "exponent_low", "exponent_high"]).T.dropna(subset="exponent")
    fit: dict[str, Any] = dict(zip((f"misfit{end}" for end in ENDS), row.found(missed), strict=True))
    fit |= {"shifted_as": how, "decided": row.decided, "reference_speed": found.speeds[found.speeds.size // 2]}
    return {"": points, SHIFTS: shifts, POWERS: powers.reset_index(names="power"), FITS: DataFrame([fit])}


def figure(tables: Tables, name: str = NAME) -> Figure:
    """A row for each set of curves: as they are, shifted, and the shifts."""
    points, shifts, powers, fits = (tables[f"{name}{each}"] for each in ("", SHIFTS, POWERS, FITS))
    label = "speed times $a_T$ [m/s]" if "reduced_speed" in points else "speed [m/s]"
    points, shifts = _few(points), _few(shifts)
    speeds = np.unique(shifts["speed"])
    colours = dict(zip(speeds.tolist(), shades.SPEED(shades.between(speeds)(speeds)), strict=True))
    drawing = style.canvas("double", 0.6 + 2.4 * len(fits))
    grid = drawing.add_gridspec(2 * len(fits), 3, height_ratios=(3, 1) * len(fits))
    panels: list[Axes] = []
    for k, fit in enumerate(fits.itertuples()):
        own, moved, lines = (each[each["curves"] == fit.curves] for each in (points, shifts, powers))
        known, rows = moved["log_shift"].notna().any(), slice(2 * k, 2 * k + 2)
        left = drawing.add_subplot(grid[rows, 0])
        above = drawing.add_subplot(grid[2 * k, 1 : 2 if known else 3], sharey=left)
        below = drawing.add_subplot(grid[2 * k + 1, 1 : 2 if known else 3], sharex=above)
        _collapse(left, above, below, fit, own, colours)
        panels += [left, above, below]
        if known:
            panels.append(drawing.add_subplot(grid[rows, 2], title="shifts", xlabel=label, xscale="log"))
            _shifts(panels[-1], fit, moved, lines, colours)
    style.decades(*panels)
    lettered(panels, 3)
    entries = speed_key(drawing, panels, speeds, label)
    if "temperature" in points:
        warmth = points.drop_duplicates("temperature").sort_values("temperature")
        entries += [entry(f"{each.temperature:.4g} K", marker=each.marker) for each in warmth.itertuples()]
    legend(drawing, (), CURVES, *entries, title=label if entries and "temperature" in points else None)
    return drawing


def _few(table: DataFrame) -> DataFrame:
    """Rows of as many speeds of each set of curves as are told apart, with a marker of each temperature.

    A speed is that to which its temperature shifts it.
    """
    if "reduced_speed" in table:
        table = table.drop(columns="speed").rename(columns={"reduced_speed": "speed"})
    warmth = table["temperature"] if "temperature" in table else Series(0.0, table.index)
    markers = dict(zip(np.unique(warmth), cycle(style.SERIES_MARKERS)))
    groups = table.assign(marker=warmth.map(markers)).groupby("curves", sort=False)
    return concat(own[own["speed"].isin(few(own["speed"], CURVES))] for _, own in groups)


def _collapse(left: Axes, above: Axes, below: Axes, fit, points: DataFrame, colours) -> None:
    """Curves of a fit as they are, shifted, and how far they are off one curve."""
    friction = "shifted_friction" if fit.shifted_as == BOTH else "friction_coefficient"
    for axes, across, up, times in (
        (left, "normal_force", "friction_coefficient", 1.0),
        (above, "shifted_force", friction, 1.0),
        (below, "shifted_force", "deviation", 100.0),
    ):
        axes.set_xscale("log")
        for speed, own in points.groupby("speed"):
            look: dict[str, Any] = {"color": colours[speed], "marker": own["marker"].iloc[0]}
            look |= {"markersize": style.mark(0.6), "linewidth": style.width(0.45)}
            intervals(axes, own[across], own, up, times, elinewidth=style.width(0.8), capsize=0, **look)
            if "holds" in own:  # hollow where a condition of the laws breaks
                hollow = own[~own["holds"].astype(bool)]
                look |= {"linestyle": "none", "markerfacecolor": style.paper(), "zorder": 2.5}
                axes.plot(hollow[across], times * hollow[up], **look)
    common = points.sort_values("shifted_force")
    curve = common[friction] / (1 + common["deviation"])
    above.plot(common["shifted_force"], curve, **style.line(0.75, 2.0, zorder=1))
    above.tick_params(labelbottom=False)
    above.set_title(SHIFTED[fit.shifted_as])
    below.axhline(0, **style.line(0.6, 0.55))
    left.set(yscale="log", title=literal(fit.curves), xlabel="normal force [N]", ylabel="friction coefficient [1]")
    missed, shifted = _missed(fit), "" if fit.shifted_as == UNSHIFTED else "shifted "
    below.set(xlabel=f"{shifted}normal force [N]", ylabel="off [%]", title=f"off by {missed}" if missed else "off")


def _missed(fit) -> str:
    """Misfit with its interval as findings have it; empty where it is not known."""
    misfit, low, high = (100 * getattr(fit, f"misfit{end}") for end in ENDS)
    return f"{interval(misfit, low, high, FIGURES)} %" if np.isfinite(misfit) else ""


def _shifts(axes: Axes, fit, shifts: DataFrame, powers: DataFrame, colours) -> None:
    """Shifts with intervals, hollow where curves do not collapse; fitted exponents in words, others as lines."""
    told = {each.power: f"{each.power}{_exponent(each)}" for each in powers.itertuples()}
    marks: dict[str, Any] = {"linestyle": "none", "markersize": style.mark(0.9)}
    marks |= {} if fit.decided else {"markerfacecolor": style.paper()}
    axes.plot([], [], "o", color=style.grey(0.3), label=told.pop(ALONG, ALONG), **marks)
    for speed, own in shifts.groupby("speed"):
        look = marks | {"color": colours[speed], "marker": own["marker"].iloc[0], "capsize": 0}
        intervals(axes, own["speed"], own, "log_shift", 1 / LOG10, **look)
    if fit.shifted_as == BOTH:
        look = marks | {"color": style.ink(), "marker": "s", "capsize": 0, "label": told.pop(ACROSS, ACROSS)}
        intervals(axes, shifts["speed"], shifts, "log_lift", 1 / LOG10, **look)
    if shifts["expected"].notna().all():
        look = style.line(0, 0.8, linestyle="--", label=told.pop(EXPECTED, EXPECTED))
        axes.plot(shifts["speed"], shifts["expected"] / LOG10, **look)
    decades = np.log10(shifts["speed"] / fit.reference_speed)
    for power, (colour, line) in zip(powers[powers["power"].isin(told)].itertuples(), OTHERS, strict=False):
        look = {"color": colour, "linestyle": line, "linewidth": style.width(0.8), "label": told[power.power]}
        axes.plot(shifts["speed"], power.exponent * decades, **look)
    style.span(axes, shifts["speed"])
    low, high = axes.get_ylim()
    labels = axes.get_legend_handles_labels()[1]
    room = ROOM * len("\n".join(labels).split("\n")) * (high - low)
    axes.set(ylim=(low, high + room), ylabel="decades of the shift [1]")
    axes.legend(loc="upper right", fontsize=style.tiny(), borderaxespad=0.1, handlelength=1.5)


def _exponent(power) -> str:
    """An exponent with its interval as the answer has it."""
    told = interval(power.exponent, power.exponent_low, power.exponent_high, FIGURES)
    if "×" in told:  # a power of ten behind an interval belongs to the number too
        return f" v^{told}"
    exponent, *ends = told.split(" ", 1)
    return "\n".join((f" $v^{{{exponent}}}$", *ends))
