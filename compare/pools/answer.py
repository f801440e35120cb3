"""What comes back of a task that was handed out: its outcome, or why there is none."""

import pickle
import traceback
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol, Self

from ..outcome import Outcome
from ..store import Task


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


@dataclass(frozen=True)
class Lost:
    """A task whose worker ended before it had an answer. how : in words, a clause"""

    how: str


Answer = Outcome | Fault | Lost


class Pool(Protocol):
    """A context: workers, to whom tasks are handed out and who answer in any order.

    Left by an exception, it ends what is being solved at once.
    """

    def room(self) -> int:
        """Number of tasks that can be handed out now. Raises OSError where no worker can be had any more."""

    def hand_out(self, task: Task) -> None:
        """Let a worker solve a task."""

    def answers(self, patience: float) -> Sequence[tuple[Task, Answer]]:
        """What has come back, waited for at most so many seconds. Raises OSError as room."""

    def call_back(self) -> Sequence[Task]:
        """Take back, and return, what is handed out and has not been started."""


def answered(packed: bytes) -> bytes:
    """The answer to a task, both pickled; whatever is raised on the way is a fault."""
    try:
        task = pickle.loads(packed)
        outcome = task.solve()
        if not task.fits(outcome):
            raise ValueError(f"what it gave is not whole: {len(outcome.rows)} rows, fields {[*outcome.fields]}")
        return pickle.dumps(outcome)
    # A worker is nobody's program: what a task ends by SystemExit ends that task.
    except (Exception, SystemExit) as error:
        return pickle.dumps(Fault.of(error))


def unpacked(packed: bytes) -> Answer:
    """The answer out of what `answered` gave."""
    try:
        return pickle.loads(packed)
    except Exception as error:
        return Fault.of(error)
