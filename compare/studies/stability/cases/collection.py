"""The collection: every hard case by its name."""

from collections.abc import Mapping

from . import (
    contact,
    extremes,
    grids,
    histories,
    mistakes,
    motion,
    programs,
    rheology,
    roughness,
    settling,
    shapes,
    units,
)
from .hardcase import HardCase

MODULES = (
    motion,
    roughness,
    contact,
    settling,
    rheology,
    units,
    grids,
    shapes,
    histories,
    programs,
    mistakes,
    extremes,
)
CASES: Mapping[str, HardCase] = {each.name: each for module in MODULES for each in module.CASES}
