"""Steady flow of a Kelvin foundation past a rigid, piecewise linear profile, in plain numbers.

With l = v tau, the length that it travels in one relaxation time, an element displaced by u carries the force
f = u + l u', Eq. 5 of Popov et al., Sci. Rep. 4, 3750 (2014). Where it touches, u = d - g and
f = d - g - l g' >= 0, Eq. 6; where it does not, f = 0 and u decays as exp(-x/l). The sweep of `steady` does the
same with arrays of modes: without them this is three times as fast, and most of what the paper asks is this.
"""

from math import exp, expm1, log, nan

import numpy as np

from scene.quantities import METRE, takes

from .element import NOWHERE, compiled, summed
from .steady import Contact, swept

# Part of the lengths of an interval that squared is none.
_CLOSE = 1e-9
# Intervals that are tested together for contact throughout.
_TOGETHER = 64


@compiled
def _landing(here, there, slope, pixel, u, memory, decay):
    """Place in an interval, from its left node, at which the free surface meets the profile, and its height there.

    NOWHERE if it does not. here, there : d - g at the left and the right node; u : displacement of the free
    surface at the left node. The clearance u exp(-t/l) - (d - g) is convex: it has one minimum, and Newton from
    the left never oversteps.
    """
    if u == 0.0:
        if here > 0.0:
            return 0.0, u
        return (min(here / slope, pixel) if there > 0.0 else NOWHERE), u
    if memory * slope >= u:
        return NOWHERE, u
    clearance, u_end = u - here, u * decay
    if clearance <= 0.0:
        return 0.0, u
    closest = pixel
    if memory * slope <= u_end:
        met = there > u_end
    else:
        # It lies above its tangents at both nodes: only if those meet below zero is there anything to search.
        rate, rate_end = slope - u / memory, slope - u_end / memory
        meet = (u_end - there - rate_end * pixel - clearance) / (rate - rate_end)
        if u_end > there and clearance + rate * meet > 0.0:
            return NOWHERE, u
        closest = min(memory * log(u / (memory * slope)), pixel)
        met = -clearance - slope * closest - u * expm1(-closest / memory) > 0.0
    if not met:
        return NOWHERE, u
    t = min(here / slope, pixel) if slope < 0.0 and here < 0.0 else 0.0
    fallen = 0.0
    for _ in range(100):
        fallen = -u * expm1(-t / memory)
        overlap = fallen - clearance - slope * t
        rate = (u - fallen) / memory - slope
        if overlap >= 0.0 or rate <= 0.0:
            break
        step = -overlap / rate
        if t + step >= closest:
            return closest, u * exp(-closest / memory)
        # The error of Newton's method is the square of its step.
        if step <= _CLOSE * min(pixel, memory) or t + step == t:
            return t + step, (u - fallen) * (1.0 - step / memory)
        t += step
    return t, u - fallen


@compiled
def _clear(heights, i, depth, u, decay, displacement):
    """Number of intervals from a free node on in which the profile stays above the free surface at their end.

    Returns the one after them, and u at its left node.
    """
    while i < heights.size - 1:
        u_end = u * decay
        if depth - min(heights[i], heights[i + 1]) > u_end:
            break
        if displacement is not None:
            displacement[i] = u
        u = u_end
        i += 1
    return i, u


@compiled
def _releases(heights, pixel, memory, depth):
    """Number of intervals in which contact ends that begins at their left node."""
    count, per_pixel = 0, 1.0 / pixel
    for k in range(heights.size - 1):
        slope = (heights[k + 1] - heights[k]) * per_pixel
        count += 1 if depth - heights[k + 1] <= memory * slope else 0
    return count


@summed
def _sums(heights, pixel, memory, depth):
    """Force, traction and squared slopes, each over the pixel, of intervals that touch throughout."""
    force = traction = squares = 0.0
    per_pixel = 1.0 / pixel
    for k in range(heights.size - 1):
        slope = (heights[k + 1] - heights[k]) * per_pixel
        mean = depth - 0.5 * (heights[k] + heights[k + 1]) - memory * slope
        force += mean
        traction -= slope * mean
        squares += slope * slope
    return force, traction, squares


