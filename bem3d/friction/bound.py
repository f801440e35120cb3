"""Bound of 95 % on the error of friction by the grid, from a single pressure and without another solve.

One pressure gives estimates of friction that fail in different ways, and the same estimates on pixels twice as
wide. `friction_error.csv` has the weights of these signs of the error, fitted to random contacts that were
solved on finer grids: the 95 % quantile of its logarithm, linear in `signs` (Koenker and Bassett, Econometrica 46,
33, 1978). The residual and a sharp tip add to it.
"""

import csv
from collections.abc import Mapping
from functools import cache
from math import ceil, exp, isnan, log, pi, sqrt
from pathlib import Path
from typing import NamedTuple

import numpy as np

from scene import Plane, SolveError

from ..grid import Grid
from ..problem import Problem
from .estimates import Friction, Lost

FITTED = Path(__file__).with_name("friction_error.csv")
# A change that vanishes by chance says little: none counts as less than this share of all together.
LEAST_SHARE = 0.03
LEAST_LAG = 3e-3  # below which what friction has beyond the first order in the speed does not show
LEAST = 1e-7  # change over friction: less is rounding, or the tolerance
MOST = 10.0  # change over friction: more is no more
OF_TOLERANCE = 3.0  # error of friction over the residual, at most
OF_TIP = 0.045  # error of friction over `at_tip`: 0.044 to 0.047 for cones on a Kelvin solid, on fine grids
UNCERTAIN = 0.5  # of friction: a solve fails where estimates differ by more, or the error may be more
SPARE, FARTHEST = 1.5, 8.0  # points over what the estimates ask for, and over those there are, at most


def on_grid(
    problem: Problem, grid: Grid, pressure: np.ndarray, residual: float, lost: Lost
) -> tuple[Friction, dict[str, float]]:
    """Friction from a pressure [Pa] of the shape of the grid, solved to a residual, and its measures by name.

    Raises SolveError as `bound` does.
    """
    friction, seen = estimated(problem, grid, pressure, lost)
    measures = friction.measures(float(pressure.sum() * grid.patch))
    if seen is not None:
        measures["friction_error"] = bound(seen, friction, grid.points, residual)
    return friction, measures


def estimated(problem: Problem, grid: Grid, pressure: np.ndarray, lost: Lost) -> tuple[Friction, "Signs | None"]:
    """Friction from a pressure, see `on_grid`, and the signs of its error; None without friction."""
    surface = problem.surface(grid)
    friction = Friction.of(problem, grid, pressure, surface, lost)
    if not friction.force:
        return friction, None
    wider = grid.coarser() if isinstance(problem.scene.indenter, Plane) else grid.wider()
    coarser = Friction.of(problem, wider, wider.averaged(pressure, grid), surface, lost)
    return friction, signs(problem, grid, friction, coarser, pressure > 0)


def bound(seen: "Signs", friction: Friction, points: int, residual: float) -> float:
    """Bound on the relative error of friction against the same surface on ever finer grids; it holds in 95 %.

    seen : signs of the error of this friction; points : along each side of its grid; residual : of the solve

    Raises SolveError where half of friction is not sure, as its estimates contradict one another, or more may be
    wrong.
    """
    weights = _fitted()[seen.kind]
    found = exp(sum(weights[name] * value for name, value in seen.numbers.items()))
    found += OF_TIP * seen.tip + OF_TOLERANCE * residual
    apart = friction.contradiction
    if max(apart, found) > UNCERTAIN:
        times = min(max(found, apart / (1 - min(apart, 0.9))) * SPARE, FARTHEST)
        raise SolveError(
            f"friction is uncertain on {points} points a side: its estimates differ by {apart:.0%} of it, and its "
            f"error may be {min(found, 99):.0%}; take about {ceil(times * points / 2) * 2} points, or a smaller "
            "extent"
        )
    return found


