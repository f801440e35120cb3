"""What a contact has done to the elastomer ahead of it, before that comes into the window.

The displacement by a contact falls only as 1/r: what lies upstream creeps long before it is touched, and carries
that into the window. It is followed on sheets of material points around the window, each twice as wide as the one
before: a pressure is handed on from each to the next, and what comes into a sheet is interpolated from there.
Displacements are in m, pressures in units of the relaxed E*.
"""

from itertools import pairwise

import numpy as np
from scipy.sparse import csr_array

from .grid import Grid

LEAST, MOST = 32, 128  # points along the first sheet, those of the window in between; of the next half, and so on


class Sheet:
    """Points of the material, kept around the indenter by whole pixels.

    grid : where they are in the frame of the indenter, less than a pixel aside
    fields : displacement of each mode [m] (K, ny, nx)
    shifts : by how many pixels the points have followed
    """

    def __init__(self, grid: Grid, modes: int):
        self.grid, self.fields, self.shifts = grid, np.zeros((modes, *grid.shape)), 0

    @property
    def x(self):
        """Of the columns along the flow [m] (nx,), in the frame of the material."""
        return self.grid.x - self.shifts * self.grid.pixel

    def lags(self, path: float) -> bool:
        """Whether the indenter, after a path [m], is more than half a pixel upstream of the middle."""
        return path / self.grid.pixel - self.shifts > 0.5 + 1e-6  # half a pixel is usual, and stays

    def shift(self, entering):
        """Drop the last column and take in another (K, ny) upstream."""
        self.fields[:, :, 1:] = self.fields[:, :, :-1].copy()
        self.fields[:, :, 0] = entering
        self.shifts += 1


class Endless:
    """A half-space, undisturbed before it all began."""

    def __init__(self, window: Sheet, path: float, half_space):
        """path : slid in all [m]; nothing from beyond the widest sheet comes into the window in it.
        half_space : grid -> callable, pressure -> relaxed displacement [m]
        """
        self.window, self._sheets, self._displaced = window, [window], []
        modes, grid = len(window.fields), window.grid
        if path > 0 and modes:
            for k in range(int(np.ceil(np.log2(1 + 2 * path / grid.extent))) + 1):
                points = max(LEAST, min(grid.points, MOST) >> k)
                wider = Grid(points, grid.extent * 2.0 ** (k + 1), grid.centre, grid.width)
                self._sheets.append(Sheet(wider, modes))
                self._displaced.append(half_space(wider))

    def creep(self, pressure, kept, gained):
        """Carry all sheets but the window over a step: what their modes keep and gain (K,)."""
        for (finer, sheet), displaced in zip(pairwise(self._sheets), self._displaced, strict=True):
            pressure = _handed_on(pressure, finer, sheet)
            sheet.fields *= kept[:, None, None]
            sheet.fields += gained[:, None, None] * displaced(pressure)

    def follow(self, path):
        """Keep all sheets around an indenter that has slid so far [m]."""
        for sheet, wider in zip(self._sheets, [*self._sheets[1:], None], strict=True):
            while sheet.lags(path):
                sheet.shift(0.0 if wider is None else _ahead(sheet, wider))


class Repeating:
    """A surface that repeats after the window: what leaves it comes in again."""

    def __init__(self, window: Sheet):
        self.window = window

    def creep(self, pressure, kept, gained):
        """There is nothing but the window."""

    def follow(self, path):
        """Keep the window around an indenter that has slid so far [m]."""
        while self.window.lags(path):
            self.window.shift(self.window.fields[:, :, -1].copy())


def _handed_on(pressure, finer, wider):
    """Pressure on a wider sheet: its forces and their moments up to the third order are those of the finer one."""
    along, across = _cubic(finer.x, wider.x), _across(finer.grid, wider.grid)
    return (along.T @ (across.T @ pressure).T).T * (finer.grid.patch / wider.grid.patch)


def _ahead(sheet, wider):
    """Displacement (K, ny) in the column upstream of a sheet, interpolated from a wider one."""
    along = _cubic(sheet.x[:1] - sheet.grid.pixel, wider.x).toarray()[0]
    across = _across(sheet.grid, wider.grid)
    return np.array([across @ (field @ along) for field in wider.fields])


def _across(finer, wider):
    """Weights along y; of single rows there are none."""
    return _cubic(finer.y, wider.y) if wider.rows > 1 else csr_array([[1.0]])


def _cubic(at, points):
    """Sparse weights (len(at), len(points)) of Lagrange's cubic through the nearest four of equidistant points."""
    place = (at - points[0]) / (points[1] - points[0])
    below = np.floor(place).astype(int)
    t = place - below
    weights = [
        -t * (1 - t) * (2 - t) / 6,
        (1 - t**2) * (2 - t) / 2,
        t * (1 + t) * (2 - t) / 2,
        -t * (1 - t**2) / 6,
    ]
    columns = below[:, None] + np.arange(-1, 3)
    starts = np.arange(0, columns.size + 1, 4)
    return csr_array((np.stack(weights, axis=1).ravel(), columns.ravel(), starts), (len(at), len(points)))
