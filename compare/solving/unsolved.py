"""Contacts without an answer: how many, why, and what to do; a contact that is empty has one."""

import re
from collections import Counter
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass

from .continuation import by_contact
from .outcome import Outcome
from .task import SceneTask, Task

DIMENSIONS = {"MDR": "1D", "BEM": "3D"}
MANY = 10  # as few contacts to one without an answer make a command fail
SHOWN = 3  # reasons that are said
NUMBER = re.compile(r"\d[\d.]*(e[+-]?\d+)?")


@dataclass(frozen=True)
class Unsolved:
    """Contacts that ended without an answer.

    failed, contacts : how many of how many, by the name of the solver
    reasons : one of each kind, by how many contacts have one of that kind, the most frequent first
    own : whether the contact of a scene as it stands is among them
    finer : how many contacts a finer grid answered in place of a coarse one
    """

    failed: Mapping[str, int]
    contacts: Mapping[str, int]
    reasons: Mapping[str, int]
    own: bool = False
    finer: int = 0

    @classmethod
    def of(
        cls,
        contacts: Iterable[SceneTask],
        outcomes: Mapping[Task, Outcome],
        own: Collection[SceneTask] = (),
    ):
        """Count over contacts, each once; one that is not among the outcomes, as its task broke, is no failure."""
        found = by_contact(outcomes)
        rows = [(each.solver.name, row) for each in contacts if each in found for row in found[each].rows]
        failed = [(name, row.reason) for name, row in rows if row.reason is not None]
        kinds = Counter(NUMBER.sub("#", reason) for _, reason in failed)
        first = {NUMBER.sub("#", reason): reason for _, reason in reversed(failed)}
        return cls(
            Counter(name for name, _ in failed),
            Counter(name for name, _ in rows),
            {first[kind]: count for kind, count in kinds.most_common()},
            any(each in found and found[each].rows[0].reason is not None for each in own),
            sum(row.finer > 0 for _, row in rows),
        )

    @property
    def serious(self) -> bool:
        """Whether so many failed, or the scene's own contact, that the command fails."""
        return self.own or 0 < sum(self.contacts.values()) <= MANY * sum(self.failed.values())

    @property
    def sentences(self) -> tuple[str, ...]:
        """Sentences that say how many contacts have no answer, why, and what to do; none where all have one."""
        if not self.failed:
            return ()
        by_solver = ", ".join(
            f"{count} of {self.contacts[name]} in {DIMENSIONS.get(name, name)}"
            for name, count in self.failed.items()
        )
        own = ", the scene's own among them" if self.own else ""
        whole = f"{sum(self.failed.values())} of {sum(self.contacts.values())}"
        told = [f"{count} of them: {reason}" for reason, count in [*self.reasons.items()][:SHOWN]]
        return (f"{whole} contacts have no answer{own}: {by_solver}; they are left out.", *told)

    @property
    def notes(self) -> tuple[str, ...]:
        """A sentence on contacts that a finer grid answers; none without any."""
        if not self.finer:
            return ()
        many = f"{self.finer} contacts are" if self.finer > 1 else "1 contact is"
        return (f"{many} too much for a coarse grid, and the next finer one answers in its place.",)


NONE_UNSOLVED = Unsolved({}, {}, {})
