"""The scene: everything that is asked, nothing of how it is solved."""

from dataclasses import fields
from typing import Any

from pydantic import model_validator
from pydantic.dataclasses import dataclass

from .effects.parts import Coulomb, Heating, Layer
from .effects.temperature import Shifted, Temperature
from .files.parts import rows
from .indenter import Indenter, Plane
from .motion import UNITS, Motion, Shear
from .printable import plain_table, table
from .quantities import CLOSED
from .solids.rheology import Elastomer
from .solids.viscoelastic import Linear
from .surfaces.measured import Measured
from .surfaces.roughness import Roughness


def fit_together(parts):
    """Return the parts as they are. Raises ValueError where one does not suit the others."""
    kind, motion = type(parts.indenter).__name__, parts.motion
    allowed, given = parts.indenter.pressed_by, motion.pressed_by
    if given not in allowed:
        units = " or ".join(f"{name} [{UNITS[name]}]" for name in allowed)
        raise ValueError(f"motion.{given} = {motion.greatest:g} does not press a {kind}: give {units}")
    if isinstance(parts.indenter, Plane) and (parts.roughness is None or parts.roughness.flat):
        raise ValueError("indenter = Plane without roughness touches everywhere: give roughness")
    if isinstance(parts.indenter, Measured) and parts.roughness is not None:
        raise ValueError("roughness on an indenter = Measured, whose map has its own: leave roughness out")
    if isinstance(motion, Shear) and parts.interface is None:
        raise ValueError("motion = Shear without friction in the interface slips at once: give interface")
    if parts.heating is not None and parts.heating.feedback is not None and parts.temperature is None:
        raise ValueError(
            f"heating.feedback = {parts.heating.feedback!r} shifts the times of the elastomer: give temperature, "
            "or leave feedback out"
        )
    parts.elastomer.at_reference(parts.temperature)
    return parts


@dataclass(frozen=True, config=CLOSED)
class Scene:
    """A rigid indenter on a viscoelastic half-space that flows past it along +x. SI units throughout.

    indenter : Sphere, Cone, PowerLaw, Cylinder, Plane or Measured
    elastomer : Elastic, Kelvin, StandardLinearSolid, Prony, KelvinChain, Fractional or Tabulated
    motion : Indent, Slide, Shear or Program
    roughness : SelfAffine, Spectrum, Wave, CrossedWaves, Topography or Profile; absent, the indenter is smooth
    layer : Layer; absent, the elastomer is a half-space
    temperature : WLF, Arrhenius or ShiftFactors; absent, the elastomer is stated as it is
    interface : Coulomb; absent, the interface has no friction of its own
    heating : Heating; absent, friction heats nothing

    What is absent costs nothing: a solver looks at `parts` alone.

    >>> from scene import Kelvin, Scene, Slide, Sphere
    >>> rubber = Kelvin(modulus="1 MPa", relaxation_time="1 ms")
    >>> scene = Scene(Sphere(radius="10 mm"), rubber, Slide(speed="0.1 m/s", load="1 N"))
    >>> scene.indenter
    Sphere(radius=0.01)
    >>> list(scene.parts)
    ['indenter', 'elastomer', 'motion']
    """

    indenter: Indenter
    elastomer: Elastomer
    motion: Motion
    roughness: Roughness | None = None
    layer: Layer | None = None
    temperature: Temperature | None = None
    interface: Coulomb | None = None
    heating: Heating | None = None  # last: all friction heats

    _fits = model_validator(mode="after")(fit_together)

    def __str__(self) -> str:
        return plain_table(rows(self.parts))

    def _repr_html_(self) -> str:
        return table(rows(self.parts), ("name", "value", "unit"), "Scene")

    @property
    def parts(self) -> dict[str, Any]:
        """Parts that the scene has, by the name of their field."""
        given = {field.name: getattr(self, field.name) for field in fields(self)}
        return {name: part for name, part in given.items() if part is not None}

    @property
    def solid(self) -> Linear:
        """The elastomer at the temperature of the scene."""
        solid = self.elastomer.at_reference(self.temperature)
        return (
            solid if self.temperature is None else Shifted(solid, self.temperature.shift, self.temperature.stiffer)
        )
