"""The rough line of a scene, for every kind of roughness."""

from scene import Profile, Topography
from scene.quantities import WHOLE, takes
from scene.surfaces.isotropic import Isotropic
from scene.surfaces.roughness import Roughness

from . import surface, topography
from .surface import Spectrum, Surface


@takes(nodes=WHOLE)
def draw(roughness: Roughness, nodes: int, spectrum: Spectrum = "mapped") -> Surface:
    """Draw one period of the rough line on a number of nodes, from its seed.

    Raises TypeError for roughness that has no line.
    """
    match roughness:
        case Topography():
            return topography.draw(roughness, nodes, spectrum)
        case Profile() if spectrum == "line-scan":
            return topography.draw_line(roughness, nodes)
        case Profile():
            return surface.draw(roughness.fitted, nodes)
        case Isotropic():
            return surface.draw(roughness, nodes, spectrum)
    raise TypeError(f"roughness = {type(roughness).__name__}: no line stands for it")
