"""Executors of this machine, what one of their workers does with a task, and signals that end a run."""

import multiprocessing
import os
import pickle
import platform
import signal
import threading
import traceback
from collections.abc import Iterator, Mapping
from concurrent.futures import BrokenExecutor, Executor, Future, ProcessPoolExecutor
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from multiprocessing.connection import wait
from typing import Any, Self

from scene import Refused
from scene.files.reading import whole

from .digest import code_of
from .task import Outcome, Task

MOST = 1024
# A worker solves on one thread; two workers with two threads each are slower than either alone.
ONE_THREAD = {f"{library}_NUM_THREADS": "1" for library in ("OMP", "OPENBLAS", "MKL", "NUMBA")}
# Python would look for the first modules of a new process in the working folder.
ENVIRONMENT = ONE_THREAD | {"PYTHONSAFEPATH": "1"}
_STARTING = threading.RLock()  # held while a process starts, as all threads share the environment
# Pools that end before a worker of theirs is ready, one after the other, until it is plain that none will be.
MOST_FAILED_STARTS = 3
# What a terminal sends to every process of a run: workers leave it to their parent.
FROM_THE_TERMINAL = {getattr(signal, name) for name in ("SIGINT", "SIGHUP") if hasattr(signal, name)}


def counted(workers: int | None) -> int:
    """Number of processes: as stated, else as many as processors. Raises InvalidInput."""
    if workers is None:
        return os.cpu_count() or 1
    return whole("workers", workers, MOST)


@dataclass(frozen=True)
class Answer:
    """Answer of a worker to a task: its outcome, or why it broke.

    reason : type and message of what was raised, in a line
    trace : where, for whoever mends it; empty where nothing was raised
    """

    outcome: Outcome | None = None
    reason: str = ""
    trace: str = ""

    @classmethod
    def of(cls, error: BaseException) -> Self:
        """Answer made of what was raised."""
        reason = ": ".join(filter(None, [type(error).__name__, " ".join(str(error).split())]))
        return cls(None, reason, "".join(traceback.format_exception(error)))


def answered(packed: bytes, here: Mapping[str, Mapping[str, str]]) -> bytes:
    """Answer to a task, both pickled; runs in a worker. Raises Refused where its code differs from `here`."""
    if differs := differences(here):
        raise Refused(f"a worker on {platform.node()} cannot be used: {differs}")
    try:
        return pickle.dumps(solved(pickle.loads(packed)))
    except Exception as error:
        return pickle.dumps(Answer.of(error))


def solved(task: Task) -> Answer:
    """Answer to a task, solved in this process, whatever is raised on the way."""
    try:
        outcome = task.solve()
        if not task.fits(outcome):
            raise ValueError(f"its answer is not whole: {len(outcome.rows)} rows, fields {[*outcome.fields]}")
        return Answer(outcome)
    # Catch SystemExit too: it must not end the worker.
    except (Exception, SystemExit) as error:
        return Answer.of(error)


def differences(here: Mapping[str, Mapping[str, str]]) -> str:
    """Differences of what this process solves with from what is used `here`, see `code_of`; empty without any."""
    try:
        there = code_of(tuple(here["code"]))
    except Exception as error:
        return f"it does not state its code ({type(error).__name__}: {error})"
    code = [name for name, digest in here["code"].items() if there["code"][name] != digest]
    other = [f"its code of {', '.join(code)} is another"] if code else []
    found = there["versions"]
    other += [
        f"its {name} is {found.get(name)}, here {mine}"
        for name, mine in here["versions"].items()
        if found.get(name) != mine
    ]
    return "; ".join(other)


