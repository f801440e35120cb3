"""A scene in Python and in TOML: the same fields, the same mistakes, each named with what is allowed."""

import difflib
import tomllib
from dataclasses import FrozenInstanceError, dataclass, replace
from math import pi

import numpy as np
import pytest
from pydantic import TypeAdapter

from scene import (
    Cone,
    Cylinder,
    Elastic,
    Fractional,
    Indent,
    Kelvin,
    KelvinChain,
    PowerLaw,
    Program,
    Prony,
    Scene,
    SelfAffine,
    Slide,
    Sphere,
    Stage,
    StandardLinearSolid,
)
from scene.reading import DEEPEST, SAID, InvalidInput, parsed, read

INDENTER = '[indenter]\ntype = "sphere"\nradius = 1e-2\n'
ELASTOMER = '[elastomer]\ntype = "kelvin"\nmodulus = 1e6\nrelaxation_time = 1e-3\n'
MOTION = '[motion]\ntype = "slide"\nspeed = 0.1\nload = 1.0\n'
PROGRAM = """[motion]
type = "program"
[[motion.stages]]
duration = 1
depth = 1e-4
[[motion.stages]]
duration = 2.0
speed = 0.1
[[motion.stages]]
duration = 1.0
depth = 0
"""
ROUGHNESS = "[roughness]\ntype = 'self-affine'\nhurst = 0.2\nrms_height = 5e-5\nlongest = 1e-2\n"
SCENE = INDENTER + ELASTOMER + MOTION
WHOLE = SCENE + ROUGHNESS


def scene_from(tmp_path, text):
    path = tmp_path / "scene.toml"
    path.write_text(text, encoding="utf-8")
    return read(path, Scene)


def test_a_file_says_what_python_says(tmp_path):
    expected = Scene(
        Sphere(1e-2),
        Kelvin(1e6, 1e-3),
        Slide(speed=0.1, load=1.0),
        SelfAffine(hurst=0.2, rms_height=5e-5, longest=1e-2),
    )
    assert scene_from(tmp_path, WHOLE) == expected
    assert scene_from(tmp_path, SCENE) == replace(expected, roughness=None)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("radius = 1e-2", "radius = -1.0", r"indenter.radius = -1.0: .*greater than 0"),
        ("radius = 1e-2", 'radius = "-5 mm"', r"indenter.radius = '-5 mm': .*greater than 0, in SI units"),
        (
            "radius = 1e-2",
            'radius = "wide"',
            r"radius = 'wide': Input should be a length, such as \"5 mm\" or 0.005 \(in m\)",
        ),
        ("radius = 1e-2", "", r'indenter.radius: missing, a length, such as "5 mm"'),
        ("radius = 1e-2", "radius = 1\nangle = 1", r"indenter.angle = 1: unknown here; known are radius, type"),
        ('"sphere"', '"ball"', r"indenter.type = 'ball': one of 'sphere', 'cone', 'power-law', 'cylinder'"),
        ("load = 1.0", "", r"motion: none given: give exactly one of load \[N\], depth \[m\]"),
        ("load = 1.0", "pressure = 1.0", r"motion.pressure = 1 does not press a Sphere: give load \[N\] or depth"),
        ("[motion]", "[movement]", r"motion: missing, a table"),
        (
            "longest = 1e-2",
            "longest = 1e-2\nshortest = 1",
            r"roughness: shortest = 1 must be at most half of longest",
        ),
        ("longest = 1e-2", "longest = 1e-2\nseed = 5.0", r"seed = 5.0: .*without a decimal point"),
        (
            "[roughness]",
            "[layer]\nthickness = 1\nbase = 'bondd'\n[roughness]",
            r"layer.base = 'bondd': .*mean 'bonded'\?",
        ),
    ],
)
def test_a_mistake_is_named_with_its_place_value_and_what_is_allowed(tmp_path, old, new, said):
    assert old in WHOLE
    with pytest.raises(InvalidInput, match=said):
        scene_from(tmp_path, WHOLE.replace(old, new))


