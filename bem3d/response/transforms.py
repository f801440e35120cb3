"""Fourier transforms of blocks of rows and columns, by ducc0 or FFTW: no other module imports either library.

Rows are real; columns are of the waves of rows. Transforms back are not normalized. Both libraries are imported on
demand, as most solves need one of them only.
"""

from typing import Literal

import numpy as np

Library = Literal["ducc0", "fftw"]


class DuccRows:
    """Up to `count` real rows of `length` points by ducc0, padded with zeros where fewer are given.

    points, waves : number types of rows and of their transforms
    """

    def __init__(self, count, length, points, waves):
        import ducc0

        self._fft, self._length = ducc0.fft, length
        self._padded = spread_rows(count, length, points)

    def forward(self, rows, waves):
        """Rows (n, nx) to waves (n, length // 2 + 1)."""
        if not self._fits(rows):
            padded, given = self._padded[: len(rows)], rows.shape[1]
            padded[:, :given], padded[:, given:] = rows, 0
            rows = padded
        self._fft.r2c(rows, axes=(1,), out=waves)

    def backward(self, waves, rows):
        """Waves (n, length // 2 + 1) to the first points (n, nx) of their rows."""
        padded = rows if self._fits(rows) else self._padded[: len(rows)]
        self._fft.c2r(waves, axes=(1,), lastsize=self._length, forward=False, out=padded)
        if padded is not rows:
            rows[:] = padded[:, : rows.shape[1]]

    def _fits(self, rows):
        return rows.shape[1] == self._length and rows.dtype == self._padded.dtype


class DuccColumns:
    """Up to `count` complex columns of `length` points by ducc0, padded with zeros where fewer are given."""

    def __init__(self, count, length, waves):
        import ducc0

        self._fft, self._padded = ducc0.fft, np.zeros((length, count), waves)

    def forward(self, columns):
        """Transform (length, n) of columns (ny, n), in place if they have this length."""
        if len(columns) < len(self._padded):
            padded, given = self._padded[:, : columns.shape[1]], len(columns)
            padded[:given], padded[given:] = columns, 0
            columns = padded
        return self._fft.c2c(columns, axes=(0,), out=columns)

    def backward(self, transformed, columns):
        """Transforms, overwritten, to the first points (ny, n) of their columns."""
        self._fft.c2c(transformed, axes=(0,), forward=False, out=transformed)
        if len(columns) < len(transformed):
            columns[:] = transformed[: len(columns)]


class FftwRows:
    """As `DuccRows`, by FFTW, which measures a plan for each length once and remembers it."""

    def __init__(self, count, length, points, waves):
        import pyfftw

        self._points = pyfftw.zeros_aligned((count, length), points)
        self._waves = pyfftw.empty_aligned((count, length // 2 + 1), waves)
        self._forward, self._backward = _plans(self._points, self._waves)

    def forward(self, rows, waves):
        """Rows (n, nx) to waves (n, length // 2 + 1)."""
        count, given = rows.shape
        self._points[:count, :given], self._points[:count, given:] = rows, 0
        self._forward.execute()
        waves[:] = self._waves[:count]

    def backward(self, waves, rows):
        """Waves (n, length // 2 + 1) to the first points (n, nx) of their rows."""
        self._waves[: len(waves)] = waves
        self._backward.execute()
        rows[:] = self._points[: len(rows), : rows.shape[1]]


class FftwColumns:
    """As `DuccColumns`, by FFTW."""

    def __init__(self, count, length, waves):
        import pyfftw

        self._lines = pyfftw.zeros_aligned((count, length), waves)
        self._forward, self._backward = _plans(self._lines, self._lines)

    def forward(self, columns):
        """Transform (length, n) of columns (ny, n), in the memory of these transforms."""
        given, count = columns.shape
        self._lines[:count, :given], self._lines[:count, given:] = columns.T, 0
        self._forward.execute()
        return self._lines[:count].T

    def backward(self, transformed, columns):
        """Transforms, as `forward` returned them, to the first points (ny, n) of their columns."""
        self._backward.execute()
        columns[:] = transformed[: len(columns)]


def _plans(points, waves):
    """Plans of FFTW forward and backward."""
    import pyfftw

    plan = {"axes": (1,), "flags": ("FFTW_MEASURE", "FFTW_DESTROY_INPUT")}
    return pyfftw.FFTW(points, waves, **plan), pyfftw.FFTW(waves, points, direction="FFTW_BACKWARD", **plan)


ROWS = {"ducc0": DuccRows, "fftw": FftwRows}
COLUMNS = {"ducc0": DuccColumns, "fftw": FftwColumns}
ORDER: dict[str, Literal["C", "F"]] = {"ducc0": "C", "fftw": "F"}  # of transformed columns in memory


class Plane:
    """A plane by ducc0, padded with zeros to (my, mx)."""

    def __init__(self, padded, points, waves):
        import ducc0

        self._fft, self._length = ducc0.fft, padded[1]
        self._points, self._image = np.zeros(padded, points), np.empty(padded, points)
        self._waves = np.empty((padded[0], padded[1] // 2 + 1), waves)

    def forward(self, plane):
        """Waves (my, mx // 2 + 1) of a plane (ny, nx), of the same shape each time."""
        self._points[: len(plane), : plane.shape[1]] = plane
        return self._fft.r2c(self._points, axes=(0, 1), out=self._waves)

    def backward(self, waves):
        """Plane (my, mx) of waves, which are overwritten."""
        return self._fft.c2r(waves, axes=(0, 1), lastsize=self._length, forward=False, out=self._image)


def transform_symmetric(values, parity, axes):
    """Transform, in place, values that are even (parity 1) or odd (-1) along each of the axes, to real waves.

    values : at 0, 1, ..., half the period; odd values without the two ends
    """
    import ducc0

    (ducc0.fft.dct if parity == 1 else ducc0.fft.dst)(values, type=1, axes=axes, out=values)


def spread_rows(count, length, kind):
    """Zeros (count, length), gaps between rows: of a power of two, all would share the same lines of the cache."""
    return np.zeros((count, length + 8), kind)[:, :length]
