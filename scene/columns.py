"""Columns of a sheet by their headings, in the units that those give."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from .heading import Heading, named
from .plain import NotPlain, bare, in_unit
from .printable import brief
from .quantities import KELVIN, Unit
from .sheet import Sheet
from .spelling import speaks_of, spelt

PURE = ("", "1", "-", "[-]", "none")  # written for no unit
_MARKS = str.maketrans(',;|"[]()/\t', " " * 10)
_HERTZ = {"hz": "Hz", "HZ": "Hz"}  # no prefix is meant
# As they stand in headings of temperatures alone: elsewhere they are other units.
_DEGREES = {"C": "degC", "c": "degC", "F": "degF", "deg. C": "degC", "deg C": "degC", "º C": "degC", "ºC": "degC"}


@dataclass(frozen=True)
class Column:
    """A column that is sought in a sheet.

    field : name of ours
    called : names that people use; small and capital letters are told apart only where two columns need it
    units : that it may have, one of SI for each kind of quantity; none of pure numbers
    optional : whether it may be absent
    """

    field: str
    called: tuple[str, ...]
    units: tuple[Unit, ...] = ()
    optional: bool = False


@dataclass(frozen=True, eq=False)
class Chosen:
    """A column that was found.

    numbers : (rows,), in the unit; as they stand in the sheet where that states none
    unit : of SI; None where the sheet states none
    name : heading; empty without one
    index : place in the sheet, from 0
    """

    numbers: np.ndarray
    unit: Unit | None
    name: str
    index: int


def chosen(
    sheet: Sheet, wanted: Sequence[Column], positional: Sequence[str] = ()
) -> tuple[dict[str, Chosen], tuple[str, ...]]:
    """The columns of a sheet by field, and notes that name those which nothing is known of.

    positional : fields of the columns of a sheet without a heading, in their order

    Raises ValueError for a unit that is unknown or of something else, for a column that is missing or there twice,
    and for a text above the numbers that may be the heading of them.
    """
    fields = {column.field: column for column in wanted}
    if sheet.names and sheet.unread:
        raise ValueError(
            f"{sheet.name}: {brief(repr(sheet.unread))} between heading and numbers is neither: leave it out, or "
            "begin it with #"
        )
    if not sheet.names or (sheet.commented and not any(meant(name, wanted) for name in sheet.names)):
        places = _by_place(sheet, wanted, positional)
    else:
        places = _by_name(sheet, wanted)
    if any(not (sheet.units and sheet.units[k]) and fields[name].units for name, k in places.items()):
        _refuse_spoken_units(sheet, wanted)
    if lacking := [each for each in wanted if not each.optional and each.field not in places]:
        raise ValueError(f"{_heading(sheet)} has no column for {'; nor for '.join(map(_allowed, lacking))}")
    known = {name: _converted(sheet, index, fields[name]) for name, index in places.items()}
    rest = [k for k in range(sheet.numbers.shape[1]) if k not in places.values()]
    return known, tuple(f"{sheet.name}: column {brief(_title(sheet, k))} is not used" for k in rest)


def refuse_half_stated(sheet: Sheet, found: Iterable[Chosen]) -> None:
    """Raise ValueError where of columns of one kind some state a unit other than that of SI, and others none."""
    found = list(found)
    bare = [each.name for each in found if each.unit is None]
    other = [each.name for each in found if each.unit and sheet.units[each.index] != each.unit.symbol]
    if bare and other:
        raise ValueError(
            f"{_heading(sheet)} gives a unit of {other[0]!r} and none of {bare[0]!r}: write both, or none"
        )


def sheet_of(table: Any) -> Sheet:
    """A table of another library as a sheet: a DataFrame, a Dataset of xarray, or arrays by their names.

    Units are those that the arrays carry, as attribute or as quantity, or those of the names, as "F_N [mN]".
    Raises ValueError for what is no table of numbers.
    """
    names, units, columns = [], [], []
    for name, held in _items(table):
        called, unit = named(str(name))
        values, own = bare(held)
        if own and unit and own != unit:
            raise ValueError(f"{brief(str(name))}: it carries the unit {brief(own)} beside that of its name")
        try:
            column = np.asarray(values, float)
        except (TypeError, ValueError):
            continue  # of words
        if column.ndim != 1:
            raise ValueError(f"{brief(str(name))}: an array of shape {column.shape}: one column is needed")
        names.append(called)
        units.append(own or unit)
        columns.append(column)
    if len({len(each) for each in columns}) != 1:
        raise ValueError(f"a {type(table).__name__} with columns of {sorted({len(c) for c in columns})} numbers")
    numbers = np.column_stack(columns)
    return Sheet(type(table).__name__, numbers, heading=Heading(tuple(names), tuple(units)))


def _items(table):
    if hasattr(table, "to_dataframe") and hasattr(table, "variables"):  # of xarray
        return [(str(name), table[name]) for name in table.variables if table[name].ndim == 1]
    if hasattr(table, "columns") and hasattr(table, "__getitem__"):
        return [(name, table[name]) for name in table.columns]
    if isinstance(table, Mapping):
        return list(table.items())
    raise ValueError(f"{brief(repr(table))}: a path, a DataFrame, a Dataset of xarray or arrays by their names")


def meant(name: str, wanted: Sequence[Column]) -> list[Column]:
    """The columns that a heading may name: by its letters as they are, else whatever their size."""
    name = spelt(name)
    exact = [each for each in wanted if name in map(spelt, each.called)]
    alike = exact or [each for each in wanted if _is_called(each, name)]
    # A word and the symbol of the same, as "Normal force F_N".
    word, _, symbol = name.partition(" ")
    while not alike and symbol:
        alike = [each for each in wanted if _is_called(each, word) and _is_called(each, symbol)]
        further, _, symbol = symbol.partition(" ")
        word = f"{word} {further}"
    return alike


def _is_called(column, name):
    name = name[1:-1] if name[:1] + name[-1:] == "()" else name
    return name.casefold() in (spelt(called).casefold() for called in column.called)


def _by_name(sheet, wanted):
    places: dict[str, int] = {}
    for index, name in enumerate(sheet.names):
        said = meant(name, wanted)
        if len(said) > 1:
            either = " or ".join(each.field for each in said)
            raise ValueError(f"{_heading(sheet)}: {brief(repr(name))} may be {either}: write it out")
        if said and said[0].field in places:
            twice = sheet.names[places[said[0].field]]
            raise ValueError(
                f"{_heading(sheet)}: {brief(repr(twice))} and {brief(repr(name))} are both {said[0].field}: keep "
                "one"
            )
        if said:
            places[said[0].field] = index
    return places


def _by_place(sheet, wanted, positional):
    if not positional or sheet.numbers.shape[1] != len(positional):
        needed = f"; without a heading, {', '.join(positional)} are needed, and no others" if positional else ""
        count = sheet.numbers.shape[1]
        raise ValueError(f"{_heading(sheet)}: {count} column{'s' * (count != 1)} without a heading{needed}")
    for text in filter(None, (*sheet.before, sheet.unread)):
        if sum(any(speaks_of(text, name) for name in each.called) for each in wanted) > 1:
            raise ValueError(
                f"{sheet.name}: {brief(repr(text))} above the numbers is no heading of {len(positional)} columns: "
                "part its names by semicolons or tabs"
            )
    return {field: index for index, field in enumerate(positional)}


def _refuse_spoken_units(sheet, wanted):
    """Raise ValueError for a text beside the numbers with a unit that may be one of a column without any."""
    units = {unit for each in wanted for unit in each.units}
    for text in (*sheet.before, sheet.unread, *(sheet.names if sheet.commented else ())):
        words = text.translate(_MARKS).split()
        for before, word in zip(["", *words], words, strict=False):
            if not before[-1:].isdigit() and any(_of_another_size(unit, word) for unit in units):
                raise ValueError(
                    f"{sheet.name} speaks of {brief(word)} beside its numbers, and no heading says of which "
                    "column: write units into the heading"
                )


def _of_another_size(unit, word):
    """Whether a word is a unit of the same kind, and another one. One letter may be anything."""
    try:
        return len(word) > 1 and any(map(str.isalpha, word)) and unit.scale(word) != (1, 0)
    except ValueError:
        return False


def _converted(sheet, index, column):
    values, stated = sheet.numbers[:, index], sheet.units[index] if sheet.units else ""
    name = sheet.names[index] if sheet.names else ""
    if KELVIN in column.units:
        stated = _DEGREES.get(stated, stated)
    if stated in PURE:
        return Chosen(values, None, name, index)
    stated, reasons = _HERTZ.get(stated, stated), []
    for unit in column.units:
        try:
            return Chosen(in_unit(values, stated, unit.symbol, unit.difference), unit, name, index)
        except (NotPlain, ValueError) as error:
            reasons.append(str(error))
    reason = max(reasons, key=lambda each: "did you mean" in each, default="")
    needed = " or ".join(f"that of {unit.kind}, as {unit.symbol}" for unit in column.units) or "none"
    raise ValueError(
        f"{_heading(sheet)} gives {column.field} in {brief(repr(stated))}{f' ({reason})' if reason else ''}: the "
        f"unit needed is {needed}"
    )


def _title(sheet, index):
    return repr(sheet.names[index]) if sheet.names else str(index + 1)


def _heading(sheet):
    if not sheet.names:
        return f"{sheet.name}, line {sheet.lines[0]}" if len(sheet.lines) else sheet.name
    return f"{sheet.name}: the heading ({brief(', '.join(sheet.names))})"


def _allowed(column):
    return f"{column.field}, called {', '.join(column.called)}"
