"""Pages: renderers of `page.Page`, and what lies beside a page: figures and tables."""

from collections.abc import Callable, Mapping, Sequence
from operator import methodcaller
from pathlib import Path
from typing import Any

from ...solving.folders import write as write_whole
from ...statistics import finding
from ...statistics.finding import Finding
from .. import csvfiles
from ..manifest import FINDINGS
from ..page import Page, Plot
from ..plots.rendering import FORMS, Picture, picture
from . import html, terminal

__all__ = ["FORMS", "PAGE", "files", "html", "tables", "terminal", "write"]

PAGE = "report.html"


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
    found = tables(page, findings)
    pictures: dict[str, Picture] = {}
    for plot in page.every(Plot):
        pictures[plot.name] = picture(plot, forms)
        found |= pictures[plot.name].named(plot.name)
        told(plot.name)
    return found | {PAGE: html.text(page, pictures).encode()}


def tables(page: Page, findings: Sequence[Finding]) -> dict[str, bytes]:
    """Every table of a page as CSV, and all findings, as files by name."""
    found: dict[str, bytes] = {}
    for name, frame in ((FINDINGS, finding.table(findings)), *page.tables()):
        content = csvfiles.text(frame).encode()
        if found.setdefault(f"{name}.csv", content) != content:
            raise ValueError(f"two tables of the page have the name {name!r}")
    return found


def write(found: Mapping[str, bytes], folder: Path) -> list[Path]:
    """Write files into a folder, which is made; returns their paths. Raises OSError."""
    for name, content in found.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        write_whole(folder / name, methodcaller("write", content))
    return [folder / name for name in found]
