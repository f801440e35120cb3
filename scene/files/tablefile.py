"""Tables of numbers: the columns that a reader knows, in SI, out of a text file or of arrays in Python.

A file has the form of `tabletext`. One heading row has names with units, as `name [unit]` or `name (unit)`, or one
row of units below it. A DataFrame, a Dataset of xarray or a mapping of arrays has columns of the same names, and
quantities of pint and attributes have units. Nothing is guessed; what `TableFormat` does not state is refused:

- a column without a unit, unless its unit is not needed, the heading is the first line, and all others are in SI
- two columns for the same field, unless `columns` states which one is used
- a column that is not used, and may tell samples apart: of text, or of numbers that repeat, with several values
"""

import re
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from unicodedata import normalize

import numpy as np

from ..numeric_input import bare, in_unit, is_unit
from ..printable import brief, shown
from ..quantities import HERTZ, RADIAN_PER_SECOND, Unit
from .stated import TableFormat
from .tabletext import PURE, Cells, read_text

# Other quantities of a measurement, which may vary and need not be used.
REDUNDANT = (
    *("time", "t", "index", "point", "tan delta", "phase", "|G*|", "|E*|", "complex modulus"),
    *("torque", "strain", "stress", "displacement", "normal force"),
)
_WITH_UNIT = re.compile(r"(.+?)\s*(?:\[([^\[\]]*)\]|\(([^()]*(?:\([^()]*\)[^()]*)*)\))")
_LETTERS = str.maketrans(
    {"’": "'", "′": "'", '"': "''", "ω": "omega", "δ": "delta", "η": "eta", "τ": "tau", "μ": "mu", "_": " "}
)


@dataclass(frozen=True)
class Column:
    """A column that a reader knows.

    field : name of the quantity, a name of the column too
    names : in headings; case, blanks and underscores aside, but a name of a single letter has its case
    units : of SI, one for each dimension that it may have; none of pure numbers
    needed, unit_needed : whether it must be there, and its unit stated
    gaps : whether empty cells and nan become NaN; otherwise they are refused
    """

    field: str
    names: tuple[str, ...]
    units: tuple[Unit, ...] = ()
    needed: bool = False
    unit_needed: bool = False
    gaps: bool = False


class Columns(dict[str, np.ndarray]):
    """Columns that were found, (rows,) in SI, by field.

    units : of SI by field; None where the table states none
    headings : names in the table by field
    name : of the table; place : of a row, for messages
    notes : names of the columns that are not used, a line each
    """

    def __init__(self, cells: Cells, headings: dict[str, str], unused: Sequence[str]):
        self.name, self.place, self.headings = cells.name, cells.place, headings
        self.notes = tuple(f"{cells.name}: column {shown(each)} is not used" for each in unused)
        self.units: dict[str, Unit | None] = {}

    def refuse(self, name: str, wrong: np.ndarray, why: str) -> None:
        """Raise ValueError for the first row (rows,) in which a field is wrong."""
        for row in np.flatnonzero(wrong)[:1]:
            raise ValueError(f"{self.place(row)}: {name} = {self[name][row]:g} {why}")


def read_columns(
    table: Any, known: Sequence[Column], stated: TableFormat | None = None, most_bytes: int = 20_000_000
) -> Columns:
    """Columns of a path, a DataFrame, a Dataset of xarray or a mapping of arrays. Raises ValueError, see above."""
    stated = stated or TableFormat()
    cells: Any = read_text(table, stated, most_bytes) if isinstance(table, str | Path) else _of_python(table)
    fields = {_key(name): each.field for each in known for name in (each.field, *each.names)}
    names = [*cells.headings]
    for k, heading in enumerate(names):
        split = None if cells.units[k] not in PURE or _key(heading) in fields else _WITH_UNIT.fullmatch(heading)
        if split and (split[2] is not None or is_unit(split[3])):
            names[k], cells.units[k] = split[1], split[2] or split[3] or ""
    places = _places(cells, names, known, fields, stated)
    used = _select(cells, names, places, fields, stated)
    units = {each: _unit(cells, places[each.field], each, stated) for each in known if each.field in places}
    needed = [(each, unit) for each, unit in units.items() if each.units and not each.unit_needed]
    si = cells.first and all(unit in ("", *(one.symbol for one in each.units)) for each, unit in needed)
    unused = [name for k, name in enumerate(names) if k not in used and cells.frame[k].astype(str).any()]
    found = Columns(cells, {each: names[k] for each, k in places.items()}, unused)
    for each, unit in units.items():
        where, numbers = shown(found.headings[each.field]), cells.finite(places[each.field], each.gaps)
        found[each.field], found.units[each.field] = _in_si(
            f"{cells.name}: column {where}", each, numbers, unit, si
        )
    return found


