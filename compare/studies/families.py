"""Claims on several series together: roughness and rheology count through one variable alone."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from math import isfinite
from typing import TYPE_CHECKING, Self

import numpy as np

from ..finding import Finding
from ..statistics.jackknife import RmsMisfit, mean_ratio
from ..samples import Samples
from ..shifting import shift
from ..verdict import DIMENSIONS
from .claims import FAST, SLOW
from .question import TOLERANCE, Question, answered, geometric, power
from .series import COARSE, FAMILIES, FINE, ROUGH
from .sides import Side

if TYPE_CHECKING:
    from .judgement import JudgedSeries

FAMILY = "study-family"


@dataclass(frozen=True)
class Family:
    """One dimensionality of several series on the same surfaces, as of resampling.Samples."""

    sides: tuple[Side, ...]

    @property
    def surfaces(self) -> int:
        """How many were drawn."""
        return self.sides[0].surfaces

    @property
    def groups(self) -> Sequence[np.ndarray]:
        return self.sides[0].groups

    def without(self, group: np.ndarray) -> Self:
        return replace(self, sides=tuple(side.without(group) for side in self.sides))


def families(series: "Sequence[JudgedSeries]") -> "dict[str, list[JudgedSeries]]":
    """Series that slide, by the name of their shape, where roughness or solid differ.

    All of a family have as many surfaces; of several such families of one shape it is the largest.
    """
    found: dict[tuple[str, int, int], list[JudgedSeries]] = {}
    for judged in series:
        if judged.laws and FAMILIES in judged.solved.series.claims:
            each = judged.solved.series
            draws = type(each.scene.indenter).__name__.lower(), each.surfaces, each.profiles
            found.setdefault(draws, []).append(judged)
    rising = sorted(found.items(), key=lambda family: len(family[1]))
    return {shape: members for (shape, *_), members in rising if _differ(members)}


def reduced(members: "Sequence[JudgedSeries]", solver: str, grid: str = FINE) -> Samples:
    """mu over the plateau against 1/xi, a curve a series; `speeds` count the series."""
    load, friction = [], []
    for judged in members:
        answers, laws = judged.solved(solver, ROUGH, grid), judged.laws[solver]
        mean = mean_ratio(answers.normal_force).value[..., None]
        unit = 1 / laws.xi_under(mean[..., 0])[..., None] / mean
        load.append((answers.normal_force * unit).reshape(-1, answers.depth.shape[2]))
        friction.append((answers.friction_force * unit / laws.plateau).reshape(load[-1].shape))
    most = max(len(each) for each in load)
    loads, frictions = (np.array([_filled(each, most) for each in stack]) for stack in (load, friction))
    return Samples(np.arange(1.0, len(members) + 1), loads, frictions)


def family_findings(series: "Sequence[JudgedSeries]") -> Iterator[Finding]:
    """For each shape and dimensionality."""
    for shape, members in families(series).items():
        for solver, dimension in DIMENSIONS.items():
            yield _one_curve(members, solver, dimension, shape)
            yield from _slope_exponents(members, solver, dimension, shape)


def _one_curve(members, solver, dimension, shape):
    fine, coarse = (_missed(members, solver, grid) for grid in (FINE, COARSE))
    low, high = fine.interval()
    return Finding(
        claim=f"Eq. 18: friction over its plateau is one function of xi, whatever roughness and solid, {shape}",
        dimension=dimension,
        expected=0.0,
        tolerance=2 * TOLERANCE,
        value=fine.value,
        statistical=(low, high),
        grid=fine.apart(coarse),
        surfaces=members[0].solved.series.drawn(solver),
        regime=_words(members, solver),
        figure=FAMILY,
        text=f"rms of ln mu about one curve through all points of {len(members)} series, none shifted, without "
        "what scatter adds.",
        undecidable="" if isfinite(fine.value + coarse.value) else "too few points or surfaces have an answer",
    )


def _missed(members, solver, grid):
    """By all points of one curve; unknown where there are too few."""
    try:
        return shift(reduced(members, solver, grid)).none.misfit
    except ValueError:
        return RmsMisfit.unknown()


def _slope_exponents(members, solver, dimension, shape):
    """At the presses where all are slow, or all are fast."""
    alike = _apart_by_height(members)
    if len(alike) < 3:
        return
    ruled = [judged.laws[solver] for judged in alike]
    plateaus = np.array([each.plateau for each in ruled])
    fine, coarse = (
        Family(tuple(Side.of(judged.solved, solver, grid) for judged in alike)) for grid in (FINE, COARSE)
    )
    slow = np.all([(each.xi[0] <= SLOW) & (each.slowest_loss <= SLOW) for each in ruled], axis=0)
    fast = np.all([each.xi[-1] >= FAST for each in ruled], axis=0)
    for place, presses, expected, what in ((0, slow, 2.0, "slowest"), (-1, fast, 1.0, "fastest")):
        if not presses.any():
            continue
        # What Eq. 19 still lacks of either limit.
        lacking = [each.law[place] / (each.plateau * each.xi[place] ** (expected - 1)) for each in ruled]

        def exponent(family: Family, place=place, presses=presses, lacking=lacking):
            levels = [side.friction()[place] / each for side, each in zip(family.sides, lacking, strict=True)]
            return power(plateaus, np.array([geometric(each[presses]) for each in levels]))

        question = Question(
            f"Eqs. 14, 17: friction at the {what} speed goes as the rms slope to the power {expected:g}, {shape}",
            expected,
            f"d ln mu / d ln of the rms slope, least squares over {len(alike)} rms heights, mean of the "
            f"{presses.sum()} presses at which all are at that limit, but for what Eq. 19 still lacks of it.",
            exponent,
            TOLERANCE * expected,
            FAMILY,
        )
        yield answered(question, dimension, fine, coarse, _words(alike, solver))


def _apart_by_height(members):
    """The first and those that differ from it in the rms height alone."""

    def but_for_height(judged):
        series = judged.solved.series
        return (
            series.speeds,
            series.presses,
            replace(series.scene, roughness=replace(series.scene.roughness, rms_height=1.0)),
        )

    return [judged for judged in members if but_for_height(judged) == but_for_height(members[0])]


def _differ(members):
    """Whether roughness or solid do."""
    scenes = [judged.solved.series.scene for judged in members]
    return any(each.roughness != scenes[0].roughness or each.elastomer != scenes[0].elastomer for each in scenes)


def _words(members, solver):
    """The regimes of all."""
    return "; ".join(dict.fromkeys(judged.laws[solver].regime.words for judged in members))


def _filled(rows, count):
    """Series with fewer points end with unknown ones."""
    return np.vstack([rows, np.full((count - len(rows), rows.shape[1]), np.nan)])
