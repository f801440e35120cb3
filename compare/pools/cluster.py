"""Workers of a dask.distributed cluster. What comes back is stored by this process alone."""

import logging
import os
import pickle
import queue
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any
from uuid import uuid4

from scene import Refused

from ..store import Task, code_of
from .answer import Answer, Fault, Lost, answered, unpacked
from .local import ONE_THREAD

if TYPE_CHECKING:
    from distributed import Client, Future

EXTRA = "pip install mdr-bem-crosscheck[cluster]"
# Seconds in which a scheduler answers, in which it lets go, and between two looks at its workers.
ANSWERS, LETS_GO, LOOKS = 5.0, 2.0, 1.0
# Tasks handed out beyond one a thread, so that no worker waits for its next.
SPARE = 2
# What a nanny gives its worker; no kernel of ours asks numba for threads.
BLAS = {name: count for name, count in ONE_THREAD.items() if not name.startswith("NUMBA")}
SINGLE = " ".join(f"{name}={count}" for name, count in BLAS.items())
NOISE = "distributed", "distributed.client", "distributed.comm", "distributed.core", "distributed.utils"


@dataclass(frozen=True)
class Stranger:
    """What a worker of other code gives in the place of an answer: who it is, and how it differs."""

    address: str
    differs: str


class Deadly(Fault):
    """Loss of a task that was with several workers as they died."""


@dataclass(eq=False)
class _Flight:
    """A task on its way.

    workers : to whom alone it may go, empty if to any
    suspect : workers died while they had it; which of their tasks they died of is seen when each goes alone
    """

    task: Task
    packed: bytes
    workers: frozenset[str] = frozenset()
    suspect: bool = False


