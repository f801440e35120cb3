"""Work-precision diagrams: what a timed solve costs, errors against references, failures as failures."""

from dataclasses import replace
from math import isnan, nan

import numpy as np
import pytest
import xarray

from bem3d import BEM
from compare.figures import style
from compare.library import ready
from compare.solving.outcome import Outcome, Row
from compare.solving.runner import sweep
from compare.solving.store import Store
from compare.statistics.convergence import MeasuredLadder, ladders, observed
from compare.studies.workprecision import models, regimes, timed_solve
from compare.studies.workprecision.convergence import Convergence, Ladder, steps_table
from compare.studies.workprecision.figures.errors import ROUNDING, plots
from compare.studies.workprecision.reference import FORCE, FRICTION, Known, closed_form, finer
from compare.studies.workprecision.study import DIAGRAMS, WorkPrecision
from compare.studies.workprecision.timed_solve import TimedSolve
from mdr1d import MDR
from scene import Indent, Kelvin, Scene, SelfAffine, Slide, Sphere
from scene.scales import elastic_contact

SOLID = Kelvin(modulus=1e6, relaxation_time=1e-3)
PRESSED = Scene(Sphere(radius=10e-3), SOLID, Indent(depth=1e-4))
SLIDING = replace(PRESSED, motion=Slide(speed=1.0, depth=1e-4))
HERTZ = closed_form("Hertz", {"force": Known(elastic_contact(PRESSED).load)})
# Two pixels a wave at least: so many points a side, or a solve ends in an error.
FINE = SelfAffine(hurst=0.5, rms_height=1e-6, longest=2e-3, shortest=1e-4, seed=1)
FAILED_BETWEEN = {"errors": [1e-2, nan, 1e-4], "seconds": [0.1, 0.001, 1.0], "reasons": [None, "too steep", None]}


@pytest.fixture(autouse=True)
def briefly(monkeypatch):
    """Repeats of a timed solve that end at once."""
    monkeypatch.setattr(timed_solve, "SECONDS", 0.0)


def made(errors, seconds=None, reasons=None, reference_error=0.0):
    """A contact of one ladder of points with these errors."""
    values = tuple(32 * 2**k for k in range(len(errors)))
    ladder = Ladder.of("BEM, by points", PRESSED, BEM(), "points", values)
    truth = closed_form("Hertz", {"force": Known(1.0, reference_error)})
    seconds = np.geomspace(0.01, 1.0, len(errors)) if seconds is None else seconds
    reasons = reasons or [None] * len(errors)
    rows = [
        Row(reason=reason)
        if reason
        else Row(1 + error, measures={"processor": spent, "wall": spent, "memory": 1e6})
        for error, spent, reason in zip(errors, seconds, reasons, strict=True)
    ]
    contact = Convergence("sphere", "sphere", truth, (FORCE,), (ladder,))
    found = contact.datasets({task: Outcome((each,)) for task, each in zip(ladder.solves, rows, strict=True)})
    return xarray.DataTree.from_dict(found)


def measured_of(node):
    return ladders(steps_table(node))


def measured(*arguments, **how) -> MeasuredLadder:
    return measured_of(made(*arguments, **how))[0]


def test_a_timed_solve_has_the_answer_of_its_solver_and_what_that_took():
    timed = TimedSolve.of(BEM(points=64, tolerance=1e-7), PRESSED)
    found = timed.solve().rows[0]
    assert found.normal_force == timed.solver.solve(PRESSED).normal_force
    # Quick solves are repeated, and the least time is taken.
    assert found.measures["repeats"] >= 3
    assert min(found.measures["processor"], found.measures["wall"]) > 0


@pytest.mark.slow
def test_a_solve_alone_in_a_process_shows_its_memory_and_is_not_measured_again(tmp_path):
    tasks = [TimedSolve.of(BEM(points=n), PRESSED) for n in (64, 512)]
    for counted in ((2, 0), (0, 2)):
        swept = sweep(tasks, Store(tmp_path), fresh=True)
        assert (swept.solved, swept.reused) == counted
    small, large = (swept.outcomes[task].rows[0].measures["memory"] for task in tasks)
    # Pressure, gap, heights and kernel alone are planes of eight bytes a point.
    assert large > max(4 * 8 * 512**2, small)


def test_a_page_has_errors_against_the_reference_and_costs_as_measured(monkeypatch):
    pair = (
        Ladder.of("BEM", PRESSED, BEM(tolerance=1e-7), "points", (32, 64)),
        Ladder.of("MDR", PRESSED, MDR(), "points", (64, 128, 256)),
    )
    contact = Convergence("sphere", "a sphere", HERTZ, (FORCE,), pair)
    monkeypatch.setitem(ready.DIAGRAMS, "little", ready.About("Little", "Five steps."))
    monkeypatch.setitem(DIAGRAMS, "little", replace(models.MODELS, name="little", contacts=lambda size: [contact]))
    study = WorkPrecision.of("little")
    untimed, timed = study.batches()
    assert (untimed.tasks, timed.timed) == ((), True)
    outcomes = {task: task.solve() for task in timed.tasks}
    found = study.answers(outcomes)
    for each, ladder in zip(measured_of(found["little"]), pair, strict=True):
        rows = [outcomes[task].rows[0] for task in ladder.solves]
        truth = elastic_contact(PRESSED).load
        assert each.errors == pytest.approx([abs(row.normal_force / truth - 1) for row in rows], rel=1e-9)
        assert each.processor.tolist() == [row.measures["processor"] for row in rows]
        assert each.errors[1] < each.errors[0]
        assert each.reaching(1.0) == np.argmin(each.processor)
    judged = study.judge(found)
    said = {each.claim.id.removeprefix("workprecision.models."): each.verdict for each in judged.findings}
    assert said == {
        "1d-within-10-percent": "holds",
        "1d-within-1-percent": "holds",
        "time-10-percent": "reported",
        "time-1-percent": "reported",
    }
    (plot,) = judged.plots
    assert set(plot.tables) == {"workprecision-models-steps-depth", "workprecision-models-answers-depth"}
    assert len(plot.tables["workprecision-models-steps-depth"]) == 5


