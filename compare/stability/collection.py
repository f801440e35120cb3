"""The collection: every hard case by its name."""

from collections.abc import Mapping

from . import contact, grids, histories, input, motion, rheology, roughness, shapes, units
from .hardcase import HardCase

GROUPS = (motion, roughness, contact, rheology, units, grids, shapes, histories, input)
CASES: Mapping[str, HardCase] = {case.name: case for group in GROUPS for case in group.CASES}
