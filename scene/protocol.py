"""Protocol of a solver, and the two ways in which it may decline to answer."""

from contextlib import contextmanager
from dataclasses import Field
from typing import Any, ClassVar, Protocol

import numpy as np

from .files.reading import InvalidInput
from .printable import brief
from .result import Result
from .scene import Scene


class Refused(ValueError):
    """The scene asks for what this solver lacks; said before anything is solved."""


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
    label : what it is called beside 1D and 3D; its name
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
