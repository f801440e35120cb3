"""What every effect costs on top of a plain contact: each solve measured alone, in both dimensionalities.

These tasks want a process each and a quiet machine, as all that is timed: see
`compare.studies.workprecision.timed_solve`.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import isfinite, nan

from bem3d import BEM
from compare.solving.outcome import Outcome, Row
from compare.solving.task import Task
from compare.studies.workprecision.timed_solve import TimedSolve
from mdr1d import MDR
from scene.costs import COSTS, two_digits

from .asked import Effect, effects
from .chapter import Chapter, Rows

NAME, DATA = "costs", "effect-costs"
SOLVERS: Mapping[str, BEM | MDR] = {"3D": BEM(points=256, steps=40), "1D": MDR(points=5000, steps=40)}
# Relative: less than this is within what repeated measurements differ by.
NOTHING = 0.1
# Parts that a plan counts by itself.
COUNTED = {"3D": (), "1D": ("Program",)}


@dataclass(frozen=True)
class Cost:
    """What one effect took of one solver.

    row : NaN with a reason where it was not solved; `refused` where it was not tried
    over : the row of what it comes on top of, its own of a plain contact
    """

    effect: Effect
    row: Row
    over: Row

    @property
    def seconds(self) -> float:
        """Processor time [s]."""
        return self.row.measures.get("processor", nan)

    @property
    def times(self) -> float:
        """Seconds over those without the effect."""
        return self.seconds / self.over.measures.get("processor", nan)

    @property
    def multiples(self) -> dict[str, float]:
        """By the names of `scene.costs.COSTS`: over those without the effect; of a program, a step of it."""
        steps = self.row.measures.get("time_steps", 1.0)
        applications = self.row.operator_applications / self.over.operator_applications
        return dict(zip(COSTS, (applications / steps, self.times / steps), strict=True))


def tasks() -> list[TimedSolve]:
    """One a solver and effect that it does not refuse."""
    return [
        TimedSolve(solver, (effect.scene,), work=_work(solver, effect))
        for solver in SOLVERS.values()
        for effect in effects()
        if not solver.refusals(effect.scene)
    ]


def costs(outcomes: Mapping[Task, Outcome]) -> dict[str, list[Cost]]:
    """Costs of all effects, by the keys of SOLVERS."""
    return {name: _of(solver, outcomes) for name, solver in SOLVERS.items()}


def tables(found: Mapping[str, Sequence[Cost]]) -> dict[str, Rows]:
    """What plans multiply costs with, by the keys of SOLVERS: a line for each part that was measured."""
    return {
        name: [
            {"part": part} | {cost: float(f"{value:.3g}") for cost, value in each.multiples.items()}
            for each in billed
            for part in each.effect.parts
            if isfinite(each.times) and part not in COUNTED[name]
        ]
        for name, billed in found.items()
    }


def chapter(outcomes: Mapping[Task, Outcome]) -> Chapter:
    """What the measurements come to, as numbers."""
    return Chapter(
        data={DATA: [_sheet(name, each) for name, billed in costs(outcomes).items() for each in billed]}
    )


def said(found: Mapping[str, Sequence[Cost]]) -> str:
    """Which effects are free, and which is the dearest."""
    return " ".join(_said(name, billed) for name, billed in found.items())


def _of(solver, outcomes):
    rows = {}
    for effect in effects():
        outcome = outcomes.get(TimedSolve(solver, (effect.scene,), work=_work(solver, effect)))
        rows[effect.title] = outcome.rows[0] if outcome else Row(reason=effect.verdict(solver))
    return [Cost(each, rows[each.title], rows[each.over or each.title]) for each in effects()]


def _work(solver, effect):
    steps = 20.0 * solver.steps if effect.scene.motion.type == "program" else 300.0
    return steps * (solver.points if solver.name == "MDR" else solver.points**2)


def _said(name, billed):
    added = [each for each in billed if each.effect.over and isfinite(each.times)]
    if not added:
        return f"In {name} nothing was solved."
    free = [each.effect.title for each in added if each.times <= 1 + NOTHING]
    dear = max(added, key=lambda each: each.times)
    most = f"{100 * NOTHING:.0f} %"
    cheap = f"{_listed(free)} cost no more than {most}" if free else f"all cost more than {most}"
    return f"In {name} {cheap}; {dear.effect.title} costs most, {two_digits(dear.times)} times as much."


def _listed(names):
    return " and ".join(filter(None, [", ".join(names[:-1]), names[-1]]))


def _sheet(name, cost):
    row = cost.row
    return {
        "dimension": name,
        "effect": cost.effect.title,
        "over": cost.effect.over or "",
        "seconds": cost.seconds,
        "times": cost.times,
        "wall": row.measures.get("wall", nan),
        "memory": row.measures.get("memory", nan),
        "repeats": row.measures.get("repeats", nan),
        "operator_applications": row.operator_applications,
        "time_steps": row.measures.get("time_steps", nan),
        "reason": row.reason or "",
    }
