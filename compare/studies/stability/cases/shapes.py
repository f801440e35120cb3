"""Needles, blunt bodies and punches."""

from functools import partial
from math import gamma, pi, radians, sqrt

import numpy as np

from scene import Cone, Indent, Plane, PowerLaw, Scene, Sphere
from scene.scales import elastic_contact

from .conditions import conditions
from .hardcase import Check, Group, deviation, invalid
from .laws import FORCES, asked, equal, refused
from .ordinary import CONE, DEPTH, ELASTIC, KELVIN, RADIUS, SPHERE, resting, sliding, to_radius
from .solvers import TOLERANCE, dense, line, square

FLAT = PowerLaw(coefficient=1.0, exponent=100.0)
CASES = case = Group("shapes")


def sneddon(coefficient, exponent, radius):
    """Load and depth of z = c r^n over a contact radius; Sneddon, Int. J. Eng. Sci. 3, 47 (1965)."""
    n = exponent
    depth = sqrt(pi) / 2 * n * gamma(n / 2) / gamma((n + 1) / 2) * coefficient * radius**n
    return 2 * n / (n + 1) * ELASTIC.indentation_modulus * depth * radius, depth


def as_sneddon(shapes, allowed_1d):
    """Load and depth of elastic contacts over RADIUS, in 3D within 3/N."""
    pressed, loaded = {}, {}
    for shape in shapes:
        load, depth = sneddon(shape.coefficient, shape.exponent, RADIUS)
        pressed[f"{shape}"] = resting(indenter=shape, motion=Indent(depth=depth)), {"normal_force": load}
        loaded[f"{shape}"] = resting(indenter=shape, motion=Indent(load=load)), {"depth": depth}

    def examine(size):
        yield from equal(pressed, allowed_1d, line)(size)
        yield from equal(pressed, 3 / size.square, partial(square, extent=3 * RADIUS))(size)
        yield from equal(loaded, 3 / size.square, square)(size)

    return examine


case.add(
    "needle",
    "Cones of 89 degrees and of a millionth and less short of a right angle.",
    "Sneddon's load and depth: to 1e-10 in 1D, where a cone is linear between nodes, and within 3/N in 3D.",
    as_sneddon([Cone(angle) for angle in (radians(89), pi / 2 - 1e-6, pi / 2 - 1e-12)], 1e-10),
)


@case(
    "The same sliding on a Kelvin body.",
    "Force and mu over the slope are those of a blunt cone to 1e-9: the theory is linear in heights.",
)
def needle_in_a_flow(size):
    needles = {f"{angle:.9f} rad": Cone(angle) for angle in (radians(89), pi / 2 - 1e-6)}
    for what, solver, needle in asked(size, needles, (partial(line, extent=4 * RADIUS), dense)):
        steep = needle.mdr_coefficient / CONE.mdr_coefficient
        for pace in (1e-3, 1.0, 1e3):
            found, known = (solver.solve(to_radius(cone, KELVIN, pace)) for cone in (needle, CONE))
            for of in ("normal_force", "friction_coefficient"):
                over = getattr(found, of) / steep
                yield deviation(f"{what}, v tau/a = {pace:g}: {of} over the slope", over, getattr(known, of), 1e-9)


case.add(
    "blunt",
    "Cones of 1e-6 and 1e-150 rad, spheres of a thousand kilometres and more.",
    "Sneddon's and Hertz's load and depth: to 1e-10 or 20/N^1.5 in 1D, within 3/N in 3D.",
    as_sneddon([Cone(1e-6), Cone(1e-150)], 1e-10),
    as_sneddon([Sphere(1e6), Sphere(1e12)], lambda size: 20 / size.line**1.5),
)
case.add(
    "nearly-a-flat-punch",
    "Exponents 10 and 100: flat where it touches, a wall at its edge, pressure peaking there.",
    "Sneddon's load and depth: within 10 n^2/N^2 in 1D and 3/N in 3D.",
    as_sneddon([PowerLaw(DEPTH * RADIUS**-10.0, 10.0)], lambda size: 10.0**2 * 10 / size.line**2),
    as_sneddon([PowerLaw(DEPTH * RADIUS**-100.0, 100.0)], lambda size: 100.0**2 * 10 / size.line**2),
)


