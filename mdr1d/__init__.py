"""One-dimensional solver: the method of dimensionality reduction on a Kelvin foundation, solved exactly."""

from .foundation import Contact, sweep
from .profile import Grid, Profile, lay_out, map_profile
from .solver import MDR
from .surface import Surface, amplitudes, draw

__all__ = ["MDR", "Contact", "Grid", "Profile", "Surface", "amplitudes", "draw", "lay_out", "map_profile", "sweep"]
