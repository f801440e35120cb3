"""A user's own study: a file says what Python says, each mistake in it is named, it is judged as any other."""

from dataclasses import replace

import numpy as np
import pytest
from small_cases import HEAD, SHARED, TABLES

from compare.studies.comparison import asked
from compare.studies.comparison.study_file import STUDIES, study_of
from scene import Cone, Indent, Kelvin, Program, Scene, SelfAffine, Slide, Sphere, Stage
from scene.files.reading import InvalidInput

SERIES = """
[[series]]
name = "a"
[[series]]
name = "b"
title = "Another"
[series.indenter]
type = "cone"
angle = "10 deg"
[series.roughness]
hurst = 0.6
"""
TEXT = HEAD + SHARED + TABLES + SERIES


KELVIN = '"kelvin"\nmodulus = "1 MPa"\nrelaxation_time = "1 ms"'


def stated(text, size="quick"):
    return study_of(text, "mine").series(size)


def mistakes_in(text):
    with pytest.raises(InvalidInput) as raised:
        stated(text)
    return str(raised.value).splitlines()


def test_a_file_says_what_python_says():
    first, second = stated(TEXT)
    rough = SelfAffine(hurst=0.2, rms_height=50e-6, longest=10e-3, shortest=2e-3, seed=1)
    assert first.scene == Scene(Sphere(10e-3), Kelvin(1e6, 1e-3), Slide(speed=0.05, load=0.5), rough)
    assert (first.speeds, first.values) == ((0.05, 0.1, 0.2), tuple(np.geomspace(0.5, 2.0, 4)))
    assert (first.surfaces, first.profiles, first.bem.points, first.mdr.points) == (2, 3, 32, 400)
    assert (first.name, first.title, second.title) == ("a", "a", "Another")
    assert second.scene == replace(first.scene, indenter=Cone("10 deg"), roughness=replace(rough, hurst=0.6))
    study = study_of(TEXT, "mine")
    assert (study.title, study.about) == ("Mine", "What I ask.")
    assert type(study) is type(STUDIES["collapse"])


def test_what_a_file_leaves_out_follows_from_the_size():
    short = TEXT.replace("surfaces = 2\nprofiles = 3\n", "").replace("[bem]\npoints = 32\n", "")
    short = short.replace(", count = 4", "").replace('["50 mm/s", 0.1, 0.2]', "{ least = 0.05, greatest = 0.2 }")
    for size, speeds, values, *draws in (("quick", 6, 4, 3, 12, 128), ("standard", 12, 8, 10, 60, 256)):
        series = stated(short, size)[0]
        assert [series.surfaces, series.profiles, series.bem.points] == draws
        assert (len(series.speeds), len(series.values)) == (speeds, values)
        assert series.speeds[0] == 0.05
        assert series.speeds[-1] == pytest.approx(0.2, rel=1e-15)  # of a power
    assert stated(TEXT, "standard") == stated(TEXT)


def test_a_ready_scene_may_stand_below_all_tables():
    text = HEAD + 'scene = "paper-sphere"\n' + SHARED + "[[series]]\nname = 'a'\n[series.roughness]\nhurst = 0.5\n"
    (series,) = stated(text)
    assert series.scene.indenter == Sphere(1e-2)
    assert series.scene.roughness == SelfAffine(hurst=0.5, rms_height=5e-5, longest=1e-2, shortest=5e-4, seed=1)


def test_what_a_size_states_lies_over_what_is_stated_at_all_and_a_series_has_the_last_word():
    sizes = """
    [sizes.standard]
    surfaces = 5
    loads = { count = 3 }
    bem = { points = 48 }
    interval = "10%"
    """
    own = 'only = ["standard", "full"]\nbem.points = 64\nsizes.full.bem.points = 128\ntitle ='
    text = TEXT.replace("[[series]]", f"{sizes}[[series]]", 1).replace('title = "Another"', own + ' "Another"')
    quick, standard, full = (stated(text, size) for size in ("quick", "standard", "full"))
    assert [each.name for each in quick] == ["a"]
    assert (quick[0].surfaces, len(quick[0].values), quick[0].bem.points, quick[0].interval) == (2, 4, 32, None)
    assert [(each.surfaces, len(each.values), each.interval) for each in standard] == [(5, 3, 0.1)] * 2
    assert [each.bem.points for each in standard] == [48, 64]
    assert [each.bem.points for each in full] == [32, 128]


