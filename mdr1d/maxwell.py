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

from scene.quantities import METRE, SPEED, takes

from .foundation import NOWHERE, Contact, compiled, summed
from .modes import Modes

# What is compiled stays in one file: numba's cache of a function does not see a change of another file.
_MOST_STEPS = 1000
# Shorter lengths than this part of a pixel count as this: their quotients stay finite, their effect is zero.
_SHORTEST = 1e-100
# Beside one, a term that leaves no trace.
_NOTHING = 1e-18
# Rows of the table of an interval: what a branch keeps of its stretch and gains of a rise of u, and what a unit of
# stretch adds to the mean force; to the heat its square adds, and its product with the rise.
_KEPT, _GAINED, _PUSH, _SQUARE, _CROSS = range(5)


@compiled
def _factors(width, lengths, moduli, table):
    """Fill the table of an interval; returns what a unit rise adds to the mean force, and its square to the heat.

    For z = width / lengths of e = exp(-z), 1 - e, and (1 - e)/z = M, (1 - M)/z = int_0^1 (1 - t) exp(-zt) dt, and
    z int_0^1 [int_0^t exp(-zs) ds]^2 dt, by series where these cancel.
    """
    of_rise = heat_of_rise = 0.0
    for k in range(lengths.size):
        z = width / lengths[k]
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
        table[_KEPT, k] = kept
        table[_GAINED, k] = mean
        table[_PUSH, k] = moduli[k] * mean
        table[_SQUARE, k] = moduli[k] * lost * (1.0 - 0.5 * lost)
        table[_CROSS, k] = moduli[k] * mean * lost
        of_rise += moduli[k] * ramp
        heat_of_rise += moduli[k] * heat
    return of_rise, heat_of_rise


@summed
def _sum(a, b):
    total = 0.0
    for k in range(a.size):
        total += a[k] * b[k]
    return total


@summed
def _fading(pushes, decay, ahead):
    """Let the free surface relax over an interval, into ahead: u at its end."""
    u = 0.0
    for j in range(pushes.size):
        ahead[j] = pushes[j] * decay[j]
        u += ahead[j]
    return u


@compiled
def _clear(heights, i, depth, u, pushes, decay, ahead, displacement):
    """Number of intervals from a free node on in which the profile stays above the free surface at their end.

    Returns the one after them, and u at its nodes.
    """
    while i < heights.size - 1:
        u_end = _fading(pushes, decay, ahead) if u > 0.0 else 0.0
        if depth - min(heights[i], heights[i + 1]) > u_end:
            break
        displacement[i] = u
        if u > 0.0:
            _move(ahead, pushes)
        u = u_end
        i += 1
    return i, u, u_end


@summed
def _clearance(t, pushes, rates):
    """Fall of the free surface on its way t, and its rate at the end."""
    fallen = fall = 0.0
    for j in range(pushes.size):
        lost = -expm1(-t * rates[j])
        fallen += pushes[j] * lost
        fall += pushes[j] * rates[j] * (1.0 - lost)
    return fallen, fall


