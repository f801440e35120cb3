"""`crosscheck plan`: both solvers' plans of a file, and what it says of a file that cannot be solved."""

import re
from dataclasses import replace

import numpy as np
import pytest
from planned import held_by
from processes import ask
from small_cases import SCENE
from solids import gel

import compare
from bem3d import BEM
from compare.library.case import Variations
from compare.library.lookup import case_of
from compare.solving.cost import seconds_per_work, work_of
from compare.studies.answers import answer
from compare.studies.comparison import asked
from compare.studies.comparison.around import left_by_grid
from compare.studies.comparison.series import pilot
from compare.studies.plan import plans
from compare.trustmap.verdict import trust
from scene import Doubtful, Scene, Slide, Sphere

PLANE = """
[indenter]
type = "plane"
[elastomer]
type = "elastic"
modulus = 1e6
[motion]
type = "indent"
pressure = 1e4
[roughness]
type = "self-affine"
hurst = 0.8
rms_height = 1e-6
longest = 1e-3
shortest = {shortest}
"""


@pytest.fixture
def written(tmp_path):
    def write(text):
        path = tmp_path / "scene.toml"
        path.write_text(text, encoding="utf-8")
        return path

    return write


def test_a_plan_counts_the_contacts_that_a_run_solves():
    narrow = replace(case_of("paper-sphere"), study=Variations(interval=0.001))
    found, cost = plans(narrow), asked.run(narrow).cost()
    assert found.cost == cost
    assert f"contacts   at most {cost.contacts:,}, " in str(found)


def test_a_plan_says_what_intervals_take_before_anything_is_solved():
    found = plans("quick-start")
    ten, _, two, one = found.accuracies
    assert [each.interval for each in found.accuracies] == [0.1, 0.05, 0.02, 0.01]
    assert ten.surfaces == sum(pilot(2))
    # the square of two, and more as the grid takes its part
    assert 3 < (one.surfaces - 4) / (two.surfaces - 4) < 8
    assert 3 < one.seconds / two.seconds < 8
    assert f"10 %: {ten.surfaces} surfaces on up to 64 points a side, " in str(found)
    assert answer(found).accuracies == found.accuracies
    # where waves are short the grid leaves no room for narrow intervals: more points are needed
    coarse = plans(replace(found.case, roughness=replace(found.scene.roughness, shortest=2e-4))).accuracies
    assert 64 <= coarse[0].points < coarse[-1].points
    off_the_map = replace(found.case, roughness=replace(found.scene.roughness, shortest=1e-7))
    for none in ("hertz", "there-and-back", "rough-plane", off_the_map):
        assert plans(none).accuracies == ()


@pytest.mark.parametrize("asking", [asked.run, asked.sweep])
def test_where_no_points_are_stated_the_grid_leaves_half_of_an_interval_to_the_scatter(asking):
    case = case_of("paper-sphere")
    stated = replace(case, bem=BEM(points=140))
    chosen, own = (asking(each, interval="0.1%").series[0].models["BEM"].solver for each in (case, stated))
    assert 0.97 < left_by_grid(chosen, case.scene) / 0.0005 <= 1
    assert own == stated.bem


@pytest.mark.slow
def test_a_sweep_to_an_interval_takes_the_work_that_was_planned(tmp_path):
    planned, scene = plans("paper-sphere").accuracies[2], case_of("paper-sphere").scene
    found = compare.sweep("paper-sphere", interval=planned.interval, output=tmp_path, report=False)
    found = found.sel(model="BEM", level=found["points"].sel(model="BEM") > 0)
    works = [work_of(BEM(points=int(each)), scene) for each in found["points"]]
    spent = float(found["friction_force"].notnull().sum("surface").values.ravel() @ works)
    assert 0.5 < planned.seconds / seconds_per_work() / spent < 2


# A solid with the shortest time that a number holds.
FASTEST = """[indenter]
type = "sphere"
radius = 0.01

[elastomer]
type = "prony"
instantaneous_modulus = 1e7
g = [0.2, 0.3]
tau = [5e-324, 1.0]

[motion]
type = "indent"
load = 1.0
"""
PROGRAM = """[motion]
type = "program"
stages = [{duration = 1.0, load = 1.0}, {duration = 1e9, speed = 1.0}]
"""


