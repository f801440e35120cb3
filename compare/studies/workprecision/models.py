"""The models against the true answer of three dimensions: which model, which settings, how many surfaces."""

from collections.abc import Iterator, Sequence
from math import nan

import numpy as np
import xarray
from pandas import DataFrame

from ...report.page import Plot, Table
from ...solving.words import share
from ...statistics.finding import HALVED, Claim, Finding
from . import regimes
from .answers import Regime, answers_table, cells, regimes_of
from .convergence import dimension, steps_table
from .diagram import Diagram, Judged, reported
from .ensemble import plans_table
from .figures import models as figures

# Wanted errors of which findings say what they take.
WANTED = (0.1, 0.01)
# What is asked for, each with a figure and a table of its own, and the quantities that answer it.
ASKED = {"friction": ("friction",), "depth or force": ("depth", "force")}


def _judged_models(node: xarray.DataTree) -> Judged:
    """Errors that 1D keeps and times to wanted errors; a table and figures for each thing asked for."""
    found, smooth = regimes_of(node), steps_table(node)
    tables: list[Table] = []
    plots: list[Plot] = []
    for what, names in ASKED.items():
        own = [each for each in found if each.quantity in names]
        if own:
            name = what.split()[0]
            caption = f"To know {what}: model, settings, time."
            tables.append(Table(f"workprecision-cells-{name}", DataFrame(cells(own)), caption))
            rows = {
                "steps": smooth[smooth["quantity"].isin(names)],
                "plans": DataFrame(plans_table([each.mean for each in own if each.mean])),
                "answers": DataFrame(answers_table(own)),
            }
            drawn = {f"workprecision-models-{kind}-{name}": each for kind, each in rows.items() if len(each)}
            plots += figures.plots(f"workprecision-models-{name}", drawn)
    return Judged([*_kept(found), *_times(found)], tables, plots)


def _kept(found: Sequence[Regime]) -> Iterator[Finding]:
    for level in WANTED:
        claim = Claim(
            f"workprecision.models.1d-within-{100 * level:g}-percent",
            f"One dimension keeps within {share(level)} of three, however fine its grid",
            0.0,
            level,
            "Answer of the 1D model on its finest grid less that of three dimensions, relative",
        )
        yield from (each.error_1d(claim) for each in found)


def _times(found: Sequence[Regime]) -> Iterator[Finding]:
    for level in WANTED:
        id = f"models.time-{100 * level:g}-percent"
        sentence = f"Processor time to {share(level)} of the true answer"
        for each in found:
            taken = each.answer(level)
            of = "1D/3D" if taken is None else dimension(taken.solver)
            yield reported(id, sentence, each.seconds(level), each.where, "s", of, each.missed())


def _judged_surfaces(node: xarray.DataTree) -> Judged:
    """The cheapest plan to each wanted error in words, and the numbers of all plans."""
    found = regimes_of(node)
    if not found:
        return Judged()
    caption = "Surfaces, points and time of the cheapest plan in 3D to each error expected of a mean."
    plans = DataFrame(plans_table([each.mean for each in found if each.mean]))
    tables = (
        Table("workprecision-cells-surfaces", DataFrame(cells(found, "BEM")), caption),
        Table("workprecision-surfaces", plans, "What grid and scatter leave by every plan.", long=True),
    )
    return Judged(list(_surface_findings(found)), tables)


def _surface_findings(found: Sequence[Regime]) -> Iterator[Finding]:
    """Findings on the scatter of surfaces, the error of a grid, and times to wanted errors."""
    why = "too few surfaces were solved"
    for each in found:
        mean, where = each.mean, each.where
        first, grid = mean.plain[0], mean.grid_error
        scatter, bias = first.levels[0].scatter, first.bias
        yield reported(
            "surfaces.scatter", "Scatter of one surface", scatter.value, where,
            scatter=scatter.interval(), grid=0.0, draws=scatter.dof + 1, missing=why,
        )  # fmt: skip
        yield reported(
            "surfaces.coarsest-grid", f"Error that the coarsest grid leaves ({first.label} points)", bias.value,
            where, scatter=(bias.low + grid, bias.high - grid), grid=grid, grid_method=HALVED, missing=why,
        )  # fmt: skip
        worth = (scatter.value / bias.size) ** 2 if bias.size > 0 else nan
        yield reported(
            "surfaces.fewest", "Surfaces from which on more points gain something", float(np.ceil(worth)), where,
            missing=why,
        )  # fmt: skip
        for level in WANTED:
            id, sentence = f"surfaces.time-{100 * level:g}-percent", f"Processor time to {share(level)} in 3D"
            yield reported(id, sentence, each.seconds(level, "BEM"), where, "s", missing=each.missed("BEM"))


MODELS = Diagram("models", lambda size: [*regimes.smooth(size), *regimes.rough(size)], _judged_models)
SURFACES = Diagram(
    "surfaces",
    lambda size: [each for each in regimes.rough(size) if each.name.endswith(("rest", "middle"))],
    _judged_surfaces,
)
