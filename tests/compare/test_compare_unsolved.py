"""Contacts without an answer: named before everything else, and when they make a command fail."""

import json

import pytest
from processes import ask

from bem3d import BEM
from compare.solving.task import Outcome, Row, SceneTask
from compare.solving.unsolved import Unsolved
from scene import Indent, Kelvin, Scene, Sphere

pytestmark = pytest.mark.usefixtures("in_this_process")

SOLVED = Row(1.0, 1.0, 0.0)
WHY = "the contact covers {} of 32 points: take more points"


def contacts(rows):
    """As many contacts in 3D as there are rows, and their outcomes."""
    scenes = [Scene(Sphere(1e-2), Kelvin(1e6, 1e-3), Indent(load=1.0 + k)) for k in range(len(rows))]
    found = {SceneTask(BEM(), (scene,)): Outcome((row,)) for scene, row in zip(scenes, rows, strict=True)}
    return list(found), found


def failed(number):
    return Row(reason=WHY.format(number))


@pytest.mark.parametrize(("failures", "serious"), [(0, False), (1, False), (2, True), (20, True)])
def test_a_tenth_without_an_answer_makes_a_command_fail(failures, serious):
    rows = [failed(k) for k in range(failures)] + [SOLVED] * (20 - failures)
    found = Unsolved.of(*contacts(rows))
    assert found.serious is serious
    assert bool(found.sentences) is (failures > 0)


def test_an_empty_contact_is_no_failure():
    found = Unsolved.of(*contacts([Row(0.0, 1.0, 0.0)] * 5))
    assert (found.failed, found.sentences, found.notes, found.serious) == ([], (), (), False)


def test_the_contact_of_the_scene_itself_makes_a_command_fail_alone():
    tasks, outcomes = contacts([failed(0)] + [SOLVED] * 99)
    assert not Unsolved.of(tasks, outcomes).serious
    found = Unsolved.of(tasks, outcomes, own=tasks[:1])
    assert found.serious
    assert "the scene's own among them" in found.sentences[0]


def test_reasons_that_differ_by_numbers_alone_are_one_and_what_broke_is_not_counted():
    tasks, outcomes = contacts([failed(3), failed(4), Row(reason="another: press less"), SOLVED, SOLVED])
    del outcomes[tasks[-1]]
    found = Unsolved.of(tasks, outcomes)
    (line,) = found.sentences
    assert line == (
        "3 of 4 contacts have no answer: 3 of 4 in 3D; they are left out. "
        f"2 of them: {WHY.format(3)}; 1 of them: another: press less"
    )


# These few points do not determine its friction, which only the solve shows.
BLUNT = """
[indenter]
type = "power-law"
coefficient = 1e296
exponent = 100
[elastomer]
type = "kelvin"
modulus = 1e6
relaxation_time = 1e-3
[motion]
type = "slide"
speed = 3e-3
load = 1.0
[study]
speeds = [3e-3]
pressing = [1.0]
load_speeds = [3e-3]
depths = [1.0]
[bem]
points = 64
[mdr]
points = 500
"""


def test_a_run_without_its_own_contact_says_so_before_the_answer_and_ends_with_1(tmp_path):
    blunt = tmp_path / "blunt.toml"
    blunt.write_text(BLUNT)

    def run(*options):
        return ask("run", blunt, "--output", tmp_path, "--workers", 1, *options)

    shown = run()
    assert shown.exit_code == 1
    text = " ".join(shown.stdout.split())
    places = [
        text.index(each) for each in ("Doubtful: slope of the body", "the scene's own among them", "friction 0.0")
    ]
    assert places == sorted(places)
    assert "take about 158 points" in text  # what to do
    page = (tmp_path / "report.html").read_text()
    assert page.index("have no answer") < page.index('class="answer"')
    quiet = run("-q", "--no-report")
    assert (quiet.exit_code, quiet.stdout) == (1, "")
    assert "crosscheck: " in quiet.stderr
    assert "have no answer" in quiet.stderr
    printed = run("--json", "--no-report")
    assert any("have no answer" in each for each in json.loads(printed.stdout)["doubts"])
