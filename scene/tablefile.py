"""Tables of numbers: named columns out of a text file, or of arrays in Python, in SI. Nothing is guessed.

The form of a file
    Text in UTF-8, or UTF-16 with its mark. One heading row of names, each with its unit behind it, as
    `name [unit]` or `name (unit)`, or with one row of units below. Cells are separated by tabs, semicolons, commas
    or blanks: the first of these that stands in the heading. Between tabs or semicolons decimals may have commas,
    if no number has a point. Lines that begin with # above the heading are skipped. Every row below the heading
    has as many cells as it; blank lines are at the end alone.

Use
    A reader lists the columns that it knows, and gets those that are there by field, in SI:

    >>> known = Column("x", ("x",), (METRE,)), Column("z", ("z", "height"), (METRE,), needed=True)
    >>> columns = read_columns("profile.csv", known, TableFormat(units={"x": "mm", "z": "um"}))
    >>> columns["z"], "x" in columns, columns.units["z"] is METRE, columns.headings["z"], columns.place(row=0)

    A table in Python is a DataFrame, a Dataset of xarray or a mapping of arrays, by the same names. Quantities of
    pint and numbers with a unit in their attributes are converted.

Refusals
    What differs from this form raises ValueError with file, line, what stands there and the option of
    `TableFormat` that states it. `TableFormat(...)` itself raises pydantic's ValidationError, a ValueError.
    - A column without a unit is in SI only if the heading is the first line of the file, as other lines above it
      may hold units, and if no other column has a unit that is not of SI. Columns with `unit_needed` have no
      default, and of several `units` the choice is left open.
    - A column that is not used must not tell samples, steps or temperatures apart: of text, or of numbers that
      repeat, it must have one value, or be in `where`. Names of `REDUNDANT` and of known columns are exempt.
    - Two columns of one field, unless `columns` states which one is used.
"""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from json import dumps
from pathlib import Path
from typing import Any
from unicodedata import normalize

import numpy as np
from pydantic import ValidationError

from .plain import bare, in_unit
from .printable import brief
from .quantities import HERTZ, RADIAN_PER_SECOND, Unit
from .tableformat import FromTable, TableFormat, split_format
from .tabletext import NUMBER, Cells, read_rows, read_text, shown

__all__ = [
    "Column",
    "Columns",
    "FromTable",
    "TableFormat",
    "filled",
    "read_columns",
    "read_rows",
    "refused",
    "split_format",
]

MOST_BYTES = 20_000_000
# Other quantities of one measurement: they may vary, and need not be used.
REDUNDANT = (
    *("time", "t", "index", "point", "tan delta", "phase", "|G*|", "|E*|", "complex modulus"),
    *("torque", "strain", "stress", "displacement", "normal force"),
)
_WITH_UNIT = re.compile(r"(?P<name>.+?)\s*(?:\[(?P<a>[^\[\]]*)\]|\((?P<b>[^()]*(?:\([^()]*\)[^()]*)*)\))")
_LETTERS = str.maketrans(
    {"’": "'", "′": "'", '"': "''", "ω": "omega", "δ": "delta", "η": "eta", "τ": "tau", "μ": "mu", "_": " "}
)
_PURE = "", "-", "1"
_PER_SECOND = "1/s", "s^-1", "s-1", "s⁻¹"


@dataclass(frozen=True)
class Column:
    """A column that a reader knows.

    field : name of the quantity, a name of the column too
    names : in headings; case, blanks and underscores aside, but a name of a single letter has its case
    units : of SI, one for each dimension that it may have; none of pure numbers
    needed : whether it must be there
    unit_needed : whether its unit must be stated, as that of a temperature
    gaps : whether empty cells and nan become NaN; otherwise they are refused
    """

    field: str
    names: tuple[str, ...]
    units: tuple[Unit, ...] = ()
    needed: bool = False
    unit_needed: bool = False
    gaps: bool = False


