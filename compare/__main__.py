"""The command `crosscheck`: it asks, prints what was found, and says mistakes; `compare.run` does the rest."""

from pathlib import Path
from typing import Annotated, Any

import typer

from .console import (
    FAILED,
    MISTAKE,
    conducted,
    interrupts_said,
    listed,
    mistakes_said,
    printed,
)

app = typer.Typer(add_completion=False, no_args_is_help=True, pretty_exceptions_enable=False)


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
Scheduler = Annotated[
    str | None, typer.Option(help="Address of a dask scheduler, as tcp://host:8786, whose workers then solve.")
]


@app.command("list")
def ready() -> None:
    """List the ready scenes and studies, to begin with."""
    from .library import ready

    for command, what in (("run", "Scenes"), ("plan", "Scenes that nothing compares"), ("study", "Studies")):
        typer.echo(f"{what}, crosscheck {command} NAME:\n")
        listed({name: each for name, each in ready().items() if each.command == command})
        typer.echo()
    typer.echo("`crosscheck new NAME` writes one into a file of your own.")


@app.command()
def new(
    name: Annotated[str, typer.Argument(help="A ready scene or study, see `crosscheck list`.")],
    file: Annotated[Path | None, typer.Argument(help="Where to; NAME.toml if absent. Never overwritten.")] = None,
) -> None:
    """Write a ready scene or study into a file, to be changed."""
    from .library import ready, write

    path = file or Path(f"{name}.toml")
    with mistakes_said():
        from .naming import known

        every = ready()
        known("NAME", name, every)
        try:
            write(name, path)
        except FileExistsError as error:
            raise FileExistsError(
                f"{path} is there already, and nothing is overwritten: name another FILE"
            ) from error
    typer.echo(f"{path}: crosscheck {every[name].command} {path}")


@app.command()
def schema(
    kind: Annotated[str, typer.Argument(help="scene or study.")] = "scene",
    output: Annotated[Path | None, typer.Option(help="File; printed if absent.")] = None,
) -> None:
    """Write the JSON schema of scenes or of studies, for editors that complete and check TOML."""
    import json

    from .naming import known
    from .schema import schema
    from .store import write

    with mistakes_said(f"--output {output}"):
        known("KIND", kind, ("scene", "study"))
        text = json.dumps(schema(kind), indent=1, ensure_ascii=False)
        if output is None:
            typer.echo(text)
            return
        write(output, lambda file: file.write(f"{text}\n".encode()))


@app.command()
def run(
    scene: Annotated[
        str | None,
        typer.Argument(help="Scene as TOML, or the name of a ready one; without it, the paper's sphere and cone."),
    ] = None,
    output: Annotated[Path, typer.Option(help="Folder of the report and of what has been solved.")] = Path(
        "crosscheck-report"
    ),
    workers: Workers = None,
    scheduler: Scheduler = None,
) -> None:
    """Solve a scene in one and in three dimensions, compare, and write a report."""
    with mistakes_said(f"--output {output}"):
        from .jobs import asking

        job = asking.cases(scene)
    conducted(job, output, workers, scheduler)


@app.command()
def plan(
    scene: Annotated[str, typer.Argument(help="Scene as TOML, with or without [mdr] and [bem], or a ready one.")],
) -> None:
    """Say what would be simulated of a scene, what that costs, and what is left out; status 2 if no solver can."""
    from .planning import plans

    with mistakes_said():
        found = plans(scene)
    typer.echo(str(found))
    if not found.feasible:
        raise typer.Exit(MISTAKE)


@app.command()
def paper(
    output: Annotated[Path, typer.Option(help="Folder of the page and of what has been solved.")] = Path(
        "crosscheck-paper"
    ),
    profiles: Annotated[int, typer.Option(min=3, help="Rough profiles averaged; as published, 200.")] = 200,
    workers: Workers = None,
    scheduler: Scheduler = None,
) -> None:
    """Simulate the paper again in one dimension: its figures, its parameter studies, its claims."""
    from .jobs import asking

    conducted(asking.paper(profiles), output, workers, scheduler)


@app.command()
def mastercurve(
    table: Annotated[Path, typer.Argument(help="CSV of friction mu, normal force F_N [N] and speed v [m/s].")],
    output: Annotated[Path, typer.Option(help="Folder of the figure and its tables.")] = Path("mastercurve"),
) -> None:
    """Shift measured curves of friction against load onto one, and say whether that works."""
    from .run import shift

    with mistakes_said(f"--output {output}"):
        found = shift(table, output)
    printed(found)
    typer.echo(f"\nFigure and tables: {output.resolve()}")


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
    from .run import describe

    stated: dict[str, Any] = {"repeat": repeat, "peaks": peaks}
    if level:
        stated["level"] = level
    if pixel:
        stated["pixel"] = pixel[0] if len(pixel) == 1 else tuple(pixel)
    if unit:
        stated["unit"] = unit
    with mistakes_said(f"--output {output}"):
        found = describe(file, output, **stated)
    printed(found)
    typer.echo(f"\nFigure and tables: {output.resolve()}")


