"""Numbers that are allowed and hardly numbers: huge and denormal ones, extents that miss, histories of no time."""

from dataclasses import replace
from functools import partial

import numpy as np
from pydantic import ValidationError

from bem3d import BEM
from compare.exact import indentation
from mdr1d import MDR
from scene import Elastic, Indent, Kelvin, Program, Refused, SelfAffine, Slide, SolveError, Sphere, Stage, Wave

from .hardcase import Check, Group, deviation, invalid, refusal
from .ordinary import DEPTH, LOAD, ROUGH, SOLID, SPHERE, dense, line, resting, sliding, space

REFUSED = (Refused, SolveError, ValidationError)
CASES = case = Group("extremes")


def _answered_or_refused(solver, scene):
    """One check: a refusal in words, or a force that is finite and positive."""
    what = f"{solver.name}: {scene.indenter}, {scene.motion}"
    try:
        force = solver.solve(scene).normal_force
    except REFUSED as error:
        said = str(error)
        return Check(
            f"{what}: refused in words", float(len(said) < 20 or ("take" not in said and "units" not in said)), 0.0
        )
    return Check(f"{what}: force", float(not 0 < force < np.inf), 0.0)


def _everywhere(size, value, *others):
    """In every quantity of a scene, and in other scenes, by both solvers."""
    scenes = (
        resting(indenter=Sphere(value)),
        resting(motion=Indent(depth=value)),
        resting(motion=Indent(load=value)),
        resting(elastomer=Elastic(value)),
        resting(elastomer=Kelvin(1e6, value), motion=Slide(speed=1.0, depth=DEPTH)),
        *others,
    )
    for scene in scenes:
        for solver in (line(size), BEM(points=24)):
            yield _answered_or_refused(solver, scene)


@case(
    "1e150 to 1.7e308 as radius, depth, load, modulus, relaxation time and speed.",
    "A force that is finite and positive, or a refusal in words that says what to change.",
)
def huge(size):
    for value in (1e150, 1e300, 1.7e308):
        yield from _everywhere(size, value, sliding(value / 1e300 + 1e100))


@case(
    "The least numbers that there are, as radius, depth, load, modulus and relaxation time.",
    "A force that is finite and positive, or a refusal in words that says what to change.",
)
def denormal(size):
    for value in (5e-324, 1e-310, 1e-160):
        yield from _everywhere(size, value)


@case(
    "Wavelengths whose wave numbers overflow, heights whose squares vanish.",
    "Wavelengths are refused by name and bound; without height the force is that of the smooth body to 1e-9.",
)
def denormal_waves(size):
    for value in (5e-324, 1e-310):
        for build, name in (
            (partial(SelfAffine, hurst=0.5, rms_height=1e-6), "longest"),
            (partial(Wave, amplitude=1e-6), "wavelength"),
        ):
            yield invalid(f"{name} = {value:g}", f"{name} | 1e-300", build, **{name: value})
    flat = replace(ROUGH, rms_height=5e-324)
    for solver in (line(size, extent=4e-3), space(size)):
        rough, smooth = (solver.solve(resting(roughness=each)).normal_force for each in (flat, None))
        yield deviation(f"{solver.name}: force at a rms height of 5e-324 m", rough, smooth, 1e-9)


@case(
    "Extents of 5e-324, 1e-5, 1e4 and 1e300 m around a contact of a millimetre.",
    "Refused: the error names the extent, says what to take, or asks for the units.",
)
def extents_that_miss(size):
    for extent, said in ((1e-5, "extent"), (1e4, "take"), (5e-324, "units"), (1e300, "units")):
        for solver in (line(size, extent=extent), space(size, extent=extent)):
            yield refusal(f"{solver.name}: extent = {extent:g} m", SolveError, said, solver.solve, resting())


@case(
    "Kilometres of glass under piconewtons, nanometres of it under micronewtons, planets of jelly.",
    "Hertz's depth within 1/N of the 3D grid.",
)
def mixed_extremes(size):
    for radius, modulus, load in ((1e3, 1e12, 1e-12), (1e-9, 1.0, 1e-15), (1e6, 1e-6, 1e6), (1e-9, 1e12, 1e-6)):
        scene = resting(indenter=Sphere(radius), elastomer=Elastic(modulus), motion=Indent(load=load))
        known = (9 * load**2 / (16 * radius * (4 * modulus) ** 2)) ** (1 / 3)
        for solver in (line(size), dense(size, extent=None)):
            what = f"{solver.name}: R = {radius:g} m, G = {modulus:g} Pa, {load:g} N"
            yield deviation(f"{what}: depth", solver.solve(scene).depth, known, 1 / size.dense)


@case("Stages of 1e-300 s.", "Force of Ting within 1e-3 of the grid in 1D; a load is met to 1e-9.")
def history_of_1e_300_s(size):
    stages = (Stage(duration=1e-300, depth=DEPTH), Stage(duration=1e-300, depth=DEPTH / 2))
    scene = resting(elastomer=SOLID, motion=Program(stages=stages))
    times, depths = (0.0, 1e-300, 2e-300), (0.0, DEPTH, DEPTH / 2)
    (known,), _ = indentation.force_of_depth(SPHERE, SOLID, times, depths, 2e-300)
    yield deviation("MDR: force after 2e-300 s", MDR(points=size.line).solve(scene).normal_force, known, 1e-3)
    heavy = replace(scene, motion=Program(stages=(Stage(duration=1e-300, load=LOAD),)))
    yield deviation("MDR: load after 1e-300 s", line(size).solve(heavy).normal_force, LOAD, 1e-9)
