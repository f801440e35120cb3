"""Moduli of the solid of a scene against the frequency, and what was measured of it."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from pandas import DataFrame

from scene import CreepTable, Scene, Table, Tabulated

from ..report.page import Plot, Tables
from . import style
from .lettering import lettered
from .prefixes import prefixed

NAME = "solid"
MEASURED, TIMES, MEASURED_TIMES = f"{NAME}-measured", f"{NAME}-times", f"{NAME}-times-measured"
PLACES = 400
ROOM = 30.0  # beyond the shortest and the longest time of the solid
ELASTIC = np.geomspace(1.0, 1e3, PLACES)  # angular frequencies [rad/s] for a solid without times
DECADES = 4.0  # of moduli below the one at rest that are shown
PARTS = {"storage": ("-", "o", "storage modulus $G'$"), "loss": ("--", "s", "loss modulus $G''$")}
OVER_TIME = {"modulus": "relaxation modulus $G(t)$", "compliance": "creep compliance $J(t)$"}


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
    _frequencies(panels[0], tables[NAME], tables.get(MEASURED), stiffer)
    if over_time:
        _times(panels[1], tables[TIMES], tables[MEASURED_TIMES])
        panels[0].set_title("moduli of the fit")
        panels[1].set_title("as measured")
        lettered(panels)
    return drawing


def _frequencies(axes: Axes, table: DataFrame, measured: DataFrame | None, stiffer: float) -> None:
    """Panel of both moduli; a modulus that is zero is left out."""
    up, unit = prefixed(table["storage"].iloc[0], "Pa")
    for name, (line, marker, label) in PARTS.items():
        if (table[name] > 0).any():
            axes.plot(table["omega"], up * table[name], line, color=style.ink(), label=label)
        if measured is not None:
            filled = style.ink() if name == "storage" else style.paper()
            _points(axes, measured["omega"], up * measured[name], marker, filled)
    axes.set(xscale="log", yscale="log", xlabel="angular frequency [rad/s]", ylabel=f"shear modulus [{unit}]")
    axes.set_xlim(table["omega"].iloc[0], table["omega"].iloc[-1])
    axes.set_ylim(bottom=max(axes.get_ylim()[0], up * table["storage"].iloc[0] * 10**-DECADES))
    right = axes.twinx()
    right.set_label("<right axis>")
    right.spines["right"].set_visible(True)
    right.set(yscale="log", ylim=[stiffer * end for end in axes.get_ylim()], ylabel=f"Young's modulus [{unit}]")
    style.decades(axes, right)
    axes.legend()


def _times(axes: Axes, table: DataFrame, measured: DataFrame) -> None:
    """Panel of what was measured over time, and of the fit."""
    (name,) = table.columns.drop("time")
    up, unit = prefixed(measured[name] if name == "modulus" else 1 / measured[name], "Pa")
    if name == "compliance":
        up, unit = 1 / up, f"1/{unit}"
    axes.plot(table["time"], up * table[name], "-", color=style.ink(), label="fit")
    _points(axes, measured["time"], up * measured[name], "o", style.ink())
    axes.set(xscale="log", yscale="log", xlabel="time [s]", ylabel=f"{OVER_TIME[name]} [{unit}]")
    style.decades(axes)
    axes.legend()


def _points(axes: Axes, x, y, marker: str, filled: str) -> None:
    """Points of a table."""
    size = style.mark(0.8)
    axes.plot(
        x, y, marker, color=style.ink(), markersize=size, markerfacecolor=filled, label="measured", linestyle=""
    )


def _moduli(omega, modulus):
    return DataFrame({"omega": omega, "storage": modulus.real, "loss": modulus.imag})
