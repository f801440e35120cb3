"""Moduli of the solid of a scene against the frequency, and what was measured of it."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from pandas import DataFrame

from scene import CreepTable, Scene, Table, Tabulated

from . import style
from .plot import Plot, Tables
from .prefixes import prefixed

NAME = "solid"
MEASURED, TIMES, MEASURED_TIMES = f"{NAME}-measured", f"{NAME}-times", f"{NAME}-times-measured"
PLACES = 400
ROOM = 30.0  # beyond the shortest and the longest time of the solid
ELASTIC = np.geomspace(1.0, 1e3, PLACES)  # angular frequencies [rad/s] for a solid without times
DECADES = 4.0  # of moduli below the first that are shown
ACROSS = {"omega": "angular frequency [rad/s]", "time": "time [s]"}
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
    unit = _curves(panels[0], tables[NAME], tables.get(MEASURED))
    panels[0].set(ylabel=f"shear modulus [{unit}]", title="moduli")
    right = panels[0].secondary_yaxis("right", functions=(lambda of: stiffer * of, lambda of: of / stiffer))
    right.set_ylabel(f"Young's modulus [{unit}]")
    if over_time:
        unit = _curves(panels[1], tables[TIMES], tables[MEASURED_TIMES])
        panels[1].set(ylabel=f"{tables[TIMES].columns[1]} [{unit}]", title="as measured")
    style.decades(*panels)
    style.lettered(panels)
    return drawing


def _curves(axes: Axes, fit: DataFrame, measured: DataFrame | None) -> str:
    """Lines of the fit and points of the table over its first column, without what is zero; returns their unit."""
    along, first = fit.columns[:2]
    start = fit[first].iloc[0]
    up, unit = prefixed(1 / start if first == "compliance" else start, "Pa")
    if first == "compliance":
        up, unit = 1 / up, f"1/{unit}"
    axes.set(xscale="log", yscale="log", xlim=fit[along].iloc[[0, -1]], xlabel=ACROSS[along])
    for name in fit.columns[1:]:
        line, marker, label = LOOKS[name]
        if (fit[name] > 0).any():
            axes.plot(fit[along], up * fit[name], line, color=style.ink(), label=label)
        if measured is not None:
            inside = style.paper() if name == "loss" else style.ink()
            look: dict[str, Any] = {"color": style.ink(), "markerfacecolor": inside, "label": "measured"}
            axes.plot(measured[along], up * measured[name], marker, **look)
    axes.set_ylim(bottom=max(axes.get_ylim()[0], up * start * 10**-DECADES))
    axes.legend()
    return unit


def _moduli(omega, modulus):
    return DataFrame({"omega": omega, "storage": modulus.real, "loss": modulus.imag})
