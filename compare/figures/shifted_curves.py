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
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from numpy.polynomial import Chebyshev
from pandas import DataFrame, concat

from ..report.page import Plot, Tables
from ..solving.words import interval
from ..statistics import eq23
from ..statistics.collapse import ENDS, Alignment, Collapse
from ..statistics.finding import FAILS, Claim, Finding
from . import shades, style
from .curves import intervals, scatter
from .lettering import clear, lettered, literal

NAME = "shifted-curves"
SHIFTS, POWERS, FITS = f"{NAME}-shifts", f"{NAME}-powers", f"{NAME}-fits"
LOG10 = np.log(10)
SLID = "speed times $a_T$ [m/s]"
# Most speeds that are drawn.
SPEEDS = 8
# Degree of the one curve through those that no shift brings together: it only says where their middle is.
APART = 2
# Significant digits of a number without an interval, as in the answer.
FIGURES = 3
FITTED, EXPECTED, BOTH, UNSHIFTED, ACROSS = "fitted", "expected", "both", "none", "along friction"
# What is done to the curves, in the words of a title.
SHIFTED = {
    FITTED: "shifted along the force",
    EXPECTED: "shifted as expected, $v^{{{:.3g}}}$",
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
    """

    title: str
    collapse: Collapse
    findings: Mapping[str, Finding]
    expected: float = nan
    powers: Mapping[str, float] = field(default_factory=dict)
    conditions: DataFrame | None = None
    lead: Alignment | None = None
    warmth: DataFrame | None = None

    def found(self, *claims: Claim) -> tuple[float, float, float]:
        """Number and interval of the first of some claims on which there is a finding; NaN where there is none."""
        for each in claims:
            if each.id in self.findings:
                return self.findings[each.id].value, *self.findings[each.id].interval
        return nan, nan, nan

    @property
    def verdict(self) -> str:
        """Verdict on the collapse by horizontal shifts."""
        return self.findings[eq23.COLLAPSE.id].verdict

    @property
    def both(self) -> bool:
        """Whether the curves are shifted along friction too."""
        return self.lead is self.collapse.both

    @property
    def decided(self) -> bool:
        """Whether the shifts mean anything: not where they bring the curves onto none, or the curves part."""
        return self.both or (not self.collapse.horizontal.reason and self.verdict != FAILS)


def plot(rows: Sequence[ShiftedCurves], name: str = NAME) -> Plot | None:
    """The plot of some sets of curves; None without any."""
    if not rows:
        return None
    parts: dict[str, list[DataFrame]] = {NAME: [], SHIFTS: [], POWERS: [], FITS: []}
    for each in rows:
        for table, frame in _tables(each).items():
            frame.insert(0, "curves", each.title)
            parts[table].append(frame)
    tables = {name + key.removeprefix(NAME): concat(frames, ignore_index=True) for key, frames in parts.items()}
    caption = (
        f"Friction against normal force at up to {SPEEDS} speeds; shifted along the force (Eq. 23), and along "
        "friction where that is shifted too (squares), beside the one curve nearest to all (grey), and how far "
        "off it; the shifts. Bars: 95 %. Curves that no shift brings together are shifted as expected, if at all; "
        "hollow shifts leave curves apart."
    )
    fits = tables[name + FITS.removeprefix(NAME)]
    alternative = "; ".join(
        f"{fit.curves}: {_missed(fit) or 'not known how far'} off one curve" for fit in fits.itertuples()
    )
    return Plot(name, figure, tables, caption, alternative, {"name": name})


def figure(tables: Tables, name: str = NAME) -> Figure:
    """A row for each set of curves: as they are, shifted, and the shifts."""
    names = (each.removeprefix(NAME) for each in (NAME, SHIFTS, POWERS, FITS))
    points, shifts, powers, fits = (tables[name + each] for each in names)
    warm = "reduced_speed" in points
    points, shifts = (_few(_slid(each)) for each in (points, shifts))
    count, along = len(fits), SLID if warm else "speed [m/s]"
    drawing = style.canvas("double", 0.55 + 2.4 * count)
    grid = drawing.add_gridspec(2 * count, 3, height_ratios=(3, 1) * count)
    speeds = np.unique(shifts["speed"])
    between, panels, legends = shades.between(speeds), [], []
    for k, fit in enumerate(fits.itertuples()):
        own, moved, lines = (each[each["curves"] == fit.curves] for each in (points, shifts, powers))
        known = moved["log_shift"].notna().any()
        panels += _collapse(drawing, grid, k, 2 if known else 3, fit, own, shades.SPEED(between(own["speed"])))
        if warm:
            _warmth(panels[-2], own)
        if known:
            axes = drawing.add_subplot(grid[2 * k : 2 * k + 2, 2], title="shifts", xlabel=along)
            _shifts(axes, fit, moved, lines, shades.SPEED(between(moved["speed"])))
            panels.append(axes)
            legends.append(axes)
    style.decades(*panels)
    for axis in (axis for axes in panels for axis in (axes.xaxis, axes.yaxis) if axis.get_scale() == "log"):
        axis.set_major_formatter(lambda value, _: f"{value:g}")
    place = {"location": "bottom", "aspect": 60, "shrink": 0.7, "fraction": 0.03, "pad": 0.04 / count}
    bar = shades.bar(drawing, panels, shades.SPEED, between, along, **place)
    if len(speeds) <= SPEEDS:
        bar.set_ticks(list(speeds), labels=[f"{speed:.3g}" for speed in speeds])
        bar.minorticks_off()
    lettered(panels, 3)
    clear(drawing, legends)
    return drawing


def _collapse(drawing, grid, k, end, fit, points, colours):
    """Panels of the curves of a fit: as they are, shifted up to a column, and how far they are off one curve."""
    lifted = "shifted_friction" if fit.shifted_as == BOTH else "friction_coefficient"
    shifted = "normal force [N]" if fit.shifted_as == UNSHIFTED else "shifted normal force [N]"
    left = drawing.add_subplot(grid[2 * k : 2 * k + 2, 0], xscale="log", yscale="log")
    above = drawing.add_subplot(grid[2 * k, 1:end], sharey=left, xscale="log")
    below = drawing.add_subplot(grid[2 * k + 1, 1:end], sharex=above)
    _curves(left, points, "normal_force", "friction_coefficient", colours)
    _curves(above, points, "shifted_force", lifted, colours)
    _curves(below, points, "shifted_force", "deviation", colours, 100.0)
    common = points.sort_values("shifted_force")
    look = style.line(0.75, 2.0, zorder=1)
    above.plot(common["shifted_force"], common[lifted] / (1 + common["deviation"]), **look)
    below.axhline(0, **style.line(0.6, 0.55))
    left.set(title=literal(fit.curves), xlabel="normal force [N]", ylabel="friction coefficient [1]")
    above.set_title(_title(fit))
    above.tick_params(labelbottom=False)
    missed = _missed(fit)
    below.set(title=f"off by {missed}" if missed else "off one curve", xlabel=shifted, ylabel="off [%]")
    if fit.shifted_as in (EXPECTED, UNSHIFTED) and (least := _missed(fit, "least_misfit")):
        told = f"shifted to the least overlap: {least}"
        below.set_title(told, loc="right", fontsize=style.small(), fontweight="normal")
    return left, above, below


def _missed(fit, name="misfit") -> str:
    """A misfit with its interval as findings have it; empty where it is not known."""
    misfit, low, high = (100 * getattr(fit, f"{name}{end}") for end in ENDS)
    return f"{interval(misfit, low, high, FIGURES)} %" if np.isfinite(misfit) else ""


def _slid(table: DataFrame) -> DataFrame:
    """A table with the speed to which its temperature shifts a curve in place of that measured."""
    if "reduced_speed" not in table:
        return table
    return table.drop(columns="speed").rename(columns={"reduced_speed": "speed"})


def _few(table: DataFrame) -> DataFrame:
    """Rows of as many speeds of each set of curves as are told apart, from the slowest to the fastest."""
    kept = []
    for _, own in table.groupby("curves", sort=False):
        speeds = np.unique(own["speed"])
        chosen = speeds[np.unique(np.linspace(0, len(speeds) - 1, min(SPEEDS, len(speeds))).round().astype(int))]
        kept.append(own[own["speed"].isin(chosen)])
    return concat(kept)


def _tables(each):
    """Tables of one row of the figure, by their names."""
    found, lead = each.collapse, each.lead or each.collapse.horizontal
    how = BOTH if each.both else FITTED
    reference = found.speeds[found.speeds.size // 2]
    along, missed = lead.horizontal.value, eq23.BOTH if each.both else eq23.COLLAPSE
    if lead.reason:
        missed = eq23.PREDICTED if np.isfinite(each.expected) else eq23.UNSHIFTED
        how, power = (EXPECTED, each.expected) if np.isfinite(each.expected) else (UNSHIFTED, 0.0)
        along = power * np.log(found.speeds / reference)
    points = found.points(along, lead.vertical.value if each.both else None)
    points = points.join(
        _deviation(points, "shifted_friction" if each.both else "friction_coefficient", lead.curve)
    )
    if each.conditions is not None:
        points = points.join(each.conditions.reset_index(drop=True))
    shifts = found.shifts(lead)
    if each.warmth is not None:
        counts = [curve.log_load.size for curve in found.curves]
        points, shifts = (
            table.rename(columns={"speed": "reduced_speed"}).join(own)
            for table, own in (
                (points, each.warmth.loc[np.repeat(each.warmth.index, counts)].reset_index(drop=True)),
                (shifts, each.warmth),
            )
        )
    fitted = each.found(eq23.EXPONENT, eq23.BESIDE if each.both else eq23.ALONE)
    powers = {FITTED: fitted if each.decided else (nan, nan, nan)}
    if each.both:
        powers[ACROSS] = each.found(eq23.NOT_SHIFTED)
    powers |= {name: (power, nan, nan) for name, power in ({EXPECTED: each.expected} | each.powers).items()}
    fit = {
        "verdict": each.verdict,
        **{f"misfit{end}": number for end, number in zip(ENDS, each.found(missed), strict=True)},
        **{f"least_misfit{end}": number for end, number in zip(ENDS, each.found(eq23.COLLAPSE), strict=True)},
        "decided": each.decided,
        "shifted_as": how,
        "expected": each.expected,
        "reference_speed": reference,
        "degree": APART if lead.reason else found.degree,
    }
    return {
        NAME: points,
        SHIFTS: shifts,
        POWERS: DataFrame(
            [(name, *found) for name, found in powers.items() if np.isfinite(found[0])],
            columns=["power", "exponent", "exponent_low", "exponent_high"],
        ),
        FITS: DataFrame([fit]),
    }


def _deviation(points, friction, curve):
    """Friction over the common curve of ln mu, less one; over the nearest of a low degree where there is none."""
    load = np.log(points["shifted_force"].to_numpy())
    common = np.exp((curve or Chebyshev.fit(load, np.log(points[friction].to_numpy()), APART))(load))
    return DataFrame({f"deviation{end}": points[f"{friction}{end}"] / common - 1 for end in ENDS})


def _title(fit):
    return SHIFTED[fit.shifted_as].format(fit.expected)


def _curves(axes: Axes, points: DataFrame, across: str, up: str, colours: Any, times: float = 1.0) -> None:
    """Lines with intervals; points filled where the conditions of the laws hold, or none are known."""
    x, y, speed = points[across].to_numpy(), times * points[up].to_numpy(), points["speed"].to_numpy()
    at = [np.flatnonzero(speed == each) for each in np.unique(speed)]
    lines = [np.column_stack([x[each], y[each]]) for each in at]
    shade = [colours[each[0]] for each in at]
    axes.add_collection(LineCollection(lines, colors=shade, linewidths=style.width(0.45), zorder=2))
    bars = {"fmt": "none", "ecolor": colours, "elinewidth": style.width(0.8), "capsize": 0}
    intervals(axes, x, points, up, times, **bars)
    holds = points["holds"].to_numpy(bool) if "holds" in points else np.ones(len(points), bool)
    for marker, where in _marked(points):
        scatter(axes, x[where], y[where], holds[where], colours[where], 0.5, 0.35, zorder=2.5, marker=marker)


def _marked(table: DataFrame):
    """Markers and the rows that have them: one for each temperature, or one for all."""
    if "temperature" not in table:
        return [("o", np.ones(len(table), bool))]
    warmth = table["temperature"].to_numpy()
    return [(marker, warmth == at) for at, marker in zip(np.unique(warmth), cycle(style.SERIES_MARKERS))]


def _warmth(axes: Axes, points: DataFrame) -> None:
    """Which marker is which temperature."""
    look: dict[str, Any] = {"linestyle": "none", "color": style.ink(), "markersize": style.mark(0.7)}
    for marker, where in _marked(points):
        axes.plot([], [], marker=marker, label=f"{points['temperature'].to_numpy()[where][0]:.4g} K", **look)
    axes.legend(loc="lower left", fontsize=style.tiny(), handlelength=1.0, labelspacing=0.2)


def _shifts(axes: Axes, fit, shifts: DataFrame, powers: DataFrame, colours: Any) -> None:
    """Shifts with intervals, hollow where curves do not collapse, and powers of the speed."""
    speed, shift = shifts["speed"].to_numpy(), shifts["log_shift"].to_numpy() / LOG10
    intervals(axes, speed, shifts, "log_shift", 1 / LOG10, fmt="none", ecolor=colours, capsize=0)
    for marker, where in _marked(shifts):
        decided = np.full(where.sum(), bool(fit.decided))
        scatter(axes, speed[where], shift[where], decided, colours[where], 0.8, 0.8, zorder=2, marker=marker)
    if fit.shifted_as == BOTH:
        squares = {"fmt": "s", "color": style.ink(), "markersize": style.mark(0.6), "capsize": 0}
        intervals(axes, speed, shifts, "log_lift", 1 / LOG10, **squares)
    colour: Any
    decades, others = np.log10(speed / fit.reference_speed), iter(OTHERS)
    for power in powers.itertuples():
        name = "along the load" if ACROSS in set(powers["power"]) and power.power == FITTED else power.power
        told = interval(power.exponent, power.exponent_low, power.exponent_high, FIGURES)
        exponent, _, ends = told.partition(" ")
        # A power of ten behind an interval belongs to the number too.
        label, ends = (f"{name} v^{told}", "") if "×" in told else (f"{name} $v^{{{exponent}}}$", ends)
        if power.power in (FITTED, ACROSS):
            colour, line = style.grey(0.6), "-" if power.power == FITTED else (0, (5, 1))
            label += f"\n{ends}" if ends else ""
        elif power.power == EXPECTED:
            colour, line = style.ink(), "--"
        else:
            colour, line = next(others, OTHERS[-1])
        look = {"color": colour, "linestyle": line, "linewidth": style.width(0.8)}
        axes.plot(speed, power.exponent * decades, label=label, **look)
    axes.set(xscale="log", xlim=(speed[0] / 1.2, speed[-1] * 1.2), ylabel="decades of the shift [1]")
    if len(powers):
        low, high = axes.get_ylim()
        axes.set_ylim(low, high + 0.5 * (high - low))
        axes.legend(loc="upper right", fontsize=style.tiny(), borderaxespad=0.1, handlelength=1.5)
