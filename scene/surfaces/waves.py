"""A sum of cosines over a lattice of wave vectors, and what it measures of itself."""

from dataclasses import dataclass
from functools import cached_property
from math import frexp, ldexp, sqrt

import numpy as np

MOST_WAVES = 2560  # along a side of what repeats: 210 MB of amplitudes


@dataclass(frozen=True, eq=False)
class Waves:
    """h(x, y) = Re sum amplitudes[j, k] exp(i (along_y[j] y + along_x[k] x)), without a mean.

    step_x, step_y : spacings of the lattice [rad/m], 2 pi over the sides of what repeats
    amplitudes : complex (2 J + 1, K + 1), rows from -J to J, columns from 0 to K: a half plane [m]
    """

    step_x: float
    step_y: float
    amplitudes: np.ndarray

    @property
    def along_x(self) -> np.ndarray:
        """Wave numbers along x (K + 1,) [rad/m]."""
        return self.step_x * np.arange(self.amplitudes.shape[1])

    @property
    def along_y(self) -> np.ndarray:
        """Wave numbers along y (2 J + 1,) [rad/m]."""
        top = self.amplitudes.shape[0] // 2
        return self.step_y * np.arange(-top, top + 1)

    @property
    def q(self) -> np.ndarray:
        """Wave numbers [rad/m], of the shape of the amplitudes."""
        return np.hypot(self.along_y[:, None], self.along_x[None, :])

    @cached_property
    def unit(self) -> float:
        """A power of two within the greatest amplitude [m]: over it squares stay numbers, and lose no digit."""
        return _unit(float(np.abs(self.amplitudes).max()))

    @property
    def power(self) -> np.ndarray:
        """Mean squares of the waves over the unit squared [1], of the shape of the amplitudes."""
        return np.square(np.abs(self.amplitudes) / self.unit) / 2

    @cached_property
    def rms_height(self) -> float:
        """Rms height over a period [m]."""
        return self.unit * sqrt(self.power.sum())

    @cached_property
    def rms_slope(self) -> float:
        """Spectral rms slope of the full gradient [1]."""
        return self._rms_slope(self.along_x, self.along_y)

    @cached_property
    def rms_slope_x(self) -> float:
        """Spectral, of dh/dx [1]."""
        return self._rms_slope(self.along_x, 0.0 * self.along_y)

    @cached_property
    def rms_slope_y(self) -> float:
        """Spectral, of dh/dy [1]."""
        return self._rms_slope(0.0 * self.along_x, self.along_y)

    def _rms_slope(self, along_x, along_y):
        unit = _unit(max(self.step_x, self.step_y))
        squares = (along_y[:, None] / unit) ** 2 + (along_x[None, :] / unit) ** 2
        return self.unit * unit * sqrt(np.sum(squares * self.power))

    def binned(self, edges: np.ndarray) -> np.ndarray:
        """rms heights [m] of the waves between wave numbers edges[k] <= q < edges[k + 1], (len(edges) - 1,)."""
        found, _ = np.histogram(self.q, edges, weights=self.power)
        return self.unit * np.sqrt(found)

    def row(self, y: float) -> np.ndarray:
        """Amplitudes (K,) [m] of the line at y [m]: Re sum_k a[k - 1] exp(i along_x[k] x), without mean."""
        return (np.exp(1j * self.along_y * y) @ self.amplitudes)[1:]

    def moved(self, x: float, y: float) -> "Waves":
        """Waves of h(x' + x, y' + y)."""
        turn = np.exp(1j * self.along_y * y)[:, None] * np.exp(1j * self.along_x * x)
        return Waves(self.step_x, self.step_y, self.amplitudes * turn)

    def below(self, highest: float) -> "Waves":
        """Waves up to a wave number [rad/m], on the same lattice."""
        return Waves(self.step_x, self.step_y, np.where(self.q <= highest, self.amplitudes, 0.0))


def _unit(value):
    """The greatest power of two that is no greater; 1 of zero."""
    return ldexp(0.5, frexp(value)[1]) if value else 1.0
