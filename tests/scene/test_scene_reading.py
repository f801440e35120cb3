"""A scene in Python and in TOML: the same fields, the same mistakes, each named with what is allowed."""

from dataclasses import replace
from difflib import get_close_matches

import pytest
from maps import noise, refused
from pydantic import TypeAdapter
from sliding import ORDINARY

from bem3d import BEM
from mdr1d import MDR
from scene import (
    Fractional,
    Indent,
    Kelvin,
    KelvinChain,
    Program,
    Prony,
    Scene,
    SelfAffine,
    Sphere,
    Stage,
    StandardLinearSolid,
    Topography,
)
from scene.files.reading import LISTED, InvalidInput, made, parsed, read
from scene.printable import LONGEST, brief, printable

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
MOVED = "duration = 2.0\nspeed = 0.1"
SCENE = INDENTER + ELASTOMER + MOTION
HILLS = noise((8, 8), 1)
WHOLE = SCENE + ROUGHNESS


def scene_from(tmp_path, text):
    path = tmp_path / "scene.toml"
    path.write_text(text, encoding="utf-8")
    return read(path, Scene)


def test_a_file_says_what_python_says(tmp_path):
    assert scene_from(tmp_path, SCENE) == ORDINARY
    rough = SelfAffine(hurst=0.2, rms_height=5e-5, longest=1e-2)
    assert scene_from(tmp_path, WHOLE) == replace(ORDINARY, roughness=rough)


@pytest.mark.parametrize(
    ("old", "new", "message"),
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
        ("load = 1.0", "", r"motion: none given: give exactly one of load \[N\], depth \[m\]"),
        ("load = 1.0", "pressure = 1.0", r"motion.pressure = 1 does not press a Sphere: give load \[N\] or depth"),
        ("[motion]", "[movement]", r"motion: missing, a table"),
        ("longest = 1e-2", "longest = 1e-2\nseed = 5.0", r"seed = 5.0: .*a whole number"),
        (
            "[roughness]",
            "[layer]\nthickness = 1\nbase = 'bondd'\n[roughness]",
            r"layer.base = 'bondd': .*mean bonded\?",
        ),
        ("duration = 2.0", "duration = 0", r"motion.stages.1.duration = 0.*greater than 0"),
        ("duration = 2.0", "", r"motion.stages.1.duration: missing, a time"),
        (MOVED, "duration = 2.0\namplitude = 1e-5", r"motion.stages.1: amplitude alone.*give both"),
        (
            MOVED,
            "duration = 2.0\nload = 1",
            r"motion: stages prescribe depth and load: give one and the same throughout",
        ),
        ("depth = 1e-4", "", r"motion: stages press nowhere: give one of load \[N\], depth \[m\], line_load"),
        (PROGRAM[26:], "stages = []", r"motion.stages = \[\]: .*at least 1 item"),
        (PROGRAM[26:], "stages = [{duration = 1.0, gap = 1e-6}]", r"motion.stages.0.gap = 1e-06: unknown here"),
    ],
)
def test_a_mistake_is_named_with_its_place_value_and_what_is_allowed(tmp_path, old, new, message):
    """Of a part, and of a stage of a program."""
    text = WHOLE if old in WHOLE else INDENTER + ELASTOMER + PROGRAM
    assert old in text
    refused(message, scene_from, tmp_path, text.replace(old, new))


def test_a_program_of_stages_can_be_read(tmp_path):
    stages = Stage(duration=1.0, depth=1e-4), Stage(duration=2.0, speed=0.1), Stage(duration=1.0, depth=0.0)
    scene = scene_from(tmp_path, INDENTER + ELASTOMER + PROGRAM)
    assert scene.motion == Program(stages=stages)
    adapter = TypeAdapter(Scene)
    assert adapter.validate_json(adapter.dump_json(scene)) == scene


