"""The sums and updates of an iteration on the points of contact, each in one pass: the only door to numba.

Values on the points of contact are vectors (m,); `where` (m,) are their places in a flattened plane, ascending.
`Plain` says in whole-array arithmetic what `Fused` does in one loop, and is what runs where numba does not.
"""

import numpy as np
from numba import njit

# Sums may be reordered, so that they vectorize; nothing else about the arithmetic is relaxed.
compiled = njit(cache=True, nogil=True, fastmath={"reassoc", "contract", "nsz"})


class Plain:
    """By the arrays of a module xp, numpy or cupy."""

    def __init__(self, xp=np):
        self.xp = xp

    def put(self, values, where, plane):
        """values onto the plane at their places."""
        plane.reshape(-1)[where] = values

    def take(self, plane, where, out, first, second):
        """Values at the places into out; their sum and their products with two vectors."""
        out[:] = plane.reshape(-1)[where]
        return float(out.sum()), float((out * first).sum()), float((out * second).sum())

    def advance(self, x, r, direction, image, step, mean):
        """x += step direction, r -= step (image - mean); returns the square norm and the largest entry of r."""
        x += step * direction
        r -= step * (image - mean)
        return float((r * r).sum()), float(abs(r).max())

    def turn(self, direction, z, mean, beta):
        """direction = z - mean + beta direction."""
        direction *= beta
        direction += z - mean

    def gaps(self, displacement, heights, level, contact, gap):
        """gap = displacement + heights - level; largest |gap| in contact, deepest penetration outside."""
        gap[:] = displacement + heights - level
        inside = float(self.xp.where(contact, abs(gap), 0.0).max())
        return inside, float(-self.xp.where(contact, 0.0, gap).min())


class Fused:
    """One loop each, by numba."""

    xp = np

    def put(self, values, where, plane):
        _put(values, where, plane.reshape(-1))

    def take(self, plane, where, out, first, second):
        return _take(plane.reshape(-1), where, out, first, second)

    def advance(self, x, r, direction, image, step, mean):
        return _advance(x, r, direction, image, step, mean)

    def turn(self, direction, z, mean, beta):
        _turn(direction, z, mean, beta)

    def gaps(self, displacement, heights, level, contact, gap):
        flat = (a.reshape(-1) for a in (displacement, heights))
        return _gaps(*flat, level, contact.reshape(-1), gap.reshape(-1))


@compiled
def _put(values, where, plane):
    for i in range(where.size):
        plane[where[i]] = values[i]


@compiled
def _take(plane, where, out, first, second):
    total = along = beside = 0.0
    for i in range(where.size):
        value = plane[where[i]]
        out[i] = value
        total += value
        along += value * first[i]
        beside += value * second[i]
    return total, along, beside


@compiled
def _advance(x, r, direction, image, step, mean):
    square = largest = 0.0
    for i in range(x.size):
        x[i] += step * direction[i]
        value = r[i] - step * (image[i] - mean)
        r[i] = value
        square += value * value
        largest = max(largest, abs(value))
    return square, largest


@compiled
def _turn(direction, z, mean, beta):
    for i in range(z.size):
        direction[i] = z[i] - mean + beta * direction[i]


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
