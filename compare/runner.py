"""Solving tasks by workers; what the store has is not solved again, and what breaks does not stop the rest."""

import os
import time
from collections import Counter, deque
from collections.abc import Iterator, Mapping, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass, field
from typing import Protocol

from .outcome import Outcome
from .pools.answer import Answer, Fault, Lost, Pool
from .pools.interrupts import caught
from .pools.local import Local
from .sharing import Sharing
from .store import Store, Task, key, write

# Seconds after which an interrupt is noticed.
PULSE = 0.2
# Workers that a task is handed to, one after the other, as long as they die.
TRIES = 3


class Progress(Protocol):
    """What a sweep tells while it runs."""

    def planned(self, tasks: Sequence[Task], reused: int) -> None:
        """The tasks that have to be solved, and how many more the store has."""

    def started(self, task: Task) -> None:
        """A task is handed out to a worker."""

    def finished(self, task: Task, outcome: Outcome) -> None:
        """A task is solved and stored, or has failed: then its rows have a reason."""

    def found(self, task: Task) -> None:
        """Another sweep has stored a task meanwhile."""

    def said(self, line: str) -> None:
        """What a person wants to know besides: a worker died, there is none, another sweep is waited for."""

    def interrupted(self) -> None:
        """Nothing more is started; the solves under way are waited for."""


class Silent:
    """Progress that tells nothing."""

    def planned(self, tasks, reused):
        pass

    def started(self, task):
        pass

    def finished(self, task, outcome):
        pass

    def found(self, task):
        pass

    def said(self, line):
        pass

    def interrupted(self):
        pass


@dataclass(frozen=True)
class SweepResult:
    """What came of a sweep.

    outcomes : by task
    solved, reused : how many tasks were handed to workers, and how many the store had
    seconds : wall time [s]
    faults : reasons by task, of the tasks that broke; their outcomes have these reasons, and are not stored
    """

    outcomes: Mapping[Task, Outcome]
    solved: int
    reused: int
    seconds: float
    faults: Mapping[Task, str] = field(default_factory=dict)

    def joined(self, later: "SweepResult") -> "SweepResult":
        """This and a later one."""
        return SweepResult(
            {**self.outcomes, **later.outcomes},
            self.solved + later.solved,
            self.reused + later.reused,
            self.seconds + later.seconds,
            {**self.faults, **later.faults},
        )


def sweep(
    tasks: Sequence[Task],
    store: Store,
    workers: int | None = None,
    progress: Progress | None = None,
    tasks_each: int | None = None,
    scheduler: str | None = None,
) -> SweepResult:
    """Solve tasks, longest first, storing each as it ends.

    workers : processes of this machine, one thread each; absent, as many as there are processors
    tasks_each : that a process solves before a fresh one takes its place; absent, any number
    scheduler : address of a dask scheduler, whose workers then solve the tasks in the place of processes

    A task that raises, or whose worker dies `TRIES` times, has failed: its outcome has the reason in every row,
    its traceback lies beside the store's files, and the next sweep solves it again. On an interrupt, any signal
    that raises KeyboardInterrupt, nothing more is started; what is being solved is finished and stored, and
    KeyboardInterrupt is raised. A second interrupt ends it at once.

    Raises OSError where the store cannot be written (everything before is kept), where processes end as they
    start, and where a scheduler cannot be reached or is lost; Refused, before anything is solved, where a
    scheduler is named and its library is not installed, or none of its workers has the same code.
    """
    progress = progress or Silent()
    start = time.perf_counter()
    stored = {task: store.get(task) for task in tasks}
    outcomes = {task: outcome for task, outcome in stored.items() if outcome is not None}
    waiting = sorted((task for task in stored if task not in outcomes), key=lambda task: -task.work)
    progress.planned(waiting, len(outcomes))
    if not waiting:
        return SweepResult(outcomes, 0, len(outcomes), time.perf_counter() - start)
    with (
        caught() as interrupts,
        Sharing(store.folder) as sharing,
        _pool(waiting, workers, tasks_each, scheduler, progress) as pool,
    ):
        course = _Course(deque(waiting), store, sharing, pool, progress, interrupts)
        outcomes.update(course.run())
    solved = len(waiting) - course.found
    return SweepResult(outcomes, solved, len(stored) - solved, time.perf_counter() - start, course.faults)


