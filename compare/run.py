"""One run of the command: cases in, report out."""

import errno
import os
import tempfile
from collections.abc import Mapping
from pathlib import Path

from pydantic import ValidationError
from rich.console import Console

from scene.reading import InvalidInput

from .cases import Case, read_case, shipped_cases
from .progress import watch
from .report import MANIFEST, PAGE, slug, write_report
from .store import Store
from .study import points, tasks
from .sweep import sweep
from .verdict import judge

SOLVED = "solved"


def named_cases(path: Path | None) -> dict[str, Case]:
    """The case of a file, by the file's name, or the shipped ones. Raises InvalidInput, Refused."""
    try:
        cases = shipped_cases() if path is None else {path.stem: read_case(path)}
        for case in cases.values():
            points(case)
    except (ArithmeticError, ValidationError) as error:
        # The file is valid; what follows from it is not.
        raise InvalidInput(f"{path}: its numbers are so far apart that the contact leaves their range") from error
    return cases


def make_folders(cases: Mapping[str, Case], folder: Path) -> None:
    """Make every folder that is going to be written into. Raises OSError, before anything is solved."""
    for below in (folder, folder / SOLVED, *(folder / slug(name) for name in cases)):
        below.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=below):
            pass
    for path in (folder / PAGE, folder / MANIFEST):
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
