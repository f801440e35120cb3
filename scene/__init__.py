"""The shared vocabulary: what is asked of a contact, what is answered, and nothing of how."""

from .doubt import Doubt, Doubtful, doubts, notes
from .fractional import Fractional
from .heating import Heating
from .indenter import Cone, Cylinder, Plane, PowerLaw, Sphere
from .interface import Coulomb
from .layer import Layer
from .measured import Measured
from .motion import Indent, Program, Shear, Slide, Stage
from .plan import Plan
from .protocol import EmptyContact, OutOfMemory, Refused, SolveError, Solver
from .regime import Regime
from .result import Result
from .rheology import Elastic, Kelvin, KelvinChain, Prony, StandardLinearSolid
from .roughness import CrossedWaves, SelfAffine, Wave
from .scene import Scene
from .table import Table, read_table
from .tabulated import Tabulated
from .temperature import WLF, Arrhenius
from .topography import Topography

__all__ = [
    "WLF",
    "Arrhenius",
    "Cone",
    "Coulomb",
    "CrossedWaves",
    "Cylinder",
    "Doubt",
    "Doubtful",
    "Elastic",
    "EmptyContact",
    "Fractional",
    "Heating",
    "Indent",
    "Kelvin",
    "KelvinChain",
    "Layer",
    "Measured",
    "OutOfMemory",
    "Plan",
    "Plane",
    "PowerLaw",
    "Program",
    "Prony",
    "Refused",
    "Regime",
    "Result",
    "Scene",
    "SelfAffine",
    "Shear",
    "Slide",
    "SolveError",
    "Solver",
    "Sphere",
    "Stage",
    "StandardLinearSolid",
    "Table",
    "Tabulated",
    "Topography",
    "Wave",
    "doubts",
    "notes",
    "read_table",
]
