"""Workers of a dask.distributed cluster, with the same code. This process alone stores their answers."""

import logging
import os
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Future
from contextlib import ExitStack, contextmanager, suppress
from typing import TYPE_CHECKING, Any
from uuid import uuid4

from scene import Refused

from .store import code_of
from .workers import ONE_THREAD, VersionMismatch, answered

if TYPE_CHECKING:
    from distributed import Client

EXTRA = "pip install mdr-bem-crosscheck[cluster]"
# Seconds in which a scheduler answers, in which it lets go, and between two looks at its workers.
ANSWERS, LETS_GO, LOOKS = 5.0, 2.0, 1.0
# Tasks submitted beyond one a thread, so that no worker waits for its next.
SPARE = 2
# What a nanny gives its worker; no kernel of ours asks numba for threads.
BLAS = {name: count for name, count in ONE_THREAD.items() if not name.startswith("NUMBA")}
SINGLE = " ".join(f"{name}={count}" for name, count in BLAS.items())
NOISE = "distributed", "distributed.client", "distributed.comm", "distributed.core", "distributed.utils"


class Cluster:
    """Workers of a scheduler that have the same code and versions as this process, see workers.Workers.

    address : of the scheduler
    packages : whose code has to be the same there
    say : is told, in a line, which workers are refused, and when there is none

    Raises Refused, ConnectionError on entry, see sweep. A few more tasks are submitted than the workers have
    threads. All ends with this process, except the contacts being solved just then, whose answers are dropped.
    """

    tries = 2  # as the scheduler tries a task with several workers before it says that they died

    def __init__(self, address: str, packages: Sequence[str], say: Callable[[str], Any]):
        self.address, self.packages, self.say = address, tuple(packages), say
        self.here = code_of(self.packages)
        self.threads: dict[str, int] = {}
        self.refused: dict[str, str] = {}
        self.flights: dict[Future[bytes], tuple[str, frozenset[str]]] = {}
        self.looked, self.alone = -LOOKS, False
        self.died: tuple[type[BaseException], ...] = ()

    def __enter__(self):
        self.stack = ExitStack()
        self.stack.enter_context(_quiet())
        self.stack.callback(self._let_go)
        self.client = None
        try:
            self.client = _connected(self.address)
            from distributed import KilledWorker

            self.died = (KilledWorker,)
            self.executor = self.client.get_executor(pure=False)
            self._look()
            if self.refused and not self.threads:
                raise Refused(f"no worker of {self.address} can be used: {self._refusals()}")
        except BaseException:
            self.stack.close()
            raise
        return self

    def __exit__(self, *_):
        self.stack.close()

    def _let_go(self):
        """Cancel all that is on its way. The client may be lost already, and complain of anything."""
        if self.client is not None:
            with suppress(Exception):
                if self.client.status == "running":
                    self.executor.shutdown(wait=False)
                self.client.close(timeout=LETS_GO)

    def room(self, out: int) -> int:
        """Number of tasks that can be submitted now, see Workers; none without workers, which is said."""
        self._check()
        if time.monotonic() - self.looked >= LOOKS:
            self._look()
        if not self.threads:
            if not self.alone:
                self.say(f"no worker at {self.address}: waiting for one")
            self.alone = True
            return 0
        self.alone = False
        return sum(self.threads.values()) + SPARE - out

    def submit(self, packed: bytes) -> "Future[bytes]":
        """Let whichever worker is free solve a pickled task, see Workers."""
        name, allowed = f"solve-{uuid4().hex}", frozenset(self.threads) if self.refused else frozenset()
        future = self.executor.submit(
            answered_there, packed, self.packages, self.here, key=name, workers=sorted(allowed) or None
        )
        self.flights[future] = name, allowed
        future.add_done_callback(lambda future: self.flights.pop(future, None))
        return future

    def lost(self) -> None:
        """Raise ConnectionError where the scheduler is lost, see Workers."""
        self._check()

    def call_back(self) -> None:
        """Cancel what no worker is solving, see Workers."""
        with suppress(Exception):
            at_work = {key for keys in self.client.run(_executing).values() for key in keys}
            for future, (name, _) in list(self.flights.items()):
                if name not in at_work:
                    future.cancel()

    def _look(self):
        """At who works there now: newcomers have to say what they solve with."""
        try:
            known = {address: int(count) for address, count in self.client.nthreads().items()}
            new = [address for address in known if address not in self.threads | self.refused]
            said = self.client.run(introduced, self.packages, workers=new, on_error="return") if new else {}
        except (OSError, TimeoutError, ValueError) as error:
            raise self._lost() from error
        self.looked = time.monotonic()
        self.refused = {address: why for address, why in self.refused.items() if address in known}
        for address, found in said.items():
            if differs := differences(self.here, found):
                self.refused[address] = differs
                self.say(f"worker {address} is refused: {differs}")
            elif found["threads"] != BLAS:
                self.say(f"worker {address} may use more than a thread a task: start it with {SINGLE}")
        self.threads = {address: count for address, count in known.items() if address not in self.refused}
        for future, (_, allowed) in list(self.flights.items()):
            if allowed and not allowed & self.threads.keys():
                future.cancel()  # all who were allowed to solve it are gone

    def _refusals(self):
        return "; ".join(f"{address}: {differs}" for address, differs in sorted(self.refused.items()))

    def _check(self):
        if self.client.status != "running":
            raise self._lost()

    def _lost(self):
        return ConnectionError(f"the scheduler at {self.address} is lost")


