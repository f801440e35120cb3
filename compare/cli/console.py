"""Output of a command for people, and every mistake in a line."""

import errno
import os
import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from io import TextIOWrapper

import typer

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
        os.getcwd()
    except OSError as error:
        say("crosscheck: the folder in which it is called is gone", error=True)
        raise typer.Exit(MISTAKE) from error
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

        told = str(error) if isinstance(error, OutOfMemory) else f"memory ran out {error}".strip()
        say(f"crosscheck: {told}", error=True)
        raise typer.Exit(FAILED) from error
    except OSError as error:
        from scene.printable import brief

        from ..solving.folders import Unwritable

        early = isinstance(error, Unwritable) or not solves
        where = f"{output}: " if isinstance(error, Unwritable) else ""
        told = (
            f"{brief(str(error.filename))}: {error.strerror}" if error.filename else error.strerror or str(error)
        )
        say(f"crosscheck: {where}{told}{'' if early else '. Solved contacts are kept.'}", error=True)
        raise typer.Exit(MISTAKE if early and error.errno != errno.ENOSPC else FAILED) from error
