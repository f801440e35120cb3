"""Plan of a scene: what both solvers would simulate, what that costs, and what the 1D answer would be worth."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from math import isinf
from textwrap import fill
from typing import cast

from bem3d import BEM
from mdr1d import MDR
from scene import Refused, Scene, SolveError, notes
from scene.plan import Plan, size, two_digits
from scene.protocol import foresee, numeric_guard

from ..library.case import Case, NotCompared, doubted
from ..library.lookup import SceneLike, case_of
from ..models.table import KNOWN
from ..solving.cost import Cost
from ..solving.words import duration, pascals, seconds, share
from ..trustmap.verdict import Advice, trust
from .comparison.around import FINER, Around

WIDTH = 100
WHOLE = {"break_long_words": False, "break_on_hyphens": False}
INDENT = 11  # of the lines, after their names


class Plans(dict[str, Plan | str | Advice]):
    """Plans by the names of the solvers, or why there is none; by "trust", what cheap answers are worth.

    Printed, seven lines.

    scene : the scene that is planned
    cost : what all contacts of `crosscheck run` take; the reason where it solves none
    refused : whether that refuses the numbers of a scene of a kind that it compares
    doubts : about the scene, and notes on what was read for it, as sentences
    interval : of the case, which takes more surfaces than those of a first look; None if it has none
    """

    def __init__(
        self,
        plans: Mapping[str, Plan | str | Advice],
        scene: Scene,
        cost: Cost | str,
        refused: bool = False,
        doubts: Sequence[str] = (),
        interval: float | None = None,
    ) -> None:
        super().__init__(plans)
        self.interval = interval
        self.scene, self.cost, self.refused, self.doubts = scene, cost, refused, tuple(doubts)

    @property
    def feasible(self) -> bool:
        """Whether a model would solve it, and `crosscheck run` would not refuse it for its numbers."""
        return bool(self._plans or isinstance(self.cost, Cost)) and not self.refused

    @property
    def details(self) -> str:
        """Every kernel and grid, and what 1D is worth: what `crosscheck plan -v` prints."""
        return "\n\n".join([_lines(self._summary()), *map(str, self.values())])

    def __str__(self) -> str:
        return _lines(self._summary())

    __repr__ = __str__

    @property
    def _plans(self) -> dict[str, Plan]:
        return {name: each for name, each in self.items() if isinstance(each, Plan)}

    def _summary(self) -> Iterator[tuple[str, str]]:
        """Names and texts of doubts and notes, of the seven lines, then the reasons against the scene."""
        yield from (("doubtful", each) for each in self.doubts)
        yield from (("note", each) for each in notes(self.scene))
        if plans := self._plans:
            contacts, time = "1, from Python: crosscheck run does not compare this scene, see below", ""
            if self.refused:
                contacts = "none by crosscheck run, which refuses this scene"
            elif isinstance(self.cost, Cost):
                contacts = f"at most {self.cost.contacts:,}, solved by crosscheck run"
                if self.interval is not None:
                    contacts += f", and as many more as intervals of {share(self.interval)} take (run --interval)"
                time = f"about {duration(self.cost.seconds)} on one processor; "
            yield "contacts", contacts
            yield "time", f"{time}this contact {self._by_dimension(_seconds)}"
            yield "memory", f"{self._by_dimension(lambda plan: size(plan.memory))}, at most, in each process"
            yield "simulated", ", ".join(type(part).__name__ for part in self.scene.parts.values())
            left = dict.fromkeys(name for plan in plans.values() for name in plan.left_out)
            yield "left out", ", ".join(left) or "nothing"
        elif isinstance(self.cost, Cost):
            yield (
                "contacts",
                f"at most {self.cost.contacts:,}, solved by crosscheck run with {' and '.join(FINER)}",
            )
            yield "time", f"about {duration(self.cost.seconds)} on one processor"
        if choice := cast(Advice, self["trust"]).choice:
            yield "advice", choice
        yield "modulus", _stiffness(self.scene)
        # What refuses all contacts refuses this one too, with values that work for all of them.
        refusal = self.cost if isinstance(self.cost, str) else ""
        reasons = {name: each for name, each in self.items() if isinstance(each, str)}
        for name, each in reasons.items():
            if not (self.refused and f"{name} cannot solve" in refusal):
                yield "refused", each
        if refusal and (self.refused or not reasons):
            yield "refused" if self.refused else "alone", refusal

    def _by_dimension(self, text: Callable[[Plan], str]) -> str:
        return ", ".join(f"{text(plan)} in {KNOWN[name][0]}" for name, plan in self._plans.items())


def _stiffness(scene):
    """Shear and Young's modulus of the solid at rest and at the instant, in words."""
    try:
        with numeric_guard():
            rest, instant = scene.solid.static_modulus, scene.solid.glassy_modulus
    except SolveError as error:
        return f"not known: {error}"
    stiffer = 2 * (1 + scene.solid.poisson_ratio)
    at_rest = f"shear G = {pascals(rest)}, Young's E = {pascals(stiffer * rest)} at rest"
    if isinf(instant):
        return f"{at_rest}; infinite at the instant (a dashpot)"
    if instant == rest:
        return f"{at_rest} and at the instant"
    return f"{at_rest}; {pascals(instant)}, {pascals(stiffer * instant)} at the instant"


def plans(asked: SceneLike) -> Plans:
    """The plans of a case, of a scene alone, of a file or of a ready scene, whether or not both can solve it.

    Raises InvalidInput.
    """
    case = case_of(asked)
    made: dict[str, Plan | str | Advice] = {
        solver.name: planned(solver, case.scene) for solver in (case.mdr, case.bem)
    }
    cost, refused, doubts = _cost(case)
    made["trust"] = trust(case.scene)
    return Plans(made, case.scene, cost, refused, doubts, case.interval)


def planned(solver: MDR | BEM, scene: Scene) -> Plan | str:
    """The plan of a solver, or its reasons against the scene."""
    try:
        foresee(solver, scene)
        return solver.plan(scene)
    except Refused as reasons:
        return str(reasons)
    except SolveError as reason:
        return f"{solver.name} would not get through this scene: {reason}"


def _cost(case: Case) -> tuple[Cost | str, bool, tuple[str, ...]]:
    """Cost of all contacts that `crosscheck run` solves, or why it solves none and whether that is a refusal.

    Also the doubts about them.
    """
    try:
        asked = Around("scene", case)
        return sum((each.cost for each in asked.curves.values()), Cost()), False, tuple(asked.doubts)
    except NotCompared as reason:
        return str(reason), False, doubted(case)
    except Refused as reason:
        return str(reason), True, doubted(case)


def _seconds(plan: Plan) -> str:
    expected = plan.seconds.value
    return "an unknown time" if expected is None else seconds(float(two_digits(expected)))


def _lines(summary):
    return "\n".join(
        fill(f"{name:<{INDENT}s}{text}", WIDTH, subsequent_indent=INDENT * " ", **WHOLE) for name, text in summary
    )
