"""Convergence: one contact answered along ladders of settings, its errors and costs as a Dataset."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from math import nan
from typing import Any, Self

import numpy as np
import xarray
from pandas import DataFrame, concat, factorize

from bem3d import BEM
from scene import Scene

from ...solving.parameter_grid import FAILED, SOLVED
from ...solving.task import Task
from ...solving.vocabulary import attributes
from ...statistics.convergence import MeasuredLadder
from .reference import Outcomes, Quantity, Reference
from .timed_solve import COSTS, OnGrid, TimedSolve

# Settings of a solver that tables tell, with what stands where it lacks them.
SETTINGS = {"points": nan, "tolerance": nan, "steps": nan, "precision": "", "extent": nan}
# Columns of the table of steps.
STEPS = (
    *("contact", "quantity", "solver", "ladder", "title", "label", "estimate", "setting", "value", *SETTINGS),
    *("relative_error", "reference", "reference_error"),
    *("processor", "wall", "memory", "operator_applications", "status", "reason"),
)
DIMENSIONS = {"MDR": "1D", "CorrectedMDR": "1D corrected", "BEM": "3D"}


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
    def of(cls, label: str, scene: Scene, solver: OnGrid, setting: str, values: Sequence, **others: Any) -> Self:
        """Steps that differ in one setting of the solver. others : of the solves, see TimedSolve"""

        def solve(value):
            return TimedSolve.of(replace(solver, **{setting: value}), scene, **others)

        return cls.over(label, setting, values, solve)

    @classmethod
    def over(cls, label: str, setting: str, values: Sequence, solve: Callable[[Any], TimedSolve]) -> Self:
        """Steps that differ in anything. solve : function of a value"""
        return cls(label, setting, tuple(values), tuple(map(solve, values)))


def points_and_tolerances(
    scene: Scene, tight: BEM, points: Sequence[int], grid: int, tolerances: Sequence[float], **others: Any
) -> tuple[Ladder, ...]:
    """Ladders of BEM: points at a tight tolerance, tolerances on one grid. others : see TimedSolve"""
    return (
        Ladder.of("BEM, by points", scene, tight, "points", points, **others),
        Ladder.of(f"BEM, by tolerance at {grid}²", scene, BEM(points=grid), "tolerance", tolerances, **others),
    )


@dataclass(frozen=True)
class Convergence:
    """A contact with the ladders that answer it, and what they are measured against.

    name : short, as in file names; title : for people
    orders : of the errors expected in the number of points, by the quantity's name
    """

    name: str
    title: str
    reference: Reference
    quantities: tuple[Quantity, ...]
    ladders: tuple[Ladder, ...]
    orders: Mapping[str, float] | None = None

    @property
    def timed(self) -> list[Task]:
        """Solves that have to be measured alone."""
        return list(dict.fromkeys(solve for ladder in self.ladders for solve in ladder.solves))

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
        orders = self.orders or {}
        found = {
            "relative_error": (
                ("quantity", "step"),
                [[_error(each, known[each.name], answer) for answer in answers] for each in quantities],
            ),
            "reference_error": ("quantity", [known[each.name].relative_error for each in quantities]),
            **costs_of(solves, outcomes),
        }
        coordinates = {
            "quantity": ("quantity", [each.name for each in quantities]),
            "label": ("quantity", [each.label for each in quantities]),
            "estimate": ("quantity", [each.by for each in quantities]),
            "expected_order": ("quantity", [orders.get(each.name, nan) for each in quantities]),
            "step": ("step", list(range(len(steps)))),
            "ladder": ("step", [ladder.label for ladder, _, _ in steps]),
            "setting": ("step", [ladder.setting for ladder, _, _ in steps]),
            "value": ("step", [float(value) for _, value, _ in steps]),
            "solver": ("step", [solve.solver.name for solve in solves]),
            **settings_of(solves, SETTINGS),
        }
        about = {
            "contact": self.name,
            "title": self.title,
            "reference": self.reference.source,
            "reference_method": self.reference.method,
        }
        return {self.name: described(xarray.Dataset(found, coordinates, about), solves[0].scene)}


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


def settings_of(solves: Sequence[TimedSolve], absent: Mapping[str, Any]) -> dict[str, tuple[str, list]]:
    """Settings (step,) of some solves by name. absent : what stands where a solver lacks them"""
    taken = {name: [getattr(solve.solver, name, None) for solve in solves] for name in absent}
    return {name: ("step", [absent[name] if v is None else v for v in own]) for name, own in taken.items()}


def described(dataset: xarray.Dataset, scene: Scene) -> xarray.Dataset:
    """A Dataset with units and definitions of all its variables."""
    for label in dataset.variables:
        dataset[label].attrs = attributes(str(label), scene)
    return dataset


def _error(quantity, known, answer):
    row = answer.rows[0]
    return nan if row.reason is not None else known.error_of(quantity.of(row, answer.fields))


def steps_table(datasets: Iterable[xarray.Dataset]) -> DataFrame:
    """A row for each ladder, quantity and step of each contact; relative errors, times [s], memory [bytes]."""
    found = []
    for dataset in datasets:
        rows = dataset.assign(dataset.attrs).to_dataframe(["quantity", "step"]).reset_index()
        found.append(rows.iloc[np.argsort(factorize(rows["ladder"])[0], kind="stable")])
    return concat(found, ignore_index=True)[list(STEPS)] if found else DataFrame(columns=STEPS)


def orders_table(found: Sequence[MeasuredLadder]) -> DataFrame:
    """A row for each ladder and quantity; NaN where too few steps show an error of their own."""
    return DataFrame(
        [
            {
                "contact": each.contact,
                "quantity": each.quantity,
                "solver": each.solver,
                "ladder": each.ladder,
                "setting": each.setting,
                "order": each.order.order,
                "standard_error": each.order.deviation,
                "constant": each.order.constant,
                "steps": each.order.count,
            }
            for each in found
        ]
    )
