"""Figs. 5 to 7 of the paper in three dimensions: friction, shifted along the force, and the shifts."""

from dataclasses import replace

import xarray
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator, NullLocator
from pandas import DataFrame

from ...report.page import Plot, Tables
from ...report.plots import shifted_curves, style
from ...report.plots.shifted_curves import ShiftedCurves
from ...statistics import eq23
from ...statistics.collapse import collapse
from ...statistics.finding import Finding
from ...statistics.frictioncurves import SimulatedCurves
from .claims import CLAIMS
from .setup import HALF_SPACE, LOSSY, MAIN, SHIFT

NAME = "experiment"
ON_LAYER = 2  # rows of the figure, the first ones
CAPTION = """Friction against force; shifted along the force (dotted: F*), the one curve nearest to all (grey), and
how far off it; the shift (dashed: as the paper has it). Loss of power 0.1, modulus at contact 1.3 of that at rest.
Rough, nearly smooth: the spectra to whose friction the smooth ball adds least and most."""
WORDS = "Friction of the ball on the layer, rough and nearly smooth, and on a half-space, shifted along the force."


def plot(answers: xarray.DataTree, members: DataFrame) -> Plot:
    """Rows of the roughness whose share is greatest, on the layer and on a half-space, and of the least."""
    own = members[(members["curves"] == MAIN.title) & (members["solid"] == LOSSY)].reset_index(drop=True)
    steep, gentle = int(own["ball-light"].idxmin()), int(own["ball-light"].idxmax())
    shown = (
        ("layer, rough", MAIN, steep),
        ("layer, nearly smooth", MAIN, gentle),
        ("half-space, rough", HALF_SPACE, steep),
    )
    rows = [
        _row(title, answers["balls"].to_dataset().sel(pair=pair.title), spectrum)
        for title, pair, spectrum in shown
    ]
    found = shifted_curves.plot(rows, NAME)
    assert found is not None
    return replace(found, draw=draw, caption=CAPTION, alternative=WORDS, options={})


def draw(tables: Tables) -> Figure:
    """The figure, with F* where there is a layer."""
    drawing = shifted_curves.figure(tables, NAME)
    panels = [axes for axes in drawing.axes if axes.get_yscale() == "log"]
    for place, axes in enumerate(panels):
        axes.yaxis.set_major_locator(MaxNLocator(5))
        axes.yaxis.set_minor_locator(NullLocator())
        if place < 2 * ON_LAYER:
            axes.axvline(MAIN.crossover, linestyle=":", **style.line(0.3, 0.8))
    return drawing


def _row(title: str, dataset: xarray.Dataset, spectrum: int) -> ShiftedCurves:
    own = dataset.sel(solid=LOSSY).isel(spectrum=spectrum)
    friction = own["friction_of_shape"] + own["friction_of_roughness"]
    loads = own["load"].broadcast_like(friction).transpose("speed", "load")
    found = collapse(SimulatedCurves(own["speed"].values, loads.values, friction.values))
    findings = {each.claim.id: each for each in eq23.findings(found, None, "3D", every=True, horizontal=True)}
    judged = findings[eq23.COLLAPSE.id]
    findings[eq23.COLLAPSE.id] = Finding(CLAIMS["collapse"], judged.value, judged.scatter, 0.0)
    return ShiftedCurves(title, found, findings, SHIFT)
