"""Progress of a run on standard error: a bar on a terminal, else a line every ten seconds."""

import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager

from rich import progress as bars
from rich.console import Console
from rich.table import Column

from scene.printable import printable

from .runner import Progress
from .task import Outcome, Task
from .words import seconds

PAUSE = 10.0  # seconds between lines where there is no terminal to draw a bar on


class Shown(Progress):
    """What a person sees of a run, a bar for each phase: a context.

    clock : seconds that grow
    """

    def __init__(self, console: Console | None = None, clock: Callable[[], float] = time.monotonic) -> None:
        usual = Console(stderr=True, highlight=False, soft_wrap=True, force_jupyter=False)
        self.clock, self.console = clock, console or usual
        drawn = self.console.is_interactive
        # Where there is little room, the end of the last column is cut off.
        last = Column(ratio=1, no_wrap=True, overflow="ellipsis")
        self.bar = bars.Progress(
            bars.TextColumn("{task.description}"),
            bars.BarColumn(bar_width=24),
            bars.TimeElapsedColumn(),
            bars.TextColumn("{task.fields[waits_for]}", markup=False, table_column=last),
            console=self.console,
            get_time=clock,
            expand=True,
            transient=True,
            redirect_stdout=False,
            refresh_per_second=10 if drawn else 1 / PAUSE,
            speed_estimate_period=3600.0,  # of long tasks, too
        )
        if not drawn:
            self.bar.live.refresh = self._refresh  # type: ignore[method-assign]
        self.last = clock()
        self.planned([], 0)
        self._begin("preparing")

    def __enter__(self) -> "Shown":
        self.bar.live.start()
        return self

    def __exit__(self, *_: object) -> None:
        self.bar.live.stop()
        self._begin("")

    def _begin(self, phase: str, total: float | None = None, waits_for: object = "") -> None:
        """Begin a phase with so much to do, or one without a count."""
        for row in self.bar.task_ids:
            self.bar.remove_task(row)
        if phase:
            self.row = self.bar.add_task(phase, total=total, waits_for=waits_for)

    def _refresh(self) -> None:
        """In place of drawing a bar: print a line of a log."""
        if self.clock() - self.last >= PAUSE:
            self.last = self.clock()
            for task in self.bar.tasks:
                self.message(f"{task.description} {task.fields['waits_for']}".strip())

    def message(self, line: str) -> None:
        """Print a line for the user."""
        self.console.print(printable(line), markup=False)

    @contextmanager
    def writing(self, count: int) -> Iterator[Callable[[str], None]]:
        """Context while `count` figures are drawn; gives a function that takes the name of each."""

        def drawn(name: str) -> None:
            self.bar.update(self.row, advance=1, waits_for=f"{printable(name)} is drawn")

        self._begin("drawing", count)
        yield drawn
        self._begin("writing")

    @contextmanager
    def solving(self) -> Iterator["Shown"]:
        """Context of solving; at its end the counts are printed."""
        began = self.clock()
        self.planned([], 0)
        try:
            yield self
        finally:
            solved = f"{self.done} of {self.count} tasks solved"
            counts = [solved, f"{self.reused} reused", *self._failures(), seconds(self.clock() - began)]
            self.message(", ".join(counts))
            self._begin("judging")

    def planned(self, tasks: Sequence[Task], reused: int) -> None:
        self.count, self.work, self.reused = len(tasks), sum(task.work for task in tasks), reused
        self.done, self.failed, self.label = 0, 0, ""
        self._begin("compiling", waits_for=self)

    def started(self, task: Task) -> None:
        self.label = task.label

    def finished(self, task: Task, outcome: Outcome) -> None:
        self.done += 1
        self.failed += any(row.reason is not None for row in outcome.rows)
        self.bar.update(self.row, advance=task.work, total=self.work, description="solving")

    def _failures(self) -> list[str]:
        return [f"{self.failed} failed"] if self.failed else []

    def _counts(self) -> list[str]:
        """Counts in words, and the time left at the pace until now, as far as there is one."""
        left = next((task.time_remaining for task in self.bar.tasks), None)
        return [f"{self.done}/{self.count}", *self._failures(), *([f"{seconds(left)} left"] if left else [])]

    def __str__(self) -> str:
        """Counts, the time left, and what was begun last."""
        return ", ".join(filter(None, [*self._counts(), printable(self.label)]))

    def interrupted(self) -> None:
        self.bar.update(self.row, description="finishing")
        self.message("finishing the tasks under way")