def test_what_is_no_toml_or_no_file_is_said(tmp_path):
    refused(r"not valid TOML: .*line 1", scene_from, tmp_path, "radius 3")
    (tmp_path / "scene.toml").write_bytes(b"\xff\xfe")
    refused("is no text in UTF-8: byte 1 is 0xff", read, tmp_path / "scene.toml", Scene)
    refused(r"nowhere\.toml: no such file", read, tmp_path / "nowhere.toml", Scene)


# Names and types that are unknown


def lines_of(tmp_path, text):
    with pytest.raises(InvalidInput) as raised:
        scene_from(tmp_path, text)
    return [line.partition("scene.toml: ")[2] for line in str(raised.value).splitlines()]


TYPES = "one of 'elastic', 'fractional', 'kelvin', 'kelvin-chain', 'prony', 'standard-linear-solid', 'tabulated'"


@pytest.mark.parametrize(
    ("old", "new", "lines"),
    [
        ("modulus =", "modlus =", ["elastomer.modlus = 1000000.0: unknown here; did you mean modulus? Known are"]),
        ("[roughness]", "[roughnes]", ["roughnes: unknown here; did you mean roughness? Known are indenter, "]),
        ('"kelvin"', '"Kelvin"', [f"elastomer.type = 'Kelvin': {TYPES}; did you mean kelvin?"]),
        (
            'type = "slide"',
            'typ = "slide"',
            ["motion.type: missing, one of 'indent', 'program', 'shear', 'slide'"],
        ),
        ("[indenter]", "speed = 0.1\n[indenter]", ["speed = 0.1: unknown here; known are indenter, elastomer, "]),
        ("seed = 1", "fudge = 1", ["roughness.fudge = 1: unknown here; known are type, hurst, "]),
        ("hurst = 0.2", "hurst = 0.2\nhurts = 1", ["roughness.hurts = 1: unknown here; did you mean hurst?"]),
        ('"sphere"', '"ball"', ["indenter.type = 'ball': one of 'cone', 'cylinder', 'measured', 'plane', '"]),
    ],
)
def test_an_unknown_name_is_one_mistake_with_the_nearest_known_one(tmp_path, old, new, lines):
    text = WHOLE + "seed = 1\n"
    assert old in text
    for found, begins in zip(lines_of(tmp_path, text.replace(old, new, 1)), lines, strict=True):
        assert found.startswith(begins)


@pytest.mark.parametrize(
    ("text", "lines"),
    [
        (
            '[indenter]\ntype = "cone"\n[motion]\n',
            [
                "motion.type: missing, one of 'indent', 'program', 'shear', 'slide'",
                'indenter.angle: missing, an angle, such as "30 deg" or 0.523599 (in rad)',
                "elastomer: missing, a table",
            ],
        ),
        (
            SCENE.replace('"sphere"\nradius = 1e-2', '"plane"').replace("load", "pressure"),
            ["indenter = Plane without roughness touches everywhere: give roughness"],
        ),
        # rows of numbers are not repeated
        (
            SCENE + f"[roughness]\ntype = 'topography'\npixel = 1.0\nheights = {50 * [[1.0, 2.0, 3.0]]}\n",
            ["roughness.heights: an array of shape (50, 3): a map has at least 4 rows and columns"],
        ),
        ("a = " + "[" * 5000 + "]" * 5000, ["tables and lists stand in one another too deep"]),
    ],
    ids=["missing", "not together", "rows of numbers", "nested"],
)
def test_mistakes_are_listed_by_their_fields_alone(tmp_path, text, lines):
    assert lines_of(tmp_path, text) == lines


LENGTH = 'a length, such as "5 mm" or 0.005 (in m)'


