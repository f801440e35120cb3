"""Contacts without an answer: how many, why, and what to do; a contact that is empty has one."""

import re
from collections import Counter
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass

from .continuation import by_contact
from .task import Outcome, Row, SceneTask, Task

DIMENSIONS = {"MDR": "1D", "BEM": "3D"}
MANY = 10  # as few contacts to one without an answer make a command fail
SHOWN = 3  # reasons that are listed
NUMBER = re.compile(r"\d[\d.]*(e[+-]?\d+)?")


@dataclass(frozen=True)
class Unsolved:
    """Contacts that ended without an answer, and others.

    contacts : of each the name of its solver, and its row
    own : whether the contact of a scene as it stands has no answer
    """

    contacts: Sequence[tuple[str, Row]] = ()
    own: bool = False

    @classmethod
    def of(
        cls,
        contacts: Iterable[SceneTask],
        outcomes: Mapping[Task, Outcome],
        own: Collection[SceneTask] = (),
    ):
        """Count contacts, each once; one that is not among the outcomes, as its task broke, is no failure."""
        found = by_contact(outcomes)
        rows = [(each.solver.name, row) for each in contacts if each in found for row in found[each].rows]
        return cls(rows, any(found[each].rows[0].reason is not None for each in own if each in found))

    @property
    def failed(self) -> list[tuple[str, str]]:
        """Name of the solver and reason of each contact without an answer."""
        return [(name, row.reason) for name, row in self.contacts if row.reason is not None]

    @property
    def serious(self) -> bool:
        """Whether the command fails: the scene's own contact failed, or at least one contact in MANY."""
        return self.own or 0 < len(self.contacts) <= MANY * len(self.failed)

    @property
    def sentences(self) -> tuple[str, ...]:
        """A line that says how many contacts have no answer, why, and what to do; none where all have one.

        Reasons that differ by their numbers alone count as one, and the first of them is given.
        """
        failed, kinds = self.failed, dict[str, list[str]]()
        if not failed:
            return ()
        for _, reason in failed:
            kinds.setdefault(NUMBER.sub("#", reason), []).append(reason)
        most = sorted(kinds.values(), key=len, reverse=True)[:SHOWN]
        few, every = (Counter(name for name, _ in each) for each in (failed, self.contacts))
        by_solver = ", ".join(f"{few[name]} of {every[name]} in {DIMENSIONS.get(name, name)}" for name in few)
        own = ", the scene's own among them" if self.own else ""
        whole = f"{len(failed)} of {len(self.contacts)} contacts have no answer{own}"
        why = "; ".join(f"{len(each)} of them: {each[0]}" for each in most)
        return (f"{whole}: {by_solver}; they are left out. {why}",)

    @property
    def notes(self) -> tuple[str, ...]:
        """A sentence on contacts that a finer grid answers; none without any."""
        finer = sum(row.finer > 0 for _, row in self.contacts)
        many = f"{finer} contacts are" if finer > 1 else "1 contact is"
        why = f"{many} too much for a coarse grid, and the next finer one answers in its place."
        return (why,) if finer else ()


NONE_UNSOLVED = Unsolved()
