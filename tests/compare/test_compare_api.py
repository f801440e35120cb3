"""`crosscheck X` is `compare.X`: the same names, arguments and numbers; nothing is printed."""

import itertools
import json
import re
from dataclasses import replace
from importlib.metadata import version

import numpy as np
import pytest
import xarray
from matplotlib.figure import Figure
from processes import ask
from small_cases import SCENE, SLIDING, SMALL, TINY
from stand_in_solver import Here

import compare
from bem3d import BEM
from compare import commands
from compare.statistics.finding import COLUMNS
from compare.statistics.jackknife import friction
from compare.studies.comparison.sweep import SweepSeries
from mdr1d import MDR
from scene import Scene
from scene.files.reading import InvalidInput, made
from scene.result import provenance
from scene.vocabulary import FIELDS


def shown(thing):
    """What a notebook shows: HTML without a tag that its text could have smuggled in."""
    text = thing._repr_html_()
    assert "<rough>" not in text
    return text


@pytest.fixture(scope="module")
def valid():
    """Content of a JSON text, which the schema of answers has to allow completely, and nothing more."""
    jsonschema = pytest.importorskip("jsonschema")
    allowed = jsonschema.Draft202012Validator(compare.schema("answers"))

    def valid(text):
        answer = json.loads(text, parse_constant=pytest.fail)
        allowed.validate(answer)
        assert not allowed.is_valid(answer | {"more": 0})
        return answer

    return valid


