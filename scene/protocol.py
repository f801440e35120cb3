"""What a solver is, and the two ways in which it may decline to answer."""

from typing import Protocol

from .result import Result
from .scene import Scene


class Refused(ValueError):
    """The scene asks for what this solver lacks; said before anything is solved."""


class SolveError(RuntimeError):
    """The solve did not reach an answer that can be trusted; the message says what to change."""


class Solver(Protocol):
    """A frozen settings object that answers scenes."""

    @property
    def name(self) -> str:
        """Short name, unique among solvers."""

    def refusals(self, scene: Scene) -> list[str]:
        """Why the scene cannot be solved, one sentence each; empty when it can."""

    def solve(self, scene: Scene) -> Result:
        """The answer. Raises Refused before, SolveError after the attempt."""


def refuse(solver: Solver, scene: Scene) -> None:
    """Raise Refused with every reason at once, if there is any."""
    if reasons := solver.refusals(scene):
        raise Refused(f"{solver.name} cannot solve this scene: " + "; ".join(reasons))
