"""Work-precision diagrams: what a timed solve costs, orders as declared, failures as failures."""

from dataclasses import replace
from math import isnan, nan, pi

import numpy as np
import pytest
import xarray
from scipy.integrate import quad

from bem3d import BEM
from compare.library import ready
from compare.models.exact.waves import crossed_closure, crossed_contact_fraction_light
from compare.report.plots import lettering, style
from compare.solving.outcome import Outcome, Row, row
from compare.solving.runner import sweep
from compare.solving.store import Store
from compare.statistics import finding
from compare.statistics.convergence import MeasuredLadder, answers, ladders, observed
from compare.studies.workprecision import elastic, extent, marching, mdr, scenes, sliding, timed_solve
from compare.studies.workprecision.convergence import Convergence, Ladder, steps_table
from compare.studies.workprecision.diagram import convergence, enough_finding, order_finding
from compare.studies.workprecision.figures.errors import ROUNDING, panels
from compare.studies.workprecision.reference import FORCE, FRICTION, Known, closed_form, finer, slow_limit
from compare.studies.workprecision.study import DIAGRAMS, WorkPrecision
from compare.studies.workprecision.timed_solve import TimedSolve
from mdr1d import MDR
from scene import Indent, Kelvin, Scene, SelfAffine, Slide, Sphere
from scene.scales import elastic_contact

NUMERICAL = [each for name, each in DIAGRAMS.items() if name not in ("models", "surfaces")]
SOLID = Kelvin(modulus=1e6, relaxation_time=1e-3)
PRESSED = Scene(Sphere(radius=10e-3), SOLID, Indent(depth=1e-4))
SLIDING = replace(PRESSED, motion=Slide(speed=1.0, depth=1e-4))
HERTZ = closed_form("Hertz", {"force": Known(elastic_contact(PRESSED).load)})
# Two pixels a wave at least: so many points a side, or a solve ends in an error.
FINE = SelfAffine(hurst=0.5, rms_height=1e-6, longest=2e-3, shortest=1e-4, seed=1)
# Observed orders scatter, as the edge of a contact moves by whole pixels.
SCATTER = 0.35
FAILED_BETWEEN = {"errors": [1e-2, nan, 1e-4], "seconds": [0.1, 0.001, 1.0], "reasons": [None, "too steep", None]}


@pytest.fixture(autouse=True)
def briefly(monkeypatch):
    """Repeats of a timed solve that end at once."""
    monkeypatch.setattr(timed_solve, "SECONDS", 0.0)


def solved(contact):
    """Ladders of a contact, each step solved once, by quantity and label of the ladder."""
    outcomes = {}
    for task in contact.timed:
        result = task.solver.solve(task.scene)
        outcomes[task] = Outcome((row(result),), {name: result.fields[name] for name in task.keeps})
    node = xarray.DataTree.from_dict(contact.datasets(outcomes))
    return {(each.quantity, each.ladder): each for each in ladders(steps_table(node))}


def made(errors, seconds=None, reasons=None, reference_error=0.0, estimates=("",)):
    """A contact of one ladder of points with these errors, which each estimate doubles."""
    values = tuple(32 * 2**k for k in range(len(errors)))
    ladder = Ladder.of("BEM, by points", PRESSED, BEM(), "points", values)
    quantities = tuple(
        replace(FORCE, name=f"force{k}", by=by, of=lambda row, _, k=k: 1 + (row.normal_force - 1) * 2**k)
        for k, by in enumerate(estimates)
    )
    truth = closed_form("Hertz", {each.name: Known(1.0, reference_error) for each in quantities})
    seconds = np.geomspace(0.01, 1.0, len(errors)) if seconds is None else seconds
    reasons = reasons or [None] * len(errors)
    rows = [
        Row(reason=reason)
        if reason
        else Row(1 + error, measures={"processor": spent, "wall": spent, "memory": 1e6})
        for error, spent, reason in zip(errors, seconds, reasons, strict=True)
    ]
    contact = Convergence("sphere", "sphere", truth, quantities, (ladder,))
    found = contact.datasets({task: Outcome((each,)) for task, each in zip(ladder.solves, rows, strict=True)})
    return xarray.DataTree.from_dict(found)


def measured_of(node):
    return answers(ladders(steps_table(node)))


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
    contact = Convergence("sphere", "a sphere", HERTZ, (FORCE,), pair, {"force": 2.0})
    monkeypatch.setitem(ready.DIAGRAMS, "little", ready.About("Little", "Five steps."))
    monkeypatch.setitem(DIAGRAMS, "little", convergence("little", lambda size: [contact]))
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
    said = [(each.claim.id.removeprefix("workprecision.little."), each.verdict) for each in judged.findings]
    assert said == [("order-2", "undecided"), ("order-2", "holds"), ("time", "reported"), ("time", "reported")]
    (plot,) = judged.plots
    assert set(plot.tables) == {"workprecision-little", "workprecision-orders-little"}
    assert len(plot.tables["workprecision-little"]) == 5


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


