"""Ratio of 1D over 3D of one quantity, as it was measured on many draws of both."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite, log, nan, sqrt

import numpy as np

from scene import Scene

from ..solving.outcome import Outcome, Row

FINE, HALF = "fine", "coarse"  # grids of the rows of an outcome

QUANTITIES = "friction", "depth", "force"


@dataclass(frozen=True)
class Ratio:
    """Ratio of the mean over profiles in 1D and the mean over surfaces in 3D.

    logarithm : of the ratio; nan where one of the means is not above zero
    line_error : relative standard error of the mean in 1D
    scatter : relative standard deviation of one surface in 3D; nan of fewer than two
    surfaces : in 3D
    grid : relative change of the mean in 3D from half the points to all
    """

    logarithm: float
    line_error: float
    scatter: float
    surfaces: int
    grid: float


def asked_of(scene: Scene) -> tuple[str, ...]:
    """Quantities that a scene has: friction if it slides, depth under a load, force at a depth."""
    free = "depth" if scene.motion.pressed_by == "load" else "force"
    return ("friction", free) if scene.motion.speed else (free,)


def ratio_of(outcome: Outcome, quantity: str) -> Ratio:
    """Ratio of a quantity, of all draws that were solved."""
    line, space = (_mean(_rows(outcome, solver, FINE), quantity) for solver in ("MDR", "BEM"))
    coarse = _rows(outcome, "BEM", HALF)
    pairs = list(zip(_rows(outcome, "BEM", FINE), coarse, strict=False))
    pairs = [pair for pair in pairs if all(row.reason is None for row in pair)]
    fine, half = (_mean([pair[k] for pair in pairs], quantity)[0] for k in (0, 1))
    above = line[0] > 0 and space[0] > 0
    return Ratio(
        logarithm=log(line[0] / space[0]) if above else nan,
        line_error=line[1] / sqrt(line[2]) if line[2] else nan,
        scatter=space[1],
        surfaces=space[2],
        grid=fine / half - 1 if half and isfinite(half) else nan,
    )


def _rows(outcome, solver, grid):
    return [
        row for row in outcome.rows if (row.settings.get("solver"), row.settings.get("grid")) == (solver, grid)
    ]


def _mean(rows: Sequence[Row], quantity: str) -> tuple[float, float, int]:
    """Mean of the draws that were solved, the relative standard deviation of one, and their number."""
    solved = [row for row in rows if row.reason is None]
    over = np.array([row.normal_force if quantity == "friction" else 1.0 for row in solved])
    name = {"friction": "friction_force", "depth": "depth", "force": "normal_force"}[quantity]
    values = np.array([getattr(row, name) for row in solved])
    if not values.size or not over.sum():
        return nan, nan, 0
    mean = float(values.sum() / over.sum())
    if values.size < 2 or not mean:
        return mean, nan, values.size
    return mean, float(np.std((values - mean * over) / over.mean(), ddof=1) / abs(mean)), values.size