@case("A sphere and a cone stated as powers.", "Forces are the same to the last bit.")
def named_and_general(size):
    for shape in (SPHERE, CONE):
        power = PowerLaw(shape.coefficient, shape.exponent)
        pair = sliding(1.0, indenter=shape), sliding(1.0, indenter=power)
        yield from equal(pair, 0.0, line, dense, of=FORCES)(size)


@case("Exponents 1e-9 below and above 2.", "Forces lie within 1e-8 and the tolerance of contact.")
def next_to_a_sphere(size):
    shapes = [PowerLaw(DEPTH / RADIUS**exponent, exponent) for exponent in (2 - 1e-9, 2.0, 2 + 1e-9)]
    for solver in (line(size), dense(size)):
        forces = [solver.solve(sliding(1.0, indenter=shape)).normal_force for shape in shapes]
        yield Check(f"{solver.name}: spread of force", np.ptp(forces) / forces[1], 1e-8 + 3 * TOLERANCE)


@case(
    "Pressure is infinite at the tip, on a pixel or between pixels.",
    "Conditions of contact, computed anew; the peak is at most a hundred times the mean.",
)
def tip_of_a_cone(size):
    for points in (size.dense - 1, size.dense):
        answer = dense(size, points=points).solve(to_radius(CONE, KELVIN, 1.0))
        yield from conditions(answer, 2 * TOLERANCE, f"{points} points")
        peak = answer.fields["pressure"].max() * 4e-6 / answer.normal_force
        yield Check(f"{points} points: peak over mean", peak, 100)


@case(
    "r^100: heights span hundreds of decades, depths are 1e-50 and 1e-100 m, coefficients 1e-150 and 1e150.",
    "Sneddon's force within 3/N; a load of 1e-100 N is met to 1e-9.",
)
def powers_that_vanish(size):
    deep, loaded = {}, {}
    for depth, coefficient in ((1e-50, 1e150), (1e-100, 1e-150)):
        scene = resting(indenter=FLAT, motion=Indent(depth=depth))
        deep[f"{depth:g} m"] = scene, {"normal_force": elastic_contact(scene).load}
        scene = resting(indenter=PowerLaw(coefficient, 100.0), motion=Indent(load=1e-100))
        loaded[f"c = {coefficient:g}"] = scene, {"normal_force": 1e-100}
    in_3d = partial(square, points=size.dense)
    yield from equal(deep, 3 / size.dense, line, in_3d)(size)
    yield from equal(loaded, 1e-9, line, in_3d)(size)


@case(
    "At a depth of 1e-300 m squares of pressures, by which iterations go, are no numbers.",
    "Refused: the error carries the violation that was left and the one wanted.",
)
def squares_that_vanish(size):
    scene = resting(indenter=FLAT, motion=Indent(depth=1e-300))
    return refused("violation | wanted", scene, partial(square, points=size.dense))(size)


@case(
    "Right angles, radii of zero, exponents out of range, planes without roughness, loads that press no plane.",
    "Refused: each error names the field, the value and what is allowed.",
)
def no_shapes(size):
    power, plane = partial(PowerLaw, coefficient=1.0), partial(Scene, Plane(), ELASTIC)
    load, pressure = Indent(load=1.0), Indent(pressure=1.0)
    yield invalid("a cone of pi/2", "angle | 1.57 | less than", Cone, angle=pi / 2)
    yield invalid("a cone of 0", "angle | greater than 0", Cone, angle=0.0)
    yield invalid("a sphere of radius 0", "radius | greater than 0", Sphere, radius=0.0)
    yield invalid("a sphere of radius -1", "radius | -1 | greater than 0", Sphere, radius=-1.0)
    yield invalid("an exponent of 1/2", "exponent | 0.5 | greater than or equal to 1", power, exponent=0.5)
    yield invalid("an exponent of 101", "exponent | 101 | less than or equal to 100", power, exponent=101.0)
    yield invalid("a plane without roughness", "Plane | give roughness", plane, pressure)
    yield invalid("a plane under a load", "load | Plane | pressure", plane, load)
    yield invalid("a sphere under a pressure", "pressure | Sphere | load", Scene, SPHERE, ELASTIC, pressure)
