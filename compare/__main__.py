"""The command `crosscheck`."""

import signal
from collections.abc import Collection, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from textwrap import fill
from typing import Annotated, Any

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
def plan(
    scene: Annotated[Path, typer.Argument(help="Scene as TOML, with or without [mdr] and [bem].")],
) -> None:
    """Say what would be simulated of a scene, what that costs, and what is left out; status 2 if no solver can."""
    from .planning import feasible, plans

    with _mistakes_said(scene):
        found = plans(scene)
    typer.echo("\n\n".join(map(str, found.values())))
    if not feasible(found):
        raise typer.Exit(MISTAKE)


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
def topography(
    file: Annotated[Path, typer.Argument(help="Map of heights: .npy, .npz, .csv, .txt, or as SurfaceTopography.")],
    pixel: Annotated[
        list[float] | None, typer.Option(help="Side of a pixel [m]; twice, along x and y. If the file has none.")
    ] = None,
    unit: Annotated[str | None, typer.Option(help="Of its heights: m, mm, um, nm. If the file has none.")] = None,
    level: Annotated[
        str | None,
        typer.Option(help="Taken off first: mean, tilt or curvature. If absent, tilt; mean of what is periodic."),
    ] = None,
    repeat: Annotated[str, typer.Option(help="How the map goes on: mirror or periodic.")] = "mirror",
    peaks: Annotated[str, typer.Option(help="Heights grow towards the elastomer, up, or away, down.")] = "up",
    output: Annotated[Path, typer.Option(help="Folder of the figure and its tables.")] = Path("topography"),
) -> None:
    """Describe a measured map of heights: size, slopes, spectra, and the self-affine law in them."""
    from .run import describe_topography

    stated: dict[str, Any] = {"repeat": repeat, "peaks": peaks}
    if level:
        stated["level"] = level
    if pixel:
        stated["pixel"] = pixel[0] if len(pixel) == 1 else tuple(pixel)
    if unit:
        stated["unit"] = unit
    with _mistakes_said(output):
        describe_topography(file, stated, output)


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
        _listed(STUDIES)
        typer.echo("`crosscheck study NAME` solves one, in minutes; --size says how much of it.")
        return
    _known((name, "NAME", STUDIES), (size, "--size", SIZES))
    with _mistakes_said(output):
        make_folders(output, [f"{name}-{size}"])
    with _interrupts_said():
        conduct_study(name, size, output, workers)


@app.command()
def workprecision(
    name: Annotated[
        str | None, typer.Argument(help="Diagram, or all of them by the name all; without it, they are listed.")
    ] = None,
    size: Annotated[str, typer.Option(help="quick (a minute a diagram) or full (up to ten).")] = "quick",
    output: Annotated[Path, typer.Option(help="Folder of the page and of what has been solved.")] = Path(
        "crosscheck-workprecision"
    ),
    workers: Workers = None,
) -> None:
    """Measure what accuracy costs in time, in one and in three dimensions, and write a page."""
    from .run import INQUIRIES, conduct_workprecision, make_folders
    from .workprecision.diagram import SIZES
    from .workprecision.report import PAGE

    if name is None:
        _listed(INQUIRIES)
        typer.echo("`crosscheck workprecision NAME` measures one, in about a minute; --size full does it in full.")
        return
    _known((name, "NAME", [*INQUIRIES, "all"]), (size, "--size", SIZES))
    with _mistakes_said(output):
        make_folders(output, page=PAGE)
    with _interrupts_said():
        conduct_workprecision(list(INQUIRIES) if name == "all" else [name], size, output, workers)


@app.command()
def stability(
    size: Annotated[str, typer.Option(help="small (half a minute) or large (some minutes).")] = "small",
    output: Annotated[Path, typer.Option(help="Folder of the table and of what has been examined.")] = Path(
        "crosscheck-stability"
    ),
    workers: Workers = None,
) -> None:
    """Solve the named hard cases, and say whether each keeps its law; status 1 if any does not."""
    from .run import examine_stability, make_folders
    from .stability.hardcase import SIZES
    from .stability.report import PAGE

    _known((size, "--size", SIZES))
    with _mistakes_said(output):
        make_folders(output, page=PAGE)
    with _interrupts_said():
        broken = examine_stability(size, output, workers)
    if broken:
        raise typer.Exit(FAILED)


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


def _listed(offered: Mapping[str, Any]) -> None:
    """What can be named, each with its title and what it is about."""
    for name, each in offered.items():
        typer.echo(f"{name:12s}{each.title}")
        typer.echo(fill(each.about, 79, initial_indent=12 * " ", subsequent_indent=12 * " "))


def _known(*choices: tuple[str, str, Collection[str]]) -> None:
    """End with a mistake where something is given, under the name of its option, that is not known."""
    for given, option, known in choices:
        if given not in known:
            typer.echo(f"crosscheck: {option} = {given}: allowed are {', '.join(known)}", err=True)
            raise typer.Exit(MISTAKE)


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
