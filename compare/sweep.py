"""Solving tasks in worker processes; what the store has is not solved again."""

import multiprocessing
import os
import signal
import threading
import time
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import closing, contextmanager
from dataclasses import dataclass
from typing import Protocol

from .outcome import Outcome
from .store import Store, Task

# A worker solves on one thread; two workers with two threads each are slower than either alone.
ONE_THREAD = {f"{library}_NUM_THREADS": "1" for library in ("OMP", "OPENBLAS", "MKL", "NUMBA")}
# What a terminal sends to every process of a run: workers leave it to their parent.
FROM_THE_TERMINAL = {getattr(signal, name) for name in ("SIGINT", "SIGHUP") if hasattr(signal, name)}
# Seconds after which an interrupt is noticed.
PULSE = 0.2


class Progress(Protocol):
    """What a sweep tells while it runs."""

    def planned(self, tasks: Sequence[Task]) -> None:
        """The tasks that have to be solved; those that the store has are not among them."""

    def started(self, task: Task) -> None:
        """A worker has begun a task."""

    def finished(self, task: Task, outcome: Outcome) -> None:
        """A task is solved and stored."""

    def interrupted(self) -> None:
        """Nothing more is started; the solves under way are waited for."""


class Silent:
    """Progress that tells nothing."""

    def planned(self, tasks):
        pass

    def started(self, task):
        pass

    def finished(self, task, outcome):
        pass

    def interrupted(self):
        pass


@dataclass(frozen=True)
class Swept:
    """Outcomes by task, how many tasks were solved, how many the store had, and the wall time [s]."""

    outcomes: Mapping[Task, Outcome]
    solved: int
    reused: int
    seconds: float

    def joined(self, later: "Swept") -> "Swept":
        """This and a later one."""
        outcomes = {**self.outcomes, **later.outcomes}
        return Swept(
            outcomes, self.solved + later.solved, self.reused + later.reused, self.seconds + later.seconds
        )


def sweep(
    tasks: Sequence[Task],
    store: Store,
    workers: int | None = None,
    progress: Progress | None = None,
    tasks_each: int | None = None,
) -> Swept:
    """Solve tasks, longest first, storing each as it ends.

    workers : processes, one thread each; absent, as many as there are processors
    tasks_each : that a process solves before a fresh one takes its place; absent, any number

    An exception in a task is a fault and is raised. On an interrupt, any signal that raises KeyboardInterrupt,
    nothing more is started; what is being solved is finished and stored, and KeyboardInterrupt is raised. A second
    interrupt ends it at once.
    """
    progress = progress or Silent()
    start = time.perf_counter()
    stored = {task: store.get(task) for task in tasks}
    outcomes = {task: outcome for task, outcome in stored.items() if outcome is not None}
    waiting = sorted((task for task in stored if task not in outcomes), key=lambda task: -task.work)
    solved = len(waiting)
    progress.planned(waiting)
    if waiting:
        workers = min(workers or os.cpu_count() or 1, solved)
        with closing(_run(waiting, workers, progress, tasks_each)) as solving:
            for task, outcome in solving:
                store.put(task, outcome)
                outcomes[task] = outcome
                progress.finished(task, outcome)
    return Swept(outcomes, solved, len(stored) - solved, time.perf_counter() - start)


def solve(task: Task) -> Outcome:
    """What a worker does."""
    return task.solve()


def _run(
    waiting: Sequence[Task], workers: int, progress: Progress, tasks_each: int | None
) -> Iterator[tuple[Task, Outcome]]:
    """Never more tasks handed out than there are workers: what has not started is not in any queue."""
    context = multiprocessing.get_context("spawn")
    upcoming, running, interrupted = iter(waiting), {}, False
    tether, ours = context.Pipe(duplex=False)
    with (
        _interrupts_caught() as caught,
        _environment(ONE_THREAD),
        tether,
        ours,
        ProcessPoolExecutor(
            workers, context, _tie_to_the_parent, (tether,), max_tasks_per_child=tasks_each
        ) as pool,
    ):

        def hand_out():
            for task in upcoming:
                with _interrupts_held():
                    running[pool.submit(solve, task)] = task
                progress.started(task)
                return

        try:
            for _ in range(workers):
                hand_out()
            while running:
                if len(caught) > 1:
                    raise KeyboardInterrupt
                if caught and not interrupted:
                    interrupted = True
                    progress.interrupted()
                for future in wait(running, PULSE, FIRST_COMPLETED).done:
                    yield running.pop(future), future.result()
                    if not caught:
                        hand_out()
            if caught:
                raise KeyboardInterrupt
        except BaseException as error:
            ours.close()
            if caught and isinstance(error, BrokenProcessPool):
                raise KeyboardInterrupt from error
            raise


def _tie_to_the_parent(tether):
    """In a worker: it ends at once when the parent closes its end of the pipe, or ends in whatever way."""

    def end_with_the_parent():
        tether.poll(None)
        os._exit(1)

    for number in FROM_THE_TERMINAL:
        signal.signal(number, signal.SIG_IGN)
    threading.Thread(target=end_with_the_parent, daemon=True).start()


@contextmanager
def _interrupts_caught():
    """The list of the signals that came meanwhile and would have raised KeyboardInterrupt."""
    caught = []
    if threading.current_thread() is not threading.main_thread():
        yield caught
        return
    raising = [n for n in signal.valid_signals() if signal.getsignal(n) is signal.default_int_handler]
    for number in raising:
        signal.signal(number, lambda number, frame: caught.append(number))
    try:
        yield caught
    finally:
        for number in raising:
            signal.signal(number, signal.default_int_handler)


@contextmanager
def _interrupts_held():
    """A process started meanwhile inherits the mask: an interrupt from the keyboard does not end it at birth."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, FROM_THE_TERMINAL)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


@contextmanager
def _environment(variables):
    """Variables that processes started meanwhile inherit: libraries read them when they are first imported."""
    before = {name: os.environ.get(name) for name in variables}
    os.environ.update(variables)
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value
