"""The experiment as the paper states it, and what it leaves open, varied over what is plausible."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import log10

import numpy as np

from scene import Fractional, Layer, Prony, Scene, SelfAffine, Slide, Sphere
from scene.scales import elastic_contact
from scene.viscoelastic import Linear

# As stated: shear moduli [Pa], power of the loss, rms height of the ball [m], friction.
RELAXED, GLASSY, POWER, HEIGHT, MEASURED = 3e6, 1.5e9, 0.1, 1e-7, 0.5
LOADS, SPEEDS = np.geomspace(1.0, 100.0, 9), np.geomspace(3e-3, 20e-3, 5)  # [N], [m/s]
FREQUENCIES = 1e-3, 1e7  # in which the power law holds [rad/s]: those of a whole contact and of all waves
SLOWEST = 1.0  # v/a at the middle of loads and speeds, to within a factor of five [rad/s]
FASTEST_RATE, RATES = 1e10, 4  # where the loss ends [rad/s]; modes a decade


@dataclass(frozen=True)
class Pair:
    """A ball and what it slides on. radius, thickness : [m]; thickness None of a half-space"""

    radius: float
    thickness: float | None

    @property
    def title(self) -> str:
        on = "a half-space" if self.thickness is None else f"{1e3 * self.thickness:g} mm"
        return f"{1e3 * self.radius:g} mm on {on}"

    def scene(self, solid: Linear, speed: float, load: float) -> Scene:
        """The smooth ball that slides."""
        layer = None if self.thickness is None else Layer(thickness=self.thickness)
        return Scene(Sphere(self.radius), solid, Slide(speed=speed, load=load), layer=layer)


def crossover(radius: float, thickness: float) -> float:
    """F* = (2/3) G_0 D^3/R [N], where a Hertzian contact of an incompressible solid is as wide as the layer thick."""
    return 2 / 3 * RELAXED * thickness**3 / radius


def everywhere(part: float) -> Fractional:
    """Solid whose loss is a power at all frequencies. part : modulus at SLOWEST less that at rest, over the latter"""
    low, high = FREQUENCIES
    return Fractional(
        modulus=RELAXED,
        relaxation_time=part ** (1 / POWER) / SLOWEST,
        exponent=POWER,
        lowest_frequency=low,
        highest_frequency=high,
        tolerance=1e-2,
    )


def from_onset(rate: float) -> Prony:
    """Solid whose loss is a power from a rate [rad/s] up to FASTEST_RATE, where its modulus is the glassy one."""
    rates = np.geomspace(rate, FASTEST_RATE, round(RATES * log10(FASTEST_RATE / rate)) + 1)
    moduli = (GLASSY - RELAXED) * rates**POWER / np.sum(rates**POWER)
    return Prony(RELAXED, tuple(moduli.tolist()), tuple((1 / rates).tolist()))


# Solids in which the relaxed modulus carries the contact, as the paper assumes, and others, by name.
ASSUMED: Mapping[str, Linear] = {
    f"power law, {part:g} at contact": everywhere(part) for part in (0.03, 0.1, 0.3)
}
OTHERS: Mapping[str, Linear] = {
    "power law, 1 at contact": everywhere(1.0),
    "power law, 3 at contact": everywhere(3.0),
    **{f"loss from {rate:g} rad/s": from_onset(rate) for rate in (0.3, 30.0, 3000.0)},
}
SOLIDS = {**ASSUMED, **OTHERS}
MAIN, HALF_SPACE = Pair(0.05, 0.01), Pair(0.05, None)
PAIRS = MAIN, Pair(0.025, 0.005), Pair(0.05, 0.005), HALF_SPACE


@dataclass(frozen=True)
class Size:
    """How much is solved. solids : names; hurst, shortest, longest : of the spectra [1], [m], [m]; checks : surfaces"""

    solids: tuple[str, ...]
    pairs: tuple[Pair, ...]
    hurst: tuple[float, ...]
    shortest: tuple[float, ...]
    longest: tuple[float, ...]
    points: int = 128
    checks: int = 0

    @property
    def spectra(self) -> tuple[SelfAffine, ...]:
        """Roughness of the ball, every one that is plausible."""
        return tuple(
            SelfAffine(rms_height=HEIGHT, hurst=hurst, longest=longest, shortest=shortest)
            for hurst in self.hurst
            for shortest in self.shortest
            for longest in self.longest
        )


_FEW = tuple(ASSUMED)[::2] + tuple(OTHERS)[-1:]
_WHOLE = tuple(SOLIDS), PAIRS, (0.5, 0.8, 1.0), (1e-7, 1e-6, 1e-5, 1e-4), (2e-4, 1e-3)
SIZES = {
    "quick": Size(_FEW, (MAIN, HALF_SPACE), (0.5, 1.0), (1e-6, 1e-4), (2e-4, 1e-3), 64),
    "standard": Size(*_WHOLE, checks=12),
    "full": Size(*_WHOLE, points=256, checks=48),
}


@dataclass(frozen=True)
class Check:
    """A ball with waves that a grid holds, solved as it is.

    height : rms over the depth; waves : shortest in the radius of the contact, of which the longest is a third; both
        as at rest on a half-space
    """

    title: str
    pair: Pair
    solid: str
    load: float
    height: float
    waves: float
    hurst: float = 0.8

    @property
    def smooth(self) -> Scene:
        """The ball without roughness."""
        return self.pair.scene(SOLIDS[self.solid], 0.01, self.load)

    @property
    def rough(self) -> SelfAffine:
        """Its roughness."""
        rest = elastic_contact(replace(self.smooth, layer=None))
        return SelfAffine(
            rms_height=self.height * rest.depth,
            hurst=self.hurst,
            longest=rest.radius / 3,
            shortest=rest.radius / self.waves,
            seed=1,
        )


POINTS = 320  # a side, ten to the shortest wave
CHECKS = (
    Check("10 N, a/12", MAIN, "power law, 0.3 at contact", 10.0, 0.02, 12),
    Check("100 N, a/12", MAIN, "power law, 0.3 at contact", 100.0, 0.02, 12),
    Check("10 N on 5 mm, a/12, H = 0.5", Pair(0.05, 0.005), "power law, 0.3 at contact", 10.0, 0.04, 12, 0.5),
    Check("10 N, a/12, stiff waves", MAIN, "loss from 30 rad/s", 10.0, 0.04, 12),
)
