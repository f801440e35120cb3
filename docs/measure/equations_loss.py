"""Eqs. 20 to 25 against the simulation: a part of docs/measure/equations.py."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from math import pi, sin

import numpy as np
from ensembles import deviation, friction, mean_slope, measured, pixels, profile, solve, steep
from tables import table

from mdr1d import MDR
from mdr1d import equations as eq
from scene import Fractional, Kelvin, Scene, SelfAffine, Slide, Sphere

G, SPEED = 1e6, 1e-2
SHAPE, LOAD = Sphere(1.0), 2.0
# Many periods in the contact: the scatter is small, and no equation asks for the period.
FINE = SelfAffine(hurst=0.4, rms_height=1e-6, longest=5e-4, shortest=1e-5)
Q_MAX = FINE.q_max(0.0)
# G''(q_max v) over the static modulus: full contact, and a depth that the static modulus governs.
SLOW = 0.003
LOSSES, HURSTS = (1.0, 0.2), (0.1, 0.5, 0.9)


def solid(beta: float, share: float, fastest: float = SPEED) -> Fractional | Kelvin:
    """A solid whose loss is a power of the frequency, G''(q_max SPEED) = share G; beta = 1 is Kelvin."""
    time = (share / sin(pi * beta / 2)) ** (1 / beta) / (Q_MAX * SPEED)
    if beta == 1:
        return Kelvin(G, time)
    # From a hundredth of the frequency of the contact to the short waves that corners of the polygon add.
    band = {"lowest_frequency": SPEED, "highest_frequency": 300 * Q_MAX * fastest}
    return Fractional(modulus=G, relaxation_time=time, exponent=beta, **band)


def loss_of(elastomer: Fractional | Kelvin) -> Callable:
    """G''(omega) of the law itself."""
    modulus = elastomer.law if isinstance(elastomer, Fractional) else elastomer.complex_modulus
    return lambda omega: modulus(omega).imag


def rough_of(hurst: float) -> SelfAffine:
    """Roughness with an rms slope of 0.1, seven times that of the sphere over its contact."""
    return steep(replace(FINE, hurst=hurst), 0.1)


def one_frequency() -> str:
    """Eqs. 20 and 21, and the spectral form."""
    motion = Slide(speed=SPEED, load=LOAD)
    length = 2 * eq.contact_radius(LOAD, G, *profile(SHAPE))

    def rows():
        for beta in LOSSES:
            elastomer = solid(beta, SLOW)
            loss = loss_of(elastomer)
            smooth = MDR().solve(Scene(SHAPE, elastomer, motion)).friction_coefficient
            for rough in map(rough_of, HURSTS):
                found = solve(Scene(SHAPE, elastomer, motion, rough))
                slopes, mu = measured(found, "rms_slope"), friction(found)
                one, printed = (
                    eq.one_frequency_friction(LOAD, G, loss, Q_MAX, SPEED, slopes, *profile(SHAPE), form)
                    for form in ("corrected", "as_printed")
                )
                spectrum = partial(rough.density_1d, q_max=Q_MAX)
                spectral = eq.spectral_force(loss, spectrum, (rough.q_min, Q_MAX), SPEED, length) / LOAD
                yield (
                    f"{beta:g}",
                    f"{rough.hurst:g}" + (" *" if 2 * rough.hurst > 1 + beta else ""),
                    deviation(printed, mu),
                    deviation(one, mu),
                    f"{spectral / one.mean():.2f}",
                    deviation(spectral, mu),
                    f"{smooth / mu.mean():.0%}",
                    deviation(spectral + smooth, mu),
                )

    header = "β|H|Eq. 21 as printed|Eq. 21|spectral over Eq. 21|spectral|share of the smooth sphere|spectral + it"
    return table(header, rows())


def general() -> str:
    """Eqs. 22 and 25 from full contact to the plateau."""
    ratios = 10.0 ** np.arange(-2, 3)
    radius = eq.contact_radius(LOAD, G, *profile(SHAPE))

    def rows():
        for beta in LOSSES:
            for rough in (rough_of(0.1), rough_of(0.8)):
                slope = mean_slope(rough, pixels(rough))
                # Eq. 21 is in proportion to the loss: that of G, over the plateau.
                unit = eq.one_frequency_friction(LOAD, G, lambda _: G, Q_MAX, SPEED, slope, *profile(SHAPE))
                unit = unit / eq.plateau(slope)
                cells, printed = [], []
                for ratio in ratios:
                    elastomer = solid(beta, ratio / unit)
                    mu = friction(solve(Scene(SHAPE, elastomer, Slide(speed=SPEED, load=LOAD), rough)))
                    known = (LOAD, G, loss_of(elastomer), Q_MAX, SPEED, slope, *profile(SHAPE))
                    cells.append(deviation(eq.general_friction(*known), mu))
                    printed.append(deviation(eq.general_friction(*known, form="as_printed"), mu))
                stiff = solid(beta, 1 / unit).complex_modulus(SPEED / radius).real / G
                top = f"{mu.mean() / eq.plateau(slope):.2f}"
                yield f"{beta:g}", f"{rough.hurst:g}", f"{stiff:.3g}", *cells, top, printed[0]

    columns = "|".join(f"ξ = {ratio:g}" for ratio in ratios)
    return table(f"β|H|G′(v/a)/G₀ at ξ = 1|{columns}|μ/(√2 s) at 100|as printed, ξ = 0.01", rows())


SECTIONS = {
    "one frequency": one_frequency,
    "general": general,
}
