"""What it takes to know the true answer of three dimensions: means over surfaces, both models, and findings."""

from dataclasses import replace
from math import inf, nan, sqrt

import numpy as np
import pytest
import xarray

from bem3d import BEM
from compare.figures import style
from compare.solving.outcome import Outcome, Row
from compare.statistics.sampling import Bias, Level, SamplingPlan, Scatter, cheapest, envelope
from compare.studies.workprecision.answers import LEVELS, answers_table, cells, regimes_of
from compare.studies.workprecision.convergence import Convergence, Ladder
from compare.studies.workprecision.ensemble import Ensemble, means, plans_table
from compare.studies.workprecision.figures.models import means as drawn_means
from compare.studies.workprecision.models import MODELS, SURFACES
from compare.studies.workprecision.reference import FRICTION, Known, closed_form
from mdr1d import MDR
from scene import Kelvin, Scene, SelfAffine, Slide, Sphere

ROUGH = Scene(
    Sphere(radius=10e-3),
    Kelvin(modulus=1e6, relaxation_time=1e-3),
    Slide(speed=0.1, load=1.0),
    SelfAffine(hurst=0.2, rms_height=1e-5, longest=1e-2, shortest=1e-3, seed=1),
)
SMOOTH = replace(ROUGH, roughness=None)
TRUE, SCATTER, FLOOR = 0.1, 0.2, 0.5  # friction of the made ensembles, its scatter between surfaces, error of 1D
GRID_BIAS = {64: 0.06, 128: 0.02, 256: 0.005}  # relative, of the made ensembles
SECONDS = {64: 0.1, 128: 0.2, 256: 0.6, 1000: 1e-3}
SETUP = 0.05  # of the trust map [s]
OFF_THE_MAP = "Off the map: made so."


def plan(bias=0.0, reach=0.0, scatters=(0.2,), seconds=(0.1,), solver="BEM"):
    grids = ((64,), (256, 64))
    levels = (Level(g, Scatter(s, 99), t) for g, s, t in zip(grids, scatters, seconds, strict=False))
    return SamplingPlan(solver, Bias(bias, bias - reach, bias + reach), tuple(levels))


def ensemble(surfaces=40, **changed):
    grids = tuple(GRID_BIAS)
    return replace(Ensemble("made", "made", ROUGH, (FRICTION,), grids, surfaces, 8, (1000,), 200), **changed)


def outcomes_of(asked, seed=1, fails=lambda solver, index: False, timed_fails=lambda solver: False, ratio=nan):
    """Answers as the models might give them: each surface its own, each grid its own bias, 1D a floor.

    ratio : of 1D over 3D on the trust map; off it if NaN
    """
    random = np.random.default_rng(seed)
    own = TRUE * (1 + SCATTER * random.standard_normal(asked.surfaces))
    found = {}
    for task in asked.untimed:
        rows = []
        for scene in task.scenes:
            k = scene.roughness.seed - 1
            if task.solver.name == "MDR":
                friction = TRUE * (1 - FLOOR + SCATTER * random.standard_normal())
            else:
                friction = own[k] + TRUE * GRID_BIAS[task.solver.points] * (1 + 0.1 * random.standard_normal())
            rows.append(Row(reason="does not converge") if fails(task.solver, k) else row_of(friction))
        found[task] = Outcome(tuple(rows))
    *timed, corrected = asked.timed
    for task in timed:
        costs = dict.fromkeys(("processor", "wall"), SECONDS[task.solver.points]) | {"memory": 1e6}
        failed = timed_fails(task.solver)
        found[task] = Outcome((Row(reason="does not converge") if failed else row_of(TRUE, measures=costs),))
    known = {"friction_ratio": ratio, "processor": SETUP + SECONDS[1000]}
    row = row_of(TRUE, measures=known) if np.isfinite(ratio) else Row(reason=OFF_THE_MAP)
    return found | {corrected: Outcome((row,))}


def row_of(friction, **others):
    return Row(1.0, 1e-4, friction, residual=0.0, operator_applications=10.0, seconds=0.1, **others)


def node(*parts):
    return xarray.DataTree.from_dict({name: each for part in parts for name, each in part.items()})


def made(asked=None, **how):
    asked = asked or ensemble()
    return asked.datasets(outcomes_of(asked, **how))


def mean(**how):
    return means(*made(**how).values())[0]


