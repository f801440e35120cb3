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

import csv
import re
from collections.abc import Mapping, Sequence
from dataclasses import InitVar, dataclass
from io import StringIO
from json import dumps
from pathlib import Path
from typing import Annotated, Any, Literal
from unicodedata import normalize

import numpy as np
import pandas as pd
from pydantic import Field, ValidationError
from pydantic.dataclasses import dataclass as checked

from . import files
from .plain import bare, in_unit
from .printable import brief
from .quantities import CLOSED, HERTZ, RADIAN_PER_SECOND, Unit

MOST_BYTES = 20_000_000
SEPARATORS = {"tab": "\t", "semicolon": ";", "comma": ",", "blanks": " "}
# Other quantities of one measurement: they may vary, and need not be used.
REDUNDANT = (
    *("time", "t", "index", "point", "tan delta", "phase", "|G*|", "|E*|", "complex modulus"),
    *("torque", "strain", "stress", "displacement", "normal force"),
)
_BINARY = {
    b"PK\3\4": "a zip archive, as workbooks (.xlsx) are: save the sheet as CSV",
    b"\x89PNG": "a picture (.png)",
    b"II*\0": "a picture (.tif)",
    b"MM\0*": "a picture (.tif)",
}
_END = "\3"  # a last cell of each row, which is elsewhere if there are too few
_NUMBER, _COMMA_NUMBER = (
    re.compile(rf"[+-]?(?:\d+{mark}?\d*|{mark}\d+)(?:[eE][+-]?\d+)?", re.ASCII) for mark in (r"\.", ",")
)
_THOUSANDS = re.compile(r"[+-]?[1-9]\d{0,2}(?:,\d{3})+")
_WITH_UNIT = re.compile(r"(?P<name>.+?)\s*(?:\[(?P<a>[^\[\]]*)\]|\((?P<b>[^()]*(?:\([^()]*\)[^()]*)*)\))")
_BLANKS = re.compile(r"\s+(?![\[(])(?![^\[(]*[\])])")  # not before a unit in brackets, nor within one
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


_Lines = Annotated[int, Field(strict=True, ge=0)]


@checked(frozen=True, config=CLOSED, kw_only=True)
class TableFormat:
    """What a user states of a table that differs from the documented form.

    columns : heading by field, as {"storage": "E' (MPa)"}; or number from 1 on, of a file without a heading
    units : unit by field, of columns whose heading has none
    where : value by heading, of the rows that are read; "*" for rows of any value
    separator : "tab", "semicolon", "comma" or "blanks", or the character itself
    decimal : "." or ","
    encoding : of the file, as "cp1252"
    skip : number of lines above the heading
    rows : number of rows below it that are read
    """

    columns: Mapping[str, str | Annotated[int, Field(strict=True, ge=1)]] | None = None
    units: Mapping[str, str] | None = None
    where: Mapping[str, str | int | float] | None = None
    separator: Literal["tab", "semicolon", "comma", "blanks", "\t", ";", ",", " "] | None = None
    decimal: Literal[".", ","] | None = None
    encoding: str | None = None
    skip: _Lines | None = None
    rows: _Lines | None = None


@checked(frozen=True, config=CLOSED, kw_only=True)
class FromTable:
    """A part of a scene that may be read from a table, with the fields of `TableFormat` as arguments."""

    columns: InitVar[Mapping[str, str | int] | None] = None
    units: InitVar[Mapping[str, str] | None] = None
    where: InitVar[Mapping[str, str | int | float] | None] = None
    separator: InitVar[str | None] = None
    decimal: InitVar[str | None] = None
    encoding: InitVar[str | None] = None
    skip: InitVar[int | None] = None
    rows: InitVar[int | None] = None


def split_format(given: Mapping[str, Any]) -> tuple[TableFormat, dict[str, Any]]:
    """What is stated of the table among what is stated for a part of a scene, and the rest."""
    names = TableFormat.__dataclass_fields__
    rest = {name: value for name, value in given.items() if name not in names}
    return TableFormat(**{name: value for name, value in given.items() if name in names}), rest


def filled(given: Mapping[str, Any], known: "Sequence[Column]") -> dict[str, Any]:
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


