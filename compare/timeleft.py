"""Time that a sweep still takes: tasks of unequal work, several at a time."""

import time
from collections import defaultdict
from collections.abc import Callable, Iterable
from typing import Any

from .store import Task


class TimeLeft:
    """An estimate, made anew from what the tasks before have taken.

    tasks : all that has to be solved; clock : seconds that grow

    What a unit of work takes is the mean over the tasks of one kind, one solver's, that have ended; over all where
    none of the kind has. The rest takes as long as its sum over as many workers as were seen at work at once, and
    no less than its longest task.
    """

    def __init__(self, tasks: Iterable[Task], clock: Callable[[], float] = time.monotonic):
        self.waiting, self.clock = {task: None for task in tasks}, clock
        self.running: dict[Task, float] = {}
        self.seconds_of: defaultdict[Any, float] = defaultdict(float)
        self.work_of: defaultdict[Any, float] = defaultdict(float)
        self.lanes = 1

    def started(self, task: Task) -> None:
        """A worker has begun a task."""
        self.waiting.pop(task, None)
        self.running[task] = self.clock()
        self.lanes = max(self.lanes, len(self.running))

    def finished(self, task: Task) -> None:
        """A worker has ended it."""
        self.seconds_of[_kind(task)] += self.clock() - self.running.pop(task)
        self.work_of[_kind(task)] += task.work

    def found(self, task: Task) -> None:
        """Nobody has to solve it any more."""
        self.waiting.pop(task, None)

    def seconds(self) -> float | None:
        """From now on; None as long as nothing has ended."""
        if not sum(self.work_of.values()):
            return None
        now = self.clock()
        left = [self._expected(task) for task in self.waiting]
        left += [max(self._expected(task) - (now - since), 0.0) for task, since in self.running.items()]
        return max(sum(left) / self.lanes, max(left, default=0.0))

    def _expected(self, task):
        kind = _kind(task)
        if self.work_of[kind]:
            return task.work * self.seconds_of[kind] / self.work_of[kind]
        return task.work * sum(self.seconds_of.values()) / sum(self.work_of.values())


def _kind(task):
    return type(task), getattr(getattr(task, "solver", None), "name", None)
