"""The shortest way to a wanted error of the true answer of three dimensions, in either model."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf, isfinite, nan
from typing import Any, ClassVar, TypeAlias

import numpy as np
import xarray

from ...amounts import seconds, share
from ...finding import HALVED, UNKNOWN, Claim, Finding
from ...statistics.convergence import MeasuredLadder, ladders
from ...statistics.sampling import Bias, Effort, cheapest
from .convergence import DIMENSIONS, steps_table
from .ensemble import MeasuredMean, means

# Wanted errors of which tables say what they take.
LEVELS = (0.1, 0.03, 0.01, 0.003)
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


@dataclass(frozen=True)
class OneQuantity:
    """One quantity of one contact. title : of the contact; quantity, label : name, for people"""

    title: str
    quantity: str
    label: str

    @property
    def where(self) -> str:
        """Contact and quantity in words."""
        return f"{self.title}: {self.label}"


@dataclass(frozen=True)
class SmoothRegime(OneQuantity):
    """A regime of a smooth body: ladders of both solvers by one quantity.

    method : how the error of the reference is known
    """

    ladders: tuple[MeasuredLadder, ...]
    method: str

    def answer(self, level: float, solver: str | None = None) -> Answer | None:
        """The shortest way to a level with the error of the reference; None where there is none."""
        found = []
        for each in self._of(solver):
            k = each.reaching(level - self._own)
            if k is not None:
                settings = f"{each.values[k]:g} {each.setting}"
                found.append(Answer(each.solver, settings, float(each.processor[k])))
        return min(found, key=lambda option: option.seconds, default=None)

    def best(self, solver: str | None = None) -> float:
        """Least error that is known to be reached."""
        return _least([each.errors[-1] + self._own for each in self._of(solver)])

    @property
    def floor(self) -> Bias:
        """Error of the 1D model on its finest grid."""
        errors = [each.errors[-1] for each in self._of("MDR")]
        return Bias(float(errors[-1]), self._own) if errors else Bias(nan, nan)

    @property
    def converges(self) -> bool:
        """Whether the order between the last two steps in 1D is more than FALLS; one alone cannot tell."""
        own = self._of("MDR")
        if not own or len(own[-1].values) < 2:
            return False
        (coarse, fine), (before, last) = own[-1].values[-2:], own[-1].errors[-2:]
        return bool(before > last * (fine / coarse) ** FALLS)

    def error_1d(self, claim: Claim) -> Finding:
        """Error of the 1D model, uncertain by that of the reference."""
        value, method = self.floor.value, self.method if isfinite(self._own) else UNKNOWN
        why = "" if isfinite(value) else "not solved"
        return Finding(claim, value, (value, value), self._own, method, self.where, reason=why)

    @property
    def _own(self):
        return self.ladders[0].reference_error

    def _of(self, solver):
        return [each for each in self.ladders if solver in (None, each.solver)]


@dataclass(frozen=True)
class RoughRegime(OneQuantity):
    """A regime of a rough body, of which the answer is the mean over surfaces.

    The time of a mean grows with the number of surfaces, however large. The scatter of profiles would hide whether
    the 1D model comes ever closer with its points.
    """

    mean: MeasuredMean
    converges: ClassVar[bool] = False

    def effort(self, level: float, solver: str | None = None) -> Effort | None:
        """Plan and numbers of surfaces for a level."""
        return cheapest(self._of(solver), level)

    def answer(self, level: float, solver: str | None = None) -> Answer | None:
        """The shortest way to a level; None where there is none."""
        effort = self.effort(level, solver)
        return None if effort is None else Answer(effort.plan.solver, effort.settings, effort.seconds)

    def best(self, solver: str | None = None) -> float:
        """Least error that is known to be reached."""
        return _least([plan.bias.most for plan in self._of(solver)])

    @property
    def floor(self) -> Bias:
        """Error of the mean of the 1D model on its finest grid."""
        return self.mean.floor

    def error_1d(self, claim: Claim) -> Finding:
        """Error of the mean of the 1D model, with scatter and grid apart."""
        floor, grid = self.floor, self.mean.grid_error
        half = floor.reach - grid
        ends = (floor.value - half, floor.value + half)
        draws = min(sample.count for sample in self.mean.samples)
        known = all(map(isfinite, (floor.value, half, grid)))
        method, why = (HALVED, "") if known else (UNKNOWN, "too many surfaces have no answer")
        return Finding(claim, floor.value, ends, grid, method, self.where, draws, reason=why)

    def _of(self, solver):
        return [plan for plan in self.mean.plans if solver in (None, plan.solver)]


Regime: TypeAlias = SmoothRegime | RoughRegime


def smooth_regimes(node: xarray.DataTree) -> list[SmoothRegime]:
    """Every quantity of every smooth contact of a diagram."""
    datasets = {name: child.to_dataset(inherit=False) for name, child in node.children.items() if child.data_vars}
    found: dict[tuple[str, str], list[MeasuredLadder]] = {}
    for each in ladders(steps_table(datasets.values())):
        found.setdefault((each.contact, each.quantity), []).append(each)
    return [
        SmoothRegime(own[0].title, name, own[0].label, tuple(own), datasets[contact].attrs["reference_method"])
        for (contact, name), own in found.items()
    ]


def rough_regimes(node: xarray.DataTree) -> list[RoughRegime]:
    """Every quantity of every rough contact of a diagram."""
    pairs = [
        [child.children[name].to_dataset(inherit=False) for name in ("BEM", "MDR")]
        for child in node.children.values()
        if child.children
    ]
    return [RoughRegime(mean.title, mean.quantity, mean.label, mean) for pair in pairs for mean in means(*pair)]


def answers_table(found: Sequence[Regime], levels: Sequence[float] = LEVELS) -> list[dict[str, Any]]:
    """A row for each regime and wanted error; times in seconds, errors relative."""
    return [_row(each, level) for each in found for level in levels]


def cells(found: Sequence[Regime], levels: Sequence[float] = LEVELS) -> list[dict[str, str]]:
    """Answers in words: regimes as rows, wanted errors as columns.

    Of rough regimes the error is that expected of a mean over surfaces (rms), of smooth ones the error itself.
    """
    return [
        {
            "regime": f"{each.title}{', expected (rms)' if isinstance(each, RoughRegime) else ''}",
            "quantity": each.label,
            **{f"within {share(level)}": _cell(each, level) for level in levels},
            "error that 1D keeps": "none (it converges)" if each.converges else interval(each.floor),
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
    taken, own = each.answer(level), each.floor
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
        "converges_1d": each.converges,
    }


def _least(errors):
    return float(np.nanmin([*errors, inf])) if np.isfinite(errors).any() else nan
