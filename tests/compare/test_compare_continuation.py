"""Contacts of a surface are one task: each starts from the last, and the answers are those of solves alone."""

from dataclasses import replace
from itertools import chain, product

import numpy as np
import pytest
from small_cases import CURVE

from bem3d import BEM
from compare.solving import continuation
from compare.solving.continuation import Continuation, by_contact
from compare.solving.curve import contacts_of, on_two_levels, tasks_of
from compare.solving.digest import key
from compare.solving.store import Store
from mdr1d import MDR
from scene import Indent, Program, Stage


def test_a_path_is_all_speeds_of_one_surface_and_load_from_rest_on_and_from_coarse_to_fine():
    paths = [each.contacts for each in CURVE.tasks() if isinstance(each, Continuation)]
    assert len(paths) == 2 * 2  # loads, surfaces
    for path in paths:
        scenes = [contact.scenes[0] for contact in path]
        assert len({(scene.motion.load, scene.roughness.seed) for scene in scenes}) == 1
        places = [(getattr(one.scenes[0].motion, "speed", 0.0), one.solver.points) for one in path]
        assert places == list(product((0.0, 0.1, 0.2), (32, 64)))
    assert {*chain(*paths)} == {each for each in contacts_of({"": CURVE}) if each.solver.name == "BEM"}


def test_the_order_of_what_is_asked_changes_no_task():
    turned = replace(CURVE, speeds=CURVE.speeds[::-1], values=CURVE.values[::-1])
    assert {key(task) for task in turned.tasks()} == {key(task) for task in CURVE.tasks()}
    assert len({key(task) for task in CURVE.tasks()}) == len(CURVE.tasks())


def test_a_path_is_cut_where_it_would_take_longer_than_a_minute(monkeypatch):
    (whole,) = replace(CURVE, values=(0.5,), draws={"BEM": 1}, levels=on_two_levels(BEM(points=64))).tasks()
    monkeypatch.setattr(continuation, "LONGEST", 0.4 * whole.work)
    parts = continuation.joined(whole.contacts)
    assert len(parts) > 2
    assert [one for each in parts for one in getattr(each, "contacts", (each,))] == list(whole.contacts)
    assert all(each.work <= 0.4 * whole.work for each in parts)
    monkeypatch.setattr(continuation, "LONGEST", 0.0)
    assert continuation.joined(whole.contacts) == list(whole.contacts)


def test_programs_and_contacts_that_keep_fields_stay_alone():
    program = replace(CURVE.scene, motion=Program(stages=(Stage(duration=1.0, depth=1e-5),)))
    pressed = replace(CURVE, scene=program, speeds=(1e-5, 1e-4), values=(1e-5,))
    assert not [each for each in pressed.tasks() if isinstance(each, Continuation)]
    kept = [each for each in replace(CURVE, keeps_fields=True).tasks() if each.keeps_fields]
    assert {type(each.solver) for each in kept} == {MDR, BEM}


@pytest.fixture(scope="module")
def solved():
    finer = on_two_levels(MDR(points=200), BEM(points=128))
    tasks = replace(CURVE, values=(0.5,), levels=finer).tasks()
    return {task: task.solve() for task in tasks}


def test_a_path_answers_as_solves_alone_do_to_the_tolerance_in_fewer_transforms(solved):
    pairs = np.zeros(2)
    for contact, outcome in by_contact(solved).items():
        (alone,), (found,) = (each.rows[:1] for each in (contact.solve(), outcome))
        np.testing.assert_allclose(found.normal_force, alone.normal_force, rtol=1e-4)
        np.testing.assert_allclose(found.depth, alone.depth, rtol=1e-4)
        np.testing.assert_allclose(found.friction_force, alone.friction_force, rtol=1e-3)
        assert found.settings == alone.settings
        if contact.solver.name == "BEM":
            pairs += [each.measures["transform_pairs"] * contact.solver.points**2 for each in (found, alone)]
    assert pairs[0] < 0.85 * pairs[1]


def test_equal_paths_have_equal_digits_and_are_kept_whole(solved, tmp_path):
    store = Store(tmp_path)
    for task in (each for each in solved if isinstance(each, Continuation)):
        again = task.solve()
        for one, other in zip(solved[task].rows, again.rows, strict=True):
            assert replace(one, seconds=0.0) == replace(other, seconds=0.0)
        store.put(task, again)
        assert store.get(task) == again
        shorter = Continuation(task.contacts[:-1])
        assert store.get(shorter) is None
        assert not shorter.fits(again)


def test_a_contact_without_an_answer_has_its_reason_and_those_behind_it_are_solved():
    """The last is finer than its waves, the first is not."""
    fine = replace(CURVE.scene, roughness=replace(CURVE.scene.roughness, shortest=1.5e-4))
    (found,) = tasks_of(
        {"": replace(CURVE, scene=fine, values=(0.5,), draws={"BEM": 1}, levels=on_two_levels(BEM(points=64)))}
    )
    outcome = found.solve()
    reasons = [row.reason is None for row in outcome.rows]
    assert reasons == [False, True] * 3
    assert "points" in outcome.rows[0].reason
    broken = found.failed("its worker died")
    assert found.fits(broken)
    assert {row.reason for row in broken.rows} == {"its worker died"}


def test_contacts_at_a_depth_and_at_a_load_are_on_different_paths():
    deep = replace(CURVE, scene=replace(CURVE.scene, motion=Indent(depth=1e-5)), values=(0.5,))
    both = {"load": replace(CURVE, values=(0.5,)), "depth": deep}
    assert set(tasks_of(both)) == {task for each in both.values() for task in each.tasks()}
