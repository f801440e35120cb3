"""What a person sees while tasks are solved: a bar on a terminal, plain lines elsewhere."""

import time

from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn
from rich.table import Column

# Seconds between lines where there is no terminal to draw a bar on.
PAUSE = 5.0


def watch(console: Console):
    """A progress bar on a terminal, plain lines elsewhere."""
    return Bar(console) if console.is_terminal else Lines(console)


class Lines:
    """Progress as a line every few seconds."""

    def __init__(self, console: Console):
        self.console = console

    def __enter__(self):
        return self

    def __exit__(self, *_):
        pass

    def planned(self, waiting):
        self.total = sum(task.work for task in waiting)
        self.count, self.done, self.work = len(waiting), 0, 0.0
        self.start = self.said = time.monotonic()
        if waiting:
            self.console.print(f"{len(waiting)} tasks to solve")

    def started(self, task):
        pass

    def interrupted(self):
        self.console.print("finishing what is being solved")

    def finished(self, task, outcome):
        self.done, self.work = self.done + 1, self.work + task.work
        now = time.monotonic()
        if now - self.said < PAUSE:
            return
        self.said = now
        left = (now - self.start) * (self.total / self.work - 1)
        self.console.print(f"{self.done}/{self.count}, {left:.0f} s left, solved {task.label}", markup=False)


class Bar:
    """Progress as a bar that names what is being solved and how long is left."""

    def __init__(self, console: Console):
        self.running, self.doing = [], ""
        # Where there is little room, what is being solved is cut off first, then the bar, never the times.
        what = Column(ratio=1, no_wrap=True, overflow="ellipsis")
        self.bar = Progress(
            BarColumn(bar_width=24),
            TextColumn("{task.percentage:3.0f} %", table_column=Column(no_wrap=True, min_width=5)),
            TimeElapsedColumn(table_column=Column(no_wrap=True, min_width=7)),
            TextColumn("left", table_column=Column(no_wrap=True, min_width=4)),
            TimeRemainingColumn(table_column=Column(no_wrap=True, min_width=7)),
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

    def planned(self, waiting):
        self.total = self.bar.add_task("", total=sum(task.work for task in waiting) or 1.0)

    def started(self, task):
        self.running.append(task)
        self._tell()

    def finished(self, task, outcome):
        self.running.remove(task)
        self.bar.advance(self.total, task.work)
        self._tell()

    def interrupted(self):
        self.doing = "finishing "
        self._tell()

    def _tell(self):
        self.bar.update(self.total, description=self.doing + (self.running[0].label if self.running else ""))
