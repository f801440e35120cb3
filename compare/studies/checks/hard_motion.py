"""Hard cases of speeds, relaxation times and solids: from nothing to beyond all bounds."""

from functools import partial
from itertools import pairwise
from typing import Any

import numpy as np

from scene import Elastic, Fractional, Kelvin, KelvinChain, Prony, Slide, StandardLinearSolid
from scene.scales import elastic_contact

from ...models.exact import mean_lag, slow_friction_1d, slow_friction_by_curvature
from .friction import founded
from .hardcase import (
    TOLERANCE,
    Part,
    by_dimension,
    dense,
    energy_is_lost,
    equal,
    hard,
    line,
    over_points,
    space,
    touching,
)
from .invariances import outside
from .law import FORCES, GRID, LINE, apart, worst
from .ordinary import (
    CONE,
    DEPTH,
    KELVIN,
    MODULUS,
    PACE,
    SOLID,
    SPHERE,
    STIFFENING,
    TIME,
    program,
    resting,
    sliding,
    stage,
    to_radius,
)

STILL, GLASSY = resting(), resting(elastomer=Elastic(STIFFENING * MODULUS))
FIVE = (1e6, 2e6, 3e6, 2e6, 1e6)  # moduli [Pa] of modes
ONE_MODE = StandardLinearSolid(MODULUS, MODULUS + sum(FIVE), TIME)
MANY = Prony(
    equilibrium_modulus=MODULUS,
    moduli=tuple(MODULUS * 10.0 ** (k % 5 - 2) for k in range(30)),
    relaxation_times=tuple(float(t) for t in np.geomspace(1e-12, 1e3, 30)),
)
TOUCHING = "Conditions of contact, computed anew point by point, within twice the tolerance."
OF_CONTACT = "Force of the elastic solid on the same grid within the tolerance of contact."


@hard("Force as at rest to the last bit, friction zero.", any_model=GRID)
def speed_zero():
    """Sliding at speed 0 has no flow, and is asked of the code of sliding."""
    yield equal(0.0, (sliding(0.0), resting(elastomer=SOLID)), of=FORCES)


@hard(
    "Force as at rest within the tolerance of contact; friction as in the limit of low speed (docs, theory) "
    "within the error of the grid, 10/N in 1D and 2/N in 3D."
)
def speed_to_zero():
    """At v tau/a = 1e-9 the memory is a tiny part of a pixel and friction is nine digits below the force."""
    speed, still, lag = 1e-9, resting(elastomer=SOLID), mean_lag(SOLID)
    yield equal(3 * TOLERANCE, (sliding(speed), still))

    def misfit(answers):
        answer, radius = answers[0], elastic_contact(still).radius
        known: Any = slow_friction_1d(
            speed * PACE, radius, lag, SOLID.indentation_modulus, SPHERE.mdr_coefficient, 2.0
        )
        if answer.dimension == "3D":
            known = slow_friction_by_curvature(
                speed * PACE, lag, answer["normal_force"], answer["curvature_by_pressure"]
            )
        return apart(answer["friction_force"], known)

    def allowed(answers):
        return by_dimension(10, 2)(answers) / answers[0].points

    yield Part((sliding(speed),), misfit, allowed)


@hard(
    "Force of the glassy elastic solid on the same grid within 1e-6: it relaxes by some a/(v tau) in passing, "
    "and contacts are solved to 1e-7.",
    any_model=GRID.and_(1e-6, "what relaxes in passing"),
)
def speed_to_infinity():
    """At v tau/a = 1e9 a standard linear solid is glassy all along the contact."""
    yield equal(1e-6, (sliding(1e9), GLASSY))


@hard(
    "Friction times speed is that at 1e9, within 30 a/(v tau), what relaxes in passing, and ten tolerances of "
    "contact; in 3D friction is the energy lost, to 1e-6."
)
def glassy_friction():
    """At v tau/a = 1e5, 1e7 and 1e9 a standard linear solid loses hardly anything, ever less as 1/v."""
    for pace in (1e5, 1e7):

        def misfit(answers, pace=pace):
            found, last = (answer["friction_force"] for answer in answers)
            return apart(pace * found, 1e9 * last)

        yield Part((sliding(pace), sliding(1e9)), misfit, 30 / pace + 10 * TOLERANCE)
    yield energy_is_lost(1e-6, *(sliding(pace) for pace in (1e9, 1e5, 1e7)), dimension="3D")


