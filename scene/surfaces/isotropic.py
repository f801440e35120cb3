"""Isotropic roughness that has a spectral density: what it is drawn by, whatever the density.

A measured one is a row of power laws between points. The density of a surface follows from its line scans.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from itertools import pairwise
from math import ceil, exp, inf, log, log10, pi, sqrt
from typing import TYPE_CHECKING, Any, Self

import numpy as np

# Nodes between two corners: for rounding those of a piece by its length, and enough over seven decades for 1e-12.
_FEWEST, _MORE, _MOST = 4, 5, 28


def power_integral(exponent, lower, upper):
    """int_lower^upper q^exponent dq for 0 < lower <= upper, arrays allowed; exact also near exponent = -1."""
    p = exponent + 1
    ratio = np.log(upper / lower)
    return lower**p * np.where(p == 0, ratio, np.expm1(p * ratio) / np.where(p == 0, 1.0, p))


def over_directions(function, q, corners):
    """Mean over all angles of function(q / cos(angle)), which is zero above the last corner.

    corners : wave numbers [rad/m], ascending, between which the function is smooth

    With 1 / cos(angle) = cosh(t) the integrand is analytic between the corners.
    """
    ends = [np.arccosh(np.maximum(corner / q, 1.0)) for corner in (q, *corners)]
    total = 0.0
    for start, end in pairwise(ends):
        middle, half = (start + end) / 2, (end - start) / 2
        nodes, weights = _rule(min(_FEWEST + ceil(_MORE * 2 * np.max(half)), _MOST))
        for node, weight in zip(nodes, weights, strict=True):
            stretch = np.cosh(middle + half * node)
            total = total + weight * half * function(q * stretch) / stretch
    return 2 / pi * total


@lru_cache
def _rule(nodes):
    return np.polynomial.legendre.leggauss(nodes)


class Isotropic:
    """Randomly rough and isotropic, from a longest wave, after which it repeats, to a shortest one.

    A class states rms_height [m], longest and shortest [m] (None where a grid sets the cut-off), seed,
    amplitudes ("fixed" or "gaussian"), its density, its moments int q^m C_2D dq, both in units of its own, and the
    wave numbers where the density has corners.

    Spectra are two-sided: <h^2> = 2 int_0^inf C_1D dq = 2 pi int_0^inf q C_2D dq. A line has the spectrum of the
    method of dimensionality reduction, C_1D = pi q C_2D, which keeps the rms height and the rms of the full
    gradient, or the spectrum of a line scan.
    """

    if TYPE_CHECKING:
        seed: int
        amplitudes: str

        @property
        def rms_height(self) -> float: ...
        @property
        def longest(self) -> float: ...
        @property
        def shortest(self) -> float | None: ...
        @property
        def _unit(self) -> float: ...
        def _relative(self, q: Any) -> Any: ...
        def _moment(self, m: int, lower: Any, upper: Any) -> Any: ...
        def _corners(self, q_max: float) -> tuple[float, ...]: ...

    @property
    def normalized(self) -> Self:
        """A spectrum of this shape, at a height whose square does not vanish."""
        return self

    @property
    def flat(self) -> bool:
        """Whether the rms height is zero, so that there is no roughness."""
        return self.rms_height == 0

    @property
    def period(self) -> float:
        """Side of the square that repeats [m]."""
        return self.longest

    @property
    def q_min(self) -> float:
        """Lowest wave number 2 pi / longest [rad/m]."""
        return 2 * pi / self.longest

    def q_max(self, pixel: float) -> float:
        """Highest wave number [rad/m]: 2 pi / shortest, or pi / pixel where `shortest` is None."""
        return 2 * pi / self.shortest if self.shortest is not None else pi / pixel

    def density_1d(self, q, q_max):
        """C_1D(q) [m^3] by the rule pi q C_2D, zero outside q_min <= q <= q_max [rad/m]."""
        return pi * q * self.density_2d(q, q_max)

    def density_line_scan(self, q, q_max):
        """C_1D(q) [m^3] of a line scan, 2 int_0^inf C_2D(sqrt(q^2 + s^2)) ds, for q > 0 [rad/m]; zero above q_max.

        A wave of the surface at an angle to the line is seen on it at q cos(angle): the line scan has power also
        below q_min, and half the mean square slope of the full gradient.
        """
        return self._seen(lambda seen: seen / q * self.density_1d(seen, q_max), q, q_max)

    def density_2d(self, q, q_max):
        """C_2D(q) [m^4], zero outside q_min <= q <= q_max [rad/m]."""
        inside = (q >= self.q_min) & (q <= q_max)
        relative = self._relative(np.where(inside, q, self.q_min))
        at_unit = (self.rms_height / self._unit) ** 2 / (2 * pi * self._moment(1, self.q_min, q_max))
        return np.where(inside, at_unit * relative, 0.0)

    def share(self, lower, upper, q_max):
        """Share of <h^2> that lies in q_min <= lower <= q <= upper <= q_max [rad/m], arrays allowed."""
        return self._moment(1, lower, upper) / self._moment(1, self.q_min, q_max)

    def share_line_scan(self, lower, upper, q_max):
        """Share of <h^2> that a line scan has in 0 < lower <= q <= upper <= q_max [rad/m], arrays allowed."""

        def above(q):
            return self.share(np.maximum(q, self.q_min), q_max, q_max)

        seen_above_lower, seen_above_upper = (self._seen(above, q, q_max) for q in (lower, upper))
        return seen_above_lower - seen_above_upper

    def rms_slope(self, q_max) -> float:
        """Spectral rms of the full gradient [1] with the cut-off q_max [rad/m].

        >>> from scene import SelfAffine
        >>> rough = SelfAffine(hurst=0.8, rms_height=1e-6, longest=1e-3, shortest=1e-5, seed=1)
        >>> round(rough.rms_slope(rough.q_max(pixel=1e-6)), 3)
        0.029
        """
        ratio = self._moment(3, self.q_min, q_max) / self._moment(1, self.q_min, q_max)
        return self.rms_height * self._unit * sqrt(ratio)

    def _seen(self, function, q, q_max):
        return over_directions(function, q, (*self._corners(q_max), q_max))


def wave_at_slope(slope: float, steepness: Callable[[float], float], q_low: float, q_high: float) -> float:
    """Shortest wave [m] of a spectrum that is cut where its rms slope reaches a value.

    steepness : rms slope of the spectrum up to a wave number [rad/m], between q_low and q_high

    Raises ValueError where the slope is not reached there.
    """
    low, high = steepness(q_low), steepness(q_high)
    if not low < slope < high:
        raise ValueError(
            f"shortest_at_slope = {slope:g}: between {low:.3g} and {high:.3g} is allowed, the rms slopes with "
            f"waves down to {2 * pi / q_low:.3g} m and down to {2 * pi / q_high:.3g} m"
        )
    from scipy.optimize import brentq  # only a spectrum that is cut so needs it

    return 2 * pi / exp(brentq(lambda u: log(steepness(exp(u)) / slope), log(q_low), log(q_high), xtol=1e-12))


def seeded(rough: Isotropic, seed: int) -> Any:
    """Copy of the roughness with another seed."""
    drawn: Any = rough
    return replace(drawn, seed=seed)


# Places at which the density of a surface is found from its line scans, between two points a decade apart; as the
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
        """The density; beyond the ends it is the density at the ends."""
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
