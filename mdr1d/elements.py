"""Elements of a foundation in time, each on its own under a height that changes linearly within a step; exact.

In units of the relaxed stiffness, with c = d - g, an element displaced by u carries

    f = u + D u' + sum_k K_k y_k,   y_k' = -y_k/m_k + u',   where it touches: u = c, f >= 0;
    u = sum_j J_j r_j,   r_j' = (f - r_j)/l_j,   where it is free: f = 0, so that r_j >= 0 decays as exp(-t/l_j):

the two phases of the steady flow in `maxwell`, with time in place of the way along it. As there, an element lands
once at most in a step, and after a release not at all; held on to a height that changes linearly its force changes
its sign once at most, so that its sign at the end tells whether there is a release.

Where an element touches at the end, its force there is that of the displacement max(u, c) and increases with c.
"""

from math import exp, expm1, inf
from typing import NamedTuple

import numpy as np

from .foundation import NOWHERE, compiled
from .modes import Modes

# What is compiled stays in one file: numba's cache of a function does not see a change of another file.
_MOST_STEPS = 1000
# Relative misfit of a load at which Newton stops, and a bracket that has nothing left inside.
_AIM, _CLOSE = 1e-13, 1e-15
# Rows of the table of factors: what a stretch of contact does to a branch.
_KEPT, _LOST, _MEAN, _RAMP, _HEAT = range(5)


class Solid(NamedTuple):
    """The modes of a solid, see `Modes`; times in seconds."""

    moduli: np.ndarray
    times: np.ndarray
    drag: float
    compliances: np.ndarray
    retarded: np.ndarray
    exchange: np.ndarray

    @classmethod
    def of(cls, modes: Modes) -> "Solid":
        return cls(
            modes.moduli,
            modes.relaxation_times,
            float(modes.drag),
            modes.compliances,
            modes.retardation_times,
            modes.exchange,
        )


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


@compiled
def _factors(width, times, table):
    """Fill the table for z = width/times: e = exp(-z), 1 - e, their means M = (1 - e)/z, R = (1 - M)/z, and
    z int_0^1 [int_0^t exp(-zs) ds]^2 dt, by series where these cancel."""
    for k in range(times.size):
        z = width / times[k]
        table[_KEPT, k] = exp(-z)
        table[_LOST, k] = lost = -expm1(-z)
        if z < 0.5:
            mean = ramp = heat = 0.0
            term, power = 1.0, 2.0  # (-z)^n / (n + 1)!, 2^(n + 1)
            for n in range(20):
                mean += term
                ramp += term / (n + 2)
                heat += z * term * (2.0 * power - 2.0) / ((n + 2) * (n + 3))
                term *= -z / (n + 2)
                power *= 2.0
        else:
            mean = lost / z
            ramp = (1.0 - mean) / z
            heat = (1.0 - mean * (1.0 + 0.5 * lost)) / z
        table[_MEAN, k] = mean
        table[_RAMP, k] = ramp
        table[_HEAT, k] = heat


@compiled
def _landing(clearance, rate, r, solid, width):
    """Time at which the free surface meets c, rising at a rate from a clearance below it; NOWHERE beyond width.

    The clearance is convex: Newton from the left never oversteps.
    """
    t = 0.0
    for _ in range(_MOST_STEPS):
        now, opening = clearance - rate * t, -rate
        for j in range(r.size):
            push = solid.compliances[j] * r[j]
            now += push * expm1(-t / solid.retarded[j])
            opening -= push / solid.retarded[j] * exp(-t / solid.retarded[j])
        if now <= 0.0:
            break
        if opening >= 0.0 or t - now / opening > width:
            return NOWHERE
        if t - now / opening == t:
            break
        t -= now / opening
    return t


