"""The command `crosscheck`: every function of `compare.commands` as a command, its docstring as the help."""

import gc
import inspect
import json
import os
import re
import warnings
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import NoneType, SimpleNamespace, UnionType
from typing import Annotated, Any, Literal, Union, get_args, get_origin, get_type_hints

import typer

from .. import commands
from ..library import ready as library
from ..solving.docstrings import documented
from .completion import completion
from .console import FAILED, MISTAKE, print_in_any_encoding, said_to_people, say

# Help is plain text: as markup of rich, what stands in brackets, units too, would be taken for a style and lost.
app = typer.Typer(
    no_args_is_help=True,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
    context_settings={"max_content_width": 100},
)

# What stands on a command line for types that are slow to import.
STAND_INS = {
    "SceneLike": str,
    "ModelLike": str,
    "Measurements": Path,
    "Surface": Path,
    "Values": Sequence[str],
}
# Arguments by their place, though they may be absent.
PLACED = ("scene", "name", "file", "kind")
# What a Python call states and a command line cannot.
PYTHON_ONLY = {"quantities", "progress", "options"}
SHARED = {
    name: each
    for name, each in inspect.signature(commands.solve).parameters.items()
    if name in commands.Options.__annotations__ and name not in PYTHON_ONLY
}
Quiet = Annotated[bool, typer.Option("-q", "--quiet", help="Print mistakes only.")]
Verbose = Annotated[
    bool, typer.Option("-v", "--verbose", help="Print a line for each solve and each figure, and every number.")
]
AsJson = Annotated[bool, typer.Option("--json", help="Print the answer as JSON: see crosscheck schema answers.")]


@dataclass(frozen=True)
class Command:
    """One command.

    function : of the same name in Python
    reported : what returns a report of the same arguments, where the function returns something else
    said : what is printed of what it returns
    details : help of the option that prints the details of what it returns; empty where it has none
    brief : whether it ends so soon that no garbage is looked for
    """

    function: Callable[..., Any]
    said: Callable[[Any], str] = str
    details: str = ""
    brief: bool = False
    reported: Callable[..., Any] | None = None

    @property
    def title(self) -> str:
        """Name on the command line, and in Python."""
        return self.function.__name__

    @property
    def solves(self) -> bool:
        """Whether the command has the options of all commands that solve."""
        return "options" in inspect.signature(self.function).parameters

    @property
    def tells(self) -> bool:
        """Whether it can tell how far it is."""
        return self.solves or "progress" in inspect.signature(self.function).parameters

    def callback(self) -> Callable[..., None]:
        """Function with a signature that typer turns into arguments and options."""
        found = inspect.signature(self.function).parameters
        taken = {name: each for name, each in found.items() if name not in PYTHON_ONLY}
        if self.solves:
            taken |= SHARED
        about, own = documented(self.function.__doc__)
        texts = documented(commands.__doc__)[1] | own
        stated = SimpleNamespace(__annotations__={name: each.annotation for name, each in taken.items()})
        hints = get_type_hints(stated, vars(commands), STAND_INS)
        parameters = [
            _parameter(self.title, name, hints[name], each.default, texts.get(name, ""))
            for name, each in taken.items()
        ]
        if self.solves:
            parameters += [_keyword("quiet", Quiet), _keyword("verbose", Verbose)]
        elif self.details:
            details = typer.Option("-v", "--verbose", help=self.details)
            parameters += [_keyword("verbose", Annotated[bool, details])]
        if self.said is not _schema:
            parameters.append(_keyword("json", AsJson))

        def called(**given: Any) -> None:
            self(**given)

        called.__doc__ = about
        called.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
        called.__annotations__ = {each.name: each.annotation for each in parameters}
        return called

    def __call__(self, quiet: bool = False, verbose: bool = False, json: bool = False, **given: Any) -> None:
        """Do the command, print what came of it, and end with its status."""
        output = f"--output {given.get('output')}"
        with warnings.catch_warnings(), said_to_people(output, solves=self.solves):
            # What Python is warned of stands at the top of what is printed.
            warnings.filterwarnings("ignore", category=UserWarning, module=re.escape(__name__))
            warnings.showwarning = lambda message, *_: say(f"crosscheck: {message}", error=True)
            found = self._answer(given, shown=not (quiet or json), lines=verbose)
        swept = getattr(found, "swept", None)
        if swept is not None and swept.reused and not swept.solved and not (quiet or json):
            say(f"0 tasks solved, {swept.reused} reused")
        for line in getattr(found, "faults", ()):
            say(f"crosscheck: {line}", error=True)
        if quiet or json:
            for line in getattr(getattr(found, "unsolved", None), "sentences", ()):
                say(f"crosscheck: {line}", error=True)
        if json:
            say(commands.as_json(found))
        elif not quiet:
            say(found.details if verbose and hasattr(found, "details") else self.said(found))
        if getattr(found, "failed", False):
            raise typer.Exit(FAILED)
        if not getattr(found, "feasible", True):
            raise typer.Exit(MISTAKE)

    def _answer(self, given: dict[str, Any], shown: bool, lines: bool) -> Any:
        """What the function returns; shown : whether a terminal shows how far it is, in lines or as a bar."""
        if not self.brief:
            gc.enable()
        function = self.reported or self.function
        if not (self.tells and shown):
            return function(**given)
        from ..solving.terminal import Preparing  # slow, and only what solves needs it

        with Preparing(lines=lines) as progress:
            return function(**given, progress=progress)


