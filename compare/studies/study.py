"""Study: the declaration behind a command: what is solved, what is claimed, what its page shows."""

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import xarray

from ..report.page import Block, Findings, Page, Plot, Section, Text
from ..solving import parameter_grid
from ..solving.cost import Cost
from ..solving.outcome import Outcome
from ..solving.parameter_grid import Rectangle
from ..solving.task import Batch, SceneTask, Task
from ..solving.unsolved import Unsolved
from ..statistics import finding, griderror
from ..statistics.finding import FAILS, Claim, Finding
from ..statistics.jackknife import judge

SETTING = "Setting"


class Study:
    """A question, declared: what is solved for it, what is claimed, and what its page shows.

    A study overrides what differs: `rectangles` and `claims` are enough. One whose tasks are no rectangles
    overrides `batches` and `answers`; one that measures claims in its own way, `findings`.

    command : name of the command, and of the Python function
    title, about : for people
    place : folder of the page below that of the command; empty if that folder itself
    """

    command: ClassVar[str] = "study"
    title: str = ""
    about: str = ""
    place: str = ""

    @property
    def doubts(self) -> tuple[str, ...]:
        """Doubts about what is asked, as sentences: what is to be looked at before any number is used."""
        return ()

    @property
    def notes(self) -> tuple[str, ...]:
        """Notes on what was read for what is asked."""
        return ()

    @property
    def own(self) -> Sequence[SceneTask]:
        """Contacts of scenes as they stand, without whose answer a command has failed."""
        return ()

    def unsolved(self, outcomes: Mapping[Task, Outcome]) -> Unsolved:
        """Contacts of the rectangles without an answer."""
        return Unsolved.of(parameter_grid.contacts_of(self.rectangles()), outcomes, self.own)

    @property
    def inputs(self) -> Mapping[str, Any]:
        """Inputs of the command, as JSON can hold them."""
        return {}

    def rectangles(self) -> Mapping[str, Rectangle]:
        """Rectangles of contacts by name. Raises InvalidInput, Refused."""
        return {}

    def claims(self) -> Sequence[Claim]:
        """Claims that are measured on the rectangles."""
        return ()

    def cost(self) -> Cost:
        """Upper bound of the cost of all solves; rectangles are counted before their tasks are built."""
        if rectangles := self.rectangles():
            return sum((each.cost for each in rectangles.values()), Cost())
        return Cost.of(task for batch in self.batches() for task in batch.tasks)

    def batches(self) -> Sequence[Batch]:
        """Everything that is solved."""
        return (Batch(parameter_grid.tasks_of(self.rectangles())),)

    def answers(self, outcomes: Mapping[Task, Outcome]) -> xarray.DataTree:
        """Everything that was solved, labelled."""
        return parameter_grid.tree(self.rectangles(), outcomes)

    def findings(self, answers: xarray.DataTree) -> Sequence[Finding]:
        """Findings on each claim."""
        return [judge(claim, answers) for claim in self.claims()]

    def failed(self, findings: Sequence[Finding]) -> bool:
        """Whether the command ends with status 1: a law or a stored value does not hold."""
        return any(each.stated == FAILS for each in findings)

    def plots(self, answers: xarray.DataTree, findings: Sequence[Finding]) -> Sequence[Plot]:
        """Figures of the page."""
        return ()

    def answer(self, findings: Sequence[Finding]) -> Sequence[str]:
        """The answer: a sentence for each claim, those that contradict included."""
        return finding.sentences(findings)

    def blocks(
        self, answers: xarray.DataTree, findings: Sequence[Finding], plots: Sequence[Plot]
    ) -> Sequence[Block]:
        """Figures, findings and other tables, alone or in sections."""
        return [*plots, Findings(findings)]

    def setting(self, answers: xarray.DataTree) -> Sequence[Block]:
        """Setting of the study: what was solved and how it is judged; it stands last on the page."""
        return [Text(self.about)] if self.about else []

    def page(self, answers: xarray.DataTree, findings: Sequence[Finding]) -> Page:
        """Page with the answer first, what its grids leave uncertain among it, and the setting last."""
        blocks = self.blocks(answers, findings, self.plots(answers, findings))
        setting = self.setting(answers)
        last = [Section(SETTING, setting)] if setting else []
        return Page(self.title, griderror.told(answers, self.answer(findings)), [*blocks, *last])
