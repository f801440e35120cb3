"""Speeds and relaxation times from nothing to beyond all bounds."""

import numpy as np

from bem3d import BEM
from compare.exact import foundation, line_contact, mean_lag, slow_friction_1d, slow_friction_by_curvature
from scene import Cylinder, Elastic, Kelvin, Program, Scene, Slide, SolveError, Stage, StandardLinearSolid
from scene.scales import elastic_contact

from .conditions import conditions
from .hardcase import Check, Group, deviation, refusal
from .ordinary import (
    CONE,
    DEPTH,
    ELASTIC,
    KELVIN,
    LOAD,
    MODULUS,
    PACE,
    RADIUS,
    SOLID,
    SPHERE,
    STIFFENING,
    TIME,
    TOLERANCE,
    dense,
    line,
    moved,
    resting,
    sliding,
    space,
)

GLASS = Elastic(STIFFENING * MODULUS)
LINE_LOAD = LOAD / RADIUS
CASES = case = Group("motion")


def _as_another(size, elastomer, motion, other, allowed, solvers=(line, space)):
    """A scene whose force is that of another solid at rest, on the same grid."""
    for solver in (build(size) for build in solvers):
        force = solver.solve(resting(elastomer=elastomer, motion=motion)).normal_force
        known = solver.solve(resting(elastomer=other)).normal_force
        yield deviation(f"{solver.name}: force", force, known, allowed)


def _marching(size):
    return space(size, steps=40)


@case(
    "Sliding at speed 0 has no flow, and is asked of the code of sliding.",
    "Force as at rest to the last bit, friction zero.",
)
def speed_zero(size):
    for solver in (line(size), space(size)):
        moving, still = solver.solve(sliding(0.0)), solver.solve(resting(elastomer=SOLID))
        yield Check(f"{solver.name}: force", abs(moving.normal_force - still.normal_force), 0.0)
        yield Check(f"{solver.name}: friction", abs(moving.friction_force), 0.0)


@case(
    "At v tau/a = 1e-9 the memory is a tiny part of a pixel and friction is nine digits below the force.",
    "Force as at rest within the tolerance of contact; friction as in the limit of low speed (docs/theory.md) "
    "within the error of the grid, 10/N in 1D and 2/N in 3D.",
)
def speed_to_zero(size):
    speed = 1e-9
    still = {solver: solver.solve(resting(elastomer=SOLID)) for solver in (line(size), space(size))}
    one, three = (solver.solve(sliding(speed)) for solver in still)
    for moving, at_rest in zip((one, three), still.values(), strict=True):
        what = f"{moving.solver}: force against rest"
        yield deviation(what, moving.normal_force, at_rest.normal_force, 3 * TOLERANCE)
    static = elastic_contact(resting(elastomer=SOLID))
    lag, modulus = mean_lag(SOLID), SOLID.indentation_modulus
    in_1d = slow_friction_1d(speed * PACE, static.radius, lag, modulus, SPHERE.mdr_coefficient, 2.0)
    yield deviation("MDR: friction", one.friction_force, in_1d, 10 / size.line)
    curved = three.measures["curvature_by_pressure"]
    in_3d = slow_friction_by_curvature(speed * PACE, lag, three.normal_force, curved)
    yield deviation("BEM: friction", three.friction_force, in_3d, 2 / size.square)


@case(
    "At v tau/a = 1e9 a standard linear solid is glassy all along the contact.",
    "Force of the glassy elastic solid on the same grid within 1e-6: it relaxes by some a/(v tau) in passing, "
    "and contacts are solved to 1e-7.",
)
def speed_to_infinity(size):
    return _as_another(size, SOLID, Slide(speed=1e9 * PACE, depth=DEPTH), GLASS, 1e-6)


