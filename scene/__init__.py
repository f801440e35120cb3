"""The shared vocabulary: what is asked of a contact, what is answered, and nothing of how."""

from .fractional import Fractional
from .indenter import Cone, Cylinder, Plane, PowerLaw, Sphere
from .motion import Indent, Program, Slide, Stage
from .protocol import EmptyContact, Refused, SolveError, Solver
from .regime import Regime
from .result import Result
from .rheology import Elastic, Kelvin, KelvinChain, Prony, StandardLinearSolid
from .roughness import CrossedWaves, SelfAffine, Wave
from .scene import Scene
from .table import Table, read_table
from .tabulated import Tabulated

__all__ = [
    "Cone",
    "CrossedWaves",
    "Cylinder",
    "Elastic",
    "EmptyContact",
    "Fractional",
    "Indent",
    "Kelvin",
    "KelvinChain",
    "Plane",
    "PowerLaw",
    "Program",
    "Prony",
    "Refused",
    "Regime",
    "Result",
    "Scene",
    "SelfAffine",
    "Slide",
    "SolveError",
    "Solver",
    "Sphere",
    "Stage",
    "StandardLinearSolid",
    "Table",
    "Tabulated",
    "Wave",
    "read_table",
]
