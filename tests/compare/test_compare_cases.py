"""A case file holds what it should, and each mistake in it is named before anything is solved."""

from dataclasses import replace

import pytest
from scene_files import SCENE
from typer.testing import CliRunner

from compare.cli.app import app
from compare.library.lookup import case_of, named_cases
from compare.studies.comparison.around import OWN, SMOOTH_DEPTH, Around
from scene import Coulomb, Elastic, Indent, Slide
from scene.files.reading import InvalidInput
from scene.scales import elastic_contact


@pytest.fixture
def case(tmp_path):
    path = tmp_path / "case.toml"
    path.write_text(SCENE)
    (case,) = named_cases(path).values()
    return case


def test_a_scene_alone_is_a_case(case):
    plan, radius = case.plan(), elastic_contact(case.scene).radius
    assert case.scene.motion.speed in set(plan.speeds) & set(plan.load_speeds)
    assert 1.0 in set(plan.pressing) & set(plan.depths)
    assert min(plan.smooth_speeds) * 1e-3 == pytest.approx(0.01 * radius)
    assert max(plan.smooth_speeds) * 1e-3 == pytest.approx(100 * radius)


@pytest.mark.parametrize("motion", [Indent(load=1.0), Slide(speed=0.1, load=1.0)])
def test_friction_of_the_interface_is_compared_in_the_own_contact_alone_and_at_rest_with_the_closed_form(
    case, motion
):
    found = Around("a case", replace(case, interface=Coulomb(0.3), motion=motion)).curves
    assert set(found[SMOOTH_DEPTH].levels) == {"MDR", "BEM", "exact"}
    assert [name for name, each in found.items() if any(each.speeds)] == [OWN] * bool(motion.speed)


def test_the_same_loads_are_meant_where_the_depth_is_prescribed(case):
    contact = elastic_contact(case.scene)
    deep = replace(case, motion=Slide(speed=0.1, depth=contact.depth))
    for factor, load in zip(deep.plan().pressing, case.plan().pressing, strict=True):
        pressed = replace(deep.scene, motion=Slide(speed=0.1, depth=factor * contact.depth))
        assert elastic_contact(pressed).load == pytest.approx(load * contact.load)


def test_what_has_no_friction_has_no_speeds_and_a_smooth_case_one_surface(case):
    for change in ({"motion": Indent(load=1.0)}, {"elastomer": Elastic(modulus=1e6)}):
        plan = replace(case, **change).plan()
        assert not plan.speeds + plan.load_speeds + plan.smooth_speeds
        assert plan.depths
    assert min(replace(case, motion=Slide(speed=0.0, load=1.0)).plan().speeds) > 0
    flat = replace(case, roughness=replace(case.roughness, rms_height=0.0))
    assert flat == replace(case, roughness=None)
    assert (flat.plan().surfaces, flat.plan().profiles) == (1, 1)


MISTAKES = {
    "a value that stands there twice": (SCENE + "[study]\nspeeds = [0.1, 0.1]\n", "twice"),
    "a shape that one solver lacks": (
        SCENE.replace('"sphere"', '"cylinder"').replace("load = 1.0", "line_load = 1.0"),
        "indenter = Cylinder",
    ),
    "numbers too far apart": (SCENE.replace("load = 1.0", "depth = 1e300"), "far apart"),
}


@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_mistake_is_named_with_exit_status_2_and_nothing_is_written(tmp_path, mistake):
    text, said = MISTAKES[mistake]
    path = tmp_path / "case.toml"
    path.write_text(text)
    answer = CliRunner().invoke(app, ["run", str(path), "--output", str(tmp_path / "out")])
    assert answer.exit_code == 2
    assert said in answer.stderr
    assert not answer.stdout
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("name", ["solved", "report.html"])
def test_a_folder_that_cannot_be_written_into_is_named_before_anything_is_solved(tmp_path, name):
    (tmp_path / "case.toml").write_text(SCENE)
    (tmp_path / "out").mkdir()
    taken = tmp_path / "out" / name
    taken.mkdir() if name == "report.html" else taken.write_text("")
    answer = CliRunner().invoke(app, ["run", str(tmp_path / "case.toml"), "--output", str(tmp_path / "out")])
    assert answer.exit_code == 2
    assert f"{taken}: " in answer.stderr


NAMED = {"tolerance": 1e-5, "surfaces": 2, "speed": 0.1, "modulus": 1.0, "radius": 1.0, "stages": [], "hurst": 0.5}
TABLES = {
    "indenter": '[indenter]\ntype = "sphere"\nradius = 1e-2\n',
    "elastomer": '[elastomer]\ntype = "kelvin"\nmodulus = 1e6\nrelaxation_time = 1e-3\n',
    "motion": '[motion]\ntype = "slide"\nspeed = 0.1\nload = 1.0\n',
}
VALUES = [
    "64",
    "true",
    "[1, [2]]",
    "[{}]",
    "{type = 1}",
]


@pytest.mark.parametrize("value", VALUES)
@pytest.mark.parametrize("table", ["indenter", "elastomer", "motion", "roughness", "study", "bem", "mdr", "layer"])
def test_a_table_that_is_something_else_is_a_mistake_wherever_its_names_stand(tmp_path, table, value):
    names = "".join(f"{name} = {each}\n" for name, each in NAMED.items())
    parts = "".join(text for name, text in TABLES.items() if name != table)
    path = tmp_path / "case.toml"
    path.write_text(f"{table} = {value}\n{names}{parts}", encoding="utf-8")
    with pytest.raises(InvalidInput) as raised:
        case_of(path)
    said = str(raised.value)
    for name in NAMED:
        assert f": {name}" in said
