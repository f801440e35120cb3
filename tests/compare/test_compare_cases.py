"""A case file holds what it should, and each mistake in it is named before anything is solved."""

from dataclasses import replace

import pytest
from processes import ask
from small_cases import SCENE

from compare.library.lookup import named_cases
from compare.studies.comparison.around import OWN, SMOOTH_DEPTH, Around
from scene import Coulomb, Indent, Slide
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


def test_what_starts_from_rest_has_speeds_and_a_smooth_case_one_surface(case):
    assert min(replace(case, motion=Slide(speed=0.0, load=1.0)).plan().speeds) > 0
    flat = replace(case, roughness=replace(case.roughness, rms_height=0.0))
    assert flat == replace(case, roughness=None)
    assert (flat.plan().surfaces, flat.plan().profiles) == (1, 1)


@pytest.mark.parametrize("name", ["solved", "report.html"])
def test_a_folder_that_cannot_be_written_into_is_named_before_anything_is_solved(tmp_path, name):
    (tmp_path / "case.toml").write_text(SCENE)
    (tmp_path / "out").mkdir()
    taken = tmp_path / "out" / name
    taken.mkdir() if name == "report.html" else taken.write_text("")
    answer = ask("run", tmp_path / "case.toml", "--output", tmp_path / "out")
    assert answer.exit_code == 2
    assert f"{taken}: " in answer.stderr
