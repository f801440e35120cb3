"""The models against the true answer of three dimensions: which model, which settings, how many surfaces."""

from collections.abc import Iterator
from math import isfinite, nan
from typing import Any

import numpy as np
import xarray
from pandas import DataFrame

from ...report.page import Plot, Table
from ...solving.amounts import share
from ...statistics.finding import HALVED, Claim, Finding
from ...statistics.sampling import cheapest
from . import regimes
from .answers import LEVELS, answers_table, cells, least_known, regimes_of, rough_means
from .convergence import DIMENSIONS, steps_table
from .diagram import Diagram, reported
from .ensemble import plans_table
from .figures import models as workprecision_models
from .figures import surfaces as workprecision_surfaces

# Wanted errors of which findings say what they take.
WANTED = (0.1, 0.01)
# What is asked for, each with a figure and a table of its own, and the quantities that answer it.
ASKED = {"friction": ("friction",), "depth or force": ("depth", "force")}


def _model_plots(node: xarray.DataTree) -> Iterator[Plot]:
    """A figure for each thing asked for."""
    smooth = steps_table(each.to_dataset(inherit=False) for each in node.children.values() if each.data_vars)
    for what, names in ASKED.items():
        own = [each for each in regimes_of(node) if each.quantity in names]
        rows = {
            "steps": smooth[smooth["quantity"].isin(names)],
            "plans": DataFrame(plans_table([each.mean for each in own if each.mean])),
            "answers": DataFrame(answers_table(own)),
        }
        name = f"workprecision-models-{what.split()[0]}"
        tables = {name.replace("models", f"models-{kind}"): each for kind, each in rows.items() if len(each)}
        if own:
            yield from workprecision_models.plots(name, tables)


def _model_tables(node: xarray.DataTree) -> Iterator[Table]:
    """Tables of the effort for wanted errors, in words."""
    for what, names in ASKED.items():
        rows = cells([each for each in regimes_of(node) if each.quantity in names])
        caption = f"To know {what}: model, settings, time."
        if rows:
            yield Table(f"workprecision-cells-{what.split()[0]}", DataFrame(rows), caption)


def _model_findings(node: xarray.DataTree) -> Iterator[Finding]:
    """Errors that 1D keeps, and times to wanted errors."""
    found = regimes_of(node)
    for level in WANTED:
        claim = Claim(
            f"workprecision.models.1d-within-{100 * level:g}-percent",
            f"One dimension keeps within {share(level)} of three, however fine its grid",
            0.0,
            level,
            "Answer of the 1D model on its finest grid less that of three dimensions, relative",
        )
        yield from (each.error_1d(claim) for each in found)
    for level in WANTED:
        id = f"models.time-{100 * level:g}-percent"
        sentence = f"Processor time to {share(level)} of the true answer"
        for each in found:
            taken = each.answer(level)
            if taken is None:
                yield reported(id, sentence, nan, each.where, "s", "1D/3D", missing=_missed(each.best()))
            else:
                yield reported(id, sentence, taken.seconds, each.where, "s", DIMENSIONS[taken.solver])


def _surface_findings(node: xarray.DataTree) -> Iterator[Finding]:
    """Findings on the scatter of surfaces, the error of a grid, and times to wanted errors."""
    for each in rough_means(node):
        first, where, grid = each.plain[0], each.where, each.grid_error
        scatter, bias = first.levels[0].scatter, first.bias
        why = "too few surfaces were solved"
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
            effort = cheapest(each.of("BEM"), level)
            id, sentence = f"surfaces.time-{100 * level:g}-percent", f"Processor time to {share(level)} in 3D"
            value = nan if effort is None else effort.seconds
            known = least_known(plan.certain for plan in each.of("BEM"))
            yield reported(id, sentence, value, where, "s", missing=_missed(known))


def _missed(known):
    return f"best known {share(known)}" if isfinite(known) else "not solved"


def _surface_plots(node: xarray.DataTree) -> Iterator[Plot]:
    """One figure, from plans to the mean and what they take."""
    found, name = rough_means(node), "workprecision-surfaces"
    tables = {name: DataFrame(plans_table(found)), f"{name}-recipes": DataFrame(_recipes(found))}
    if found:
        yield workprecision_surfaces.plot(name, tables, LEVELS)


def _recipes(found) -> Iterator[dict[str, Any]]:
    """A row for each wanted error and plan: surfaces of each level, and the time."""
    for each in found:
        for level in LEVELS:
            efforts = [(plan, plan.effort(level)) for plan in each.of("BEM")]
            times = [nan if effort is None else effort.seconds for _, effort in efforts]
            best = np.nanargmin(times) if np.isfinite(times).any() else None
            for k, (plan, effort) in enumerate(efforts):
                yield {
                    "contact": each.contact,
                    "quantity": each.quantity,
                    "wanted": level,
                    "plan": plan.label,
                    "first_surfaces": nan if effort is None else effort.counts[0],
                    "surfaces": "" if effort is None else " + ".join(str(count) for count in effort.counts),
                    "seconds": times[k],
                    "cheapest": k == best,
                    "grid_error": plan.bias.size,
                    "scatter": plan.levels[0].scatter.value,
                }


MODELS = Diagram(
    "models",
    "Which model for which error",
    "Both models against the true answer of three dimensions: one is fast and keeps the error of the model, "
    "the other is slow and converges. Smooth bodies have one answer; that of rough ones is the mean over "
    "surfaces, so that the scatter between surfaces counts beside the grid. Between them is 1D corrected by the "
    "trust map: it pays for the map once and keeps the error of the map. Of a smooth body the map solves both "
    "models, so that nothing is gained; off the map there is no answer.",
    lambda size: [*regimes.smooth(size), *regimes.rough(size)],
    _model_findings,
    _model_plots,
    _model_tables,
)
SURFACES = Diagram(
    "surfaces",
    "How many surfaces, on how many points",
    "A rough contact has the mean over surfaces as its answer. The error of a mean is that of the grid, "
    "however many surfaces are solved, and what their scatter leaves, however fine the grid.",
    lambda size: [each for each in regimes.rough(size) if each.name.endswith(("rest", "middle"))],
    _surface_findings,
    _surface_plots,
)
