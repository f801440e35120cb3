"""Hard cases of speeds, relaxation times and solids: from nothing to beyond all bounds."""

from dataclasses import replace
from functools import partial
from itertools import product

import numpy as np

from scene import Elastic, Kelvin, KelvinChain, Prony, Slide, StandardLinearSolid

from .closed_forms import ROUND, founded, slow_friction
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
    touching,
)
from .invariances import falls
from .law import FORCES, GRID, alike, apart
from .ordinary import (
    CONE,
    DEPTH,
    KELVIN,
    MODULUS,
    PACE,
    RADIUS,
    ROUGH,
    SOLID,
    STIFFENING,
    TIME,
    deep,
    program,
    resting,
    sliding,
    stage,
)

STILL, GLASSY = resting(), resting(elastomer=Elastic(STIFFENING * MODULUS))


def ratio(modulus: float) -> StandardLinearSolid:
    """Standard linear solid with a glassy modulus over the rubbery one."""
    return StandardLinearSolid(MODULUS, modulus * MODULUS, TIME)


@hard(
    "Forces as at rest: to the last bit at speed 0, within the tolerance of contact at the least.", any_model=GRID
)
def speed_zero():
    """Sliding at speed 0, and at the smallest number that there is, is asked of the code of sliding."""
    rest = resting(elastomer=SOLID)
    yield from equal(0.0, (sliding(0.0), rest), of=FORCES)
    yield from equal(3 * TOLERANCE, (resting(elastomer=SOLID, motion=Slide(speed=5e-324, depth=DEPTH)), rest))


@hard(
    "Force as at rest within the tolerance of contact; friction of the limit of low speed within the error of the "
    "grid, 10/N in 1D and 2/N in 3D."
)
def speed_to_zero():
    """At v tau/a = 1e-9 the memory is a tiny part of a pixel and friction is nine digits below the force."""
    scene = sliding(1e-9)
    yield from equal(3 * TOLERANCE, (scene, resting(elastomer=SOLID)))
    yield Part((scene,), slow_friction(scene), by_dimension(over_points(10), over_points(2)))


@hard(
    "Force of the elastic solid, of rubber or of glass, on the same grid: within the tolerance of contact, and at "
    "v tau/a = 1e9 within 1e-6, as it relaxes by some a/(v tau) in passing.",
    any_model=GRID.wider("1e-6, what relaxes in passing", more=1e-6),
)
def times_and_speeds_without_end():
    """Relaxation times of 1e-30 and 1e-300 s, of 1e30 and 1e100 s, and the speed v tau/a = 1e9."""
    rows = [(sliding(1.0, Kelvin(MODULUS, time)), STILL) for time in (1e-30, 1e-300)]
    for time in (1e30, 1e100):
        rows.append((sliding(1.0, StandardLinearSolid(MODULUS, STIFFENING * MODULUS, time)), GLASSY))
    yield from equal(3 * TOLERANCE, *rows)
    yield from equal(1e-6, (sliding(1e9), GLASSY))


@hard(
    "Friction times speed is that at 1e9, within 30 a/(v tau), what relaxes in passing, and ten tolerances; in 3D "
    "friction is the energy lost, to 1e-6."
)
def glassy_friction():
    """At v tau/a = 1e5, 1e7 and 1e9 a standard linear solid loses hardly anything, ever less as 1/v."""
    by = "friction_by_loss"
    for pace in (1e5, 1e7):
        pair = sliding(1e9), sliding(pace)
        yield Part(pair, alike(friction_force=1e9 / pace), 30 / pace + 10 * TOLERANCE)
        yield each_of(lambda answer: apart(answer[by], answer["friction_force"]), 1e-6, *pair, only="3D")


@hard("Friction by the traction on the slopes is the energy lost, to 1e-9.", partial(line, extent=4.5 * RADIUS))
def lifted_off_in_a_flow():
    """Roughness as high as the depth: most of the line is lifted off and lands again."""
    rough, by = replace(ROUGH, hurst=0.0, rms_height=DEPTH), "friction_by_traction"
    every = product((1e-3, 1.0, 1e3), (KELVIN, SOLID))
    scenes = [sliding(pace, solid, roughness=rough) for pace, solid in every]
    yield each_of(lambda answer: apart(answer[by], answer["friction_force"]), 1e-9, *scenes)


