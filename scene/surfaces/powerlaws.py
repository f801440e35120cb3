"""A spectral density as power laws between points, and that of a surface from that of its line scans."""

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from math import ceil, inf, log10, pi, sqrt

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

    @property
    def ends(self) -> tuple[float, float]:
        """Exponents at the first and at the last point, over an octave each, as single laws scatter."""
        low, high = self.q[0], self.q[-1]
        return float(np.log2(self(2 * low) / self(low))), float(np.log2(self(high) / self(high / 2)))

    def __call__(self, q):
        """The density; beyond the ends that of the ends."""
        return np.exp(np.interp(np.log(q), np.log(self.q), np.log(self.density)))

    def exponent(self, q):
        """The exponent at a wave number."""
        return self.exponents[self._law(q)]

    def moment(self, m: int, lower, upper):
        """int q^m density dq from lower to upper, arrays allowed; nothing lies beyond the ends."""
        return self._above(m, lower) - self._above(m, upper)

    def beyond(self, m: int) -> tuple[float, float]:
        """int q^m density dq below the first and above the last point by the laws of the ends; may be infinite."""
        low, high = (exponent + m + 1 for exponent in self.ends)
        below, above = (self.density * self.q ** (m + 1))[[0, -1]].tolist()
        return below / low if low > 0 else inf, -above / high if high < 0 else inf

    def cut(self, lower: float, upper: float) -> "PowerLaws":
        """The part from lower to upper."""
        q = np.array([lower, *self.q[(self.q > lower) & (self.q < upper)], upper])
        return PowerLaws(q, self(q))

    def _law(self, q):
        return np.clip(np.searchsorted(self.q, q, "right") - 1, 0, len(self.exponents) - 1)

    def _above(self, m, q):
        """int q^m density dq from q on: the rest of its law, and all laws above, where numbers are small."""
        q = np.clip(q, self.q[0], self.q[-1])
        start, law = self.q[:-1], self._law(q)
        unit, exponent = self.density[:-1] * start ** (m + 1), m + self.exponents
        whole = unit * power_integral(exponent, 1.0, self.q[1:] / start)
        above = np.append(np.cumsum(whole[::-1])[::-1], 0.0)[law + 1]
        return above + unit[law] * power_integral(exponent[law], q / start[law], self.q[law + 1] / start[law])


def of_surface(line: PowerLaws) -> PowerLaws:
    """C_2D of an isotropic surface at the points of its line scans and between them; it may come out below zero.

    line : two-sided C_1D of its line scans, which beyond the last point goes on by the law of that end

    By Abel's inversion, C_2D(q) = -(1/pi) int_q^inf C_1D'(k) / sqrt(k^2 - q^2) dk, which is a mean over the
    directions of waves that a line sees at q. It is below zero where no isotropic surface has such line scans.
    """
    # Only spectra of lines need it.
    from scipy.special import hyp2f1

    # Below each point the surface has a root of the distance to it: the places are closer there.
    pieces = [line.q[:1]]
    for low, high in pairwise(line.q.tolist()):
        count = ceil(_PLACES * sqrt(log10(high / low)))
        pieces.append(high * (low / high) ** np.square(np.arange(count)[::-1] / count))
    q = np.concatenate(pieces)
    falling = over_directions(lambda k: line.exponent(k) * line(k), q, line.q)
    exponent, share = line.ends[1], q / line.q[-1]
    a = (1 - exponent) / 2
    tail = exponent * line.density[-1] * share * hyp2f1(1 / 2, a, a + 1, share**2) / (pi * a)
    return PowerLaws(q, -(falling + tail) / (2 * q))
