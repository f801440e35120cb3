"""What is asked of accuracy and time: diagrams of contests, and what a reader can do with them."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

from ..outcome import Outcome
from ..store import Task
from .rung import Rung

SIZES = ("quick", "full")


class Entry(Protocol):
    """What a diagram is made of: a Contest of ladders, or an Ensemble of surfaces."""

    @property
    def name(self) -> str:
        """For files."""

    @property
    def title(self) -> str:
        """For people."""

    @property
    def timed(self) -> Sequence[Rung]:
        """What is measured alone."""

    @property
    def untimed(self) -> Sequence[Task]:
        """What is solved besides."""

    def judged(self, outcomes: Mapping[Task, Outcome]) -> Any:
        """All of it measured: Judged or JudgedEnsemble."""


class Inquiry(Protocol):
    """What the command measures, and tells."""

    @property
    def name(self) -> str:
        """Of the command and of files."""

    @property
    def title(self) -> str:
        """What is compared, for people."""

    @property
    def about(self) -> str:
        """How, and why, for people."""

    def untimed(self, size: str) -> list[Task]:
        """What is solved besides, each once."""

    def timed(self, size: str) -> list[Rung]:
        """What is measured alone, each once."""

    def judge(self, size: str, outcomes: Mapping[Task, Outcome]) -> Any:
        """All of it measured, as figures take it."""

    def advice(self, found: Any) -> str:
        """A paragraph that a reader can act on, from the numbers found."""


@dataclass(frozen=True)
class Diagram:
    """An inquiry into errors over time.

    contests : at a size, "quick" or "full"
    advice : as of Inquiry
    """

    name: str
    title: str
    about: str
    contests: Callable[[str], Sequence[Entry]]
    advice: Callable[[Sequence[Any]], str]

    def untimed(self, size: str) -> list[Task]:
        """As of Inquiry."""
        return untimed(self.contests(size))

    def timed(self, size: str) -> list[Rung]:
        """As of Inquiry."""
        return timed(self.contests(size))

    def judge(self, size: str, outcomes: Mapping[Task, Outcome]) -> list[Any]:
        """Every contest, judged."""
        return judged(self.contests(size), outcomes)


def timed(contests: Sequence[Entry]) -> list[Rung]:
    """What is measured alone, each once."""
    return list(dict.fromkeys(rung for contest in contests for rung in contest.timed))


def untimed(contests: Sequence[Entry]) -> list[Task]:
    """What they are measured against, each once."""
    return list(dict.fromkeys(task for contest in contests for task in contest.untimed))


def judged(contests: Sequence[Entry], outcomes: Mapping[Task, Outcome]) -> list[Any]:
    """All of them."""
    return [contest.judged(outcomes) for contest in contests]