@compiled
def _landing(here, there, slope, pixel, u, u_end, pushes, rates, decay):
    """Place in an interval, from its left node, where the free surface meets the profile; else NOWHERE.

    u, u_end : free surface at both nodes; pushes : at the left one. The clearance is convex: Newton from the left
    never oversteps, and comes to where it rises again if there is no landing.
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
        for j in range(pushes.size):
            fall = pushes[j] * rates[j]
            rate -= fall
            rate_end -= fall * decay[j]
        if rate >= 0.0 or rate_end <= 0.0:
            return NOWHERE
        meet = (u_end - there - rate_end * pixel - (u - here)) / (rate - rate_end)
        if u - here + rate * meet > 0.0:
            return NOWHERE
    t = min(here / slope, pixel) if slope < 0.0 and here < 0.0 else 0.0
    for _ in range(_MOST_STEPS):
        fallen, fall = _clearance(t, pushes, rates)
        clearance, rate = u - here + slope * t - fallen, slope - fall
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
    """Place at which the force f(t) of the contact falls to zero within a width; NOWHERE if it does not.

    f(t) = f + rate t + sum_k b_k (exp(-t/m_k) - 1), b_k = K_k (y_k - m_k rate), changes sign once at most: the end
    tells whether, and a bracket that shrinks by Newton steps, or by halves where those are slow, tells where.
    """
    if f < 0.0:
        return 0.0
    positive, negative = 0.0, width
    t, step, before = width, width, width
    for _ in range(_MOST_STEPS):
        now, slope = f + rate * t, rate
        for k in range(y.size):
            b = moduli[k] * (y[k] - lengths[k] * rate)
            lost = -expm1(-t / lengths[k])
            now -= b * lost
            slope -= b / lengths[k] * (1.0 - lost)
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


@summed
def _stretched(y, rise, table, moduli, ahead):
    """Move the stretches over an interval of contact, into ahead.

    Returns sum_k K_k y_k at its end; and of the stretches at its start, as the table weighs them, the sum for the
    mean force, and those of squares and of stretches for the heat.
    """
    pull = push = square = cross = 0.0
    for k in range(y.size):
        stretch = y[k]
        moved = table[_KEPT, k] * stretch + rise * table[_GAINED, k]
        ahead[k] = moved
        pull += moduli[k] * moved
        push += table[_PUSH, k] * stretch
        square += table[_SQUARE, k] * stretch * stretch
        cross += table[_CROSS, k] * stretch
    return pull, push, square, cross


@summed
def _move(source, target):
    for k in range(target.size):
        target[k] = source[k]


@compiled
def _pressed(
    heights, i, pixel, depth, drag, y, table, of_rise, heat_of_rise, moduli, ahead, displacement, touching, pushed
):
    """First interval after those that touch throughout from a node on, and their sums.

    Of force, heat, traction and squared slopes. Most of a sweep is this loop.
    """
    force = heat = traction = squares = 0.0
    per_pixel = 1.0 / pixel
    while i < heights.size - 1:
        here, there = depth - heights[i], depth - heights[i + 1]
        rise = heights[i] - heights[i + 1]
        pull, push, square, cross = _stretched(y, rise, table, moduli, ahead)
        dragged = drag * rise * per_pixel
        if there + dragged + pull <= 0.0:
            break
        mean = 0.5 * (here + there) + push + rise * of_rise + dragged
        displacement[i], touching[i] = here, True
        pushed[i, 0], pushed[i, 1] = pixel, pixel * mean
        force += mean
        heat += square + rise * (cross + rise * heat_of_rise)
        traction += rise * mean
        squares += rise * rise
        _move(ahead, y)
        i += 1
    return i, pixel * force, heat, traction, squares * per_pixel


@compiled
def _land(kept, r, compliances, exchange, pushes, y):
    """Write what is left of J_j r_j at the end of a free stretch, and the stretches y there; returns u there.

    kept : of each r_j; r : at the start
    """
    u = 0.0
    for j in range(r.size):
        pushes[j] = compliances[j] * r[j] * kept[j]
        u += pushes[j]
    for k in range(y.size):
        y[k] = -_sum(exchange[k], pushes)
    return u


@compiled
def _leave(u, moduli, y, exchange, r):
    """Write the smoothed forces r of a state in contact."""
    r[:] = u
    for k in range(y.size):
        pull = moduli[k] * y[k]
        for j in range(r.size):
            r[j] -= exchange[k, j] * pull


@compiled
def _firmness(stretch, shift, moduli, lengths, exchange, table, shift_left):
    """d(force)/d(depth) of a stretch of contact past its landing; writes d(r)/d(depth) at its end."""
    _factors(stretch, lengths, moduli, table)
    firm = 1.0 + _sum(table[_PUSH], shift)
    shift *= table[_KEPT]
    _leave(1.0, moduli, shift, exchange, shift_left)
    return stretch * firm


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
    of_rise_full, heat_full = _factors(pixel, lengths, moduli, full)
    rates = 1.0 / retarded
    decay = np.exp(-pixel * rates)
    y, left = np.zeros(n), np.zeros(q)  # left : r at the last release
    pushes = np.zeros(q)  # J_j r_j of the free surface at the node
    y_ahead, pushes_ahead = np.empty(n), np.empty(q)
    shift, shift_left = np.zeros(n), np.zeros(q)  # derivatives of y, from the landing on, and of `left`
    force = lost = traction = stiffness = length = slope_square = 0.0
    stretch = apart = 0.0  # in contact since it landed, free since it left
    u = 0.0  # of the free surface at the node
    first = last = nan
    touches = False
    i, nodes = 0, heights.size
    while i < nodes - 1:
        begun = i
        if touches:
            i, push, heat, pull, squares = _pressed(
                heights,
                i,
                pixel,
                depth,
                drag,
                y,
                full,
                of_rise_full,
                heat_full,
                moduli,
                y_ahead,
                displacement,
                touching,
                pushed,
            )
            width = pixel * (i - begun)
            force += push
            lost += heat + drag * squares
            traction += pull
            slope_square += squares
            length += width
            stretch += width
        else:
            i, u, u_end = _clear(heights, i, depth, u, pushes, decay, pushes_ahead, displacement)
            apart += pixel * (i - begun)
        if i == nodes - 1:
            break
        here = depth - heights[i]
        there = depth - heights[i + 1]
        rate = (heights[i] - heights[i + 1]) / pixel
        displacement[i] = here if touches else u
        touching[i] = touches
        begin, width, start = 0.0, pixel, here
        if touches:
            f = here + drag * rate + _sum(moduli, y)
        else:
            begin = _landing(here, there, -rate, pixel, u, u_end, pushes, rates, decay)
            if begin == NOWHERE:
                apart += pixel
                u = u_end
                _move(pushes_ahead, pushes)
                i += 1
                continue
            apart += begin
            kept = np.exp(-apart * rates)
            for j in range(q):
                lost -= 0.5 * compliances[j] * left[j] * left[j] * expm1(-2.0 * apart * rates[j])
            slackened = _land(kept, shift_left, compliances, exchange, pushes, shift)
            met = _land(kept, left, compliances, exchange, pushes, y)
            fall = _sum(pushes, rates)
            if begin > 0.0:
                # Where the free surface meets the flank, the flatter of the two knows the height.
                start = met if fall < abs(rate) else max(here + rate * begin, 0.0)
                # Only the heights know the width of a touch just before a node.
                width = min(max((there - start) / rate, 0.0), pixel) if rate > 0.0 else pixel - begin
            shift += 1.0 - slackened
            stiffness += drag * (1.0 - slackened)
            # Beyond rounding a jump comes only of a profile that is pressed in where the grid starts.
            jump = max(here - u, 0.0) if begin == 0.0 else 0.0
            y += jump
            lost -= 0.5 * stiff * jump * jump
            f = stiff * jump + drag * (rate + fall)
            if first != first:
                first = i * pixel + begin
            stretch = 0.0
        end = _release(f, rate, width, y, moduli, lengths)
        touches = end == NOWHERE
        if not touches:
            apart = width - end
            width = end
        of_rise, heat_of_rise = _factors(width, lengths, moduli, part)
        rise = rate * width
        _, push, square, cross = _stretched(y, rise, part, moduli, y_ahead)
        _move(y_ahead, y)
        push = width * (start + 0.5 * rise + push + rise * of_rise + drag * rate)
        pushed[i, 0] = width
        pushed[i, 1] = push
        force += push
        lost += square + rise * (cross + rise * heat_of_rise) + drag * rate * rise
        traction += rate * push
        length += width
        stretch += width
        slope_square += rate * rise
        if not touches:
            last = i * pixel + begin + width
            _leave(start + rise, moduli, y, exchange, left)
            for j in range(q):
                if left[j] < 0.0:
                    left[j] = 0.0
            stiffness += _firmness(stretch, shift, moduli, lengths, exchange, part, shift_left)
            u = 0.0
            for j in range(q):
                pushes[j] = compliances[j] * left[j] * exp(-apart * rates[j])
                u += pushes[j]
        i += 1
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


@takes(heights=METRE, pixel=METRE, speed=SPEED, depth=METRE)
def sweep_modes(heights, pixel: float, modes: Modes, speed: float, depth: float) -> Contact:
    """Solve steady flow along +x past a rigid profile, linear between its nodes.

    heights : g at equidistant nodes (N,) [m]
    pixel : their spacing [m]
    modes, speed : of the elastomer, and of its flow [m/s]
    depth : d [m], against the same zero as the heights

    The elastomer is at rest before the first node, and relaxes freely behind the last one.
    """
    heights = np.asarray(heights)
    displacement = np.empty(heights.size)
    touching = np.zeros(heights.size, dtype=np.bool_)
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
