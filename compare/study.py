"""From a case to what has to be solved: points of curves, and the tasks of which each point is the average."""

from collections.abc import Iterator
from dataclasses import asdict, dataclass, replace
from math import nan

from pydantic import TypeAdapter

from scene import EmptyContact, Indent, Program, Scene, SelfAffine, Slide, SolveError, Solver, Topography
from scene.motion import UNITS
from scene.protocol import refuse
from scene.scales import elastic_contact

from .cases import Case
from .exact import Exact
from .outcome import Outcome, Row, row

SCENES = TypeAdapter(tuple[Scene, ...])


@dataclass(frozen=True)
class Task:
    """A task, as of store: scenes that differ only in the seed of their roughness.

    solver, scenes : what is solved
    keeps_fields : whether the fields of the first scene are kept, for pictures
    work : see store
    """

    solver: Solver
    scenes: tuple[Scene, ...]
    keeps_fields: bool = False
    work: float = 1.0

    @property
    def label(self) -> str:
        """Short description for people."""
        scene = self.scenes[0]
        motion, rough = scene.motion, scene.roughness
        seed = getattr(rough, "seed", None)
        body = "smooth" if rough is None else "waves" if seed is None else f"surface {seed}"
        if len(self.scenes) > 1:
            body = f"{len(self.scenes)} profiles"
        pressed, moved = _pressed(motion), _moving(motion)
        return f"{self.solver.name} {type(scene.indenter).__name__.lower()} {pressed}, {moved}, {body}"

    @property
    def question(self) -> dict:
        """The scenes, and the solver by its name and settings."""
        scenes = SCENES.dump_python(self.scenes, mode="json")
        return {"scenes": scenes, "solver": self.solver.name, "settings": asdict(self.solver)}

    @property
    def packages(self) -> tuple[str, ...]:
        """That of the scenes and that of the solver."""
        return "scene", type(self.solver).__module__.split(".")[0]

    def solve(self) -> Outcome:
        """Solve every scene, one after the other.

        An empty contact has forces of zero; any other SolveError becomes a row of NaN with its reason; any other
        exception is a fault and is raised.
        """
        rows, fields = [], {}
        for scene in self.scenes:
            try:
                result = self.solver.solve(scene)
            except EmptyContact:
                depth = scene.motion.greatest if scene.motion.pressed_by == "depth" else nan
                rows.append(Row(0.0, depth, 0.0, residual=0.0, applications=0.0, seconds=0.0))
                continue
            except SolveError as error:
                rows.append(Row(reason=str(error) or type(error).__name__))
                continue
            if self.keeps_fields and not rows:
                fields = dict(result.fields)
            rows.append(row(result))
        return Outcome(tuple(rows), fields)

    def failed(self, reason: str) -> Outcome:
        """A row a scene, each with the reason."""
        return Outcome((Row(reason=reason),) * len(self.scenes))

    def fits(self, outcome: Outcome) -> bool:
        """A row a scene."""
        return len(outcome.rows) == len(self.scenes)


def _pressed(motion):
    """What presses, with its unit; depths in micrometres."""
    value, unit = motion.greatest, UNITS[motion.pressed_by]
    return f"{value * 1e6:.3g} µm" if unit == "m" else f"{value:.3g} {unit}"


def _moving(motion):
    if isinstance(motion, Program):
        return f"{len(motion.stages)} stages"
    return f"{motion.speed:.3g} m/s" if motion.speed else "at rest"


@dataclass(frozen=True)
class Point:
    """One point of one curve: the mean over the scenes of its tasks.

    kind : own, force-depth, speed, load, smooth, coarse or refined; a refined point repeats the coarse one, the
        same single surface, with twice the points in every direction
    """

    kind: str
    tasks: tuple[Task, ...]

    @property
    def scene(self) -> Scene:
        """The first of its scenes; the others differ in the seed."""
        return self.tasks[0].scenes[0]

    @property
    def solver(self) -> str:
        return self.tasks[0].solver.name


def points(case: Case) -> list[Point]:
    """Every point of every curve of a case. Raises Refused if any of them asks for what its solver lacks."""
    found = [*_own(case), *_force_depth(case), *_speed(case), *_load(case), *_smooth(case)]
    for point in found:
        for task in point.tasks:
            refuse(task.solver, task.scenes[0])
    return found


