"""Laws of cost: known powers come back with honest intervals, and what is no power is called none."""

import tracemalloc
import warnings
from dataclasses import replace
from itertools import pairwise
from math import isnan

import numpy as np
import pytest
from matplotlib.figure import Figure

from bem3d import BEM
from compare.figures import style, workprecision_costs
from compare.outcome import Outcome, Row
from compare.publish import draw
from compare.workprecision import forecast
from compare.workprecision.costladders import KELVIN, LOAD, SPHERE, Paired, ladders, plane
from compare.workprecision.costs import COSTS, billed
from compare.workprecision.laws import REPEATABLE, Law, NoLaw, fit, fit_whole, held_out
from scene import Indent, Scene

ROUNDING = 1e-9
TRIALS = 200
# Of a share of 95 % over TRIALS: three standard deviations, 3 sqrt(0.95 * 0.05 / 200).
CHANCE = 0.046
GRIDS = np.array([64.0, 128, 256, 512, 1024, 2048])
SCATTER = 0.03  # of timings
FACTOR, EXPONENT, BEYOND = 3e-7, 2.3, 16384


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


def test_an_exact_power_comes_back():
    law = fit(GRIDS, FACTOR * GRIDS**EXPONENT)
    assert law.exponent == pytest.approx(EXPONENT, rel=ROUNDING)
    assert law.at(BEYOND) == pytest.approx(FACTOR * BEYOND**EXPONENT, rel=ROUNDING)
    assert law.overhead == 0
    assert (law.lowest, law.highest) == (64, 2048)


def test_a_fixed_cost_beside_a_power_is_found():
    # exact data: least squares stop at the square root of rounding
    law = fit(GRIDS, 0.02 + 1e-7 * GRIDS**2.2)
    assert law.exponent == pytest.approx(2.2, rel=1e-6)
    assert law.overhead == pytest.approx(0.02, rel=1e-6)


def test_intervals_of_an_exponent_hold_it_as_often_as_they_say(trials):
    share = np.mean([holds(law.exponent_interval, EXPONENT) for law, _ in trials])
    assert share == pytest.approx(0.95, abs=CHANCE)


def test_intervals_of_a_forecast_hold_one_more_measurement_as_often_as_they_say(trials):
    share = np.mean([holds(law.interval(BEYOND), beyond) for law, beyond in trials])
    assert share == pytest.approx(0.95, abs=CHANCE)


def test_intervals_that_are_too_narrow_would_be_seen(trials):
    narrow = [replace(law, covariance=law.covariance / 4) for law, _ in trials]
    assert np.mean([holds(law.exponent_interval, EXPONENT) for law in narrow]) < 0.95 - CHANCE


