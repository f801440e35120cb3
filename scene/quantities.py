"""Number types of the fields of a scene: what each allows is declared once, here."""

import numbers
from typing import Annotated

from pydantic import BeforeValidator, ConfigDict, Field

# Unknown names are mistakes.
CLOSED = ConfigDict(extra="forbid")


def _as_float(value):
    """Take any real number (numpy scalars too), leave the rest for the strict check to name."""
    if not isinstance(value, numbers.Real) or isinstance(value, bool):
        return value
    try:
        return float(value)
    except OverflowError:
        raise ValueError("Input should be within the range of floating-point numbers") from None


def _as_int(value):
    is_whole = isinstance(value, numbers.Integral) and not isinstance(value, bool)
    return int(value) if is_whole else value


Finite = Annotated[float, BeforeValidator(_as_float), Field(strict=True, allow_inf_nan=False)]
Positive = Annotated[Finite, Field(gt=0)]
NonNegative = Annotated[Finite, Field(ge=0)]
Whole = Annotated[int, BeforeValidator(_as_int), Field(strict=True)]
