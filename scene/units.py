"""Quantities written with a unit, as "5 mm": read into SI by pint, to the float nearest to the text."""

import re
from decimal import Decimal
from difflib import get_close_matches
from functools import lru_cache
from math import isinf
from pathlib import Path
from typing import Any
from unicodedata import normalize

LONGEST = 100  # letters of a quantity

_NUMBER = re.compile(r"\s*([+\-−]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+\-−]?[0-9]+)?)(.*)", re.DOTALL)
_NAME = re.compile(r"[^\W\d_]++(?:_[^\W\d_]++)*+")
# Names, each with a power of one digit, as mm2, mm^2 and s-1, between marks. What else pint computes is no unit.
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
