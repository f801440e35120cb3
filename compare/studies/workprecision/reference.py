"""References: what errors are measured against, and how well it is known itself."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from math import nan

import numpy as np

from scene import Scene

from ...solving.outcome import Outcome, Row
from ...solving.task import SceneTask, Task
from ...statistics.finding import EXACT, HALVED
from .timed_solve import OnGrid, work

Outcomes = Mapping[Task, Outcome]


@dataclass(frozen=True)
class Quantity:
    """A number of an answer whose error is asked for.

    name : as in tables; label : as in figures, without what it is an error of
    of : from the row of an answer that was solved
    """

    name: str
    label: str
    of: Callable[[Row], float]

    def measured(self, row: Row) -> float:
        """The number; NaN of a failed solve."""
        return nan if row.reason is not None else self.of(row)


DEPTH = Quantity("depth", "depth", lambda row: row.depth)
FORCE = Quantity("force", "normal force", lambda row: row.normal_force)
FRICTION = Quantity("friction", "friction coefficient", lambda row: row.friction_coefficient)


@dataclass(frozen=True)
class Known:
    """Value of a quantity.

    error : of the value itself, in the same unit; errors of a ladder below it say nothing
    scale : that errors are relative to; the magnitude of the value if absent
    """

    value: float
    error: float = 0.0
    scale: float | None = None

    def error_of(self, found: float) -> float:
        """Relative deviation of a number."""
        return float(np.abs(found - self.value)) / self._scale

    @property
    def relative_error(self) -> float:
        """Relative error of the value itself."""
        return self.error / self._scale

    @property
    def _scale(self):
        return float(np.abs(self.value)) if self.scale is None else self.scale


@dataclass(frozen=True)
class Reference:
    """Reference that a ladder is measured against.

    source : where it is from, for people
    method : how its error is known, see `finding.Finding.grid_method`
    values : values by the quantity's name, from the quantities asked for and the outcomes of the tasks; absent of
        quantities that it does not know, NaN where a solve failed
    tasks : that have to be solved for it
    """

    source: str
    method: str
    values: Callable[[Sequence[Quantity], Outcomes], Mapping[str, Known]]
    tasks: tuple[Task, ...] = ()


def closed_form(source: str, values: Mapping[str, Known]) -> Reference:
    """Values known without solving. values : by the quantity's name"""
    return Reference(source, EXACT, lambda asked, _: values)


def finer(scene: Scene, solver: OnGrid, source: str, scale: Mapping[str, float] | None = None) -> Reference:
    """Reference by the scene solved far finer; its error is the change from half the points.

    source : for people, with {} for the points
    scale : by the quantity's name, see Known
    """
    coarser = replace(solver, points=solver.points // 2)
    tasks = tuple(SceneTask(each, (scene,), work=work(each)) for each in (solver, coarser))

    def known(quantities, outcomes):
        found = {}
        for each in quantities:
            value, other = (each.measured(outcomes[task].rows[0]) for task in tasks)
            found[each.name] = Known(value, abs(value - other), (scale or {}).get(each.name))
        return found

    return Reference(source.format(solver.points), HALVED, known, tasks)
