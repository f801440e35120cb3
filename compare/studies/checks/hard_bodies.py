"""Hard cases of shapes, roughness, waves, grids and units."""

from dataclasses import replace
from functools import partial
from math import pi, radians, sqrt
from typing import Any

import numpy as np

from scene import (
    Cone,
    CrossedWaves,
    Cylinder,
    Elastic,
    Indent,
    Plane,
    PowerLaw,
    Scene,
    SelfAffine,
    Slide,
    Sphere,
    Wave,
)
from scene.scales import elastic_contact

from ...models.exact import full_contact, line_contact, waves
from .closed_forms import AMPLITUDE, CROSSED_CLOSURE, WAVE_CLOSURE, WAVELENGTH, WAVES, deep
from .hardcase import (
    TOLERANCE,
    Part,
    by_dimension,
    dense,
    each_of,
    energy_is_lost,
    equal,
    hard,
    line,
    over_points,
    row,
    space,
    square,
    touching,
)
from .law import FORCES, alike, apart
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
    family,
    resting,
    sliding,
    to_radius,
)

WIDE_LINE = partial(line, extent=4 * RADIUS)
TIGHT = partial(square, tolerance=TOLERANCE)
PERIOD = SelfAffine(hurst=0.8, rms_height=1e-6, longest=1e-3, shortest=2.5e-4, seed=2)
WAVE, CROSSED = Wave(**WAVES), CrossedWaves(**WAVES)
CLOSURE: dict[Any, float] = {WAVE: WAVE_CLOSURE, CROSSED: CROSSED_CLOSURE}
TOUCHING = "Conditions of contact, computed anew, within twice the tolerance."


def _pressed(rough: Any, pressure: float, elastomer: Any = ELASTIC, speed: float = 0.0) -> Scene:
    return Scene(Plane(), elastomer, Slide(speed=speed, pressure=pressure), rough)


# Shapes


def _as_sneddon(in_1d, *shapes):
    """Load at a depth and depth under a load of Sneddon, Int. J. Eng. Sci. 3, 47 (1965), in 3D within 3/N."""

    def allowed(answers):
        return in_1d(answers) if answers[0].dimension == "1D" else over_points(3)(answers)

    for shape in shapes:
        scene = deep(shape)
        form = elastic_contact(scene)
        loaded = replace(scene, motion=Indent(load=form.load))
        yield equal(allowed, (scene, {"normal_force": form.load}), (loaded, {"depth": form.depth}))


@hard("Sneddon's load and depth: to 1e-10 in 1D, where a cone is linear, and within 3/N in 3D.", line, square)
def needle():
    """Cones of 89 degrees and of a millionth and less short of a right angle."""
    cones = (Cone(angle) for angle in (radians(89), pi / 2 - 1e-6, pi / 2 - 1e-12))
    yield from _as_sneddon(lambda answers: 1e-10, *cones)


@hard("Sneddon's and Hertz's load and depth: to 1e-10 or 20/N^1.5 in 1D, within 3/N in 3D.", line, square)
def blunt():
    """Cones of 1e-6 and 1e-150 rad, spheres of a thousand kilometres and more."""
    yield from _as_sneddon(lambda answers: 1e-10, Cone(1e-6), Cone(1e-150))
    yield from _as_sneddon(over_points(20, 1.5), Sphere(1e6), Sphere(1e12))


@hard("Sneddon's load and depth: within 10 n^2/N^2 in 1D and 3/N in 3D.", line, square)
def nearly_a_flat_punch():
    """Exponents 10 and 100: flat where it touches, a wall at its edge, pressure peaking there."""
    for n in (10.0, 100.0):
        yield from _as_sneddon(over_points(10 * n**2, 2), PowerLaw(DEPTH * RADIUS**-n, n))


@hard("Forces are the same to the last bit.", line, dense)
def named_and_general():
    """A sphere and a cone stated as powers."""
    powers = ((shape, PowerLaw(shape.coefficient, shape.exponent)) for shape in (SPHERE, CONE))
    yield equal(
        0.0, *((sliding(1.0, indenter=one), sliding(1.0, indenter=other)) for one, other in powers), of=FORCES
    )


