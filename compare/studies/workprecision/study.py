"""Cost of accuracy in time: `crosscheck workprecision`."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, Self

import xarray

from scene import Solver
from scene.reading import InvalidInput

from ...library import ready
from ...models.table import Model, ModelLike, listed, named
from ...report.page import Block, Findings, Section, Text
from ...solving.outcome import Outcome
from ...solving.task import Batch, Task
from ...solving.words import sentences
from ...statistics.finding import Finding
from ..study import Judgement, Study
from . import models
from .convergence import Convergence
from .diagram import Diagram
from .regimes import QUICK, SIZES

DIAGRAMS: Mapping[str, Diagram] = {each.name: each for each in (models.MODELS, models.SURFACES)}
ALL, MODELS = "all", "models"
ABOUT = """Errors are relative. The reference is a closed form where there is one, elsewhere a far finer solution,
whose own error is the grey band; points within the band are hollow and are known to be no worse than that.
Times are processor seconds of one thread from the scene to the result, the least of several repeats, each
solve alone in a process of its own, after one that loads compiled code. A setting reaches an error only if
all finer ones of its ladder do; no finer one confirms the finest. A solve that fails is NaN, with its
reason in the table."""


@dataclass(frozen=True)
class WorkPrecision(Study):
    """Diagrams of error over time.

    names : of DIAGRAMS
    models : others that are measured too, in the smooth contacts of the diagram of that name
    size : quick, a few contacts on short ladders, a minute or two a diagram; standard, all contacts on short
        ladders; full, all contacts on long ladders, hours
    """

    names: tuple[str, ...]
    size: str = QUICK
    models: tuple[Solver, ...] = ()

    command: ClassVar[str] = "workprecision"
    title = "What accuracy costs in time"
    about = ABOUT

    @classmethod
    def of(cls, names: str | Sequence[str], size: str = QUICK, models: Sequence[ModelLike] | None = None) -> Self:
        """Diagrams by name, or "all". Raises InvalidInput with what is allowed.

        models : beside MDR, CorrectedMDR and BEM, in the smooth contacts of the diagram `models`
        """
        asked = (names,) if isinstance(names, str) else tuple(names)
        for name in asked:
            if name not in (*DIAGRAMS, ALL):
                raise InvalidInput(f"NAME = {name}: allowed are {', '.join(DIAGRAMS)} and {ALL}")
        if size not in SIZES:
            raise InvalidInput(f"size = {size}: allowed are {', '.join(SIZES)}")
        chosen = tuple(DIAGRAMS) if ALL in asked else tuple(dict.fromkeys(asked))
        several = listed(models)
        if several and MODELS not in chosen:
            raise InvalidInput(f"models: of the diagram {MODELS} alone, and not of {', '.join(chosen)}")
        others = (Model.of(named(each, {}) if isinstance(each, str) else each).solver for each in several)
        return cls(chosen, size, tuple(others))

    @property
    def inputs(self) -> Mapping[str, Any]:
        """Names and size."""
        others = {"models": [each.name for each in self.models]} if self.models else {}
        return {"names": list(self.names), "size": self.size} | others

    @property
    def diagrams(self) -> list[Diagram]:
        """Diagrams in the order they were asked for."""
        return [DIAGRAMS[name] for name in self.names]

    def _contacts(self, diagram):
        found = diagram.contacts(self.size)
        others = self.models if diagram.name == MODELS else ()
        return [each.beside(others) if isinstance(each, Convergence) else each for each in found]

    def batches(self) -> Sequence[Batch]:
        """First everything that is not timed; each task once."""
        contacts = [each for diagram in self.diagrams for each in self._contacts(diagram)]
        untimed = dict.fromkeys(task for each in contacts for task in each.untimed)
        timed = dict.fromkeys(task for each in contacts for task in each.timed)
        return Batch(tuple(untimed)), Batch(tuple(timed), timed=True)

    def answers(self, outcomes: Mapping[Task, Outcome]) -> xarray.DataTree:
        """Datasets of all diagrams at /diagram/contact, of rough means at /diagram/contact/solver."""
        return xarray.DataTree.from_dict(
            {
                f"/{diagram.name}/{name}": dataset
                for diagram in self.diagrams
                for contact in self._contacts(diagram)
                for name, dataset in contact.datasets(outcomes).items()
            }
        )

    def judge(self, answers: xarray.DataTree) -> Judgement:
        """Findings of all diagrams; a section and a statement for each claim of each."""
        findings: list[Finding] = []
        answer: list[str] = []
        blocks: list[Block] = []
        for each in self.diagrams:
            own = each.judge(answers.children[each.name])
            heading = f"{each.title}: " if len(self.diagrams) > 1 else ""
            answer += [f"{heading}{sentence}" for sentence in sentences(own.findings)]
            blocks.append(Section(each.title, [*own.plots, *own.tables, Findings(own.findings)]))
            findings += own.findings
        return Judgement(findings, answer, blocks, self.setting)

    @property
    def setting(self) -> Sequence[Block]:
        """Meaning of errors and times, and the contacts of each diagram."""
        return [Text(ABOUT)] + [
            Section(f"Contacts of the diagram: {each.title}", [Text(ready.DIAGRAMS[each.name].about)])
            for each in self.diagrams
        ]
