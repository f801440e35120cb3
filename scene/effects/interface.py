"""Interaction of the two surfaces where they touch, besides pressing."""

from typing import Literal

from pydantic import Field
from pydantic.dataclasses import dataclass

from ..quantities import CLOSED, NonNegative


@dataclass(frozen=True, config=CLOSED)
class Coulomb:
    """Dry friction at every point of contact: it sticks under a traction of up to coefficient * pressure.

    In steady sliding all of it slips, however slowly, and adds coefficient * F_N to friction; so it is at
    Slide(speed=0) too, the limit v -> 0+, while under an Indent nothing pulls and there is no friction. Absent,
    the interface has no friction of its own, and all friction is loss in the elastomer.
    """

    coefficient: NonNegative
    type: Literal["coulomb"] = Field(default="coulomb", repr=False)
