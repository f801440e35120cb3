"""Deformation of the elastomer around the window, before it enters.

The displacement by a contact falls only as 1/r: what lies upstream creeps long before it is touched, and carries
that into the window. It is followed on sheets of material points around the window, each twice as wide as the one
before: a pressure is handed on from each to the next, and what comes into a sheet is interpolated from there.
Displacements are in m, pressures in units of the relaxed E*.

An indenter that comes back meets its own wake, and finer features in it than the wider sheets have. What a column
has beyond them when it leaves a sheet is kept, and fades as all that creeps: far from the contact, what is gained
meanwhile is what the wider sheets gain.
"""

from collections import deque
from itertools import pairwise

import numpy as np
from scipy.sparse import csr_array

from scene import Program

from ..grid import Grid

LEAST, MOST = 32, 128  # points along the first sheet, those of the window in between; of the next half, and so on
FADED = 1e-17  # of what a column had as it left: less is not kept


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
        """Places of the columns along the flow [m] (nx,), in the frame of the material."""
        return self.grid.x - self.shifts * self.grid.pixel

    def way(self, path: float) -> int:
        """Direction to shift, 1 or -1, with the indenter on its path [m] half a pixel off the middle; or 0."""
        off = path / self.grid.pixel - self.shifts
        return 0 if abs(off) <= 0.5 + 1e-6 else 1 if off > 0 else -1  # half a pixel is usual, and stays

    def shift(self, way: int, entering):
        """Drop a column, the last one as the indenter goes forwards; take in another (K, ny) at the other end."""
        if way > 0:
            self.fields[:, :, 1:] = self.fields[:, :, :-1].copy()
            self.fields[:, :, 0] = entering
        else:
            self.fields[:, :, :-1] = self.fields[:, :, 1:].copy()
            self.fields[:, :, -1] = entering
        self.shifts += way


def wider_grids(grid: Grid, path: float) -> list[Grid]:
    """Grids of the sheets around a window; nothing from beyond the widest enters the window on a path [m]."""
    if path == 0:
        return []
    count = int(np.ceil(np.log2(1 + 2 * path / grid.extent))) + 1
    points = (max(LEAST, min(grid.points, MOST) >> k) for k in range(count))
    return [Grid(each, grid.extent * 2.0 ** (k + 1), grid.centre, grid.width) for k, each in enumerate(points)]


def left_behind(program: Program, times: np.ndarray) -> float:
    """Path [m], at most, on which what leaves a sheet has not faded, of modes with these retardation times [s]."""
    fastest = max(abs(stage.speed) for stage in program.stages)
    return min(program.span, fastest * float(np.max(times)) * -np.log(FADED))


class Endless:
    """A half-space, undisturbed before it all began."""

    def __init__(self, window: Sheet, path: float, half_space):
        """Undisturbed sheets around a window.

        path : between its ends [m]; nothing from beyond the widest sheet comes into the window on it.
        half_space : grid -> callable, pressure -> relaxed displacement [m]
        """
        self.window, self._sheets, self._displaced = window, [window], []
        modes, grid = len(window.fields), window.grid
        if modes:
            for wider in wider_grids(grid, path):
                self._sheets.append(Sheet(wider, modes))
                self._displaced.append(half_space(wider))

    def creep(self, pressure, kept, gained):
        """Carry all sheets but the window over a step: what their modes keep and gain (K,)."""
        for (finer, sheet), displaced in zip(pairwise(self._sheets), self._displaced, strict=True):
            pressure = _handed_on(pressure, finer, sheet)
            sheet.fields *= kept[:, None, None]
            sheet.fields += gained[:, None, None] * displaced(pressure)

    def follow(self, path, time):
        """Keep all sheets around an indenter on its path [m], at a time [s]."""
        for sheet, wider in pairwise(self._sheets):
            while way := sheet.way(path):
                sheet.shift(way, self._entering(sheet, wider, way, time))
        widest = self._sheets[-1]
        while way := widest.way(path):
            widest.shift(way, 0.0)

    def _entering(self, sheet, wider, way, time):
        """The column (K, ny) that enters a sheet for the first time."""
        return _interpolated(sheet, wider, -1 if way > 0 else len(sheet.x))


class Returning(Endless):
    """Surroundings under an indenter that comes back and finds the wake that it left.

    kept : of the displacement of each mode (K,) after a time [s]
    """

    def __init__(self, window: Sheet, path: float, half_space, kept):
        super().__init__(window, path, half_space)
        self._kept = kept
        # What has left each sheet forwards and backwards: the last to leave is the first to come back.
        self._behind: dict[Sheet, dict[int, deque]] = {
            sheet: {1: deque(), -1: deque()} for sheet in self._sheets[:-1]
        }

    def _entering(self, sheet, wider, way, time):
        leaving = len(sheet.x) - 1 if way > 0 else 0
        finer = sheet.fields[:, :, leaving] - _interpolated(sheet, wider, leaving)
        left, met = self._behind[sheet][way], self._behind[sheet][-way]
        left.append((finer, time))
        while self._kept(time - left[0][1]).max() < FADED:
            left.popleft()
        column = super()._entering(sheet, wider, way, time)
        if met:
            finer, since = met.pop()
            column += self._kept(time - since)[:, None] * finer
        return column


class Repeating:
    """A surface that repeats after the window: what leaves it comes in again."""

    def __init__(self, window: Sheet):
        self.window = window

    def creep(self, pressure, kept, gained):
        """Do nothing: there is only the window."""

    def follow(self, path, time):
        """Keep the window around an indenter on its path [m]."""
        while way := self.window.way(path):
            self.window.shift(way, self.window.fields[:, :, -1 if way > 0 else 0].copy())


def _handed_on(pressure, finer, wider):
    """Pressure on a wider sheet with the forces, and their moments up to the third order, of the finer one."""
    along, across = _cubic(finer.x, wider.x), _across(finer.grid, wider.grid)
    return (along.T @ (across.T @ pressure).T).T * (finer.grid.patch / wider.grid.patch)


def _interpolated(sheet, wider, column):
    """Displacement (K, ny) where a sheet has a column, or would have one beyond its ends, from a wider one."""
    along = _cubic(sheet.x[:1] + column * sheet.grid.pixel, wider.x).toarray()[0]
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
