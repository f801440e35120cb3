"""The chapters of the page on effects, in their order; what they cost is another, which wants a quiet machine."""

from collections.abc import Sequence

from . import layer, motions, shear, temperature, topography
from .chapter import Study

STUDIES: Sequence[Study] = (layer, topography, temperature, shear, motions)
