"""Dialect of a text file of numbers: the one separator of its cells, and the mark of its decimals."""

import csv
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from math import nan

NUMBER, EMPTY, WORD, BAD = "NEWB"  # kinds of cells; bad is what begins as a number and is none
BLANK = " "
# In the order in which a separator that stands in every row excludes those after it.
STRONG = "\t;|"
_COMMENT = re.compile(r"\s*(?:#|%|//|!)+\s?")
_NOT_MEASURED = re.compile(
    r"[+-]?(?:nan(?:\(s?n?(?:an|ind)\))?|na|n/a|n\.a\.|null|none|bad|no ?data|missing|masked|invalid|void|-+"
    r"|\*+)?",
    re.IGNORECASE,
)
# Marks of spreadsheets and of old compilers for what is no number; a # in them begins no comment.
_SPREADSHEET = re.compile(
    r"(?<![^\s,;|\t\"])(?:#N/?A|#NV|#NULL!|#DIV/0!|#VALUE!|[+-]?1[.,]#(?:QNAN|SNAN|IND)0*)(?![\w/!])"
)
_CODE = re.compile(r"\s#.*")  # a comment after numbers
_MOMENT = re.compile(
    r"(?:\d{4}[-/.]\d{1,2}[-/.]\d{1,2}|\d{1,2}[-/.]\d{1,2}[-/.](?:\d{4}|\d{2}))(?:[ T]+\d{1,2}:.*)?"
    r"|\d{1,2}:\d{2}(?::\d{2}(?:[.,]\d+)?)?"
)
_DECIMALS, _WHOLE = re.compile(r"(\d+)(?:[eE][+-]?\d+)?"), re.compile(r"[+-]?\d+")
_ZERO = re.compile(r"[+-]?0\d+")
_THOUSAND = re.compile(r"[+-]?[1-9]\d{0,2},\d{3}")
_THOUSANDS = re.compile(r"[+-]?\d{1,3}(?:([.,'’ ])\d{3})(?:\1\d{3})*(?:[.,]\d*)?")
_MINUS = str.maketrans("−‐‑–", "----")


@lru_cache(maxsize=2)
def _number(decimal):
    mark = re.escape(decimal)
    return re.compile(
        rf"[+-]?(?:(?:\d+(?:{mark}\d*)?|{mark}\d+)(?:[eEdD][+-]?\d+)?|inf(?:inity)?)", re.IGNORECASE | re.ASCII
    )


@dataclass(frozen=True)
class Dialect:
    """One way to part a line into cells and to read numbers in them.

    separator : one letter, a blank for any run of blanks and tabs
    decimal : "." or ","
    """

    separator: str
    decimal: str

    def cells(self, line: str) -> list[str]:
        """Cells of a line, without the blanks around them; quotes hold one together."""
        if '"' not in line:
            return (
                line.split() if self.separator == BLANK else [each.strip() for each in line.split(self.separator)]
            )
        if self.separator == BLANK:
            line = " ".join(line.split())
        return [each.strip() for each in next(csv.reader([line], delimiter=self.separator, skipinitialspace=True))]

    def fits(self, line: str, cells: Sequence[str]) -> bool:
        """Whether no decimal comma of a line is a separator: it stands in quotes, or another letter separates."""
        both = self.separator == self.decimal
        return not both or all(f'"{cell}"' in line for cell in cells if "," in cell)

    def kind(self, cell: str) -> str:
        """Whether a cell is a number, says that there is none, is a word, or begins as a number and is none."""
        if _number(self.decimal).fullmatch(cell):
            # No program writes 05; where a decimal comma is taken for a separator it stands.
            zero = self.separator == "," and _ZERO.fullmatch(cell)
            return BAD if zero else NUMBER
        if _NOT_MEASURED.fullmatch(cell):
            return EMPTY
        if _MOMENT.fullmatch(cell):
            return WORD
        first = cell.lstrip('"')[:1]
        return BAD if first.isdigit() or first in ("+", "-", ".", ",") else WORD

    def reason(self, cell: str) -> str:
        """Why a cell that begins as a number is none, and what to do; empty where nothing is known."""
        if _THOUSANDS.fullmatch(cell.strip('"')):
            return ": write numbers without marks between thousands"
        if _number({".": ",", ",": "."}[self.decimal]).fullmatch(cell):
            return f": the other numbers have {'points' if self.decimal == '.' else 'commas'} for decimals"
        return ""

    def kinds(self, cells: Sequence[str]) -> str:
        """Kinds of cells, a letter each."""
        return "".join(map(self.kind, cells))

    def value(self, cell: str) -> float:
        """Number of a cell that is one; NaN of any other."""
        if not _number(self.decimal).fullmatch(cell):
            return nan
        plain = cell.replace(self.decimal, ".")
        return float(plain.translate(_FORTRAN) if "d" in plain.lower() else plain)


_FORTRAN = str.maketrans("dD", "ee")
_POINT = [Dialect(separator, ".") for separator in (*STRONG, ",", BLANK)]
DIALECTS = (*_POINT, *(Dialect(separator, ",") for separator in (*STRONG, ",", BLANK)))


def plain(line: str) -> str:
    """A line in the signs of a keyboard, without what follows a # and with NaN for the marks of spreadsheets."""
    if not line.isascii():
        line = line.translate(_MINUS).replace("\N{NO-BREAK SPACE}", " ").replace("\N{NARROW NO-BREAK SPACE}", " ")
    if "#" in line:
        line = _CODE.sub("", _SPREADSHEET.sub("nan", line))
    return line


def comment(line: str) -> str | None:
    """Text of a line that is a comment as a whole; None of any other."""
    found = _COMMENT.match(line)
    return line[found.end() :].strip(" ") if found else None


def thousands(cells: Iterable[str]) -> str | None:
    """A number whose comma may part thousands as well as decimals where none of the others tells; else None."""
    first = None
    for cell in filter(lambda each: "," in each, cells):
        if not _THOUSAND.fullmatch(cell):
            return None
        first = first or cell
    return first


def decimals(rows: Sequence[Sequence[str]]) -> bool:
    """Whether every second cell may be the decimals of the one before it, parted by a comma.

    Decimals are digits, as many in all, or without a zero at the end.
    """
    rows = [[cell for cell in row if not _NOT_MEASURED.fullmatch(cell)] for row in rows]
    if any(len(row) % 2 for row in rows):
        return False
    parts = [found for row in rows for cell in row[1::2] if (found := _DECIMALS.fullmatch(cell))]
    if len(parts) < sum(len(row) // 2 for row in rows) or not all(
        _WHOLE.fullmatch(cell) for row in rows for cell in row[::2]
    ):
        return False
    digits = [part[1] for part in parts]
    return len(set(map(len, digits))) == 1 or not any(each.endswith("0") for each in digits)


def unquoted(cell: str) -> str:
    """A cell without the quotes around it; a doubled quote within them is one."""
    return cell[1:-1].replace('""', '"') if len(cell) > 1 and cell[0] == cell[-1] == '"' else cell
