"""Roughness of no height and of too much, at both ends of the Hurst exponent, and cut off where grids end."""

from dataclasses import replace
from functools import partial
from math import radians

import numpy as np

from mdr1d import draw
from scene import (
    Cone,
    CrossedWaves,
    EmptyContact,
    Indent,
    Plane,
    PowerLaw,
    Refused,
    Scene,
    SelfAffine,
    Slide,
    SolveError,
)
from scene.quantities import MOST_WHOLE

from .conditions import conditions, kelvin_surface
from .hardcase import Check, Group, deviation
from .laws import energy_is_lost, equal, in_contact, refused
from .ordinary import DEPTH, KELVIN, LOAD, PACE, RADIUS, ROUGH, SOLID, resting, sliding
from .solvers import TOLERANCE, dense, line, space, square

WIDE_LINE = partial(line, extent=4 * RADIUS)
CASES = case = Group("roughness")


def _as_on_springs(what, answer):
    """Displacement is the greatest of what was pressed before, and friction is the energy lost."""
    apart = np.abs(kelvin_surface(answer) - answer.fields["displacement"]).max() / answer.depth
    yield Check(f"{what}displacement against the greatest of what was pressed before", apart, 1e-12)
    yield energy_is_lost(what, answer, 1e-9)


@case(
    "Roughness of height zero, of 1e-300 m and of 1e-20 m, a part in 1e16 of the depth.",
    "Force of the smooth body: to the last bit at 0 and 1e-300 m, to 1e-12 at 1e-20 m.",
)
def height_zero(size):
    for solver in (WIDE_LINE(size), space(size)):
        smooth = solver.solve(sliding(1.0)).normal_force
        for height, allowed in ((0.0, 0.0), (1e-300, 0.0), (1e-20, 1e-12)):
            rough = solver.solve(sliding(1.0, roughness=replace(ROUGH, rms_height=height))).normal_force
            yield Check(f"{solver.name}: force, h0 = {height:g} m", abs(rough / smooth - 1), allowed)


@case(
    "At H = 0 and 1 moments of the spectrum are logarithms, limits of powers that cancel.",
    "The rms height is h0 to 1e-12 on line and surface; the rms slope is that of H 1e-9 away to 1e-7; "
    "conditions of contact, computed anew.",
)
def hurst_zero_and_one(size):
    for hurst in (0.0, 1.0):
        rough = replace(ROUGH, hurst=hurst)
        drawn = draw(rough, size.line)
        yield deviation(f"H = {hurst:g}: rms height of the line", drawn.rms_height, rough.rms_height, 1e-12)
        near = replace(ROUGH, hurst=abs(hurst - 1e-9))
        q_max = rough.q_max(0.0)
        slope, nearby = rough.rms_slope(q_max), near.rms_slope(q_max)
        yield deviation(f"H = {hurst:g}: rms slope against that nearby", slope, nearby, 1e-7)
        answer = dense(size).solve(sliding(1.0, roughness=rough))
        yield deviation(f"H = {hurst:g}: of the surface", answer.measures["rms_height"], rough.rms_height, 1e-12)
        yield from conditions(answer, 2 * TOLERANCE, f"H = {hurst:g}")


@case(
    "A load that one asperity carries: the depth is less than h0.",
    "The load is met to 1e-10 in 1D and 1e-9 in 3D; conditions of contact, computed anew.",
)
def rougher_than_deep(size):
    for load in (1e-6, 1e-3):
        scene = resting(motion=Indent(load=load * LOAD), roughness=replace(ROUGH, rms_height=DEPTH))
        answer = line(size).solve(scene)
        yield deviation(f"1D: force under {load:g} of the load", answer.normal_force, load * LOAD, 1e-10)
        yield Check("1D: depth over h0", answer.depth / DEPTH, 1.0)
    found = square(size, points=4 * size.dense, tolerance=TOLERANCE).solve(scene)
    yield Check("3D: depth over h0", found.depth / DEPTH, 1.0)
    yield deviation("3D: force", found.normal_force, 1e-3 * LOAD, 1e-9)
    yield from conditions(found, 2 * TOLERANCE)


@case(
    "H = 0 and 1 with h0 = d, sliding from v tau/a = 1e-3 to 1e3: most of the line is lifted off and lands again.",
    "Displacement is the greatest of all that was pressed before and has relaxed, to 1e-12 of the depth; "
    "friction by traction is the energy lost to 1e-9.",
)
def ends_of_hurst_in_a_flow(size):
    for hurst in (0.0, 1.0):
        for pace in (1e-3, 1.0, 1e3):
            scene = sliding(pace, KELVIN, roughness=replace(ROUGH, hurst=hurst, rms_height=DEPTH))
            answer = line(size).solve(scene)
            yield from _as_on_springs(f"H = {hurst:g}, v tau/a = {pace:g}: ", answer)