@dataclass(eq=False)
class Columns:
    """Columns that were found.

    name : of the table, for messages
    values : (rows,) by field, in SI
    units : of SI by field; None where the table states none
    headings : names in the table by field
    lines : (rows,) line of each row in the file; empty of a table in Python
    notes : names of the other columns, a line each
    """

    name: str
    values: dict[str, np.ndarray]
    units: dict[str, Unit | None]
    headings: dict[str, str]
    lines: Sequence[int]
    notes: tuple[str, ...] = ()

    def __contains__(self, name: str) -> bool:
        return name in self.values

    def __getitem__(self, name: str) -> np.ndarray:
        return self.values[name]

    def place(self, row: int) -> str:
        """Where a row stands, for messages."""
        return _place(self.name, self.lines, row)

    def refuse(self, name: str, wrong: np.ndarray, why: str) -> None:
        """Raise ValueError for the first row (rows,) in which a field is wrong."""
        if wrong.any():
            row = int(np.argmax(wrong))
            raise ValueError(f"{self.place(row)}: {name} = {self.values[name][row]:g} {why}")


@dataclass
class _Cells:
    """A table as it stands there: headings and units by column, cells (rows,) of text or numbers by column.

    si : whether columns without a unit are in SI
    comma : whether decimals have commas
    """

    name: str
    headings: list[str]
    units: list[str]
    cells: list[np.ndarray]
    lines: Sequence[int] = ()
    si: bool = True
    comma: bool = False


def read_columns(
    table: Any, known: Sequence[Column], stated: TableFormat | None = None, most_bytes: int = MOST_BYTES
) -> Columns:
    """The columns of a table that a reader knows.

    table : path of a text file, a DataFrame, a Dataset of xarray, or a mapping of arrays

    Raises ValueError for what is not in the documented form and not stated, see the module.
    """
    stated = stated or TableFormat()
    held = _of_file(Path(table), stated, most_bytes) if isinstance(table, str | Path) else _of_python(table)
    places = _places(held, known, stated)
    units = stated.units or {}
    written = {
        each: units.get(each.field) or held.units[places[each.field]] for each in known if each.field in places
    }
    held.si &= all(
        each.unit_needed or unit in (*_PURE, *(one.symbol for one in each.units)) for each, unit in written.items()
    )
    named = _select(held, places, known, stated)
    others = [heading for k, heading in enumerate(held.headings) if k not in named]
    notes = tuple(f"{held.name}: column {brief(repr(each))} is not used" for each in others)
    found = Columns(held.name, {}, {}, {}, held.lines, notes)
    for each in known:
        if each.field in places:
            place = places[each.field]
            found.headings[each.field] = held.headings[place]
            found.values[each.field], found.units[each.field] = _in_si(held, place, each, stated)
    return found


def read_rows(path: str | Path, stated: TableFormat, most_bytes: int) -> tuple[np.ndarray, Sequence[int]] | None:
    """Rows of numbers without a heading, NaN where a cell is empty or nan, and their lines; None of a heading.

    Where a separator ends each row, there is no cell behind it. Raises ValueError as `read_columns` does.
    """
    held = _of_file(Path(path), stated, most_bytes, headless=True)
    if held is None:
        return None
    if not any(held.cells[-1]):
        held.cells.pop()
    return np.stack([_numbers(held, k, True) for k in range(len(held.cells))], axis=1), held.lines


def _of_file(path, stated, most_bytes, headless=False):
    """Cells of a file; headless : None of one that has a heading."""
    name, lines = brief(str(path)), _text(path, stated, most_bytes).split("\n")
    while lines and not lines[-1].strip(" \t;,"):  # spreadsheets write separators below a table
        lines.pop()
    start = stated.skip or 0
    while start < len(lines) and (not lines[start].strip() or lines[start].lstrip().startswith("#")):
        start += 1
    if start >= len(lines):
        raise ValueError(f"{name}: there is no row in it")
    outside = re.sub('"[^"]*"', "", lines[start])
    separator = SEPARATORS.get(stated.separator or "", stated.separator) or next(
        (each for each in "\t;," if each in outside and each != stated.decimal), " "
    )
    headings = _split(lines[start], separator)
    units, body = [""] * len(headings), start + 1
    if headless:
        numbered = any(_COMMA_NUMBER.fullmatch(each.replace(".", ",")) for each in headings)
        if not numbered:
            return None
    else:
        numbered = any(isinstance(each, int) for each in (stated.columns or {}).values())
    if numbered:
        headings, body = [str(k + 1) for k in range(len(headings))], start
    elif any(_NUMBER.fullmatch(each.replace(",", ".")) for each in headings):
        raise ValueError(
            f"{name}, line {start + 1}: {brief(repr(lines[start]))} is no heading: write one, state skip, or "
            "state the columns by number, as columns = {field = 1}"
        )
    elif body < len(lines) and _are_units(below := _split(lines[body], separator), len(headings)):
        units, body = below, body + 1
    stop = len(lines) if stated.rows is None else min(body + stated.rows, len(lines))
    if stop == body:
        raise ValueError(f"{name}: there is no row below line {body}")
    cells = _rows(name, lines, (start, body, stop), separator, len(headings))
    comma = _has_commas(name, cells, separator) if stated.decimal is None else stated.decimal == ","
    return _Cells(name, headings, units, cells, range(body + 1, stop + 1), start == 0 and not numbered, comma)


