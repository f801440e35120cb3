"""Friction against speed at several temperatures, shifted along the speed onto a curve a load; the shifts."""

from itertools import cycle
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from pandas import DataFrame

from ...figures import shades, style
from ...figures.curves import intervals
from ...figures.lettering import clear, lettered
from ...report.page import Plot, Tables
from ...statistics.intervals import student
from .pooling import Pooled
from .shiftlaws import ShiftLaw
from .temperatureshifts import TemperatureShifts

NAME = "temperature-shifts"
SHIFTS, LAWS = f"{NAME}-shifts", f"{NAME}-laws"
LOG10 = np.log(10)
# Most that are drawn, from the lowest to the highest.
TEMPERATURES, LOADS = len(style.SERIES_MARKERS), 3
LINES = {"WLF": "-", "Arrhenius": "--"}


def plot(pooled: Pooled, shifts: TemperatureShifts, law: ShiftLaw | None) -> Plot:
    """The plot of points at several temperatures, and of their shifts."""
    tables = {NAME: _points(pooled, shifts), SHIFTS: shifts_table(shifts), LAWS: _laws(shifts, law)}
    how = "found" if shifts.found else "stated"
    caption = (
        f"Friction against speed at one load, a marker for each of at most {TEMPERATURES} temperatures; at up to "
        f"{LOADS} loads against the speed times a_T, which is {how}; the decades of a_T, and the laws that they "
        "allow. Bars: 95 %."
    )
    return Plot(
        NAME, figure, tables, caption, "Friction at several temperatures, shifted onto a curve for each load."
    )


def figure(tables: Tables) -> Figure:
    """Left: as measured, at one load. Middle: shifted along the speed. Right: the shifts."""
    points, shifts, laws = (tables[name] for name in (NAME, SHIFTS, LAWS))
    drawing = style.canvas("double", 2.7)
    left, middle, right = panels = drawing.subplots(1, 3)
    middle.sharey(left)
    warmth = np.unique(shifts["temperature"])
    colours = dict(zip(warmth.tolist(), shades.SPEED(np.linspace(0, 1, warmth.size)), strict=True))
    shown = _few(warmth, TEMPERATURES)
    markers = dict(zip(shown.tolist(), style.SERIES_MARKERS, strict=False))
    loads = np.unique(points["load"])
    middling = loads[loads.size // 2]
    for axes, across in ((left, "speed"), (middle, "reduced_speed")):
        for (load, at), own in points[points["temperature"].isin(shown)].groupby(["load", "temperature"]):
            if axes is left and load != middling:
                continue
            look = {
                "color": colours[at],
                "marker": markers[at],
                "markersize": style.mark(0.8),
                "linewidth": style.width(0.5),
            }
            label = f"{at:.4g} K" if load == middling else None
            intervals(axes, own[across], own, "friction_coefficient", capsize=0, label=label, **look)
        axes.set(xscale="log", yscale="log")
    _law(right, shifts, laws, colours, dict(zip(warmth.tolist(), cycle(style.SERIES_MARKERS))) | markers)
    left.set(xlabel="speed [m/s]", ylabel="friction coefficient [1]", title=f"as measured, {middling:.3g} N")
    middle.set(xlabel="speed times $a_T$ [m/s]", title="shifted")
    right.set(xlabel="temperature [K]", ylabel="decades of $a_T$ [1]", title="shifts")
    left.legend(loc="best", fontsize=style.tiny(), handlelength=1.0)
    low, high = left.get_xlim()
    if 10 < high / low < 100:  # too many ticks for a narrow panel, but for two decades and more
        left.set_xlim(np.sqrt(low * high) / 10, np.sqrt(low * high) * 10)
    middle.set_xlim(right=30 * points["reduced_speed"].max())
    style.decades(left, middle)
    left.yaxis.set_major_formatter(lambda value, _: f"{value:g}")
    lettered(panels)
    clear(drawing, panels)
    ends = points.loc[points.groupby("load")["reduced_speed"].idxmax()]
    for row in ends.itertuples():
        place = {"xytext": (4, 0), "textcoords": "offset points", "va": "center", "fontsize": style.tiny()}
        middle.annotate(f"{row.load:.3g} N", (row.reduced_speed, row.friction_coefficient), **place)
    return drawing


def _law(axes: Axes, shifts: DataFrame, laws: DataFrame, colours, markers) -> None:
    for name, own in laws.groupby("law", sort=False):
        look: dict[str, Any] = {"color": style.grey(0.45), "linestyle": LINES[name], "linewidth": style.width(0.8)}
        axes.plot(own["temperature"], own["log_time_shift"] / LOG10, label=name, **look)
    for at, own in shifts.groupby("temperature"):
        look = {"color": colours[at], "fmt": markers[at], "markersize": style.mark(0.9), "capsize": 0}
        intervals(axes, own["temperature"], own, "log_time_shift", 1 / LOG10, **look)
    if len(laws):
        axes.legend(loc="upper right", fontsize=style.tiny())


def _points(pooled: Pooled, shifts: TemperatureShifts) -> DataFrame:
    """Points at a few of the loads that most temperatures have."""
    frame = DataFrame(
        {
            "temperature": [each.temperature for each in pooled.points],
            "speed": [each.speed for each in pooled.points],
            "normal_force": [each.load for each in pooled.points],
            "friction_coefficient": [each.friction for each in pooled.points],
            "press": pooled.presses,
        }
    )
    by = dict(zip(shifts.temperatures.tolist(), shifts.shifts.value.tolist(), strict=True))
    frame.insert(2, "reduced_speed", frame["speed"] * np.exp(frame["temperature"].map(by)))
    errors = np.array([pooled.error(each) for each in pooled.points])
    width = errors * student(0.95, pooled.dof)
    frame["friction_coefficient_low"] = frame["friction_coefficient"] * np.exp(-width)
    frame["friction_coefficient_high"] = frame["friction_coefficient"] * np.exp(width)
    groups = frame.groupby("press")
    counts = groups["temperature"].nunique()
    chosen = _few(counts.index[counts == counts.max()].to_numpy(), LOADS)
    frame.insert(3, "load", groups["normal_force"].transform("mean"))
    return frame[frame["press"].isin(chosen)].drop(columns="press").sort_values(["load", "temperature", "speed"])


def shifts_table(shifts: TemperatureShifts) -> DataFrame:
    """Shift ln a_T of each temperature with its interval of 95 %."""
    return DataFrame({"temperature": shifts.temperatures, **shifts.shifts.columns("log_time_shift")})


def _laws(shifts: TemperatureShifts, law: ShiftLaw | None) -> DataFrame:
    """The laws that found shifts allow, on lines."""
    kelvins = np.linspace(shifts.temperatures[0], shifts.temperatures[-1], 101)
    names = () if law is None else law.allowed
    frames = [
        (name, at, shift)
        for name in names
        for at, shift in zip(kelvins, law.log_shift(kelvins, name), strict=True)
    ]
    return DataFrame(frames, columns=["law", "temperature", "log_time_shift"])


def _few(values: np.ndarray, most: int) -> np.ndarray:
    """As many values as are told apart, from the lowest to the highest."""
    return values[np.unique(np.linspace(0, len(values) - 1, min(most, len(values))).round().astype(int))]
