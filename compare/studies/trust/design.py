"""Scenes of the campaign: each a point of a unit cube, over dimensionless groups alone.

Lengths come in units of the radius a of the smooth relaxed contact, moduli in units of the relaxed one. Nothing
else matters: in the linear theory heights may be stretched together, body and roughness, without a change of any
ratio of two answers.
"""

from functools import cache
from math import exp, log, log10

import numpy as np

from scene import (
    Cone,
    Fractional,
    Indent,
    Kelvin,
    PowerLaw,
    Prony,
    Scene,
    SelfAffine,
    Slide,
    Sphere,
    StandardLinearSolid,
)
from scene.rheology import Elastomer

RADIUS, DEPTH, MODULUS, SPEED = 1e-3, 1e-4, 1e6, 1.0
# Ranges of the groups, from least to greatest.
EXPONENTS = 1.0, 12.0
STIFFENING = 2.0, 1e4
HEIGHTS = 2e-3, 1.0
WAVES = 0.7, 16.0
PERIODS = 1.0, 10.0
SPEEDS = 1e-3, 1e3
# Points to learn from from which on the longest wave is far longer than the contact, as in the paper.
LONG, LONG_PERIODS = 4096, (8.0, 25.0)
# Points from which on bodies are blunt and slide under a load, where the depth is hardest to predict: of those to
# learn from, of those that were held out once and then learned from, and of those held out. Their exponents and
# heights, and the longest waves of all of them.
BLUNT, BLUNT_CHECKED, BLUNT_HELD_OUT = 6144, 12_000, 4000
TO_LEARN, TO_HOLD_OUT = ((2.5, 12.0), (0.05, 0.4)), ((3.0, 12.0), (0.08, 0.3))
ALL_PERIODS = PERIODS[0], LONG_PERIODS[1]
DIMENSIONS = 16
# Shares of the bodies that are cones, and cones or spheres.
CONES, ROUND = 0.3, 0.6
# Shares of the scenes that are smooth, slide, and are pressed by a load.
SMOOTH, SLIDING, UNDER_LOAD = 0.1, 0.88, 0.6
# Seeds of the points to learn from, of those that are held out, and of blunt ones: held out once, and held out.
LEARNED, HELD_OUT, CHECKED_BLUNT, HELD_OUT_BLUNT = 20, 1120, 32_006, 61_125
# Surfaces that a point may have.
SEEDS = 1000


@cache
def learned_points() -> np.ndarray:
    """Points to choose from (8192, DIMENSIONS): a Sobol sequence, which fills the cube evenly."""
    from scipy.stats import qmc  # takes half a second, which the verdict on a scene does not have

    return qmc.Sobol(DIMENSIONS, seed=LEARNED).random(8192)


@cache
def drawn_points(seed: int) -> np.ndarray:
    """Points of a seed (2000, DIMENSIONS), drawn evenly."""
    return np.random.default_rng(seed).random((2000, DIMENSIONS))


def learned(point: int) -> Scene:
    """Scene of a number of a point to learn from; each has surfaces of its own, so that none scatter together."""
    seed = SEEDS * point
    if point >= BLUNT_CHECKED:
        return scene_at(
            _blunt(drawn_points(CHECKED_BLUNT)[point - BLUNT_CHECKED], *TO_HOLD_OUT), seed, ALL_PERIODS
        )
    place = learned_points()[point]
    if point >= BLUNT:
        return scene_at(_blunt(place, *TO_LEARN), seed, ALL_PERIODS)
    return scene_at(place, seed, PERIODS if point < LONG else LONG_PERIODS)


def held_out(point: int) -> Scene:
    """Scene of a number of a point held out."""
    seed = 10_000 * SEEDS + SEEDS * point
    if point >= BLUNT_HELD_OUT:
        place = drawn_points(HELD_OUT_BLUNT)[point - BLUNT_HELD_OUT]
        return scene_at(_blunt(place, *TO_HOLD_OUT), seed, ALL_PERIODS)
    return scene_at(drawn_points(HELD_OUT)[point], seed)


def _blunt(point, exponents, heights):
    """Point of the cube (DIMENSIONS,) moved to bodies of some exponents, which slide rough under a load."""
    shape, exponent, *middle, pressed, smooth, height = point[:10]
    return np.array(
        [
            ROUND + (1 - ROUND) * shape,
            _within(exponent, EXPONENTS, exponents),
            *middle,
            UNDER_LOAD * pressed,
            SMOOTH + (1 - SMOOTH) * smooth,
            _within(height, HEIGHTS, heights),
            *point[10:-1],
            SLIDING * point[-1],
        ]
    )


