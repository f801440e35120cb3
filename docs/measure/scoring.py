"""Scores of the trust map on scenes held out: errors, coverage and advice, by region."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, fields
from functools import cached_property
from itertools import product
from math import log
from typing import Any

import numpy as np
from scipy.special import ndtr
from tables import of_count

from compare.trustmap.measured import beyond_measured, limits
from compare.trustmap.model import (
    FLOWS,
    LAW,
    NAMES,
    NORMAL,
    ROUGHNESS,
    SHAPES,
    WIDENED,
    Condition,
    Measurements,
    Model,
    Predicted,
    parts,
)
from compare.trustmap.table import column, measurements
from compare.trustmap.verdict import SOLVE, USE, advice_on

# Regions of the map, where errors and advice are stated, each a condition on groups.
SPEEDS: dict[str, Condition] = {
    "at rest": lambda g: ~g["slides"],
    "slow": lambda g: g["slides"] & FLOWS["slow"](g),
    "fast": lambda g: g["slides"] & FLOWS["fast"](g),
}
SOLIDS: dict[str, Condition] = {
    "Kelvin-like, E_g > 10^4 E_r": lambda g: g["stiffening"] > log(1e4),
    "E_g 10^2 to 10^4 E_r": lambda g: (g["stiffening"] <= log(1e4)) & (g["stiffening"] > log(1e2)),
    "E_g up to 10^2 E_r": lambda g: g["stiffening"] <= log(1e2),
}
WAVES: dict[str, Condition] = {
    "less than 2 waves on the radius": lambda g: g["sliding_waves"] < log(2),
    "2 to 6 waves": lambda g: (g["sliding_waves"] >= log(2)) & (g["sliding_waves"] < log(6)),
    "more than 6 waves": lambda g: g["sliding_waves"] >= log(6),
}
SURFACES: dict[str, Condition] = {
    "spectrum": lambda g: (g["side"] == 0) & (g["gaussian"] == 0),
    "as measured": lambda g: (g["side"] > 0) | (g["gaussian"] > 0),
}
REGIONS = {"body": SHAPES, "speed": SPEEDS, "roughness": ROUGHNESS, "solid": SOLIDS, "waves": WAVES}
COVERED = WIDENED | {"speed": SPEEDS}  # what coverage is stated by
# Scenes of a regime below which its advice is left out.
FEWEST = 5
# Scenes of a region from which on it fails if its coverage is below what was promised, with 95 % of confidence.
ENOUGH, PROMISED = 40, 0.95
# Of the narrower of two intervals, of 1D and of the law.
BEST = "best-advice"
STATED: dict[str, dict[str, Condition]] = {
    "all": {"all": lambda g: np.isfinite(g["shape"])},
    **REGIONS,
    "prescribed": COVERED["prescribed"],
    "surface": SURFACES,
}


@dataclass(frozen=True, eq=False)
class Score:
    """Ratios predicted and measured, of scenes with one quantity (N,).

    measured, predicted : of the same scenes; where a mean is not above zero there is no ratio, and no error
    slides : which of the scenes slide
    """

    measured: Measurements
    predicted: Predicted
    slides: np.ndarray

    @property
    def groups(self) -> Mapping[str, np.ndarray]:
        """What regions are conditions on: groups (N,) by name."""
        return dict(zip(NAMES, self.measured.groups.T, strict=True)) | {"slides": self.slides}

    def taken(self, chosen: np.ndarray) -> "Score":
        """Score of some scenes: a mask or numbers of scenes."""
        predicted = Predicted(*(each[chosen] for each in self.predicted))
        return Score(self.measured.taken(chosen), predicted, self.slides[chosen])

    def best(self, other: "Score") -> "Score":
        """Score that takes for each scene the narrower of two intervals, and is usable where either is."""
        first = np.where(self.usable == other.usable, self.predicted.error <= other.predicted.error, self.usable)

        def picked(ours, theirs):
            return np.where(first.reshape(-1, *[1] * (ours.ndim - 1)), ours, theirs)

        measured = (
            picked(getattr(self.measured, each.name), getattr(other.measured, each.name))
            for each in fields(Measurements)
        )
        predicted = (picked(*each) for each in zip(self.predicted, other.predicted, strict=True))
        return Score(Measurements(*measured), Predicted(*predicted), self.slides)

    @cached_property
    def variance(self) -> np.ndarray:
        """Variance of the measured logarithms (N,)."""
        return self.measured.variance(self.predicted.scatter)

    @cached_property
    def advice(self) -> np.ndarray:
        """Advice on each scene (N,)."""
        ratio, error = np.exp(self.predicted.logarithm), self.predicted.error
        return np.array([advice_on(*each) for each in zip(ratio, error, strict=True)])

    @property
    def usable(self) -> np.ndarray:
        """Mask of the scenes that get "use" or "multiply" (N,)."""
        return self.advice != SOLVE

    @property
    def used(self) -> "Score":
        """Score of the scenes that are usable and have a ratio: whose errors count."""
        return self.taken(self.usable & np.isfinite(self.measured.logarithm))

    @cached_property
    def errors(self) -> np.ndarray:
        """Relative errors of corrected 1D (N,), the scatter of the truth in them."""
        return np.expm1(self.measured.logarithm - self.predicted.logarithm)

    @cached_property
    def held(self) -> np.ndarray:
        """Mask of the measured ratios within the interval of 95 % (N,), widened by the noise of the truth."""
        apart = self.measured.logarithm - self.predicted.logarithm
        return np.abs(apart) < NORMAL * np.sqrt(self.predicted.error**2 + self.variance)

    @property
    def covered(self) -> float:
        """Share of the measured ratios within the interval of 95 %."""
        return float(np.mean(self.held))

    @property
    def surfaces_covered(self) -> float:
        """Share of single surfaces within the interval of one surface, where it has one, as they were measured."""
        if not self.predicted.surface_known.all():
            return self.taken(self.predicted.surface_known).surfaces_covered
        apart = self.measured.logarithm - self.predicted.logarithm
        width = NORMAL * np.hypot(self.predicted.error, self.predicted.scatter)
        scatter = np.maximum(np.nan_to_num(self.measured.scatter), 1e-9)
        return float(np.mean(ndtr((width - apart) / scatter) - ndtr((-width - apart) / scatter)))


def scored(held_out: Mapping[str, np.ndarray], models: Mapping[str, Model]) -> dict[str, Score]:
    """Score of each model on the scenes of a table, and of the best advice on friction.

    Off the map nothing is known: the advice is to solve.
    """
    found: dict[str, Score] = {}
    for name, model in models.items():
        rows, measured = measurements(held_out, name)
        off = np.array([bool(beyond_measured(place)) for place in measured.groups], bool)
        predicted = model.predicted(np.clip(measured.groups, *limits()))
        predicted = predicted._replace(error=np.where(off, np.inf, predicted.error))
        found[name] = Score(measured, predicted, held_out[column("friction", "surfaces")][rows] > 0)
    return {**found, BEST: found["friction"].best(found[LAW])}


def of_surfaces(scores: Mapping[str, Score], name: str) -> dict[str, Score]:
    """Scores on the scenes with surfaces of one kind, see SURFACES."""
    return {each: score.taken(SURFACES[name](score.groups)) for each, score in scores.items()}


def error_rows(
    scores: Mapping[str, Score], kinds: Mapping[str, Mapping[str, Condition]] = STATED
) -> Iterator[dict[str, Any]]:
    """Errors as measured and share within the interval, by region, a kind of region at a time, and ratio.

    fails : as in `coverage_rows`
    """
    for kind, regions in kinds.items():
        for (region, condition), (name, score) in product(regions.items(), scores.items()):
            here = condition(score.groups) & np.isfinite(score.measured.logarithm)
            used = score.taken(here & score.usable)
            if used.usable.size:
                half, most = np.quantile(np.abs(used.errors), (0.5, 0.9))
                row = {"ratio": name, "by": kind, "region": region, "scenes": int(here.sum())}
                row |= {"usable": float(score.usable[here].mean()), "median": half, "nine in ten": most}
                yield row | _held(used)


def _held(used):
    """Share within the interval with its own, and whether it fails what was promised."""
    tried = used.usable.size
    low, high = of_count(int(used.held.sum()), tried)
    fails = tried >= ENOUGH and high < PROMISED
    return {"in 95 %": used.covered, "least": low, "most": high, "fails": fails}


def coverage_rows(scores: Mapping[str, Score]) -> Iterator[dict[str, Any]]:
    """Share of the usable ratios within their interval, by quantity and region, with the interval of the count.

    fails : whether a region of enough scenes has significantly fewer than what was promised
    """
    for name, score in scores.items():
        for named, here in parts(COVERED, score.groups):
            used = score.taken(here).used
            if used.usable.size:
                row = dict(zip(COVERED, named, strict=True)) | {"quantity": name, "scenes": used.usable.size}
                yield row | _held(used)


def advice_rows(scores: Sequence[Score]) -> Iterator[tuple[str, ...]]:
    """A row for each regime, a cell for each score: factor on it, half its interval, and share to solve."""
    for speed, roughness in product(("slow", "fast", "at rest"), ROUGHNESS):
        regimes = (SPEEDS[speed](score.groups) & ROUGHNESS[roughness](score.groups) for score in scores)
        cells = (_advice(score.taken(here)) for score, here in zip(scores, regimes, strict=True))
        yield f"{speed}, {roughness}", *cells


def _advice(part: Score) -> str:
    """Advice of most scenes; a factor with its range, from the lowest to the highest of nine in ten."""
    if part.advice.size < FEWEST:
        return ""
    used, left = (float(np.mean(part.advice == kind)) for kind in (USE, SOLVE))
    solve = f"solve {100 * left:.0f} %"
    if left > 0.5:
        return solve
    known = part.taken(part.usable).predicted
    low, middle, high = np.quantile(np.exp(-known.logarithm), (0.05, 0.5, 0.95))
    kind = "use" if used > 0.5 else f"× {middle:.2f} ({low:.2f} to {high:.2f})"
    half = 100 * np.median(np.expm1(NORMAL * known.error))
    return f"{kind}, ±{half:.2g} %" + (f"; {solve}" if left > 0.005 else "")
