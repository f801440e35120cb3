"""Moduli of the solid of a scene against the frequency, and what was measured of it."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from pandas import DataFrame

from scene import CreepTable, Scene, Table, Tabulated

from . import style
from .lettering import lettered
from .plot import Plot, Tables
from .prefixes import prefixed

NAME = "solid"
MEASURED, TIMES, MEASURED_TIMES = f"{NAME}-measured", f"{NAME}-times", f"{NAME}-times-measured"
PLACES = 400
ROOM = 30.0  # beyond the shortest and the longest time of the solid
ELASTIC = np.geomspace(1.0, 1e3, PLACES)  # angular frequencies [rad/s] for a solid without times
DECADES = 4.0  # of moduli below the one at rest that are shown
# Line, marker and name of each quantity.
LOOKS = {
    "storage": ("-", "o", "storage modulus $G'$"),
    "loss": ("--", "s", "loss modulus $G''$"),
    "modulus": ("-", "o", "relaxation modulus $G(t)$"),
    "compliance": ("-", "o", "creep compliance $J(t)$"),
}


def plot(scene: Scene) -> Plot:
    """The plot of the solid of a scene, at its temperature."""
    solid, tables = scene.solid, {}
    times = np.concatenate([solid.relaxation()[2], solid.retardation()[2]])
    omega = np.geomspace(1 / (ROOM * times.max()), ROOM / times.min(), PLACES) if len(times) else ELASTIC
    tables[NAME] = _moduli(omega, solid.complex_modulus(omega))
    shown = "Shear moduli of the solid"
    if isinstance(scene.elastomer, Tabulated):
        stated = scene.elastomer.at_reference(scene.temperature)
        place, numbers = stated.measured()
        longer = 1.0 if scene.temperature is None else scene.temperature.shift
        if isinstance(stated.table, Table):
            tables[MEASURED] = _moduli(place / longer, numbers)
        else:
            creeps = isinstance(stated.table, CreepTable)
            name, law = ("compliance", solid.creep_compliance) if creeps else ("modulus", solid.relaxation_modulus)
            time = np.geomspace(place[0], place[-1], PLACES) * longer
            tables[TIMES] = DataFrame({"time": time, name: law(time)})
            tables[MEASURED_TIMES] = DataFrame({"time": place * longer, name: numbers})
        shown += ": lines of the fit, a guess beyond the table, and points of the table"
    warm = "" if scene.temperature is None else f", at {scene.temperature.temperature:g} K"
    caption = f"{shown}{warm}. Right axis: Young's moduli, by its Poisson ratio of {solid.poisson_ratio:g}."
    alternative = "Storage and loss modulus as two curves against the angular frequency."
    return Plot(NAME, figure, tables, caption, alternative, {"stiffer": 2 * (1 + solid.poisson_ratio)})


def figure(tables: Tables, stiffer: float = 3.0) -> Figure:
    """(a) Storage and loss modulus. (b) The relaxation modulus or creep compliance, where that was measured.

    stiffer : Young's modulus over shear modulus
    """
    over_time = TIMES in tables
    drawing = style.canvas("double" if over_time else "single", 2.6)
    panels = drawing.subplots(1, 1 + over_time, squeeze=False)[0]
    up, unit = prefixed(tables[NAME]["storage"].iloc[0], "Pa")
    _curves(panels[0], tables[NAME], tables.get(MEASURED), up)
    panels[0].set(xlabel="angular frequency [rad/s]", ylabel=f"shear modulus [{unit}]")
    panels[0].set_ylim(bottom=max(panels[0].get_ylim()[0], up * tables[NAME]["storage"].iloc[0] * 10**-DECADES))
    right = panels[0].twinx()
    right.set_label("<right axis>")
    right.spines["right"].set_visible(True)
    limits = [stiffer * end for end in panels[0].get_ylim()]
    right.set(yscale="log", ylim=limits, ylabel=f"Young's modulus [{unit}]")
    style.decades(panels[0], right)
    if over_time:
        fit, measured = tables[TIMES], tables[MEASURED_TIMES]
        inverse = "compliance" in fit
        up, unit = prefixed(1 / measured["compliance"] if inverse else measured["modulus"], "Pa")
        _curves(panels[1], fit, measured, 1 / up if inverse else up)
        panels[1].set(xlabel="time [s]", ylabel=f"{fit.columns[1]} [{'1/' * inverse}{unit}]")
        style.decades(panels[1])
        panels[0].set_title("moduli of the fit")
        panels[1].set_title("as measured")
        lettered(panels)
    return drawing


def _curves(axes: Axes, fit: DataFrame, measured: DataFrame | None, up: float) -> None:
    """Lines of the fit and points of the table over its first column; what is zero is left out."""
    along = fit.columns[0]
    axes.set(xscale="log", yscale="log", xlim=fit[along].iloc[[0, -1]])
    for name in fit.columns[1:]:
        line, marker, label = LOOKS[name]
        if (fit[name] > 0).any():
            axes.plot(fit[along], up * fit[name], line, color=style.ink(), label=label)
        if measured is not None:
            filled = style.paper() if name == "loss" else style.ink()
            look = style.line(0.0, marker=marker, markersize=style.mark(0.8), markerfacecolor=filled)
            axes.plot(measured[along], up * measured[name], linestyle="", label="measured", **look)
    axes.legend()


def _moduli(omega, modulus):
    return DataFrame({"omega": omega, "storage": modulus.real, "loss": modulus.imag})