@hard("Forces lie within 1e-8 and the tolerance of contact.", line, dense)
def next_to_a_sphere():
    """Exponents 1e-9 below and above 2."""
    shapes = (PowerLaw(DEPTH / RADIUS**exponent, exponent) for exponent in (2 - 1e-9, 2.0, 2 + 1e-9))
    low, middle, high = (sliding(1.0, indenter=shape) for shape in shapes)
    yield equal(1e-8 + 3 * TOLERANCE, (low, middle), (high, middle), (low, high))


@hard(f"{TOUCHING} The peak is at most a hundred times the mean.", partial(dense, points=23), dense)
def tip_of_a_cone():
    """Pressure is infinite at the tip, on a pixel or between pixels."""
    scene = to_radius(CONE, KELVIN, 1.0)
    yield touching(scene)
    yield each_of(lambda answer: answer.fields["pressure"].max() * 4e-6 / answer["normal_force"], 100.0, scene)


@hard("Sneddon's force within 3/N; a load of 1e-100 N is met to 1e-9.", line, partial(square, points=24))
def powers_that_vanish():
    """r^100: heights span hundreds of decades, depths are 1e-50 and 1e-100 m, coefficients 1e-150 and 1e150."""
    flat = PowerLaw(coefficient=1.0, exponent=100.0)
    deep = [resting(indenter=flat, motion=Indent(depth=depth)) for depth in (1e-50, 1e-100)]
    yield equal(3 / 24, *((scene, {"normal_force": elastic_contact(scene).load}) for scene in deep))
    bodies = (PowerLaw(coefficient, 100.0) for coefficient in (1e150, 1e-150))
    loaded = (resting(indenter=body, motion=Indent(load=1e-100)) for body in bodies)
    yield equal(1e-9, *((scene, {"normal_force": 1e-100}) for scene in loaded))


@hard("Hertz's depth within 1/N of the 3D grid.", line, partial(dense, extent=None))
def mixed_extremes():
    """Kilometres of glass under piconewtons, nanometres of it under micronewtons, planets of jelly."""
    for radius, modulus, load in ((1e3, 1e12, 1e-12), (1e-9, 1.0, 1e-15), (1e6, 1e-6, 1e6), (1e-9, 1e12, 1e-6)):
        scene = resting(indenter=Sphere(radius), elastomer=Elastic(modulus), motion=Indent(load=load))
        known = (9 * load**2 / (16 * radius * (4 * modulus) ** 2)) ** (1 / 3)
        yield equal(by_dimension(1 / 24, 1 / 24), (scene, {"depth": known}))


# Roughness


def _rough(**changed: Any) -> SelfAffine:
    return replace(ROUGH, **changed)


@hard("Force of the smooth body: to the last bit at 0 and 1e-300 m, to 1e-12 at 1e-20 m.", WIDE_LINE, space)
def height_zero():
    """Roughness of height zero, of 1e-300 m and of 1e-20 m, a part in 1e16 of the depth."""
    for height, allowed in ((0.0, 0.0), (1e-300, 0.0), (5e-324, 0.0), (1e-20, 1e-12)):
        yield equal(allowed, (sliding(1.0, roughness=_rough(rms_height=height)), sliding(1.0)))


@hard(f"The rms height is h0 to 1e-12 on line and surface. {TOUCHING}", line, dense)
def ends_of_the_spectrum():
    """H = 0 and 1, where moments of the spectrum are logarithms; one octave, all of it in the roll-off."""
    octave = _rough(shortest=ROUGH.longest / 2, rolloff=ROUGH.longest)
    scenes = [sliding(1.0, roughness=rough) for rough in (_rough(hurst=0.0), _rough(hurst=1.0), octave)]
    yield each_of(lambda answer: apart(answer["rms_height"], ROUGH.rms_height), 1e-12, *scenes)
    yield touching(*scenes)


@hard("The load is met to 1e-10 in 1D and 1e-9 in 3D. " + TOUCHING, line, partial(TIGHT, points=96))
def rougher_than_deep():
    """A load that one asperity carries: the depth is less than h0."""
    scene = resting(motion=Indent(load=1e-3 * LOAD), roughness=_rough(rms_height=DEPTH))
    yield equal(by_dimension(1e-10, 1e-9), (scene, {"normal_force": 1e-3 * LOAD}))
    yield each_of(lambda answer: answer["depth"] / DEPTH, 1.0, scene)
    yield touching(scene)