@pytest.mark.parametrize("asked", ["trust hertz", "plan thin-layer", "scenes", "study", "new hertz"])
def test_every_command_answers_in_json_as_its_schema_says(valid, asked, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert valid(ask(*asked.split(), "--json").stdout)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("found")


@pytest.fixture(scope="module")
def found(folder, in_this_process):
    return compare.run({"tiny": TINY}, folder, workers=1)


def test_a_run_prints_nothing_and_what_it_returns_says_what_the_command_prints(folder, found, capfd, valid):
    assert str(found.path.resolve()) in str(found)
    assert repr(found) == str(found)
    assert found.page.answer
    again = compare.run({"tiny": TINY}, folder, report=False)
    assert capfd.readouterr() == ("", "")
    assert (again.swept.solved, again.swept.reused, again.path) == (0, found.swept.solved, None)
    assert list(again.findings.columns) == list(COLUMNS)
    assert valid(commands.as_json(found))["page"] == str(found.path)


def test_a_run_shows_itself_in_a_notebook(found):
    assert "A &lt;rough&gt; sphere &amp; more" in shown(found)


def test_figures_are_drawn_when_they_are_taken_out_and_show_themselves(found):
    figures = found.figures
    name, *_ = figures
    drawing = figures[name]
    assert isinstance(drawing, Figure)
    assert drawing._repr_png_().startswith(b"\x89PNG")
    with pytest.raises(KeyError):
        figures["tiny/nothing"]
    assert str(figures).startswith(f"Figures({name}, ")


def test_a_folder_says_what_wrote_it_and_may_be_moved(folder, found):
    text = (folder / "manifest.json").read_text()
    assert json.loads(text)["command"] == "run"
    assert str(folder) not in text


def test_a_plan_is_asked_of_a_scene_a_case_or_a_file():
    of_scene = compare.plan(SLIDING)
    assert of_scene.feasible
    assert {*of_scene} == {"MDR", "BEM"}
    assert str(compare.plan(TINY)["BEM"]) == str(TINY.bem.plan(SLIDING))
    assert all(str(each) in of_scene.details for each in of_scene.values())


def test_a_sweep_is_a_dataset_of_every_draw_with_means_and_intervals(tmp_path, valid, in_this_process):
    scene, output = tmp_path / "scene.toml", tmp_path / "found"
    scene.write_text(SCENE + SMALL)
    answers = compare.sweep(
        scene, speed=[0.1, 0.0], load=[0.5, 1.0], draws=2, output=output, workers=1, report=False
    )
    assert dict(answers.sizes) == {"model": 2, "level": 2, "speed": 2, "load": 2, "surface": 2}
    assert answers.speed.values.tolist() == [0.0, 0.1]
    assert set(answers.status.values.ravel()) == {"solved"}
    bem = answers.sel(model="BEM", level="fine")
    assert answers.friction_coefficient_mean.sel(model="BEM").values == pytest.approx(friction(bem))
    assert (answers.friction_coefficient_low <= answers.friction_coefficient_mean).all()
    assert compare.friction_plot(answers)._repr_png_().startswith(b"\x89PNG")
    again = compare.sweep(scene, speed="0 m/s, 10cm/s", load="0.5N..1N:2", draws=2, output=output, report=False)
    xarray.testing.assert_identical(again, answers)
    words = "sweep", scene, "--speed", "0 m/s,10cm/s", "--load", "0.5 N", "--load", "1N"
    answer = valid(ask(*words, "--draws", 2, "--output", output, "--no-report", "--json").stdout)
    row = next(each for each in answer["tables"]["means-friction"] if each["load"] == 0.5)
    mean = answers.friction_coefficient_mean.sel(model="BEM", speed=0.1, load=0.5).item()
    assert row["friction_coefficient (3D)"] == mean
    assert row["1D/3D"] == pytest.approx(row["friction_coefficient (1D)"] / mean)


def test_a_dataset_names_its_scene_version_and_seeds_and_its_axes_have_names_and_units(folder, found):
    tree, fields = compare.load(folder), BEM(points=32).solve(SLIDING).to_xarray()
    stored, source = tree["tiny/friction-speed"], f"mdr-bem-crosscheck {version('mdr-bem-crosscheck')}"
    for attributes, seeds in ((fields.attrs, "5"), (stored.attrs, "5 to 6")):
        scene = made(json.loads(attributes["scene"]), Scene, "scene")
        assert replace(scene, motion=SLIDING.motion) == SLIDING
        assert (attributes["source"], attributes["seeds"]) == (source, seeds)
    assert tree.attrs == {"source": source}
    assert provenance(SLIDING, [1, 2, 3, 5, 10_001])["seeds"] == "1 to 3, 5, 10001"
    for name, unit, axis in (("x", "m", {"axis": "X"}), ("pressure", "Pa", {})):
        assert fields[name].attrs == {"units": unit, "long_name": name, "comment": FIELDS[name].text, **axis}
    assert stored.speed.attrs["units"] == "m/s"


SHARES = 0, 1, "2 mm", "200%", True, float("nan"), "-1%"
NO_EXECUTOR = r"executor = .*: an object with submit is needed, without a scheduler"


@pytest.mark.parametrize(
    ("asked", "message"),
    [
        ({"speeds": [1.0]}, "argument of sweep = speeds: allowed are scene, speed, .*; did you mean speed"),
        ({"speed": []}, "speed = .*at least one"),
        ({"speed": [-0.1]}, "speed = .-0.1.*finite numbers of zero or more"),
        ({"speed": [0.1], "load": [1.0], "depth": [1e-5]}, "load, depth: both"),
        ({"speed": [0.1], "draws": 0}, "draws = 0"),
        ({"speed": [float("nan")]}, "speed = .nan"),
        ({"speed": itertools.count(1)}, "speed = count.*: at most 1,000 values"),
        ({"speed": "1mm/s..5mm"}, "speed = '1mm/s..5mm': a speed, such as"),
        ({"load": ["1 N", "0N..2N"]}, "load = .*'0N..2N'.: a range has finite ends above zero"),
        ({"depth": "1um..2um:1e3"}, "depth = '1um..2um:1e3': .*'1e3'"),
        ({"speed": {"a": 1.0}}, "speed = .*a set has no order, nor has a mapping"),
        ({"speed": object()}, "speed = <object.*a speed, such as"),
        *(({"interval": each}, r"interval = .*: a share above 0 and below 1, as 2% or 0\.02") for each in SHARES),
        ({"draws": 3, "interval": "2%"}, "draws, interval: both given"),
        *(
            ({"workers": each}, f"workers = {each}: a whole number from 1 to 1024")
            for each in (0, 1025, True, 1.5)
        ),
        *(({"executor": each, "scheduler": "tcp://name:1"}, NO_EXECUTOR) for each in ("mine", Here())),
    ],
)
def test_a_mistake_in_a_sweep_is_said_before_anything_is_solved(tmp_path, asked, message):
    with pytest.raises(InvalidInput, match=message):
        compare.sweep(SLIDING, output=tmp_path / "no", **asked)
    assert not (tmp_path / "no").exists()


@pytest.mark.parametrize(
    ("given", "numbers"),
    [
        ("1mm/s..1m/s", 10 ** (np.arange(10) / 3 - 3)),
        ("8mm/s..1mm/s:4", [1e-3, 2e-3, 4e-3, 8e-3]),
        (["1 mm/s, 0 m/s", 0.5, "3mm/s..3.1mm/s"], [0, 1e-3, 3e-3, 3.1e-3, 0.5]),
        (None, [0.1]),
    ],
)
def test_speeds_are_numbers_texts_with_units_and_ranges_of_three_to_a_decade(given, numbers):
    assert SweepSeries.of(SLIDING, given).speeds == pytest.approx(tuple(numbers))


def test_a_scene_shows_the_fields_of_its_parts_with_their_units():
    text, lines = shown(SLIDING), str(SLIDING).splitlines()
    for cell in ("indenter", "Sphere", "motion.load", "N", "roughness.amplitudes", "fixed"):
        assert f">{cell}<" in text
    assert "motion.depth" not in text  # which is not given
    assert [line.split() for line in lines[:2]] == [["indenter", "Sphere"], ["indenter.radius", "0.01", "m"]]


def test_a_result_shows_every_number_with_its_unit_and_escapes_what_it_holds():
    result = MDR(points=300).solve(SLIDING)
    text = shown(result)
    for name in ("normal_force", "depth", "friction_coefficient", *result.measures, *result.fields):
        assert f">{name}<" in text
    assert ">N<" in text
    title, *lines = str(result).splitlines()
    assert title.startswith(f"MDR, points = {result.settings['points']}, ")
    assert lines[0].split() == ["normal_force", f"{result.normal_force:.6g}", "N"]
    hostile = replace(result, settings={"points": "<script>"}, measures={"<b>\u202e": 1.0})
    for shown_as in (hostile._repr_html_(), str(hostile).replace("\n", "")):
        assert shown_as.isprintable()
    assert not re.search("<script>|<b>", hostile._repr_html_())
