"""One and the same contact from nanometres to kilometres, from pascals to terapascals, in any unit of time."""

from dataclasses import replace

import numpy as np

from scene import Cylinder, Program, Prony, Scene, Slide, Stage

from .hardcase import Group, deviation
from .ordinary import DEPTH, LOAD, MODULUS, PACE, RADIUS, ROUGH, SPHERE, TIME, dense, line

MODES = (1e6, 3e6), (TIME, TIME / 50)
CASES = case = Group("units")
BITS = "Depth, force and friction scale by powers of two to the last bit."


def _scaled(length, modulus, time, motion, rough=ROUGH):
    """The rough sphere on two modes, in other units of length, modulus and time."""
    moduli, times = MODES
    solid = Prony(
        equilibrium_modulus=modulus * MODULUS,
        moduli=tuple(modulus * each for each in moduli),
        relaxation_times=tuple(time * each for each in times),
    )
    waves = {name: length * getattr(rough, name) for name in ("rms_height", "longest", "shortest")}
    return Scene(
        replace(SPHERE, radius=length * SPHERE.radius),
        solid,
        motion(length, modulus, time),
        replace(rough, **waves),
    )


def _slide(length, modulus, time):
    return Slide(speed=length / time * PACE, depth=length * DEPTH)


def _loaded(length, modulus, time):
    return Slide(speed=length / time * PACE, load=length**2 * modulus * LOAD)


def _program(length, modulus, time):
    return Program(
        stages=(
            Stage(duration=time * TIME, load=length**2 * modulus * LOAD),
            Stage(duration=2 * time * TIME, speed=length / time * PACE / 8),
            Stage(duration=time * TIME, load=0.1 * length**2 * modulus * LOAD),
        )
    )


def _compared(size, motion, factors, allowed):
    """Both solvers in each unit against the ordinary one."""
    for build in (line, dense):
        one = build(size, extent=4 * RADIUS, **_steps(motion))
        known = one.solve(_scaled(1.0, 1.0, 1.0, motion))
        for length, modulus, time in factors:
            found = replace(one, extent=length * 4 * RADIUS).solve(_scaled(length, modulus, time, motion))
            what = f"{one.name}, {length:.3g} m, {modulus:.3g} Pa, {time:.3g} s"
            force = length**2 * modulus
            yield deviation(f"{what}: depth", found.depth / length, known.depth, allowed)
            yield deviation(f"{what}: force", found.normal_force / force, known.normal_force, allowed)
            yield deviation(f"{what}: friction", found.friction_force / force, known.friction_force, allowed)


def _steps(motion):
    return {"steps": 20} if motion is _program else {}


@case("Lengths from micrometres to a thousandth of a nanometre.", BITS)
def nanometres(size):
    return _compared(size, _slide, [(2.0**-k, 1.0, 1.0) for k in (10, 20, 30)], 0.0)


@case("Lengths from a metre to a million kilometres.", BITS)
def kilometres(size):
    return _compared(size, _slide, [(2.0**k, 1.0, 1.0) for k in (10, 20, 40)], 0.0)


@case("Moduli from 1e-12 to 1e24 Pa.", BITS)
def pascals_to_exapascals(size):
    return _compared(size, _slide, [(1.0, 2.0**k, 1.0) for k in (-20, -60, 20, 60)], 0.0)


@case("Relaxation times from 1e-18 to 1e12 s.", BITS)
def femtoseconds_to_ages(size):
    return _compared(size, _slide, [(1.0, 1.0, 2.0**k) for k in (-50, -20, 20, 50)], 0.0)


@case("Nanometres, terapascals and picoseconds; kilometres, pascals and ages.", BITS)
def all_units_at_once(size):
    return _compared(size, _slide, [(2.0**-30, 2.0**20, 2.0**-40), (2.0**10, 2.0**-20, 2.0**40)], 0.0)


@case(
    "A load is a product of all units, and the depth is sought.",
    "Depth, force and friction scale to 1e-12: powers other than squares round.",
)
def loads_in_all_units(size):
    return _compared(size, _loaded, [(2.0**-30, 2.0**20, 2.0**-40), (2.0**10, 2.0**-20, 2.0**40)], 1e-12)


@case(
    "Factors that are no powers of two: nanometres, kilometres, inches and psi; every number rounds anew.",
    "Depth, force and friction scale to 1e-9: the set of contact is the same, and rounding is carried through.",
)
def decimal_units(size):
    factors = [(1e-9, 1.0, 1e-6), (1e3, 1e6, 1e3), (25.4e-3, 6894.757, 3600.0)]
    return _compared(size, _slide, factors, 1e-9)


@case(
    "A program in time, cut into steps by pixels and durations in other units.",
    "Depth, force and friction scale to 1e-9: steps round.",
)
def marches_in_all_units(size):
    factors = [(2.0**-30, 2.0**20, 2.0**-40), (2.0**10, 2.0**-20, 2.0**40)]
    return _compared(size, _program, factors, 1e-9)


@case(
    "Forces of a line are per length, and depths count from a logarithm.",
    "Depth and mu scale to 1e-9: the logarithm rounds.",
)
def lines_in_all_units(size):
    one = dense(size, points=size.row, extent=None)

    def scene(length, modulus):
        solid = Prony(modulus * MODULUS, tuple(modulus * each for each in MODES[0]), MODES[1])
        motion = Slide(speed=length * PACE, line_load=length * modulus * LOAD / RADIUS)
        return Scene(Cylinder(length * SPHERE.radius), solid, motion)

    known = one.solve(scene(1.0, 1.0))
    for length, modulus in ((2.0**-30, 2.0**20), (2.0**10, 2.0**-20)):
        found, what = one.solve(scene(length, modulus)), f"{length:.3g} m, {modulus:.3g} Pa"
        yield deviation(f"{what}: depth", found.depth / length, known.depth, 1e-9)
        yield deviation(f"{what}: mu", found.friction_coefficient, known.friction_coefficient, 1e-9)


@case(
    "Sums may agree where points do not.",
    "Displacement in 1D and pressure in 3D scale at every point, to the last bit.",
)
def fields_in_all_units(size):
    for build in (line, dense):
        one = build(size, extent=4 * RADIUS)
        small = replace(one, extent=2.0**-20 * 4 * RADIUS)
        known, found = one.solve(_scaled(1.0, 1.0, 1.0, _slide)), small.solve(_scaled(2.0**-20, 1.0, 1.0, _slide))
        names = {"MDR": ("displacement", 2.0**-20), "BEM": ("pressure", 1.0)}
        name, unit = names[one.name]
        apart = np.abs(found.fields[name] / unit - known.fields[name]).max()
        yield deviation(f"{one.name}: {name}", 1 + apart / known.fields[name].max(), 1.0, 0.0)
