"""The numerical diagrams: orders as declared, failures as failures, advice that holds, figures that show it."""

from dataclasses import replace
from io import BytesIO
from math import nan, pi

import numpy as np
import pytest
from matplotlib.text import Text
from scipy.integrate import quad

from bem3d import BEM
from compare.exact.waves import crossed_closure, crossed_contact_fraction_light
from compare.figures import lettering, style, workprecision
from compare.outcome import Outcome, Row, row
from compare.publish import DOTS_PER_INCH
from compare.workprecision import wording
from compare.workprecision.contest import (
    FORCE,
    Climbed,
    ClosedForm,
    Contest,
    Judged,
    Known,
    Ladder,
    judge,
)
from compare.workprecision.diagram import judged, timed, untimed
from compare.workprecision.diagrams import elastic, estimates, extent, marching, mdr, precision, sliding
from compare.workprecision.diagrams.scenes import CONTACT, KELVIN, SPHERE, pressed
from compare.workprecision.diagrams.slowlimit import SlowLimit
from compare.workprecision.listing import orders, rungs
from compare.workprecision.order import observed
from scene import Indent

NUMERICAL = [module.DIAGRAM for module in (mdr, elastic, sliding, marching, precision, extent)]
# Observed orders scatter, as the edge of a contact moves by whole pixels.
SCATTER = 0.35


def solved(tasks):
    """Outcomes by one solve each, without the repeats of a measurement."""
    outcomes = {}
    for task in tasks:
        result = task.solver.solve(task.scene)
        outcomes[task] = Outcome((row(result),), {name: result.fields[name] for name in task.keeps})
    return outcomes


def failing(contests, reason="the contact did not converge"):
    """Every rung fails; what it is measured against does not."""
    fine = Row(
        1.0, 1e-4, 0.1, measures={"curvature_by_pressure": 1e3, "contact_fraction": 0.1}, settings={"extent": 1.0}
    )
    return {task: Outcome((fine,)) for task in untimed(contests)} | {
        rung: Outcome((Row(reason=reason),)) for rung in timed(contests)
    }


def drawn(errors, processor=None, reasons=None, reference_error=0.0, values=None, by=(None,)):
    """A contest of one ladder of points with these errors."""
    count = len(errors)
    values = values or tuple(32 * 2**k for k in range(count))
    ladder = Ladder.of("BEM, by points", pressed(SPHERE), BEM(), "points", values)
    quantities = tuple(replace(FORCE, name=f"force-{each}", by=each) for each in by)
    known = {each.name: Known(1.0, reference_error) for each in quantities}
    contest = Contest("sphere", "sphere", ClosedForm("Hertz", known), quantities, (ladder,))
    processor = np.geomspace(0.01, 1.0, count) if processor is None else np.array(processor)
    costs = {name: np.where(np.isfinite(errors), processor, nan) for name in ("processor", "wall", "memory")}
    climbed = Climbed(
        ladder,
        {each.name: np.array(errors, float) * 2**k for k, each in enumerate(quantities)},
        applications=processor,
        reasons=tuple(reasons or [None] * count),
        **costs,
    )
    return Judged(contest, known, (climbed,))


@pytest.mark.parametrize("order", [0.5, 1.0, 2.0])
def test_the_order_of_a_power_law_is_its_exponent(order):
    points = np.array([32, 64, 128, 256])
    found = observed(points, 3.0 * points**-order)
    assert found.order == pytest.approx(order, rel=1e-12)  # rounding
    np.testing.assert_allclose(found.at(points), 3.0 * points**-order, rtol=1e-12)


def test_an_order_rests_on_no_failed_rung_and_on_none_within_the_error_of_the_reference():
    points, errors = np.array([16, 32, 64, 128, 256, 512]), np.array([nan, 4e-2, 1e-2, 2.5e-3, 1e-4, 2e-4])
    found = observed(points, errors, reference_error=1e-4)
    assert (found.order, found.count) == (pytest.approx(2.0), 3)
    assert np.isnan(observed(points[3:], errors[3:], 1e-4).order)


def test_what_lies_near_the_error_of_the_reference_says_nothing_of_the_order_of_a_ladder():
    found = drawn([4e-2, 1e-2, 2.5e-3, 2e-3], reference_error=7e-4)
    assert found.order(found.climbed[0], found.contest.quantities[0].name).order == pytest.approx(2.0)


