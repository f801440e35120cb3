"""Input that is a mistake: NaN, infinities, negative numbers and zero in every field, contradictions, files."""

import tempfile
from dataclasses import fields, replace
from pathlib import Path

import numpy as np

from scene import (
    Cylinder,
    Elastic,
    Fractional,
    Indent,
    Plane,
    PowerLaw,
    Prony,
    Refused,
    Scene,
    Slide,
    Sphere,
    Wave,
    read_table,
)
from scene.reading import InvalidInput, read

from .hardcase import Check, Group, invalid, refusal
from .ordinary import CONE, ELASTIC, KELVIN, ROUGH, SOLID, SPHERE, resting
from .solvers import line, space

FRACTIONAL = Fractional(
    modulus=1e6, relaxation_time=1e-3, exponent=0.5, lowest_frequency=1e-2, highest_frequency=1e4
)
POWER, LOADED, SLID = PowerLaw(coefficient=50.0, exponent=2.0), Indent(load=1.0), Slide(speed=1.0, depth=1e-4)
PARTS = (SPHERE, CONE, POWER, ELASTIC, KELVIN, SOLID, FRACTIONAL, LOADED, SLID, ROUGH)
FILE = """
[indenter]
type = "sphere"
radius = -1.0
[elastomer]
type = "kelvin"
modulus = nan
[motion]
type = "slide"
speed = "fast"
load = 1.0
depht = 2.0
"""
FINITE = "Refused: the error names the field, the value and that it must be finite."
CASES = case = Group("mistakes")


def in_every_field(value, said, but=()):
    """Parts with this value in place of each real number, one field at a time, except some."""
    places = [(part, field.name) for part in PARTS for field in fields(part)]
    real = [(part, name) for part, name in places if isinstance(getattr(part, name), float) and name not in but]
    return lambda size: [
        invalid(f"{type(part).__name__}.{name} = {value:g}", f"{name}{said}", replace, part, **{name: value})
        for part, name in real
    ]


case.add(
    "nan",
    "NaN in every real field of every part of a scene.",
    FINITE,
    in_every_field(float("nan"), " | finite number | nan"),
)
case.add(
    "infinite",
    "Plus and minus infinity in every real field.",
    FINITE,
    in_every_field(float("inf"), " | finite number | inf"),
    in_every_field(-float("inf"), " | finite number | -inf"),
)
case.add(
    "negative",
    "-1 in every real field but Poisson's ratio.",
    "Refused: the error names the field.",
    in_every_field(-1.0, "", but={"poisson_ratio"}),
)
case.add(
    "zero",
    "0 in every real field that must not be zero.",
    "Refused: the error names the field and that it must be greater.",
    in_every_field(0.0, " | greater than", but={"hurst", "rms_height", "speed", "poisson_ratio"}),
)


@case(
    "Words, truth values, complex numbers, nothing, lists and arrays for a number; numpy's scalars.",
    "Refused by field and kind; numpy's scalars are taken as they are.",
)
def no_numbers(size):
    for value in ("1e6", True, 1 + 0j, None, [1.0], np.array([1.0, 2.0])):
        for kind, name in ((Elastic, "modulus"), (Sphere, "radius")):
            what = f"{kind.__name__}({name}={value!r})"
            yield invalid(what, f"{name} | Input should be", kind, **{name: value})
    for number in (np.float32(1e6), np.int64(1_000_000), 1_000_000):
        yield Check(f"{type(number).__name__} as a modulus", abs(Elastic(number).modulus - 1e6), 0.0)


