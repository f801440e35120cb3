"""Protocol of a solver, the ways in which it may decline to answer, and the memory that it may have."""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import Field
from functools import cache
from pathlib import Path
from typing import Any, ClassVar, Protocol

import numpy as np

from .files.reading import InvalidInput
from .plan import size
from .printable import brief
from .result import Result
from .scene import Scene


class Refused(ValueError):
    """The scene asks for something that this solver lacks; raised before anything is solved."""


class SolveError(RuntimeError):
    """The solve did not reach an answer that can be trusted; the message says what to change."""


class EmptyContact(SolveError):
    """At the prescribed depth nothing touches: the forces are zero."""


class Solver(Protocol):
    """A model: a frozen dataclass of settings that answers scenes.

    `name` and `solve` are all that a model must have. What else it may have, and what is taken where it has not:

    refusals(scene) : reasons why a scene cannot be solved, a sentence each; without it none is refused beforehand
    foreseen(scene) : reasons why a solve would fail, found beforehand; none
    points, steps : settings of its grid and its steps in time, halved to know their error; it has no coarser grid
    label : what it is called next to 1D and 3D; its name
    draws : what its means are taken over: "profiles" in one dimension, "surfaces", or "none"; surfaces
    answers : what it has a claim on, of "friction", "force" (at a depth) and "depth" (under a load); all of them.
        The judge asks it for nothing else, nor for friction at a depth without the force
    packages : names of the packages whose files its answers depend on; the outermost package of its class and of
        each class that it derives from
    """

    __dataclass_fields__: ClassVar[dict[str, Field[Any]]]

    @property
    def name(self) -> str:
        """Short name, unique among models."""

    def solve(self, scene: Scene) -> Result:
        """The answer. Raises Refused of what the model lacks, SolveError of an attempt that failed."""


class OutOfMemory(MemoryError):
    """There was less memory than the solve takes; it says nothing of the scene, and may go well elsewhere."""


@contextmanager
def numeric_guard():
    """Turn a fault of arithmetic into a SolveError: numbers so far apart that their quotients leave the range.

    Memory that runs out is OutOfMemory.
    """
    try:
        with np.errstate(over="raise", invalid="raise", divide="raise"):
            yield
    except MemoryError as fault:
        why = str(fault) or "no size is known"
        raise OutOfMemory(f"memory ran out ({why}): take fewer points, or fewer workers") from fault
    except (ArithmeticError, np.linalg.LinAlgError) as fault:
        raise SolveError(
            f"the numbers of the scene are too far apart to be computed with ({type(fault).__name__}: {fault}); "
            "check the units of its lengths, moduli, times and loads"
        ) from fault


def refuse(solver: Solver, scene: Scene) -> None:
    """Raise Refused with every reason at once, if there is any; SolveError as `numeric_guard`.

    Raises InvalidInput of what is no Scene.
    """
    if not isinstance(scene, Scene):
        raise InvalidInput(f"scene = {brief(repr(scene))}: a Scene is needed")
    _raise(solver, scene, lacking)


def foresee(solver: Solver, scene: Scene) -> None:
    """Raise Refused and SolveError as `refuse`, and Refused where it shows beforehand that a solve would fail."""
    _raise(solver, scene, why_not)


def why_not(solver: Solver, scene: Scene) -> list[str]:
    """Reasons why a solver refuses a scene, or else those that its `foreseen`, if it has one, finds beforehand."""
    return lacking(solver, scene) or getattr(solver, "foreseen", lambda scene: [])(scene)


def lacking(solver: Solver, scene: Scene) -> list[str]:
    """Reasons why a solver refuses a scene; none of a solver that states none beforehand."""
    return getattr(solver, "refusals", lambda scene: [])(scene)


def _raise(solver, scene, reasons):
    with numeric_guard():
        found = reasons(solver, scene)
    if found:
        raise Refused(f"{solver.name} cannot solve this scene: " + "; ".join(found))


# A control group without a limit states one near the largest whole number.
NO_LIMIT = 2**60


@cache
def memory() -> int:
    """Bytes that this process can have at most."""
    return min([*_physical(), *_of_groups(), *_of_process()], default=NO_LIMIT)


def shortage(needed: int) -> list[str]:
    """Reason why a number of bytes does not fit in memory; empty if it does."""
    there = memory()
    if needed <= there:
        return []
    return [f"it needs {size(needed)} of memory, and only {size(there)} are available: use fewer points"]


def _physical() -> Iterator[int]:
    if "SC_PHYS_PAGES" in getattr(os, "sysconf_names", ()):
        yield os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")


def _of_groups() -> Iterator[int]:
    """Limits of the control groups of this process, on Linux: of its own and of those around it."""
    try:
        lines = Path("/proc/self/cgroup").read_text(encoding="utf-8").splitlines()
    except OSError:
        return
    for line in lines:
        _, controllers, path = line.split(":", 2)
        root, name = (
            ("/sys/fs/cgroup/memory", "memory.limit_in_bytes")
            if "memory" in controllers.split(",")
            else ("/sys/fs/cgroup", "memory.max")
        )
        place = Path(root, path.lstrip("/"))
        for folder in (place, *place.parents):
            try:
                yield int((folder / name).read_text())
            except (OSError, ValueError):  # no such group here, or "max"
                continue


def _of_process() -> Iterator[int]:
    """Memory that `ulimit` leaves to this process."""
    try:
        import resource
    except ImportError:  # Windows
        return
    for limit in (resource.RLIMIT_AS, resource.RLIMIT_DATA):
        soft, _ = resource.getrlimit(limit)
        if soft != resource.RLIM_INFINITY:
            yield soft
