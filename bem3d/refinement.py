"""A contact of few small spots, solved on very fine pixels at the points of its spots alone.

Where next to nothing touches, a grid is empty pixels. Between points of contact the operator is a dense matrix,
taken from the kernel of a grid; where else they might touch is seen on the coarse grid and looked at on the fine
one.
"""

from dataclasses import dataclass, replace
from functools import partial
from time import process_time

import numpy as np

from scene import Cylinder, Plane, Program, Refused, Result, SolveError
from scene.protocol import numeric_guard
from scene.quantities import WHOLE, takes
from scene.terms import terms_of, wrap_solve

from . import window
from .friction import bound
from .grid import Grid, Piece
from .measures import measured
from .motion import wake
from .problem import Problem
from .spots import ROWS, Spots

NEAR = 0.05  # of the depth below the lowest point: gaps on the coarse grid that the fine one may close
MOST = 16384  # points in contact: their matrix takes 2 GiB
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

    The answer is the one that `solver` would give on as many points, to its tolerance, with all that the parts of
    the scene add. Its fields are those of the points in contact: x, y [m] and pressure [Pa], (m,), and tractions
    and slip under a Shear. Raises Refused for programs, planes and lines, and SolveError where too much touches
    or comes close on the fine grid.
    """
    steps = _steps(times)
    if reasons := _refusals(result):
        raise Refused(f"this answer cannot be refined: {'; '.join(reasons)}")
    heating = result.scene.heating
    # As warm as its friction makes it on fine pixels: a contact solved on coarse ones is another one.
    fields = None if heating is not None and heating.feedback is not None else result.fields

    def answered(scene):
        return _refined(solver, scene, _grid_of(result.fields), fields, steps)

    with numeric_guard():
        return wrap_solve(answered, terms_of(solver.terms, result.scene))(result.scene)


def _refusals(result):
    """Reasons why an answer has no points of contact that could be solved alone."""
    reasons, scene, fields = [], result.scene, result.fields
    if isinstance(scene.motion, Program):
        reasons.append("motion = Program: a history is no single contact, take more points")
    if isinstance(scene.indenter, Plane):
        reasons.append("indenter = Plane: its surface repeats, take more points")
    if isinstance(scene.indenter, Cylinder):
        reasons.append("indenter = Cylinder: a line is one row of pixels already, take more points")
    if not {"x", "y", "pressure", "gap"} <= fields.keys() or np.ndim(fields["gap"]) != 2:
        reasons.append("result.fields: no pressure and gap on a grid, take those of BEM.solve")
    return reasons


def _refined(solver, scene, coarse, fields, steps):
    """The refined answer, from fields on the coarse grid; without fields, they are solved first."""
    started, problem = process_time(), Problem(scene, solver.engine, solver.terms)
    around = wake.surroundings(solver, scene, fields or _fields(problem, coarse, solver.tolerance))
    fine, touching = coarse, None
    for factor in steps:
        fine = replace(coarse, points=factor * coarse.points)
        near = _near(problem, coarse, fine, around)
        begun = near.gap <= 0 if touching is None else near.within(touching)
        touching, pressure, depth, violation, rounds = _solved(problem, fine, near, begun, solver.tolerance)
    spots, force = Spots.of(fine, touching.row, touching.column), float(pressure.sum() * fine.patch)
    window.check(scene, spots, pressure > 0)
    friction, estimates = bound.on_grid(problem, spots, pressure, violation, partial(_lost, problem))
    found = Result(
        scene=scene,
        solver=solver.name,
        settings=solver.settings(problem, coarse) | {"points": fine.points},
        normal_force=force,
        depth=depth,
        friction_force=friction.force,
        residual=violation,
        operator_applications=float(rounds),
        seconds=process_time() - started,
        measures={
            **measured(problem, spots, pressure, np.zeros(spots.shape)),
            **estimates,
            "rounds": float(rounds),
            "transform_pairs": float(rounds),
        },
        fields={"x": spots.x, "y": spots.y, "pressure": pressure},
    )
    return problem.completed(found, spots)


def _grid_of(fields):
    x, y = fields["x"], fields["y"]
    pixel = float(x[-1] - x[0]) / (len(x) - 1)
    return Grid(len(x), pixel * len(x), (float(x[0] + x[-1]) / 2, float(y[0] + y[-1]) / 2))


def _fields(problem, grid, tolerance):
    """Fields of the contact on a grid."""
    answer = problem.solve(grid, tolerance)
    pressure, gap = answer.pressure * problem.flow.modulus, answer.gap * grid.pixel
    return {"x": grid.x, "y": grid.y, "pressure": pressure, "gap": gap}


def _near(problem, coarse: Grid, fine: Grid, around: wake.Surroundings) -> _Points:
    """Pixels of the fine grid where the surface, as the coarse one has it, comes close to the indenter."""
    lag, depth = problem.flow.collocation(fine), around.depth
    seen = replace(coarse, centre=(coarse.centre[0] + around.lag, coarse.centre[1]))
    reach = NEAR * (depth - float(around.indenter.min()))
    surface, parts = problem.surface(fine), []
    for first in range(0, fine.points, ROWS):
        y = fine.y[first : first + ROWS]
        centre = fine.centre[0] + lag, float(y.mean())
        block = Piece(fine.points, fine.extent, centre, lines=len(y))
        height = problem.heights(block, surface)
        left = block.resample(around.displacement, seen) + height - depth
        row, column = np.nonzero(left < reach)
        parts.append((row + first, column, height[row, column], left[row, column]))
    return _Points(*map(np.concatenate, zip(*parts, strict=True)))


def _kernel(problem, grid):
    """Displacement by a loaded pixel (ny, 2 nx), as in the operator of the grid."""
    medium, flow = problem.medium, problem.flow
    if flow.at_rest:
        return medium.kernel.elastic(grid)
    shift = flow.collocation(grid) / grid.pixel
    return medium.kernel.flowing(grid, flow.instantaneous, flow.shares, flow.in_pixels(grid), shift)


def _between(kernel, at: _Points | Spots, loaded: _Points | Spots, ahead: int = 0) -> np.ndarray:
    """Kernel from each of the loaded points to each other point (m, n), or to `ahead` pixels downstream of it."""
    found = np.empty((len(at.row), len(loaded.row)))
    middle = kernel.shape[1] // 2
    for first in range(0, len(at.row), ROWS):
        part = slice(first, first + ROWS)
        aside = np.abs(at.row[part, None] - loaded.row)
        found[part] = kernel[aside, middle + ahead + at.column[part, None] - loaded.column]
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


def _lost(problem, spots: Spots, pressure):
    """Energy lost per length slid under a pressure [Pa] (m,), see `Problem.lost`."""
    if problem.flow.at_rest:
        return 0.0, 0.0
    shares, lengths = problem.medium._seen(spots)
    rates, reach = shares / lengths, spots.reach + 1
    wide, flowing = Piece(reach, reach * spots.pixel, lines=reach), problem.medium.kernel.flowing
    pushed = pressure / problem.flow.modulus

    def moved(kernel, ahead=0):
        return _between(kernel, spots, spots, ahead) @ pushed

    loss = pressure @ moved(flowing(wide, rates.sum(), -rates, lengths, 0.0))
    kernel = flowing(wide, 0.0, shares, lengths, 0.0)
    work = pressure @ (moved(kernel, 1) - moved(kernel, -1)) / 2
    return float(loss * spots.patch), float(work * spots.patch)
