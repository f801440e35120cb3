"""A job: tasks, and what becomes of their outcomes. The same job solves, recalls what is solved, and draws."""

from base64 import b64encode
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from html import escape
from io import BytesIO
from pathlib import Path
from typing import Any, Generic, NamedTuple, Protocol, TypeVar

from matplotlib.figure import Figure

from scene import SolveError, markup

from .. import manifest, sweep
from ..recalling import recall
from ..store import TRACE, Store
from ..sweep import Progress, SweepResult

SOLVED = "solved"
SHOWN = 3  # reasons, of the tasks that broke
SCREEN = 110  # dots per inch of what a notebook shows
T = TypeVar("T")


class Broken(SolveError):
    """So many tasks broke that nothing can be judged. what : that, in words; the message also tells of tasks"""

    def __init__(self, what: str, told: Sequence[str]):
        super().__init__("; ".join([what, *told]))
        self.what = what


class Heading(str):
    """A line that heads those after it."""


class Panel(NamedTuple):
    """A figure that a job can draw.

    folder : below that of the job, empty of that itself
    module : of compare.figures
    data : that its `figure`, `sheets` and `caption` take
    suffix : of all names, as of publish.draw
    """

    folder: str
    module: Any
    data: Any
    suffix: str = ""


class Round(NamedTuple):
    """Tasks solved together. alone : one after the other in a process each, as they are timed."""

    tasks: Sequence[Any]
    alone: bool = False


class Job(Protocol[T]):
    """What a command does.

    command : its name
    arguments : what is asked, as JSON can hold it; `of` makes the job of it again
    doing : what is done once everything is solved, in words
    folders, files : written below the folder that is given, and into the one that has the page
    place : of page and manifest below the folder that is given, empty of that itself
    rounds : what is solved
    """

    @property
    def command(self) -> str: ...

    @property
    def arguments(self) -> Mapping[str, Any]: ...

    @property
    def doing(self) -> str: ...

    @property
    def folders(self) -> Sequence[str]: ...

    @property
    def files(self) -> Sequence[str]: ...

    @property
    def place(self) -> str: ...

    @property
    def rounds(self) -> Sequence[Round]: ...

    def judged(self, swept: SweepResult) -> T:
        """What comes of the outcomes."""

    def write(self, folder: Path, judged: T, swept: SweepResult) -> Path | None:
        """Write page, figures and tables into the folder of the page. Returns the page, None of a job without."""

    def panels(self, judged: T) -> Iterator[Panel]:
        """Every figure."""

    def lines(self, judged: T) -> Iterator[str]:
        """What matters of it, for a terminal."""

    def tables(self, judged: T) -> Iterator[str]:
        """The same for a notebook, as HTML."""


@dataclass(frozen=True, repr=False)
class Found(Generic[T]):
    """What a job found. Printed, it is what the command prints; a notebook shows it as tables.

    judged : what came of it; of which type, the function that returned this says
    swept : outcomes by task, how many were solved and how many the folder had
    page : that was written; None of what was only recalled, and of a job that has none
    job : what was asked
    """

    judged: T
    swept: SweepResult
    page: Path | None
    job: Job[T]

    @property
    def figures(self) -> "Figures":
        """Every figure by its name, drawn when it is asked for; a notebook shows them."""
        return Figures(tuple(self.job.panels(self.judged)))

    def __str__(self) -> str:
        end = [f"\nPage: {self.page.resolve()}"] if self.page else []
        end += [f"{counted(len(self.swept.faults))} broke; swept.faults says why"] if self.swept.faults else []
        return "\n".join([*self.job.lines(self.judged), *end]).strip("\n")

    __repr__ = __str__

    def _repr_html_(self) -> str:
        end = [markup.paragraph(f"Page: {self.page}")] if self.page else []
        return "".join([*self.job.tables(self.judged), *end])