@pytest.mark.parametrize("diagram", NUMERICAL, ids=lambda diagram: diagram.name)
@pytest.mark.parametrize("size", ["quick", "full"])
def test_no_rung_asks_for_what_its_solver_lacks(diagram, size):
    contests = diagram.contests(size)
    for task in timed(contests):
        assert task.solver.refusals(task.scene) == []
    for task in untimed(contests):
        assert task.solver.refusals(task.scenes[0]) == []
    if size == "quick":
        assert len(timed(contests)) <= 17  # some two and a half seconds each


@pytest.mark.parametrize("diagram", NUMERICAL, ids=lambda diagram: diagram.name)
def test_where_all_solves_fail_the_advice_says_why_and_recommends_nothing(diagram):
    contests = diagram.contests("quick")
    found = judged(contests, failing(contests))
    for each in found:
        for climbed in each.climbed:
            assert all(np.isnan(errors).all() for errors in climbed.errors.values())
    said = diagram.advice(found)
    assert "the contact did not converge" in said
    assert "takes" not in said.replace("takes as long", "")
    assert workprecision.figure(found) is not None
    rows = workprecision.sheets(found)["workprecision"]
    assert {entry["reason"] for entry in rows} == {"the contact did not converge"}


def test_a_failed_rung_is_never_recommended_and_is_named():
    errors = [1e-2, nan, 1e-4]
    found = drawn(errors, processor=[0.1, 0.001, 1.0], reasons=[None, "too steep", None])
    (climbed,) = found.climbed
    said = wording.levels(found, climbed, "force-None", (1e-2, 1e-3))
    assert said == "1 % and 0.1 % take 128 points (1 s)"
    assert wording.failures([found]) == " Not solved: sphere, BEM, by points, 64 points: too steep."


def test_levels_below_the_error_of_the_reference_are_not_promised():
    found = drawn([1e-2, 1e-3, 1e-4], reference_error=5e-4)
    said = wording.levels(found, found.climbed[0], "force-None", (1e-2, 1e-4))
    assert (
        said == "1 % takes 32 points (10 ms), 0.01 % cannot be told, since the reference is only known to 0.05 %"
    )


def test_a_level_that_no_rung_reaches_is_said_with_the_best():
    found = drawn([1e-2, 1e-3])
    said = wording.levels(found, found.climbed[0], "force-None", (1e-4,))
    assert said == "0.01 % is reached by no rung, the best has 0.1 % with 64 points (1 s)"


def test_enough_is_the_cheapest_rung_that_later_ones_do_not_better():
    found = drawn([1e-2, 1.2e-4, 1e-4, 1e-4])
    assert wording.enough(found.climbed[0], "force-None").startswith("64 points")
    assert "every rung gains" in wording.enough(drawn([1e-2, 1e-3, 1e-4]).climbed[0], "force-None")
    assert "cannot be told" in wording.enough(drawn([1e-2, 1e-3, nan]).climbed[0], "force-None")


def test_all_estimates_have_one_truth_and_the_indicator_counts_from_zero():
    inner = ClosedForm("codes", {"friction": Known(0.2, 1e-4)})
    known = estimates.OfFriction(inner).known(estimates.ALL, {})
    assert {known[each.name] for each in estimates.ALL[:-1]} == {Known(0.2, 1e-4)}
    answer = Row(2.0, 1e-4, 0.4, measures={"friction_disagreement": 0.03, "friction_by_loss": 0.5})
    assert known[estimates.INDICATOR.name].error_of(estimates.INDICATOR.of(answer, {})) == pytest.approx(0.15)
    assert known[estimates.LOSS.name].error_of(estimates.LOSS.of(answer, {})) == pytest.approx(0.25)


def test_the_limit_of_low_speed_is_the_lag_times_the_curvature_and_is_known_as_well_as_its_grids_and_speed():
    scene = sliding.rough(1e-3)
    truth = SlowLimit.of(scene, BEM(points=128))
    lag, limit = scene.elastomer.relaxation_time, 1e-3 * scene.elastomer.relaxation_time * 1000.0
    rows = (
        Row(1.0, measures={"curvature_by_pressure": 1000.0}),
        Row(1.0, measures={"curvature_by_pressure": 990.0}),
        Row(1.0, friction_force=10 * 1e-3 * lag * 970.0),
    )
    known = truth.known(
        (estimates.JOINED,), dict(zip(truth.tasks, (Outcome((each,)) for each in rows), strict=True))
    )
    assert known["friction"].value == pytest.approx(limit)
    assert known["friction"].relative_error == pytest.approx(0.01 + 0.002)


