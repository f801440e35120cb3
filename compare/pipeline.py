"""Study: one declaration a command, and the one path from its tasks to its page."""

import errno
import os
import tempfile
from base64 import b64encode
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from html import escape
from io import BytesIO
from pathlib import Path
from typing import Any, ClassVar

import xarray
from matplotlib.figure import Figure
from pandas import DataFrame

from scene import SolveError
from scene.reading import InvalidInput

from . import finding, manifest, pages, rectangle, runner
from .finding import FAILS, Claim, Finding
from .netcdf import Group, Variable, encoded, unsealed
from .outcome import Outcome
from .page import Block, Findings, Page, Plot
from .rectangle import Rectangle
from .runner import Progress, SweepResult
from .statistics.jackknife import judge
from .store import TRACE, Store, write
from .suggest import known
from .task import Batch, Task

SOLVED, RESULTS = "solved", "results.nc"
SHOWN = 3  # reasons that are said of tasks that broke
SCREEN = 110  # dots per inch of what a notebook shows


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
    def inputs(self) -> Mapping[str, Any]:
        """What was asked, as JSON can hold it."""
        return {}

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
        """Blocks of the page below the answer."""
        return [*plots, Findings(findings)]

    def page(self, answers: xarray.DataTree, findings: Sequence[Finding]) -> Page:
        """The page."""
        blocks = self.blocks(answers, findings, self.plots(answers, findings))
        return Page(self.title, self.answer(findings), blocks)


class Broken(SolveError):
    """So many tasks broke that nothing can be judged."""


@dataclass(frozen=True, repr=False)
class Report:
    """What a study came to. Printed, it is what the command prints; in a notebook, tables and figures.

    study : the question
    answers : everything that was solved, an xarray.DataTree with a Dataset for each rectangle and solver
    claims : findings one by one; `findings` has them as a DataFrame
    page : the page, with its plots
    swept : number of tasks that were solved and reused, and what broke
    output : folder of the page and of what has been solved
    path : file of the page; None if none was written
    """

    study: Study
    answers: xarray.DataTree
    claims: Sequence[Finding]
    page: Page
    swept: SweepResult
    output: Path
    path: Path | None = None

    @property
    def findings(self) -> DataFrame:
        """Findings as a DataFrame, the same columns whatever command they come from."""
        return finding.table(self.claims)

    @property
    def figures(self) -> "Figures":
        """Figures by name, each drawn when it is taken out; a notebook shows them."""
        return Figures(tuple(self.page.every(Plot)))

    @property
    def failed(self) -> bool:
        """Whether a task broke, or a law or a stored value does not hold."""
        return bool(self.swept.faults) or self.study.failed(self.claims)

    @property
    def faults(self) -> list[str]:
        """Number of tasks that broke, the first reasons, and where the tracebacks are; empty where none broke."""
        return faults(self.swept, self.output)

    def __str__(self) -> str:
        return pages.terminal.text(self.page, self.path)

    __repr__ = __str__

    def _repr_html_(self) -> str:
        return pages.notebook.fragment(self.page, self.path)


@dataclass(frozen=True, repr=False)
class Figures(Mapping[str, Figure]):
    """Figures by name, each drawn when it is taken out."""

    plots: tuple[Plot, ...]

    def __getitem__(self, name: str) -> Figure:
        from .plots import style

        plot = {each.name: each for each in self.plots}[name]
        with style.applied():
            figure = plot.figure()
        figure._repr_png_ = lambda: _png(figure)  # type: ignore[attr-defined]
        return figure

    def __iter__(self) -> Iterator[str]:
        return (plot.name for plot in self.plots)

    def __len__(self) -> int:
        return len(self.plots)

    def __repr__(self) -> str:
        return f"Figures({', '.join(self)})"

    def _repr_html_(self) -> str:
        shown = ((name, b64encode(_png(self[name])).decode()) for name in self)
        return "".join(
            f'<p><img alt="{escape(name)}" src="data:image/png;base64,{image}"></p>' for name, image in shown
        )


def _png(figure):
    from .plots import style

    image = BytesIO()
    with style.applied():
        figure.savefig(image, format="png", dpi=SCREEN)
    return image.getvalue()


@dataclass(frozen=True)
class Watch:
    """Whom a run tells how far it is.

    solving : makes what is told while tasks are solved
    writing : makes what is told of every figure while the page is written, from their number
    """

    solving: Callable[[], AbstractContextManager[Progress | None]] = nullcontext
    writing: Callable[[int], AbstractContextManager[Callable[[str], Any]]] = lambda count: nullcontext(
        lambda name: None
    )


