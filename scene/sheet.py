"""Sheets of numbers in text files: read in the one dialect that fits the whole file, or refused with the place."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import accumulate, islice
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
    decimals,
    plain,
    thousands,
)
from .heading import Heading, is_statement
from .printable import brief

# Lines, and letters in them, from which the dialect of a long file is found; the others have to be in it too.
SAMPLE, SHORT, LETTERS = 300, 6, 50_000
LINES, LINE = 2**21, 2**20  # lines of a file, and letters in one of them
MOST = 20_000_000  # bytes of a file


@dataclass(frozen=True, eq=False)
class Sheet:
    """A block of numbers out of a text file.

    name : of the file, for messages
    numbers : (rows, columns), NaN where a cell is empty or says that nothing was measured
    lines : (rows,) line of each row in the file
    heading : of the columns; empty without one
    """

    name: str
    numbers: np.ndarray
    lines: Sequence[int] = ()
    heading: Heading = field(default_factory=Heading)

    @property
    def names(self) -> tuple[str, ...]:
        """Headings of the columns without their units; none without a heading."""
        return self.heading.names

    @property
    def units(self) -> tuple[str, ...]:
        """Units of the columns as they are written, "" where none is; none without a heading."""
        return self.heading.units

    @property
    def before(self) -> tuple[str, ...]:
        """Lines of text above the block, since the block before, and below the last one."""
        return self.heading.before

    @property
    def commented(self) -> bool:
        """Whether the heading stands in a comment."""
        return self.heading.commented

    @property
    def unread(self) -> str:
        """Text right above the numbers that is neither a heading of them nor a comment."""
        return self.heading.unread

    def told(self, below: Sequence[str]) -> "Sheet":
        """The sheet with lines below it among those around it."""
        texts = (comment(line) or line.strip() for line in below if line.strip())
        return replace(self, heading=replace(self.heading, before=(*self.before, *texts)))

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
    one of them in the whole file; a comma within cells parted otherwise, or in quotes, is a decimal comma. A text
    is one in UTF-8, UTF-16 or Latin-1. What can be read in two ways is refused.

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


def _found(name, lines):
    """The dialect in which the beginning of a file can be read. Raises ValueError with none, or with several."""
    count = next((k for k, letters in enumerate(accumulate(map(len, lines)), 1) if letters > LETTERS), len(lines))
    sample, reasons, fitting = lines[: min(max(count, SHORT), SAMPLE)], {}, []
    for dialect in DIALECTS:
        reading = _Reading(name, dialect, sample, whole=len(sample) == len(lines))
        try:
            fitting.append((dialect, tuple(reading.sheets())))
        except ValueError as mistake:
            reasons.setdefault(reading.weight, mistake)
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
    """The reading of two whose columns have headings, else the wider one. Raises ValueError if none has any."""
    told = [bool(sheets[0].names) and not sheets[0].unread for _, sheets in (one, other)]
    wide = [sheets[0].numbers.shape[1] for _, sheets in (one, other)]
    if told[0] != told[1]:
        return one if told[0] else other
    if told[0] and wide[0] != wide[1]:
        return one if wide[0] > wide[1] else other
    (first, *_), (second, *_) = one[1], other[1]
    raise ValueError(
        f"{name}, line {first.lines[0]}: can be read as {_shown(first)} and as {_shown(second)}: part the columns "
        "by semicolons or tabs, write decimal points, or write a heading"
    )


def _shown(sheet):
    return " and ".join(f"{number:g}" for number in sheet.numbers[0, :4])


def _check_commas(name, dialect, lines, sheets):
    """Raise ValueError where a comma may part columns, decimals or thousands, and no number tells."""

    def rows(most=None):
        places = (number - 1 for sheet in sheets for number in sheet.lines)
        return (dialect.cells(lines[place]) for place in islice(places, most))

    if dialect.decimal == ",":
        numbers = (cell for row in rows() for cell in row if dialect.kind(cell) == NUMBER)
        if doubtful := thousands(numbers):
            raise ValueError(
                f"{name}: {doubtful!r} and all numbers like it may have a decimal comma or one between thousands: "
                "write points, or another number of decimals"
            )
    elif dialect.separator != "," or any(sheet.names for sheet in sheets):
        return
    elif decimals(list(rows(SHORT))) and decimals(list(rows())):
        raise ValueError(
            f"{name}, line {sheets[0].lines[0]}: commas may part columns or decimals: write decimal points, part "
            "the columns by semicolons, or write a heading"
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
    weight: tuple[int, bool, int] = field(default=(0, False, 0), init=False)

    @cached_property
    def form(self) -> str:
        """Kinds of the columns, by the lines in which numbers stand. Raises ValueError without any."""
        counted: dict[int, list[str]] = {}
        texts = (line for line in self.lines if line.strip() and comment(line) is None)
        tabs = True
        for line in islice(texts, SAMPLE):
            kinds = self.dialect.kinds(self.dialect.cells(line))
            if NUMBER in kinds:
                counted.setdefault(len(kinds), []).append(kinds)
                tabs &= "\t" in line.strip()
        if not counted:
            raise ValueError(f"{self.name}: there is no row of numbers in it")
        sound = {width: sum(BAD not in each for each in rows) for width, rows in counted.items()}
        width = max(sound, key=lambda each: (sound[each], each))
        self.weight = sound[width], width > 1 and self.dialect.separator in STRONG, width
        if tabs and self.dialect.separator == BLANK:
            raise ValueError(f"{self.name}: a tab stands in every row, and blanks beside it part no cells")
        columns = zip(*counted[width], strict=True)
        return "".join(NUMBER if each.count(NUMBER) >= each.count(WORD) else WORD for each in columns)

    @cached_property
    def end(self) -> int:
        """Line from which on there is nothing but separators, as spreadsheets write them below a table."""
        backwards = range(len(self.lines), 0, -1)
        return next((count for count in backwards if any(map(str.isalnum, self.lines[count - 1]))), 0)

    def _fits(self, kinds):
        """Whether a line of such cells is a row."""
        return kinds == self.form or (
            len(kinds) == len(self.form)
            and (NUMBER in kinds or kinds == EMPTY * len(kinds))
            and all(kind in (EMPTY, wanted) for kind, wanted in zip(kinds, self.form, strict=True))
        )

    def sheets(self) -> Iterator[Sheet]:
        """The blocks. Raises ValueError for what is no row among them."""
        gap, start, stop, total, last = [], 0, 0, 0, None
        while start < len(self.lines):
            stop = self._stop(start) if start >= stop else stop
            end, numbers = self._block(start, stop)
            if not len(numbers):
                gap.append(start)
                start += 1
                continue
            total += len(numbers)
            self._check_size(total)
            self._check_gap(gap)
            if last:
                yield last
            last = self._sheet(gap, start, numbers)
            gap, start = [], end
        if self.whole:
            self._check_gap(gap, last=True)
        if not last:
            raise ValueError(f"{self.name}: there is no row of numbers in it")
        yield last.told([self.lines[each] for each in gap])

    def _stop(self, start):
        """The next blank line or comment from a line on."""
        places = range(start, len(self.lines))
        blank = (k for k in places if not self.lines[k].strip() or comment(self.lines[k]) is not None)
        return next(blank, len(self.lines))

    def _block(self, start, stop):
        """End of the run of rows from one line on and before another, and their numbers."""
        rows = []
        for line in map(self.lines.__getitem__, range(start, stop)):
            if len(rows) == SHORT and (numbers := self._at_once(self.lines[start:stop])) is not None:
                return stop, numbers
            cells = self.dialect.cells(line)
            kinds = self.dialect.kinds(cells)
            nothing = NUMBER not in kinds and not any(map(str.isalpha, line))
            if (
                (nothing and not (rows and start + len(rows) >= self.end))
                or not self._fits(kinds)
                or not self.dialect.fits(line, cells)
            ):
                break
            rows.append(list(map(self.dialect.value, cells)))
            self._check_size(len(rows))
        return start + len(rows), np.array(rows, float).reshape(len(rows), len(self.form))

    def _at_once(self, lines):
        """Numbers of many lines that hold nothing else, else None."""
        self._check_size(len(lines))
        text = "\n".join(lines)
        if WORD in self.form or "_" in text or '"' in text or (self.dialect.decimal == "," and "." in text):
            return None
        if self.dialect.decimal == ",":
            text = text.replace(",", ".")
        separator = None if self.dialect.separator == BLANK else self.dialect.separator
        try:
            numbers = np.loadtxt(text.split("\n"), delimiter=separator, comments=None, ndmin=2)
        except ValueError:
            return None  # line by line it is found where
        return numbers if numbers.shape[1] == len(self.form) else None

    def _check_size(self, rows):
        if rows > self.most_rows:
            raise ValueError(f"{self.name}: at least {rows:,} rows: at most {self.most_rows:,} are read")
        if self.most_numbers and rows * len(self.form) > self.most_numbers:
            raise ValueError(f"{self.name}: more than {self.most_numbers:,} numbers: no more are read")

    def _sheet(self, gap, start, numbers):
        heading = Heading.of([self.lines[each] for each in gap], len(self.form), self.dialect)
        if WORD in self.form and not heading.names:
            self._refuse(start)
        # Columns of words are left out, and their headings with them; so is what follows a separator at the end
        # of every line.
        ends = self.dialect.separator != BLANK and all(
            self.lines[k].rstrip().endswith(self.dialect.separator) for k in range(start, start + len(numbers))
        )
        form = self.form[:-1] if ends and np.isnan(numbers[:, -1]).all() else self.form
        kept = [k for k, kind in enumerate(form) if kind == NUMBER]
        return Sheet(
            self.name, numbers[:, kept], range(start + 1, start + 1 + len(numbers)), heading.of_columns(kept)
        )

    def _check_gap(self, gap, last=False):
        """Raise ValueError where lines between blocks may be rows that went wrong."""
        said = [each for each in gap if self.lines[each].strip()]
        for each in said:
            line = self.lines[each].strip()
            if comment(line) is not None:
                continue
            if each == gap[0] > 0:
                self._refuse(each)  # no blank line parts it from the rows above
            cells = self.dialect.cells(line)
            kinds = self.dialect.kinds(cells)
            if not any(map(_like_a_number, kinds, cells)) or is_statement(line):
                continue
            axes = len(kinds) == len(self.form) and set(kinds[1:]) == {NUMBER}
            lowest = each == said[-1]
            if last or kinds[0] != WORD or (lowest and not axes):
                self._refuse(each)

    def _refuse(self, number):
        """Raise ValueError for a line, with the cell that is wrong."""
        cells, form, where = self.dialect.cells(self.lines[number]), self.form, f"{self.name}, line {number + 1}"
        kinds = self.dialect.kinds(cells)
        wrong = next((k for k, kind in enumerate(kinds) if kind not in (EMPTY, NUMBER)), None)
        if wrong is not None and (len(cells) == len(form) or NUMBER not in kinds):
            reason = self.dialect.reason(cells[wrong])
            raise ValueError(f"{where}, column {wrong + 1}: {brief(repr(cells[wrong]))} is not a number{reason}")
        if kinds == EMPTY * len(form):
            raise ValueError(f"{where}: a row without a number: leave it out, or leave the line blank")
        count = f"{len(cells)} column{'s' * (len(cells) != 1)}, and other rows have {len(form)}"
        raise ValueError(f"{where}: {count}: {brief(repr(self.lines[number].strip()))}")


def _like_a_number(kind, cell):
    return kind == NUMBER or (kind == BAD and not set(filter(str.isalpha, cell)) - set("eEdD"))
