"""One scene solved in both dimensionalities on as many surfaces as its scatter asks for, as a task."""

from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass, replace
from itertools import chain
from math import inf, sqrt
from typing import Any

import numpy as np
from ratios import FINE, HALF

from bem3d import BEM
from compare.models.law.bands import Bands
from compare.solving.outcome import Outcome, Row
from compare.solving.task import SCENES, SceneTask, Task, draws_of
from mdr1d import MDR
from scene import Scene, SelfAffine

LINE_POINTS, PROFILES, MOST_PROFILES = 4000, 40, 800  # of profiles; solved at once, and at most
LEAST_POINTS = 128
DEARER = 4.0  # a surface on all points than on half of them
# Half the points stand in for all where they change a surface by less than this, relative.
ALIKE = 0.2


@dataclass(frozen=True)
class Grids:
    """Grids of surfaces.

    points : to choose from, a side of the fine grid
    pixels : to the shortest wave
    few, many : surfaces solved at once on the fine grid, and on half its points
    """

    points: tuple[int, ...] = (LEAST_POINTS, 192, 256, 384, 512)
    pixels: float = 10.0
    few: int = 4
    many: int = 8


# Many waves ask for great grids, and scatter little.
USUAL, GREAT = Grids(), Grids((512, 640, 768, 960, 1280, 1536, 1920, 2560, 3072), 8.0, 2, 4)


