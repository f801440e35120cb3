"""Tables of a few rows: as HTML for notebooks, all text escaped, no style but alignment, and as plain text."""

from collections.abc import Iterable, Sequence
from html import escape
from typing import Any

from .printable import printable

LONGEST = 60  # rows of a table that are shown


def table(rows: Iterable[Sequence[Any]], heading: Sequence[str] = (), title: str = "") -> str:
    """Rows of cells as a table: the first cell of a row names it, and lines of a cell stay lines.

    title : said above; heading : of the columns
    """
    every = [[_text(cell) for cell in row] for row in rows]
    caption = f'<caption style="text-align:left;font-weight:bold">{_text(title)}</caption>' if title else ""
    head = "".join(f'<th scope="col" style="text-align:left">{_text(name)}</th>' for name in heading)
    body = "".join(_row(cells) for cells in every[:LONGEST])
    if len(every) > LONGEST:
        body += f"<tr><td>and {len(every) - LONGEST} more</td></tr>"
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
