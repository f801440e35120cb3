"""Friction measured by a user at several loads and speeds, on the way of Figs. 5 to 7."""

from math import sqrt
from pathlib import Path

import numpy as np

from scene.reading import InvalidInput
from scene.table import read_rows

from ..commoncurve import Curve
from ..metrics import estimate, pooled_scatter
from .shifts import Shifted

COLUMNS = ("mu", "F_N", "v")
# What a heading may call them, in lower case.
CALLED = {
    "mu": ("mu", "µ", "μ", "friction", "friction_coefficient"),
    "F_N": ("f_n", "fn", "load", "normal_force", "force"),
    "v": ("v", "speed", "velocity"),
}
LEAST_LOADS = 2


def read_measured(path: str | Path) -> Shifted:
    """Shift the curves of a table: friction coefficient mu, normal force F_N [N] and speed v [m/s], a row a point.

    Columns stand in this order, or as a heading names them. Rows of equal load and speed are measurements of one
    point: their mean counts. Its standard error is that of a scatter which, relative to friction, is the same
    everywhere: two or three measurements say too little of their own. Raises InvalidInput naming file, line and
    what is allowed.
    """
    try:
        points = _points(path)
        scatter = pooled_scatter(estimate(measured) for loads in points.values() for measured in loads.values())
        curves = [_curve(speed, points[speed], scatter) for speed in sorted(points)]
        return Shifted.measured(Path(path).stem, curves)
    except ValueError as error:
        said = str(error)
        raise InvalidInput(said if said.startswith(str(path)) else f"{path}: {said}") from error


def _points(path):
    """Frictions by speed and load."""
    heading, rows = read_rows(path, COLUMNS)
    order = _order(heading)
    points: dict[float, dict[float, list[float]]] = {}
    for row in rows:
        friction, load, speed = (row[i] for i in order)
        points.setdefault(speed, {}).setdefault(load, []).append(friction)
    if len(points) < 2:
        raise ValueError(f"{len(points)} speeds: at least 2 are needed")
    for speed, loads in points.items():
        if len(loads) < LEAST_LOADS:
            raise ValueError(f"v = {speed:g} has {len(loads)} load: at least {LEAST_LOADS} are needed for a curve")
    return points


def _curve(speed, loads, scatter):
    ordered = [loads[load] for load in sorted(loads)]
    friction, error = zip(*((np.mean(each), scatter / sqrt(len(each))) for each in ordered), strict=True)
    return Curve(speed, np.log(sorted(loads)), np.log(friction), np.array(error))


def _order(heading):
    """Where mu, F_N and v stand."""
    if not heading:
        return range(len(COLUMNS))
    meant = [next((name for name in COLUMNS if cell.lower() in CALLED[name]), cell) for cell in heading]
    if sorted(meant) != sorted(COLUMNS):
        names = "; ".join(f"{name} as {', '.join(called)}" for name, called in CALLED.items())
        raise ValueError(f"the heading {heading} must name each of {', '.join(COLUMNS)} once: {names}")
    return [meant.index(name) for name in COLUMNS]
