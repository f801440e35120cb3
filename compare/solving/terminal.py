"""How far a run is, for people: bars on a terminal, plain lines elsewhere."""

import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager
from typing import Any

from rich import progress as bars
from rich.console import Console, RenderableType
from rich.markup import escape
from rich.table import Column

from scene.printable import printable

from .amounts import duration
from .cost import SECONDS
from .outcome import Outcome
from .runner import Progress, SweepProgress
from .task import Task

# Seconds between lines where there is no terminal to draw a bar on.
PAUSE = 5.0
# Seconds that workers take to start, until the first task is solved.
START = 3.0


class Moving(bars.Progress):
    """A bar that is brought up to date each time it is drawn. before : brings it up to date"""

    def __init__(self, *columns: bars.ProgressColumn, before: Callable[[], Any], **options: Any):
        self.before = before
        super().__init__(*columns, **options)

    def get_renderables(self) -> Iterable[RenderableType]:
        """Lines to draw now."""
        self.before()
        yield from super().get_renderables()


class SweepBar(SweepProgress):
    """Progress of a sweep on a console: a context.

    pause : seconds between lines where there is no bar; 0 for a line a task, and no bar
    clock : seconds that grow
    """

    def __init__(
        self, console: Console, pause: float = PAUSE, clock: Callable[[], float] = time.monotonic, bar: bool = True
    ):
        self.console, self.pause, self.clock = console, pause, clock
        self.shown = bar and console.is_terminal
        self.row: bars.TaskID | None = None
        # Where there is little room, what is being solved is cut off first, then the bar, never the times.
        self.bar = Moving(
            bars.BarColumn(bar_width=24),
            bars.TextColumn("{task.percentage:3.0f} %", table_column=Column(no_wrap=True, min_width=5)),
            bars.TimeElapsedColumn(table_column=Column(no_wrap=True, min_width=7)),
            bars.TextColumn("{task.fields[left]} left", table_column=Column(no_wrap=True, min_width=10)),
            bars.TextColumn("{task.fields[counts]}", markup=False, table_column=Column(no_wrap=True)),
            bars.TextColumn(
                "{task.description}",
                markup=False,
                table_column=Column(ratio=1, no_wrap=True, overflow="ellipsis"),
            ),
            before=self._move,
            console=console,
            get_time=clock,
            expand=True,
            transient=True,
            disable=not self.shown,
        )
        self.total = self.done = self.failed = self.reused = 0
        # Tasks that are solved now, with the times when they were handed out; and the time that solved ones took.
        self.doing, self.running, self.taken = "", dict[Task, float](), 0.0

    def __enter__(self):
        self.bar.start()
        return self

    def __exit__(self, *_):
        self.bar.stop()
        if self.done:
            of = f"{self.done}" if self.done == self.total else f"{self.done} of {self.total}"
            failed = [f"{self.failed} failed"] if self.failed else []
            parts = [f"{of} tasks solved", f"{self.reused} reused", *failed, duration(self.clock() - self.start)]
            self.console.print(", ".join(parts), markup=False)

    def planned(self, tasks: Sequence[Task], reused: int) -> None:
        """The tasks that have to be solved, and how many more the store has."""
        if self.row is not None:
            self.bar.remove_task(self.row)
        self.total, self.done, self.failed, self.reused = len(tasks), 0, 0, reused
        self.start = self.last = self.clock()
        self.work, self.all_work = 0.0, sum(task.work for task in tasks) or 1.0
        self.reached = self.taken = 0.0
        self.row = self.bar.add_task("", total=self.all_work, counts=self._counts(), left="?")
        if tasks and not self.shown:
            self.console.print(f"{len(tasks)} tasks to solve" + (f", {reused} reused" if reused else ""))

    def started(self, task: Task) -> None:
        """A task is handed out to a worker."""
        self.running[task] = self.clock()
        self._tell()

    def finished(self, task: Task, outcome: Outcome) -> None:
        """A task is solved and stored, or has failed."""
        now = self.clock()
        self.taken += now - self.running.pop(task, now)
        self.done, self.work = self.done + 1, self.work + task.work
        self.failed += any(row.reason is not None for row in outcome.rows)
        self._tell()
        if not self.shown and now - self.last >= self.pause:
            self.last = now
            self.said(f"{self._counts()}, {self._left()} left, solved {task.label}")

    def said(self, line: str) -> None:
        """A line for a person."""
        self.console.print(printable(line), markup=False)

    def interrupted(self) -> None:
        """Tell that nothing more is started."""
        self.doing = "finishing "
        if not self.shown:
            self.console.print("finishing the tasks under way")
        self._tell()

    def _reached(self):
        """Work that is done, with the share of running tasks that they should have by now; it never falls.

        A unit of work takes what it took until now, and before any is solved, what it is expected to take. After
        its time a task counts half, and the rest comes ever more slowly: the bar neither stops nor is full.
        """
        known = self.work and self.taken
        now, unit, start = self.clock(), self.taken / self.work if known else SECONDS, 0.0 if known else START
        shares = (
            task.work * (now - since) / (now - since + unit * task.work + start)
            for task, since in list(self.running.items())
            if now > since
        )
        self.reached = max(self.reached, self.work, self.work + sum(shares))
        return self.reached

    def _left(self):
        """Time left if the work goes on as it went until now."""
        reached = self._reached()
        return duration((self.clock() - self.start) * (self.all_work / reached - 1) if reached else None)

    def _move(self):
        if self.row is not None:
            self.bar.update(self.row, completed=self._reached(), left=self._left())

    def _counts(self):
        return f"{self.done}/{self.total}" + (f", {self.failed} failed" if self.failed else "")

    def _tell(self):
        if self.row is not None:
            what = self.doing + printable(next((task.label for task in self.running), ""))
            self.bar.update(self.row, counts=self._counts(), description=what)


