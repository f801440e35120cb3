"""One scene solved with one choice of settings, alone in a process, with all that it costs."""

import platform
import sys
import time
from collections.abc import Callable
from dataclasses import asdict, dataclass, replace
from math import nan
from typing import Protocol, Self

from scene import Plane, Refused, Result, Scene, SelfAffine, SolveError, Solver
from scene.protocol import lacking

from ...solving.outcome import Outcome, Row, row
from ...solving.task import SCENES, SceneTask

# A solve is repeated until so many seconds have gone, at least and at most as often as said; once, if it is long.
SECONDS, LEAST, MOST, LONG = 1.0, 3, 50, 6.0
# Settings of the solve that loads compiled code before anything is measured.
WARM = {"points": 64, "steps": 20}
COSTS = ("processor", "wall", "memory")


class OnGrid(Solver, Protocol):
    """A solver that has a grid."""

    @property
    def points(self) -> int:
        """Points along each side."""

    @property
    def steps(self) -> int:
        """Steps in time, of a Program."""


@dataclass(frozen=True)
class TimedSolve(SceneTask):
    """One scene, solved until its least time is known. It wants a process of its own.

    Row.measures has, besides those of the result, processor and wall [s], each the least of the repeats, from the
    scene to the result; memory [bytes], by which the first raised the peak of the process; and repeats.
    """

    @classmethod
    def of(cls, solver: Solver, scene: Scene) -> Self:
        """The scene with the solver, its work as expected."""
        return cls(solver, (scene,), work=work(solver))

    @property
    def scene(self) -> Scene:
        """The scene."""
        return self.scenes[0]

    @property
    def label(self) -> str:
        """Short description for people."""
        points = getattr(self.solver, "points", 0)
        return f"{self.solver.name}, {points} points, {type(self.scene.indenter).__name__.lower()}"

    @property
    def question(self) -> dict:
        """The scene, the solver by its name and settings, and the machine."""
        (scene,) = SCENES.dump_python(self.scenes, mode="json")
        asked = {"scene": scene, "solver": self.solver.name, "settings": asdict(self.solver)}
        if not self.portable:
            asked["source"] = super().question["source"]
        return {"timed": asked, "machine": [platform.machine(), platform.node()]}

    @property
    def packages(self) -> tuple[str, ...]:
        """Packages of the scene, of the solver and of this measurement."""
        return *super().packages, __name__

    def solve(self) -> Outcome:
        """The numbers of the last repeat, with the costs; NaN with its reason where the solve fails."""
        self._warm_up()
        try:
            result, costs = _measured(lambda: self.solver.solve(self.scene))
        except (Refused, SolveError) as error:
            return Outcome((Row(reason=str(error) or type(error).__name__),))
        found = row(result)
        return Outcome((replace(found, measures={**found.measures, **costs}),))

    def _warm_up(self):
        """Solve the scene on few points, smooth where its roughness is refused on so few; failing is no matter.

        A plane keeps its roughness without its short waves.
        """
        less = {name: min(most, held) for name, most in WARM.items() if (held := getattr(self.solver, name, 0))}
        few = replace(self.solver, **less)
        scene, rough = self.scene, self.scene.roughness
        if lacking(few, scene) and isinstance(rough, SelfAffine):
            cut_off = replace(rough, shortest=None) if isinstance(scene.indenter, Plane) else None
            scene = replace(scene, roughness=cut_off)
        try:
            few.solve(scene)
        except (SolveError, ValueError):
            return


def work(solver: Solver) -> float:
    """Work of one solve, in passes over a point of a grid, roughly; 1 of a model without points."""
    if not hasattr(solver, "points"):
        return 1.0
    return solver.points * 5.0 if solver.name == "MDR" else solver.points**2.2 * 50.0


def _measured(solve: Callable[[], Result]) -> tuple[Result, dict[str, float]]:
    held, memory, spent, started = _peak(), nan, [], time.perf_counter()
    while True:
        processor, wall = time.process_time(), time.perf_counter()
        result = solve()
        spent.append((time.process_time() - processor, time.perf_counter() - wall))
        if len(spent) == 1:
            memory = _peak() - held
        passed = time.perf_counter() - started
        if passed > LONG or len(spent) >= MOST or (passed > SECONDS and len(spent) >= LEAST):
            least = (min(times) for times in zip(*spent, strict=True))
            return result, dict(zip(COSTS, (*least, memory), strict=True)) | {"repeats": float(len(spent))}


def _peak() -> float:
    """Largest memory that the process has held so far [bytes]; NaN where the system does not say."""
    try:
        # Since the process began, where getrusage counts from the parent that it was forked from.
        with open("/proc/self/status", encoding="ascii") as status:
            return 1024 * next(float(line.split()[1]) for line in status if line.startswith("VmHWM"))
    except (OSError, StopIteration):
        return _peak_of_usage()


def _peak_of_usage() -> float:
    try:
        import resource
    except ImportError:
        return nan
    unit = 1 if sys.platform == "darwin" else 1024
    return float(unit * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)