@dataclass(eq=False)
class Columns:
    """Columns that were found.

    cells : of the table, for messages
    values : (rows,) by field, in SI
    units : of SI by field; None where the table states none
    headings : names in the table by field
    notes : names of the other columns, a line each
    """

    cells: Cells
    values: dict[str, np.ndarray]
    units: dict[str, Unit | None]
    headings: dict[str, str]
    notes: tuple[str, ...] = ()

    def __contains__(self, name: str) -> bool:
        return name in self.values

    def __getitem__(self, name: str) -> np.ndarray:
        return self.values[name]

    @property
    def name(self) -> str:
        """Of the table, for messages."""
        return self.cells.name

    def place(self, row: int) -> str:
        """Where a row stands, for messages."""
        return self.cells.place(row)

    def refuse(self, name: str, wrong: np.ndarray, why: str) -> None:
        """Raise ValueError for the first row (rows,) in which a field is wrong."""
        if wrong.any():
            row = int(np.argmax(wrong))
            raise ValueError(f"{self.place(row)}: {name} = {self.values[name][row]:g} {why}")


def read_columns(
    table: Any, known: Sequence[Column], stated: TableFormat | None = None, most_bytes: int = MOST_BYTES
) -> Columns:
    """The columns of a table that a reader knows.

    table : path of a text file, a DataFrame, a Dataset of xarray, or a mapping of arrays

    Raises ValueError for what is not in the documented form and not stated, see the module.
    """
    stated = stated or TableFormat()
    if isinstance(table, str | Path):
        cells = read_text(Path(table), stated, most_bytes, lambda below: any(map(_is_unit, below)))
    else:
        cells = _of_python(table)
    whole = list(cells.headings)
    places = _places(cells, whole, known, stated)
    used = _select(cells, whole, places, known, stated)
    units = {each: _unit(cells, places[each.field], each, stated) for each in known if each.field in places}
    own = [(each.units, unit) for each, unit in units.items() if each.units and not each.unit_needed]
    si = cells.first and all(not unit or unit in [one.symbol for one in several] for several, unit in own)
    others = [k for k, each in enumerate(cells.columns) if k not in used and any(map(str, each))]
    notes = tuple(f"{cells.name}: column {shown(cells.headings[k])} is not used" for k in others)
    found = Columns(cells, {}, {}, {}, notes)
    for each, unit in units.items():
        place = places[each.field]
        found.headings[each.field] = cells.headings[place]
        numbers, default = cells.numbers(place, each.gaps), si and not each.unit_needed
        found.values[each.field], found.units[each.field] = _in_si(found, each, numbers, unit, default)
    return found


def filled(given: Mapping[str, Any], known: Sequence[Column]) -> dict[str, Any]:
    """What is stated for a part of a scene, with fields out of the columns of `table`, where that is stated.

    Raises ValueError for what is stated of no table, and ValidationError, at table, for one that is refused.
    """
    written, rest = split_format(given)
    if (table := rest.pop("table", None)) is None:
        if written != TableFormat():
            raise ValueError("table is missing, of which columns, units or lines are stated")
        return rest
    try:
        columns = read_columns(table, known, written)
        if both := columns.values.keys() & rest.keys():
            raise ValueError(f"{columns.name}: {min(both)} is stated beside it, and a column of it: leave one out")
    except ValueError as error:
        raise refused(table, error) from error
    return rest | columns.values


def refused(table: Any, reason: ValueError) -> ValidationError:
    """A mistake of the field `table`."""
    line: Any = {
        "type": "value_error",
        "loc": ("table",),
        "input": table,
        "ctx": {"error": ValueError(str(reason))},
    }
    return ValidationError.from_exception_data("table", [line])


