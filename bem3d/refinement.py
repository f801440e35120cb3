"""A contact of few small spots on pixels finer than any grid could hold, solved at the points of its spots alone.

Where next to nothing touches, a grid is empty pixels. Between points of contact the operator is a dense matrix,
taken from the kernel of a grid; where else they might touch is seen on the coarse grid and looked at on the fine
one.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from time import process_time

import numpy as np

from scene import Plane, Program, Result, SolveError
from scene.quantities import WHOLE, takes

from . import wake
from .friction import Friction, indenter_curvature
from .grid import Grid, Piece
from .problem import Problem

NEAR = 0.05  # of the depth below the lowest point: gaps on the coarse grid that the fine one may close
MOST = 16384  # points in contact, of which the matrix takes 2 GiB
ROWS = 512  # of the fine grid at a time, and points of a block of a matrix
ROUNDS = 100


@dataclass(frozen=True)
class _Points:
    """Some pixels of a grid: rows, columns, heights over the macroscopic tip and gaps expected there [m], (m,)."""

    row: np.ndarray
    column: np.ndarray
    height: np.ndarray
    gap: np.ndarray

    def __getitem__(self, chosen) -> "_Points":
        return _Points(self.row[chosen], self.column[chosen], self.height[chosen], self.gap[chosen])

    def within(self, others: "_Points") -> np.ndarray:
        """Whether each lies in one of some pixels twice as wide (m,)."""
        own, wide = (np.stack([each.row, each.column], axis=1) for each in (self, others))
        return np.isin((own // 2) @ [2**20, 1], wide @ [2**20, 1])


def _steps(times: int) -> list[int]:
    """Factors to refine by, one after the other. Raises ValueError for what is no power of two."""
    if times < 1 or times & (times - 1):
        raise ValueError(f"times = {times!r}: a power of two, as 1, 2, 4")
    return [2**k for k in range(1, times.bit_length())] or [1]


@takes(times=WHOLE)
def refined(solver, result: Result, times: int = 2) -> Result:
    """A steady contact on pixels `times` as fine, in the window in which it was solved.

    solver, result : the `BEM` that answered, and its answer with its fields
    times : a power of two

    The answer is that of `solver` on as many points, to its tolerance. Its fields are those of the points in
    contact: x, y [m] and pressure [Pa], (m,). Raises SolveError for programs, planes and lines, and where too much
    touches or comes close on the fine grid.
    """
    scene, started = result.scene, process_time()
    problem = Problem(scene, solver.engine, solver.terms)
    if isinstance(scene.motion, Program) or isinstance(scene.indenter, Plane) or problem.width is not None:
        raise SolveError("only steady contacts on a free surface are refined: take more points")
    x, y = result.fields["x"], result.fields["y"]
    pixel = float(x[-1] - x[0]) / (len(x) - 1)
    coarse = Grid(len(x), pixel * len(x), (float(x[0] + x[-1]) / 2, float(y[0] + y[-1]) / 2))
    fine, touching = coarse, None
    for factor in _steps(times):
        fine = replace(coarse, points=factor * coarse.points)
        near = _near(problem, coarse, fine, result, solver)
        begun = near.gap <= 0 if touching is None else near.within(touching)
        touching, pressure, depth, violation, rounds = _solved(problem, fine, near, begun, solver.tolerance)
    friction = _friction(problem, fine, touching, pressure)
    force = float(pressure.sum() * fine.patch)
    return Result(
        scene=scene,
        solver=solver.name,
        settings=solver.settings(problem, coarse) | {"points": fine.points},
        normal_force=force,
        depth=depth,
        friction_force=friction.force,
        residual=violation,
        applications=float(rounds),
        seconds=process_time() - started,
        measures={
            "pixel": fine.pixel,
            "contact_area": len(pressure) * fine.patch,
            "contact_points": float(len(pressure)),
            "points_per_shortest_wave": problem.points_per_wave(fine),
            **friction.measures(force),
            "rounds": float(rounds),
        },
        fields={"x": fine.x[touching.column], "y": fine.y[touching.row], "pressure": pressure},
    )


def _near(problem, coarse: Grid, fine: Grid, result: Result, solver) -> _Points:
    """Pixels of the fine grid where the surface, as the coarse one has it, comes close to the indenter."""
    lag, coarse_lag = (problem.flow.collocation(grid) for grid in (fine, coarse))
    gap = result.fields["gap"]
    indenter = wake.heights(solver, result.scene, coarse.x + coarse_lag, coarse.y)
    displacement = gap - indenter + result.depth
    seen = replace(coarse, centre=(coarse.centre[0] + coarse_lag, coarse.centre[1]))
    reach = NEAR * (result.depth - float(indenter.min()))
    surface, parts = problem.surface(fine), []
    for first in range(0, fine.points, ROWS):
        y = fine.y[first : first + ROWS]
        centre = fine.centre[0] + lag, float(y.mean())
        block = Piece(fine.points, fine.extent, centre, lines=len(y))
        height = problem.heights(block, surface)
        left = block.resample(displacement, seen) + height - result.depth
        row, column = np.nonzero(left < reach)
        parts.append((row + first, column, height[row, column], left[row, column]))
    return _Points(*map(np.concatenate, zip(*parts, strict=True)))


def _kernel(problem, grid):
    """Displacement by a loaded pixel (ny, 2 nx), that of the operator of the grid."""
    medium, flow = problem.medium, problem.flow
    if flow.at_rest:
        return medium.ground.elastic(grid)
    shift = flow.collocation(grid) / grid.pixel
    return medium.ground.flowing(grid, flow.instantaneous, flow.shares, flow.in_pixels(grid), shift)


def _between(kernel, at: _Points, loaded: _Points) -> np.ndarray:
    """Kernel from each of the loaded points to each other point (m, n)."""
    found = np.empty((len(at.row), len(loaded.row)))
    middle = kernel.shape[1] // 2
    for first in range(0, len(at.row), ROWS):
        part = slice(first, first + ROWS)
        aside = np.abs(at.row[part, None] - loaded.row)
        found[part] = kernel[aside, middle + at.column[part, None] - loaded.column]
    return found


def _solved(problem, grid, near, touches, tolerance):
    """Points in contact, their pressure [Pa], depth [m], violation and rounds.

    touches : the points with which to begin (m,), bool

    On a set of contact the pressure is exact. What pulls is dropped first, and what penetrates is added once
    nothing pulls.
    """
    motion, modulus, kernel = problem.scene.motion, problem.flow.modulus, _kernel(problem, grid)
    heights = near.height / grid.pixel
    lowest = heights.min(initial=np.inf)
    for rounds in range(1, ROUNDS + 1):
        where = np.flatnonzero(touches)
        if len(where) > MOST:
            raise SolveError(f"the contact covers {len(where)} pixels, {MOST} fit in a matrix: take more points")
        if not len(where):
            raise SolveError("nothing is left in contact: take a finer grid to begin with")
        own = near[where]
        matrix = _between(kernel, own, own)
        unit, lifted = np.linalg.solve(matrix, np.stack([np.ones(len(where)), heights[where]], axis=1)).T
        depth = (
            motion.depth / grid.pixel
            if motion.load is None
            else (motion.load / (modulus * grid.patch) + lifted.sum()) / unit.sum()
        )
        pressure = depth * unit - lifted
        if (pressure < 0).any():
            touches[where[pressure < 0]] = False
            continue
        gap = heights - depth
        for first in range(0, len(heights), ROWS):
            part = slice(first, first + ROWS)
            gap[part] += _between(kernel, near[part], own) @ pressure
        gap[where] = 0.0
        aim = tolerance * (depth - lowest)
        deepest = float(-gap.min())
        if deepest <= aim:
            _check_reach(near.gap, gap * grid.pixel)
            return own, pressure * modulus, depth * grid.pixel, max(deepest, 0.0) / aim * tolerance, rounds
        touches |= gap < -aim
    raise SolveError(f"after {ROUNDS} sets of contact {deepest / aim:.1e} times the tolerance is left")


def _check_reach(expected, gap):
    """Raise SolveError if gaps closed by so much that points beyond those looked at could touch."""
    closed, looked_at = float((expected - gap)[gap > 0].max(initial=0.0)), float(expected.max())
    if closed > looked_at:
        raise SolveError(
            f"gaps close by {closed:g} m on the fine grid, and only those up to {looked_at:g} m were looked at: "
            "begin with a finer grid"
        )


def _friction(problem, grid, touching, pressure) -> Friction:
    """Friction as `Friction` has it, work taken for loss, from the pressure [Pa] (m,) at the points in contact."""
    scene, flow, surface, force = problem.scene, problem.flow, problem.surface(grid), float(pressure.sum())
    x, y = grid.x[touching.column], grid.y[touching.row]

    slopes = scene.indenter.slope(x, y)
    curvatures = indenter_curvature(scene.indenter, x, y, grid.pixel)
    if surface is not None:
        slopes = slopes + _at(touching, grid, surface.slopes)
        curvatures = curvatures + _at(touching, grid, surface.curvatures)
    mean_curvature = float(pressure @ curvatures) / force
    loss = _lost(problem, grid, touching, pressure / flow.modulus) * flow.modulus * grid.patch
    return Friction(
        by_traction=float(-pressure @ slopes) * grid.patch,
        by_loss=loss,
        by_work=loss,
        by_curvature=flow.trail * mean_curvature * force * grid.patch,
        mean_curvature=mean_curvature,
        lag=flow.lag(grid),
        slowness=flow.slowness(grid),
    )


def _at(points: _Points, grid: Grid, evaluate: Callable[[np.ndarray, np.ndarray], np.ndarray]) -> np.ndarray:
    """Values (m,) at some pixels of what is evaluated on rows and columns."""
    rows, row = np.unique(points.row, return_inverse=True)
    columns, column = np.unique(points.column, return_inverse=True)
    found = np.empty(len(row))
    for first in range(0, len(rows), ROWS):
        values = evaluate(grid.x[columns], grid.y[rows[first : first + ROWS]])
        here = (row >= first) & (row < first + ROWS)
        found[here] = values[row[here] - first, column[here]]
    return found


def _lost(problem, grid, touching, pressure):
    """sum p dw/dx, as `HalfSpace.lost` by the slope of the displacement."""
    if problem.flow.at_rest:
        return 0.0
    shares, lengths = problem.medium._seen(grid)
    rates = shares / lengths
    kernel = problem.medium.ground.flowing(grid, rates.sum(), -rates, lengths, 0.0)
    return float(pressure @ (_between(kernel, touching, touching) @ pressure))