def tasks(found: list[Point]) -> list[Task]:
    """The tasks behind points, each once: curves that cross share the point where they do."""
    unique = {(task.solver, task.scenes): task for point in found for task in point.tasks}
    return list(unique.values())


def _own(case: Case) -> Iterator[Point]:
    """The scene as it stands, and its first surface on a grid twice as fine."""
    yield from _both(case, "own", case.scene)
    yield from _refined(case, case.scene)


def _force_depth(case: Case) -> Iterator[Point]:
    depth = elastic_contact(case.scene).depth
    for factor in case.plan().depths:
        pressed = replace(case.scene, motion=Indent(depth=factor * depth))
        smooth = replace(pressed, roughness=None)
        yield from _both(case, "force-depth", pressed)
        if case.roughness:
            yield from _both(case, "force-depth", smooth)
        if not Exact().refusals(smooth):
            yield Point("force-depth", (_task(case, Exact(), (smooth,)),))


def _speed(case: Case) -> Iterator[Point]:
    for speed in case.plan().speeds:
        yield from _both(case, "speed", _moved(case.scene, speed))


def _load(case: Case) -> Iterator[Point]:
    plan = case.plan()
    for speed in plan.load_speeds:
        for factor in plan.pressing:
            yield from _both(case, "load", _moved(case.scene, speed, factor))


def _smooth(case: Case) -> Iterator[Point]:
    """The smooth body at every speed, the slowest once more on a finer grid: the limit 2 is measured there."""
    speeds = case.plan().smooth_speeds
    smooth = replace(case.scene, roughness=None)
    for speed in speeds:
        yield from _both(case, "smooth", _moved(smooth, speed))
    if speeds:
        yield from _refined(case, _moved(smooth, min(speeds)))


def _refined(case: Case, scene: Scene) -> Iterator[Point]:
    """One surface on two grids, for the error of discretisation; none where the grid cuts the surface off."""
    if scene.roughness is not None and scene.roughness.shortest is None:
        return
    fine = replace(case.bem, points=2 * case.bem.points)
    yield Point("coarse", (_task(case, case.bem, (scene,)),))
    yield Point("refined", (_task(case, fine, (scene,)),))


def _moved(scene: Scene, speed: float, factor: float = 1.0) -> Scene:
    motion = scene.motion
    load = motion.load and motion.load * factor
    depth = motion.depth and motion.depth * factor
    return replace(scene, motion=Slide(speed=speed, load=load, depth=depth))


def _both(case: Case, kind: str, scene: Scene) -> Iterator[Point]:
    """The same point in one dimension, all its profiles in one task, and in three, one task a surface."""
    plan = case.plan()
    yield Point(kind, (_task(case, case.mdr, surfaces_of(scene, plan.profiles)),))
    yield Point(kind, tuple(_task(case, case.bem, (drawn,)) for drawn in surfaces_of(scene, plan.surfaces)))


def surfaces_of(scene: Scene, count: int) -> tuple[Scene, ...]:
    """The scene with seeds seed, seed + 1, ...; a body that is smooth or has plain waves has one surface."""
    rough = scene.roughness
    if not isinstance(rough, SelfAffine | Topography):
        return (scene,)
    return tuple(replace(scene, roughness=replace(rough, seed=rough.seed + k)) for k in range(count))


def _task(case: Case, solver: Solver, scenes: tuple[Scene, ...]) -> Task:
    own = solver in (case.mdr, case.bem) and scenes[0] == case.scene
    return Task(solver, scenes, keeps_fields=own, work=_work(case, solver, scenes))


def _work(case, solver, scenes):
    """In passes over a node: transforms of a 3D solve, more the finer its grid; a dozen sweeps of a 1D solve."""
    if isinstance(solver, type(case.bem)):
        return len(scenes) * solver.points**2.5 * (25.0 if scenes[0].motion.speed else 5.0)
    if isinstance(solver, type(case.mdr)):
        return len(scenes) * solver.points * 15.0
    return 1.0
