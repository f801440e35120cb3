"""Rough surfaces in two dimensions: one draw from the spectrum of a scene, evaluated wherever a grid asks."""

from dataclasses import dataclass
from functools import lru_cache
from math import isqrt

import numpy as np
from scipy.fft import ifft, irfft

from scene import CrossedWaves, Profile, SolveError, Topography
from scene.surfaces.isotropic import Isotropic, seeded
from scene.surfaces.topography import MOST_WAVES, Waves

CORE = 16  # shells in which the density varies much across the cell of a wave vector
CORE_SAMPLES, OUTER_SAMPLES = 8, 2  # per axis, in the cell
SMALL, KEPT = 128, 16  # waves along x, or points, up to which the last spectra and cosines are kept: 13 MB
# Spawn keys keep a surface apart from a line drawn with the same seed, and the moduli of waves from the phases.
PHASES, MODULI = (2,), (2, 0)


@dataclass(frozen=True)
class RoughSurface:
    """Periodic sum of cosines on grids: with random phases for a spectrum, with its own phases for a map."""

    waves: Waves

    @classmethod
    def of(cls, roughness, q_max: float) -> "RoughSurface":
        """The surface of a scene's roughness, with the cut-off q_max [rad/m] where it has a spectrum."""
        if isinstance(roughness, Isotropic):
            return cls.draw(roughness, q_max)
        if isinstance(roughness, Profile):
            return cls.draw(roughness.fitted, q_max)
        if isinstance(roughness, Topography):
            return cls(roughness.waves if roughness.seed == 0 else roughness.waves.moved(*roughness.shift))
        amplitudes = np.zeros((3, 2), complex)
        if isinstance(roughness, CrossedWaves):  # cos x cos y is half of cos(x + y) and cos(x - y)
            amplitudes[[0, 2], 1] = roughness.amplitude / 2
        else:
            amplitudes[1, 1] = roughness.amplitude
        step = 2 * np.pi / roughness.wavelength
        return cls(Waves(step, step, amplitudes))

    @classmethod
    def draw(cls, roughness: Isotropic, q_max: float) -> "RoughSurface":
        """One surface with the cut-off q_max [rad/m].

        Each wave vector carries the power of its cell of the lattice, int C_2D d^2q, so that the rms height over
        a period is exactly the rms height of the spectrum, and its density is C_2D at every q. With Gaussian
        amplitudes both hold in the mean over many surfaces. Waves are drawn shell by shell: a higher cut-off adds
        detail to the same surface. Raises SolveError when it would not fit in memory, seven times as much while
        it is drawn.
        """
        top = int(q_max / roughness.q_min * (1 + 1e-12))
        if top > MOST_WAVES:
            raise SolveError(
                f"the surface has {top:.15g} waves of its cut-off on longest = {roughness.longest:g} m, "
                f"{MOST_WAVES} fit in memory: state a longer shortest or shortest_kept, or a shorter longest wave"
            )
        # At unit height, as the square of a tiny one would vanish.
        shared = seeded(roughness.normalized, 1)
        amplitudes, order = (_kept if top <= SMALL else _spectrum)(shared, top, q_max)
        phases, moduli = np.empty(order.size), np.ones(order.size)
        phases[order] = 2 * np.pi * _stream(roughness.seed, PHASES).random(order.size)
        if roughness.amplitudes == "gaussian":
            moduli[order] = np.sqrt(_stream(roughness.seed, MODULI).standard_exponential(order.size))
        waves = roughness.rms_height * amplitudes * np.exp(1j * phases.reshape(amplitudes.shape))
        return cls(Waves(roughness.q_min, roughness.q_min, waves * moduli.reshape(amplitudes.shape)))

    @property
    def amplitudes(self) -> np.ndarray:
        """Complex amplitudes of the waves [m]."""
        return self.waves.amplitudes

    def heights(self, x, y):
        """h [m], (ny, nx), on the grid of coordinates x (nx,) and y (ny,) [m]."""
        return self._sum(self.amplitudes, x, y)

    def slopes(self, x, y):
        """dh/dx [1], (ny, nx)."""
        return self._sum(1j * self.waves.along_x * self.amplitudes, x, y)

    def curvatures(self, x, y):
        """d2h/dx2 [1/m], (ny, nx)."""
        return self._sum(-(self.waves.along_x**2) * self.amplitudes, x, y)

    def _sum(self, amplitudes, x, y):
        if _span_a_period(x, self.waves.step_x) and _span_a_period(y, self.waves.step_y):
            return self._on_a_period(amplitudes, x, y)
        top = len(amplitudes) // 2
        even, odd = amplitudes[top:] + amplitudes[top::-1], amplitudes[top:] - amplitudes[top::-1]  # in y
        even[0] /= 2
        shares = np.vstack([np.hstack([even.real, -even.imag]), np.hstack([-odd.imag, -odd.real])])
        return _cosines(y, self.waves.step_y, len(even)) @ shares @ _cosines(x, self.waves.step_x, even.shape[1]).T

    def _on_a_period(self, amplitudes, x, y):
        top, highest = len(amplitudes) // 2, amplitudes.shape[1] - 1
        # Transforms carry all waves: on the points of a coarse grid, between which they have others.
        between_y, between_x = 2 * top // len(y) + 1, 2 * highest // len(x) + 1
        waves = np.zeros((between_y * len(y), highest + 1), complex)
        along_y = np.arange(-top, top + 1)
        waves[along_y] = amplitudes * np.outer(
            np.exp(1j * self.waves.along_y * y[0]), np.exp(1j * self.waves.along_x * x[0]) / 2
        )
        waves[:, 0] *= 2  # the others stand for their mirror images as well
        rows = ifft(waves, axis=0, norm="forward")[::between_y]
        return np.ascontiguousarray(irfft(rows, between_x * len(x), norm="forward")[:, ::between_x])

    @property
    def rms_height(self) -> float:
        """Rms height over a period [m]."""
        return self.waves.rms_height

    @property
    def rms_slope(self) -> float:
        """Spectral rms of the full gradient over a period [1]."""
        return self.waves.rms_slope


