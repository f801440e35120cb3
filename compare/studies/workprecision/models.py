"""Both models against the true answer of three dimensions: which model, which settings, how long."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from math import inf, isfinite, nan
from typing import Any, Protocol

import numpy as np
import xarray
from pandas import DataFrame

from ...amounts import seconds, share
from ...finding import HALVED, UNKNOWN, Claim, Finding
from ...page import Block, Plot, Table
from ...plots import workprecision_models, workprecision_surfaces
from ...statistics.sampling import Bias, Effort, cheapest
from ...task import Task
from . import regimes
from .convergence import DIMENSIONS, Convergence, MeasuredLadder, ladders, steps_table
from .diagram import reported
from .ensemble import Ensemble, Mean, means, plans_table
from .reference import Outcomes

# Wanted errors of which tables say what they take, and those of which findings do.
LEVELS, WANTED = (0.1, 0.03, 0.01, 0.003), (0.1, 0.01)
# What is asked for, each with a figure and a table of its own, and the quantities that answer it.
ASKED = {"friction": ("friction",), "depth or force": ("depth", "force")}
# Order in the points from which on an error falls.
FALLS = 0.3


@dataclass(frozen=True)
class Answer:
    """The shortest way to a wanted error.

    solver : by name; settings : in words; seconds : of processor time
    """

    solver: str
    settings: str
    seconds: float

    @property
    def text(self) -> str:
        """Model, settings and time in words."""
        return f"{DIMENSIONS[self.solver]}, {self.settings}: {seconds(self.seconds)}"


class Regime(Protocol):
    """One quantity of one contact, as both models know it.

    title : of the contact; quantity, label : see Quantity; rough : whether its answer is a mean over surfaces
    """

    title: str
    quantity: str
    label: str
    rough: bool

    def answer(self, level: float, solver: str | None = None) -> Answer | None:
        """The shortest way of one solver, or of both, whose error and that of the truth keep a level together."""

    def best(self, solver: str | None = None) -> float:
        """Least error that one solver, or either, is known to reach with any of its settings; NaN if not known."""

    def floor(self) -> Bias:
        """Error of the 1D model on its finest grid: no setting passes it, unless it converges; NaN if not solved."""

    def converges(self) -> bool:
        """Whether the error of the 1D model still falls from its last grid but one to its finest."""

    def error_1d(self, claim: Claim) -> Finding:
        """Finding of the error that the 1D model keeps."""

    def failures(self) -> list[str]:
        """Solves that failed, and why."""


@dataclass(frozen=True)
class SmoothRegime:
    """A regime of a smooth body: ladders of both solvers by one quantity."""

    ladders: tuple[MeasuredLadder, ...]
    rough = False

    @property
    def title(self) -> str:
        """Contact for people."""
        return self.ladders[0].title

    @property
    def quantity(self) -> str:
        """Name of the quantity."""
        return self.ladders[0].quantity

    @property
    def label(self) -> str:
        """Quantity for people."""
        return self.ladders[0].label

    def answer(self, level: float, solver: str | None = None) -> Answer | None:
        """The shortest way to a level; None where there is none."""
        room, found = level - self._own, []
        for each in self._of(solver):
            k = each.reaching(room)
            if k is not None:
                settings = f"{each.values[k]:g} {each.setting}"
                found.append(Answer(each.solver, settings, float(each.processor[k])))
        return min(found, key=lambda option: option.seconds, default=None)

    def best(self, solver: str | None = None) -> float:
        """Least error that is known to be reached."""
        return _least([each.errors[-1] + self._own for each in self._of(solver)])

    def floor(self) -> Bias:
        """Error of the 1D model on its finest grid."""
        errors = [each.errors[-1] for each in self._of("MDR")]
        return Bias(float(errors[-1]), self._own) if errors else Bias(nan, nan)

    def converges(self) -> bool:
        """Whether the order between the last two steps in 1D is more than FALLS; one alone cannot tell."""
        own = self._of("MDR")
        if not own or len(own[-1].values) < 2:
            return False
        (coarse, fine), (before, last) = own[-1].values[-2:], own[-1].errors[-2:]
        return bool(before > last * (fine / coarse) ** FALLS)

    def error_1d(self, claim: Claim) -> Finding:
        """Error of the 1D model, uncertain by that of the reference."""
        floor = self.floor()
        method = self.ladders[0].dataset.attrs["reference_method"] if isfinite(self._own) else UNKNOWN
        ends = (floor.value, floor.value)
        why = "" if isfinite(floor.value) else "not solved"
        return Finding(claim, floor.value, ends, self._own, method, f"{self.title}: {self.label}", reason=why)

    def failures(self) -> list[str]:
        """Solves that failed, and why."""
        return [
            f"{each.ladder} with {value:g} {each.setting}: {reason}"
            for each in self.ladders
            for value, reason in each.failures
        ]

    @property
    def _own(self):
        return self.ladders[0].reference_error

    def _of(self, solver):
        return [each for each in self.ladders if solver in (None, each.solver)]


@dataclass(frozen=True)
class RoughRegime:
    """A regime of a rough body, of which the answer is the mean over surfaces.

    The time of a mean grows with the number of surfaces, however large.
    """

    mean: Mean
    rough = True

    @property
    def title(self) -> str:
        """Contact for people."""
        return self.mean.title

    @property
    def quantity(self) -> str:
        """Name of the quantity."""
        return self.mean.quantity

    @property
    def label(self) -> str:
        """Quantity for people."""
        return self.mean.label

    def effort(self, level: float, solver: str | None = None) -> Effort | None:
        """Plan and numbers of surfaces for a level."""
        return cheapest([plan for plan in self.mean.plans if solver in (None, plan.solver)], level)

    def answer(self, level: float, solver: str | None = None) -> Answer | None:
        """The shortest way to a level; None where there is none."""
        effort = self.effort(level, solver)
        return None if effort is None else Answer(effort.plan.solver, effort.settings, effort.seconds)

    def best(self, solver: str | None = None) -> float:
        """Least error that is known to be reached."""
        return _least([plan.bias.most for plan in self.mean.plans if solver in (None, plan.solver)])

    def floor(self) -> Bias:
        """Error of the mean of the 1D model on its finest grid."""
        return self.mean.floor

    def converges(self) -> bool:
        """Never: the scatter of profiles would hide it."""
        return False

    def error_1d(self, claim: Claim) -> Finding:
        """Error of the mean of the 1D model, with scatter and grid apart."""
        floor, grid = self.mean.floor, self.mean.discretisation
        half = floor.reach - grid
        ends = (floor.value - half, floor.value + half)
        known = all(map(isfinite, (floor.value, half, grid)))
        draws = min(sample.count for sample in self.mean.samples)
        method, why = (HALVED, "") if known else (UNKNOWN, "too many surfaces have no answer")
        return Finding(claim, floor.value, ends, grid, method, f"{self.title}: {self.label}", draws, reason=why)

    def failures(self) -> list[str]:
        """Solves that failed, and why."""
        return [
            f"{len(sample.reasons)} of {sample.count} in {DIMENSIONS[sample.solver]} with {sample.points} "
            f"points: {sample.reasons[0]}"
            for sample in self.mean.samples
            if sample.reasons
        ]


def regimes_of(node: xarray.DataTree) -> list[Regime]:
    """Every quantity of every contact of a diagram."""
    found: list[Regime] = []
    for child in node.children.values():
        if child.children:
            both = (child[name].to_dataset(inherit=False) for name in ("BEM", "MDR"))
            found += [RoughRegime(mean) for mean in means(*both)]
        else:
            every = list(ladders(child.to_dataset(inherit=False)))
            names = dict.fromkeys(each.quantity for each in every)
            found += [SmoothRegime(tuple(each for each in every if each.quantity == name)) for name in names]
    return found


def answers_table(found: Sequence[Regime], levels: Sequence[float] = LEVELS) -> list[dict[str, Any]]:
    """A row for each regime and wanted error; times in seconds, errors relative."""
    return [_row(each, level) for each in found for level in levels]


def cells(found: Sequence[Regime], levels: Sequence[float] = LEVELS) -> list[dict[str, str]]:
    """Answers in words: regimes as rows, wanted errors as columns.

    Of rough regimes the error is that expected of a mean over surfaces (rms), of smooth ones the error itself.
    """
    return [
        {
            "regime": f"{each.title}{', expected (rms)' if each.rough else ''}",
            "quantity": each.label,
            **{f"within {share(level)}": _cell(each, level) for level in levels},
            "error that 1D keeps": "none (it converges)" if each.converges() else interval(each.floor()),
        }
        for each in found
    ]


def interval(bias: Bias) -> str:
    """A size with the ends of its interval in words."""
    if not isfinite(bias.size):
        return "not known"
    if not isfinite(bias.reach):
        return f"{share(bias.size)}, interval not known"
    if bias.reach < 0.05 * bias.size:
        return share(bias.size)
    least = share(bias.least).removesuffix(" %") if bias.least else "0"
    return f"{share(bias.size)} ({least} to {share(bias.most)})"


def _cell(each, level):
    taken, known = each.answer(level), each.best()
    if taken is not None:
        return taken.text
    return f"not reached; best known {share(known)}" if isfinite(known) else "not known"


def _row(each, level):
    taken, own = each.answer(level), each.floor()
    by_solver = {name: each.answer(level, name) for name in DIMENSIONS}
    return {
        "regime": each.title,
        "quantity": each.label,
        "wanted": level,
        "model": "" if taken is None else DIMENSIONS[taken.solver],
        "settings": "" if taken is None else taken.settings,
        "seconds": nan if taken is None else taken.seconds,
        **{
            f"seconds_{DIMENSIONS[name].lower()}": nan if answer is None else answer.seconds
            for name, answer in by_solver.items()
        },
        "best_known": each.best(),
        "floor_1d": own.size,
        "floor_1d_least": own.least,
        "floor_1d_most": own.most,
        "converges_1d": each.converges(),
    }


def _least(errors):
    return float(np.nanmin([*errors, inf])) if np.isfinite(errors).any() else nan


@dataclass(frozen=True)
class ModelDiagram:
    """Regimes that both models answer.

    contacts : at a size
    of_models : whether models are compared, or numbers of surfaces with points in 3D alone
    """

    name: str
    title: str
    about: str
    contacts: Callable[[str], Sequence[Convergence | Ensemble]]
    of_models: bool = True

    def untimed(self, size: str) -> list[Task]:
        """References, and every surface and profile."""
        return list(dict.fromkeys(task for each in self.contacts(size) for task in each.untimed))

    def timed(self, size: str) -> list[Task]:
        """Solves that are measured alone, each once."""
        return list(dict.fromkeys(task for each in self.contacts(size) for task in each.timed))

    def datasets(self, size: str, outcomes: Outcomes) -> dict[str, xarray.Dataset]:
        """A Dataset a smooth contact, and one for each solver of a rough one."""
        return {name: dataset for each in self.contacts(size) for name, dataset in each.datasets(outcomes).items()}

    def findings(self, node: xarray.DataTree) -> list[Finding]:
        """Errors that 1D keeps and times to wanted errors; of surfaces, what scatters and what a grid leaves."""
        found = regimes_of(node)
        return list(_model_findings(found) if self.of_models else _surface_findings(found))

    def plots(self, node: xarray.DataTree) -> list[Plot]:
        """A figure for each thing asked for; of surfaces, one."""
        found = regimes_of(node)
        if not self.of_models:
            if not found:
                return []
            name = "workprecision-surfaces"
            ways = {name: plans_table([each.mean for each in found]), f"{name}-recipes": list(_recipes(found))}
            return [workprecision_surfaces.plot(name, {key: DataFrame(rows) for key, rows in ways.items()}, LEVELS)]
        return [
            workprecision_models.plot(f"workprecision-models-{what.split()[0]}", tables)
            for what, names in ASKED.items()
            if (tables := self._tables(what.split()[0], [each for each in found if each.quantity in names]))
        ]

    def tables(self, node: xarray.DataTree) -> list[Block]:
        """What wanted errors take, in words."""
        found = regimes_of(node) if self.of_models else []
        return [
            Table(f"workprecision-cells-{what.split()[0]}", DataFrame(rows), f"To know {what}: model, settings, time.")
            for what, names in ASKED.items()
            if (rows := cells([each for each in found if each.quantity in names]))
        ]

    def _tables(self, suffix, found):
        rows = {
            "steps": steps_table([each for regime in found if not regime.rough for each in regime.ladders]),
            "plans": plans_table([regime.mean for regime in found if regime.rough]),
            "answers": answers_table(found),
        }
        return {f"workprecision-models-{name}-{suffix}": DataFrame(each) for name, each in rows.items() if each}


def _model_findings(found: Sequence[Regime]) -> Iterator[Finding]:
    for level in WANTED:
        claim = Claim(
            f"workprecision.models.1d-within-{100 * level:g}-percent",
            f"One dimension keeps within {share(level)} of three, however fine its grid",
            0.0,
            level,
            "Answer of the 1D model on its finest grid less that of three dimensions, relative",
        )
        yield from (each.error_1d(claim) for each in found)
    for level in WANTED:
        id, sentence = f"models.time-{100 * level:g}-percent", f"Processor time to {share(level)} of the true answer"
        for each in found:
            taken, known = each.answer(level), each.best()
            where = f"{each.title}: {each.label}"
            if taken is None:
                why = f"best known {share(known)}" if isfinite(known) else "not solved"
                yield reported(id, sentence, nan, where, "s", "1D/3D", reason=why)
            else:
                yield reported(id, sentence, taken.seconds, where, "s", DIMENSIONS[taken.solver])


def _surface_findings(found: Sequence[RoughRegime]) -> Iterator[Finding]:
    for each in found:
        first, where = each.mean.plain[0], f"{each.title}: {each.label}"
        scatter, bias, grid = first.levels[0].scatter, first.bias, each.mean.discretisation
        why = "" if isfinite(scatter.value) else "too few surfaces were solved"
        yield reported(
            "surfaces.scatter", "Scatter of one surface", scatter.value, where, "%",
            scatter=scatter.interval(), grid=0.0, draws=scatter.freedom + 1, reason=why,
        )  # fmt: skip
        half = bias.reach - grid
        yield reported(
            "surfaces.coarsest-grid", f"Error that the coarsest grid leaves ({first.label} points)", bias.value, where,
            "%", scatter=(bias.value - half, bias.value + half), grid=grid, grid_method=HALVED, reason=why,
        )  # fmt: skip
        worth = (scatter.value / bias.size) ** 2 if bias.size > 0 else nan
        yield reported(
            "surfaces.fewest", "Surfaces from which on more points gain something", float(np.ceil(worth)), where,
            reason=why,
        )  # fmt: skip
        for level in WANTED:
            effort, known = each.effort(level, "BEM"), each.best("BEM")
            missed = f"best known {share(known)}" if isfinite(known) else "not solved"
            id, sentence = f"surfaces.time-{100 * level:g}-percent", f"Processor time to {share(level)} in 3D"
            value = nan if effort is None else effort.seconds
            yield reported(id, sentence, value, where, "s", reason="" if effort else missed)


def _recipes(found: Sequence[RoughRegime]) -> Iterator[dict[str, Any]]:
    """A row for each wanted error and plan: surfaces of each level, and the time."""
    for each in found:
        for level in LEVELS:
            best = each.effort(level, "BEM")
            for plan in each.mean.of("BEM"):
                effort = plan.reaching(level)
                yield {
                    "contact": each.mean.contact,
                    "quantity": each.quantity,
                    "wanted": level,
                    "plan": plan.label,
                    "first_surfaces": nan if effort is None else effort.counts[0],
                    "surfaces": "" if effort is None else " + ".join(str(count) for count in effort.counts),
                    "seconds": nan if effort is None else effort.seconds,
                    "cheapest": best is not None and best.plan is plan,
                    "grid_error": plan.bias.size,
                    "scatter": plan.levels[0].scatter.value,
                }


MODELS = ModelDiagram(
    "models",
    "Which model for which error",
    "Both models against the true answer of three dimensions: one is fast and keeps the error of the model, "
    "the other is slow and converges. Smooth bodies have one answer; that of rough ones is the mean over "
    "surfaces, so that the scatter between surfaces counts beside the grid.",
    lambda size: [*regimes.smooth(size), *regimes.rough(size)],
)
SURFACES = ModelDiagram(
    "surfaces",
    "How many surfaces, on how many points",
    "A rough contact has the mean over surfaces as its answer. The error of a mean is what the grid leaves, "
    "however many surfaces are solved, and what their scatter leaves, however fine the grid.",
    lambda size: [each for each in regimes.rough(size) if each.name.endswith(("rest", "middle"))],
    of_models=False,
)
