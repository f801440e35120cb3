"""A page as files: HTML that needs nothing else, offline and without scripts, its figures, its tables as CSV."""

import base64
import hashlib
from collections.abc import Callable, Mapping, Sequence
from operator import methodcaller
from pathlib import Path
from typing import Any

import jinja2
import pandas
from markupsafe import Markup
from pandas import DataFrame

from scene.printable import printable

from ..figures.rendering import Picture, picture
from ..solving.folders import write as write_whole
from ..statistics import finding
from ..statistics.finding import Finding
from . import csvfiles
from .manifest import inside, made
from .page import Page, Plot
from .tables import claims, shown

PAGE = "report.html"
MOST_ROWS = 400  # a longer table is no reading
MOST_NARROW = 8  # columns of a table that a printed page holds without breaking words
# A browser loads nothing for a page, and runs and applies nothing that is not allowed by its digest.
POLICY = "default-src 'none'; base-uri 'none'; form-action 'none'; img-src data:; style-src"


def files(
    page: Page,
    findings: Sequence[Finding],
    forms: Sequence[str] = ("png",),
    told: Callable[[str], Any] = lambda name: None,
) -> dict[str, bytes]:
    """A page with its figures and tables, as files by name; the page comes last.

    findings : that findings.csv has, of the page and beyond it
    forms : of the figures; a PNG is always among them
    told : called with the name of each figure once it is drawn

    Raises InvalidInput where the look has text too large for a figure.
    """
    found, pictures = tables(page, findings), {}
    for plot in page.every(Plot):
        pictures[plot.name] = picture(plot, forms)
        found |= pictures[plot.name].named(plot.name)
        told(plot.name)
    return found | {PAGE: html(page, pictures).encode()}


def tables(page: Page, findings: Sequence[Finding]) -> dict[str, bytes]:
    """Every table of a page as CSV, and all findings, as files by name."""
    found: dict[str, bytes] = {}
    for name, frame in (("findings", finding.table(findings)), *page.tables()):
        content = csvfiles.text(frame).encode()
        if found.setdefault(f"{name}.csv", content) != content:
            raise ValueError(f"two tables of the page have the name {name!r}")
    return found


def write(found: Mapping[str, bytes], folder: Path) -> list[Path]:
    """Write files into a folder, which is made; returns their paths.

    Raises InvalidInput, before anything is written, of a name that leads out of the folder, and OSError.
    """
    paths = [inside(folder, name) for name in found]
    for path, content in zip(paths, found.values(), strict=True):
        path.parent.mkdir(parents=True, exist_ok=True)
        write_whole(path, methodcaller("write", content))
    return paths


def html(page: Page, pictures: Mapping[str, Picture]) -> str:
    """The page as one file; pictures : of the plots, by name"""
    return _rendered(page, whole=True, pictures=pictures, about=made())


def fragment(page: Page, path: Path | None = None) -> str:
    """Answer, findings and tables of a page for a notebook, without figures; path : of the page, named last"""
    return _rendered(page, whole=False, pictures={}, path=path and path.resolve())


def _rendered(page, **given) -> str:
    """The page by its template."""
    environment = jinja2.Environment(
        loader=jinja2.PackageLoader("compare", "report"),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    functions: dict[str, Any] = {
        "kind": lambda block: type(block).__name__,
        "policy": lambda style: f"{POLICY} 'sha256-{_base64(hashlib.sha256(style.encode()).digest())}'",
        "image": lambda drawn: _base64(drawn.files["png"]),
        "table": lambda block: None if block.long or len(block.frame) > MOST_ROWS else _table(shown(block.frame)),
        "claims": lambda block: _table(claims(block.findings)) if block.findings else None,
    }
    return printable(environment.get_template("page.html").render(page=page, **functions, **given))


def _table(frame: DataFrame) -> Markup:
    """A table of texts, all of which are escaped."""
    columns = frame.shape[1]
    wide = "wide" if columns > MOST_NARROW else None
    with pandas.option_context("display.max_colwidth", None):
        text = frame.to_html(index=False, border=0, justify="left", classes=wide, formatters=[str] * columns)
    return Markup(text.replace(' style="text-align: left;"', "", 1))  # a style that the policy forbids


def _base64(content: bytes) -> str:
    return base64.b64encode(content).decode()
