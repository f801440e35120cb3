"""Text and tables of a few rows as a terminal or a page may show them: what controls one is spelt out."""

from collections.abc import Iterable, Sequence
from html import escape
from typing import Any
from unicodedata import category

LONGEST = 200  # letters of a name or a value in a message


def printable(text: str) -> str:
    r"""A text whose unprintable characters, line ends aside, are written as escapes, as \x1b; blanks are alike."""
    if text.isprintable():
        return text
    return "".join(each if each.isprintable() or each == "\n" else _escape(each) for each in text)


def brief(text: str, most: int = LONGEST) -> str:
    """A text as a printable line of at most `most` letters; the middle of a longer text is left out."""
    ends = text if len(text) <= most else text[:most] + text[-most:]
    line = printable(ends).replace("\n", "\\n")
    if len(line) <= most and ends is text:
        return line
    half = (most - 3) // 2
    return f"{line[:half]}...{line[-half:]}"


def shown(text: object) -> str:
    """A value in a message, a text in quotes, its middle left out where it is long."""
    return brief(repr(text), 80)


def _escape(letter):
    return " " if category(letter) == "Zs" else letter.encode("unicode_escape").decode("ascii")


MOST_ROWS = 60  # rows of a table that are shown


def table(rows: Iterable[Sequence[Any]], heading: Sequence[str] = (), title: str = "") -> str:
    """Rows of cells as a table in HTML.

    title : caption above the table; heading : names of the columns
    """
    from pandas import DataFrame, option_context  # only notebooks need it

    frame = DataFrame([[printable(_said(cell)) for cell in row] for row in rows], columns=heading or None)
    with option_context("display.max_colwidth", None):
        lines = frame.to_html(
            index=False, header=bool(heading), max_rows=MOST_ROWS, border=0, justify="left", na_rep=""
        )
    return (paragraph(title) if title else "") + "".join(lines.splitlines())


def plain_table(rows: Iterable[tuple[str, Any, str]], title: str = "") -> str:
    """Names, values and units as aligned lines below a title; the unit 1 is left out."""
    every = [(name, _said(value), "" if unit == "1" else unit) for name, value, unit in rows]
    width = max(len(name) for name, _, _ in every)
    lines = (f"{name:{width}}  {value} {unit}".rstrip() for name, value, unit in every)
    return printable("\n".join([title, *lines] if title else lines))


def paragraph(text: str) -> str:
    """A sentence."""
    return f"<p>{escape(printable(text))}</p>"


def _said(cell):
    return f"{cell:.6g}" if isinstance(cell, float) else str(cell)
