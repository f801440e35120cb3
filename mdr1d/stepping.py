"""A step in time of a row of elements, each on its own, and how far an indenter sinks in it under a load.

Where an element touches at the end, its displacement is max(u, c), and its force increases with c.
"""

from math import inf
from typing import NamedTuple

import numpy as np

from .element import (
    GAINED,
    KEPT,
    NOWHERE,
    PUSH,
    compiled,
    faded,
    hold,
    land,
    landing,
    leave,
    relax,
    tabulate,
    total,
)

_MOST_STEPS = 1000
# Relative misfit of a load at which Newton stops, and a bracket that has nothing left inside.
_AIM, _CLOSE = 1e-13, 1e-15


class State(NamedTuple):
    """State: elements that touch (N,), stretches y (N, K) of those, smoothed forces r (N, Q) [m] of the rest."""

    touching: np.ndarray
    stretches: np.ndarray
    forces: np.ndarray


class Sums(NamedTuple):
    """Sums of a step over the elements, for stiffness 1.

    force : at the end of the step [m]
    impulse : int f dt [m s]
    drive : int g' f dt, the impulse along the flow [m s]
    work, heat : done on the elements, and lost in them [m^2]
    stored : in them at the end [m^2]
    touching : of those that touch then
    """

    force: float
    impulse: float
    drive: float
    work: float
    heat: float
    stored: float
    touching: int


class Step(NamedTuple):
    """What all elements share in a step, and room for one.

    duration : [s]; full : table of a contact that lasts; decay : of the free modes (Q,)
    part, ahead, pushes, fallen : room
    """

    duration: float
    full: np.ndarray
    decay: np.ndarray
    part: np.ndarray
    ahead: np.ndarray
    pushes: np.ndarray
    fallen: np.ndarray


@compiled
def _step(duration, solid):
    count, free = solid.times.size, solid.retarded.size
    full = np.empty((7, count))
    tabulate(duration, solid, full)
    decay = np.exp(-duration / solid.retarded)
    return Step(duration, full, decay, np.empty((7, count)), np.empty(count), np.empty(free), np.empty(free))


@compiled
def _follow(c, rate, touches, y, r, solid, step):
    """Move one element through a step in which c rises at a rate.

    Returns whether it touches at the end, its force there and how that grows with c there, if c starts as it
    does; int f dt; and the energy lost.
    """
    begin = heat = 0.0
    if touches:
        f, table = c + solid.drag * rate + total(solid.moduli, y), step.full
    else:
        pushes, u = step.pushes, 0.0
        for j in range(r.size):
            pushes[j] = solid.compliances[j] * r[j]
            u += pushes[j]
        u_end = faded(pushes, step.decay, step.fallen)
        c_end = c + rate * step.duration
        begin = landing(c, c_end, rate, step.duration, u, u_end, pushes, solid, step.decay)
        if begin == NOWHERE:
            return False, 0.0, 0.0, 0.0, relax(r, step.duration, solid)
        heat = relax(r, begin, solid)
        fall = 0.0
        for j in range(r.size):
            pushes[j] = solid.compliances[j] * r[j]
            fall += pushes[j] / solid.retarded[j]
        land(pushes, solid, y)
        f, table = solid.drag * (rate + fall), step.part
        c += rate * begin
        tabulate(step.duration - begin, solid, table)
    growth, left = 1.0 + solid.drag / step.duration, step.duration - begin
    for k in range(y.size):
        growth += solid.moduli[k] * (begin * table[KEPT, k] + left * table[GAINED, k]) / step.duration
    end, width, impulse, warmed = hold(f, c, rate, left, y, solid, table, step.part, step.ahead)
    heat += warmed
    if end > 0.0:
        return True, end, growth, impulse, heat
    leave(c + rate * width, y, solid, 0.0, r)
    return False, 0.0, 0.0, impulse, heat + relax(r, left - width, solid)


@compiled
def _stored(c, touches, y, r, solid):
    energy = c * c if touches else 0.0
    springs, stretches = (solid.moduli, y) if touches else (solid.compliances, r)
    for k in range(springs.size):
        energy += springs[k] * stretches[k] * stretches[k]
    return 0.5 * energy


