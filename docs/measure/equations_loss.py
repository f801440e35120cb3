"""Eqs. 20 to 25 against the simulation, and full contact wave by wave: a part of docs/measure/equations.py."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from math import ceil, pi, sin

import numpy as np
from ensembles import deviation, friction, mean_slope, measured, pixels, profile, solve, steep
from tables import order, table

from mdr1d import MDR, draw, modes_of, sweep, sweep_modes
from mdr1d import equations as eq
from scene import Fractional, Kelvin, Scene, SelfAffine, Slide, Sphere, StandardLinearSolid

G, SPEED = 1e6, 1e-2
SHAPE, LOAD = Sphere(1.0), 2.0
# Many periods in the contact: the scatter is small, and no equation asks for the period.
FINE = SelfAffine(hurst=0.4, rms_height=1e-6, longest=5e-4, shortest=1e-5)
Q_MAX = FINE.q_max(0.0)
# G''(q_max v) over the static modulus: full contact, and a depth that the static modulus governs.
SLOW = 0.003
LOSSES, HURSTS = (1.0, 0.5, 0.2), (0.1, 0.3, 0.5, 0.7, 0.9)


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


def bandwidth() -> str:
    """The spectral form over Eq. 20 by the ratio of the longest to the shortest wave."""
    ratios = (1e2, 1e4, 1e6)

    def rows():
        for beta in (0.5, 0.2):
            loss = partial(eq.power_law_loss, loss=G, reference_frequency=1.0, beta=beta)
            for hurst in HURSTS:
                cells = []
                for ratio in ratios:
                    rough = replace(FINE, hurst=hurst, shortest=FINE.longest / ratio)
                    q = rough.q_max(0.0)
                    spectrum = partial(rough.density_1d, q_max=q)
                    spectral = eq.spectral_force(loss, spectrum, (rough.q_min, q), SPEED, 1.0)
                    one = eq.high_frequency_force(loss, q, SPEED, rough.rms_slope(q), 1.0)
                    cells.append(f"{spectral / one:.2f}")
                yield f"{beta:g}", f"{hurst:g}" + (" *" if 2 * hurst > 1 + beta else ""), *cells

    return table("β|H|" + "|".join(f"q_max/q_min = {ratio:g}" for ratio in ratios), rows())


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


def shifts() -> str:
    """Eq. 23: friction at the loads that the shift factor makes equivalent."""
    speeds = SPEED * np.array([1.0, 3.0, 10.0, 30.0])
    lightest = 0.5

    def rows():
        for beta in LOSSES:
            elastomer = solid(beta, 1.0, speeds[-1])
            for rough in (rough_of(0.1), rough_of(0.8)):
                slope = mean_slope(rough, pixels(rough))
                p = eq.force_shift(speeds, G, loss_of(elastomer), Q_MAX, slope, *profile(SHAPE))
                loads = lightest * p[0] / p
                first, *later = (
                    friction(solve(Scene(SHAPE, elastomer, Slide(speed=speed, load=load), rough)))
                    for speed, load in zip(speeds, loads, strict=True)
                )
                yield (
                    f"{beta:g}",
                    f"{eq.force_shift_exponent(beta, 2):g}",
                    f"{rough.hurst:g}",
                    f"{loads[-1]:.3g}",
                    *(deviation(mu, first) for mu in later),
                )

    return table("β|d ln p/d ln v|H|load at 30 v, N|μ there over that at v: 3 v|10 v|30 v", rows())


def full_contact() -> str:
    """Friction of a period of a rough line far from its ends, against its waves."""
    line = SelfAffine(hurst=0.4, rms_height=1e-6, longest=1e-3, shortest=1e-4, seed=1)
    speed, depth, points = 0.1, 4e-5, (32, 64, 128, 256)
    solids = {
        "Kelvin": Kelvin(G, 1e-4),
        "standard linear": StandardLinearSolid(G, 4 * G, 1e-3),
        "β = 0.3": Fractional(
            modulus=G, relaxation_time=1e-4, exponent=0.3, lowest_frequency=1e3, highest_frequency=1e6
        ),
    }

    def rows():
        for name, elastomer in solids.items():
            errors = {"waves": [], "differences": [], "all waves of the polygon": []}
            for count in points:
                surface = draw(line, count)
                force = _of_a_period(elastomer, surface, speed, depth)
                for key, (numbers, heights) in _waves(surface).items():
                    summed = eq.wave_force(
                        lambda w, e=elastomer: e.complex_modulus(w).imag, numbers, heights, speed, surface.period
                    )
                    errors[key].append(abs(summed / force - 1))
            for key, found in errors.items():
                fitted = f"{order(points, found):.1f}" if max(found) > 1e-8 else "exact"
                yield name, key, *(f"{error:.1e}" for error in found), fitted

    return table("solid|sum over|" + "|".join(f"{count} points" for count in points) + "|order", rows())


def _of_a_period(elastomer, surface, speed, depth):
    """Energy lost per length [N] of n + 1 periods less that of n: what is left is far from the ends."""
    modulus, moduli, times = elastomer.relaxation()
    periods, lost = 2 + ceil(40 * speed * max(times, default=0.0) / surface.period), []
    for count in (periods, periods + 1):
        heights = np.tile(surface.heights, count)
        if moduli.size:
            contact = sweep_modes(heights, surface.pixel, modes_of(elastomer), speed, depth)
        else:
            contact = sweep(heights, surface.pixel, speed * elastomer.viscosity / modulus, depth)
        lost.append(4 * modulus * contact.dissipation)
    return lost[1] - lost[0]


def _waves(surface):
    """Wave numbers and amplitudes: as drawn; with slopes by finite differences; of the polygon, with aliases."""
    pixel, drawn = surface.pixel, surface.amplitudes
    q = 2 * pi / surface.period * np.arange(1, drawn.size + 1)
    aliases = np.abs(q + 2 * pi / pixel * np.arange(-4000, 4001)[:, None])
    polygon = drawn * np.sinc(aliases * pixel / (2 * pi)) ** 2
    return {
        "waves": (q, drawn),
        "differences": (2 / pixel * np.sin(q * pixel / 2), drawn),
        "all waves of the polygon": (aliases.ravel(), polygon.ravel()),
    }


SECTIONS = {
    "Full contact: every wave by itself": (
        "`wave_force` over the friction of one period of a rough line in full contact, far from its ends: "
        "relative error by points a period (the shortest wave has a tenth of them). The profile is linear "
        "between its nodes, so that a drawn wave q has a smaller slope, that of finite differences, and aliases "
        "q + 2πm/Δx with sinc² of its amplitude. A Kelvin solid, whose loss goes by slopes alone, agrees with "
        "the finite differences to rounding; every other solid with the sum over the waves of the polygon, here "
        "up to 4000 aliases; with the drawn waves all of them agree to second order in the pixel.",
        full_contact,
    ),
    "Eqs. 20 and 21: one frequency for all waves": (
        "Shallow sphere (R = 1 m, 2 N, 2a = 14 mm) on solids with a loss modulus ~ ω^β, rms slope 0.1 (seven "
        "times the macroscopic one), waves from 0.5 mm to 10 µm, G''(q_max v) = 0.003 G₀: full contact. The "
        "spectral form leaves out the sphere itself; with the simulated friction of the smooth sphere it is the "
        "simulation, within 2.5 %. A macroscopic slope much smaller than that of the roughness is enough for β = "
        "1 alone: a wave counts by q^(1+β) A², and the sphere is a long and high one. Rows with * have H > "
        "(1+β)/2.",
        one_frequency,
    ),
    "The spectral form over Eq. 20": (
        "By bandwidth; no simulation. The ratio tends to (2-2H)/(1+β-2H), and where H > (1+β)/2 (*) it grows "
        "without end: long waves dominate.",
        bandwidth,
    ),
    "Eqs. 22 and 25: from full contact to the plateau": (
        "The same sphere and roughness; ξ is Eq. 21 over the plateau of Eq. 14. Good for β = 1. For β < 1 it "
        "fails twice. At ξ = 1, G''(q_max v)/G₀ is 0.94 q_max d/s for a sphere, so that the modulus at the "
        "frequency of the contact, v/a, is no longer the static one unless (q_max a)^β is still larger; and on a "
        "solid that is not viscous the plateau lies lower than √2 s: here at roughly β of it. Eq. 25 is Eq. 22 "
        "for these solids.",
        general,
    ),
    "Eq. 23: shifted loads": (
        "Friction at a speed and at the load F_N p(v₁)/p(v), over that at v₁ and 0.5 N; it should be zero. On "
        "the Kelvin solid it is, until the macroscopic slope counts. The last column is a load of 82 N for β = "
        "1.",
        shifts,
    ),
}
