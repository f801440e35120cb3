"""The command `crosscheck`."""

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from textwrap import fill
from typing import Annotated

import typer

app = typer.Typer(add_completion=False, no_args_is_help=True, pretty_exceptions_enable=False)

FAILED, MISTAKE, INTERRUPTED = 1, 2, 130


def _version(wanted: bool) -> None:
    if wanted:
        from importlib.metadata import version

        typer.echo(version("mdr-bem-crosscheck"))
        raise typer.Exit


@app.callback()
def crosscheck(
    version: Annotated[bool, typer.Option("--version", callback=_version, is_eager=True, help="Version.")] = False,
) -> None:
    """How far the one-dimensional method can be trusted for rough, viscoelastic contacts."""


Workers = Annotated[int | None, typer.Option(min=1, help="Processes; as many as processors if absent.")]


@app.command()
def run(
    scene: Annotated[
        Path | None, typer.Argument(help="Scene as TOML; without it, the paper's sphere and cone.")
    ] = None,
    output: Annotated[Path, typer.Option(help="Folder of the report and of what has been solved.")] = Path(
        "crosscheck-report"
    ),
    workers: Workers = None,
) -> None:
    """Solve a scene in one and in three dimensions, compare, and write a report."""
    from .run import crosscheck_cases, make_folders, named_cases

    with _mistakes_said(output):
        cases = named_cases(scene)
        make_folders(output, cases)
    with _interrupts_said():
        crosscheck_cases(cases, output, workers)


@app.command()
def paper(
    output: Annotated[Path, typer.Option(help="Folder of the page and of what has been solved.")] = Path(
        "crosscheck-paper"
    ),
    profiles: Annotated[int, typer.Option(min=3, help="Rough profiles averaged; as published, 200.")] = 200,
    workers: Workers = None,
) -> None:
    """Simulate the paper again in one dimension: its figures, its parameter studies, its claims."""
    from .paper.report import PAGE
    from .run import make_folders, reproduce

    with _mistakes_said(output):
        make_folders(output, page=PAGE)
    with _interrupts_said():
        reproduce(profiles, output, workers)


@app.command()
def mastercurve(
    table: Annotated[Path, typer.Argument(help="CSV of friction mu, normal force F_N [N] and speed v [m/s].")],
    output: Annotated[Path, typer.Option(help="Folder of the figure and its tables.")] = Path("mastercurve"),
) -> None:
    """Shift measured curves of friction against load onto one, and say whether that works."""
    from .run import shift_measured

    with _mistakes_said(output):
        shift_measured(table, output)


@app.command()
def study(
    name: Annotated[str | None, typer.Argument(help="Study; without it, they are listed.")] = None,
    size: Annotated[
        str, typer.Option(help="quick (minutes), standard (up to an hour) or paper (up to a day).")
    ] = "quick",
    output: Annotated[Path, typer.Option(help="Folder of pages and of what has been solved.")] = Path(
        "crosscheck-study"
    ),
    workers: Workers = None,
) -> None:
    """Ask the claims of the paper of many contacts in one and in three dimensions, and write a page."""
    from .run import SIZES, STUDIES, conduct_study, make_folders

    if name is None:
        for each, asked in STUDIES.items():
            typer.echo(f"{each:12s}{asked.title}")
            typer.echo(fill(asked.about, 79, initial_indent=12 * " ", subsequent_indent=12 * " "))
        typer.echo("`crosscheck study NAME` solves one, in minutes; --size says how much of it.")
        return
    for given, option, known in ((name, "NAME", STUDIES), (size, "--size", SIZES)):
        if given not in known:
            typer.echo(f"crosscheck: {option} = {given}: allowed are {', '.join(known)}", err=True)
            raise typer.Exit(MISTAKE)
    with _mistakes_said(output):
        make_folders(output, [f"{name}-{size}"])
    with _interrupts_said():
        conduct_study(name, size, output, workers)


@app.command()
def regress(
    baseline: Annotated[
        Path | None, typer.Option(help="Stored quantities as TOML; without it, those of the package.")
    ] = None,
    update: Annotated[bool, typer.Option("--update", help="Store what has moved.")] = False,
    output: Annotated[Path, typer.Option(help="Folder of what has been solved.")] = Path("crosscheck-regress"),
    workers: Workers = None,
) -> None:
    """Say whether the accuracy of one dimension has moved from what is stored; status 1 if it has."""
    from .accuracy import shipped
    from .regression import SHIPPED, read_baseline, read_or_begin, rewrite, wrong
    from .run import make_folders, remeasure

    path, quantities = baseline or SHIPPED, shipped()
    with _mistakes_said(output):
        stored = (read_or_begin if update else read_baseline)(path, quantities)
        make_folders(output)
    with _interrupts_said():
        found = remeasure(quantities, stored, output, workers)
        left = rewrite(path, found) if update else wrong(found)
    if update:
        typer.echo(f"Baseline: {path}")
    if left:
        raise typer.Exit(FAILED)


@contextmanager
def _mistakes_said(output: Path) -> Iterator[None]:
    """Before anything is solved: a mistake in the input, or a folder that cannot be written."""
    from scene import Refused
    from scene.reading import InvalidInput

    _interrupt_on("SIGTERM", "SIGHUP")
    try:
        yield
    except (InvalidInput, Refused) as mistake:
        typer.echo(f"crosscheck: {mistake}", err=True)
        raise typer.Exit(MISTAKE) from mistake
    except OSError as error:
        typer.echo(f"crosscheck: --output {output}: {_said(error)}", err=True)
        raise typer.Exit(MISTAKE) from error


@contextmanager
def _interrupts_said() -> Iterator[None]:
    """While tasks are solved: an interrupt, or a disk that is full."""
    try:
        yield
    except KeyboardInterrupt as interrupt:
        typer.echo("Interrupted. What is solved is kept: the same command resumes from there.", err=True)
        raise typer.Exit(INTERRUPTED) from interrupt
    except OSError as error:
        typer.echo(f"crosscheck: {_said(error)}. What is solved and stored is kept.", err=True)
        raise typer.Exit(FAILED) from error


def _interrupt_on(*names: str) -> None:
    """Let signals do what Ctrl-C does, unless they are ignored, as by nohup."""
    for number in (getattr(signal, name) for name in names if hasattr(signal, name)):
        if signal.getsignal(number) is signal.SIG_DFL:
            signal.signal(number, signal.default_int_handler)


def _said(error: OSError) -> str:
    return f"{error.filename}: {error.strerror}" if error.filename else str(error)


def main() -> None:
    """Entry point of the console command."""
    app()


if __name__ == "__main__":
    main()