def _text(path, stated, most_bytes):
    content = files.content(path, most_bytes)
    if kind := next((kind for mark, kind in _BINARY.items() if content.startswith(mark)), None):
        raise ValueError(f"{brief(str(path))} is {kind}; a table is a text file")
    encoding = stated.encoding or ("utf-16" if content[:2] in (b"\xff\xfe", b"\xfe\xff") else "utf-8-sig")
    try:
        return content.decode(encoding).replace("\r\n", "\n").replace("\r", "\n")
    except UnicodeDecodeError as error:
        line, byte = content[: error.start].count(b"\n") + 1, content[error.start]
        raise ValueError(
            f'{brief(str(path))}, line {line}: byte {byte:#04x} is not {encoding}: state encoding, as "cp1252"'
        ) from None
    except LookupError:
        raise ValueError(f'encoding = {encoding!r}: Python knows none of this name, as "cp1252"') from None


def _split(line, separator):
    if separator == " ":
        return [re.sub('^"(.*)"$', r"\1", each) for each in _BLANKS.split(line.strip())]
    return [each.strip() for each in next(csv.reader([line], delimiter=separator, skipinitialspace=True))]


def _rows(name, lines, places, separator, width):
    """Columns of cells between two lines. Raises ValueError for a row of another width."""
    start, body, stop = places
    try:
        frame = pd.read_csv(
            StringIO(f"{separator}{_END}\n".join([separator.join("0" * width), *lines[body:stop], ""])),
            sep=r"\s+" if separator == " " else separator,
            header=None,
            dtype=str,
            na_filter=False,
            skipinitialspace=True,
            on_bad_lines="error",
        )
        wrong = np.flatnonzero(frame[width].to_numpy(object) != _END) - 1
    except pd.errors.ParserError as error:
        counted = re.search(r"line (\d+)", str(error))
        frame, wrong = pd.DataFrame(), np.array([int(counted[1]) - 2] if counted else [])
    if not len(wrong) and len(frame) == stop - body + 1:
        return [frame[k][1:].str.strip().to_numpy(object) for k in range(width)]
    row = int(wrong[0]) if len(wrong) else next(k for k in range(stop - body) if lines[body + k].count('"') % 2)
    text, where = lines[body + row], f"{name}, line {body + row + 1}"
    if not text.strip():
        raise ValueError(f"{where} is blank, and there are rows below it: state rows = {row} to end before it")
    again = [k + 1 for k in range(body + row + 1, stop) if lines[k] == text and not text[:1].isdigit()]
    second = f"; line {again[0]} is another heading: state rows to end before it" if again else ""
    if not len(wrong):
        raise ValueError(f"{where}: {brief(repr(text))} has a quotation mark that opens, and none that closes it")
    count = len(text.split() if separator == " " else _split(text, separator))
    raise ValueError(
        f"{where}: {brief(repr(text))} has {count} cell{'s' * (count != 1)}, and line {start + 1}, "
        f"{brief(repr(lines[start]))}, has {width}: state skip for lines above the heading, rows for those below "
        f"the table, or separator{second}"
    )


def _has_commas(name, cells, separator):
    """Whether decimals have commas. Raises ValueError where they may be other marks, or some have points."""
    if separator not in "\t;":
        return False
    numbers = [cell for each in cells for cell in each if _COMMA_NUMBER.fullmatch(cell)]
    commas = [cell for cell in numbers if "," in cell]
    points = [cell for each in cells for cell in each if "." in cell and _NUMBER.fullmatch(cell)] if commas else []
    if points:
        raise ValueError(f"{name}: decimals have commas, {commas[0]!r}, and points, {points[0]!r}: state decimal")
    if commas and all(map(_THOUSANDS.fullmatch, commas)):
        raise ValueError(f"{name}: {commas[0]!r} may have decimals or thousands behind its comma: state decimal")
    return bool(commas)


