"""The page of work-precision diagrams: what to do, figures, tables beside it."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..figures import workprecision, workprecision_costs, workprecision_models, workprecision_surfaces
from ..glossary import Definitions
from ..illustration import Illustration, illustrate, sheets_of
from ..publish import render, write_text
from ..sheets import Sheet, reading
from ..sweep import SweepResult
from . import answers
from .diagram import Inquiry

PAGE = "workprecision.html"
# Those that are not drawn as panels of error over time.
FIGURES = {"models": workprecision_models, "surfaces": workprecision_surfaces, "costs": workprecision_costs}
# What is asked of the models, each with a figure and a table of its own, and the quantities that answer it.
ASKED = {"friction": ("friction",), "depth or force": ("depth", "force")}


@dataclass(frozen=True)
class Chapter:
    """One inquiry on the page.

    advice : what to do
    figures : none where nothing could be drawn
    tables : in words, by title
    """

    name: str
    title: str
    about: str
    advice: str
    figures: tuple[Illustration, ...]
    tables: Mapping[str, Sequence[Mapping[str, str]]]

    @property
    def anchor(self) -> str:
        """On the page."""
        return f"inquiry-{self.name}"

    @property
    def data(self) -> list[Sheet]:
        """All that its figures show."""
        return sheets_of(self.figures)

    @property
    def sheets(self) -> list[str]:
        """Names of its CSV files."""
        return [sheet.name.removesuffix(".csv") for sheet in self.data]


def chapter(folder: Path, inquiry: Inquiry, found: Any) -> Chapter:
    """Write the figures and the sheets of an inquiry, and put together what the page says of it."""
    module = FIGURES.get(inquiry.name, workprecision)
    shown = {f"-{inquiry.name}" if module is workprecision else "": found}
    if module is workprecision_models:
        asked = ((what, answers.restricted(found, names)) for what, names in ASKED.items())
        shown = {f"-{what.split()[0]}": some for what, some in asked if some}
    drawn = [illustrate(folder, folder, module, some, suffix) for suffix, some in shown.items()]
    return Chapter(
        inquiry.name,
        inquiry.title,
        inquiry.about,
        inquiry.advice(found),
        tuple(figure for figure in drawn if figure is not None),
        tables(inquiry, found),
    )


def tables(inquiry: Inquiry, found: Any) -> dict[str, list[dict[str, str]]]:
    """Of the models, what a wanted error takes; of all else, figures and sheets say it."""
    if inquiry.name != "models":
        return {}
    return {f"To know {what}": answers.cells(found, names) for what, names in ASKED.items()}


def write_workprecision(folder: Path, chapters: Sequence[Chapter], size: str, swept: SweepResult) -> Path:
    """Write the page, and return its path."""
    page = render(
        "workprecision.html",
        title="What accuracy costs in time",
        contents=[("summary", "What to do"), *((each.anchor, each.title) for each in chapters)],
        chapters=chapters,
        sheets=[sheet for each in chapters for sheet in each.data],
        definitions=Definitions(),
        **reading(),
        size=size,
        swept=swept,
    )
    write_text(folder / PAGE, page)
    return folder / PAGE
