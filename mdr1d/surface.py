"""A rough line drawn from the one-dimensional spectrum of a scene's roughness, and how fine lines are."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from math import ceil, floor, hypot, nan, pi, sqrt
from typing import Literal

import numpy as np
from scipy.fft import irfft

from scene import Profile, Topography
from scene.quantities import BARE, takes
from scene.surfaces.isotropic import Isotropic, seeded
from scene.surfaces.roughness import Roughness

# Spectrum of a line: C_1D = pi q C_2D, or the spectrum of a line scan of the surface.
Spectrum = Literal["mapped", "line-scan"]

# Spawn keys keep a line apart from a surface drawn with the same seed, and the moduli of waves from the phases.
_PHASES, _MODULI = (1,), (1, 0)
# Phases kept for the next spectrum: 2 MB of them at most, for each of a few seeds.
_MOST_KEPT = 2**17


# One period of roughness must fit into memory, and have waves at all.
MOST_NODES, _LEAST_NODES = 2**25, 4


@dataclass(frozen=True)
class Band:
    """Band of waves of a line: period and shortest wavelength [m], None where the nodes are the cut-off."""

    period: float
    shortest: float | None

    @property
    def waves(self) -> float:
        """Number of the shortest waves in a period; nan where the nodes are the cut-off."""
        return nan if self.shortest is None else self.period / self.shortest

    @property
    def nodes(self) -> int:
        """Number of nodes in a period, two to the shortest wave."""
        if self.shortest is None:
            return _LEAST_NODES
        return ceil(2 * self.waves * (1 - 1e-12))


def band_of(roughness: Roughness, spectrum: Spectrum = "mapped") -> Band:
    """Band of a line that stands for a scene's roughness.

    A measured map has waves in all directions, the shortest of them across its pixels' corners; its rows have
    those along x. A measured line has its own as a line scan, and else those of the surface fitted to it.
    """
    if isinstance(roughness, Profile) and spectrum == "line-scan":
        return Band(roughness.side, roughness.side / roughness.top)
    if not isinstance(roughness, Topography):
        return Band(roughness.longest, roughness.shortest)
    (side_x, side_y), (top_x, top_y) = roughness.sides, roughness.tops
    if spectrum == "line-scan":
        return Band(side_x, side_x / top_x)
    period, highest = roughness.period, hypot(top_x / side_x, top_y / side_y)
    if roughness.shortest_kept is not None:
        highest = min(highest, (1 + 1e-12) / roughness.shortest_kept)
    return Band(period, period / int(period * highest + 0.5))


def nodes_needed(roughness: Roughness, spectrum: Spectrum = "mapped") -> int:
    """Nodes in a period that the shortest wave asks for."""
    return band_of(roughness, spectrum).nodes


@dataclass(frozen=True)
class Surface:
    """One period of a rough line: h(x) = sum_k amplitudes[k-1] cos(2 pi k x / period + phase_k).

    heights : at the nodes x = 0, pixel, ..., period - pixel (M,) [m]
    pixel : spacing of the nodes [m]
    amplitudes : of the waves k = 1, 2, ... (K,) [m]
    shortest : wavelength of the cut-off of the spectrum [m]
    """

    heights: np.ndarray
    pixel: float
    amplitudes: np.ndarray
    shortest: float

    @property
    def period(self) -> float:
        """Period [m]."""
        return self.heights.size * self.pixel

    @cached_property
    def rms_height(self) -> float:
        """rms of the heights at the nodes over a period [m]."""
        return sqrt(np.mean(np.square(self.heights)))

    @cached_property
    def rms_slope(self) -> float:
        """rms of the finite differences between neighbouring nodes over a period [1]."""
        steps = np.diff(self.heights, append=self.heights[0])
        return sqrt(np.mean(np.square(steps))) / self.pixel

    @cached_property
    def rms_slope_spectral(self) -> float:
        """rms slope of the sum of waves [1]; finite differences cut the shortest ones short."""
        k = np.arange(1, self.amplitudes.size + 1)
        return 2 * pi / self.period * sqrt(np.sum(np.square(k * self.amplitudes)) / 2)


def through(waves: np.ndarray, nodes: int, band: Band) -> Surface:
    """The line with complex amplitudes of the waves k = 1, 2, ... (K,) [m], on `nodes` nodes a period."""
    spread = np.zeros(nodes // 2 + 1, complex)
    spread[1 : waves.size + 1] = waves / 2
    if 2 * waves.size == nodes:
        spread[-1] = waves[-1].real
    heights = np.fft.irfft(spread, n=nodes, norm="forward")
    return Surface(heights, band.period / nodes, np.abs(waves), band.shortest or nan)


@takes(bandwidth=BARE)
def amplitudes(roughness: Isotropic, bandwidth: float, spectrum: Spectrum = "mapped") -> np.ndarray:
    """Amplitudes of the waves q_k = k q_min (K,) [m], K the whole part of the bandwidth q_max / q_min.

    Wave k has the variance of its cell, A_k^2 / 2 = 2 int C_1D dq from q_(k-1/2) to q_(k+1/2), and the last cell
    ends at q_max. A mapped spectrum starts at q_min, and so does its first cell: the sum of variances is
    rms_height^2. A line scan has power at every q: what it has below q_min / 2 is the mean height of a period of
    the line, and is left out, so that the line has less than rms_height. Gaussian amplitudes have these as their
    root mean square.
    """
    # The bandwidth is a quotient: rounding must not cost it its last wave.
    edges = np.arange(floor(bandwidth * (1 + 1e-9)) + 1) + 0.5
    edges[-1] = bandwidth
    if spectrum == "mapped":
        edges[0] = 1.0
    share = roughness.share if spectrum == "mapped" else roughness.share_line_scan
    edges = edges * roughness.q_min
    shares = share(edges[:-1], edges[1:], bandwidth * roughness.q_min)
    return roughness.rms_height * np.sqrt(2 * shares)


@dataclass(frozen=True, eq=False)
class LineFamily:
    """Lines of a spectrum on a grid, one for each seed.

    amplitudes : of the waves k = 1, 2, ... (K,) [m], fixed or, if gaussian, the root of their mean squares
    nodes : in a period; pixel : their spacing [m]
    shortest : wavelength of the cut-off of the spectrum [m]
    """

    amplitudes: np.ndarray
    gaussian: bool
    nodes: int
    pixel: float
    shortest: float

    def drawn(self, seed: int) -> Surface:
        """The line of a seed, wave by wave. Phases are the same for every spectrum and kind of amplitude.

        A wave at the Nyquist wave number has no phase on the grid. One of fixed amplitude keeps its sign and gets
        the height that keeps its variance; a Gaussian one is left with its real part, a Gaussian height of that
        variance.
        """
        return self.drawn_together([seed])[0]

    def drawn_together(self, seeds: Sequence[int]) -> list[Surface]:
        """The lines of some seeds, by one transform."""
        # Not zeros(): fresh pages of memory would take longer than the waves.
        spread, drawn = np.full((len(seeds), self.nodes // 2 + 1), 0j), []
        for own, seed in zip(spread, seeds, strict=True):
            waves = self.amplitudes
            if self.gaussian:
                waves = waves * np.sqrt(_stream(seed, _MODULI).standard_exponential(waves.size))
            np.multiply(_phasors(seed, waves.size), waves / 2, out=own[1 : waves.size + 1])
            if 2 * waves.size == self.nodes:
                real = own[-1].real
                own[-1] = 2 * real if self.gaussian else np.copysign(waves[-1] / sqrt(2), real)
            drawn.append(waves)
        heights = irfft(spread, n=self.nodes, norm="forward", overwrite_x=True)
        return [
            Surface(each, self.pixel, waves, self.shortest) for each, waves in zip(heights, drawn, strict=True)
        ]


def family_of(roughness: Isotropic, nodes: int, spectrum: Spectrum = "mapped") -> LineFamily:
    """The lines of a spectrum on `nodes` nodes a period; the seed does not matter.

    Their waves do not depend on the grid as long as the cut-off does not; without `shortest` the cut-off is the
    Nyquist wave number of this grid, as in the paper.
    """
    return _unseeded(seeded(roughness, 0), nodes, spectrum)


def draw(roughness: Isotropic, nodes: int, spectrum: Spectrum = "mapped") -> Surface:
    """Draw one period of the rough line, on `nodes` nodes, from its seed."""
    return family_of(roughness, nodes, spectrum).drawn(roughness.seed)


@lru_cache(maxsize=16)
def _unseeded(roughness, nodes, spectrum):
    """Lines of a spectrum, evaluated once for all seeds: amplitudes of a line scan take longer than a sweep."""
    pixel = roughness.longest / nodes
    q_max = roughness.q_max(pixel)
    waves = amplitudes(roughness, q_max / roughness.q_min, spectrum)
    waves.setflags(write=False)
    return LineFamily(waves, roughness.amplitudes == "gaussian", nodes, pixel, 2 * pi / q_max)


def _phasors(seed, count):
    """exp(i phase) of the first waves of a seed; lines of many spectra begin with the same."""
    if count > _MOST_KEPT:
        return _drawn_phasors(seed, count)
    return _kept_phasors(seed, 1 << (count - 1).bit_length())[:count]


@lru_cache(maxsize=16)
def _kept_phasors(seed, count):
    return _drawn_phasors(seed, count)


def _drawn_phasors(seed, count):
    phases = 2 * pi * _stream(seed, _PHASES).random(count)
    return np.cos(phases) + 1j * np.sin(phases)


def _stream(seed, key):
    return np.random.default_rng(np.random.SeedSequence(seed, spawn_key=key))
