"""Laws of cost: known powers come back with honest intervals, and what is no power is called none."""

import tracemalloc
from dataclasses import replace
from itertools import pairwise
from math import isnan, sqrt

import numpy as np
import pytest

from bem3d import BEM
from compare.report.plots import style
from compare.solving.outcome import Outcome, Row
from compare.statistics.costs import REPEATABLE, Law, NoLaw, fit, fit_whole, held_out
from compare.studies.workprecision.cost_fit import fits_of
from compare.studies.workprecision.cost_ladders import KELVIN, LOAD, SPHERE, ladders, plane
from compare.studies.workprecision.forecasts import LARGEST, forecasts
from compare.studies.workprecision.study import WorkPrecision
from scene import Indent, Scene

ROUNDING = 1e-9
TRIALS = 200
# Three standard deviations of a share of 95 % over TRIALS, 3 sqrt(0.95 * 0.05 / 200).
CHANCE = 0.046
GRIDS = np.array([64.0, 128, 256, 512, 1024, 2048])
SCATTER = 0.03  # of timings
FACTOR, EXPONENT, BEYOND = 3e-7, 2.3, 16384
COSTS = WorkPrecision.of("costs")
SOLVES = COSTS.diagrams[0].timed("quick")


def noisy(cost, seed):
    return cost * np.exp(SCATTER * np.random.default_rng(seed).standard_normal(len(cost)))


@pytest.fixture(scope="module")
def trials():
    """Laws fitted to a power with scatter, and one more measurement far beyond each."""
    true, found = FACTOR * np.append(GRIDS, BEYOND) ** EXPONENT, []
    for seed in range(TRIALS):
        *seen, beyond = noisy(true, seed)
        found.append((fit(GRIDS, seen), beyond))
    return found


def holds(interval, value):
    return interval[0] <= value <= interval[1]


@pytest.mark.parametrize(
    ("overhead", "exponent", "allowed"),
    # exact data: least squares with a fixed cost stop at the square root of rounding
    [(0.0, EXPONENT, ROUNDING), (0.02, 2.2, 1e-6)],
    ids=["a power", "a fixed cost beside a power"],
)
def test_an_exact_law_comes_back(overhead, exponent, allowed):
    law = fit(GRIDS, overhead + 1e-7 * GRIDS**exponent)
    assert law.exponent == pytest.approx(exponent, rel=allowed)
    assert law.overhead == pytest.approx(overhead, rel=allowed)
    assert law.at(BEYOND) == pytest.approx(overhead + 1e-7 * BEYOND**exponent, rel=10 * allowed)
    assert (law.lowest, law.highest) == (64, 2048)