def test_depths_may_be_those_of_the_smooth_relaxed_body_under_loads():
    series = stated(TEXT.replace('name = "a"', 'name = "a"\nprescribed = "depth"'))[0]
    modulus = 8 / 3 * 1e6 / 0.5  # 4 E* / 3
    assert series.prescribed == "depth"
    assert series.slides
    expected = (np.geomspace(0.5, 2.0, 4) / (modulus * 0.1)) ** (2 / 3)
    assert series.values == pytest.approx(expected, rel=1e-9)


def test_bodies_rest_without_speeds_and_are_pressed_in_at_rates():
    rest = stated(TEXT.replace('speeds = ["50 mm/s", 0.1, 0.2]', ""))[0]
    assert rest.speeds == ()
    assert rest.scene.motion == Indent(load=0.5)
    pressed = TEXT.replace("speeds =", "rates =").replace("loads = { least", "depths = { least")
    pressed = pressed.replace('"0.5 N", greatest = 2', '"50 um", greatest = 2e-4')
    series = stated(pressed)[0]
    assert series.scene.motion == Program(stages=(Stage(duration=1.0, depth=50e-6),))
    assert series.speeds == (0.05, 0.1, 0.2)


def test_what_a_series_states_of_its_motion_replaces_what_is_shared():
    text = TEXT.replace('name = "a"', 'name = "a"\ndepths = ["50 um"]\nrates = [0.1]')
    first, second = stated(text)
    assert (first.prescribed, first.slides) == ("depth", False)
    assert (second.prescribed, second.slides) == ("load", True)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('name = "b"', 'name = "A"', ["series: series 'A': has the folder of 'a'"]),
        (", 0.1, 0.2]", "]", ["series.0: speeds: at least two", "series.1: speeds: at least two"]),
        (
            "greatest = 2",
            "greatest = 0.2",
            ["series.0: loads: both ends of a range, or a list"],
        ),
        ("surfaces = 2", "depths = [1e-4]", ["series.0: loads, depths: both given", "series.1: loads, depths"]),
        ("points = 32", "points = 24", ["series.0: bem.points = 24: at least 32", "series.1: bem.points"]),
        (
            "hurst = 0.6",
            "rms_height = 0",
            ["series.1: roughness.rms_height = 0: a study asks"],
        ),
        (KELVIN, '"elastic"\nmodulus = 1', ["series.0: speeds"]),
        (SERIES, "", ["series: missing, a list"]),
    ],
)
def test_a_mistake_is_named_with_its_place(old, new, message):
    assert old in TEXT
    lines = mistakes_in(TEXT.replace(old, new, 1))
    for line in message:
        assert any(each.startswith(f"mine: {line}") for each in lines), lines


def test_mistakes_are_named_at_once_first_those_of_the_file_then_those_of_contacts_put_together():
    text = TEXT.replace("hurst = 0.6", "hurst = 6").replace('"10 deg"', '"10 m"')
    named = [line.split(" = ")[0] for line in mistakes_in(text)]
    assert named == ["mine: series.1: indenter.angle", "mine: series.1: roughness.hurst"]
    text = text.replace("surfaces", "surfases").replace('"50 mm/s"', '"50 Pa"')
    assert [line.split(" ")[1] for line in mistakes_in(text)] == ["surfases", "speeds.0"]


def test_a_file_is_a_study_of_the_command(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text(TEXT, encoding="utf-8")
    study = asked.study(path)
    assert (study.place, study.title, study.inputs["source"]) == ("mine-quick", "Mine", TEXT)
