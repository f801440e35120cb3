"""The scene: everything that is asked, nothing of how it is solved."""

from pydantic import model_validator
from pydantic.dataclasses import dataclass

from .indenter import Indenter, Plane
from .motion import UNITS, Motion
from .quantities import CLOSED
from .rheology import Elastomer
from .roughness import Roughness


def fit_together(parts):
    """The same parts. Raises ValueError where motion or roughness does not suit the indenter."""
    kind, motion = type(parts.indenter).__name__, parts.motion
    allowed, given = parts.indenter.pressed_by, motion.pressed_by
    if given not in allowed:
        units = " or ".join(f"{name} [{UNITS[name]}]" for name in allowed)
        raise ValueError(f"motion.{given} = {motion.greatest:g} does not press a {kind}: give {units}")
    if isinstance(parts.indenter, Plane) and (parts.roughness is None or parts.roughness.rms_height == 0):
        raise ValueError("indenter = Plane without roughness touches everywhere: give roughness")
    return parts


@dataclass(frozen=True, config=CLOSED)
class Scene:
    """A rigid indenter on a viscoelastic half-space that flows past it along +x. SI units throughout.

    indenter : Sphere, Cone, PowerLaw, Cylinder or Plane
    elastomer : Elastic, Kelvin, StandardLinearSolid, Prony, KelvinChain, Fractional or Tabulated
    motion : Indent, Slide or Program
    roughness : SelfAffine, Wave or CrossedWaves; absent, the indenter is smooth
    """

    indenter: Indenter
    elastomer: Elastomer
    motion: Motion
    roughness: Roughness | None = None

    _fits = model_validator(mode="after")(fit_together)
