"""Task: what a worker solves in one go, its outcome, and scenes of a solver as such a task."""

import sys
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from importlib import import_module
from inspect import getsource
from math import isfinite, nan
from time import process_time
from typing import Any, NamedTuple, Protocol

import numpy as np
from pydantic import TypeAdapter

from scene import EmptyContact, Program, Refused, Result, Scene, SolveError, Solver
from scene.motion import UNITS

NUMBERS = ("normal_force", "depth", "friction_force", "residual", "operator_applications", "seconds")
# Names that a row has besides the measures of a model, which may not use them.
TAKEN = {*NUMBERS, "level", "speed", "load", "surface", "points", "stratum", "variate", "control_variates"} | {
    "friction_coefficient", "depth_reached", "status", "reason"
}  # fmt: skip


@dataclass(frozen=True)
class Row:
    """The numbers of a solved scene, as in Result; NaN with a reason where the solve failed.

    finer : which of the finer grids of its task answered; 0 where the solver itself did
    """

    normal_force: float = nan
    depth: float = nan
    friction_force: float = nan
    residual: float = nan
    operator_applications: float = nan
    seconds: float = nan
    measures: Mapping[str, float] = field(default_factory=dict)
    settings: Mapping[str, Any] = field(default_factory=dict)
    reason: str | None = None
    finer: int = 0

    @property
    def friction_coefficient(self) -> float:
        """mu = F_x / F_N; NaN where nothing carries a load."""
        return self.friction_force / self.normal_force if self.normal_force else nan


@dataclass(frozen=True)
class Outcome:
    """The rows of a task, one a scene, and the fields of its first scene if the task keeps them."""

    rows: tuple[Row, ...]
    fields: Mapping[str, np.ndarray] = field(default_factory=dict, repr=False)


def row(result: Result) -> Row:
    """The numbers of a result, as plain Python numbers. Raises SolveError of measures that no table can hold."""
    if taken := sorted(TAKEN & result.measures.keys()):
        raise SolveError(f"measure {taken[0]!r}: the name has another use, choose another")
    numbers: dict[str, Any] = {name: float(getattr(result, name)) for name in NUMBERS}
    return Row(
        **numbers,
        measures={name: float(value) for name, value in result.measures.items()},
        settings={name: _plain(value) for name, value in result.settings.items()},
    )


def reason_of(error: BaseException) -> str:
    """Message of an error in a line; its type where it has none."""
    return " ".join(str(error).split()) or type(error).__name__


def _plain(value):
    value = value.item() if isinstance(value, np.generic) else value
    return value if isinstance(value, str | int | float | bool | None) else str(value)


REFUSED = "refused: "  # before the reason of a model that refuses in its solve
SCENES = TypeAdapter(tuple[Scene, ...])


class Task(Protocol):
    """Task that one worker solves in one go; equal tasks have equal answers.

    label : short description for people
    work : rough cost, in units that are the same for all tasks; it orders them and tells how far they are
    question : everything that the answer depends on except code, as JSON can hold it
    packages : names of the packages whose code the answer depends on
    keeps_fields : whether the outcome has fields
    count : number of rows of its outcome
    """

    @property
    def label(self) -> str: ...

    @property
    def work(self) -> float: ...

    @property
    def question(self) -> Mapping[str, Any]: ...

    @property
    def packages(self) -> Sequence[str]: ...

    @property
    def keeps_fields(self) -> bool:
        return False

    @property
    def count(self) -> int:
        return 1

    def solve(self) -> Outcome:
        """Solve, and return the outcome."""

    def failed(self, reason: str) -> Outcome:
        """Outcome where there is no answer: as many rows, all NaN, each with the reason."""
        return Outcome((Row(reason=reason),) * self.count)

    def fits(self, outcome: Outcome) -> bool:
        """Whether a stored outcome is whole."""
        return len(outcome.rows) == self.count


class Batch(NamedTuple):
    """Tasks solved together. timed : one after the other in a process each, as their times are measured."""

    tasks: Sequence[Task]
    timed: bool = False