def _of_python(table):
    if hasattr(table, "to_dataframe") and hasattr(table, "variables"):  # of xarray
        items = [(name, table[name]) for name in table.variables if table[name].ndim == 1]
    elif isinstance(table, Mapping) or (hasattr(table, "columns") and hasattr(table, "__getitem__")):
        items = [(name, table[name]) for name in getattr(table, "columns", table)]
    else:
        raise ValueError(f"{shown(table)}: a path, a DataFrame, a Dataset of xarray or arrays by their names")
    cells = Cells(type(table).__name__, [], [], [])
    for heading, given in items:
        values, unit = bare(given)
        array = np.asarray(values)
        if array.ndim != 1 or not array.size:
            raise ValueError(f"{cells.name}, column {shown(heading)}: shape {array.shape}, and (rows,) is needed")
        cells.headings.append(str(heading))
        cells.units.append(unit or "")
        cells.columns.append(
            array.astype(float) if array.dtype.kind in "fiu" else np.array(list(map(str, array)), object)
        )
    if len(lengths := {len(each) for each in cells.columns}) != 1:
        raise ValueError(f"{cells.name}: columns of {sorted(lengths)} rows, which must be equally many")
    return cells


def _key(name):
    """A name as it is compared."""
    key = "".join(normalize("NFKC", normalize("NFKC", name).translate(_LETTERS)).split()).translate(_LETTERS)
    return key if len(key) == 1 else key.casefold()


def _places(cells, whole, known, stated):
    """Column by field; units of headings become those of the table. whole : headings as they are written."""
    names = {_key(name): each.field for each in known for name in (each.field, *each.names)}
    columns, units = stated.columns or {}, stated.units or {}
    if unknown := {*columns, *units} - {each.field for each in known}:
        raise ValueError(
            f"{shown(min(unknown))} is none of the columns: {', '.join(each.field for each in known)}"
        )
    for k, heading in enumerate(whole):
        found = None if _key(heading) in names else _WITH_UNIT.fullmatch(heading)
        unit = (found["a"] or found["b"] or "").strip() if found else ""
        if found and (cells.units[k] in _PURE or _is_unit(unit)):
            if cells.units[k] not in _PURE and not _same(unit, cells.units[k]):
                two = f"{shown(heading)} and {shown(cells.units[k])}"
                raise ValueError(f"{cells.name}: {two} are two units of one column")
            cells.headings[k], cells.units[k] = found["name"], unit
    places = {name: _called(cells, whole, each) for name, each in columns.items()}
    for k, heading in enumerate(cells.headings):
        name = names.get(_key(heading))
        if name is None or name in columns or k in places.values():
            continue
        if name in places:
            both = f"{shown(whole[places[name]])} and {shown(whole[k])}"
            state = f"state one, as columns = {{{name} = {_toml(whole[k], quoted=True)}}}"
            raise ValueError(f"{cells.name}: {both} are both {name}: {state}")
        places[name] = k
    for each in known:
        if each.field not in places and (each.needed or each.field in units):
            raise ValueError(
                f"{cells.name}: there is no column {each.field} ({', '.join(each.names)}), but "
                f"{brief(', '.join(map(repr, whole)))}: state its heading, as columns = {{{_toml(each.field)} = "
                f"{_toml(whole[0], quoted=True)}}}, or skip for lines above the heading"
            )
    return places


def _called(cells, whole, heading):
    """Column of a stated heading, with its unit or without, or of a number."""
    wanted = _key(str(heading))
    found = [k for names in (whole, cells.headings) for k, each in enumerate(names) if _key(each) == wanted]
    if len(set(found)) != 1:
        many = "several columns are" if found else "no column is"
        raise ValueError(
            f"{cells.name}: {many} called {shown(heading)}; there are {brief(', '.join(map(repr, whole)))}"
        )
    return found[0]