def _of_python(table):
    if hasattr(table, "to_dataframe") and hasattr(table, "variables"):  # of xarray
        items = [(name, table[name]) for name in table.variables if table[name].ndim == 1]
    elif isinstance(table, Mapping) or (hasattr(table, "columns") and hasattr(table, "__getitem__")):
        items = [(name, table[name]) for name in getattr(table, "columns", table)]
    else:
        raise ValueError(
            f"{brief(repr(table))}: a path, a DataFrame, a Dataset of xarray or arrays by their names"
        )
    held = _Cells(type(table).__name__, [], [], [])
    for heading, given in items:
        values, unit = bare(given)
        array = np.asarray(values)
        if array.ndim != 1 or not array.size:
            raise ValueError(f"{held.name}, column {heading!r}: shape {array.shape}, and (rows,) is needed")
        held.headings.append(str(heading))
        held.units.append(unit or "")
        held.cells.append(
            array.astype(float) if array.dtype.kind in "fiu" else np.array(list(map(str, array)), object)
        )
    if len(lengths := {len(each) for each in held.cells}) != 1:
        raise ValueError(f"{held.name}: columns of {sorted(lengths)} rows, which must be equally many")
    return held


def _key(name):
    """A name as it is compared."""
    key = "".join(normalize("NFKC", normalize("NFKC", name).translate(_LETTERS)).split()).translate(_LETTERS)
    return key if len(key) == 1 else key.casefold()


def _places(held, known, stated):
    """Column by field; units of headings become those of the table."""
    names = {_key(name): each.field for each in known for name in (each.field, *each.names)}
    columns, units = stated.columns or {}, stated.units or {}
    if unknown := {*columns, *units} - {each.field for each in known}:
        raise ValueError(f"{min(unknown)!r} is none of the columns: {', '.join(each.field for each in known)}")
    whole = list(held.headings)
    for k, heading in enumerate(whole):
        found = None if _key(heading) in names else _WITH_UNIT.fullmatch(heading)
        unit = (found["a"] or found["b"] or "").strip() if found else ""
        if found and (held.units[k] in _PURE or _is_unit(unit)):
            if held.units[k] not in _PURE and not _same(unit, held.units[k]):
                raise ValueError(f"{held.name}: {heading!r} and {held.units[k]!r} are two units of one column")
            held.headings[k], held.units[k] = found["name"], unit
    places = {name: _called(held, whole, each) for name, each in columns.items()}
    for k, heading in enumerate(held.headings):
        name = names.get(_key(heading))
        if name is None or name in columns or k in places.values():
            continue
        if name in places:
            raise ValueError(
                f"{held.name}: {whole[places[name]]!r} and {whole[k]!r} are both {name}: state one, as columns = "
                f"{{{_toml(name)} = {_toml(whole[k], quoted=True)}}}"
            )
        places[name] = k
    for each in known:
        if each.field not in places and (each.needed or each.field in units):
            raise ValueError(
                f"{held.name}: there is no column {each.field} ({', '.join(each.names)}), but "
                f"{brief(', '.join(map(repr, whole)))}: state its heading, as columns = {{{_toml(each.field)} = "
                f"{_toml(whole[0], quoted=True)}}}, or skip for lines above the heading"
            )
    return places


def _called(held, whole, heading):
    """Column of a stated heading, with its unit or without, or of a number."""
    wanted = _key(str(heading))
    found = [k for names in (whole, held.headings) for k, each in enumerate(names) if _key(each) == wanted]
    if len(set(found)) != 1:
        many = "several columns are" if found else "no column is"
        raise ValueError(f"{held.name}: {many} called {heading!r}; there are {brief(', '.join(map(repr, whole)))}")
    return found[0]