def test_one_dimension_converges_in_second_order_and_exactly_on_a_cone():
    contests = [each for each in mdr.contests("quick") if each.name != "rough-sphere"]
    found = {each.contest.name: each for each in judged(contests, solved(timed(contests)))}
    for name in ("rest-sphere", "sphere-kelvin"):
        order = found[name].order(found[name].climbed[0], FORCE.name)
        assert order.order == pytest.approx(2.0, abs=SCATTER), name
    cone = found["cone-standard"].climbed[0].errors
    assert max(errors.max() for errors in cone.values()) < 1e-11  # rounding of sums over thousands of nodes
    steps = found["withdrawal"].climbed[1].errors["force"]
    np.testing.assert_allclose(steps, steps[0], rtol=1e-6)  # a depth linear in time has no error in time


def test_a_withdrawal_in_one_dimension_converges_in_second_order():
    (contest,) = (each for each in mdr.contests("quick") if each.name == "withdrawal")
    given = contest.ladders[0].rungs[0]
    ladder = Ladder.of("MDR", given.scene, given.solver, "points", [64 * 2**k for k in range(8)])
    found = judge(replace(contest, ladders=(ladder,)), solved(ladder.rungs))
    assert found.order(found.climbed[0], FORCE.name).order == pytest.approx(2.0, abs=SCATTER)


def test_at_rest_the_force_converges_in_second_order_and_the_pressure_in_first():
    (contest, *_) = elastic.contests("quick")
    contest = replace(contest, ladders=contest.ladders[:1])
    found = judge(contest, solved(contest.timed))
    force, pressure = (found.order(found.climbed[0], each.name) for each in contest.quantities)
    assert force.order == pytest.approx(2.0, abs=SCATTER)
    assert pressure.order == pytest.approx(1.0, abs=SCATTER)  # an edge of infinite slope in whole pixels


def test_hertz_pressure_misses_itself_by_nothing():
    quantity = elastic.hertzian(radius=1.0, peak=3.0)
    x = np.linspace(-1.5, 1.5, 31)
    exact = 3.0 * np.sqrt(np.maximum(1 - np.square(np.hypot(x, x[:, None])), 0))
    fields = {"x": x, "y": x, "pressure": exact}
    assert quantity.of(Row(), fields) == pytest.approx(0.0, abs=1e-15)
    assert quantity.of(Row(), fields | {"pressure": 1.1 * exact}) > 0.05


def test_points_and_steps_together_converge_against_ting():
    contest, _ = marching.contests("quick")
    both = contest.ladders[2]
    both = replace(both, values=both.values[:2], rungs=both.rungs[:2])
    found = judge(replace(contest, ladders=(both,)), solved(both.rungs))
    coarse, fine = found.climbed[0].errors["history"]
    assert fine < 0.5 * coarse < 5e-4  # a quarter in second order, of whole pixels


def test_a_cell_pressed_lightly_holds_two_contacts_of_the_sphere():
    # crossed waves of the same curvature, by the closed form of Johnson, Greenwood and Higginson
    period = 10.0
    scene = extent.cell(period, Indent(load=extent.LOAD))
    wavelength = 2 * CONTACT * period
    closure = crossed_closure(KELVIN.indentation_modulus, scene.roughness.amplitude, wavelength)
    fraction = crossed_contact_fraction_light(scene.motion.pressure / closure)
    assert fraction * wavelength**2 == pytest.approx(2 * pi * CONTACT**2, rel=1e-12)


def test_the_shape_of_a_wave_is_that_of_its_body_of_revolution():
    # F = 2 E* int_0^a (d - g) dx and int g'^2 dx of g = x^2/R - q^2 x^4/(6R), by quadrature
    q, modulus = pi / (8 * CONTACT), KELVIN.indentation_modulus
    a = extent.wave_radius(q)

    def g(x):
        return x**2 / SPHERE.radius - q**2 * x**4 / (6 * SPHERE.radius)

    def slope(x):
        return 2 * x / SPHERE.radius * (1 - q**2 * x**2 / 3)

    assert 2 * modulus * quad(lambda x: g(a) - g(x), 0, a)[0] == pytest.approx(extent.LOAD, rel=1e-9)
    sphere = 4 * CONTACT**3 / (3 * SPHERE.radius**2)
    assert extent.wave_friction(q) == pytest.approx(quad(lambda x: slope(x) ** 2, 0, a)[0] / sphere, rel=1e-9)
    assert extent.wave_friction(1e-3 * q) == pytest.approx(1.0, abs=1e-5)