def smooth(own_error=1e-5, errors=None):
    """One smooth contact: relative errors of each ladder, made to order."""
    errors = errors or {"MDR": (0.2, 0.2), "BEM": (0.05, 0.01, 0.002)}
    points = {"MDR": (100, 1000), "BEM": (32, 64, 128)}
    ladders = tuple(
        Ladder.of(solver.name, SMOOTH, solver, "points", points[solver.name]) for solver in (MDR(), BEM())
    )
    truth = closed_form("made", {"friction": Known(TRUE, own_error * TRUE)})
    found = {}
    for ladder in ladders:
        for k, task in enumerate(ladder.solves):
            wrong = errors[ladder.label][k]
            spent = 1e-5 * 10**k if ladder.label == "MDR" else 1e-2 * 4**k
            row = row_of(TRUE * (1 + wrong), measures={"processor": spent, "wall": spent, "memory": 1e6})
            found[task] = Outcome((row if np.isfinite(wrong) else Row(reason="does not converge"),))
    return Convergence("smooth", "smooth", truth, (FRICTION,), ladders).datasets(found)


def regime(parts):
    return regimes_of(node(parts))[0]


def test_the_expected_error_is_that_of_means_of_normal_deviates():
    """The rms error of 4000 means of 25; allowed: four standard errors of such an rms, 4/sqrt(8000)."""
    random = np.random.default_rng(2)
    found = 0.03 + 0.2 * random.standard_normal((4000, 25)).mean(axis=1)
    assert plan(bias=0.03).error_of(25) == pytest.approx(np.sqrt(np.mean(found**2)), rel=0.045)


def test_a_scatter_has_a_degree_of_freedom_less_than_values():
    scatter = Scatter.of([1.0, nan, 3.0, 5.0])
    assert scatter == Scatter(2.0, 2)
    assert Scatter.of([1.0]).dof == Scatter.of([]).dof == 0


def test_the_interval_of_a_scatter_covers_as_often_as_it_says():
    """Of 2000 samples of eight; allowed: four standard deviations of a binomial share, 0.02."""
    random = np.random.default_rng(3)
    ends = [Scatter.of(sample).interval() for sample in random.standard_normal((2000, 8))]
    assert np.mean([low <= 1.0 <= high for low, high in ends]) == pytest.approx(0.95, abs=0.02)


def test_no_other_numbers_of_surfaces_give_a_smaller_error_in_the_same_time():
    both = plan(bias=0.01, scatters=(0.2, 0.02), seconds=(0.1, 0.7))
    best = both.error(100.0)
    for share in np.linspace(0.01, 0.99, 99):
        counts = share * 100.0 / 0.1, (1 - share) * 100.0 / 0.7
        assert best <= sqrt(0.01**2 + 0.2**2 / counts[0] + 0.02**2 / counts[1]) * (1 + 1e-12)  # rounding


@pytest.mark.parametrize("level", LEVELS)
def test_what_is_said_to_reach_an_error_reaches_it_with_no_surface_to_spare(level):
    """With the largest bias of the interval, and corrections that scatter by the largest of theirs."""
    both = plan(bias=0.001, reach=0.0005, scatters=(0.2, 0.02), seconds=(0.1, 0.7))
    effort, most = both.effort(level), both.levels[1].scatter.interval()[1]
    assert most > 0.02

    def error(first, second):
        return sqrt(0.0015**2 + 0.2**2 / first + most**2 / second)

    first, second = effort.counts
    assert error(first, second) <= level < error(first - 1, max(second - 1, 1e-9))
    assert effort.seconds == pytest.approx(first * 0.1 + second * 0.7)


def test_no_number_of_surfaces_passes_the_bias_nor_its_interval():
    assert plan(bias=0.02).effort(0.02) is None
    assert plan(bias=0.02, reach=0.01).effort(0.029) is None
    assert plan(bias=-0.02, reach=0.01).effort(0.031) is not None


@pytest.mark.parametrize("failed", [{"bias": nan}, {"reach": nan}, {"scatters": (nan,)}, {"seconds": (nan,)}])
def test_what_failed_is_never_the_cheapest(failed):
    failed, slow = plan(**failed), plan(seconds=(1e6,))
    assert failed.effort(inf) is None
    assert cheapest([failed, slow], 0.1) == slow.effort(0.1)
    assert cheapest([failed], 0.1) is None
    assert envelope([failed], np.array([1.0, 10.0])).tolist() == [inf, inf]


