"""Table of terms: this solver's treatment of each part of a scene."""

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
from scene.terms import Table

from .contact.shear import Drawn, Interface
from .response.layer import LayerTerm
from .term import HeatedContact, Term
from .topography import FittedRoughness, MeasuredRoughness

__all__ = ["TERMS", "Term"]

TERMS: Table = {
    Axisymmetric: Term,
    Cylinder: Term,
    Plane: Term,
    Measured: Term,
    Linear: Term,
    Indent: Term,
    Slide: Term,
    Shear: Drawn,
    Program: Term,
    Isotropic: Term,
    Wave: Term,
    Layer: LayerTerm,
    Topography: MeasuredRoughness,
    Profile: FittedRoughness,
    TemperatureLaw: Term,
    Heating: HeatedContact,
    Coulomb: Interface,
}