def test_a_program_of_stages_can_be_read(tmp_path):
    stages = Stage(duration=1.0, depth=1e-4), Stage(duration=2.0, speed=0.1), Stage(duration=1.0, depth=0.0)
    scene = scene_from(tmp_path, INDENTER + ELASTOMER + PROGRAM)
    assert scene.motion == Program(stages=stages)
    adapter = TypeAdapter(Scene)
    assert adapter.validate_json(adapter.dump_json(scene)) == scene


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("duration = 2.0", "duration = 0", r"motion.stages.1.duration = 0.*greater than 0"),
        ("duration = 2.0", "", r"motion.stages.1.duration: missing, a time"),
        ("speed = 0.1", "amplitude = 1e-5", r"motion.stages.1: amplitude alone.*give both"),
        ("speed = 0.1", "load = 1", r"motion: stages prescribe depth and load: give one and the same throughout"),
        ("depth = 1e-4", "", r"motion: stages press nowhere: give one of load \[N\], depth \[m\], line_load"),
        (PROGRAM[26:], "stages = []", r"motion.stages = \[\]: .*at least 1 item"),
        (PROGRAM[26:], "stages = [{duration = 1.0, gap = 1e-6}]", r"^\S*scene.toml: motion.stages.0.gap[^\n]*$"),
    ],
)
def test_a_mistake_in_a_program_is_named_with_its_stage(tmp_path, old, new, said):
    assert old in PROGRAM
    with pytest.raises(InvalidInput, match=said):
        scene_from(tmp_path, INDENTER + ELASTOMER + PROGRAM.replace(old, new))


def test_a_program_prescribes_by_straight_lines_from_zero_and_what_presses_it_suits_the_indenter():
    stages = Stage(duration=1.0, load=2.0), Stage(duration=2.0, speed=0.5), Stage(duration=1.0, load=0.0)
    program = Program(stages=stages)
    np.testing.assert_allclose(program.prescribed([0, 0.5, 1, 2, 3, 3.5, 4]), [0, 1, 2, 2, 2, 1, 0])
    np.testing.assert_allclose(program.path([1.0, 2.0, 4.0]), [0.0, 0.5, 1.0])
    assert (program.duration, program.length, program.pressed_by) == (4.0, 1.0, "load")
    assert program.held == Indent(load=2.0)
    with pytest.raises(InvalidInput, match=r"motion.load = 2 does not press a Cylinder: give line_load"):
        Scene(Cylinder(1.0), Elastic(1e6), program)


def test_what_is_no_toml_or_no_file_is_said(tmp_path):
    with pytest.raises(InvalidInput, match=r"not valid TOML: .*line 1"):
        scene_from(tmp_path, "radius 3")
    (tmp_path / "scene.toml").write_bytes(b"\xff\xfe")
    with pytest.raises(InvalidInput, match="is no text in UTF-8: byte 1 is 0xff"):
        read(tmp_path / "scene.toml", Scene)
    with pytest.raises(InvalidInput, match=r"nowhere\.toml: no such file"):
        read(tmp_path / "nowhere.toml", Scene)
    with pytest.raises(InvalidInput, match="is a folder"):
        read(tmp_path, Scene)


def test_any_number_is_kept_as_a_float_and_a_whole_one_is_no_other():
    for number in (2, np.float32(2), np.int64(2)):
        assert (Sphere(number).radius, type(Sphere(number).radius)) == (2.0, float)
    rough = SelfAffine(hurst=0.2, rms_height=1e-5, longest=1e-2, seed=np.int64(2))
    assert type(rough.seed) is int
    for value in (True, "2", 2.0, np.float64(2)):
        with pytest.raises(InvalidInput, match="seed"):
            replace(rough, seed=value)


def test_a_scene_cannot_be_changed_and_survives_its_own_json():
    scene = Scene(Sphere(1e-2), Prony(1e6, (1e6,), (1.0,)), Slide(speed=0.1, load=1.0))
    with pytest.raises(FrozenInstanceError):
        scene.motion.speed = 2.0
    adapter = TypeAdapter(Scene)
    assert adapter.validate_json(adapter.dump_json(scene)) == scene