@pytest.mark.parametrize(
    ("make", "lines"),
    [
        (lambda: Sphere(radios=1), ["radios = 1: unknown here; did you mean radius? Known are radius, type"]),
        (lambda: Sphere(), [f"radius: missing, {LENGTH}"]),
        (lambda: Sphere(None), [f"radius = None: Input should be {LENGTH}"]),
        (lambda: Sphere(1, "sphere", 3), ["3 values without a name: 2 at most, others by name, each once"]),
        (lambda: Sphere(1, radius=2), ["1 values without a name: 2 at most, others by name, each once"]),
        (
            lambda: Kelvin(-1, "1 m"),
            [
                "modulus = -1: Input should be greater than 0",
                "relaxation_time = '1 m': Input should be a time, such as \"1 ms\" or 0.001 (in s); "
                "this one has the unit m",
            ],
        ),
        (lambda: Topography(HILLS, "2 um"), ["2 values without a name: 0 at most, others by name, each once"]),
        (
            lambda: Topography(heights=HILLS, pixel="2 s"),
            [f"pixel = '2 s': Input should be {LENGTH}; this one has the unit s; or two of them, along x and y"],
        ),
        (lambda: Scene(1, Kelvin(1, 1), Indent(load=1)), ["indenter = 1: a table"]),
        (lambda: MDR(shape="round"), ["shape = 'round': Input should be 'mapped' or 'as-given'"]),
    ],
)
def test_a_call_names_its_mistakes_as_a_file_does(make, lines):
    with pytest.raises(InvalidInput) as raised:
        make()
    assert [line.partition(": ")[2] for line in str(raised.value).splitlines()] == lines
    assert "pydantic" not in str(raised.getrepr())


@pytest.mark.parametrize("solver", [MDR(), BEM()])
@pytest.mark.parametrize("given", [HILLS, "quick-start", Sphere, None], ids=["array", "text", "class", "None"])
def test_a_solver_names_what_is_no_scene(solver, given):
    for ask in (solver.solve, solver.plan):
        refused(r"^scene = .*: a Scene is needed$", ask, given)


# Files that a file names


MAP = "\n".join(" ".join(map(str, row)) for row in HILLS)
TABLE = """f G' G''
1 1e6 9000
10 1.001e6 8.999e4
100 1.089e6 8.911e5
1000 5.5e6 4.5e6
1e4 9.911e6 8.911e5
1e5 9.999e6 8.999e4
"""
RUBBER = "[elastomer]\ntype = 'tabulated'\nfrequency_unit = 'rad/s'\nkind = 'shear'\ntable = {}\n"


@pytest.mark.parametrize(
    ("held", "stated"),
    [
        (MAP, SCENE + "[roughness]\ntype = 'topography'\npixel = 1e-6\nunit = 'um'\nfile = {}\n"),
        (TABLE, INDENTER + MOTION + RUBBER),
    ],
    ids=["a map", "a table"],
)
def test_a_path_is_relative_to_the_file_in_which_it_stands(tmp_path, monkeypatch, held, stated):
    """Wherever it is read, and whether the file itself is named by a relative or an absolute path."""
    folder = tmp_path / "scenes"
    folder.mkdir()
    (folder / "held.txt").write_text(held)
    (folder / "scene.toml").write_text(stated.format("'held.txt'"))
    (tmp_path / "absolute.toml").write_text(stated.format(repr(str(folder / "held.txt"))))
    monkeypatch.chdir(tmp_path)
    near = read("scenes/scene.toml", Scene)
    monkeypatch.chdir(folder)
    for path in ("scene.toml", folder / "scene.toml", "../absolute.toml"):
        assert read(path, Scene) == near
    (folder / "held.txt").unlink()
    for named, place in (
        ("../scene.toml", r"scenes/\.\., the folder of the file that names it"),
        ("scene.toml", "scenes, the working directory"),
    ):
        refused(
            rf"held\.txt: no such file in .*{place}",
            made,
            parsed(stated.format("'held.txt'"), named),
            Scene,
            named,
        )


# Whatever stands where


