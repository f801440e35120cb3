"""Hard cases of shapes, roughness, waves, grids and units."""

from dataclasses import replace
from functools import partial
from math import pi, radians
from typing import Any

import numpy as np

from scene import Cone, CrossedWaves, Cylinder, Elastic, Indent, PowerLaw, Scene, SelfAffine, Sphere, Wave
from scene.scales import elastic_contact

from ...models.exact import waves
from .closed_forms import AMPLITUDE, CROSSED_CLOSURE, LINE_LOAD, WAVE_CLOSURE, WAVES, away, wavy
from .hardcase import (
    TOLERANCE,
    Part,
    by_dimension,
    dense,
    each_of,
    equal,
    hard,
    line,
    over_points,
    space,
    square,
    touching,
)
from .invariances import falls
from .law import FORCES, alike
from .ordinary import (
    CONE,
    DEPTH,
    ELASTIC,
    KELVIN,
    LOAD,
    PACE,
    RADIUS,
    ROUGH,
    SOLID,
    SPHERE,
    deep,
    family,
    resting,
    sliding,
)

OCTAVE = replace(ROUGH, shortest=ROUGH.longest / 2, rolloff=ROUGH.longest)
PERIOD = SelfAffine(hurst=0.8, rms_height=1e-6, longest=1e-3, shortest=1.25e-4, seed=2)
CLOSURE: dict[Any, float] = {Wave(**WAVES): WAVE_CLOSURE, CrossedWaves(**WAVES): CROSSED_CLOSURE}
TOUCHING = "Conditions of contact, computed anew, within twice the tolerance."
SMALL_AND_LARGE = (2.0**-30, 2.0**60, 2.0**-50), (2.0**40, 2.0**-60, 2.0**50)


# Shapes


@hard(
    "Load and depth of Sneddon: in 1D to 1e-10 of cones, 20/N^1.5 of spheres and 10 n^2/N^2 of r^n, in 3D 2/N.",
    line,
    square,
)
def shapes_beyond_sense():
    """Needles, plains and punches: cones of 1e-150 rad, planets of jelly, nanometres of glass, r^100."""
    angles = radians(89), pi / 2 - 1e-6, pi / 2 - 1e-12, 1e-6, 1e-150
    mixed = (1e3, 1e12, 1e-12), (1e-9, 1.0, 1e-15), (1e6, 1e-6, 1e6), (1e-9, 1e12, 1e-6)
    scenes = [deep(shape) for shape in map(Cone, angles)]
    scenes += [deep(PowerLaw(DEPTH * RADIUS**-n, n)) for n in (10.0, 100.0)]
    scenes += [Scene(Sphere(radius), Elastic(modulus), Indent(load=load)) for radius, modulus, load in mixed]
    scenes += [Scene(PowerLaw(1.0, 100.0), ELASTIC, Indent(depth=depth)) for depth in (1e-50, 1e-100)]
    for scene in scenes:
        form, n = elastic_contact(scene), scene.indenter.exponent
        in_1d = {1.0: 1e-10, 2.0: over_points(20, 1.5)}.get(n, over_points(10 * n**2, 2))
        for motion in (Indent(depth=form.depth), Indent(load=form.load)):
            asked = replace(scene, motion=motion), {"normal_force": form.load, "depth": form.depth}
            yield from equal(by_dimension(in_1d, over_points(2)), asked)


@hard("Forces to the last bit; next to a sphere within 1e-8 and the tolerance of contact.", line, dense)
def named_and_general():
    """A cone and a sphere stated as powers, and exponents 1e-9 below and above 2."""
    for shape, more in ((CONE, 0.0), (SPHERE, 0.0), (SPHERE, -1e-9), (SPHERE, 1e-9)):
        general = PowerLaw(shape.coefficient / RADIUS**more, shape.exponent + more)
        pair = sliding(1.0, indenter=general), sliding(1.0, indenter=shape)
        yield from equal(1e-8 + 3 * TOLERANCE if more else 0.0, pair, of=FORCES)


@hard(TOUCHING, partial(dense, points=23), dense)
def tip_of_a_cone():
    """Pressure is infinite at the tip, on a pixel or between pixels."""
    yield touching(deep(CONE, KELVIN, 1.0))


# Roughness


@hard(
    "Force of the smooth body: to the last bit at 0 and 1e-300 m, to 1e-12 at 1e-20 m.",
    partial(line, extent=4 * RADIUS),
    space,
)
def height_zero():
    """Roughness of height zero, of 1e-300 m and of 1e-20 m, a part in 1e16 of the depth."""
    for height, allowed in ((0.0, 0.0), (1e-300, 0.0), (5e-324, 0.0), (1e-20, 1e-12)):
        faint = sliding(1.0, roughness=replace(ROUGH, rms_height=height))
        yield from equal(allowed, (faint, sliding(1.0)))


@hard(TOUCHING, dense)
def ends_of_the_spectrum():
    """H = 0 and 1, where moments of the spectrum are logarithms; one octave, all of it in the roll-off."""
    every = replace(ROUGH, hurst=0.0), replace(ROUGH, hurst=1.0), OCTAVE
    yield touching(*(sliding(1.0, roughness=rough) for rough in every))


@hard(TOUCHING, partial(square, points=96))
def rougher_than_deep():
    """A load that one asperity carries: the depth is less than h0."""
    rough = replace(ROUGH, rms_height=DEPTH)
    yield touching(resting(motion=Indent(load=1e-3 * LOAD), roughness=rough))


