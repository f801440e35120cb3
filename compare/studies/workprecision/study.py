"""Cost of accuracy in time: `crosscheck workprecision`."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, Self

import xarray

from scene.reading import InvalidInput

from ...library.ready import Listing
from ...report.page import Block, Findings, Plot, Section, Text
from ...solving.outcome import Outcome
from ...solving.task import Batch, Task
from ...statistics.finding import Finding
from ..study import Hooked
from . import elastic, extent, marching, mdr, precision, sliding
from .costs import COSTS_DIAGRAM
from .diagram import Diagram, advice
from .models import MODELS, SURFACES
from .scenes import QUICK, SIZES

# In the order of the page.
DIAGRAMS: Mapping[str, Diagram] = {
    each.name: each
    for each in (
        MODELS,
        SURFACES,
        mdr.DIAGRAM,
        elastic.DIAGRAM,
        sliding.DIAGRAM,
        marching.DIAGRAM,
        precision.DIAGRAM,
        extent.DIAGRAM,
        COSTS_DIAGRAM,
    )
}
ALL = "all"
ABOUT = """Errors are relative. The reference is a closed form where there is one, elsewhere a far finer solution,
whose own error is the grey band; points within the band are hollow and are known to be no worse than that.
Times are processor seconds of one thread from the scene to the result, the least of several repeats, each
solve alone in a process of its own, after one that loads compiled code. A setting reaches an error only if
all finer ones of its ladder do; no finer one confirms the finest. A solve that fails is NaN, with its
reason in the table."""


@dataclass(frozen=True)
class WorkPrecision(Hooked):
    """Diagrams of error over time.

    names : of DIAGRAMS
    size : quick, a few contacts on short ladders, a minute or two a diagram; standard, all contacts on short
        ladders; full, all contacts on long ladders, hours
    """

    names: tuple[str, ...]
    size: str = QUICK

    command: ClassVar[str] = "workprecision"
    title = "What accuracy costs in time"
    about = ABOUT

    @classmethod
    def of(cls, names: str | Sequence[str], size: str = QUICK) -> Self:
        """Diagrams by name, or "all". Raises InvalidInput with what is allowed."""
        asked = (names,) if isinstance(names, str) else tuple(names)
        for name in asked:
            if name not in (*DIAGRAMS, ALL):
                raise InvalidInput(f"NAME = {name}: allowed are {', '.join(DIAGRAMS)} and {ALL}")
        if size not in SIZES:
            raise InvalidInput(f"size = {size}: allowed are {', '.join(SIZES)}")
        return cls(tuple(DIAGRAMS) if ALL in asked else tuple(dict.fromkeys(asked)), size)

    @staticmethod
    def listing() -> Listing:
        """Diagrams to choose from."""
        return Listing(DIAGRAMS, end=f"`crosscheck workprecision NAME` measures one; {ALL}, every one of them.")

    @property
    def inputs(self) -> Mapping[str, Any]:
        """Names and size."""
        return {"names": list(self.names), "size": self.size}

    @property
    def diagrams(self) -> list[Diagram]:
        """Diagrams in the order they were asked for."""
        return [DIAGRAMS[name] for name in self.names]

    def batches(self) -> Sequence[Batch]:
        """First everything that is not timed."""
        untimed, timed = (
            tuple(dict.fromkeys(task for each in self.diagrams for task in of(each)))
            for of in (lambda each: each.untimed(self.size), lambda each: each.timed(self.size))
        )
        return Batch(untimed), Batch(timed, timed=True)

    def answers(self, outcomes: Mapping[Task, Outcome]) -> xarray.DataTree:
        """Datasets of all diagrams at /diagram/contact, of rough means at /diagram/contact/solver."""
        return xarray.DataTree.from_dict(
            {
                f"/{each.name}/{name}": dataset
                for each in self.diagrams
                for name, dataset in each.datasets(self.size, outcomes).items()
            }
        )

    def findings(self, answers: xarray.DataTree) -> list[Finding]:
        """Findings of all diagrams."""
        return [found for each in self.diagrams for found in each.findings(answers.children[each.name])]

    def plots(self, answers: xarray.DataTree, findings: Sequence[Finding]) -> list[Plot]:
        """Figures of all diagrams."""
        return [plot for each in self.diagrams for plot in each.plots(answers.children[each.name])]

    def answer(self, findings: Sequence[Finding]) -> list[str]:
        """A sentence for each claim of each diagram, from all of its findings."""
        told = []
        for each in self.diagrams:
            heading = f"{each.title}: " if len(self.diagrams) > 1 else ""
            told += [f"{heading}{sentence}" for sentence in advice(self._of(each, findings))]
        return told

    def blocks(
        self, answers: xarray.DataTree, findings: Sequence[Finding], plots: Sequence[Plot]
    ) -> Sequence[Block]:
        """A section a diagram."""
        found = []
        for each in self.diagrams:
            figures = [plot for plot in plots if plot.name.startswith(f"workprecision-{each.name}")]
            tables = each.tables(answers.children[each.name])
            found.append(Section(each.title, [*figures, *tables, Findings(self._of(each, findings))]))
        return found

    def settings(self, answers: xarray.DataTree) -> Sequence[Block]:
        """Meaning of errors and times, and the contacts of each diagram."""
        return [Text(ABOUT.replace("\n", " "))] + [
            Section(f"Contacts of the diagram: {each.title}", [Text(each.about)]) for each in self.diagrams
        ]

    @staticmethod
    def _of(diagram, findings):
        return [each for each in findings if each.claim.id.startswith(f"workprecision.{diagram.name}.")]
