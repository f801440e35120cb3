"""Number types of the fields of a scene: what each allows, and its unit, is declared once, here.

A quantity is given as a number in SI or, in Python and in a file alike, as a string with a unit: 0.005 or "5 mm".
What is held is always the number in SI.
"""

import numbers
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated, Any, get_args, get_type_hints

from pydantic import BeforeValidator, ConfigDict, Field, GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic_core import ArgsKwargs, CoreSchema, core_schema

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


@dataclass(frozen=True)
class Unit:
    """The unit of a number, as a part of its type: it makes strings with units numbers in SI.

    symbol : SI unit, as "m" or "W/(m K)"
    kind : what has it, as "a length"
    example, number : a quantity with a unit, and the same in SI
    difference : whether a temperature is a difference of two
    """

    symbol: str
    kind: str
    example: str
    number: float
    difference: bool = True

    @property
    def allowed(self) -> str:
        """Allowed values in words."""
        return f"{self.kind}, as {self.example} or {self.number:g} (in {self.symbol})"

    def value(self, given: Any) -> Any:
        """A string as a number in SI, a number as it is. Raises ValueError for anything else."""
        if isinstance(given, numbers.Real) and not isinstance(given, bool):
            return given
        reason = ""
        if isinstance(given, str):
            # Units take time to load, and only strings need them.
            from .units import Unreadable, in_si

            try:
                return in_si(given, self.symbol, self.difference)
            except Unreadable as error:
                reason = f"; {error}" if str(error) else ""
        raise ValueError(f"Input should be {self.allowed}{reason}")

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.no_info_before_validator_function(self.value, handler(source))

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        return _or_written(handler(schema), (self.example,)) | {"description": self.allowed}


@dataclass(frozen=True)
class UnitOfOthers:
    """The unit of a number where it depends on other fields.

    symbol : in words or with their names, as "m^(1-exponent)"
    examples : quantities that the dataclass itself makes numbers in SI before; none where it takes numbers alone
    """

    symbol: str
    examples: tuple[str, ...] = ()

    def value(self, given: Any) -> Any:
        """A number as it is. Raises ValueError for a string."""
        if isinstance(given, str):
            raise ValueError(f"Input should be a number (in {self.symbol})")
        return given

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.no_info_before_validator_function(self.value, handler(source))

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        said = {"description": f"in {self.symbol}"}
        return _or_written(handler(schema), self.examples) | said if self.examples else handler(schema) | said


def _or_written(number, examples):
    """JSON schema of a number, or of a quantity with a unit."""
    from .units import PATTERN

    return {"anyOf": [number, {"type": "string", "pattern": PATTERN, "examples": list(examples)}]}


METRE = Unit("m", "a length", "5 mm", 5e-3)
PASCAL = Unit("Pa", "a pressure or modulus", "1.2 MPa", 1.2e6)
PER_PASCAL = Unit("1/Pa", "a compliance", "1/MPa", 1e-6)
SECOND = Unit("s", "a time", "1 ms", 1e-3)
SPEED = Unit("m/s", "a speed", "20 mm/s", 0.02)
NEWTON = Unit("N", "a force", "10 mN", 0.01)
NEWTON_PER_METRE = Unit("N/m", "a force per length", "10 N/mm", 1e4)
RADIAN = Unit("rad", "an angle", "30 deg", 0.523599)
HERTZ = Unit("Hz", "a frequency", "2 kHz", 2e3)
RADIAN_PER_SECOND = Unit("rad/s", "an angular frequency (1 Hz is 2 pi rad/s)", "100 rad/s", 100.0)
KELVIN = Unit("K", "an absolute temperature", "25 degC", 298.15, difference=False)
KELVIN_APART = Unit("K", "a difference of temperatures", "0.06 K", 0.06)
CONDUCTIVITY = Unit("W/(m K)", "a thermal conductivity", "20 W/(m K)", 20.0)
JOULE_PER_MOLE = Unit("J/mol", "an energy per amount", "50 kJ/mol", 5e4)

Length = Annotated[Positive, METRE]
LengthOrZero = Annotated[NonNegative, METRE]
Pressure = Annotated[Positive, PASCAL]
PressureOrZero = Annotated[NonNegative, PASCAL]
Compliance = Annotated[Positive, PER_PASCAL]
ComplianceOrZero = Annotated[NonNegative, PER_PASCAL]
Time = Annotated[Positive, SECOND]
Speed = Annotated[Positive, SPEED]
SpeedOrZero = Annotated[NonNegative, SPEED]
Velocity = Annotated[Finite, SPEED]
Force = Annotated[Positive, NEWTON]
ForceOrZero = Annotated[NonNegative, NEWTON]
LineLoad = Annotated[Positive, NEWTON_PER_METRE]
LineLoadOrZero = Annotated[NonNegative, NEWTON_PER_METRE]
Angle = Annotated[Positive, RADIAN]
Frequency = Annotated[Positive, HERTZ]
AngularFrequency = Annotated[Positive, RADIAN_PER_SECOND]
AbsoluteTemperature = Annotated[Positive, KELVIN]
TemperatureDifference = Annotated[Positive, KELVIN_APART]
Conductivity = Annotated[Positive, CONDUCTIVITY]
MolarEnergy = Annotated[Positive, JOULE_PER_MOLE]


def unit_of(cls: type, field: str) -> str | None:
    """Symbol of the unit of a field of a dataclass, of each entry where there are several; None without one.

    Raises KeyError where there is no such field.
    """
    hints = get_type_hints(cls, include_extras=True)
    return next((unit.symbol for unit in _units(hints[field])), None)


def by_name(given: Any) -> dict[str, Any] | None:
    """Values stated for the fields of a dataclass, in Python or in a table, by name; None of anything else."""
    if isinstance(given, ArgsKwargs):
        return None if given.args else given.kwargs or {}
    return given if isinstance(given, dict) else None


def _units(hint) -> Iterator[Unit | UnitOfOthers]:
    for part in get_args(hint):
        if isinstance(part, Unit | UnitOfOthers):
            yield part
        elif not isinstance(part, str):
            yield from _units(part)