class Preparing:
    """A bar from the first second, while a command imports, reads and plans; a context, ended by whoever is next.

    lines : whether lines are printed in place of bars
    """

    def __init__(self, lines: bool = False) -> None:
        self.lines, self.console = lines, Console(highlight=False, soft_wrap=True)
        shown = self.console.is_terminal and not lines
        columns = bars.BarColumn(bar_width=24), bars.TimeElapsedColumn(), bars.TextColumn("{task.description}")
        self.bar = bars.Progress(*columns, console=self.console, transient=True, disable=not shown)
        self.bar.add_task("preparing", total=None)

    def __enter__(self) -> "Preparing":
        self.bar.start()
        return self

    def __exit__(self, *_: object) -> None:
        self.end()

    def end(self) -> None:
        """Take the bar away, once or again."""
        self.bar.stop()


def shown(preparing: Preparing) -> Progress:
    """Progress that tells a terminal how far a run is: bars, or a line for each solve and each figure.

    preparing : what is shown until then, on the same terminal
    """
    console, lines = preparing.console, preparing.lines

    def solving() -> SweepBar:
        preparing.end()
        return SweepBar(console, pause=0.0, bar=False) if lines else SweepBar(console)

    def writing(count: int) -> AbstractContextManager[Callable[[str], Any]]:
        preparing.end()
        return _figures(console, count, lines)

    return Progress(lambda line: console.print(line, markup=False), solving, writing)


@contextmanager
def _figures(console: Any, count: int, lines: bool) -> Iterator[Callable[[str], Any]]:
    """A bar over the figures of a page while they are drawn."""
    if lines:
        yield lambda name: console.print(f"  figure {printable(name)}", markup=False)
        return
    with bars.Progress(console=console, transient=True, disable=not console.is_terminal) as bar:
        drawn = bar.add_task("Writing the page", total=count)
        yield lambda name: bar.update(drawn, advance=1, description=f"Drawing {escape(printable(name))}")
