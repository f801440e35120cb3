"""Continuation: neighbouring contacts of a body and surface in three dimensions, each solved from the last."""

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, replace
from math import inf

from bem3d import BEM, WarmStart
from scene import Indent, Program

from .task import Outcome, SceneTask, Task

# Work of a path: about a minute, so that a kill costs no more.
LONGEST = 1e9


@dataclass(frozen=True)
class Continuation(Task):
    """Contacts of the same body and surface, each started from those before it; equal if the contacts are.

    contacts : tasks with a single scene each, in the order in which they are solved
    """

    contacts: tuple[SceneTask, ...]

    @property
    def count(self) -> int:
        """A row for each contact."""
        return len(self.contacts)

    @property
    def label(self) -> str:
        """First contact, and how many follow."""
        return f"{self.contacts[0].label}, and {len(self.contacts) - 1} more"

    @property
    def work(self) -> float:
        """Rough cost of all contacts."""
        return sum(each.work for each in self.contacts)

    @property
    def question(self) -> dict:
        """Questions of the contacts in their order."""
        return {"path": [each.question for each in self.contacts]}

    @property
    def packages(self) -> tuple[str, ...]:
        """Packages of the contacts."""
        return self.contacts[0].packages

    def solve(self) -> Outcome:
        """Solve the contacts in their order, also behind one that fails."""
        warm_start = WarmStart()
        return Outcome(tuple(row for each in self.contacts for row in each.solve(warm_start).rows))


def joined(contacts: Iterable[SceneTask], first: Collection[SceneTask] = ()) -> list[SceneTask | Continuation]:
    """Contacts as tasks: what differs in speed and grid alone as one path, from rest on, from coarse to fine.

    Contacts of other solvers, in time, and those that keep fields stay alone.

    first : contacts that are on no path with others
    """
    paths: dict[object, list[SceneTask]] = {}
    for each in contacts:
        paths.setdefault((each in first, _shared(each)), []).append(each)
    cut = [path for found in paths.values() for path in _cut(sorted(found, key=_place))]
    return [Continuation(tuple(path)) if len(path) > 1 else path[0] for path in cut]


def by_contact(outcomes: Mapping[Task, Outcome]) -> Mapping[Task, Outcome]:
    """Outcomes by contact, also of those that were solved on a path."""
    if not any(isinstance(task, Continuation) for task in outcomes):
        return outcomes
    found: dict[Task, Outcome] = {}
    for task, outcome in outcomes.items():
        if isinstance(task, Continuation):
            found |= {each: Outcome((row,)) for each, row in zip(task.contacts, outcome.rows, strict=True)}
        else:
            found[task] = outcome
    return found


def _shared(contact):
    """Key that all contacts of a path share: all but the speed, and the grid except its kind."""
    (scene, *others), solver = contact.scenes, contact.solver
    motion = scene.motion
    alone = others or contact.keeps_fields
    if alone or not isinstance(solver, BEM) or isinstance(motion, Program):
        return contact
    rest = Indent(**{motion.pressed_by: motion.greatest})
    return replace(scene, motion=rest), replace(solver, points=16, steps=1)


def _place(contact):
    return getattr(contact.scenes[0].motion, "speed", 0.0), getattr(contact.solver, "points", 0)


def _cut(contacts: list[SceneTask]) -> list[list[SceneTask]]:
    """Paths of LONGEST at most."""
    paths, work = list[list[SceneTask]](), inf
    for each in contacts:
        if work + each.work > LONGEST:
            paths, work = [*paths, []], 0.0
        paths[-1].append(each)
        work += each.work
    return paths
