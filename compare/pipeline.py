"""Study: one declaration a command, and the one path from its tasks to its page."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, ClassVar

import xarray
from pandas import DataFrame

from scene import SolveError

from . import finding, rectangle
from .finding import VERDICTS, Claim, Finding
from .outcome import Outcome
from .page import Block, Findings, Page, Plot
from .rectangle import Rectangle
from .statistics.jackknife import judge
from .task import Batch, Task

SOLVED = "solved"


class Study:
    """A question, declared: what is solved for it, what is claimed, and what its page shows.

    A study overrides what differs: `rectangles` and `claims` are enough. One whose tasks are no rectangles overrides
    `batches` and `answers`; one that measures claims in its own way, `findings`.

    command : name of the command, and of the Python function
    title, about : for people
    place : folder of the page below that of the command; empty if that folder itself
    inputs : what was asked, as JSON can hold it
    """

    command: ClassVar[str]
    title: str = ""
    about: str = ""
    place: str = ""
    inputs: Mapping[str, Any] = {}

    def rectangles(self) -> Mapping[str, Rectangle]:
        """Rectangles of contacts by name. Raises InvalidInput, Refused."""
        return {}

    def claims(self) -> Sequence[Claim]:
        """Claims that are measured on the rectangles."""
        return ()

    def batches(self) -> Sequence[Batch]:
        """Everything that is solved."""
        return (Batch(rectangle.unique(self.rectangles())),)

    def answers(self, outcomes: Mapping[Task, Outcome]) -> xarray.DataTree:
        """Everything that was solved, labelled."""
        return rectangle.tree(self.rectangles(), outcomes)

    def findings(self, answers: xarray.DataTree) -> Sequence[Finding]:
        """What becomes of each claim."""
        return [judge(claim, answers) for claim in self.claims()]

    def plots(self, answers: xarray.DataTree, findings: Sequence[Finding]) -> Sequence[Plot]:
        """Figures of the page."""
        return ()

    def answer(self, findings: Sequence[Finding]) -> Sequence[str]:
        """The answer: a sentence for each claim, those that contradict included."""
        return finding.sentences(findings)

    def blocks(
        self, answers: xarray.DataTree, findings: Sequence[Finding], plots: Sequence[Plot]
    ) -> Sequence[Block]:
        """Blocks of the page below the answer."""
        return [*plots, Findings(findings)]

    def page(self, answers: xarray.DataTree, findings: Sequence[Finding]) -> Page:
        """The page."""
        blocks = self.blocks(answers, findings, self.plots(answers, findings))
        return Page(self.title, self.answer(findings), blocks)


@dataclass(frozen=True, repr=False)
class Report:
    """What a study came to. Printed, it is what the command prints; in a notebook, tables and figures.

    study : the question
    answers : everything that was solved, an xarray.DataTree with a Dataset for each rectangle and solver
    claims : the findings one by one
    page : the page, with its plots
    path : file of the page; None if none was written
    swept : how much was solved and reused, and what broke
    """

    study: Study
    answers: xarray.DataTree
    claims: Sequence[Finding]
    page: Page
    swept: SweepResult
    path: Path | None = None

    @property
    def findings(self) -> DataFrame:
        """Findings as a DataFrame, the same columns whatever command they come from."""
        return finding.table(self.claims)

    @property
    def figures(self) -> Mapping[str, Any]:
        """Figures by name, each drawn when it is taken out; a notebook shows them."""
        return Figures(tuple(self.page.every(Plot)))

    def __str__(self) -> str:
        from .pages import terminal

        return terminal.text(self.page, self.path)

    __repr__ = __str__

    def _repr_html_(self) -> str:
        from .pages import notebook

        return notebook.fragment(self.page, self.path)