@hard("Friction by traction is the energy lost, to 1e-9.", partial(line, extent=4.5 * RADIUS))
def ends_of_hurst_in_a_flow():
    """H = 0 and 1 with h0 = d, from v tau/a = 1e-3 to 1e3: most of the line is lifted off and lands again."""
    rough = [_rough(hurst=hurst, rms_height=DEPTH) for hurst in (0.0, 1.0)]
    scenes = [sliding(pace, KELVIN, roughness=each) for each in rough for pace in (1e-3, 1.0, 1e3)]
    scenes.append(sliding(1.0, KELVIN, roughness=SelfAffine(hurst=0.0, rms_height=DEPTH, longest=2 * RADIUS)))
    yield energy_is_lost(1e-9, *scenes)


@hard(TOUCHING, partial(TIGHT, points=24))
def two_pixels_a_wave():
    """The shortest wave is at the Nyquist wave number of the grid."""
    yield touching(_pressed(_rough(shortest=2 * (2 * RADIUS) / 24), 3e5, SOLID, PACE))


@hard(
    "Stretched by 2^40 force and depth grow by as much, friction by its square, to 1e-12, rounding.", line, dense
)
def steep_beyond_sense():
    """Slopes of 1e11: linear theory has no scale for them."""
    factor = 2.0**40
    body, steep = (PowerLaw(coefficient=scale * 50.0, exponent=2.0) for scale in (1.0, factor))
    flat = Scene(body, SOLID, Slide(speed=PACE, depth=DEPTH), ROUGH)
    tall = Scene(
        steep, SOLID, Slide(speed=PACE, depth=factor * DEPTH), _rough(rms_height=factor * ROUGH.rms_height)
    )
    form = alike({"normal_force": factor, "depth": factor, "friction_force": factor**2})
    yield Part((flat, tall), form, 1e-12)


# Waves and grids


@hard(
    "Pressure of the closed form at every pixel, within 1e-4 of p* and of the mean: contact is solved to 1e-7, "
    "and what that leaves of the gap is felt as pressure by the wave number.",
    TIGHT,
)
def whole_domain():
    """Pressed beyond closure a wavy plane touches everywhere: there is no free point."""
    for rough, closure in CLOSURE.items():
        for fraction in (1.001, 2.0, 1e3):

            def misfit(answer, rough=rough, closure=closure, fraction=fraction):
                x, y = (2 * np.pi / WAVELENGTH * answer.fields[name] for name in ("x", "y"))
                across = np.cos(y)[:, None] if rough is CROSSED else 1.0
                known = closure * (fraction - across * np.cos(x))
                return float(np.abs(answer.fields["pressure"] - known).max() / closure)

            yield each_of(misfit, 1e-4 * max(1.0, fraction), _pressed(rough, fraction * closure))


@hard(
    "Westergaard's contact fraction to two pixels, of the two edges, and mean gap to 2/N^2, the order of the "
    "discretisation.",
    partial(row, tolerance=1e-9),
    *(partial(row, tolerance=1e-9, points=points) for points in (61, 63)),
)
def nearly_full_contact():
    """At 0.5, 0.99 and 0.9999 of closure a wave leaves gaps of a few pixels, with hardly any height."""
    for fraction in (0.5, 0.99, 0.9999):
        known, gap = waves.wave_contact_fraction(fraction), waves.wave_mean_gap(fraction)
        scene = _pressed(WAVE, fraction * WAVE_CLOSURE)
        yield each_of(lambda answer, known=known: abs(answer["contact_fraction"] - known), over_points(2), scene)
        if fraction > 0.5:
            yield each_of(
                lambda answer, gap=gap: abs(answer["mean_gap"] / AMPLITUDE - gap), over_points(2, 2), scene
            )


@hard(f"The mean gap is zero to 1e-3 h0, that of the last pixels. {TOUCHING}", TIGHT)
def just_closed():
    """At the pressure of closure itself points touch under no pressure, or are about to."""
    scenes = [_pressed(rough, closure) for rough, closure in CLOSURE.items()]
    yield each_of(lambda answer: abs(answer["mean_gap"]) / AMPLITUDE, 1e-3, *scenes)
    yield touching(*scenes)


