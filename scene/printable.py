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
    """A text in one printable line of so many letters at most, its middle left out where it is longer."""
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
    """Rows of cells as a table: the first cell of a row names it, and lines of a cell stay lines.

    title : said above; heading : of the columns
    """
    every = [[_text(cell) for cell in row] for row in rows]
    caption = f'<caption style="text-align:left;font-weight:bold">{_text(title)}</caption>' if title else ""
    head = "".join(f'<th scope="col" style="text-align:left">{_text(name)}</th>' for name in heading)
    body = "".join(_row(cells) for cells in every[:MOST_ROWS])
    if len(every) > MOST_ROWS:
        body += f"<tr><td>and {len(every) - MOST_ROWS} more</td></tr>"
    return f"<table>{caption}{f'<thead><tr>{head}</tr></thead>' if head else ''}<tbody>{body}</tbody></table>"


def plain_table(rows: Iterable[tuple[str, Any, str]], title: str = "") -> str:
    """Names, values and units as aligned lines below a title; the unit 1 is left out."""
    every = [(name, _said(value), "" if unit == "1" else unit) for name, value, unit in rows]
    width = max(len(name) for name, _, _ in every)
    lines = (f"{name:{width}}  {value} {unit}".rstrip() for name, value, unit in every)
    return printable("\n".join([title, *lines] if title else lines))


def paragraph(text: str) -> str:
    """A sentence."""
    return f"<p>{_text(text)}</p>"


def _row(cells):
    name, *rest = cells or [""]
    others = "".join(f'<td style="text-align:left">{cell}</td>' for cell in rest)
    return f'<tr><th scope="row" style="text-align:left;font-weight:normal">{name}</th>{others}</tr>'


def _text(cell):
    return escape(printable(_said(cell))).replace("\n", "<br>")


def _said(cell):
    return f"{cell:.6g}" if isinstance(cell, float) else str(cell)
