"""The page on effects: every chapter comes out of its answers, and how its means are written."""

from dataclasses import replace

import effects
import numpy as np
import pytest
from effects_page import costs, shear, topography
from effects_page.catalogue import STUDIES
from effects_page.means import estimate, mean, written

from compare.report.plots import style
from compare.solving.outcome import Outcome, Row
from compare.solving.store import key
from scene import SolveError

POINTS = {"MDR": 200, "BEM": 32}  # of a sketch


def sketched(tasks):
    """Answers of all tasks on coarse grids; NaN where a coarse grid has none."""
    found = {}
    for task in tasks:
        solver, scenes = task.solver, task.scenes
        coarse = replace(solver, points=min(solver.points, POINTS[solver.name]), steps=min(solver.steps, 10))
        try:
            found[task] = replace(task, solver=coarse).solve()
        except SolveError as error:
            found[task] = Outcome((Row(reason=str(error)),) * len(scenes))
    return found


# That on topography has a test of its own, test_effects_topography.py.
@pytest.mark.parametrize(
    "study", [study for study in STUDIES if study is not topography], ids=lambda study: study.NAME
)
def test_every_task_of_a_chapter_is_asked_once_and_refused_by_no_one(study):
    tasks = study.tasks()
    assert len({key(task) for task in tasks}) == len({(task.solver, task.scenes) for task in tasks})
    assert not [reason for task in tasks for scene in task.scenes for reason in task.solver.refusals(scene)]


@pytest.mark.slow
@pytest.mark.parametrize("study", STUDIES, ids=lambda study: study.NAME)
def test_every_chapter_has_its_numbers_tables_and_figures(study):
    outcomes = sketched(study.tasks())
    with style.applied():
        chapter = study.chapter(outcomes)
    assert all(chapter.tables.values())
    page = effects.PAGE.read_text(encoding="utf-8")
    for name, rows in chapter.tables.items():
        assert f"<!-- {name} -->\n| {' | '.join(rows[0])} |" in page
    assert chapter.figures.keys() == chapter.data.keys() != set()
    assert all(figure.axes for figure in chapter.figures.values())
    failed = {task: task.failed("on purpose") for task in study.tasks()[:1]}
    with style.applied():
        assert study.chapter(outcomes | failed) != chapter


def test_curves_of_partial_slip_are_given_back_where_they_follow_cattaneo_and_mindlin():
    from compare.models.exact import tangential

    def answer(task, scene):
        if scene.motion.type != "shear":
            return Row(normal_force=1 - float(tangential.force(1 - scene.motion.depth / shear.DEPTH)))
        full = tangential.full_slip_displacement(shear.FRICTION, shear.DEPTH, scene.solid.poisson_ratio)
        share = min(scene.motion.displacement / full, 1.0)
        stick = {"BEM": "stick_area", "MDR": "stick_length"}[task.solver.name]
        friction = shear.FRICTION * float(tangential.force(share if share < 1 - 1e-9 else 1.0))
        return Row(1.0, friction_force=friction, measures={stick: float(share < 1 - 1e-9) * (1 - share)})

    outcomes = {task: Outcome(tuple(answer(task, scene) for scene in task.scenes)) for task in shear.tasks()}
    for curve in shear.curves(outcomes).values():
        assert curve.full == pytest.approx(np.ones(np.size(curve.full)))
        assert curve.off(1.0) < 1e-12


def test_what_effects_cost_is_said_without_a_single_answer():
    assert "nothing was solved" in costs.said(costs.costs({}))


@pytest.mark.parametrize(
    ("values", "text"),
    [
        ([0.01030, 0.01031, 0.01032], "0.010310 (0.010285 to 0.010335)"),
        ([0.25], "0.25"),
        ([0.25, 0.25 * (1 + 1e-9)], "0.25"),
        ([], "undecided"),
        ([np.nan], "undecided"),
    ],
)
def test_means_are_written_with_two_digits_of_their_scatter_if_they_have_one(values, text):
    assert mean(values) == text
    assert written(estimate(values), "N").startswith(text)
