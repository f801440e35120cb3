"""The scene and its effects: everything that is asked, nothing of how it is solved; and its parts in words."""

from collections.abc import Iterator, Mapping
from dataclasses import MISSING, fields, is_dataclass
from typing import Any, Literal, get_args, get_type_hints

from pydantic import Field, model_validator
from pydantic.dataclasses import dataclass

from .effects.temperature import Shifted, Temperature
from .indenter import Indenter, Plane
from .motion import UNITS, Motion, Program, Shear
from .printable import plain_table, table
from .quantities import CLOSED, Conductivity, Length, NonNegative, Unit
from .solids.rheology import Elastomer
from .solids.viscoelastic import Linear
from .surfaces.measured import Measured
from .surfaces.roughness import Roughness


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class Layer:
    """The elastomer is a layer on a rigid, flat base; absent, it is a half-space.

    thickness : [m]
    base : "bonded", the lower side does not move, or "frictionless", it slides along the base and is not lifted
    """

    thickness: Length
    base: Literal["bonded", "frictionless"] = "bonded"


@dataclass(frozen=True, config=CLOSED)
class Coulomb:
    """Dry friction at every point of contact: it sticks under a traction of up to coefficient * pressure.

    In steady sliding all of it slips, however slowly, and adds coefficient * F_N to friction; so it is at
    Slide(speed=0) too, the limit v -> 0+, while under an Indent nothing pulls and there is no friction. Absent,
    the interface has no friction of its own, and all friction is loss in the elastomer.
    """

    coefficient: NonNegative
    type: Literal["coulomb"] = Field(default="coulomb", repr=False)


def temperature_rise(friction, modulus, length, speed, conductivity):
    """2 mu G l v / lambda [K], Popov et al., Sci. Rep. 4, 3750 (2014), Methods; numbers or arrays.

    With the static modulus [Pa] and the depth [m] it is the mean over the contact, with the glassy modulus and the
    rms height of the roughness the largest in a micro-contact. modulus : in shear of an incompressible solid, and
    of any other E*/4, which presses as much
    """
    return 2 * friction * modulus * length * speed / conductivity


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class Heating:
    """Friction heats the contact, and the indenter takes the heat; absent, nothing gets warmer.

    conductivity : of the indenter [W/(m K)]
    feedback : which rise of temperature acts back on the elastomer, until both agree: the "average" of the contact
        or the "flash" of its asperities; absent, both are estimated and neither acts

    A result has two measures more, the estimates [K]: average_heating, NaN where the depth is negative, and
    flash_heating, zero of a smooth indenter and infinite where the elastomer has no glassy modulus. With feedback
    the answer is that at T = temperature.temperature + rise(T), to 1e-6 of the rise or 1e-9 K. Where several T
    agree it is the lowest, to which a contact warms up from the temperature of the scene. Its measures are
    temperature [K] and heating_solves, how many it took; operator_applications and seconds of the Result are of
    all.
    """

    conductivity: Conductivity
    feedback: Literal["average", "flash"] | None = None


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


FEW = 4  # of a part's values or stages, that are listed one by one


def rows(parts: Mapping[str, Any]) -> Iterator[tuple[str, str, str]]:
    """Names, values and units: the kind of each part, and below it its fields, those that are absent left out."""
    for name, part in parts.items():
        yield name, type(part).__name__, ""
        for each in fields(part):
            value, unit = getattr(part, each.name), unit_of(type(part), each.name) or ""
            if each.repr and value is not None:
                yield f"{name}.{each.name}", value if isinstance(value, str) else described(value), unit


def described(part: Any) -> str:
    """A part of a scene in a line: its type, and of its fields those that say something."""
    match part:
        case Program() if len(part.stages) > FEW:
            return _summed_up(part)
        case tuple() if len(part) > FEW and all(isinstance(value, float) for value in part):
            return f"{len(part)} from {min(part):g} to {max(part):g}"
        case tuple():
            return f"({', '.join(map(described, part))})"
    if not is_dataclass(part):
        return f"{part:g}" if isinstance(part, float) else repr(part)
    stated = (each for each in fields(part) if each.repr and not _usual(each, getattr(part, each.name)))
    return f"{type(part).__name__}({', '.join(f'{e.name}={described(getattr(part, e.name))}' for e in stated)})"


def _summed_up(program):
    """A program of many stages."""
    speeds = [stage.speed for stage in program.stages]
    swings = sum(stage.oscillation is not None for stage in program.stages)
    return (
        f"Program({len(speeds)} stages{f', {swings} of them oscillating' if swings else ''}, "
        f"{program.duration:g} s, path {program.length:g} m, speed {min(speeds):g} to {max(speeds):g} m/s, "
        f"{program.pressed_by} up to {program.greatest:g} {UNITS[program.pressed_by]})"
    )


def _usual(declared, value):
    default = declared.default
    return default is not MISSING and type(value) is type(default) and value == default


def unit_of(cls: type, field: str) -> str | None:
    """Symbol of the unit of a field of a dataclass, of each entry where there are several; None without one.

    Raises KeyError where there is no such field.
    """
    parts = [get_type_hints(cls, include_extras=True)[field]]
    for part in parts:  # which grows by the arguments of each
        if isinstance(part, Unit):
            return part.symbol
        parts += get_args(part)
    return None
