"""One scene at every speed and press of a rectangle, always on the same surfaces."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np

from bem3d import BEM
from mdr1d import MDR
from scene import Indent, Program, Scene, Slide, Stage
from scene.motion import Motion
from scene.protocol import refuse

from ..outcome import Outcome
from ..statistics.jackknife import mean_ratio
from ..store import Task as AnyTask
from ..study import Task, surfaces_of

ROUGH, REST, SMOOTH, SMOOTH_REST = "rough", "rest", "smooth", "smooth rest"
FINE, COARSE = "fine", "coarse"
# What is asked of answers: shifts of curves (Eq. 23), friction in each dimensionality (Eqs. 14 to 19), depth and
# force in each, all that compares the dimensionalities, and what compares several series.
COLLAPSE, FRICTION, DEPTH, PAIRS, FAMILIES = CLAIMS = "collapse", "friction", "depth", "dimensions", "families"
# Of the contact itself, by solver: the area [m^2] or the length [m] that touches.
CONTACT = {"BEM": "contact_area", "MDR": "contact_length"}


@dataclass(frozen=True)
class Series:
    """A rectangle of points around one rough scene, in both dimensionalities and on two grids each.

    name, title : for files and for people
    scene : its motion says whether load or depth is prescribed; that of a Program is pressed in from nothing at a
        constant rate, and all other scenes slide
    speeds : of sliding, or the rates of pressing in [m/s]; none where only rest is asked for
    presses : loads [N] or depths [m]
    surfaces, profiles : drawn in three and in one dimension, with the seeds from that of the scene on
    bem, mdr : the finer settings; the coarser have half the points, and half the steps in time
    note : what is to be said of it, for the report
    claims : which of CLAIMS are judged
    """

    name: str
    title: str
    scene: Scene
    speeds: tuple[float, ...]
    presses: tuple[float, ...]
    surfaces: int
    profiles: int
    bem: BEM
    mdr: MDR
    note: str = ""
    claims: tuple[str, ...] = CLAIMS

    @property
    def pressed_by(self) -> str:
        """load or depth."""
        return self.scene.motion.pressed_by

    def drawn(self, solver: str) -> int:
        """Surfaces or profiles of a solver."""
        return self.profiles if solver == self.mdr.name else self.surfaces

    @property
    def slides(self) -> bool:
        """Whether speeds are those of sliding."""
        return bool(self.speeds) and not isinstance(self.scene.motion, Program)

    def at(self, press: float, speed: float = 0.0) -> Scene:
        """The scene pressed so, at rest or at a speed."""
        pressed: dict[str, Any] = {self.pressed_by: press}
        motion: Motion = Indent(**pressed)
        if speed and isinstance(self.scene.motion, Program):
            motion = Program(stages=(Stage(duration=press / speed, **pressed),))
        elif speed:
            motion = Slide(speed=speed, **pressed)
        return replace(self.scene, motion=motion)


class Key(NamedTuple):
    """Which answers of a series: solver's name, body and motion, grid."""

    solver: str
    body: str
    grid: str


@dataclass(frozen=True)
class Block:
    """Tasks of one key, (speeds, presses); each is a tuple whose rows are surface after surface."""

    points: int
    tasks: tuple[tuple[tuple[Task, ...], ...], ...]


@dataclass(frozen=True)
class Answers:
    """What came of a block: arrays (speeds, presses, surfaces), NaN where a solve failed or nothing touched.

    points : of the grid
    normal_force, friction_force [N], depth [m]
    contact : area [m^2] or length [m] in contact
    measures : what both solvers call by these names, and what each has of its own
    reasons : of the solves that failed, with what failed
    seconds : processor time of all
    """

    points: int
    normal_force: np.ndarray
    friction_force: np.ndarray
    depth: np.ndarray
    contact: np.ndarray
    measures: Mapping[str, np.ndarray]
    reasons: tuple[tuple[str, str], ...]
    seconds: float

    @property
    def friction(self) -> np.ndarray:
        """Coefficient of the means over surfaces, (speeds, presses)."""
        return mean_ratio(self.friction_force, self.normal_force).value


