"""Convolutions on the grid: with a kernel on a free surface, with a symbol on one that repeats."""

from math import prod

import numpy as np
from scipy.fft import rfft2

from .engine import Engine

PLAIN = Engine()
SHORTEST = np.pi * (1 - 1e-9)  # wave number [rad/pixel]; those of other waves are less


class FreeConvolution:
    """Zero-padded convolution with a kernel, on ny x nx points of a free surface; counts operator_applications."""

    def __init__(self, shape, symbol, engine=PLAIN):
        """symbol: see `free_symbol`."""
        self.shape, self.operator_applications = shape, 0
        self._product = engine.product([symbol], shape, free_size(shape, engine))

    @classmethod
    def of(cls, kernel, engine=PLAIN):
        """The convolution with a kernel, see `free_symbol`."""
        return cls((len(kernel), kernel.shape[1] // 2), free_symbol(kernel, engine), engine)

    def __call__(self, pressure, out=None):
        """Displacement (ny, nx) of a pressure (ny, nx)."""
        self.operator_applications += 1
        return self._product(pressure, out)


def free_symbol(kernel, engine=PLAIN):
    """Symbol of a kernel (ny, 2 nx), symmetric in y; column nx + i acts i pixels downstream (see `influence`)."""
    ny, nx = kernel.shape[0], kernel.shape[1] // 2
    padded = free_size((ny, nx), engine)
    downstream, upstream = kernel[:, nx:], kernel[:, 1:nx]
    if np.array_equal(downstream[:, 1:], upstream[:, ::-1]):
        return engine.symmetric(downstream, padded)
    return engine.transformed(_laid_out(downstream, upstream, padded), padded)


class FreePair:
    """Zero-padded convolution of two planes with a symmetric matrix of kernels, ny x nx points of a free surface.

    `operator_applications` counts two of a single plane each time.
    """

    def __init__(self, kernels, engine=PLAIN):
        """kernels: xx, xy, yy (ny, nx), 0, 1, ... pixels aside and downstream; xy is odd in both, others even."""
        ny, nx = kernels[0].shape
        padded = free_size((ny, nx), engine)
        symbols = [
            engine.symmetric(kernel, padded, parity) for kernel, parity in zip(kernels, (1, -1, 1), strict=True)
        ]
        self.shape, self.operator_applications = (ny, nx), 0
        self._product = engine.product(symbols, self.shape, padded)

    def __call__(self, planes, out=None):
        """Displacements (2, ny, nx) of tractions (2, ny, nx)."""
        self.operator_applications += 2
        return self._product(planes, out)


class PeriodicFilter:
    """Multiplication of every wave by its symbol, on ny x nx points that repeat; counts operator_applications."""

    def __init__(self, shape, symbol, engine=PLAIN):
        """symbol: function of the wave numbers (q_y, q_x) in rad/pixel, even in q_y, broadcast, to an array."""
        self.shape, self.operator_applications = shape, 0
        self._product = engine.product([symbol(*_wave_numbers(shape))], shape, shape)

    def __call__(self, values, out=None):
        """The filtered values (ny, nx)."""
        self.operator_applications += 1
        return self._product(values, out)


class PeriodicPair:
    """Multiplication of two planes, wave by wave, by a symmetric matrix of symbols, on ny x nx points that repeat.

    `operator_applications` counts two of a single plane each time.
    """

    def __init__(self, shape, symbols, engine=PLAIN):
        """symbols: function of the wave numbers (q_y, q_x) in rad/pixel to xx, xy, yy; xy is odd in both.

        At the shortest wave of the grid both signs of a wave number are the same one, and there is no xy.
        """
        q_y, q_x = _wave_numbers(shape)
        xx, xy, yy = symbols(q_y, q_x)
        xy = np.where((q_y > SHORTEST) | (q_x > SHORTEST), 0.0, xy)
        self.shape, self.operator_applications = shape, 0
        self._product = engine.product((xx, xy, yy), shape, shape)

    def __call__(self, planes, out=None):
        """The filtered planes (2, ny, nx)."""
        self.operator_applications += 2
        return self._product(planes, out)


def autocorrelation(plane, engine=PLAIN):
    """Sums of products of values i columns and j rows apart, either way: (ny, nx) for i, j = 0, 1, ..."""
    ny, nx = plane.shape
    padded = free_size(plane.shape, engine)
    waves = rfft2(plane, s=padded)
    power, rows = np.square(waves.real) + np.square(waves.imag), np.arange(padded[0] // 2 + 1)
    both = engine.symmetric(power[rows] + power[-rows], padded)[:ny, :nx] / prod(padded)
    both[0] /= 2
    return both


def free_size(shape, engine):
    """Size of the transforms of a plane on a free surface, padded with zeros."""
    return tuple(1 if size == 1 else engine.good_size(2 * size - 1) for size in shape)


def _laid_out(downstream, upstream, padded):
    """Columns of a kernel around the loaded one, as transforms take them: those upstream at the end."""
    laid_out = np.zeros((len(downstream), padded[1]))
    laid_out[:, : downstream.shape[1]] = downstream
    laid_out[:, padded[1] - upstream.shape[1] :] = upstream
    return laid_out


def _wave_numbers(shape):
    """q_y (ny//2+1, 1) and q_x (1, nx//2+1) [rad/pixel]."""
    ny, nx = shape
    q_y, q_x = 2 * np.pi * np.arange(ny // 2 + 1) / ny, 2 * np.pi * np.arange(nx // 2 + 1) / nx
    return q_y[:, None], q_x[None, :]
