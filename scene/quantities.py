"""Number types of the fields of a scene: what each allows is declared once, here."""

import numbers
from typing import Annotated

from pydantic import BeforeValidator, ConfigDict, Field

# Unknown names are mistakes.
CLOSED = ConfigDict(extra="forbid")


def _as_float(value):
    """Take any real number (numpy scalars too), leave the rest for the strict check to name."""
    is_real = isinstance(value, numbers.Real) and not isinstance(value, bool)
    return float(value) if is_real else value


def _as_int(value):
    is_whole = isinstance(value, numbers.Integral) and not isinstance(value, bool)
    return int(value) if is_whole else value


Finite = Annotated[float, BeforeValidator(_as_float), Field(strict=True, allow_inf_nan=False)]
Positive = Annotated[Finite, Field(gt=0)]
NonNegative = Annotated[Finite, Field(ge=0)]
Whole = Annotated[int, BeforeValidator(_as_int), Field(strict=True)]
