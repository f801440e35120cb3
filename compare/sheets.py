"""Data inside a page: a table of a file that lies beside it, with every digit, and the file itself to download."""

import csv
import io
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from math import isnan, nan
from pathlib import Path
from urllib.parse import quote

from .glossary import of_column

# A longer table is no reading: it is in the page as a file alone.
MOST_ROWS = 400
# Need no escape within a data URI.
PLAIN = " ,;:/()[]{}=+*@!'~?|^$&"


@dataclass(frozen=True)
class Cell:
    """One entry: as it is read, and what it is sorted by, which is a number or the text itself."""

    shown: str
    value: str
    numeric: bool

    @classmethod
    def of(cls, text: str) -> "Cell":
        """From the text of a file."""
        number = _number(text)
        if number is None:
            return cls(text, text, False)
        return cls("–" if isnan(number) else text if text.lstrip("-").isdigit() else f"{number:.6g}", text, True)


@dataclass(frozen=True)
class Sheet:
    """One table of data.

    anchor : on the page; row k, from 1, has anchor.k
    title : for people
    file : its path from the folder of the page
    text : of that file, CSV
    """

    anchor: str
    title: str
    file: str
    text: str

    @classmethod
    def read(cls, root: Path, path: Path, title: str) -> "Sheet":
        """Of a file as it was written below the folder of a page; a title and a file, each once on the page."""
        file = path.relative_to(root).as_posix()
        return cls(anchored("data", file.removesuffix(".csv")), title, file, path.read_text(encoding="utf-8"))

    @property
    def name(self) -> str:
        """Of the file alone."""
        return self.file.rsplit("/", 1)[-1]

    @property
    def columns(self) -> list[str]:
        return next(csv.reader(io.StringIO(self.text)), [])

    @property
    def rows(self) -> Iterator[list[Cell]]:
        lines = csv.reader(io.StringIO(self.text))
        next(lines, None)
        return ([Cell.of(text) for text in line] for line in lines)

    @property
    def count(self) -> int:
        """Of rows."""
        return sum(1 for _ in self.rows)

    @property
    def readable(self) -> bool:
        """Whether it is short enough to be shown as a table."""
        return self.count <= MOST_ROWS

    @property
    def download(self) -> str:
        """The file as a data URI."""
        return f"data:text/csv;charset=utf-8,{quote(self.text, safe=PLAIN)}"

    def row(self, number: int) -> str:
        """Anchor of a row, from 1; that of the table if it is not shown."""
        return f"{self.anchor}.{number}" if self.readable else self.anchor


def headed(column: str) -> str:
    """A column's name in words with its unit."""
    term = of_column(column)
    return f"{column.replace('_', ' ')} [{term.unit}]" if term and term.unit else column.replace("_", " ")


def runs(rows: Iterable[int]) -> list[tuple[int, int]]:
    """First and last of what follows one another without a gap."""
    found: list[tuple[int, int]] = []
    for row in sorted(rows):
        if found and row == found[-1][1] + 1:
            found[-1] = (found[-1][0], row)
        else:
            found.append((row, row))
    return found


def reading() -> dict[str, Callable]:
    """What templates need to show sheets."""
    return {"headed": headed, "runs": runs}


def anchored(*parts: str) -> str:
    """Parts as one anchor: a fragment that needs no escape and begins with a letter."""
    return "-".join("".join(c if c.isascii() and c.isalnum() else "-" for c in part) for part in parts if part)


def _number(text: str) -> float | None:
    """What sorts by value; NaN of nan and of nothing, None of text."""
    if text in ("", "nan"):
        return nan
    try:
        return float(text)
    except ValueError:
        return None
