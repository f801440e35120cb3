"""Cost of contacts and of studies: work, by counting, which allocates surfaces; and time, for forecasts alone.

Work is a number of scene and settings, the same on every machine. Seconds are work times what a unit of it takes
on this machine, as half a second of solving shows once; the user's cache keeps it.
"""

import os
from collections.abc import Iterable
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from statistics import median

from bem3d import BEM
from bem3d.problem import row_width
from mdr1d import MDR
from scene import Kelvin, Program, Refused, Scene, Shear, Slide, SolveError, Solver, Sphere

from .task import Task
from .words import HOUR, seconds

CALIBRATION = 0.5  # of processor time [s]
CALIBRATING = BEM(points=64), Scene(Sphere(0.01), Kelvin(1e6, 1e-3), Slide(speed=0.1, load=1.0))
CALIBRATED = 6.3e5  # work of this contact, solved again and again: less than once, as its kernels are kept
COMMAND = 4e8  # work of a command besides its solves: to load, to judge, to draw and to write
SLOWEST = 1e-4  # seconds a unit of work takes at most: a kept number above is none
FEEDBACK = {"MDR": 25, "BEM": 8}  # solves until temperature and heat agree, with all that each of them checks
DAY = 24 * HOUR
MOST_DRAWS = 10_000  # rough surfaces or profiles that are averaged
MOST_VALUES = 1000  # speeds, loads or depths in a curve
MANY_CONTACTS = 300_000  # from which to build the tasks takes longer than a person waits
MOST_CONTACTS = 2_000_000  # of a study: more are too many to be held in memory


def work_of(solver: Solver, scene: Scene) -> float:
    """Work of a contact, in passes over a point of a grid, fitted to times; a model may state its own as `work`.

    Of a contact on a surface of its own, in a process that has solved others.
    """
    if not isinstance(solver, BEM | MDR):
        return getattr(solver, "work", 1.0)
    motion, rough = scene.motion, scene.roughness
    fed_back = scene.heating is not None and scene.heating.feedback is not None
    again, steps = FEEDBACK[solver.name] if fed_back else 1, 0
    modes = scene.solid.retardation()[2].size if getattr(motion, "speed", 0.0) else 0
    if isinstance(motion, Program):
        # Under a load every step takes twice as long.
        steps = _steps(solver, scene) * (1 if motion.pressed_by == "depth" else 2)
    if isinstance(solver, MDR):
        drawn = 3e4 + 12 * solver.points if rough is not None else 0.0
        return again * (2.5e4 + drawn + solver.points * (5 * steps or 2 + modes))
    row = row_width(scene) is not None
    area = solver.points if row else solver.points**2
    if steps:
        return steps * (5e4 + 15.0 * area)
    # Without a shortest wave the finest are as short as the grid holds.
    again *= 2 if rough is not None and getattr(rough, "shortest", 0.0) is None else 1
    if not modes:
        return again * (3.2e5 + 41.0 * area) * (5 if isinstance(motion, Shear) else 1)
    # A layer needs tables of its own.
    each = 3.2e5 + 3.0 * area**2 if row else 7.6e5 + 5e4 * modes + 95.0 * area
    return again * each * (5 if scene.layer is not None else 2) / 2


def _steps(solver, scene):
    """Steps in time of a Program; as stated where it is refused."""
    try:
        return solver.plan(scene).steps
    except (Refused, SolveError, ArithmeticError):
        return solver.steps


@cache
def seconds_per_work() -> float:
    """Processor time [s] of a unit of work on this machine, for forecasts alone; kept in the user's cache."""
    folder = os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache")
    kept = Path(folder, "crosscheck", "seconds-per-work.txt")
    with suppress(OSError, ValueError):
        if 0 < (found := float(kept.read_text(encoding="utf-8"))) < SLOWEST:
            return found
    (solver, scene), spent = CALIBRATING, list[float]()
    solver.solve(scene)  # which loads compiled code
    while sum(spent) < CALIBRATION:
        spent.append(solver.solve(scene).seconds)
    found = median(spent) / CALIBRATED
    with suppress(OSError):
        kept.parent.mkdir(parents=True, exist_ok=True)
        kept.write_text(str(found), encoding="utf-8")
    return found


@dataclass(frozen=True)
class Cost:
    """Upper bound of what a study takes.

    contacts : number of scenes that are solved
    work : of all of them, in units of `Task.work`
    """

    contacts: int = 0
    work: float = 0.0

    @classmethod
    def of(cls, tasks: Iterable[Task]) -> "Cost":
        """Cost of tasks that are built."""
        every = list(tasks)
        return cls(sum(task.count for task in every), sum(task.work for task in every))

    def __add__(self, other: "Cost") -> "Cost":
        return Cost(self.contacts + other.contacts, self.work + other.work)

    @property
    def seconds(self) -> float:
        """Processor time of the command [s], a forecast."""
        return (COMMAND + self.work) * seconds_per_work()

    def __str__(self) -> str:
        contacts = f"{self.contacts:,} contact{'' if self.contacts == 1 else 's'}"
        return f"{contacts} at most, about {seconds(self.seconds)} of processor time"

    def refuse(self, workers: int, yes: bool) -> None:
        """Raise Refused for what no memory holds, and without a yes for more than a day or for many contacts."""
        if self.contacts > MOST_CONTACTS:
            raise Refused(f"{self}: at most {MOST_CONTACTS:,} contacts are solved in one study")
        if (self.seconds > DAY * workers or self.contacts > MANY_CONTACTS) and not yes:
            why = "more than a day" if self.seconds > DAY * workers else f"more than {MANY_CONTACTS:,} contacts"
            raise Refused(f"{self}: {why} (workers = {workers}). Ask for less, or agree to it: --yes, yes=True")
