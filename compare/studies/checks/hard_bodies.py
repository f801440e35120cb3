"""Hard cases of shapes, roughness, waves, grids and units."""

from dataclasses import replace
from functools import partial
from math import pi, radians

import numpy as np

from scene import Cone, Cylinder, Elastic, Indent, PowerLaw, Scene, SelfAffine, Sphere
from scene.scales import elastic_contact

from .closed_forms import LINE_LOAD, wavy
from .hardcase import (
    TOLERANCE,
    Part,
    by_dimension,
    dense,
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
TOUCHING = "Conditions of contact, computed anew, within twice the tolerance."


# Shapes


@hard(
    "Load and depth of Sneddon: in 1D to 1e-10 of cones, 20/N^1.5 of spheres and 10 n^2/N^2 of r^n, in 3D 2/N.",
    line,
    square,
)
def shapes_beyond_sense():
    """Needles, plains and punches: cones of 1e-150 rad, planets of jelly, nanometres of glass, r^100."""
    mixed = (1e3, 1e12, 1e-12), (1e6, 1e-6, 1e6), (1e-9, 1e12, 1e-6)
    scenes = [deep(Cone(angle)) for angle in (radians(89), pi / 2 - 1e-6, pi / 2 - 1e-12, 1e-6, 1e-150)]
    scenes += [deep(PowerLaw(DEPTH * RADIUS**-n, n)) for n in (10.0, 100.0)]
    scenes += [Scene(Sphere(radius), Elastic(modulus), Indent(load=load)) for radius, modulus, load in mixed]
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
def peaks():
    """The tip of a cone, on a pixel or between; roughness of H = 0 and 1, and one octave that is all roll-off."""
    every = replace(ROUGH, hurst=0.0), replace(ROUGH, hurst=1.0), OCTAVE
    yield touching(deep(CONE, KELVIN, 1.0), *(sliding(1.0, roughness=rough) for rough in every))


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


# Waves and grids


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
    "Conditions of contact, computed anew, within twice the tolerance, also on windows that are sought. Hertz's "
    "force, and on a line his depth, within 4/N^1.5: the edge moves by parts of a pixel.",
    *(partial(square, points=points) for points in (16, 17, 31, 47, 49, 65)),
)
def prime_grids():
    """Squares, periods and rows of 16 points, the least, of primes, which no transform divides, and odd ones."""
    cylinder = Scene(Cylinder(SPHERE.radius), ELASTIC, Indent(line_load=LINE_LOAD))
    depth = elastic_contact(cylinder).depth
    yield from equal(over_points(4, 1.5), (resting(), {"normal_force": LOAD}), (cylinder, {"depth": depth}))
    yield touching(resting(), sliding(1.0), sliding(3.0, KELVIN, roughness=ROUGH))
    pressures = 1e-3 * SOLID.indentation_modulus, SOLID.indentation_modulus
    yield touching(*(wavy(each, PERIOD, SOLID, PACE) for each in pressures), wavy(1e5, PERIOD))


# Units


@hard(
    "Depth, force and friction scale by powers of two to the last bit; by other factors and in steps of a program "
    "to 1e-9, as rounding is carried through.",
    partial(line, steps=20),
    partial(dense, extent=None, steps=20),
)
def other_units():
    """Picometres and kilometres, 1 Pa and 1 TPa, 1e-15 and 1e9 s; inches and psi."""
    small, large = (2.0**-30, 2.0**60, 2.0**-50), (2.0**40, 2.0**-60, 2.0**50)
    inches = 25.4e-3, 6894.757, 3600.0
    for kind, units, allowed in (
        ("sliding", small, 0.0),
        ("sliding", large, 0.0),
        ("sliding", inches, 1e-9),
        ("program", small, 1e-9),
        ("program", large, 1e-9),
    ):
        length, modulus, _ = units
        forces = dict.fromkeys(FORCES, length**2 * modulus)
        yield Part((family(kind), family(kind, *units)), alike(depth=length, **forces), allowed)
