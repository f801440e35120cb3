"""Cells of a table as they stand in a text file: by separators, in rows of as many cells as the heading."""

import csv
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from io import StringIO
from math import inf, nan
from pathlib import Path

import numpy as np
import pandas as pd

from . import files
from .printable import brief
from .tableformat import SEPARATORS, TableFormat

BINARY = {
    b"PK\3\4": "a zip archive, as workbooks (.xlsx) are: save the sheet as CSV",
    b"\x89PNG": "a picture (.png)",
    b"II*\0": "a picture (.tif)",
    b"MM\0*": "a picture (.tif)",
}
_END = "\3"  # a last cell of each row, which is elsewhere if there are too few
NUMBER, _COMMA_NUMBER = (
    re.compile(rf"[+-]?(?:\d+{mark}?\d*|{mark}\d+)(?:[eE][+-]?\d+)?", re.ASCII) for mark in (r"\.", ",")
)
_THOUSANDS = re.compile(r"[+-]?[1-9]\d{0,2}(?:,\d{3})+")
_BLANKS = re.compile(r"\s+(?![\[(])(?![^\[(]*[\])])")  # not before a unit in brackets, nor within one


def shown(text: object) -> str:
    """A text of a table in a message: in quotes, its middle left out where it is long."""
    return brief(repr(text), 80)


@dataclass(eq=False)
class Cells:
    """A table as it stands there.

    headings, units : of the columns as they are written; "" where there is none
    columns : of cells (rows,), text or numbers
    lines : (rows,) line of each row in the file; empty of a table in Python
    first : whether nothing stands above the heading
    comma : whether decimals have commas
    """

    name: str
    headings: list[str]
    units: list[str]
    columns: list[np.ndarray]
    lines: Sequence[int] = ()
    first: bool = True
    comma: bool = False

    def place(self, row: int) -> str:
        """Where a row stands, for messages."""
        return f"{self.name}, line {self.lines[row]}" if self.lines else f"{self.name}, row {row + 1}"

    def numbers(self, column: int, gaps: bool = False) -> np.ndarray:
        """Numbers of a column. Raises ValueError for a cell that is none; gaps : but not for nan or nothing."""
        cells = self.columns[column]
        found = cells
        if cells.dtype.kind != "f":
            number, none = _COMMA_NUMBER if self.comma else NUMBER, ("", "nan", "-nan") if gaps else ()
            found = np.array(
                [
                    float(each.replace(",", "."))
                    if number.fullmatch(each)
                    else nan
                    if each.casefold() in none
                    else inf
                    for each in cells
                ]
            )
        wrong = ~(np.isfinite(found) | (gaps & np.isnan(found)))
        if wrong.any():
            row = int(np.argmax(wrong))
            raise ValueError(
                f"{self.place(row)}, column {shown(self.headings[column])}: {shown(cells.tolist()[row])} is no "
                "number: state rows to end before it, where to leave it out, decimal, or separator"
            )
        return found


def read_text(path: Path, stated: TableFormat, most_bytes: int, units_below: Callable[[list[str]], bool]) -> Cells:
    """Cells of a file with a heading, or without one where columns are stated by number.

    units_below : whether cells below the heading are units

    Raises ValueError for what is not in the documented form and not stated.
    """
    name, lines, start = _lines(path, stated, most_bytes)
    separator = _separator(lines[start], stated)
    headings = _split(lines[start], separator)
    units, body = [""] * len(headings), start + 1
    if numbered := any(isinstance(each, int) for each in (stated.columns or {}).values()):
        headings, body = [str(k + 1) for k in range(len(headings))], start
    elif _has_number(headings):
        raise ValueError(
            f"{name}, line {start + 1}: {shown(lines[start])} is no heading: write one, state skip, or "
            "state the columns by number, as columns = {field = 1}"
        )
    elif body < len(lines):
        below = [
            each[1:-1].strip() if each[:1] + each[-1:] in ("[]", "()") else each
            for each in _split(lines[body], separator)
        ]
        if len(below) == len(headings) and not _has_number(below) and units_below(below):
            units, body = below, body + 1
    columns, lines_read = _rows(name, lines, (start, body), separator, len(headings), stated.rows)
    comma = _has_commas(name, columns, separator, stated, numbered)
    return Cells(name, headings, units, columns, lines_read, start == 0 and not numbered, comma)


def read_rows(path: str | Path, stated: TableFormat, most_bytes: int) -> tuple[np.ndarray, Sequence[int]] | None:
    """Rows of numbers without a heading, NaN where a cell is empty or nan, and their lines; None of a heading.

    Where a separator ends each row, there is no cell behind it. Raises ValueError as `read_text` does.
    """
    name, lines, start = _lines(Path(path), stated, most_bytes)
    separator = _separator(lines[start], stated)
    first = _split(lines[start], separator)
    if not _has_number(first):
        return None
    columns, lines_read = _rows(name, lines, (start, start), separator, len(first), stated.rows)
    columns = columns if any(columns[-1]) else columns[:-1]
    names = [str(k + 1) for k, _ in enumerate(columns)]
    comma = _has_commas(name, columns, separator, stated, True)
    cells = Cells(name, names, names, columns, lines_read, comma=comma)
    return np.stack([cells.numbers(k, gaps=True) for k, _ in enumerate(names)], axis=1), lines_read


