"""Periodogram of a measured line in bins of waves, and how length, tapers and levelling change a spectrum in it.

Waves u are counted in the length of the line: <h^2> = 2 int c du. The tapers are sine tapers, Riedel and
Sidorenko, IEEE Trans. Signal Process. 43, 188 (1995).
"""

from dataclasses import dataclass
from functools import lru_cache
from math import log10, pi, sqrt

import numpy as np

from .form import polynomials

PER_DECADE = 20  # bins
COARSE = 0.05  # relative, of the density of a bin beside its scatter: its width, and what lattices of laws leave
TAPERS = 3
# Waves in the line that are a bin each, of which levelling takes something; and those that leak into others.
LOW, REACH, STEP = 12, 24, 0.25
SMEARED = 2  # of a wave alone and its neighbours: measured, for intervals of the rms height to hold
FINE = 1024  # points on which the leakage of the lowest waves is found


def _tapers(count):
    """Sine tapers (TAPERS, count), each of unit sum of squares."""
    place = pi / (count + 1) * np.arange(1, count + 1)
    return sqrt(2 / (count + 1)) * np.sin(np.arange(1, TAPERS + 1)[:, None] * place)


def periodogram(heights: np.ndarray) -> np.ndarray:
    """c at u = 1, 2, ... below the Nyquist wave number."""
    count = len(heights)
    waves = np.fft.rfft(_tapers(count) * heights, axis=1)[:, 1 : (count + 1) // 2]
    return np.mean(np.abs(waves) ** 2, axis=0) / count


@dataclass(frozen=True, eq=False)
class Bins:
    """Bins of waves u, the lowest a bin each.

    starts : waves before each bin (B,); number : of its waves (B,); u : of their centres (B,)
    freedoms : of the chi square of each (B,)
    leaked : shares (B, J) of the waves u_low (J,) in each bin, by tapers and levelling
    own : share of its own waves (B,)
    nyquist : waves of two spacings
    """

    starts: np.ndarray
    number: np.ndarray
    u: np.ndarray
    freedoms: np.ndarray
    leaked: np.ndarray
    u_low: np.ndarray
    own: np.ndarray
    nyquist: float

    def means(self, periodogram):
        """Means of a periodogram over the bins."""
        return np.add.reduceat(periodogram, self.starts) / self.number


@lru_cache(maxsize=8)
def bins_of(count: int, degree: int) -> Bins:
    """Bins of a line of so many points, less a polynomial of a degree.

    count : more than three times the waves that are a bin each
    """
    top = (count - 1) // 2
    wide = round(PER_DECADE * log10(top / LOW))
    edges = np.append(np.arange(LOW), np.rint(LOW * (top / LOW) ** (np.arange(wide + 1) / wide)))
    edges = np.unique(edges.astype(int))
    starts, number = edges[:-1], np.diff(edges)
    # The mean of a falling spectrum over a bin is that at a mean which favours its lower end.
    waves = np.arange(1, top + 1.0)
    u = (np.add.reduceat(waves**-2.5, starts) / number) ** (-1 / 2.5)
    # Neighbours share what a taper smears: in the sum over many of them.
    shared = 1 + 1 / (2 * TAPERS)
    freedoms = 2 * number / shared / np.where(u > LOW, 1.0, SMEARED)
    freedoms = 1 / (1 / freedoms + COARSE**2 / 2)
    u_low = np.maximum(np.arange(REACH / STEP) * STEP, 1e-3)
    low = u <= LOW
    leaked = np.empty((len(u), len(u_low)))
    leaked[low] = _levelled_leakage(degree)[: low.sum()]
    centres = np.rint(u[~low])[:, None]
    leaked[~low] = _leakage(centres - u_low) + _leakage(centres + u_low)
    leaked[:, 0] /= 2
    leaked *= STEP
    own = np.where(low, 0.0, np.maximum(1 - leaked.sum(axis=1), 0.0))
    return Bins(starts, number, u, freedoms, leaked, u_low, own, count / 2)


def _leakage(offset):
    """Mean square of the tapers' transforms at offsets in waves, its integral one."""
    total = 0.0
    for order in range(1, TAPERS + 1):
        turns, centre = 2 * pi * offset, pi * order
        apart = turns**2 - centre**2
        near = np.abs(apart) < 1e-6
        found = 4 * centre**2 * (1 - (-1) ** order * np.cos(turns)) / np.where(near, 1.0, apart) ** 2
        total = total + np.where(near, 0.5, found)
    return total / TAPERS


@lru_cache(maxsize=4)
def _levelled_leakage(degree):
    """Shares of waves of the lattice in the lowest bins of a line that is levelled first (LOW, J)."""
    basis, tapers = polynomials(FINE, degree), _tapers(FINE)
    places, size = np.arange(FINE) / FINE, int(FINE / STEP)
    rows = []
    for u in range(1, LOW + 1):
        tapered = tapers * np.exp(-2j * pi * u * places)
        tapered = tapered - (tapered @ basis) @ basis.T
        power = np.mean(np.abs(np.fft.fft(tapered, size, axis=1)) ** 2, axis=0) / FINE
        lattice = np.arange(int(REACH / STEP))
        rows.append(power[lattice] + power[-lattice])
    return np.array(rows)
