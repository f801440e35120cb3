"""The command `crosscheck`: every function of `compare.commands` as a command of the same name and arguments."""

import inspect
import json
import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

import typer

from . import commands
from .console import FAILED, MISTAKE, said_to_people

app = typer.Typer(add_completion=False, no_args_is_help=True, pretty_exceptions_enable=False)

# One meaning of an argument wherever it stands: its type on a command line, and what it is.
ARGUMENTS = {
    ("run", "scene"): (
        str | None,
        "Scene as TOML, or the name of a ready one; the paper's sphere and cone if absent.",
    ),
    ("plan", "scene"): (str, "Scene as TOML, or the name of a ready one."),
    ("animate", "scene"): (str, "Scene as TOML, or the name of a ready one."),
    ("study", "name"): (str | None, "Study, or a file with one of your own; absent, the studies are listed."),
    ("workprecision", "name"): (str | None, "Diagram, or all of them by the name all; absent, they are listed."),
    ("mastercurve", "table"): (Path, "CSV of friction mu, normal force F_N [N] and speed v [m/s]."),
    ("topography", "file"): (Path, "Map of heights: .npy, .npz, .csv, .txt, or as SurfaceTopography reads it."),
    ("figures", "folder"): (Path, "Folder that a command left."),
    ("export", "folder"): (Path, "Folder that a command left, or a file of results."),
    ("new", "name"): (str, "Ready scene or study, see `crosscheck list`."),
    ("new", "file"): (Path | None, "Where to; NAME.toml if absent. Never overwritten."),
    ("schema", "kind"): (str, "scene or study."),
}
OPTIONS = {
    "size": (str, "How much is solved: quick, standard or full."),
    "output": (Path | None, "Folder of the page and of what has been solved."),
    "baseline": (Path | None, "Stored quantities as TOML; those of the package if absent."),
    "update": (bool, "Store what has moved."),
    "pixel": (list[float] | None, "Side of a pixel [m]; twice, along x and y. If the file has none."),
    "unit": (str | None, "Of its heights: m, mm, um, nm. If the file has none."),
    "level": (str | None, "Taken off first: mean, tilt or curvature. If absent tilt; mean of what is periodic."),
    "repeat": (str, "How the map goes on: mirror or periodic."),
    "peaks": (str, "Heights grow towards the elastomer, up, or away, down."),
    "journal": (str, "Whose columns and least sizes; none in particular if default."),
    "style": (str | None, "Style of matplotlib of your own: a .mplstyle file, or a name."),
    "to": (str, "csv or latex."),
    "frames": (int, "How many pictures."),
    "seconds": (float, "How long the animation lasts [s]."),
    "folder": (Path, "Folder of what has been solved."),
    "workers": (int | None, "Processes; as many as processors if absent."),
    "scheduler": (str | None, "Address of a dask scheduler, as tcp://host:8786, whose workers then solve."),
    "format": (str, "Of the page: html, markdown or latex."),
    "figures": (str, "Forms of the figures: png, or png,pdf,svg."),
    "report": (bool, "Whether the page and its figures are written."),
}
# What a Python call states and a command line cannot.
PYTHON_ONLY = {"quantities", "progress"}
SHARED = {"workers": None, "scheduler": None, "format": "html", "figures": "png", "report": True}
Quiet = Annotated[bool, typer.Option("-q", "--quiet", help="Say nothing but mistakes.")]
Verbose = Annotated[bool, typer.Option("-v", "--verbose", help="Say each solve and each figure.")]
AsJson = Annotated[bool, typer.Option("--json", help="Print the findings as JSON.")]


