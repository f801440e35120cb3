"""What the command does, as functions: each solves what its folder has not, judges, writes, and prints nothing.

What a function returns says itself what was found: printed, it is what the command prints; in a notebook, tables
and figures. Interrupted, the same call resumes. As worker processes are started, a script calls them under
`if __name__ == "__main__":`.
"""

from collections.abc import Callable, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from pathlib import Path
from typing import Any

from .asked import Asked, case_of, make_folders
from .jobs import asking
from .jobs.job import SOLVED, Found, Job, answer, solve
from .manifest import NAME as MANIFEST
from .sweep import Progress, SweepResult

REPORT, STUDY, PAPER, COSTS = (
    "crosscheck-report",
    "crosscheck-study",
    "crosscheck-paper",
    "crosscheck-workprecision",
)
STABILITY, REGRESS, SHIFTED, DESCRIBED = "crosscheck-stability", "crosscheck-regress", "mastercurve", "topography"
ANIMATED = "crosscheck-animation"


def crosscheck(
    scene: Asked | Mapping[str, Asked] | None = None,
    folder: str | Path = REPORT,
    workers: int | None = None,
    scheduler: str | None = None,
    progress: Progress | bool = False,
) -> Found:
    """Solve scenes in one and in three dimensions, compare, and write a report; `judged` has a Judgement a case.

    scene : a Scene or a Case, the path of one, the name of a ready one, or several by name; the paper's sphere and
        cone if absent
    folder : of the report and of what has been solved
    workers : processes; as many as processors if absent
    scheduler : address of a scheduler of dask.distributed, which has the workers then
    progress : whether the terminal says how far it is, or who is told instead, see compare.sweep.Progress

    Raises InvalidInput, Refused before anything is solved.
    """
    return conducted(asking.cases(scene), folder, workers, scheduler, progress)


def conduct(
    study: Any,
    size: str = "quick",
    folder: str | Path = STUDY,
    workers: int | None = None,
    scheduler: str | None = None,
    progress: Progress | bool = False,
) -> Found:
    """Ask the claims of the paper of many contacts, and write a page; `judged` is a JudgedStudy.

    study : the name of one, or the path of a file
    size : quick (minutes), standard (up to an hour) or paper (up to a day)
    folder, workers, scheduler, progress : as of crosscheck

    Raises InvalidInput, Refused.
    """
    return conducted(asking.study(study, size), folder, workers, scheduler, progress)


def reproduce(
    profiles: int = 200,
    folder: str | Path = PAPER,
    workers: int | None = None,
    scheduler: str | None = None,
    progress: Progress | bool = False,
) -> Found:
    """Simulate the paper again in one dimension, and write a page; `judged` has its data and its claims.

    profiles : averaged, at least 3; as published, 200
    folder, workers, scheduler, progress : as of crosscheck
    """
    return conducted(asking.paper(profiles), folder, workers, scheduler, progress)


def weigh(
    *names: str,
    size: str = "quick",
    folder: str | Path = COSTS,
    workers: int | None = None,
    scheduler: str | None = None,
    progress: Progress | bool = False,
) -> Found:
    """Measure what accuracy costs in time, and write a page; `judged` has what each diagram found, by name.

    names : of diagrams, all of them if absent; size : quick or full
    folder, workers, scheduler, progress : as of crosscheck; what is timed is solved on this machine, alone
    """
    return conducted(asking.costs(names, size), folder, workers, scheduler, progress)


def examine(
    size: str = "small",
    folder: str | Path = STABILITY,
    workers: int | None = None,
    scheduler: str | None = None,
    progress: Progress | bool = False,
) -> Found:
    """Solve the named hard cases, each with its law, and write a table; `judged` has a Record a case.

    size : small or large
    folder, workers, scheduler, progress : as of crosscheck
    """
    return conducted(asking.hardcases(size), folder, workers, scheduler, progress)


def regress(
    baseline: str | Path | None = None,
    quantities: Sequence[Any] | None = None,
    folder: str | Path = REGRESS,
    workers: int | None = None,
    scheduler: str | None = None,
    progress: Progress | bool = False,
) -> Found:
    """Hold quantities against stored ones; `judged` has every Change, `judged.wrong` those that ask for a look.

    baseline : a file of stored values; those of the package if absent
    quantities : that are measured; those of the package if absent
    folder, workers, scheduler, progress : as of crosscheck

    For a test of your own, `check` raises AssertionError, and `update` stores. Raises InvalidInput.
    """
    return conducted(asking.baseline(baseline, quantities), folder, workers, scheduler, progress)


def shift(table: str | Path, folder: str | Path = SHIFTED) -> Found:
    """Shift measured curves of friction onto one; `judged` is a Shifted.

    table : CSV of friction mu, normal force F_N [N] and speed v [m/s]
    folder : of the figure and its tables

    Raises InvalidInput.
    """
    from .jobs.tables import Mastercurve

    return conducted(Mastercurve(Path(table)), folder)


def describe(file: str | Path, folder: str | Path = DESCRIBED, **stated: Any) -> Found:
    """Describe a measured map of heights: size, slopes, spectra; `judged` is a Description.

    stated : the other fields of scene.Topography, as pixel=1e-6, unit="um"
    folder : of the figure and its tables

    Raises InvalidInput.
    """
    from .jobs.tables import Map

    return conducted(Map(Path(file), stated), folder)


def animate(
    scene: Asked,
    path: str | Path,
    folder: str | Path = ANIMATED,
    workers: int | None = None,
    progress: Progress | bool = False,
    **settings: Any,
) -> Path:
    """Draw a scene as it moves in time, in one and in three dimensions side by side; returns the path.

    scene : as of crosscheck, one
    path : of a .gif, or of an .mp4 where ffmpeg is there
    folder : of what has been solved: the picture is made again from it
    workers, progress : as of crosscheck
    settings : mdr, bem, frames, seconds, as of compare.animation.animate

    Raises InvalidInput, Refused, and SolveError where a march fails.
    """
    from .animation import animate as animated
    from .store import Store

    case = case_of(scene)
    with _watched(progress)() as told:
        return animated(case, path, store=Store(Path(folder) / SOLVED), workers=workers, progress=told, **settings)


def prepared(job: Job, folder: Path) -> None:
    """Make every folder that a job writes into. Raises OSError, before anything is solved."""
    below = (SOLVED,) if job.rounds else ()
    place = f"{job.place}/" if job.place else ""
    make_folders(folder, (*below, *job.folders), [f"{place}{name}" for name in (*job.files, MANIFEST)])


def conducted(
    job: Job,
    folder: str | Path,
    workers: int | None = None,
    scheduler: str | None = None,
    progress: Progress | bool = False,
) -> Found:
    """Do a job from its question to its page."""
    folder = Path(folder)
    if not job.rounds:  # what is read may be wrong, and then nothing is written
        job.judged(SweepResult({}, 0, 0, 0.0))
    prepared(job, folder)
    return answer(job, folder, solve(job, folder, workers, scheduler, _watched(progress)))


def _watched(progress: Progress | bool) -> Callable[[], AbstractContextManager[Any]]:
    """What a sweep tells, and whom."""
    if progress is True:
        from rich.console import Console

        from .progress import watch

        return lambda: watch(Console(highlight=False, soft_wrap=True))
    return lambda: nullcontext(progress or None)