@dataclass(frozen=True, repr=False)
class Figures(Mapping[str, Figure]):
    """Figures by name, each drawn when it is taken out."""

    panels: tuple[Panel, ...]

    def __getitem__(self, name: str) -> Figure:
        from ..figures import style

        panel = self._named[name]
        with style.applied():
            return _shown(panel.module.figure(panel.data))

    def __iter__(self) -> Iterator[str]:
        return iter(self._named)

    def __len__(self) -> int:
        return len(self._named)

    def __repr__(self) -> str:
        return f"Figures({', '.join(self)})"

    def _repr_html_(self) -> str:
        return "".join(
            f'<p><img alt="{escape(name)}" src="data:image/png;base64,{b64encode(_png(self[name])).decode()}"></p>'
            for name in self
        )

    @property
    def _named(self):
        """Those that have something to show."""
        return {_name(each): each for each in self.panels if each.data is None or each.module.sheets(each.data)}


def solve(
    job: Job,
    folder: Path,
    workers: int | None = None,
    scheduler: str | None = None,
    watched: Callable[[], AbstractContextManager[Progress | None]] = nullcontext,
) -> SweepResult:
    """Solve what the folder does not have. What is timed is solved here and alone, whatever the scheduler."""
    store, swept = Store(folder / SOLVED), SweepResult({}, 0, 0, 0.0)
    for each in job.rounds:
        with watched() as progress:
            if each.alone:
                found = sweep.sweep(each.tasks, store, 1, progress, tasks_each=1)
            else:
                found = sweep.sweep(each.tasks, store, workers, progress, scheduler=scheduler)
        swept = swept.joined(found)
    return swept


def answer(job: Job[T], folder: Path, swept: SweepResult) -> Found[T]:
    """Judge what was solved, and write page and manifest. Raises Broken where too much of it broke."""
    try:
        return _answered(job, folder, swept)
    except (SolveError, ValueError, ArithmeticError, LookupError) as error:
        # What is made of NaN alone raises nearly anything, and would hide what matters.
        if not swept.faults:
            raise
        whole = len(swept.faults) == len(swept.outcomes)
        why = f": {error}" if isinstance(error, SolveError) else ""
        what = "nothing was solved" if whole else f"what was solved cannot be judged without what broke{why}"
        raise Broken(what, broken(swept, folder)) from error


def broken(swept: SweepResult, folder: Path) -> list[str]:
    """How many tasks broke, the first reasons, and where it is told; empty where none did."""
    if not swept.faults:
        return []
    lines = [f"{counted(len(swept.faults))} of {len(swept.outcomes)} broke, which is a fault of the program"]
    told = {reason: task.label for task, reason in reversed(list(swept.faults.items()))}
    lines += [f"{label}: {reason}" for reason, label in reversed(told.items())][:SHOWN]
    return [*lines, f"tracebacks: {(folder / SOLVED).resolve()}/*{TRACE}"]


def counted(count: int) -> str:
    """So many tasks, in words."""
    return f"{count} task{'' if count == 1 else 's'}"


def _answered(job, folder, swept):
    below = folder / job.place
    below.mkdir(parents=True, exist_ok=True)
    judged = job.judged(swept)
    (below / manifest.NAME).unlink(missing_ok=True)
    page = job.write(below, judged, swept)
    manifest.stamp(below, job.command, job.arguments, folder / SOLVED)
    return Found(judged, swept, page, job)


def recalled(job: Job[T], solved: Path) -> Found[T]:
    """Judge what was solved before, by whatever code. Raises Refused where some of it is missing."""
    swept = recall([task for each in job.rounds for task in each.tasks], Store(solved))
    return Found(job.judged(swept), swept, None, job)


def _name(panel):
    return "/".join(part for part in (panel.folder, panel.module.NAME + panel.suffix) if part)


def _shown(figure):
    """A figure that a notebook shows, whatever its back end."""
    figure._repr_png_ = lambda: _png(figure)
    return figure


def _png(figure):
    from ..figures import style

    image = BytesIO()
    with style.applied():
        figure.savefig(image, format="png", dpi=SCREEN)
    return image.getvalue()
