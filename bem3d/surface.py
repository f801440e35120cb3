"""Rough surfaces in two dimensions: one draw from the spectrum of a scene, evaluated wherever a grid asks."""

from dataclasses import dataclass, replace

import numpy as np

from scene import CrossedWaves, SelfAffine, SolveError, Topography
from scene.waves import MOST_WAVES, Waves

CORE = 16  # shells in which the density varies much across the cell of a wave vector
CORE_SAMPLES, OUTER_SAMPLES = 8, 2  # per axis, in the cell
# Spawn keys keep a surface apart from a line drawn with the same seed, and the moduli of waves from the phases.
PHASES, MODULI = (2,), (2, 0)


@dataclass(frozen=True)
class RoughSurface:
    """Periodic sum of cosines on grids: of random phases where a spectrum is drawn, of its own of a map."""

    waves: Waves

    @classmethod
    def of(cls, roughness, q_max: float) -> "RoughSurface":
        """The surface of a scene's roughness, with the cut-off q_max [rad/m] where it has a spectrum."""
        if isinstance(roughness, SelfAffine):
            return cls.draw(roughness, q_max)
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
    def draw(cls, roughness: SelfAffine, q_max: float) -> "RoughSurface":
        """One surface with the cut-off q_max [rad/m].

        Each wave vector carries the power of its cell of the lattice, int C_2D d^2q, so that the rms height over a
        period is exactly that of the spectrum and its density is C_2D at every q; of Gaussian amplitudes both are
        means over many surfaces. Waves are drawn shell by shell: a higher cut-off adds detail to the same surface.
        Raises SolveError when it would not fit in memory, seven times as much while it is drawn.
        """
        top = int(q_max / roughness.q_min * (1 + 1e-12))
        if top > MOST_WAVES:
            raise SolveError(
                f"the surface has {top:.15g} waves of its cut-off on longest = {roughness.longest:g} m, "
                f"{MOST_WAVES} fit in memory; take a longer shortest or a shorter longest wave"
            )
        k_y, k_x = np.mgrid[-top : top + 1, 0 : top + 1]
        k = np.hypot(k_x, k_y)
        drawn = (k >= 1) & (k <= q_max / roughness.q_min * (1 + 1e-12)) & ((k_x > 0) | (k_y > 0))
        # Of unit height: the square of a tiny one would vanish.
        power = np.where(drawn, _cell_means(replace(roughness, rms_height=1.0), k_x, k_y, q_max), 0.0)
        power /= power.sum()
        order = np.lexsort((k_x.ravel(), k_y.ravel(), np.maximum(k_x, np.abs(k_y)).ravel()))
        phases, moduli = np.empty(k.size), np.ones(k.size)
        phases[order] = 2 * np.pi * _stream(roughness.seed, PHASES).random(k.size)
        if roughness.amplitudes == "gaussian":
            moduli[order] = np.sqrt(_stream(roughness.seed, MODULI).standard_exponential(k.size))
        waves = roughness.rms_height * np.sqrt(2 * power) * np.exp(1j * phases.reshape(k.shape))
        return cls(Waves(roughness.q_min, roughness.q_min, waves * moduli.reshape(k.shape)))

    @property
    def amplitudes(self) -> np.ndarray:
        """As of its waves."""
        return self.waves.amplitudes

    def heights(self, x, y):
        """h [m], (ny, nx), on the grid of coordinates x (nx,) and y (ny,) [m]."""
        return self._sum(self.amplitudes, x, y)

    def slopes(self, x, y):
        """dh/dx [1], (ny, nx)."""
        return self._sum(1j * self.waves.along_x * self.amplitudes, x, y)

    def _sum(self, amplitudes, x, y):
        if self._spans_a_period(x, y):
            return self._on_a_period(amplitudes, x, y)
        q_y, q_x = self.waves.along_y, self.waves.along_x
        return (np.exp(1j * np.outer(y, q_y)) @ amplitudes @ np.exp(1j * np.outer(q_x, x))).real

    def _spans_a_period(self, x, y):
        """Whether the points divide a period evenly: then one transform does it."""
        counts = np.array([len(y), len(x)])
        pixels = 2 * np.pi / (np.array([self.waves.step_y, self.waves.step_x]) * counts)
        given = np.array([np.ptp(y) / max(len(y) - 1, 1), np.ptp(x) / max(len(x) - 1, 1)])
        return bool(np.allclose(given, pixels, rtol=1e-9, atol=0))

    def _on_a_period(self, amplitudes, x, y):
        q_y, q_x = self.waves.along_y, self.waves.along_x
        top, (ny, nx) = len(q_y) // 2, (len(y), len(x))
        shifted = amplitudes * (np.exp(1j * q_y * y[0]) / 2)[:, None] * np.exp(1j * q_x * x[0])
        # On the points a wave is the same as the one that many wave vectors lower or higher.
        folded = _folded(_folded(shifted, -top, ny).T, 0, nx).T
        waves = folded[:, : nx // 2 + 1].copy()
        waves[:, 1 : (nx + 1) // 2] += _mirrored(folded[:, : nx // 2 : -1])
        alone = [0, nx // 2] if nx % 2 == 0 else [0]  # columns that hold a wave and its mirror image
        waves[:, alone] += _mirrored(waves[:, alone])
        return np.fft.irfft2(waves, s=(ny, nx), norm="forward")

    @property
    def rms_height(self) -> float:
        """Over a period [m]."""
        return self.waves.rms_height

    @property
    def rms_slope(self) -> float:
        """Spectral rms of the full gradient over a period [1]."""
        return self.waves.rms_slope


def _folded(amplitudes, first, count):
    """Rows first, first + 1, ... added where they are the same modulo `count`: (count, ...)."""
    folded = np.zeros((count, *amplitudes.shape[1:]), complex)
    for start in range(0, len(amplitudes), count):
        rows = amplitudes[start : start + count]
        folded[(first + start + np.arange(len(rows))) % count] += rows
    return folded


def _mirrored(waves):
    """Amplitudes of the opposite wave vectors; waves has all rows."""
    return np.conj(np.roll(waves[::-1], 1, axis=0))


def _stream(seed, key):
    return np.random.default_rng(np.random.SeedSequence(seed, spawn_key=key))


def _cell_means(roughness, k_x, k_y, q_max):
    """Mean of C_2D over the unit cell around each lattice point."""

    def mean(samples, k_x, k_y):
        offsets = (np.arange(samples) + 0.5) / samples - 0.5
        total = np.zeros(k_x.shape)
        for along in offsets:
            for aside in offsets:
                q = roughness.q_min * np.hypot(k_x + along, k_y + aside)
                total += roughness.density_2d(q, q_max)
        return total / samples**2

    power = mean(OUTER_SAMPLES, k_x, k_y)
    core = np.maximum(k_x, np.abs(k_y)) <= CORE
    power[core] = mean(CORE_SAMPLES, k_x[core], k_y[core])
    return power
