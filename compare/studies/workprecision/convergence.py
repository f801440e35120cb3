"""Convergence: one contact answered along ladders of settings, its errors and costs as a Dataset."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import nan
from typing import Any

import numpy as np
import xarray

from scene import Scene

from ...amounts import seconds, setting, share
from ...rectangle import FAILED, SOLVED
from ...statistics.convergence import Order, observed
from ...task import Task
from ...vocabulary import attributes
from .reference import Outcomes, Quantity, Reference
from .timed_solve import COSTS, OnGrid, TimedSolve

# Settings of a solver that tables tell, where it has them.
SETTINGS = ("points", "tolerance", "steps", "precision", "extent")
# Errors alike: what is gained by less than this factor is not worth having.
ALIKE = 1.5
DIMENSIONS = {"MDR": "1D", "BEM": "3D"}


@dataclass(frozen=True)
class Ladder:
    """The same scene with one setting after another.

    label : as in a legend
    setting : what changes from step to step, for people
    values : of it, one a step
    """

    label: str
    setting: str
    values: tuple[float, ...]
    solves: tuple[TimedSolve, ...]

    @classmethod
    def of(cls, label: str, scene: Scene, solver: OnGrid, setting: str, values: Sequence, **others: Any):
        """Steps that differ in one setting. others : of the solves, see TimedSolve"""
        solvers = [replace(solver, **{setting: value}) for value in values]
        return cls.through(label, scene, solvers, setting, values, **others)

    @classmethod
    def through(
        cls, label: str, scene: Scene, solvers: Sequence[OnGrid], setting: str, values: Sequence, **others: Any
    ):
        """Steps of any settings."""
        solves = tuple(TimedSolve.of(solver, scene, **others) for solver in solvers)
        return cls(label, setting, tuple(values), solves)


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
        known = self.reference.known(self.quantities, outcomes)
        quantities = [each for each in self.quantities if each.name in known]
        steps = [
            (ladder, value, solve)
            for ladder in self.ladders
            for value, solve in zip(ladder.values, ladder.solves, strict=True)
        ]
        answers = [outcomes[solve] for _, _, solve in steps]
        rows = [answer.rows[0] for answer in answers]
        found: dict[str, tuple] = {
            "relative_error": (
                ("quantity", "step"),
                [[_error(each, known[each.name], answer) for answer in answers] for each in quantities],
            ),
            "reference_error": ("quantity", [known[each.name].relative_error for each in quantities]),
            "status": ("step", [SOLVED if row.reason is None else FAILED for row in rows]),
            "reason": ("step", [row.reason or "" for row in rows]),
            "applications": ("step", [row.applications for row in rows]),
        }
        found |= {name: ("step", [row.measures.get(name, nan) for row in rows]) for name in (*COSTS, "repeats")}
        coordinates: dict[str, tuple] = {
            "quantity": ("quantity", [each.name for each in quantities]),
            "label": ("quantity", [each.label for each in quantities]),
            "estimate": ("quantity", [each.by for each in quantities]),
            "expected_order": ("quantity", [(self.orders or {}).get(each.name, nan) for each in quantities]),
            "step": ("step", list(range(len(steps)))),
            "ladder": ("step", [ladder.label for ladder, _, _ in steps]),
            "setting": ("step", [ladder.setting for ladder, _, _ in steps]),
            "value": ("step", [float(value) for _, value, _ in steps]),
            "solver": ("step", [solve.solver.name for _, _, solve in steps]),
        }
        for name in SETTINGS:
            taken = [getattr(solve.solver, name, None) for _, _, solve in steps]
            absent = "" if name == "precision" else nan
            coordinates[name] = ("step", [absent if value is None else value for value in taken])
        about = {
            "contact": self.name,
            "title": self.title,
            "reference": self.reference.source,
            "reference_method": self.reference.method,
        }
        dataset = xarray.Dataset(found, coordinates, about)
        for label in dataset.variables:
            dataset[label].attrs = attributes(str(label), self.ladders[0].solves[0].scene)
        return {self.name: dataset}


def _error(quantity, known, answer):
    row = answer.rows[0]
    return nan if row.reason is not None else known.error_of(quantity.of(row, answer.fields))


@dataclass(frozen=True)
class MeasuredLadder:
    """One ladder of a contact, by one quantity; arrays (steps,) are NaN where a solve failed.

    dataset : of the contact, with the steps of this ladder and this quantity alone
    """

    dataset: xarray.Dataset

    @property
    def contact(self) -> str:
        """Name of the contact."""
        return self.dataset.attrs["contact"]

    @property
    def title(self) -> str:
        """Contact for people."""
        return self.dataset.attrs["title"]

    @property
    def quantity(self) -> str:
        """Name of the quantity."""
        return self.dataset["quantity"].item()

    @property
    def label(self) -> str:
        """Quantity for people."""
        return self.dataset["label"].item()

    @property
    def estimate(self) -> str:
        """Which estimate of the quantity; empty of the only one."""
        return self.dataset["estimate"].item()

    @property
    def ladder(self) -> str:
        """Label of the ladder."""
        return str(self.dataset["ladder"].values[0])

    @property
    def setting(self) -> str:
        """What changes from step to step."""
        return str(self.dataset["setting"].values[0])

    @property
    def solver(self) -> str:
        """Name of the solver."""
        return str(self.dataset["solver"].values[0])

    @property
    def values(self) -> np.ndarray:
        """Setting of each step."""
        return self.dataset["value"].values

    @cached_property
    def errors(self) -> np.ndarray:
        """Relative errors."""
        return self.dataset["relative_error"].values

    @cached_property
    def processor(self) -> np.ndarray:
        """Processor time [s]."""
        return self.dataset["processor"].values

    @property
    def reference_error(self) -> float:
        """Relative error of the reference."""
        return self.dataset["reference_error"].item()

    @property
    def failures(self) -> list[tuple[float, str]]:
        """Setting and reason of each solve that failed."""
        reasons = zip(self.values, self.dataset["reason"].values, strict=True)
        return [(float(value), str(reason)) for value, reason in reasons if reason]

    @cached_property
    def order(self) -> Order:
        """Order at which the error falls with the setting."""
        return observed(self.values, self.errors, self.reference_error)

    def reaching(self, level: float) -> int | None:
        """Cheapest step from which on the error stays at or below a level; None if none does.

        A step that is right by chance does not count: those of finer settings have to be so too. The finest has
        none that could confirm it, and counts alone.
        """
        within = self.errors <= level
        good = [k for k in range(len(within)) if within[k:].all()]
        return min(good, key=lambda k: self.processor[k]) if good else None

    @property
    def enough(self) -> int | None:
        """Cheapest step from which on errors are as small as on the last; None where that one failed."""
        return self.reaching(ALIKE * self.errors[-1])

    @property
    def best(self) -> float:
        """Least error of all steps; NaN where none was solved."""
        return float(np.nanmin(self.errors)) if np.isfinite(self.errors).any() else nan

    @property
    def unsolved(self) -> str:
        """Why there is no error at all; empty where there is one."""
        if np.isfinite(self.errors).any():
            return ""
        failed = self.failures
        return f"no step was solved ({failed[0][1]})" if failed else "the reference was not solved"

    def step(self, k: int) -> str:
        """A setting and its time in words."""
        return f"{setting(self.setting, self.values[k])}: {seconds(self.processor[k])}"

    def cell(self, level: float) -> str:
        """What a wanted error takes, or why it cannot be told."""
        if self.unsolved:
            return self.unsolved
        if level < self.reference_error:
            return f"reference known to {share(self.reference_error)}"
        k = self.reaching(level)
        return f"not reached; best {share(self.best)}" if k is None else self.step(k)


def ladders(dataset: xarray.Dataset) -> Iterator[MeasuredLadder]:
    """Every ladder of a contact by every quantity."""
    labels = dataset["ladder"].values
    for label in dict.fromkeys(labels.tolist()):
        for name in dataset["quantity"].values:
            yield MeasuredLadder(dataset.isel(step=np.flatnonzero(labels == label)).sel(quantity=name))


def answers(dataset: xarray.Dataset) -> list[MeasuredLadder]:
    """Ladders by the first estimate of each label: what the solver answers."""
    first: dict[str, str] = {}
    for name, label in zip(dataset["quantity"].values, dataset["label"].values, strict=True):
        first.setdefault(str(label), str(name))
    return [each for each in ladders(dataset) if each.quantity in first.values()]


def steps_table(found: Sequence[MeasuredLadder]) -> list[dict[str, Any]]:
    """A row for each step and quantity; relative errors, times [s], memory [bytes]."""
    return [row for each in found for row in _rows(each)]


def orders_table(found: Sequence[MeasuredLadder]) -> list[dict[str, Any]]:
    """A row for each ladder and quantity; NaN where too few steps show an error of their own."""
    return [
        {
            **_named(each),
            "setting": each.setting,
            "order": each.order.order,
            "standard_error": each.order.deviation,
            "constant": each.order.constant,
            "steps": each.order.count,
        }
        for each in found
    ]


def _named(each):
    return {"contact": each.contact, "quantity": each.quantity, "solver": each.solver, "ladder": each.ladder}


def _rows(each):
    whole = each.dataset
    for k, value in enumerate(each.values):
        step = whole.isel(step=k)
        own = ("processor", "wall", "memory", "applications", "status", "reason")
        yield {
            **_named(each),
            "title": each.title,
            "label": each.label,
            "estimate": each.estimate,
            "setting": each.setting,
            "value": value,
            **{name: step[name].item() for name in SETTINGS},
            "relative_error": each.errors[k],
            "reference": whole.attrs["reference"],
            "reference_error": each.reference_error,
            **{name: step[name].item() for name in own},
        }
