"""Marching in time through a program of loads or depths, at rest or sliding: one elastic contact a step.

The pressure is constant in a step. Within it, the surface responds like a stiffer half-space, displaced already
by what the material remembers, so each step is a symmetric problem of contact. The gap is collocated where a
pressure held in steps displaces as a smooth one would (see `Creep.collocation`): forces are of second order in
the step where they are smooth, and friction, which is all delay, keeps its digits however short the memory.

The window is attached to the material and is shifted by whole pixels as the indenter moves on.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import pairwise

import numpy as np

from scene import Plane, Program, SolveError
from scene.steps import Frames

from ..contact import activeset
from ..grid import Grid
from ..problem import Problem
from ..window import check_on_map
from .material import Creep, Material
from .timeline import in_a_pixel, timeline
from .upstream import Endless, Repeating, Returning, Sheet

ROUNDING = 1e-12  # of depth, height and memory where they overlap most: an overlap of less is none
FIRST = 1 / 64  # of the window that a load is guessed to touch first
YIELDING = 0.6  # of a step: a solid collocated later than that has little stiffness at once
KEPT = 2**23  # values of heights and slopes at places within a pixel, at most


@dataclass(frozen=True)
class History:
    """A contact over time, arrays (steps,) in SI units.

    time, path, speed : in the middle of each step; less than zero backwards
    depth : there; NaN where nothing touches at a load of zero
    normal_force, contact_area : of the step
    friction_by_traction : pressure times the indenter's slope, > 0 opposes a motion forwards, < 0 one backwards
    power : of the pressure on the delayed part of the displacement; in steady sliding friction times speed,
        otherwise what is stored and the motion in depth count as well
    residual, rounds : of each contact, see `contact`
    pressure, gap, displacement : in the last step (ny, nx), the last of the surface
    offset : by which the pixels' centres are downstream of those of the grid where they are seen
    frames : fields at instants asked for, (F,) and (F, ny, nx); empty where none are
    """

    time: np.ndarray
    path: np.ndarray
    speed: np.ndarray
    depth: np.ndarray
    normal_force: np.ndarray
    friction_by_traction: np.ndarray
    power: np.ndarray
    contact_area: np.ndarray
    residual: np.ndarray
    rounds: np.ndarray
    pressure: np.ndarray
    gap: np.ndarray
    displacement: np.ndarray
    offset: float
    frames: Mapping[str, np.ndarray]

    @property
    def friction_by_work(self) -> np.ndarray:
        """power / speed [N], a second estimate of steady friction, of the same sign; NaN at rest."""
        moving = self.speed != 0
        return np.where(moving, self.power / np.where(moving, self.speed, 1.0), np.nan)


def march(
    problem: Problem, program: Program, grid: Grid, tolerance: float, steps: int, instants: int = 0
) -> History:
    """March through a program on a grid.

    problem : the same scene with the motion `program.held`
    tolerance : of each contact, see `contact`
    steps : of the whole program, see `timeline`
    instants : at which the contact is kept, see `scene.steps`

    Raises SolveError where there are too many steps, a contact does not converge or it reaches the grid's edge.
    """
    times = timeline(program, grid.pixel, steps)
    frames = Frames((times[1:] + times[:-1]) / 2, program.duration, instants)
    body = _Body(problem, grid, places(program, grid, steps))
    material, press = _material(problem, program, grid), _Press(problem, program, grid)
    touch, rows = _Touch.nothing(np.zeros(grid.shape)), []
    turns = program.turns
    for k, (start, end) in enumerate(pairwise(times)):
        middle, step = (start + end) / 2, end - start
        seen = material.creep.collocation(step)
        if seen > YIELDING * step and (start in turns or end in turns):
            seen = step  # the pressure jumps: seen earlier, the surface would be thrown off the indenter by then
        guess = np.roll(touch.pressure, material.follow(program.path(middle), start), axis=1)
        at = material.offset(program.path(start + seen))
        heights, remembered = body.heights(at), material.remembered(seen)
        compliance = material.creep.compliance(seen)
        touch = press(heights, remembered, compliance, guess, tolerance, start + seen, middle)
        if k in frames:
            fields = _fields(problem, remembered, touch)
            frames.keep(time=start + seen, depth=touch.depth, shift=at, **fields)
        slopes = body.slopes(material.offset(program.path(middle)))
        work = material.crept(step, touch.pressure, touch.displacement / compliance)
        rows.append((start + seen, *touch.sums(slopes), work / step))
    press.count()
    end = _fields(problem, remembered, touch) | {"gap": touch.gap, "offset": float(at)}
    return _history(problem, program, grid, times, np.array(rows), frames, end)


def _material(problem, program, grid):
    creep = Creep.of(problem.scene.solid)
    window = Sheet(grid, len(creep.times))
    if isinstance(problem.scene.indenter, Plane):
        return Material(creep, Repeating(window))

    def half_space(sheet):
        operator = problem.medium.operator(sheet)
        return lambda pressure: operator(pressure) * sheet.pixel

    if program.reverses:
        return Material(creep, Returning(window, program.span, half_space, creep.kept))
    return Material(creep, Endless(window, program.span, half_space))


def places(program: Program, grid: Grid, steps: int) -> int:
    """Number of places within a pixel at which heights or slopes are kept.

    Steps that pass a pixel in equal parts come back to the same places, as many for heights as for slopes; at
    rest there is one of each. If a pixel has more than KEPT allows, only two are kept: otherwise the place needed
    next would always have been dropped just before.
    """
    wanted = 2 * in_a_pixel(program, grid.pixel, steps)
    return wanted if wanted * grid.points * grid.rows <= KEPT else 2


class _Body:
    """The indenter over the material, evaluated once for each place within a pixel.

    kept : how many places
    """

    def __init__(self, problem, grid, kept):
        self._problem, self._grid, self._surface = problem, grid, problem.surface(grid)
        self._at = lru_cache(kept)(self._evaluated)

    def heights(self, offset):
        """z [m] at the points of the grid, moved downstream by an offset [m]."""
        return self._at(self._problem.heights, round(offset / self._grid.pixel, 9))

    def slopes(self, offset):
        """dz/dx at the same points."""
        return self._at(self._problem.slopes, round(offset / self._grid.pixel, 9))

    def _evaluated(self, of, pixels):
        x, y = self._grid.centre
        return of(replace(self._grid, centre=(x + pixels * self._grid.pixel, y)), self._surface)


@dataclass(frozen=True)
class _Touch:
    """A contact: pressure over E*, displacement by it and gap [m] (ny, nx), depth [m], and its effort."""

    pressure: np.ndarray
    displacement: np.ndarray
    gap: np.ndarray
    depth: float = np.nan
    violation: float = 0.0
    rounds: int = 0

    @classmethod
    def nothing(cls, gap, depth=np.nan) -> "_Touch":
        """The indenter, clear of the surface."""
        return cls(np.zeros(gap.shape), np.zeros(gap.shape), gap, depth)

    def sums(self, slopes):
        """Numbers of the contact that a history keeps."""
        traction = -np.sum(self.pressure * slopes)
        count = np.count_nonzero(self.pressure)
        return self.depth, self.pressure.sum(), traction, count, self.violation, self.rounds


class _Press:
    """One contact after the other between a program's indenter and one half-space."""

    def __init__(self, problem, program, grid):
        self._problem, self._program, self._grid = problem, program, grid
        self._operator = problem.medium.operator(grid)
        self._preconditioner = problem.medium.preconditioner(grid)

    def __call__(self, body, remembered, compliance, guess, tolerance, seen, middle):
        """The contact at the depth of the time `seen`, or under the load in the `middle` of the step [s].

        body, remembered : heights of the indenter, and what is left of the surface's displacement [m] (ny, nx)
        compliance : over the relaxed one; guess : a pressure to begin with (ny, nx)
        """
        program, pixel, heights = self._program, self._grid.pixel, body + remembered
        if program.pressed_by == "depth":
            load, depth = None, float(program.prescribed(seen))
            lowest = heights.argmin()
            known = depth + abs(body.flat[lowest]) + abs(remembered.flat[lowest])
            if depth - heights.flat[lowest] <= ROUNDING * known:
                return _Touch.nothing(heights - depth, depth)
        else:
            load, depth = self._load(middle), None
            if load == 0:
                return _Touch.nothing(np.full(heights.shape, np.nan))
        # A half-space that is c times as compliant under p is the relaxed one under c p.
        start = compliance * guess if guess.any() else _overlap(heights, depth) / pixel
        found = self._solved(
            heights / pixel, start, tolerance, depth and depth / pixel, load and compliance * load, middle
        )
        touch = _Touch(
            found.pressure / compliance,
            found.displacement * pixel,
            found.gap * pixel,
            found.depth * pixel,
            found.violation,
            found.rounds,
        )
        self._check_edge(touch.pressure, middle)
        return touch

    def count(self):
        """Add the effort of all contacts to the counts of the problem."""
        problem, points = self._problem, self._grid.points * self._grid.rows
        problem.work += self._operator.operator_applications * points
        problem.transforms += (
            self._operator.operator_applications + self._preconditioner.operator_applications
        ) * points

    def _load(self, time):
        """Sum of the pressure over E* on all pixels."""
        grid, value = self._grid, float(self._program.prescribed(time)) / self._problem.flow.modulus
        return value * grid.points * grid.rows if self._program.pressed_by == "pressure" else value / grid.patch

    def _solved(self, heights, start, tolerance, depth, load, time):
        try:
            return activeset.solve(
                self._operator,
                heights,
                start,
                tolerance,
                depth=depth,
                load=load,
                precondition=self._preconditioner,
                symmetric=True,
            )
        except activeset.NotConverged as error:
            raise SolveError(f"{time:g} s into the program: {error}; take more steps") from error

    def _check_edge(self, pressure, time):
        grid = self._grid
        check_on_map(self._problem.scene, grid, pressure > 0)
        if not isinstance(self._problem.scene.indenter, Plane) and grid.on_rim(pressure > 0):
            raise SolveError(
                f"{time:g} s into the program the contact reaches the edge of extent = {grid.extent:g} m; "
                "take a larger extent"
            )