@case(
    "Both load and depth, or neither, wavelengths out of order, unknown names, moduli without times.",
    "Refused: each error names the fields and values that contradict each other.",
)
def contradictions(size):
    both = {"load": 1.0, "depth": 1e-4}
    glass = "glassy_modulus = 1 | must exceed | rubbery_modulus"
    frequencies = "highest_frequency = 10000 | exceed lowest_frequency = 100000"
    times = "relaxation_times has 1 | moduli has 2"
    yield invalid("no load, no depth", "none given | exactly one | load [N] | depth [m]", Indent)
    yield invalid("load and depth", "load = 1 | depth = 0.0001 | exactly one", Slide, speed=1.0, **both)
    yield invalid("a backward speed", "speed | -1", Slide, speed=-1.0, load=1.0)
    yield invalid("shortest beyond longest", "shortest = 1 | longest", replace, ROUGH, shortest=1.0)
    yield invalid("a roll-off beyond longest", "rolloff = 1 | longest", replace, ROUGH, rolloff=1.0)
    yield invalid("H = 1.1", "hurst | 1.1 | less than or equal to 1", replace, ROUGH, hurst=1.1)
    yield invalid("a seed of -1", "seed | -1", replace, ROUGH, seed=-1)
    yield invalid("a seed of 1/2", "seed | 0.5 | integer", replace, ROUGH, seed=0.5)
    yield invalid("an unknown field", "colour | Unexpected", Elastic, modulus=1e6, colour=3.0)
    yield invalid("glass below rubber", glass, replace, SOLID, glassy_modulus=1.0)
    yield invalid("moduli without times", times, Prony, 1e6, (1e6, 1e6), (1.0,))
    yield invalid("no moduli", "moduli | at least 1", Prony, 1e6, moduli=(), relaxation_times=())
    yield invalid("frequencies in no order", frequencies, replace, FRACTIONAL, lowest_frequency=1e5)


@case(
    "Planes, cylinders and waves in 1D, rough cylinders in 3D.",
    "Refused before anything is solved, by the name of what is lacking.",
)
def not_for_this_solver(size):
    plane = Scene(Plane(), SOLID, Indent(pressure=1e4), ROUGH)
    cylinder = Scene(Cylinder(1e-2), SOLID, Indent(line_load=1e3))
    wave, rough = resting(roughness=Wave(amplitude=1e-6, wavelength=1e-3)), replace(cylinder, roughness=ROUGH)
    in_1d, in_3d = line(size).solve, space(size).solve
    yield refusal("MDR: a plane", Refused, "Plane | no body of revolution", in_1d, plane)
    yield refusal("MDR: a cylinder", Refused, "Cylinder | no body of revolution", in_1d, cylinder)
    yield refusal("MDR: one wave", Refused, "Wave | not isotropic", in_1d, wave)
    yield refusal("BEM: a rough cylinder", Refused, "rough Cylinder | Sphere or a Plane", in_3d, rough)
    yield refusal("BEM: a plane on an extent", Refused, "extent | period", in_3d, plane)


@case(
    "Scene files with several mistakes, tables with words, commas, zeros, nan and nothing.",
    "Refused: every mistake by its place in the file, its value and what is allowed.",
)
def files_with_mistakes(size):
    five = "indenter.radius = -1.0 | elastomer.modulus = nan | relaxation_time: missing | motion.speed | depht"
    scene, table = lambda path: read(path, Scene), read_table
    files = {
        "a scene with five mistakes": (scene, FILE, five),
        "a scene cut off": (scene, "[indenter\n", "scene.toml | not valid TOML"),
        "a table of words": (
            table,
            "frequency storage loss\n1 2 3\n1 2 x\n",
            "line 3 | column 3 | 'x' is not a number",
        ),
        "a table with decimal commas": (table, "1,5;2,5;3,5\n", "1 frequencies | at least 4"),
        "a table with zero": (table, "1 1 1\n2 0 1\n", "line 2 | storage = 0 | greater than 0"),
        "a table with nan": (table, "1 1 1\n2 nan 1\n", "1 frequencies | at least 4"),
        "an empty table": (table, "# nothing\n", "no row of numbers"),
    }
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "scene.toml"
        for what, (ask, content, words) in files.items():
            path.write_text(content, encoding="utf-8")
            yield refusal(what, InvalidInput if ask is scene else ValueError, words, ask, path)
