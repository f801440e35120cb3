"""Every number and field that a solver gives has an entry, and a unit by which it scales with the scene."""

from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from changing_motion import program
from sliding import ORDINARY
from strategies import rescaled

import compare
from bem3d import BEM
from compare.library.case import Case
from compare.studies.comparison.answers import THEORIES
from mdr1d import MDR
from scene import (
    WLF,
    Coulomb,
    Cylinder,
    Heating,
    Indent,
    Layer,
    Plane,
    Program,
    SelfAffine,
    Shear,
    Slide,
    StandardLinearSolid,
)
from scene.files.reading import read
from scene.vocabulary import FIELDS, MEASURES, NUMBERS

SHIPPED = Path(compare.__file__).parent / "library" / "scenes"
# But for one of many steps, whose words others have too.
READY = [path for path in sorted(SHIPPED.glob("*.toml")) if path.stem != "shaken-load"]
SOLVERS = MDR(points=600, steps=20), BEM(points=32, steps=20)
ROUGH = SelfAffine(hurst=0.5, rms_height=1e-6, longest=2e-3, shortest=5e-4, seed=2)
RUBBED = replace(ORDINARY, interface=Coulomb(coefficient=0.3))
WARM = WLF(temperature=306.0, reference=300.0, c1=10.0, c2=100.0)
# One of each motion, body and effect that `rescaled` knows how to take to other units.
SCENES = {
    "sliding": replace(ORDINARY, roughness=ROUGH),
    "at rest": replace(ORDINARY, motion=Indent(depth=1e-4), roughness=ROUGH),
    "rubbed": RUBBED,
    "sheared": replace(RUBBED, motion=Shear(depth=1e-4, displacement=5e-5), roughness=ROUGH),
    "layer": replace(RUBBED, layer=Layer(thickness=1e-3)),
    "heated": replace(RUBBED, temperature=WARM, heating=Heating(conductivity=0.5, feedback="average")),
    "line": replace(ORDINARY, indenter=Cylinder(radius=1e-2), motion=Slide(speed=0.1, line_load=100.0)),
    "plane": replace(ORDINARY, indenter=Plane(), motion=Slide(speed=0.1, pressure=1e3), roughness=ROUGH),
    "program": replace(
        ORDINARY,
        elastomer=StandardLinearSolid(rubbery_modulus=1e6, glassy_modulus=5e6, relaxation_time=1e-2),
        motion=program({"duration": 0.01, "load": 1.0}, {"duration": 0.01, "load": 1.0, "speed": 0.05}),
    ),
}
# Powers of length, modulus of elasticity and time.
UNITS = {
    **dict.fromkeys(("1", "K"), (0, 0, 0)),
    "m": (1, 0, 0),
    "m^2": (2, 0, 0),
    "1/m": (-1, 0, 0),
    "s": (0, 0, 1),
    "m/s": (1, 0, -1),
    "Pa": (0, 1, 0),
    "N": (2, 1, 0),
    "N/m": (1, 1, 0),
    "J": (3, 1, 0),
    "J/m": (2, 1, 0),
}
# Other units that are powers of two: all that changes is the exponent of each number.
LENGTH, MODULUS, TIME = 2.0**3, 2.0**-4, 2.0**5
# What is left of rounding where a solver takes powers or logarithms, and iterates on them.
TOLERANCE = 1e-6
OF_THE_MACHINE = {"seconds", "residual", "operator_applications"}


@cache
def answered():
    """Every ready scene, and one rubbed in sliding, in the solvers that simulate it; histories with instants."""
    scenes = [read(path, Case).scene for path in READY]
    return [result for scene in [*scenes, RUBBED] for result in results(scene)]


def results(scene):
    frames = {"frames": 2} if isinstance(scene.motion, Program) else {}
    return [replace(solver, **frames).solve(scene) for solver in SOLVERS if not solver.refusals(scene)]


def test_every_measure_and_field_has_an_entry_and_every_entry_is_used():
    by_theory = [each.solve(SCENES["sliding"]) for each in THEORIES]
    assert {name for result in [*answered(), *by_theory] for name in result.measures} == set(MEASURES)
    assert {name for result in answered() for name in result.fields} == set(FIELDS)
    assert all(hasattr(result, name) for result in answered() for name in NUMBERS)


def test_every_field_lies_along_its_axes():
    for result in answered():
        for name, values in result.fields.items():
            axes = [axis for axis in FIELDS[name].axes if axis != "y" or "y" in result.fields]
            assert len(axes) == values.ndim
            for axis, size in zip(axes, values.shape, strict=True):
                assert size == result.fields[axis].shape[-1]


@pytest.mark.parametrize("name", SCENES)
@pytest.mark.parametrize("solver", [*SOLVERS, *THEORIES])
def test_a_unit_is_that_by_which_a_number_follows_the_units_of_the_scene(name, solver):
    if solver.refusals(SCENES[name]):
        pytest.skip(f"{solver.name} does not simulate it")
    first, second = (solver.solve(s) for s in (SCENES[name], rescaled(SCENES[name], LENGTH, MODULUS, TIME)))
    numbers = ({n: getattr(result, n) for n in NUMBERS} for result in (first, second))
    assert misfits(SCENES[name], NUMBERS, *numbers) == []
    assert misfits(SCENES[name], MEASURES, first.measures, second.measures) == []
    assert misfits(SCENES[name], FIELDS, first.fields, second.fields) == []


def misfits(scene, entries, first, second):
    """Names of what does not follow the units as its own says."""
    names = [name for name in first if name not in OF_THE_MACHINE]
    return [name for name in names if not _follows(scene, entries[name], first[name], second[name])]


def _follows(scene, entry, first, second):
    i, j, k = UNITS[entry.unit_under(scene.indenter.type)]
    expected = np.asarray(first, float) * LENGTH**i * MODULUS**j * TIME**k
    least = TOLERANCE * np.abs(np.nan_to_num(expected)).max()  # depth may be unknown
    return np.allclose(second, expected, rtol=TOLERANCE, atol=least, equal_nan=True)