def _parameter(command: str, name: str, hint: Any, default: Any, text: str) -> inspect.Parameter:
    """Argument or option of a command.

    text : what the docstring says of it, with more on Python alone; empty in Python without docstrings
    """
    kind, values = _on_command_line(hint)
    text = text.partition(". From Python")[0]
    about: Any = {
        "help": text and f"{text[0].upper()}{text[1:]}.",
        "autocompletion": completion(command, name, values),
    }
    if default is inspect.Parameter.empty or name in PLACED:
        told = typer.Argument(**about)
    elif kind is bool and not default:
        told = typer.Option(f"--{name}", **about)  # no --no-NAME beside it
    else:
        told = typer.Option(**about)
    return _keyword(name, Annotated[kind, told], default)


def _on_command_line(hint: Any) -> tuple[Any, list[str]]:
    """Type on a command line of what a function takes, and its values where these are fixed.

    A string stands for all that Python states in other ways too.
    """
    members = get_args(hint) if get_origin(hint) in (Union, UnionType) else (hint,)
    values = [value for each in members if get_origin(each) is Literal for value in get_args(each)]
    if any(get_origin(each) is Sequence for each in members):
        kind: Any = list[str]
    elif Path in members:
        kind = Path
    else:
        kind = members[0] if members[0] in (bool, int, float) else str
    return (kind | None if NoneType in members else kind), values


def _keyword(name, annotation, default=False):
    return inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=default, annotation=annotation)


def _paths(found: Any) -> str:
    if not found:
        return "0 files"
    folder = os.path.commonpath([path.parent.resolve() for path in found])
    places = (path.resolve().relative_to(folder) for path in found)
    return "\n".join([*(f"  {place}" for place in places), f"{len(found)} files: {folder}"])


def _written_ready(path: Path) -> str:
    text = path.read_text(encoding="utf-8")
    command = next(each.command for each in library.ready().values() if each.text == text)
    return f"{path} is written. Next: crosscheck {command} {path}"


def _schema(found: Mapping[str, Any]) -> str:
    return json.dumps(found, indent=1, ensure_ascii=False)


COMMANDS = (
    Command(commands.run),
    Command(commands.sweep, reported=commands.swept),
    Command(commands.trust, brief=True),
    Command(commands.study),
    Command(commands.paper),
    Command(commands.workprecision),
    Command(commands.stability),
    Command(commands.verify),
    Command(commands.regress),
    Command(commands.mastercurve),
    Command(commands.topography),
    Command(commands.plan, details="Print settings, grids, kernels, and the advice on 1D as well."),
    Command(commands.scenes, details="Print what each scene and each study is about."),
    Command(commands.new, said=_written_ready),
    Command(commands.schema, said=_schema),
    Command(commands.export, said=_paths),
    Command(commands.draw),
)
for _each in COMMANDS:
    app.command(_each.title)(_each.callback())


def _version(wanted: bool) -> None:
    if wanted:
        from importlib.metadata import version

        say(version("mdr-bem-crosscheck"))
        raise typer.Exit


@app.callback()
def crosscheck(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Print the version.")
    ] = False,
) -> None:
    """How far the one-dimensional method can be trusted for rough, viscoelastic contacts."""


def main() -> None:
    """Entry point of the console command."""
    print_in_any_encoding()
    # The matrices of the judge are small: threads of BLAS would wait for one another on a busy machine.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    # What is imported stays: a third of the time of a short command went into looking for garbage among it.
    gc.disable()
    try:
        app()
    except OSError as error:  # commands say their own: this one is of standard output
        say(f"crosscheck: standard output: {error.strerror}", error=True)
        raise SystemExit(FAILED) from error
    finally:
        gc.freeze()  # so that none is looked for at the end either, as all goes with the process
