"""Doubts about a scene: each number beyond its limit, none within, and no scene that breaks the list."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from changing_motion import program
from solids import gel

from compare.library.lookup import case_of
from compare.library.ready import ready
from scene import (
    WLF,
    Arrhenius,
    Cone,
    Coulomb,
    CrossedWaves,
    Cylinder,
    Doubt,
    Elastic,
    Heating,
    Indent,
    Kelvin,
    Layer,
    Measured,
    Plane,
    PowerLaw,
    Program,
    Scene,
    SelfAffine,
    Shear,
    Slide,
    Spectrum,
    Sphere,
    Stage,
    StandardLinearSolid,
    Table,
    Tabulated,
    Topography,
    Wave,
    doubts,
    notes,
)
from scene.doubt import ABOVE, BELOW, LIMITS, OPEN, beyond_linear, beyond_table, unseen
from scene.scales import elastic_contact
from scene.surfaces.heightmap import HeightMap

RUBBER = StandardLinearSolid(rubbery_modulus=1e6, glassy_modulus=1e8, relaxation_time=1e-3)
ROUGH = SelfAffine(hurst=0.8, rms_height=2e-5, longest=1e-2, shortest=1e-3)
LAW = Arrhenius(temperature=300, reference=290, activation_energy=6e4)
WILLIAMS = WLF(temperature=300, reference=299.99, c1=17.44, c2=51.6)
BASE = Scene(
    Sphere(radius=1e-2),
    RUBBER,
    Slide(speed=0.1, load=1.0),
    ROUGH,
    layer=Layer(thickness=1e-2),
    temperature=LAW,
    heating=Heating(conductivity=0.2),
    interface=Coulomb(coefficient=0.3),
)
WAVES = np.sin(2 * np.pi * np.arange(64) / 16)
GROOVES = 1e-6 * (WAVES[:, None] + 0.05 * WAVES[None, :])  # heights vary along y
SPIKE = 1e-6 * WAVES[:, None] * WAVES[None, :]
SPIKE[20, 30] = 1e-3


NARROW = {"roughness": Spectrum(q=[1e3, 1e5], C2D=[1e-21, 1e-28], convention="persson")}
# Of a part and its field: a value below the lower limit and one above the upper.
ENDS = [
    ("temperature", "activation_energy", 60, 6e6),
    ("temperature", "c1", 0.0174, 1744.0),
    ("temperature", "c2", 0.0516, 51.6e3),
    ("indenter", "radius", 1e-10, 12.7),
    ("layer", "thickness", 1e-10, 10),
    ("heating", "conductivity", 2e-4, 2e5),
]
# By the number and its end: what breaks the limit.
BEYOND = {
    (f"scene.{part}.{field}", most): {part: replace(thing, **{field: value})}
    for part, field, *ends in ENDS
    for thing in (getattr(BASE, part), WILLIAMS)
    if hasattr(thing, field)
    for most, value in enumerate(ends)
} | {
    ("decades_below", True): {"elastomer": gel(1e8)},
    ("decades_above", True): {"elastomer": gel(1e-4)},
    ("rest_width", True): {"elastomer": gel(1.0), "motion": Indent(load=1.0)},
    ("scene.temperature.temperature", False): {"temperature": replace(LAW, temperature=20, reference=25)},
    ("scene.temperature.temperature", True): {"temperature": replace(LAW, temperature=3e4)},
    ("scene.temperature.reference", False): {"temperature": replace(LAW, temperature=20, reference=25)},
    ("scene.temperature.reference", True): {"temperature": replace(LAW, reference=3e4)},
    ("scene.solid.static_modulus", False): {"elastomer": Kelvin(1.0, 1e-3)},
    ("scene.solid.static_modulus", True): {"elastomer": Elastic(1e12)},
    ("modulus_at_the_instant", True): {"elastomer": replace(RUBBER, glassy_modulus=1e12)},
    ("scene.roughness.period", True): {"roughness": replace(ROUGH, longest=10.0)},
    ("shortest", False): {"roughness": replace(ROUGH, shortest=1e-10)},
    ("rms_height", False): {"roughness": replace(ROUGH, rms_height=1e-11)},
    ("scene.interface.coefficient", True): {"interface": Coulomb(coefficient=300)},
    ("mach", True): {"motion": Slide(speed=1e5, load=1.0)},
    ("contact.radius", True): {"indenter": Cone(1e-3), "motion": Slide(speed=0.1, depth=0.01)},
    ("contact.radius", False): {"motion": Slide(speed=0.1, load=1e-19)},
    ("contact.depth", False): {"motion": Slide(speed=0.1, depth=1e-11)},
    ("edge_slope", True): {"motion": Slide(speed=0.1, load=100.0)},
    ("edge_slope", False): {"indenter": Cone(1e-6)},
    ("rms_slope", True): {"roughness": replace(ROUGH, rms_height=1e-3)},
    ("rms_slope", False): {"roughness": replace(ROUGH, rms_height=1e-9)},
    ("height_left_out", True): NARROW,
    ("slope_left_out", True): NARROW,
    ("height_over_depth", True): {"roughness": replace(ROUGH, rms_height=2e-4)},
    ("anisotropy", True): {"roughness": Topography(heights=GROOVES, pixel=1e-5, repeat="periodic")},
    ("spike", True): {"roughness": Topography(heights=SPIKE, pixel=1e-4)},
    ("depth_over_thickness", True): {"motion": Slide(speed=0.1, depth=5e-4), "layer": Layer(thickness=1e-3)},
    ("pressure_over_modulus", True): {"indenter": Plane(), "motion": Slide(speed=0.1, pressure=1e8)},
    ("stiffening", True): {"elastomer": Kelvin(1e6, 1e3)},
    ("loss", False): {"elastomer": replace(RUBBER, relaxation_time=1e-12)},
}


def named(scene):
    return {(each.name, each.number > each.limit): each for each in doubts(scene)}


def test_ordinary_numbers_are_not_doubted():
    assert doubts(BASE) == ()


@pytest.mark.parametrize("limit", LIMITS, ids=lambda limit: f"{limit.number}-{limit.limit:g}")
def test_each_limit_has_a_number_beyond_it_that_is_doubted_with_number_limit_and_reason(limit):
    found = named(replace(BASE, **BEYOND[limit.number, limit.most]))[limit.name, limit.most]
    assert isinstance(found, Doubt)
    assert limit.broken(found.number)
    assert not limit.broken(limit.limit)
    for text in (f"{found.number:.3g}", f"{limit.limit:g}", limit.why, limit.unit):
        assert text in str(found)


@pytest.mark.parametrize("name", [name for name, each in ready().items() if each.kind == "scene"])
def test_of_ready_scenes_that_is_doubted_which_their_departures_or_notes_state(name):
    case = case_of(name)
    stated = " ".join([*case.departures, *case.notes])
    assert [each for each in case.doubts if each.name not in stated] == []


@pytest.mark.parametrize(
    ("changed", "meant"),
    [
        (("scene.temperature.temperature", False), "is 20 degC meant?"),
        (("scene.solid.static_modulus", False), "is 1 MPa meant?"),
        (("scene.indenter.radius", True), "is 12.7 mm meant?"),
        (("scene.temperature.activation_energy", False), "is 60 kJ/mol meant?"),
    ],
)
def test_what_was_probably_meant_is_asked(changed, meant):
    assert meant in [each.meant for each in doubts(replace(BASE, **BEYOND[changed]))]


def test_nothing_is_guessed_that_would_be_doubted_too():
    (found,) = (each for each in doubts(replace(BASE, elastomer=Kelvin(1e-9, 1e-3))) if each.unit == "Pa")
    assert not found.meant


@pytest.mark.parametrize("kind", [Wave, CrossedWaves])
def test_slopes_of_waves_are_those_of_their_cosines(kind):
    steep = replace(BASE, roughness=kind(amplitude=1e-3, wavelength=1e-3))
    assert named(steep)["rms slope of the roughness", True].number == pytest.approx(2 * np.pi / np.sqrt(2))


def test_a_cut_off_by_the_grid_has_the_slope_of_the_grid():
    open_ended = replace(BASE, roughness=replace(ROUGH, hurst=0.1, rms_height=5e-5, shortest=None))
    assert doubts(open_ended) == ()
    (found,) = doubts(open_ended, pixel=1e-6)
    assert found.number == pytest.approx(open_ended.roughness.rms_slope(np.pi / 1e-6))


def test_beyond_a_slope_of_one_nothing_linear_is_left():
    assert beyond_linear(replace(BASE, motion=Slide(speed=0.1, load=100.0))) is None  # 0.57
    found = beyond_linear(replace(BASE, motion=Slide(speed=0.1, load=1e5)))
    assert found.number > 1
    steep = beyond_linear(replace(BASE, roughness=replace(ROUGH, rms_height=1e-3)))
    assert steep.name == "rms slope of the roughness"


BALL = Sphere(1e-2)
CLOSE = 1e-4  # decades


def slid(elastomer, omega, temperature=None, **parts):
    """A sphere that slides so that v over the radius, as stiff as it then is, is this frequency [rad/s]."""
    at_rest = Scene(BALL, elastomer, Indent(load=1.0), temperature=temperature)
    return replace(at_rest, motion=Slide(speed=omega * radius(at_rest, omega), load=1.0), **parts)


def radius(scene, omega):
    """Radius of the contact of an elastic solid of the modulus that this one has at a frequency [rad/s]."""
    modulus = abs(complex(scene.solid.complex_modulus(omega)))
    return elastic_contact(replace(scene, elastomer=Elastic(modulus), temperature=None)).radius


def outside(scene):
    return {each.name: each.number for each in unseen(scene)}


@pytest.mark.parametrize("exponent", [0.05, 0.1, 0.2, 0.3])
@pytest.mark.parametrize(("name", "end", "way"), [(BELOW, 1.0, -1), (ABOVE, 100.0, 1)])
def test_a_contact_outside_its_table_is_doubted_by_how_many_decades_and_what_is_assumed(name, end, way, exponent):
    for decades in (-1.0, 0.0, 0.5, 1.5, 3.0):
        omega = end * 10.0 ** (way * decades)
        scene = slid(gel(1.0, exponent), omega)
        found = {each.name: each for each in doubts(scene)}
        if decades <= 0:
            assert not {BELOW, ABOVE, OPEN} & set(found)
            continue
        assert found[name].number == pytest.approx(decades, abs=CLOSE)
        assert doubts(scene)[0] == found[name]
        assert "friction is at least what is found" in str(found[name])
        assert (beyond_table(scene) is not None) == (decades > 1 or name == BELOW)  # there the rest is open too
        continued = slid(gel(1.0, exponent, extrapolate=True), omega)
        (further,) = unseen(continued)
        assert further.number == pytest.approx(decades, abs=CLOSE)
        assert f"G'' goes on as frequency^{exponent:g}" in str(further)
        assert beyond_table(continued) is None
    far = slid(gel(1.0, exponent, extrapolate=True), 100.0 * 10**7.5 if way > 0 else 10**-8.0)
    assert beyond_table(far).number > 6


def test_the_shortest_wave_counts_and_without_one_that_of_the_grid():
    speed = slid(gel(1.0), 10.0).motion.speed
    scene = slid(gel(1.0), 10.0, roughness=replace(ROUGH, shortest=2 * np.pi * speed / 1000))
    assert outside(scene) == pytest.approx({ABOVE: 1.0}, abs=CLOSE)
    open_ended = replace(scene, roughness=replace(ROUGH, shortest=None))
    assert outside(open_ended) == {}
    (found,) = (each for each in doubts(open_ended, pixel=np.pi * speed / 1e4) if each.name == ABOVE)
    assert found.number == pytest.approx(2.0, abs=CLOSE)


def test_a_table_is_that_at_the_temperature_of_the_scene():
    warmer = WLF(temperature=310, reference=300, c1=8.86, c2=101.6)  # frequencies 67 times as high
    law = Arrhenius(temperature=280, reference=300, activation_energy=6e4)
    for temperature in (warmer, law):
        shift = np.log10(temperature.shift)
        for omega in (2.0, 50.0):
            expected = {ABOVE: np.log10(omega / 100) + shift, BELOW: -np.log10(omega) - shift}
            expected = {name: each for name, each in expected.items() if each > 0.1}
            found = outside(slid(gel(1.0), omega, temperature=temperature))
            found.pop(OPEN, None)
            assert found == pytest.approx(expected, abs=CLOSE)


def test_a_table_of_several_temperatures_reaches_as_far_as_they_do():
    omega, temperatures, law = np.geomspace(1.0, 100.0, 13), (280.0, 300.0, 320.0), replace(WILLIAMS, c2=150.0)
    at_each = [replace(law, temperature=each, reference=300.0).shift for each in temperatures]
    moduli = 1e6 * (1j * np.outer(at_each, omega).ravel()) ** 0.2
    table = {
        "omega [rad/s]": np.tile(omega, len(temperatures)),
        "T [K]": np.repeat(temperatures, len(omega)),
        "G' [Pa]": moduli.real,
        "G'' [Pa]": moduli.imag,
    }
    solid, here = Tabulated(table=table), replace(law, temperature=300.0, reference=300.0)
    above, below = slid(solid, 1e2 * max(at_each) * 10**0.5, here), slid(solid, min(at_each) / 10**0.5, here)
    assert (outside(above)[ABOVE], outside(below)[BELOW]) == pytest.approx((0.5, 0.5), abs=CLOSE)


@pytest.mark.parametrize(
    ("stages", "expected"),
    [
        ((Stage(duration=0.1, load=1.0), Stage(duration=0.9, speed=0.01)), {}),
        ((Stage(duration=0.1, load=1.0), Stage(duration=99.9)), {BELOW: 2.0}),
        ((Stage(duration=1e-3, load=1.0), Stage(duration=0.9)), {ABOVE: 1.0}),
        (
            (
                Stage(duration=0.1, load=1.0),
                Stage(duration=0.5, load=1.0, amplitude=0.1, frequency=1e4 / (2 * np.pi)),
            ),
            {ABOVE: 2.0},
        ),
        (
            (Stage(duration=0.1, load=1.0), Stage(duration=0.5, speed=-slid(gel(1.0), 1e4).motion.speed)),
            {ABOVE: 2.0},
        ),
    ],
    ids=["within", "long", "sudden", "oscillating", "sliding"],
)
def test_a_program_has_the_frequencies_of_its_history(stages, expected):
    found = outside(Scene(BALL, gel(1.0), Program(stages=stages)))
    assert (OPEN in found) == (BELOW in expected)
    found.pop(OPEN, None)
    assert found == pytest.approx(expected, abs=1e-2)


AT_REST = {
    "indented": Indent(load=1.0),
    "sheared": Shear(load=1.0, displacement=1e-6),
    "slid as slowly as can be": Slide(speed=0.0, load=1.0),
    "slid slowly": slid(gel(1.0), 0.2).motion,
}


@pytest.mark.parametrize("motion", AT_REST.values(), ids=AT_REST)
def test_a_modulus_at_rest_that_is_open_is_doubted_where_it_is_asked_for(motion):
    scene = Scene(BALL, gel(1.0), motion, interface=Coulomb(coefficient=0.3))
    assert OPEN in outside(scene)
    assert beyond_table(scene) is not None
    assert OPEN not in outside(slid(gel(1.0), 10.0))
    stated = replace(scene, elastomer=gel(1.0, equilibrium_modulus=1e5))
    assert OPEN not in outside(stated)
    assert beyond_table(stated) is None
    omega = np.geomspace(1.0, 1e5, 26)
    modulus = RUBBER.complex_modulus(omega)
    plateau = Tabulated(table=Table(omega, modulus.real, modulus.imag), frequency_unit="rad/s", kind="shear")
    assert OPEN not in outside(replace(scene, elastomer=plateau))


def test_a_table_that_is_continued_is_doubted_for_the_slope_of_the_contact_that_slides():
    heavy = slid(gel(1.0, 0.3, extrapolate=True), 1e4)
    heavy = replace(heavy, motion=replace(heavy.motion, load=30.0))
    assert beyond_linear(heavy) is None
    assert beyond_linear(replace(heavy, motion=Indent(load=30.0))) is not None


def test_notes_are_those_of_what_was_read_and_change_no_part():
    heights = HeightMap(GROOVES)
    map_read = Topography(heights=heights, pixel=1e-5)
    object.__setattr__(heights, "notes", ("column strain is not used",))
    scene = replace(BASE, roughness=map_read)
    assert notes(scene) == ("column strain is not used",)
    assert map_read == Topography(heights=GROOVES, pixel=1e-5)
    assert notes(BASE) == ()


EXTREMES = (1e-300, 1e-30, 1.0, 1e30, 1e300)
BODIES = (Sphere, Cone, Cylinder)


@pytest.mark.parametrize("body", BODIES)
def test_no_scene_breaks_the_list(body):
    for size, modulus, pressed, speed in product(EXTREMES, EXTREMES, EXTREMES, (0.0, 1e-300, 1e300)):
        indenter = Cone(min(size, 1.57)) if body is Cone else body(size)
        motion = {"line_load": pressed} if body is Cylinder else {"depth": pressed}
        scene = Scene(indenter, Kelvin(modulus, 1 / size), Slide(speed=speed, **motion))
        assert all(map(str, doubts(scene)))


def test_scenes_without_a_smooth_contact_are_no_trouble():
    bowl = np.add.outer(*[((np.arange(8) - 3.5) * 1e-4) ** 2] * 2)
    flat = replace(ROUGH, rms_height=0.0)
    stages = program({"duration": 1.0, "load": 1.0}, {"duration": 1.0, "speed": -0.1})
    for changed in (
        {"indenter": Measured(heights=bowl, pixel=1e-4), "roughness": None},
        {"indenter": Plane(), "motion": Indent(gap=1e-6)},
        {"roughness": flat},
        {"motion": stages},
        {"motion": Shear(load=1.0, displacement=1e-6)},
        {"indenter": PowerLaw(1e300, 100.0)},
        {"roughness": Topography(heights=np.zeros((8, 8)), pixel=1e-6)},
        {"roughness": Topography(heights=1e40 * GROOVES, pixel=1e-6)},
        {"temperature": WLF(temperature=400, reference=300, c1=17.44, c2=51.6)},
    ):
        assert all(map(str, doubts(replace(BASE, **changed))))
