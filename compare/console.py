"""Output of a command for people: its progress, and every mistake in a line."""

import signal
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from typing import TYPE_CHECKING, Any

import typer

if TYPE_CHECKING:
    from .pipeline import Watch

FAILED, MISTAKE, INTERRUPTED = 1, 2, 130


def say(text: str, error: bool = False) -> None:
    """Print a text, with nothing in it that controls a terminal."""
    if not all(map(str.isprintable, text.split("\n"))):
        from scene.printable import printable  # slow, and few texts need it

        text = printable(text)
    typer.echo(text, err=error)


class Preparing:
    """A bar from the first second, while a command imports, reads and plans; a context, ended by whoever is next.

    lines : whether lines are printed in place of bars
    """

    def __init__(self, lines: bool = False) -> None:
        from rich.console import Console
        from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

        self.lines, self.console = lines, Console(highlight=False, soft_wrap=True)
        shown = self.console.is_terminal and not lines
        columns = BarColumn(bar_width=24), TimeElapsedColumn(), TextColumn("{task.description}")
        self.bar = Progress(*columns, console=self.console, transient=True, disable=not shown)
        self.bar.add_task("preparing", total=None)

    def __enter__(self) -> "Preparing":
        self.bar.start()
        return self

    def __exit__(self, *_: object) -> None:
        self.end()

    def end(self) -> None:
        """Take the bar away, once or again."""
        self.bar.stop()


def watch(preparing: Preparing) -> "Watch":
    """A watch that tells a terminal how far a run is: bars, or a line for each solve and each figure.

    preparing : what is shown until then, on the same terminal
    """
    from . import progress
    from .pipeline import Watch

    console, lines = preparing.console, preparing.lines

    def solving() -> progress.Watched:
        preparing.end()
        return progress.Watched(console, pause=0.0, bar=False) if lines else progress.Watched(console)

    def writing(count: int) -> AbstractContextManager[Callable[[str], Any]]:
        preparing.end()
        return _figures(console, count, lines)

    return Watch(lambda line: console.print(line, markup=False), solving, writing)


@contextmanager
def _figures(console: Any, count: int, lines: bool) -> Iterator[Callable[[str], Any]]:
    """A bar over the figures of a page while they are drawn."""
    from rich.markup import escape
    from rich.progress import Progress

    from scene.printable import printable

    if lines:
        yield lambda name: console.print(f"  figure {printable(name)}", markup=False)
        return
    with Progress(console=console, transient=True, disable=not console.is_terminal) as bar:
        drawn = bar.add_task("Writing the page", total=count)
        yield lambda name: bar.update(drawn, advance=1, description=f"Drawing {escape(printable(name))}")


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
        from scene.reading import InvalidInput

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

        from .pipeline import Unwritable

        early = isinstance(error, Unwritable) or not solves
        where = f"{output}: " if isinstance(error, Unwritable) else ""
        told = f"{brief(str(error.filename))}: {error.strerror}" if error.filename else str(error)
        say(f"crosscheck: {where}{told}{'' if early else '. Solved contacts are kept.'}", error=True)
        raise typer.Exit(MISTAKE if early else FAILED) from error
