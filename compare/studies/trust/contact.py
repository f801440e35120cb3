"""One scene solved in both dimensionalities on as many surfaces as its scatter asks for, as a task."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import chain
from math import inf, sqrt
from typing import Any

import numpy as np

from bem3d import BEM
from mdr1d import MDR
from scene import Scene

from ...solving.outcome import Outcome, Row
from ...solving.task import SCENES, SceneTask, draws_of
from ...trustmap.ratio import FINE, HALF

POINTS = 128, 192, 256, 384, 512
LINE_POINTS = 4000
# Pixels of the 3D grid to the shortest wave.
PIXELS = 10
# Draws solved at once, and on half the points besides.
BLOCK, COARSE = {"MDR": 40, "BEM": 4}, {"MDR": 40, "BEM": 2}
MOST_PROFILES = 400


@dataclass(frozen=True)
class Contact:
    """A task, see `task.Task`: a scene on profiles and on surfaces, until their means are known.

    scene : of the first surface
    wanted : standard error over draws at which friction, or force at rest, is known, relative
    surfaces : most of them on 128 points a side; on more points fewer, as their cost grows
    depth_too : the depth is to be known as closely

    A row is a draw; its settings tell `solver`, `grid` (fine or coarse) and `points`.
    """

    scene: Scene
    wanted: float
    surfaces: int
    depth_too: bool = False
    keeps_fields = False
    packages = ("scene", "mdr1d", "bem3d", "compare.studies.trust.contact")

    @property
    def label(self) -> str:
        """Short description for people."""
        return SceneTask(BEM(), (self.scene,)).label.replace("BEM", "MDR and BEM")

    @property
    def work(self) -> float:
        """Rough cost, in passes over a point of a grid."""
        rough = self.scene.roughness
        return 1e6 if rough is None else 2.5e7 * max(1.0, self._waves / 5) ** 2

    @property
    def question(self) -> Mapping[str, Any]:
        """Scene, and how well it is to be known."""
        (scene,) = SCENES.dump_python((self.scene,), mode="json")
        told = {"trust": scene, "wanted": self.wanted, "surfaces": self.surfaces}
        return told | ({"depth_too": True} if self.depth_too else {})

    def solve(self) -> Outcome:
        """Solve until the means are known, or the surfaces are spent."""
        line = self._drawn(MDR(points=LINE_POINTS), MOST_PROFILES)
        first = SceneTask(BEM(points=POINTS[0]), (self.scene,)).solve().rows[0]
        points = self._points(first)
        most = max(BLOCK["BEM"], round(self.surfaces * (POINTS[0] / points) ** 1.5))
        space = self._drawn(BEM(points=points), most)
        return Outcome(tuple(chain(line, space)))

    def failed(self, reason: str) -> Outcome:
        """Outcome with the reason in its one row."""
        return Outcome((Row(reason=reason),))

    def fits(self, outcome: Outcome) -> bool:
        """Whether the stored outcome has any rows."""
        return bool(outcome.rows)

    @property
    def _waves(self):
        rough = self.scene.roughness
        return rough.longest / rough.shortest

    def _points(self, first):
        """Points that resolve the shortest wave in the window of a first solve."""
        rough = self.scene.roughness
        extent = first.settings.get("extent", inf)
        needed = 0 if rough is None else PIXELS * extent / rough.shortest
        return next((points for points in POINTS if points >= needed), POINTS[-1])

    def _drawn(self, solver: MDR | BEM, most: int) -> Iterator[Row]:
        """Rows of the fine grid, a block after the other, then of the first draws on half the points."""
        block, scenes = BLOCK[solver.name], draws_of(self.scene, most)
        rows: list[Row] = []
        while len(rows) < len(scenes) and not self._known(rows):
            rows += SceneTask(solver, scenes[len(rows) : len(rows) + block]).solve().rows
        half = replace(solver, points=solver.points // 2)
        coarse = SceneTask(half, scenes[: COARSE[solver.name]]).solve().rows
        for grid, each, found in ((FINE, solver, rows), (HALF, half, coarse)):
            told = {"solver": each.name, "grid": grid, "points": each.points}
            yield from (replace(row, measures={}, settings=told) for row in found)

    def _known(self, rows):
        """Whether the means of what is asked of the scene have the standard error that is wanted."""
        at_rest = "depth" if self.scene.motion.pressed_by == "load" else "normal_force"
        asked = {"friction_coefficient" if getattr(self.scene.motion, "speed", 0.0) > 0 else at_rest}
        return all(self._close(rows, name) for name in asked | ({"depth"} if self.depth_too else set()))

    def _close(self, rows, name):
        values = np.array([getattr(row, name) for row in rows])
        values = values[np.isfinite(values)]
        if values.size < BLOCK["BEM"]:
            return False
        return bool(np.std(values, ddof=1) / sqrt(values.size) < self.wanted * abs(values.mean()))
