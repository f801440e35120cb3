"""Tables in text files: what a user states of them, and their cells, in rows of as many cells as the heading."""

import csv
import re
from collections.abc import Mapping
from dataclasses import InitVar
from dataclasses import dataclass as plain
from io import StringIO
from math import inf, nan
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
import pandas as pd
from pydantic import Field
from pydantic.dataclasses import dataclass

from ..printable import brief
from ..quantities import CLOSED
from ..units import is_unit
from . import files

SEPARATORS = {"tab": "\t", "semicolon": ";", "comma": ",", "blanks": " "}
BINARY = {b"PK\3\4": "a workbook (.xlsx)", **dict.fromkeys((b"\x89PNG", b"II*\0", b"MM\0*"), "a picture")}
PURE = "", "-", "1"  # units of pure numbers
_END = "\3"  # a last cell of each row, which is elsewhere if there are too few
_NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?", re.ASCII)
_THOUSANDS = re.compile(r"[+-]?[1-9]\d{0,2}(?:,\d{3})+")
_BLANKS = re.compile(r"\s+(?![\[(])(?![^\[(]*[\])])")  # not before a unit in brackets, nor within one
_Lines = Annotated[int, Field(strict=True, ge=0)]


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class TableFormat:
    """Form of a table where it differs from the documented one, as a user states it.

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


@dataclass(frozen=True, config=CLOSED, kw_only=True)
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
    """Form of the table and the other fields, out of those that are stated for a part of a scene."""
    names = TableFormat.__dataclass_fields__
    rest = {name: value for name, value in given.items() if name not in names}
    return TableFormat(**{name: value for name, value in given.items() if name in names}), rest


@plain(eq=False)
class Cells:
    """A table as it stands there: text or numbers, by line or row; units, "" where there is none.

    first, comma : whether nothing stands above the heading, and whether decimals have commas
    """

    name: str
    frame: pd.DataFrame
    headings: list[str]
    units: list[str]
    first: bool = True
    comma: bool = False

    def place(self, row: int) -> str:
        """Where a row stands, for messages."""
        return f"{self.name}, {self.frame.index.name} {self.frame.index[row]}"

    def numbers(self, column: int) -> np.ndarray:
        """Numbers of a column (rows,): infinite where there is none, NaN where a cell is empty or nan."""
        cells = self.frame[column]
        if cells.dtype.kind == "f":
            return cells.to_numpy()
        return np.array([self._number(each) for each in cells])

    def _number(self, cell):
        text = cell.translate({44: ".", 46: ","}) if self.comma else cell  # comma and point
        return float(text) if _NUMBER.fullmatch(text) else nan if text.casefold() in ("", "nan", "-nan") else inf

    def finite(self, column: int, gaps: bool = False) -> np.ndarray:
        """Numbers of a column. Raises ValueError for a cell that is none; gaps : but not for nan or nothing."""
        found, cells = self.numbers(column), self.frame[column]
        wrong = ~(np.isfinite(found) | (gaps & np.isnan(found)))
        if wrong.any():
            row = int(np.argmax(wrong))
            raise ValueError(
                f"{self.place(row)}, column {shown(self.headings[column])}: {shown(cells.tolist()[row])} "
                "is no number: state rows to end before it, where to leave it out, decimal, or separator"
            )
        return found


def shown(text: object) -> str:
    """A text of a table in a message, or in TOML: in quotes, its middle left out where it is long."""
    return brief(repr(text), 80)


def read_text(path: str | Path, stated: TableFormat, most_bytes: int) -> Cells:
    """Cells of a file with a heading, or without one where columns are stated by number. Raises ValueError."""
    name, lines, start, separator = _lines(path, stated, most_bytes)
    headings = _split(lines[start], separator)
    numbered = any(isinstance(each, int) for each in (stated.columns or {}).values())
    if not numbered and _has_number(headings):
        raise ValueError(
            f"{name}, line {start + 1}: {shown(lines[start])} is no heading: write one, state skip, or "
            "state the columns by number, as columns = {field = 1}"
        )
    units = [each.strip("[]()") for line in lines[start + 1 : start + 2] for each in _split(line, separator)]
    if numbered or len(units) != len(headings) or not any(map(is_unit, units)) or _has_number(units):
        units = []
    body = start + (not numbered) + bool(units)
    frame, comma = _frame(name, lines, (start, body), separator, len(headings), stated)
    headings = [str(k + 1) for k in frame] if numbered else headings
    return Cells(name, frame, headings, units or [""] * len(headings), start == 0 and not numbered, comma)


def read_rows(path: str | Path, stated: TableFormat, most_bytes: int) -> tuple[np.ndarray, int] | None:
    """Rows of numbers, NaN of an empty cell or nan, and their first line; None of a heading. Raises ValueError."""
    name, lines, start, separator = _lines(path, stated, most_bytes)
    first = _split(lines[start], separator)
    if not _has_number(first):
        return None
    frame, comma = _frame(name, lines, (start, start), separator, len(first), stated)
    # Where a separator ends each row, there is no cell behind it.
    width = len(first) - (not frame[len(first) - 1].any())
    cells = Cells(name, frame, [str(k + 1) for k in frame], [], comma=comma)
    return np.stack([cells.finite(k, gaps=True) for k in range(width)], axis=1), start + 1


def _lines(path, stated, most_bytes):
    """Name of a file, its lines, the place of the first that is read, and its separator."""
    name, content = brief(str(path)), files.content(path, most_bytes)
    if kind := next((kind for mark, kind in BINARY.items() if content.startswith(mark)), None):
        raise ValueError(f"{name} is {kind}; a table is a text file")
    encoding = stated.encoding or ("utf-16" if content[:2] in (b"\xff\xfe", b"\xfe\xff") else "utf-8-sig")
    try:
        lines = content.decode(encoding).replace("\r\n", "\n").replace("\r", "\n").split("\n")
    except (ValueError, LookupError) as error:
        line = content[: getattr(error, "start", 0)].count(b"\n") + 1
        raise ValueError(f'{name}, line {line}: {brief(str(error))}: state encoding, as "cp1252"') from None
    while lines and not lines[-1].strip(" \t;,"):  # spreadsheets write separators below a table
        lines.pop()
    start = stated.skip or 0
    while start < len(lines) and (not lines[start].strip() or lines[start].lstrip().startswith("#")):
        start += 1
    if start >= len(lines):
        raise ValueError(f"{name}: there is no row in it")
    outside = re.sub('"[^"]*"', "", lines[start])
    own = next((each for each in "\t;," if each in outside and each != stated.decimal), " ")
    return name, lines, start, SEPARATORS.get(stated.separator, stated.separator) or own


def _split(line, separator):
    if separator == " ":
        return _BLANKS.split(line.strip())
    return [each.strip() for each in next(csv.reader([line], delimiter=separator, skipinitialspace=True), [])]


def _has_number(cells):
    return any(_NUMBER.fullmatch(each.replace(",", ".")) for each in cells)


def _frame(name, lines, places, separator, width, stated):
    """Text of the cells, and whether decimals have commas. Raises ValueError, also for a row of another width.

    places : of the line that has the width, and of the first row
    """
    start, body = places
    rows = lines[body:] if stated.rows is None else lines[body : body + stated.rows]
    if not rows:
        raise ValueError(f"{name}: there is no row below line {body}")
    frame, wrong, sep = pd.DataFrame(), [], r"\s+" if separator == " " else separator
    text = StringIO(f"{separator}{_END}\n".join([separator.join("0" * width), *rows, ""]))
    try:
        frame = pd.read_csv(
            text, sep=sep, header=None, dtype=str, na_filter=False, skipinitialspace=True, on_bad_lines="error"
        )[1:]
        wrong = np.flatnonzero(frame[width] != _END)
    except pd.errors.ParserError as error:
        wrong = [int(each) - 2 for each in re.findall(r"line (\d+)", str(error))]
    if len(wrong) or len(frame) != len(rows):  # an open quotation mark joins rows
        row = body + int(next(iter(wrong), next((k for k, each in enumerate(rows) if '"' in each), 0)))
        raise ValueError(
            f"{name}, line {row + 1}: {shown(lines[row])} has not the {width} cells of line {start + 1}, "
            f"{shown(lines[start])}: state skip for lines above the heading, rows to end before this "
            "one, or separator"
        )
    frame = frame.drop(columns=width).map(str.strip)
    frame.index = pd.RangeIndex(body + 1, body + len(rows) + 1, name="line")
    pointed = any("." in each for each in frame.to_numpy().flat)
    if separator == "," and start == body and stated.decimal != "." and not pointed:
        raise ValueError(
            f"{name}: commas may stand between whole numbers or be those of decimals: state decimal, and separator"
        )
    if stated.decimal is not None or separator not in "\t;":
        return frame, stated.decimal == ","
    numbers = [each for each in frame.to_numpy().flat if _NUMBER.fullmatch(each.replace(",", ".", 1))]
    commas, points = ([each for each in numbers if mark in each] for mark in ",.")
    if commas and (points or all(map(_THOUSANDS.fullmatch, commas))):
        also = f", and {shown(points[0])} has a point" if points else ""
        raise ValueError(
            f"{name}: {shown(commas[0])} may have decimals or thousands behind its comma{also}: state decimal"
        )
    return frame, bool(commas)