@case(
    "At v tau/a = 1e5, 1e7 and 1e9 a standard linear solid loses hardly anything, ever less as 1/v.",
    "Friction times speed is that at 1e9, within 30 a/(v tau), what relaxes in passing, and ten tolerances of "
    "contact; in 3D friction is the energy lost, to 1e-6.",
)
def glassy_friction(size):
    paces = 1e5, 1e7, 1e9
    for solver in (line(size), space(size)):
        answers = [solver.solve(sliding(pace)) for pace in paces]
        *lost, last = (pace * answer.friction_force for pace, answer in zip(paces, answers, strict=True))
        for pace, found in zip(paces, lost, strict=False):
            what = f"{solver.name}: friction times speed at v tau/a = {pace:g}"
            yield deviation(what, found, last, 30 / pace + 10 * TOLERANCE)
        for pace, answer in zip(paces, answers, strict=True):
            by_loss = answer.measures.get("friction_by_loss")
            if by_loss is not None:
                what = f"{solver.name}: friction at v tau/a = {pace:g}, against the loss"
                yield deviation(what, answer.friction_force, by_loss, 1e-6)


@case(
    "A Kelvin body has no glass: force and friction grow with the speed for ever, and the contact shrinks.",
    "Closed forms of the foundation for sphere and cone up to v tau/a = 1e9, within 20/N of the grid.",
)
def kelvin_to_speed_1e9_1d(size):
    for shape in (SPHERE, CONE):
        depth = shape.mdr_coefficient * RADIUS**shape.exponent
        for pace in (1e3, 1e6, 1e9):
            scene = Scene(shape, KELVIN, Slide(speed=pace * PACE, depth=depth))
            found = line(size).solve(scene)
            force, friction = foundation.sliding_forces(shape, KELVIN, pace * PACE, depth)
            what = f"{type(shape).__name__} at {pace:g}"
            yield deviation(f"{what}, force", found.normal_force, force, 20 / size.line)
            yield deviation(f"{what}, friction", found.friction_force, friction, 20 / size.line)


@case(
    "The memory of a Kelvin body is a billion times the contact: every pixel is felt equally downstream.",
    "Conditions of contact, computed anew point by point, within twice the tolerance.",
)
def kelvin_to_speed_1e9_3d(size):
    for pace in (1e3, 1e6, 1e9):
        answer = dense(size).solve(sliding(pace, KELVIN))
        yield from conditions(answer, 2 * TOLERANCE, f"v tau/a = {pace:g}")


@case(
    "From v tau = a on the contact of a cone in 1D ends at its tip, a kink of the profile.",
    "mu = (pi/2) tan(theta) to 1e-9, rounding: the profile is linear between nodes.",
)
def kelvin_cone_saturates(size):
    slope = CONE.mdr_coefficient
    for pace in (1.5, 1e3, 1e6):
        depth = slope * RADIUS
        answer = line(size).solve(Scene(CONE, KELVIN, Slide(speed=pace * PACE, depth=depth)))
        yield deviation(f"mu at v tau/a = {pace:g}", answer.friction_coefficient, slope, 1e-9)


@case(
    "Kelvin bodies with relaxation times of 1e-30 and 1e-300 s are elastic.",
    "Force of the elastic solid on the same grid within the tolerance of contact.",
)
def relaxation_time_to_zero(size):
    for brief in (1e-30, 1e-300):
        yield from _as_another(
            size, Kelvin(MODULUS, brief), Slide(speed=PACE, depth=DEPTH), ELASTIC, 3 * TOLERANCE
        )


@case(
    "Standard linear solids with relaxation times of 1e30 and 1e100 s are glassy.",
    "Force of the glassy elastic solid on the same grid within the tolerance of contact.",
)
def relaxation_time_to_infinity(size):
    for long in (1e30, 1e100):
        solid = StandardLinearSolid(MODULUS, STIFFENING * MODULUS, long)
        yield from _as_another(size, solid, Slide(speed=PACE, depth=DEPTH), GLASS, 3 * TOLERANCE)


@case(
    "At 1e308 m/s viscous forces leave the range of numbers.",
    "Refused: the error asks for the units of the scene.",
)
def speed_beyond_numbers(size):
    scene = moved(sliding(1.0, KELVIN), speed=1e308)
    for solver in (line(size), space(size)):
        what, words = f"{solver.name} at 1e308 m/s", "numbers of the scene | units"
        yield refusal(what, SolveError, words, solver.solve, scene)


