"""Claims on several series together: roughness and rheology count through one variable alone."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import groupby
from typing import TYPE_CHECKING, Self

import numpy as np

from ..finding import Finding
from ..resampling import mean_ratio
from ..samples import Samples
from ..shifting import shift
from .claims import DIMENSIONS, TOLERANCE, Question, answered
from .series import COARSE, FINE, ROUGH
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
    """Series that slide, by the name of their shape; two at least."""

    def shape(judged):
        return type(judged.solved.series.scene.indenter).__name__.lower()

    sliding = sorted((judged for judged in series if judged.laws), key=shape)
    grouped = {name: list(members) for name, members in groupby(sliding, shape)}
    return {name: members for name, members in grouped.items() if len(members) > 1}


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
    load, friction = (np.array([_filled(each, most) for each in stack]) for stack in (load, friction))
    return Samples(np.arange(1.0, len(members) + 1), load, friction)


def family_findings(series: "Sequence[JudgedSeries]") -> Iterator[Finding]:
    """For each shape and dimensionality."""
    for shape, members in families(series).items():
        for solver, dimension in DIMENSIONS.items():
            yield _one_curve(members, solver, dimension, shape)
            yield from _slope_exponents(members, solver, dimension, shape)


def _one_curve(members, solver, dimension, shape):
    fine, coarse = (shift(reduced(members, solver, grid)).none.misfit for grid in (FINE, COARSE))
    low, high = fine.interval()
    return Finding(
        claim=f"Eq. 18: friction over its plateau is one function of xi, whatever roughness and solid, {shape}",
        dimension=dimension,
        expected=0.0,
        tolerance=2 * TOLERANCE,
        value=fine.value,
        statistical=(low, high),
        grid=abs(fine.value - coarse.value),
        surfaces=members[0].solved(solver).depth.shape[2],
        regime="; ".join(dict.fromkeys(judged.laws[solver].regime.words for judged in members)),
        figure=FAMILY,
        text=f"rms of ln mu about one curve through all points of {len(members)} series, none shifted, without "
        "what scatter adds.",
    )


def _slope_exponents(members, solver, dimension, shape):
    """Between series that differ in the rms height alone."""
    first = members[0].solved.series.scene
    alike = [
        judged
        for judged in members
        if replace(judged.solved.series.scene, roughness=first.roughness) == first
        and replace(judged.solved.series.scene.roughness, rms_height=first.roughness.rms_height) == first.roughness
    ]
    if len(alike) < 3:
        return
    slopes = np.log([judged.laws[solver].plateau for judged in alike])
    fine, coarse = (
        Family(tuple(Side.of(judged.solved, solver, grid) for judged in alike)) for grid in (FINE, COARSE)
    )
    for place, expected, what in ((0, 2.0, "slowest"), (-1, 1.0, "fastest")):

        def exponent(family: Family, place=place):
            levels = [np.mean(np.log(side.friction()[place])) for side in family.sides]
            return float(np.polyfit(slopes, levels, 1)[0])

        question = Question(
            f"Eqs. 14, 17: friction at the {what} speed goes as the rms slope to the power {expected:g}, {shape}",
            expected,
            f"d ln mu / d ln of the rms slope, least squares over {len(alike)} rms heights, mean of the presses.",
            exponent,
            TOLERANCE * expected,
        )
        yield answered(question, dimension, fine, coarse, members[0].laws[solver].regime.words, FAMILY)


def _filled(rows, count):
    """Series with fewer points end with unknown ones."""
    return np.vstack([rows, np.full((count - len(rows), rows.shape[1]), np.nan)])
