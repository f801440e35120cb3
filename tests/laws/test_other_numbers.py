"""Numbers as other libraries hold them, at every place of the Python API: what they are in SI, or refused by name.

The places are found, not listed: every field of every class, every argument of every function. One that is new and
has no example here fails.
"""

import inspect
from dataclasses import dataclass, fields, is_dataclass, replace
from functools import cache, partial
from typing import Any, get_type_hints

import numpy as np
import pandas
import pytest
import xarray
from maps import noise
from sliding import ORDINARY as SLIDING
from solids import OF_EACH_TYPE

import bem3d
import compare
import mdr1d
import scene
from bem3d import BEM
from compare.figures.style import columns
from compare.library.case import Variations
from compare.solving.curve import Curve
from compare.studies.comparison.sweep import SweepSeries
from compare.studies.mastercurve.study import Mastercurve
from compare.studies.mastercurve.temperatures import Constants
from mdr1d import MDR, equations, estimates
from scene import (
    WLF,
    Arrhenius,
    Cone,
    Coulomb,
    CrossedWaves,
    Cylinder,
    Heating,
    Indent,
    InvalidInput,
    Layer,
    Measured,
    Plane,
    PowerLaw,
    SelfAffine,
    Shear,
    ShiftFactors,
    Slide,
    Spectrum,
    Sphere,
    Stage,
    StandardLinearSolid,
    Table,
    Tabulated,
    Topography,
    Wave,
)
from scene.scene import unit_of

# Each unit in another one, larger or smaller by a power of ten but for degrees; no dimension where there is none.
OTHERS = {
    "m": "mm",
    "m^3": "mm^3",
    "m^4": "mm^4",
    "Pa": "MPa",
    "1/Pa": "1/MPa",
    "s": "ms",
    "m/s": "km/s",
    "N": "mN",
    "N/m": "kN/m",
    "rad": "mrad",
    "Hz": "kHz",
    "rad/s": "rad/ms",
    "rad/m": "rad/mm",
    "K": "mK",
    "W/(m K)": "mW/(m K)",
    "J/mol": "kJ/mol",
    None: "",
}
ROUNDING = 1e-12
HEIGHTS = noise((5, 6), 1)
FREQUENCY, STORAGE, LOSS = (1.0, 10.0, 100.0, 1e3), (1e6, 1.1e6, 2e6, 3e6), (5e4, 3e5, 8e5, 5e5)
PRESSED = {"load": 1.0, "depth": 1e-3, "line_load": 10.0, "pressure": 1e4, "gap": 1e-6}
ROUGH = SelfAffine(hurst=0.5, rms_height=1e-6, longest=1e-3, shortest=1e-4, rolloff=5e-4, seed=2)
WARM = (300.0, 300.0, 300.0, 300.0)
TABLE = Table(FREQUENCY, STORAGE, LOSS, temperature=WARM)
CURVE = Curve(scene=SLIDING, speeds=(0.1, 1.0), values=(0.5, 2.0), levels={}, draws={})
# Valid objects, in which each field that takes a number has one.
OBJECTS = [
    WLF(temperature=310.0, reference=300.0, c1=8.0, c2=100.0),
    Arrhenius(temperature=310.0, reference=300.0, activation_energy=5e4),
    ShiftFactors(temperature=310.0, reference=300.0, temperatures=(300.0, 310.0), a_T=(1.0, 0.1), b_T=(1.0, 1.1)),
    Sphere(1e-2),
    Cone(0.1),
    PowerLaw(3.0, 2.5),
    Cylinder(1e-2),
    Plane(),
    Coulomb(0.3),
    *(solid for solid in OF_EACH_TYPE.values() if not isinstance(solid, Tabulated)),
    Tabulated(table=TABLE, frequency_unit="Hz", kind="shear", equilibrium_modulus=9e5, tolerance=0.5),
    TABLE,
    Table(time=FREQUENCY, modulus=STORAGE[::-1], temperature=WARM),
    Table(time=FREQUENCY, compliance=(1e-6, 2e-6, 3e-6, 4e-6), temperature=WARM),
    Heating(conductivity=20.0),
    Layer(thickness=1e-2),
    *(Indent(**{name: value}) for name, value in PRESSED.items()),
    *(Slide(speed=0.1, **{name: value}) for name, value in PRESSED.items()),
    *(Shear(displacement=1e-6, **{name: value}) for name, value in PRESSED.items()),
    *(
        Stage(duration=1.0, speed=0.1, **{name: PRESSED[name]})
        for name in ("load", "depth", "line_load", "pressure")
    ),
    ROUGH,
    *(
        Spectrum(q=(1e3, 1e4, 1e5), convention="jacobs", longest_kept=5e-3, shortest_kept=1e-4, seed=2, **density)
        for density in ({"C2D": (1e-18, 1e-20, 1e-24)}, {"C1D": (1e-14, 1e-15, 1e-18), "sides": "two"})
    ),
    Wave(amplitude=1e-6, wavelength=1e-3),
    CrossedWaves(amplitude=1e-6, wavelength=1e-3),
    Topography(heights=HEIGHTS, pixel=1e-3, shortest_kept=3e-3, seed=1),
    Measured(heights=HEIGHTS, pixel=1e-3, shortest_kept=3e-3),
    MDR(points=100, extent=1e-2, steps=5, frames=2),
    BEM(points=32, extent=1e-2, tolerance=1e-4, threads=1, steps=5, frames=2),
    Variations(
        speeds=(0.1, 1.0), pressing=(0.5, 2.0), load_speeds=(0.1,), depths=(1.0, 2.0), surfaces=2, profiles=3
    ),
    compare.CorrectedMDR(profiles=3),
    compare.Persson(gamma=0.5),
    CURVE,
    compare.Claim("a", "A", expected=1.0, tolerance=0.1),
    compare.Finding(compare.Claim("a", "A"), value=1.0, scatter=(0.5, 1.5), grid=0.1),
]
# Fields whose unit follows from other fields, that have no unit, or whose unit is no part of a type.
UNITS = {
    (PowerLaw, "coefficient"): None,
    (Table, "frequency"): None,
    (Curve, "speeds"): "m/s",
    (Curve, "values"): "N",
}
# What solvers make and hand over, and what holds no numbers itself.
MADE = {
    "Heights",
    "Doubt",
    "Plan",
    "Regime",
    "Result",
    "Contact",
    "Grid",
    "Modes",
    "Profile",
    "Surface",
    "WarmStart",
    "Report",
    "SceneTask",
}
WITHOUT = {"Scene", "Case", "Program", "Plane"}
# Tested below, with the fields that they need in addition.
APART = {
    "Shear.force",
    "Stage.amplitude",
    "Stage.frequency",
    "Curve.draws",
    "Finding.drawn",
    "Finding.parts",
}


