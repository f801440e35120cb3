"""Waves of pressure on an elastic layer over a rigid base, and what the base takes off the displacement by a load.

A wave displaces a layer of thickness h by M(|q| h) of what it does to a half-space of the same elastomer, 2/|q|
per E*. Lengths are in thicknesses here, and waves t = |q| h. With k = 3 - 4 nu,

    bonded:        M = [2k sinh 2t - 4t] / [2k cosh 2t + 4t^2 + 1 + k^2],
    frictionless:  M = [cosh 2t - 1] / [sinh 2t + 2t];

both from plane strain with no shear on the upper side. Numerators and denominators are taken times exp(-2t), and
what M and 1 - M would lose to cancellation is written out: both have all their digits from the longest wave to the
shortest.
"""

from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Protocol

import numpy as np
from scipy.special import j0

THICK = 300.0  # from there on M is one and 1 - M less than 1e-255
SERIES_BELOW, SERIES_TERMS = 1.0, 10  # of sinh z - z, to 1e-17
REACH = 44.0  # beyond which a load displaces by less than 1e-15 of what it does a thickness away
SHORTEST = 22.0  # 1 - M is 1e-16 there
PANELS, NODES = 44, 24  # of waves up to it: three and a half periods of the longest distance in each
COARSE, FINE = 1 / 32, 1 / 1024  # steps of the table: of order 8, and of the pieces looked up, of order 4
PIECES = 4, round(REACH / FINE)  # coefficients of a table
DISTANCES, AT_ONCE = 64, 4096  # distances summed and pieces made at once: half a megabyte


class Base(Protocol):
    """Base on which the layer lies. Waves t > 0 of any shape."""

    @property
    def springs(self) -> float:
        """lim M/t for long waves: a thin layer is a bed of springs that yield 2 h springs p / E*."""

    @property
    def spread(self) -> float:
        """Length over which a thin layer spreads pressure, the root of lim |M/t - springs| / (springs t^2)."""

    def yields(self, t):
        """M(t)."""

    def one_minus_compliance(self, t):
        """1 - M(t)."""


@dataclass(frozen=True)
class Bonded:
    """The lower side does not move."""

    poisson_ratio: float

    @property
    def springs(self):
        return (1 - 2 * self.poisson_ratio) / (2 * (1 - self.poisson_ratio) ** 2)

    @property
    def spread(self):
        k = self._k
        squeezed = (8 / 3 * k - 16 * (k - 1) / (k + 1)) / (1 + k) ** 2
        return np.inf if self.springs == 0 else float(np.sqrt(abs(squeezed) / self.springs))

    def yields(self, t):
        t = np.minimum(t, THICK)
        # k - 1 is exact where the material is nearly incompressible.
        k, excess, gone = self._k, 2 * (1 - 2 * self.poisson_ratio), np.exp(-2 * t)
        return 2 * (k * _sinh_less(2 * t, gone) + 2 * t * gone * excess) / self._divisor(t, gone)

    def one_minus_compliance(self, t):
        t = np.minimum(t, THICK)
        k, gone = self._k, np.exp(-2 * t)
        return (2 * k * gone + (1 + 2 * t) ** 2 + k**2) * gone / self._divisor(t, gone)

    @property
    def _k(self):
        return 3 - 4 * self.poisson_ratio

    def _divisor(self, t, gone):
        return self._k * (1 + gone**2) + (4 * t**2 * gone + (1 + self._k**2) * gone)


@dataclass(frozen=True)
class Frictionless:
    """The lower side slides along the base, and is not lifted. The same for every Poisson ratio."""

    springs: float = 0.5
    spread: float = 0.0

    def yields(self, t):
        t = np.minimum(t, THICK)
        return np.expm1(-2 * t) ** 2 / 2 / self._divisor(t)

    def one_minus_compliance(self, t):
        t = np.minimum(t, THICK)
        return (2 * t - np.expm1(-2 * t)) * np.exp(-2 * t) / self._divisor(t)

    def _divisor(self, t):
        return 2 * t * np.exp(-2 * t) - np.expm1(-4 * t) / 2


