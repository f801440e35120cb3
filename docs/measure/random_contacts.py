"""Random contacts in steady flow, of every body, solid and speed, in units of the contact.

Radius of the smooth contact at rest 0.1 m, relaxed shear modulus 0.25 Pa, longest times around 1 s.
"""

import numpy as np

from scene import (
    Cone,
    CrossedWaves,
    Cylinder,
    Fractional,
    Indent,
    Kelvin,
    KelvinChain,
    Plane,
    PowerLaw,
    Prony,
    Scene,
    SelfAffine,
    Slide,
    Sphere,
    StandardLinearSolid,
    Wave,
)
from scene.scales import elastic_contact

KINDS = "smooth", "rough", "plane", "line"
RADIUS, DEPTH, MODULUS = 0.1, 0.02, 0.25
SPOTS = 6  # spots of contact on a wave, about: whose size tells slow from fast
MEMORIES = -4.0, 2.5  # powers of ten of the memory of one mode over the length that tells slow from fast


def drawn(kind, seed):
    """Scene of a kind and a seed; the seeds of a kind are independent of one another."""
    draw = np.random.default_rng([seed, KINDS.index(kind)])
    solid = _solid(draw)
    match kind:
        case "plane":
            return _plane(draw, solid)
        case "line":
            motion = Slide(
                speed=_speed(draw, solid, RADIUS),
                line_load=np.pi * RADIUS**2 / 4 * solid.indentation_modulus,
            )
            return Scene(Cylinder(radius=1.0), solid, motion)
    body = _smooth(draw) if kind == "smooth" else _BODIES[draw.choice(len(_BODIES), p=_SHARES)]
    depth = body.mdr_coefficient * RADIUS**body.exponent
    load = elastic_contact(Scene(body, solid, Indent(depth=depth))).load
    pressed = {"load": load} if draw.random() < 0.6 else {"depth": depth}
    if kind == "smooth":
        return Scene(body, solid, Slide(speed=_speed(draw, solid, RADIUS), **pressed))
    rough = _rough(draw, depth)
    return Scene(body, solid, Slide(speed=_speed(draw, solid, rough.shortest / SPOTS), **pressed), rough)


_BODIES = (
    Sphere(radius=1.0),
    Cone(angle=0.1),
    PowerLaw(coefficient=2.0, exponent=4.0),
    PowerLaw(coefficient=DEPTH / RADIUS**12, exponent=12.0),
)
_SHARES = 0.4, 0.3, 0.2, 0.1


def _smooth(draw):
    """Sphere, cone, or a power law with any exponent from 1 to 100."""
    which = draw.random()
    if which < 0.2:
        return Sphere(radius=1.0)
    if which < 0.4:
        return Cone(angle=draw.uniform(0.02, 0.2))
    exponent = 10 ** draw.uniform(0, 2)
    return PowerLaw(coefficient=DEPTH / RADIUS**exponent, exponent=exponent)


def _rough(draw, depth):
    waves = 10 ** draw.uniform(np.log10(1.5), 1)  # the shortest, on the radius of contact
    hurst, height = draw.uniform(0, 1), depth * 10 ** draw.uniform(-2.3, 0)
    longest = RADIUS * draw.uniform(1, 4)
    return SelfAffine(
        hurst=hurst,
        rms_height=height,
        longest=longest,
        shortest=min(RADIUS / waves, longest / 2),
        seed=draw.integers(1000),
        amplitudes=("fixed", "gaussian")[draw.integers(2)],
    )


def _plane(draw, solid):
    """Rough planes, and a third with waves, from light to nearly full contact."""
    waves = draw.integers(2, 17)
    rough: SelfAffine | Wave = SelfAffine(
        hurst=draw.uniform(0, 1),
        rms_height=1e-2,
        longest=1.0,
        shortest=1 / waves,
        seed=draw.integers(1000),
    )
    slope = rough.rms_slope(rough.q_max(1.0))
    if draw.random() < 0.3:
        rough, waves, slope = (Wave, CrossedWaves)[draw.integers(2)](amplitude=1e-2, wavelength=1.0), 1, 0.03
    pressure = solid.indentation_modulus * slope * 10 ** draw.uniform(-2, 0.5) / 2
    return Scene(Plane(), solid, Slide(speed=_speed(draw, solid, 1 / waves / SPOTS), pressure=pressure), rough)


def _solid(draw):
    """One of every type; modes lie up to seven decades apart."""

    def powers(low, high, count):
        return 10 ** draw.uniform(low, high, count)

    match draw.choice(["kelvin", "standard", "prony", "chain", "fractional"]):
        case "kelvin":
            return Kelvin(MODULUS, 1.0)
        case "standard":
            (ratio,) = powers(0.2, 3, 1)
            return StandardLinearSolid(MODULUS, MODULUS * ratio, 1 / ratio)
        case "prony":
            count = draw.integers(2, 5)
            return Prony(MODULUS, MODULUS * powers(-1, 2, count), powers(-6, 1, count))
        case "chain":
            count = draw.integers(2, 4)
            compliances, at_once = powers(-1, 0.5, count), 0.0 if draw.random() < 0.3 else powers(-3, 0, 1)[0]
            unit = (at_once + sum(compliances)) * MODULUS
            return KelvinChain(at_once / unit, compliances / unit, powers(-6, 1, count))
    return Fractional(
        modulus=MODULUS,
        relaxation_time=1.0,
        exponent=draw.uniform(0.2, 0.8),
        lowest_frequency=powers(-4, -1, 1)[0],
        highest_frequency=powers(1, 4, 1)[0],
    )


def _speed(draw, solid, length):
    """Speed at which one of the modes, any, is remembered over a length [m] times a random power of ten."""
    return length * 10 ** draw.uniform(*MEMORIES) / draw.choice(solid.retardation()[2])
