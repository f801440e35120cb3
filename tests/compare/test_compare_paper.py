"""The paper simulated again: its parameter studies, its law, its shifts, and what becomes of its claims."""

from dataclasses import replace

import numpy as np
import pytest

from compare.solving.curve import of_model
from compare.solving.task import Outcome, Row
from compare.statistics.finding import Finding
from compare.statistics.intervals import Estimated
from compare.studies.paper import law, parameter_studies, parameters
from compare.studies.paper.parameter_studies import contacts, dataset, slow_friction, tasks
from compare.studies.paper.shifts import ROUGH, WHOLE, Rubber
from compare.studies.paper.study import Paper
from mdr1d import equations
from mdr1d.ensemble import solve_profiles
from scene import Cone, Regime, SolveError
from scene.files.reading import InvalidInput
from scene.scales import SMALL_SLOPE

VALUES, PROFILES = 3, 10
REASON = "ZeroDivisionError: a fault"


def solved(asked):
    return {task: task.solve() for task in asked}


def failed(asked):
    return {task: task.failed(REASON) for task in asked}


@pytest.fixture(scope="module")
def data():
    asked = tasks(VALUES, PROFILES)
    return dataset(asked, solved(asked))


@pytest.fixture(scope="module")
def slow(data):
    return slow_friction(VALUES, data)


def test_the_parameter_studies_are_those_of_the_paper():
    found = contacts(20)
    assert len(found) == 6 * 20 * 11
    assert sum(len(task.seeds) for task in tasks(20, 200)) == 200
    ranges = [(0.1, 10), (1e5, 1e7), (1e-6, 1e-4), (1e-7, 1e-5), np.radians((5, 75)), (1e-4, 1e-2)]
    for study, ends in zip(parameters.STUDIES, ranges, strict=True):
        values = sorted({each.parameter for each in found if each.study == study})
        assert len(values) == 20
        assert (values[0], values[-1]) == pytest.approx(tuple(ends), rel=1e-12)


def test_one_parameter_varies_at_a_time():
    reference = parameters.base("cone")
    for each in contacts(VALUES):
        scene = replace(each.scene, roughness=replace(each.scene.roughness, hurst=parameters.ROUGH.hurst))
        part, name, _ = parameters.STUDIES[each.study]
        if part:
            assert getattr(getattr(scene, part), name) == each.parameter
            scene = replace(scene, **{part: getattr(reference, part)})
        assert scene == reference
        assert (each.points == parameters.POINTS) == bool(part)
        assert each.points * each.parameter == pytest.approx(parameters.LENGTH) or part


def test_friction_at_low_speed_collapses_on_slope_one_where_the_conditions_hold(slow):
    slope, count = slow.power(slow.points["holds"].to_numpy())
    assert count >= 10
    assert slope.value == pytest.approx(1.0, abs=0.02)  # sampling of a smaller campaign
    low, high = slope.interval()
    assert low < slope.value < high


def test_what_does_not_collapse_is_the_macroscopic_slope(slow):
    where = slow.points["slow"]
    printed = slow.points["normalised_friction"] / slow.points["xi"]
    assert printed[where].max() > 100
    np.testing.assert_allclose((printed / slow.with_macro_slope)[where], 1.0, atol=0.1)


def test_a_point_without_an_answer_and_profiles_that_broke_are_left_out(slow, data):
    lost = data.copy(deep=True)
    lost["friction_coefficient"][5, 2] = np.nan
    found = slow_friction(VALUES, lost)
    assert found.power(np.ones(len(found.points), bool))[1] == len(found.points) - 1
    asked = tasks(VALUES, PROFILES + parameter_studies.TOGETHER)
    first = replace(asked[0], seeds=tuple(range(PROFILES)))
    outcomes = solved([first]) | failed(asked)
    assert all(task.fits(outcomes[task]) for task in outcomes)
    assert not first.fits(Outcome((), dict.fromkeys(outcomes[first].fields, np.zeros(1))))
    found = slow_friction(VALUES, dataset([first, asked[1]], outcomes))
    np.testing.assert_array_equal(found.samples, slow.samples)
    with pytest.raises(SolveError, match="no profile was solved"):
        slow_friction(VALUES, dataset(asked, outcomes))