@pytest.mark.parametrize("count", [40, pytest.param(200, marks=pytest.mark.slow)])
def test_truth_and_floor_are_within_their_intervals_as_often_as_they_say(count):
    """Of made ensembles; allowed: 95 % within three standard deviations of a binomial count of 200, 4.6 %.

    The whole intervals hold what the grid may do besides, and may cover more often.
    """
    covered = []
    for seed in range(count):
        found = mean(seed=seed)
        off = abs(found.truth.value - TRUE * (1 + GRID_BIAS[256]))
        scattered = found.truth.error - found.grid_error * found.truth.scale
        floor = found.floor()
        covered.append((off <= scattered, off <= found.truth.error, floor.least <= FLOOR <= floor.most))
    by_scatter, *whole = np.mean(covered, axis=0)
    assert by_scatter == pytest.approx(0.95, abs=0.046)
    assert min(whole) >= 0.95 - 0.046


def test_the_bias_of_a_grid_is_found_far_below_the_scatter():
    """On the same surfaces the grid alone differs: allowed is a tenth of what eight scatter by."""
    found = mean()
    for each in found.plain[:-1]:
        expected = (GRID_BIAS[each.levels[0].points[0]] - GRID_BIAS[256]) * TRUE / found.truth.value
        assert each.bias.value == pytest.approx(expected, abs=0.1 * SCATTER / sqrt(8))
        assert each.bias.least <= expected <= each.bias.most
    # of the finest, no less than what halving its points changes
    assert found.plain[-1].bias.most == found.grid_error == pytest.approx(0.015, rel=0.2)


@pytest.mark.parametrize(
    ("parts", "above", "below"), [(made(), 0.7, 0.3), (smooth(), 0.3, 0.1)], ids=["rough", "smooth"]
)
def test_one_dimension_is_taken_where_its_floor_allows_and_only_there(parts, above, below):
    found = regime(parts)
    assert found.answer(above).solver == "MDR"
    assert found.answer(below).solver == "BEM"
    assert found.answer(below, "MDR") is None
    within = [each for each in MODELS.judge(node(parts)).findings if "1d-within" in each.claim.id]
    assert [each.verdict for each in within] == ["fails", "fails"]
    assert all(low <= each.value <= high for each in within for low, high in [each.interval])


def test_nothing_below_what_is_known_of_the_truth_is_claimed():
    vague, rough = regime(smooth(own_error=0.02)), regime(made())
    assert vague.answer(0.01) is None
    assert vague.best() == pytest.approx(0.022)
    assert regime(smooth()).answer(0.01).settings == "128 points"
    assert rough.answer(rough.mean.grid_error) is None


def test_a_solve_that_failed_is_told_with_its_reason_and_its_grid_reaches_nothing():
    found = regime(smooth(errors={"MDR": (0.0, nan), "BEM": (0.05, 0.01, 0.002)}))
    assert found.answer(0.01, "MDR") is None
    assert found.ways[0].failures == [(1000, "does not converge")]
    rough = made(fails=lambda solver, k: solver.name == "BEM" and k == 1, timed_fails=lambda s: s.points == 64)
    told = {(row["solver"], row["points"]): row for row in plans_table([regime(rough).mean])}
    coarse = told["BEM", 64]
    assert (coarse["failed"], coarse["surfaces"], coarse["reason"]) == (1, 40, "does not converge")
    assert not any("64 points" in row["settings"] for row in answers_table([regime(rough)]))
    statuses = rough["made/BEM"]["status"]
    assert (statuses.sel(points=64) == "failed").sum() == 1
    assert (statuses.sel(points=256) == "not asked").sum() == 32


def test_one_dimension_keeps_no_error_that_its_grid_still_lowers():
    """Of second order: on ten times the points a hundredth."""
    both = smooth(errors={"MDR": (1e-3, 1e-5), "BEM": (0.05, 0.01, 0.002)}), smooth()
    told = [cells([regime(each)])[0]["error that 1D keeps"] for each in both]
    assert told == ["none (it converges)", "20 %"]


