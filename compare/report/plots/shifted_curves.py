"""Friction against load at many speeds, the curves shifted onto one, and the shifts (paper, Figs. 5 to 7)."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from itertools import cycle
from math import nan
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from pandas import DataFrame, concat

from ...statistics.collapse import ENDS, Alignment, Collapse
from ...statistics.finding import FAILS, Finding
from ..page import Plot, Tables
from . import shades, style
from .curves import intervals, scatter
from .lettering import clear, lettered, literal

NAME = "shifted-curves"
SHIFTS, POWERS, FITS = f"{NAME}-shifts", f"{NAME}-powers", f"{NAME}-fits"
LOG10 = np.log(10)
SLID = "speed times $a_T$ [m/s]"
# Most speeds that are drawn.
SPEEDS = 8
FITTED, EXPECTED, BOTH, ACROSS = "fitted", "expected", "both", "along friction"
# Lines of other powers of the speed, in the order in which they come.
OTHERS = (("#009E73", ":"), ("#CC79A7", "-."))


@dataclass(frozen=True)
class ShiftedCurves:
    """A row of the figure.

    title : what the curves are
    collapse : what shifts make of them
    finding : on the collapse by horizontal shifts
    expected : exponent of the shifts as a power of the speed that is expected; NaN if none is
    powers : other exponents, by name
    conditions : further columns of the points, in their order; where the column `holds` is false points are hollow
    lead : alignment of the collapse that is the answer; that along the load if None
    warmth : temperature and measured speed of each curve, where its own speed is one that its temperature shifts
    """

    title: str
    collapse: Collapse
    finding: Finding
    expected: float = nan
    powers: Mapping[str, float] = field(default_factory=dict)
    conditions: DataFrame | None = None
    lead: Alignment | None = None
    warmth: DataFrame | None = None

    @property
    def both(self) -> bool:
        """Whether the curves are shifted along friction too."""
        return self.lead is self.collapse.both

    @property
    def decided(self) -> bool:
        """Whether the shifts mean anything: not where they bring the curves onto none, or the curves part."""
        return self.both or (not self.collapse.horizontal.reason and self.finding.verdict != FAILS)


def plot(rows: Sequence[ShiftedCurves], name: str = NAME, about: str = "") -> Plot | None:
    """The plot of some sets of curves; None without any. about : a sentence added to the caption."""
    if not rows:
        return None
    parts: dict[str, list[DataFrame]] = {NAME: [], SHIFTS: [], POWERS: [], FITS: []}
    for each in rows:
        for table, frame in _tables(each).items():
            frame.insert(0, "curves", each.title)
            parts[table].append(frame)
    tables = {name + key.removeprefix(NAME): concat(frames, ignore_index=True) for key, frames in parts.items()}
    caption = (
        f"Friction against normal force, a curve for each of at most {SPEEDS} speeds; the curves shifted along "
        "the force (Eq. 23), and along friction where that is shifted too (squares), to come closest to one; the "
        "shift. Bars: 95 %. Shifts of curves that do not collapse are hollow; curves that part are shifted as "
        f"expected, if at all. {about}"
    )
    alternative = "; ".join(
        f"{each.title}: " + ("both shifts" if each.both else f"collapse {each.finding.verdict}") for each in rows
    )
    return Plot(name, figure, tables, caption.strip(), alternative, {"name": name})


def figure(tables: Tables, name: str = NAME) -> Figure:
    """A row for each set of curves: as they are, shifted, and the shifts."""
    names = (each.removeprefix(NAME) for each in (NAME, SHIFTS, POWERS, FITS))
    points, shifts, powers, fits = (tables[name + each] for each in names)
    warm = "reduced_speed" in points
    points, shifts = (_few(_slid(each)) for each in (points, shifts))
    count = len(fits)
    drawing = style.canvas("double", 0.55 + 2.1 * count)
    panels = drawing.subplots(count, 3, squeeze=False)
    between = shades.between(shifts["speed"])
    for row, (_, fit) in zip(panels, fits.iterrows(), strict=True):
        own, moved, lines = (each[each["curves"] == fit["curves"]] for each in (points, shifts, powers))
        row[1].sharey(row[0])
        lifted = "shifted_friction" if fit["shifted_as"] == BOTH else "friction_coefficient"
        for axes, at in zip(
            row, (("normal_force", "friction_coefficient"), ("shifted_force", lifted)), strict=False
        ):
            _curves(axes, own, *at, shades.SPEED(between(own["speed"].to_numpy())))
            axes.set(xscale="log", yscale="log")
        if own["shifted_force"].isna().all():
            row[1].text(0.5, 0.5, "undecided", transform=row[1].transAxes, ha="center", fontsize=style.small())
        _shifts(row[2], fit, moved, lines, shades.SPEED(between(moved["speed"].to_numpy())))
        if warm:
            _warmth(row[1], own)
        row[0].set_title(literal(fit["curves"]))
        row[1].set_title(_verdict(fit))
        row[2].set_title("" if fit["decided"] else "exponent undecided")
        row[0].set(xlabel="normal force [N]", ylabel="friction coefficient [1]")
        row[1].set(xlabel="shifted normal force [N]")
        row[2].set(xlabel=SLID if warm else "speed [m/s]", ylabel="decades of the shift [1]")
        style.decades(*row)
        for axis in (row[0].yaxis, row[1].yaxis, row[1].xaxis):
            axis.set_major_formatter(lambda value, _: f"{value:g}")
    place = {"location": "bottom", "aspect": 60, "shrink": 0.7, "fraction": 0.03, "pad": 0.04 / count}
    shades.bar(drawing, panels, shades.SPEED, between, SLID if warm else "speed [m/s]", **place)
    lettered(panels.flat, 3)
    clear(drawing, panels[:, 2])
    return drawing


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
    expected = lead.reason and np.isfinite(each.expected)
    reference = found.speeds[found.speeds.size // 2]
    along = each.expected * np.log(found.speeds / reference) if expected else lead.horizontal.value
    points = found.points(along, lead.vertical.value if each.both else None)
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
    fitted = (lead.exponent.value, *lead.exponent.interval()) if each.decided else (nan, nan, nan)
    powers = {FITTED: fitted}
    if each.both:
        powers[ACROSS] = (lead.vertical_exponent.value, *lead.vertical_exponent.interval())
    powers |= {name: (power, nan, nan) for name, power in ({EXPECTED: each.expected} | each.powers).items()}
    missed = (
        (lead.misfit.value, *lead.misfit.interval()) if each.both else (each.finding.value, *each.finding.interval)
    )
    fit = {
        "verdict": each.finding.verdict,
        **{f"misfit{end}": number for end, number in zip(ENDS, missed, strict=True)},
        "decided": each.decided,
        "shifted_as": BOTH if each.both else EXPECTED if expected else FITTED,
        "reference_speed": reference,
        "degree": found.degree,
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


def _verdict(fit):
    misfit = f", misfit {fit['misfit']:.2%}" if np.isfinite(fit["misfit"]) else ""
    if fit["shifted_as"] == BOTH:
        return f"shifted both ways{misfit}"
    how = ", shifted as expected" if fit["shifted_as"] == EXPECTED else ""
    return f"collapse {fit['verdict']}{how}{misfit}"


def _curves(axes: Axes, points: DataFrame, across: str, friction: str, colours: Any) -> None:
    """Lines with intervals; points filled where the conditions of the laws hold, or none are known."""
    known = points[across].notna().to_numpy()
    points, colours = points[known], colours[known]
    x, mu, speed = (points[name].to_numpy() for name in (across, friction, "speed"))
    at = [np.flatnonzero(speed == each) for each in np.unique(speed)]
    lines = [np.column_stack([x[each], mu[each]]) for each in at]
    shade = [colours[each[0]] for each in at]
    axes.add_collection(LineCollection(lines, colors=shade, linewidths=style.width(0.45), zorder=2))
    bars = {"fmt": "none", "ecolor": colours, "elinewidth": style.width(0.8), "capsize": 0}
    intervals(axes, x, points, friction, **bars)
    holds = points["holds"].to_numpy(bool) if "holds" in points else np.ones(len(points), bool)
    for marker, where in _marked(points):
        scatter(axes, x[where], mu[where], holds[where], colours[where], 0.5, 0.35, zorder=2.5, marker=marker)


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
    if np.isfinite(shift).any():
        intervals(axes, speed, shifts, "log_shift", 1 / LOG10, fmt="none", ecolor=colours, capsize=0)
        for marker, where in _marked(shifts):
            decided = np.full(where.sum(), bool(fit["decided"]))
            scatter(axes, speed[where], shift[where], decided, colours[where], 0.8, 0.8, zorder=2, marker=marker)
    if fit["shifted_as"] == BOTH:
        squares = {"fmt": "s", "color": style.ink(), "markersize": style.mark(0.6), "capsize": 0}
        intervals(axes, speed, shifts, "log_lift", 1 / LOG10, **squares)
    colour: Any
    decades, others = np.log10(speed / fit["reference_speed"]), iter(OTHERS)
    for power in powers.itertuples():
        name = "along the load" if ACROSS in set(powers["power"]) and power.power == FITTED else power.power
        label = f"{name} {power.exponent:.3g}"
        if power.power in (FITTED, ACROSS):
            colour, line = style.grey(0.6), "-" if power.power == FITTED else (0, (5, 1))
            if power.exponent_low < power.exponent_high:
                label += f"\n({power.exponent_low:.3g} to {power.exponent_high:.3g})"
        elif power.power == EXPECTED:
            colour, line = style.ink(), "--"
        else:
            colour, line = next(others, OTHERS[-1])
        look = {"color": colour, "linestyle": line, "linewidth": style.width(0.8)}
        axes.plot(speed, power.exponent * decades, label=label, **look)
    axes.set(xscale="log", xlim=(speed[0] / 1.2, speed[-1] * 1.2))
    if len(powers):
        low, high = axes.get_ylim()
        axes.set_ylim(low, high + 0.5 * (high - low))
        axes.legend(loc="upper right", fontsize=style.tiny(), borderaxespad=0.1, handlelength=1.5)