def differences(here: Mapping[str, Mapping[str, str]], there: Any) -> str:
    """Differences of what a worker solves with from what is used here, in words; empty where it does not.

    there : as code_of gives it, or the exception that came in its place
    """
    if isinstance(there, BaseException):
        return f"it does not state its code ({type(there).__name__}: {there})"
    code = [name for name, digest in here["code"].items() if there["code"].get(name) != digest]
    other = [f"its code of {', '.join(code)} is another"] if code else []
    for name, mine in here["versions"].items():
        if there["versions"].get(name) != mine:
            other.append(f"its {name} is {there['versions'].get(name)}, here {mine}")
    return "; ".join(other)


def introduced(packages: Sequence[str]) -> dict[str, Mapping[str, str | None]]:
    """Code of a worker, as code_of, with the threads of its libraries; runs on the worker."""
    return {**code_of(packages), "threads": {name: os.environ.get(name) for name in BLAS}}


def answered_there(packed: bytes, packages: Sequence[str], here: Mapping) -> bytes:
    """Answer to a task, both pickled; runs on a worker. Raises VersionMismatch of a worker that has just come."""
    if differs := differences(here, code_of(packages)):
        raise VersionMismatch(differs)
    return answered(packed)


def _executing(dask_worker) -> list[str]:
    """Keys of the tasks that a worker is solving; runs on the worker."""
    return [state.key for state in dask_worker.state.executing]


def _connected(address) -> "Client":
    try:
        from distributed import Client
        from distributed.comm import resolve_address
    except ImportError as error:
        raise Refused(f"a cluster needs dask.distributed: {EXTRA}") from error
    try:
        resolve_address(address)  # a client that cannot read it hangs at the end of the program
        return Client(address, timeout=ANSWERS, set_as_default=False)
    except (OSError, TimeoutError) as error:
        raise ConnectionError(f"no scheduler answers at {address} within {ANSWERS:g} s") from error
    except ValueError as error:
        raise Refused(f"{address} is no address of a scheduler, as tcp://name:8786: {error}") from error


@contextmanager
def _quiet() -> Iterator[None]:
    """Silence the log of the library on a lost connection, which we report in one line."""
    loggers = [logging.getLogger(name) for name in NOISE]
    before = [each.level for each in loggers]
    for each in loggers:
        each.setLevel(logging.CRITICAL)
    try:
        yield
    finally:
        for each, level in zip(loggers, before, strict=True):
            each.setLevel(level)
