"""Grids of pixels on the surface, and boxes around contacts."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache, wraps
from math import isfinite, prod
from typing import TypeVar

import numpy as np

# Points of a grid up to which values are kept, by each method the last ones of as many grids as have KEPT points
# together: at 17 bytes a point 18 MB of each size, and 54 MB at most.
SIZES, KEPT = (2**10, 2**12, 2**14), 2**20

_T = TypeVar("_T")


@dataclass(frozen=True)
class Grid:
    """A square of points x points pixels on extent x extent [m], or one row of them.

    centre : (x, y) [m] from the indenter's axis
    width : of a single row, for contacts that are alike all along y [m]; without it, the grid is a square
    """

    points: int
    extent: float
    centre: tuple[float, float] = (0.0, 0.0)
    width: float | None = None

    @classmethod
    def around(cls, box: "Box", points: int, margin: float, width: float | None = None) -> "Grid":
        """A square, or a row of this width, `margin` times the longer side of a box.

        Its centre is moved to a whole pixel, so that the tip of an indenter lies alike on every grid. Raises
        OverflowError beyond the range of numbers.
        """
        extent = float(margin * box.side)
        if not isfinite(extent + sum(box.centre)):
            raise OverflowError("a window beyond the range of numbers")
        pixel = extent / points
        x, y = (float(round(at / pixel) * pixel) for at in box.centre)
        return cls(points, extent, (x, y), width)

    @property
    def pixel(self) -> float:
        """Side of a pixel [m]."""
        return self.extent / self.points

    @property
    def rows(self) -> int:
        """Pixels along y."""
        return self.points if self.width is None else 1

    @property
    def shape(self) -> tuple[int, int]:
        """(rows, points) of every array on this grid."""
        return self.rows, self.points

    @property
    def patch(self) -> float:
        """Area of a pixel [m^2]."""
        return self.pixel * (self.pixel if self.width is None else self.width)

    @property
    def x(self) -> np.ndarray:
        """Pixel centres along the flow [m], (points,)."""
        return self.centre[0] + self._offsets(self.points)

    @property
    def y(self) -> np.ndarray:
        """Pixel centres across the flow [m], (rows,)."""
        return self.centre[1] + self._offsets(self.rows)

    def _offsets(self, count):
        return (np.arange(count) - (count - 1) / 2) * self.pixel

    @property
    def places(self) -> tuple[np.ndarray, np.ndarray]:
        """(x, y) of the pixels [m], to be broadcast to the shape of the grid."""
        return self.x[None, :], self.y[:, None]

    def sampled(self, evaluate: Callable[[np.ndarray, np.ndarray], np.ndarray]) -> np.ndarray:
        """Values on the grid of a function of coordinates x (points,) and y (rows,)."""
        return evaluate(self.x, self.y)

    def coarser(self) -> "Grid":
        """A grid on this piece with half the points."""
        return replace(self, points=(self.points + 1) // 2)

    def ladder(self, least: int) -> list["Grid"]:
        """This grid, and coarser ones on its piece as long as they have `least` points along each side."""
        grids = [self]
        while grids[-1].points >= 2 * least:
            grids.append(grids[-1].coarser())
        return grids

    def resample(self, values: np.ndarray, given: "Grid") -> np.ndarray:
        """Values of another grid by bilinear interpolation; beyond its outermost points, the nearest values."""
        for axis, position in enumerate(self._positions(given)):
            values = _interpolated(values, position, axis)
        return values

    def wider(self) -> "Grid":
        """A grid of pixels twice as wide around all of these; a corner on the indenter's axis stays a corner.

        Where the tip lies in its pixel decides the error of a cone.
        """
        before = self._before
        points = (self.points + max(before) + 1) // 2
        x, y = (
            at + (points - self.points / 2 - more) * self.pixel
            for at, more in zip(self.centre, before, strict=True)
        )
        return replace(
            self, points=points, extent=2 * points * self.pixel, centre=(x, y if self.width is None else 0.0)
        )

    @property
    def _before(self) -> tuple[int, int]:
        """Pixels along x and y to add before the first, for pixels twice as wide to have corners on the axis."""
        x, y = (int(np.floor(self.points / 2 - at / self.pixel + 0.5)) % 2 for at in self.centre)
        return x, y if self.width is None else 0

    def averaged(self, values: np.ndarray, given: "Grid") -> np.ndarray:
        """Means over these pixels of values that are constant on pixels of another grid, and zero beyond it."""
        along = _overlap(self, given, 0)
        across = _overlap(self, given, 1) if self.width is None else np.ones((1, 1))
        return across @ values @ along.T

    def resampled_contact(self, pressure: np.ndarray, given: "Grid") -> np.ndarray:
        """A pressure of another grid, zero where the nearest pixel there has none.

        Otherwise interpolation would let the contact grow by a rim.
        """
        return self.resample(pressure, given) * self.nearest(pressure > 0, given)

    def nearest(self, chosen: np.ndarray, given: "Grid") -> np.ndarray:
        """Whether the nearest pixel of another grid is chosen (rows, points); False beyond its outermost ones."""
        found = np.zeros((given.rows + 2, given.points + 2), bool)
        found[1:-1, 1:-1] = chosen
        for axis, position in enumerate(self._positions(given)):
            # Halfway between two, the later one, whatever rounding says.
            nearest = np.clip(np.floor(position + (0.5 + 1e-6)).astype(int), -1, given.shape[axis])
            found = found.take(nearest + 1, axis)
        return found

    def _positions(self, given):
        """Positions of the rows, then of the columns, of this grid among those of another, in its pixels."""
        yield (self.y - given.y[0]) / given.pixel
        yield (self.x - given.x[0]) / given.pixel

    def box(self, chosen: np.ndarray) -> "Box":
        """The smallest box around the chosen pixels; chosen (rows, points) bool, at least one True."""
        x, y = self.x[chosen.any(axis=0)], self.y[chosen.any(axis=1)]
        half, across = self.pixel / 2, self.pixel / 2 if self.width is None else 0.0
        return Box(x[0] - half, x[-1] + half, y[0] - across, y[-1] + across)

    def spot_radius(self, chosen: np.ndarray) -> float:
        """Radius [m] of a disc with the area over rim of the chosen pixels; of a row half the width of a strip."""
        area, rim = np.count_nonzero(chosen), self.rim(chosen)
        # Pixels make the rim of a disc 4/pi times as long.
        return self.pixel * area / rim if self.rows == 1 else self.pixel * 8 / np.pi * area / rim

    def rim(self, chosen: np.ndarray) -> int:
        """Sides of the chosen pixels beyond which there is none of them; of a row only those at its ends."""
        ways = (chosen,) if self.rows == 1 else (chosen, chosen.T)
        inner = sum(np.count_nonzero(lines[:, 1:] != lines[:, :-1]) for lines in ways)
        return int(inner + sum(np.count_nonzero(lines[:, [0, -1]]) for lines in ways))

    def on_rim(self, chosen: np.ndarray) -> bool:
        """Whether any chosen pixel lies on the rim; a single row ends at its first and last pixel only."""
        return bool(chosen[:, [0, -1]].any() or (self.width is None and chosen[[0, -1]].any()))


@dataclass(frozen=True)
class Piece(Grid):
    """A rectangle of square pixels; `points` along the flow."""

    lines: int = 1

    @property
    def rows(self) -> int:
        """Pixels along y."""
        return self.lines


def _overlap(grid, given, axis):
    """Shares of the pixels of a grid that pixels of another cover, along an axis (points, given points)."""
    edges, others = (
        (np.arange(each.points + 1) - each.points / 2) * each.pixel + each.centre[axis] for each in (grid, given)
    )
    covered = np.minimum(edges[1:, None], others[1:]) - np.maximum(edges[:-1, None], others[:-1])
    return np.maximum(covered, 0.0) / grid.pixel


def _interpolated(values, position, axis):
    given = values.shape[axis]
    if given == 1:
        return values.take(np.zeros(position.size, int), axis)
    lower = np.clip(np.floor(position).astype(int), 0, given - 2)
    share = np.clip(position - lower, 0.0, 1.0)
    share = share[:, None] if axis == 0 else share
    between, beyond = values.take(lower, axis), values.take(lower + 1, axis)
    beyond -= between
    beyond *= share
    between += beyond
    return between


@dataclass(frozen=True)
class Box:
    """A rectangle of surface, sides along x and y [m]."""

    left: float
    right: float
    lower: float
    upper: float

    @property
    def side(self) -> float:
        """The longer side [m]."""
        return max(self.right - self.left, self.upper - self.lower)

    @property
    def centre(self) -> tuple[float, float]:
        """(x, y) [m]."""
        return (self.left + self.right) / 2, (self.lower + self.upper) / 2

    def padded(self, by: float) -> "Box":
        """Larger by a length [m] on every side."""
        return Box(self.left - by, self.right + by, self.lower - by, self.upper + by)

    def union(self, other: "Box") -> "Box":
        """The smallest box around both."""
        return Box(
            min(self.left, other.left),
            max(self.right, other.right),
            min(self.lower, other.lower),
            max(self.upper, other.upper),
        )


def cached_on_small_grids(evaluate: Callable[..., _T]) -> Callable[..., _T]:
    """Decorator of a method of a frozen medium and a grid: keep its last values on small grids, wherever they lie.

    Values are found by the digits of all that they depend on, so that an answer does not depend on earlier solves.
    They must not be written into.
    """
    remembered = {size: lru_cache(KEPT // size)(evaluate) for size in SIZES}

    @wraps(evaluate)
    def of(medium, grid):
        found = next((remembered[size] for size in SIZES if prod(grid.shape) <= size), evaluate)
        return found(medium, replace(grid, centre=(0.0, 0.0)))

    return of
