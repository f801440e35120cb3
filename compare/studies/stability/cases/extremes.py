"""Numbers that are allowed and hardly numbers: huge and denormal ones, extents that miss, histories of no time."""

from dataclasses import replace
from functools import partial

import numpy as np
from pydantic import ValidationError

from scene import Elastic, Indent, Kelvin, Refused, SelfAffine, SolveError, Sphere, Wave

from ....models.exact import indentation
from .hardcase import Check, Group, invalid
from .laws import BOTH, asked, equal, refused
from .ordinary import DEPTH, LOAD, ROUGH, SOLID, SPHERE, program, resting, sliding, stage
from .solvers import dense, line, space, square

REFUSED = (Refused, SolveError, ValidationError)
CASES = case = Group("extremes")


def _answered_or_refused(what, solver, scene):
    """A force that is finite and positive, or a refusal in words."""
    try:
        force = solver.solve(scene).normal_force
    except REFUSED as error:
        said = str(error)
        unsaid = len(said) < 20 or ("take" not in said and "units" not in said)
        return Check(f"{what}: refused in words", float(unsaid), 0.0)
    return Check(f"{what}: force", float(not 0 < force < np.inf), 0.0)


def everywhere(*values, faster=()):
    """Numbers in every quantity of a scene, and others as its speed, by both solvers."""
    scenes = {f"speed {value:g}": sliding(value) for value in faster}
    for value in values:
        scenes |= {
            f"radius {value:g} m": resting(indenter=Sphere(value)),
            f"depth {value:g} m": resting(motion=Indent(depth=value)),
            f"load {value:g} N": resting(motion=Indent(load=value)),
            f"modulus {value:g} Pa": resting(elastomer=Elastic(value)),
            f"relaxation time {value:g} s": sliding(1.0, Kelvin(1e6, value)),
        }

    def examine(size):
        for what, solver, scene in asked(size, scenes, (line, partial(square, points=24))):
            yield _answered_or_refused(what, solver, scene)

    return examine


ANSWERED = "A force that is finite and positive, or a refusal in words that says what to change."
case.add(
    "huge",
    "1e150 to 1.7e308 as radius, depth, load, modulus and relaxation time, 1e100 as speed.",
    ANSWERED,
    everywhere(1e150, 1e300, 1.7e308, faster=(1e100,)),
)
case.add(
    "denormal",
    "The least numbers that there are, as radius, depth, load, modulus and relaxation time.",
    ANSWERED,
    everywhere(5e-324, 1e-310, 1e-160),
)


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
    yield from equal((resting(roughness=flat), resting()), 1e-9, partial(line, extent=4e-3), space)(size)


@case(
    "Extents of 5e-324, 1e-5, 1e4 and 1e300 m around a contact of a millimetre.",
    "Refused: the error names the extent, says what to take, or asks for the units.",
)
def extents_that_miss(size):
    for extent, said in ((1e-5, "extent"), (1e4, "take"), (5e-324, "units"), (1e300, "units")):
        builds = (partial(build, extent=extent) for build in BOTH)
        yield from refused(said, resting(), *builds)(size)


@case(
    "Kilometres of glass under piconewtons, nanometres of it under micronewtons, planets of jelly.",
    "Hertz's depth within 1/N of the 3D grid.",
)
def mixed_extremes(size):
    rows = {}
    for radius, modulus, load in ((1e3, 1e12, 1e-12), (1e-9, 1.0, 1e-15), (1e6, 1e-6, 1e6), (1e-9, 1e12, 1e-6)):
        scene = resting(indenter=Sphere(radius), elastomer=Elastic(modulus), motion=Indent(load=load))
        known = (9 * load**2 / (16 * radius * (4 * modulus) ** 2)) ** (1 / 3)
        rows[f"R = {radius:g} m, G = {modulus:g} Pa, {load:g} N"] = scene, {"depth": known}
    return equal(rows, 1 / size.dense, line, partial(dense, extent=None))(size)


@case("Stages of 1e-300 s.", "Force of Ting within 1e-3 of the grid in 1D; a load is met to 1e-9.")
def history_of_1e_300_s(size):
    times, depths = (0.0, 1e-300, 2e-300), (0.0, DEPTH, DEPTH / 2)
    (known,), _ = indentation.force_of_depth(SPHERE, SOLID, times, depths, 2e-300)
    back = program(stage(1e-300, depth=DEPTH), stage(1e-300, depth=DEPTH / 2))
    yield from equal((back, {"normal_force": known}), 1e-3, line)(size)
    loaded = program(stage(1e-300, load=LOAD))
    yield from equal((loaded, {"normal_force": LOAD}), 1e-9, line)(size)
