"""Friction against speed at several temperatures, shifted along the speed onto a curve a load; the shifts."""

import numpy as np
from matplotlib.figure import Figure
from pandas import DataFrame

from . import shades, style
from .curves import curves, limit
from .plot import Plot, Tables
from .shades import few

NAME = "temperature-shifts"
SHIFTS = f"{NAME}-shifts"
LOG10 = np.log(10)
# Most that are drawn, from the lowest to the highest.
TEMPERATURES, LOADS = len(style.SERIES_MARKERS), 3


def plot(points: DataFrame, shifts: DataFrame, how: str) -> Plot:
    """Plot of points at several temperatures, and of their shifts.

    points : temperature [K], speed [m/s], reduced_speed (times a_T), load [N] that tells the curves apart,
        friction_coefficient, friction_coefficient_low and friction_coefficient_high
    shifts : temperature, log_time_shift (ln a_T), log_time_shift_low and log_time_shift_high
    how : where a_T is from: "found" or "stated"
    """
    caption = (
        f"Friction against speed at one load, a marker for each of at most {TEMPERATURES} temperatures; at up to "
        f"{LOADS} loads against the speed times a_T, which is {how}; the decades of a_T. Bars: 95 %."
    )
    alternative = "Friction at several temperatures, shifted onto a curve for each load."
    return Plot(NAME, figure, {NAME: points, SHIFTS: shifts}, caption, alternative)


def figure(tables: Tables) -> Figure:
    """Left: as measured, at one load. Middle: shifted along the speed. Right: the shifts."""
    points, shifts = (tables[name] for name in (NAME, SHIFTS))
    drawing = style.canvas("double", 2.9)
    left, middle, right = drawing.subplots(1, 3)
    middle.sharey(left)
    warmth = few(shifts["temperature"], TEMPERATURES)
    forms = dict(zip(warmth, zip(style.SERIES_MARKERS, style.SERIES_LINES, strict=True), strict=False))
    scale = shades.between(warmth)
    points = points[points["temperature"].isin(warmth)]
    counts = points.groupby("load")["temperature"].nunique()
    loads = few(counts.index[counts == counts.max()], LOADS)
    middling = loads[loads.size // 2]
    points = points[points["load"].isin(loads)]

    def look(temperature, *_):
        (marker, line), label = forms[temperature], f"{temperature:.4g} K"
        return {"marker": marker, "linestyle": line, "color": shades.SPEED(scale(temperature)), "label": label}

    for axes, own, across in (
        (left, points[points["load"] == middling], "speed"),
        (middle, points, "reduced_speed"),
    ):
        curves(axes, own, across, "friction_coefficient", by=("temperature", "load"), look=look)
    for load, own in points.groupby("load"):
        end = own.loc[own["reduced_speed"].idxmax(), ["reduced_speed", "friction_coefficient"]]
        place = {"textcoords": "offset points", "va": "center", "fontsize": style.small()}
        middle.annotate(f"{load:.3g} N", end, (4, 0), **place)
    shifts = shifts[shifts["temperature"].isin(warmth)]
    curves(right, shifts, "temperature", "log_time_shift", 1 / LOG10, ("temperature",), look)
    left.set(xlabel="speed [m/s]", ylabel="friction coefficient [1]", title=f"as measured, {middling:.3g} N")
    middle.set(xlabel="speed times $a_T$ [m/s]", title="shifted")
    right.set(xlabel="temperature [K]", ylabel="decades of $a_T$ [1]", title="shifts")
    for axes in (left, middle):
        axes.set(xscale="log", yscale="log")
    low, high = left.get_xlim()
    between = np.sqrt(low * high)  # two decades at least: within less there are too many ticks for a narrow panel
    left.set_xlim(min(low, between / 10), max(high, 10 * between))
    middle.set_xlim(right=30 * points["reduced_speed"].max())
    limit(left, points, "friction_coefficient")
    style.finish(drawing, 5)
    return drawing
