"""Study: the declaration behind a command: what is solved, what is claimed, what its page shows."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import xarray

from scene.signatures import readable

from ..figures.plot import Plot
from ..report.page import Block, Findings, Page, Section, Table, Text
from ..solving import words
from ..solving.cost import Cost
from ..solving.curve import Curve, contacts_of, tasks_of, tree
from ..solving.task import Batch, Outcome, SceneTask, Task
from ..solving.unsolved import Unsolved
from ..statistics import griderror
from ..statistics.finding import FAILS, Finding

SETTING = "Setting"


@readable
@dataclass(frozen=True)
class Judgement:
    """What the answers of a study come to, made once.

    findings : one by one
    answer : sentences; one for each claim if absent
    blocks : figures, findings and other tables of the page, alone or in sections; all findings if absent
    setting : what was solved and how it is judged; it stands last on the page
    opening : tables that stand before the answer: what a reader came for
    """

    findings: Sequence[Finding]
    answer: Sequence[str] | None = None
    blocks: Sequence[Block] | None = None
    setting: Sequence[Block] = ()
    opening: Sequence[Table] = ()

    @property
    def plots(self) -> tuple[Plot, ...]:
        """Every figure."""
        return tuple(self.page("", xarray.DataTree()).every(Plot))

    def page(self, title: str, answers: xarray.DataTree) -> Page:
        """Page with the answer first, what the grids leave uncertain among it, and the setting last."""
        sentences = words.sentences(self.findings) if self.answer is None else self.answer
        blocks = [Findings(self.findings)] if self.blocks is None else self.blocks
        last = [Section(SETTING, self.setting)] if self.setting else []
        return Page(title, griderror.with_grid_error(answers, sentences), [*blocks, *last], opening=self.opening)


class Study:
    """A question, declared: what is solved for it, what is claimed, and what its answers come to.

    A study overrides `grids` and `judge`; one whose tasks are no curves `batches` and `answers` too.

    command : name of the command, and of the Python function
    title, about : for people
    place : folder of the page below the folder of the command; empty if both are the same
    reason : why it is solved after another, see `more`
    """

    command: ClassVar[str] = "study"
    title: str = ""
    about: str = ""
    place: str = ""
    reason: str = "more surfaces"

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
        """Contacts of the grids without an answer."""
        return Unsolved.of(contacts_of(self.grids()), outcomes, self.own)

    @property
    def inputs(self) -> Mapping[str, Any]:
        """Inputs of the command, as JSON can hold them."""
        return {}

    def grids(self) -> Mapping[str, Curve]:
        """Curves of contacts by name. Raises InvalidInput, Refused."""
        return {}

    def cost(self) -> Cost:
        """Upper bound of the cost of all solves; grids are counted before their tasks are built."""
        if grids := self.grids():
            return sum((each.cost for each in grids.values()), Cost())
        return Cost.of(task for batch in self.batches() for task in batch.tasks)

    @property
    def first(self) -> "Study":
        """The part that is solved and judged before all else."""
        return self

    @property
    def rest(self) -> "Study | None":
        """The whole study, which is solved after its first part; None where this is the whole."""
        return None

    def batches(self) -> Sequence[Batch]:
        """Everything that is solved."""
        return (Batch(tasks_of(self.grids())),)

    def answers(self, outcomes: Mapping[Task, Outcome]) -> xarray.DataTree:
        """Everything that was solved, labelled."""
        return tree(self.grids(), outcomes)

    def more(self, answers: xarray.DataTree, findings: Sequence[Finding]) -> "Study | None":
        """The study with more surfaces, as its answers and findings ask for; None where they say enough."""
        return None

    def judge(self, answers: xarray.DataTree) -> Judgement:
        """What the answers come to: once for the same answers, and all of it."""
        return Judgement((), setting=self.setting)

    @property
    def setting(self) -> Sequence[Block]:
        """Setting of the study, which stands last on the page: what it is about."""
        return [Text(self.about)] if self.about else []

    def failed(self, findings: Sequence[Finding]) -> bool:
        """Whether the command ends with status 1: a law or a stored value does not hold."""
        return any(each.stated == FAILS for each in findings)