def run(
    study: Study,
    output: str | Path,
    workers: int | None = None,
    scheduler: str | None = None,
    format: str = "html",
    figures: str = "png",
    report: bool = True,
    watch: Watch | None = None,
) -> Report:
    """Do a study from its tasks to its page; what the folder has is not solved again.

    output : folder of the page and of what has been solved
    workers : processes; as many as processors if absent
    scheduler : address of a scheduler of dask.distributed, whose workers solve then
    format : of the page, "html", "markdown" or "latex"
    figures : forms of the figures, "png", "pdf" and "svg", separated by commas; a PNG is always written
    report : whether the page and its figures are written; findings and results always are
    watch : told how far it is

    Raises Unwritable, before anything is solved, where the folder cannot be written; Broken where so many tasks
    broke that nothing can be judged.
    """
    output, watch = Path(output), watch or Watch()
    forms = tuple(dict.fromkeys(["png", *(form.strip() for form in figures.split(",") if form.strip())]))
    known("format", format, pages.FORMATS)
    for form in forms:
        known("figures", form, pages.FORMS)
    batches = study.batches()
    below = output / study.place
    _make_folders(output, [SOLVED] if any(each.tasks for each in batches) else [], study.place)
    swept = _solve(batches, output, workers, scheduler, watch)
    try:
        answers = study.answers(swept.outcomes)
        findings = study.findings(answers)
        page = study.page(answers, findings)
    except (SolveError, ValueError, ArithmeticError, LookupError) as error:
        # What is made of NaN alone raises nearly anything, and would hide what matters.
        if not swept.faults:
            raise
        whole = len(swept.faults) == len(swept.outcomes)
        what = "nothing was solved" if whole else f"what was solved cannot be judged without what broke: {error}"
        raise Broken("; ".join([what, *faults(swept, output)])) from error
    manifest.remove(below)
    store_results(below / RESULTS, answers)
    path = None
    if report:
        with watch.writing(len(list(page.every(Plot)))) as told:
            path = pages.write(page, findings, below, format, forms, told)
    else:
        for name in pages.FILES:  # of an earlier run, whose findings these are no longer
            (below / name).unlink(missing_ok=True)
        pages.write_tables(page, findings, below)
    manifest.stamp(below, study, page, swept, os.path.relpath(output / SOLVED, below))
    return Report(study, answers, findings, page, swept, output, path)


def faults(swept: SweepResult, output: Path) -> list[str]:
    """Number of tasks that broke, the first reasons, and where the tracebacks are; empty where none broke."""
    if not swept.faults:
        return []
    lines = [f"{len(swept.faults)} of {len(swept.outcomes)} tasks broke, which is a fault of the program"]
    told = {reason: task.label for task, reason in reversed(list(swept.faults.items()))}
    lines += [f"{label}: {reason}" for reason, label in reversed(told.items())][:SHOWN]
    return [*lines, f"tracebacks: {(output / SOLVED).resolve()}/*{TRACE}"]


def store_results(path: Path, answers: xarray.DataTree) -> None:
    """Write everything that was solved as one netCDF-4 file, whole or not at all. Raises OSError."""
    content = encoded(_group(answers))
    write(path, lambda file: file.write(content))


def _group(node: xarray.DataTree) -> Group:
    """A node with all below it, as the writer takes it, which is ten times as fast as that of xarray."""
    dataset = node.to_dataset(inherit=False)
    variables = {}
    for name, each in dataset.variables.items():
        values = each.values.astype(object) if each.dtype.kind == "U" else each.values
        attributes = {key: str(text) for key, text in each.attrs.items() if str(text)}
        variables[str(name)] = Variable(tuple(map(str, each.dims)), values, attributes)
    below = {name: _group(child) for name, child in node.children.items()}
    texts = {str(key): str(text) for key, text in dataset.attrs.items()}
    if beside := [str(name) for name in dataset.coords if name not in dataset.dims]:
        texts["coordinates"] = " ".join(beside)  # as CF has it
    return Group(variables, texts, below)


def load(folder: str | Path) -> xarray.DataTree:
    """Everything that a command solved, as it left it in a folder: a Dataset for each rectangle and solver.

    Each single draw is there, with `status` and `reason`; units and definitions are attributes. A folder of
    several studies has each below its name.

    Raises InvalidInput where there are no results or they are damaged, OSError for what cannot be read.
    """
    folder = Path(folder)
    paths = [folder] if folder.is_file() else sorted(folder.rglob(RESULTS))
    if not folder.exists():
        raise InvalidInput(f"{folder}: no such file or folder")
    if not paths:
        raise InvalidInput(f"{folder}: no command has left results here")
    parts: dict[str, xarray.Dataset] = {}
    for path in paths:
        place = "" if path == folder or path.parent == folder else f"/{path.parent.relative_to(folder).as_posix()}"
        try:
            with xarray.open_datatree(BytesIO(unsealed(path.read_bytes())), engine="h5netcdf") as tree:
                for node in tree.subtree:
                    parts[f"{place}{node.path}".rstrip("/") or "/"] = node.to_dataset(inherit=False).load()
        except (ValueError, KeyError, TypeError, RuntimeError) as error:
            raise InvalidInput(f"{path}: is no file of results, or is damaged: {error}") from error
    return xarray.DataTree.from_dict(parts)


def _solve(batches, output, workers, scheduler, watch) -> SweepResult:
    """Solve what the folder does not have. What is timed is solved here and alone, whatever the scheduler."""
    swept = SweepResult({}, 0, 0, 0.0)
    for batch in batches:
        if not batch.tasks:
            continue
        store = Store(output / SOLVED)
        with watch.solving() as progress:
            if batch.timed:
                found = runner.sweep(batch.tasks, store, 1, progress, tasks_each=1)
            else:
                found = runner.sweep(batch.tasks, store, workers, progress, scheduler=scheduler)
        swept = swept.joined(found)
    return swept


class Unwritable(OSError):
    """A folder or a file cannot be written into; said before anything is solved."""


def _make_folders(folder, below, place):
    """Make every folder that is written into. Raises Unwritable."""
    try:
        _try_folders(folder, below, place)
    except OSError as error:
        raise Unwritable(error.errno, error.strerror, error.filename) from error


def _try_folders(folder, below, place):
    for path in (folder, *(folder / name for name in (*below, place) if name)):
        if path.exists() and not path.is_dir():
            raise NotADirectoryError(errno.ENOTDIR, "is a file, and no folder", str(path))
        path.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=path):
            pass
    for path in (folder / place / name for name in (*pages.FILES, RESULTS, manifest.NAME)):
        if path.is_dir():
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(path))