def _of_python(table):
    if not (isinstance(table, Mapping) or hasattr(table, "columns")):
        raise ValueError(f"{shown(table)}: a path, a DataFrame, a Dataset of xarray or arrays by their names")
    every = getattr(table, "variables", getattr(table, "columns", table))  # of xarray, pandas, a mapping
    names = [name for name in every if getattr(table[name], "ndim", 1)]  # of xarray one number may be a coordinate
    held = [bare(table[name]) for name in names]
    from pandas import DataFrame, RangeIndex  # slow, and few scenes need it

    frame = DataFrame({k: np.asarray(values) for k, (values, _) in enumerate(held)})
    if not frame.size:
        raise ValueError(f"{type(table).__name__}: there is no row in it")
    frame = frame.apply(lambda each: each.astype(float) if each.dtype.kind in "fiu" else each.map(str))
    frame.index = RangeIndex(1, len(frame) + 1, name="row")
    return Cells(type(table).__name__, frame, [*map(str, names)], [unit or "" for _, unit in held])


def _key(name):
    """A name as it is compared."""
    key = "".join(normalize("NFKC", name).translate(_LETTERS).split())
    return key if len(key) == 1 else key.casefold()


def _find(cells, names, heading):
    """Column of a stated heading, with its unit or without, or of a number."""
    wanted, pairs = _key(str(heading)), zip(cells.headings, names, strict=True)
    found = [k for k, pair in enumerate(pairs) if wanted in map(_key, pair)]
    if len(found) != 1:
        there = brief(", ".join(map(repr, cells.headings)))
        raise ValueError(f"{cells.name}: {len(found)} columns are called {shown(heading)}; there are {there}")
    return found[0]


def _places(cells, names, known, fields, stated):
    """Column by field. names : headings without units"""
    columns, units = stated.columns or {}, stated.units or {}
    if unknown := {*columns, *units}.difference(allowed := [each.field for each in known]):
        raise ValueError(f"{shown(min(unknown))} is none of the columns: {', '.join(allowed)}")
    places = {name: _find(cells, names, heading) for name, heading in columns.items()}
    taken = {*places.values()}
    for k, name in enumerate(fields.get(_key(each)) for each in names):
        if name in (None, *columns) or k in taken:
            continue
        if name in places:
            one, other = shown(cells.headings[places[name]]), shown(cells.headings[k])
            raise ValueError(
                f"{cells.name}: {one} and {other} are both {name}: state one, as columns = {{{name} = {other}}}"
            )
        places[name] = k
    for each in known:
        if each.field not in places and (each.needed or each.field in units):
            there = brief(", ".join(map(repr, cells.headings)))
            raise ValueError(
                f"{cells.name}: there is no column {each.field} ({', '.join(each.names)}), but {there}: state its "
                f"heading, as columns = {{{each.field} = {shown(cells.headings[0])}}}, or skip"
            )
    return places


def _select(cells, names, places, fields, stated):
    """Keep the rows that are stated, and return the columns that are used or stated. Raises ValueError."""
    kept, free, where = np.ones(len(cells.frame), bool), {*places.values()}, dict(stated.where or {})
    for heading, value in where.items():
        free.add(place := _find(cells, names, heading))
        there = cells.numbers(place) if isinstance(value, int | float) else cells.frame[place].to_numpy()
        kept &= (value == "*") | (there == value)
    if not kept.any():
        raise ValueError(f"{cells.name}: no row has {brief(repr(where))}")
    cells.frame = cells.frame[kept]
    for k in {*cells.frame}.difference(free):
        values = cells.frame[k].unique()
        counted = len(values) == len(cells.frame) and np.isfinite(cells.numbers(k)).all()
        if len(values) > 1 and not counted and _key(names[k]) not in {*fields, *map(_key, REDUNDANT)}:
            own, one, other = map(shown, (names[k], *map(str, values[:2])))
            raise ValueError(
                f"{cells.name}: column {own} has several values, {one} and {other}, and is not used: state its "
                f"quantity, as columns = {{field = {own}}}, or where = {{{own} = {one}}}, and '*' for all rows"
            )
    return free


def _unit(cells, place, column, stated):
    """Unit of a column as it is written or stated; empty without one. Raises ValueError where both differ."""
    unit, own = cells.units[place].strip(), (stated.units or {}).get(column.field, "")
    if unit in PURE:
        return own
    if unit in ("1/s", "s^-1", "s-1", "s⁻¹") and RADIAN_PER_SECOND in column.units:
        unit = "" if HERTZ in column.units else "rad/s"  # 1/s of a frequency may be either
    if unit and own and "".join(unit.split()) != "".join(own.split()):
        heading, both = shown(cells.headings[place]), f"is in {shown(unit)}, and units states {shown(own)}"
        raise ValueError(f"{cells.name}: column {heading} {both}: they must agree")
    return unit or own


def _in_si(where, column, numbers, unit, si):
    """Numbers in SI, and the unit of SI; None where there is no unit. si : whether that is then the unit"""
    state = f"state units = {{{column.field} = {next((each.symbol for each in column.units), '')!r}}}"
    if not unit and (column.unit_needed or (len(column.units) == 1 and not si)):
        raise ValueError(f"{where} has no unit in the heading: {state}")
    if not unit:
        return numbers, None
    for each in column.units:
        with suppress(ValueError):
            return in_unit(numbers, unit, each.symbol, each.difference), each
    kinds = " or ".join(each.kind for each in column.units) or "a number without a unit"
    raise ValueError(f"{where} is in {shown(unit)}, and is {kinds}: {state}")