@dataclass(frozen=True)
class SceneTask(Task):
    """Scenes that differ only in the seed of their roughness, answered by one solver; equal if these are.

    finer : the solver on finer grids; where the solver has no answer, the first of them that has one is taken
    keeps_fields : whether the fields of the first scene are kept, for pictures
    work : rough cost, see `Task`
    """

    solver: Solver
    scenes: tuple[Scene, ...]
    finer: tuple[Solver, ...] = ()
    keeps_fields: bool = field(default=False, compare=False)
    work: float = field(default=1.0, compare=False)

    @property
    def label(self) -> str:
        """Short description for people."""
        scene = self.scenes[0]
        rough = scene.roughness
        seed = getattr(rough, "seed", None)
        body = "smooth" if rough is None else "waves" if seed is None else f"surface {seed}"
        if len(self.scenes) > 1:
            body = f"{len(self.scenes)} profiles"
        shape = type(scene.indenter).__name__.lower()
        return f"{self.solver.name} {shape} {conditions(scene.motion)}, {body}"

    @property
    def count(self) -> int:
        """A row for each scene."""
        return len(self.scenes)

    @property
    def question(self) -> dict:
        """The scenes, and the solver by its name and settings; its source too, where it is in no module."""
        scenes = SCENES.dump_python(self.scenes, mode="json")
        asked = {"scenes": scenes, "solver": self.solver.name, "settings": asdict(self.solver)}
        asked |= {"finer": [asdict(each) for each in self.finer]} if self.finer else {}
        return asked if self.portable else asked | {"source": _source(type(self.solver))}

    @property
    def packages(self) -> tuple[str, ...]:
        """Packages of the scenes, those that the solver names, and the outermost of its classes that name none."""
        kinds = type(self.solver).__mro__
        own = [kind.__module__ for kind in kinds if "packages" not in vars(kind) and _importable(kind)]
        named = getattr(self.solver, "packages", ())
        return tuple(dict.fromkeys(["scene", *named, *(module.partition(".")[0] for module in own)]))

    @property
    def portable(self) -> bool:
        """Whether another process can import the class of the solver: not of a script, a notebook, a function."""
        return _importable(type(self.solver))

    def solve(self, *warm_start: Any) -> Outcome:
        """Solve every scene, one after the other.

        warm_start : of neighbouring contacts, for a solver that begins where they were

        An empty contact has forces of zero; Refused, NotImplementedError and any other SolveError become a row of
        NaN with its reason; any other exception is a fault of the program and is raised.
        """
        rows, fields = [], {}
        for scene in self.scenes:
            found, result = _answer(self.solver, scene, warm_start)
            for number, solver in enumerate(self.finer if found.reason is not None else (), 1):
                other, result = _answer(solver, scene, warm_start)
                if other.reason is None:
                    found = replace(other, finer=number)
                    break
            rows.append(found)
            if self.keeps_fields and len(rows) == 1 and result is not None:
                fields = dict(result.fields)
        return Outcome(tuple(rows), fields)


def _answer(solver, scene, warm_start) -> tuple[Row, Result | None]:
    """Row of a scene, and the result if there is one."""
    try:
        began = process_time()
        result = solver.solve(scene, *warm_start)
        seconds = result.seconds if isfinite(result.seconds) else process_time() - began
        return row(replace(result, seconds=seconds)), result
    except EmptyContact:
        depth = scene.motion.greatest if scene.motion.pressed_by == "depth" else nan
        return Row(0.0, depth, 0.0, residual=0.0, operator_applications=0.0, seconds=0.0), None
    except (Refused, NotImplementedError) as error:
        return Row(reason=REFUSED + reason_of(error)), None
    except SolveError as error:
        return Row(reason=reason_of(error)), None


def _importable(kind) -> bool:
    """Whether another process can import a class; what comes with Python is not asked for."""
    module = kind.__module__
    if module == "__main__" or module.partition(".")[0] in sys.stdlib_module_names:
        return False
    return getattr(import_module(module), kind.__name__, None) is kind


def _source(kind) -> str:
    """Source of a class or a function, or its compiled code where the source is lost."""
    try:
        return getsource(kind)
    except (OSError, TypeError):  # of a notebook: cells are known by function
        if code := getattr(kind, "__code__", None):
            return f"{kind.__name__} {code.co_code.hex()} {code.co_consts!r}"
    return "\n".join(_source(each) for each in vars(kind).values() if hasattr(each, "__code__"))


def draws_of(scene: Scene, seeds: int | Iterable[int]) -> tuple[Scene, ...]:
    """The scene with several seeds; smooth bodies and plain waves have a single draw.

    seeds : numbers to add to the seed of the scene, or how many of them, from 0 on
    """
    rough: Any = scene.roughness
    if not hasattr(rough, "seed"):
        return (scene,)
    added = tuple(range(seeds) if isinstance(seeds, int) else seeds)
    return tuple(replace(scene, roughness=replace(rough, seed=rough.seed + each)) for each in added)


def conditions(motion: Any) -> str:
    """Load or depth that is prescribed, depths in micrometres, and the speed, in words: 1 N, 0.1 m/s."""
    value, unit = motion.greatest, UNITS[motion.pressed_by]
    pressed = f"{value * 1e6:.3g} µm" if unit == "m" else f"{value:.3g} {unit}"
    if isinstance(motion, Program):
        return f"{pressed}, {len(motion.stages)} stages"
    return f"{pressed}, {motion.speed:.3g} m/s" if motion.speed else f"{pressed}, at rest"