def test_intervals_hold_beside_a_fixed_cost_too():
    # An F test overlooks some fixed costs, and intervals are then too narrow: it is not 95 % to the letter.
    laws = [fit(GRIDS, noisy(0.02 + 1e-7 * GRIDS**2.2, seed)) for seed in range(TRIALS // 2)]
    assert np.mean([holds(law.exponent_interval, 2.2) for law in laws]) >= 0.9


def test_a_cost_that_falls_to_a_level_gets_no_fixed_part():
    found = fit(GRIDS, 15 + 30 * (GRIDS / 64) ** -1.5)
    assert isinstance(found, Law)
    assert found.overhead == 0
    assert found.exponent < 0


def test_what_is_no_power_is_said_to_be_none():
    speeds = np.logspace(-4, 4, 9)
    hump = 20 + 100 / (1 + np.log10(speeds) ** 2)
    found = fit_whole(speeds, hump)
    assert isinstance(found, NoLaw)
    assert "misfit" in found.reason
    assert (found.least, found.most, found.at_most) == (hump.min(), 120.0, 1.0)
    assert isinstance(fit(GRIDS, GRIDS**2 * [1, 2, 1, 2, 1, 2]), NoLaw)


def test_the_smallest_points_are_dropped_where_they_do_not_follow():
    cost = 1e-7 * GRIDS**2.2
    cost[0] *= 0.3  # neither scatter nor a fixed cost: less than the power
    law = fit(GRIDS, cost)
    assert law.lowest == 128
    assert law.exponent == pytest.approx(2.2, rel=ROUNDING)


def test_scatter_alone_does_not_make_a_power_none():
    # 1 in 100 at a scatter of REPEATABLE; more than half of the points would have to be dropped besides
    rng, x = np.random.default_rng(5), GRIDS
    laws = [fit(x, x**2 * np.exp(REPEATABLE * rng.standard_normal(len(x)))) for _ in range(100)]
    assert sum(isinstance(law, NoLaw) for law in laws) <= 3


def test_failed_points_are_left_out_and_too_few_make_no_law():
    cost = 1e-7 * GRIDS**2
    cost[2] = np.nan
    assert fit(GRIDS, cost).count == 5
    assert isinstance(fit(GRIDS[:3], cost[:3]), NoLaw)
    assert isnan(fit([], []).least)


def test_the_reach_of_a_law_inverts_it():
    law = fit(GRIDS, noisy(150 * GRIDS**2, 3))
    n, low, high = law.reach(64 * 2**30)
    # read off between 2000 points over nine decades
    assert law.at(n) == pytest.approx(64 * 2**30, rel=1e-4)
    assert low < n < high
    assert law.interval(low)[1] == pytest.approx(64 * 2**30, rel=1e-3)


def test_the_largest_point_is_held_out():
    x, law, found = held_out(GRIDS, 2 * GRIDS**2)
    assert (x, found, law.highest) == (2048, 2 * 2048.0**2, 1024)


def test_applications_of_a_smooth_solve_hardly_grow_with_the_grid():
    # a count, alike on every machine: from 64 to 512 points it may not grow by a fifth with each doubling, where
    # plain conjugate gradients take sqrt(2) times as many
    def counted(n):
        return BEM(points=n).solve(Scene(SPHERE, KELVIN, Indent(load=LOAD))).applications

    counts = [counted(n) for n in (64, 128, 256, 512)]
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


def made(size="quick", failing=()):
    """Outcomes that follow laws without any solve; `failing` : tasks that fail, by place."""
    outcomes = {}
    for k, task in enumerate(COSTS.timed(size)):
        if k in failing:
            outcomes[task] = Outcome((Row(reason="no converged contact"),))
            continue
        n, deep = task.solver.points, task.solver.name == "BEM"
        nodes = n**2 if deep else n
        measures = {
            "processor": 1e-2 + 1e-6 * nodes,
            "wall": 2e-2,
            "memory": 151.0 * nodes,
            "repeats": 3.0,
            "time_steps": float(task.solver.steps),
            "contact_fraction": min(task.scene.motion.greatest / 0.1 / 2, 0.99) if deep else 1.0,
        }
        if isinstance(task, Paired):
            measures |= {"plain_product": 1e-8 * nodes, "padded_product": 3e-8 * nodes}
        if deep:
            measures["transform_pairs"] = 50.0
        outcomes[task] = Outcome((Row(1.0, 1.0, 1.0, 0.0, 30.0, 0.1, measures, {"points": n}),))
    return outcomes


def test_a_ladder_is_billed_with_all_its_costs():
    ladder = ladders("quick")["slide"]
    bill = billed(ladder, made())
    assert bill.x.tolist() == [128, 192, 256, 384, 512]
    assert bill.limit == pytest.approx(30 * 3e-8 * bill.x**2 + 20 * 1e-8 * bill.x**2)
    assert bill.laws["memory"].lowest == 256
    assert bill.laws["memory"].exponent == pytest.approx(2, rel=ROUNDING)
    assert bill.laws["processor"].exponent == pytest.approx(2, rel=1e-5)
    assert (bill.stored > 300).all()


@pytest.mark.parametrize("size", ["quick", "full"])
def test_each_size_measures_every_axis_and_nothing_twice(size):
    tasks = COSTS.timed(size)
    assert len(set(tasks)) == len(tasks)
    settings = {ladder.setting for ladder in ladders(size).values()}
    assert settings >= {"points", "steps", "speed", "contact"}
    for task in tasks:
        assert not task.solver.refusals(task.scene)


def test_a_failed_solve_costs_nan_and_says_why():
    costed = COSTS.judge("quick", made(failing={0}))
    bill = costed.bills["plane"]
    assert isnan(bill.processor[0])
    assert bill.reasons[0] == "no converged contact"
    assert bill.laws["processor"].count == 4
    assert "no converged contact" in COSTS.advice(costed)


def test_forecasts_are_checked_on_a_point_left_out():
    costed = COSTS.judge("quick", made())
    checks = [each for each in costed.forecasts if "from fewer" in each.what and each.reason is None]
    assert checks
    assert all(each.held is not None for each in checks)
    wrong = replace(checks[0], found=2 * checks[0].high)
    assert wrong.held is False


def test_a_law_that_misses_its_own_largest_grid_forecasts_nothing():
    outcomes = made()
    last = COSTS.timed("quick")[4]
    (row,) = outcomes[last].rows
    slow = replace(row, measures={**row.measures, "processor": 5 * row.measures["processor"]})
    costed = COSTS.judge("quick", {**outcomes, last: Outcome((slow,))})
    missed = next(each for each in costed.forecasts if each.what == forecast.largest("time"))
    assert isnan(missed.value)
    assert "factor of 5" in missed.reason
    kept = [each for each in costed.forecasts if each.what == forecast.largest("memory")]
    assert all(each.reason is None for each in kept)


def test_advice_covers_whatever_was_found():
    everything = range(len(COSTS.timed("quick")))
    for failing in ((), (0, 5), everything):
        costed = COSTS.judge("quick", made(failing=failing))
        text = COSTS.advice(costed)
        assert "nan" not in text
        assert " inf" not in text
        assert text.endswith(".")
    assert "every solve failed" in text


def test_advice_speaks_from_the_numbers():
    costed = COSTS.judge("quick", made())
    memory = next(e for e in costed.forecasts if e.what == f"memory with {forecast.LARGEST}² points")
    assert memory.value == pytest.approx(151 * forecast.LARGEST**2 / 2**30, rel=1e-6)
    assert "38 GiB" in COSTS.advice(costed)  # 37.75


def test_the_figure_draws_what_it_is_given(tmp_path):
    costed = COSTS.judge("quick", made(failing={1}))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        drawn = draw(tmp_path, workprecision_costs, costed)
    assert drawn.inches == style.DOUBLE
    assert {path.name for path in tmp_path.glob("*.csv")} == {
        "workprecision-costs.csv",
        "workprecision-costs-laws.csv",
        "workprecision-costs-forecasts.csv",
        "workprecision-costs-drawn.csv",
    }
    rows = (tmp_path / "workprecision-costs.csv").read_text().splitlines()
    assert len(rows) == 1 + sum(len(bill.x) for bill in costed.bills.values())


def test_the_figure_survives_that_all_fails():
    costed = COSTS.judge("quick", made(failing=range(len(COSTS.timed("quick")))))
    with style.applied():
        assert isinstance(workprecision_costs.figure(costed), Figure)
    assert workprecision_costs.figure(replace(costed, bills={})) is None


def test_a_law_knows_its_scatter():
    law = fit(GRIDS, noisy(FACTOR * GRIDS**EXPONENT, 1))
    assert isinstance(law, Law)
    assert law.freedom == 4
    # a standard deviation of four degrees of freedom, within its interval of 99.9 %
    assert 0.15 * SCATTER < law.scatter < 2.2 * SCATTER
