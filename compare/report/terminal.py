"""A page as plain text, which a command prints: doubts, the answer, findings and short tables."""

import textwrap
from collections.abc import Iterator
from pathlib import Path

from pandas import DataFrame
from rich.console import Console
from rich.table import Table as Printed
from rich.text import Text as Words

from scene.printable import printable

from .page import Findings, Page, Section, Table, Text
from .tables import claims, shown

WIDTH = 100
MORE = "Every number stands in findings.csv; -v prints the whole page, as `report.details` does in Python."
# Rows of the longest table that is printed, and letters of its lines.
MOST_ROWS, WIDEST = 100, 140


def text(page: Page, path: Path | None = None, whole: bool = True) -> str:
    """The page, or what it begins with: the opening in words, or else the answer with what stands above sections.

    path : of its file, named at the end; whole : whether sections follow, and numbers an opening
    """
    above = [each for each in page.blocks if not (page.opening or isinstance(each, Section))]
    blocks = page.blocks if whole else above
    parts = [
        _headed(page.title, "="),
        *map(_filled, page.first),
        *_blocks(page.opening, "-"),
        "\n".join(map(_filled, page.answer)),
        *_blocks(blocks, "-"),
        MORE if len(blocks) < len(page.blocks) else "",
        f"Page: {path.resolve()}" if path else "",
    ]
    return printable("\n\n".join(filter(None, parts)))


def _blocks(blocks, rule) -> Iterator[str]:
    for block in blocks:
        match block:
            case Text():
                yield "\n\n".join(map(_filled, block.lines)).replace("\n\n- ", "\n- ")
            case Table() if not block.long and len(block.frame) <= MOST_ROWS:
                yield _captioned(block.caption, shown(block.frame))
            case Findings(findings, caption) if findings:
                yield _captioned(caption, claims(findings, details=False))
            case Section(title, inside):
                if parts := list(filter(None, _blocks(inside, ""))):
                    yield "\n\n".join([_headed(title, rule), *parts])


def _captioned(caption: str, frame: DataFrame) -> str:
    """A table below its caption; long texts are broken into lines."""
    printed = Printed(box=None, pad_edge=False)
    for head, cells in frame.items():
        one_word = not any(" " in cell for cell in cells)
        printed.add_column(
            Words(head), overflow="fold", min_width=max(map(len, cells), default=0) if one_word else None
        )
    for row in frame.itertuples(index=False, name=None):
        printed.add_row(*map(Words, row))
    console = Console(width=WIDEST, color_system=None, force_jupyter=False)
    with console.capture() as captured:
        console.print(printed, crop=False)
    lines = captured.get().splitlines()
    return "\n".join(filter(None, [_filled(caption), *map(str.rstrip, lines)]))


def _headed(title, rule):
    return f"{title}\n{rule * len(title)}" if rule else title


def _filled(words):
    indent = "  " if words.startswith("- ") else ""
    return textwrap.fill(words, WIDTH, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False)
