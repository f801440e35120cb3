"""How the indenter moves: pressed in to rest, or sliding steadily, and what presses it."""

from typing import Annotated, Literal

from pydantic import Field, model_validator
from pydantic.dataclasses import dataclass

from .quantities import CLOSED, NonNegative, Positive

UNITS = {"load": "N", "depth": "m", "line_load": "N/m", "pressure": "Pa", "gap": "m"}


class _Pressed:
    """What presses the indenter: exactly one of `UNITS`."""

    @model_validator(mode="after")
    def _exactly_one(self):
        given = [name for name in UNITS if getattr(self, name) is not None]
        if len(given) != 1:
            stated = ", ".join(f"{name} = {getattr(self, name):g}" for name in given) or "none given"
            units = ", ".join(f"{name} [{unit}]" for name, unit in UNITS.items())
            raise ValueError(f"{stated}: give exactly one of {units}")
        return self

    @property
    def pressed_by(self) -> str:
        """Name of what is prescribed, one of `UNITS`."""
        return next(name for name in UNITS if getattr(self, name) is not None)


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class Indent(_Pressed):
    """Pressed in and held until the elastomer has relaxed: its equilibrium modulus alone counts.

    load [N] or depth [m] of a body of revolution, line_load [N/m] of a cylinder, mean pressure [Pa] or mean
    gap [m] of a plane: one of them.
    """

    load: Positive | None = None
    depth: Positive | None = None
    line_load: Positive | None = None
    pressure: Positive | None = None
    gap: Positive | None = None
    type: Literal["indent"] = Field(default="indent", repr=False)

    @property
    def speed(self) -> float:
        return 0.0


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class Slide(_Pressed):
    """Steady sliding at a speed [m/s] >= 0, pressed in as in `Indent`."""

    speed: NonNegative
    load: Positive | None = None
    depth: Positive | None = None
    line_load: Positive | None = None
    pressure: Positive | None = None
    gap: Positive | None = None
    type: Literal["slide"] = Field(default="slide", repr=False)


Motion = Annotated[Indent | Slide, Field(discriminator="type")]