def test_heights_slopes_and_loads_times_a_number_have_friction_times_that_number():
    small = 0.001
    scenes, points = zip(*((each.scene, each.points) for each in contacts(2)), strict=True)
    flat = [
        replace(
            scene,
            indenter=Cone(angle=np.arctan(small * np.tan(scene.indenter.angle))),
            motion=replace(scene.motion, load=small * scene.motion.load),
            roughness=replace(scene.roughness, rms_height=small * scene.roughness.rms_height),
        )
        for scene in scenes
    ]
    steep, gentle = (solve_profiles(each, points, seeds=(0, 1)) for each in (scenes, flat))
    # Both loads are met to 1e-10 at least; measured 2e-15.
    np.testing.assert_allclose(gentle.friction / small, steep.friction, rtol=1e-9)
    assert gentle.rms_slope.max() < SMALL_SLOPE < steep.rms_slope.max()


def test_all_conditions_hold_but_that_of_small_slopes():
    for ratios, holds in (((0.05, 0.5, 0.1, 2.0), True), ((0.2, 0.5, 0.1, 0.1), False)):
        assert parameters.holds(Regime(*ratios)) == holds


@pytest.mark.parametrize("alpha", [1.2, 1.5, 2.0])
def test_the_law_of_fig_4_has_its_exponent_back(alpha):
    assert law.best(law.VARIABLES, equations.interpolation(law.VARIABLES, alpha)) == pytest.approx(alpha, abs=1e-4)


def law_of(shape, profiles, outcomes=None):
    """Law of a shape from answers of its tasks, solved if there are none."""
    asked = law.curve(shape, profiles)
    return law.law(shape, of_model(asked.dataset(outcomes or solved(asked.tasks())), "MDR"))


def test_a_point_of_the_law_that_broke_is_left_out():
    asked, scatter = law.curve("sphere", 3).tasks(), 1 + 1e-3 * np.array([-1, 0, 1])
    level = equations.plateau(parameters.rms_slope()) * equations.interpolation(law.VARIABLES)
    whole = {
        task: Outcome(tuple(Row(10.0, 1e-4, 10.0 * friction * factor) for factor in scatter))
        for task, friction in zip(asked, level, strict=True)
    }
    found = law_of("sphere", 3, whole | failed(asked[4:5]))
    np.testing.assert_allclose(found.points["xi"], np.delete(law.VARIABLES, 4), rtol=1e-12)
    # The fit's own tolerance is 1e-6; noise of 1e-3 that is the same at all points moves alpha by less.
    assert found.alpha.value == pytest.approx(1.5, abs=5e-3)
    with pytest.raises(SolveError, match=r"Fig\. 4, sphere: nothing was solved"):
        law_of("sphere", 3, failed(asked))


def test_without_what_the_smooth_body_has_friction_shifts_as_the_loss_does(monkeypatch):
    monkeypatch.setattr(parameters, "SPEEDS", parameters.SPEEDS[::9])
    monkeypatch.setattr(parameters, "FORCES", parameters.FORCES[::2])
    rubber = Rubber(0.5, 1e-3)
    collapses = rubber.collapses(
        *(of_model(each.dataset(solved(each.tasks())), "MDR") for each in rubber.grids(4).values())
    )
    whole, rough = (collapses[of].horizontal for of in (WHOLE, ROUGH))
    assert rubber.shift == -0.75
    assert rough.exponent.value == pytest.approx(-0.75, rel=0.05)
    # The macroscopic shape has a friction of its own, of long waves.
    assert whole.misfit.value > 5 * rough.misfit.value
    judged = [*rubber.findings(collapses)]
    found = [each for each in judged if each.claim.id == "eq23.exponent"]
    assert [(each.grid, each.claim.expected) for each in found] == [(0.0, -0.75)] * 2
    drawn = rubber.plot(collapses, judged)
    assert drawn.alternative.startswith("β = 0.5, τ = 0.001 s, whole friction: ")


def test_an_interval_of_profiles_decides_a_claim_and_none_leaves_it_open():
    for value, error, verdict in ((1.5, 0.01, "holds"), (1.3, 0.01, "fails"), (1.5, np.nan, "undecided")):
        found = Finding.of(law.ALPHA, Estimated(value, error, 19), draws=20)
        assert (found.verdict, found.grid) == (verdict, 0.0)


def test_sizes_are_profiles_and_a_larger_one_has_the_tasks_of_a_smaller():
    assert [Paper.of(size).profiles for size in ("quick", "standard", "full")] == [20, 50, 200]
    with pytest.raises(InvalidInput):
        Paper.of("large")
    (batch,) = Paper.of("quick").batches()
    assert len(batch.tasks) == 1 + 2 + 2 * 25 + 4 * 2 * 280
    assert tasks(20, 60)[:2] == tasks(20, 50)