@pytest.mark.parametrize(("surfaces", "known"), [(40, False), (100, True)])
def test_a_mean_that_lacks_surfaces_is_no_truth(surfaces, known):
    """Of 40 surfaces one is more than 2 %, of 100 it is not."""
    found = made(ensemble(surfaces), fails=lambda solver, k: solver.name == "BEM" and k == 20)
    assert np.isfinite(means(*found.values())[0].truth.error) == known
    assert (regime(found).answer(0.7) is not None) == known
    verdicts = {each.verdict for each in MODELS.judge(node(found)).findings if "1d-within" in each.claim.id}
    assert verdicts == ({"fails"} if known else {"undecided"})


def test_corrected_by_the_true_ratio_one_dimension_keeps_no_error_and_pays_for_the_map_first():
    found = mean(ratio=1 - FLOOR)
    (own,), (line,) = found.of("CorrectedMDR"), found.of("MDR")
    assert found.floor("CorrectedMDR").least == 0.0 < found.floor().least
    assert own.setup == pytest.approx(SETUP)
    assert own.levels[0].seconds == line.levels[0].seconds == SECONDS[1000]
    # Scatter of one profile relative to the true mean: as much more as its mean is less.
    assert own.levels[0].scatter.value == pytest.approx(line.levels[0].scatter.value / (1 - FLOOR))
    assert own.least_seconds == pytest.approx(SETUP + SECONDS[1000])
    assert own.error(SETUP + 25 * SECONDS[1000]) == pytest.approx(own.error_of(25))
    effort = own.effort(0.3)
    assert effort.seconds == pytest.approx(SETUP + effort.counts[0] * SECONDS[1000])
    assert regime(made(ratio=1 - FLOOR)).answer(0.3) == effort
    assert "profiles" in effort.settings


def test_off_the_map_the_corrected_model_has_no_error_and_says_why():
    found = regime(made())
    assert np.isnan(found.mean.floor("CorrectedMDR").value)
    assert found.answer(10.0, "CorrectedMDR") is None
    (told,) = (row for row in plans_table([found.mean]) if row["solver"] == "CorrectedMDR")
    assert told["reason"] == OFF_THE_MAP
    assert cells([found])[0]["best of 1D corrected"] == "not known"


def test_a_wrong_ratio_is_an_error_that_no_number_of_profiles_passes():
    """A third too high: the mean comes out at three quarters."""
    floor = mean(ratio=(1 - FLOOR) * 4 / 3).floor("CorrectedMDR")
    assert floor.least < 0.25 < floor.most
    assert floor.least > 0.1


def test_a_time_of_which_one_surface_failed_is_none():
    asked = ensemble(timed_surfaces=2)
    failed = next(task for task in asked.timed if task.solver.points == 64)
    outcomes = outcomes_of(asked) | {failed: Outcome((Row(reason="does not converge"),))}
    costs = asked.datasets(outcomes)["made/BEM"]["processor"]
    assert np.isnan(costs.sel(points=64))
    assert costs.sel(points=128) == SECONDS[128]


@pytest.mark.parametrize("fails", [False, True], ids=["solved", "failed"])
def test_figures_tables_and_findings_come_of_whatever_was_solved(fails):
    rough = made(fails=lambda *_: fails, timed_fails=lambda _: fails)
    unsolved = {"MDR": (nan, nan), "BEM": (nan, nan, nan)} if fails else None
    both = node(smooth(errors=unsolved), rough)
    plots = MODELS.judge(both).plots
    assert len(plots) == 2
    with style.applied():
        assert sum(len(plot.figure().axes) for plot in plots) == 2
    assert all(len(plot.caption.split()) <= 60 for plot in plots)
    for diagram, found in ((MODELS, both), (SURFACES, node(rough))):
        findings = diagram.judge(found).findings
        assert all(each.reason for each in findings if not np.isfinite(each.value))
        assert any(np.isfinite(each.value) for each in findings) or fails
    told, _ = SURFACES.judge(node(rough)).tables
    assert (told.frame["within 10 %"] == "not known").all() == fails


def test_plans_are_drawn_from_their_table_alone():
    _, plans = SURFACES.judge(node(made(ratio=1 - FLOOR))).tables
    (drawn,), measured = drawn_means(plans.frame), mean(ratio=1 - FLOOR)
    for there, here in zip(drawn.plans, measured.plans, strict=True):
        assert (there.levels, there.setup) == (here.levels, here.setup)
        assert there.bias.most == pytest.approx(here.bias.most, rel=1e-12)  # rounding
    assert [*SURFACES.judge(xarray.DataTree()).tables, *MODELS.judge(xarray.DataTree()).plots] == []