@dataclass(frozen=True)
class Place:
    """One place that takes a number, or numbers.

    take : with what is given there, returns what came of it
    value : a plain number or a tuple, in SI
    unit : of SI; None without one
    """

    name: str
    take: Any
    value: Any
    unit: str | None = None

    @property
    def whole(self):
        return isinstance(self.value, int)


def numeric(value):
    several = isinstance(value, tuple) and value and not isinstance(value[0], str)
    return all(map(numeric, value)) if several else isinstance(value, int | float) and not isinstance(value, bool)


def unit_at(cls, name):
    if (cls, name) in UNITS:
        return UNITS[cls, name]
    return unit_of(cls, name) if hasattr(cls, "__pydantic_fields__") else None


def fields_of(thing):
    """Places of an object: its fields that hold numbers."""

    def take(given, name):
        return getattr(replace(thing, **{name: given}), name)

    cls = type(thing)
    values = {each.name: getattr(thing, each.name) for each in fields(thing) if each.init}
    return [
        Place(f"{cls.__name__}.{name}", partial(take, name=name), value, unit_at(cls, name))
        for name, value in values.items()
        if numeric(value)
    ]


FORMULAS = {
    "load": (1.5, "N"),
    **dict.fromkeys(("modulus", "glassy_modulus", "loss"), (2e6, "Pa")),
    "relaxation_time": (1e-3, "s"),
    "speed": (0.1, "m/s"),
    "conductivity": (20.0, "W/(m K)"),
    **dict.fromkeys(("depth", "lengths", "contact_length", "radius", "displacement", "thickness"), (1e-3, "m")),
    "rms_height": (1e-3, "m"),
    "amplitudes": ((1e-6, 2e-6), "m"),
    "wave_number": (1e4, "rad/m"),
    "wave_numbers": ((1e4, 2e4), "rad/m"),
    "band": ((1e3, 1e4), "rad/m"),
    **dict.fromkeys(("omega", "reference_frequency"), (50.0, "rad/s")),
    **dict.fromkeys(("rms_slope", "xi", "shifted_load", "friction", "c"), (0.2, None)),
    **dict.fromkeys(("n", "alpha"), (1.5, None)),
    **dict.fromkeys(("beta", "poisson_ratio"), (0.3, None)),
    "slopes": ((0.1, 0.3), None),
    "loss_modulus": (lambda omega: 1e3 * omega**0.5, None),
    "spectrum": (lambda q: q**-2.0, None),
}
NOT_NUMBERS = {
    "scene",
    "grid",
    "spectrum",
    "dataset",
    "folder",
    "name",
    "file",
    "size",
    "output",
    "options",
    "baseline",
    "update",
    "models",
    "reference",
    "kind",
    "study",
    "scheduler",
    "executor",
    "report",
    "yes",
    "progress",
    "form",
}


