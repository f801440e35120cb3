"""A page as Markdown, with its figures and tables in files beside it: for documentation."""

import re
from collections.abc import Iterator, Mapping

from ...solving.vocabulary import entry, stem
from ..manifest import FINDINGS, made
from ..page import Findings, Page, Plot, Section, Table, Text
from ..plots.rendering import Picture
from . import mathematics
from .columns import claims, columns

MOST_ROWS = 100
SPECIAL = re.compile(r"([\\`*\[\]<>|$]|(?<![^\W_])_|_(?![^\W_]))")


def text(page: Page, pictures: Mapping[str, Picture], tables: Mapping[str, str]) -> str:
    """The page; what stands in tables is defined at its end."""
    used: dict[str, None] = {}
    parts = [f"# {escaped(page.title)}", "\n".join(f"- **{typeset(each)}**" for each in page.first)]
    parts += ["\n".join(f"- {typeset(sentence)}" for sentence in page.answer)]
    parts += _blocks(page.blocks, 2, used)
    parts.append(f"All findings, every digit: [{FINDINGS}.csv]({FINDINGS}.csv).")
    if used:
        parts += ["## Definitions", "\n".join(f"- {_definition(name)}" for name in used)]
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


def _blocks(blocks, level, used) -> Iterator[str]:
    for block in blocks:
        match block:
            case Text(markdown):
                yield markdown.strip()
            case Table():
                yield from _table(block, used)
            case Findings():
                yield from _findings(block, used)
            case Plot():
                yield f"![{escaped(block.alternative or block.caption)}]({block.name}.png)"
                data = ", ".join(f"[{name}.csv]({block.folder}{name}.csv)" for name in block.tables)
                yield f"{typeset(block.caption)}{f' Data: {data}.' if data else ''}"
            case Section(title, inside):
                yield f"{'#' * level} {escaped(title)}"
                yield from _blocks(inside, level + 1, used)


def _table(block, used):
    if block.caption:
        yield typeset(block.caption)
    if not block.long and len(block.frame) <= MOST_ROWS:
        shown = columns(block.frame)
        used.update(dict.fromkeys(stem(column.name) for column in shown if entry(column.name)))
        rows = [list(row) for row in zip(*(column.texts for column in shown), strict=True)]
        yield table([column.title for column in shown], rows, [column.numeric for column in shown])
    yield f"Every digit of {len(block.frame)} rows: [{block.name}.csv]({block.name}.csv)."


def _findings(block, used):
    used.update(dict.fromkeys(("verdict", "dimension", "value", "tolerance", "grid_method")))
    if block.caption:
        yield typeset(block.caption)
    shown = claims(block.findings)
    yield table(list(shown), [list(row) for row in zip(*shown.values(), strict=True)], [False] * len(shown))


def _definition(name):
    found = entry(name)
    unit = f" [{found.unit.replace('^2', '²')}]" if found.unit else ""
    formula = f" {mathematics.dollars(found.formula)}." if found.formula else ""
    source = f" ({found.source})" if found.source else ""
    words = f"{escaped(unit)}: {typeset(found.text)}{formula}{escaped(source)}"
    return f"**{escaped(name.replace('_', ' '))}**{words}"