@compiled
def advance(approaches, rates, slopes, duration, state, solid):
    """Move all elements through a step.

    approaches : c = d - g at its start (N,) [m]; rates : at which they rise (N,) [m/s]
    slopes : g' under each element (N,)
    state : is moved to the end of the step
    """
    step = _step(duration, solid)
    force = impulse = drive = work = heat = stored = 0.0
    count = 0
    for i in range(approaches.size):
        c, rate, y, r = approaches[i], rates[i], state.stretches[i], state.forces[i]
        # Untouched, and untouched it stays.
        if c <= 0.0 and c + rate * duration <= 0.0 and not state.touching[i] and not r.any():
            continue
        touches, f, _, pushed, lost = _follow(c, rate, state.touching[i], y, r, solid, step)
        state.touching[i] = touches
        force += f
        impulse += pushed
        drive += slopes[i] * pushed
        work += rate * pushed
        heat += lost
        stored += _stored(c + rate * duration, touches, y, r, solid)
        count += touches
    return force, impulse, drive, work, heat, stored, count


@compiled
def _ahead(approaches, rates, state, solid, step):
    """Part of the step ahead that does not depend on how far the indenter sinks in it.

    Of an element that touches, its force at the end without sinking, and how that grows; of a free one, its
    approach at the end over its displacement, and zero. Returns also how far the indenter sinks until the first of
    them presses at the end.
    """
    start, growth = np.empty(approaches.size), np.zeros(approaches.size)
    firm = 1.0 + solid.drag / step.duration + step.full[PUSH].sum()
    first = inf
    for i in range(approaches.size):
        rise = rates[i] * step.duration
        if state.touching[i]:
            start[i] = approaches[i] + firm * rise
            for k in range(solid.times.size):
                start[i] += solid.moduli[k] * state.stretches[i, k] * step.full[KEPT, k]
            growth[i] = firm
            first = min(first, -start[i] / firm)
        else:
            start[i] = approaches[i] + rise
            for j in range(solid.retarded.size):
                start[i] -= solid.compliances[j] * state.forces[i, j] * step.decay[j]
            first = min(first, -start[i])
    return start, growth, first


@compiled
def _carried(sunk, start, growth, approaches, rates, state, solid, step):
    """Force at the end of a step in which the indenter sinks so far, and how it grows with that."""
    y, r = np.empty(solid.times.size), np.empty(solid.retarded.size)
    force = slope = 0.0
    for i in range(approaches.size):
        if growth[i] > 0.0:
            f = start[i] + growth[i] * sunk
            if f > 0.0:
                force += f
                slope += growth[i]
        elif start[i] + sunk > 0.0:
            r[:] = state.forces[i]
            rate = rates[i] + sunk / step.duration
            _, f, more, _, _ = _follow(approaches[i], rate, False, y, r, solid, step)
            force += f
            slope += more
    return force, slope


@compiled
def sinking(load, guess, approaches, rates, duration, state, solid):
    """Depth [m] that the indenter sinks in a step for the elements to carry a load at its end.

    load : over stiffness and spacing of the elements [m]
    guess : to begin with [m]
    approaches, rates : as in `advance`, for an indenter that does not sink

    Returns it, and the misfit of the load [m]. The force increases with the depth: a bracket shrinks by Newton
    steps, or by halves where those are slow. The force of a dashpot begins with a jump where an element lands: a
    load within the jump makes it land at the very end and carry what is left. Without a load, the indenter follows
    the surface.
    """
    step = _step(duration, solid)
    start, growth, low = _ahead(approaches, rates, state, solid, step)
    if load == 0.0:
        return low, 0.0
    high = low + load  # one element alone carries at least what it is pressed in by
    sunk, before, misfit = min(max(guess, low), high), inf, inf
    for _ in range(_MOST_STEPS):
        force, slope = _carried(sunk, start, growth, approaches, rates, state, solid, step)
        misfit = force - load
        if abs(misfit) <= _AIM * load:
            break
        if misfit < 0.0:
            low = sunk
        else:
            high = sunk
        if high - low <= _CLOSE * (abs(low) + abs(high)):
            if solid.drag > 0.0:
                misfit = 0.0
            break
        more = -misfit / slope if slope > 0.0 else inf
        if not (low < sunk + more < high and abs(more) <= 0.5 * before):
            more = 0.5 * (low + high) - sunk
        sunk, before = sunk + more, abs(more)
    return sunk, misfit
