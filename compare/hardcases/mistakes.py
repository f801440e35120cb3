"""Input that is a mistake: NaN, infinities, negative numbers and zero in every field, contradictions, files."""

import tempfile
from collections.abc import Iterator
from dataclasses import fields, is_dataclass, replace
from functools import partial
from pathlib import Path

import numpy as np
from pydantic import ValidationError

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

from .hardcase import Check, Group, refusal
from .ordinary import (
    CONE,
    ELASTIC,
    KELVIN,
    ROUGH,
    SOLID,
    SPHERE,
    line,
    resting,
    space,
)

POWER = PowerLaw(coefficient=50.0, exponent=2.0)
FRACTIONAL = Fractional(
    modulus=1e6, relaxation_time=1e-3, exponent=0.5, lowest_frequency=1e-2, highest_frequency=1e4
)
PARTS = (
    SPHERE,
    CONE,
    POWER,
    ELASTIC,
    KELVIN,
    SOLID,
    FRACTIONAL,
    Indent(load=1.0),
    Slide(speed=1.0, depth=1e-4),
    ROUGH,
)
CASES = case = Group("mistakes")


def _numbers(part) -> Iterator[str]:
    """Names of the fields of a part that hold a real number."""
    assert is_dataclass(part)
    return (field.name for field in fields(part) if isinstance(getattr(part, field.name), float))


def _in_every_field(size, value, said):
    for part in PARTS:
        for name in _numbers(part):
            ask, names = partial(replace, part, **{name: value}), (name, *said)
            yield refusal(f"{type(part).__name__}.{name} = {value}", ValidationError, names, ask)


@case(
    "NaN in every real field of every part of a scene.",
    "Refused: the error names the field, the value and that it must be finite.",
)
def nan(size):
    return _in_every_field(size, float("nan"), ("finite number", "nan"))


@case(
    "Plus and minus infinity in every real field.",
    "Refused: the error names the field, the value and that it must be finite.",
)
def infinite(size):
    yield from _in_every_field(size, float("inf"), ("finite number", "inf"))
    yield from _in_every_field(size, -float("inf"), ("finite number", "-inf"))


@case(
    "-1 in every real field but Poisson's ratio.",
    "Refused: the error names the field.",
)
def negative(size):
    for refused in _in_every_field(size, -1.0, ()):
        # The only number that may be negative is one of Poisson's.
        if ".poisson_ratio" not in refused.what:
            yield refused


@case(
    "0 in every real field that must not be zero.",
    "Refused: the error names the field and that it must be greater.",
)
def zero(size):
    may = {"hurst", "rms_height", "speed", "poisson_ratio"}
    for part in PARTS:
        for name in set(_numbers(part)) - may:
            ask, names = partial(replace, part, **{name: 0.0}), (name, "greater than")
            yield refusal(f"{type(part).__name__}.{name} = 0", ValidationError, names, ask)


@case(
    "Words, truth values, complex numbers, nothing, lists and arrays for a number; numpy's scalars.",
    "Refused by field and kind; numpy's scalars are taken as they are.",
)
def no_numbers(size):
    for value in ("1e6", True, 1 + 0j, None, [1.0], np.array([1.0, 2.0])):
        for kind in (Elastic, Sphere):
            name = next(iter(fields(kind))).name
            ask = partial(kind, **{name: value})
            yield refusal(f"{kind.__name__}({name}={value!r})", ValidationError, (name, "Input should be"), ask)
    for number in (np.float32(1e6), np.int64(1_000_000), 1_000_000):
        yield Check(f"{type(number).__name__} as a modulus", abs(Elastic(number).modulus - 1e6), 0.0)