@hard(
    "Closed forms of the foundation for sphere and cone, within 20/N of the grid; of a Kelvin cone from v tau = a "
    "on mu = (pi/2) tan(theta) to 1e-9, rounding, as the profile is linear between nodes.",
    line,
)
def all_but_no_glass_1d():
    """A Kelvin body at speeds to 1e9, glassy over rubbery moduli of 1e6 and 1e12: force and wake grow."""
    asked = [*product([KELVIN], (1e3, 1e6, 1e9)), *product(map(ratio, (1e6, 1e12)), (1e-6, 1e-3, 1.0, 100.0))]
    yield from equal(over_points(20), *(founded(shape, *each) for shape in ROUND.values() for each in asked))
    known = {"friction_coefficient": CONE.mdr_coefficient}
    yield from equal(1e-9, *((deep(CONE, KELVIN, pace), known) for pace in (1.5, 1e3, 1e6)))


@hard("Conditions of contact, computed anew point by point, within twice the tolerance.", dense)
def all_but_no_glass_3d():
    """The same in three dimensions: a memory of 1e9 contacts, and one of all but 1e-6 of the compliance."""
    asked = [*product((1e3, 1e6, 1e9), [KELVIN]), *product((1e-9, 1e-3, 1.0, 1e9), [ratio(1e6)])]
    yield touching(*(sliding(pace, solid) for pace, solid in asked))


@hard(
    "Force of 49 speeds never falls, and lies between those of the rubbery and the glassy solid, within rounding "
    "in 1D and ten tolerances of contact in 3D.",
    line,
    partial(space, points=32),
    any_model=GRID,
)
def force_rises_with_speed():
    """At a given depth over twelve decades of speed the contact shrinks and the solid stiffens."""
    scenes = (STILL, *map(sliding, np.geomspace(1e-6, 1e6, 49).tolist()), GLASSY)
    yield Part(scenes, falls("normal_force"), by_dimension(1e-10, 10 * TOLERANCE))


@hard(
    "Forces of the glassy and the rubbery solid: in 1D within 1e-8, what relaxes in the ramp, and 3/N^2 of the "
    "grid; in 3D, of first order in 40 steps, within 0.1.",
    line,
    partial(space, steps=40),
    any_model=GRID.wider("0.02, of first order in 200 steps", more=0.02),
)
def depth_at_once_and_in_an_age():
    """A depth is reached in 1e-300 s, in a billionth of the relaxation time, and in a billion of them."""
    ramps = (1e-300, GLASSY), (1e-9 * TIME, GLASSY), (1e9 * TIME, STILL)
    allowed = by_dimension(lambda answers: 1e-8 + over_points(3, 2)(answers), 0.1)
    yield from equal(allowed, *((program(stage(duration, depth=DEPTH)), known) for duration, known in ramps))


@hard("Friction of the limit of low speed to 1e-3: the difference of two moduli keeps six digits.", line)
def barely_relaxing():
    """The glassy modulus exceeds the rubbery one by 1e-10: friction comes from the last six digits."""
    scene = sliding(1e-4, ratio(1 + 1e-10))
    yield Part((scene,), slow_friction(scene), 1e-3)


@hard("Conditions of contact, computed anew, within twice the tolerance.", partial(dense, points=16))
def thirty_modes_over_fifteen_decades():
    """Thirty Maxwell modes from 1e-12 to 1e3 s, of moduli four decades apart."""
    moduli = MODULUS * 10.0 ** (np.arange(30) % 5 - 2)
    solid = Prony(MODULUS, moduli, np.geomspace(1e-12, 1e3, 30))
    yield touching(*(sliding(speed / PACE, solid) for speed in (1e-9, 1.0, 1e9)))


@hard("Forces and friction as without them, to 1e-6: contact is solved to 1e-7.", line, dense, any_model=GRID)
def all_but_absent_modes():
    """Modes of 1e-30 and 1e-150 Pa beside one of 1e7 Pa; an element of a chain that is all but rigid, no glass."""
    rows = [(KelvinChain(0.0, (1 / MODULUS, 1e-300), (TIME, TIME / 3)), KELVIN)]
    for faint in (1e-30, 1e-150):
        rows.append((Prony(MODULUS, (9e6, faint, faint), (TIME, 1e-9, 1e9)), SOLID))
    for solids, pace in product(rows, (0.1, 10.0)):
        yield from equal(1e-6, [sliding(pace, solid) for solid in solids], of=FORCES)