def _overlap(heights, depth):
    """First pressure, in proportion to the overlap; without a depth, on some of the lowest points."""
    if depth is None:
        return activeset.first_guess(heights, int(heights.size * FIRST) + 1)
    return np.maximum(depth - heights, 0.0)


def _fields(problem, remembered, touch):
    """Pressure [Pa], and displacement of the surface [m] (ny, nx)."""
    return {
        "pressure": problem.flow.modulus * touch.pressure,
        "displacement": remembered + touch.displacement,
    }


def _history(problem, program, grid, times, rows, frames, end):
    """History of the contact in SI units, with its fields at the end."""
    seen, depth, pressure, traction, count, violation, rounds, power = rows.T
    middle, force = (times[1:] + times[:-1]) / 2, problem.flow.modulus * grid.patch
    depth_given = program.pressed_by == "depth"
    return History(
        time=middle,
        path=program.path(middle),
        speed=np.diff(program.path(times)) / np.diff(times),
        depth=program.prescribed(middle) if depth_given else _back(seen, depth, middle),
        normal_force=force * pressure,
        friction_by_traction=force * traction,
        power=force * power,
        contact_area=grid.patch * count,
        residual=violation,
        rounds=rounds.astype(int),
        frames=frames.handed_over(),
        **end,
    )


def _back(seen, depth, middle):
    """Depth in the middle of each step, interpolated from the times at which the gap was measured."""
    seen_before, before = np.roll(seen, 1), np.roll(depth, 1)
    before[0] = np.nan
    between = depth + (before - depth) * (seen - middle) / (seen - seen_before)
    return np.where(np.isnan(before), depth, between)
