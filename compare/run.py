"""One run of the command: cases in, report out."""

from collections.abc import Mapping
from pathlib import Path

from rich.console import Console

from .cases import Case, read_case, shipped_cases
from .progress import watch
from .report import write_report
from .store import Store
from .study import points, tasks
from .sweep import sweep
from .verdict import judge


def named_cases(path: Path | None) -> dict[str, Case]:
    """The case of a file, by the file's name, or the shipped ones. Raises InvalidInput, Refused."""
    cases = shipped_cases() if path is None else {path.stem: read_case(path)}
    for case in cases.values():
        points(case)
    return cases


def crosscheck_cases(cases: Mapping[str, Case], folder: Path, workers: int | None) -> None:
    """Solve, judge and report cases, telling on the console how far it is and what came out."""
    console = Console(highlight=False, soft_wrap=True)
    found = {name: points(case) for name, case in cases.items()}
    everything = [point for those in found.values() for point in those]
    with watch(console) as progress:
        swept = sweep(tasks(everything), Store(folder / "solved"), workers, progress)
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
