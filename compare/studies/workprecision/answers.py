"""The shortest way to a wanted error of the true answer of three dimensions, in any model."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import isfinite, nan
from typing import Any

import xarray

from ...solving.words import seconds, share
from ...statistics.convergence import MeasuredLadder, ladders
from ...statistics.finding import HALVED, UNKNOWN, Claim, Finding
from ...statistics.sampling import Bias, Effort, SamplingPlan, cheapest
from .convergence import dimension, steps_table
from .ensemble import MeasuredMean, means

# Wanted errors of which tables say what they take.
LEVELS = (0.1, 0.03, 0.01, 0.003)
# Order in the points from which on an error falls.
FALLS = 0.3


@dataclass(frozen=True)
class Regime:
    """One quantity of one contact, and all ways to it: ladders of a smooth body, plans to the mean of a rough one.

    title : of the contact; quantity, label : name, for people
    floor : error of the 1D model on its finest grid
    converges : whether that error still falls with the points
    known : of the finding on that error, all but its claim and value
    mean : over surfaces, that of a rough body
    """

    title: str
    quantity: str
    label: str
    ways: Sequence[MeasuredLadder | SamplingPlan]
    floor: Bias
    converges: bool
    known: Mapping[str, Any]
    mean: MeasuredMean | None = None

    @property
    def where(self) -> str:
        """Contact and quantity in words."""
        return f"{self.title}: {self.label}"

    def of(self, solver: str | None) -> list[MeasuredLadder | SamplingPlan]:
        """Ways of one solver; all of them if none is named."""
        return [each for each in self.ways if solver in (None, each.solver)]

    def answer(self, level: float, solver: str | None = None) -> Effort | None:
        """The shortest way to a level; None where there is none."""
        return cheapest(self.of(solver), level)

    def seconds(self, level: float, solver: str | None = None) -> float:
        """Processor time of the shortest way to a level [s]; NaN where there is none."""
        taken = self.answer(level, solver)
        return nan if taken is None else taken.seconds

    def best(self, solver: str | None = None) -> float:
        """Least error that is known to be reached; NaN without any."""
        return float(min(filter(isfinite, (each.certain for each in self.of(solver))), default=nan))

    def missed(self, solver: str | None = None) -> str:
        """Least error that is known to be reached, in words."""
        best = self.best(solver)
        return f"best known {share(best)}" if isfinite(best) else "not solved"

    def cell(self, level: float, solver: str | None = None) -> str:
        """The shortest way to a level in words."""
        taken = self.answer(level, solver)
        if taken is not None:
            return f"{dimension(taken.solver)}, {taken.settings}: {seconds(taken.seconds)}"
        return f"not reached; {self.missed(solver)}" if isfinite(self.best(solver)) else "not known"

    def error_1d(self, claim: Claim) -> Finding:
        """Error of the 1D model on its finest grid."""
        return Finding(claim, self.floor.value, where=self.where, **self.known)


def regimes_of(node: xarray.DataTree) -> list[Regime]:
    """Every quantity of every contact of a diagram, smooth ones first."""
    found: dict[tuple[str, str], list[MeasuredLadder]] = {}
    for each in ladders(steps_table(node)):
        found.setdefault((each.contact, each.quantity), []).append(each)
    smooth = [_smooth(own, node[contact].attrs["reference_method"]) for (contact, _), own in found.items()]
    rough = (
        [child.children[name].to_dataset(inherit=False) for name in ("BEM", "MDR", "CorrectedMDR")]
        for child in node.children.values()
        if child.children
    )
    return [*smooth, *(_rough(mean) for each in rough for mean in means(*each))]


def _smooth(own, method):
    first, uncertain = own[0], own[0].reference_error
    lines = [each for each in own if each.solver == "MDR"]
    error = float(lines[-1].errors[-1]) if lines else nan
    floor = Bias(error, error - uncertain, error + uncertain)
    known = {
        "scatter": (floor.value, floor.value),
        "grid": uncertain,
        "grid_method": method if isfinite(uncertain) else UNKNOWN,
        "reason": "" if isfinite(floor.value) else "not solved",
    }
    falls = bool(lines) and _falls(lines[-1])
    return Regime(first.title, first.quantity, first.label, own, floor, falls, known)


def _falls(ladder):
    """Whether the order between the last two steps is more than FALLS; one alone cannot tell."""
    if len(ladder.values) < 2:
        return False
    (coarse, fine), (before, last) = ladder.values[-2:], ladder.errors[-2:]
    return bool(before > last * (fine / coarse) ** FALLS)


def _rough(mean):
    """The scatter of profiles would hide whether the 1D model comes ever closer with its points."""
    floor, grid = mean.floor(), mean.grid_error
    scatter = (floor.low + grid, floor.high - grid)
    sure = all(map(isfinite, (floor.value, *scatter)))
    known = {
        "scatter": scatter,
        "grid": grid,
        "grid_method": HALVED if sure else UNKNOWN,
        "draws": min(sample.count for sample in mean.samples),
        "reason": "" if sure else "too many surfaces have no answer",
    }
    return Regime(mean.title, mean.quantity, mean.label, mean.plans, floor, False, known, mean)


def answers_table(found: Iterable[Regime]) -> Iterator[dict[str, Any]]:
    """A row for each regime and wanted error; times in seconds, errors relative."""
    for each in found:
        for level in LEVELS:
            taken, own = each.answer(level), each.floor
            yield {
                "regime": each.title,
                "quantity": each.label,
                "wanted": level,
                "model": "" if taken is None else dimension(taken.solver),
                "settings": "" if taken is None else taken.settings,
                "seconds": each.seconds(level),
                "seconds_1d": each.seconds(level, "MDR"),
                "seconds_1d_corrected": each.seconds(level, "CorrectedMDR"),
                "seconds_3d": each.seconds(level, "BEM"),
                "best_known": each.best(),
                "floor_1d": own.size,
                "floor_1d_least": own.least,
                "floor_1d_most": own.most,
                "converges_1d": each.converges,
            }


def cells(found: Iterable[Regime], solver: str | None = None) -> list[dict[str, str]]:
    """Answers in words: regimes as rows, wanted errors as columns; of one solver, or of all with what 1D keeps.

    Of rough regimes the error is that expected of a mean over surfaces (rms), of smooth ones the error itself.
    """
    rows = []
    for each in found:
        row = {
            "regime": f"{each.title}{', expected (rms)' if each.mean else ''}",
            "quantity": each.label,
            **{f"within {share(level)}": each.cell(level, solver) for level in LEVELS},
        }
        if solver is None:
            best = each.best("CorrectedMDR")
            row["error that 1D keeps"] = "none (it converges)" if each.converges else _interval(each.floor)
            row["best of 1D corrected"] = share(best) if isfinite(best) else "not known"
        rows.append(row)
    return rows


def _interval(bias):
    """A size with the ends of its interval in words."""
    if not isfinite(bias.size):
        return "not known"
    if not isfinite(bias.most):
        return f"{share(bias.size)}, interval not known"
    if bias.high - bias.low < 0.1 * bias.size:
        return share(bias.size)
    least = share(bias.least).removesuffix(" %") if bias.least else "0"
    return f"{share(bias.size)} ({least} to {share(bias.most)})"
