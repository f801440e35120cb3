"""Convergence: one contact answered along ladders of settings, its errors and costs as a Dataset."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from math import nan
from typing import Any, Self, cast

import numpy as np
import xarray
from pandas import DataFrame, concat, factorize

from scene import Scene, Solver

from ...comparison.curve import FAILED, SOLVED
from ...solving.task import Task
from ...solving.vocabulary import attributes
from .reference import Outcomes, Quantity, Reference
from .timed_solve import COSTS, OnGrid, TimedSolve

# Settings of a solver that tables tell, with what stands where it lacks them.
SETTINGS = {"points": nan, "tolerance": nan, "steps": nan, "precision": "", "extent": nan}
# Columns of the table of steps.
STEPS = (
    *("contact", "quantity", "solver", "ladder", "title", "label", "setting", "value", *SETTINGS),
    *("relative_error", "reference", "reference_error"),
    *("processor", "wall", "memory", "operator_applications", "status", "reason"),
)
_DIMENSIONS = {"MDR": "1D", "CorrectedMDR": "1D corrected", "BEM": "3D"}


def dimension(solver: str) -> str:
    """Dimension of a solver as findings have it; its name, of a model that did not come with the package."""
    return _DIMENSIONS.get(solver, solver)


@dataclass(frozen=True)
class Ladder:
    """Scene that is solved with one setting after another.

    label : as in a legend
    setting : what changes from step to step, for people
    values : of it, one a step
    """

    label: str
    setting: str
    values: tuple[float, ...]
    solves: tuple[TimedSolve, ...]

    @classmethod
    def of(cls, label: str, scene: Scene, solver: OnGrid, setting: str, values: Sequence) -> Self:
        """Steps that differ in one setting of the solver."""
        solvers = (replace(solver, **{setting: value}) for value in values)
        return cls(label, setting, tuple(values), tuple(TimedSolve.of(each, scene) for each in solvers))

    @classmethod
    def over(cls, label: str, setting: str, values: Sequence, solve: Callable[[Any], TimedSolve]) -> Self:
        """Steps that differ in anything. solve : function of a value"""
        return cls(label, setting, tuple(values), tuple(map(solve, values)))


@dataclass(frozen=True)
class Convergence:
    """A contact with the ladders that answer it, and what they are measured against.

    name : short, as in file names; title : for people
    """

    name: str
    title: str
    reference: Reference
    quantities: tuple[Quantity, ...]
    ladders: tuple[Ladder, ...]

    def beside(self, models: Sequence[Solver]) -> "Convergence":
        """The contact with other models: on a quarter of their points, half and all, or once without points."""
        if not models:
            return self
        scene, ladders = self.ladders[0].solves[0].scene, list(self.ladders)
        for each in models:
            points = getattr(each, "points", None)
            if points is None:
                ladders.append(Ladder(each.name, "settings", (1.0,), (TimedSolve.of(each, scene),)))
            else:
                few = [number for number in (points // 4, points // 2) if number]
                ladders.append(Ladder.of(each.name, scene, cast(OnGrid, each), "points", (*few, points)))
        return replace(self, ladders=tuple(ladders))

    @property
    def timed(self) -> list[Task]:
        """Solves that have to be measured alone."""
        return [solve for ladder in self.ladders for solve in ladder.solves]

    @property
    def untimed(self) -> list[Task]:
        """Tasks of the reference."""
        return list(self.reference.tasks)

    def datasets(self, outcomes: Outcomes) -> dict[str, xarray.Dataset]:
        """Errors (quantity, step) and costs (step,) of every step of every ladder, by the name of the contact."""
        known = self.reference.values(self.quantities, outcomes)
        quantities = [each for each in self.quantities if each.name in known]
        steps = [
            (ladder, value, solve)
            for ladder in self.ladders
            for value, solve in zip(ladder.values, ladder.solves, strict=True)
        ]
        solves = [solve for _, _, solve in steps]
        answers = [outcomes[solve] for solve in solves]
        errors = [
            [known[each.name].error_of(each.measured(answer.rows[0])) for answer in answers] for each in quantities
        ]
        by_quantity = {
            "quantity": [each.name for each in quantities],
            "label": [each.label for each in quantities],
            "reference_error": [known[each.name].relative_error for each in quantities],
        }
        by_step = {
            "step": list(range(len(steps))),
            "ladder": [ladder.label for ladder, _, _ in steps],
            "setting": [ladder.setting for ladder, _, _ in steps],
            "value": [float(value) for _, value, _ in steps],
            "solver": [solve.solver.name for solve in solves],
        }
        for name, absent in SETTINGS.items():
            held = [getattr(solve.solver, name, None) for solve in solves]
            by_step[name] = [absent if each is None else each for each in held]
        coordinates = {name: ("quantity", values) for name, values in by_quantity.items()}
        coordinates |= {name: ("step", values) for name, values in by_step.items()}
        about = {
            "contact": self.name,
            "title": self.title,
            "reference": self.reference.source,
            "reference_method": self.reference.method,
        }
        found = {"relative_error": (("quantity", "step"), errors), **costs_of(solves, outcomes)}
        dataset = xarray.Dataset(found, coordinates, about).reset_coords("reference_error")
        return {self.name: described(dataset, solves[0].scene)}


def costs_of(solves: Sequence[TimedSolve], outcomes: Outcomes, *more: str) -> dict[str, tuple[str, list]]:
    """Costs and status (step,) of some solves, as variables of a Dataset. more : other measures"""
    rows = [outcomes[solve].rows[0] for solve in solves]
    found: dict[str, list] = {
        "status": [SOLVED if row.reason is None else FAILED for row in rows],
        "reason": [row.reason or "" for row in rows],
        "operator_applications": [row.operator_applications for row in rows],
    }
    found |= {name: [row.measures.get(name, nan) for row in rows] for name in (*COSTS, "repeats", *more)}
    return {name: ("step", values) for name, values in found.items()}


def described(dataset: xarray.Dataset, scene: Scene) -> xarray.Dataset:
    """A Dataset with units and definitions of all its variables."""
    for label in dataset.variables:
        dataset[label].attrs = attributes(str(label), scene)
    return dataset


def steps_table(node: xarray.DataTree) -> DataFrame:
    """A row for each ladder, quantity and step of each contact; relative errors, times [s], memory [bytes]."""
    found = []
    for child in node.children.values():
        if child.data_vars:
            dataset = child.to_dataset(inherit=False)
            rows = dataset.assign(dataset.attrs).to_dataframe(["quantity", "step"]).reset_index()
            found.append(rows.iloc[np.argsort(factorize(rows["ladder"])[0], kind="stable")])
    return concat(found, ignore_index=True)[list(STEPS)] if found else DataFrame(columns=STEPS)
