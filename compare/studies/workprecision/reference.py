"""References: what errors are measured against, and how well it is known itself."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from math import nan

import numpy as np

from bem3d import BEM
from scene import Scene, Slide

from ...models.exact.slow import mean_lag, slow_friction_by_curvature
from ...solving.outcome import Outcome, Row
from ...solving.task import SceneTask, Task
from ...statistics.finding import EXACT, EXTRAPOLATED, HALVED
from .timed_solve import OnGrid, work

Outcomes = Mapping[Task, Outcome]


@dataclass(frozen=True)
class Quantity:
    """A number of an answer whose error is asked for.

    name : as in tables; label : as in figures, without what it is an error of
    of : from the row and the fields of an answer that was solved
    by : which estimate of it, where one answer has several: those of one label are drawn together
    """

    name: str
    label: str
    of: Callable[[Row, Mapping[str, np.ndarray]], float]
    by: str = ""

    def measured(self, row: Row, fields: Mapping[str, np.ndarray]) -> float:
        """The number; NaN of a failed solve."""
        return nan if row.reason is not None else self.of(row, fields)


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


def finer(
    scene: Scene, solver: OnGrid, source: str, scale: Mapping[str, float] | None = None, **coarser
) -> Reference:
    """Reference by the scene solved far finer; its error is the change from the next coarser grid or setting.

    source : for people, with {} for the points
    scale : by the quantity's name, see Known
    coarser : settings of the next, if it is not on half the points
    """
    next_to_it = replace(solver, **coarser or {"points": solver.points // 2})
    tasks = tuple(SceneTask(each, (scene,), work=work(each)) for each in (solver, next_to_it))

    def known(quantities, outcomes):
        found = {}
        for each in quantities:
            value, other = (each.measured(outcomes[task].rows[0], outcomes[task].fields) for task in tasks)
            found[each.name] = Known(value, abs(value - other), (scale or {}).get(each.name))
        return found

    return Reference(source.format(solver.points), HALVED, known, tasks)


def slow_limit(scene: Scene, solver: BEM) -> Reference:
    """Friction from the curvature of the surface, weighted with the pressure at rest; to first order in the speed.

    Half the points tell how uncertain the limit is. Ten times the speed, on those too, departs from it by ten
    times as much as the scene, whose roughness is the same on every grid.
    """
    coarser = replace(solver, points=solver.points // 2)
    tasks = tuple(_moved(scene, *each) for each in ((0.0, solver), (0.0, coarser), (10.0, coarser)))

    def limit(row):
        curvature = row.measures.get("curvature_by_pressure", nan)
        return slow_friction_by_curvature(scene.motion.speed, mean_lag(scene.solid), 1.0, curvature)

    def known(_, outcomes):
        finest, less, faster = (outcomes[task].rows[0] for task in tasks)
        departure = abs(faster.friction_coefficient / 10 - limit(less)) / 10
        return {FRICTION.name: Known(limit(finest), abs(limit(finest) - limit(less)) + departure)}

    source = "the limit of low speed by the curvature under the pressure at rest"
    return Reference(source, EXTRAPOLATED, known, tasks)


def _moved(scene, factor, solver):
    """Task of the scene at its speed times a factor."""
    motion = scene.motion
    slid = Slide(speed=factor * motion.speed, **{motion.pressed_by: motion.greatest})
    return SceneTask(solver, (replace(scene, motion=slid),), work=work(solver))
