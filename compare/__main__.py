"""The command `crosscheck`."""

from pathlib import Path
from typing import Annotated

import typer

app = typer.Typer(add_completion=False, no_args_is_help=True, pretty_exceptions_enable=False)

MISTAKE, INTERRUPTED = 2, 130


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

    from .run import crosscheck_cases, named_cases

    try:
        cases = named_cases(scene)
        output.mkdir(parents=True, exist_ok=True)
    except (InvalidInput, Refused) as mistake:
        typer.echo(f"crosscheck: {mistake}", err=True)
        raise typer.Exit(MISTAKE) from mistake
    except OSError as error:
        typer.echo(f"crosscheck: --output {output}: {error.strerror}", err=True)
        raise typer.Exit(MISTAKE) from error
    try:
        crosscheck_cases(cases, output, workers)
    except KeyboardInterrupt as interrupt:
        typer.echo("Interrupted. What is solved is kept: the same command resumes from there.", err=True)
        raise typer.Exit(INTERRUPTED) from interrupt


def main() -> None:
    """Entry point of the console command."""
    app()


if __name__ == "__main__":
    main()
