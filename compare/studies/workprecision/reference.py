"""References: what errors are measured against, and how well it is known itself."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from math import nan
from typing import Protocol

import numpy as np

from bem3d import BEM
from scene import Scene, Slide

from ...exact.slow import mean_lag, slow_friction_by_curvature
from ...finding import EXACT, EXTRAPOLATED, HALVED
from ...outcome import Outcome, Row
from ...task import SceneTask, Task
from .timed_solve import OnGrid, work

Outcomes = Mapping[Task, Outcome]


@dataclass(frozen=True)
class Quantity:
    """A number of an answer whose error is asked for.

    name : as in tables; label : as in figures, without what it is an error of
    of : from the row and the fields of an answer; NaN of a failed one
    by : which estimate of it, where one answer has several: those of one label are drawn together
    """

    name: str
    label: str
    of: Callable[[Row, Mapping[str, np.ndarray]], float]
    by: str = ""


DEPTH = Quantity("depth", "depth", lambda row, _: row.depth)
FORCE = Quantity("force", "normal force", lambda row, _: row.normal_force)
FRICTION = Quantity("friction", "friction coefficient", lambda row, _: row.friction_coefficient)


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


class Reference(Protocol):
    """What a ladder is measured against.

    source : where it is from, for people
    method : how its error is known, see `finding.Finding.grid_method`
    """

    @property
    def source(self) -> str: ...

    @property
    def method(self) -> str: ...

    @property
    def tasks(self) -> Sequence[Task]:
        """Tasks that have to be solved for it."""

    def known(self, quantities: Sequence[Quantity], outcomes: Outcomes) -> Mapping[str, Known]:
        """Values by the quantity's name; quantities that it does not know are absent, NaN where a solve failed."""


@dataclass(frozen=True)
class ClosedForm:
    """Values known without solving. values : by the quantity's name"""

    source: str
    values: Mapping[str, Known]
    method: str = EXACT
    tasks: tuple[()] = ()

    def known(self, quantities: Sequence[Quantity], outcomes: Outcomes) -> Mapping[str, Known]:
        """Values by the quantity's name."""
        return {each.name: self.values[each.name] for each in quantities if each.name in self.values}


@dataclass(frozen=True)
class Finer:
    """The same scene solved far finer; its error is what the next coarser grid, or looser setting, differs by.

    scale : by the quantity's name, see Known
    """

    source: str
    finest: Task
    next: Task
    scale: Mapping[str, float] = field(default_factory=dict)
    method: str = HALVED

    @classmethod
    def of(cls, scene: Scene, solver: OnGrid, source: str, scale: Mapping[str, float] | None = None, **coarser):
        """A scene on the finest grid. coarser : settings of the next, if it is not on half the points"""
        coarser = coarser or {"points": solver.points // 2}
        finest, next = (
            SceneTask(each, (scene,), work=work(each)) for each in (solver, replace(solver, **coarser))
        )
        return cls(source, finest, next, scale or {})

    @property
    def tasks(self) -> tuple[Task, ...]:
        """Both grids."""
        return self.finest, self.next

    def known(self, quantities: Sequence[Quantity], outcomes: Outcomes) -> Mapping[str, Known]:
        """Values by the quantity's name, NaN where one of the two solves failed."""
        finest, less = (outcomes[task] for task in self.tasks)
        found = {}
        for each in quantities:
            value, other = (each.of(answer.rows[0], answer.fields) for answer in (finest, less))
            found[each.name] = Known(value, abs(value - other), self.scale.get(each.name))
        return found


@dataclass(frozen=True)
class SlowLimit:
    """Friction from the curvature of the surface, weighted with the pressure at rest; to first order in the speed.

    scene : that slides slowly; its roughness is the same on every grid
    finest : at rest; next : on half the points, by which the limit is uncertain
    faster : on those too, at ten times the speed, whose departure from the limit is ten times that of the scene
    """

    scene: Scene
    finest: Task
    next: Task
    faster: Task
    source: str = "the limit of low speed by the curvature under the pressure at rest"
    method: str = EXTRAPOLATED

    @classmethod
    def of(cls, scene: Scene, solver: BEM) -> "SlowLimit":
        """Limit of a scene, with a solver for the finest grid."""
        coarser = replace(solver, points=solver.points // 2)
        finest, next_to_it = (_moved(scene, 0.0, each) for each in (solver, coarser))
        return cls(scene, finest, next_to_it, _moved(scene, 10.0, coarser))

    @property
    def tasks(self) -> tuple[Task, ...]:
        """At rest on both grids, and faster."""
        return self.finest, self.next, self.faster

    def known(self, quantities: Sequence[Quantity], outcomes: Outcomes) -> Mapping[str, Known]:
        """Friction alone; NaN where a solve failed."""
        finest, coarser, faster = (outcomes[task].rows[0] for task in self.tasks)
        limit, other = (self._limit(row) for row in (finest, coarser))
        departure = abs(faster.friction_coefficient / 10 - other) / 10
        return {FRICTION.name: Known(limit, abs(limit - other) + departure)}

    def _limit(self, row):
        curvature = row.measures.get("curvature_by_pressure", nan)
        return slow_friction_by_curvature(self.scene.motion.speed, mean_lag(self.scene.solid), 1.0, curvature)


def _moved(scene, factor, solver):
    """Task of the scene at its speed times a factor."""
    motion = scene.motion
    slid = Slide(speed=factor * motion.speed, **{motion.pressed_by: motion.greatest})
    return SceneTask(solver, (replace(scene, motion=slid),), work=work(solver))
