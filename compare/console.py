"""What a person sees of a command: how far it is, what was found, and every mistake in a line."""

import signal
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from textwrap import fill
from typing import TYPE_CHECKING, Any

import typer

if TYPE_CHECKING:
    from .jobs.job import Found, Job

FAILED, MISTAKE, INTERRUPTED = 1, 2, 130


def conducted(job: "Job", output: Path, workers: int | None, scheduler: str | None) -> "Found":
    """Solve, saying how far it is; judge, write and print. Ends with FAILED where a task broke."""
    from rich.console import Console

    from scene import SolveError

    from .jobs.job import SOLVED, Broken, answer, broken, solve
    from .progress import watch
    from .run import prepared

    console = Console(highlight=False, soft_wrap=True)
    with mistakes_said(f"--output {output}"):
        prepared(job, output)
    with interrupts_said():
        if stored := sum(1 for _ in (output / SOLVED).glob("*.nc")):
            console.print(f"Reading what of {stored} stored results is asked for")
        swept = solve(job, output, workers, scheduler, lambda: watch(console))
        if not swept.solved:
            console.print(f"0 tasks solved, {swept.reused} reused")
        for line in broken(swept, output):
            typer.echo(f"crosscheck: {line}", err=True)
        console.print(job.doing)
        try:
            found = answer(job, output, swept)
        except SolveError as error:
            typer.echo(f"crosscheck: {error.what if isinstance(error, Broken) else error}", err=True)
            raise typer.Exit(FAILED) from error
    printed(found)
    if swept.faults:
        raise typer.Exit(FAILED)
    return found


def printed(found: "Found") -> None:
    """What was found; headings stand out on a terminal."""
    from rich.console import Console

    from .jobs.job import Heading

    console = Console(highlight=False, soft_wrap=True)
    for line in found.job.lines(found.judged):
        if isinstance(line, Heading):
            console.print(f"\n{line}", markup=False, style="bold")
        else:
            console.print(line, markup=False)
    if found.page:
        console.print(f"\nPage: {found.page.resolve()}", markup=False)


def listed(offered: Mapping[str, Any]) -> None:
    """What can be named, each with its title and what it is about."""
    width = max((len(name) for name in offered), default=0) + 2
    for name, each in offered.items():
        typer.echo(f"{name:{width}s}{each.title}")
        typer.echo(fill(each.about, 79, initial_indent=width * " ", subsequent_indent=width * " "))


@contextmanager
def mistakes_said(where: str = "") -> Iterator[None]:
    """Before anything is solved: a mistake in the input, or a file or folder that cannot be written.

    where : the option that names it, with its value
    """
    interrupt_on("SIGTERM", "SIGHUP")
    try:
        yield
    except ValueError as error:
        _end_with(error)
        raise
    except OSError as error:
        typer.echo(f"crosscheck: {f'{where}: ' if where else ''}{_said(error)}", err=True)
        raise typer.Exit(MISTAKE) from error


@contextmanager
def interrupts_said() -> Iterator[None]:
    """While tasks are solved: an interrupt, a cluster that does not answer, or a disk that is full."""
    try:
        yield
    except KeyboardInterrupt as interrupt:
        typer.echo("Interrupted. What is solved is kept: the same command resumes from there.", err=True)
        raise typer.Exit(INTERRUPTED) from interrupt
    except ValueError as error:
        _end_with(error)
        raise
    except OSError as error:
        typer.echo(f"crosscheck: {_said(error)}. What is solved and stored is kept.", err=True)
        raise typer.Exit(FAILED) from error


def _end_with(error: ValueError) -> None:
    """Say a mistake and end; return from a fault, which is to be raised as it is."""
    from scene import Refused  # slow, and only a mistake needs it
    from scene.reading import InvalidInput

    if isinstance(error, InvalidInput | Refused):
        typer.echo(f"crosscheck: {error}", err=True)
        raise typer.Exit(MISTAKE) from error


def interrupt_on(*names: str) -> None:
    """Let signals do what Ctrl-C does, unless they are ignored, as by nohup."""
    for number in (getattr(signal, name) for name in names if hasattr(signal, name)):
        if signal.getsignal(number) is signal.SIG_DFL:
            signal.signal(number, signal.default_int_handler)


def _said(error: OSError) -> str:
    return f"{error.filename}: {error.strerror}" if error.filename else str(error)