@case(
    "A depth at which the highest asperity does not reach the surface.",
    "Refused as an empty contact: the error names motion.depth and its value.",
)
def above_the_peaks(size):
    crest = CrossedWaves(amplitude=DEPTH / 10, wavelength=RADIUS)
    for build, rough in ((WIDE_LINE, replace(ROUGH, seed=4)), (space, crest)):
        for depth in (DEPTH / 100, 1e-300):
            scene = Scene(Cone(radians(88)), SOLID, Slide(speed=PACE, depth=depth), rough)
            words = f"motion.depth | {depth:g} | lowest point"
            yield from refused(words, scene, build, error=EmptyContact)(size)


@case(
    "The shortest wave is at the Nyquist wave number of the grid.",
    "Conditions of contact, computed anew; rms height of the line to 1e-12.",
)
def two_pixels_a_wave(size):
    rough = replace(ROUGH, shortest=2 * (2 * RADIUS) / size.dense)
    scene = Scene(Plane(), SOLID, Slide(speed=PACE, pressure=3e5), rough)
    yield from in_contact(scene, partial(square, points=size.dense, tolerance=TOLERANCE))(size)
    drawn = draw(rough, size.dense)
    yield deviation("rms height of the line on two nodes a wave", drawn.rms_height, ROUGH.rms_height, 1e-12)


TINY = replace(ROUGH, shortest=1e-6 * RADIUS)
BROAD = Scene(Plane(), SOLID, Indent(pressure=1e4), replace(ROUGH, shortest=2 * RADIUS / 4000))
NINE_DECADES = resting(roughness=replace(ROUGH, shortest=1e-12))
case.add(
    "unresolved-waves",
    "The shortest wave is far less than a pixel.",
    "Refused: the error names shortest, its value and one that would do.",
    refused(f"shortest | {TINY.shortest:g} | would do", resting(roughness=TINY), WIDE_LINE, space, error=Refused),
)
case.add(
    "nine-decades-of-waves",
    "Roughness from millimetres to picometres fits no memory.",
    "Refused at once: the error names what to change.",
    refused("longest | shortest | raise shortest", NINE_DECADES, line, error=Refused),
    refused("memory | use", BROAD, partial(square, points=16384), error=(SolveError, Refused)),
)


@case(
    "A spectrum of one octave, all of it in the roll-off.",
    "The rms height is h0 to 1e-12; conditions of contact, computed anew.",
)
def a_single_octave(size):
    rough = replace(ROUGH, shortest=ROUGH.longest / 2, rolloff=ROUGH.longest)
    drawn = draw(rough, size.line)
    yield deviation("rms height of the line", drawn.rms_height, ROUGH.rms_height, 1e-12)
    yield from conditions(dense(size).solve(sliding(1.0, roughness=rough)), 2 * TOLERANCE)


@case(
    "Slopes of 1e11: linear theory has no scale for them.",
    "Stretched by 2^40 force and depth grow by as much, friction by its square, to 1e-12, rounding.",
)
def steep_beyond_sense(size):
    factor = 2.0**40
    stretched = replace(ROUGH, rms_height=factor * ROUGH.rms_height)
    body, steep = (PowerLaw(coefficient=scale * 50.0, exponent=2.0) for scale in (1.0, factor))
    flat = Scene(body, SOLID, Slide(speed=PACE, depth=DEPTH), ROUGH)
    tall = Scene(steep, SOLID, Slide(speed=PACE, depth=factor * DEPTH), stretched)
    for solver in (line(size), dense(size)):
        one, other = solver.solve(flat), solver.solve(tall)
        for name, over in (("normal_force", factor), ("depth", factor), ("friction_force", factor**2)):
            ratio = getattr(other, name) / over
            yield deviation(f"{solver.name}: {name} over the stretch", ratio, getattr(one, name), 1e-12)


SEEDED = {f"seed {seed:g}": resting(roughness=replace(ROUGH, seed=seed)) for seed in (2**53 + 1, MOST_WHOLE)}
case.add(
    "huge-seeds",
    "Seeds up to the largest.",
    "The same seed gives the same force, to the last bit.",
    equal({what: (scene, scene) for what, scene in SEEDED.items()}, 0.0),
)


@case(
    "H = 0 down to the Nyquist wave number, as in the paper: each interval of the line has its own slope.",
    "Displacement and energy as of ends-of-hurst-in-a-flow.",
)
def as_rough_as_the_grid(size):
    rough = SelfAffine(hurst=0.0, rms_height=DEPTH, longest=2 * RADIUS)
    answer = line(size, extent=4.5 * RADIUS).solve(sliding(1.0, KELVIN, roughness=rough))
    yield from _as_on_springs("", answer)
