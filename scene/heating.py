"""Frictional heating of the contact."""

from typing import Literal

from pydantic.dataclasses import dataclass

from .quantities import CLOSED, Positive


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class Heating:
    """Friction heats the contact, and the indenter takes the heat; absent, nothing gets warmer.

    conductivity : of the indenter [W/(m K)]
    feedback : which rise of temperature acts back on the elastomer, until both agree: the "average" of the contact
        or the "flash" of its asperities; absent, both are estimated and neither acts
    """

    conductivity: Positive
    feedback: Literal["average", "flash"] | None = None