def test_most_of_what_parts_a_lattice_from_a_free_tip_at_rest_is_the_shape_of_its_wave():
    contest, *_ = extent.contests("quick")
    cells = contest.ladders[0]
    cells = replace(cells, values=cells.values[1:], rungs=cells.rungs[1:])
    errors = judge(replace(contest, ladders=(cells,)), solved(cells.rungs)).climbed[0].errors
    assert np.all(errors["radius"][1:] < 0.3 * errors["radius"][:-1])  # a quarter, as (a/lambda)^2
    assert np.all(errors["radius_less_shape"] < 0.25 * errors["radius"])


def test_a_free_window_has_no_error_of_its_extent():
    contest, *_ = extent.contests("quick")
    windows = contest.ladders[1]
    close, wide = judge(replace(contest, ladders=(windows,)), solved(windows.rungs)).climbed[0].errors["radius"]
    assert close == pytest.approx(wide, rel=0.05)  # the pixels lie differently under the edge


def test_single_precision_reaches_what_its_tolerance_asks_for_and_no_more():
    scene = pressed(SPHERE)
    tight, double, single = (
        BEM(points=64, tolerance=tolerance, precision=precision).solve(scene).normal_force
        for tolerance, precision in ((1e-11, "double"), (1e-7, "double"), (1e-5, "single"))
    )
    assert abs(double / tight - 1) < abs(single / tight - 1) < 1e-5


def test_points_within_the_error_of_the_reference_are_hollow_and_failures_are_named():
    found = drawn([1e-2, nan, 1e-4], reasons=[None, "too steep", None], reference_error=1e-3)
    (axes,) = workprecision.figure([found]).axes
    faces = {
        y: line.get_markerfacecolor()
        for line in axes.lines
        if line.get_linestyle() == "None"
        for y in line.get_ydata()
        if np.isfinite(y)
    }
    assert faces == {1e-2: style.COLOUR["BEM"], 1e-4: "white"}
    written = [text.get_text() for text in axes.texts]
    assert "failed: points 64" in written
    assert {"32", "128"} <= set(written)
    assert "64" not in written


def test_estimates_of_one_answer_share_a_panel():
    found = drawn([1e-2, 1e-3, 1e-4], by=("joined", "by loss"))
    assert len(workprecision.figure([found]).axes) == 1
    assert len(workprecision.panels([found])[0].curves) == 2
    assert "first ladder" in workprecision.caption([found])


def test_what_is_written_covers_neither_points_nor_other_texts():
    found = drawn([1e-2, 0.9e-2, 0.8e-2, 0.7e-2], processor=[1.0, 1.05, 1.1, 1.15])
    (axes,) = workprecision.figure([found]).axes
    boxes = [text.get_window_extent() for text in axes.texts]
    assert len(boxes) >= 2
    assert not any(a.overlaps(b) for k, a in enumerate(boxes) for b in boxes[:k])
    marks = list(lettering._markers(axes))
    assert not any(box.overlaps(mark) for box in boxes for mark in marks)


@pytest.mark.parametrize("diagram", NUMERICAL, ids=lambda diagram: diagram.name)
def test_headings_have_room_beside_the_numbers_of_the_axis(diagram):
    contests = diagram.contests("full")
    with style.applied():
        drawing = workprecision.figure(judged(contests, failing(contests)))
        drawing.savefig(BytesIO(), dpi=DOTS_PER_INCH)
        headings = drawing.findobj(lambda part: isinstance(part, Text) and part.get_weight() == "bold")
        widths = [each.get_window_extent(dpi=DOTS_PER_INCH).width / DOTS_PER_INCH for each in headings]
    columns = len({axes.get_subplotspec().colspan.start for axes in drawing.axes})
    # Numbers and label of the vertical axis take up to 6 % of the page.
    assert max(widths) < (1 / columns - 0.06) * drawing.get_figwidth()


def test_tables_hold_every_rung_and_its_costs():
    found = drawn([1e-2, nan, 1e-4], reasons=[None, "too steep", None], reference_error=1e-5)
    rows = rungs([found])
    assert [entry["reason"] for entry in rows] == ["", "too steep", ""]
    assert [entry["points"] for entry in rows] == [32, 64, 128]
    assert np.isnan(rows[1]["processor"])
    assert all(entry["reference_error"] == pytest.approx(1e-5) for entry in rows)
    assert np.isnan(orders([found])[0]["order"])
    assert workprecision.figure([]) is None
    assert workprecision.sheets([]) == {}
