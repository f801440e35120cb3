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

GROUPS = (
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
CASES: Mapping[str, HardCase] = {case.name: case for group in GROUPS for case in group.CASES}
