"""One scene, ladders of settings that answer it, and what they are measured against."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from math import nan
from typing import Any, Protocol

import numpy as np

from scene import Scene

from ..outcome import Outcome, Row
from ..store import Task
from ..study import Task as Solves
from .order import Order, observed
from .rung import COSTS, OnGrid, Rung

Value = float | np.ndarray


@dataclass(frozen=True)
class Quantity:
    """A number of an answer whose error is asked for.

    name : as in tables; label : as in figures, without what it is an error of
    of : from the row and the fields of an answer; NaN of a failed one
    by : which estimate of it, where one answer has several: those of one label are drawn together
    """

    name: str
    label: str
    of: Callable[[Row, Mapping[str, np.ndarray]], Value]
    by: str | None = None


DEPTH = Quantity("depth", "depth", lambda row, _: row.depth)
FORCE = Quantity("force", "normal force", lambda row, _: row.normal_force)
FRICTION = Quantity("friction", "friction coefficient", lambda row, _: row.friction_coefficient)


@dataclass(frozen=True)
class Known:
    """What a quantity is.

    error : of the value itself, in the same unit; errors of a ladder below it say nothing
    scale : that errors are relative to; the largest magnitude of the value if absent
    """

    value: Value
    error: float = 0.0
    scale: float | None = None

    def error_of(self, found: Value) -> float:
        """Largest deviation, relative."""
        return float(np.max(np.abs(found - self.value))) / self._scale

    @property
    def relative_error(self) -> float:
        """Its own."""
        return self.error / self._scale

    @property
    def _scale(self):
        return float(np.max(np.abs(self.value))) if self.scale is None else self.scale


class Truth(Protocol):
    """What ladders are measured against."""

    @property
    def source(self) -> str:
        """Where it is from, for people."""

    @property
    def tasks(self) -> Sequence[Task]:
        """That have to be solved for it."""

    def known(self, quantities: Sequence[Quantity], outcomes: Mapping[Task, Outcome]) -> Mapping[str, Known]:
        """By the quantity's name; quantities that it does not know are absent."""


@dataclass(frozen=True)
class ClosedForm:
    """Known without solving. values : by the quantity's name."""

    source: str
    values: Mapping[str, Known]
    tasks: tuple[()] = ()

    def known(self, quantities, outcomes):
        """As of Truth."""
        return {each.name: self.values[each.name] for each in quantities if each.name in self.values}


