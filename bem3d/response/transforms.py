"""Fourier transforms of many lines at once, by ducc0 or FFTW: no other module imports either library.

ducc0 and pyfftw are imported on demand, as most solves need one of them only.
"""

from typing import Literal

import numpy as np

Library = Literal["ducc0", "fftw"]


def lines(library, count, length, points, waves):
    """Transforms of up to `count` lines of `length` points, forward and backward.

    points, waves : number types of the lines and of their transforms; real lines have length // 2 + 1 waves
    """
    return {"ducc0": _Ducc, "fftw": _Fftw}[library](count, length, points, waves)


class _Ducc:
    """Lines by ducc0, which plans nothing."""

    def __init__(self, count, length, points, waves):
        import ducc0

        self._fft, self._length, self._real = ducc0.fft, length, points != waves
        self._points = spread_rows(count, length, points)
        self._waves = spread_rows(count, length // 2 + 1, waves) if self._real else self._points

    def forward(self, values):
        """Waves (n, length // 2 + 1 or length) of n lines; zeros are added up to their length."""
        count, given = values.shape
        points, waves = self._points[:count], self._waves[:count]
        points[:, :given], points[:, given:] = values, 0
        transform = self._fft.r2c if self._real else self._fft.c2c
        return transform(points, axes=(1,), forward=True, out=waves)

    def backward(self, waves):
        """Lines (n, length) with these waves, not normalized."""
        points = self._points[: len(waves)]
        options = {"axes": (1,), "forward": False, "out": points}
        if self._real:
            return self._fft.c2r(waves, lastsize=self._length, **options)
        return self._fft.c2c(waves, **options)


class _Fftw:
    """Lines by FFTW, which measures a plan for each length once and remembers it."""

    def __init__(self, count, length, points, waves):
        import pyfftw

        self._points = pyfftw.zeros_aligned((count, length), points)
        self._waves = self._points if points == waves else pyfftw.empty_aligned((count, length // 2 + 1), waves)
        plan = {"axes": (1,), "flags": ("FFTW_MEASURE", "FFTW_DESTROY_INPUT")}
        self._forward = pyfftw.FFTW(self._points, self._waves, **plan)
        self._backward = pyfftw.FFTW(self._waves, self._points, direction="FFTW_BACKWARD", **plan)

    def forward(self, values):
        """As of `_Ducc`."""
        count, given = values.shape
        self._points[:count, :given], self._points[:count, given:] = values, 0
        self._forward.execute()
        return self._waves[:count]

    def backward(self, waves):
        """As of `_Ducc`."""
        if not np.may_share_memory(waves, self._waves):
            self._waves[: len(waves)] = waves
        self._backward.execute()
        return self._points[: len(waves)]


class Plane:
    """A plane by ducc0, padded with zeros to (my, mx)."""

    def __init__(self, padded, points, waves):
        import ducc0

        self._fft, self._length = ducc0.fft, padded[1]
        self._points, self._image = np.zeros(padded, points), np.empty(padded, points)
        self._waves = np.empty((padded[0], padded[1] // 2 + 1), waves)

    def forward(self, plane):
        """Waves (my, mx // 2 + 1) of a plane (ny, nx), the same number of values each time."""
        self._points[: len(plane), : plane.shape[1]] = plane
        return self._fft.r2c(self._points, axes=(0, 1), out=self._waves)

    def backward(self, waves):
        """Plane (my, mx) with these waves, not normalized; they are lost."""
        return self._fft.c2r(waves, axes=(0, 1), lastsize=self._length, forward=False, out=self._image)


def spread_rows(count, length, kind):
    """Zeros (count, length), gaps between rows: of a power of two, all would share the same lines of the cache."""
    return np.zeros((count, length + 8), kind)[:, :length]


def transform_symmetric(values, parity, axes):
    """Real waves, in place, of values that are even (parity 1) or odd (-1) along each of the axes.

    values : at 0, 1, ..., half the period; odd values without the two ends
    """
    import ducc0

    (ducc0.fft.dct if parity == 1 else ducc0.fft.dst)(values, type=1, axes=axes, out=values)