def test_rows_of_numbers_are_not_repeated_to_whoever_wrote_them(tmp_path):
    heights = "[" + ", ".join(["[1.0, 2.0, 3.0]"] * 50) + "]"
    text = f"[roughness]\ntype = 'topography'\npixel = 1.0\nheights = {heights}\n"
    with pytest.raises(InvalidInput) as raised:
        scene_from(tmp_path, SCENE + text)
    assert str(raised.value).endswith(
        "roughness.heights: an array of shape (50, 3): a map has at least 4 rows and columns"
    )


def test_a_list_that_is_too_short_is_named_with_what_it_lacks(tmp_path):
    @dataclass(frozen=True)
    class Ends:
        pair: tuple[float, float]

    path = tmp_path / "ends.toml"
    path.write_text("pair = [1.0]\n")
    with pytest.raises(InvalidInput, match=r"ends.toml: pair.1 = \[1.0\]: Field required"):
        read(path, Ends)


@pytest.mark.parametrize("digits", [301, 4000])
def test_numbers_of_any_length_are_named(tmp_path, digits):
    hexadecimal = "0x" + "f" * digits
    with pytest.raises(InvalidInput, match=r"indenter.radius.*within the range"):
        scene_from(tmp_path, SCENE.replace("1e-2", hexadecimal))
    with pytest.raises(InvalidInput, match=r"radius|valid TOML"):
        scene_from(tmp_path, SCENE.replace("1e-2", "1" + "0" * 2 * digits))


def test_what_does_not_fit_together_is_named_by_its_fields_alone(tmp_path):
    text = SCENE.replace('"sphere"\nradius = 1e-2', '"plane"').replace("load", "pressure")
    with pytest.raises(InvalidInput) as raised:
        scene_from(tmp_path, text)
    assert str(raised.value).endswith(
        "scene.toml: indenter = Plane without roughness touches everywhere: give roughness"
    )


# What was probably meant


def lines_of(tmp_path, text):
    with pytest.raises(InvalidInput) as raised:
        scene_from(tmp_path, text)
    return [line.partition("scene.toml: ")[2] for line in str(raised.value).splitlines()]


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("modulus =", "modlus =", "elastomer.modlus = 1000000.0: unknown here; did you mean modulus? Known"),
        ("[roughness]", "[roughnes]", "roughnes: unknown here; did you mean roughness? Known are indenter, "),
        ('"kelvin"', '"Kelvin"', "elastomer.type = 'Kelvin': one of 'elastic', 'kelvin', "),
        ('type = "slide"', 'typ = "slide"', "motion.typ = 'slide': unknown here; did you mean type?"),
        ("[indenter]", "speed = 0.1\n[indenter]", "speed = 0.1: unknown here"),
        ("seed = 1", "fudge = 1", "roughness.fudge = 1: unknown here; known are type, hurst, "),
    ],
)
def test_a_misspelt_name_is_one_mistake_and_said_with_what_is_meant(tmp_path, old, new, said):
    text = WHOLE + "seed = 1\n"
    assert old in text
    (line,) = lines_of(tmp_path, text.replace(old, new, 1))
    assert line.startswith(said)


def test_a_name_in_the_wrong_table_is_said_with_the_right_one(tmp_path):
    text = "speed = 0.1\n" + WHOLE.replace("speed = 0.1\n", "")
    (line,) = lines_of(tmp_path, text)
    assert line.startswith("speed = 0.1: unknown here; did you mean motion.speed? Known are indenter, elastomer")
    (line,) = lines_of(tmp_path, text.replace("speed", "spede"))
    assert line.startswith("spede = 0.1: unknown here; did you mean motion.speed?")
    assert lines_of(tmp_path, text.replace("0.1", "-0.1"))[1] == (
        "motion.speed = -0.1: Input should be greater than or equal to 0"
    )
    layered = SCENE.replace("radius = 1e-2", "radius = 1e-2\nbase = 'bonded'") + "[layer]\nthickness = 1\n"
    (line,) = lines_of(tmp_path, layered)
    assert "did you mean layer.base?" in line


