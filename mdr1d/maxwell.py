"""Steady flow of a foundation of Maxwell branches past a rigid, piecewise linear profile, solved exactly.

In units of the relaxed stiffness, along the flow, with m_k = v tau_k, an element displaced by u carries

    f = u + D u' + sum_k K_k y_k,   y_k' = -y_k/m_k + u',   where it touches: u = d - g, f >= 0;
    u = sum_j J_j r_j,   r_j' = (f - r_j)/l_j,   where it is free: f = 0, so that r_j >= 0 decays as exp(-x/l_j).

y_k is the stretch of the spring of branch k and r_j the smoothed force of retardation mode j: two coordinates of
one state, joined by r_j = u - sum_k C_kj K_k y_k and, where f = 0, y_k = -sum_j C_kj J_j r_j, with
C_kj = m_k/(l_j - m_k). Each is diagonal in its own phase, so that a stretch costs K operations a node and only its
ends K^2. D, of a lone dashpot, is zero for a solid with a glassy modulus.

The free surface is convex. After a release its clearance c from a straight flank starts to rise and only grows: an
interval has one landing at most, and after a release none. Held on to the flank it would need the force
f = -(c + D c' + sum_k K_k int exp(-(x - s)/m_k) c'(s) ds) < 0 from there on: on a straight flank f changes its
sign once at most, and its sign at the end tells whether there is a release.

As the inverse of a completely monotone creep operator, u -> f is positive on the diagonal and nowhere else, so
that u is the least of all displacements with f >= 0 and u >= d - g. Mixing two depths mixes such displacements: u
is convex and increasing in d, and so is the force, int f dx = int u dx.
"""

from math import exp, expm1, inf, nan

import numpy as np

from .foundation import NOWHERE, Contact, compiled
from .modes import Modes

# What is compiled stays in one file: numba's cache of a function does not see a change of another file.
_MOST_STEPS = 1000
# Shorter lengths than this part of a pixel count as this: their quotients stay finite, their effect is zero.
_SHORTEST = 1e-100
# Rows of the table of factors: what an interval does to a branch.
_KEPT, _LOST, _MEAN, _RAMP, _HEAT = range(5)


@compiled
def _factors(width, lengths, table):
    """Fill the table for z = width / lengths: e = exp(-z), 1 - e, and (1 - e)/z = M, (1 - M)/z = int_0^1 (1 - t)
    exp(-zt) dt, and z int_0^1 [int_0^t exp(-zs) ds]^2 dt, by series where these cancel."""
    for k in range(lengths.size):
        z = width / lengths[k]
        lost = -expm1(-z)
        if z < 0.5:
            mean = ramp = heat = 0.0
            term = 1.0  # (-z)^n / (n + 1)!
            for n in range(20):
                mean += term
                ramp += term / (n + 2)
                heat += z * term * (2.0 ** (n + 2) - 2.0) / ((n + 2) * (n + 3))
                term *= -z / (n + 2)
        else:
            mean = lost / z
            ramp = (1.0 - mean) / z
            heat = (1.0 - mean * (1.0 + 0.5 * lost)) / z
        table[_KEPT, k] = exp(-z)
        table[_LOST, k] = lost
        table[_MEAN, k] = mean
        table[_RAMP, k] = ramp
        table[_HEAT, k] = heat


@compiled
def _landing(here, there, slope, pixel, u, u_end, r, compliances, lengths, decay):
    """Where in an interval the free surface meets the profile, from its left node; NOWHERE if it does not.

    u, u_end : free surface at both nodes; r : at the left one. The clearance is convex: Newton from the left never
    oversteps, and comes to where it rises again if there is no landing.
    """
    if u == 0.0:
        if here > 0.0:
            return 0.0
        return min(here / slope, pixel) if there > 0.0 else NOWHERE
    if u <= here:
        return 0.0
    if u_end > there:
        # It lies above its tangents at both nodes: only if those meet below zero is there anything to search.
        rate, rate_end = slope, slope
        for j in range(r.size):
            fall = compliances[j] * r[j] / lengths[j]
            rate -= fall
            rate_end -= fall * decay[j]
        if rate >= 0.0 or rate_end <= 0.0:
            return NOWHERE
        meet = (u_end - there - rate_end * pixel - (u - here)) / (rate - rate_end)
        if u - here + rate * meet > 0.0:
            return NOWHERE
    t = min(here / slope, pixel) if slope < 0.0 and here < 0.0 else 0.0
    for _ in range(_MOST_STEPS):
        clearance, rate = u - here + slope * t, slope
        for j in range(r.size):
            push = compliances[j] * r[j]
            clearance += push * expm1(-t / lengths[j])
            rate -= push / lengths[j] * exp(-t / lengths[j])
        if clearance <= 0.0:
            return t
        if rate >= 0.0:
            break
        next_t = t - clearance / rate
        if next_t >= pixel:
            break
        if next_t <= t:
            return t
        t = next_t
    return NOWHERE


