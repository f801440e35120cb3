"""The shared vocabulary: what is asked of a contact, what is answered, and nothing of how."""

from .doubt import Doubt, Doubtful, doubts, notes
from .fractional import Fractional
from .heating import Heating
from .indenter import Cone, Cylinder, Plane, PowerLaw, Sphere
from .interface import Coulomb
from .layer import Layer
from .measured import Measured
from .moduli import read_table
from .motion import Indent, Program, Shear, Slide, Stage
from .plan import Plan
from .profile import Profile
from .protocol import EmptyContact, OutOfMemory, Refused, SolveError, Solver
from .reading import InvalidInput
from .regime import Regime
from .result import Result
from .rheology import Elastic, Kelvin, KelvinChain, Prony, StandardLinearSolid
from .roughness import CrossedWaves, Wave
from .scene import Scene
from .selfaffine import SelfAffine
from .signatures import make_readable
from .spectrum import Spectrum
from .table import CreepTable, RelaxationTable, Table
from .tabulated import Tabulated
from .temperature import WLF, Arrhenius, ShiftFactors
from .topography import Topography

__all__ = [
    "WLF",
    "Arrhenius",
    "Cone",
    "Coulomb",
    "CreepTable",
    "CrossedWaves",
    "Cylinder",
    "Doubt",
    "Doubtful",
    "Elastic",
    "EmptyContact",
    "Fractional",
    "Heating",
    "Indent",
    "InvalidInput",
    "Kelvin",
    "KelvinChain",
    "Layer",
    "Measured",
    "OutOfMemory",
    "Plan",
    "Plane",
    "PowerLaw",
    "Profile",
    "Program",
    "Prony",
    "Refused",
    "Regime",
    "RelaxationTable",
    "Result",
    "Scene",
    "SelfAffine",
    "Shear",
    "ShiftFactors",
    "Slide",
    "SolveError",
    "Solver",
    "Spectrum",
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

make_readable(globals()[name] for name in __all__)