@pytest.mark.parametrize(
    ("text", "status", "lines"),
    [
        (PLANE.format(shortest=1e-4), 0, ["MDR cannot solve this scene: indenter = Plane", "left out"]),
        (
            PLANE.format(shortest=1e-6),
            2,
            ["MDR cannot solve this scene", "BEM cannot solve this scene: roughness."],
        ),
        (SCENE.partition("[motion]")[0] + PROGRAM, 2, ["would not get through this scene"]),
        (
            FASTEST,
            2,
            ["not known: the numbers of the scene are too far apart", "MDR would not get through this scene"],
        ),
    ],
    ids=["refused by one", "refused by both", "too many steps", "shortest time of all"],
)
def test_what_is_refused_stands_in_the_plan_and_in_its_status(written, text, status, lines):
    answer = ask("plan", written(text))
    assert answer.exit_code == status
    for each in lines:
        assert each in answer.output


def test_a_plan_holds_next_to_nothing_whatever_the_solve_would(written):
    path = written(SCENE + "[bem]\npoints = 4096\n[mdr]\npoints = 100000\n")
    plans(path)
    found, most = held_by(plans, path)
    assert found["BEM"].memory > 2e9
    assert most < 1e7  # the profile's surface is drawn on few nodes to lay out its grid


def test_what_no_grid_carries_is_planned_for_the_models_that_answer_it(written, tmp_path):
    """A map of 2 um waves on a contact of some 500 um, which 128 points a side do not carry."""
    np.save(tmp_path / "map.npy", 1e-7 * np.random.default_rng(3).standard_normal((64, 64)))
    text = SCENE.split("[roughness]")[0].replace("load = 1.0", "load = 0.02")
    path = written(
        f'{text}[roughness]\ntype = "topography"\nfile = "{tmp_path}/map.npy"\npixel = "1 um"\nunit = "m"\n'
    )
    planned = ask("plan", path)
    assert planned.exit_code == 0
    assert "solved by crosscheck run" in planned.stdout
    assert "BEM cannot solve this scene: roughness.shortest" in " ".join(planned.stdout.split())
    asked = ask("run", path, "--models", "mdr,bem", "--output", tmp_path / "out")
    assert asked.exit_code == 2
    assert "on 128 points: roughness.shortest" in " ".join(asked.stderr.split())
    assert not (tmp_path / "out").exists()


def test_doubts_stand_first_in_a_plan_and_in_what_trust_says_and_are_warnings_in_python(written):
    path = written(SCENE.replace("radius = 1e-2", "radius = 12.7").split("[roughness]")[0])
    for command in ("plan", "trust"):
        answer = ask(command, path)
        first = " ".join(answer.output.split())
        assert re.match(r"doubtful:? +radius of the body = 12.7 m, above 1 m: .* is 12.7 mm meant\?", first)
        assert not answer.stderr
    for function in (compare.plan, compare.trust):
        with pytest.warns(Doubtful, match="is 12.7 mm meant") as warned:
            function(path)
        assert {each.filename for each in warned} == {__file__}


def test_every_command_doubts_the_same_of_a_table_and_run_and_plan_their_curves_too():
    slow, within = (
        case_of(Scene(Sphere(10e-3), gel(1.0), Slide(speed=speed, load=1.0))) for speed in (1e-6, 0.05)
    )
    sentences = asked.run({"a case": slow}).doubts
    assert sentences[0].startswith("frequencies of the contact below those of the table = 3.1")
    assert sentences[1].startswith("width of the interval of the modulus at rest")
    assert sentences == plans(slow).doubts
    assert sentences[:2] == asked.sweep(slow).doubts == tuple(map(str, trust(slow.scene).doubts))
    assert asked.sweep(slow, speed=1e-2).doubts == ()
    # The scene is within the table, its curves are not, and indent.
    assert trust(within.scene).doubts == ()
    curves = asked.run({"a case": within}).doubts
    assert {each.split(" = ")[0] for each in curves} == {
        "frequencies of the contact above those of the table",
        "width of the interval of the modulus at rest over that modulus",
    }
    assert curves == plans(within).doubts
