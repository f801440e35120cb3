"""Figs. 5 to 7 of the paper in three dimensions: friction at the speeds, shifted along the force, and the shifts."""

import numpy as np
import xarray
from matplotlib.figure import Figure
from pandas import DataFrame

from ...report.page import Plot, Tables
from ...report.plots import shifted_curves, style
from ...report.plots.shifted_curves import ShiftedCurves
from ...statistics import eq23
from ...statistics.collapse import collapse
from ...statistics.finding import Finding
from ...statistics.frictioncurves import SimulatedCurves
from .setup import HALF_SPACE, MAIN, POWER, crossover

NAME = "experiment"
SOLID = "power law, 0.3 at contact"


def plot(answers: xarray.DataTree, members: DataFrame) -> Plot:
    """Rows of the roughness whose share is greatest, on the layer and on a half-space, and of the least."""
    own = members[(members["curves"] == MAIN.title) & (members["solid"] == SOLID)].reset_index(drop=True)
    steep, gentle = int(own["ball-light"].idxmin()), int(own["ball-light"].idxmax())
    shown = ((MAIN, steep, "rough"), (MAIN, gentle, "nearly smooth"), (HALF_SPACE, steep, "rough"))
    found = shifted_curves.plot([_row(answers[pair.title].to_dataset(), pair, *each) for pair, *each in shown], NAME)
    return Plot(
        NAME,
        draw,
        found.tables,
        "Friction against force at five speeds; shifted along the force to one curve, dotted: F* where the contact "
        "is as wide as the layer is thick; the shift. Solid with a loss of power 0.1, its modulus at contact 1.3 of "
        "that at rest. Dashed: power of the paper.",
        "Friction of the ball on the layer, rough and nearly smooth, and on a half-space, shifted along the force.",
    )


def draw(tables: Tables) -> Figure:
    """The figure, with F* where there is a layer."""
    drawing = shifted_curves.figure(tables, NAME)
    for panels in (drawing.axes[:3], drawing.axes[3:6]):
        for axes in panels[:2]:
            axes.axvline(crossover(MAIN.radius, MAIN.thickness), linestyle=":", **style.line(0.3, 0.8))
    return drawing


def _row(dataset, pair, spectrum, how):
    own = dataset.sel(solid=SOLID).isel(spectrum=spectrum)
    load = own["normal_force"].values
    friction = own["friction_of_shape"].values + own["friction_of_roughness"].values
    found = collapse(SimulatedCurves(own["speed"].values, load, friction))
    missed = found.horizontal.misfit.value
    finding = Finding(eq23.COLLAPSE, missed, (missed, missed), 0.0)
    return ShiftedCurves(f"{pair.title}, {how}", found, finding, -1.5 * POWER)