@case("The smallest number that there is, as a speed.", "Force at rest within the tolerance of contact.")
def speed_denormal(size):
    return _as_another(size, SOLID, Slide(speed=5e-324, depth=DEPTH), ELASTIC, 3 * TOLERANCE)


@case(
    "At a given depth over twelve decades of speed the contact shrinks and the solid stiffens.",
    "Force of 49 speeds never falls, and lies between those of the rubbery and the glassy solid, within "
    "rounding in 1D and ten tolerances of contact in 3D.",
)
def force_rises_with_speed(size):
    speeds = np.geomspace(1e-6, 1e6, 49)
    for solver, allowed in ((line(size), 1e-10), (space(size, points=32), 10 * TOLERANCE)):
        forces = np.array([solver.solve(sliding(pace)).normal_force for pace in speeds])
        loss = max(-np.diff(forces).min() / forces.min(), 0.0)
        yield Check(f"{solver.name}: greatest loss of force as speed rises", loss, allowed)
        soft, hard = (solver.solve(resting(elastomer=solid)).normal_force for solid in (ELASTIC, GLASS))
        outside = max(soft / forces.min(), forces.max() / hard) - 1
        yield Check(f"{solver.name}: beyond rubbery and glassy", outside, allowed)


@case(
    "Over eighteen decades of speed at a given load friction is nearly nothing at both ends.",
    "Friction is not negative, without any allowance.",
)
def friction_never_drives(size):
    for pace in np.geomspace(1e-9, 1e9, 10):
        for solver in (line(size), space(size, points=32)):
            answer = solver.solve(moved(sliding(pace), depth=None, load=LOAD))
            drives = -answer.friction_force / answer.normal_force
            yield Check(f"{solver.name}: -mu at v tau/a = {pace:g}", drives, 0.0)


@case(
    "Below a sliding line contact kernels are logarithms that all but cancel.",
    "mu as of Hunter's closed form from v tau/a = 1e-6 to 1e3, within 3/N of the grid.",
)
def line_at_all_speeds(size):
    modulus = SOLID.indentation_modulus
    for pace in (1e-6, 1.0, 1e3):
        scene = Scene(Cylinder(SPHERE.radius), SOLID, Slide(speed=pace * PACE, line_load=LINE_LOAD))
        known = line_contact.sliding(
            SPHERE.radius, modulus, STIFFENING * modulus, STIFFENING * TIME, pace * PACE, LINE_LOAD
        )
        answer = BEM(points=size.row).solve(scene)
        what = f"mu at v tau/a = {pace:g}"
        yield deviation(what, answer.friction_coefficient, known.friction_coefficient, 3 / size.row)


@case(
    "At v tau/a = 1e9 the pressure under a line is a difference of kernel values that have no digits left.",
    "Refused: the error says what to take instead.",
)
def line_beyond_digits(size):
    scene = Scene(Cylinder(SPHERE.radius), KELVIN, Slide(speed=1e9 * PACE, line_load=LINE_LOAD))
    yield refusal("v tau/a = 1e9", SolveError, "take", BEM(points=size.row).solve, scene)


@case(
    "A depth is reached in a billionth of the relaxation time, and in a billion of them.",
    "Forces of the glassy and the rubbery solid: in 1D within 1e-8, what relaxes in the ramp, and 3/N^2 of "
    "the grid; in 3D, of first order in 40 steps, within 0.1.",
)
def depth_at_once_and_in_an_age(size):
    for duration, solid, allowed in ((1e-9 * TIME, GLASS, 1e-8), (1e9 * TIME, ELASTIC, 1e-8)):
        motion = Program(stages=(Stage(duration=duration, depth=DEPTH),))
        yield from _as_another(size, SOLID, motion, solid, allowed + 3 / size.line**2, (line,))
        yield from _as_another(size, SOLID, motion, solid, 0.1, (_marching,))