class Cluster:
    """A pool, as of answer: whoever works for a scheduler, with the same code and versions as this process.

    address : of the scheduler
    packages : whose code has to be the same there
    say : is told, in a line, which workers are refused, and when there is none

    Raises Refused, ConnectionError on entry, see sweep. What is handed out is a few more than the workers have
    threads; it ends with this process, but for what is being solved just then, of which the answer is dropped.
    """

    def __init__(self, address: str, packages: Sequence[str], say: Callable[[str], None]):
        self.address, self.packages, self.say = address, tuple(packages), say
        self.here = code_of(self.packages)
        self.flights: dict[Future, _Flight] = {}
        self.back: queue.SimpleQueue[Future] = queue.SimpleQueue()
        self.strangers: dict[str, str] = {}
        self.threads: dict[str, int] = {}
        self.unsent: list[tuple[Task, Answer]] = []
        self.suspects: list[_Flight] = []
        self.looked, self.alone = -LOOKS, False

    def __enter__(self):
        self.stack = ExitStack()
        self.stack.enter_context(_quiet())
        self.stack.callback(self._let_go)
        self.client = None
        try:
            self.client = _connected(self.address)
            self._look()
            if self.strangers and not self.threads:
                raise Refused(f"no worker of {self.address} can be used: {self._refusals()}")
        except BaseException:
            self.stack.close()
            raise
        return self

    def __exit__(self, *_):
        self.stack.close()

    def _let_go(self):
        """Cancel all that is on its way. The client may be lost already, and complain of anything."""
        if self.client is None:
            return
        with suppress(Exception):
            if self.client.status == "running":
                self.client.cancel(list(self.flights), force=True)
            self.client.close(timeout=LETS_GO)

    def room(self) -> int:
        """Number of tasks that can be handed out now, see Pool; none without workers, which is said."""
        if time.monotonic() - self.looked >= LOOKS:
            self._look()
        if not self.threads:
            if not self.alone:
                self.say(f"no worker at {self.address}: waiting for one")
            self.alone = True
            return 0
        self.alone = False
        return sum(self.threads.values()) + SPARE - len(self.flights)

    def hand_out(self, task: Task) -> None:
        """Hand a task to whichever worker is free, see Pool."""
        try:
            packed = pickle.dumps(task)
        except Exception as error:
            self.unsent.append((task, Fault.of(error)))
            return
        self._submit(_Flight(task, packed))

    def answers(self, patience: float) -> list[tuple[Task, Answer]]:
        """Answers that have come, see Pool."""
        self._check()
        found, self.unsent = self.unsent, []
        if found:
            return found
        if self.suspects and not self.flights:
            self._submit(self.suspects.pop())
        with suppress(queue.Empty):
            found += self._take(self.back.get(timeout=patience))
            while True:
                found += self._take(self.back.get_nowait())
        return found

    def call_back(self) -> list[Task]:
        """Call back what has not started, see Pool. Where nobody says what is being solved, everything is."""
        keys: set[str] = set()
        try:
            for each in self.client.run(_executing).values():
                keys.update(each)
        except Exception:
            return []
        idle = [future for future in self.flights if future.key not in keys and not future.done()]
        self.client.cancel(idle, force=True)
        suspects, self.suspects = [flight.task for flight in self.suspects], []
        return suspects + [self.flights.pop(future).task for future in idle]

    def _submit(self, flight):
        flight.workers = frozenset(self.threads) if self.strangers else frozenset()
        future = self.client.submit(
            solved_there,
            flight.packed,
            self.packages,
            self.here,
            key=f"{type(flight.task).__name__}-{uuid4().hex}",
            workers=sorted(flight.workers) or None,
            pure=False,
        )
        self.flights[future] = flight
        future.add_done_callback(self.back.put)

    def _take(self, future) -> Iterator[tuple[Task, Answer]]:
        flight = self.flights.pop(future, None)
        if flight is None:
            return
        try:
            answer = self._answer(future)
        except TimeoutError:
            # Its worker was lost with the answer, and it is solved again.
            self.flights[future] = flight
            future.add_done_callback(self.back.put)
            return
        if isinstance(answer, Stranger):
            self._refuse(answer.address, answer.differs)
            self._submit(flight)
        elif isinstance(answer, Deadly) and not flight.suspect:
            flight.suspect = True
            self.suspects.append(flight)
        else:
            yield flight.task, answer

    def _answer(self, future):
        """What a task raises comes back as its answer; what is raised here is the cluster's own."""
        if future.status == "finished":
            return unpacked(future.result(timeout=ANSWERS))
        self._check()
        if future.status != "error":
            return Lost("the cluster dropped it")
        error = future.exception()
        if type(error).__name__ == "KilledWorker":
            return Deadly(f"{error.allowed_failures + 1} workers of the cluster died as they solved it")
        self._look()
        return Lost(Fault.of(error).reason)

    def _look(self):
        """At who works there now: newcomers have to say what they solve with."""
        self._check()
        try:
            known = {address: int(count) for address, count in self.client.nthreads().items()}
            new = [address for address in known if address not in self.threads | self.strangers]
            said = self.client.run(introduced, self.packages, workers=new, on_error="return") if new else {}
        except (OSError, TimeoutError, ValueError) as error:
            self._check()
            raise self._lost() from error
        self.looked = time.monotonic()
        self.strangers = {address: why for address, why in self.strangers.items() if address in known}
        for address, found in said.items():
            if differs := differences(self.here, found):
                self._refuse(address, differs)
            elif found["threads"] != BLAS:
                self.say(f"worker {address} may use more than a thread a task: start it with {SINGLE}")
        self.threads = {address: count for address, count in known.items() if address not in self.strangers}
        self._redirect()

    def _redirect(self):
        """What waits for workers that are gone may go to others."""
        for future, flight in list(self.flights.items()):
            if flight.workers and not flight.workers & self.threads.keys() and self.threads and not future.done():
                del self.flights[future]
                self.client.cancel([future], force=True)
                self._submit(flight)

    def _refuse(self, address, differs):
        self.strangers[address] = differs
        self.threads.pop(address, None)
        self.say(f"worker {address} is refused: {differs}")

    def _refusals(self):
        return "; ".join(f"{address}: {differs}" for address, differs in sorted(self.strangers.items()))

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
        return f"it does not say what it solves with ({type(there).__name__}: {there})"
    code = [name for name, digest in here["code"].items() if there["code"].get(name) != digest]
    other = [f"its code of {', '.join(code)} is another"] if code else []
    for name, mine in here["versions"].items():
        if there["versions"].get(name) != mine:
            other.append(f"its {name} is {there['versions'].get(name)}, here {mine}")
    return "; ".join(other)


def introduced(packages: Sequence[str]) -> dict[str, Mapping[str, str | None]]:
    """On a worker: what it solves with, as code_of, and the threads of its libraries."""
    return {**code_of(packages), "threads": {name: os.environ.get(name) for name in BLAS}}


def solved_there(packed: bytes, packages: Sequence[str], here: Mapping) -> bytes:
    """On a worker: the answer to a task, both pickled, or a Stranger."""
    if differs := differences(here, code_of(packages)):
        from distributed import get_worker

        return pickle.dumps(Stranger(get_worker().address, differs))
    return answered(packed)


def _executing(dask_worker) -> list[str]:
    """On a worker: keys of what it is solving."""
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
def _quiet():
    """What the library logs of a connection that is lost is said in one line, by us."""
    loggers = [logging.getLogger(name) for name in NOISE]
    before = [each.level for each in loggers]
    for each in loggers:
        each.setLevel(logging.CRITICAL)
    try:
        yield
    finally:
        for each, level in zip(loggers, before, strict=True):
            each.setLevel(level)
