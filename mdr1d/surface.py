"""A rough line drawn from the one-dimensional spectrum of a scene's roughness."""

from dataclasses import dataclass
from math import floor, pi, sqrt

import numpy as np

from scene.roughness import SelfAffine

# The spawn key keeps the phases of a line apart from those of a surface drawn with the same seed.
_LINE = 1


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

    @property
    def rms_height(self) -> float:
        """rms of the heights at the nodes over a period [m]."""
        return sqrt(np.mean(np.square(self.heights)))

    @property
    def rms_slope(self) -> float:
        """rms of the finite differences between neighbouring nodes over a period [1]."""
        steps = self.heights - np.roll(self.heights, 1)
        return sqrt(np.mean(np.square(steps / self.pixel)))

    @property
    def rms_slope_spectral(self) -> float:
        """rms slope of the sum of waves [1]; finite differences cut the shortest ones short."""
        k = np.arange(1, self.amplitudes.size + 1)
        return 2 * pi / self.period * sqrt(np.sum(np.square(k * self.amplitudes)) / 2)


def amplitudes(roughness: SelfAffine, bandwidth: float) -> np.ndarray:
    """Amplitudes of the waves q_k = k q_min (K,) [m], K the whole part of the bandwidth q_max / q_min.

    Wave k has the variance of its cell, A_k^2 / 2 = 2 int C_1D dq from q_(k-1/2) to q_(k+1/2). The first cell
    starts at q_min and the last ends at q_max, so that the sum of variances is rms_height^2.
    """
    # The bandwidth is a quotient: rounding must not cost it its last wave.
    edges = np.arange(floor(bandwidth * (1 + 1e-9)) + 1) + 0.5
    edges[0], edges[-1] = 1.0, bandwidth
    edges = edges * roughness.q_min
    shares = roughness.share(edges[:-1], edges[1:], bandwidth * roughness.q_min)
    return roughness.rms_height * np.sqrt(2 * shares)


def draw(roughness: SelfAffine, nodes: int) -> Surface:
    """Draw one period of the rough line on so many nodes, phase by phase from its seed.

    The waves do not depend on the grid as long as the cut-off does not; without `shortest` the cut-off is the
    Nyquist wave number of this grid, as in the paper.

    A wave at the Nyquist wave number keeps only its sign on the grid: it gets the height that keeps its variance.
    """
    pixel = roughness.longest / nodes
    q_max = roughness.q_max(pixel)
    waves = amplitudes(roughness, q_max / roughness.q_min)
    generator = np.random.default_rng(np.random.SeedSequence(roughness.seed, spawn_key=(_LINE,)))
    spectrum = np.zeros(nodes // 2 + 1, complex)
    spectrum[1 : waves.size + 1] = waves / 2 * np.exp(2j * pi * generator.random(waves.size))
    if 2 * waves.size == nodes:
        spectrum[-1] = np.copysign(waves[-1] / sqrt(2), spectrum[-1].real)
    return Surface(np.fft.irfft(spectrum, n=nodes, norm="forward"), pixel, waves, 2 * pi / q_max)