@hard("Closed forms of the foundation for sphere and cone, within 20/N of the grid.", line)
def all_but_no_glass_1d():
    """A Kelvin body at speeds to 1e9, glassy over rubbery moduli of 1e6 and 1e12: force and wake grow."""
    asked = [(KELVIN, pace) for pace in (1e3, 1e6, 1e9)]
    for ratio in (1e6, 1e12):
        asked += [(StandardLinearSolid(MODULUS, ratio * MODULUS, TIME), v) for v in (1e-6, 1e-3, 1.0, 100.0)]
    yield equal(over_points(20), *(founded(shape, solid, v) for solid, v in asked for shape in (SPHERE, CONE)))


@hard(TOUCHING, dense)
def all_but_no_glass_3d():
    """The same in three dimensions: a memory of 1e9 contacts, and one of all but 1e-6 of the compliance."""
    solid = StandardLinearSolid(MODULUS, 1e6 * MODULUS, TIME)
    asked = [(KELVIN, pace) for pace in (1e3, 1e6, 1e9)] + [(solid, pace) for pace in (1e-9, 1e-3, 1.0, 1e9)]
    yield touching(*(sliding(pace, each) for each, pace in asked))


@hard(
    "mu = (pi/2) tan(theta) to 1e-9, rounding: the profile is linear between nodes.",
    line,
    any_model=GRID,
    kinds=LINE,
)
def kelvin_cone_saturates():
    """From v tau = a on the contact of a cone in 1D ends at its tip, a kink of the profile."""
    known = {"friction_coefficient": CONE.mdr_coefficient}
    yield equal(1e-9, *((to_radius(CONE, KELVIN, pace), known) for pace in (1.5, 1e3, 1e6)))


@hard(OF_CONTACT, any_model=GRID)
def relaxation_time_to_zero():
    """Kelvin bodies with relaxation times of 1e-30 and 1e-300 s are elastic."""
    yield equal(3 * TOLERANCE, *((sliding(1.0, Kelvin(MODULUS, time)), STILL) for time in (1e-30, 1e-300)))


@hard(OF_CONTACT, any_model=GRID)
def relaxation_time_to_infinity():
    """Standard linear solids with relaxation times of 1e30 and 1e100 s are glassy."""
    solids = (StandardLinearSolid(MODULUS, STIFFENING * MODULUS, time) for time in (1e30, 1e100))
    yield equal(3 * TOLERANCE, *((sliding(1.0, solid), GLASSY) for solid in solids))


@hard("Force at rest within the tolerance of contact.", any_model=GRID)
def speed_denormal():
    """The smallest number that there is, as a speed."""
    yield equal(3 * TOLERANCE, (resting(elastomer=SOLID, motion=Slide(speed=5e-324, depth=DEPTH)), STILL))


@hard(
    "Force of 49 speeds never falls, and lies between those of the rubbery and the glassy solid, within rounding "
    "in 1D and ten tolerances of contact in 3D.",
    line,
    partial(space, points=32),
)
def force_rises_with_speed():
    """At a given depth over twelve decades of speed the contact shrinks and the solid stiffens."""
    scenes = (STILL, *map(sliding, np.geomspace(1e-6, 1e6, 49).tolist()), GLASSY)

    def falls(answers):
        forces = [answer["normal_force"] for answer in answers[1:-1]]
        return max(worst(max(one - other, 0.0) for one, other in pairwise(forces)) / min(forces), outside(answers))

    yield Part(scenes, falls, by_dimension(1e-10, 10 * TOLERANCE))


@hard(
    "Forces of the glassy and the rubbery solid: in 1D within 1e-8, what relaxes in the ramp, and 3/N^2 of the "
    "grid; in 3D, of first order in 40 steps, within 0.1.",
    line,
    partial(space, steps=40),
    any_model=GRID.and_(0.02, "of first order in 200 steps"),
)
def depth_at_once_and_in_an_age():
    """A depth is reached in a billionth of the relaxation time, and in a billion of them."""
    ramps = ((1e-9 * TIME, GLASSY), (1e9 * TIME, STILL))

    def allowed(answers):
        return 1e-8 + over_points(3, 2)(answers) if answers[0].dimension == "1D" else 0.1

    yield equal(allowed, *((program(stage(duration, depth=DEPTH)), known) for duration, known in ramps))


BARELY = StandardLinearSolid(MODULUS, MODULUS * (1 + 1e-10), TIME)


@hard("Friction of the limit of low speed to 1e-3: the difference of two moduli keeps six digits.", line)
def barely_relaxing():
    """The glassy modulus exceeds the rubbery one by 1e-10: friction comes from the last six digits."""
    static, lag = elastic_contact(resting(elastomer=BARELY)), mean_lag(BARELY)
    shape = SPHERE.mdr_coefficient, SPHERE.exponent
    known = slow_friction_1d(1e-4 * PACE, static.radius, lag, BARELY.indentation_modulus, *shape)
    yield equal(1e-3, (sliding(1e-4, BARELY), {"friction_force": known}))