@compiled
def _release(f, rate, width, y, moduli, lengths):
    """Where f(t) = f + rate t + sum_k b_k (exp(-t/m_k) - 1), b_k = K_k (y_k - m_k rate), falls to zero within a
    width; NOWHERE if it does not.

    There is one change of sign at most: the sign at the end tells whether, and a bracket that shrinks by Newton
    steps, or by halves where those are slow, tells where.
    """
    if f < 0.0:
        return 0.0
    positive, negative = 0.0, width
    t, step, before = width, width, width
    for _ in range(_MOST_STEPS):
        now, slope = f + rate * t, rate
        for k in range(y.size):
            b = moduli[k] * (y[k] - lengths[k] * rate)
            now += b * expm1(-t / lengths[k])
            slope -= b / lengths[k] * exp(-t / lengths[k])
        if now > 0.0:
            if t == width:
                return NOWHERE
            positive = t
        else:
            negative = t
        step, before = now / slope if slope < 0.0 else inf, step
        inside = positive < t - step < negative
        if not (inside and abs(step) <= 0.5 * abs(before)):
            step = t - 0.5 * (positive + negative)
        next_t = t - step
        if next_t == t or not positive < next_t < negative:
            break
        t = next_t
    return t


@compiled
def _force_ahead(f, rise, y, moduli, table):
    """f at the end of a stretch of contact, given what of it owes nothing to the branches."""
    for k in range(y.size):
        f += moduli[k] * (y[k] * table[_KEPT, k] + rise * table[_MEAN, k])
    return f


@compiled
def _pressed(start, rate, width, y, moduli, table):
    """Integrals over a stretch of contact, of u + sum_k K_k y_k and of sum_k K_k y_k^2/m_k; moves y to its end."""
    rise = rate * width
    mean, heat = start + 0.5 * rise, 0.0
    for k in range(y.size):
        kept, lost, average = table[_KEPT, k], table[_LOST, k], table[_MEAN, k]
        mean += moduli[k] * (y[k] * average + rise * table[_RAMP, k])
        heat += moduli[k] * (
            y[k] * (y[k] * lost * (1.0 - 0.5 * lost) + rise * average * lost) + rise * rise * table[_HEAT, k]
        )
        y[k] = y[k] * kept + rise * average
    return width * mean, heat


@compiled
def _land(apart, r, compliances, retarded, exchange, y):
    """Write the stretches y at the end of a free stretch.

    apart : its length; r : at its start. Returns the energy lost in it, u at its end, and how fast u falls there.
    """
    y[:] = 0.0
    lost = u = fall = 0.0
    for j in range(r.size):
        push = compliances[j] * r[j]
        lost -= 0.5 * push * r[j] * expm1(-2.0 * apart / retarded[j])
        push *= exp(-apart / retarded[j])
        u += push
        fall += push / retarded[j]
        for k in range(y.size):
            y[k] -= exchange[k, j] * push
    return lost, u, fall


@compiled
def _leave(u, moduli, y, exchange, r):
    """Write the smoothed forces r of a state in contact."""
    r[:] = u
    for k in range(y.size):
        for j in range(r.size):
            r[j] -= exchange[k, j] * moduli[k] * y[k]


@compiled
def _firmness(stretch, shift, moduli, lengths, exchange, table, shift_left):
    """d(force)/d(depth) of a stretch of contact past its landing; writes d(r)/d(depth) at its end."""
    _factors(stretch, lengths, table)
    firm = 1.0
    for k in range(shift.size):
        firm += moduli[k] * shift[k] * table[_MEAN, k]
        shift[k] *= table[_KEPT, k]
    _leave(1.0, moduli, shift, exchange, shift_left)
    return stretch * firm


@compiled
def _sum(a, b):
    total = 0.0
    for k in range(a.size):
        total += a[k] * b[k]
    return total


