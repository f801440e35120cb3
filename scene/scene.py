"""The scene: everything that is asked, nothing of how it is solved."""

from pydantic.dataclasses import dataclass

from .indenter import Indenter
from .motion import Motion
from .quantities import CLOSED
from .rheology import Elastomer
from .roughness import Roughness


@dataclass(frozen=True, config=CLOSED)
class Scene:
    """A rigid indenter on a viscoelastic half-space that flows past it along +x. SI units throughout.

    indenter : Sphere, Cone, PowerLaw or Cylinder
    elastomer : Elastic, Kelvin, StandardLinearSolid, Prony, KelvinChain, Fractional or Tabulated
    motion : Indent or Slide
    roughness : SelfAffine; absent, the indenter is smooth
    """

    indenter: Indenter
    elastomer: Elastomer
    motion: Motion
    roughness: Roughness | None = None
