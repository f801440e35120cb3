"""Workers of a dask.distributed cluster, with the same code. This process alone stores their answers."""

import asyncio
import logging
import os
import socket
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Future, wait
from contextlib import ExitStack, contextmanager, suppress
from functools import partial
from threading import Thread
from typing import TYPE_CHECKING, Any
from uuid import uuid4

from scene import Refused
from scene.printable import brief

from .store import code_of
from .workers import ONE_THREAD, PULSE, VersionMismatch, answered

if TYPE_CHECKING:
    from distributed import Client

EXTRA = "pip install mdr-bem-crosscheck[cluster]"
# Seconds in which a scheduler answers, after which it is lost, in which it lets go, between two looks at it.
ANSWERS, LOST, LETS_GO, LOOKS = 4.0, 30.0, 2.0, 1.0
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
    interrupts : signals that came; the first ends what is waited for on entry, the second anything

    Raises Refused, ConnectionError on entry, see sweep. A few more tasks are submitted than the workers have
    threads. All ends with this process, except the contacts being solved just then, whose answers are dropped.
    """

    tries = 2  # as the scheduler tries a task with several workers before it says that they died

    def __init__(
        self, address: str, packages: Sequence[str], say: Callable[[str], Any], interrupts: Sequence[int] = ()
    ):
        self.address, self.packages, self.say, self.interrupts = address, tuple(packages), say, interrupts
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
            self.client = self._connected()
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
            at_work = {
                key for keys in self._answer(partial(self.client.run, _executing), LOST).values() for key in keys
            }
            for future, (name, _) in list(self.flights.items()):
                if name not in at_work:
                    future.cancel()

    def _look(self):
        """At who works there now: newcomers have to say what they solve with."""
        try:
            found = self._answer(self.client.nthreads, LOST)
            known = {address: int(count) for address, count in found.items()}
            new = [address for address in known if address not in self.threads | self.refused]
            ask = partial(self.client.run, introduced, self.packages, workers=new, on_error="return")
            said = self._answer(ask, LOST) if new else {}
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

    def _connected(self) -> "Client":
        from distributed import Client
        from distributed.comm import CommClosedError, get_address_host_port, resolve_address

        try:
            host, port = get_address_host_port(self.address)  # inproc:// has none
            if not (host.encode("idna") and 0 < port < 2**16):
                raise ValueError
        except (TypeError, ValueError) as error:
            raise Refused(f"scheduler = {brief(repr(self.address))}: an address, as tcp://name:8786") from error

        def asked():
            return asyncio.run(asyncio.wait_for(_kind(resolve_address(self.address)), ANSWERS))

        # A client at an address that is none of a scheduler waits for ever, and holds the end of the program.
        try:
            if (kind := self._answer(asked, ANSWERS)) != "Scheduler":
                raise ValueError(kind)
            return self._answer(partial(Client, self.address, timeout=ANSWERS, set_as_default=False), ANSWERS)
        except Exception as error:
            reason = "another program answers there, or one that wants TLS set up in the configuration of dask"
            if isinstance(error, socket.gaierror):
                reason = "no host has this name"
            elif isinstance(error, OSError) and not isinstance(error, CommClosedError):
                reason = f"nothing answers within {ANSWERS:g} s"
            raise ConnectionError(f"{brief(self.address)} is no scheduler of dask: {reason}") from error

    def _answer(self, ask: Callable[[], Any], seconds: float) -> Any:
        """What a call of the library gives, which may wait for ever and lets no signal through.

        Raises what it raises, TimeoutError after these seconds, KeyboardInterrupt at an interrupt.
        """
        answer: Future[Any] = Future()

        def call():
            try:
                answer.set_result(ask())
            except BaseException as error:
                answer.set_exception(error)

        Thread(target=call, daemon=True).start()
        until = time.monotonic() + seconds
        while not wait([answer], PULSE).done:
            if len(self.interrupts) > (self.client is not None):
                raise KeyboardInterrupt
            if time.monotonic() > until:
                raise TimeoutError
        return answer.result()

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


async def _kind(address) -> str:
    """Kind of the server of dask at an address, as "Scheduler". Raises nearly anything of another one."""
    from distributed import Security
    from distributed.core import rpc

    async with rpc(address, timeout=ANSWERS, connection_args=Security().get_connection_args("client")) as there:
        return (await there.identity())["type"]


@contextmanager
def _quiet() -> Iterator[None]:
    """Silence the log of the library on a lost connection, which we report in one line. Raises Refused."""
    try:
        import distributed  # noqa: F401, sets the levels of its log
    except ImportError as error:
        raise Refused(f"a cluster needs dask.distributed: {EXTRA}") from error
    loggers = [logging.getLogger(name) for name in NOISE]
    before = [each.level for each in loggers]
    for each in loggers:
        each.setLevel(logging.CRITICAL)
    try:
        yield
    finally:
        for each, level in zip(loggers, before, strict=True):
            each.setLevel(level)
