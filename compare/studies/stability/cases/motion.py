"""Speeds and relaxation times from nothing to beyond all bounds."""

from functools import partial

import numpy as np

from scene import Cylinder, Elastic, Kelvin, Scene, Slide, StandardLinearSolid
from scene.scales import elastic_contact

from ....models.exact import line_contact, mean_lag, slow_friction_1d, slow_friction_by_curvature
from .hardcase import Check, Group, deviation
from .laws import FORCES, asked, equal, in_contact, on_a_foundation, refused
from .ordinary import (
    CONE,
    DEPTH,
    KELVIN,
    LOAD,
    MODULUS,
    PACE,
    RADIUS,
    SOLID,
    SPHERE,
    STIFFENING,
    TIME,
    at_paces,
    moved,
    program,
    resting,
    sliding,
    stage,
    to_radius,
)
from .solvers import TOLERANCE, line, row, space

STILL, GLASSY = resting(), resting(elastomer=Elastic(STIFFENING * MODULUS))
COARSE = partial(space, points=32)
CASES = case = Group("motion")


def _on_a_line(elastomer, pace):
    return Scene(Cylinder(SPHERE.radius), elastomer, Slide(speed=pace * PACE, line_load=LOAD / RADIUS))


def _hunter(pace):
    """Friction coefficient of a line contact."""
    soft, hard, time = SOLID.indentation_modulus, STIFFENING * SOLID.indentation_modulus, STIFFENING * TIME
    known = line_contact.sliding(SPHERE.radius, soft, hard, time, pace * PACE, LOAD / RADIUS)
    return {"friction_coefficient": known.friction_coefficient}


case.add(
    "speed-zero",
    "Sliding at speed 0 has no flow, and is asked of the code of sliding.",
    "Force as at rest to the last bit, friction zero.",
    equal((sliding(0.0), resting(elastomer=SOLID)), 0.0, of=FORCES),
)


@case(
    "At v tau/a = 1e-9 the memory is a tiny part of a pixel and friction is nine digits below the force.",
    "Force as at rest within the tolerance of contact; friction as in the limit of low speed (docs, theory) "
    "within the error of the grid, 10/N in 1D and 2/N in 3D.",
)
def speed_to_zero(size):
    speed, still = 1e-9, resting(elastomer=SOLID)
    yield from equal((sliding(speed), still), 3 * TOLERANCE)(size)
    one, three = (build(size).solve(sliding(speed)) for build in (line, space))
    lag, modulus, radius = mean_lag(SOLID), SOLID.indentation_modulus, elastic_contact(still).radius
    in_1d = slow_friction_1d(speed * PACE, radius, lag, modulus, SPHERE.mdr_coefficient, 2.0)
    yield deviation("MDR: friction", one.friction_force, in_1d, 10 / size.line)
    curved = three.measures["curvature_by_pressure"]
    in_3d = slow_friction_by_curvature(speed * PACE, lag, three.normal_force, curved)
    yield deviation("BEM: friction", three.friction_force, in_3d, 2 / size.square)


case.add(
    "speed-to-infinity",
    "At v tau/a = 1e9 a standard linear solid is glassy all along the contact.",
    "Force of the glassy elastic solid on the same grid within 1e-6: it relaxes by some a/(v tau) in passing, "
    "and contacts are solved to 1e-7.",
    equal((sliding(1e9), GLASSY), 1e-6),
)


@case(
    "At v tau/a = 1e5, 1e7 and 1e9 a standard linear solid loses hardly anything, ever less as 1/v.",
    "Friction times speed is that at 1e9, within 30 a/(v tau), what relaxes in passing, and ten tolerances of "
    "contact; in 3D friction is the energy lost, to 1e-6.",
)
def glassy_friction(size):
    for solver in (line(size), space(size)):
        answers = {pace: solver.solve(sliding(pace)) for pace in (1e9, 1e5, 1e7)}
        last = 1e9 * answers[1e9].friction_force
        for pace, answer in answers.items():
            what, found = f"{solver.name}, v tau/a = {pace:g}", answer.friction_force
            if pace < 1e9:
                yield deviation(f"{what}: friction times speed", pace * found, last, 30 / pace + 10 * TOLERANCE)
            if "friction_by_loss" in answer.measures:
                yield deviation(f"{what}: friction and loss", found, answer.measures["friction_by_loss"], 1e-6)