@compiled
def _pressed(heights, i, pixel, memory, depth, displacement, touching, pushed):
    """First interval after those that touch throughout from a node on, and their sums.

    Most of a sweep are these, and a processor takes some of them at once.
    """
    begun, nodes = i, heights.size
    while i + _TOGETHER < nodes and _releases(heights[i : i + _TOGETHER + 1], pixel, memory, depth) == 0:
        i += _TOGETHER
    while i < nodes - 1 and _releases(heights[i : i + 2], pixel, memory, depth) == 0:
        i += 1
    if displacement is not None:
        for k in range(begun, i):
            slope = (heights[k + 1] - heights[k]) / pixel
            displacement[k], touching[k] = depth - heights[k], True
            pushed[k, 0] = pixel
            pushed[k, 1] = pixel * (depth - 0.5 * (heights[k] + heights[k + 1]) - memory * slope)
    force, traction, squares = _sums(heights[begun : i + 1], pixel, memory, depth)
    return i, force, traction, squares


@compiled
def flow_kelvin(heights, pixel, memory, depth, displacement=None, touching=None, pushed=None):
    decay = exp(-pixel / memory) if memory > 0.0 else 0.0
    force = traction = length = slope_square = lost = reach = 0.0
    first = last = nan
    touches = False
    u = 0.0  # of the free surface at the node
    left = 0.0  # displacement at which the surface last left the profile
    i, nodes = np.intp(0), heights.size  # a literal would have what it is passed to compiled once more
    while i < nodes - 1:
        if touches:
            begun = i
            i, push, pull, squares = _pressed(heights, i, pixel, memory, depth, displacement, touching, pushed)
            force += pixel * push
            traction += pixel * pull
            slope_square += pixel * squares
            length += pixel * (i - begun)
        else:
            i, u = _clear(heights, i, depth, u, decay, displacement)
        if i == nodes - 1:
            break
        here = depth - heights[i]
        there = depth - heights[i + 1]
        slope = (heights[i + 1] - heights[i]) / pixel
        if displacement is not None:
            displacement[i] = here if touches else u
            touching[i] = touches
        begin, start = 0.0, here
        if not touches:
            begin, met = _landing(here, there, slope, pixel, u, memory, decay)
            if begin == NOWHERE:
                u *= decay
                i += 1
                continue
            if begin > 0.0:
                # Where the free surface meets the flank, the flatter of the two knows the height.
                start = met if met < memory * abs(slope) or u == 0.0 else max(here - slope * begin, 0.0)
            lost += 0.5 * (left - start) * (left + start)
            reach += memory * (1.0 - start / left) if left > 0.0 else memory
            if first != first:
                first = i * pixel + begin
            touches = True
        end, finish = pixel, there
        if there <= memory * slope and slope > 0.0:
            pressing = start - memory * slope
            if pressing <= 0.0:
                end, finish = begin, start
            elif begin + pressing / slope < pixel:
                end, finish = begin + pressing / slope, memory * slope
        # Only the heights know the width of a first touch just before a node.
        width = (start - finish) / slope if begin > 0.0 and slope < 0.0 else end - begin
        push = width * (0.5 * (start + finish) - memory * slope)
        if pushed is not None:
            pushed[i, 0] = width
            pushed[i, 1] = push
        force += push
        traction -= slope * push
        length += width
        slope_square += slope * slope * width
        if end < pixel:
            touches = False
            left = finish
            u = left * exp(-(pixel - end) / memory) if memory > 0.0 else 0.0
            last = i * pixel + end
        i += 1
    if displacement is not None:
        displacement[i] = depth - heights[i] if touches else u
        touching[i] = touches
    if touches:
        last = i * pixel
        left = depth - heights[i]
    lost += 0.5 * left * left
    return force, memory * slope_square + lost, traction, length + reach, length, slope_square, first, last


@takes(heights=METRE, pixel=METRE, memory=METRE, depth=METRE)
def sweep(heights, pixel: float, memory: float, depth: float) -> Contact:
    """Solve steady flow along +x past a rigid profile, linear between its nodes.

    heights : g at equidistant nodes (N,) [m]
    pixel : their spacing [m]
    memory : l = v tau >= 0 [m]; zero is the elastic foundation
    depth : d [m], against the same zero as the heights

    The elastomer is at rest before the first node, and relaxes freely behind the last one.
    """
    return swept(flow_kelvin, heights, pixel, float(memory), depth)
