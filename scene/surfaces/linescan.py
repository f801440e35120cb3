"""The self-affine law in a measured line: which isotropic surface it was cut from, and how surely that is known.

A line scan has the spectrum C_1D(q) = 2 int_0^inf C_2D(sqrt(q^2 + s^2)) ds of its surface. C_2D is sought among
laws that are flat up to a roll-off and fall from there as q^(-2H - 2) to a cut-off; beyond it the line may have
any spectrum, such as noise. The periodogram takes three sine tapers, Riedel and Sidorenko, IEEE Trans.
Signal Process. 43, 188 (1995). Every law is compared after what happens to a line of it: cut to its length,
levelled, tapered, and folded where it goes on beyond the spacing. Ordinates of a Gaussian line are chi square; all
laws of a lattice are weighed by that, and intervals are quantiles of these weights. A line that scatters more
about every law than it should is weighed at its own scatter.

Wave numbers here are waves u in the length of the line: <h^2> = 2 int c du = 2 pi int u C_2D du.
"""

from dataclasses import dataclass
from functools import lru_cache
from math import log10, pi, sqrt

import numpy as np

from .heightmap import polynomials, taken_off
from .isotropic import power_integral

PER_DECADE = 20  # bins
COARSE = 0.05  # relative, of the density of a bin, against its scatter: its width, and what lattices of laws leave
TAPERS = 3
# Waves in the line that are a bin each, as levelling takes part of them; and those that leak into others.
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
    """Bins of a line with a number of points, less a polynomial of a degree.

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


LEAST, MOST = 64, 2**20  # points of a line that is fitted
LEVEL = 0.95  # of intervals
# Beyond what a surface has, for intervals to reach its ends.
HURSTS = np.arange(-8, 49) / 40
FALLING = 4  # bins over which a law falls, at least
UNLIKELY = 0.01  # chance of the scatter about a law, below which it is none
UNKNOWNS = 4
# Limits beyond which a law does not fit a line: ratio of the mean squares of both, either way round; and rms of
# the logarithm of the ratio of their spectra, which scatters by 1 in the lowest bins.
FOREIGN, SCATTERED = 10.0, 2.0
NOTHING = 1e-24  # of the greatest density: rounding
TINY = 1e-300  # of a law beyond its end
FOLDS = 4  # periods of the lattice of points over which a law beyond the spacing is followed
DRAWN = 4000


@dataclass(frozen=True)
class Interval:
    """Number with its interval of 95 %."""

    value: float
    low: float
    high: float


@dataclass(frozen=True)
class LineLaw:
    """Self-affine law of the surface that a line was cut from, each number with its interval of 95 %.

    hurst : Hurst exponent
    rms_height, rms_slope : of the surface with waves up to `length` [m], of the full gradient [1]
    rolloff, shortest : wavelengths [m]; a roll-off as long as the line is one that it does not show
    length : of the line, the longest wave that it shows [m]
    cutoff : whether the spectrum ends within what the spacing resolves
    follows : whether the line scatters about the law no more than a Gaussian one does
    beyond : share of the mean square slope of the line in waves shorter than the cut-off, which are left out
    """

    hurst: Interval
    rms_height: Interval
    rms_slope: Interval
    rolloff: Interval
    shortest: Interval
    length: float
    cutoff: bool
    follows: bool
    beyond: float


def fit(heights: np.ndarray, spacing: float, degree: int = 1) -> LineLaw:
    """Law of a line.

    heights : (N,) [m], from any level; spacing : of the points [m]
    degree : of the polynomial that is taken off first

    Raises ValueError for too few or too many points, and for a line that is nothing like any law, such as a single
    wave.
    """
    count = len(heights)
    if not LEAST <= count <= MOST:
        raise ValueError(f"{count:,} points: {LEAST} to {MOST:,} are fitted")
    unit = float(np.abs(heights).max())
    left = taken_off(heights / unit, degree) if unit else heights
    bins = bins_of(count, degree)
    seen = bins.means(periodogram(left))
    return _weighed(bins, np.maximum(seen, NOTHING * seen.max()), unit, count * spacing)


class _Laws:
    """Laws of unit plateau on a lattice of exponents, roll-offs and cut-offs, as their lines come out in bins."""

    def __init__(self, bins):
        self._bins = bins
        decades = log10(bins.nyquist)
        # Both may lie beyond what the line shows.
        self.rolloffs = 10 ** (np.arange(-PER_DECADE, int(decades * PER_DECADE)) / PER_DECADE)
        cutoffs = bins.nyquist * 10 ** (np.arange(-int(decades * PER_DECADE), PER_DECADE + 1) / PER_DECADE)
        ends = np.searchsorted(bins.u, cutoffs, side="right")
        enough = (ends >= max(FALLING, len(bins.u) / 3)) & (ends >= len(bins.u) - ends)
        self.cutoffs, self.ends = cutoffs[enough], ends[enough]
        self._falls = self.rolloffs[:, None] * 10 ** (FALLING / PER_DECADE) <= self.cutoffs
        self.penalty = np.log(len(bins.u))
        # Whether waves beyond what the spacing resolves are seen as longer ones, and which.
        self._folds = (self.cutoffs > bins.nyquist).astype(int)
        period = 2 * bins.nyquist
        self._images = [number * period + sign * bins.u for number in range(1, FOLDS + 1) for sign in (-1, 1)]
        self._lines = [self._lined(hurst) for hurst in HURSTS]

    def compared(self, seen):
        """Deviances and amplitudes of all laws (hurst, roll-off, cut-off)."""
        shape = len(HURSTS), *self._falls.shape
        deviance, amplitude = np.empty(shape), np.empty(shape)
        inside = np.arange(len(seen)) < self.ends[:, None]
        weights = inside * self._bins.freedoms
        total = weights.sum(axis=1)
        for k, hurst in enumerate(HURSTS):
            whole, beyond = self._lines[k]
            fall = self.rolloffs[:, None] ** (2 * hurst + 2)
            for j, end in enumerate(self.ends):
                law = whole[self._folds[j]][:, :end] - fall * beyond[j, :end]
                ratio = seen[:end] / np.maximum(law, TINY)
                amplitude[k, :, j] = ratio @ weights[j, :end] / total[j]
                deviance[k, :, j] = total[j] * np.log(amplitude[k, :, j]) - np.log(ratio) @ weights[j, :end]
            deviance[k] += self.penalty * (len(seen) - self.ends)
        deviance[:, ~self._falls] = np.inf
        return deviance, amplitude

    def _lined(self, hurst):
        """Lines of unit plateaus without a cut-off, plain and folded (2, R, B); of tails of unit falls (Q, B)."""
        bins, rolloffs, cutoffs = self._bins, self.rolloffs[:, None], self.cutoffs[:, None]
        fall, folds = rolloffs ** (2 * hurst + 2), self._folds.astype(bool)

        def whole(u):
            flat = np.sqrt(np.maximum(rolloffs**2 - u**2, 0.0))
            return 2 * (flat + fall * _tail(hurst, u, np.maximum(rolloffs, u)))

        def beyond(u, cutoffs=cutoffs):
            return 2 * _tail(hurst, u, np.maximum(cutoffs, u))

        def seen(lines):
            return lines(bins.u) * bins.own + lines(bins.u_low) @ bins.leaked.T

        plain, tails = seen(whole), seen(beyond)
        folded = plain + sum(map(whole, self._images))
        tails[folds] += sum(beyond(u, cutoffs[folds]) for u in self._images)
        return np.stack([plain, folded]), tails

    def line(self, at):
        """The line of a law of unit plateau in the bins of its band."""
        (whole, beyond), fall = self._lines[at[0]], self.rolloffs[at[1]] ** (2 * HURSTS[at[0]] + 2)
        return (whole[self._folds[at[2]], at[1]] - fall * beyond[at[2]])[: self.ends[at[2]]]

    def numbers(self, at, jitter=(0.0, 0.0, 0.0)):
        """Exponents, roll-offs and cut-offs of laws, moved by parts of a step of the lattice."""
        hurst = HURSTS[at[0]] + jitter[0] * (HURSTS[1] - HURSTS[0])
        rolloff = self.rolloffs[at[1]] * 10 ** (jitter[1] / PER_DECADE)
        cutoff = self.cutoffs[at[2]] * 10 ** (jitter[2] / PER_DECADE)
        return hurst, rolloff, np.minimum(cutoff, self._bins.nyquist)


@lru_cache(maxsize=2)
def _laws(bins):
    """Laws of lines alike, which are the same whatever the heights."""
    return _Laws(bins)


def _tail(hurst, u, start):
    """int_start^inf k^(-2H - 1) / sqrt(k^2 - u^2) dk for start >= u > 0."""
    from scipy.special import beta, betainc

    a = hurst + 0.5
    return u ** (-2 * a) * betainc(a, 0.5, (u / start) ** 2) * beta(a, 0.5) / 2


def _moment(power, hurst, rolloff, cutoff):
    """2 pi int u^power C_2D du of a unit plateau from u = 1 to the cut-off."""
    start, fall = np.maximum(rolloff, 1.0), 2 * hurst + 2
    falling = rolloff**fall * power_integral(power - fall, start, cutoff)
    return 2 * pi * (power_integral(power, 1.0, start) + falling)


def _weighed(bins, seen, unit, length):
    """The law of least deviance, with quantiles of all of them by their likelihood."""
    from scipy.special import chdtrc

    laws = _laws(bins)
    deviance, amplitude = laws.compared(seen)
    possible = ((HURSTS >= 0) & (HURSTS <= 1))[:, None, None]
    best = np.unravel_index(np.argmin(np.where(possible, deviance, np.inf)), deviance.shape)
    end, square = laws.ends[best[2]], float(bins.number @ seen)
    law = amplitude[best] * laws.line(best)
    strange = float(np.sqrt(np.mean(np.log(seen[:end] / law) ** 2))) > SCATTERED
    if strange or not 1 / FOREIGN < float(bins.number[:end] @ law) / square < FOREIGN:
        raise ValueError(
            "its spectrum is not self-affine at all, and no surface stands for it: for regular "
            'waves take type = "wave", or measure a map'
        )
    dof = max(1, end - UNKNOWNS)
    own = float(deviance[best] - laws.penalty * (len(seen) - end))
    spread = max(1.0, own / dof)
    random = np.random.default_rng(0)
    weights = np.cumsum(np.exp((deviance.min() - deviance.ravel()) / (2 * spread)))
    drawn = np.unravel_index(np.searchsorted(weights, random.random(DRAWN) * weights[-1]), deviance.shape)
    freedoms = np.array([bins.freedoms[:end].sum() for end in laws.ends])[drawn[2]] / spread
    many = laws.numbers(drawn, random.uniform(-0.5, 0.5, (3, DRAWN)))
    scale = np.sqrt(amplitude[drawn] * freedoms / random.chisquare(freedoms))

    def interval(one, all_of_them):
        low, high = np.quantile(all_of_them, [(1 - LEVEL) / 2, (1 + LEVEL) / 2])
        return Interval(float(one), float(min(low, one)), float(max(high, one)))

    slopes = bins.number * seen * bins.u**2
    one, root = laws.numbers(best), sqrt(amplitude[best])
    height, slope = (
        interval(factor * root * np.sqrt(_moment(power, *one)), factor * scale * np.sqrt(_moment(power, *many)))
        for power, factor in ((1, unit), (3, unit * 2 * pi / length))
    )
    return LineLaw(
        hurst=interval(one[0], np.clip(many[0], 0, 1)),
        rms_height=height,
        rms_slope=slope,
        rolloff=interval(length / max(one[1], 1.0), length / np.maximum(many[1], 1.0)),
        shortest=interval(length / one[2], length / many[2]),
        length=length,
        cutoff=bool(one[2] < bins.nyquist),
        follows=bool(chdtrc(dof, own) > UNLIKELY),
        beyond=float(slopes[end:].sum() / slopes.sum()),
    )
