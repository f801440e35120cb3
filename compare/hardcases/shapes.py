"""Needles, blunt bodies and punches."""

from functools import partial
from math import gamma, pi, radians, sqrt

import numpy as np

from bem3d import BEM
from scene import Cone, Indent, Plane, PowerLaw, Scene, Slide, SolveError, Sphere
from scene.scales import elastic_contact

from .conditions import conditions
from .hardcase import Check, Group, deviation, invalid, refusal
from .ordinary import CONE, DEPTH, ELASTIC, KELVIN, PACE, RADIUS, SOLID, SPHERE, TOLERANCE, dense, line

STIFFNESS = ELASTIC.indentation_modulus
CASES = case = Group("shapes")


def sneddon(coefficient, exponent, radius):
    """Load and depth of z = c r^n over a contact radius; Sneddon, Int. J. Eng. Sci. 3, 47 (1965)."""
    n = exponent
    depth = sqrt(pi) / 2 * n * gamma(n / 2) / gamma((n + 1) / 2) * coefficient * radius**n
    return 2 * n / (n + 1) * STIFFNESS * depth * radius, depth


def _at_rest(size, shape, radius, allowed_1d, allowed_3d):
    load, depth = sneddon(shape.coefficient, shape.exponent, radius)
    scene, name = Scene(shape, ELASTIC, Indent(depth=depth)), f"{shape}"
    answer = line(size).solve(scene)
    yield deviation(f"MDR, {name}: force", answer.normal_force, load, allowed_1d)
    answer = BEM(points=size.square, extent=3 * radius).solve(scene)
    yield deviation(f"BEM, {name}: force", answer.normal_force, load, allowed_3d)
    answer = BEM(points=size.square).solve(Scene(shape, ELASTIC, Indent(load=load)))
    yield deviation(f"BEM under load, {name}: depth", answer.depth, depth, allowed_3d)


@case(
    "Cones of 89 degrees and of a millionth and less short of a right angle.",
    "Sneddon's load and depth: to 1e-10 in 1D, where a cone is linear between nodes, and within 3/N in 3D.",
)
def needle(size):
    for angle in (radians(89), pi / 2 - 1e-6, pi / 2 - 1e-12):
        yield from _at_rest(size, Cone(angle), RADIUS, 1e-10, 3 / size.square)


@case(
    "The same sliding on a Kelvin body.",
    "Force and mu over the slope are those of a blunt cone to 1e-9: the theory is linear in heights.",
)
def needle_in_a_flow(size):
    for angle in (radians(89), pi / 2 - 1e-6):
        shape = Cone(angle)
        depth = shape.mdr_coefficient * RADIUS
        for pace in (1e-3, 1.0, 1e3):
            scene = Scene(shape, KELVIN, Slide(speed=pace * PACE, depth=depth))
            flat = Scene(CONE, KELVIN, Slide(speed=pace * PACE, depth=CONE.mdr_coefficient * RADIUS))
            steep = shape.mdr_coefficient / CONE.mdr_coefficient
            for solver in (line(size, extent=4 * RADIUS), dense(size)):
                found, known = solver.solve(scene), solver.solve(flat)
                what = f"{solver.name}, {angle:.9f} rad, v tau/a = {pace:g}"
                force = found.normal_force / steep
                yield deviation(f"{what}: force over the slope", force, known.normal_force, 1e-9)
                mu = found.friction_coefficient / steep
                yield deviation(f"{what}: mu over the slope", mu, known.friction_coefficient, 1e-9)


@case(
    "Cones of 1e-6 and 1e-150 rad, spheres of a thousand kilometres and more.",
    "Sneddon's and Hertz's load and depth: to 1e-10 or 20/N^1.5 in 1D, within 3/N in 3D.",
)
def blunt(size):
    for angle in (1e-6, 1e-150):
        yield from _at_rest(size, Cone(angle), RADIUS, 1e-10, 3 / size.square)
    for radius in (1e6, 1e12):
        yield from _at_rest(size, Sphere(radius), RADIUS, 20 / size.line**1.5, 3 / size.square)


@case(
    "Exponents 10 and 100: flat where it touches, a wall at its edge, pressure peaking there.",
    "Sneddon's load and depth: within 10 n^2/N^2 in 1D and 3/N in 3D.",
)
def nearly_a_flat_punch(size):
    for exponent in (10.0, 100.0):
        shape = PowerLaw(coefficient=DEPTH * RADIUS**-exponent, exponent=exponent)
        yield from _at_rest(size, shape, RADIUS, exponent**2 * 10 / size.line**2, 3 / size.square)


