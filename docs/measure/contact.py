"""One scene solved in 1D and 3D on as many surfaces as its scatter asks for, as a task, and the ratio of both."""

from collections import namedtuple
from dataclasses import asdict, dataclass, replace
from math import ceil, hypot, inf, log, nan, pi, sqrt

import numpy as np

from bem3d import BEM
from compare.models.law.bands import Bands
from compare.solving.task import SCENES, Outcome, SceneTask, Task, draws_of
from compare.statistics.jackknife import off_the_ratio
from compare.trustmap.model import LAW
from compare.trustmap.table import NUMBERS
from mdr1d import MDR
from scene import Scene, SelfAffine

FINE, HALF = "fine", "coarse"  # grids of the rows of an outcome
LINE_POINTS, PROFILES, MOST_PROFILES = 4000, 40, 800  # of profiles; solved at once, and at most
LEAST_POINTS = 128
DEARER = 4.0  # a surface on all points than on half of them
# Half the points stand in for all where they change a surface by less than this, relative.
ALIKE = 0.2
STEEP = 0.95  # share of the mean square slope of a map that a grid has to resolve


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


# Ratio of the mean over profiles in 1D and the mean over surfaces in 3D, see `trustmap.model.Measurements`.
Ratio = namedtuple("Ratio", NUMBERS)