@pytest.mark.parametrize("size", scenes.SIZES)
@pytest.mark.parametrize("diagram", DIAGRAMS.values(), ids=lambda diagram: diagram.name)
def test_no_solver_refuses_any_step(diagram, size):
    untimed, timed = WorkPrecision.of(diagram.name, size).batches()
    for task in (*untimed.tasks, *timed.tasks):
        assert task.solver.refusals(task.scenes[0]) == []
    assert size != "quick" or diagram not in NUMERICAL or len(timed.tasks) <= 17  # two and a half seconds each


@pytest.mark.parametrize("diagram", NUMERICAL, ids=lambda diagram: diagram.name)
def test_where_all_solves_fail_findings_say_why_and_nothing_is_recommended(diagram):
    why = "the contact did not converge"
    fine = Row(
        1.0, 1e-4, 0.1, measures={"curvature_by_pressure": 1e3, "contact_fraction": 0.1}, settings={"extent": 1.0}
    )
    study = WorkPrecision.of(diagram.name)
    untimed, timed = study.batches()
    outcomes = {task: Outcome((fine,)) for task in untimed.tasks}
    outcomes |= {task: Outcome((Row(reason=why),)) for task in timed.tasks}
    found = study.answers(outcomes)[diagram.name]
    judged = diagram.judge(found)
    findings = judged.findings
    assert all(isnan(each.value) for each in findings)
    assert any(why in each.reason for each in findings)
    plot, *_ = judged.plots
    assert set(plot.tables[plot.name]["reason"]) == {why}
    assert len(plot.caption.split()) <= 60
    with style.applied():
        assert plot.figure().axes
    (table,) = judged.tables
    assert table.frame.filter(like="within").map(lambda cell: why in cell).all(axis=None)
    assert " nan" not in " ".join(finding.sentences(findings))


def test_an_order_rests_on_no_failed_step_and_on_none_within_the_error_of_the_reference():
    points, errors = np.array([16, 32, 64, 128, 256, 512]), np.array([nan, 4e-2, 1e-2, 2.5e-3, 1e-4, 2e-4])
    found = observed(points, errors, reference_error=1e-4)
    assert (found.order, found.count) == (pytest.approx(2.0), 3)
    np.testing.assert_allclose(found.at(points[1:4]), errors[1:4], rtol=1e-12)
    assert isnan(observed(points[3:], errors[3:], 1e-4).order)
    noisy = np.array([4e-2, 1.2e-2, 2.4e-3, 7e-4])
    _, covariance = np.polyfit(np.log(points[1:5]), np.log(noisy), 1, cov=True)
    assert observed(points[1:5], noisy).deviation == pytest.approx(np.sqrt(covariance[0, 0]), rel=1e-9)
    ladder = measured([4e-2, 1e-2, 2.5e-3, 2e-3], reference_error=7e-4)
    assert ladder.order.order == pytest.approx(2.0)


@pytest.mark.parametrize(
    ("errors", "verdict"),
    [
        ((0.04, 0.01, 0.0025, 0.000625), "holds"),
        ((0.04, 0.02, 0.01, 0.005), "fails"),
        ((0.04, 0.01, 0.001), "undecided"),
    ],
)
def test_an_order_is_judged_by_the_whole_interval_of_its_fit(errors, verdict):
    assert order_finding("made", measured(errors), 2.0).verdict == verdict
    assert order_finding("made", measured(errors)).verdict == "reported"


@pytest.mark.parametrize(
    ("how", "level", "text"),
    [
        (FAILED_BETWEEN, 1e-2, "128 points: 1 s"),
        ({"errors": [1e-2, 1e-3, 1e-4], "reference_error": 5e-4}, 1e-4, "reference known to 0.05 %"),
        ({"errors": [1e-2, 1e-3, 1e-4], "reference_error": 5e-4}, 1.1e-2, "32 points: 10 ms"),
        ({"errors": [1e-2, 1e-3]}, 1e-4, "not reached; best 0.1 %"),
    ],
    ids=["failed", "below the reference", "reached", "not reached"],
)
def test_a_wanted_error_takes_the_cheapest_step_after_which_all_keep_it(how, level, text):
    assert measured(**how).cell(level) == text


@pytest.mark.parametrize(
    ("errors", "enough", "why"),
    [
        ([1e-2, 1.2e-4, 1e-4, 1e-4], 64, ""),
        ([1e-2, 1e-3, 1e-4], 128, "every step gains"),
        ([1e-2, 1e-3, nan], nan, "the last step failed"),
    ],
)
def test_enough_is_the_cheapest_step_that_later_ones_do_not_better(errors, enough, why):
    reasons = ["too steep" if isnan(error) else None for error in errors]
    found = enough_finding("made", measured(errors, reasons=reasons))
    assert (found.value, found.reason) == (pytest.approx(enough, nan_ok=True), why)


