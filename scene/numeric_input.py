"""Plain numbers of what other libraries hold, quantities, arrays with labels or masks, tables: their one door.

What has a unit or labels is known by its attributes: no library is imported to be asked.
"""

from collections.abc import Mapping, Set
from dataclasses import dataclass
from numbers import Real
from typing import Any

import numpy as np

from .printable import brief
from .units import NotPlain, in_si, scale

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
    """Numbers of one unit in another, of SI. Raises NotPlain.

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
