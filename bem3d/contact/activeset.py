"""The complementarity problem of contact: from an operator and heights to a pressure, without physics.

Find p >= 0 with gap = A p + z - d >= 0 and p * gap = 0 on every point, for a depth d given or such that
sum(p) = load. The operator A is positive definite; it need not be symmetric.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..response.medium import Foundation
from . import sums
from .krylov import conjugate_gradients, direct, gmres

ROUNDS = 400  # sets of contact tried before giving up, and one more a pixel along; 5 to 20 are usual
ACCURACY = 0.3  # of the error on one set of contact: rougher solves drop what belongs to it
ADDED = 0.3  # of the penetration outside: what may be left inside when the set grows; at 1 it cycles
PATIENCE = 30  # rounds after which solves are closer by a tenth, each time: rough ones can cycle
INNER_ITERATIONS = 60
FEW = 8  # points that span the least height to which errors are referred


class NotConverged(RuntimeError):
    """No set of contact was found on which all conditions hold to the tolerance."""


@dataclass(frozen=True)
class Contact:
    """A solved contact: planes (ny, nx), and numbers.

    displacement : by the pressure; where heights are many orders greater, the gap has lost it
    violation : as `tolerance` measures it; rounds : sets tried
    """

    pressure: np.ndarray
    displacement: np.ndarray
    gap: np.ndarray
    depth: float
    lowest: float
    violation: float
    rounds: int


def solve(
    operator: Callable,
    heights: np.ndarray,
    start: np.ndarray,
    tolerance: float,
    depth: float | None = None,
    load: float | None = None,
    precondition: Callable | None = None,
    foundation: Foundation | None = None,
    symmetric: bool = False,
) -> Contact:
    """Solve on a set of contact and drop what pulls; add what penetrates once that outweighs what is left.

    Sets that follow one another in a cycle are joined: what pulls is then dropped from one that holds them all.

    start : pressure to begin with (ny, nx), >= 0; its support is the first set of contact
    tolerance : largest |gap| in contact and penetration outside, over the depth of the lowest height, d - min(z),
        or what the heights in contact span where that is more (depths under a line may be negative)
    depth, load : exactly one; load is sum(p)
    precondition : approximate inverse, on the whole grid, of the operator without its foundation
    foundation : under a flow, what of the operator remembers along x
    symmetric : conjugate gradients, else GMRES, on a single row elimination

    Raises NotConverged.
    """
    solver = conjugate_gradients if symmetric else direct if len(heights) == 1 else gmres
    heights = np.ascontiguousarray(heights)
    pressure, accuracy = np.array(start, order="C"), ACCURACY
    _balance(pressure, load)
    gap, displacement = np.empty(heights.shape), np.empty(heights.shape)
    lowest, least = float(heights.min()), float(np.partition(heights.reshape(-1), FEW)[FEW] - heights.min())
    most, deepest = ROUNDS + max(heights.shape), np.inf
    on_set = _OnSet(operator, precondition, foundation, depth is None, heights.shape)
    marked, tried = np.zeros((2, *heights.shape), bool)
    for rounds in range(1, most + 1):
        contact = pressure > 0
        if not contact.any():
            raise NotConverged("nothing is pressed: the pressure is below the range of numbers")
        operator(pressure, out=displacement)
        mean, highest = _levels(displacement, heights, np.flatnonzero(contact))
        level = mean if depth is None else depth
        inside, outside = sums.gaps(displacement, heights, level, contact, gap)
        aim = tolerance * max(level - lowest, highest - lowest, least)
        violation = max(inside, outside) / aim * tolerance
        if inside <= aim and outside <= aim:
            return Contact(pressure, displacement, gap, level, lowest, violation, rounds)
        if inside <= max(aim, ADDED * outside):
            contact |= gap < -aim
            if outside > deepest / 2:  # what was added the last time was dropped again: solve closer
                accuracy /= 4
            deepest = outside
        tried |= contact
        if rounds % PATIENCE == 0:
            accuracy /= 10
            marked, tried = contact, contact.copy()
        elif (contact == marked).all():
            contact = tried.copy()
        on_set.set_contact(contact)
        correction = solver(on_set, -on_set.restricted(gap), accuracy, aim, INNER_ITERATIONS)
        on_set.add(correction, pressure)
        if not pressure.any():  # a poor start, solved too roughly: begin again with what overlaps, and closer
            pressure, accuracy = np.maximum(level - heights, 0.0), accuracy / 4
        _balance(pressure, load)
    raise NotConverged(f"after {most} sets of contact the violation is {violation:.2e}, wanted {tolerance:.2e}")


def misfit(operator: Callable, heights, pressure, depth: float | None = None, load: float | None = None) -> float:
    """Mean |gap| under a pressure, weighted with it: how far a start is from the answer.

    The pressure is scaled to the load, if there is one.
    """
    _balance(pressure, load)
    gap = operator(pressure) + heights
    level = gap[pressure > 0].mean() if depth is None else depth
    return float((pressure * abs(gap - level)).sum() / pressure.sum())


def first_guess(heights: np.ndarray, count: int) -> np.ndarray:
    """First pressure under a load: on about `count` of the lowest points, in proportion to their overlap."""
    level = np.partition(heights, count, axis=None)[count]
    overlap = np.maximum(level - heights, 0.0)
    # Where they are all alike, none is deeper than the others.
    return overlap if overlap.any() else (heights == level).astype(float)


def _levels(displacement, heights, where):
    """Depth at which the mean gap of the points of contact is zero, and their greatest height."""
    touched = heights.reshape(-1)[where]
    return float((displacement.reshape(-1)[where] + touched).mean()), float(touched.max())


def _balance(pressure, load):
    if load is not None and pressure.any():
        pressure *= load / pressure.sum()


class _OnSet:
    """The operator on the points of contact alone; at given load on corrections that keep the load."""

    def __init__(self, operator, precondition, foundation, mean_free, shape):
        self.mean_free = mean_free
        self._operator, self._precondition, self._foundation = operator, precondition, foundation
        self._plane, self._image = np.zeros(shape), np.empty(shape)
        self._lifted = None

    def set_contact(self, contact):
        """Set the points of contact, a bool array (ny, nx)."""
        self.where, self._contact = np.flatnonzero(contact), contact
        self._plane[:] = 0

    def restricted(self, plane):
        """Values of a plane on the set of contact."""
        values = plane.reshape(-1)[self.where]
        return values - values.mean() if self.mean_free else values

    def add(self, correction, pressure):
        """Add a correction (m,) on the set to the pressure (ny, nx), in place, and drop what then pulls.

        Under a flow the pixels that still press keep the displacement of the foundation, and not their pressure:
        where a leading edge pulled, the pixels behind it press less.
        """
        values = pressure.reshape(-1)[self.where] + correction
        if self._foundation is None:
            values = np.maximum(values, 0.0)
        sums.scatter(values, self.where, pressure)
        if values.min() < 0:
            sums.foundation_displacement(pressure, self._foundation)
            sums.foundation_pressure(pressure, self._contact, self._foundation, least=0.0)

    def row(self):
        """Displacement of a single row under a unit load on its first pixel, and on its last."""
        plane = np.zeros_like(self._plane)
        images = []
        for place in (0, -1):
            plane[:] = 0
            plane[0, place] = 1.0
            images.append(self._operator(plane)[0])
        return images

    def operator(self, values, out, first, second):
        """Write the operator's values into `out`; return their mean and their inner products with two vectors.

        The mean is zero unless corrections are to keep the load.
        """
        return self._through(self._operator, values, out, first, second)

    def precondition(self, values, out, first, second):
        """As `operator`, for the approximate inverse."""
        if self._precondition is None:
            out[:] = values
            return 0.0, float((values * first).sum()), float((values * second).sum())
        return self._through(self._precondition, values, out, first, second)

    def _through(self, product, values, out, first, second):
        sums.scatter(values, self.where, self._plane)
        product(self._plane, out=self._image)
        total, with_first, with_second = sums.gather(self._image, self.where, out, first, second)
        # The vectors are free of mean themselves where means are taken off: their products need no correction.
        return total / out.size if self.mean_free else 0.0, with_first, with_second

    def pressed(self, displaced_foundation):
        """Pressure (m,) under which the foundation has a given displacement (m,)."""
        return self._push(displaced_foundation).reshape(-1)[self.where]

    def displaced(self, displaced_foundation):
        """Displacement of the surface by the pressure of `pressed`; at given load without its mean."""
        self._operator(self._push(displaced_foundation), out=self._image)
        return self.restricted(self._image)

    def foundation_displacement(self, displacement):
        """Approximate displacement (m,) of the foundation for a displacement of the surface (m,).

        Behind each spot of contact the displacement relaxes as on a free surface. If it were cut off there, it
        would jump by more the longer the memory is. At given load a level is added that keeps the load.
        """
        values = self._inverted(displacement).reshape(-1)[self.where]
        if not self.mean_free:
            return values
        return values - float((self._worth * values).sum()) * self._level

    def prepare_load_constraint(self):
        """Prepare the load constraint of this set: the level, and the load per displacement of each point."""
        if not self.mean_free:
            return
        if self._lifted is None:  # by a unit displacement everywhere: close enough on all sets that follow
            self._lifted = self._inverted(np.ones(len(self.where))).copy()
        # The sum of pressures as a sum of what sinks: the transpose of pushing is pushing upstream.
        worth, contact = np.ones(self._plane.shape), np.ascontiguousarray(self._contact[:, ::-1])
        if self._foundation is not None:
            sums.foundation_pressure(worth, contact, self._foundation)
        self._worth = np.ascontiguousarray(worth[:, ::-1]).reshape(-1)[self.where]
        level = self._lifted.reshape(-1)[self.where]
        self._level = level / float((self._worth * level).sum())

    def _push(self, displaced_foundation):
        sums.scatter(displaced_foundation, self.where, self._plane)
        if self._foundation is not None:
            sums.foundation_pressure(self._plane, self._contact, self._foundation)
        return self._plane

    def _inverted(self, displacement):
        self._plane[:] = 0
        sums.scatter(displacement, self.where, self._plane)
        if self._foundation is not None:
            sums.with_free_surface(self._plane, self._contact, self._foundation)
        if self._precondition is None:
            return self._plane
        self._precondition(self._plane, out=self._image)
        return self._image
