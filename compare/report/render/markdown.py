"""A page as Markdown, with its figures and tables in files beside it: for documentation."""

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field

from ...solving.vocabulary import entry, stem
from ..manifest import FINDINGS, made
from ..page import Findings, Page, Plot, Section, Table, Text
from ..plots.rendering import Picture
from . import mathematics
from .columns import claims, columns

MOST_ROWS = 40  # of all tables of a page: a table is shown whole while there is room, else by its file
SAID = "Caption as above."
SPECIAL = re.compile(r"([\\`*\[\]<>|$]|(?<![^\W_])_|_(?![^\W_]))")


@dataclass
class _Shown:
    """What a page has shown so far: names to be defined at its end, captions, and how many rows are left."""

    names: dict[str, None] = field(default_factory=dict)
    captions: set[str] = field(default_factory=set)
    room: int = MOST_ROWS

    def takes(self, rows: int) -> bool:
        """Whether a table of so many rows still fits; if so, they are taken."""
        fits = rows <= self.room
        self.room -= rows if fits else 0
        return fits

    def define(self, names: Iterable[str]):
        self.names.update(dict.fromkeys(names))

    def caption(self, words: str) -> str:
        """A caption; where the page has said it already, that it is the one above."""
        told = SAID if words in self.captions else typeset(words)
        self.captions.add(words)
        return told


def text(page: Page, pictures: Mapping[str, Picture]) -> str:
    """The page; what stands in tables is defined at its end."""
    shown = _Shown()
    parts = [f"# {escaped(page.title)}", "\n".join(f"- **{typeset(each)}**" for each in page.first)]
    parts += ["\n".join(f"- {typeset(sentence)}" for sentence in page.answer)]
    parts += _blocks(page.blocks, 2, shown)
    parts.append(f"All findings, every digit: [{FINDINGS}.csv]({FINDINGS}.csv).")
    if shown.names:
        parts += ["## Definitions", "\n".join(f"- {_definition(name)}" for name in shown.names)]
    about = {**page.about, **made()}
    parts += ["## How this page was made", "\n".join(f"- {name}: {escaped(fact)}" for name, fact in about.items())]
    return "\n\n".join(part for part in parts if part) + "\n"


def escaped(words: str) -> str:
    """Text that Markdown shows as it is."""
    return SPECIAL.sub(r"\\\1", words)


def typeset(words: str) -> str:
    """A sentence, escaped, with its symbols as formulas."""
    return mathematics.typeset(words, escaped, mathematics.dollars)


def table(heads: list[str], rows: list[list[str]], numeric: list[bool]) -> str:
    """A table of texts, which are escaped; numbers stand on the right."""
    lines = [heads, *rows]
    cells = [[typeset(" ".join(cell.split())) for cell in line] for line in lines]
    cells.insert(1, ["--:" if right else ":--" for right in numeric])
    return "\n".join(f"| {' | '.join(line)} |" for line in cells)


def _blocks(blocks, level, shown) -> Iterator[str]:
    for block in blocks:
        match block:
            case Text(markdown):
                yield markdown.strip()
            case Table():
                yield from _table(block, shown)
            case Findings():
                yield from _findings(block, shown)
            case Plot():
                yield f"![{escaped(block.alternative or block.caption)}]({block.name}.png)"
                data = ", ".join(f"[{name}.csv]({block.folder}{name}.csv)" for name in block.tables)
                yield f"{shown.caption(block.caption)}{f' Data: {data}.' if data else ''}"
            case Section(title, inside):
                yield f"{'#' * level} {escaped(title)}"
                yield from _blocks(inside, level + 1, shown)


def _table(block, shown):
    if block.caption:
        yield typeset(block.caption)
    if not block.long and shown.takes(len(block.frame)):
        cells = columns(block.frame)
        shown.define(stem(column.name) for column in cells if entry(column.name))
        rows = [list(row) for row in zip(*(column.texts for column in cells), strict=True)]
        yield table([column.title for column in cells], rows, [column.numeric for column in cells])
    yield f"Every digit of {len(block.frame)} rows: [{block.name}.csv]({block.name}.csv)."


def _findings(block, shown):
    if block.caption:
        yield typeset(block.caption)
    if not shown.takes(len(block.findings)):
        yield f"{len(block.findings)} findings stand in [{FINDINGS}.csv]({FINDINGS}.csv)."
        return
    shown.define(("verdict", "dimension", "value", "tolerance", "grid_method"))
    cells = claims(block.findings)
    yield table(list(cells), [list(row) for row in zip(*cells.values(), strict=True)], [False] * len(cells))


def _definition(name):
    found = entry(name)
    unit = f" [{found.unit.replace('^2', '²')}]" if found.unit else ""
    formula = f" {mathematics.dollars(found.formula)}." if found.formula else ""
    source = f" ({found.source})" if found.source else ""
    words = f"{escaped(unit)}: {typeset(found.text)}{formula}{escaped(source)}"
    return f"**{escaped(name.replace('_', ' '))}**{words}"
