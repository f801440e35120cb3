"""Sheets of numbers in text files: read in the one dialect that fits the whole file, or refused with the place."""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import islice
from pathlib import Path

import numpy as np

from . import files
from .dialect import (
    BAD,
    BLANK,
    DIALECTS,
    EMPTY,
    NUMBER,
    STRONG,
    WORD,
    Dialect,
    comment,
    plain,
    thousands,
    unquoted,
)
from .printable import brief

SAMPLE = 300  # lines from which the dialect of a long file is found; the others have to be in it too
LINES, LINE = 2**20, 2**20  # lines of a file, and letters in one of them
MOST = 20_000_000  # bytes of a file
_STATEMENT = re.compile(r"[^\W\d][^:=;\t,|]{0,80}[:=].*")  # "Width: 20 µm", "T = 25 °C"
# "F_N [mN]", "F_N (mN)", "F_N / mN", "F_N in mN", or a name alone.
_NAMED = re.compile(
    r"(?P<name>.*?)\s*(?:\[(?P<a>[^\[\]]*)\]|\((?P<b>[^()]*(?:\([^()]*\)[^()]*)*)\)|/\s*\(?(?P<c>[^()/]+)\)?"
    r"|\s+in\s+(?P<d>\S+))?"
)
_UNIT = re.compile(r"[\[(]?\s*(?P<unit>[^\[\]]*?)\s*[\])]?")
_BLANKS = re.compile(r"\s{2,}|\t"), re.compile(r"\s+(?![\[(/])(?<!/\s)(?![^\[(]*[\])])")


@dataclass(frozen=True, eq=False)
class Sheet:
    """A block of numbers out of a text file.

    name : of the file, for messages
    numbers : (rows, columns), NaN where a cell is empty or says that nothing was measured
    lines : (rows,) line of each row in the file
    names : headings of the columns without their units; none without a heading
    units : of the columns as they are written, "" where none is
    before : lines of text above the block, since the block before
    commented : whether the heading stands in a comment
    unread : text right above the numbers that is no heading of as many columns; else ""
    """

    name: str
    numbers: np.ndarray
    lines: Sequence[int]
    names: tuple[str, ...] = ()
    units: tuple[str, ...] = ()
    before: tuple[str, ...] = ()
    commented: bool = False
    unread: str = ""

    def place(self, row: int, column: int) -> str:
        """Where a number stands, for messages."""
        called = f" ({brief(self.names[column])})" if self.names else ""
        where = f", line {self.lines[row]}" if len(self.lines) else ""
        return f"{self.name}{where}, column {column + 1}{called}"


def read_sheets(
    path: str | Path, most_rows: int = LINES, most_bytes: int = MOST, most_numbers: int | None = None
) -> tuple[Sheet, ...]:
    """The blocks of numbers of a text file, at least one, all of as many columns.

    A block ends at a blank line, a comment or text. Cells are parted by tabs, semicolons, bars, commas or blanks,
    one of them in the whole file; a comma within cells parted otherwise, or in quotes, is a decimal comma. A text is
    one in UTF-8, UTF-16 or Latin-1. What can be read in two ways is refused.

    most_rows, most_bytes, most_numbers : that are read

    Raises ValueError naming file, line, column and what stands there.
    """
    name = brief(str(path))
    lines = [plain(each) for each in files.text(path, most_bytes, any_encoding=True).split("\n")]
    if len(lines) > LINES:
        raise ValueError(f"{name}: more than {LINES} lines")
    for number, line in enumerate(lines, 1):
        if len(line) > LINE:
            raise ValueError(f"{name}: line {number} has more than {LINE} letters")
    dialect = _found(name, lines)
    reading = _Reading(name, dialect, lines, most_rows, most_numbers)
    sheets = tuple(reading.sheets())
    _check_commas(name, dialect, lines, sheets)
    return sheets


def named(cell: str) -> tuple[str, str]:
    """Name and unit of a heading, as "F_N [mN]" has them; an empty unit where it has none."""
    found = _NAMED.fullmatch(" ".join(cell.split()))
    unit = next(filter(None, found.group("a", "b", "c", "d")), "").strip() if found else ""
    if not found or not found["name"]:
        return cell.strip(), ""
    # |E*| (f) names an argument and no unit.
    return found["name"].strip(), unit


