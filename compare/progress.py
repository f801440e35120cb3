"""What a person sees while tasks are solved: a bar on a terminal, plain lines elsewhere."""

import time
from collections.abc import Callable, Sequence

from rich.console import Console
from rich.progress import BarColumn, Progress, ProgressColumn, TextColumn, TimeElapsedColumn
from rich.table import Column
from rich.text import Text

from .outcome import Outcome
from .store import Task
from .timeleft import TimeLeft

# Seconds between lines where there is no terminal to draw a bar on.
PAUSE = 5.0


def watch(console: Console) -> "Bar | Lines":
    """A progress bar on a terminal, plain lines elsewhere."""
    return Bar(console) if console.is_terminal else Lines(console)


def failed(outcome: Outcome) -> bool:
    """Whether a task, or a part of it, has no answer."""
    return any(row.reason is not None for row in outcome.rows)


def duration(seconds: float | None) -> str:
    """Seconds as a person says them; a question mark where they are not known."""
    if seconds is None:
        return "?"
    whole = round(seconds)
    if whole < 60:
        return f"{whole} s"
    if whole < 3600:
        return f"{whole // 60} min {whole % 60:02d} s"
    return f"{whole // 3600} h {whole % 3600 // 60:02d} min"


class _Counts:
    """Progress of a sweep: tasks by what became of them, work, and the time left."""

    def __init__(self, tasks: Sequence[Task], reused: int, clock: Callable[[], float]):
        self.total, self.all_work = len(tasks), sum(task.work for task in tasks)
        self.done, self.failed, self.reused, self.work = 0, 0, reused, 0.0
        self.left, self.clock = TimeLeft(tasks, clock), clock
        self.start = clock()

    def finished(self, task: Task, outcome: Outcome) -> None:
        self.left.finished(task)
        self.done, self.work = self.done + 1, self.work + task.work
        self.failed += failed(outcome)

    def found(self, task: Task) -> None:
        self.left.found(task)
        self.total, self.reused = self.total - 1, self.reused + 1
        self.work += task.work

    @property
    def short(self) -> str:
        """Tasks so far, of how many, and how many of them failed."""
        return f"{self.done}/{self.total}" + (f", {self.failed} failed" if self.failed else "")

    @property
    def whole(self) -> str:
        """Tasks solved, reused and failed in a sentence, at the end."""
        all_of = f"{self.done}" if self.done == self.total else f"{self.done} of {self.total}"
        parts = [f"{all_of} tasks solved", f"{self.reused} reused"]
        parts += [f"{self.failed} failed"] if self.failed else []
        return ", ".join([*parts, duration(self.clock() - self.start)])


class _Told:
    """What both ways of telling share: counts while a sweep runs, a line at its end."""

    def __init__(self, console: Console, clock: Callable[[], float]):
        self.console, self.clock = console, clock
        self.counts: _Counts | None = None

    def planned(self, waiting, reused):
        self.counts = _Counts(waiting, reused, self.clock)

    def started(self, task):
        self.counts.left.started(task)

    def finished(self, task, outcome):
        self.counts.finished(task, outcome)

    def found(self, task):
        self.counts.found(task)

    def said(self, line):
        self.console.print(line, markup=False)

    def __exit__(self, *_):
        if self.counts and self.counts.done:
            self.console.print(self.counts.whole, markup=False)


class Lines(_Told):
    """Progress as a line every few seconds. pause : seconds between lines; 0 for a line a task"""

    def __init__(self, console: Console, clock: Callable[[], float] = time.monotonic, pause: float = PAUSE):
        super().__init__(console, clock)
        self.pause = pause

    def __enter__(self):
        return self

    def planned(self, waiting, reused):
        super().planned(waiting, reused)
        self.last = self.clock()
        if waiting:
            known = f", {reused} reused" if reused else ""
            self.console.print(f"{len(waiting)} tasks to solve{known}")

    def interrupted(self):
        self.console.print("finishing what is being solved")

    def finished(self, task, outcome):
        super().finished(task, outcome)
        now = self.clock()
        if now - self.last < self.pause:
            return
        self.last = now
        left = duration(self.counts.left.seconds())
        self.console.print(f"{self.counts.short}, {left} left, solved {task.label}", markup=False)


class _Left(ProgressColumn):
    """Counts down from the last estimate to the next."""

    def __init__(self, clock: Callable[[], float]):
        super().__init__(Column(no_wrap=True, min_width=10))
        self.clock = clock
        self.end: float | None = None

    def set(self, seconds: float | None) -> None:
        """An estimate."""
        self.end = None if seconds is None else self.clock() + seconds

    def render(self, task):
        seconds = None if self.end is None else max(self.end - self.clock(), 0.0)
        return Text(f"{duration(seconds)} left", style="progress.remaining")


class Bar(_Told):
    """Progress as a bar that names what is being solved, how long is left, and how many have failed."""

    def __init__(self, console: Console, clock: Callable[[], float] = time.monotonic):
        super().__init__(console, clock)
        self.running: list[Task] = []
        self.doing, self.left = "", _Left(clock)
        # Where there is little room, what is being solved is cut off first, then the bar, never the times.
        what = Column(ratio=1, no_wrap=True, overflow="ellipsis")
        self.bar = Progress(
            BarColumn(bar_width=24),
            TextColumn("{task.percentage:3.0f} %", table_column=Column(no_wrap=True, min_width=5)),
            TimeElapsedColumn(table_column=Column(no_wrap=True, min_width=7)),
            self.left,
            TextColumn("{task.fields[counts]}", markup=False, table_column=Column(no_wrap=True)),
            TextColumn("{task.description}", markup=False, table_column=what),
            console=console,
            expand=True,
            transient=True,
        )

    def __enter__(self):
        self.bar.__enter__()
        return self

    def __exit__(self, *raised):
        self.bar.__exit__(*raised)
        super().__exit__(*raised)

    def planned(self, waiting, reused):
        if self.counts:
            self.bar.remove_task(self.total)
        super().planned(waiting, reused)
        self.total = self.bar.add_task("", total=self.counts.all_work or 1.0, counts=self.counts.short)

    def started(self, task):
        super().started(task)
        self.running.append(task)
        self._tell()

    def finished(self, task, outcome):
        super().finished(task, outcome)
        self.running.remove(task)
        self._tell()

    def found(self, task):
        super().found(task)
        self._tell()

    def interrupted(self):
        self.doing = "finishing "
        self._tell()

    def _tell(self):
        self.left.set(self.counts.left.seconds())
        what = self.doing + (self.running[0].label if self.running else "")
        self.bar.update(self.total, completed=self.counts.work, counts=self.counts.short, description=what)
