"""A page as files: HTML that needs nothing else, offline and without scripts, its figures, its tables as CSV."""

import base64
import hashlib
from collections.abc import Callable, Mapping, Sequence
from operator import methodcaller
from pathlib import Path
from typing import Any

import jinja2

from scene.printable import printable

from ..figures.plot import Plot, picture
from ..solving.folders import write as write_whole
from ..statistics import finding
from ..statistics.finding import Finding
from . import csvfiles
from .manifest import inside, machine, versions
from .page import Page
from .tables import claims, shown

PAGE = "report.html"


def files(
    page: Page,
    findings: Sequence[Finding],
    on_drawn: Callable[[str], Any] = lambda name: None,
) -> dict[str, bytes]:
    """A page with its figures and tables, as files by name; the page comes last.

    findings : that findings.csv has, of the page and beyond it
    on_drawn : called with the name of each figure once it is drawn
    """
    found, pictures = tables(page, findings), {}
    for plot in page.every(Plot):
        pictures[plot.name] = picture(plot)
        found |= pictures[plot.name].named(plot.name)
        on_drawn(plot.name)
    text = _rendered(page, whole=True, pictures=pictures, versions=versions(), machine=machine())
    return found | {PAGE: text.encode()}


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
    functions = {"base64": _base64, "digest": _digest, "shown": shown, "claims": claims}
    return printable(environment.get_template("page.html").render(page=page, **functions, **given))


def _digest(style: str) -> str:
    return _base64(hashlib.sha256(style.encode()).digest())


def _base64(content: bytes) -> str:
    return base64.b64encode(content).decode()
