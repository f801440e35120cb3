"""Progress of a run as people see it: bars on a terminal and in a notebook, plain lines elsewhere."""

import time
from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager
from io import StringIO
from typing import Any

from rich import progress as bars
from rich.console import Console, Group, RenderableType
from rich.markup import escape
from rich.padding import Padding
from rich.table import Column
from rich.text import Text

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


class Notebook(Console):
    """Console of a notebook: one output for all that is said, brought up to date in its place, and a bar below."""

    def __init__(self) -> None:
        super().__init__(force_jupyter=False, force_terminal=False, file=StringIO())
        self.lines = list[Text]()
        self.place: Any = None

    def print(self, *said: Any, **look: Any) -> None:
        """Say one more line, or take the bar away."""
        self.lines += map(Text, said)
        self.show()

    def show(self, *below: RenderableType) -> None:
        """Bring the output up to date: lines, and what stands below them."""
        from IPython.display import display

        content = Padding(Group(*self.lines, *below), 0, expand=False)
        if self.place is None:
            self.place = display(content, display_id=True)
        else:
            self.place.update(content)


class Bar(bars.Progress):
    """A bar on a terminal or in a notebook. before : brings it up to date each time it is drawn"""

    def __init__(
        self, console: Console, *columns: Any, shown: bool = True, before: Callable[[], Any] = str, **options: Any
    ):
        self.before = before
        disable = not (shown and (console.is_terminal or isinstance(console, Notebook)))
        super().__init__(*columns, console=console, transient=True, disable=disable, **options)
        if isinstance(console, Notebook):
            self.live.refresh = lambda: console.show(self.get_renderable())  # type: ignore[method-assign]

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
        self.row: bars.TaskID | None = None
        # Where there is little room, what is being solved is cut off first, then the bar, never the times.
        self.bar = Bar(
            console,
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
            shown=bar,
            before=self._move,
            get_time=clock,
            expand=True,
        )
        self.shown = not self.bar.disable
        self.total = self.done = self.failed = self.reused = 0
        # Tasks that are solved now, with the times when they were handed out.
        self.doing, self.running = "", dict[Task, float]()

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
        self.start = self.last = self.since = self.clock()
        # Work of all tasks, and of solved ones with the seconds that it took, by solver: their units differ.
        self.every, self.solved, self.took = (defaultdict[type, float](float) for _ in range(3))
        for task in tasks:
            self.every[_solver(task)] += task.work
        self.reached = 0.0
        self.row = self.bar.add_task("", total=1.0, counts=self._counts(), left="?")
        if tasks and not self.shown:
            self.console.print(f"{len(tasks)} tasks to solve" + (f", {reused} reused" if reused else ""))

    def started(self, task: Task) -> None:
        """A task is handed out to a worker."""
        self.running[task] = self.clock()
        self._tell()

    def finished(self, task: Task, outcome: Outcome) -> None:
        """A task is solved and stored, or has failed."""
        now, solver = self.clock(), _solver(task)
        handed_out = self.running.pop(task, now)
        took = sum(row.seconds for row in outcome.rows if row.seconds > 0) or now - handed_out
        if not self.done:  # until then workers were starting
            self.since = max(self.start, now - took)
        self.done += 1
        self.solved[solver] += task.work
        self.took[solver] += took
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

    def _seconds(self):
        """Seconds that all takes, as known by now, and of each running task those expected and spent.

        A unit of work takes what it took until now, and before any is solved, what it is expected to take.
        """
        unit = {each: self.took[each] / self.solved[each] if self.took[each] else SECONDS for each in self.every}
        now, start = self.clock(), 0.0 if self.done else START
        running = [
            (unit[_solver(task)] * task.work + start, now - max(handed_out, self.since))
            for task, handed_out in list(self.running.items())
        ]
        return sum(unit[each] * work for each, work in self.every.items()) or 1.0, running

    def _left(self):
        """Time left at the pace until now, a quarter more of tasks that are late; not known of late first ones."""
        now, (whole, running) = self.clock(), self._seconds()
        if not self.done:
            left = START + whole / max(len(running), 1) - (now - self.start)
            return duration(left if left > 0 else None)
        done = sum(self.took.values()) + sum(spent for _, spent in running)
        late = sum(max(0.0, 1.25 * spent - expected) for expected, spent in running)
        return duration((now - self.since) * max(0.0, (whole + late) / done - 1) if done else None)

    def _move(self):
        """Bring the bar up to date: late tasks go on ever more slowly, so that it neither stops nor is full."""
        if self.row is not None:
            whole, running = self._seconds()
            start = 0.0 if self.done else START
            shares = (
                (expected - start) * (part if part < 0.8 else 1 - 0.04 / (part - 0.6))
                for expected, spent in running
                for part in [spent / (expected or 1.0)]
            )
            self.reached = max(self.reached, (sum(self.took.values()) + sum(shares)) / whole)
            self.bar.update(self.row, completed=self.reached, left=self._left())

    def _counts(self):
        return f"{self.done}/{self.total}" + (f", {self.failed} failed" if self.failed else "")

    def _tell(self):
        if self.row is not None:
            what = self.doing + printable(next((task.label for task in self.running), ""))
            self.bar.update(self.row, counts=self._counts(), description=what)


def _solver(task):
    return type(getattr(task, "solver", task))


class Preparing:
    """A bar from the first second, while a command imports, reads and plans; a context, ended by whoever is next.

    lines : whether lines are printed in place of bars
    """

    def __init__(self, lines: bool = False) -> None:
        self.lines, self.console = lines, Console(highlight=False, soft_wrap=True)
        if self.console.is_jupyter and not lines:
            self.console = Notebook()
        columns = bars.BarColumn(bar_width=24), bars.TimeElapsedColumn(), bars.TextColumn("{task.description}")
        self.bar = Bar(self.console, *columns, shown=not lines)
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
    with Bar(console, *bars.Progress.get_default_columns()) as bar:
        drawn = bar.add_task("Drawing", total=count)
        yield lambda name: bar.update(drawn, advance=1, description=f"Drawing {escape(printable(name))}")