@app.command()
def study(
    name: Annotated[
        str | None, typer.Argument(help="Study, or a file with one of your own; without it, they are listed.")
    ] = None,
    size: Annotated[
        str, typer.Option(help="quick (minutes), standard (up to an hour) or paper (up to a day).")
    ] = "quick",
    output: Annotated[Path, typer.Option(help="Folder of pages and of what has been solved.")] = Path(
        "crosscheck-study"
    ),
    workers: Workers = None,
    scheduler: Scheduler = None,
) -> None:
    """Ask the claims of the paper of many contacts in one and in three dimensions, and write a page."""
    if name is None:
        from .studies.catalogue import STUDIES

        listed(STUDIES)
        typer.echo("`crosscheck study NAME` solves one, in minutes; --size says how much of it.")
        return
    with mistakes_said(f"--output {output}"):
        from .jobs import asking

        job = asking.study(name, size)
    conducted(job, output, workers, scheduler)


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
    scheduler: Annotated[
        str | None,
        typer.Option(help="Address of a dask scheduler for what is not timed; what is, is solved here."),
    ] = None,
) -> None:
    """Measure what accuracy costs in time, in one and in three dimensions, and write a page."""
    if name is None:
        from .workprecision.catalogue import INQUIRIES

        listed(INQUIRIES)
        typer.echo("`crosscheck workprecision NAME` measures one, in about a minute; --size full does it in full.")
        return
    with mistakes_said(f"--output {output}"):
        from .jobs import asking

        job = asking.costs([name], size)
    conducted(job, output, workers, scheduler)


@app.command()
def stability(
    size: Annotated[str, typer.Option(help="small (half a minute) or large (some minutes).")] = "small",
    output: Annotated[Path, typer.Option(help="Folder of the table and of what has been examined.")] = Path(
        "crosscheck-stability"
    ),
    workers: Workers = None,
    scheduler: Scheduler = None,
) -> None:
    """Solve the named hard cases, and say whether each keeps its law; status 1 if any does not."""
    with mistakes_said(f"--output {output}"):
        from .jobs import asking
        from .jobs.hardcases import broken

        job = asking.hardcases(size)
    found = conducted(job, output, workers, scheduler)
    if broken(found.judged):
        raise typer.Exit(FAILED)


@app.command()
def regress(
    baseline: Annotated[
        Path | None, typer.Option(help="Stored quantities as TOML; without it, those of the package.")
    ] = None,
    update: Annotated[bool, typer.Option("--update", help="Store what has moved.")] = False,
    output: Annotated[Path, typer.Option(help="Folder of what has been solved.")] = Path("crosscheck-regress"),
    workers: Workers = None,
    scheduler: Scheduler = None,
) -> None:
    """Say whether the accuracy of one dimension has moved from what is stored; status 1 if it has."""
    with mistakes_said(f"--output {output}"):
        from .jobs import asking
        from .regression import SHIPPED, rewrite

        job = asking.baseline(baseline, beginning=update)
    changes = conducted(job, output, workers, scheduler).judged
    left = changes.wrong
    if update:
        with interrupts_said():
            left = rewrite(baseline or SHIPPED, changes)
        typer.echo(f"Baseline: {baseline or SHIPPED}")
    if left:
        raise typer.Exit(FAILED)


@app.command()
def figures(
    folder: Annotated[Path, typer.Argument(help="That run, study, paper or another command left.")],
    journal: Annotated[str, typer.Option(help="Whose columns and least sizes; without it, no one's.")] = "default",
    style: Annotated[
        str | None, typer.Option(help="A style of matplotlib of your own: a .mplstyle file, or a name.")
    ] = None,
    output: Annotated[Path | None, typer.Option(help="Where to; `figures` in FOLDER if absent.")] = None,
) -> None:
    """Make every figure again, for a journal or in a style, from what is stored; nothing is solved."""
    with mistakes_said(f"--output {output or folder}"):
        from .redrawing import redraw

        found = redraw(folder, journal, style, output, typer.echo)
    typer.echo(found.summary)


@app.command()
def export(
    path: Annotated[Path, typer.Argument(help="A file of results, or a folder that a command left.")],
    to: Annotated[str, typer.Option(help="csv or latex.")] = "csv",
    output: Annotated[Path, typer.Option(help="Folder of the tables.")] = Path("crosscheck-tables"),
) -> None:
    """Write what is stored as tables: CSV with units, or LaTeX with booktabs."""
    with mistakes_said(f"--output {output}"):
        from .naming import known
        from .tables import export

        known("--to", to, ("csv", "latex"))
        written = export(path, output, to)
    for each in written:
        typer.echo(f"  {each}")
    typer.echo(f"\n{len(written)} tables: {output.resolve()}")


@app.command()
def animate(
    scene: Annotated[str, typer.Argument(help="Scene as TOML, or the name of a ready one.")],
    output: Annotated[
        Path | None, typer.Option(help="File, .gif or (where ffmpeg is there) .mp4; SCENE.gif if absent.")
    ] = None,
    solved: Annotated[Path, typer.Option(help="Folder of what has been solved.")] = Path("crosscheck-animation"),
    workers: Workers = None,
) -> None:
    """Solve a scene in time and draw it as it moves, in one and in three dimensions."""
    path = output or Path(f"{Path(scene).stem}.gif")
    with mistakes_said(f"--output {path}"), interrupts_said():
        from scene import SolveError

        from .run import animate

        try:
            animate(scene, path, solved, workers, progress=True)
        except SolveError as error:
            typer.echo(f"crosscheck: {error}", err=True)
            raise typer.Exit(FAILED) from error
    typer.echo(f"Animation: {path.resolve()}")


def main() -> None:
    """Entry point of the console command."""
    app()


if __name__ == "__main__":
    main()
