"""The limit of low speed as a truth: friction of a rough contact from nothing but its pressure at rest."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import nan

from bem3d import BEM
from scene import Scene, Slide

from ...exact import mean_lag, slow_friction_by_curvature
from ...outcome import Outcome
from ...store import Task
from ...study import Task as Solves
from ..contest import FRICTION, Known, Quantity


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

    @classmethod
    def of(cls, scene: Scene, solver: BEM) -> "SlowLimit":
        """With a solver for the finest grid."""
        coarser = replace(solver, points=solver.points // 2)
        finest, next_to_it = (_moved(scene, 0.0, each) for each in (solver, coarser))
        return cls(scene, finest, next_to_it, _moved(scene, 10.0, coarser))

    @property
    def tasks(self) -> tuple[Task, ...]:
        """As of Truth."""
        return self.finest, self.next, self.faster

    def known(self, quantities: Sequence[Quantity], outcomes: Mapping[Task, Outcome]) -> Mapping[str, Known]:
        """As of Truth: friction alone; NaN where a solve failed."""
        finest, coarser, faster = (outcomes[task].rows[0] for task in self.tasks)
        limit, other = (self._limit(row) for row in (finest, coarser))
        departure = abs(faster.friction_coefficient / 10 - other) / 10
        return {FRICTION.name: Known(limit, abs(limit - other) + departure)}

    def _limit(self, row):
        curvature = row.measures.get("curvature_by_pressure", nan)
        return slow_friction_by_curvature(self.scene.motion.speed, mean_lag(self.scene.solid), 1.0, curvature)


def _moved(scene, factor, solver):
    """The scene at its speed times a factor."""
    motion = scene.motion
    slid = Slide(speed=factor * motion.speed, **{motion.pressed_by: motion.greatest})
    return Solves(solver, (replace(scene, motion=slid),), work=solver.points**2.2 * 50.0)
