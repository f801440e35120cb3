"""Start of a solve from contacts that were solved before, of the same body and surface."""

from dataclasses import dataclass, field

from scene import Scene

from . import window
from .problem import Problem, Start


@dataclass
class WarmStart:
    """Starts that solves leave for those that follow: of the same scene on other grids, and of its neighbours.

    A scene is placed once for all grids. A contact starts from the next coarser one of the same scene, or from the
    last on as many points, where that is nearer. Whatever it holds, the answer is that of a solve
    alone, to the tolerance.
    """

    _scene: Scene | None = None
    _placed: dict[int, window.Placed] = field(default_factory=dict)
    _own: dict[int, Start] = field(default_factory=dict)
    _last: dict[int, Start] = field(default_factory=dict)

    def set_scene(self, scene: Scene) -> None:
        """Say which scene is solved next; windows and coarser contacts of another are forgotten."""
        if scene != self._scene:
            self._scene = scene
            self._placed.clear()
            self._own.clear()

    def placed(self, problem: Problem, points: int) -> window.Placed:
        """Place of the contact of the scene, for a grid of so many points."""
        coarse = min(points, window.COARSE)
        if coarse not in self._placed:
            self._placed[coarse] = window.fitted(problem, coarse)
        return self._placed[coarse]

    def coarser(self, points: int) -> Start | None:
        """Contact of the scene on the most points below a number."""
        fewer = [each for each in self._own if each < points]
        return self._own[max(fewer)] if fewer else None

    def beside(self, points: int) -> Start | None:
        """Last contact on as many points, of whatever scene."""
        return self._last.get(points)

    def leave(self, start: Start) -> None:
        """Keep a contact of the scene for the solves that follow."""
        self._own[start.grid.points] = self._last[start.grid.points] = start
