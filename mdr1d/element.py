"""One element of a foundation under a height that changes linearly, followed exactly through both of its phases.

In units of the relaxed stiffness, with c = d - g, an element displaced by u carries

    f = u + D u' + sum_k K_k y_k,   y_k' = -y_k/m_k + u',   where it touches: u = c, f >= 0;
    u = sum_j J_j r_j,   r_j' = (f - r_j)/l_j,   where it is free: f = 0, so that r_j >= 0 decays as exp(-t/l_j).

y_k is the stretch of the spring of branch k and r_j the smoothed force of retardation mode j: two coordinates of
one state, joined by r_j = u - sum_k C_kj K_k y_k and, where f = 0, y_k = -sum_j C_kj J_j r_j, with
C_kj = m_k/(l_j - m_k). Each is diagonal in its own phase. D, of a lone dashpot, is zero for a solid with a glassy
modulus; a Kelvin foundation is D alone, with l = D, so that f = u + l u', Eq. 5 of Popov et al., Sci. Rep. 4, 3750
(2014). The way t along the profile is one of time, or of length in a steady flow.

The free surface is convex. After a release its clearance from a straight flank starts to rise and only grows: a
flank has one landing at most, and after a release none. Held on to the flank an element would need the force
f = -(c + D c' + sum_k K_k int exp(-(t - s)/m_k) c'(s) ds) < 0 from there on: on a straight flank f changes its
sign once at most, and its sign at the end tells whether there is a release.
"""

from math import exp, expm1, inf
from typing import NamedTuple

import numpy as np

from scene import loops

from .modes import Modes

# How every loop of this package is compiled.
compiled = loops.compiled(error_model="numpy")
# Compiled for short loops that only sum: in any order, side by side, at the place of the call.
summed = loops.compiled(error_model="numpy", fastmath={"reassoc", "contract", "nsz"}, forceinline=True)

NOWHERE = -1.0
_MOST_STEPS = 1000
# Added to one, this leaves no trace.
_NOTHING = 1e-18
# Rows of a table: what a branch keeps of its stretch and gains of a rise of u; what a unit of stretch and a unit
# of the rise add to the mean force; and to the heat, the square of either and their product.
KEPT, GAINED, PUSH, RISE, SQUARE, OF_RISE, CROSS = range(7)


class Solid(NamedTuple):
    """The modes of a solid, see `Modes`; times in seconds, or in lengths of a flow."""

    moduli: np.ndarray
    times: np.ndarray
    drag: float
    compliances: np.ndarray
    retarded: np.ndarray
    exchange: np.ndarray

    @classmethod
    def of(cls, modes: Modes, speed: float = 1.0, shortest: float = 0.0) -> "Solid":
        """Solid of modes that flow at a speed [m/s]; shorter times, or lengths, count as the shortest."""
        return cls(
            modes.moduli,
            np.maximum(speed * modes.relaxation_times, shortest),
            float(speed * modes.drag),
            modes.compliances,
            np.maximum(speed * modes.retardation_times, shortest),
            modes.exchange,
        )


@compiled
def tabulate(width, solid, table):
    """Fill the table (7, K) of a stretch of contact.

    For z = width/m of e = exp(-z), 1 - e, M = (1 - e)/z, (1 - M)/z = int_0^1 (1 - t) exp(-zt) dt, and
    z int_0^1 [int_0^t exp(-zs) ds]^2 dt, by series where these cancel.
    """
    for k in range(solid.times.size):
        z = width / solid.times[k]
        if z < 0.5:
            mean = ramp = heat = 0.0
            term, doubled = 1.0, 4.0  # (-z)^n / (n + 1)! and 2^(n + 2)
            for n in range(20):
                mean += term
                term /= n + 2
                ramp += term
                heat += term * (doubled - 2.0) / (n + 3)
                term *= -z
                doubled *= 2.0
                if abs(term) * doubled < _NOTHING:
                    break
            heat *= z
            lost = z * mean
            kept = 1.0 - lost
        else:
            kept = exp(-z)
            lost = 1.0 - kept
            mean = lost / z
            ramp = (1.0 - mean) / z
            heat = (1.0 - mean * (1.0 + 0.5 * lost)) / z
        table[KEPT, k] = kept
        table[GAINED, k] = mean
        table[PUSH, k] = solid.moduli[k] * mean
        table[RISE, k] = solid.moduli[k] * ramp
        table[SQUARE, k] = solid.moduli[k] * lost * (1.0 - 0.5 * lost)
        table[OF_RISE, k] = solid.moduli[k] * heat
        table[CROSS, k] = solid.moduli[k] * mean * lost


@summed
def total(a, b):
    """Sum of the products of two arrays."""
    found = 0.0
    for k in range(a.size):
        found += a[k] * b[k]
    return found


@summed
def move(source, target):
    """Write one array into another."""
    for k in range(target.size):
        target[k] = source[k]


@summed
def stretched(y, rise, table, moduli, ahead):
    """Move the stretches over a rise of u, into ahead.

    Returns sum_k K_k y_k at its end; and of the stretches at its start, as the table weighs them, the sum for the
    mean force, and those of squares and of stretches for the heat.
    """
    pull = push = square = cross = 0.0
    for k in range(y.size):
        stretch = y[k]
        moved = table[KEPT, k] * stretch + rise * table[GAINED, k]
        ahead[k] = moved
        pull += moduli[k] * moved
        push += table[PUSH, k] * stretch
        square += table[SQUARE, k] * stretch * stretch
        cross += table[CROSS, k] * stretch
    return pull, push, square, cross


