"""Steady flow of a foundation past a rigid, piecewise linear profile, solved exactly.

The elastomer enters undisturbed at the left and flows along +x: each element is one of `element`, with the way
along the profile as its time. As the inverse of a completely monotone creep operator, u -> f is positive on the
diagonal and nowhere else, so that u is the least of all displacements with f >= 0 and u >= d - g; of a Kelvin
foundation u(x) = max(0, max_{y <= x} (d - g(y)) exp(-(x - y)/l)). Mixing two depths mixes such displacements: u is
convex and increasing in d, and so is the force, int f dx = int u dx.
"""

from math import exp, inf, nan
from typing import NamedTuple

import numpy as np

from scene.quantities import METRE, SPEED, takes

from .element import (
    NOWHERE,
    PUSH,
    Solid,
    add,
    compiled,
    faded,
    hold,
    land,
    landing,
    leave,
    move,
    of_rise,
    relax,
    stretched,
    tabulate,
    total,
)
from .modes import Modes

# Shorter lengths than this part of a pixel count as this: their quotients stay finite, their effect is zero.
_SHORTEST = 1e-100


class Contact(NamedTuple):
    """Sums of a sweep, for stiffness K = 1 per length; multiply forces by K [Pa].

    force : int f dx / K [m^2]
    dissipation : friction force as the energy lost per length slid [m^2], int l u'^2 dx of a Kelvin foundation,
        the wake included; a sum of terms >= 0, free of cancellation, and exactly zero for an elastic foundation
    traction : the same friction force from its definition, -int g' f dx / K [m^2], Eq. 8; agrees to rounding
    stiffness : d(force)/d(depth) [m]
    length : of the real contact [m]
    slope_square : int g'^2 dx over the real contact [m]
    first, last : where contact begins and ends, from the first node [m]; nan without contact
    displacement : u at the nodes (N,) [m]
    touching : which nodes touch (N,)
    pushed : in each interval between nodes, the length of the real contact [m] and int f dx / K [m^2] (N - 1, 2)
    """

    force: float
    dissipation: float
    traction: float
    stiffness: float
    length: float
    slope_square: float
    first: float
    last: float
    displacement: np.ndarray
    touching: np.ndarray
    pushed: np.ndarray


@compiled
def _clear(heights, i, depth, u, pushes, decay, ahead, displacement):
    """Number of intervals from a free node on in which the profile stays above the free surface at their end.

    Returns the one after them, and u at its nodes.
    """
    u_end = u
    while i < heights.size - 1:
        u_end = faded(pushes, decay, ahead) if u > 0.0 else 0.0
        if depth - min(heights[i], heights[i + 1]) > u_end:
            break
        displacement[i] = u
        if u > 0.0:
            move(ahead, pushes)
        u = u_end
        i += 1
    return i, u, u_end


@compiled
def _pressed(heights, i, pixel, depth, solid, y, table, ahead, displacement, touching, pushed):
    """First interval after those that touch throughout from a node on, and their sums.

    Of force, heat, traction and squared slopes. Most of a sweep is this loop.
    """
    force = heat = traction = squares = 0.0
    per_pixel = 1.0 / pixel
    rising, warming = of_rise(table)
    while i < heights.size - 1:
        here, there = depth - heights[i], depth - heights[i + 1]
        rise = heights[i] - heights[i + 1]
        pull, push, square, cross = stretched(y, rise, table, solid.moduli, ahead)
        dragged = solid.drag * rise * per_pixel
        if there + dragged + pull <= 0.0:
            break
        mean = 0.5 * (here + there) + push + rise * rising + dragged
        displacement[i], touching[i] = here, True
        pushed[i, 0], pushed[i, 1] = pixel, pixel * mean
        force += mean
        heat += square + rise * (cross + rise * warming)
        traction += rise * mean
        squares += rise * rise
        move(ahead, y)
        i += 1
    return i, pixel * force, heat + solid.drag * squares * per_pixel, traction, squares * per_pixel


@compiled
def _firmness(stretch, shift, solid, table, shift_left):
    """d(force)/d(depth) of a stretch of contact past its landing; writes d(r)/d(depth) at its end."""
    tabulate(stretch, solid, table)
    firm = 1.0 + total(table[PUSH], shift)
    stretched(shift, 0.0, table, solid.moduli, shift)
    leave(1.0, shift, solid, -inf, shift_left)
    return stretch * firm


