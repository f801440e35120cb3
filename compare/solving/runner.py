"""Solving tasks by workers; what the store has is not solved again, and what breaks does not stop the rest."""

import logging
import pickle
import time
from collections import Counter, deque
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, CancelledError, Future, wait
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, field
from typing import Any

from .outcome import Outcome
from .store import Store, write
from .task import Task
from .workers import PULSE, Fault, Processes, VersionMismatch, Workers, caught, counted, solved, unpacked

_LOG = logging.getLogger(__name__)


class SweepProgress:
    """SweepProgress of a sweep while it runs; this one says nothing."""

    def planned(self, tasks: Sequence[Task], reused: int) -> None:
        """The tasks that have to be solved, and how many more the store has."""

    def started(self, task: Task) -> None:
        """A task is handed out to a worker."""

    def finished(self, task: Task, outcome: Outcome) -> None:
        """A task is solved and stored, or has failed: then its rows have a reason."""

    def said(self, line: str) -> None:
        """Remark for people: a worker died, there is none."""

    def interrupted(self) -> None:
        """Tell that nothing more is started; the solves under way are waited for."""


@dataclass(frozen=True)
class Progress:
    """Whom a run tells how far it is.

    told : told what a study takes, before a task is built
    solving : makes what is told while tasks are solved
    writing : makes what is told of every figure while the page is written, from their number
    """

    told: Callable[[str], Any] = str
    solving: Callable[[], AbstractContextManager[SweepProgress | None]] = nullcontext
    writing: Callable[[int], AbstractContextManager[Callable[[str], Any]]] = lambda count: nullcontext(
        lambda name: None
    )


