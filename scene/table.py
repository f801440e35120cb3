"""Measured storage and loss moduli, in Python or in a text file."""

import re
from collections.abc import Sequence
from math import isfinite
from pathlib import Path
from typing import Annotated

from pydantic import model_validator
from pydantic.dataclasses import dataclass

from . import files
from .printable import brief
from .quantities import CLOSED, ROW, Positive, Pressure, UnitOfOthers

COLUMNS = ("frequency", "storage", "loss")
MOST_ROWS = 5_000
_LEAST_FREQUENCIES, _WIDEST = 4, 1e40
MOST = 20_000_000  # bytes of a file
_SEPARATOR = re.compile(r"\s*[,;\t]\s*|\s+")
# Of a heading: a unit in brackets, as in "F_N [mN]", stays with its name, and only commas and the like part words.
_MARKS, _BLANKS = re.compile(r"\s*[,;\t]\s*"), re.compile(r"\s+(?![\[(])(?![^\[(]*[\])])")
_NUMBER = re.compile(r"[+-]?(?:(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:e[+-]?[0-9]+)?|nan|inf(?:inity)?)", re.IGNORECASE)
Frequencies = Annotated[tuple[Annotated[Positive, UnitOfOthers("frequency_unit")], ...], ROW]
Moduli = Annotated[tuple[Pressure, ...], ROW]


@dataclass(frozen=True, config=CLOSED, repr=False)
class Table:
    """Measured moduli: frequency, storage and loss modulus, equally many, all > 0; at least 4 frequencies.

    At most 5,000 rows, over 40 decades of the frequency.

    In any order; a frequency may stand there more than once, and then each of its rows counts.
    """

    frequency: Frequencies
    storage: Moduli
    loss: Moduli

    @model_validator(mode="after")
    def _rows(self):
        lengths = [len(getattr(self, name)) for name in COLUMNS]
        if len(set(lengths)) > 1:
            raise ValueError(f"frequency, storage and loss have {lengths} values: they must be equally many")
        if lengths[0] > MOST_ROWS:
            raise ValueError(f"{lengths[0]:,} rows: at most {MOST_ROWS:,} are fitted")
        if max(self.frequency, default=0.0) > _WIDEST * min(self.frequency, default=0.0):
            raise ValueError(f"frequencies lie farther apart than by a factor of {_WIDEST:g}")
        if len(set(self.frequency)) < _LEAST_FREQUENCIES:
            raise ValueError(f"{len(set(self.frequency))} frequencies: at least {_LEAST_FREQUENCIES} are needed")
        return self

    def __repr__(self):
        return f"Table({len(self.frequency)} rows from {min(self.frequency):g} to {max(self.frequency):g})"


def read_table(path: str | Path) -> Table:
    """A table from a text or CSV file: a row of frequency, storage and loss modulus a line.

    Cells are separated by commas, semicolons, tabs or blanks, with decimal points. Lines without a number before
    the first row, empty lines, and what follows a # are skipped. Raises ValueError naming file and line.
    """
    return Table(**columns(path))


def columns(path: str | Path) -> dict[str, tuple[float, ...]]:
    """The columns of such a file by their names, not yet checked as a whole."""
    _, rows = read_rows(path, COLUMNS, MOST_ROWS)
    return dict(zip(COLUMNS, zip(*rows, strict=True) if rows else ((), (), ()), strict=True))


def read_rows(path: str | Path, names: Sequence[str], most: int) -> tuple[list[str], list[tuple[float, ...]]]:
    """The cells of the heading, if there is one, and the rows of such a file, a number > 0 for each name.

    most : rows that are read. Raises ValueError naming file and line, also of more of them.
    """
    text = files.text(path, MOST)
    heading: list[str] = []
    rows: list[tuple[float, ...]] = []
    for number, line in enumerate(text.split("\n"), start=1):
        line = line.partition("#")[0].strip()
        cells, named = _SEPARATOR.split(line), (_MARKS if _MARKS.search(line) else _BLANKS).split(line)
        if cells == [""]:
            continue
        if not rows and not any(_is_number(cell) for cell in (cells[0], *named)):
            heading = named
        else:
            if len(rows) == most:
                raise ValueError(f"{brief(str(path))}: at least {most + 1:,} rows: at most {most:,} are read")
            rows.append(_row(cells, names, f"{brief(str(path))}, line {number}"))
    return heading, rows


def _is_number(cell):
    return _NUMBER.fullmatch(cell) is not None


def _row(cells, names, where):
    if len(cells) != len(names):
        needed = ", ".join(names[:-1]) + f" and {names[-1]}"
        hint = "; commas separate columns, numbers have decimal points" if len(cells) > len(names) else ""
        raise ValueError(f"{where}: {len(cells)} columns; {needed} are needed, and no others{hint}")
    for name, cell in zip(names, cells, strict=True):
        if not _is_number(cell):
            raise ValueError(f"{where}: {name} = {brief(repr(cell))} is not a number")
        if not (isfinite(float(cell)) and float(cell) > 0):
            raise ValueError(f"{where}: {name} = {brief(cell)} must be finite and greater than 0")
    return tuple(float(cell) for cell in cells)
