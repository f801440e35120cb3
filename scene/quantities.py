"""Number types of the fields of a scene: what each allows, and its unit, is declared once, here.

A quantity is given as a number in SI or, in Python and in a file alike, as a string with a unit: 0.005 or "5 mm".
In Python it may also be what other libraries hold, see `numeric_input`. What is held is always the number in SI.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import wraps
from inspect import signature
from numbers import Integral
from typing import Annotated, Any, ParamSpec, TypeVar

from pydantic import BeforeValidator, ConfigDict, Field, GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic_core import CoreSchema, core_schema

from .numeric_input import number, numbers, one_by_one, relabelled
from .printable import brief

_P = ParamSpec("_P")
_T = TypeVar("_T")
# Unknown names are mistakes.
CLOSED = ConfigDict(extra="forbid")


@dataclass(frozen=True)
class Unit:
    """Unit of a number, as a part of its type: numbers, strings and arrays become plain numbers in SI.

    symbol : SI unit, as "m" or "W/(m K)"; in words or with names where it depends on other fields, as
        "m^(1-exponent)"; empty without a unit
    kind : what has it, as "a length"
    example, number : a quantity with a unit, and the same in SI; no number where the unit depends on other fields
    difference : whether a temperature is a difference of two
    """

    symbol: str
    kind: str = "a number"
    example: str = ""
    number: float | None = None
    difference: bool = True

    @property
    def allowed(self) -> str:
        """Allowed values in words."""
        such = "" if self.number is None else f', such as "{self.example}" or {self.number:g}'
        return f"{self.kind}{such}{f' (in {self.symbol})' if self.symbol else ''}"

    def value(self, given: Any) -> Any:
        """A number, a string or a quantity as a float in SI. Raises ValueError for anything else."""
        try:
            return float(self._taken(number, given))
        except OverflowError:
            raise ValueError("Input should be within the range of floating-point numbers") from None

    def values(self, given: Any) -> Any:
        """One number or an array of any shape, in the same way."""
        return self._taken(numbers, given)

    def row(self, given: Any) -> tuple[Any, ...]:
        """A list of numbers, or a one-dimensional array, in the same way."""
        found = one_by_one(given)
        if not isinstance(found, list | tuple):
            raise ValueError("Input should be a list of numbers")
        return tuple(map(self.value, found))

    def _taken(self, take, given):
        try:
            return take(given, None if self.number is None else self.symbol, self.difference)
        except ValueError as error:
            reason = f"; {error}" if str(error) else ""
            raise ValueError(f"Input should be {self.allowed}{reason}") from None

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.no_info_before_validator_function(self.value, handler(source))

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        plain, written = handler(schema), {"type": "string", "examples": [self.example]}
        kinds = {"anyOf": [plain, written]} if self.example else plain
        return kinds | {"description": self.allowed}


class _Count(Unit):
    """A whole number."""

    def value(self, given: Any) -> Any:
        if isinstance(found := self._taken(number, given), Integral):
            return int(found)
        raise ValueError(f"Input should be {self.allowed}")

    values = value


def argument(name: str, given: Any, take: Callable[[Any], _T]) -> _T:
    """Argument as a function of a number reads it. Raises its ValueError, with the name and the value."""
    try:
        return take(given)
    except ValueError as error:
        raise ValueError(f"{name} = {brief(repr(given))}: {str(error).removeprefix('Input should be ')}") from None


def takes(**units: Unit) -> Callable[[Callable[_P, _T]], Callable[_P, _T]]:
    """Decorator of functions: arguments of these names become plain numbers or arrays in SI, as fields do.

    None stays, and so do the labels of an array of xarray. Raises ValueError, which names the argument.
    """

    def decorated(function: Callable[_P, _T]) -> Callable[_P, _T]:
        names = tuple(signature(function).parameters)

        def taken(name, given):
            known = given is None or name not in units
            return given if known else relabelled(given, argument(name, given, units[name].values))

        @wraps(function)
        def checked(*args: _P.args, **kwargs: _P.kwargs) -> _T:
            given: Any = (*map(taken, names, args), *args[len(names) :])
            stated: Any = {name: taken(name, each) for name, each in kwargs.items()}
            return function(*given, **stated)

        return checked

    return decorated


BARE, WHOLE = Unit("", "a number without a unit"), _Count("", "a whole number")
METRE = Unit("m", "a length", "5 mm", 5e-3)
PASCAL = Unit("Pa", "a pressure", "1.2 MPa", 1.2e6)
MODULUS = Unit("Pa", "a modulus", "1.2 MPa", 1.2e6)
YOUNGS = Unit("Pa", "a Young's modulus E", "3 MPa", 3e6)
PER_PASCAL = Unit("1/Pa", "a compliance in shear", "1/MPa", 1e-6)
COMPLIANCE = Unit("1/Pa", "a compliance", "1/MPa", 1e-6)
PASCAL_SECOND = Unit("Pa s", "a viscosity", "1 kPa s", 1e3)
SECOND = Unit("s", "a time", "1 ms", 1e-3)
SPEED = Unit("m/s", "a speed", "20 mm/s", 0.02)
NEWTON = Unit("N", "a force", "10 mN", 0.01)
NEWTON_PER_METRE = Unit("N/m", "a force per length", "10 N/mm", 1e4)
RADIAN = Unit("rad", "an angle", "30 deg", 0.523599)
HERTZ = Unit("Hz", "a frequency", "2 kHz", 2e3)
RADIAN_PER_SECOND = Unit("rad/s", "an angular frequency (1 Hz is 2 pi rad/s)", "100 rad/s", 100.0)
KELVIN = Unit("K", "an absolute temperature", "25 degC", 298.15, difference=False)
RADIAN_PER_METRE = Unit("rad/m", "a wave number (1/m are cycles)", "10 rad/mm", 1e4)
CONDUCTIVITY = Unit("W/(m K)", "a thermal conductivity", "20 W/(m K)", 20.0)

Finite = Annotated[float, BeforeValidator(BARE.value), Field(strict=True, allow_inf_nan=False)]
Positive = Annotated[Finite, Field(gt=0)]
NonNegative = Annotated[Finite, Field(ge=0)]
Whole = Annotated[int, BeforeValidator(WHOLE.value), Field(strict=True)]
MOST_WHOLE = 2**63 - 1  # the largest whole number that files of results hold
Seed = Annotated[Whole, Field(ge=0, le=MOST_WHOLE)]
# Items of a tuple of numbers: an array of any library counts too, and keeps its unit.
ROW = BeforeValidator(one_by_one)
Length = Annotated[Positive, METRE]
LengthOrZero = Annotated[NonNegative, METRE]
Pressure = Annotated[Positive, PASCAL]
PressureOrZero = Annotated[NonNegative, PASCAL]
ShearModulus = Annotated[Positive, Unit("Pa", "a shear modulus G", "1.2 MPa", 1.2e6)]
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
TemperatureDifference = Annotated[Positive, Unit("K", "a difference of temperatures", "0.06 K", 0.06)]
Conductivity = Annotated[Positive, CONDUCTIVITY]
MolarEnergy = Annotated[Positive, Unit("J/mol", "an energy per amount", "50 kJ/mol", 5e4)]
