"""Effects that a part of a scene states: an elastic layer, heating by friction, friction in the interface."""

from typing import Literal

from pydantic import Field
from pydantic.dataclasses import dataclass

from ..quantities import CLOSED, Conductivity, Length, NonNegative


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
