"""Plain numbers of what other libraries hold, quantities, arrays with labels or masks, tables: their one door.

Strings, as "5 mm", are read into SI by pint, to the float nearest to the text.

What has a unit or labels is known by its attributes: no library is imported to be asked.
"""

import re
from collections.abc import Mapping, Set
from dataclasses import dataclass
from decimal import Decimal
from difflib import get_close_matches
from functools import lru_cache
from math import isinf
from numbers import Real
from pathlib import Path
from typing import Any
from unicodedata import normalize

import numpy as np

from .printable import brief

LONGEST = 100  # letters of a quantity

_NUMBER = re.compile(r"\s*([+\-−]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+\-−]?[0-9]+)?)(.*)", re.DOTALL)
_NAME = re.compile(r"[^\W\d_]++(?:_[^\W\d_]++)*+")
# Names, each with a one-digit power, as mm2, mm^2 and s-1, between marks. What else pint computes is no unit.
_UNIT = re.compile(
    rf"(?:\s*+(?:{_NAME.pattern}(?:(?:\s*+(?:\^|\*\*)\s*+)?-?[1-9](?![\w.]))?|[*·⋅/()]|\.(?=[^\W\d_])|1(?=\s*/)))++"
)
_GLUED = re.compile(r"(?<=[^\W\d_])(?=-?[1-9])")  # before the power of "mm2"
_DEGREES = {"C": "degC", "F": "degF"}  # of temperatures, where pint has coulombs and farads
_USUAL = "m mm um nm Pa MPa mPa kPa GPa N mN kN Hz kHz s ms us min rad deg K degC mol kg J kJ W newton pascal"


class NotPlain(ValueError):
    """There are no plain numbers in something; the message says why, unless that is obvious."""


def in_si(text: str, unit: str, difference: bool = True) -> float:
    """The float nearest to a quantity in an SI unit.

    unit : such as "m", "m/s" or "W/(m K)"
    difference : whether a temperature is a difference, which has no degrees Celsius; else it is an absolute one

    Raises NotPlain for any other dimension, for what is no number with a unit, and beyond the range of floats.
    """
    written = _NUMBER.fullmatch(text[: LONGEST + 1])
    if written is None:
        raise NotPlain("there is no number before the unit" if text.strip() else "")
    one, zero = scale(text[written.start(2) :], unit, difference)
    try:
        number = Decimal(written[1].replace("−", "-"))
        found = float(number * one + zero)
    except ArithmeticError:
        found = float("inf")
    if isinf(found) or (number and not found):
        raise NotPlain("beyond the range of floating-point numbers")
    return found


@lru_cache(maxsize=256)
def scale(given: str, unit: str, difference: bool = True) -> tuple[Decimal, Decimal]:
    """One of a unit, and its zero, in an SI unit: a number of it times the first plus the second is in SI.

    Raises NotPlain as `in_si`.
    """
    if unit == "K":
        given = _DEGREES.get(given.strip(), given)
    asked, wanted = _parsed(given), _registry().parse_units(unit)
    if asked.dimensionality != wanted.dimensionality:
        raise NotPlain(f"this one has the unit {given.strip()}")
    if difference and str(asked) in ("degree_Celsius", "degree_Fahrenheit"):
        raise NotPlain("degrees count from a zero of their own, and a difference is in K")
    if not difference and str(asked).startswith("delta"):
        raise NotPlain("this is a difference of temperatures")
    zero, one = (_registry().Quantity(Decimal(each), asked).to(wanted).magnitude for each in range(2))
    return one - zero, zero


@lru_cache(maxsize=256)
def is_unit(given: str) -> bool:
    """Whether a text is a unit of anything."""
    try:
        return _parsed(given) is not None
    except NotPlain:
        return False


def _parsed(text: str) -> Any:
    """Unit of a text, as pint has it."""
    if len(text) > LONGEST:
        raise NotPlain(f"more than {LONGEST} letters")
    text = normalize("NFKC", text).replace("−", "-").replace("Δ°", "delta_deg").replace("°", "deg").strip()
    if not text:
        raise NotPlain("there is no unit")
    if _UNIT.fullmatch(text):
        for name in _NAME.findall(text):
            _check_name(name)
        try:
            return _registry().parse_units(_GLUED.sub("**", f"1{text}" if text.startswith("/") else text))
        except Exception:  # pint has no one error for what it cannot read
            pass
    raise NotPlain(f"{text!r} is no unit; a number has a decimal point, and nothing else between its digits")


def _check_name(name):
    """Raise NotPlain for an unknown unit, and for the plural of a symbol, as Pas, which may be a product."""
    parsed = _registry().parse_unit_name
    found, usual = parsed(name), _USUAL.split()
    if not found or (len(name) <= 4 and name.endswith("s") and found[0] == (parsed(name[:-1]) or [None])[0]):
        alike = [each for each in usual if each.casefold() == name.casefold()]
        alike = alike or get_close_matches(name, usual, 1)
        question = f", did you mean {' or '.join(map(repr, alike))}?" if alike else ""
        raise NotPlain(f"no unit is called {name!r}{question}")


@lru_cache(maxsize=1)
def _registry() -> Any:
    # Takes a third of a second, and only what is written with units needs it.
    import pint

    registry: Any = pint.UnitRegistry(None, non_int_type=Decimal, on_redefinition="ignore")
    registry.load_definitions(Path(pint.__file__).with_name("default_en.txt"))
    # An angle counts as a dimension: so that a frequency [Hz] is not taken for an angular one [rad/s].
    registry.define("radian = [angle] = rad")
    return registry


