"""The rough line of a scene, by whatever its roughness is."""

from scene import Topography
from scene.roughness import SelfAffine

from . import surface, topography
from .surface import Spectrum, Surface


def draw(roughness: SelfAffine | Topography, nodes: int, spectrum: Spectrum = "mapped") -> Surface:
    """Draw one period of the rough line on so many nodes, from its seed."""
    one = topography if isinstance(roughness, Topography) else surface
    return one.draw(roughness, nodes, spectrum)