case.add(
    "kelvin-to-speed-1e9-1d",
    "A Kelvin body has no glass: force and friction grow with the speed for ever, and the contact shrinks.",
    "Closed forms of the foundation for sphere and cone up to v tau/a = 1e9, within 20/N of the grid.",
    on_a_foundation({"Kelvin": KELVIN}, (1e3, 1e6, 1e9)),
)
case.add(
    "kelvin-to-speed-1e9-3d",
    "The memory of a Kelvin body is a billion times the contact: every pixel is felt equally downstream.",
    "Conditions of contact, computed anew point by point, within twice the tolerance.",
    in_contact(at_paces(1e3, 1e6, 1e9, elastomer=KELVIN)),
)
SATURATED = {"friction_coefficient": CONE.mdr_coefficient}
case.add(
    "kelvin-cone-saturates",
    "From v tau = a on the contact of a cone in 1D ends at its tip, a kink of the profile.",
    "mu = (pi/2) tan(theta) to 1e-9, rounding: the profile is linear between nodes.",
    equal({f"{pace:g}": (to_radius(CONE, KELVIN, pace), SATURATED) for pace in (1.5, 1e3, 1e6)}, 1e-9, line),
)
BRIEF = {f"{tau:g} s": Kelvin(MODULUS, tau) for tau in (1e-30, 1e-300)}
LONG = {f"{tau:g} s": StandardLinearSolid(MODULUS, STIFFENING * MODULUS, tau) for tau in (1e30, 1e100)}
case.add(
    "relaxation-time-to-zero",
    "Kelvin bodies with relaxation times of 1e-30 and 1e-300 s are elastic.",
    "Force of the elastic solid on the same grid within the tolerance of contact.",
    equal({what: (sliding(1.0, solid), STILL) for what, solid in BRIEF.items()}, 3 * TOLERANCE),
)
case.add(
    "relaxation-time-to-infinity",
    "Standard linear solids with relaxation times of 1e30 and 1e100 s are glassy.",
    "Force of the glassy elastic solid on the same grid within the tolerance of contact.",
    equal({what: (sliding(1.0, solid), GLASSY) for what, solid in LONG.items()}, 3 * TOLERANCE),
)
case.add(
    "speed-beyond-numbers",
    "At 1e308 m/s viscous forces leave the range of numbers.",
    "Refused: the error asks for the units of the scene.",
    refused("numbers of the scene | units", moved(sliding(1.0, KELVIN), speed=1e308)),
)
case.add(
    "speed-denormal",
    "The smallest number that there is, as a speed.",
    "Force at rest within the tolerance of contact.",
    equal((moved(sliding(1.0), speed=5e-324), STILL), 3 * TOLERANCE),
)


@case(
    "At a given depth over twelve decades of speed the contact shrinks and the solid stiffens.",
    "Force of 49 speeds never falls, and lies between those of the rubbery and the glassy solid, within "
    "rounding in 1D and ten tolerances of contact in 3D.",
)
def force_rises_with_speed(size):
    for solver, allowed in ((line(size), 1e-10), (COARSE(size), 10 * TOLERANCE)):
        forces = np.array([solver.solve(sliding(pace)).normal_force for pace in np.geomspace(1e-6, 1e6, 49)])
        loss = max(-np.diff(forces).min() / forces.min(), 0.0)
        yield Check(f"{solver.name}: greatest loss of force as speed rises", loss, allowed)
        soft, hard = (solver.solve(scene).normal_force for scene in (STILL, GLASSY))
        outside = max(soft / forces.min(), forces.max() / hard) - 1
        yield Check(f"{solver.name}: beyond rubbery and glassy", outside, allowed)


@case(
    "Over eighteen decades of speed at a given load friction is nearly nothing at both ends.",
    "Friction is not negative, without any allowance.",
)
def friction_never_drives(size):
    scenes = {pace: moved(sliding(pace), depth=None, load=LOAD) for pace in np.geomspace(1e-9, 1e9, 10)}
    for what, solver, scene in asked(size, scenes, (line, COARSE)):
        answer = solver.solve(scene)
        yield Check(f"{what}: -mu", -answer.friction_force / answer.normal_force, 0.0)


case.add(
    "line-at-all-speeds",
    "Below a sliding line contact kernels are logarithms that all but cancel.",
    "mu of Hunter's closed form from v tau/a = 1e-6 to 1e3, within 3/N of the grid.",
    equal(
        {f"v tau/a = {pace:g}": (_on_a_line(SOLID, pace), _hunter(pace)) for pace in (1e-6, 1.0, 1e3)},
        lambda size: 3 / size.row,
        row,
    ),
)
case.add(
    "line-beyond-digits",
    "At v tau/a = 1e9 the pressure under a line is a difference of kernel values that have no digits left.",
    "Refused: the error says what to take instead.",
    refused("take", _on_a_line(KELVIN, 1e9), row),
)
RAMPS = {
    f"in {duration:g} s": (program(stage(duration, depth=DEPTH)), known)
    for duration, known in ((1e-9 * TIME, GLASSY), (1e9 * TIME, STILL))
}
case.add(
    "depth-at-once-and-in-an-age",
    "A depth is reached in a billionth of the relaxation time, and in a billion of them.",
    "Forces of the glassy and the rubbery solid: in 1D within 1e-8, what relaxes in the ramp, and 3/N^2 of "
    "the grid; in 3D, of first order in 40 steps, within 0.1.",
    equal(RAMPS, lambda size: 1e-8 + 3 / size.line**2, line),
    equal(RAMPS, 0.1, partial(space, steps=40)),
)
