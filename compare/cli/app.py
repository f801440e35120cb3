"""The command `crosscheck`: every function of `compare.commands` as a command, and what it prints for people."""

import errno
import gc
import json
import os
import re
import signal
import sys
import warnings
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from inspect import Parameter, Signature, signature
from io import TextIOWrapper
from pathlib import Path
from typing import Annotated, Any, get_origin

import typer
from typer import Option

from .. import commands
from ..library import ready as library

FAILED, MISTAKE, INTERRUPTED = 1, 2, 130


def say(text: str, error: bool = False) -> None:
    """Print a text, with nothing in it that controls a terminal."""
    if not all(map(str.isprintable, text.split("\n"))):
        from scene.printable import printable

        text = printable(text)
    print(text, file=sys.stderr if error else sys.stdout, flush=True)


def print_in_any_encoding() -> None:
    """From now on letters that the encoding of the terminal lacks are printed as escapes."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")


@contextmanager
def said_to_people(output: str, solves: bool) -> Iterator[None]:
    """Report every mistake and every interrupt in one line, with the exit status that goes with it.

    output : the option that names the folder, with its value
    solves : whether something may have been stored before it went wrong
    """
    for number in (getattr(signal, name) for name in ("SIGTERM", "SIGHUP") if hasattr(signal, name)):
        if signal.getsignal(number) is signal.SIG_DFL:  # and not ignored, as by nohup
            signal.signal(number, signal.default_int_handler)
    try:
        yield
    except KeyboardInterrupt as interrupt:
        say("Interrupted. Solved contacts are kept: the same command resumes from there.", error=True)
        raise typer.Exit(INTERRUPTED) from interrupt
    except (ValueError, LookupError, RuntimeError) as error:
        from scene import Refused, SolveError
        from scene.files.reading import InvalidInput

        if not isinstance(error, InvalidInput | Refused | SolveError):
            raise
        say(f"crosscheck: {error}", error=True)
        raise typer.Exit(FAILED if isinstance(error, SolveError) else MISTAKE) from error
    except MemoryError as error:
        from scene import OutOfMemory

        complaint = str(error) if isinstance(error, OutOfMemory) else f"memory ran out {error}".strip()
        say(f"crosscheck: {complaint}", error=True)
        raise typer.Exit(FAILED) from error
    except OSError as error:
        from scene.printable import brief

        from ..solving.folders import Unwritable

        early = isinstance(error, Unwritable) or not solves
        where = f"{output}: " if isinstance(error, Unwritable) else ""
        complaint = (
            f"{brief(str(error.filename))}: {error.strerror}" if error.filename else error.strerror or str(error)
        )
        say(f"crosscheck: {where}{complaint}{'' if early else '. Solved contacts are kept.'}", error=True)
        raise typer.Exit(MISTAKE if early and error.errno != errno.ENOSPC else FAILED) from error


# Help is plain text: as markup of rich, what stands in brackets, units too, would be taken for a style and lost.
app = typer.Typer(
    no_args_is_help=True,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
    context_settings={"max_content_width": 100},
)

Quiet = Annotated[bool, Option("-q", "--quiet", help="Print mistakes only.")]
Verbose = Annotated[
    bool,
    Option("-v", "--verbose", help="Print every number and detail."),
]
AsJson = Annotated[bool, Option("--json", help="Print the answer as JSON: see crosscheck schema answers.")]


def _add(
    function: Callable[..., Any],
    text: Callable[[Any], str] = str,
    details: bool = False,
    reported: Callable[..., Any] | None = None,
) -> None:
    """Add a function of `compare.commands` as a command of the same name, arguments, options and defaults.

    text : function that returns the text to print for the returned value
    details : whether what it returns has details to print
    reported : what returns a report of the same arguments, where the function returns something else
    """
    parameters = {each.name: each for each in _parameters(function)}
    solves = "workers" in parameters
    more = {"quiet": Quiet} if solves else {}
    more |= {"verbose": Verbose} if solves or details else {}
    more |= {"json": AsJson} if text is not _schema else {}
    parameters |= {
        name: Parameter(name, Parameter.KEYWORD_ONLY, default=False, annotation=hint)
        for name, hint in more.items()
    }

    def called(quiet: bool = False, verbose: bool = False, json: bool = False, **given: Any) -> None:
        gc.enable()
        with warnings.catch_warnings(), said_to_people(f"--output {given.get('output')}", solves):
            # What Python is warned of stands at the top of what is printed.
            warnings.filterwarnings("ignore", category=UserWarning, module=re.escape(__name__))
            warnings.showwarning = lambda message, *_: say(f"crosscheck: {message}", error=True)
            if solves and not (quiet or json):
                given["progress"] = True
            found = (reported or function)(**given)
        _tell(found, text, quiet, verbose, json)

    called.__signature__ = Signature([*parameters.values()])  # type: ignore[attr-defined]
    called.__annotations__ = {name: each.annotation for name, each in parameters.items()}
    app.command(function.__name__, help=(function.__doc__ or "").partition("\n\n")[0])(called)


def _parameters(function: Callable[..., Any]) -> Iterator[Parameter]:
    """Parameters of a function that are annotated as `options` does, and those of `solve` that it hands on."""
    for each in signature(function).parameters.values():
        hint = vars(commands).get(each.annotation)
        if each.kind is each.VAR_KEYWORD:
            shared = commands.Options.__annotations__
            yield from (other for other in _parameters(commands.solve) if other.name in shared)
        elif get_origin(hint) is Annotated:
            yield each.replace(annotation=hint, kind=each.KEYWORD_ONLY)


def _tell(found: Any, text: Callable[[Any], str], quiet: bool, verbose: bool, json: bool) -> None:
    """Print what a function returned, and end with its status."""
    for line in getattr(found, "faults", ()):
        say(f"crosscheck: {line}", error=True)
    if quiet or json:
        for line in getattr(getattr(found, "unsolved", None), "sentences", ()):
            say(f"crosscheck: {line}", error=True)
    if json:
        say(commands.as_json(found))
    elif not quiet:
        say(found.details if verbose and hasattr(found, "details") else text(found))
    if getattr(found, "failed", False):
        raise typer.Exit(FAILED)
    if not getattr(found, "feasible", True):
        raise typer.Exit(MISTAKE)


def _written_ready(path: Path) -> str:
    text = path.read_text(encoding="utf-8")
    command = next(each.command for each in library.ready().values() if each.text == text)
    return f"{path} is written. Next: crosscheck {command} {path}"


def _schema(found: Mapping[str, Any]) -> str:
    return json.dumps(found, indent=1, ensure_ascii=False)


_add(commands.run)
_add(commands.sweep, reported=commands.swept)
_add(commands.trust)
_add(commands.study)
_add(commands.paper)
_add(commands.workprecision)
_add(commands.stability)
_add(commands.verify)
_add(commands.regress)
_add(commands.mastercurve)
_add(commands.topography)
_add(commands.plan, details=True)
_add(commands.scenes)
_add(commands.new, text=_written_ready)
_add(commands.schema, text=_schema)
_add(commands.export, text=lambda found: "\n".join(map(str, found)))
_add(commands.draw)


def _version(wanted: bool) -> None:
    if wanted:
        from importlib.metadata import version

        say(version("mdr-bem-crosscheck"))
        raise typer.Exit


@app.callback()
def crosscheck(
    version: Annotated[
        bool, Option("--version", callback=_version, is_eager=True, help="Print the version.")
    ] = False,
) -> None:
    """Measure how far the one-dimensional method can be trusted for rough, viscoelastic contacts."""


def main() -> None:
    """Entry point of the console command."""
    print_in_any_encoding()
    # The matrices of the judge are small: threads of BLAS would wait for one another on a busy machine.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    # What is imported stays: a third of the time of a short command went into looking for garbage among it.
    gc.disable()
    gc.set_threshold(100_000, 20, 100)  # where it is looked for later on, answers stay too
    try:
        app()
    except OSError as error:  # commands say their own: this one is of standard output
        say(f"crosscheck: standard output: {error.strerror}", error=True)
        raise SystemExit(FAILED) from error
    finally:
        gc.freeze()  # so that none is looked for at the end either, as all goes with the process