@compiled
def _release(f, rate, y, solid, width):
    """Time at which the force f(t) of an element falls to zero; it is negative after the width.

    f(t) = f + rate t + sum_k b_k (exp(-t/m_k) - 1), b_k = K_k (y_k - m_k rate). A bracket shrinks by Newton steps,
    or by halves where those are slow.
    """
    if f < 0.0:
        return 0.0
    positive, negative = 0.0, width
    t, before = width, inf
    for _ in range(_MOST_STEPS):
        now, slope = f + rate * t, rate
        for k in range(y.size):
            b = solid.moduli[k] * (y[k] - solid.times[k] * rate)
            now += b * expm1(-t / solid.times[k])
            slope -= b / solid.times[k] * exp(-t / solid.times[k])
        if now == 0.0:
            break
        if now > 0.0:
            positive = t
        else:
            negative = t
        step = -now / slope if slope < 0.0 else inf
        if not (positive <= t + step <= negative and abs(step) <= 0.5 * before):
            step = 0.5 * (positive + negative) - t
        if t + step == t:
            break
        t, before = t + step, abs(step)
    return t


@compiled
def _relax(r, apart, solid):
    """Move r to the end of a free stretch. Returns the energy lost in it."""
    heat = 0.0
    for j in range(r.size):
        if r[j] > 0.0:
            heat -= 0.5 * solid.compliances[j] * r[j] * r[j] * expm1(-2.0 * apart / solid.retarded[j])
            r[j] *= exp(-apart / solid.retarded[j])
    return heat


@compiled
def _hold(c, rate, width, y, solid, table):
    """Move y to the end of a stretch of contact. Returns int f dt, and the energy lost in it."""
    rise = rate * width
    mean, heat = c + 0.5 * rise + solid.drag * rate, solid.drag * rate * rise
    for k in range(y.size):
        kept, lost, average = table[_KEPT, k], table[_LOST, k], table[_MEAN, k]
        mean += solid.moduli[k] * (y[k] * average + rise * table[_RAMP, k])
        heat += solid.moduli[k] * (
            y[k] * (y[k] * lost * (1.0 - 0.5 * lost) + rise * average * lost) + rise * rise * table[_HEAT, k]
        )
        y[k] = y[k] * kept + rise * average
    return width * mean, heat


@compiled
def _land(r, solid, y):
    """Write the stretches y of a free state. Returns how fast its surface falls."""
    y[:] = 0.0
    fall = 0.0
    for j in range(r.size):
        push = solid.compliances[j] * r[j]
        fall += push / solid.retarded[j]
        for k in range(y.size):
            y[k] -= solid.exchange[k, j] * push
    return fall


@compiled
def _leave(u, y, solid, r):
    """Write the smoothed forces r of a state that no force holds; those of rounding would be negative."""
    r[:] = u
    for k in range(y.size):
        for j in range(r.size):
            r[j] -= solid.exchange[k, j] * solid.moduli[k] * y[k]
    for j in range(r.size):
        if r[j] < 0.0:
            r[j] = 0.0


@compiled
def _meeting(c, rate, r, solid, duration):
    """Time at which a free element lands in a step; NOWHERE if it does not."""
    u = u_end = fall = 0.0
    c_end = c + rate * duration
    for j in range(r.size):
        if r[j] > 0.0:
            push = solid.compliances[j] * r[j]
            u += push
            u_end += push * exp(-duration / solid.retarded[j])
            fall += push / solid.retarded[j]
    # Clear at both ends, and a convex clearance that rises at once.
    if c_end <= u_end and (fall <= -rate or u == 0.0):
        return NOWHERE
    begin = _landing(u - c, rate, r, solid, duration)
    return duration if begin == NOWHERE and c_end > u_end else begin


@compiled
def _follow(c, rate, duration, touches, y, r, solid, full, part):
    """Move one element through a step in which c rises at a rate.

    full : factors of the whole step; part : room for others
    Returns whether it touches at the end, its force there and how that grows with c there, if c starts as it
    does; int f dt; and the energy lost.
    """
    begin = heat = 0.0
    if touches:
        f, table = c + solid.drag * rate, full
        for k in range(y.size):
            f += solid.moduli[k] * y[k]
    else:
        begin = _meeting(c, rate, r, solid, duration)
        if begin == NOWHERE:
            return False, 0.0, 0.0, 0.0, _relax(r, duration, solid)
        heat = _relax(r, begin, solid)
        f, table = solid.drag * (rate + _land(r, solid, y)), part
        c += rate * begin
        _factors(duration - begin, solid.times, part)
    width = duration - begin
    rise = rate * width
    end, growth = c + rise + solid.drag * rate, 1.0 + solid.drag / duration
    for k in range(y.size):
        kept, average = table[_KEPT, k], table[_MEAN, k]
        end += solid.moduli[k] * (y[k] * kept + rise * average)
        growth += solid.moduli[k] * (begin * kept + width * average) / duration
    touches = end > 0.0
    if not touches:
        width, table = _release(f, rate, y, solid, width), part
        _factors(width, solid.times, part)
    impulse, warmed = _hold(c, rate, width, y, solid, table)
    heat += warmed
    if touches:
        return True, end, growth, impulse, heat
    _leave(c + rate * width, y, solid, r)
    return False, 0.0, 0.0, impulse, heat + _relax(r, duration - begin - width, solid)