def _sinh_less(z, gone):
    """(sinh z - z) exp(-z), gone = exp(-z)."""
    small = np.minimum(z, 2 * SERIES_BELOW)
    series = np.ones_like(small)
    for n in range(SERIES_TERMS, 0, -1):
        series = 1 + series * small**2 / ((2 * n + 2) * (2 * n + 3))
    return np.where(z < 2 * SERIES_BELOW, small**3 / 6 * series * gone, (1 - gone**2) / 2 - z * gone)


class Taken:
    """Displacement by a load that the base takes off, over (1/pi) p dA / E*, at a distance in thicknesses.

    A point load displaces by 1/r - c(r), a line load by -2 ln r - 2 c(r): both vanish beyond REACH.
    """

    def __init__(self, values):
        """values : of distances (n,), even and smooth."""
        # Only layers need it.
        from scipy.interpolate import make_interp_spline

        at = np.arange(-8, round(REACH / COARSE) + 9) * COARSE
        smooth = make_interp_spline(at, values(np.abs(at)), k=7)
        # Cubics of the place within a piece, from 0 to 1, by value and slope at both ends.
        self._pieces = np.empty(PIECES)
        for first in range(0, PIECES[1], AT_ONCE):
            at = np.arange(first, min(first + AT_ONCE, PIECES[1]) + 1) * FINE
            value, slope = smooth(at), smooth(at, 1) * FINE
            step, start, end = np.diff(value), slope[:-1], slope[1:]
            self._pieces[:, first : first + AT_ONCE] = (
                start + end - 2 * step,
                3 * step - 2 * start - end,
                start,
                value[:-1],
            )

    def __call__(self, distance):
        """c at distances (any shape), none above REACH."""
        place = distance / FINE
        piece = place.astype(np.intp)
        within = place - piece
        highest, *lower = self._pieces
        total, coefficient = highest.take(piece, mode="clip"), np.empty_like(within)
        for row in lower:
            total *= within
            total += row.take(piece, out=coefficient, mode="clip")
        return total


@dataclass(frozen=True)
class Taking:
    """The tables of a base, each made when it is first asked for."""

    base: Base

    @cached_property
    def from_point(self) -> Taken:
        """c(r) = int_0^inf (1 - M) J0(r t) dt."""
        t, weights = _waves()
        hindered = weights * self.base.one_minus_compliance(t)
        return Taken(lambda r: _summed(j0, r, t, hindered))

    @cached_property
    def from_line(self) -> Taken:
        """c(x) = -ln(4 + x^2)/2 - int_0^inf [M - 1 + exp(-2t)] cos(x t) dt/t.

        The logarithm is the displacement by an image two thicknesses away, 1 - exp(-2t) in place of M.
        """
        t, weights = _waves()
        rest = weights * (self.base.yields(t) + np.expm1(-2 * t)) / t
        return Taken(lambda x: -np.log(4 + x**2) / 2 - _summed(np.cos, x, t, rest))


@lru_cache(maxsize=8)
def taking(base: Base) -> Taking:
    """Kept, as the tables know nothing of thickness and grid."""
    return Taking(base)


def _summed(turning, distances, t, weights):
    """Sum over t of turning(distance t) by weights, of some DISTANCES at a time."""
    parts = np.split(distances, range(DISTANCES, len(distances), DISTANCES))
    return np.concatenate([turning(np.outer(part, t)) @ weights for part in parts])


def _waves():
    """Nodes and weights for 0 <= t <= SHORTEST."""
    x, w = np.polynomial.legendre.leggauss(NODES)
    half = SHORTEST / PANELS / 2
    return (half * (2 * np.arange(PANELS)[:, None] + 1 + x)).ravel(), np.tile(half * w, PANELS)
