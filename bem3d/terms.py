"""What this solver has for each part of a scene: its table of terms."""

from scene import (
    WLF,
    Arrhenius,
    Cylinder,
    Indent,
    Plane,
    Program,
    Result,
    SelfAffine,
    Slide,
    Wave,
    terms,
)
from scene.indenter import Axisymmetric
from scene.terms import Table
from scene.viscoelastic import Linear

from .grid import Grid


class Term(terms.Term):
    """A part of a scene as boundary elements take it up."""

    def medium(self, medium):
        """The response of the elastomer, as changed by the part: what `HalfSpace`, `Cell` and `Line` offer."""
        return medium

    def completed(self, result: Result, problem, grid: Grid) -> Result:
        """The answer with what the part adds once the pressure is found.

        problem : the `Problem` that was solved, on the grid
        """
        return result


TERMS: Table = {
    Axisymmetric: Term,
    Cylinder: Term,
    Plane: Term,
    Linear: Term,
    Indent: Term,
    Slide: Term,
    Program: Term,
    SelfAffine: Term,
    Wave: Term,
    WLF: Term,
    Arrhenius: Term,
}
