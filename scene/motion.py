"""How the indenter moves: pressed in to rest, or sliding steadily. Either the load or the depth is prescribed."""

from typing import Annotated, Literal

from pydantic import Field, model_validator
from pydantic.dataclasses import dataclass

from .quantities import CLOSED, NonNegative, Positive


class _LoadOrDepth:
    @model_validator(mode="after")
    def _exactly_one(self):
        if (self.load is None) == (self.depth is None):
            given = f"load = {self.load}, depth = {self.depth}"
            raise ValueError(f"{given}: give exactly one of load [N] and depth [m]")
        return self


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class Indent(_LoadOrDepth):
    """Pressed in and held until the elastomer has relaxed: its equilibrium modulus alone counts.

    load [N] or depth [m], one of them.
    """

    load: Positive | None = None
    depth: Positive | None = None
    type: Literal["indent"] = Field(default="indent", repr=False)

    @property
    def speed(self) -> float:
        return 0.0


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class Slide(_LoadOrDepth):
    """Steady sliding at a speed [m/s] >= 0, at given load [N] or depth [m]."""

    speed: NonNegative
    load: Positive | None = None
    depth: Positive | None = None
    type: Literal["slide"] = Field(default="slide", repr=False)


Motion = Annotated[Indent | Slide, Field(discriminator="type")]
