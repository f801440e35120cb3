"""Heights, slopes and spectra of a measured map, and the self-affine law in them.

Spectra are two-sided, as on the page of conventions: <h^2> = 2 pi int q C_2D dq = 2 int C_1D dq.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from math import hypot, log10, pi

import numpy as np

from scene import Topography
from scene.doubt import ANISOTROPIC

from .powerlaw import LEAST, SelfAffineLaw, fit

PER_DECADE = 10  # rings
DECADE = 1.0  # decades of wavelengths below which an exponent says little
STEEP = 10.0  # rms slope above which one of the units is probably another
WHOLE = 1.05  # highest wave number of a map, divided by its last wave number with power, where there is no cut-off
NOTHING = 1e-24  # of the greatest mean square of a wave: rounding


@dataclass(frozen=True)
class Rings:
    """Spectrum averaged over directions, a ring of wave numbers each; rings without power are left out.

    edges : between the rings (N + 1,) [rad/m]
    q : mean wave numbers (N,) [rad/m]
    density : C_2D (N,) [m^4]
    waves : of the map in each (N,), a wave and its opposite counted as one
    freedoms : independent real numbers in each (N,)
    whole : whether the last ring ends where the map does, and not where its power does
    """

    edges: np.ndarray
    q: np.ndarray
    density: np.ndarray
    waves: np.ndarray
    freedoms: np.ndarray
    whole: bool


@dataclass(frozen=True)
class Profile:
    """Spectrum of the rows, averaged over them: wave numbers along x [rad/m] and C_1D [m^3], both (K,)."""

    q: np.ndarray
    density: np.ndarray


@dataclass(frozen=True)
class Description:
    """Heights, slopes and spectra of a map, levelled as it states.

    rms_height : of the pixels [m]
    slopes : rms of the derivatives of its waves, along x and along y [1]
    law : None where there are too few rings
    """

    topography: Topography
    rms_height: float
    slopes: tuple[float, float]
    rings: Rings
    rows: Profile
    law: SelfAffineLaw | None

    @property
    def rms_slope(self) -> float:
        """Rms slope of the full gradient, by its waves [1]."""
        return hypot(*self.slopes)

    @property
    def band(self) -> str:
        """Band of wavelengths of the law, in words; empty without a law."""
        if self.law is None:
            return ""
        start = "below a roll-off" if self.law.rolloff else "from the longest wave"
        end = "to a cut-off" if self.law.cutoff or not self.rings.whole else "to the shortest"
        ends = f"{self.law.longest:.3g} to {self.law.shortest:.3g} m"
        return f"{ends}, {self.law.decades:.2f} decades, {start} {end}"

    @property
    def warnings(self) -> list[str]:
        """Reasons not to take the numbers at their word."""
        return [*_of_law(self.law), *_of_directions(self.slopes), *_of_slope(self.rms_slope)]


def describe(topography: Topography) -> Description:
    """Description of a map. Raises ValueError where it has no heights, or no waves to average over directions."""
    relief, waves = topography.relief, topography.waves
    if not relief.any():
        raise ValueError(f"heights are none once level = {topography.level!r} is taken off")
    rings = rings_of(topography)
    enough = len(rings.q) >= LEAST
    return Description(
        topography=topography,
        rms_height=float(np.sqrt(np.mean(np.square(relief)))),
        slopes=(waves.rms_slope_x, waves.rms_slope_y),
        rings=rings,
        rows=rows_of(topography),
        law=fit(rings.q, rings.density, rings.freedoms, rings.edges) if enough else None,
    )


def rings_of(topography: Topography) -> Rings:
    """The spectrum of a map on rings of wave numbers, up to the highest that it has in every direction.

    Raises ValueError for a map without waves there.
    """
    waves = topography.waves
    steps, tops = (waves.step_x, waves.step_y), topography.tops
    highest = min(step * top for step, top in zip(steps, tops, strict=True))
    lowest = max(steps) / 2
    q, power = waves.q.ravel(), waves.power.ravel()
    there = (np.arange(-tops[1], tops[1] + 1)[:, None] > 0) | (np.arange(tops[0] + 1) > 0)
    there = there.ravel() & (q >= lowest) & (q < highest * (1 - 1e-9)) & (power > NOTHING * power.max())
    if not there.any():
        raise ValueError(
            f"no wave of the map is shorter than {2 * pi / lowest:g} m and longer than {2 * pi / highest:g} m, of "
            "which it can have all directions: a spectrum takes more pixels, or a map that is more nearly a square"
        )
    count = max(1, round(PER_DECADE * log10(highest / lowest)))
    edges = lowest * (highest / lowest) ** (np.arange(count + 1) / count)
    freedoms = _freedoms(topography, waves.amplitudes.shape).ravel()
    last = q[there].max()
    number, _ = np.histogram(q[there], edges)
    sums = [np.histogram(q[there], edges, weights=each[there])[0] for each in (power, q, freedoms)]
    kept = number > 0
    power, q, freedoms = (each[kept] for each in sums)
    number = number[kept]
    density = waves.unit**2 * power / number / (2 * steps[0] * steps[1])
    borders = np.append(edges[:-1][kept], last)
    return Rings(borders, q / number, density, number, freedoms, bool(last * WHOLE > highest))


def _freedoms(topography, shape):
    """Independent numbers of each wave: modulus and phase; of a mirrored map one for waves that are images."""
    if topography.repeat == "periodic":
        return np.full(shape, 2.0)
    freedoms = np.full(shape, 0.5)
    freedoms[shape[0] // 2] = freedoms[:, 0] = 1.0
    return freedoms


def rows_of(topography: Topography) -> Profile:
    """C_1D of the line scans along x, the mean over all rows of what repeats."""
    waves = topography.waves
    return Profile(waves.along_x[1:], waves.unit**2 * waves.power.sum(axis=0)[1:] / (2 * waves.step_x))


def _of_law(law) -> Iterator[str]:
    if law is None:
        yield "there are too few rings of waves to look for a power law"
        return
    if law.decades < DECADE:
        yield (
            f"the power law spans {law.decades:.2g} decades of wavelengths: an exponent of less than one says "
            "little of another"
        )
    if not law.follows:
        yield (
            f"the spectrum scatters more about the power law than its waves do (chi square {law.misfit:.2g} per "
            "degree of freedom): it may be none"
        )
    if not 0 <= law.hurst <= 1:
        yield f"a Hurst exponent of {law.hurst:.2g} is none of a self-affine surface, which has 0 to 1"


def _of_directions(slopes) -> Iterator[str]:
    low, high = sorted(slopes)
    if high > ANISOTROPIC * low:
        yield (
            f"the rms slopes along x and y, {slopes[0]:.3g} and {slopes[1]:.3g}, are not those of an isotropic "
            "surface: a line drawn by C_1D = pi q C_2D stands for neither direction"
        )


def _of_slope(slope) -> Iterator[str]:
    if slope > STEEP:
        yield (
            f"the rms slope is {slope:.3g}, which no surface has: check the unit of the heights and the side of a "
            "pixel"
        )


def mapped(rings: Rings) -> np.ndarray:
    """C_1D = pi q C_2D [m^3] of the rule of the MDR (N,)."""
    return pi * rings.q * rings.density