def arguments_of(function, label, examples, **stated):
    """Places of a function: its arguments that have an example, the others as stated or as they are by default."""
    parameters = inspect.signature(function).parameters
    own = {name: examples[name] for name in parameters if name in examples and name not in stated}
    unknown = parameters.keys() - own.keys() - stated.keys() - NOT_NUMBERS
    assert not unknown, f"{label} takes {unknown}: give examples"
    plain = {name: value for name, (value, _) in own.items()}

    def take(given, name):
        return function(**{**plain, **stated, name: given})

    return [
        Place(f"{label}({name})", partial(take, name=name), value, unit)
        for name, (value, unit) in own.items()
        if not callable(value)
    ]


def formulas():
    for module in (equations, estimates):
        for name, function in inspect.getmembers(module, inspect.isfunction):
            if function.__module__ == module.__name__ and not name.startswith("_") and name != "temperature_rise":
                words = {"base": "half-space"} if "base" in inspect.signature(function).parameters else {}
                yield from arguments_of(function, f"{module.__name__}.{name}", FORMULAS, **words)


def drawn(given):
    return mdr1d.draw(ROUGH, nodes=given).heights


LINE = {"heights": tuple(50.0 * np.linspace(-1e-3, 1e-3, 6) ** 2), "pixel": 4e-4, "depth": 2e-5}
MODES = mdr1d.modes_of(StandardLinearSolid(1e6, 2e6, 1e-3))


def laid_out(points=100, extent=1e-2):
    return mdr1d.lay_out(SLIDING, points, extent).pixel


def swept(**given):
    return mdr1d.sweep(**{**LINE, "memory": 1e-4} | given).displacement


def swept_in_modes(**given):
    return mdr1d.sweep_modes(**{**LINE, "modes": MODES, "speed": 0.1} | given).displacement


def asked(**given):
    sweep = SweepSeries.of(SLIDING, **({"speed": (0.1, 0.2)} | given))
    return *sweep.speeds, *sweep.values, sweep.draws


def by_accuracy(**given):
    def check(solver, scene, wanted):
        raise InterruptedError(wanted)

    with pytest.MonkeyPatch.context() as patched:
        patched.setattr("bem3d.accuracy._check", check)
        with pytest.raises(InterruptedError) as asked:
            bem3d.for_accuracy(SLIDING, **given)
    return asked.value.args[0]


LOADS, SPEEDS = (each.ravel() for each in np.meshgrid(np.geomspace(1, 16, 5), (0.1, 0.2, 0.4)))
FRICTION = {"mu": 0.3 / (1 + LOADS / SPEEDS / 10), "F_N": LOADS, "v": SPEEDS}


def shifted(**given):
    stated = {"c1": 8.86, "c2": 101.6, "reference": 293.15} | given
    return Constants(**stated).shifts(np.array([310.0]))[0]


@cache
def coarse():
    solver = BEM(points=16, tolerance=1e-2)
    return solver, solver.solve(replace(SLIDING, motion=Indent(load=1.0)))


def refined(given):
    return bem3d.refined(*coarse(), times=given).measures["pixel"]


