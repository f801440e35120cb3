"""An elastomer of finite thickness."""

from typing import Literal

from pydantic.dataclasses import dataclass

from ..quantities import CLOSED, Length


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class Layer:
    """The elastomer is a layer on a rigid, flat base; absent, it is a half-space.

    thickness : [m]
    base : "bonded", the lower side does not move, or "frictionless", it slides along the base and is not lifted
    """

    thickness: Length
    base: Literal["bonded", "frictionless"] = "bonded"