@hard(
    "Force rises by no less than half of its greatest gain, as stiffness falls nowhere by more than 1e-5 of "
    "itself: contact grows with the depth, and stiffness with the contact.",
    line,
    partial(dense, tolerance=1e-9),
)
def force_rises_with_depth():
    """Depths a thousandth apart: on a grid, contact grows by whole pixels."""
    for rough in (None, ROUGH):
        motions = (Indent(depth=depth) for depth in DEPTH * (1 + 1e-3 * np.arange(12)))
        scenes = tuple(resting(motion=motion, roughness=rough) for motion in motions)
        yield Part(scenes, lambda answers: -(gains := _gains(answers)).min() / gains.max() + 1.5, 1.0)
        yield Part(scenes, lambda answers: max(-np.diff(gains := _gains(answers)).min() / gains.max(), 0.0), 1e-5)


def _gains(answers):
    return np.diff([answer["normal_force"] for answer in answers])


@hard(TOUCHING, *(partial(space, points=points) for points in (17, 31, 47)))
def prime_squares():
    """Squares of 17, 31 and 47 points, which no transform divides."""
    yield touching(resting(), sliding(1.0, KELVIN, roughness=ROUGH))


@hard(
    "Hertz's force within 8/N^1.5: the edge of contact moves by parts of a pixel.",
    *(lambda size, more=more: space(size, points=size.square + more) for more in (-1, 0, 1)),
)
def odd_next_to_even():
    """One point more or less puts the indenter's tip between pixels or on one."""
    yield equal(over_points(8, 1.5), (resting(), {"normal_force": LOAD}))


@hard(TOUCHING, *(partial(TIGHT, points=points) for points in (17, 18, 31, 47)))
def prime_periods():
    """A surface that repeats on 17, 31 and 47 points, where no wave stands at the Nyquist wave number."""
    scenes = (_pressed(PERIOD, part * SOLID.indentation_modulus, SOLID, PACE) for part in (1e-3, 1.0))
    yield touching(*scenes, Scene(Plane(), ELASTIC, Indent(pressure=1e5), PERIOD))


@hard("Friction of the closed form within 10/N^2.", *(partial(TIGHT, points=points) for points in (17, 31, 32)))
def prime_periods_in_full_contact():
    """Full contact on 17 and 31 points: heights are seen behind the pixels' centres, where pressure lags."""
    pressure = 3 * full_contact.crossed_closure(1e-6, 1e-3, SOLID, PACE)
    scene = _pressed(CrossedWaves(amplitude=1e-6, wavelength=1e-3), pressure, SOLID, PACE)
    friction = full_contact.crossed_friction(1e-6, 1e-3, SOLID, PACE) * 1e-6
    yield equal(over_points(10, 2), (scene, {"friction_force": friction}))


@hard(
    "Hertz's half-width to a pixel, depth to 4/N^1.5 of itself.",
    *(partial(row, points=points) for points in (17, 31, 127)),
    row,
)
def prime_rows():
    """A line contact on single rows of 17 and 31 points; squares are the only other shape of a grid."""
    half_width, _ = line_contact.hertz(SPHERE.radius, ELASTIC.indentation_modulus, LOAD / RADIUS)
    scene = Scene(Cylinder(SPHERE.radius), ELASTIC, Indent(line_load=LOAD / RADIUS))
    yield each_of(lambda answer: abs(answer["contact_area"] / 2 - half_width) / answer["pixel"], 1.0, scene)
    yield equal(over_points(4, 1.5), (scene, {"depth": elastic_contact(scene).depth}))


@hard(TOUCHING, partial(space, points=16, extent=2.4 * RADIUS))
def smallest_square():
    """16 points a side."""
    yield touching(sliding(1.0))


def _cone(depth: float) -> Part:
    """A cone at rest at a depth, of which the force is exact in 1D."""
    force = 2 / np.pi * ELASTIC.indentation_modulus * depth**2 / CONE.coefficient
    return equal(1e-12, (resting(indenter=CONE, motion=Indent(depth=depth)), {"normal_force": force}))