class Signs(NamedTuple):
    """Signs of an error: the kind of contact, which selects their weights, numbers by name, and `at_tip`."""

    kind: str
    numbers: Mapping[str, float]
    tip: float = 0.0


def signs(problem: Problem, grid: Grid, friction: Friction, coarser: Friction, touched: np.ndarray) -> Signs:
    """Signs of the error of friction.

    friction, coarser : by the same pressure, on the pixels of the grid and on pixels twice as wide
    touched : pixels in contact, bool, of the shape of the grid

    Logarithms of what friction changes by, as far as that counts, from one estimate to another and from the pixels
    to those twice as wide; and of how many pixels there are on what has to be resolved.
    """
    lag, slow, force = friction.lag, friction.slowness, friction.force
    fast = 1 - slow

    def change(weight, one, other):
        return (min(weight * abs((one - other) / force), MOST) if weight else 0.0) + LEAST

    changes = {
        "joined, on wider pixels": change(1.0, friction.joined(coarser), force),
        "traction, on wider pixels": change(fast * lag, coarser.by_traction, friction.by_traction),
        "loss, on wider pixels": change(fast * (1 - lag), coarser.by_loss, friction.by_loss),
        "curvature, on wider pixels": change(slow, coarser.by_curvature, friction.by_curvature),
        "traction to loss": change(lag, friction.by_traction, friction.by_loss),
        "work to loss": change(fast * (1 - lag), friction.by_work, friction.by_loss),
        "curvature to loss": change(slow, friction.by_curvature, friction.by_loss),
    }
    least = LEAST_SHARE * sqrt(sum(each**2 for each in changes.values()))
    changes["curvature to answer"] = change(1.0, friction.by_curvature, force)  # of a fast flow it shows the speed
    scene, waves = problem.scene, problem.points_per_wave(grid)
    across, smooth = log(grid.spot_radius(touched) / grid.pixel), isnan(waves)
    breadth = log(problem.flow.memory / problem.flow.lag_length)
    kind = f"{'smooth' if smooth else 'rough'}, {'slow' if slow > 1 / 2 else 'fast'}"
    return Signs(
        kind,
        {
            "one": 1.0,
            **{name: log(max(each, least)) for name, each in changes.items()},
            "points": log(np.count_nonzero(touched)),
            "spot": across,
            "spot, squared": across**2,
            "edge": across - log(getattr(scene.indenter, "exponent", 2.0)),
            "wave": 0.0 if smooth else log(waves),
            "trail": log(max(lag, LEAST_LAG)),
            "breadth": breadth,
            "breadth, squared": breadth**2,
            "lag": lag,
            "slowness": slow,
            "plane": float(isinstance(scene.indenter, Plane)),
        },
        at_tip(scene.indenter, grid, touched, lag),
    )


def at_tip(indenter, grid: Grid, touched: np.ndarray, lag: float) -> float:
    """Scale of the error that the pixels at a sharp tip leave; 0 without such a tip, or where it is free.

    At the tip of a body r^n the pressure on a viscous solid grows as r^(n - 2), and the friction within r as
    r^(2 n - 1): that is the order of the error in the pixel over the radius of contact, the first for a cone. The
    more a solid is glassy on a pixel, by the lag of the grid's shortest wave, the less there is of it.

    touched : pixels in contact, bool, of the shape of the grid
    """
    exponent, (x, y) = getattr(indenter, "exponent", 2.0), grid.places
    around = np.maximum(abs(x), abs(y)) < 1.1 * grid.pixel  # four pixels around a corner, or nine around a centre
    if exponent >= 2 or not touched[around].any():
        return 0.0
    radius = sqrt(np.count_nonzero(touched) / pi)  # of the contact [pixel]
    return lag / radius ** (2 * exponent - 1)


@cache
def _fitted() -> Mapping[str, Mapping[str, float]]:
    """Weights of the signs by name, for each kind of contact."""
    with FITTED.open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    return {kind: {row["sign"]: float(row[kind]) for row in rows} for kind in rows[0] if kind != "sign"}