_OWN = (float, int, str, bool, list, tuple, type(None))
_SIMPLE = {float, int, np.float64}
_REAL = "fiu"  # kinds of numpy's types


@dataclass(frozen=True)
class WithUnit:
    """One number out of an array with a unit, which goes with it."""

    magnitude: Any
    units: str

    def __repr__(self):
        return f"{self.magnitude} {self.units}"


def is_number(given: Any) -> bool:
    """Whether something is a real number: no truth, and no duration, which numpy counts among them."""
    return isinstance(given, Real) and not isinstance(given, bool | np.timedelta64)


def number(given: Any, unit: str | None, difference: bool = True) -> Any:
    """One number in a unit of SI, as `units.in_si` has it; a number without a unit as it is.

    unit : None where a number has none, and takes no string

    Raises NotPlain.
    """
    held, own = bare(given)
    if isinstance(held, str) and unit is not None and own is None:
        return in_si(held, unit, difference)
    if not is_number(held):
        raise NotPlain(f"an array of shape {held.shape}" if isinstance(held, np.ndarray) else "")
    return in_unit(held, own, unit, difference)


def numbers(given: Any, unit: str | None, difference: bool = True) -> Any:
    """Real numbers in a unit of SI: one of them, or an array of any shape. Those without a unit stay as they are.

    Lists may hold whatever `number` takes. Raises NotPlain.
    """
    held, own = bare(given)
    if is_number(held) or isinstance(held, str):
        return number(given, unit, difference)
    if isinstance(held, np.ndarray) and held.dtype.kind in "OU":
        held = held.tolist()
    if isinstance(held, list | tuple) and not _SIMPLE.issuperset(map(type, held)):
        held = [numbers(each, unit, difference) for each in held]
    try:
        array = np.asarray(held)
    except ValueError:
        raise NotPlain("rows of unequal lengths") from None
    if array.dtype.kind not in _REAL:
        raise NotPlain(f"an array of type {brief(str(array.dtype))}: real numbers are needed")
    return in_unit(array, own, unit, difference)


def one_by_one(given: Any) -> Any:
    """The numbers of a row, each with the unit that all of them carry; what is no array as it is."""
    if isinstance(given, Set | Mapping):
        raise NotPlain("a set has no order, nor has a mapping: give a list")
    held, own = bare(given)
    if not isinstance(held, np.ndarray):
        return given
    if held.ndim != 1:
        raise NotPlain(f"an array of shape {held.shape}: one row is needed")
    values = held.tolist() if held.dtype.kind in _REAL else list(held)
    return values if own is None else [WithUnit(value, own) for value in values]


def relabelled(given: Any, found: Any) -> Any:
    """Numbers with the labels of the array of xarray that they came from, by which such arrays are joined."""
    labelled = np.ndim(found) and hasattr(given, "dims") and hasattr(given, "coords")
    return given.copy(data=found).drop_attrs(deep=False) if labelled else found


def bare(given: Any) -> tuple[Any, str | None]:
    """Values of an object without labels and masks, and the unit that it carries; None where it has none.

    A unit is empty where something says that it has no dimension. Raises NotPlain of two units, and of bytes.
    """
    unit = None
    while type(given) not in _OWN:
        inner, own = _peeled(given)
        if own is not None and unit is not None:
            raise NotPlain(f"it has two units, {brief(own)!r} and {brief(unit)!r}")
        unit = unit if own is None else "" if own in ("1", "dimensionless") else own
        if inner is given:
            break
        given = inner
    return given, unit


def _peeled(given):
    """Object inside the outermost wrapper, and the unit of the wrapper."""
    if isinstance(given, bytes | bytearray | memoryview):
        raise NotPlain("bytes are no numbers")
    if isinstance(given, np.ma.MaskedArray):
        if count := np.ma.count_masked(given):
            raise NotPlain(f"{count} of {given.size} numbers are masked: fill them in, or leave them out")
        return given.data, None
    if hasattr(given, "dims") and hasattr(given, "attrs"):  # of xarray
        if not hasattr(given, "data"):
            raise NotPlain(f"a {type(given).__name__}: give one of its variables")
        return given.data, _stated(given)
    if hasattr(given, "to_numpy"):  # of pandas, polars
        return given.to_numpy(), _stated(given)
    if hasattr(given, "magnitude") and hasattr(given, "units"):  # of pint
        units = given.units
        return given.magnitude, units if isinstance(units, str) else format(units, "~C")
    own = getattr(given, "units", getattr(given, "unit", None))
    if own is not None and hasattr(given, "value"):  # of unyt, astropy
        return np.asarray(given.value), str(own).strip()
    if isinstance(given, np.ndarray):
        return np.asarray(given) if given.ndim else given[()], None
    return given, None


def _stated(given):
    """The unit among the attributes of an array."""
    found = [given.attrs[name] for name in ("units", "unit") if name in getattr(given, "attrs", ())]
    return str(found[0]).strip() if found else None


def in_unit(held: Any, own: str | None, unit: str | None, difference: bool = True) -> Any:
    """Convert numbers from their own unit to a unit of SI. Raises NotPlain.

    own : None, numbers stay as they are; empty, they have no dimension
    unit : None where numbers have none
    """
    if own is None or (unit is None and not own):
        return held
    if not own:
        raise NotPlain("this one has no dimension")
    if unit is None:
        raise NotPlain(f"this one has the unit {brief(own)}")
    one, zero = map(float, scale(own, unit, difference))
    return held * one + zero if zero else held * one
