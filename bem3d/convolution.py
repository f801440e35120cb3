"""Convolutions on the grid: with a kernel on a free surface, with a symbol on one that repeats."""

import numpy as np

from .engine import Engine

PLAIN = Engine()


class FreeConvolution:
    """Zero-padded convolution with a kernel, on ny x nx points of a free surface. `applications` counts."""

    def __init__(self, kernel, engine=PLAIN):
        """kernel: (ny, 2 nx), symmetric in y; column nx + i acts i pixels downstream (see `influence`)."""
        ny, nx = kernel.shape[0], kernel.shape[1] // 2
        padded = (1 if ny == 1 else engine.good_size(2 * ny - 1), engine.good_size(2 * nx - 1))
        downstream, upstream = kernel[:, nx:], kernel[:, 1:nx]
        laid_out = np.zeros((ny, padded[1]))
        laid_out[:, :nx] = downstream
        laid_out[:, padded[1] - nx + 1 :] = upstream
        symbol = engine.transformed(laid_out, padded)
        if np.array_equal(downstream[:, 1:], upstream[:, ::-1]):
            symbol = symbol.real
        self.shape, self.applications, self.pairs = (ny, nx), 0, 1.0
        self._product = engine.product(symbol, self.shape, padded)

    def __call__(self, pressure, out=None):
        """Displacement (ny, nx) of a pressure (ny, nx)."""
        self.applications += 1
        return self._product(pressure, out)


class PeriodicFilter:
    """Multiplication of every wave by its symbol, on ny x nx points that repeat. `applications` counts."""

    def __init__(self, shape, symbol, engine=PLAIN):
        """symbol: function of the wave numbers (q_y, q_x) in rad/pixel, even in q_y, broadcast, to an array.

        One of q_x alone, an array of one row, needs no transform along y.
        """
        ny, nx = shape
        q_y = 2 * np.pi * np.arange(ny // 2 + 1)[:, None] / ny
        q_x = 2 * np.pi * np.arange(nx // 2 + 1)[None, :] / nx
        values = symbol(q_y, q_x)
        self.shape, self.applications = shape, 0
        self.pairs = 0.5 if len(values) == 1 and ny > 1 else 1.0  # of transforms, an application
        self._product = engine.product(values, shape, (1 if len(values) == 1 else ny, nx))

    def __call__(self, values, out=None):
        """The filtered values (ny, nx)."""
        self.applications += 1
        return self._product(values, out)