def resolving(first, shortest, points, pixels):
    """The least of some points, a side, with pixels to the shortest wave in the window of a first solve."""
    needed = pixels * first.settings.get("extent", inf) / shortest
    return next((each for each in points if each >= needed), points[-1])


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
    def label(self):
        """Short description for people."""
        return SceneTask(BEM(), (self.scene,)).label.replace("BEM", "MDR and BEM")

    @property
    def work(self):
        """Rough cost, in passes over a point of a grid."""
        rough = self.scene.roughness
        return 1e6 if rough is None else 2.5e7 * max(1.0, rough.longest / finest_wave(rough) / 5) ** 2

    @property
    def question(self):
        """Scene, and how well it is to be known."""
        (scene,) = SCENES.dump_python((self.scene,), mode="json")
        return {"trust": scene, "wanted": self.wanted, "surfaces": self.surfaces, "grids": asdict(self.grids)}

    def solve(self):
        """Solve until the means are known, or the surfaces are spent."""
        line, scenes = MDR(points=LINE_POINTS), draws_of(self.scene, MOST_PROFILES)
        (first,), rough = _solved(BEM(points=LEAST_POINTS), (self.scene,)), self.scene.roughness
        finest = inf if rough is None else finest_wave(rough)
        profiles = _labelled(FINE, line, self._until_known(line, scenes, PROFILES))
        return Outcome(
            (*profiles, *self._surfaces(resolving(first, finest, self.grids.points, self.grids.pixels)))
        )

    def fits(self, outcome):
        """Whether the stored outcome has any rows."""
        return bool(outcome.rows)

    def _until_known(self, solver, scenes, block, rows=()):
        """Rows of scenes, a block after the other, until their mean has the standard error that is wanted."""
        rows = list(rows)
        while len(rows) < len(scenes) and not self._known(rows):
            rows += _solved(solver, scenes[len(rows) : len(rows) + block])
        return rows

    def _surfaces(self, points):
        """Rows of surfaces on the fine grid, then on half its points."""
        few, many = self.grids.few, self.grids.many
        solver, half = BEM(points=points), BEM(points=points // 2)
        scenes = draws_of(self.scene, max(many, round(self.surfaces * (LEAST_POINTS / points) ** 1.5)))
        most = len(scenes)  # one of a smooth body
        fine, coarse = _solved(solver, scenes[:few]), _solved(half, scenes[:many])
        every, some = self._values(fine), self._values(coarse)[: len(fine)]
        # Whether half the points answer to all of the first surfaces, much as all points do.
        stands_in = most >= many and np.all(np.abs(some - every) <= ALIKE * np.abs(every))
        while stands_in:
            spread, apart = self._spreads(fine, coarse)
            if sqrt(spread**2 / len(coarse) + apart**2 / len(fine)) < self.wanted:
                break
            # The greatest gain in variance for what it costs.
            finer = apart / len(fine) > sqrt(DEARER) * spread / len(coarse)
            if finer and len(fine) + few <= len(coarse):
                fine += _solved(solver, scenes[len(fine) : len(fine) + few])
            elif len(coarse) < most:
                coarse += _solved(half, scenes[len(coarse) : len(coarse) + many])
            else:
                break
        if not stands_in:
            blocks = ceil(min(most, max(few, most // round(DEARER))) / few)
            coarse, fine = coarse[:few], self._until_known(solver, scenes[: blocks * few], few, fine)
        yield from _labelled(FINE, solver, fine)
        yield from _labelled(HALF, half, coarse)

    def _values(self, rows):
        """Friction coefficient of each row (N,); of a scene at rest its depth, or its force at a depth."""
        at_rest = "depth" if self.scene.motion.pressed_by == "load" else "normal_force"
        name = "friction_coefficient" if getattr(self.scene.motion, "speed", 0.0) > 0 else at_rest
        return np.array([getattr(row, name) for row in rows])

    def _known(self, rows):
        values = self._values(rows)
        values = values[np.isfinite(values)]
        enough = values.size >= self.grids.few
        return enough and np.std(values, ddof=1) / sqrt(values.size) < self.wanted * abs(values.mean())

    def _spreads(self, fine, coarse):
        """Standard deviation of a surface on half the points, and of what all points change, relative."""
        every, some = self._values(fine), self._values(coarse)
        middle = abs(np.nanmean(some)) or nan
        return (np.nanstd(each, ddof=1) / middle for each in (some, every - some[: every.size]))


def _solved(solver, scenes):
    return [*SceneTask(solver, scenes).solve().rows]


def _labelled(grid, solver, rows):
    settings = {"solver": solver.name, "grid": grid, "points": solver.points}
    return (replace(row, measures={}, settings=settings) for row in rows)


def finest_wave(rough):
    """Shortest wave that a grid has to resolve [m]: of a map the one up to which nearly all of its slope is."""
    if isinstance(rough, SelfAffine) and rough.shortest is not None:
        return rough.shortest
    bands = Bands.of(rough)
    slopes = np.cumsum(bands.power * np.square(bands.q))
    return 2 * pi / float(bands.q[np.searchsorted(slopes, STEEP * slopes[-1])])


def ratio_of(outcome, quantity, law=nan):
    """Ratio of a quantity, of all draws that were solved; law : friction coefficient that the law makes of it."""
    space = _space(outcome, "friction" if quantity == LAW else quantity)
    line = Mean(law, 0.0, inf) if quantity == LAW else _mean(_rows(outcome, "MDR", FINE), quantity)[0]
    above = line.value > 0 and space.value > 0
    return Ratio(
        logarithm=log(line.value / space.value) if above else nan,
        line_error=line.scatter / sqrt(line.draws) if line.draws else nan,
        scatter=space.scatter,
        surfaces=space.draws,
        grid=space.grid,
    )


# Mean over draws, the relative standard deviation of one, and how many know it as well; see `Ratio.grid`.
Mean = namedtuple("Mean", "value scatter draws grid", defaults=[nan])


def _space(outcome, quantity):
    """Mean over surfaces: where most are on half the points, theirs, times what all points change on the first."""
    fine, half = (_rows(outcome, "BEM", grid) for grid in (FINE, HALF))
    pairs = [pair for pair in zip(fine, half, strict=False) if all(row.reason is None for row in pair)]
    (every, changes), (some, on_half) = (_mean([pair[k] for pair in pairs], quantity) for k in (0, 1))
    grid = every.value / some.value - 1 if some.value else nan
    if len(half) <= len(fine) or len(pairs) < 2:
        return _mean(fine, quantity)[0]._replace(grid=grid)
    many, _ = _mean(half, quantity)
    error = hypot(many.scatter / sqrt(many.draws), np.linalg.norm(changes - on_half))
    known = many.scatter**2 / error**2 if error else many.draws
    return Mean(many.value * (1 + grid), many.scatter, min(known, many.draws), grid)


def _rows(outcome, solver, grid):
    asked = {"solver": solver, "grid": grid}
    return [row for row in outcome.rows if asked.items() <= row.settings.items()]


def _mean(rows, quantity):
    """Mean of the draws that were solved, and its relative change with each: the squares sum to its variance."""
    name = {"friction": "friction_force", "depth": "depth", "force": "normal_force"}[quantity]
    over = [row.normal_force for row in rows] if quantity == "friction" else 1.0
    value, changes, count = off_the_ratio([getattr(row, name) for row in rows], over)
    with np.errstate(divide="ignore", invalid="ignore"):
        scatter = np.linalg.norm(changes) * sqrt(count) / abs(value)
        return Mean(float(value), float(scatter), int(count)), changes / value