def _span_a_period(places, step):
    """Whether places (n,) divide the period of a wave number evenly, so that a transform suffices."""
    pixel = 2 * np.pi / (step * len(places))
    given = abs(places[-1] - places[0]) / max(len(places) - 1, 1)
    return abs(given - pixel) <= 1e-9 * pixel


def _cosines(places, step, count):
    """Cosines, then sines, of `count` multiples of a wave number at the places (n,): (n, 2 count)."""
    if max(len(places), count) <= SMALL:  # heights, slopes and curvatures of a small grid ask for the same ones
        return _kept_cosines(places.tobytes(), step, count)
    return _evaluated(places, step, count)


@lru_cache(KEPT)
def _kept_cosines(places, step, count):
    return _evaluated(np.frombuffer(places), step, count)


def _evaluated(places, step, count):
    side = isqrt(count - 1) + 1  # a wave is the product of two, of far fewer
    turns = np.exp(1j * step * places[:, None, None] * np.multiply.outer([side, 1], np.arange(side)))
    waves = (turns[:, 0, :, None] * turns[:, 1, None, :]).reshape(len(places), -1)[:, :count]
    return np.hstack([waves.real, waves.imag])


def _stream(seed, key):
    return np.random.default_rng(np.random.SeedSequence(seed, spawn_key=key))


def _spectrum(roughness, top, q_max):
    """Amplitudes (2 top + 1, top + 1) that all surfaces of a spectrum have, and the order of their phases."""
    k_y, k_x = np.mgrid[-top : top + 1, 0 : top + 1]
    k = np.hypot(k_x, k_y)
    drawn = (k >= 1) & (k <= q_max / roughness.q_min * (1 + 1e-12)) & ((k_x > 0) | (k_y > 0))
    power = np.where(drawn, _cell_means(roughness, top, q_max), 0.0)
    power /= power.sum()
    order = np.lexsort((k_x.ravel(), k_y.ravel(), np.maximum(k_x, np.abs(k_y)).ravel()))
    return np.sqrt(2 * power), order


_kept = lru_cache(KEPT)(_spectrum)


def _cell_means(roughness, top, q_max):
    """Mean of C_2D over the unit cell around each point of the lattice, (2 top + 1, top + 1) as amplitudes are."""

    def mean(samples, top):
        along = np.arange(top + 1) + ((np.arange(samples) + 0.5) / samples - 0.5)[:, None]
        q = roughness.q_min * np.hypot(along[:, None, :, None], along[:, None, :])
        return roughness.density_2d(q, q_max).mean(axis=(0, 1))

    core = min(CORE, top)
    power = mean(OUTER_SAMPLES, top)
    power[: core + 1, : core + 1] = mean(CORE_SAMPLES, core)
    return np.concatenate([power[:0:-1], power])