def pressed(**given):
    """Greatest pressure on a wave that is pressed flat."""
    wave = 1e-6 * np.cos(np.pi * np.arange(16) / 8) * np.ones((16, 1))
    stated = {"pixel": 1e-6, "modulus": 1e6, "pressure": 1e5} | given
    return bem3d.press(wave, **stated).fields["pressure"].max()


def called(label, function, **numbers):
    """Places of a function that is called with one of its numbers; each is a value and its unit."""
    return [
        Place(f"{label}({name})", lambda given, name=name: function(**{name: given}), value, *unit)
        for name, (value, *unit) in numbers.items()
    ]


SWEPT = {"heights": ((1e-5, 0.0, 1e-5), "m"), "pixel": (4e-4, "m"), "depth": (2e-5, "m")}
CALLED = [
    *called("mdr1d.sweep", swept, **SWEPT, memory=(1e-4, "m")),
    *called("mdr1d.sweep_modes", swept_in_modes, **SWEPT, speed=(0.1, "m/s")),
    Place("mdr1d.draw(nodes)", drawn, 64),
    Place("mdr1d.amplitudes(bandwidth)", lambda given: mdr1d.amplitudes(ROUGH, given), 10.0),
    *called("mdr1d.lay_out", laid_out, points=(100,), extent=(1e-2, "m")),
    Place("bem3d.refined(times)", refined, 2),
    *called("bem3d.for_accuracy", by_accuracy, friction=(0.1,), depth=(0.1,)),
    *called("bem3d.press", pressed, pixel=(1e-6, "m"), modulus=(1e6, "Pa"), pressure=(1e5, "Pa")),
    *called("compare.sweep", asked, speed=((0.1, 0.3), "m/s"), load=((0.1, 0.3), "N"), draws=(2,)),
    *called("compare.sweep", asked, depth=((1e-5, 2e-5), "m")),
    Place("compare.export(width)", lambda given: columns("default", given)[0], 0.1, "m"),
    Place("compare.sweep(interval)", lambda given: SweepSeries.of(SLIDING, (0.1,), interval=given).interval, 0.1),
    Place("compare.mastercurve(tolerance)", lambda given: Mastercurve.of(FRICTION, given).tolerance, 0.1),
    *called("compare.mastercurve", shifted, c1=(8.0,), c2=(100.0, "K"), reference=(300.0, "K")),
]
PLACES = [
    *(place for thing in OBJECTS for place in fields_of(thing)),
    *formulas(),
    *CALLED,
]
GROUPS: dict[str, list[Place]] = {}
for each in PLACES:
    GROUPS.setdefault(each.name.partition("(")[0].rpartition(".")[0], []).append(each)
everywhere = pytest.mark.parametrize("places", GROUPS.values(), ids=GROUPS)


@pytest.fixture(scope="module")
def quantity():
    import pint

    registry = pint.UnitRegistry()
    return lambda value, unit: registry.Quantity(np.asarray(value, float)[()] if unit else value, unit or "")


def same(one, other):
    if isinstance(one, dict):
        return one == pytest.approx(other, rel=ROUNDING)
    return np.allclose(np.asarray(one), np.asarray(other), rtol=ROUNDING, atol=0)


def scaled(value, place, quantity):
    """A value in SI as a quantity in the other unit."""
    if place.unit is None:
        return quantity(value, None)
    return quantity(value, place.unit.replace("(m K)", "m/K")).to(OTHERS[place.unit].replace("(m K)", "m/K"))


def refused(place, given):
    """Message of a refusal, which names the place."""
    with pytest.raises(ValueError) as raised:  # noqa: PT011
        place.take(given)
    name = place.name.rpartition("(")[2].rstrip(")").rpartition(".")[2]
    assert name in str(raised.value), f"{place.name}: {raised.value}"
    return str(raised.value)


