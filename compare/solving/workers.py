"""Worker processes of this machine, and what comes back of a task that one of them solved."""

import multiprocessing
import os
import pickle
import signal
import threading
import traceback
from collections.abc import Iterator, Mapping
from concurrent.futures import Future, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from dataclasses import dataclass
from multiprocessing.connection import wait
from typing import Protocol, Self

from scene.reading import whole

from .outcome import Outcome
from .task import Task

MOST = 1024
# A worker solves on one thread; two workers with two threads each are slower than either alone.
ONE_THREAD = {f"{library}_NUM_THREADS": "1" for library in ("OMP", "OPENBLAS", "MKL", "NUMBA")}
# Python would look for the first modules of a new process in the working folder.
ENVIRONMENT = ONE_THREAD | {"PYTHONSAFEPATH": "1"}
_STARTING = threading.Lock()  # of one process after the other, as the environment is that of all threads
# Pools that end before a worker of theirs is ready, one after the other, until it is plain that none will be.
STILLBORN = 3
# Seconds after which an interrupt is noticed.
PULSE = 0.2
# What a terminal sends to every process of a run: workers leave it to their parent.
FROM_THE_TERMINAL = {getattr(signal, name) for name in ("SIGINT", "SIGHUP") if hasattr(signal, name)}


def counted(workers: int | None) -> int:
    """Number of processes: as stated, else as many as processors. Raises InvalidInput."""
    if workers is None:
        return os.cpu_count() or 1
    return whole("workers", workers, MOST)


def starting() -> bool:
    """Whether this is a worker that still imports the script which asked for workers."""
    return getattr(multiprocessing.current_process(), "_inheriting", False)


@dataclass(frozen=True)
class Fault:
    """A task that broke: what a solver does not foresee, or does not survive.

    reason : type and message of what was raised, in a line
    trace : where, for whoever mends it; empty where nothing was raised
    """

    reason: str
    trace: str = ""

    @classmethod
    def of(cls, error: BaseException) -> Self:
        """Fault made of what was raised."""
        message = " ".join(str(error).split())
        reason = f"{type(error).__name__}: {message}" if message else type(error).__name__
        return cls(reason, "".join(traceback.format_exception(error)))


def answered(packed: bytes) -> bytes:
    """The outcome or Fault of a task, both pickled; whatever is raised on the way is a fault."""
    try:
        return pickle.dumps(solved(pickle.loads(packed)))
    except Exception as error:
        return pickle.dumps(Fault.of(error))


def solved(task: Task) -> Outcome | Fault:
    """The outcome of a task, solved in this process; whatever is raised on the way is a fault."""
    try:
        outcome = task.solve()
        if not task.fits(outcome):
            raise ValueError(f"its answer is not whole: {len(outcome.rows)} rows, fields {[*outcome.fields]}")
        return outcome
    # Catch SystemExit too: it must not end the worker.
    except (Exception, SystemExit) as error:
        return Fault.of(error)


def unpacked(packed: bytes) -> Outcome | Fault:
    """The answer out of what `answered` gave."""
    try:
        return pickle.loads(packed)
    except Exception as error:
        return Fault.of(error)


class VersionMismatch(Exception):
    """A worker does not solve with the code and versions of this process."""


class Workers(Protocol):
    """A context: whoever solves tasks. Left by an exception, it ends what is being solved at once.

    died : what a future raises whose worker died of its task or beside it
    tries : deaths of workers until a task counts as their reason
    """

    died: tuple[type[BaseException], ...]
    tries: int

    def room(self, out: int) -> int:
        """Number of tasks that can be submitted now, where some are out. Raises OSError where none ever can."""

    def submit(self, packed: bytes) -> "Future[bytes]":
        """Let a worker solve a pickled task; cancelled, a future is to be submitted again."""

    def lost(self) -> None:
        """A future says that its worker died. Raises OSError where none can be had any more."""

    def call_back(self) -> None:
        """Cancel what is submitted and has not been started."""


class Processes:
    """Workers of this machine: a ProcessPoolExecutor, made anew where one of its processes dies.

    count : of processes, one thread each
    fresh : whether every task has a process of its own, which is then the only one
    """

    died: tuple[type[BaseException], ...] = (BrokenProcessPool,)
    tries = 3

    def __init__(self, count: int, fresh: bool = False):
        self.count, self.fresh = 1 if fresh else count, fresh
        self.context = multiprocessing.get_context("spawn")
        self.pool: ProcessPoolExecutor | None = None
        self.stillborn = 0

    def __enter__(self):
        return self

    def __exit__(self, kind, *_):
        self._end(kill=kind is not None)

    def room(self, out: int) -> int:
        """Number of tasks that can be submitted now, see Workers: no more are out than there are processes."""
        return self.count - out

    def submit(self, packed: bytes) -> "Future[bytes]":
        """Let a process solve a pickled task."""
        if self.pool is None or self.fresh:
            self._end()
            self.ready = self.context.Value("b", 0, lock=False)
            with _STARTING, _environment(ENVIRONMENT):  # it starts a process that keeps count of its semaphores
                self.pool = ProcessPoolExecutor(self.count, self.context, _begin, (self.ready,))
        try:
            with _STARTING, _environment(ENVIRONMENT), _held():
                return self.pool.submit(answered, packed)
        except BrokenProcessPool:
            self.lost()
            return self.submit(packed)

    def lost(self) -> None:
        """Give up a pool in which a process died. Raises ChildProcessError where all end as they start."""
        if self.pool is not None:
            self.stillborn = 0 if self.ready.value else self.stillborn + 1
            self._end()
        if self.stillborn >= STILLBORN:
            raise ChildProcessError(
                f"worker processes ended as they started, {STILLBORN} times: a script has to call this under "
                'if __name__ == "__main__":'
            )

    def call_back(self) -> None:
        """Cancel nothing, as all that is submitted is being solved, see Workers."""

    def _end(self, kill=False):
        if self.pool is None:
            return
        if kill:
            for process in list((self.pool._processes or {}).values()):  # public from Python 3.14 on
                process.kill()
        self.pool.shutdown(cancel_futures=True)
        self.pool = None


def _begin(ready):
    """Begin a worker, which heeds no terminal and ends at once when its parent ends, in whatever way."""
    for number in FROM_THE_TERMINAL:
        signal.signal(number, signal.SIG_IGN)
    parent = multiprocessing.parent_process()

    def end_with_the_parent():
        wait([parent.sentinel])
        os._exit(1)

    threading.Thread(target=end_with_the_parent, daemon=True).start()
    ready.value = 1


@contextmanager
def caught() -> Iterator[list[int]]:
    """The list of the signals that came meanwhile and would have raised KeyboardInterrupt."""
    came: list[int] = []
    if threading.current_thread() is not threading.main_thread():
        yield came
        return
    raising = [n for n in signal.valid_signals() if signal.getsignal(n) is signal.default_int_handler]
    for number in raising:
        signal.signal(number, lambda number, frame: came.append(number))
    try:
        yield came
    finally:
        for number in raising:
            signal.signal(number, signal.default_int_handler)


@contextmanager
def _held() -> Iterator[None]:
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
def _environment(variables: Mapping[str, str]) -> Iterator[None]:
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
