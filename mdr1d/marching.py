"""Marching in time through a program: an indenter over elements that stay where they are, a pixel apart.

In a step the depth changes linearly and the indenter stays between the same nodes of its profile, so that the
height over each element changes linearly, and it is followed exactly. A prescribed depth is linear between the
turns of its program, unless it oscillates: the history of each element is then without error. An oscillation of
the depth is followed by chords: its work and its loss are of second order in the step, and so is the force,
except with a dashpot, whose force is half a step late. A prescribed load is met once a step.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from math import expm1

import numpy as np

from scene import Program, SolveError
from scene.steps import Frames

from .element import Solid
from .indentation import ACCEPTED
from .modes import Modes
from .profile import Profile
from .stepping import State, Sums, advance, sinking
from .timeline import Timeline, timeline

# Relative misfit of the balance of energy that is still an answer; rounding of a million steps stays below.
_BALANCED = 1e-8


@dataclass(frozen=True)
class History:
    """A contact over time, for stiffness 1 per length: forces [m^2] and energies [m^3] over the relaxed modulus.

    time, path, depth : at the end of each step (S,); depth of the macroscopic tip
    force, length : of the contact then; length [m]
    speed : of each step (S,); less than zero backwards, as the path may be
    friction : -int g' f dx (S,), > 0 opposes a motion forwards, < 0 one backwards; mean over the last whole pixel
        slid, at rest and before there is one since the indenter last turned round over the step
    work, dissipated : done by the indenter and lost until then (S,); stored : then (S,), of an indenter that never
        turns back without the elements that it has left behind: what these hold counts as lost
    misfit : of the load, the greatest of all steps [m^2]
    reach : farthest from the axis that an element touched at the end of a step [m]
    x, heights, displacement, touching : of the elements at the end (N,), x from the axis of the indenter
    frames : fields at instants asked for, (F,) and (F, N); empty where none are
    """

    time: np.ndarray
    path: np.ndarray
    speed: np.ndarray
    depth: np.ndarray
    force: np.ndarray
    friction: np.ndarray
    length: np.ndarray
    work: np.ndarray
    dissipated: np.ndarray
    stored: np.ndarray
    misfit: float
    reach: float
    x: np.ndarray
    heights: np.ndarray
    displacement: np.ndarray
    touching: np.ndarray
    frames: Mapping[str, np.ndarray]


def march(program: Program, body: Profile, modes: Modes, modulus: float, steps: int, instants: int = 0) -> History:
    """March through a program on a profile.

    modulus : relaxed, of the foundation [Pa]
    steps : of the whole program, see `timeline`
    instants : at which the elements are kept, see `scene.steps`

    Raises SolveError where there are too many steps, the contact leaves the grid, or rounding spoils the answer.
    """
    line, row = timeline(program, body.pixel, steps), (_Returning if program.reverses else _Row)(body, modes)
    by_depth = program.pressed_by == "depth"
    press = _Depth(program) if by_depth else _Load(program, modes, modulus * body.pixel)
    frames = Frames(line.times[1:], program.duration, instants)
    depth = 0.0 if by_depth else body.lowest
    work = row.press_at_once(depth)
    rows, misfit, reach, lost = [], 0.0, 0.0, 0.0
    for k, duration in enumerate(np.diff(line.times)):
        lost += row.follow(line, k)
        rate, missed = press(row, depth, line.times[k], duration)
        sums = row.advance(depth, rate, duration)
        depth += rate * duration
        _check_inside(row, body, depth, line.times[k + 1])
        if k in frames:
            frames.keep(
                time=line.times[k + 1],
                depth=depth,
                x=row.x,
                profile=row.heights,
                displacement=row.displacement(depth),
                contact=row.state.touching,
            )
        misfit, reach = max(misfit, abs(missed)), max(reach, row.reach)
        work, lost = work + sums.work, lost + sums.heat
        rows.append((depth, sums.force, -sums.drive / duration, sums.touching, work, lost, sums.stored))
    if not by_depth:
        _check_met(misfit * body.pixel * modulus / program.greatest)
    depths, *totals = np.array(rows).T
    force, friction, length, work, dissipated, stored = body.pixel * np.array(totals)
    _check_balanced(work, dissipated, stored)
    return History(
        time=line.times[1:],
        path=program.path(line.times[1:]),
        speed=np.diff(program.path(line.times)) / np.diff(line.times),
        depth=program.prescribed(line.times[1:]) if by_depth else depths,
        force=force,
        friction=_over_pixels(friction, line),
        length=length,
        work=work,
        dissipated=dissipated,
        stored=stored,
        misfit=misfit * body.pixel,
        reach=reach,
        x=row.x,
        heights=row.heights,
        displacement=row.displacement(depth),
        touching=row.state.touching,
        frames=frames.handed_over(),
    )


def _over_pixels(friction, line: Timeline):
    """Friction of each step, averaged over the last whole pixel slid one way: within a pixel it has a ripple."""
    slid, place = line.end - line.begin, line.passed + line.end
    moving = np.flatnonzero(slid)
    turns = moving[1:][slid[moving[1:]] * slid[moving[:-1]] < 0]
    means = []
    for run in np.split(np.arange(len(slid)), turns):
        way = -1.0 if (slid[run] < 0).any() else 1.0
        start = way * (place[run[0]] - slid[run[0]])
        places = np.append(start, way * place[run])
        work = np.append(0.0, np.cumsum(friction[run] * way * slid[run]))
        whole = np.floor(places[1:])
        mean = np.interp(whole, places, work) - np.interp(whole - 1, places, work)
        means.append(np.where((slid[run] != 0) & (whole - 1 >= start), mean, friction[run]))
    return np.concatenate(means)


class _Row:
    """The elements between the nodes of a profile, one in each interval, and how it moves over them."""

    def __init__(self, body: Profile, modes: Modes):
        self._body, self._solid = body, Solid.of(modes)
        self._slopes = np.diff(body.heights) / body.pixel
        central = (self._slopes[1:] + self._slopes[:-1]) / 2
        self._at_nodes = np.concatenate([self._slopes[:1], central])
        count = len(self._slopes)
        self.state = State(
            np.zeros(count, np.bool_),
            np.zeros((count, len(modes.moduli))),
            np.zeros((count, len(modes.compliances))),
        )
        self._passed, self._place, self._moved = 0, 0.0, 0.0

    @property
    def x(self):
        """Coordinates of the elements [m]."""
        return self._body.x[:-1] + self._place * self._body.pixel

    @property
    def heights(self):
        """g over them [m]."""
        return self._body.heights[:-1] + self._place * self._body.pixel * self._slopes

    @property
    def reach(self):
        """Largest distance from the axis at which an element touches [m]."""
        touching = np.flatnonzero(self.state.touching)
        return float(np.abs(self.x[touching[[0, -1]]]).max()) if len(touching) else 0.0

    def displacement(self, depth):
        """u [m] at a depth."""
        free = self.state.forces @ self._solid.compliances
        return np.where(self.state.touching, depth - self.heights, free)

    def press_at_once(self, depth):
        """Press undisturbed elements in to a depth, in no time. Returns the work against springs [m^2]."""
        pressed = np.maximum(depth - self.heights, 0.0)
        self.state.touching[:] = pressed > 0
        self.state.stretches[:] = pressed[:, None]
        return (1 + self._solid.moduli.sum()) * float(pressed @ pressed) / 2

    def follow(self, line: Timeline, k):
        """Begin a step of a timeline. Returns the energy in the elements that leave with it [m^2]."""
        left = 0.0
        while self._passed < line.passed[k]:
            left += float(self._solid.compliances @ self._shifted(1, 0.0) ** 2) / 2
        self._place, self._moved = line.begin[k], line.end[k] - line.begin[k]
        return left

    def _shifted(self, way, entering):
        """Move on by a pixel, forwards or backwards, and take in a free element.

        entering : its smoothed forces (Q,), which are returned of the element that leaves
        """
        into, out = (0, -1) if way > 0 else (-1, 0)
        leaving = self.state.forces[out].copy()
        for values in self.state:
            before, after = (values[:-1], values[1:]) if way > 0 else (values[1:], values[:-1])
            after[:] = before
            values[into] = 0
        self.state.forces[into] = entering
        self._passed += way
        return leaving

    def rates(self, depth_rate, duration):
        """Rates at which d - g rises over the elements (N,) [m/s]."""
        return depth_rate - self._moved * self._body.pixel / duration * self._slopes

    def sinking(self, load, guess, depth, duration, until):
        """See `sinking`; load over stiffness and pixel [m], at a time `until` of the step."""
        rates = self.rates(0.0, duration)
        return sinking(load, guess, depth - self.heights, rates, until, self.state, self._solid)

    def advance(self, depth, depth_rate, duration) -> Sums:
        """Advance to the end of the step."""
        slopes = self._at_nodes if self._moved == 0 and self._place in (0, 1) else self._slopes
        approaches, rates = depth - self.heights, self.rates(depth_rate, duration)
        sums = advance(approaches, rates, slopes, duration, self.state, self._solid)
        self._place += self._moved
        return Sums(*sums)


class _Returning(_Row):
    """Row under an indenter that comes back: elements left behind recover freely, and are met again."""

    def __init__(self, body: Profile, modes: Modes):
        super().__init__(body, modes)
        # Forces of what left forwards and backwards, and when: the last to leave is the first to come back.
        self._behind: dict[int, list] = {1: [], -1: []}
        self._energies = np.zeros(len(modes.compliances))  # of all of them, in each mode

    def follow(self, line: Timeline, k):
        """Begin a step, as `_Row` does; nothing is lost with elements that leave."""
        solid, now = self._solid, line.times[k]
        while self._passed != line.passed[k]:
            way = 1 if self._passed < line.passed[k] else -1
            entering = np.zeros(len(self._energies))
            if self._behind[-way]:
                forces, since = self._behind[-way].pop()
                entering = forces * np.exp(-(now - since) / solid.retarded)
            leaving = self._shifted(way, entering)
            self._behind[way].append((leaving, now))
            self._energies += solid.compliances * (leaving**2 - entering**2) / 2
        return super().follow(line, k)

    def advance(self, depth, depth_rate, duration) -> Sums:
        """Advance to the end of the step, as `_Row` does, with the elements left behind."""
        sums, before = super().advance(depth, depth_rate, duration), self._energies.sum()
        self._energies *= np.exp(-2 * duration / self._solid.retarded)
        stored = self._energies.sum()
        return sums._replace(heat=sums.heat + before - stored, stored=sums.stored + stored)


class _Depth:
    """Rate at which the indenter sinks by a program of depths."""

    def __init__(self, program: Program):
        self._program = program

    def __call__(self, row: _Row, depth, start, duration):
        """Rate [m/s] of a step, and the misfit of the load: none."""
        return float(self._program.prescribed(start + duration) - depth) / duration, 0.0


class _Load:
    """Rate at which the indenter sinks by a program of loads.

    The load is met at the end of a step. A dashpot responds to the rate, and the rate of a step belongs to its
    middle: with a dashpot, the load is met at the part 1/(1 - exp(-z)) - 1/z of a step of z = duration/T, so that
    a linear depth creeps as far as in truth. T is the retardation time of the dashpot with all springs.
    """

    def __init__(self, program: Program, modes: Modes, stiffness):
        self._program, self._stiffness, self._rate = program, stiffness, 0.0
        self._yielding = (1 + modes.moduli.sum()) / modes.drag if modes.drag else np.inf

    def __call__(self, row: _Row, depth, start, duration):
        """Rate [m/s] of a step, and the misfit of the load over stiffness and pixel [m]."""
        until = _place(duration * self._yielding) * duration
        load = float(self._program.prescribed(start + until)) / self._stiffness
        sunk, misfit = row.sinking(load, self._rate * until, depth, duration, until)
        self._rate = sunk / until
        return self._rate, misfit


def _place(z):
    """1/(1 - exp(-z)) - 1/z, from 1/2 to 1; by series where that cancels."""
    return 0.5 + z / 12 if z < 1e-3 else -1 / expm1(-z) - 1 / z


def _check_met(misfit):
    """Raise SolveError where rounding keeps the load from being met; misfit : relative, of the load."""
    if not misfit <= ACCEPTED:
        raise SolveError(
            f"a load of the program is met only to a relative {misfit:.1e} of the greatest: the lengths or "
            "times of the scene differ by more than rounding allows; prescribe the depth"
        )


def _check_balanced(work, dissipated, stored):
    """Raise SolveError where rounding costs the balance of energy."""
    most = max(np.abs(work).max(), dissipated.max(), stored.max())
    missed = np.abs(stored + dissipated - work).max()
    if not missed <= _BALANCED * most:
        raise SolveError(
            f"work, stored energy and loss balance only to a relative {missed / most:.1e}: "
            "the lengths or times of the scene differ by more than rounding allows"
        )


def _check_inside(row, body, depth, time):
    """Raise SolveError where the contact has left the grid, or may have."""
    if depth > body.rim or row.state.touching[[0, -1]].any():
        raise SolveError(
            f"{time:g} s into the program the contact leaves the grid, whose extent is "
            f"{body.x[-1] - body.x[0]:g} m: take a larger extent"
        )
