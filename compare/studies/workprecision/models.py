"""Both models against the true answer of three dimensions: which model, which settings, how many surfaces."""

from collections.abc import Callable, Iterator, Sequence
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
from ...task import Task
from . import regimes
from .answers import LEVELS, Regime, RoughRegime, SmoothRegime, answers_table, cells, regimes_of
from .convergence import DIMENSIONS, Convergence, steps_table
from .diagram import reported
from .ensemble import Ensemble, plans_table
from .reference import Outcomes

# Wanted errors of which findings say what they take.
WANTED = (0.1, 0.01)
# What is asked for, each with a figure and a table of its own, and the quantities that answer it.
ASKED = {"friction": ("friction",), "depth or force": ("depth", "force")}


@dataclass(frozen=True)
class ModelDiagram:
    """Regimes that both models answer.

    contacts : at a size
    of_models : whether models are compared, or numbers of surfaces with points in 3D alone
    """

    name: str
    title: str
    about: str
    contacts: Callable[[str], Sequence[Convergence | Ensemble]]
    of_models: bool = True

    def untimed(self, size: str) -> list[Task]:
        """References, and every surface and profile."""
        return list(dict.fromkeys(task for each in self.contacts(size) for task in each.untimed))

    def timed(self, size: str) -> list[Task]:
        """Solves that are measured alone, each once."""
        return list(dict.fromkeys(task for each in self.contacts(size) for task in each.timed))

    def datasets(self, size: str, outcomes: Outcomes) -> dict[str, xarray.Dataset]:
        """A Dataset a smooth contact, and one for each solver of a rough one."""
        return {name: dataset for each in self.contacts(size) for name, dataset in each.datasets(outcomes).items()}

    def findings(self, node: xarray.DataTree) -> list[Finding]:
        """Errors that 1D keeps and times to wanted errors; of surfaces, what scatters and what a grid leaves."""
        found = regimes_of(node)
        return list(_model_findings(found) if self.of_models else _surface_findings(_rough(found)))

    def plots(self, node: xarray.DataTree) -> list[Plot]:
        """A figure for each thing asked for; of surfaces, one."""
        found = regimes_of(node)
        if not self.of_models:
            name, rough = "workprecision-surfaces", _rough(found)
            rows = {name: plans_table([each.mean for each in rough]), f"{name}-recipes": list(_recipes(rough))}
            tables = {key: DataFrame(each) for key, each in rows.items()}
            return [workprecision_surfaces.plot(name, tables, LEVELS)] if rough else []
        return [
            workprecision_models.plot(f"workprecision-models-{what.split()[0]}", tables)
            for what, names in ASKED.items()
            if (tables := self._tables(what.split()[0], [each for each in found if each.quantity in names]))
        ]

    def tables(self, node: xarray.DataTree) -> list[Block]:
        """What wanted errors take, in words."""
        found = regimes_of(node) if self.of_models else []
        return [
            Table(
                f"workprecision-cells-{what.split()[0]}",
                DataFrame(rows),
                f"To know {what}: model, settings, time.",
            )
            for what, names in ASKED.items()
            if (rows := cells([each for each in found if each.quantity in names]))
        ]

    def _tables(self, suffix, found):
        rows = {
            "steps": steps_table(
                [each for regime in found if isinstance(regime, SmoothRegime) for each in regime.ladders]
            ),
            "plans": plans_table([regime.mean for regime in _rough(found)]),
            "answers": answers_table(found),
        }
        return {f"workprecision-models-{name}-{suffix}": DataFrame(each) for name, each in rows.items() if each}


def _rough(found: Sequence[Regime]) -> list[RoughRegime]:
    return [each for each in found if isinstance(each, RoughRegime)]


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
            taken, known = each.answer(level), each.best()
            where = f"{each.title}: {each.label}"
            if taken is None:
                why = f"best known {share(known)}" if isfinite(known) else "not solved"
                yield reported(id, sentence, nan, where, "s", "1D/3D", reason=why)
            else:
                yield reported(id, sentence, taken.seconds, where, "s", DIMENSIONS[taken.solver])


def _surface_findings(found: Sequence[RoughRegime]) -> Iterator[Finding]:
    for each in found:
        first, where = each.mean.plain[0], f"{each.title}: {each.label}"
        scatter, bias, grid = first.levels[0].scatter, first.bias, each.mean.discretisation
        why = "" if isfinite(scatter.value) else "too few surfaces were solved"
        yield reported(
            "surfaces.scatter", "Scatter of one surface", scatter.value, where,
            scatter=scatter.interval(), grid=0.0, draws=scatter.freedom + 1, reason=why,
        )  # fmt: skip
        half = bias.reach - grid
        yield reported(
            "surfaces.coarsest-grid", f"Error that the coarsest grid leaves ({first.label} points)", bias.value,
            where, scatter=(bias.value - half, bias.value + half), grid=grid, grid_method=HALVED, reason=why,
        )  # fmt: skip
        worth = (scatter.value / bias.size) ** 2 if bias.size > 0 else nan
        yield reported(
            "surfaces.fewest", "Surfaces from which on more points gain something", float(np.ceil(worth)), where,
            reason=why,
        )  # fmt: skip
        for level in WANTED:
            effort, known = each.effort(level, "BEM"), each.best("BEM")
            missed = f"best known {share(known)}" if isfinite(known) else "not solved"
            id, sentence = f"surfaces.time-{100 * level:g}-percent", f"Processor time to {share(level)} in 3D"
            value = nan if effort is None else effort.seconds
            yield reported(id, sentence, value, where, "s", reason="" if effort else missed)


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
SURFACES = ModelDiagram(
    "surfaces",
    "How many surfaces, on how many points",
    "A rough contact has the mean over surfaces as its answer. The error of a mean is what the grid leaves, "
    "however many surfaces are solved, and what their scatter leaves, however fine the grid.",
    lambda size: [each for each in regimes.rough(size) if each.name.endswith(("rest", "middle"))],
    of_models=False,
)
