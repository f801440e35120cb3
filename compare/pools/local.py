"""Worker processes of this machine. One that dies takes only its own task with it."""

import multiprocessing
import os
import pickle
import signal
import threading
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess

from ..store import Task
from .answer import Answer, Fault, Lost, answered, unpacked
from .interrupts import FROM_THE_TERMINAL, held

# A worker solves on one thread; two workers with two threads each are slower than either alone.
ONE_THREAD = {f"{library}_NUM_THREADS": "1" for library in ("OMP", "OPENBLAS", "MKL", "NUMBA")}
# Workers that end before any is ready, one after the other, until it is plain that none will be.
STILLBORN = 3
READY = b"ready"


@dataclass(eq=False)
class _Worker:
    """A process, the pipe to it, and what it is at. `solved` counts the tasks that it has answered."""

    process: BaseProcess
    pipe: Connection
    task: Task | None = None
    ready: bool = False
    solved: int = 0


class Local:
    """A pool, as of answer: processes with a pipe each, so that none shares a lock with one that dies.

    workers : processes, one thread each
    tasks_each : that a process solves before a fresh one takes its place; None, any number
    """

    def __init__(self, workers: int, tasks_each: int | None = None):
        self.limit, self.tasks_each = workers, tasks_each
        self.context = multiprocessing.get_context("spawn")
        self.workers: list[_Worker] = []
        self.unsent: list[tuple[Task, Answer]] = []
        self.stillborn = 0

    def __enter__(self):
        with ExitStack() as stack:
            stack.enter_context(_environment(ONE_THREAD))
            # Ends with this process, whatever becomes of it.
            self.tether, self.ours = self.context.Pipe(duplex=False)
            stack.enter_context(self.tether)
            stack.enter_context(self.ours)
            self.stack = stack.pop_all()
        return self

    def __exit__(self, kind, *_):
        with self.stack:
            for worker in self.workers:
                if kind is not None:
                    worker.process.kill()
                worker.pipe.close()
            for worker in self.workers:
                worker.process.join()

    def room(self) -> int:
        """Number of tasks that can be handed out now, see Pool."""
        return self.limit - sum(worker.task is not None for worker in self.workers)

    def hand_out(self, task: Task) -> None:
        """Hand a task to a worker that is idle, or to a fresh one, see Pool."""
        try:
            packed = pickle.dumps(task)
        except Exception as error:
            self.unsent.append((task, Fault.of(error)))
            return
        worker = next((each for each in self.workers if each.task is None), None) or self._start()
        worker.task = task
        # If it is dead, its pipe will say so.
        with suppress(OSError):
            worker.pipe.send_bytes(packed)

    def answers(self, patience: float) -> list[tuple[Task, Answer]]:
        """Answers that have come, see Pool. Raises ChildProcessError where workers end as they start."""
        if self.unsent:
            unsent, self.unsent = self.unsent, []
            return unsent
        heard = wait([worker.pipe for worker in self.workers], patience)
        return [answer for worker in list(self.workers) if worker.pipe in heard for answer in self._hear(worker)]

    def call_back(self) -> list[Task]:
        """Call back nothing, as all that is handed out is being solved, see Pool."""
        return []

    def _hear(self, worker) -> Iterator[tuple[Task, Answer]]:
        try:
            packed = worker.pipe.recv_bytes()
        except (EOFError, OSError):
            yield from self._bury(worker)
            return
        if packed == READY:
            worker.ready, self.stillborn = True, 0
            return
        task, worker.task = worker.task, None
        worker.solved += 1
        if worker.solved == self.tasks_each:
            self._dismiss(worker)
        yield task, unpacked(packed)

    def _start(self):
        pipe, theirs = self.context.Pipe()
        process = self.context.Process(target=_work, args=(theirs, self.tether))
        with held(), theirs:
            process.start()
        self.workers.append(_Worker(process, pipe))
        return self.workers[-1]

    def _dismiss(self, worker):
        self.workers.remove(worker)
        worker.pipe.close()
        worker.process.join()

    def _bury(self, worker) -> Iterator[tuple[Task, Answer]]:
        self._dismiss(worker)
        how = _end(worker.process.exitcode)
        if not worker.ready:
            self.stillborn += 1
            if self.stillborn >= STILLBORN:
                raise ChildProcessError(f"{STILLBORN} worker processes ended as they started, the last by {how}")
        if worker.task is not None:
            yield worker.task, Lost(f"its worker ended by {how}")


def _end(code):
    """Words on the way a process ended."""
    if code >= 0:
        return f"status {code}"
    name = next((each.name for each in signal.Signals if each == -code), f"signal {-code}")
    return f"{name}, as when memory runs out" if name == "SIGKILL" else name


def _work(pipe, tether):
    """What a worker does, until its pipe is closed."""
    _tie_to_the_parent(tether)
    pipe.send_bytes(READY)
    while True:
        try:
            packed = pipe.recv_bytes()
        except EOFError:
            return
        pipe.send_bytes(answered(packed))


def _tie_to_the_parent(tether):
    """In a worker: it ends at once when the parent ends, in whatever way."""

    def end_with_the_parent():
        tether.poll(None)
        os._exit(1)

    for number in FROM_THE_TERMINAL:
        signal.signal(number, signal.SIG_IGN)
    threading.Thread(target=end_with_the_parent, daemon=True).start()


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
