"""Table of terms: this solver's treatment of each part of a scene, and the parts that it lacks."""

from scene import (
    Coulomb,
    Cylinder,
    Heating,
    Indent,
    Layer,
    Measured,
    Plane,
    Profile,
    Program,
    Shear,
    Slide,
    Topography,
    Wave,
)
from scene.effects.temperature import TemperatureLaw
from scene.indenter import Axisymmetric
from scene.solids.viscoelastic import Linear
from scene.surfaces.isotropic import Isotropic
from scene.terms import Table, unsupported

from .tangential import Drawn, Interface
from .term import HeatedContact, Term
from .topography import FittedRoughness, MeasuredRoughness

__all__ = ["TERMS", "Term"]

NO_BODY = unsupported(
    "it is no body of revolution, so it has no one-dimensional profile: use a Sphere, Cone or PowerLaw, or a "
    "three-dimensional solver"
)
NOT_ISOTROPIC = unsupported(
    "it is not isotropic, so no one-dimensional spectrum stands for it: use SelfAffine, or a three-dimensional "
    "solver"
)
NO_LAYER = unsupported(
    "its stiffness against a contact is no sum over lengths, so no one-dimensional foundation has the same force "
    "at every depth: leave layer out, or use a three-dimensional solver"
)

TERMS: Table = {
    Axisymmetric: Term,
    Cylinder: NO_BODY,
    Plane: NO_BODY,
    Measured: NO_BODY,
    Linear: Term,
    Indent: Term,
    Slide: Term,
    Shear: Drawn,
    Program: Term,
    Isotropic: Term,
    Wave: NOT_ISOTROPIC,
    Topography: MeasuredRoughness,
    Profile: FittedRoughness,
    Layer: NO_LAYER,
    TemperatureLaw: Term,
    Heating: HeatedContact,
    Coulomb: Interface,
}