def _pool(waiting, workers, tasks_each, scheduler, progress) -> AbstractContextManager[Pool]:
    if scheduler is None:
        return Local(min(workers or os.cpu_count() or 1, len(waiting)), tasks_each)
    from .pools.cluster import Cluster

    packages = sorted({package for task in waiting for package in task.packages})
    return Cluster(scheduler, packages, progress.said)


@dataclass
class _Course:
    """One sweep under way.

    queue : what is to be handed out, in this order; elsewhere : what another sweep on the same store is solving
    out : names of what is handed out; deaths : of workers, by the task that they were at
    """

    queue: deque[Task]
    store: Store
    sharing: Sharing
    pool: Pool
    progress: Progress
    interrupts: list[int]
    elsewhere: list[Task] = field(default_factory=list)
    out: dict[Task, str] = field(default_factory=dict)
    deaths: Counter = field(default_factory=Counter)
    faults: dict[Task, str] = field(default_factory=dict)
    found: int = 0

    def run(self) -> Iterator[tuple[Task, Outcome]]:
        """What comes of each task. Raises KeyboardInterrupt, and OSError as sweep."""
        winding_up = told = False
        while self.queue or self.elsewhere or self.out:
            if len(self.interrupts) > 1:
                raise KeyboardInterrupt
            if self.interrupts and not winding_up:
                winding_up = True
                self._wind_up()
            if not self.queue:
                self.queue, self.elsewhere = deque(self.elsewhere), []
            yield from self._hand_out()
            if self.elsewhere and not self.out and not told:
                told = True
                self.progress.said(f"{len(self.elsewhere)} tasks are being solved by another run: waiting for it")
            for task, answer in self.pool.answers(PULSE):
                yield from self._settle(task, answer)
        if self.interrupts:
            raise KeyboardInterrupt

    def _hand_out(self):
        """No more than there is room for: what has not started is in no queue but this."""
        room = self.pool.room()
        while room > 0 and self.queue and not self.interrupts:
            task = self.queue.popleft()
            name = key(task)
            if not self.sharing.take(name):
                self.elsewhere.append(task)
            elif (outcome := self.store.get(task)) is not None:
                self.sharing.give_back(name)
                self.found += 1
                self.progress.found(task)
                yield task, outcome
            else:
                room -= 1
                self.out[task] = name
                self.pool.hand_out(task)
                if task not in self.deaths:
                    self.progress.started(task)

    def _settle(self, task, answer: Answer):
        if isinstance(answer, Lost):
            self.deaths[task] += 1
            if self.interrupts:
                self.sharing.give_back(self.out.pop(task))
                return
            if self.deaths[task] < TRIES:
                self.progress.said(f"{task.label}: {answer.how}; handed out again")
                del self.out[task]
                self.queue.appendleft(task)
                return
            answer = Fault(f"handed out {TRIES} times; {answer.how}")
        name = self.out[task]
        outcome = self._kept(task, name, answer)
        del self.out[task]
        self.sharing.give_back(name)
        self.progress.finished(task, outcome)
        yield task, outcome

    def _kept(self, task, name, answer: Outcome | Fault) -> Outcome:
        """The outcome, stored; of a fault what failed, with its trace in a file."""
        note = self.store.trace(name)
        if isinstance(answer, Outcome):
            try:
                self.store.put(task, answer)
            except OSError:
                raise
            except Exception as error:
                answer = Fault.of(error)
            else:
                note.unlink(missing_ok=True)
                return answer
        self.faults[task] = answer.reason
        text = f"{task.label}\n{answer.reason}\n\n{answer.trace}"
        write(note, lambda file: file.write(text.encode()))
        return task.failed(answer.reason)

    def _wind_up(self):
        self.progress.interrupted()
        self.queue.clear()
        self.elsewhere.clear()
        for task in self.pool.call_back():
            self.sharing.give_back(self.out.pop(task))
