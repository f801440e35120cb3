"""Report: what a study came to, which shows itself on a terminal and in a notebook."""

from base64 import b64encode
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from html import escape
from pathlib import Path

import xarray
from matplotlib.figure import Figure
from pandas import DataFrame

from scene.signatures import readable

from ..figures.plot import Plot, finished
from ..figures.style import png
from ..report import render, terminal
from ..report.page import Page
from ..solving.runner import SweepResult
from ..solving.store import TRACE
from ..solving.unsolved import NONE_UNSOLVED, Unsolved
from ..statistics import finding
from ..statistics.finding import Finding
from .study import Study

SOLVED = "solved"  # folder of solved contacts, below the folder of the page
SHOWN = 3  # number of reasons that are listed for tasks that broke


@readable
@dataclass(frozen=True, repr=False)
class Report:
    """Report of a study. Printed, it is what the command prints; in a notebook, tables and figures.

    study : the question
    answers : everything that was solved, an xarray.DataTree with a Dataset for each parameter grid and solver
    judged : findings one by one; `findings` has them as a DataFrame
    page : the page, with its plots
    swept : number of tasks that were solved and reused, and what broke
    output : folder of the page and of what has been solved
    path : file of the page; None if none was written
    unsolved : contacts without an answer
    """

    study: Study
    answers: xarray.DataTree
    judged: Sequence[Finding]
    page: Page
    swept: SweepResult
    output: Path
    path: Path | None = None
    unsolved: Unsolved = NONE_UNSOLVED

    @property
    def findings(self) -> DataFrame:
        """A row for each finding, the same columns whatever command they come from."""
        return finding.table(self.judged)

    @property
    def figures(self) -> "Figures":
        """Figures by name, each drawn when it is taken out; a notebook shows them."""
        return Figures(tuple(self.page.every(Plot)))

    @property
    def failed(self) -> bool:
        """Whether a task broke, many contacts or a scene's own have no answer, or what has to hold does not."""
        return bool(self.swept.faults) or self.unsolved.serious or self.study.failed(self.judged)

    @property
    def doubts(self) -> Sequence[str]:
        """Doubts, and contacts without an answer, as they stand before the answer."""
        return self.page.doubts

    @property
    def faults(self) -> list[str]:
        """Lines on tasks that broke."""
        return faults(self.swept, self.output)

    def __str__(self) -> str:
        return terminal.text(self.page, self.path, whole=False)

    __repr__ = __str__

    @property
    def details(self) -> str:
        """The whole page as a terminal shows it, with every number."""
        return terminal.text(self.page, self.path)

    def _repr_html_(self) -> str:
        return render.fragment(self.page, self.path)


@dataclass(frozen=True, repr=False)
class Figures(Mapping[str, Figure]):
    """Figures by name, each drawn when it is taken out."""

    plots: tuple[Plot, ...]

    def __getitem__(self, name: str) -> Figure:
        return finished({each.name: each for each in self.plots}[name])

    def __iter__(self) -> Iterator[str]:
        return (plot.name for plot in self.plots)

    def __len__(self) -> int:
        return len(self.plots)

    def __repr__(self) -> str:
        return f"Figures({', '.join(self)})"

    def _repr_html_(self) -> str:
        shown = ((name, b64encode(png(figure)).decode()) for name, figure in self.items())
        return "".join(
            f'<p><img alt="{escape(name)}" src="data:image/png;base64,{image}"></p>' for name, image in shown
        )


def faults(swept: SweepResult, output: Path) -> list[str]:
    """Number of tasks that broke, the first reasons, and where the tracebacks are; empty where none broke."""
    if not swept.faults:
        return []
    lines = [f"{len(swept.faults)} of {len(swept.outcomes)} tasks broke, which is a fault of the program"]
    labels = {reason: task.label for task, reason in reversed(list(swept.faults.items()))}
    lines += [f"{label}: {reason}" for reason, label in reversed(labels.items())][:SHOWN]
    return [*lines, f"tracebacks: {(output / SOLVED).resolve()}/*{TRACE}"]
