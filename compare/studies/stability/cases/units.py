"""One and the same contact from nanometres to kilometres, from pascals to terapascals, in any unit of time."""

from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import partial
from typing import NamedTuple

import numpy as np

from scene import Cylinder, Prony, Scene, Slide

from .hardcase import Group, deviation
from .laws import Law
from .ordinary import DEPTH, LOAD, MODULUS, PACE, RADIUS, ROUGH, SPHERE, TIME, program, stage
from .solvers import TOLERANCE, dense, line, row

BITS = "Depth, force and friction scale by powers of two to the last bit."
CASES = case = Group("units")


class Units(NamedTuple):
    """Units of length, modulus and time over those of the ordinary contact."""

    length: float = 1.0
    modulus: float = 1.0
    time: float = 1.0

    @property
    def load(self) -> float:
        """LOAD in these units."""
        return self.length**2 * self.modulus * LOAD


def powers(name: str, *exponents: int) -> list[Units]:
    """One of the units by powers of two."""
    return [Units(**{name: 2.0**exponent}) for exponent in exponents]


BOTH = line, dense
SMALL_AND_LARGE = Units(2.0**-30, 2.0**20, 2.0**-40), Units(2.0**10, 2.0**-20, 2.0**40)
FORCES = {
    "depth": lambda units: units.length,
    "normal_force": lambda units: units.length**2 * units.modulus,
    "friction_force": lambda units: units.length**2 * units.modulus,
}


def _solid(units):
    moduli, times = (units.modulus * 1e6, units.modulus * 3e6), (units.time * TIME, units.time * (TIME / 50))
    return Prony(units.modulus * MODULUS, moduli, times)


def _sphere(motion, units):
    waves = {name: units.length * getattr(ROUGH, name) for name in ("rms_height", "longest", "shortest")}
    indenter = replace(SPHERE, radius=units.length * SPHERE.radius)
    return Scene(indenter, _solid(units), motion(units), replace(ROUGH, **waves))


def _line(units):
    motion = Slide(speed=units.length * PACE, line_load=units.length * units.modulus * LOAD / RADIUS)
    return Scene(Cylinder(units.length * SPHERE.radius), _solid(units), motion)


def _slide(units, **pressed):
    return Slide(speed=units.length / units.time * PACE, **pressed)


def _program(units):
    first, last = (stage(units.time * TIME, load=part * units.load) for part in (1.0, 0.1))
    away = stage(2 * units.time * TIME, speed=units.length / units.time * PACE / 8)
    return program(first, away, last).motion


SLIDING = partial(_sphere, lambda units: _slide(units, depth=units.length * DEPTH))
LOADED = partial(_sphere, lambda units: _slide(units, load=units.load))
MARCHING = partial(_sphere, _program)


def scaled(
    scene: Callable, every: Iterable[Units], allowed=0.0, of=FORCES, solvers=(line, dense), **settings
) -> Law:
    """Answers in some units over their own unit are those of the ordinary contact."""

    def examine(size):
        for build in solvers:
            solver = build(size, **{"extent": 4 * RADIUS} | settings)
            known = solver.solve(scene(Units()))
            for units in every:
                extent = solver.extent and units.length * 4 * RADIUS
                found = replace(solver, extent=extent).solve(scene(units))
                what = f"{solver.name}, {units.length:.3g} m, {units.modulus:.3g} Pa, {units.time:.3g} s"
                for name, unit in of.items():
                    value = getattr(found, name) / unit(units)
                    yield deviation(f"{what}: {name}", value, getattr(known, name), allowed)

    return examine


for name, about, every in (
    ("nanometres", "Lengths from micrometres to a thousandth of a nanometre.", powers("length", -10, -20, -30)),
    ("kilometres", "Lengths from a metre to a million kilometres.", powers("length", 10, 20, 40)),
    ("pascals-to-exapascals", "Moduli from 1e-12 to 1e24 Pa.", powers("modulus", -20, -60, 20, 60)),
    ("femtoseconds-to-ages", "Relaxation times from 1e-18 to 1e12 s.", powers("time", -50, -20, 20, 50)),
    (
        "all-units-at-once",
        "Nanometres, terapascals and picoseconds; kilometres, pascals and ages.",
        SMALL_AND_LARGE,
    ),
):
    case.add(name, about, BITS, scaled(SLIDING, every))
case.add(
    "loads-in-all-units",
    "A load is a product of all units, and the depth is sought.",
    "Depth, force and friction scale to 1e-12: powers other than squares round.",
    scaled(LOADED, SMALL_AND_LARGE, 1e-12),
)
case.add(
    "decimal-units",
    "Factors that are no powers of two: nanometres, kilometres, inches and psi; every number rounds anew.",
    "Depth, force and friction scale to 1e-9: the set of contact is the same, and rounding is carried through.",
    scaled(SLIDING, [Units(1e-9, 1.0, 1e-6), Units(1e3, 1e6, 1e3), Units(25.4e-3, 6894.757, 3600.0)], 1e-9),
)
case.add(
    "marches-in-all-units",
    "A program in time, cut into steps by pixels and durations in other units.",
    "Depth, force and friction scale to 1e-9: steps round.",
    scaled(MARCHING, SMALL_AND_LARGE, 1e-9, steps=20),
)
case.add(
    "lines-in-all-units",
    "Forces of a line are per length, and depths count from a logarithm.",
    "Depth and mu scale to 1e-9: the logarithm rounds.",
    scaled(
        _line,
        (Units(2.0**-30, 2.0**20), Units(2.0**10, 2.0**-20)),
        1e-9,
        {"depth": FORCES["depth"], "friction_coefficient": lambda units: 1.0},
        (row,),
        extent=None,
        tolerance=TOLERANCE,
    ),
)


@case(
    "Sums may agree where points do not.",
    "Displacement in 1D and pressure in 3D scale at every point, to the last bit.",
)
def fields_in_all_units(size):
    small = Units(length=2.0**-20)
    for build, name, unit in ((line, "displacement", small.length), (dense, "pressure", 1.0)):
        known, found = (
            build(size, extent=each.length * 4 * RADIUS).solve(SLIDING(each)).fields[name]
            for each in (Units(), small)
        )
        apart = np.abs(found / unit - known).max()
        yield deviation(name, 1 + apart / known.max(), 1.0, 0.0)
