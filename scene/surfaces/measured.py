"""An indenter whose whole surface was measured."""

from functools import lru_cache
from typing import ClassVar, Literal

import numpy as np
from pydantic import Field, model_validator
from pydantic.dataclasses import dataclass

from .heightmap import ROUNDING, levelled
from .scanned import MAPPED, QUOTIENT, Scanned


@dataclass(frozen=True, config=MAPPED, kw_only=True)
class Measured(Scanned):
    """A body by a map of its surface: z = 0 at the lowest pixel, x = y = 0 in the middle of the map.

    heights, pixel, peaks, shortest_kept : what was measured, and how much of it is kept, see `Scanned`; waves are
        left out of what the map, mirrored at its sides, has besides the paraboloid that fits it best, which stays
    level : what is taken off first: nothing ("none"), so that the body stands as it was measured, or the plane
        that fits it best ("tilt")

    Between the pixels runs a bicubic spline, which may dip below the lowest of them. Beyond the map nothing is
    known of the body: z is its greatest height there, and a contact that reaches the outermost pixels is an error.
    """

    pressed_by: ClassVar[tuple[str, ...]] = ("load", "depth")

    level: Literal["none", "tilt"] = "none"
    type: Literal["measured"] = Field(default="measured", repr=False)

    @model_validator(mode="after")
    def _no_plane(self):
        if self.relief.max() <= ROUNDING * np.abs(self.heights.heights).max():
            left = "" if self.shortest_kept is None else f" without waves shorter than {self.shortest_kept:g} m"
            raise ValueError(f"heights are those of a plane{left}: a body has to have a lowest point")
        return self

    @property
    def side(self) -> float:
        """The longer side of the map [m]."""
        return max(self.size)

    @property
    def shortest(self) -> float:
        """Shortest wavelength [m]: of those kept, or that the map can show, two pixels."""
        return self.shortest_kept or 2 * min(self.pixel)

    @property
    def relief(self) -> np.ndarray:
        """z at the pixels (rows, columns) [m]."""
        turned = self._turned()
        heights = turned if self.level == "none" else levelled(turned, "tilt")
        if self.shortest_kept is not None:
            heights = _without_waves(heights, self.sides, self.shortest_kept)
        return heights - heights.min()

    def height(self, x, y):
        """z(x, y) [m] for coordinates [m] of any broadcastable shapes."""
        return self._evaluated(x, y, _spline(self).greatest)

    def slope(self, x, y):
        """dz/dx [1]; zero beyond the map."""
        return self._evaluated(x, y, 0.0, dy=1) / self.pixel[0]

    def on_rim(self, x, y):
        """Whether points [m] lie on the outermost pixels of the map, or beyond it (bool)."""
        column, row = self._lattice(x, y)
        rows, columns = self.heights.shape
        return (column < 0.5) | (column > columns - 1.5) | (row < 0.5) | (row > rows - 1.5)

    def _lattice(self, x, y):
        """Columns and rows, counted from the first pixel's centre."""
        rows, columns = self.heights.shape
        return x / self.pixel[0] + (columns - 1) / 2, y / self.pixel[1] + (rows - 1) / 2

    def _evaluated(self, x, y, beyond, dy=0):
        column, row = np.broadcast_arrays(*self._lattice(np.asarray(x, float), np.asarray(y, float)))
        rows, columns = self.heights.shape
        spline = _spline(self)
        inside = (np.abs(column - (columns - 1) / 2) <= columns / 2) & (np.abs(row - (rows - 1) / 2) <= rows / 2)
        # Half a pixel around the outermost centres is the map's, and is as those are.
        return np.where(inside, spline.unit * spline.pixels.ev(row, column, dy=dy), beyond)


def _without_waves(heights, sides, shortest):
    """Heights less their mirrored waves shorter than this [m], except those of the paraboloid that fits best."""
    # Only maps whose short waves are left out need it.
    from scipy.fft import dctn, idctn

    left = levelled(heights, "curvature")
    along_y, along_x = (np.arange(count) / side for count, side in zip(heights.shape, sides[::-1], strict=True))
    waves = dctn(left)
    waves[np.hypot(along_y[:, None], along_x) * shortest > 1 + QUOTIENT] = 0.0
    return heights - left + idctn(waves)


class _Spline:
    """Spline of the heights over a unit of their own, on whole pixels."""

    def __init__(self, body: Measured):
        # Only measured bodies need it.
        from scipy.interpolate import RectBivariateSpline

        heights = body.relief
        self.greatest = float(heights.max())
        self.unit = self.greatest
        rows, columns = heights.shape
        self.pixels = RectBivariateSpline(np.arange(rows), np.arange(columns), heights / self.unit)


@lru_cache(maxsize=4)
def _spline(body: Measured) -> _Spline:
    return _Spline(body)