def test_all_estimates_have_one_reference_and_the_indicator_counts_from_zero():
    inner = closed_form("codes", {"friction": Known(0.2, 1e-4)})
    known = sliding.estimates_of(inner).values(sliding.ESTIMATES, {})
    assert {known[each.name] for each in sliding.ESTIMATES[:-1]} == {Known(0.2, 1e-4)}
    answer = Row(2.0, 1e-4, 0.4, measures={"friction_disagreement": 0.03, "friction_by_loss": 0.5})
    assert known[sliding.INDICATOR.name].error_of(sliding.INDICATOR.of(answer, {})) == pytest.approx(0.15)
    assert known[sliding.LOSS.name].error_of(sliding.LOSS.of(answer, {})) == pytest.approx(0.25)


def test_the_limit_of_low_speed_is_the_lag_times_the_curvature_and_is_known_as_well_as_its_grids_and_speed():
    scene = scenes.rough(1e-3)
    reference = slow_limit(scene, BEM(points=128))
    lag = scene.elastomer.relaxation_time
    rows = (
        Row(1.0, measures={"curvature_by_pressure": 1000.0}),
        Row(1.0, measures={"curvature_by_pressure": 990.0}),
        Row(1.0, friction_force=10 * 1e-3 * lag * 970.0),
    )
    known = reference.values((), dict(zip(reference.tasks, (Outcome((each,)) for each in rows), strict=True)))
    assert known["friction"].value == pytest.approx(1e-3 * lag * 1000.0)
    assert known["friction"].relative_error == pytest.approx(0.01 + 0.002)


def test_one_dimension_converges_in_second_order_and_exactly_on_a_cone():
    found = {each.name: solved(each) for each in mdr.contacts("quick") if each.name != "rough-sphere"}
    for name in ("rest-sphere", "sphere-kelvin"):
        assert found[name]["force", "MDR, by points"].order.order == pytest.approx(2.0, abs=SCATTER), name
    # rounding of sums over thousands of nodes
    assert max(each.errors.max() for each in found["cone-standard"].values()) < 1e-11
    steps = found["withdrawal"]["force", "MDR, by steps"].errors
    np.testing.assert_allclose(steps, steps[0], rtol=1e-6)  # a depth linear in time has no error in time


def test_at_rest_the_force_converges_in_second_order_and_the_pressure_in_first():
    contact, *_ = elastic.contacts("quick")
    found = solved(replace(contact, ladders=contact.ladders[:1]))
    for name, order in contact.orders.items():
        assert found[name, "BEM, by points"].order.order == pytest.approx(order, abs=SCATTER)


def test_hertz_pressure_misses_itself_by_nothing():
    quantity = elastic.hertzian(radius=1.0, peak=3.0)
    x = np.linspace(-1.5, 1.5, 31)
    exact = 3.0 * np.sqrt(np.maximum(1 - np.square(np.hypot(x, x[:, None])), 0))
    fields = {"x": x, "y": x, "pressure": exact}
    assert quantity.of(Row(), fields) == pytest.approx(0.0, abs=1e-15)
    assert quantity.of(Row(), fields | {"pressure": 1.1 * exact}) > 0.05


def test_points_and_steps_together_converge_against_ting():
    contact, _ = marching.contacts("quick")
    both = contact.ladders[2]
    both = replace(both, values=both.values[:2], solves=both.solves[:2])
    (each,) = solved(replace(contact, ladders=(both,))).values()
    coarse, fine = each.errors
    assert fine < 0.5 * coarse < 5e-4  # a quarter in second order, of whole pixels


def test_a_cell_pressed_lightly_holds_two_contacts_of_the_sphere():
    # crossed waves of the same curvature, by the closed form of Johnson, Greenwood and Higginson
    scene = extent.cell(10.0, Indent(load=extent.LOAD))
    wavelength = 2 * scenes.CONTACT * 10.0
    closure = crossed_closure(scenes.KELVIN.indentation_modulus, scene.roughness.amplitude, wavelength)
    fraction = crossed_contact_fraction_light(scene.motion.pressure / closure)
    assert fraction * wavelength**2 == pytest.approx(2 * pi * scenes.CONTACT**2, rel=1e-12)


