"""Convolutions on the grid: the only door to the Fourier transform."""

import numpy as np
import pyfftw


class FreeConvolution:
    """Zero-padded convolution with a kernel, on ny x nx points of a free surface.

    The transform along x skips the rows of zeros, so a product costs three quarters of a padded transform pair.
    `applications` counts the products.
    """

    def __init__(self, kernel, threads=1):
        """kernel: (ny, 2 nx), symmetric in y; column nx + i acts i pixels downstream (see `influence`)."""
        ny, nx = kernel.shape[0], kernel.shape[1] // 2
        self.shape = (ny, nx)
        self.applications = 0
        self._rows = pyfftw.zeros_aligned((ny, 2 * nx))
        self._half = pyfftw.empty_aligned((ny, nx + 1), complex)
        self._plane = pyfftw.zeros_aligned((2 * ny, nx + 1), complex)
        plan = {"flags": ("FFTW_MEASURE", "FFTW_DESTROY_INPUT"), "threads": threads}
        self._along_x = pyfftw.FFTW(self._rows, self._half, axes=(1,), **plan)
        self._along_y = pyfftw.FFTW(self._plane, self._plane, axes=(0,), **plan)
        self._back_y = pyfftw.FFTW(self._plane, self._plane, axes=(0,), direction="FFTW_BACKWARD", **plan)
        self._back_x = pyfftw.FFTW(self._half, self._rows, axes=(1,), direction="FFTW_BACKWARD", **plan)
        self._symbol = self._transformed(kernel)

    def _transformed(self, kernel):
        ny, nx = self.shape
        symbol = np.zeros((2 * ny, nx + 1), complex)
        self._rows[:] = np.roll(kernel, nx, axis=1)
        self._along_x.execute()
        symbol[:ny] = self._half
        symbol[ny + 1 :] = self._half[:0:-1]
        self._plane[:] = symbol
        self._along_y.execute()
        # Both inverse transforms are left unnormalized by FFTW; the symbol carries the factor.
        return self._plane / (4 * nx * ny)

    def __call__(self, pressure):
        """Displacement (ny, nx) of a pressure (ny, nx)."""
        ny, nx = self.shape
        self.applications += 1
        self._rows[:, :nx] = pressure
        self._rows[:, nx:] = 0
        self._along_x.execute()
        self._plane[:ny] = self._half
        self._plane[ny:] = 0
        self._along_y.execute()
        self._plane *= self._symbol
        self._back_y.execute()
        self._half[:] = self._plane[:ny]
        self._back_x.execute()
        return self._rows[:, :nx].copy()


class PeriodicFilter:
    """Multiplication by a symbol in Fourier space on an ny x nx periodic grid, without padding."""

    def __init__(self, shape, symbol, threads=1):
        """symbol: function of the wave numbers (q_y, q_x) in rad/pixel, broadcast, to a complex array."""
        ny, nx = shape
        self._real = pyfftw.empty_aligned((ny, nx))
        self._plane = pyfftw.empty_aligned((ny, nx // 2 + 1), complex)
        plan = {"axes": (0, 1), "flags": ("FFTW_MEASURE", "FFTW_DESTROY_INPUT"), "threads": threads}
        self._forward = pyfftw.FFTW(self._real, self._plane, **plan)
        self._backward = pyfftw.FFTW(self._plane, self._real, direction="FFTW_BACKWARD", **plan)
        q_y = 2 * np.pi * np.fft.fftfreq(ny)[:, None]
        q_x = 2 * np.pi * np.fft.rfftfreq(nx)[None, :]
        self._symbol = symbol(q_y, q_x) / (nx * ny)

    def __call__(self, values):
        """The filtered values (ny, nx)."""
        self._real[:] = values
        self._forward.execute()
        self._plane *= self._symbol
        self._backward.execute()
        return self._real.copy()
