"""The chapter on partial slip: its numbers follow from the answers, and its tasks are each asked once."""

from dataclasses import replace

import numpy as np
import pytest
from effects_page import shear

from compare.exact import tangential
from compare.outcome import Outcome, Row
from compare.plots import style
from scene import Shear

FACTOR = 1.25  # of the displacement at which the rough bodies made up here slip, over that of the smooth


def answer(task, scene):
    """Of bodies that follow Cattaneo and Mindlin, rough ones over a longer way."""
    rough = scene.roughness is not None
    stretch, stick = (FACTOR if rough else 1.0), "stick_area" if task.solver.name == "BEM" else "stick_length"
    if not isinstance(scene.motion, Shear):
        left = scene.motion.depth / shear.DEPTH
        return Row(normal_force=1 - float(tangential.force((1 - left) / stretch)), friction_force=0.0)
    full = tangential.full_slip_displacement(shear.FRICTION, shear.DEPTH, scene.solid.poisson_ratio)
    share = min(scene.motion.displacement / full / stretch, 1.0)
    if share > 1 - 1e-9:
        share = 1.0
    return Row(
        normal_force=1.0,
        friction_force=shear.FRICTION * float(tangential.force(share)),
        applications=30.0,
        measures={stick: 1 - share, "tangential_applications": 20.0},
    )


@pytest.fixture(scope="module")
def outcomes():
    return {task: Outcome(tuple(answer(task, scene) for scene in task.scenes)) for task in shear.tasks()}


def test_every_task_is_asked_once_and_known_to_the_chapter(outcomes):
    asked = [(task.solver, task.scenes) for task in shear.tasks()]
    assert len(set(asked)) == len(asked)
    assert {len(task.scenes) for task in shear.tasks()} == {1, shear.SURFACES, shear.LINES}


def test_curves_find_where_all_slips_and_how_far_they_are_off(outcomes):
    found = shear.curves(outcomes)
    for way in ("smooth, 1D", "smooth, 3D", shear.UNCOUPLED):
        assert found[way].full == pytest.approx([1.0])
        assert found[way].off(1.0) < 1e-12
        # nine tenths, between two displacements of the ladder
        assert found[way].most == pytest.approx(tangential.displacement(0.9), abs=0.01)
    for way in ("rough, 1D", "rough, 3D"):
        assert found[way].full == pytest.approx(np.full(found[way].full.size, FACTOR))
        assert found[way].off(found[way].full) < 1e-12
        assert found[way].off(1.0) > 0.1
        assert found[way].off_superposed < 1e-12


def test_a_failed_solve_leaves_no_number(outcomes):
    task = next(task for task in shear.tasks() if len(task.scenes) == shear.SURFACES)
    failed = replace(outcomes[task], rows=(Row(reason="no"), *outcomes[task].rows[1:]))
    assert np.isnan(shear.curves(outcomes | {task: failed})["rough, 3D"].off(1.0))


def test_the_chapter_says_what_was_found_and_draws_it(outcomes):
    with style.applied():
        chapter = shear.chapter(outcomes)
    said = " ".join(chapter.text.split())
    assert "u = 1.25 times 3/2 μ d in 1D" in said  # of bodies that are all alike
    assert {len(rows) for rows in chapter.tables.values()} == {8, len(shear.POINTS)}
    assert chapter.tables["Operator applications at half of 3/2 μ d"][0]["smooth: ratio"] == "2.0"
    (drawing,) = chapter.figures.values()
    assert len(drawing.axes) == 2
    (rows,) = chapter.data.values()
    assert len(rows) == len(shear.SOLVERS) * len(shear.SHARES)
