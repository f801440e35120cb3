"""The command `crosscheck`."""

import signal
from pathlib import Path
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


@app.command()
def run(
    scene: Annotated[
        Path | None, typer.Argument(help="Scene as TOML; without it, the paper's sphere and cone.")
    ] = None,
    output: Annotated[Path, typer.Option(help="Folder of the report and of what has been solved.")] = Path(
        "crosscheck-report"
    ),
    workers: Annotated[int | None, typer.Option(min=1, help="Processes; as many as processors if absent.")] = None,
) -> None:
    """Solve a scene in one and in three dimensions, compare, and write a report."""
    from scene import Refused
    from scene.reading import InvalidInput

    from .run import crosscheck_cases, make_folders, named_cases

    _interrupt_on("SIGTERM", "SIGHUP")
    try:
        cases = named_cases(scene)
        make_folders(cases, output)
    except (InvalidInput, Refused) as mistake:
        typer.echo(f"crosscheck: {mistake}", err=True)
        raise typer.Exit(MISTAKE) from mistake
    except OSError as error:
        typer.echo(f"crosscheck: --output {output}: {_said(error)}", err=True)
        raise typer.Exit(MISTAKE) from error
    try:
        crosscheck_cases(cases, output, workers)
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