def test_intervals_of_exponents_and_forecasts_hold_as_often_as_they_say_and_narrower_ones_would_not(trials):
    exponents = np.mean([holds(law.exponent_interval, EXPONENT) for law, _ in trials])
    beyond = np.mean([holds(law.interval(BEYOND), found) for law, found in trials])
    assert (exponents, beyond) == pytest.approx((0.95, 0.95), abs=CHANCE)
    narrow = [replace(law, covariance=law.covariance / 4) for law, _ in trials]
    assert np.mean([holds(law.exponent_interval, EXPONENT) for law in narrow]) < 0.95 - CHANCE
    # An F test overlooks some fixed costs, and intervals are then too narrow: it is not 95 % to the letter.
    laws = [fit(GRIDS, noisy(0.02 + 1e-7 * GRIDS**2.2, seed)) for seed in range(TRIALS // 2)]
    assert np.mean([holds(law.exponent_interval, 2.2) for law in laws]) >= 0.9


def test_one_more_measurement_amid_the_others_scatters_by_them_and_by_their_mean():
    law = fit(GRIDS, noisy(1e-7 * GRIDS**2.2, 3))
    # Six points, two unknowns: Student's t of four degrees of freedom, 2.7764.
    assert law.dof == 4
    half = 2.7764 * law.scatter * sqrt(1 + 1 / 6)
    assert np.log(law.interval(law.centre)[1] / law.at(law.centre)) == pytest.approx(half, rel=1e-4)


def test_a_cost_that_falls_to_a_level_gets_no_fixed_part():
    found = fit(GRIDS, 15 + 30 * (GRIDS / 64) ** -1.5)
    assert isinstance(found, Law)
    assert found.overhead == 0 > found.exponent


def test_what_is_no_power_is_said_to_be_none():
    speeds = np.logspace(-4, 4, 9)
    hump = 20 + 100 / (1 + np.log10(speeds) ** 2)
    found = fit_whole(speeds, hump)
    assert isinstance(found, NoLaw)
    assert "misfit" in found.reason
    assert (found.least, found.most, found.at_most) == (hump.min(), 120.0, 1.0)
    assert isinstance(fit(GRIDS, GRIDS**2 * [1, 2, 1, 2, 1, 2]), NoLaw)


def test_scatter_alone_does_not_make_a_power_none():
    # 1 in 100 at a scatter of REPEATABLE; more than half of the points would have to be dropped besides
    rng = np.random.default_rng(5)
    laws = [fit(GRIDS, GRIDS**2 * np.exp(REPEATABLE * rng.standard_normal(len(GRIDS)))) for _ in range(100)]
    assert sum(isinstance(law, NoLaw) for law in laws) <= 3


def test_points_that_do_not_follow_or_failed_are_left_out_and_too_few_make_no_law():
    cost = 1e-7 * GRIDS**2.2
    cost[0] *= 0.3  # neither scatter nor a fixed cost: less than the power
    law = fit(GRIDS, cost)
    assert (law.lowest, law.exponent) == (128, pytest.approx(2.2, rel=ROUNDING))
    cost[2] = np.nan
    assert fit(GRIDS, cost).count == 4
    assert isinstance(fit(GRIDS[:3], cost[:3]), NoLaw)
    assert isnan(fit([], []).least)


def test_the_reach_of_a_law_inverts_it_and_the_largest_point_can_be_held_out():
    law = fit(GRIDS, noisy(150 * GRIDS**2, 3))
    n, low, high = law.reach(64 * 2**30)
    # read off between 2000 points over nine decades
    assert law.at(n) == pytest.approx(64 * 2**30, rel=1e-4)
    assert low < n < high
    assert law.interval(low)[1] == pytest.approx(64 * 2**30, rel=1e-3)
    x, law, found = held_out(GRIDS, 2 * GRIDS**2)
    assert (x, found, law.highest) == (2048, 2 * 2048.0**2, 1024)


def test_applications_of_a_smooth_solve_hardly_grow_with_the_grid():
    # a count, alike on every machine: from 64 to 512 points it may not grow by a fifth with each doubling, where
    # plain conjugate gradients take sqrt(2) times as many
    scene = Scene(SPHERE, KELVIN, Indent(load=LOAD))
    counts = [BEM(points=n).solve(scene).operator_applications for n in (64, 128, 256, 512)]
    assert all(after <= 1.2 * before for before, after in pairwise(counts)), counts


def test_memory_of_a_solve_grows_with_the_points_of_its_grid():
    # arrays counted as they are made: all of them are planes, so bytes a point settle as edges lose weight
    def bytes_a_point(n):
        solver, scene = BEM(points=n), plane(n, 0.035)
        tracemalloc.start()
        try:
            solver.solve(scene)
            return tracemalloc.get_traced_memory()[1] / n**2
        finally:
            tracemalloc.stop()

    bytes_a_point(64)  # what is imported and compiled once
    small, large = bytes_a_point(128), bytes_a_point(256)
    assert 0.75 * small < large < small
    # 13 planes of double precision: heights, gaps, pressures, one spectrum and its symbol
    assert large < 16 * 8


def answers(failing=(), slower=None):
    """Datasets of outcomes that follow laws without any solve; `failing` : solves that fail, `slower` : one."""
    outcomes = {}
    for k, task in enumerate(SOLVES):
        if k in failing:
            outcomes[task] = Outcome((Row(reason="no converged contact"),))
            continue
        n, deep = task.solver.points, task.solver.name == "BEM"
        nodes = n**2 if deep else n
        measures = {
            "processor": (1e-2 + 1e-6 * nodes) * (5 if k == slower else 1),
            "wall": 2e-2,
            "memory": 151.0 * nodes,
            "repeats": 3.0,
            "time_steps": float(task.solver.steps),
            "contact_fraction": min(task.scene.motion.greatest / 0.1 / 2, 0.99) if deep else 1.0,
        }
        if task.products:
            measures |= {"plain_product": 1e-8 * nodes, "padded_product": 3e-8 * nodes}
        if deep:
            measures["transform_pairs"] = 50.0
        outcomes[task] = Outcome((Row(1.0, 1.0, 1.0, 0.0, 30.0, 0.1, measures, {"points": n}),))
    return COSTS.answers(outcomes)


def fits(**how):
    return {each.name: each for each in fits_of(answers(**how)["costs"])}


def test_a_ladder_is_fitted_with_all_its_costs():
    found = fits()["slide"]
    x = found.known("x")
    assert x.tolist() == [128, 192, 256, 384, 512]
    limit = 30 * 3e-8 * x**2 + 20 * 1e-8 * x**2
    assert found.known("over_limit") == pytest.approx(found.known("processor") / limit)
    assert found.laws["memory"].lowest == 256
    assert found.laws["memory"].exponent == pytest.approx(2, rel=ROUNDING)
    assert found.laws["processor"].exponent == pytest.approx(2, rel=1e-5)
    assert (found.known("stored_bytes") > 300).all()


@pytest.mark.parametrize("size", ["quick", "standard", "full"])
def test_each_size_measures_every_axis_and_nothing_that_a_solver_lacks(size):
    assert {ladder.setting for ladder in ladders(size).values()} >= {"points", "steps", "speed", "contact"}
    for task in COSTS.diagrams[0].timed(size):
        assert not task.solver.refusals(task.scene)


def test_a_failed_solve_costs_nan_and_says_why():
    found = fits(failing={0})["plane"]
    first = found.steps.iloc[0]
    assert isnan(first["processor"])
    assert (first["reason"], first["status"]) == ("no converged contact", "failed")
    assert found.laws["processor"].count == 4


def test_forecasts_are_checked_on_a_point_left_out_and_come_of_no_law_that_misses_it():
    found = COSTS.findings(answers())
    checks = [each for each in found if ".held-out-" in each.claim.id]
    assert {each.verdict for each in checks} == {"holds", "undecided"}
    memory = next(each for each in found if each.claim.id.endswith("largest-memory"))
    assert memory.value == pytest.approx(151 * LARGEST**2 / 2**30, rel=1e-6)
    slow = forecasts(list(fits(slower=4).values()))
    missed = next(each for each in slow if each.kind == "largest-time")
    assert isnan(missed.value)
    assert "factor of 5" in missed.reason
    assert not any(each.reason for each in slow if each.kind == "largest-memory")
    assert next(each for each in slow if each.kind == "held-out-time").held is False


@pytest.mark.parametrize("failing", [(), (1,), range(len(SOLVES))], ids=["none", "one", "all"])
def test_figure_and_answer_come_of_whatever_was_measured(failing):
    found = answers(failing=failing)
    findings = COSTS.findings(found)
    (plot,) = COSTS.judge(found).plots
    assert len(plot.tables["workprecision-costs"]) == sum(len(each.solves) for each in ladders("quick").values())
    with style.applied():
        assert len(plot.figure().axes) == 6
    told = " ".join(COSTS.answer(findings))
    assert " nan" not in told
    assert ("not known" in told) or not failing
