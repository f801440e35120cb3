"""Terms of the boundary elements: how they treat a part of a scene; heating as in every solver."""

from typing import Any

from scene import Result, Scene, terms
from scene.effects.terms import Heated

from .grid import Grid


class Term(terms.Term):
    """A part of a scene as boundary elements treat it."""

    def medium(self, medium: Any, scene: Scene) -> Any:
        """The response of the elastomer, as changed by the part: what `HalfSpace`, `Cell` and `Line` offer."""
        return medium

    def completed(self, result: Result, problem, grid: Grid) -> Result:
        """The answer with what the part adds once the pressure is found.

        problem : the `Problem` that was solved, on the grid
        """
        return result


class HeatedContact(Heated, Term):
    """A contact that its friction heats, solved again until it is as warm as that makes it, if asked for."""
