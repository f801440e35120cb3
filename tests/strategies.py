"""Scenes to state laws about: dimensionless numbers drawn over all decades that a solver claims, then units.

A scene is drawn with a smooth relaxed contact of radius 1, a relaxed modulus of indentation E* of 1 and times
around 1, and is then taken to units drawn apart. Every number is one of a hundred steps through its range, on a
logarithmic scale where it spans decades: examples shrink towards the lower end, and are the same everywhere.

The profile "laws" repeats the same examples for ever. HYPOTHESIS_PROFILE=hunt draws new ones, forty times as many.
"""

import os
from dataclasses import fields, is_dataclass, replace
from math import atan, gamma, pi, sqrt

from hypothesis import HealthCheck, settings
from hypothesis import strategies as st

from scene import (
    Cone,
    CrossedWaves,
    Elastic,
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
)
from scene.surfaces.heightmap import HeightMap

# Three-dimensional solves make an example slow, and no example says less for it.
_SLOW = {"deadline": None, "database": None, "suppress_health_check": [HealthCheck.too_slow]}
settings.register_profile("laws", derandomize=True, **_SLOW)
settings.register_profile("hunt", print_blob=True, **_SLOW)
PROFILE = os.environ.get("HYPOTHESIS_PROFILE", "laws")
settings.load_profile(PROFILE)

STEPS = 100  # fewer than those from which literals of the source are mixed into what is drawn

# Exponents of length, modulus and time in the unit of a field; what is not here has none.
DIMENSIONS = {
    **dict.fromkeys(("radius", "depth", "gap", "rms_height", "longest", "shortest", "rolloff"), (1, 0, 0)),
    **dict.fromkeys(("amplitude", "wavelength", "thickness", "displacement", "pixel", "shortest_kept"), (1, 0, 0)),
    **dict.fromkeys(("modulus", "rubbery_modulus", "glassy_modulus", "equilibrium_modulus", "moduli"), (0, 1, 0)),
    **dict.fromkeys(("storage", "loss"), (0, 1, 0)),
    **dict.fromkeys(("instantaneous_compliance", "compliances"), (0, -1, 0)),
    **dict.fromkeys(("relaxation_time", "relaxation_times", "retardation_times", "duration"), (0, 0, 1)),
    **dict.fromkeys(("frequency", "lowest_frequency", "highest_frequency"), (0, 0, -1)),
    "speed": (1, 0, -1),
    **dict.fromkeys(("load", "force"), (2, 1, 0)),
    "line_load": (1, 1, 0),
    "conductivity": (2, 1, -1),
    "pressure": (0, 1, 0),
}


def examples(count):
    """Settings of a law: `count` examples, more on a hunt."""
    return settings(max_examples=count * (40 if PROFILE == "hunt" else 1))


def rescaled(part, length=1.0, modulus=1.0, time=1.0):
    """A scene or a part of it in other units, or the same answer asked at another size."""
    changed = {}
    for field in fields(part):
        value = getattr(part, field.name)
        if isinstance(value, HeightMap):
            changed[field.name] = HeightMap(value.heights * length)
        elif is_dataclass(value):
            changed[field.name] = rescaled(value, length, modulus, time)
        elif isinstance(value, tuple) and is_dataclass(value[0]):
            changed[field.name] = tuple(rescaled(item, length, modulus, time) for item in value)
        elif field.name in DIMENSIONS and value is not None:
            i, j, k = DIMENSIONS[field.name]
            factor = length**i * modulus**j * time**k
            changed[field.name] = tuple(x * factor for x in value) if isinstance(value, tuple) else value * factor
        elif field.name == "coefficient" and hasattr(part, "exponent"):
            changed[field.name] = value * length ** (1 - part.exponent)
    return replace(part, **changed)


def evenly(low, high):
    """Numbers from low to high."""
    return st.integers(0, STEPS).map(lambda k: low + (high - low) * k / STEPS)


def decades(low, high):
    """Powers of ten from 10^low to 10^high."""
    return evenly(low, high).map(lambda power: 10.0**power)


