"""Pages: four renderers of `page.Page`, and what lies beside a page: figures and tables."""

from collections.abc import Callable, Mapping, Sequence
from operator import methodcaller
from pathlib import Path
from types import ModuleType
from typing import Any

from ...solving.store import write as write_whole
from ...statistics import finding
from ...statistics.finding import Finding
from .. import csvfiles
from ..manifest import FINDINGS
from ..page import Page, Plot
from ..plots.rendering import FORMS, Picture, picture
from . import html, markdown, terminal

__all__ = ["FILES", "FORMATS", "FORMS", "html", "terminal", "write", "write_picture", "write_tables"]

_RENDERERS: Mapping[str, tuple[str, ModuleType]] = {
    "html": ("report.html", html),
    "markdown": ("report.md", markdown),
}
FORMATS = tuple(_RENDERERS)
FILES = tuple(name for name, _ in _RENDERERS.values())


def write(
    page: Page,
    findings: Sequence[Finding],
    folder: Path,
    format: str = "html",
    forms: Sequence[str] = ("png",),
    told: Callable[[str], Any] = lambda name: None,
) -> Path:
    """Write a page with its figures and tables; returns the file of the page.

    findings : that findings.csv has, of the page and beyond it
    forms : of the figures; a PNG is always written
    told : called with the name of each figure once it is drawn

    Raises OSError, InvalidInput where the look has text too large for a figure.
    """
    write_tables(page, findings, folder)
    pictures: dict[str, Picture] = {}
    for plot in page.every(Plot):
        pictures[plot.name] = picture(plot, forms)
        write_picture(pictures[plot.name], folder / plot.name)
        told(plot.name)
    name, renderer = _RENDERERS[format]
    csvfiles.write_text(folder / name, renderer.text(page, pictures))
    return folder / name


def write_picture(drawn: Picture, path: Path) -> list[Path]:
    """Write every form of a figure; path : without its ending. Returns the files. Raises OSError."""
    path.parent.mkdir(parents=True, exist_ok=True)
    files = {path.with_name(f"{path.name}.{form}"): content for form, content in drawn.files.items()}
    for file, content in files.items():
        write_whole(file, methodcaller("write", content))
    return list(files)


def write_tables(page: Page, findings: Sequence[Finding], folder: Path) -> None:
    """Write every table of a page as CSV, and all findings. Raises OSError."""
    texts: dict[str, str] = {}
    for name, frame in ((FINDINGS, finding.table(findings)), *page.tables()):
        text = csvfiles.text(frame)
        if texts.setdefault(name, text) != text:
            raise ValueError(f"two tables of the page have the name {name!r}")
    for name, text in texts.items():
        csvfiles.write_text(folder / f"{name}.csv", text)
