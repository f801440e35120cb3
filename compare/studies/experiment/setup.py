"""The experiment as the paper states it, and what it leaves open, varied over what is plausible."""

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import product
from math import inf, isfinite, log10
from typing import TypeAlias

import numpy as np

from scene import Fractional, Layer, Prony, Scene, SelfAffine, Slide, Sphere

Solid: TypeAlias = Fractional | Prony
# As stated: shear moduli [Pa], power of the loss, rms height of the ball [m], friction.
RELAXED, GLASSY, POWER, HEIGHT, MEASURED = 3e6, 1.5e9, 0.1, 1e-7, 0.5
SHIFT = -1.5 * POWER  # along the force, as a power of the speed
LOADS, SPEEDS = np.geomspace(1.0, 100.0, 9), np.geomspace(3e-3, 20e-3, 5)  # [N], [m/s]
FREQUENCIES = 1e-3, 1e7  # in which the power law holds [rad/s]: those of a whole contact and of all waves
SLOWEST = 1.0  # v/a at the middle of loads and speeds, to within a factor of five [rad/s]
FASTEST_RATE, RATES = 1e10, 4  # where the loss ends [rad/s]; modes a decade


@dataclass(frozen=True)
class Pair:
    """A ball and what it slides on. radius, thickness : [m]; thickness inf of a half-space"""

    radius: float
    thickness: float

    @property
    def title(self) -> str:
        on = f"{1e3 * self.thickness:g} mm" if isfinite(self.thickness) else "a half-space"
        return f"{1e3 * self.radius:g} mm on {on}"

    @property
    def width(self) -> float:
        """Thickness of the layer; that of the first layer for a half-space [m]."""
        return self.thickness if isfinite(self.thickness) else MAIN.thickness

    @property
    def crossover(self) -> float:
        """F* = (2/3) G_0 D^3/R [N], at which Hertz has the contact as wide as the layer is thick."""
        return 2 / 3 * RELAXED * self.width**3 / self.radius

    def scene(self, solid: Solid, speed: float, load: float) -> Scene:
        """The smooth ball that slides."""
        layer = Layer(thickness=self.thickness) if isfinite(self.thickness) else None
        return Scene(Sphere(self.radius), solid, Slide(speed=speed, load=load), layer=layer)


MAIN, THIN, HALF_SPACE = Pair(0.05, 0.01), Pair(0.05, 0.005), Pair(0.05, inf)
PAIRS = MAIN, Pair(0.025, 0.005), THIN, HALF_SPACE


def everywhere(part: float) -> Fractional:
    """Solid whose loss is a power at all frequencies. part : rise of its modulus up to SLOWEST, of that at rest"""
    return Fractional(
        modulus=RELAXED,
        relaxation_time=part ** (1 / POWER) / SLOWEST,
        exponent=POWER,
        lowest_frequency=FREQUENCIES[0],
        highest_frequency=FREQUENCIES[1],
        tolerance=1e-2,
    )


def from_onset(rate: float) -> Prony:
    """Solid whose loss is a power from a rate [rad/s] up to FASTEST_RATE, where its modulus is the glassy one."""
    rates = np.geomspace(rate, FASTEST_RATE, round(RATES * log10(FASTEST_RATE / rate)) + 1)
    moduli = (GLASSY - RELAXED) * rates**POWER / np.sum(rates**POWER)
    return Prony(RELAXED, tuple(moduli.tolist()), tuple((1 / rates).tolist()))


# Solids in which the relaxed modulus carries the contact, as the paper assumes, and all, by name.
ASSUMED: Mapping[str, Solid] = {f"power law, {part:g} at contact": everywhere(part) for part in (0.03, 0.1, 0.3)}
SOLIDS: Mapping[str, Solid] = {
    **ASSUMED,
    **{f"power law, {part:g} at contact": everywhere(part) for part in (1.0, 3.0)},
    **{f"loss from {rate:g} rad/s": from_onset(rate) for rate in (0.3, 30.0, 3000.0)},
}
LOSSY, STIFF = "power law, 0.3 at contact", "loss from 3000 rad/s"


@dataclass(frozen=True)
class Size:
    """Size of the study. hurst, shortest, longest : of the spectra [1], [m], [m]; checks : surfaces of each"""

    solids: tuple[str, ...]
    pairs: tuple[Pair, ...]
    hurst: tuple[float, ...]
    shortest: tuple[float, ...]
    points: int
    checks: int = 0
    longest: tuple[float, ...] = (2e-4, 1e-3)

    @property
    def spectra(self) -> tuple[SelfAffine, ...]:
        """Roughness of the ball, every one that is plausible."""
        return tuple(
            SelfAffine(rms_height=HEIGHT, hurst=hurst, longest=longest, shortest=shortest)
            for hurst, shortest, longest in product(self.hurst, self.shortest, self.longest)
        )


_WHOLE = tuple(SOLIDS), PAIRS, (0.5, 0.8, 1.0), (1e-7, 1e-6, 1e-5, 1e-4)
SIZES = {
    "quick": Size((next(iter(ASSUMED)), LOSSY, STIFF), (MAIN, HALF_SPACE), (0.5, 1.0), (1e-6, 1e-4), 64),
    "standard": Size(*_WHOLE, points=128, checks=12),
    "full": Size(*_WHOLE, points=256, checks=48),
}
