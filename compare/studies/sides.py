"""What claims are judged from: one dimensionality of a series, or both, whose surfaces can be left out."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from ..statistics.jackknife import groups, mean_ratio
from .series import FINE, REST, ROUGH, SMOOTH, SMOOTH_REST, Answers, Solved

PER_SURFACE = ("normal_force", "friction_force", "depth", "contact")


@dataclass(frozen=True)
class Side:
    """One solver on one grid.

    bodies : answers by body
    """

    solver: str
    bodies: Mapping[str, Answers]

    @classmethod
    def of(cls, solved: Solved, solver: str, grid: str = FINE) -> Self:
        """All that a series has of it."""
        found = {body: solved.get(solver, body, grid) for body in (ROUGH, REST, SMOOTH, SMOOTH_REST)}
        return cls(solver, {body: answers for body, answers in found.items() if answers is not None})

    def __getitem__(self, body: str) -> Answers:
        return self.bodies[body]

    @property
    def surfaces(self) -> int:
        """How many were drawn; 0 without a rough body."""
        drawn = [answers.depth.shape[2] for body, answers in self.bodies.items() if body in (ROUGH, REST)]
        return drawn[0] if drawn else 0

    @property
    def groups(self) -> Sequence[np.ndarray]:
        """As of resampling.Samples."""
        return groups(self.surfaces) if self.surfaces else []

    def without(self, group: np.ndarray) -> Self:
        """The same without some surfaces; smooth bodies keep their only one."""
        return replace(
            self,
            bodies={
                body: _without(answers, group) if body in (ROUGH, REST) else answers
                for body, answers in self.bodies.items()
            },
        )

    @property
    def smooth(self) -> Self:
        """The smooth bodies alone, of which no surface can be left out."""
        return replace(self, bodies={body: self[body] for body in (SMOOTH, SMOOTH_REST) if body in self.bodies})

    def friction(self, body: str = ROUGH) -> np.ndarray:
        """mu of the means over surfaces, (speeds, presses); NaN as of mean."""
        answers = self[body]
        return np.where(_enough(answers.friction_force), answers.friction, np.nan)

    def mean(self, name: str, body: str) -> np.ndarray:
        """Of a number over surfaces, (speeds, presses); NaN where fewer than half of them have it."""
        values = getattr(self[body], name)
        return np.where(_enough(values), mean_ratio(values).value, np.nan)


@dataclass(frozen=True)
class Pair:
    """Both dimensionalities on grids of their own.

    Their surfaces are independent: one of three dimensions is left out together with a share of the profiles,
    which counts both errors, with the degrees of freedom of the fewer.
    """

    one: Side
    three: Side

    @property
    def surfaces(self) -> int:
        """How many were drawn in three dimensions."""
        return self.three.surfaces

    @property
    def smooth(self) -> Self:
        """The smooth bodies alone."""
        return replace(self, one=self.one.smooth, three=self.three.smooth)

    @property
    def groups(self) -> Sequence[np.ndarray]:
        """As of resampling.Samples."""
        return [np.array([k]) for k in range(min(len(self.one.groups), len(self.three.groups)))]

    def without(self, group: np.ndarray) -> Self:
        """As of resampling.Samples."""
        (k,), count = group, len(self.groups)
        one, three = (np.array_split(np.arange(side.surfaces), count)[k] for side in (self.one, self.three))
        return replace(self, one=self.one.without(one), three=self.three.without(three))


def _enough(values):
    """Whether half of the surfaces or more have an answer."""
    return 2 * np.isfinite(values).sum(axis=-1) >= values.shape[-1]


def _without(answers: Answers, group) -> Answers:
    kept = {name: np.delete(getattr(answers, name), group, axis=2) for name in PER_SURFACE}
    measures = {name: np.delete(values, group, axis=2) for name, values in answers.measures.items()}
    return replace(answers, measures=measures, **kept)
