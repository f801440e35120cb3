"""Start of a solve from contacts that were solved before, of the same body and surface."""

from dataclasses import dataclass, field

from scene import Scene

from . import window
from .problem import Problem, Start


@dataclass
class WarmStart:
    """Contacts kept as starts of later solves: of the same scene on coarser grids, and of neighbouring scenes.

    A scene is placed once for all grids. A contact starts from the next coarser one of the same scene, or from the
    last one on as many points, whichever is closer. The answer does not depend on the start, to the tolerance.
    """

    _scene: Scene | None = None
    _placed: dict[int, window.Placed] = field(default_factory=dict)
    _own: dict[int, Start] = field(default_factory=dict)
    _last: dict[int, Start] = field(default_factory=dict)

    def set_scene(self, scene: Scene) -> None:
        """Set the scene to be solved next; windows and coarser contacts of other scenes are dropped."""
        if scene != self._scene:
            self._scene = scene
            self._placed.clear()
            self._own.clear()

    def placed(self, problem: Problem, points: int) -> window.Placed:
        """Place of the contact of the scene, for a grid of `points` a side."""
        coarse = min(points, window.COARSE)
        if coarse not in self._placed:
            self._placed[coarse] = window.fitted(problem, coarse)
        return self._placed[coarse]

    def coarser(self, points: int) -> Start | None:
        """Contact of the scene on the most points below a number."""
        fewer = [each for each in self._own if each < points]
        return self._own[max(fewer)] if fewer else None

    def neighbour(self, points: int) -> Start | None:
        """Last contact on as many points, of any scene."""
        return self._last.get(points)

    def leave(self, start: Start) -> None:
        """Keep a contact of the scene for the solves that follow."""
        self._own[start.grid.points] = self._last[start.grid.points] = start
