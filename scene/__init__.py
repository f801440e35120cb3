"""The shared vocabulary: what is asked of a contact, what is answered, and nothing of how."""

from .indenter import Cone, Cylinder, PowerLaw, Sphere
from .motion import Indent, Slide
from .protocol import Refused, SolveError, Solver
from .result import Result
from .rheology import Elastic, Kelvin, Prony, StandardLinearSolid
from .roughness import SelfAffine
from .scene import Scene

__all__ = [
    "Cone",
    "Cylinder",
    "Elastic",
    "Indent",
    "Kelvin",
    "PowerLaw",
    "Prony",
    "Refused",
    "Result",
    "Scene",
    "SelfAffine",
    "Slide",
    "SolveError",
    "Solver",
    "Sphere",
    "StandardLinearSolid",
]