@summed
def of_rise(table):
    """What a unit rise adds to the mean force, and its square to the heat."""
    push = heat = 0.0
    for k in range(table.shape[1]):
        push += table[RISE, k]
        heat += table[OF_RISE, k]
    return push, heat


@summed
def add(amount, values):
    """Add a number to all values."""
    for k in range(values.size):
        values[k] += amount


@summed
def faded(pushes, decay, ahead):
    """Let the free surface relax: write its parts J_j r_j into `ahead`, and return u then."""
    u = 0.0
    for j in range(pushes.size):
        ahead[j] = pushes[j] * decay[j]
        u += ahead[j]
    return u


@summed
def _fallen(t, pushes, retarded):
    """Fall of the free surface on its way t, and its rate at the end."""
    fallen = fall = 0.0
    for j in range(pushes.size):
        lost = -expm1(-t / retarded[j])
        fallen += pushes[j] * lost
        fall += pushes[j] / retarded[j] * (1.0 - lost)
    return fallen, fall


@compiled
def landing(c, c_end, rate, width, u, u_end, pushes, solid, decay):
    """Place at which a free surface meets c, which rises at a rate; else NOWHERE.

    c_end : at the end of the width, where a light touch has digits that c has not
    u, u_end : free surface at both ends
    pushes : J_j r_j at the start; decay : what the width leaves of them

    The clearance is convex: Newton from the left never oversteps, and comes to where it rises again if there is no
    landing.
    """
    if u == 0.0:
        if c > 0.0:
            return 0.0
        return min(-c / rate, width) if c_end > 0.0 else NOWHERE
    if u <= c:
        return 0.0
    if u_end >= c_end:
        # It lies above its tangents at both ends: only if those meet below zero is there anything to search.
        opening = closing = -rate
        for j in range(pushes.size):
            fall = pushes[j] / solid.retarded[j]
            opening -= fall
            closing -= fall * decay[j]
        if opening >= 0.0 or closing <= 0.0:
            return NOWHERE
        meet = (u_end - c_end - closing * width - (u - c)) / (opening - closing)
        if u - c + opening * meet > 0.0:
            return NOWHERE
    t = min(-c / rate, width) if rate > 0.0 and c < 0.0 else 0.0
    for _ in range(_MOST_STEPS):
        fallen, fall = _fallen(t, pushes, solid.retarded)
        clearance, opening = u - c - rate * t - fallen, -rate - fall
        if clearance <= 0.0:
            return t
        if opening >= 0.0:
            break
        ahead = t - clearance / opening
        if ahead >= width:
            break
        if ahead <= t:
            return t
        t = ahead
    return width if u_end < c_end else NOWHERE


@compiled
def _release(f, rate, width, y, solid):
    """Where the force f(t) of the contact falls to zero; it is not positive after the width.

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
            lost = -expm1(-t / solid.times[k])
            now -= b * lost
            slope -= b / solid.times[k] * (1.0 - lost)
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
def hold(f, c, rate, width, y, solid, table, part, ahead):
    """Follow an element that touches, with its force f, while c rises at a rate; y is moved to where that ends.

    table : of the width; part, ahead : room for another, and for stretches

    Returns its force at the end of the width, which is not positive where it has left; the part of the width on
    which it touched, int f dt there, and the energy lost.
    """
    rise = rate * width
    end = f + rise  # and not of c: a light touch keeps its digits
    for k in range(y.size):
        end += table[PUSH, k] * (rise - width * y[k] / solid.times[k])
    if end <= 0.0:
        width, table = _release(f, rate, width, y, solid), part
        rise = rate * width
        tabulate(width, solid, table)
    _, push, square, cross = stretched(y, rise, table, solid.moduli, ahead)
    move(ahead, y)
    rising, warming = of_rise(table)
    mean = c + 0.5 * rise + solid.drag * rate + push + rise * rising
    heat = square + rise * (cross + rise * warming + solid.drag * rate)
    return end, width, width * mean, heat


@compiled
def land(pushes, solid, y):
    """Write the stretches y of a free state, of J_j r_j."""
    for k in range(y.size):
        y[k] = -total(solid.exchange[k], pushes)


@compiled
def leave(u, y, solid, least, r):
    """Write the smoothed forces r of a state of contact, no less than the least: in truth none is below zero."""
    for j in range(r.size):
        r[j] = u
    for k in range(y.size):
        pull = solid.moduli[k] * y[k]
        for j in range(r.size):
            r[j] -= solid.exchange[k, j] * pull
    for j in range(r.size):
        r[j] = max(r[j], least)


@compiled
def relax(r, apart, solid):
    """Move r to the end of a free stretch. Returns the energy lost in it."""
    heat = 0.0
    for j in range(r.size):
        if r[j] > 0.0:
            heat -= 0.5 * solid.compliances[j] * r[j] * r[j] * expm1(-2.0 * apart / solid.retarded[j])
            r[j] *= exp(-apart / solid.retarded[j])
    return heat
