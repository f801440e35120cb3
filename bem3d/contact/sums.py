"""The sums and updates of an iteration on the points of contact, each in one pass.

Values on the points of contact are vectors (m,); `where` (m,) are their places in a flattened plane, ascending.
"""

import numpy as np

from scene import loops

# Sums may be reordered, so that they vectorize; nothing else about the arithmetic is relaxed.
compiled = loops.compiled(fastmath={"reassoc", "contract", "nsz"})

LEAST = -np.inf  # pressure that a foundation may have
ROWS = 8  # marched side by side: a pixel waits for the one before it, but not for its neighbours aside
DISPLACEMENT, FREE, PRESSURE = range(3)
NOWHERE = np.zeros((0, 0), bool)


def scatter(values, where, plane):
    """Write values to their places in the plane."""
    _scatter(values, where, plane.reshape(-1))


def gather(plane, where, out, first, second):
    """Read values at their places into `out`; return their sum and their inner products with two vectors."""
    return _gather(plane.reshape(-1), where, out, first, second)


def gaps(displacement, heights, level, contact, gap):
    """Write gap = displacement + heights - level; return the largest |gap| in contact and penetration outside."""
    flat = (a.reshape(-1) for a in (displacement, heights))
    return _gaps(*flat, level, contact.reshape(-1), gap.reshape(-1))


def foundation_displacement(plane, foundation):
    """Replace a pressure (ny, nx), in place, by the displacement of a foundation under it."""
    states = _zeros(plane, foundation)
    if foundation.wraps:
        _march(plane.copy(), NOWHERE, foundation, states, DISPLACEMENT)
        states /= 1 - foundation.kept[:, None] ** plane.shape[1]
    _march(plane, NOWHERE, foundation, states, DISPLACEMENT)


def with_free_surface(plane, contact, foundation):
    """Let the displacement (ny, nx) of a foundation relax freely, in place, wherever it is not in contact."""
    _march(plane, contact, foundation, _entering(plane, contact, foundation), FREE)


def foundation_pressure(plane, contact, foundation, least=LEAST):
    """Replace the displacement of a foundation, in place, by the pressure on it: zero out of contact.

    least : lowest pressure allowed
    """
    states = _entering(plane, contact, foundation)
    if foundation.wraps and least > LEAST:
        _march(plane.copy(), contact, foundation, states, PRESSURE, least)
    _march(plane, contact, foundation, states, PRESSURE, least)


def _zeros(plane, foundation):
    return np.zeros((len(foundation.kept), len(plane)))


def _march(plane, contact, foundation, states, what, least=LEAST):
    _lap(plane, contact, foundation.at_once, foundation.kept, foundation.gained, states, what, least)


def _entering(plane, contact, foundation):
    """States (K, ny) with which a row begins; where it wraps, those with which it ends."""
    given = _zeros(plane, foundation)
    if not foundation.wraps:
        return given
    _march(plane.copy(), contact, foundation, given, PRESSURE)
    # The end of a row is linear in its beginning.
    ends = [_zeros(plane, foundation) for _ in foundation.kept]
    for mode, end in enumerate(ends):
        end[mode] = 1.0
        _march(np.zeros_like(plane), contact, foundation, end, PRESSURE)
    gone = np.eye(len(ends)) - np.stack(ends).transpose(2, 1, 0)
    return np.linalg.solve(gone, given.T[..., None])[..., 0].T


@compiled
def update_solution(x, r, direction, image, step, mean):
    """x += step direction, r -= step (image - mean); returns the square norm and the largest entry of r."""
    square = largest = 0.0
    for i in range(x.size):
        x[i] += step * direction[i]
        value = r[i] - step * (image[i] - mean)
        r[i] = value
        square += value * value
        largest = max(largest, abs(value))
    return square, largest


@compiled
def update_direction(direction, z, mean, beta):
    """direction = z - mean + beta direction."""
    for i in range(z.size):
        direction[i] = z[i] - mean + beta * direction[i]


@compiled
def _scatter(values, where, plane):
    for i in range(where.size):
        plane[where[i]] = values[i]


@compiled
def _gather(plane, where, out, first, second):
    total = with_first = with_second = 0.0
    for i in range(where.size):
        value = plane[where[i]]
        out[i] = value
        total += value
        with_first += value * first[i]
        with_second += value * second[i]
    return total, with_first, with_second


@compiled
def _gaps(displacement, heights, level, contact, gap):
    inside = outside = 0.0
    for i in range(gap.size):
        value = displacement[i] + heights[i] - level
        gap[i] = value
        if contact[i]:
            inside = max(inside, abs(value))
        else:
            outside = max(outside, -value)
    return inside, outside


@compiled
def _lap(plane, contact, at_once, kept, gained, states, what, least):
    stiffness, modes = 1 / at_once, kept.size
    known, pressure, of_rows = np.empty(ROWS), np.zeros(ROWS), np.zeros((modes, ROWS))
    for first in range(0, plane.shape[0], ROWS):
        rows = min(ROWS, plane.shape[0] - first)
        of_rows[:, :rows] = states[:, first : first + rows]
        for x in range(plane.shape[1]):
            known[:] = 0.0
            for k in range(modes):
                for j in range(ROWS):
                    of_rows[k, j] *= kept[k]
                    known[j] += of_rows[k, j]
            for j in range(rows):
                y, given = first + j, plane[first + j, x]
                if what == DISPLACEMENT:
                    pressure[j] = given
                    plane[y, x] = known[j] + at_once * given
                else:
                    pressure[j] = max((given - known[j]) * stiffness, least) if contact[y, x] else 0.0
                    plane[y, x] = pressure[j] if what == PRESSURE else given if contact[y, x] else known[j]
            for k in range(modes):
                for j in range(ROWS):
                    of_rows[k, j] += gained[k] * pressure[j]
        states[:, first : first + rows] = of_rows[:, :rows]