def test_every_class_has_an_example_of_each_number():
    held = {(type(thing), name) for thing in OBJECTS for name in (each.name for each in fields(thing))}
    for package in (scene, mdr1d, bem3d, compare):
        for name in set(package.__all__) - MADE - WITHOUT:
            cls = getattr(package, name)
            if not (inspect.isclass(cls) and is_dataclass(cls)):
                continue
            for each in fields(cls):
                hint = str(get_type_hints(cls)[each.name])
                if not ("float" in hint or "int" in hint):
                    continue
                assert (cls, each.name) in held, f"{name}.{each.name} has no example"
                examples = [getattr(thing, each.name) for thing in OBJECTS if type(thing) is cls]
                assert any(map(numeric, examples)) or f"{name}.{each.name}" in APART, f"{name}.{each.name}"


def test_every_argument_is_known():
    known = {place.name.partition("(")[0].rpartition(".")[2] for place in CALLED} | {
        "heights",
        "verify",
        "topography",
    }
    for package in (mdr1d, bem3d, compare):
        for name in package.__all__:
            function = getattr(package, name)
            if inspect.isfunction(function) and name not in known:
                taken = set(inspect.signature(function).parameters)
                assert taken <= NOT_NUMBERS | {"workers", "interval"}, name


def alike(place, quantity):
    """The value of a place in another unit, and as other libraries hold it."""
    other = scaled(place.value, place, quantity)
    if not isinstance(place.value, tuple):
        cast = np.int32 if place.whole else np.float64
        return other, cast(place.value), np.array(place.value), xarray.DataArray(place.value)
    unit = {} if place.unit is None else {"units": OTHERS[place.unit]}
    listed = pandas.Series(other.magnitude, index=range(5, 5 + len(place.value)))
    listed.attrs.update(unit)
    return (
        *(other, [scaled(each, place, quantity) for each in place.value]),
        *(list(place.value), np.array(place.value), list(map(np.float64, place.value))),
        *(xarray.DataArray(other.magnitude, dims="k", attrs=unit), listed),
        np.ma.masked_invalid(np.array(place.value)),
    )


@everywhere
def test_a_number_in_another_unit_or_of_another_library_is_the_plain_number(places, quantity):
    for place in places:
        plain = place.take(place.value)
        for each in alike(place, quantity):
            assert same(place.take(each), plain), f"{place.name}: {each!r}"


@everywhere
def test_what_has_another_dimension_is_refused_by_name(places, quantity):
    for place in places:
        message = refused(place, quantity(place.value, "kg"))
        assert "kg" in message or "whole number" in message or "integer" in message, place.name
        if isinstance(place.value, tuple):
            refused(place, xarray.DataArray(list(place.value), dims="k", attrs={"units": "kg"}))


@everywhere
def test_a_truth_a_duration_of_numpy_and_an_imaginary_number_are_no_numbers(places):
    for place in places:
        for wrong in (True, np.True_, np.array(True), 1j, np.timedelta64(1, "s"), "wide"):
            others = place.value[1:] if isinstance(place.value, tuple) else ()
            refused(place, wrong)
            if others:
                refused(place, [wrong, *others])
                refused(place, np.ma.masked_equal(place.value, place.value[0]))


def test_what_depends_on_others_takes_their_unit(quantity):
    for written in (quantity, "{} {}".format):
        assert Shear(load=1.0, force=written(3.0, "mN")).force == 3e-3
        assert Shear(line_load=1.0, force=written(3.0, "N/mm")).force == 3e3
        swung = {"duration": written(1.0, "min"), "frequency": written(2.0, "kHz")}
        stage = Stage(depth=1e-3, amplitude=written(2.0, "um"), **swung)
        assert (stage.amplitude, stage.duration, stage.frequency) == (2e-6, 60.0, 2e3)
        assert Stage(load=1.0, amplitude=written(300.0, "mN"), **swung).amplitude == 0.3
        with pytest.raises(InvalidInput, match="amplitude"):
            Stage(amplitude=written(1.0, "N"), **swung)
        with pytest.raises(InvalidInput, match="force"):
            Shear(line_load=1.0, force=written(3.0, "N"))
    with pytest.raises(InvalidInput, match=r"a number \(in m\^\(1-exponent\)\)"):
        PowerLaw("3 1/m", 2.0)
    for wrong in (quantity(1.0, "m"), "1 m", True, np.True_, [1.0]):
        with pytest.raises(ValueError, match="force"):
            Shear(load=1.0, force=wrong)
        with pytest.raises(ValueError, match="amplitude"):
            Stage(load=1.0, amplitude=wrong, **swung)
