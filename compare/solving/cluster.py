"""Workers of a dask.distributed cluster, with the same code. This process alone stores their answers."""

import logging
import re
import time
from collections.abc import Callable
from concurrent.futures import Future, wait
from contextlib import ExitStack, suppress
from functools import partial
from threading import Thread
from typing import Any

from scene import Refused
from scene.printable import brief

from .executors import Workers

ADDRESS = re.compile(r"\w+://[^\s/]+:\d+")
EXTRA = "pip install mdr-bem-crosscheck[cluster]"
# Seconds in which a scheduler answers, after which it is lost, in which it lets go, between two looks at it.
ANSWERS, LOST, LETS_GO, LOOKS = 4.0, 30.0, 2.0, 1.0
SPARE = 2  # tasks submitted beyond one a thread, so that no worker waits for its next
NOISE = "distributed", "distributed.client", "distributed.comm", "distributed.core", "distributed.utils"


class Cluster(Workers):
    """Workers of a scheduler, see `Workers`.

    address : of the scheduler
    say : called with a line of text when there is no worker

    Raises Refused, ConnectionError on entry, see `sweep`. A few more tasks are submitted than the workers have
    threads. All ends with this process, except the contacts being solved just then, whose answers are dropped.
    """

    tries = 2  # as the scheduler tries a task with several workers before it says that they died

    def __init__(self, address: str, say: Callable[[str], Any]):
        self.address, self.say = address, say
        self.lost = f"the scheduler at {address} is lost"
        self.threads, self.looked = 1, 0.0

    def __enter__(self):
        if not ADDRESS.fullmatch(self.address):
            raise Refused(f"scheduler = {brief(repr(self.address))}: an address, as tcp://name:8786")
        try:
            from distributed import Client, KilledWorker
        except ImportError as error:
            raise Refused(f"a cluster needs dask.distributed: {EXTRA}") from error
        self.died = (KilledWorker,)
        with ExitStack() as stack:
            for logger in map(logging.getLogger, NOISE):  # a lost connection is reported in one line
                stack.callback(logger.setLevel, logger.level)
                logger.setLevel(logging.CRITICAL)
            try:
                client = partial(Client, self.address, timeout=ANSWERS, set_as_default=False)
                self.client = answer_within(2 * ANSWERS, client)
            except (OSError, ValueError) as error:
                raise ConnectionError(f"no scheduler of dask answers at {brief(self.address)}") from error
            stack.callback(self._let_go)
            self.executor = self.client.get_executor(pure=False)
            self.stack = stack.pop_all()
        return self

    def __exit__(self, *_):
        self.stack.close()

    def _let_go(self):
        """Cancel all that is on its way. The client may be lost already, and complain of anything."""
        with suppress(Exception):
            if self.client.status == "running":
                self.executor.shutdown(wait=False)
            self.client.close(timeout=LETS_GO)

    def room(self) -> int:
        """Number of tasks to submit: threads of the workers and a few more, or 0 without workers.

        Raises ConnectionError.
        """
        if self.client.status != "running":
            raise ConnectionError(self.lost)
        if time.monotonic() - self.looked >= LOOKS:
            before, self.threads = self.threads, sum(self._asked(self.client.nthreads).values())
            self.looked = time.monotonic()
            if before and not self.threads:
                self.say(f"no worker at {self.address}: waiting for one, with this package installed")
        return self.threads + SPARE if self.threads else 0

    def renew(self) -> None:
        """The scheduler replaces workers."""

    def _asked(self, ask):
        try:
            return answer_within(LOST, ask)
        except (OSError, TimeoutError, ValueError) as error:
            raise ConnectionError(self.lost) from error


def answer_within(seconds: float, ask: Callable[[], Any]) -> Any:
    """What a call of the library gives, which may wait for ever and lets no signal through.

    Raises what it raises, TimeoutError after these seconds.
    """
    answer: Future[Any] = Future()

    def call():
        try:
            answer.set_result(ask())
        except BaseException as error:
            answer.set_exception(error)

    Thread(target=call, daemon=True).start()
    if not wait([answer], seconds).done:
        raise TimeoutError
    return answer.result()
