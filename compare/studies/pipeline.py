"""The one path from a study to its page: solve, judge, draw, write."""

import errno
import os
from concurrent.futures import Executor
from dataclasses import replace
from math import inf, nan
from pathlib import Path
from time import monotonic

from scene import SolveError
from scene.files.reading import InvalidInput
from scene.printable import brief
from scene.quantities import SECOND

from ..figures.plot import Plot
from ..figures.rendering import FORMS
from ..report import manifest, render
from ..solving import netcdf, runner
from ..solving.executors import counted
from ..solving.folders import Unwritable, lock, make
from ..solving.runner import Progress, SweepResult
from ..solving.store import Store
from ..solving.suggest import known
from ..statistics.multilevel import GROWTH
from .report import SOLVED, Report, faults
from .study import Study

GROWTHS = GROWTH, 2.0, 1.4  # times the surfaces that are tried in turn where time is limited


def run(
    study: Study,
    output: str | Path,
    workers: int | None = None,
    scheduler: str | None = None,
    executor: Executor | None = None,
    figure_format: str = "png",
    report: bool = True,
    yes: bool = False,
    budget: str | float | None = None,
    progress: Progress | None = None,
) -> Report:
    """Do a study from its tasks to its page; what the folder has is not solved again.

    The arguments are those of `compare.solve`; progress : told how far it is

    Raises Refused, before a task is built, for more than a day without a yes; Unwritable, before anything is
    solved, where the folder cannot be written; InvalidInput, where another run holds it; SolveError where so many
    tasks broke that nothing can be judged.
    """
    output, progress = Path(output), progress or Progress()
    forms = tuple(dict.fromkeys(["png", *(form.strip() for form in figure_format.split(",") if form.strip())]))
    for form in forms:
        known("figure_format", form, FORMS)
    limit = inf if budget is None else _seconds(budget)
    if executor is not None and (scheduler is not None or not callable(getattr(executor, "submit", None))):
        needed = "an object with submit is needed, without a scheduler"
        raise InvalidInput(f"executor = {brief(repr(executor))}: {needed}")
    cost, count = study.cost(), counted(workers)
    cost.refuse(count, yes)
    below = manifest.inside(output, study.place) if study.place else output
    if Path(study.place).parts[:1] == (SOLVED,):
        raise InvalidInput(f"place = {study.place}: this folder holds the solved contacts, choose another place")
    _make_folders(output, [SOLVED] if cost.contacts else [], study.place)
    with lock((output, below), progress.said):
        if cost.contacts:
            progress.said(str(cost))
        done = _answered(study, output, workers, scheduler, executor, yes, limit, progress)
        path = _write(done, below, forms, report, progress)
        return replace(done, path=path)


def _seconds(budget):
    """Seconds above zero, of a number or a text with a unit. Raises InvalidInput."""
    try:
        found = float(SECOND.value(budget))
    except ValueError:
        found = nan
    if not 0 < found < inf:
        raise InvalidInput(f"budget = {brief(repr(budget))}: a time above zero, as 10min or 600 s")
    return found


def _answered(study, output, workers, scheduler, executor, yes, limit, progress) -> Report:
    """Report of a study, of which nothing is written yet."""
    swept, count, began = SweepResult({}, 0, 0, 0.0), counted(workers), monotonic()
    more: Study | None = study
    try:
        while more is not None:
            more.cost().refuse(count, yes)
            if more is not study:
                progress.said(f"more surfaces: {more.cost()}")
            found = _solve(more, swept, output, workers, scheduler, executor, progress)
            study, swept = more, swept.joined(found)
            answers = study.answers(swept.outcomes)
            judged = study.judge(answers)
            # What breaks with few surfaces breaks with more.
            more = None if swept.faults else _more(study, answers, judged.findings, limit, began)
        findings, page = judged.findings, judged.page(study.title, answers)
        whole = {task: each for task, each in swept.outcomes.items() if task not in swept.faults}
        unsolved = study.unsolved(whole)
        answer, doubts = (*page.answer, *unsolved.notes), (*study.doubts, *unsolved.sentences)
        page = replace(page, answer=answer, doubts=doubts, notes=study.notes)
    except (SolveError, ValueError, ArithmeticError, LookupError) as error:
        # What is made of NaN alone raises nearly anything, and would hide what matters.
        if not swept.faults:
            raise
        what = "nothing was solved"
        if len(swept.faults) < len(swept.outcomes):
            what = f"the solved contacts cannot be judged without the broken ones: {error}"
        raise SolveError("; ".join([what, *faults(swept, output)])) from error
    return Report(study, answers, findings, page, swept, output, None, unsolved)


def _write(done, folder, forms, report, progress) -> Path | None:
    """Write a page and all beside it in place of what earlier runs wrote there; returns the file of the page.

    All is drawn before the folder is touched.
    """
    study, page, results = done.study, done.page, netcdf.packed(done.answers)
    files = {netcdf.NAME: results}
    if report:
        with progress.writing(len(list(page.every(Plot)))) as told:
            files |= render.files(page, done.judged, forms, told)
    else:
        files |= render.tables(page, done.judged)
    manifest.begin(folder, study, files)
    written = render.write(files, folder)
    solved = os.path.relpath(done.output / SOLVED, folder)
    manifest.stamp(folder, study, page, done.swept, solved, files, netcdf.digest(results))
    return written[-1] if report else None


def _more(study, answers, findings, limit, began):
    """The study with more surfaces, of which as many as fit into the time that is left; None where none do.

    More work takes as long as what was done so far.
    """
    for growth in GROWTHS:
        more = study.more(answers, findings, growth)
        if more is None:
            return None
        done, spent = study.cost().work, monotonic() - began
        if limit == inf or spent * (more.cost().work - done) <= (limit - spent) * done:
            return more
    return None


def _solve(study, had, output, workers, scheduler, executor, progress) -> SweepResult:
    """Solve what neither a sweep had nor the folder has. Timed tasks are solved here, whatever the executor."""
    swept = SweepResult({}, 0, 0, 0.0)
    for batch in study.batches():
        if tasks := [task for task in batch.tasks if task not in had.outcomes]:
            with progress.solving() as told:
                store = Store(output / SOLVED)
                found = runner.sweep(tasks, store, workers, told, batch.timed, scheduler, executor)
            swept = swept.joined(found)
    return swept


def _make_folders(folder, below, place):
    """Make every folder that is written into. Raises Unwritable."""
    try:
        for path in (folder, *(folder / name for name in (*below, place) if name)):
            if path.exists() and not path.is_dir():
                raise NotADirectoryError(errno.ENOTDIR, "is a file, and no folder", str(path))
            make(path)
        for path in (folder / place / name for name in (render.PAGE, netcdf.NAME, manifest.NAME)):
            if path.is_dir():
                raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(path))
    except OSError as error:
        raise Unwritable(error.errno, error.strerror, error.filename) from error