@pytest.mark.parametrize("kind", ["sphere", "cone", "plane"])
def test_a_name_that_is_called_as_the_type_of_its_table_is_a_name(tmp_path, kind):
    lines = lines_of(tmp_path, SCENE.replace('type = "sphere"', f'type = "{kind}"\n{kind} = 1'))
    assert f"indenter.{kind} = 1: unknown here" in lines[0]


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


@pytest.fixture
def compared(monkeypatch):
    """Names for which a near one was sought."""
    names = []

    def compare(name, *others):
        names.append(name)
        return get_close_matches(name, *others)

    monkeypatch.setattr("scene.files.reading.get_close_matches", compare)
    return names


@pytest.mark.parametrize("text", MANY.values(), ids=MANY)
def test_of_many_mistakes_the_first_are_listed_and_how_many_more_there_are(tmp_path, compared, text):
    lines = lines_of(tmp_path, text)
    assert len(lines) == LISTED + 1
    assert lines[-1] == "and 950 more mistakes"
    assert len(compared) <= LISTED


def test_nothing_of_a_file_controls_a_terminal(tmp_path):
    text = SCENE + '"\\u001b[31m\\u0007\\u202e[red]" = "\\u001b]0;title\\u009b\\r\\n"\n'
    (line,) = lines_of(tmp_path, text)
    assert line.startswith(r"motion.\x1b[31m\x07\u202e[red] = '\x1b]0;title\x9b\r\n': unknown here")
    assert "\x1b" not in str(InvalidInput("\x1b"))


G = 1e6
SPRINGPOT = Fractional(modulus=G, relaxation_time=1e-3, exponent=0.3, lowest_frequency=1e-4, highest_frequency=1e8)
ROUGH = SelfAffine(hurst=0.7, rms_height=3e-5, longest=1e-2, shortest=1e-4, seed=3)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: StandardLinearSolid(G, G, 1.0), r"glassy_modulus = 1e\+06 must exceed rubbery_modulus = 1e\+06"),
        (lambda: Prony(G, (G, G), (1.0,)), "relaxation_times has 1 values, moduli has 2: each modulus"),
        (lambda: KelvinChain(0.0, (1.0,), (1.0, 2.0)), "retardation_times has 2 values, compliances has 1"),
        (lambda: replace(SPRINGPOT, highest_frequency=1e-4), r"0\.0001 must exceed lowest_frequency = 0\.0001"),
        (lambda: replace(SPRINGPOT, highest_frequency=1e27), r"highest_frequency = 1e\+27 .* at most 30 decades"),
        (lambda: replace(ROUGH, shortest=6e-3), r"shortest = 0\.006 must be at most half of longest = 0\.01"),
        (lambda: replace(ROUGH, rolloff=2e-2), "rolloff = 0.02 must be more than shortest .* at most longest"),
    ],
)
def test_a_wrong_value_is_refused_with_its_field_and_what_is_allowed(make, message):
    refused(message, make)


# Messages about any content

# Escape, bell, return, the C1 form of an escape, direction of reading, no width, half a letter.
CONTROLS = ["\x1b[31m", "\a", "\r", "\b", "\x9b31m", "\u202e", "\u2066", "\u200b", "\ufeff", "\ud800", "\0"]


@pytest.mark.parametrize("control", CONTROLS)
def test_what_controls_a_terminal_is_written_out(control):
    assert printable(control).isprintable()
    assert printable(printable(control)) == printable(control)


def test_letters_of_people_and_line_ends_stay():
    text = "µ = 0.3 °C, naïve 摩擦\nnext"
    assert printable(text) == text
    assert printable("20\u202f000\xa0N") == "20 000 N"
    assert brief(text) == text.replace("\n", "\\n")


@pytest.mark.parametrize("letter", ["a", "\n", "\x1b", "\ud800", "\U000e0001"])
def test_a_brief_text_is_short_and_has_both_of_its_ends(letter):
    found = brief(f"first{letter * 10_000}last")
    assert found.isprintable()
    assert len(found) <= LONGEST
    assert found.startswith("first")
    assert found.endswith("last")