@compiled
def _stored(c, touches, y, r, solid):
    energy = 0.0
    if touches:
        energy = c * c
        for k in range(y.size):
            energy += solid.moduli[k] * y[k] * y[k]
    else:
        for j in range(r.size):
            energy += solid.compliances[j] * r[j] * r[j]
    return 0.5 * energy


@compiled
def advance(approaches, rates, slopes, duration, state, solid):
    """Move all elements through a step.

    approaches : c = d - g at its start (N,) [m]; rates : at which they rise (N,) [m/s]
    slopes : g' under each element (N,)
    state : is moved to the end of the step
    """
    full, part = np.empty((5, solid.times.size)), np.empty((5, solid.times.size))
    _factors(duration, solid.times, full)
    force = impulse = drive = work = heat = stored = 0.0
    count = 0
    for i in range(approaches.size):
        c, rate, y, r = approaches[i], rates[i], state.stretches[i], state.forces[i]
        # Untouched, and untouched it stays.
        if c <= 0.0 and c + rate * duration <= 0.0 and not state.touching[i] and not r.any():
            continue
        touches, f, _, pushed, lost = _follow(c, rate, duration, state.touching[i], y, r, solid, full, part)
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
def _ahead(approaches, rates, duration, state, solid, full):
    """Part of the step ahead that does not depend on how far the indenter sinks in it.

    Of an element that touches, its force at the end without sinking, and how that grows; of a free one, its
    approach at the end over its displacement, and zero. Returns also how far the indenter sinks until the first of
    them presses at the end.
    """
    start, growth = np.empty(approaches.size), np.zeros(approaches.size)
    firm = 1.0 + solid.drag / duration
    for k in range(solid.times.size):
        firm += solid.moduli[k] * full[_MEAN, k]
    first = inf
    for i in range(approaches.size):
        rise = rates[i] * duration
        if state.touching[i]:
            start[i] = approaches[i] + firm * rise
            for k in range(solid.times.size):
                start[i] += solid.moduli[k] * state.stretches[i, k] * full[_KEPT, k]
            growth[i] = firm
            first = min(first, -start[i] / firm)
        else:
            start[i] = approaches[i] + rise
            for j in range(solid.retarded.size):
                push = solid.compliances[j] * state.forces[i, j]
                start[i] -= push * exp(-duration / solid.retarded[j])
            first = min(first, -start[i])
    return start, growth, first


@compiled
def _carried(sunk, start, growth, approaches, rates, duration, state, solid, full, part):
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
            rate = rates[i] + sunk / duration
            _, f, more, _, _ = _follow(approaches[i], rate, duration, False, y, r, solid, full, part)
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
    full, part = np.empty((5, solid.times.size)), np.empty((5, solid.times.size))
    _factors(duration, solid.times, full)
    start, growth, low = _ahead(approaches, rates, duration, state, solid, full)
    if load == 0.0:
        return low, 0.0
    high = low + load  # one element alone carries at least what it is pressed in by
    sunk, before, misfit = min(max(guess, low), high), inf, inf
    for _ in range(_MOST_STEPS):
        force, slope = _carried(sunk, start, growth, approaches, rates, duration, state, solid, full, part)
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
        step = -misfit / slope if slope > 0.0 else inf
        if not (low < sunk + step < high and abs(step) <= 0.5 * before):
            step = 0.5 * (low + high) - sunk
        sunk, before = sunk + step, abs(step)
    return sunk, misfit