class _Mistake(ValueError):
    """A text is no table in a dialect."""


def _found(name, lines):
    """The dialect in which the beginning of a file can be read. Raises ValueError with no such, or with several."""
    sample, reasons, fitting = lines[:SAMPLE], {}, []
    for dialect in DIALECTS:
        reading = _Reading(name, dialect, sample, whole=len(lines) <= SAMPLE)
        try:
            fitting.append((dialect, tuple(reading.sheets())))
        except _Mistake as mistake:
            reasons[reading.weight] = mistake
    if not fitting:
        raise ValueError(str(reasons[max(reasons)]))
    best = fitting[0]
    for other in fitting[1:]:
        if not _alike(best[1], other[1]):
            best = _clearer(name, best, other)
    return best[0]


def _alike(one, other):
    return len(one) == len(other) and all(
        np.array_equal(a.numbers, b.numbers, equal_nan=True) for a, b in zip(one, other, strict=True)
    )


def _clearer(name, one, other):
    """The reading of two whose numbers have headings, as many names as columns. Raises ValueError if both or none do."""
    told = [bool(sheets[0].names) and not sheets[0].unread for _, sheets in (one, other)]
    wide = [sheets[0].numbers.shape[1] for _, sheets in (one, other)]
    if told[0] != told[1]:
        return one if told[0] else other
    if told[0] and wide[0] != wide[1]:
        return one if wide[0] > wide[1] else other
    (first, *_), (second, *_) = one[1], other[1]
    raise ValueError(
        f"{name}, line {first.lines[0]}: can be read as {_shown(first)} and as {_shown(second)}: part the columns by "
        "semicolons or tabs, write decimal points, or write a heading"
    )


def _shown(sheet):
    return " and ".join(f"{number:g}" for number in sheet.numbers[0, :4])


def _check_commas(name, dialect, lines, sheets):
    """Raise ValueError for commas that part decimals or thousands, and no number tells which."""
    if dialect.decimal == ".":
        return
    rows = (lines[number - 1] for sheet in sheets for number in sheet.lines)
    if doubtful := thousands(
        [cell for line in rows for cell in dialect.cells(line) if dialect.kind(cell) == NUMBER]
    ):
        raise ValueError(
            f"{name}: {doubtful!r} and all numbers like it may have a decimal comma or one between thousands: write "
            "points, or another number of decimals"
        )