def test_the_shape_of_a_wave_is_that_of_its_body_of_revolution():
    # F = 2 E* int_0^a (d - g) dx and int g'^2 dx of g = x^2/R - q^2 x^4/(6R), by quadrature
    q, modulus, radius = pi / (8 * scenes.CONTACT), scenes.KELVIN.indentation_modulus, scenes.SPHERE.radius
    a = extent.wave_radius(q)

    def g(x):
        return x**2 / radius - q**2 * x**4 / (6 * radius)

    def slope(x):
        return 2 * x / radius * (1 - q**2 * x**2 / 3)

    assert 2 * modulus * quad(lambda x: g(a) - g(x), 0, a)[0] == pytest.approx(extent.LOAD, rel=1e-9)
    sphere = 4 * scenes.CONTACT**3 / (3 * radius**2)
    assert extent.wave_friction(q) == pytest.approx(quad(lambda x: slope(x) ** 2, 0, a)[0] / sphere, rel=1e-9)
    assert extent.wave_friction(1e-3 * q) == pytest.approx(1.0, abs=1e-5)


def test_most_of_what_parts_a_lattice_from_a_free_tip_is_the_shape_of_its_wave_and_a_free_window_has_no_error():
    contact, *_ = extent.contacts("quick")
    cells, windows, _ = contact.ladders
    cells = replace(cells, values=cells.values[1:], solves=cells.solves[1:])
    found = solved(replace(contact, ladders=(cells, windows)))
    errors = {name: found[name, cells.label].errors for name in ("radius", "radius_less_shape")}
    assert np.all(errors["radius"][1:] < 0.3 * errors["radius"][:-1])  # a quarter, as (a/lambda)^2
    assert np.all(errors["radius_less_shape"] < 0.25 * errors["radius"])
    close, wide = found["radius", windows.label].errors
    assert close == pytest.approx(wide, rel=0.05)  # the pixels lie differently under the edge


@pytest.mark.slow
def test_single_precision_reaches_what_its_tolerance_asks_for_and_no_more():
    scene = scenes.pressed(scenes.SPHERE)
    tight, double, single = (
        BEM(points=64, tolerance=tolerance, precision=precision).solve(scene).normal_force
        for tolerance, precision in ((1e-11, "double"), (1e-7, "double"), (1e-5, "single"))
    )
    assert abs(double / tight - 1) < abs(single / tight - 1) < 1e-5


def drawn(*arguments, **how):
    *_, plot = convergence("made", lambda size: []).judge(made(*arguments, **how)).plots
    return plot, plot.figure()


def test_points_within_the_error_of_the_reference_are_hollow_and_failures_are_named():
    _, figure = drawn([1e-2, nan, 1e-4], reasons=[None, "too steep", None], reference_error=1e-3)
    (axes,) = figure.axes
    marks = [line for line in axes.lines if line.get_linestyle() == "None"]
    points = [(line.get_markerfacecolor(), y) for line in marks for y in line.get_ydata()]
    faces = {round(y, 12): face for face, y in points if np.isfinite(y)}
    assert faces == {1e-2: style.COLOUR["BEM"], 1e-4: "white"}
    written = {text.get_text() for text in axes.texts}
    assert {"failed: points 64", "32", "128"} <= written
    assert "64" not in written


def test_an_error_of_rounding_is_drawn_hollow_on_the_band_of_rounding():
    _, figure = drawn([1e-3, 1e-16, 4e-14])
    (axes,) = figure.axes
    hollow = [line for line in axes.lines if line.get_markerfacecolor() == "white" and len(line.get_ydata())]
    assert [y for line in hollow for y in line.get_ydata()] == [ROUNDING, ROUNDING]
    assert axes.patches[0].get_window_extent().y1 == pytest.approx(axes.transData.transform((1, ROUNDING))[1])


def test_estimates_of_one_answer_share_a_panel_and_the_table_has_every_step():
    plot, figure = drawn([1e-2, nan, 1e-4], reasons=[None, "too steep", None], estimates=("joined", "by loss"))
    assert len(figure.axes) == 1
    (panel,) = panels(plot.tables["workprecision-made"], estimates=True)
    assert [curve.estimate for curve in panel] == ["joined", "by loss"]
    table = plot.tables["workprecision-made"]
    assert table["reason"].tolist() == 2 * ["", "too steep", ""]
    assert table["processor"].isna().sum() == 2
    assert np.isnan(plot.tables["workprecision-orders-made"]["order"]).all()


def test_what_is_written_covers_neither_points_nor_other_texts():
    _, figure = drawn([1e-2, 0.9e-2, 0.8e-2, 0.7e-2], seconds=[1.0, 1.05, 1.1, 1.15])
    (axes,) = figure.axes
    boxes = [text.get_window_extent() for text in axes.texts]
    assert len(boxes) >= 2
    assert not any(a.overlaps(b) for k, a in enumerate(boxes) for b in boxes[:k])
    marks = list(lettering._markers(axes))
    assert not any(box.overlaps(mark) for box in boxes for mark in marks)
