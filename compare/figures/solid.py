"""Moduli of the solid of a scene against the frequency, and what was measured of it."""

import numpy as np
from matplotlib.figure import Figure
from pandas import DataFrame

from scene import Scene, Tabulated

from . import style
from .plot import Plot, Tables

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
        if not stated.table.over_time:
            tables[MEASURED] = _moduli(place / longer, numbers)
        else:
            creeps = stated.table.compliance is not None
            name, law = ("compliance", solid.creep_compliance) if creeps else ("modulus", solid.relaxation_modulus)
            time = np.geomspace(place[0], place[-1], PLACES) * longer
            tables[TIMES] = DataFrame({"time": time, name: law(time)})
            tables[MEASURED_TIMES] = DataFrame({"time": place * longer, name: numbers})
        shown += ": lines of the fit, a guess beyond the table, and points of the table"
    warm = "" if scene.temperature is None else f", at {scene.temperature.temperature:g} K"
    alternative = "Storage and loss modulus as two curves against the angular frequency."
    return Plot(NAME, figure, tables, f"{shown}{warm}.", alternative)


def figure(tables: Tables) -> Figure:
    """(a) Storage and loss modulus. (b) The relaxation modulus or creep compliance, where that was measured."""
    over_time = TIMES in tables
    drawing = style.canvas("double" if over_time else "single", 2.6)
    panels = drawing.subplots(1, 1 + over_time, squeeze=False)[0]
    for axes, lines, dots in zip(panels, (NAME, TIMES), (MEASURED, MEASURED_TIMES), strict=False):
        fit, measured = tables[lines].set_index(tables[lines].columns[0]), tables.get(dots, DataFrame())
        for name, (line, marker, label) in LOOKS.items():
            if name in fit and (fit[name] > 0).any():
                axes.plot(fit[name], line, color=style.ink(), label=label)
            if name in measured:
                look = {"markerfacecolor": style.paper() if name == "loss" else style.ink(), "label": "measured"}
                axes.plot(measured.iloc[:, 0], measured[name], marker, color=style.ink(), **look)
        label = "creep compliance [1/Pa]" if "compliance" in fit else "shear modulus [Pa]"
        axes.set(xscale="log", yscale="log", xlim=fit.index[[0, -1]], xlabel=ACROSS[fit.index.name])
        axes.set(ylabel=label, title="as measured" if lines == TIMES else "moduli")
        axes.set_ylim(bottom=max(axes.get_ylim()[0], fit.iloc[0, 0] * 10**-DECADES))
        axes.legend()
    style.decades(*panels)
    style.lettered(panels)
    return drawing


def _moduli(omega, modulus):
    return DataFrame({"omega": omega, "storage": modulus.real, "loss": modulus.imag})
