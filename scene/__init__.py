"""The shared vocabulary: what is asked of a contact, what is answered, and nothing of how."""

from .doubt import Doubt, Doubtful, doubts, notes
from .effects.temperature import WLF, Arrhenius, ShiftFactors
from .files.reading import InvalidInput
from .indenter import Cone, Cylinder, Plane, PowerLaw, Sphere
from .motion import Indent, Program, Shear, Slide, Stage
from .plan import Plan
from .protocol import EmptyContact, OutOfMemory, Refused, SolveError, Solver
from .result import Result
from .scales import Regime
from .scene import Coulomb, Heating, Layer, Scene
from .signatures import make_readable
from .solids.fractional import Fractional
from .solids.moduli import read_table
from .solids.rheology import Elastic, Kelvin, KelvinChain, Prony, StandardLinearSolid
from .solids.table import Table
from .solids.tabulated import Tabulated
from .surfaces.measured import Measured
from .surfaces.profile import Profile
from .surfaces.roughness import CrossedWaves, Wave
from .surfaces.selfaffine import SelfAffine
from .surfaces.spectrum import Spectrum
from .surfaces.topography import Topography

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
