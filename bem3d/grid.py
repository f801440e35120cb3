"""The square of surface on which a contact is sought."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Grid:
    """points x points square pixels on extent x extent [m]; centre (x, y) [m] from the indenter's axis."""

    points: int
    extent: float
    centre: tuple[float, float] = (0.0, 0.0)

    @classmethod
    def around(cls, box: "Box", points: int, margin: float) -> "Grid":
        """A square `margin` times the longer side of a box.

        Its centre is moved to a whole pixel, so that the tip of an indenter lies alike on every grid.
        """
        extent = float(margin * box.side)
        pixel = extent / points
        x, y = (float(round(at / pixel) * pixel) for at in box.centre)
        return cls(points, extent, (x, y))

    @property
    def pixel(self) -> float:
        """Side of a pixel [m]."""
        return self.extent / self.points

    @property
    def x(self) -> np.ndarray:
        """Pixel centres along the flow [m], (points,)."""
        return self.centre[0] + self._offsets

    @property
    def y(self) -> np.ndarray:
        """Pixel centres across the flow [m], (points,)."""
        return self.centre[1] + self._offsets

    @property
    def _offsets(self):
        return (np.arange(self.points) - (self.points - 1) / 2) * self.pixel

    def coarser(self) -> "Grid":
        """The same square with half the points."""
        return Grid((self.points + 1) // 2, self.extent, self.centre)

    def resample(self, values: np.ndarray) -> np.ndarray:
        """Values (m, m) of any other grid on the same square, taken over to this one by bilinear interpolation."""
        position = (np.arange(self.points) + 0.5) * len(values) / self.points - 0.5
        lower = np.clip(np.floor(position).astype(int), 0, len(values) - 2)
        share = np.clip(position - lower, 0.0, 1.0)
        rows = (1 - share)[:, None] * values[lower] + share[:, None] * values[lower + 1]
        return (1 - share) * rows[:, lower] + share * rows[:, lower + 1]

    def box(self, chosen: np.ndarray) -> "Box":
        """The smallest box around the chosen pixels; chosen (points, points) bool, at least one True."""
        x, y = self.x[chosen.any(axis=0)], self.y[chosen.any(axis=1)]
        half = self.pixel / 2
        return Box(x[0] - half, x[-1] + half, y[0] - half, y[-1] + half)

    def on_rim(self, chosen: np.ndarray) -> bool:
        """Whether any chosen pixel lies on the rim of the square."""
        return bool(chosen[[0, -1]].any() or chosen[:, [0, -1]].any())


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
