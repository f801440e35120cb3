"""Both models against the true answer of three dimensions: which model, which settings, how many surfaces."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import isfinite, nan
from typing import Any

import numpy as np
import xarray
from pandas import DataFrame

from ...amounts import share
from ...finding import HALVED, Claim, Finding
from ...page import Block, Plot, Table
from ...plots import workprecision_models, workprecision_surfaces
from . import regimes
from .answers import LEVELS, Regime, RoughRegime, answers_table, cells, rough_regimes, smooth_regimes
from .convergence import DIMENSIONS, steps_table
from .diagram import Diagram, reported
from .ensemble import plans_table

# Wanted errors of which findings say what they take.
WANTED = (0.1, 0.01)
# What is asked for, each with a figure and a table of its own, and the quantities that answer it.
ASKED = {"friction": ("friction",), "depth or force": ("depth", "force")}


@dataclass(frozen=True)
class ModelDiagram(Diagram):
    """Both models in regimes of smooth and of rough bodies."""

    def findings(self, node: xarray.DataTree) -> list[Finding]:
        """Errors that 1D keeps, and times to wanted errors."""
        return list(_model_findings(_regimes(node)))

    def plots(self, node: xarray.DataTree) -> list[Plot]:
        """A figure for each thing asked for."""
        found = []
        smooth = steps_table(each.to_dataset(inherit=False) for each in node.children.values() if each.data_vars)
        for what, names in ASKED.items():
            own = [each for each in _regimes(node) if each.quantity in names]
            rows = {
                "steps": smooth[smooth["quantity"].isin(names)],
                "plans": DataFrame(plans_table([each.mean for each in own if isinstance(each, RoughRegime)])),
                "answers": DataFrame(answers_table(own)),
            }
            name = f"workprecision-models-{what.split()[0]}"
            tables = {name.replace("models", f"models-{kind}"): each for kind, each in rows.items() if len(each)}
            found += [workprecision_models.plot(name, tables)] if own else []
        return found

    def tables(self, node: xarray.DataTree) -> list[Block]:
        """What wanted errors take, in words."""
        found = {
            what: cells([each for each in _regimes(node) if each.quantity in names])
            for what, names in ASKED.items()
        }
        return [
            Table(
                f"workprecision-cells-{what.split()[0]}",
                DataFrame(rows),
                f"To know {what}: model, settings, time.",
            )
            for what, rows in found.items()
            if rows
        ]


@dataclass(frozen=True)
class SurfaceDiagram(Diagram):
    """Numbers of surfaces with points in 3D."""

    def findings(self, node: xarray.DataTree) -> list[Finding]:
        """What scatters between surfaces, what a grid leaves, and times to wanted errors."""
        return list(_surface_findings(rough_regimes(node)))

    def plots(self, node: xarray.DataTree) -> list[Plot]:
        """One figure, from plans to the mean and what they take."""
        found, name = rough_regimes(node), f"workprecision-{self.name}"
        rows = {name: plans_table([each.mean for each in found]), f"{name}-recipes": list(_recipes(found))}
        tables = {key: DataFrame(each) for key, each in rows.items()}
        return [workprecision_surfaces.plot(name, tables, LEVELS)] if found else []

    def tables(self, node: xarray.DataTree) -> list[Block]:
        """Nothing that the figure does not say."""
        return []


def _regimes(node) -> list[Regime]:
    return [*smooth_regimes(node), *rough_regimes(node)]


def _model_findings(found: Sequence[Regime]) -> Iterator[Finding]:
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
        id, sentence = (
            f"models.time-{100 * level:g}-percent",
            f"Processor time to {share(level)} of the true answer",
        )
        for each in found:
            taken = each.answer(level)
            if taken is None:
                yield reported(id, sentence, nan, each.where, "s", "1D/3D", missing=_missed(each.best()))
            else:
                yield reported(id, sentence, taken.seconds, each.where, "s", DIMENSIONS[taken.solver])


def _surface_findings(found: Sequence[RoughRegime]) -> Iterator[Finding]:
    for each in found:
        first, where = each.mean.plain[0], each.where
        scatter, bias, grid = first.levels[0].scatter, first.bias, each.mean.grid_error
        why = "too few surfaces were solved"
        yield reported(
            "surfaces.scatter", "Scatter of one surface", scatter.value, where,
            scatter=scatter.interval(), grid=0.0, draws=scatter.freedom + 1, missing=why,
        )  # fmt: skip
        half = bias.reach - grid
        yield reported(
            "surfaces.coarsest-grid", f"Error that the coarsest grid leaves ({first.label} points)", bias.value,
            where, scatter=(bias.value - half, bias.value + half), grid=grid, grid_method=HALVED, missing=why,
        )  # fmt: skip
        worth = (scatter.value / bias.size) ** 2 if bias.size > 0 else nan
        yield reported(
            "surfaces.fewest", "Surfaces from which on more points gain something", float(np.ceil(worth)), where,
            missing=why,
        )  # fmt: skip
        for level in WANTED:
            effort = each.effort(level, "BEM")
            id, sentence = f"surfaces.time-{100 * level:g}-percent", f"Processor time to {share(level)} in 3D"
            value = nan if effort is None else effort.seconds
            yield reported(id, sentence, value, where, "s", missing=_missed(each.best("BEM")))


def _missed(known):
    return f"best known {share(known)}" if isfinite(known) else "not solved"


def _recipes(found: Sequence[RoughRegime]) -> Iterator[dict[str, Any]]:
    """A row for each wanted error and plan: surfaces of each level, and the time."""
    for each in found:
        for level in LEVELS:
            best = each.effort(level, "BEM")
            for plan in each.mean.of("BEM"):
                effort = plan.reaching(level)
                yield {
                    "contact": each.mean.contact,
                    "quantity": each.quantity,
                    "wanted": level,
                    "plan": plan.label,
                    "first_surfaces": nan if effort is None else effort.counts[0],
                    "surfaces": "" if effort is None else " + ".join(str(count) for count in effort.counts),
                    "seconds": nan if effort is None else effort.seconds,
                    "cheapest": best is not None and best.plan is plan,
                    "grid_error": plan.bias.size,
                    "scatter": plan.levels[0].scatter.value,
                }


MODELS = ModelDiagram(
    "models",
    "Which model for which error",
    "Both models against the true answer of three dimensions: one is fast and keeps the error of the model, "
    "the other is slow and converges. Smooth bodies have one answer; that of rough ones is the mean over "
    "surfaces, so that the scatter between surfaces counts beside the grid.",
    lambda size: [*regimes.smooth(size), *regimes.rough(size)],
)
SURFACES = SurfaceDiagram(
    "surfaces",
    "How many surfaces, on how many points",
    "A rough contact has the mean over surfaces as its answer. The error of a mean is what the grid leaves, "
    "however many surfaces are solved, and what their scatter leaves, however fine the grid.",
    lambda size: [each for each in regimes.rough(size) if each.name.endswith(("rest", "middle"))],
)
