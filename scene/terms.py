"""Tables of terms: what a solver has for each part that a scene may be made of.

A table maps the types of parts to terms. A solver looks up the parts that a scene has, and no others: what is
absent is not even asked about. A type stands for its subclasses, as far as they have no line of their own.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from .plan import Plan
from .result import Result
from .scene import Scene, described

Solve = Callable[[Scene], Result]


@dataclass(frozen=True)
class Term:
    """Treatment of a part of a scene by a solver; most parts need no more than this base class.

    field : of the scene, in which the part stands
    """

    field: str
    part: Any

    def refusals(self, scene: Scene) -> list[str]:
        """Reasons why the part cannot be solved in this scene, one sentence each; empty when it can."""
        return []

    def around(self, solve: Solve) -> Solve:
        """A solve that asks another one, of the scene as changed by the part."""
        return solve

    @property
    def says(self) -> str:
        """Simulation of the part in a line for people."""
        return described(self.part)

    def planned(self, plan: Plan, scene: Scene) -> Plan:
        """A plan with what the part builds besides; most parts build nothing of their own."""
        return plan


@dataclass(frozen=True)
class Unsupported(Term):
    """A part for which the solver has nothing; `why`, and what can be done."""

    why: str

    def refusals(self, scene: Scene) -> list[str]:
        return [f"{self.field} = {type(self.part).__name__}: {self.why}"]


Table = Mapping[type, Callable[[str, Any], Term]]


def unsupported(why: str) -> Callable[[str, Any], Unsupported]:
    """A line for what a solver has not."""
    return lambda field, part: Unsupported(field, part, why)


UNKNOWN = unsupported("this solver has no term for it; leave it out, or take a solver that has one")


def terms_of(table: Table, scene: Scene) -> list[Any]:
    """The terms of the parts that are present, in the order of the scene's fields."""
    return [_line(table, type(part))(field, part) for field, part in scene.parts.items()]


def refused_parts(table: Table, scene: Scene) -> list[str]:
    """Reasons why parts of a scene cannot be solved, one sentence each."""
    return [reason for term in terms_of(table, scene) for reason in term.refusals(scene)]


def _line(table, kind):
    return next((table[each] for each in kind.__mro__ if each in table), UNKNOWN)


def wrap_solve(solve: Solve, terms: list[Term]) -> Solve:
    """Wrap a solve in the terms, the first term innermost."""
    for term in terms:
        solve = term.around(solve)
    return solve
