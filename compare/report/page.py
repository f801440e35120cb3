"""Page: what a command has to say, as a list of blocks that every renderer shows in its own way."""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

from pandas import DataFrame

from ..figures.plot import Plot
from ..statistics.finding import Finding


@dataclass(frozen=True)
class Text:
    """Plain text: paragraphs with an empty line between them; lines that begin with "- " are a list."""

    text: str

    @property
    def lines(self) -> list[str]:
        """Each paragraph, and each item of a list, as one line."""
        joined = re.sub(r"\n(?!\s*\n|\s*- )", " ", self.text)
        return [" ".join(line.split()) for line in joined.splitlines() if line.strip()]


@dataclass(frozen=True)
class Table:
    """A table that people read; its CSV file is the frame with every digit.

    name : of its file, without .csv, with its folder below the folder of the page: "sphere/points"
    frame : columns whose names the vocabulary knows
    caption : one sentence
    long : whether the page shows only a link to the file, as the table has too many rows to read
    """

    name: str
    frame: DataFrame
    caption: str = ""
    long: bool = False


@dataclass(frozen=True)
class Findings:
    """Findings as a table: claim, verdict, interval, what it is tested against, and the reason."""

    findings: Sequence[Finding]
    caption: str = ""


class _Ordered:
    """Blocks, sorted into the order of reading; blocks of the same kind keep their order."""

    blocks: Sequence["Block"]

    def __post_init__(self):
        found = sorted(self.blocks, key=lambda block: ORDER.index(type(block)))
        object.__setattr__(self, "blocks", tuple(found))

    def every(self, kind: type) -> Iterator[Any]:
        """Blocks of the given kind, also those in sections, in their order."""
        for block in self.blocks:
            if isinstance(block, kind):
                yield block
            elif isinstance(block, Section):
                yield from block.every(kind)


@dataclass(frozen=True)
class Section(_Ordered):
    """Blocks under a heading, in the order of reading."""

    title: str
    blocks: Sequence["Block"]


Block: TypeAlias = Text | Table | Findings | Plot | Section
# Order of reading on every page and in every section: figures before tables, and sections last.
ORDER = (Text, Plot, Findings, Table, Section)


@dataclass(frozen=True)
class Page(_Ordered):
    """A page, in the order of reading: doubts, the opening, the answer, figures, findings, other tables, sections.

    title : of the page
    answer : a sentence for each claim, generated from all findings
    blocks : of the page below the answer; those given are put in the order of reading
    doubts : sentences that stand before the answer: doubts about what was asked, contacts without an answer
    notes : sentences that follow them, on what was read
    opening : tables before the answer: what a reader came for
    """

    title: str
    answer: Sequence[str]
    blocks: Sequence[Block]
    doubts: Sequence[str] = ()
    notes: Sequence[str] = ()
    opening: Sequence[Table] = ()

    @property
    def first(self) -> list[str]:
        """Doubts and notes, each with the word that says which it is."""
        return [*(f"Doubtful: {each}" for each in self.doubts), *(f"Note: {each}." for each in self.notes)]

    def tables(self) -> Iterator[tuple[str, DataFrame]]:
        """Name of its file, without .csv, and frame of every table that is shown or drawn; some come twice."""
        yield from ((table.name, table.frame) for table in (*self.opening, *self.every(Table)))
        for plot in self.every(Plot):
            yield from plot.files.items()