@dataclass(frozen=True)
class Contact(Task):
    """A task, see `task.Task`: a scene on profiles and on surfaces, until their means are known.

    scene : of the first surface
    wanted : standard error over draws at which friction, or depth or force at rest, is known, relative
    surfaces : most of them on half of LEAST_POINTS a side; on more points fewer, as their cost grows
    grids : in 3D

    In 3D most surfaces are solved on half the points, and the first few on all of them, which tells what half
    leaves out: the mean is known as closely as both leave it (Giles, Oper. Res. 56, 607, 2008). A row is a draw;
    its settings tell `solver`, `grid` (fine or coarse) and `points`.
    """

    scene: Scene
    wanted: float
    surfaces: int
    grids: Grids = USUAL
    packages = ("scene", "mdr1d", "bem3d", "compare.models.law.bands", "contact")

    @property
    def label(self) -> str:
        """Short description for people."""
        return SceneTask(BEM(), (self.scene,)).label.replace("BEM", "MDR and BEM")

    @property
    def work(self) -> float:
        """Rough cost, in passes over a point of a grid."""
        rough = self.scene.roughness
        return 1e6 if rough is None else 2.5e7 * max(1.0, rough.longest / finest_wave(rough) / 5) ** 2

    @property
    def question(self) -> Mapping[str, Any]:
        """Scene, and how well it is to be known."""
        (scene,) = SCENES.dump_python((self.scene,), mode="json")
        return {"trust": scene, "wanted": self.wanted, "surfaces": self.surfaces, "grids": asdict(self.grids)}

    def solve(self) -> Outcome:
        """Solve until the means are known, or the surfaces are spent."""
        line = MDR(points=LINE_POINTS)
        first = SceneTask(BEM(points=LEAST_POINTS), (self.scene,)).solve().rows[0]
        profiles = self._told(FINE, line, self._profiles(line))
        return Outcome(tuple(chain(profiles, self._surfaces(self._fine(first)))))

    def fits(self, outcome: Outcome) -> bool:
        """Whether the stored outcome has any rows."""
        return bool(outcome.rows)

    def _fine(self, first):
        """Points that resolve the shortest wave in the window of a first solve."""
        rough = self.scene.roughness
        extent, points = first.settings.get("extent", inf), self.grids.points
        needed = 0 if rough is None else self.grids.pixels * extent / finest_wave(rough)
        return next((each for each in points if each >= needed), points[-1])

    def _profiles(self, solver) -> list[Row]:
        """Rows of profiles, a block after the other."""
        rows: list[Row] = []
        scenes = draws_of(self.scene, MOST_PROFILES)
        while len(rows) < len(scenes) and not self._known(rows):
            rows += SceneTask(solver, scenes[len(rows) : len(rows) + PROFILES]).solve().rows
        return rows

    def _surfaces(self, points) -> Iterator[Row]:
        """Rows of surfaces on the fine grid, then on half its points."""
        few, many = self.grids.few, self.grids.many
        solver, half = BEM(points=points), BEM(points=points // 2)
        most = max(many, round(self.surfaces * (LEAST_POINTS / points) ** 1.5))
        scenes = draws_of(self.scene, most)
        most = len(scenes)  # one of a smooth body
        fine, coarse = (
            [*SceneTask(each, scenes[:count]).solve().rows] for each, count in ((solver, few), (half, many))
        )
        stands_in = most >= many and self._alike(fine, coarse)
        while stands_in and not self._both_known(fine, coarse):
            spread, apart = self._spreads(fine, coarse)
            # The greatest gain in variance for what it costs.
            finer = apart / len(fine) > sqrt(DEARER) * spread / len(coarse)
            if finer and len(fine) + few <= len(coarse):
                fine += SceneTask(solver, scenes[len(fine) : len(fine) + few]).solve().rows
            elif len(coarse) < most:
                coarse += SceneTask(half, scenes[len(coarse) : len(coarse) + many]).solve().rows
            else:
                break
        if not stands_in:
            coarse, most = coarse[:few], min(most, max(few, most // round(DEARER)))
        while not stands_in and len(fine) < most and not self._known(fine):
            fine += SceneTask(solver, scenes[len(fine) : len(fine) + few]).solve().rows
        yield from self._told(FINE, solver, fine)
        yield from self._told(HALF, half, coarse)

    @staticmethod
    def _told(grid, solver, rows) -> Iterator[Row]:
        told = {"solver": solver.name, "grid": grid, "points": solver.points}
        return (replace(row, measures={}, settings=told) for row in rows)

    def _values(self, rows):
        """Friction coefficient of each row (N,); of a scene at rest its depth, or its force at a depth."""
        at_rest = "depth" if self.scene.motion.pressed_by == "load" else "normal_force"
        name = "friction_coefficient" if getattr(self.scene.motion, "speed", 0.0) > 0 else at_rest
        return np.array([getattr(row, name) if row.reason is None else np.nan for row in rows])

    def _known(self, rows):
        """Whether the mean of rows has the standard error that is wanted."""
        values = self._values(rows)
        values = values[np.isfinite(values)]
        if values.size < self.grids.few:
            return False
        return bool(np.std(values, ddof=1) / sqrt(values.size) < self.wanted * abs(values.mean()))

    def _alike(self, fine, coarse):
        """Whether half the points answer to all of the first surfaces, much as all points do."""
        every, some = self._values(fine), self._values(coarse)[: len(fine)]
        if not (np.isfinite(every) & np.isfinite(some)).all():
            return False
        return bool(np.all(np.abs(some - every) <= ALIKE * np.abs(every)))

    def _spreads(self, fine, coarse):
        """Standard deviation of a surface on half the points, and of what all points change, relative."""
        every, some = self._values(fine), self._values(coarse)
        middle = abs(np.nanmean(some))
        if not middle:
            return inf, inf
        apart = every - some[: every.size]
        return float(np.nanstd(some, ddof=1) / middle), float(np.nanstd(apart, ddof=1) / middle)

    def _both_known(self, fine, coarse):
        spread, apart = self._spreads(fine, coarse)
        return sqrt(spread**2 / len(coarse) + apart**2 / len(fine)) < self.wanted


def finest_wave(rough: Any) -> float:
    """Shortest wave that a grid has to resolve [m]: of a map the one up to which nearly all of its slope is."""
    if isinstance(rough, SelfAffine) and rough.shortest is not None:
        return rough.shortest
    return Bands.of(rough).finest
