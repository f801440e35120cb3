"""One run of the command: cases in, report out."""

import errno
import os
import tempfile
from collections.abc import Iterable, Mapping, Sequence
from math import nan
from pathlib import Path
from typing import Any

from pydantic import TypeAdapter, ValidationError
from rich.console import Console

from scene import SolveError, Topography
from scene.reading import InvalidInput, mistakes

from .cases import Case, read_case, shipped_cases
from .figures import shifted_curves, topography
from .paper import reproduction
from .paper.claims import claims
from .paper.measured import read_measured
from .paper.report import write_paper
from .progress import watch
from .publish import draw
from .quantity import Quantity
from .regression import Change, changes, measure, said
from .report import MANIFEST, PAGE, slug, write_report
from .stability import report as stability
from .store import Store
from .studies.catalogue import SIZES, STUDIES
from .studies.judgement import judge_study
from .studies.report import failures, write_study
from .studies.series import tasks as study_tasks
from .studies.tableau import columns
from .studies.wording import line
from .study import points, tasks
from .sweep import sweep
from .topography import describe, described
from .verdict import judge
from .wording import explain, explain_vertical, plus_minus
from .workprecision.catalogue import INQUIRIES
from .workprecision.report import chapter, write_workprecision

SOLVED = "solved"


def named_cases(path: Path | None) -> dict[str, Case]:
    """The case of a file, by the file's name, or the shipped ones. Raises InvalidInput, Refused."""
    try:
        cases = shipped_cases() if path is None else {path.stem: read_case(path)}
        for case in cases.values():
            points(case)
    except (ArithmeticError, SolveError, ValidationError) as error:
        # The file is valid; what follows from it is not.
        raise InvalidInput(f"{path}: its numbers are so far apart that the contact leaves their range") from error
    return cases


def make_folders(folder: Path, names: Iterable[str] = (), page: str = PAGE) -> None:
    """Make every folder that is going to be written into. Raises OSError, before anything is solved.

    names : of cases, each of which has a folder of its own; page : the name of the page
    """
    for below in (folder, folder / SOLVED, *(folder / slug(name) for name in names)):
        below.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=below):
            pass
    for path in (folder / page, folder / MANIFEST):
        if path.is_dir():
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(path))


def crosscheck_cases(cases: Mapping[str, Case], folder: Path, workers: int | None) -> None:
    """Solve, judge and report cases, telling on the console how far it is and what came out."""
    console = Console(highlight=False, soft_wrap=True)
    found = {name: points(case) for name, case in cases.items()}
    everything = [point for those in found.values() for point in those]
    with watch(console) as progress:
        swept = sweep(tasks(everything), Store(folder / SOLVED), workers, progress)
    console.print(f"{swept.solved} tasks solved, {swept.reused} reused, {swept.seconds:.0f} s; writing the report")
    judged = {name: judge(case, found[name], swept) for name, case in cases.items()}
    page = write_report(folder, judged, swept)
    for name, judgement in judged.items():
        console.print(f"\n{judgement.case.title or name}", markup=False, style="bold")
        for number in judgement.numbers:
            console.print(f"  {number.name}: {number.written}", markup=False)
        if judgement.failures:
            console.print(f"  {len(judgement.failures)} solves failed; the report says why")
    console.print(f"\nReport: {page.resolve()}", markup=False)


def reproduce(profiles: int, folder: Path, workers: int | None) -> None:
    """Solve everything that the figures of the paper need, and write its page."""
    console = Console(highlight=False, soft_wrap=True)
    size = reproduction.Size.of(profiles)
    with watch(console) as progress:
        swept = sweep(reproduction.tasks(size), Store(folder / SOLVED), workers, progress)
    console.print(
        f"{swept.solved} tasks solved, {swept.reused} reused, {swept.seconds:.0f} s; drawing the figures"
    )
    found = reproduction.collect(size, swept.outcomes)
    judged = claims(found)
    page = write_paper(folder, found, judged, swept)
    for claim in judged:
        console.print(f"  {claim.verdict:9s}  {claim.name}: {claim.written}", markup=False)
    if found.failed:
        console.print(f"  {found.failed} solves failed and are left out")
    console.print(f"\nPage: {page.resolve()}", markup=False)


def remeasure(
    quantities: Sequence[Quantity], stored: Mapping[str, float], folder: Path, workers: int | None
) -> list[Change]:
    """Measure quantities again, and tell which have moved from what is stored."""
    console = Console(highlight=False, soft_wrap=True)
    with watch(console) as progress:
        swept = measure(quantities, folder / SOLVED, workers, progress)
    console.print(f"{swept.solved} tasks solved, {swept.reused} reused, {swept.seconds:.0f} s")
    found = changes(quantities, stored, swept.outcomes)
    console.print(f"\n{said(found)}", markup=False)
    return found


