"""The engine of work-precision diagrams: what a rung costs, what a failed one is, and a page from them."""

from dataclasses import replace
from math import isnan

import numpy as np
import pytest

from bem3d import BEM
from compare import run
from compare.store import Store
from compare.sweep import sweep
from compare.workprecision.catalogue import INQUIRIES
from compare.workprecision.contest import FORCE, FRICTION, ClosedForm, Contest, Finer, Known, Ladder
from compare.workprecision.diagram import Diagram
from compare.workprecision.report import PAGE
from compare.workprecision.rung import Rung
from mdr1d import MDR
from scene import Indent, Kelvin, Scene, SelfAffine, Slide, Sphere
from scene.scales import elastic_contact

SOLID = Kelvin(modulus=1e6, relaxation_time=1e-3)
PRESSED = Scene(Sphere(radius=10e-3), SOLID, Indent(depth=1e-4))
SLIDING = replace(PRESSED, motion=Slide(speed=1.0, depth=1e-4))
# Two pixels a wave at least: so many points a side, or a solve ends in an error.
FINE = SelfAffine(hurst=0.5, rms_height=1e-6, longest=2e-3, shortest=1e-4, seed=1)


def contest(**changed):
    exact = ClosedForm("Hertz", {"force": Known(elastic_contact(PRESSED).load)})
    ladder = Ladder.of("BEM", PRESSED, BEM(tolerance=1e-7), "points", (32, 64))
    return replace(Contest("sphere", "a sphere", exact, (FORCE,), (ladder,)), **changed)


@pytest.fixture(scope="module")
def solved(tmp_path_factory):
    ladders = (*contest().ladders, Ladder.of("MDR", PRESSED, MDR(), "points", (100, 1000)))
    asked = contest(ladders=ladders)
    return asked, sweep(asked.timed, Store(tmp_path_factory.mktemp("solved")), 1, tasks_each=1).outcomes


def test_a_rung_has_the_answer_of_its_solver_and_what_that_took(solved):
    asked, outcomes = solved
    for rung in asked.timed:
        (row,) = outcomes[rung].rows
        assert row.normal_force == rung.solver.solve(PRESSED).normal_force
        assert row.measures["processor"] > 0
        assert row.measures["wall"] > 0
        assert row.measures["memory"] >= 0
        # Of quick solves the least of several is taken.
        assert row.measures["repeats"] >= 3


def test_errors_are_against_the_truth_and_costs_are_as_measured(solved):
    asked, outcomes = solved
    three, one = asked.judged(outcomes).climbed
    exact = elastic_contact(PRESSED).load
    for climbed in (three, one):
        for k, rung in enumerate(climbed.ladder.rungs):
            row = outcomes[rung].rows[0]
            assert climbed.errors["force"][k] == pytest.approx(abs(row.normal_force / exact - 1), rel=1e-9)
            assert climbed.processor[k] == row.measures["processor"]
            assert climbed.applications[k] == row.applications
        assert climbed.errors["force"][1] < climbed.errors["force"][0]
        assert climbed.reaching("force", 1.0) == np.argmin(climbed.processor)


def test_memory_is_that_of_the_solve(tmp_path):
    rungs = [Rung(BEM(points=n), PRESSED) for n in (64, 512)]
    small, large = (sweep(rungs, Store(tmp_path), 1, tasks_each=1).outcomes[rung].rows[0] for rung in rungs)
    # Pressure, gap, heights and kernel alone are planes of eight bytes a point.
    assert large.measures["memory"] > 4 * 8 * 512**2
    assert large.measures["memory"] > small.measures["memory"]


def test_a_failed_solve_is_nan_with_its_reason_and_reaches_nothing(tmp_path):
    rough = replace(PRESSED, roughness=FINE)
    ladder = Ladder.of("BEM", rough, BEM(), "points", (16, 128))
    finer = Finer.of(rough, BEM(points=256), "256 points")
    asked = contest(truth=finer, ladders=(ladder,))
    outcomes = sweep(asked.untimed, Store(tmp_path)).outcomes | sweep(asked.timed, Store(tmp_path), 1).outcomes
    (climbed,) = asked.judged(outcomes).climbed
    assert isnan(climbed.processor[0])
    assert isnan(climbed.errors["force"][0])
    assert "less than two pixels" in climbed.reasons[0]
    assert climbed.reasons[1] is None
    assert climbed.reaching("force", 1.0) == 1


def test_what_fails_after_a_good_rung_takes_its_promise_away(solved):
    asked, outcomes = solved
    climbed = asked.judged(outcomes).climbed[0]
    failed = replace(climbed, errors={"force": np.array([1e-6, np.nan])}, processor=np.array([1.0, np.nan]))
    assert failed.reaching("force", 1e-3) is None


def test_a_finer_solution_knows_its_own_error():
    finer = Finer.of(SLIDING, BEM(points=64), "64 points")
    outcomes = {task: task.solve() for task in finer.tasks}
    known = finer.known((FORCE, FRICTION), outcomes)
    values = [outcomes[task].rows[0].friction_coefficient for task in finer.tasks]
    assert known["friction"].value == values[0]
    assert known["friction"].error == abs(values[0] - values[1])
    assert known["friction"].relative_error == pytest.approx(abs(values[1] / values[0] - 1))


def test_a_page_is_written_and_what_was_measured_is_not_measured_again(tmp_path, monkeypatch):
    title, advice = "A little diagram", "Take 64."
    little = Diagram("little", title, "Two rungs.", lambda size: [contest()], lambda found: advice)
    monkeypatch.setitem(INQUIRIES, "little", little)
    for counted in ((2, 0), (0, 2)):
        found = run.weigh("little", folder=tmp_path, workers=1)
        assert (found.swept.solved, found.swept.reused) == counted
        assert advice in str(found)
    page = (tmp_path / PAGE).read_text(encoding="utf-8")
    assert title in page
    assert advice in page
    assert "data:image/png;base64" in page
    rows = (tmp_path / "workprecision-little.csv").read_text(encoding="utf-8").splitlines()
    assert len(rows) == 3
    for name in ("processor", "wall", "memory", "applications", "error", "reason"):
        assert name in rows[0]


def test_a_process_is_fresh_for_each_task_where_that_is_asked(tmp_path):
    rungs = [Rung(MDR(points=n), PRESSED) for n in (64, 128, 256)]
    swept = sweep(rungs, Store(tmp_path), 1, tasks_each=1)
    assert swept.solved == 3
    joined = swept.joined(sweep(rungs[:1], Store(tmp_path), 1))
    assert (joined.solved, joined.reused) == (3, 1)
    assert set(joined.outcomes) == set(rungs)
