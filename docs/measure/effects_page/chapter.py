"""What a study of an effect asks, and what its page says."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Protocol

from matplotlib.figure import Figure

from compare.solving.outcome import Outcome
from compare.solving.task import Task

Rows = Sequence[Mapping[str, object]]


@dataclass(frozen=True)
class Chapter:
    """A chapter of the page on effects.

    text : Markdown, every number in it computed from the answers
    tables : heading -> rows, in the page
    figures : name -> figure, and data : the same name -> the numbers that are drawn, as rows of a CSV
    """

    text: str
    tables: Mapping[str, Rows] = field(default_factory=dict)
    figures: Mapping[str, Figure] = field(default_factory=dict)
    data: Mapping[str, Rows] = field(default_factory=dict)


class Study(Protocol):
    """A module of this package."""

    @property
    def NAME(self) -> str:
        """Short name, of files."""

    @property
    def TITLE(self) -> str:
        """Heading of the chapter."""

    def tasks(self) -> Sequence[Task]:
        """Everything that is solved, through the sweep and the store."""

    def chapter(self, outcomes: Mapping[Task, Outcome]) -> Chapter:
        """What came out."""