@dataclass(eq=False)
class _Reading:
    """One attempt to read lines in a dialect.

    whole : whether the lines are the whole file, or its beginning
    weight : how far the attempt came
    """

    name: str
    dialect: Dialect
    lines: Sequence[str]
    most_rows: int = LINES
    most_numbers: int | None = None
    whole: bool = True
    weight: tuple[int, int] = field(default=(0, 0), init=False)

    @cached_property
    def form(self) -> str:
        """Kinds of the columns, by the lines in which numbers stand. Raises _Mistake without any."""
        counted: dict[int, list[str]] = {}
        texts = (line for line in self.lines if line.strip() and comment(line) is None)
        tabs = True
        for line in islice(texts, SAMPLE):
            kinds = self.dialect.kinds(self.dialect.cells(line))
            if NUMBER in kinds:
                counted.setdefault(len(kinds), []).append(kinds)
                tabs &= "\t" in line.strip()
        if not counted:
            raise _Mistake(f"{self.name}: there is no row of numbers in it")
        sound = {width: sum(BAD not in each for each in rows) for width, rows in counted.items()}
        width = max(sound, key=lambda each: (sound[each], each))
        self.weight = sound[width], width
        if tabs and self.dialect.separator == BLANK:
            raise _Mistake(f"{self.name}: a tab stands in every row, and blanks beside it part no cells")
        columns = zip(*counted[width], strict=True)
        return "".join(NUMBER if each.count(NUMBER) >= each.count(WORD) else WORD for each in columns)

    def _fits(self, kinds):
        """Whether a line of such cells is a row."""
        return kinds == self.form or (
            len(kinds) == len(self.form)
            and NUMBER in kinds
            and all(kind in (EMPTY, wanted) for kind, wanted in zip(kinds, self.form, strict=True))
        )

    def sheets(self) -> Iterator[Sheet]:
        """The blocks. Raises _Mistake for what is no row among them."""
        form, gap, start = self.form, [], 0
        total = 0
        while start < len(self.lines):
            end, numbers = self._block(start)
            if not len(numbers):
                gap.append(start)
                start += 1
                continue
            total += len(numbers)
            if total > self.most_rows:
                raise ValueError(
                    f"{self.name}: at least {self.most_rows + 1:,} rows: at most {self.most_rows:,} are read"
                )
            self._check_gap(gap)
            yield self._sheet(gap, start, numbers[:, [kind == NUMBER for kind in form]], form)
            gap, start = [], end
        if self.whole:
            self._check_gap(gap, last=True)

    def _block(self, start):
        """End of the run of rows that begins at a line, and their numbers."""
        rows, number = [], start
        values, fits, kinds_of, cells_of = self.dialect.value, self._fits, self.dialect.kinds, self.dialect.cells
        width = len(self.form)
        for number in range(start, len(self.lines)):
            line = self.lines[number]
            if not line.strip() or comment(line) is not None:
                break
            cells = cells_of(line)
            row = self._plainly(line, cells, width)
            if row is None:
                if not fits(kinds_of(cells)) or not all(
                    "," not in cell or self.dialect.fits(line, cell)
                    for cell in cells
                    if self.dialect.decimal == ","
                ):
                    break
                row = list(map(values, cells))
            rows.append(row)
            if len(rows) > self.most_rows or (self.most_numbers and len(rows) * width > self.most_numbers):
                number += 1
                break
        else:
            number = len(self.lines)
        return number, np.array(rows, float).reshape(len(rows), width)

    def _plainly(self, line, cells, width):
        """Numbers of a row that all are plain; None of any other."""
        if len(cells) != width or "_" in line or WORD in self.form or self.dialect.separator == ",":
            return None
        text = line if self.dialect.decimal == "." else None
        if text is None:
            if "." in line:
                return None
            cells = [cell.replace(",", ".") for cell in cells]
        try:
            return list(map(float, cells))
        except ValueError:
            return None

    def _sheet(self, gap, start, numbers, form):
        heading, units, kept, commented, unread = self._heading(gap, start)
        wanted = [k for k, kind in enumerate(form) if kind == NUMBER]
        # Columns of words are left out, and their headings with them.
        names = tuple(heading[k] for k in wanted) if heading else ()
        return Sheet(
            self.name,
            numbers,
            range(start + 1, start + 1 + len(numbers)),
            names,
            tuple(units[k] for k in wanted) if heading else (),
            tuple(kept),
            commented,
            unread,
        )

    def _heading(self, gap, start):
        """Names and units of the columns, the other lines above them, whether they are a comment, and what is unread."""
        said = [each for each in gap if self.lines[each].strip(' \t;,|"')]
        texts = [comment(self.lines[each]) for each in said]
        whole = [
            self.lines[each].strip() if text is None else text for each, text in zip(said, texts, strict=True)
        ]
        if not said:
            return (), (), [], False, ""
        # The lowest line of as many cells as columns; below it there may be rulers and remarks.
        places = [k for k, text in enumerate(whole) if self._names(text)]
        unread = [text for text, remark in zip(whole, texts, strict=True) if remark is None][-1:]
        if not places:
            stated = not unread or _STATEMENT.fullmatch(unread[0])
            return (), (), whole, texts[-1] is not None, "" if stated else unread[0]
        place = places[-1]
        parts, below = self._parted(whole[place]), whole[place + 1 :]
        remark = texts[place] is not None
        last = "" if all(text is not None for text in texts[place + 1 :]) else unread[0]
        if len(places) > 1 and places[-2] == place - 1 and _are_units(parts):
            pairs, units = (
                [named(each) for each in self._parted(whole[place - 1])],
                [_unit(each) for each in parts],
            )
            if any(own and unit not in ("", "-", own) for (_, own), unit in zip(pairs, units, strict=True)):
                where = f"{self.name}, line {said[place] + 1}"
                raise _Mistake(f"{where}: units beside those of the heading: state them once")
            units = [own or unit for (_, own), unit in zip(pairs, units, strict=True)]
            return tuple(name for name, _ in pairs), tuple(units), whole[: place - 1] + below, remark, last
        return (*zip(*map(named, parts), strict=True), whole[:place] + below, remark, last)

    def _names(self, line):
        """Whether a line may be a heading, or the units of one."""
        parts = self._parted(line)
        stated = _STATEMENT.fullmatch(line) and (len(parts) == 1 or self.dialect.separator == BLANK)
        return parts and not stated and any(map(str.isalpha, line))

    def _parted(self, line):
        """Cells of a heading, as many as columns; none where it has not as many."""
        width = len(self.form)
        for separator in dict.fromkeys((self.dialect.separator, *STRONG, ",")):
            if separator == BLANK:
                continue
            # Quotes within quotes, as of G", are not doubled by every program.
            plainly = [unquoted(each.strip()) for each in line.split(separator)]
            for cells in (plainly, Dialect(separator, ".").cells(line)):
                if len(cells) == width and (width > 1 or not any(map(line.count, STRONG))):
                    return [self._as_point(each) for each in cells]
        if self.dialect.separator == BLANK:
            for cells in (*(blanks.split(line.strip()) for blanks in _BLANKS), self.dialect.cells(line)):
                if len(cells) == width:
                    return [self._as_point(unquoted(each)) for each in cells]
        return []

    def _as_point(self, cell):
        """A number among headings, as of axes, with a decimal point."""
        return cell.replace(",", ".") if self.dialect.kind(cell) == NUMBER else cell

    def _check_gap(self, gap, last=False):
        """Raise _Mistake where lines between blocks may be rows that went wrong."""
        said = [each for each in gap if self.lines[each].strip()]
        for each in said:
            line = self.lines[each].strip()
            if comment(line) is not None:
                continue
            if each == gap[0] > 0:
                self._refuse(each)  # no blank line parts it from the rows above
            cells = self.dialect.cells(line)
            kinds = self.dialect.kinds(cells)
            if not any(map(_like_a_number, kinds, cells)) or _STATEMENT.fullmatch(line):
                continue
            axes = len(kinds) == len(self.form) and set(kinds[1:]) == {NUMBER}
            lowest = each == said[-1]
            if last or kinds[0] != WORD or (lowest and not axes):
                self._refuse(each)

    def _refuse(self, number):
        """Raise _Mistake for a line, with the cell that is wrong."""
        cells, form, where = self.dialect.cells(self.lines[number]), self.form, f"{self.name}, line {number + 1}"
        kinds = self.dialect.kinds(cells)
        wrong = next((k for k, (kind, wanted) in enumerate(zip(kinds, form)) if kind not in (EMPTY, wanted)), None)
        if wrong is not None and (len(cells) == len(form) or NUMBER not in kinds):
            raise _Mistake(f"{where}, column {wrong + 1}: {brief(repr(cells[wrong]))} is not a number")
        count = f"{len(cells)} column{'s' * (len(cells) != 1)}, and other rows have {len(form)}"
        raise _Mistake(f"{where}: {count}: {brief(repr(self.lines[number].strip()))}")


def _like_a_number(kind, cell):
    return kind == NUMBER or (kind == BAD and not any(map(str.isalpha, cell)))


def _unit(cell):
    found = _UNIT.fullmatch(cell.strip())
    return found["unit"] if found else cell.strip()


def _are_units(cells):
    """Whether every cell of a line is a unit, says that there is none, or is empty; and one at least is a unit."""
    found = [_is_unit(_unit(each)) for each in cells]
    return all(found) and any(_unit(each) not in ("", "-", "1") for each in cells)


def _is_unit(text):
    if text in ("", "-", "1", "%"):
        return True
    # Units take time to load, and only what has them needs them.
    from .units import Unreadable, known

    try:
        return known(text)
    except Unreadable:
        return False