def test_what_stands_under_a_misspelt_name_is_checked_as_if_it_were_right(tmp_path):
    text = WHOLE.replace("[elastomer]", "[elastomr]").replace("modulus = 1e6", "modulis = '1 N'")
    text = text.replace('"sphere"\nradius = 1e-2', '"spher"\nradius = -1').replace("hurst = 0.2", "hurst = 2")
    assert [line.partition(":")[0] for line in lines_of(tmp_path, text)] == [
        "indenter.type = 'spher'",
        "indenter.radius = -1",
        "elastomr",
        "roughness.hurst = 2",
        "elastomer.modulis = '1 N'",
        "elastomer.modulus = '1 N'",
    ]


def test_everything_that_is_missing_is_said(tmp_path):
    assert lines_of(tmp_path, '[indenter]\ntype = "cone"\n[motion]\n') == [
        'indenter.angle: missing, an angle, such as "30 deg" or 0.523599 (in rad)',
        "motion.type: missing, one of 'indent', 'slide', 'shear', 'program'",
        "elastomer: missing, a table",
    ]


@pytest.mark.parametrize(
    ("stated", "missing", "instead"),
    [
        ('type = "prony"\nmoduli = [1]', "elastomer.relaxation_times", ["tau"]),
        ('type = "prony"\nrelaxation_times = [1]', "elastomer.moduli", ["youngs_moduli", "g"]),
        ('type = "kelvin"\nmodulus = 1', "elastomer.relaxation_time", []),
        (f'{ELASTOMER[12:]}\n[roughness]\ntype = "self-affine"', "roughness.rms_height", ["rms_slope"]),
    ],
)
def test_what_may_stand_in_place_of_a_missing_name_is_said(tmp_path, stated, missing, instead):
    lines = lines_of(tmp_path, f"{INDENTER}[elastomer]\n{stated}\n[motion]\ntype = 'indent'\nload = 1")
    (line,) = [line for line in lines if line.startswith(f"{missing}: missing, ")]
    assert line.split("; or ")[1:] == instead


# Whatever stands where


@pytest.mark.parametrize("kind", ["sphere", "cone", "plane"])
def test_a_name_that_is_called_as_the_type_of_its_table_is_a_name(tmp_path, kind):
    lines = lines_of(tmp_path, SCENE.replace('type = "sphere"', f'type = "{kind}"\n{kind} = 1'))
    assert f"indenter.{kind} = 1: unknown here" in lines[0]


DEEP = {
    "a header": f"[{'a.' * 500}a]\n",
    "quoted and spaced": '"a" . ' * 100_000 + "'a' = 1\n",
    "tables in a line": "a = " + "{a = " * 5000 + "1" + "}" * 5000,
    "one level too many": "a = " + "[" * DEEPEST + "]" * DEEPEST,
}


@pytest.mark.parametrize("text", DEEP.values(), ids=DEEP)
def test_what_is_nested_too_deep_is_said(tmp_path, text):
    assert lines_of(tmp_path, text) == ["tables and lists stand in one another deeper than 20 levels"]


def test_what_is_nested_less_deep_is_read():
    text = "a = " + "[" * (DEEPEST - 1) + "]" * (DEEPEST - 1)
    assert parsed(text, "file") == tomllib.loads(text)
    assert parsed("# " + "a.b." * 20, "file") == {}


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
@pytest.mark.parametrize("mark", ["", "\ufeff"])
def test_line_ends_and_the_mark_of_an_editor_mean_nothing(tmp_path, end, mark):
    path = tmp_path / "scene.toml"
    path.write_bytes((mark + WHOLE.replace("\n", end)).encode())
    assert read(path, Scene) == scene_from(tmp_path, WHOLE)


STAGES = INDENTER + ELASTOMER + "[motion]\ntype = 'program'\n"
MANY = {
    "unknown": SCENE + "".join(f"lod{k} = 1\n" for k in range(1000)),
    "of a table that is unknown": SCENE + "".join(f"[motions{k}]\n" for k in range(1000)),
    "wrong": STAGES + "[[motion.stages]]\nduration = 1\nload = 'x'\n" * 1000,
    "missing": STAGES + "[[motion.stages]]\nload = 1.0\n" * 1000,
    "unknown and wrong": STAGES + "[[motion.stages]]\nduration = '1 N'\nlod = 1.0\n" * 500,
}


