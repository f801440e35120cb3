"""The pixels in contact alone, as a grid: functions on them are vectors, and operators are matrices."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Self

import numpy as np

from .grid import Box, Grid

ROWS = 512  # of a grid, or of a matrix, that are evaluated at a time


@dataclass(frozen=True, eq=False)
class Spots(Grid):
    """Some pixels of a grid; every array on them is a vector (m,).

    row, column : of the pixels on the grid (m,)
    """

    row: np.ndarray = field(kw_only=True)
    column: np.ndarray = field(kw_only=True)

    @classmethod
    def of(cls, grid: Grid, row: np.ndarray, column: np.ndarray) -> Self:
        """Pixels of a square grid."""
        return cls(grid.points, grid.extent, grid.centre, row=row, column=column)

    @property
    def shape(self):
        """Shape (m,) of every array on these pixels."""
        return self.row.shape

    @property
    def x(self):
        """Places of the pixels along the flow [m], (m,)."""
        return super().x[self.column]

    @property
    def y(self):
        """Places of the pixels across the flow [m], (m,)."""
        return super().y[self.row]

    @property
    def places(self):
        """(x, y) of every pixel [m]."""
        return self.x, self.y

    def sampled(self, evaluate: Callable[[np.ndarray, np.ndarray], np.ndarray]) -> np.ndarray:
        """Values (m,) of a function of the coordinates of columns and of rows."""
        rows, row = np.unique(self.row, return_inverse=True)
        columns, column = np.unique(self.column, return_inverse=True)
        x, y, found = super().x[columns], super().y[rows], np.empty(self.shape)
        for first in range(0, len(rows), ROWS):
            here = (row >= first) & (row < first + ROWS)
            found[here] = evaluate(x, y[first : first + ROWS])[row[here] - first, column[here]]
        return found

    def ladder(self, least: int) -> list[Grid]:
        """These pixels alone: their matrices have no coarser ones."""
        return [self]

    def wider(self) -> "Spots":
        """Pixels twice as wide that these lie in."""
        grid = super().wider()
        row, column = np.divmod(np.unique(self._twice(grid.points)), grid.points)
        return Spots(grid.points, grid.extent, grid.centre, row=row, column=column)

    def averaged(self, values: np.ndarray, given: Any) -> np.ndarray:
        """Means over these pixels of values on pixels half as wide; zero where there are none of those."""
        place = np.searchsorted(self.row * self.points + self.column, given._twice(self.points))
        return np.bincount(place, values, len(self.row)) / 4

    def _twice(self, points):
        """Places of the pixels twice as wide, `points` in a row, that these lie in."""
        right, down = self._before
        return (self.row + down) // 2 * points + (self.column + right) // 2

    def box(self, chosen: np.ndarray) -> Box:
        """The smallest box around the chosen pixels."""
        x, y, half = self.x[chosen], self.y[chosen], self.pixel / 2
        return Box(x.min() - half, x.max() + half, y.min() - half, y.max() + half)

    def rim(self, chosen: np.ndarray) -> int:
        """Sides of the chosen pixels beyond which there is none of them."""
        wide = self.points + 2  # a pixel at the end of a row is no neighbour of the first of the next
        place = self.row[chosen] * wide + self.column[chosen]
        return sum(len(place) - np.isin(place + step, place).sum() for step in (1, -1, wide, -wide))

    def on_rim(self, chosen: np.ndarray) -> bool:
        """Whether any chosen pixel lies on the rim of the grid."""
        return any(np.isin(each[chosen], (0, self.points - 1)).any() for each in (self.row, self.column))

    @property
    def reach(self) -> int:
        """Pixels along each axis that a kernel between all of these needs."""
        return int(max(np.ptp(self.row), np.ptp(self.column))) + 1

    def matrix(self, kernel: np.ndarray, odd: bool = False) -> np.ndarray:
        """Kernel from each pixel to each other (m, m).

        kernel : 0, 1, ... pixels aside and downstream; odd : in both, where it is not even in both
        """
        found = np.empty(2 * self.shape)
        for first in range(0, len(found), ROWS):
            part = slice(first, first + ROWS)
            aside, along = (each[part, None] - each for each in (self.row, self.column))
            found[part] = kernel[np.abs(aside), np.abs(along)]
            if odd:
                found[part] *= np.sign(aside) * np.sign(along)
        return found