def _within(place, ends, part):
    """Place between the ends of a range of what is there between those of a part of it, in logarithms."""
    low, high = (log(end / ends[0]) / log(ends[1] / ends[0]) for end in part)
    return low + place * (high - low)


def scene_at(point: np.ndarray, seed: int = 0, periods: tuple[float, float] = PERIODS) -> Scene:
    """Scene of a point of the cube (DIMENSIONS,).

    seed : of its first surface; periods : range of the longest wave over the radius
    """
    (shape, exponent, kind, loss, spread, tilt, branches, pressed, smooth, height, waves, hurst, period, rolled,
     rolloff, speed) = (float(each) for each in point)  # fmt: skip
    indenter = _indenter(shape, exponent)
    rough = None if smooth < SMOOTH else _rough(height, waves, hurst, periods, period, rolled, rolloff, seed)
    wave = RADIUS / between(WAVES, waves)
    solid = solid_at(kind, loss, spread, tilt, branches, speed, wave)
    rests = speed >= SLIDING
    stiffness = 2 * indenter.exponent / (indenter.exponent + 1) * solid.indentation_modulus * DEPTH * RADIUS
    load, depth = (stiffness, None) if pressed < UNDER_LOAD else (None, DEPTH)
    motion = Indent(load=load, depth=depth) if rests else Slide(speed=SPEED, load=load, depth=depth)
    return Scene(indenter, solid, motion, rough)


def between(ends: tuple[float, float], place: float) -> float:
    """Number at a place, 0 to 1, between two ends, in equal ratios."""
    low, high = ends
    return exp(log(low) + place * log(high / low))


def _indenter(shape, exponent) -> Sphere | Cone | PowerLaw:
    if shape < CONES:
        return Cone(np.arctan(DEPTH / RADIUS / Cone(angle=np.pi / 4).mdr_coefficient))
    if shape < ROUND:
        return Sphere(RADIUS**2 / DEPTH)
    n = between(EXPONENTS, exponent)
    return PowerLaw(DEPTH / PowerLaw(RADIUS**-n, n).mdr_coefficient * RADIUS**-n * RADIUS**-n, n)


def _rough(height, waves, hurst, periods, period, rolled, rolloff, seed) -> SelfAffine:
    shortest = RADIUS / between(WAVES, waves)
    longest = between((max(periods[0] * RADIUS, 2 * shortest), periods[1] * RADIUS), period)
    return SelfAffine(
        hurst=hurst,
        rms_height=DEPTH * between(HEIGHTS, height),
        longest=longest,
        rolloff=between((shortest, longest), max(rolloff, 1e-3)) if rolled < 0.5 else None,
        shortest=shortest,
        seed=seed,
    )


def solid_at(kind, loss, spread, tilt, branches, speed, wave) -> Elastomer:
    """Solid whose times lie so that the speed runs from where friction grows with it to beyond its peak."""
    place = min(speed / SLIDING, 1.0)
    stiffening = between(STIFFENING, loss)
    if kind < 0.25:
        return Kelvin(MODULUS, wave / SPEED * between(SPEEDS, place))
    if kind < 0.6:
        # From slow on the scale of retardation to fast on that of relaxation.
        time = wave / SPEED * between((SPEEDS[0] / stiffening**0.5, SPEEDS[1]), place)
        return StandardLinearSolid(MODULUS, MODULUS * stiffening, time)
    if kind < 0.8:
        exponent = 0.1 + 0.8 * loss
        decades = 2.5 * max(exponent, 0.4) / exponent * (2 * place - 1)
        slow, fast = SPEED / RADIUS, SPEED / wave
        return Fractional(
            modulus=MODULUS,
            relaxation_time=wave / SPEED * 10**decades,
            exponent=exponent,
            lowest_frequency=1e-3 * slow,
            highest_frequency=1e3 * fast,
        )
    width = 0.5 + 5.5 * spread
    count = 2 + int(5 * branches)
    steps = np.linspace(-0.5, 0.5, count)
    moduli = 10 ** ((2 * tilt - 1) * width / 2 * steps)
    middle = log10(wave / SPEED * between((SPEEDS[0] / stiffening**0.5, SPEEDS[1]), place))
    return Prony(
        MODULUS,
        tuple((MODULUS * (stiffening - 1) * moduli / moduli.sum()).tolist()),
        tuple((10 ** (middle + width * steps)).tolist()),
    )
