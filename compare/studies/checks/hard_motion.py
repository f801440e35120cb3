"""Hard cases of programs, speeds, relaxation times and solids: from nothing to beyond all bounds."""

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
from .law import FORCES, GRID, alike, apart, worst
from .ordinary import (
    CONE,
    DEPTH,
    KELVIN,
    LOAD,
    MODULUS,
    PACE,
    RADIUS,
    SOLID,
    STIFFENING,
    TIME,
    deep,
    program,
    resting,
    sliding,
    stage,
)

PRESSED = stage(TIME, depth=DEPTH)
coarse_line, coarse_space = partial(line, points=400), partial(space, points=24)
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
    "Force as at rest within the tolerance of contact; friction of the limit of low speed within 1e-3 in 1D and "
    "2/N, the error of the grid, in 3D."
)
def speed_to_zero():
    """At v tau/a = 1e-9 the memory is a tiny part of a pixel and friction is nine digits below the force.

    It is fourteen digits below where the glassy modulus exceeds the rubbery one by 1e-10: six digits are left.
    """
    scenes = sliding(1e-9), sliding(1e-4, ratio(1 + 1e-10))
    yield from equal(3 * TOLERANCE, (scenes[0], resting(elastomer=SOLID)))
    for scene in scenes:
        yield Part((scene,), slow_friction(scene), by_dimension(1e-3, over_points(2)))


@hard(
    "Force of the elastic solid, of rubber or of glass, on the same grid: within the tolerance of contact, and at "
    "v tau/a = 1e9 within 1e-6, as it relaxes by some a/(v tau) in passing.",
    any_model=GRID.wider("1e-6, what relaxes in passing", more=1e-6),
)
def times_and_speeds_without_end():
    """Relaxation times of 1e-30 and 1e-300 s, of 1e30 and 1e100 s, and the speed v tau/a = 1e9."""
    for time in (1e-30, 1e-300):
        yield from equal(3 * TOLERANCE, (sliding(1.0, Kelvin(MODULUS, time)), STILL))
    for time in (1e30, 1e100):
        yield from equal(
            3 * TOLERANCE, (sliding(1.0, StandardLinearSolid(MODULUS, STIFFENING * MODULUS, time)), GLASSY)
        )
    yield from equal(1e-6, (sliding(1e9), GLASSY))


@hard("Friction times speed is that at 1e9, within 30 a/(v tau), what relaxes in passing, and ten tolerances.")
def glassy_friction():
    """At v tau/a = 1e5, 1e7 and 1e9 a standard linear solid loses hardly anything, ever less as 1/v."""
    for pace in (1e5, 1e7):
        pair = sliding(1e9), sliding(pace)
        yield Part(pair, alike(friction_force=1e9 / pace), 30 / pace + 10 * TOLERANCE)


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
    "grid; in 3D, of first order in 40 steps, within 0.1. Where stages are held, force or depth at rest within "
    "1e-4, of the sums over pixels, a depth in 3D within 0.02.",
    line,
    partial(space, steps=40),
    any_model=GRID.wider("0.02, of first order in 200 steps", more=0.02),
)
def stages_without_end():
    """A depth reached in 1e-300 s, or in a billion relaxation times; stages of 1e-15 and of 1e15 s."""
    ramps = (1e-300, GLASSY), (1e-9 * TIME, GLASSY), (1e9 * TIME, STILL)
    allowed = by_dimension(lambda answers: 1e-8 + over_points(3, 2)(answers), 0.1)
    yield from equal(allowed, *((program(stage(duration, depth=DEPTH)), known) for duration, known in ramps))
    march = program(PRESSED, stage(1e-6 * TIME), stage(50 * TIME), elastomer=KELVIN)
    yield from equal(1e-4, (program(stage(1e-15, depth=DEPTH), stage(1e15)), STILL), (march, STILL))
    creep = program(stage(1e-3 * TIME, load=LOAD), stage(1e9 * TIME))
    yield from equal(by_dimension(1e-4, 0.02), (creep, {"depth": DEPTH}))


@hard("Conditions of contact, computed anew, within twice the tolerance.", dense)
def memories_without_end():
    """A memory of 1e9 contacts, one of all but 1e-6 of the compliance, and thirty modes from 1e-12 to 1e3 s."""
    moduli = MODULUS * 10.0 ** (np.arange(30) % 5 - 2)
    thirty = Prony(MODULUS, moduli, np.geomspace(1e-12, 1e3, 30))
    asked = [*product((1e3, 1e6, 1e9), [KELVIN]), *product((1e-9, 1e-3, 1.0, 1e9), [ratio(1e6)])]
    yield touching(*(sliding(*each) for each in (*asked, (1.0 / PACE, thirty))))


@hard("Forces and friction as without them, to 1e-6: contact is solved to 1e-7.", line, dense, any_model=GRID)
def all_but_absent_modes():
    """Modes of 1e-30 and 1e-150 Pa with one of 1e7 Pa; an almost rigid element of a chain; no glassy modulus."""
    chain = KelvinChain(0.0, (1 / MODULUS, 1e-300), (TIME, TIME / 3)), KELVIN
    series = [(Prony(MODULUS, (9e6, faint, faint), (TIME, 1e-9, 1e9)), SOLID) for faint in (1e-30, 1e-150)]
    for solids, pace in product((chain, *series), (0.1, 10.0)):
        yield from equal(1e-6, [sliding(pace, solid) for solid in solids], of=FORCES)


@hard(
    "Forces of the last eighth are those before to 1e-4 in 1D, of the ripple of pixels, and 0.02 in 3D; friction "
    "agrees with steady sliding within 0.02 of 400 points and 0.05 of 24. The solver refuses what does not "
    "balance "
    "work, energy lost and stored.",
    lambda size: coarse_line(size, extent=2.4 * RADIUS, steps=size.steps),
    lambda size: coarse_space(size, steps=size.march),
)
def many_steps():
    """Up to 1e5 steps of sliding in 1D, thousands in 3D: rounding and forgotten memory would add up."""
    scene = program(PRESSED, stage(8 * RADIUS / (0.1 * PACE), speed=0.1 * PACE))

    def drift(answer):
        eighths = (np.array_split(answer.result.fields[name], 8) for name in FORCES)
        return worst(apart(late[-1].mean(), late[-4].mean()) for late in eighths)

    yield each_of(drift, by_dimension(1e-4, 0.02), scene)
    yield from equal(by_dimension(0.02, 0.05), (scene, sliding(0.1)), of=("friction_force",))