def test_a_failed_solve_is_nan_with_its_reason_and_reaches_nothing():
    rough = replace(PRESSED, roughness=FINE)
    truth = finer(rough, BEM(points=256), "256 points")
    ladder = Ladder.of("BEM", rough, BEM(), "points", (16, 128))
    contact = Convergence("rough", "rough", truth, (FORCE,), (ladder,))
    found = contact.datasets({task: task.solve() for task in (*contact.untimed, *contact.timed)})
    (each,) = measured_of(xarray.DataTree.from_dict(found))
    assert isnan(each.processor[0])
    assert isnan(each.errors[0])
    assert found["rough"]["status"].values.tolist() == ["failed", "solved"]
    ((value, reason),) = each.failures
    assert (value, each.reaching(1.0)) == (16, 1)
    assert "less than two pixels" in reason


def test_a_finer_solution_knows_its_own_error():
    truth = finer(SLIDING, BEM(points=64), "64 points")
    outcomes = {task: task.solve() for task in truth.tasks}
    known = truth.values((FORCE, FRICTION), outcomes)
    values = [outcomes[task].rows[0].friction_coefficient for task in truth.tasks]
    assert known["friction"].value == values[0]
    assert known["friction"].error == abs(values[0] - values[1])
    assert known["friction"].relative_error == pytest.approx(abs(values[1] / values[0] - 1))


@pytest.mark.parametrize("size", regimes.SIZES)
@pytest.mark.parametrize("diagram", DIAGRAMS.values(), ids=lambda diagram: diagram.name)
def test_no_solver_refuses_any_step(diagram, size):
    untimed, timed = WorkPrecision.of(diagram.name, size).batches()
    for task in (*untimed.tasks, *timed.tasks):
        assert task.solver.refusals(task.scenes[0]) == []


def test_an_order_rests_on_no_failed_step_and_on_none_within_the_error_of_the_reference():
    points, errors = np.array([16, 32, 64, 128, 256, 512]), np.array([nan, 4e-2, 1e-2, 2.5e-3, 1e-4, 2e-4])
    found = observed(points, errors, reference_error=1e-4)
    assert found.order == pytest.approx(2.0)
    np.testing.assert_allclose(found.at(points[1:4]), errors[1:4], rtol=1e-12)
    assert isnan(observed(points[3:], errors[3:], 1e-4).order)
    ladder = measured([4e-2, 1e-2, 2.5e-3, 2e-3], reference_error=7e-4)
    assert ladder.order.order == pytest.approx(2.0)


@pytest.mark.parametrize(
    ("how", "level", "reached"),
    [
        (FAILED_BETWEEN, 1e-2, ("128 points", 1.0)),
        ({"errors": [1e-2, 1e-3, 1e-4], "reference_error": 5e-4}, 1e-4, None),
        ({"errors": [1e-2, 1e-3, 1e-4], "reference_error": 5e-4}, 1.1e-2, ("32 points", 0.01)),
        ({"errors": [1e-2, 1e-3]}, 1e-4, None),
    ],
    ids=["failed", "below the reference", "reached", "not reached"],
)
def test_a_wanted_error_takes_the_cheapest_step_after_which_all_keep_it(how, level, reached):
    effort = measured(**how).effort(level)
    assert (effort and (effort.settings, effort.seconds)) == reached


def drawn(*arguments, **how):
    (plot,) = plots("made", {"steps": steps_table(made(*arguments, **how))})
    return plot.figure()


def test_points_within_the_error_of_the_reference_are_hollow_and_failures_are_named():
    figure = drawn([1e-2, nan, 1e-4], reasons=[None, "too steep", None], reference_error=1e-3)
    (axes,) = figure.axes
    marks = [line for line in axes.lines if line.get_linestyle() == "None"]
    points = [(line.get_markerfacecolor(), y) for line in marks for y in line.get_ydata()]
    faces = {round(y, 12): face for face, y in points if np.isfinite(y)}
    assert faces == {1e-2: style.COLOUR["BEM"], 1e-4: "white"}
    written = {text.get_text() for text in axes.texts}
    assert {"failed: points 64", "32", "128"} <= written
    assert "64" not in written


def test_an_error_of_rounding_is_drawn_hollow_on_the_band_of_rounding():
    figure = drawn([1e-3, 1e-16, 4e-14])
    (axes,) = figure.axes
    hollow = [line for line in axes.lines if line.get_markerfacecolor() == "white" and len(line.get_ydata())]
    assert [y for line in hollow for y in line.get_ydata()] == [ROUNDING, ROUNDING]
    assert axes.patches[0].get_window_extent().y1 == pytest.approx(axes.transData.transform((1, ROUNDING))[1])
