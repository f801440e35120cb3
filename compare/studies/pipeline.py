"""The one path from a study to its page: solve, judge, draw, write."""

import errno
import os
from concurrent.futures import Executor
from dataclasses import replace
from functools import partial
from pathlib import Path

from scene import SolveError
from scene.files.reading import InvalidInput
from scene.printable import brief

from ..figures.plot import Plot
from ..report import manifest, render
from ..solving import netcdf, runner
from ..solving.executors import Processes, counted
from ..solving.folders import Unwritable, lock, make
from ..solving.runner import Progress, SweepResult
from ..solving.store import Store
from .report import SOLVED, Report, faults
from .study import Study


def run(
    study: Study,
    output: str | Path,
    workers: int | None = None,
    scheduler: str | None = None,
    executor: Executor | None = None,
    report: bool = True,
    yes: bool = False,
    progress: Progress | None = None,
) -> Report:
    """Do a study from its tasks to its page; what the folder has is not solved again.

    The arguments are those of `compare.solve`; progress : object that receives the state of the work

    Raises Refused, before a task is built, for more than a day without a yes; Unwritable, before anything is
    solved, where the folder cannot be written; InvalidInput, where another run holds it; SolveError where too many
    tasks broke to judge anything.
    """
    output, progress = Path(output), progress or Progress()
    if executor is not None and (scheduler is not None or not callable(getattr(executor, "submit", None))):
        needed = "an object with submit is needed, without a scheduler"
        raise InvalidInput(f"executor = {brief(repr(executor))}: {needed}")
    cost, count = study.cost(), counted(workers)
    cost.refuse(count, yes)
    below = manifest.inside(output, study.place) if study.place else output
    if Path(study.place).parts[:1] == (SOLVED,):
        raise InvalidInput(f"place = {study.place}: this folder holds the solved contacts, choose another place")
    _make_folders(output, [SOLVED] if cost.contacts else [], study.place)
    with lock((output, below), progress.message):
        if cost.contacts:
            progress.message(str(cost))
        solve = partial(runner.sweep, workers=workers, scheduler=scheduler, executor=executor)
        done = _answered(study, output, count, yes, progress, solve)
        path = _write(done, below, report, progress)
        return replace(done, path=path)


def _answered(study, output, count, yes, progress, solve) -> Report:
    """Solve a study and return its report; nothing is written to its page yet."""
    swept = SweepResult({}, 0, 0, 0.0)
    more: Study | None = study.first
    try:
        with Processes(count) as processes:
            while more is not None:
                more.cost().refuse(count, yes)
                if swept.outcomes:
                    progress.message(f"{more.reason}: {more.cost()}")
                found = _solve(more, swept, output, progress, partial(solve, processes=processes))
                study, swept = more, swept.joined(found)
                answers = study.answers(swept.outcomes)
                judged = study.judge(answers)
                # What breaks with few surfaces breaks with more.
                more = study.rest if swept.faults else study.more(answers, judged.findings)
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


def _write(done, folder, report, progress) -> Path | None:
    """Write a page and all its files in place of the files of earlier runs there; return the path of the page.

    All is drawn before the folder is touched.
    """
    study, page = done.study, done.page
    files = {netcdf.NAME: netcdf.packed(done.answers)}
    if report:
        with progress.writing(len(list(page.every(Plot)))) as drawn:
            files |= render.files(page, done.judged, drawn)
    else:
        files |= render.tables(page, done.judged)
    manifest.begin(folder, study, files)
    written = render.write(files, folder)
    solved = os.path.relpath(done.output / SOLVED, folder)
    manifest.stamp(folder, study, page, done.swept, solved, files)
    return written[-1] if report else None


def _solve(study, had, output, progress, solve) -> SweepResult:
    """Solve what neither a sweep had nor the folder has. Timed tasks are solved here, whatever the executor."""
    swept = SweepResult({}, 0, 0, 0.0)
    for batch in study.batches():
        if tasks := [task for task in batch.tasks if task not in had.outcomes]:
            with progress.solving() as on_solved:
                found = solve(tasks, Store(output / SOLVED), progress=on_solved, fresh=batch.timed)
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