@hard("Force on a cone exact to 1e-12: it is linear between nodes.", partial(line, points=8, extent=2.4 * RADIUS))
def smallest_line():
    """8 points on a line."""
    yield _cone(RADIUS / 4)


@hard(
    "Force on a cone exact to 1e-12, on an even number of points.",
    *(partial(line, points=points) for points in (9, 31, 101, 997)),
)
def odd_lines():
    """Odd and prime numbers of points, which are rounded up to have a node at the tip."""
    yield _cone(DEPTH)
    yield each_of(lambda answer: answer.points % 2, 0.0, resting(indenter=CONE))


@hard(
    "Pixels divide the period to 1e-9, the rms height is h0 to 1e-12, friction by traction is the energy lost to "
    "1e-9.",
    *(partial(line, points=points, extent=sqrt(2) * 3 * RADIUS) for points in (997, 1009)),
)
def lines_off_the_period():
    """An extent that is no rational part of the period of the roughness, on prime numbers of points."""
    scene = sliding(1.0, KELVIN, roughness=ROUGH)
    yield each_of(lambda answer: abs((ROUGH.longest / answer["pixel"] + 0.5) % 1 - 0.5), 1e-9, scene)
    yield each_of(lambda answer: apart(answer["rms_height"], ROUGH.rms_height), 1e-12, scene)
    yield energy_is_lost(1e-9, scene)


@hard(
    "The contact lies inside of it, solved to the tolerance.",
    *(partial(space, extent=None, points=points) for points in (47, 65, 130)),
)
def windows_of_odd_grids():
    """A window sought on grids that halve to odd ones."""

    def rim(answer):
        touched = answer.fields["pressure"] > 0
        return float(touched[[0, -1]].any() or touched[:, [0, -1]].any())

    scene = sliding(3.0, roughness=ROUGH)
    yield each_of(rim, 0.0, scene)
    yield each_of(lambda answer: answer["residual"], TOLERANCE, scene)


# Units


FREE = line, partial(dense, extent=None)
SMALL_AND_LARGE = (2.0**-30, 2.0**20, 2.0**-40), (2.0**10, 2.0**-20, 2.0**40)


def _in_units(kind, allowed, *every):
    """Depth, force and friction of a contact in other units of length, modulus and time."""
    for factors in every:
        length, modulus, _ = factors
        form = alike({"depth": length} | dict.fromkeys(FORCES, length**2 * modulus))
        yield Part((family(kind), family(kind, *factors)), form, allowed)


@hard("Depth, force and friction scale by powers of two to the last bit.", *FREE)
def powers_of_two():
    """From a thousandth of a nanometre to a million kilometres, from 1e-12 to 1e24 Pa, from 1e-18 to 1e12 s."""
    lengths = [(2.0**power, 1.0, 1.0) for power in (-10, -20, -30, 10, 20, 40)]
    moduli = [(1.0, 2.0**power, 1.0) for power in (-20, -60, 20, 60)]
    times = [(1.0, 1.0, 2.0**power) for power in (-50, -20, 20, 50)]
    yield from _in_units("rough", 0.0, *lengths, *moduli, *times, *SMALL_AND_LARGE)


@hard("Depth, force and friction scale to 1e-12: powers other than squares round.", *FREE)
def loads_in_all_units():
    """A load is a product of all units, and the depth is sought."""
    yield from _in_units("rough load", 1e-12, *SMALL_AND_LARGE)


@hard(
    "Depth, force and friction scale to 1e-9: the set of contact is the same, and rounding is carried through.",
    *FREE,
)
def decimal_units():
    """Factors that are no powers of two: nanometres, kilometres, inches and psi; every number rounds anew."""
    yield from _in_units("rough", 1e-9, (1e-9, 1.0, 1e-6), (1e3, 1e6, 1e3), (25.4e-3, 6894.757, 3600.0))


@hard("Depth, force and friction scale to 1e-9: steps round.", *(partial(each, steps=20) for each in FREE))
def marches_in_all_units():
    """A program in time, cut into steps by pixels and durations in other units."""
    yield from _in_units("rough program", 1e-9, *SMALL_AND_LARGE)
