"""What claims are judged from: one dimensionality of a series, or both, whose surfaces can be left out."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from ..resampling import groups, mean_ratio
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
        found = {body: solved(solver, body, grid) for body in (ROUGH, REST, SMOOTH, SMOOTH_REST)}
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

    def friction(self, body: str = ROUGH) -> np.ndarray:
        """mu of the means over surfaces, (speeds, presses)."""
        return self[body].friction

    def mean(self, name: str, body: str) -> np.ndarray:
        """Of a number over surfaces, (speeds, presses)."""
        return mean_ratio(getattr(self[body], name)).value


@dataclass(frozen=True)
class Pair:
    """Both dimensionalities on grids of their own.

    Their surfaces are independent: one of three dimensions is left out together with a share of the profiles,
    which counts both errors, with the degrees of freedom of the fewer.
    """

    one: Side
    three: Side

    @property
    def groups(self) -> Sequence[np.ndarray]:
        """As of resampling.Samples."""
        return [np.array([k]) for k in range(min(len(self.one.groups), len(self.three.groups)))]

    def without(self, group: np.ndarray) -> Self:
        """As of resampling.Samples."""
        (k,), count = group, len(self.groups)
        one, three = (np.array_split(np.arange(side.surfaces), count)[k] for side in (self.one, self.three))
        return replace(self, one=self.one.without(one), three=self.three.without(three))


def _without(answers: Answers, group) -> Answers:
    kept = {name: np.delete(getattr(answers, name), group, axis=2) for name in PER_SURFACE}
    measures = {name: np.delete(values, group, axis=2) for name, values in answers.measures.items()}
    return replace(answers, measures=measures, **kept)