def _lines(path, stated, most_bytes):
    """Name of a file, its lines, and the place of the first that is read."""
    name, content = brief(str(path)), files.content(path, most_bytes)
    if kind := next((kind for mark, kind in BINARY.items() if content.startswith(mark)), None):
        raise ValueError(f"{name} is {kind}; a table is a text file")
    encoding = stated.encoding or ("utf-16" if content[:2] in (b"\xff\xfe", b"\xfe\xff") else "utf-8-sig")
    try:
        lines = content.decode(encoding).replace("\r\n", "\n").replace("\r", "\n").split("\n")
    except UnicodeDecodeError as error:
        line, byte = content[: error.start].count(b"\n") + 1, content[error.start]
        raise ValueError(
            f"{name}, line {line}: byte {byte:#04x} is not {encoding.removesuffix('-sig')}: state encoding, as "
            '"cp1252"'
        ) from None
    except LookupError:
        raise ValueError(f'encoding = {shown(encoding)}: Python knows none of this name, as "cp1252"') from None
    while lines and not lines[-1].strip(" \t;,"):  # spreadsheets write separators below a table
        lines.pop()
    start = stated.skip or 0
    while start < len(lines) and (not lines[start].strip() or lines[start].lstrip().startswith("#")):
        start += 1
    if start >= len(lines):
        raise ValueError(f"{name}: there is no row in it")
    return name, lines, start


def _separator(line, stated):
    outside = re.sub('"[^"]*"', "", line)
    own = next((each for each in "\t;," if each in outside and each != stated.decimal), " ")
    return SEPARATORS.get(stated.separator, stated.separator) or own


def _has_number(cells):
    return any(_COMMA_NUMBER.fullmatch(each.replace(".", ",")) for each in cells)


def _split(line, separator):
    if separator == " ":
        return [re.sub('^"(.*)"$', r"\1", each) for each in _BLANKS.split(line.strip())]
    return [each.strip() for each in next(csv.reader([line], delimiter=separator, skipinitialspace=True))]


def _rows(name, lines, places, separator, width, most):
    """Columns of cells from a line on, and their lines. Raises ValueError for a row of another width."""
    start, body = places
    stop = len(lines) if most is None else min(body + most, len(lines))
    if stop == body:
        raise ValueError(f"{name}: there is no row below line {body}")
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
        columns = [frame[k][1:].str.strip().to_numpy(object) for k in range(width)]
        return columns, range(body + 1, stop + 1)
    row = int(wrong[0]) if len(wrong) else next(k for k in range(stop - body) if lines[body + k].count('"') % 2)
    text, where = lines[body + row], f"{name}, line {body + row + 1}"
    if not text.strip():
        raise ValueError(f"{where} is blank, and there are rows below it: state rows = {row} to end before it")
    if not len(wrong):
        raise ValueError(f"{where}: {shown(text)} has a quotation mark that opens, and none that closes it")
    again = [k + 1 for k in range(body + row + 1, stop) if lines[k] == text and not text[:1].isdigit()]
    second = f"; line {again[0]} is another heading: state rows to end before it" if again else ""
    count = len(text.split() if separator == " " else _split(text, separator))
    raise ValueError(
        f"{where}: {shown(text)} has {count} cell{'s' * (count != 1)}, and line {start + 1}, "
        f"{shown(lines[start])}, has {width}: state skip for lines above the heading, rows for those below "
        f"the table, or separator{second}"
    )


def _has_commas(name, columns, separator, stated, counted):
    """Whether decimals have commas. Raises ValueError where they may be other marks, or some have points.

    counted : whether no heading says how many columns there are, so that commas of decimals may make more of them
    """
    cells = [cell for column in columns for cell in column]
    if separator == "," and counted and stated.decimal != "." and not any("." in cell for cell in cells):
        raise ValueError(
            f"{name}: commas may stand between whole numbers or be those of decimals: state decimal, and separator"
        )
    if stated.decimal is not None or separator not in "\t;":
        return stated.decimal == ","
    commas = [cell for cell in cells if "," in cell and _COMMA_NUMBER.fullmatch(cell)]
    points = [cell for cell in cells if "." in cell and NUMBER.fullmatch(cell)] if commas else []
    if points:
        raise ValueError(
            f"{name}: decimals have commas, {shown(commas[0])}, and points, {shown(points[0])}: state decimal"
        )
    if commas and all(map(_THOUSANDS.fullmatch, commas)):
        raise ValueError(
            f"{name}: {shown(commas[0])} may have decimals or thousands behind its comma: state decimal"
        )
    return bool(commas)
