"""Progress of a run on standard error: a bar on a terminal and in a notebook, else a line every ten seconds."""

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from io import StringIO
from typing import Any

from rich import progress as bars
from rich.console import Console, Group
from rich.padding import Padding
from rich.table import Column
from rich.text import Text

from scene.printable import printable

from .amounts import duration
from .cost import SECONDS
from .runner import Progress, SweepProgress
from .task import Task

PAUSE = 10.0  # seconds between lines where there is no terminal to draw a bar on
LONG = 60.0  # seconds of a task of which compiling is a small part


class Shown(SweepProgress):
    """What a person sees of a run, a bar for each phase: a context.

    lines : whether a line is printed for each solve and each figure, in place of a bar
    clock : seconds that grow
    """

    def __init__(
        self, lines: bool = False, console: Console | None = None, clock: Callable[[], float] = time.monotonic
    ) -> None:
        console = console or Console(stderr=True, highlight=False, soft_wrap=True)
        self.lines, self.clock, self.notebook = lines, clock, console.is_jupyter
        self.console = Console(file=StringIO(), force_jupyter=False) if self.notebook else console
        drawn = console.is_interactive and not self.notebook
        # Where there is little room, the end of the last column is cut off.
        last = Column(ratio=1, no_wrap=True, overflow="ellipsis")
        self.bar = bars.Progress(
            bars.TextColumn("{task.description}"),
            bars.BarColumn(bar_width=24),
            bars.TimeElapsedColumn(),
            bars.TextColumn("{task.fields[shown]}", markup=False, table_column=last),
            console=self.console,
            get_time=clock,
            expand=True,
            transient=True,
            redirect_stdout=False,
            refresh_per_second=10 if drawn else 2 if self.notebook else 1 / PAUSE,
        )
        if not drawn:
            self.bar.live.refresh = self._refresh  # type: ignore[method-assign]
        self.progress = Progress(self.said, self.solving, self.writing)
        self.output: Any = None  # of a notebook: one for all lines, with the bar below them
        self.told, self.last = list[Text](), clock()
        self._begin("preparing")

    def __enter__(self) -> "Shown":
        if not self.lines:
            self.bar.live.start()
        return self

    def __exit__(self, *_: object) -> None:
        self.bar.live.stop()
        self._begin("")

    def __str__(self) -> str:
        """What the phase waits for, with counts and the time left."""
        labels = [printable(task.label) for task in self.running.copy()]
        return ", ".join([*self._counts(), *labels[:1]]) if self.tasks else self.waits_for

    def _counts(self) -> list[str]:
        failed = [f"{self.failed} failed"] if self.failed else []
        left = [f"{duration(left)} left"] if (left := self._left()) >= 0.5 else []
        return [f"{self.done}/{self.tasks}", *failed, *left]

    def _left(self) -> float:
        """Seconds left, from the work planned and the pace of the work done; as `cost` expects before any is."""
        now, unit = self.clock(), self.spent / self.paced if self.paced else SECONDS
        running = self.running.copy()
        under_way = sum(min(now - began, unit * task.work) for task, began in running.items())
        return (unit * (self.work - self.bar.tasks[0].completed) - under_way) / max(1, len(running))

    def _begin(self, phase: str, work: float | None = None) -> None:
        """Begin a phase with so much work to do, or one without a count."""
        self.waits_for, self.running = "", dict[Task, float]()
        self.tasks = self.done = self.failed = self.reused = self.workers = 0
        # Seconds and work of the tasks that tell the pace.
        self.spent = self.paced = 0.0
        for row in self.bar.task_ids:
            self.bar.remove_task(row)
        if phase:
            self.row = self.bar.add_task(phase, total=work, shown=self)

    def _refresh(self) -> None:
        """In place of drawing a bar: bring the output of a notebook up to date, or print a line of a log."""
        if self.notebook:
            from IPython.display import display

            self.output = self.output or display(display_id=True)
            self.output.update(Padding(Group(*self.told, self.bar.get_renderable()), 0, expand=False))
        elif self.clock() - self.last >= PAUSE:
            self.last = self.clock()
            for task in self.bar.tasks:
                self.said(f"{task.description} {self}".strip())

    def said(self, line: str) -> None:
        """Say a line to a person."""
        if self.notebook:
            self.told.append(Text(printable(line)))
            self._refresh()
        else:
            self.console.print(printable(line), markup=False)

    @contextmanager
    def writing(self, count: int) -> Iterator[Callable[[str], None]]:
        """Draw so many figures; what it gives is called with the name of each that is drawn."""

        def drawn(name: str) -> None:
            self.waits_for = f"{printable(name)} is drawn"
            self.bar.advance(self.row)
            if self.lines:
                self.said(f"  figure {name}")

        self._begin("drawing", count)
        yield drawn
        self._begin("writing")

    @contextmanager
    def solving(self) -> Iterator["Shown"]:
        """Solve what is planned; the counts are said at the end."""
        began = self.clock()
        try:
            yield self
        finally:
            of = "" if self.done == self.tasks else f" of {self.tasks}"
            failed = f", {self.failed} failed" if self.failed else ""
            took = duration(self.clock() - began)
            self.said(f"{self.done}{of} tasks solved, {self.reused} reused{failed}, {took}")
            self._begin("judging")

    def planned(self, tasks, reused):
        self._begin("compiling")
        self.work, self.tasks, self.reused = sum(task.work for task in tasks), len(tasks), reused

    def started(self, task):
        self.running[task] = self.clock()
        self.workers = max(self.workers, len(self.running))

    def finished(self, task, outcome):
        spent = self.clock() - self.running.pop(task, self.clock())
        seconds = sum(row.seconds for row in outcome.rows if row.seconds > 0) or spent
        # The first task of each worker compiles too: it tells the pace only if it is long.
        if self.done >= self.workers or seconds > LONG:
            self.spent += seconds
            self.paced += task.work
        self.done += 1
        self.failed += any(row.reason is not None for row in outcome.rows)
        self.bar.update(self.row, advance=task.work, total=self.work, description="solving")
        if self.lines:
            self.said(", ".join([*self._counts(), f"solved {task.label}"]))

    def interrupted(self):
        self.bar.update(self.row, description="finishing")
        self.said("finishing the tasks under way")