@dataclass(frozen=True)
class SweepResult:
    """Outcomes of a sweep, with counts, time and faults.

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
    progress: SweepProgress | None = None,
    fresh: bool = False,
    scheduler: str | None = None,
) -> SweepResult:
    """Solve tasks, longest first, storing each as it ends.

    workers : processes of this machine, one thread each; absent, as many as there are processors
    fresh : whether each task has a process of its own, one after the other
    scheduler : address of a dask scheduler, whose workers then solve the tasks in place of processes

    What no other process can import, as the model of a script or a notebook, is solved in this one.
    The folder is to be held, see `hold`. A task that raises, or that workers die of, has failed: its outcome has
    the reason in every row, its traceback lies beside the store's file, and the next sweep solves it again. On an
    interrupt, any signal that raises KeyboardInterrupt, nothing more is started; what is being solved is finished
    and stored, and KeyboardInterrupt is raised. A second interrupt ends it at once.

    Raises OSError where the store cannot be written (everything before is kept), where processes end as they
    start, and where a scheduler cannot be reached or is lost; Refused, before anything is solved, where a
    scheduler is named and its address is none, its library is not installed, or none of its workers has the same
    code.
    """
    progress, start = progress or SweepProgress(), time.perf_counter()
    stored = _stored(tasks, store)
    if len(stored) == len(set(tasks)):
        progress.planned([], len(stored))
        return SweepResult(stored, 0, len(stored), time.perf_counter() - start)
    with caught() as interrupts, store.writing():
        missing = sorted({task: None for task in tasks if task not in stored}, key=lambda task: -task.work)
        if other := store.by_other_code(missing):
            progress.said(f"{other} stored tasks were solved by other code: they are solved again")
        _LOG.info("%d tasks to solve, %d reused from %s", len(missing), len(stored), store.folder)
        progress.planned(missing, len(stored))
        with _workers(missing, workers, fresh, scheduler, progress, interrupts) as pool:
            course = _Course(deque(missing), store, pool, progress, interrupts)
            outcomes = stored | dict(course.run())
    return SweepResult(outcomes, len(missing), len(stored), time.perf_counter() - start, course.faults)


def _stored(tasks, store):
    found = {task: store.get(task) for task in dict.fromkeys(tasks)}
    return {task: outcome for task, outcome in found.items() if outcome is not None}


def _workers(missing, count, fresh, scheduler, progress, interrupts) -> AbstractContextManager[Workers]:
    if scheduler is None:
        return Processes(min(counted(count), max(len(missing), 1)), fresh)
    from .cluster import Cluster

    packages = sorted({package for task in missing for package in task.packages})
    return Cluster(scheduler, packages, progress.said, interrupts)


@dataclass
class _Course:
    """One sweep under way.

    queue : what is to be submitted, in this order; out : what is submitted
    suspects : tasks whose worker died; each is tried alone, which tells of which of them it died
    deaths : of workers, by the task that they were at
    """

    queue: deque[Task]
    store: Store
    workers: Workers
    progress: SweepProgress
    interrupts: list[int]
    out: dict["Future[bytes]", Task] = field(default_factory=dict)
    suspects: deque[Task] = field(default_factory=deque)
    deaths: Counter = field(default_factory=Counter)
    faults: dict[Task, str] = field(default_factory=dict)

    def run(self) -> Iterator[tuple[Task, Outcome]]:
        """Outcome of each task. Raises KeyboardInterrupt, and OSError as sweep."""
        told: set[Task] = set()
        winding_up = False
        while self.queue or self.suspects or self.out:
            if len(self.interrupts) > 1:
                raise KeyboardInterrupt
            if self.interrupts and not winding_up:
                winding_up = True
                self.progress.interrupted()
                self.queue.clear()
                self.suspects.clear()
                self.workers.call_back()
            while (room := self.workers.room(len(self.out))) > 0 and (task := self._next()) is not None:
                if task not in told:
                    told.add(task)
                    self.progress.started(task)
                yield from self._submit(task)
            if not self.out:
                time.sleep(PULSE if room <= 0 else 0.0)
                continue
            done, _ = wait(self.out, PULSE, FIRST_COMPLETED)
            for future in done:
                yield from self._settle(self.out.pop(future), future)
        if self.interrupts:
            raise KeyboardInterrupt

    def _next(self) -> Task | None:
        """The task to submit now, if any: a suspect goes alone, before all others."""
        if self.interrupts:
            return None
        if self.suspects:
            return None if self.out else self.suspects.popleft()
        if any(self.deaths[task] for task in self.out.values()) or not self.queue:
            return None
        return self.queue.popleft()

    def _submit(self, task):
        if not getattr(task, "portable", True):  # its class is known to this process alone
            yield self._kept(task, solved(task))
            return
        try:
            packed = pickle.dumps(task)
        except Exception as error:
            yield self._kept(task, Fault.of(error))
        else:
            self.out[self.workers.submit(packed)] = task

    def _settle(self, task, future):
        try:
            answer = unpacked(future.result())
        except self.workers.died:
            self.workers.lost()
            self.deaths[task] += 1
            if self.interrupts:
                return
            if self.deaths[task] < self.workers.tries:
                self.progress.said(f"{task.label}: its worker process died; the task is tried again alone")
                self.suspects.append(task)
                return
            times = f"{self.deaths[task]} times, the last time alone"
            answer = Fault(f"its worker died {times}, as when memory runs out")
        except (CancelledError, VersionMismatch):
            if not self.interrupts:
                self.queue.appendleft(task)
            return
        except Exception as error:
            answer = Fault.of(error)
        yield self._kept(task, answer)

    def _kept(self, task, answer: Outcome | Fault) -> tuple[Task, Outcome]:
        """The outcome, stored; of a fault what failed, with its trace in a file."""
        note = self.store.trace(task)
        if isinstance(answer, Outcome):
            try:
                self.store.put(task, answer)
                note.unlink(missing_ok=True)
            except OSError:
                raise
            except Exception as error:
                answer = Fault.of(error)
        if isinstance(answer, Fault):
            self.faults[task] = answer.reason
            text = f"{task.label}\n{answer.reason}\n\n{answer.trace}"
            write(note, lambda file: file.write(text.encode()))
        outcome = task.failed(answer.reason) if isinstance(answer, Fault) else answer
        self.progress.finished(task, outcome)
        return task, outcome
