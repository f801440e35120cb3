"""The sums and updates of an iteration on the points of contact, each in one pass.

Values on the points of contact are vectors (m,); `where` (m,) are their places in a flattened plane, ascending.
`Plain` says in whole-array arithmetic what `Fused` does in one loop, and is what runs where numba does not.
"""

import numpy as np

from scene import loops

# Sums may be reordered, so that they vectorize; nothing else about the arithmetic is relaxed.
compiled = loops.compiled(fastmath={"reassoc", "contract", "nsz"})

LEAST = -np.inf  # pressure that a foundation may have
ROWS = 8  # marched side by side: a pixel waits for the one before it, but not for its neighbours aside
SINK, RELEASE, PUSH = range(3)
NOWHERE = np.zeros((0, 0), bool)


class Marching:
    """Along the flow over a foundation (see `foundation`), in place, on what `_lap` does on arrays of `xp`."""

    def sink(self, plane, foundation):
        """Pressure (ny, nx) to the displacement that it makes of a foundation."""
        states = self._zeros(plane, foundation)
        if foundation.wraps:
            self._lap(plane.copy(), NOWHERE, foundation, states, SINK)
            states /= 1 - self._modes(foundation) ** plane.shape[1]
        self._lap(plane, NOWHERE, foundation, states, SINK)

    def release(self, plane, contact, foundation):
        """Displacement of a foundation in contact (ny, nx): elsewhere it becomes that of a surface left alone."""
        self._lap(plane, contact, foundation, self._entering(plane, contact, foundation), RELEASE)

    def push(self, plane, contact, foundation, least=LEAST):
        """Displacement of a foundation in contact to pressure, zero elsewhere; no less than `least`."""
        states = self._entering(plane, contact, foundation)
        if foundation.wraps and least > LEAST:
            self._lap(plane.copy(), contact, foundation, states, PUSH, least)
        self._lap(plane, contact, foundation, states, PUSH, least)

    def _modes(self, foundation):
        return self.xp.asarray(foundation.kept)[:, None]

    def _zeros(self, plane, foundation):
        return self.xp.zeros((len(foundation.kept), len(plane)))

    def _entering(self, plane, contact, foundation):
        """States (K, ny) with which a row begins; where it wraps, those with which it ends."""
        given = self._zeros(plane, foundation)
        if not foundation.wraps:
            return given
        self._lap(plane.copy(), contact, foundation, given, PUSH)
        # The end of a row is linear in its beginning.
        ends = [self._zeros(plane, foundation) for _ in foundation.kept]
        for mode, end in enumerate(ends):
            end[mode] = 1.0
            self._lap(self.xp.zeros_like(plane), contact, foundation, end, PUSH)
        gone = self.xp.eye(len(ends)) - self.xp.stack(ends).transpose(2, 1, 0)
        return self.xp.linalg.solve(gone, given.T[..., None])[..., 0].T


class Plain(Marching):
    """Sums and updates of an iteration by the arrays of a module xp, numpy or cupy."""

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

    def _lap(self, plane, contact, foundation, states, what, least=LEAST):
        """Column by column downstream; `states` (K, ny) are those before the first, then those of the last."""
        gained, where = self.xp.asarray(foundation.gained)[:, None], self.xp.where
        kept = self._modes(foundation)
        for x in range(plane.shape[1]):
            states *= kept
            known, given = states.sum(axis=0), plane[:, x].copy()
            if what == SINK:
                pressure = given
                plane[:, x] = known + foundation.at_once * pressure
            else:
                pressure = self.xp.maximum((given - known) / foundation.at_once, least)
                pressure = where(contact[:, x], pressure, 0.0)
                plane[:, x] = pressure if what == PUSH else where(contact[:, x], given, known)
            states += gained * pressure

    def gaps(self, displacement, heights, level, contact, gap):
        """gap = displacement + heights - level; largest |gap| in contact, deepest penetration outside."""
        gap[:] = displacement + heights - level
        inside = float(self.xp.where(contact, abs(gap), 0.0).max())
        return inside, float(-self.xp.where(contact, 0.0, gap).min())


class Fused(Marching):
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

    def _lap(self, plane, contact, foundation, states, what, least=LEAST):
        _lap(plane, contact, foundation.at_once, foundation.kept, foundation.gained, states, what, least)

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
                if what == SINK:
                    pressure[j] = given
                    plane[y, x] = known[j] + at_once * given
                else:
                    pressure[j] = max((given - known[j]) * stiffness, least) if contact[y, x] else 0.0
                    plane[y, x] = pressure[j] if what == PUSH else given if contact[y, x] else known[j]
            for k in range(modes):
                for j in range(ROWS):
                    of_rows[k, j] += gained[k] * pressure[j]
        states[:, first : first + rows] = of_rows[:, :rows]
