"""One-dimensional solver: the method of dimensionality reduction on a viscoelastic foundation, solved exactly."""

import logging

from scene.signatures import make_readable

from . import equations, estimates
from .kelvin import sweep
from .lines import draw
from .modes import Modes, modes_of
from .profile import Grid, Profile, lay_out, map_profile
from .solver import MDR
from .steady import Contact, sweep_modes
from .surface import Surface, amplitudes

__all__ = [
    "MDR",
    "Contact",
    "Grid",
    "Modes",
    "Profile",
    "Surface",
    "amplitudes",
    "draw",
    "equations",
    "estimates",
    "lay_out",
    "map_profile",
    "modes_of",
    "sweep",
    "sweep_modes",
]

make_readable(globals()[name] for name in __all__)
logging.getLogger(__name__).addHandler(logging.NullHandler())