@compiled
def _flow(heights, pixel, solid, depth, displacement, touching, pushed):
    """Sums of `Contact` for a solid whose times are lengths of its flow; its fields are written."""
    n, q = solid.moduli.size, solid.compliances.size
    stiff = 1.0 + solid.moduli.sum()  # against a jump of u: glassy but for the dashpot
    full, part, ahead = np.empty((7, n)), np.empty((7, n)), np.empty(n)
    tabulate(pixel, solid, full)
    decay = np.exp(-pixel / solid.retarded)
    y, left = np.zeros(n), np.zeros(q)  # left : r at the last release
    pushes, pushes_ahead = np.zeros(q), np.empty(q)  # J_j r_j of the free surface at the node
    shift, shift_left = np.zeros(n), np.zeros(q)  # derivatives of y, from the landing on, and of `left`
    force = lost = traction = stiffness = length = slope_square = 0.0
    stretch = apart = 0.0  # in contact since it landed, free since it left
    u = 0.0  # of the free surface at the node
    first = last = nan
    touches = False
    i, nodes = np.intp(0), heights.size  # a literal would have what it is passed to compiled once more
    while i < nodes - 1:
        begun = i
        if touches:
            i, push, heat, pull, squares = _pressed(
                heights, i, pixel, depth, solid, y, full, ahead, displacement, touching, pushed
            )
            width = pixel * (i - begun)
            force += push
            lost += heat
            traction += pull
            slope_square += squares
            length += width
            stretch += width
        else:
            i, u, u_end = _clear(heights, i, depth, u, pushes, decay, pushes_ahead, displacement)
            apart += pixel * (i - begun)
        if i == nodes - 1:
            break
        here, there = depth - heights[i], depth - heights[i + 1]
        rate = (heights[i] - heights[i + 1]) / pixel
        displacement[i], touching[i] = (here if touches else u), touches
        begin, width, start, table = 0.0, pixel, here, full
        if touches:
            f = here + solid.drag * rate + total(solid.moduli, y)
        else:
            begin = landing(here, there, rate, pixel, u, u_end, pushes, solid, decay)
            if begin == NOWHERE:
                apart += pixel
                u = u_end
                move(pushes_ahead, pushes)
                i += 1
                continue
            apart += begin
            met = slackened = fall = 0.0
            lost += relax(left, apart, solid)
            for j in range(q):
                pushes[j] = solid.compliances[j] * shift_left[j] * exp(-apart / solid.retarded[j])
                slackened += pushes[j]
            land(pushes, solid, shift)
            for j in range(q):
                pushes[j] = solid.compliances[j] * left[j]
                met += pushes[j]
                fall += pushes[j] / solid.retarded[j]
            land(pushes, solid, y)
            if begin > 0.0:
                # Where the free surface meets the flank, the flatter of the two knows the height.
                start = met if fall < abs(rate) else max(here + rate * begin, 0.0)
                # Only the heights know the width of a touch just before a node.
                width = min(max((there - start) / rate, 0.0), pixel) if rate > 0.0 else pixel - begin
                table = part
                tabulate(width, solid, table)
            add(1.0 - slackened, shift)
            stiffness += solid.drag * (1.0 - slackened)
            # Beyond rounding a jump comes only of a profile that is pressed in where the grid starts.
            jump = max(here - u, 0.0) if begin == 0.0 else 0.0
            add(jump, y)
            lost -= 0.5 * stiff * jump * jump
            f = stiff * jump + solid.drag * (rate + fall)
            if first != first:
                first = i * pixel + begin
            stretch = 0.0
        end, touched, push, heat = hold(f, start, rate, width, y, solid, table, part, ahead)
        touches = end > 0.0
        rise = rate * touched
        pushed[i, 0], pushed[i, 1] = touched, push
        force += push
        lost += heat
        traction += rate * push
        length += touched
        stretch += touched
        slope_square += rate * rise
        if not touches:
            apart = width - touched
            last = i * pixel + begin + touched
            leave(start + rise, y, solid, 0.0, left)
            stiffness += _firmness(stretch, shift, solid, part, shift_left)
            u = 0.0
            for j in range(q):
                pushes[j] = solid.compliances[j] * left[j] * exp(-apart / solid.retarded[j])
                u += pushes[j]
        i += 1
    u = depth - heights[i] if touches else u
    displacement[i], touching[i] = u, touches
    if touches:
        last = i * pixel
        if solid.drag == 0.0:
            lost += 0.5 * (u + total(solid.moduli, y)) ** 2 / stiff
        leave(u, y, solid, 0.0, left)
        stiffness += _firmness(stretch, shift, solid, part, shift_left)
    for j in range(q):
        lost += 0.5 * solid.compliances[j] * left[j] ** 2
    return force, lost, traction, stiffness, length, slope_square, first, last


def swept(flow, heights, pixel, memory, depth) -> Contact:
    """Contact by the sums and the fields of a compiled flow with some memory."""
    heights = np.broadcast_to(heights, np.shape(heights))  # read-only: loops are compiled for one kind
    fields = np.empty(heights.size), np.zeros(heights.size, np.bool_), np.zeros((heights.size - 1, 2))
    return Contact._make((*flow(heights, float(pixel), memory, float(depth), *fields), *fields))


@takes(heights=METRE, pixel=METRE, speed=SPEED, depth=METRE)
def sweep_modes(heights, pixel: float, modes: Modes, speed: float, depth: float) -> Contact:
    """Solve steady flow along +x past a rigid profile, linear between its nodes.

    heights : g at equidistant nodes (N,) [m]
    pixel : their spacing [m]
    modes, speed : of the elastomer, and of its flow [m/s]
    depth : d [m], against the same zero as the heights

    The elastomer is at rest before the first node, and relaxes freely behind the last one.
    """
    return swept(_flow, heights, pixel, Solid.of(modes, speed, _SHORTEST * pixel), depth)