@compiled
def _sweep(
    heights,
    pixel,
    depth,
    moduli,
    lengths,
    drag,
    compliances,
    retarded,
    exchange,
    displacement,
    touching,
    pushed,
):
    n, q = moduli.size, compliances.size
    stiff = 1.0 + moduli.sum()  # against a jump of u: glassy but for the dashpot
    full, part = np.empty((5, n)), np.empty((5, n))
    _factors(pixel, lengths, full)
    decay = np.exp(-pixel / retarded)
    y, r, left = np.zeros(n), np.zeros(q), np.zeros(q)  # left : r at the last release
    shift, shift_left = np.zeros(n), np.zeros(q)  # derivatives of y, from the landing on, and of `left`
    force = lost = traction = stiffness = length = slope_square = 0.0
    stretch = apart = 0.0  # in contact since it landed, free since it left
    u = 0.0  # of the free surface at the node
    first = last = nan
    touches = False
    for i in range(heights.size - 1):
        here = depth - heights[i]
        there = depth - heights[i + 1]
        rate = (heights[i] - heights[i + 1]) / pixel
        displacement[i] = here if touches else u
        touching[i] = touches
        begin, width, start = 0.0, pixel, here
        table = full
        if touches:
            f = here + drag * rate + _sum(moduli, y)
            touches = _force_ahead(there + drag * rate, rate * pixel, y, moduli, full) > 0.0
        else:
            u_end = fall = 0.0
            if u > 0.0:
                for j in range(q):
                    push = compliances[j] * r[j]
                    u_end += push * decay[j]
                    fall += push / retarded[j]
            # Clear at both nodes, and a convex clearance that rises from the left one or is straight.
            clear = here <= u and there <= u_end and (fall <= -rate or u == 0.0)
            if not clear:
                begin = _landing(here, there, -rate, pixel, u, u_end, r, compliances, retarded, decay)
            if clear or begin == NOWHERE:
                apart += pixel
                if u > 0.0:
                    u = u_end
                    for j in range(q):
                        r[j] *= decay[j]
                continue
            apart += begin
            cooled, met, fall = _land(apart, left, compliances, retarded, exchange, y)
            if begin > 0.0:
                # Where the free surface meets the flank, the flatter of the two knows the height.
                start = met if fall < abs(rate) else max(here + rate * begin, 0.0)
                # Of a touch just before a node only the heights know the width.
                width = min(max((there - start) / rate, 0.0), pixel) if rate > 0.0 else pixel - begin
            _, kept, _ = _land(apart, shift_left, compliances, retarded, exchange, shift)
            shift += 1.0 - kept
            stiffness += drag * (1.0 - kept)
            # Beyond rounding a jump comes only of a profile that is pressed in where the grid starts.
            jump = max(here - u, 0.0) if begin == 0.0 else 0.0
            y += jump
            lost += cooled - 0.5 * stiff * jump * jump
            f = stiff * jump + drag * (rate + fall)
            if first != first:
                first = i * pixel + begin
            stretch = 0.0
        if not touches:
            end = _release(f, rate, width, y, moduli, lengths)
            touches = end == NOWHERE
        if not touches:
            apart = width - end
            width = end
        if begin > 0.0 or not touches:
            table = part
            _factors(width, lengths, part)
        push, heat = _pressed(start, rate, width, y, moduli, table)
        push += drag * rate * width
        pushed[i, 0] = width
        pushed[i, 1] = push
        force += push
        lost += heat + drag * rate * rate * width
        traction += rate * push
        length += width
        stretch += width
        slope_square += rate * rate * width
        if not touches:
            last = i * pixel + begin + width
            _leave(start + rate * width, moduli, y, exchange, left)
            for j in range(q):
                if left[j] < 0.0:
                    left[j] = 0.0
            stiffness += _firmness(stretch, shift, moduli, lengths, exchange, part, shift_left)
            u = 0.0
            for j in range(q):
                r[j] = left[j] * exp(-apart / retarded[j])
                u += compliances[j] * r[j]
    i = heights.size - 1
    displacement[i] = depth - heights[i] if touches else u
    touching[i] = touches
    if touches:
        last = i * pixel
        if drag == 0.0:
            lost += 0.5 * (displacement[i] + _sum(moduli, y)) ** 2 / stiff
        _leave(displacement[i], moduli, y, exchange, left)
        stiffness += _firmness(stretch, shift, moduli, lengths, exchange, part, shift_left)
    for j in range(q):
        lost += 0.5 * compliances[j] * left[j] ** 2
    return force, lost, traction, stiffness, length, slope_square, first, last


def sweep_modes(heights, pixel: float, modes: Modes, speed: float, depth: float) -> Contact:
    """Solve steady flow along +x past a rigid profile, linear between its nodes.

    heights : g at equidistant nodes (N,) [m]
    pixel : their spacing [m]
    modes, speed : of the elastomer, and of its flow [m/s]
    depth : d [m], against the same zero as the heights

    The elastomer is at rest before the first node, and relaxes freely behind the last one.
    """
    displacement = np.empty(heights.size)
    touching = np.empty(heights.size, dtype=np.bool_)
    pushed = np.zeros((heights.size - 1, 2))
    shortest = _SHORTEST * pixel
    sums = _sweep(
        heights,
        float(pixel),
        float(depth),
        modes.moduli,
        np.maximum(speed * modes.relaxation_times, shortest),
        float(speed * modes.drag),
        modes.compliances,
        np.maximum(speed * modes.retardation_times, shortest),
        modes.exchange,
        displacement,
        touching,
        pushed,
    )
    return Contact._make((*sums, displacement, touching, pushed))
