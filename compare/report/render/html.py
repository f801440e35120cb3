"""A page as one HTML file that needs nothing else: images and tables inside, offline and without scripts."""

import base64
from collections.abc import Mapping
from html import escape
from typing import Any
from urllib.parse import quote

import jinja2
from markupsafe import Markup
from pandas import DataFrame

from ...solving.vocabulary import Term, entry, stem
from ..manifest import FINDINGS, made
from ..page import Page, Plot, Section, Table
from ..plots.rendering import Picture
from . import mathematics, prose
from .columns import columns, regimes_once

# A longer table is no reading, and a larger file is not put into the page.
MOST_ROWS, MOST_BYTES = 400, 300_000
# Digits of numbers that are there to be looked up.
DIGITS = 6
# Need no escape within a data URI.
SAFE = " ,;:/()[]{}=+*@!'~?|^$&"
# A word that is longer may be broken into lines.
LONG = 30


def text(page: Page, pictures: Mapping[str, Picture], tables: Mapping[str, str]) -> str:
    """The page.

    pictures : of the plots, by name; tables : text of every CSV file beside the page, by name
    """
    used: dict[str, Term] = {}
    shown = {table.name for table in page.every(Table)}
    behind = {name: frame for name, frame in page.tables() if name not in shown}
    return _template("page.html").render(
        page=page,
        contents=[
            (anchor("section", each.title), each.title) for each in page.blocks if isinstance(each, Section)
        ],
        data={name: _rows(frame, used) for name, frame in behind.items()},
        about={**page.about, **made()},
        **_content(used, pictures, tables, {plot.name for plot in page.every(Plot)}),
    )


def fragment(page: Page) -> str:
    """Answer, findings and tables of a page, without its figures, as a part of another page."""
    return _template("fragment.html").render(page=page, **_content(None, {}, {}, set()))


def anchor(*parts: str) -> str:
    """Parts as one anchor: a fragment that needs no escape and begins with a letter."""
    return "-".join("".join(c if c.isascii() and c.isalnum() else "-" for c in part) for part in parts if part)


def _content(used, pictures, tables, figures) -> dict[str, Any]:
    """Functions and values for the templates. used : terms that the page defines; None without definitions"""
    return {
        "kind": lambda block: type(block).__name__,
        "anchor": anchor,
        "definitions": used,
        "pictures": pictures,
        "figures": figures,
        "prose": lambda markdown: Markup(prose.html(markdown)),
        "typeset": lambda words: Markup(_typeset(words)),
        "regimes_once": regimes_once,
        "mathml": lambda latex: Markup(mathematics.mathml(latex)),
        "rows": lambda table: _rows(table.frame, used, people=True),
        "head": lambda label, name: Markup(_head(label, name, used)),
        "image": lambda picture: base64.b64encode(picture.files["png"]).decode(),
        "download": lambda name: _download(name, tables),
        "FINDINGS": FINDINGS,
    }


def _rows(frame: DataFrame, used: dict[str, Term] | None, people: bool = False) -> Markup | None:
    """Head and body of a table; None of one that is too long to be read."""
    if len(frame) > MOST_ROWS:
        return None
    shown = columns(frame) if people else columns(frame, DIGITS, merged=False)
    heads = "".join(_head(column.title, column.name, used) for column in shown)
    cells = [[_cell(column, *each) for each in zip(column.values, column.texts, strict=True)] for column in shown]
    body = "\n".join(f"<tr>{''.join(row)}</tr>" for row in zip(*cells, strict=True))
    return Markup(f"<thead><tr>{heads}</tr></thead>\n<tbody>\n{body}\n</tbody>")


def _head(title, name, used):
    """Head of a column, with a link to its definition, which the page then has."""
    whose, mark = stem(name), ""
    if used is not None and (found := entry(whose)) is not None:
        used[whose] = found
        mark = f'<a class="mark" href="#{anchor("def", whose)}" aria-label="Definition: {escape(title)}">?</a>'
    return f'<th scope="col"><span class="label">{escape(title)}</span>{mark}</th>'


def _cell(column, value, shown):
    label = f' data-label="{escape(column.title)}"'
    if isinstance(value, float):
        return f'<td class="number"{label} data-value="{value!r}">{escape(shown)}</td>'
    if len(shown) > LONG:
        return f'<td class="words"{label}>{_typeset(shown)}</td>'
    return f"<td{label}>{escape(shown)}</td>"


def _typeset(words):
    return mathematics.typeset(words, escape, mathematics.mathml)


def _download(name: str, tables: Mapping[str, str]) -> str:
    """A table as a file within the page; empty of a large one, which lies beside it alone."""
    content = tables[name]
    if len(content) > MOST_BYTES:
        return ""
    return f"data:text/csv;charset=utf-8,{quote(content, safe=SAFE)}"


def _template(name: str) -> jinja2.Template:
    environment = jinja2.Environment(
        loader=jinja2.PackageLoader("compare.report", "render"),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    return environment.get_template(name)
