"""From a case to what has to be solved: points of curves, and the tasks of which each point is the average."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

from scene import Indent, Scene, Slide, Solver
from scene.protocol import refuse
from scene.scales import elastic_contact

from .cases import Case
from .exact import Exact
from .task import SceneTask as Task
from .task import draws_of as surfaces_of


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
