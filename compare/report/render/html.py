"""A page as one HTML file that needs nothing else, offline and without scripts; a part of it for a notebook."""

import base64
import hashlib
from collections.abc import Mapping
from html import escape
from pathlib import Path
from typing import Any

import jinja2
from markupsafe import Markup
from pandas import DataFrame

from scene.printable import printable

from ..manifest import FINDINGS, made
from ..page import Page, Plot, Section, Table
from ..plots.rendering import Picture
from .columns import columns, regimes_once
from .symbols import symbolic

MOST_ROWS = 400  # a longer table is no reading
# Digits of numbers that are there to be looked up.
DIGITS = 6
# A word that is longer may be broken into lines.
LONG = 30
# A browser loads nothing for a page, and runs and applies nothing that is not allowed by its digest.
POLICY = "default-src 'none'; base-uri 'none'; form-action 'none'; img-src data:"


def text(page: Page, pictures: Mapping[str, Picture]) -> str:
    """The page; pictures : of the plots, by name."""
    style = _template("style.html").render()
    shown = {table.name for table in page.every(Table)}
    behind = {name: frame for name, frame in page.tables() if name not in shown}
    made_of = _template("page.html").render(
        page=page,
        policy=f"{POLICY}; style-src {digest(style)}",
        style=Markup(style),
        contents=[
            (anchor("section", each.title), each.title) for each in page.blocks if isinstance(each, Section)
        ],
        data={name: _rows(frame) for name, frame in behind.items()},
        about={**page.about, **made()},
        **_content(True, pictures, {plot.name for plot in page.every(Plot)}),
    )
    return printable(made_of)


def digest(text: str) -> str:
    """A script or a style of a page as its policy names it."""
    return f"'sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()}'"


def fragment(page: Page, path: Path | None = None) -> str:
    """Answer, findings and tables of a page for a notebook, without figures; path : of the page, named last."""
    content = _content(False, {}, set())
    return printable(_template("fragment.html").render(page=page, path=path and path.resolve(), **content))


def anchor(*parts: str) -> str:
    """Parts as one anchor: a fragment that needs no escape and begins with a letter."""
    return "-".join("".join(c if c.isascii() and c.isalnum() else "-" for c in part) for part in parts if part)


def _content(whole, pictures, figures) -> dict[str, Any]:
    """Functions and values for the templates. whole : whether the page is a file of its own"""
    return {
        "kind": lambda block: type(block).__name__,
        "anchor": anchor,
        "whole": whole,
        "pictures": pictures,
        "figures": figures,
        "symbolic": symbolic,
        "regimes_once": regimes_once,
        "rows": lambda table: _rows(table.frame, people=True),
        "image": lambda picture: base64.b64encode(picture.files["png"]).decode(),
        "FINDINGS": FINDINGS,
    }


def _rows(frame: DataFrame, people: bool = False) -> Markup | None:
    """Head and body of a table; None of one that is too long to be read."""
    if len(frame) > MOST_ROWS:
        return None
    shown = columns(frame) if people else columns(frame, DIGITS, merged=False)
    heads = "".join(f'<th scope="col">{escape(column.title)}</th>' for column in shown)
    cells = [[_cell(column, *each) for each in zip(column.values, column.texts, strict=True)] for column in shown]
    body = "\n".join(f"<tr>{''.join(row)}</tr>" for row in zip(*cells, strict=True))
    return Markup(f"<thead><tr>{heads}</tr></thead>\n<tbody>\n{body}\n</tbody>")


def _cell(column, value, shown):
    label = f' data-label="{escape(column.title)}"'
    if len(shown) > LONG and not isinstance(value, float):
        return f'<td class="words"{label}>{escape(symbolic(shown))}</td>'
    return f"<td{label}>{escape(shown)}</td>"


def _template(name: str) -> jinja2.Template:
    environment = jinja2.Environment(
        loader=jinja2.PackageLoader("compare.report", "render"),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    return environment.get_template(name)