# Waves and grids


@hard(f"Just closed the mean gap is zero to 1e-3 h0, that of the last pixels. {TOUCHING}", square)
def whole_domain():
    """Pressed to closure and beyond it a wavy plane touches everywhere: there is no free point."""
    for rough, closure in CLOSURE.items():
        yield Part((wavy(closure, rough),), away("mean_gap", 0.0, AMPLITUDE), 1e-3)
        yield touching(*(wavy(fraction * closure, rough) for fraction in (1.0, 1.001, 2.0, 1e3)))


@hard(
    "Westergaard's contact fraction to two pixels, of the two edges, and mean gap to 2/N^2, the order of the "
    "discretisation.",
    *(partial(square, tolerance=1e-9, points=points) for points in (61, 63, 128)),
)
def nearly_full_contact():
    """At 0.99 and 0.9999 of closure a wave leaves gaps of a few pixels, with hardly any height."""
    for fraction in (0.99, 0.9999):
        scenes = (wavy(fraction * WAVE_CLOSURE, Wave(**WAVES)),)
        touched, gap = waves.wave_contact_fraction(fraction), waves.wave_mean_gap(fraction)
        yield Part(scenes, away("contact_fraction", touched), over_points(2))
        yield Part(scenes, away("mean_gap", AMPLITUDE * gap, AMPLITUDE), over_points(2, 2))


@hard(
    "Force never falls, without any allowance: contact grows with the depth.", line, partial(dense, tolerance=1e-9)
)
def force_rises_with_depth():
    """Depths a thousandth apart: on a grid, contact grows by whole pixels."""
    motions = [Indent(depth=depth) for depth in DEPTH * (1 + 1e-3 * np.arange(12))]
    for rough in (None, ROUGH):
        scenes = tuple(resting(motion=motion, roughness=rough) for motion in motions)
        yield Part(scenes, falls("normal_force"), 0.0)


@hard(
    "Conditions of contact, computed anew, within twice the tolerance. Hertz's force within 8/N^1.5: the edge of "
    "contact moves by parts of a pixel.",
    partial(space, points=16, extent=2.4 * RADIUS),
    *(partial(space, points=points) for points in (17, 31, 47, 48, 49)),
)
def prime_squares():
    """Squares of 16 points, the least, of primes, which no transform divides, and of one point more or less."""
    yield from equal(over_points(8, 1.5), (resting(), {"normal_force": LOAD}))
    yield touching(resting(), sliding(1.0), sliding(1.0, KELVIN, roughness=ROUGH))


@hard(TOUCHING, *(partial(square, points=points) for points in (16, 17, 18, 31, 47)))
def prime_periods():
    """A surface that repeats on primes of points, or on 16, of which its shortest wave is the Nyquist wave."""
    scenes = (wavy(part * SOLID.indentation_modulus, PERIOD, SOLID, PACE) for part in (1e-3, 1.0))
    yield touching(*scenes, wavy(1e5, PERIOD))


@hard(
    "Hertz's half-width to a pixel, depth to 4/N^1.5 of itself.",
    *(partial(square, points=points) for points in (17, 31, 127, 128)),
)
def prime_rows():
    """A line contact on single rows of 17 and 31 points; squares are the only other shape of a grid."""
    scene = Scene(Cylinder(SPHERE.radius), ELASTIC, Indent(line_load=LINE_LOAD))
    form = elastic_contact(scene)
    yield each_of(lambda answer: abs(answer["contact_area"] / 2 - form.radius) / answer["pixel"], 1.0, scene)
    yield from equal(over_points(4, 1.5), (scene, {"depth": form.depth}))


@hard("The contact lies inside of it.", *(partial(square, points=points) for points in (47, 65, 130)))
def windows_of_odd_grids():
    """A window sought on grids that halve to odd ones."""

    def at_the_rim(answer):
        touched = answer.result.fields["pressure"] > 0
        return touched.sum() - touched[1:-1, 1:-1].sum()

    yield each_of(at_the_rim, 0.0, sliding(3.0, roughness=ROUGH))


# Units


@hard(
    "Depth, force and friction scale by powers of two to the last bit; of a load to 1e-12, as powers other than "
    "squares round; by other factors and in steps of a program to 1e-9, as rounding is carried through. Stretched "
    "by 2^40 force and depth grow by as much, friction by its square, to 1e-12.",
    partial(line, steps=20),
    partial(dense, extent=None, steps=20),
)
def other_units():
    """Picometres and kilometres, 1 Pa and 1 TPa, 1e-15 and 1e9 s; inches and psi; slopes of 1e11, beyond sense."""
    for kind, allowed, every in (
        ("rough-sliding", 0.0, SMALL_AND_LARGE),
        ("rough-load", 1e-12, SMALL_AND_LARGE),
        ("rough-program", 1e-9, SMALL_AND_LARGE),
        ("rough-sliding", 1e-9, ((1e-9, 1.0, 1e-6), (1e3, 1e6, 1e3), (25.4e-3, 6894.757, 3600.0))),
    ):
        for length, modulus, time in every:
            force = length**2 * modulus
            form = alike(depth=length, normal_force=force, friction_force=force)
            yield Part((family(kind), family(kind, length, modulus, time)), form, allowed)
    form = alike(depth=2.0**40, normal_force=2.0**40, friction_force=2.0**80)
    yield Part((family("rough-sliding"), family("rough-sliding", steep=2.0**40)), form, 1e-12)
