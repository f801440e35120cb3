"""Frictional heating of the contact."""

from typing import Literal

from pydantic.dataclasses import dataclass

from ..quantities import CLOSED, Conductivity


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
