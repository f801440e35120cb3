"""Friction at several temperatures, as one curve, and of contacts that heat themselves."""

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from compare.report.plots import style
from compare.report.plots.lettering import clear

NAME = "effect-temperature"
SOLVER = {"1D": "MDR", "3D": "BEM"}


def figure(data: Sequence[Mapping[str, object]]) -> Figure:
    """Friction at each temperature, and what heat makes of it.

    (a), (b) friction against speed, and against speed times a_T; (c) the rise of temperature that friction makes
    against that of the contact; (d) friction against speed, with and without heating.

    data : rows of panel ("temperature", "warmer", "speed"), dimension, temperature [K], speed [m/s], reduced_speed
        [m/s], feedback, friction [1], average_heating [K]
    """
    drawing = style.canvas("double", 4.8)
    (apart, together), (warmer, heated) = drawing.subplots(2, 2)
    _at_temperatures(apart, data, "speed")
    _at_temperatures(together, data, "reduced_speed")
    _steady(warmer, data)
    _over_speed(heated, data)
    apart.set(xlabel="speed [m/s]", title="(a)")
    together.set(xlabel=r"speed times $a_T$ [m/s]", title="(b)")
    together.legend(ncols=2, loc="lower right")
    warmer.set(xlabel="contact warmer by [K]", ylabel="rise made by friction [K]", title="(c)")
    heated.set(xlabel="speed [m/s]", title="(d)")
    for axes in (apart, together, heated):
        axes.set_ylabel(r"$\mu$ [1]")
    for axes in (apart, together, warmer, heated):
        axes.set(xscale="log", yscale="log")
        style.decades(axes)
    for axes in (warmer, heated):
        axes.legend()
    clear(drawing, drawing.axes)
    return drawing


def _chosen(data, panel, dimension, **others):
    wanted = {"panel": panel, "dimension": dimension, **others}
    return [row for row in data if all(row[name] == value for name, value in wanted.items())]


def _values(rows, *names):
    return (np.array([row[name] for row in rows], float) for name in names)


def _at_temperatures(axes: Axes, data, speed):
    temperatures = sorted({row["temperature"] for row in data if row["panel"] == "temperature"})
    for dimension, solver in SOLVER.items():
        shades = style.shades(solver, len(temperatures))
        for temperature, shade, marker in zip(temperatures, shades, style.SERIES_MARKERS, strict=False):
            x, mu = _values(_chosen(data, "temperature", dimension, temperature=temperature), speed, "friction")
            label = f"{dimension}, {temperature:g} K"
            axes.plot(
                x, mu, style.LINE[solver], color=shade, marker=marker, markersize=style.mark(0.75), label=label
            )


def _steady(axes: Axes, data):
    room = min(row["temperature"] for row in data if row["panel"] == "warmer")
    for dimension, solver in SOLVER.items():
        temperature, rise = _values(_chosen(data, "warmer", dimension), "temperature", "average_heating")
        shown = temperature > room
        axes.plot(
            temperature[shown] - room, rise[shown], style.LINE[solver], color=style.COLOUR[solver], label=dimension
        )
    low, high = axes.get_xlim()
    ends = np.array([max(low, 0.1), high])
    axes.plot(ends, ends, ":", color=style.grey(0.3), linewidth=style.width(0.8), label="steady")


def _over_speed(axes: Axes, data):
    for dimension, solver in SOLVER.items():
        for feedback, filled, said in (("", style.paper(), "not heated"), ("average", None, "heated")):
            speed, mu = _values(_chosen(data, "speed", dimension, feedback=feedback), "speed", "friction")
            colour = style.COLOUR[solver]
            axes.plot(
                speed,
                mu,
                ":" if not feedback else style.LINE[solver],
                color=colour,
                marker=style.MARKER[solver],
                markerfacecolor=filled or colour,
                label=f"{dimension}, {said}",
            )