@case("A sphere and a cone stated as powers.", "Forces are the same to the last bit.")
def named_and_general(size):
    for named in (SPHERE, CONE):
        general = PowerLaw(coefficient=named.coefficient, exponent=named.exponent)
        for solver in (line(size), dense(size)):
            motion = Slide(speed=PACE, depth=DEPTH)
            one, two = (solver.solve(Scene(shape, SOLID, motion)) for shape in (named, general))
            for of in ("normal_force", "friction_force"):
                apart = abs(getattr(one, of) - getattr(two, of))
                yield Check(f"{solver.name}, {type(named).__name__}: {of}", apart, 0.0)


@case("Exponents 1e-9 below and above 2.", "Forces lie within 1e-8 and the tolerance of contact.")
def next_to_a_sphere(size):
    for solver in (line(size), dense(size)):
        forces = []
        for exponent in (2 - 1e-9, 2.0, 2 + 1e-9):
            shape = PowerLaw(coefficient=DEPTH / RADIUS**exponent, exponent=exponent)
            forces.append(solver.solve(Scene(shape, SOLID, Slide(speed=PACE, depth=DEPTH))).normal_force)
        yield Check(f"{solver.name}: spread of force", np.ptp(forces) / forces[1], 1e-8 + 3 * TOLERANCE)


@case(
    "Pressure is infinite at the tip, on a pixel or between pixels.",
    "Conditions of contact, computed anew; the peak is at most a hundred times the mean.",
)
def tip_of_a_cone(size):
    scene = Scene(CONE, KELVIN, Slide(speed=PACE, depth=CONE.mdr_coefficient * RADIUS))
    for points in (size.dense - 1, size.dense):
        answer = dense(size, points=points).solve(scene)
        yield from conditions(answer, 2 * TOLERANCE, f"{points} points")
        yield Check(
            f"{points} points: peak over mean", answer.fields["pressure"].max() * 4e-6 / answer.normal_force, 100
        )


@case(
    "r^100: heights span hundreds of decades, depths are 1e-50 and 1e-100 m, coefficients 1e-150 and 1e150.",
    "Sneddon's force within 3/N; a load of 1e-100 N is met to 1e-9.",
)
def powers_that_vanish(size):
    solvers = line(size), BEM(points=size.dense)
    for depth in (1e-50, 1e-100):
        scene = Scene(PowerLaw(coefficient=1.0, exponent=100.0), ELASTIC, Indent(depth=depth))
        for solver in solvers:
            force, known = solver.solve(scene).normal_force, elastic_contact(scene).load
            yield deviation(f"{solver.name}, {depth:g} m: force", force, known, 3 / size.dense)
    for coefficient in (1e150, 1e-150):
        shape = PowerLaw(coefficient=coefficient, exponent=100.0)
        for solver in solvers:
            answer = solver.solve(Scene(shape, ELASTIC, Indent(load=1e-100)))
            yield deviation(f"{solver.name}, c = {coefficient:g}: force", answer.normal_force, 1e-100, 1e-9)


@case(
    "At a depth of 1e-300 m squares of pressures, by which iterations go, are no numbers.",
    "Refused: the error carries the violation that was left and the one wanted.",
)
def squares_that_vanish(size):
    scene = Scene(PowerLaw(coefficient=1.0, exponent=100.0), ELASTIC, Indent(depth=1e-300))
    yield refusal("a depth of 1e-300 m", SolveError, "violation | wanted", BEM(points=size.dense).solve, scene)


@case(
    "Right angles, radii of zero, exponents out of range, planes without roughness, loads that press no plane.",
    "Refused: each error names the field, the value and what is allowed.",
)
def no_shapes(size):
    power, plane, load, pressure = (
        partial(PowerLaw, coefficient=1.0),
        Plane(),
        Indent(load=1.0),
        Indent(pressure=1.0),
    )
    yield invalid("a cone of pi/2", "angle | 1.57 | less than", Cone, angle=pi / 2)
    yield invalid("a cone of 0", "angle | greater than 0", Cone, angle=0.0)
    yield invalid("a sphere of radius 0", "radius | greater than 0", Sphere, radius=0.0)
    yield invalid("a sphere of radius -1", "radius | -1 | greater than 0", Sphere, radius=-1.0)
    yield invalid("an exponent of 1/2", "exponent | 0.5 | greater than or equal to 1", power, exponent=0.5)
    yield invalid("an exponent of 101", "exponent | 101 | less than or equal to 100", power, exponent=101.0)
    yield invalid("a plane without roughness", "Plane | give roughness", Scene, plane, ELASTIC, pressure)
    yield invalid("a plane under a load", "load | Plane | pressure", Scene, plane, ELASTIC, load)
    yield invalid("a sphere under a pressure", "pressure | Sphere | load", Scene, SPHERE, ELASTIC, pressure)
