"""What this solver has for each part of a scene: its table of terms, and what it lacks, with the reason."""

from scene import (
    WLF,
    Arrhenius,
    Cylinder,
    Indent,
    Layer,
    Plane,
    Program,
    Result,
    SelfAffine,
    Slide,
    Wave,
    terms,
)
from scene.indenter import Axisymmetric
from scene.terms import Table, lacking
from scene.viscoelastic import Linear


class Term(terms.Term):
    """A part of a scene as the one-dimensional foundation takes it up."""

    def completed(self, result: Result) -> Result:
        """The answer with what the part adds once the normal contact is found."""
        return result


NO_BODY = lacking(
    "it is no body of revolution, so it has no one-dimensional profile: use a Sphere, Cone or PowerLaw, or a "
    "three-dimensional solver"
)
NOT_ISOTROPIC = lacking(
    "it is not isotropic, so no one-dimensional spectrum stands for it: use SelfAffine, or a three-dimensional "
    "solver"
)
NO_LAYER = lacking(
    "its stiffness against a contact is no sum over lengths, so no one-dimensional foundation has the same force "
    "at every depth: leave layer out, or use a three-dimensional solver"
)

TERMS: Table = {
    Axisymmetric: Term,
    Cylinder: NO_BODY,
    Plane: NO_BODY,
    Linear: Term,
    Indent: Term,
    Slide: Term,
    Program: Term,
    SelfAffine: Term,
    Wave: NOT_ISOTROPIC,
    Layer: NO_LAYER,
    WLF: Term,
    Arrhenius: Term,
}