@hard(
    "Friction by traction is the energy lost, to 1e-8 in 1D; conditions of contact in 3D, computed anew.",
    line,
    partial(dense, points=16),
)
def thirty_modes_over_fifteen_decades():
    """Thirty Maxwell modes from 1e-12 to 1e3 s, of moduli four decades apart."""
    scenes = [resting(elastomer=MANY, motion=Slide(speed=speed, depth=DEPTH)) for speed in (1e-9, 1.0, 1e9)]
    yield energy_is_lost(1e-8, *scenes)
    yield touching(*scenes)


def _alike(allowed: float, *solids: tuple) -> Part:
    """Pairs of solids have the same forces in a flow."""
    pairs = [(sliding(pace, one), sliding(pace, other)) for one, other in solids for pace in (0.1, 10.0)]
    return equal(allowed, *pairs, of=FORCES)


@hard("Forces and friction of the solid with their sum, to 1e-12, rounding.", line, dense, any_model=GRID)
def equal_times():
    """Five modes of one and the same relaxation time."""
    yield _alike(1e-12, (Prony(MODULUS, FIVE, (TIME,) * 5), ONE_MODE))


@hard("Forces and friction of the solid with one mode to ten times that difference and 1e-9.", line, dense)
def nearly_equal_times():
    """Modes whose times differ by 1e-15, 1e-12 and 1e-8 of themselves, in relaxation and in retardation."""
    for share in (1e-15, 1e-12, 1e-8):
        times = tuple(TIME * (1 + k * share) for k in range(5))
        merged = StandardLinearSolid(MODULUS, MODULUS + sum(FIVE), times[2])
        chains = KelvinChain(1e-7, (1e-7, 2e-7, 1e-7), times[:3]), KelvinChain(1e-7, (4e-7,), times[1:2])
        yield _alike(10 * share + 1e-9, (Prony(MODULUS, FIVE, times), merged), chains)


@hard("Forces and friction are the same to the last bit.", line, partial(dense, points=16), any_model=GRID)
def modes_in_any_order():
    """Thirty modes, shuffled."""
    modes = np.array((MANY.moduli, MANY.relaxation_times))[:, np.random.default_rng(1).permutation(30)]
    yield _alike(0.0, (MANY, Prony(MODULUS, tuple(modes[0].tolist()), tuple(modes[1].tolist()))))


@hard("Forces and friction as without them, to 1e-6: contact is solved to 1e-7.", line, dense, any_model=GRID)
def all_but_absent_modes():
    """Modes of 1e-30 and of 1e-150 Pa beside one of 1e7 Pa."""
    solids = (Prony(MODULUS, (9e6, faint, faint), (TIME, 1e-9, 1e9)) for faint in (1e-30, 1e-150))
    yield _alike(1e-6, *((solid, ONE_MODE) for solid in solids))


@hard("Forces and friction of the Kelvin body, to 1e-6: contact is solved to 1e-7.", line, dense, any_model=GRID)
def chain_without_glass():
    """A chain of Kelvin elements without instantaneous compliance, one of them all but rigid."""
    yield _alike(1e-6, (KelvinChain(0.0, (1 / MODULUS, 1e-300), (TIME, TIME / 3)), KELVIN))


@hard("Friction by traction is the energy lost, to 1e-8.", line)
def fractional_at_its_ends():
    """A power law over thirty decades, and exponents next to 0 and to 1."""
    for exponent, decades in ((0.5, 30), (1e-3, 6), (0.999, 6)):
        ends = {"lowest_frequency": 10.0 ** (-decades / 2), "highest_frequency": 10.0 ** (decades / 2)}
        solid = Fractional(modulus=MODULUS, relaxation_time=TIME, exponent=exponent, **ends)
        yield energy_is_lost(1e-8, resting(elastomer=solid, motion=Slide(speed=1.0, depth=DEPTH)))


@hard("Force in proportion to 1/(1 - nu) within the tolerance of contact.", line, dense)
def poissons_ratio_at_its_ends():
    """Poisson's ratio next to -1, and at 1/2."""
    for ratio in (-0.999999, 0.0, 0.5):

        def misfit(answers, ratio=ratio):
            found, known = (answer["normal_force"] for answer in answers)
            return apart(found, known * 0.5 / (1 - ratio))

        yield Part((resting(elastomer=Elastic(MODULUS, ratio)), resting()), misfit, 3 * TOLERANCE)