@dataclass(frozen=True)
class Finer:
    """The same scene solved far finer; its own error is what the next coarser grid, or looser setting, differs by.

    scale : by the quantity's name, see Known
    """

    source: str
    finest: Task
    next: Task
    scale: Mapping[str, float] = field(default_factory=dict)

    @classmethod
    def of(cls, scene: Scene, solver: OnGrid, source: str, scale: Mapping[str, float] | None = None, **coarser):
        """`coarser` : settings of the next, where half the points are not what is meant."""
        coarser = coarser or {"points": solver.points // 2}
        finest, next = (Solves(each, (scene,), work=work(each)) for each in (solver, replace(solver, **coarser)))
        return cls(source, finest, next, scale or {})

    @property
    def tasks(self) -> tuple[Task, ...]:
        """As of Truth."""
        return self.finest, self.next

    def known(self, quantities, outcomes):
        """As of Truth; NaN where one of the two failed."""
        finest, less = (outcomes[task] for task in self.tasks)
        found = {}
        for each in quantities:
            value, other = (each.of(answer.rows[0], answer.fields) for answer in (finest, less))
            error = float(np.max(np.abs(np.asarray(value) - other)))
            found[each.name] = Known(value, error, self.scale.get(each.name))
        return found


@dataclass(frozen=True)
class Ladder:
    """One model climbing: the same scene with one setting after another.

    label : as in a legend
    setting : what is climbed, for people
    values : of it, one a rung
    """

    label: str
    setting: str
    values: tuple[float, ...]
    rungs: tuple[Rung, ...]

    @classmethod
    def of(cls, label: str, scene: Scene, solver: OnGrid, setting: str, values: Sequence, **others: Any):
        """Rungs that differ in one setting. others : of the rungs, see Rung; steps that go along with points."""
        solvers = [replace(solver, **{setting: value}) for value in values]
        return cls.through(label, scene, solvers, setting, values, **others)

    @classmethod
    def through(
        cls, label: str, scene: Scene, solvers: Sequence[OnGrid], setting: str, values: Sequence, **others
    ):
        """Rungs of any settings."""
        rungs = tuple(Rung(solver, scene, work=work(solver), **others) for solver in solvers)
        return cls(label, setting, tuple(values), rungs)


@dataclass(frozen=True)
class Contest:
    """A scene with all that answers it.

    name : short, as in file names; title : for people
    """

    name: str
    title: str
    truth: Truth
    quantities: tuple[Quantity, ...]
    ladders: tuple[Ladder, ...]

    @property
    def timed(self) -> list[Rung]:
        """What has to be measured alone."""
        return list(dict.fromkeys(rung for ladder in self.ladders for rung in ladder.rungs))

    @property
    def untimed(self) -> list[Task]:
        """What has to be solved besides."""
        return list(self.truth.tasks)

    def judged(self, outcomes: Mapping[Task, Outcome]) -> "Judged":
        """Errors and costs of all ladders."""
        return judge(self, outcomes)


@dataclass(frozen=True)
class Climbed:
    """A ladder measured, arrays (rungs,) with NaN where a solve failed.

    errors : relative, by the quantity's name
    processor, wall [s], memory [bytes], applications : see Rung
    reasons : why a solve failed, None where it did not
    """

    ladder: Ladder
    errors: Mapping[str, np.ndarray]
    processor: np.ndarray
    wall: np.ndarray
    memory: np.ndarray
    applications: np.ndarray
    reasons: tuple[str | None, ...]

    def reaching(self, quantity: str, level: float) -> int | None:
        """The cheapest rung from which on the error stays at or below a level; None if none does.

        A rung that is right by chance does not count: those of finer settings have to be so too. The finest has
        none that could confirm it, and counts alone.
        """
        within = self.errors[quantity] <= level
        good = [k for k in range(len(within)) if within[k:].all()]
        return min(good, key=lambda k: self.processor[k]) if good else None


@dataclass(frozen=True)
class Judged:
    """A contest measured. known : by the quantity's name."""

    contest: Contest
    known: Mapping[str, Known]
    climbed: tuple[Climbed, ...]

    def order(self, climbed: Climbed, quantity: str) -> Order:
        """At which the error of one of its ladders falls."""
        return observed(climbed.ladder.values, climbed.errors[quantity], self.known[quantity].relative_error)


def judge(contest: Contest, outcomes: Mapping[Task, Outcome]) -> Judged:
    """Errors and costs of all ladders."""
    known = contest.truth.known(contest.quantities, outcomes)
    return Judged(contest, known, tuple(_climbed(contest, ladder, known, outcomes) for ladder in contest.ladders))


def _climbed(contest, ladder, known, outcomes):
    answers = [outcomes[rung] for rung in ladder.rungs]
    rows = [answer.rows[0] for answer in answers]
    errors = {
        each.name: np.array([_error(each, known[each.name], answer) for answer in answers])
        for each in contest.quantities
        if each.name in known
    }
    costs = {name: np.array([row.measures.get(name, nan) for row in rows]) for name in COSTS}
    applications = np.array([row.applications for row in rows])
    return Climbed(ladder, errors, applications=applications, reasons=tuple(row.reason for row in rows), **costs)


def _error(quantity, known, answer):
    row = answer.rows[0]
    return nan if row.reason is not None else known.error_of(quantity.of(row, answer.fields))


def work(solver: OnGrid) -> float:
    """Of one solve, in passes over a point of a grid, roughly; see store."""
    return solver.points * 15.0 if solver.name == "MDR" else solver.points**2.2 * 50.0
