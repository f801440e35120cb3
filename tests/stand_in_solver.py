"""A solver that answers at once, gives up, breaks or dies as its settings ask, for tests of what runs solvers."""

import os
import signal
import time
from concurrent.futures import Future
from dataclasses import replace
from pathlib import Path

from pydantic.dataclasses import dataclass

from compare.solving.executors import ONE_THREAD
from compare.solving.runner import Progress
from compare.solving.task import SceneTask as Task
from scene import Indent, Kelvin, Result, Scene, SolveError, Sphere

SCENE = Scene(Sphere(radius=1e-2), Kelvin(modulus=1e6, relaxation_time=1e-3), Indent(load=1.0))


@dataclass(frozen=True)
class Stand:
    """Answers at once, leaving a mark; gives up above a load, breaks above a higher one, dies above the highest.

    dies : how often a worker dies of it; it answers then
    """

    gives_up_above: float = 100.0
    breaks_above: float = 1000.0
    dies_above: float = 10000.0
    dies: int = 99
    marks: str = ""
    seconds: float = 0.0
    name: str = "stand"

    def refusals(self, scene):
        return []

    def solve(self, scene):
        load = scene.motion.load
        time.sleep(self.seconds)
        if self.marks:
            Path(self.marks, f"{load:g}-{time.monotonic_ns()}-{os.getpid()}").touch()
        if load > self.dies_above and len(list(Path(self.marks).glob(f"{load:g}-*"))) <= self.dies:
            os.kill(os.getpid(), signal.SIGKILL)
        if load > self.dies_above:
            load = self.gives_up_above
        if load > self.breaks_above:
            raise ZeroDivisionError("a fault in the solver")
        if load > self.gives_up_above:
            raise SolveError(f"{load:g} N is too much; press less")
        threads = {name: float(os.environ.get(name, "nan")) for name in ONE_THREAD}
        measures = threads | {"process": float(os.getpid())}
        return Result(scene, self.name, {}, load, 1e-4 * load, 0.0, 0.0, 1.0, 0.25, measures, {"x": [load]})


def loads(*values, solver=None):
    return [Task(solver or Stand(), (replace(SCENE, motion=Indent(load=value)),), work=value) for value in values]


def marks(folder, load="*"):
    """How many solves of a load, or of all, left a mark in a folder."""
    return len(list(folder.glob(f"{load}-*")))


def forces(swept, tasks):
    """Forces that were found by tasks, each of a single scene."""
    return [swept.outcomes[task].rows[0].normal_force for task in tasks]


def every_bit(row):
    """All of a row to the last bit but the payload of NaN, -0.0 apart from 0.0."""
    return repr(replace(row, measures=sorted(row.measures.items()), settings=sorted(row.settings.items())))


def exactly(outcome):
    """All of its numbers, to the last digit, but for the seconds that were measured."""
    return [every_bit(replace(row, seconds=0.0)) for row in outcome.rows]


class Heard(Progress):
    def __init__(self):
        self.said_lines = []
        self.heard = []

    def planned(self, tasks, reused):
        self.heard.append(("planned", [task.work for task in tasks], reused))

    def started(self, task):
        self.heard.append(("started", task.work))

    def finished(self, task, outcome):
        self.heard.append(("finished", task.work))

    def message(self, line):
        self.said_lines.append(line)

    def interrupted(self):
        self.heard.append(("interrupted", None))


class Here:
    """An executor in this process, for laws that no process of another has a part in."""

    def submit(self, function, *given):
        future = Future()
        future.set_result(function(*given))
        return future
