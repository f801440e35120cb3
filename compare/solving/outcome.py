"""Outcome of a task: the numbers of each of its scenes, and fields for pictures."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import nan
from typing import Any

import numpy as np

from scene import Result, SolveError
from scene.printable import brief

NUMBERS = ("normal_force", "depth", "friction_force", "residual", "operator_applications", "seconds")
# Names of what stands beside the measures of a model, which may have no other.
TAKEN = {*NUMBERS, "level", "speed", "load", "surface", "points", "stratum", "variate", "control_variates"} | {
    "friction_coefficient", "depth_reached", "status", "reason"
}  # fmt: skip


@dataclass(frozen=True)
class Row:
    """The numbers of one solved scene, as in Result; NaN with a reason where the solve failed.

    finer : which of the finer grids of its task answered; 0 where the solver itself did
    """

    normal_force: float = nan
    depth: float = nan
    friction_force: float = nan
    residual: float = nan
    operator_applications: float = nan
    seconds: float = nan
    measures: Mapping[str, float] = field(default_factory=dict)
    settings: Mapping[str, Any] = field(default_factory=dict)
    reason: str | None = None
    finer: int = 0

    @property
    def friction_coefficient(self) -> float:
        """mu = F_x / F_N; NaN where nothing carries a load."""
        return self.friction_force / self.normal_force if self.normal_force else nan


@dataclass(frozen=True)
class Outcome:
    """The rows of a task, one a scene, and the fields of its first scene if the task keeps them."""

    rows: tuple[Row, ...]
    fields: Mapping[str, np.ndarray] = field(default_factory=dict, repr=False)


def row(result: Result) -> Row:
    """The numbers of a result, as plain Python numbers. Raises SolveError of measures that no table can hold."""
    for name in (*result.measures, *result.fields):
        if not (isinstance(name, str) and name.isprintable() and name.strip(". ")) or "/" in name:
            raise SolveError(f"measure or field {brief(repr(name))}: printable letters without / are allowed")
    if taken := sorted(TAKEN & result.measures.keys()):
        raise SolveError(f"measure {taken[0]!r}: the name has another use, choose another")
    numbers: dict[str, Any] = {name: float(getattr(result, name)) for name in NUMBERS}
    return Row(
        **numbers,
        measures={name: float(value) for name, value in result.measures.items()},
        settings={name: _plain(value) for name, value in result.settings.items()},
    )


def reason_of(error: BaseException) -> str:
    """Message of an error in a line; its type where it has none."""
    return " ".join(str(error).split()) or type(error).__name__


def _plain(value):
    value = value.item() if isinstance(value, np.generic) else value
    return value if isinstance(value, str | int | float | bool | None) else str(value)
