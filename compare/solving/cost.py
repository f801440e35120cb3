"""Cost of a study in contacts, time and bytes, by counting: known before a task of it is built."""

from collections.abc import Iterable
from dataclasses import dataclass, fields

from scene import Refused
from scene.plan import size

from .task import Task
from .words import HOUR, duration

SECONDS = 6e-8  # of processor a unit of work takes, within a factor of two
STORED = 1000.0  # bytes a contact takes on disk, its place in the file of results included
DAY = 24 * HOUR
MOST_DRAWS = 10_000  # rough surfaces or profiles that are averaged
MOST_VALUES = 1000  # speeds, loads or depths in a curve
MANY_CONTACTS = 300_000  # from which to build the tasks takes longer than a person waits
MOST_CONTACTS = 2_000_000  # of a study: more are too many to be held in memory


@dataclass(frozen=True)
class Cost:
    """Upper bound of what a study takes.

    contacts : number of scenes that are solved
    work : of all of them, in units of `Task.work`
    kept : bytes of the fields that are kept for pictures
    """

    contacts: int = 0
    work: float = 0.0
    kept: int = 0

    @classmethod
    def of(cls, tasks: Iterable[Task]) -> "Cost":
        """Cost of tasks that are built."""
        every = list(tasks)
        return cls(sum(task.count for task in every), sum(task.work for task in every))

    def __add__(self, other: "Cost") -> "Cost":
        return Cost(*(getattr(self, each.name) + getattr(other, each.name) for each in fields(self)))

    @property
    def seconds(self) -> float:
        """Processor time [s]."""
        return SECONDS * self.work

    @property
    def disk(self) -> float:
        """Bytes on disk."""
        return STORED * self.contacts + self.kept

    def __str__(self) -> str:
        contacts = f"{self.contacts:,} contact{'' if self.contacts == 1 else 's'}"
        return f"{contacts} at most, about {duration(self.seconds)} of processor time, {size(self.disk)} on disk"

    def refuse(self, workers: int, yes: bool) -> None:
        """Raise Refused for what no memory holds, and without a yes for more than a day or for many contacts."""
        if self.contacts > MOST_CONTACTS:
            raise Refused(f"{self}: at most {MOST_CONTACTS:,} contacts are solved in one study")
        if (self.seconds > DAY * workers or self.contacts > MANY_CONTACTS) and not yes:
            why = "more than a day" if self.seconds > DAY * workers else f"more than {MANY_CONTACTS:,} contacts"
            on = f"{workers} processor{'' if workers == 1 else 's'}"
            raise Refused(f"{self}: {why} on {on}. Ask for less, or agree to it: --yes, from Python yes=True")
