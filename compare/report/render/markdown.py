"""A page as Markdown, with its figures and tables in files beside it: for documentation."""

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field

from scene.printable import printable

from ...solving.vocabulary import entry, stem
from ..manifest import FINDINGS, made
from ..page import Findings, Page, Plot, Section, Table, Text
from ..plots.rendering import Picture
from . import mathematics, prose
from .columns import claims, columns

MOST_ROWS = 40  # of all tables of a page: a table is shown whole while there is room, else by its file
SAID = "Caption as above."
# Marks of Markdown, of the dialect of Sphinx too: those that count anywhere, and where a line begins.
SPECIAL = re.compile(r"([\\`*\[\]<>|$~#{}]|(?<![^\W_])_|_(?![^\W_])|&(?=[#\w])|!(?=\[|$)|(?<={)%)")


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
    parts += [begun(typeset(words)) for words in page.opening]
    parts += ["\n".join(f"- {begun(typeset(sentence))}" for sentence in page.answer)]
    parts += _blocks(page.blocks, 2, shown)
    parts.append(f"All findings, every digit: [{FINDINGS}.csv]({FINDINGS}.csv).")
    if shown.names:
        parts += ["## Definitions", "\n".join(f"- {_definition(name)}" for name in shown.names)]
    about = {**page.about, **made()}
    parts += ["## How this page was made", "\n".join(f"- {name}: {escaped(fact)}" for name, fact in about.items())]
    return printable("\n\n".join(part for part in parts if part) + "\n")


def escaped(words: str) -> str:
    """Text that Markdown shows as it is, in one line, of which it is not the beginning: see `begun`."""
    return SPECIAL.sub(r"\\\1", re.sub(r"[ \t\r\n]+", " ", words))


def begun(line: str) -> str:
    """A line that is no list, no ruler and no directive, whatever it begins with."""
    line = re.sub(r"^(?:(\d+)([.)])(?=\s|$)|([-+=:%]))", r"\1\\\2\3", line.strip())
    return re.sub(r"^(\(.*)=$", r"\1\\=", line)


def restated(text: str) -> str:
    """A text of a page with nothing in it but the marks that it may have."""
    said, marks, tight = "", [], False
    for token in prose.tokens(text):
        match token.type:
            case "bullet_list_open" | "ordered_list_open":
                marks.append("")
            case "bullet_list_close" | "ordered_list_close":
                marks.pop()
            case "list_item_open":
                marks[-1] = "1. " if token.markup in ".)" else "- "
            case "list_item_close":
                marks[-1] = ""
            case "paragraph_open":
                said += "\n" if tight and token.hidden else "\n\n"
                tight = token.hidden
            case "inline" | "math_block":
                if line := begun("".join(_inline(token.children or [token]))):
                    said += "".join(marks) + line
                    marks = [" " * len(mark) for mark in marks]
    return said.strip("\n")


def _inline(tokens) -> Iterator[str]:
    led = ""
    for token in tokens:
        match token.type:
            case "em_open" | "em_close" | "strong_open" | "strong_close":
                yield "*" if token.type.startswith("em") else "**"
            case "link_open":
                led = re.sub(r"([()])", r"\\\1", escaped(token.attrs["href"]))
                yield "["
            case "link_close":
                yield f"]({led})"
            case "code_inline":
                yield _code(token.content)
            case "softbreak" | "hardbreak":
                yield " "
            case kind if kind.startswith("math"):
                latex = " ".join(token.content.split())
                formula = mathematics.dollars(latex)
                yield _code(latex) if not mathematics.understood(latex) else formula
            case _:
                yield escaped(token.content)


def _code(words):
    """Code between more backticks than it has in a row."""
    ticks = "`" * (1 + max(map(len, re.findall("`+", words)), default=0))
    room = " " if ticks != "`" or words != words.strip() else ""
    return f"{ticks}{room}{words}{room}{ticks}"


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
                yield restated(markdown)
            case Table():
                yield from _table(block, shown)
            case Findings():
                yield from _findings(block, shown)
            case Plot():
                yield f"![{escaped(block.alternative or block.caption)}]({block.name}.png)"
                data = ", ".join(f"[{name}.csv]({block.folder}{name}.csv)" for name in block.tables)
                yield f"{begun(shown.caption(block.caption))}{f' Data: {data}.' if data else ''}"
            case Section(title, inside):
                yield f"{'#' * level} {escaped(title)}"
                yield from _blocks(inside, level + 1, shown)


def _table(block, shown):
    if block.caption:
        yield begun(typeset(block.caption))
    if not block.long and shown.takes(len(block.frame)):
        cells = columns(block.frame)
        shown.define(stem(column.name) for column in cells if entry(column.name))
        rows = [list(row) for row in zip(*(column.texts for column in cells), strict=True)]
        yield table([column.title for column in cells], rows, [column.numeric for column in cells])
    yield f"Every digit of {len(block.frame)} rows: [{block.name}.csv]({block.name}.csv)."


def _findings(block, shown):
    if block.caption:
        yield begun(typeset(block.caption))
    if not shown.takes(len(block.findings)):
        yield f"{len(block.findings)} findings stand in [{FINDINGS}.csv]({FINDINGS}.csv)."
        return
    shown.define(("verdict", "dimension", "value", "tolerance", "grid_method"))
    cells = claims(block.findings)
    yield table(list(cells), [list(row) for row in zip(*cells.values(), strict=True)], [False] * len(cells))


def _definition(name):
    found = entry(name)
    unit = f" [{found.unit_in_words}]" if found.unit else ""
    formula = f" {mathematics.dollars(found.formula)}." if found.formula else ""
    source = f" ({found.source})" if found.source else ""
    words = f"{escaped(unit)}: {typeset(found.text)}{formula}{escaped(source)}"
    return f"**{escaped(name.replace('_', ' '))}**{words}"
