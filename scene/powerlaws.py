"""A spectral density as power laws between points, and that of a surface from that of its line scans."""

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from math import ceil, inf, log, log10, sqrt

import numpy as np

from .isotropic import over_directions, power_integral

# Places at which the density of a surface is found from that of a line, between two points a decade apart; as the
# root of the distance between others.
_PLACES = 16


@dataclass(frozen=True, eq=False)
class PowerLaws:
    """Density above zero by power laws between points.

    q, density : wave numbers, ascending, and the density at them (N,)
    """

    q: np.ndarray
    density: np.ndarray

    @cached_property
    def exponents(self) -> np.ndarray:
        """Exponents of the laws (N - 1,)."""
        return np.diff(np.log(self.density)) / np.diff(np.log(self.q))

    @cached_property
    def ends(self) -> tuple[float, float]:
        """Exponents at the first and at the last point, over an octave each, as single laws scatter."""
        low, high = (np.log(self(start * np.array([1.0, 2.0]))) for start in (self.q[0], self.q[-1] / 2))
        return float(np.diff(low)[0] / log(2)), float(np.diff(high)[0] / log(2))

    def __call__(self, q):
        """The density; beyond the ends that of the ends."""
        return np.exp(np.interp(np.log(q), np.log(self.q), np.log(self.density)))

    def exponent(self, q):
        """The exponent at a wave number."""
        return self.exponents[self._law(q, "right")]

    def moment(self, m: int, lower, upper):
        """int q^m density dq from lower to upper, arrays allowed; nothing lies beyond the ends."""
        lower, upper = (np.clip(each, self.q[0], self.q[-1]) for each in (lower, upper))
        first = self._law(lower, "right")
        last = np.maximum(self._law(upper, "left"), first)
        after = np.minimum(first + 1, last)
        below, above = self._cumulated(m)
        # The lesser numbers lose fewer digits in their difference.
        between = np.where(below[last] < above[after], below[last] - below[after], above[after] - above[last])
        # Within one law the integral is one piece, else the rest of the first law and the beginning of the last.
        alone = first == last
        start = self._within(m, first, lower, np.where(alone, upper, self.q[first + 1]))
        return start + between + np.where(alone, 0.0, self._within(m, last, self.q[last], upper))

    def beyond(self, m: int) -> tuple[float, float]:
        """int q^m density dq below the first and above the last point by the laws of the ends; may be infinite."""
        low, high = (exponent + m + 1 for exponent in self.ends)
        below, above = self.density[[0, -1]] * self.q[[0, -1]] ** (m + 1)
        return float(below / low) if low > 0 else inf, float(-above / high) if high < 0 else inf

    def cut(self, lower: float, upper: float) -> "PowerLaws":
        """The part from lower to upper."""
        q = np.concatenate([[lower], self.q[(self.q > lower) & (self.q < upper)], [upper]])
        return PowerLaws(q, self(q))

    def _law(self, q, side):
        return np.clip(np.searchsorted(self.q, q, side) - 1, 0, len(self.exponents) - 1)

    def _cumulated(self, m):
        every = self._within(m, np.arange(len(self.exponents)), self.q[:-1], self.q[1:])
        return np.append(0.0, np.cumsum(every)), np.append(np.cumsum(every[::-1])[::-1], 0.0)

    def _within(self, m, law, lower, upper):
        start = self.q[law]
        part = power_integral(m + self.exponents[law], lower / start, np.maximum(upper, lower) / start)
        return self.density[law] * start ** (m + 1) * part


def of_surface(line: PowerLaws) -> tuple[np.ndarray, np.ndarray]:
    """Wave numbers (M,), those of the points and more between, and C_2D at them of an isotropic surface.

    line : two-sided C_1D of its line scans, which beyond the last point goes on by the law of that end

    By Abel's inversion, C_2D(q) = -(1/pi) int_q^inf C_1D'(k) / sqrt(k^2 - q^2) dk, which is a mean over the
    directions of waves that a line sees at q. It is below zero where no isotropic surface has such line scans.
    """
    # Only spectra of lines need it.
    from scipy.special import hyp2f1

    # Below each point the surface has a root of the distance to it: the places are closer there.
    pieces = []
    for low, high in pairwise(line.q.tolist()):
        count = ceil(_PLACES * sqrt(log10(high / low)))
        pieces.append(high * (low / high) ** np.square(np.arange(count)[::-1] / count))
    q = np.concatenate([line.q[:1], *pieces])
    falling = over_directions(lambda k: line.exponent(k) * line(k), q, line.q)
    exponent, share = line.ends[1], q / line.q[-1]
    a = (1 - exponent) / 2
    tail = exponent * line.density[-1] * share * hyp2f1(1 / 2, a, a + 1, share**2) / (np.pi * a)
    return q, -(falling + tail) / (2 * q)
