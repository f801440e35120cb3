"""Ratio of 1D over 3D of one quantity, of many draws of both that were solved."""

from collections.abc import Sequence
from math import hypot, inf, isfinite, log, nan, sqrt
from typing import NamedTuple

import numpy as np

from compare.solving.outcome import Outcome, Row
from compare.trustmap.ratio import LAW, Ratio

FINE, HALF = "fine", "coarse"  # grids of the rows of an outcome


def ratio_of(outcome: Outcome, quantity: str, law: float = nan) -> Ratio:
    """Ratio of a quantity, of all draws that were solved; law : friction coefficient that the law makes of it."""
    space = _space(outcome, "friction" if quantity == LAW else quantity)
    line = Mean(law, 0.0, inf) if quantity == LAW else _line(outcome, quantity)
    above = line.value > 0 and space.value > 0
    return Ratio(
        logarithm=log(line.value / space.value) if above else nan,
        line_error=line.scatter / sqrt(line.draws) if line.draws else nan,
        scatter=space.scatter,
        surfaces=space.draws,
        grid=space.grid,
    )


class Mean(NamedTuple):
    """Mean over draws, the relative standard deviation of one, and how many know it as well; see `Ratio.grid`."""

    value: float
    scatter: float
    draws: float
    grid: float = nan


def _line(outcome, quantity):
    return _mean(_rows(outcome, "MDR", FINE), quantity)


def _space(outcome, quantity):
    """Mean over surfaces: where most are on half the points, theirs, times what all points change on the first."""
    fine, half = (_rows(outcome, "BEM", grid) for grid in (FINE, HALF))
    pairs = [pair for pair in zip(fine, half, strict=False) if all(row.reason is None for row in pair)]
    first, again = ([pair[k] for pair in pairs] for k in (0, 1))
    every, some = _mean(first, quantity), _mean(again, quantity)
    grid = every.value / some.value - 1 if some.value and isfinite(some.value) else nan
    if len(half) <= len(fine) or len(pairs) < 2:
        return _mean(fine, quantity)._replace(grid=grid)
    many = _mean(half, quantity)
    apart = _apart(first, again, quantity) / sqrt(len(pairs))
    error = hypot(many.scatter / sqrt(many.draws), apart)
    known = many.scatter**2 / error**2 if error else many.draws
    return Mean(many.value * (1 + grid), many.scatter, min(known, many.draws), grid)


def _rows(outcome, solver, grid):
    return [
        row for row in outcome.rows if (row.settings.get("solver"), row.settings.get("grid")) == (solver, grid)
    ]


def _values(rows: Sequence[Row], quantity: str) -> tuple[np.ndarray, np.ndarray]:
    """Values of rows, and those over whose sum theirs is taken."""
    name = {"friction": "friction_force", "depth": "depth", "force": "normal_force"}[quantity]
    over = [row.normal_force if quantity == "friction" else 1.0 for row in rows]
    return np.array([getattr(row, name) for row in rows]), np.array(over)


def _mean(rows: Sequence[Row], quantity: str) -> Mean:
    """Mean of the draws that were solved."""
    values, over = _values([row for row in rows if row.reason is None], quantity)
    if not values.size or not over.sum():
        return Mean(nan, nan, 0)
    mean = float(values.sum() / over.sum())
    if values.size < 2 or not mean:
        return Mean(mean, nan, values.size)
    return Mean(mean, float(np.std((values - mean * over) / over.mean(), ddof=1) / abs(mean)), values.size)


def _apart(fine: Sequence[Row], half: Sequence[Row], quantity: str) -> float:
    """Standard deviation of what all points change on a surface, over the mean."""
    moved = []
    for rows in (fine, half):
        values, over = _values(rows, quantity)
        moved.append((values - values.sum() / over.sum() * over) / abs(values.mean()))
    return float(np.std(moved[0] - moved[1], ddof=1))