def shift_measured(path: Path, folder: Path) -> None:
    """Shift the curves of a user's own table onto one, and write the figure and its tables."""
    console = Console(highlight=False, soft_wrap=True)
    shifted = read_measured(path)
    folder.mkdir(parents=True, exist_ok=True)
    draw(folder, shifted_curves, [shifted], suffix=f"-{slug(path.stem)}")
    collapse = shifted.collapse
    console.print(f"horizontal shifts onto one curve: {collapse.verdict}")
    console.print(f"  {explain(collapse)}")
    console.print(f"  misfit {collapse.after.rms:.2%}, without shifts {collapse.before.rms:.2%}")
    exponent = collapse.exponent if collapse.overlaps else nan
    console.print(f"  shift ~ v^p, p = {plus_minus(exponent, shifted.exponent_error)}")
    console.print(f"  {explain_vertical(shifted.vertical)}", markup=False)
    if shifted.vertical:
        console.print(f"  vertical shifts alone leave a misfit of {shifted.vertical.alone.rms:.2%}")
    console.print(f"\nFigure and tables: {folder.resolve()}", markup=False)


def describe_topography(path: Path, stated: Mapping[str, Any], folder: Path) -> None:
    """Describe a measured map, and write the figure of its spectra and its tables. Raises InvalidInput.

    stated : the other fields of a scene's `Topography`
    """
    console = Console(highlight=False, soft_wrap=True)
    content = {"file": str(path), **stated}
    adapter = TypeAdapter(Topography)
    try:
        found = describe(adapter.validate_python(content))
    except ValidationError as error:
        raise InvalidInput("\n".join(mistakes(error, content, adapter))) from error
    except ValueError as error:
        raise InvalidInput(f"{path}: {error}") from error
    folder.mkdir(parents=True, exist_ok=True)
    draw(folder, topography, found, suffix=f"-{slug(path.stem)}")
    for sentence in described(found):
        console.print(sentence, markup=False)
    console.print(f"\nFigure and tables: {folder.resolve()}", markup=False)


def conduct_workprecision(names: Sequence[str], size: str, folder: Path, workers: int | None) -> None:
    """Measure what accuracy costs, and write the page. What is timed is solved alone, after all else."""
    console = Console(highlight=False, soft_wrap=True)
    store, inquiries = Store(folder / SOLVED), [INQUIRIES[name] for name in names]
    with watch(console) as progress:
        known = sweep([task for each in inquiries for task in each.untimed(size)], store, workers, progress)
    with watch(console) as progress:
        timed = sweep([task for each in inquiries for task in each.timed(size)], store, 1, progress, tasks_each=1)
    swept = known.joined(timed)
    console.print(
        f"{swept.solved} tasks solved, {swept.reused} reused, {swept.seconds:.0f} s; drawing the figures"
    )
    chapters = [chapter(folder, each, each.judge(size, swept.outcomes)) for each in inquiries]
    page = write_workprecision(folder, chapters, size, swept)
    for each in chapters:
        console.print(f"\n{each.title}", markup=False, style="bold")
        console.print(f"  {each.advice}", markup=False)
    console.print(f"\nPage: {page.resolve()}", markup=False)


def examine_stability(size: str, folder: Path, workers: int | None) -> int:
    """Solve the collection of hard cases, write its table, and tell what is broken. Returns how many are."""
    console = Console(highlight=False, soft_wrap=True)
    with watch(console) as progress:
        found = stability.conduct(size, folder, folder / SOLVED, workers, progress)
    verdicts = [record.verdict for record in found]
    console.print(", ".join(f"{verdict} {verdicts.count(verdict)}" for verdict in stability.VERDICTS))
    broken = [record for record in found if record.verdict == stability.BROKEN]
    for record in broken:
        console.print(
            f"  {record.name}: {record.what} {record.found:.2g}, allowed {record.allowed:.2g}", markup=False
        )
        console.print(f"    {record.law} {record.message}", markup=False)
    console.print(f"\nTable: {(folder / stability.PAGE).resolve()}", markup=False)
    return len(broken)


def conduct_study(name: str, size: str, folder: Path, workers: int | None) -> None:
    """Solve a study that comes with the package, judge it, and write its page."""
    console = Console(highlight=False, soft_wrap=True)
    series = STUDIES[name].series(SIZES[size])
    with watch(console) as progress:
        solving = [task for each in series for task in study_tasks(each)]
        swept = sweep(solving, Store(folder / SOLVED), workers, progress)
    console.print(f"{swept.solved} tasks solved, {swept.reused} reused, {swept.seconds:.0f} s; judging")
    judged = judge_study(name, size, series, swept.outcomes)
    page = write_study(folder / slug(f"{name}-{size}"), judged, swept)
    for column in columns(judged):
        console.print(f"\n{column.title}", markup=False, style="bold")
        for finding in column.findings:
            console.print(f"  {line(finding)}", markup=False)
    if failed := sum(len(failures(each)) for each in judged.series):
        console.print(f"\n{failed} solves failed; the page says why")
    console.print(f"\nPage: {page.resolve()}", markup=False)