def _select(cells, whole, places, known, stated):
    """Keep the rows that are stated, and return the columns that are used or stated.

    Raises ValueError for another one that tells rows apart.
    """
    kept, free = np.ones(len(cells.columns[0]), bool), set(places.values())
    for heading, value in (stated.where or {}).items():
        place = _called(cells, whole, heading)
        free.add(place)
        if value != "*":
            kept &= [_equal(str(cell), str(value)) for cell in cells.columns[place]]
    if not kept.any():
        raise ValueError(f"{cells.name}: no row has {brief(repr(dict(stated.where or {})))}")
    cells.columns = [each[kept] for each in cells.columns]
    cells.lines = np.array(cells.lines)[kept].tolist() if cells.lines else ()
    exempt = {_key(name) for name in (*REDUNDANT, *(name for each in known for name in each.names))}
    for k, heading in enumerate(cells.headings):
        if k not in free and _key(heading) not in exempt:
            _refuse_apart(cells, heading, list(map(str, cells.columns[k])))
    return free


def _refuse_apart(cells, heading, texts):
    """Raise ValueError for a column of text, or of numbers that repeat, with several values."""
    values = list(dict.fromkeys(texts))
    if len(values) == 1 or (
        len(values) == len(texts) and all(NUMBER.fullmatch(each.replace(",", ".")) for each in values)
    ):
        return
    key, (own, first, second) = _toml(heading), [_toml(each, quoted=True) for each in (heading, *values[:2])]
    raise ValueError(
        f"{cells.name}: column {shown(heading)} has several values, {first} and {second}, and is not used: state "
        f"its quantity, as columns = {{field = {own}}}, or where = {{{key} = {first}}} for rows of one value, "
        f'where = {{{key} = "*"}} for all'
    )


def _equal(cell, value):
    numbers = NUMBER.fullmatch(cell) and NUMBER.fullmatch(value)
    return float(cell) == float(value) if numbers else cell == value


def _unit(cells, place, column, stated):
    """Unit of a column as it is written or stated; empty without one. Raises ValueError where both differ."""
    unit, own = cells.units[place], (stated.units or {}).get(column.field, "")
    unit = "" if unit in _PURE or (own and not _is_unit(unit)) else unit
    if unit in _PER_SECOND and RADIAN_PER_SECOND in column.units:
        unit = "" if HERTZ in column.units else "rad/s"  # 1/s of a frequency may be either
    if unit and own and not _same(unit, own):
        heading = cells.headings[place]
        raise ValueError(
            f"{cells.name}: column {shown(heading)} is in {shown(unit)}, and units states {shown(own)}: they must "
            "agree"
        )
    return unit or own


def _in_si(found, column, numbers, unit, default):
    """Numbers in SI, and the unit of SI; None where there is no unit.

    default : whether numbers without a unit are in SI
    """
    symbol = column.units[0].symbol if column.units else ""
    where = f"{found.name}: column {shown(found.headings[column.field])}"
    state = f"state units = {{{_toml(column.field)} = {_toml(symbol, quoted=True)}}}"
    if not unit:
        if not default and (len(column.units) == 1 or column.unit_needed):
            raise ValueError(f"{where} has no unit in the heading: {state}")
        return numbers, None
    reasons = []
    for each in column.units:
        try:
            return in_unit(numbers, unit, each.symbol, each.difference), each
        except ValueError as error:
            reasons.append(str(error))
    kinds = " or ".join(each.kind for each in column.units) or "a number without a unit"
    raise ValueError(f"{where} is in {shown(unit)}, and is {kinds} ({brief('; '.join(reasons))}): {state}")


def _is_unit(text):
    # Units take time to load, and only tables that have some need them.
    from .units import Unreadable, known

    try:
        return known(text)
    except Unreadable:
        return False


def _same(one, other):
    """Whether two units are one."""
    from .units import Unreadable, scale

    try:
        return scale(one, one, False) == scale(other, one, False)
    except Unreadable:
        return False


def _toml(name, quoted=False):
    """A name in TOML, as a key or a value."""
    name = brief(name, 80)
    return name if not quoted and re.fullmatch(r"[\w-]+", name, re.ASCII) else dumps(name, ensure_ascii=False)
