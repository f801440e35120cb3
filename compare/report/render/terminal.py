"""A page as plain text, which a command prints: doubts, the answer, findings and short tables."""

import textwrap
from collections.abc import Iterator
from pathlib import Path

from scene.printable import printable

from ...statistics.finding import Finding
from ..page import Findings, Page, Plot, Section, Table, Text
from .columns import LOW, columns

WIDTH = 100
MORE = "Every number stands on the page; -v prints it too, as `report.details` does in Python."
# Rows of the longest table that is printed, and letters of a line.
MOST_ROWS, WIDEST = 100, 200


def text(page: Page, path: Path | None = None, whole: bool = True) -> str:
    """The page; path : of its file, named at the end; whole : whether numbers follow an opening in words."""
    parts = [
        _headed(page.title, "="),
        *map(_filled, page.first),
        *map(_filled, page.opening),
        *map(_filled, page.answer),
        *(_blocks(page.blocks, "-") if whole or not page.opening else [MORE]),
    ]
    if path is not None:
        parts.append(f"Page: {path.resolve()}")
    return printable("\n\n".join(part for part in parts if part))


def _blocks(blocks, rule) -> Iterator[str]:
    for block in blocks:
        match block:
            case Text():
                yield "\n\n".join(
                    "\n".join(_filled(line, 2 * line.startswith("- ")) for line in part) for part in block.parts
                )
            case Table() if not block.long and len(block.frame) <= MOST_ROWS:
                parts = ["\n".join(part) for part in _table(block.frame)]
                yield "\n".join(filter(None, [_filled(block.caption), "\n\n".join(parts)]))
            case Findings(findings, caption):
                yield "\n".join([*([_filled(caption)] if caption else []), *_findings(findings)])
            case Section(title, inside):
                parts = [part for part in _blocks(inside, "") if part]
                if parts:
                    yield "\n\n".join([_headed(title, rule), *parts])
            case Plot() | Table():
                pass


def _findings(findings) -> Iterator[str]:
    """Each claim, and below it a line for each place: verdict, place, number found, reason."""
    claims: dict[tuple[str, str], list[Finding]] = {}
    for each in findings:
        claims.setdefault((each.claim.sentence, each.claim.tested), []).append(each)
    for (claim, tested), found in claims.items():
        yield _filled(f"{claim}{f' (tested against {tested})' if tested else ''}:", 2)
        for each in found:
            place = " ".join(part for part in (each.dimension, each.where) if part)
            reason = f"; {each.why}" if each.why else ""
            yield _filled(f"  {each.verdict:<9}  {place}: {each.found()}{reason}", 13)


def _table(frame) -> Iterator[list[str]]:
    """Lines of a table; one that is too wide in parts, each of which begins with the columns that say where."""
    aligned, told = [], [name for name in frame if f"{name}{LOW}" in frame]
    for each in columns(frame):
        cells = [each.title, *(text.replace("\n", " ") for text in each.texts)]
        side, width = str.rjust if each.numeric else str.ljust, max(map(len, cells))
        aligned.append((each.name, [side(cell, width) for cell in cells]))
    places = [cells for name, cells in aligned[: list(frame).index(told[0])]] if told else []
    part: list[list[str]] = []
    for _, cells in aligned:
        if part != places and sum(len(one[0]) + 2 for one in [*part, cells]) > WIDEST + 2:
            yield _lines(part)
            part = [*places]
        part.append(cells)
    yield _lines(part)


def _lines(aligned) -> list[str]:
    return ["  ".join(row).rstrip() for row in zip(*aligned, strict=True)]


def _headed(title, rule):
    return f"{title}\n{rule * len(title)}" if rule else title


def _filled(words, indent=0):
    return textwrap.fill(
        words, WIDTH, subsequent_indent=" " * indent, break_long_words=False, break_on_hyphens=False
    )