@pytest.mark.parametrize("text", MANY.values(), ids=MANY)
def test_of_many_mistakes_the_first_are_said_and_how_many_more_there_are(tmp_path, monkeypatch, text):
    compared, compare = [], difflib.get_close_matches
    monkeypatch.setattr(difflib, "get_close_matches", lambda *a, **b: compared.append(a) or compare(*a, **b))
    lines = lines_of(tmp_path, text)
    assert len(lines) == SAID + 1
    assert lines[-1] == "and 950 more mistakes"
    assert len(compared) <= 10 * SAID


def test_names_and_values_of_any_length_are_cut_before_they_are_compared(tmp_path, monkeypatch):
    compared, compare = [], difflib.get_close_matches
    monkeypatch.setattr(difflib, "get_close_matches", lambda *a, **b: compared.append(a[0]) or compare(*a, **b))
    long = "load" * 50_000
    lines = lines_of(tmp_path, SCENE.replace('"sphere"', f'"{long}"') + f"{long} = '{long}'\n")
    assert max(map(len, lines)) < 1000
    assert len(lines) == 2
    assert compared
    assert max(map(len, compared)) <= 100


def test_nothing_of_a_file_controls_a_terminal(tmp_path):
    text = SCENE + '"\\u001b[31m\\u0007\\u202e[red]" = "\\u001b]0;title\\u009b\\r\\n"\n'
    (line,) = lines_of(tmp_path, text)
    assert line.isprintable()
    assert line.startswith(r"motion.\x1b[31m\x07\u202e[red] = '\x1b]0;title\x9b\r\n': unknown here")
    assert "\x1b" not in str(InvalidInput("\x1b"))


G = 1e6
SPRINGPOT = Fractional(modulus=G, relaxation_time=1e-3, exponent=0.3, lowest_frequency=1e-4, highest_frequency=1e8)
ROUGH = SelfAffine(hurst=0.7, rms_height=3e-5, longest=1e-2, shortest=1e-4, seed=3)


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: Cone(angle=pi / 2), r"angle.*less than 1\.57"),
        (lambda: PowerLaw(coefficient=1.0, exponent=0.9), r"exponent.*greater than or equal to 1"),
        (lambda: Elastic(G, poisson_ratio=0.6), r"poisson_ratio.*less than or equal to 0\.5"),
        (lambda: StandardLinearSolid(G, G, 1.0), r"glassy_modulus = 1e\+06 must exceed rubbery_modulus = 1e\+06"),
        (lambda: Prony(G, moduli=(), relaxation_times=()), r"moduli.*at least 1"),
        (lambda: Prony(G, (G, G), (1.0,)), "relaxation_times has 1 values, moduli has 2: each modulus"),
        (lambda: Prony(G, moduli=(G, -G), relaxation_times=(1.0, 2.0)), r"moduli\.1.*greater than 0"),
        (lambda: KelvinChain(0.0, (1.0,), (1.0, 2.0)), "retardation_times has 2 values, compliances has 1"),
        (lambda: replace(SPRINGPOT, exponent=1.0), r"exponent.*less than 1"),
        (lambda: replace(SPRINGPOT, tolerance=0.5), r"tolerance.*less than or equal to 0\.1"),
        (lambda: replace(SPRINGPOT, highest_frequency=1e-4), r"0\.0001 must exceed lowest_frequency = 0\.0001"),
        (lambda: replace(SPRINGPOT, highest_frequency=1e27), r"highest_frequency = 1e\+27 .* at most 30 decades"),
        (lambda: replace(ROUGH, hurst=1.1), r"hurst.*less than or equal to 1"),
        (lambda: replace(ROUGH, shortest=6e-3), r"shortest = 0\.006 must be at most half of longest = 0\.01"),
        (lambda: replace(ROUGH, seed=-1), r"seed.*greater than or equal to 0"),
        (lambda: replace(ROUGH, rolloff=2e-2), "rolloff = 0.02 must be more than shortest .* at most longest"),
        (lambda: replace(ROUGH, amplitudes="rayleigh"), r"amplitudes.*'fixed' or 'gaussian'"),
    ],
)
def test_a_wrong_value_is_refused_with_its_field_and_what_is_allowed(make, said):
    with pytest.raises(InvalidInput, match=said):
        make()