def _select(held, places, known, stated):
    """Keep the rows that are stated, and return the columns that are used or stated.

    Raises ValueError for another one that tells rows apart.
    """
    kept, free = np.ones(len(held.cells[0]), bool), set(places.values())
    for heading, value in (stated.where or {}).items():
        place = _called(held, held.headings, heading)
        free.add(place)
        if value != "*":
            kept &= [_equal(str(cell), str(value)) for cell in held.cells[place]]
    if not kept.any():
        raise ValueError(f"{held.name}: no row has {brief(repr(dict(stated.where or {})))}")
    held.cells = [each[kept] for each in held.cells]
    held.lines = [line for line, each in zip(held.lines, kept, strict=True) if each] if held.lines else ()
    exempt = {_key(name) for name in (*REDUNDANT, *(name for each in known for name in each.names))}
    for k, (heading, cells) in enumerate(zip(held.headings, held.cells, strict=True)):
        values = list(dict.fromkeys(cells.tolist()))
        pure = len(values) == len(cells) and all(map(_NUMBER.fullmatch, map(str, values)))
        if k not in free and _key(heading) not in exempt and len(values) > 1 and not pure:
            key, value = _toml(heading), _toml(str(values[0]), quoted=True)
            first, second = map(repr, values[:2])
            raise ValueError(
                f"{held.name}: column {heading!r} has several values, {first} and {second}, and is not used: "
                f'state where = {{{key} = {value}}} for rows of one, where = {{{key} = "*"}} for all, or its '
                "quantity in columns"
            )

    return free


def _equal(cell, value):
    numbers = _NUMBER.fullmatch(cell) and _NUMBER.fullmatch(value)
    return float(cell) == float(value) if numbers else cell == value


def _in_si(held, place, column, stated):
    """Numbers of a column in SI, and the unit of SI; None where the table states none."""
    numbers, heading = _numbers(held, place, column.gaps), held.headings[place]
    unit, own = held.units[place], (stated.units or {}).get(column.field, "")
    unit = "" if unit in _PURE or (own and not _is_unit(unit)) else unit
    if unit in _PER_SECOND and RADIAN_PER_SECOND in column.units:
        unit = "" if HERTZ in column.units else "rad/s"  # 1/s of a frequency may be either
    if unit and own and not _same(unit, own):
        raise ValueError(
            f"{held.name}: column {heading!r} is in {unit!r}, and units states {own!r}: they must agree"
        )
    state = (
        f"state units = {{{_toml(column.field)} = {_toml(column.units[0].symbol if column.units else '', True)}}}"
    )
    if not (unit := unit or own):
        if column.unit_needed or (len(column.units) == 1 and not held.si):
            raise ValueError(f"{held.name}: column {heading!r} has no unit in the heading: {state}")
        return numbers, None
    reasons = []
    for each in column.units:
        try:
            return in_unit(numbers, unit, each.symbol, each.difference), each
        except ValueError as error:
            reasons.append(str(error))
    kinds = " or ".join(each.kind for each in column.units) or "a number without a unit"
    raise ValueError(
        f"{held.name}: column {heading!r} is in {unit!r}, and is {kinds} ({'; '.join(reasons)}): {state}"
    )


def _numbers(held, place, gaps):
    """Numbers of a column. Raises ValueError for a cell that is none."""
    cells = held.cells[place]
    if cells.dtype.kind == "f":
        wrong = ~np.isfinite(cells) & (~np.isnan(cells) | (not gaps))
        found = cells
    else:
        if gaps:
            cells = np.array(["" if each.casefold().strip("+-") == "nan" else each for each in cells], object)
        number = _COMMA_NUMBER if held.comma else _NUMBER
        wrong = np.array([not (number.fullmatch(each) or (gaps and not each)) for each in cells])
        found = np.nan
        if not wrong.any():
            found = np.array([float(each.replace(",", ".") or "nan") for each in cells])
            wrong = np.isinf(found)
    if wrong.any():
        row = int(np.argmax(wrong))
        cell = brief(repr(cells.tolist()[row]))
        raise ValueError(
            f"{_place(held.name, held.lines, row)}, column {held.headings[place]!r}: {cell} is "
            "no number: state rows to end before it, where to leave it out, decimal, or separator"
        )
    return found


def _place(name, lines, row):
    return f"{name}, line {lines[row]}" if lines else f"{name}, row {row + 1}"


def _are_units(cells, width):
    """Whether a row is one of units."""
    for k, cell in enumerate(cells):
        cells[k] = cell[1:-1].strip() if cell[:1] + cell[-1:] in ("[]", "()") else cell
    return (
        len(cells) == width
        and any(map(_is_unit, cells))
        and all(each in ("", "-", "1", "%") or _is_unit(each) for each in cells)
    )


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
    return name if not quoted and re.fullmatch(r"[\w-]+", name, re.ASCII) else dumps(name, ensure_ascii=False)