@case(
    "Both load and depth, or neither, wavelengths out of order, unknown names, moduli without times.",
    "Refused: each error names the fields and values that contradict each other.",
)
def contradictions(size):
    asks = {
        "no load, no depth": (partial(Indent), ("none given", "exactly one", "load [N]", "depth [m]")),
        "load and depth": (
            partial(Slide, speed=1.0, load=1.0, depth=1e-4),
            ("load = 1", "depth = 0.0001", "exactly one"),
        ),
        "a backward speed": (partial(Slide, speed=-1.0, load=1.0), ("speed", "-1")),
        "shortest beyond longest": (partial(replace, ROUGH, shortest=1.0), ("shortest = 1", "longest")),
        "a roll-off beyond longest": (partial(replace, ROUGH, rolloff=1.0), ("rolloff = 1", "longest")),
        "H = 1.1": (partial(replace, ROUGH, hurst=1.1), ("hurst", "1.1", "less than or equal to 1")),
        "a seed of -1": (partial(replace, ROUGH, seed=-1), ("seed", "-1")),
        "a seed of 1/2": (partial(replace, ROUGH, seed=0.5), ("seed", "0.5", "integer")),
        "an unknown field": (partial(Elastic, modulus=1e6, colour=3.0), ("colour", "Unexpected")),
        "glass below rubber": (
            partial(replace, SOLID, glassy_modulus=1.0),
            ("glassy_modulus = 1", "must exceed", "rubbery_modulus"),
        ),
        "moduli without times": (
            partial(Prony, 1e6, (1e6, 1e6), (1.0,)),
            ("relaxation_times has 1", "moduli has 2"),
        ),
        "no moduli": (
            partial(Prony, equilibrium_modulus=1e6, moduli=(), relaxation_times=()),
            ("moduli", "at least 1"),
        ),
        "frequencies in no order": (
            partial(replace, FRACTIONAL, lowest_frequency=1e5),
            ("highest_frequency = 10000", "exceed lowest_frequency = 100000"),
        ),
    }
    for what, (ask, names) in asks.items():
        yield refusal(what, ValidationError, names, ask)


@case(
    "Planes, cylinders and waves in 1D, rough cylinders in 3D.",
    "Refused before anything is solved, by the name of what is lacking.",
)
def not_for_this_solver(size):
    plane = Scene(Plane(), SOLID, Indent(pressure=1e4), ROUGH)
    cylinder = Scene(Cylinder(1e-2), SOLID, Indent(line_load=1e3))
    wave = resting(roughness=Wave(amplitude=1e-6, wavelength=1e-3))
    asks = {
        "MDR: a plane": (line(size), plane, ("Plane", "no body of revolution")),
        "MDR: a cylinder": (line(size), cylinder, ("Cylinder", "no body of revolution")),
        "MDR: one wave": (line(size), wave, ("Wave", "not isotropic")),
        "BEM: a rough cylinder": (
            space(size),
            replace(cylinder, roughness=ROUGH),
            ("rough Cylinder", "Sphere or a Plane"),
        ),
        "BEM: a plane on an extent": (space(size), plane, ("extent", "period")),
    }
    for what, (solver, scene, names) in asks.items():
        yield refusal(what, Refused, names, partial(solver.solve, scene))


@case(
    "Scene files with several mistakes, tables with words, commas, zeros, nan and nothing.",
    "Refused: every mistake by its place in the file, its value and what is allowed.",
)
def files_with_mistakes(size):
    """Every mistake of a file at once, by its place."""
    scene = (
        '[indenter]\ntype = "sphere"\nradius = -1.0\n[elastomer]\ntype = "kelvin"\nmodulus = nan\n'
        '[motion]\ntype = "slide"\nspeed = "fast"\nload = 1.0\ndepht = 2.0\n'
    )
    tables = {
        "a table of words": ("frequency storage loss\n1 2 none\n", ("line 2", "loss = 'none'", "not a number")),
        "a table with decimal commas": ("1,5;2,5;3,5\n", ("line 1", "6 columns", "decimal points")),
        "a table with zero": ("1 1 1\n2 0 1\n", ("line 2", "storage = 0", "greater than 0")),
        "a table with nan": ("1 1 1\n2 nan 1\n", ("line 2", "storage = nan", "finite")),
        "an empty table": ("# nothing\n", ("0 frequencies", "at least 4")),
    }
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "scene.toml"
        path.write_text(scene, encoding="utf-8")
        names = (
            "indenter.radius = -1.0",
            "elastomer.modulus = nan",
            "relaxation_time: missing",
            "motion.speed",
            "depht",
        )
        yield refusal("a scene with five mistakes", InvalidInput, names, partial(read, path, Scene))
        path.write_text("[indenter\n", encoding="utf-8")
        yield refusal(
            "a scene cut off", InvalidInput, ("scene.toml", "not valid TOML"), partial(read, path, Scene)
        )
        for what, (content, names) in tables.items():
            path.write_text(content, encoding="utf-8")
            yield refusal(what, ValueError, names, partial(read_table, path))