@dataclass(frozen=True)
class Command:
    """One command.

    function : of the same name in Python
    said : what is printed of what it returns
    """

    function: Callable[..., Any]
    said: Callable[[Any], str] = str
    name: str = ""

    @property
    def title(self) -> str:
        """Name on the command line."""
        return self.name or self.function.__name__

    @property
    def solves(self) -> bool:
        """Whether it has the options of all commands that solve."""
        return "options" in inspect.signature(self.function).parameters

    def parameters(self) -> dict[str, Any]:
        """Arguments and their defaults, those that all commands share included."""
        found = inspect.signature(self.function).parameters
        own = {name: each.default for name, each in found.items() if name not in PYTHON_ONLY and name != "options"}
        return own | (SHARED if self.solves else {})

    def callback(self) -> Callable[..., None]:
        """Function with a signature that typer turns into arguments and options."""
        parameters = [self._parameter(name, default) for name, default in self.parameters().items()]
        if self.solves:
            parameters += [_keyword("quiet", Quiet), _keyword("verbose", Verbose), _keyword("json", AsJson)]

        def called(**given: Any) -> None:
            self(**given)

        called.__doc__ = (self.function.__doc__ or "").split("\n\n")[0]
        called.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
        called.__annotations__ = {each.name: each.annotation for each in parameters}
        return called

    def __call__(self, quiet: bool = False, verbose: bool = False, json: bool = False, **given: Any) -> None:
        """Do the command, print what came of it, and end with its status."""
        with said_to_people(f"--output {given.get('output')}", solves=self.solves):
            if self.solves:
                given["progress"] = "lines" if verbose else not (quiet or json)
            elif "progress" in inspect.signature(self.function).parameters:
                given["progress"] = True
            found = self.function(**given)
        swept = getattr(found, "swept", None)
        if swept is not None and swept.reused and not swept.solved and not (quiet or json):
            typer.echo(f"0 tasks solved, {swept.reused} reused")
        for line in getattr(found, "faults", ()):
            typer.echo(f"crosscheck: {line}", err=True)
        if json:
            typer.echo(_as_json(found))
        elif not quiet:
            typer.echo(self.said(found))
        if getattr(found, "failed", False):
            raise typer.Exit(FAILED)
        if not getattr(found, "feasible", True):
            raise typer.Exit(MISTAKE)

    def _parameter(self, name, default):
        kind, text = ARGUMENTS.get((self.title, name)) or OPTIONS[name]
        if (self.title, name) in ARGUMENTS:
            told = typer.Argument(help=text)
        elif name == "report":
            told = typer.Option("--report/--no-report", help=text)
        else:
            told = typer.Option(f"--{name}", help=text, **({"min": 1} if name == "workers" else {}))
        if isinstance(default, str) and kind in (Path, Path | None):
            default = Path(default)
        return inspect.Parameter(
            name, inspect.Parameter.KEYWORD_ONLY, default=default, annotation=Annotated[kind, told]
        )


def _keyword(name, annotation):
    return inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=False, annotation=annotation)


def _as_json(found: Any) -> str:
    if hasattr(found, "findings"):
        rows = json.loads(found.findings.to_json(orient="records", double_precision=15))
        return json.dumps({"page": str(found.path) if found.path else None, "findings": rows}, indent=1)
    return json.dumps({name: str(each) for name, each in dict(found).items()}, indent=1)


def _paths(found: Any) -> str:
    folders = sorted({str(path.parent.resolve()) for path in found})
    return "\n".join([*(f"  {path.name}" for path in found), f"{len(found)} files: {', '.join(folders)}"])


def _written_ready(path: Path) -> str:
    text = path.read_text(encoding="utf-8")
    command = next(each.command for each in commands.ready().values() if each.text == text)
    return f"{path}: crosscheck {command} {path}"


def _schema(found: Mapping[str, Any]) -> str:
    return json.dumps(found, indent=1, ensure_ascii=False)


COMMANDS = (
    Command(commands.run),
    Command(commands.study),
    Command(commands.paper),
    Command(commands.workprecision),
    Command(commands.stability),
    Command(commands.regress),
    Command(commands.mastercurve),
    Command(commands.topography),
    Command(commands.plan),
    Command(commands.ready, name="list"),
    Command(commands.new, said=_written_ready),
    Command(commands.schema, said=_schema),
    Command(commands.figures, said=_paths),
    Command(commands.export, said=_paths),
    Command(commands.animate, said=lambda path: f"Animation: {path.resolve()}"),
)
for _each in COMMANDS:
    app.command(_each.title)(_each.callback())


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


def main() -> None:
    """Entry point of the console command."""
    # The matrices of the judge are small: threads of BLAS would wait for one another on a busy machine.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    app()