@dataclass(frozen=True)
class Solved:
    """A series with its answers by key; keys that were not asked for are missing."""

    series: Series
    answers: Mapping[Key, Answers]

    def __call__(self, solver: str, body: str = ROUGH, grid: str = FINE) -> Answers:
        """Those of a key that was asked for. Raises KeyError for another."""
        return self.answers[Key(solver, body, grid)]

    def get(self, solver: str, body: str = ROUGH, grid: str = FINE) -> Answers | None:
        """The same, None where they were not asked for."""
        return self.answers.get(Key(solver, body, grid))


def blocks(series: Series) -> dict[Key, Block]:
    """Everything that is solved of a series.

    Raises Refused if a solver lacks what a scene asks for, ValueError if the scene has no roughness.
    """
    if series.scene.roughness is None:
        raise ValueError(f"{series.title}: a series asks what roughness does, and this scene has none")
    found = {}
    for finest, draws in ((series.mdr, series.profiles), (series.bem, series.surfaces)):
        half = replace(finest, points=finest.points // 2, steps=max(1, finest.steps // 2))
        for grid, solver in ((FINE, finest), (COARSE, half)):
            for body, stripped, speeds in _bodies(series):
                found[Key(solver.name, body, grid)] = _block(stripped, solver, speeds, draws)
    return found


def tasks(series: Series) -> list[Task]:
    """All of them, each once."""
    every = (task for block in blocks(series).values() for row in block.tasks for point in row for task in point)
    return list({(task.solver, task.scenes): task for task in every}.values())


def collect(series: Series, outcomes: Mapping[AnyTask, Outcome]) -> Solved:
    """Put the answers of a series together."""
    return Solved(series, {key: _answers(key, block, outcomes) for key, block in blocks(series).items()})


def _bodies(series):
    """Which bodies are solved, and at which speeds."""
    smooth = replace(series, scene=replace(series.scene, roughness=None))
    if series.speeds:
        yield ROUGH, series, series.speeds
        yield SMOOTH, smooth, series.speeds
    yield REST, series, (0.0,)
    yield SMOOTH_REST, smooth, (0.0,)


def _block(series, solver, speeds, draws):
    """One dimension takes all profiles of a point in one task, three take a task a surface."""
    rows = []
    for speed in speeds:
        points = []
        for press in series.presses:
            scene = series.at(press, speed)
            refuse(solver, scene)
            drawn = surfaces_of(scene, draws)
            together = (drawn,) if isinstance(solver, MDR) else tuple((each,) for each in drawn)
            points.append(tuple(Task(solver, scenes, work=_work(solver, scenes)) for scenes in together))
        rows.append(tuple(points))
    return Block(solver.points, tuple(rows))


def _work(solver, scenes):
    """In passes over a point of a grid, roughly."""
    each = solver.points**2.2 * 50.0
    if isinstance(solver, MDR):
        each = solver.points * 15.0 * max(1, scenes[0].elastomer.relaxation()[2].size)
    steps = solver.steps if isinstance(scenes[0].motion, Program) else 1
    return len(scenes) * each * steps


def _answers(key: Key, block: Block, outcomes: Mapping[AnyTask, Outcome]) -> Answers:
    labelled = [
        [[(task.label, row) for task in point for row in outcomes[task].rows] for point in row]
        for row in block.tasks
    ]
    rows = [[[row for _, row in point] for point in line] for line in labelled]
    flat = [pair for line in labelled for point in line for pair in point]
    names = sorted({name for _, row in flat for name in row.measures})
    measures = {name: _array(rows, lambda row, name=name: row.measures.get(name, np.nan)) for name in names}
    touched = _array(rows, lambda row: row.normal_force) > 0

    def where_touched(name):
        return np.where(touched, _array(rows, lambda row: getattr(row, name)), np.nan)

    return Answers(
        points=block.points,
        normal_force=_array(rows, lambda row: row.normal_force),
        friction_force=where_touched("friction_force"),
        depth=_array(rows, lambda row: row.depth),
        contact=measures.get(CONTACT[key.solver], np.full(touched.shape, np.nan)),
        measures=measures,
        reasons=tuple((label, row.reason) for label, row in flat if row.reason is not None),
        seconds=float(np.nansum([row.seconds for _, row in flat])),
    )


def _array(rows: Sequence, number) -> np.ndarray:
    return np.array([[[number(row) for row in point] for point in line] for line in rows])