@st.composite
def indenters(draw):
    """Bodies of revolution with a smooth contact of radius 1, and its depth."""
    depth = draw(decades(-4, -0.5))
    kind = draw(st.sampled_from(("sphere", "cone", "power-law")))
    if kind == "sphere":
        return Sphere(radius=1 / depth), depth
    if kind == "cone":
        return Cone(angle=atan(2 / pi * depth)), depth
    n = draw(evenly(1, 6))
    stretched = sqrt(pi) / 2 * n * gamma(n / 2) / gamma((n + 1) / 2)
    return PowerLaw(coefficient=depth / stretched, exponent=n), depth


POISSON = evenly(-0.5, 0.5)


@st.composite
def viscoelastic(draw):
    """Solids with relaxed E* = 1: the relaxed modulus is (1 - nu)/2, and times are around 1."""
    nu = draw(POISSON)
    soft = (1 - nu) / 2
    kind = draw(st.sampled_from(("kelvin", "standard", "prony", "chain")))
    if kind == "kelvin":
        return Kelvin(modulus=soft, relaxation_time=1.0, poisson_ratio=nu)
    if kind == "standard":
        return StandardLinearSolid(soft, soft * (1 + draw(decades(-2, 6))), 1.0, nu)
    count = draw(st.integers(1, 4))
    times = tuple(draw(decades(-6, 6)) for _ in range(count))
    if kind == "prony":
        return Prony(soft, tuple(soft * draw(decades(-2, 6)) for _ in times), times, nu)
    shares = [draw(evenly(0.01, 1)) for _ in times]
    at_once = draw(st.sampled_from((0.0, 1e-6, 1e-2, 1.0)))
    total = (sum(shares) + at_once) * soft
    return KelvinChain(at_once / total, tuple(share / total for share in shares), times, nu)


@st.composite
def elastic(draw):
    """Elastic solids with E* = 1."""
    nu = draw(POISSON)
    return Elastic((1 - nu) / 2, nu)


solids = st.one_of(elastic(), viscoelastic())


@st.composite
def spectra(draw, depth):
    """Self-affine roughness of 0 to 3 depths on a contact of radius 1; shortest at most eight times shorter."""
    longest = draw(decades(-0.3, 1))
    shortest = longest / draw(evenly(2, 8))
    return SelfAffine(
        hurst=draw(evenly(0, 1)),
        rms_height=depth * draw(evenly(0, 3)),
        longest=longest,
        shortest=shortest,
        rolloff=draw(st.sampled_from((None, longest, (longest + shortest) / 2))),
        seed=draw(st.integers(0, STEPS)),
        amplitudes=draw(st.sampled_from(("fixed", "gaussian"))),
    )


# Memory over contact radius, v tau / a; at zero the elastomer has relaxed.
speeds = st.one_of(st.just(0.0), decades(-6, 6))


@st.composite
def motions(draw, depth, load):
    """At rest or sliding, by the depth or by the load of the smooth relaxed contact."""
    pressed = draw(st.sampled_from(({"depth": depth}, {"load": load})))
    speed = draw(st.one_of(st.none(), speeds))
    return Indent(**pressed) if speed is None else Slide(speed=speed, **pressed)


@st.composite
def bodies(draw):
    """Scenes of bodies of revolution, smooth or rough, with radius and E* of 1 for the smooth relaxed contact."""
    shape, depth = draw(indenters())
    load = 2 * shape.exponent / (shape.exponent + 1) * depth
    roughness = None if draw(st.booleans()) else draw(spectra(depth))
    return Scene(shape, draw(solids), draw(motions(depth, load)), roughness)


@st.composite
def planes(draw):
    """Planes under a pressure, rough or with crossed waves of wavelength 1, of E* = 1."""
    height = draw(decades(-4, -1))
    waves = CrossedWaves(amplitude=height, wavelength=1.0)
    rough = SelfAffine(
        hurst=draw(evenly(0, 1)), rms_height=height, longest=1.0, shortest=0.25, seed=draw(st.integers(0, STEPS))
    )
    pressure = height * draw(decades(-1, 1))
    motion = Slide(speed=draw(speeds), pressure=pressure)
    return Scene(Plane(), draw(solids), motion, draw(st.sampled_from((waves, rough))))


@st.composite
def units(draw):
    """Length [m], modulus [Pa] and time [s], each over 24 decades."""
    return {name: 10.0 ** draw(st.integers(-12, 12)) for name in ("length", "modulus", "time")}