class Workers:
    """Workers of an executor, which is made and ended elsewhere. Left by an exception, it ends all at once.

    executor : anything with `submit`, as those of concurrent.futures
    count : tasks that are handed out at once
    died : exceptions of a future whose worker died, of its task or for another reason
    tries : deaths of workers until a task counts as their reason
    """

    died: tuple[type[BaseException], ...] = (BrokenExecutor,)
    tries = 3

    def __init__(self, executor: Executor | None, count: int):
        self.executor: Any = executor
        self.count = count

    def __enter__(self):
        return self

    def __exit__(self, *_):
        pass

    def room(self) -> int:
        """Most tasks that are handed out at once; 0 without workers. Raises OSError where none can come."""
        return self.count

    def submit(self, packed: bytes, here: Mapping) -> "Future[bytes]":
        """Let a worker answer a pickled task, see `answered`. Raises OSError of an executor that takes none."""
        with suppress(BrokenExecutor):
            return self.executor.submit(answered, packed, here)
        self.renew()
        return self.submit(packed, here)

    def renew(self) -> None:
        """Replace workers after a death. Raises OSError where none can be had any more."""
        raise ChildProcessError("the executor has lost a worker and solves nothing more: make another one")


class Processes(Workers):
    """Processes of this machine: a ProcessPoolExecutor, made anew where one of its processes dies.

    count : of processes, one thread each
    fresh : whether every task has a process of its own, which is then the only one: `count` is 1
    """

    def __init__(self, count: int, fresh: bool = False):
        super().__init__(None, count)
        self.fresh, self.failed_starts = fresh, 0
        self.context = multiprocessing.get_context("spawn")

    def __exit__(self, kind, *_):
        self._end(kill=kind is not None)

    def submit(self, packed: bytes, here: Mapping) -> "Future[bytes]":
        """Let a process answer a pickled task; the first ones, or each where they are to be fresh, start it."""
        with _STARTING, _birth():
            if self.fresh:
                self._end()
            if self.executor is None:
                self.ready = self.context.Value("b", 0, lock=False)
                self.executor = ProcessPoolExecutor(self.count, self.context, _begin, (self.ready,))
            return super().submit(packed, here)

    def renew(self) -> None:
        """End a pool in which a process died. Raises ChildProcessError where all end as they start."""
        if self.executor is not None:
            self.failed_starts = 0 if self.ready.value else self.failed_starts + 1
            self._end()
        if self.failed_starts >= MOST_FAILED_STARTS:
            raise ChildProcessError(
                f"worker processes ended as they started, {MOST_FAILED_STARTS} times: a script has to call this "
                'under if __name__ == "__main__":'
            )

    def _end(self, kill=False):
        if self.executor is None:
            return
        if kill:
            for process in list((self.executor._processes or {}).values()):  # public from Python 3.14 on
                process.kill()
        self.executor.shutdown(cancel_futures=True)
        self.executor = None


def _begin(ready):
    """Begin a worker, which heeds no terminal and ends at once when its parent ends, in whatever way."""
    for number in FROM_THE_TERMINAL:
        signal.signal(number, signal.SIG_IGN)
    parent: Any = multiprocessing.parent_process()

    def end_with_the_parent():
        wait([parent.sentinel])
        os._exit(1)

    threading.Thread(target=end_with_the_parent, daemon=True).start()
    ready.value = 1


@contextmanager
def caught() -> Iterator[list[int]]:
    """The list of the signals that came meanwhile, of those that raise KeyboardInterrupt; the second raises it."""
    came: list[int] = []

    def note(number, frame):
        came.append(number)
        if len(came) > 1:
            raise KeyboardInterrupt

    main = threading.current_thread() is threading.main_thread()
    every = signal.valid_signals() if main else ()
    raising = [number for number in every if signal.getsignal(number) is signal.default_int_handler]
    for number in raising:
        signal.signal(number, note)
    try:
        yield came
    finally:
        for number in raising:
            signal.signal(number, signal.default_int_handler)


@contextmanager
def _birth() -> Iterator[None]:
    """Environment of processes that start meanwhile, which libraries read as they are imported, and their mask.

    An interrupt from the keyboard would end a process before it heeds none.
    """
    before = {name: os.environ.get(name) for name in ENVIRONMENT}
    masked = hasattr(signal, "pthread_sigmask") and signal.pthread_sigmask(signal.SIG_BLOCK, FROM_THE_TERMINAL)
    os.environ.update(ENVIRONMENT)
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value
        if masked is not False:
            signal.pthread_sigmask(signal.SIG_SETMASK, masked)
