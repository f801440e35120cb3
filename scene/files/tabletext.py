"""Cells of tables in text files, in rows of as many cells as the heading."""

import csv
import re
from dataclasses import dataclass
from math import inf, nan
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..numeric_input import is_unit
from ..printable import brief, shown
from . import files
from .stated import TableFormat

if TYPE_CHECKING:
    from pandas import DataFrame

SEPARATORS = {"tab": "\t", "semicolon": ";", "comma": ",", "blanks": " "}
PURE = "", "-", "1"  # units of pure numbers
_NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?", re.ASCII)
_THOUSANDS = re.compile(r"[+-]?[1-9]\d{0,2}(?:[.,]\d{3})+")
_BLANKS = re.compile(r"\s+(?![\[(])(?![^\[(]*[\])])")  # not before a unit in brackets, nor within one


@dataclass(eq=False)
class Cells:
    """A table as it stands there: text or numbers, by line or row; units, "" where there is none.

    first, comma : whether nothing stands above the heading, and whether decimals have commas
    """

    name: str
    frame: "DataFrame"
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
        return cells.to_numpy() if cells.dtype.kind == "f" else np.array([*map(self._number, cells)])

    def _number(self, cell):
        text = cell.translate({44: ".", 46: ","}) if self.comma else cell  # comma and point
        return float(text) if _NUMBER.fullmatch(text) else nan if text.casefold() in ("", "nan", "-nan") else inf

    def finite(self, column: int, gaps: bool = False) -> np.ndarray:
        """Numbers of a column. Raises ValueError for a cell that is none; gaps : but not for nan or nothing."""
        found, cells = self.numbers(column), self.frame[column]
        wrong = ~(np.isfinite(found) | (gaps & np.isnan(found)))
        for row in np.flatnonzero(wrong)[:1]:
            raise ValueError(
                f"{self.place(row)}, column {shown(self.headings[column])}: {shown(cells.tolist()[row])} "
                "is no number: state rows to end before it, where to leave it out, decimal, or separator"
            )
        return found


def read_text(path: str | Path, stated: TableFormat, most_bytes: int, rectangle: bool = False) -> Cells | None:
    """Cells of a file with a heading, or without one where columns are stated by number. Raises ValueError.

    rectangle : of numbers alone; None where there is a heading
    """
    name, lines, start, separator = _lines(path, stated, most_bytes)
    headings, *below = (_split(line, separator) for line in lines[start : start + 2])
    numbered = rectangle or any(isinstance(each, int) for each in (stated.columns or {}).values())
    if rectangle and not _has_number(headings):
        return None
    if not numbered and _has_number(headings):
        raise ValueError(
            f"{name}, line {start + 1}: {shown(lines[start])} is no heading: write one, state skip, or "
            "state the columns by number, as columns = {field = 1}"
        )
    units = [cell.strip("[]()") for row in below for cell in row if not numbered]
    if len(units) != len(headings) or not any(map(is_unit, units)) or _has_number(units):
        units = []
    frame, comma = _frame(name, lines, (start, start + (not numbered) + bool(units)), separator, stated)
    headings, units = ([str(k + 1) for k in frame] if numbered else headings), units or [""] * len(headings)
    return Cells(name, frame, headings, units, start == 0 and not numbered, comma)


def _lines(path, stated, most_bytes):
    """Name of a file, its lines, the place of the first that is read, and its separator."""
    name, content = brief(str(path)), files.content(path, most_bytes)
    encoding = stated.encoding or ("utf-16" if content[:2] in (b"\xff\xfe", b"\xfe\xff") else "utf-8-sig")
    try:
        lines = content.decode(encoding).replace("\r\n", "\n").replace("\r", "\n").split("\n")
    except (ValueError, LookupError) as error:
        line = content[: getattr(error, "start", 0)].count(b"\n") + 1
        raise ValueError(f'{name}, line {line}: {brief(str(error))}: state encoding, as "cp1252"') from None
    while lines and not lines[-1].strip(" \t;,"):  # spreadsheets write separators below a table
        lines.pop()
    below = (k for k, line in enumerate(lines) if k >= (stated.skip or 0) and line.strip()[:1] not in ("", "#"))
    if (start := next(below, None)) is None:
        raise ValueError(f"{name}: there is no row in it")
    unquoted = re.sub('"[^"]*"', "", lines[start]).replace(stated.decimal or " ", " ")
    own = next((each for each in "\t;," if each in unquoted), " ")
    return name, lines, start, SEPARATORS.get(stated.separator, stated.separator) or own


def _split(line, separator):
    if separator == " ":
        return _BLANKS.split(line.strip())
    return [each.strip() for each in next(csv.reader([line], delimiter=separator, skipinitialspace=True), [])]


def _has_number(cells):
    return any(_NUMBER.fullmatch(each.replace(",", ".")) for each in cells)


def _frame(name, lines, places, separator, stated):
    """Text of the cells, and whether decimals have commas. Raises ValueError, also for a row of another width.

    places : of the line that has the width, and of the first row
    """
    (start, body), end = places, None if stated.rows is None else places[1] + stated.rows
    width, rows = len(_split(lines[start], separator)), [_split(line, separator) for line in lines[body:end]]
    if not rows:
        raise ValueError(f"{name}: there is no row below line {body}")
    for line, row in enumerate(rows, body):
        if len(row) != width:
            raise ValueError(
                f"{name}, line {line + 1}: {shown(lines[line])} has not the {width} cells of line {start + 1}, "
                f"{shown(lines[start])}: state skip for lines above the heading, rows to end before this "
                "one, or separator"
            )
    from pandas import DataFrame, RangeIndex

    frame = DataFrame(rows, RangeIndex(body + 1, body + len(rows) + 1, name="line"), dtype=object)
    numbers = [each for row in rows for each in row if _NUMBER.fullmatch(each.replace(",", ".", 1))]
    commas, points = ([each for each in numbers if mark in each] for mark in ",.")
    unclear = start == body and len(points) < len(numbers) and all(map(_THOUSANDS.fullmatch, points))
    if separator == "," and (stated.decimal == "," or (unclear and stated.decimal is None)):
        raise ValueError(f"{name}: commas may stand between numbers or in decimals: state decimal, and separator")
    if stated.decimal is not None or separator not in "\t;":
        return frame, stated.decimal == ","
    if commas and (points or all(map(_THOUSANDS.fullmatch, commas))):
        raise ValueError(f"{name}: {shown(commas[0])} may have decimals or thousands: state decimal")
    return frame, bool(commas)
