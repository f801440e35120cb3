"""What it takes to know the true answer of three dimensions: means, both models, and what is advised."""

from dataclasses import replace
from math import inf, nan, sqrt

import numpy as np
import pytest

from bem3d import BEM
from compare import publish
from compare.figures import lettering, workprecision_models, workprecision_surfaces
from compare.outcome import Outcome, Row
from compare.workprecision import answers, diagram, models, surfaces
from compare.workprecision.contest import FORCE, FRICTION, ClosedForm, Contest, Known, Ladder
from compare.workprecision.ensemble import Ensemble
from compare.workprecision.rung import Rung
from compare.workprecision.statistics import Bias, Draw, Scatter, Way, cheapest, envelope
from mdr1d import MDR
from scene import Elastic, Indent, Kelvin, Scene, SelfAffine, Slide, Sphere

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


def way(bias=0.0, reach=0.0, scatters=(0.2,), seconds=(0.1,), solver="BEM"):
    grids = ((64,), (256, 64))
    drawn = (Draw(g, Scatter(s, 99), t) for g, s, t in zip(grids, scatters, seconds, strict=False))
    return Way(solver, Bias(bias, reach), tuple(drawn))


def ensemble(surfaces=40, paired=8, profiles=200):
    grids = tuple(GRID_BIAS)
    return Ensemble("made", "made", ROUGH, (FRICTION,), grids, surfaces, paired, (1000,), profiles)


def outcomes_of(asked, seed=1, fails=lambda solver, index: False, timed_fails=lambda solver: False):
    """Answers as both models might give them: each surface its own, each grid its own bias, 1D a floor."""
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
            failed = fails(task.solver, k)
            rows.append(Row(reason="does not converge") if failed else row_of(friction))
        found[task] = Outcome(tuple(rows))
    for rung in asked.timed:
        costs = dict.fromkeys(("processor", "wall"), SECONDS[rung.solver.points]) | {"memory": 1e6}
        failed = timed_fails(rung.solver)
        row = Row(reason="does not converge") if failed else row_of(TRUE, measures=costs)
        found[rung] = Outcome((row,))
    return found


def row_of(friction, **others):
    return Row(1.0, 1e-4, friction, residual=0.0, applications=10.0, seconds=0.1, **others)


def made(**how):
    asked = ensemble()
    return asked.judged(outcomes_of(asked, **how))


def contest(true=0.1, own_error=1e-5, errors=None, reason=None):
    """One smooth scene judged: relative errors of each ladder, made to order."""
    errors = errors or {"MDR": (0.2, 0.2), "BEM": (0.05, 0.01, 0.002)}
    points = {"MDR": (100, 1000), "BEM": (32, 64, 128)}
    ladders = tuple(
        Ladder.of(solver.name, SMOOTH, solver, "points", points[solver.name]) for solver in (MDR(), BEM())
    )
    truth = ClosedForm("made", {"friction": Known(true, own_error * true)})
    asked = Contest("smooth", "smooth", truth, (FRICTION,), ladders)
    found = {}
    for ladder in ladders:
        for k, rung in enumerate(ladder.rungs):
            wrong = errors[ladder.label][k]
            spent = 1e-5 * 10**k if ladder.label == "MDR" else 1e-2 * 4**k
            row = row_of(true * (1 + wrong), measures={"processor": spent, "wall": spent, "memory": 1e6})
            found[rung] = Outcome((row if np.isfinite(wrong) else Row(reason="does not converge"),))
    return asked.judged(found)


def test_the_expected_error_is_that_of_means_of_normal_deviates():
    """The rms error of 4000 means of 25; allowed: four standard errors of such an rms, 4/sqrt(8000)."""
    random = np.random.default_rng(2)
    means = 0.03 + 0.2 * random.standard_normal((4000, 25)).mean(axis=1)
    assert way(bias=0.03).error_of(25) == pytest.approx(np.sqrt(np.mean(means**2)), rel=0.045)


def test_the_interval_of_a_scatter_covers_as_often_as_it_says():
    """Of 2000 samples of eight; allowed: four standard deviations of a binomial share, 0.02."""
    random = np.random.default_rng(3)
    ends = [Scatter.of(sample).interval() for sample in random.standard_normal((2000, 8))]
    covered = np.mean([low <= 1.0 <= high for low, high in ends])
    assert covered == pytest.approx(0.95, abs=0.02)


def test_no_other_numbers_of_surfaces_give_a_smaller_error_in_the_same_time():
    """Allowed: rounding."""
    both = way(bias=0.01, scatters=(0.2, 0.02), seconds=(0.1, 0.7))
    best = both.error(100.0)
    for share in np.linspace(0.01, 0.99, 99):
        counts = share * 100.0 / 0.1, (1 - share) * 100.0 / 0.7
        assert best <= sqrt(0.01**2 + 0.2**2 / counts[0] + 0.02**2 / counts[1]) * (1 + 1e-12)


@pytest.mark.parametrize("level", answers.LEVELS)
def test_what_is_said_to_reach_an_error_reaches_it_with_no_surface_to_spare(level):
    """With the largest bias of the interval, and corrections that scatter by the largest of theirs."""
    both = way(bias=0.001, reach=0.0005, scatters=(0.2, 0.02), seconds=(0.1, 0.7))
    reached, most = both.reaching(level), both.draws[1].scatter.interval()[1]
    assert most > 0.02

    def error(first, second):
        return sqrt(0.0015**2 + 0.2**2 / first + most**2 / second)

    first, second = reached.counts
    assert error(first, second) <= level
    assert error(first - 1, max(second - 1, 1e-9)) > level
    assert reached.seconds == pytest.approx(reached.counts[0] * 0.1 + reached.counts[1] * 0.7)


def test_no_number_of_surfaces_passes_the_bias_nor_its_interval():
    assert way(bias=0.02).reaching(0.02) is None
    assert way(bias=0.02, reach=0.01).reaching(0.029) is None
    assert way(bias=-0.02, reach=0.01).reaching(0.031) is not None


@pytest.mark.parametrize(
    "failed", [way(bias=nan), way(reach=nan), way(scatters=(nan,)), way(seconds=(nan,))], ids=lambda w: str(w.bias)
)
def test_what_failed_is_never_the_cheapest(failed):
    slow = way(seconds=(1e6,))
    assert failed.reaching(inf) is None
    assert cheapest([failed, slow], 0.1).way is slow
    assert cheapest([failed], 0.1) is None
    assert envelope([failed], np.array([1.0, 10.0])).tolist() == [inf, inf]


def test_truth_and_floor_are_within_their_intervals_as_often_as_they_say():
    """Of 200 made ensembles; allowed: 95 % within three standard deviations of a binomial count, 4.6 %.

    The whole intervals hold what the grid may do besides, and may cover more often.
    """
    asked = ensemble()
    covered = []
    for seed in range(200):
        standing = asked.judged(outcomes_of(asked, seed)).standings["friction"]
        truth, floor = standing.truth, standing.floor
        finest = TRUE * (1 + GRID_BIAS[256])
        scattered = truth.error - standing.discretisation * truth.scale
        off = abs(truth.value - finest)
        covered.append((off <= scattered, off <= truth.error, floor.least <= FLOOR <= floor.most))
    by_scatter, *whole = np.mean(covered, axis=0)
    assert by_scatter == pytest.approx(0.95, abs=0.046)
    assert min(whole) >= 0.95 - 0.046


def test_the_bias_of_a_grid_is_found_far_below_the_scatter():
    """On the same surfaces the grid alone differs: allowed is a tenth of what eight scatter by."""
    standing = made().standings["friction"]
    for each in surfaces.plain(standing)[:-1]:
        points = each.draws[0].points[0]
        expected = (GRID_BIAS[points] - GRID_BIAS[256]) * TRUE / standing.truth.value
        assert each.bias.value == pytest.approx(expected, abs=0.1 * SCATTER / sqrt(8))
        assert each.bias.least <= expected <= each.bias.most


def test_the_finest_grid_claims_no_less_than_what_halving_its_points_changes():
    standing = made().standings["friction"]
    finest = surfaces.plain(standing)[-1]
    assert finest.bias.most == standing.discretisation
    assert standing.discretisation == pytest.approx(0.015, rel=0.2)


def test_one_dimension_is_taken_where_its_floor_allows_and_only_there():
    rough, smooth = made(), contest()
    for found, above, below in ((rough, 0.7, 0.3), (smooth, 0.3, 0.1)):
        assert answers.answer(found, "friction", above).solver == "MDR"
        assert answers.answer(found, "friction", below).solver == "BEM"
        assert answers.answer(found, "friction", below, "MDR") is None


def test_nothing_below_what_is_known_of_the_truth_is_claimed():
    vague = contest(own_error=0.02)
    assert answers.answer(vague, "friction", 0.01) is None
    assert answers.best(vague, "friction") == pytest.approx(0.022)
    assert answers.answer(contest(), "friction", 0.01).settings == "128 points"
    rough = made()
    assert answers.answer(rough, "friction", rough.standings["friction"].discretisation) is None


def test_a_solve_that_failed_is_counted_with_its_reason_and_its_ladder_reaches_nothing():
    found = contest(errors={"MDR": (0.0, nan), "BEM": (0.05, 0.01, 0.002)})
    assert answers.answer(found, "friction", 0.01, "MDR") is None
    assert "does not converge" in models.advice([found])
    rough = made(fails=lambda solver, k: solver.name == "BEM" and k == 1, timed_fails=lambda s: s.points == 64)
    assert [len(sample.reasons) for sample in rough.samples] == [1, 1, 1, 0]
    assert "1 of 40 in 3D with 64 points: does not converge" in surfaces.advice([rough])
    for row in answers.table([rough]):
        assert "64 points" not in row["settings"]


@pytest.mark.parametrize("advise", [models.advice, surfaces.advice], ids=["models", "surfaces"])
def test_advice_holds_where_everything_failed(advise):
    """No number is made of what was not solved."""
    said = advise([made(fails=lambda *_: True, timed_fails=lambda *_: True)])
    assert "Not solved" in said
    assert "nan" not in said
    assert "inf" not in said


def test_advice_names_the_floor_and_what_a_level_takes():
    said = models.advice([contest(), made()])
    assert "20 %" in said
    assert "128 points in 0.16 s" in said
    assert "What error" not in said
    spoken = surfaces.advice([made()])
    assert "64 points, corrected by" in spoken


def test_the_table_has_every_regime_quantity_and_level_and_says_what_is_not_reached():
    found = [contest(own_error=0.02), made()]
    rows = answers.table(found)
    assert len(rows) == 2 * len(answers.LEVELS)
    smooth, rough = answers.cells(found, ("friction",))
    assert smooth["within 0.3 %"] == "not reached; best known 2.2 %"
    assert (smooth["regime"], rough["regime"]) == ("smooth", "made, expected (rms)")
    (failed,) = answers.cells([made(fails=lambda *_: True)], ("friction",))
    assert set(failed.values()) == {"made, expected (rms)", "not known"}


def test_one_dimension_keeps_no_error_that_its_grid_still_lowers():
    """Of second order: on ten times the points a hundredth."""
    exact, kept = contest(errors={"MDR": (1e-3, 1e-5), "BEM": (0.05, 0.01, 0.002)}), contest()
    said = [answers.cells([found], ("friction",))[0]["error that 1D keeps"] for found in (exact, kept)]
    assert said == ["none (it converges)", "20 %"]
    assert "on its finest grid an error of 20 % (smooth); none (it converges) for smooth." in models.advice(
        [exact, kept]
    )
    assert "keeps none (it converges) for smooth." in models.advice([exact])


def test_a_mean_that_lacks_surfaces_is_no_truth():
    """Of 40 surfaces one is more than 2 %, of 100 it is not."""
    for surfaces_drawn, known in ((40, False), (100, True)):
        asked = ensemble(surfaces=surfaces_drawn)
        found = asked.judged(outcomes_of(asked, fails=lambda solver, k: solver.name == "BEM" and k == 20))
        assert np.isfinite(found.standings["friction"].truth.error) == known
        assert (answers.answer(found, "friction", 0.7) is not None) == known


def test_a_time_of_which_one_surface_failed_is_none():
    asked = replace(ensemble(), timed_surfaces=2)
    outcomes = outcomes_of(asked)
    failed = next(rung for rung in asked.timed if rung.solver.points == 64)
    found = asked.judged({**outcomes, failed: Outcome((Row(reason="does not converge"),))})
    costs = {sample.points: sample.costs["processor"] for sample in found.samples}
    assert np.isnan(costs[64])
    assert costs[128] == SECONDS[128]


@pytest.mark.parametrize(
    ("discretisation", "cause"), [(0.02, "the truth is known to 2 %"), (0.005, "only to 1.5 %")]
)
def test_what_hinders_is_told_from_what_does_not(discretisation, cause):
    ways = (way(bias=0.01, reach=0.005), way(bias=discretisation, seconds=(nan,)))
    standing = replace(made().standings["friction"], discretisation=discretisation, ways=ways)
    assert cause in surfaces._hindrance(standing, 0.01)


def test_restricted_leaves_out_quantities_and_what_has_none_of_them():
    assert answers.restricted([contest(), made()], ("force",)) == []
    assert len(answers.restricted([contest(), made()], ("friction",))) == 2


@pytest.mark.parametrize("size", diagram.SIZES)
def test_no_solver_refuses_any_regime(size):
    for entry in models.DIAGRAM.contests(size):
        for rung in entry.timed:
            assert rung.solver.refusals(rung.scene) == []
        for task in entry.untimed[:2]:
            assert task.solver.refusals(task.scenes[0]) == []


def test_both_grids_have_the_same_surfaces():
    """Solved: force at a depth scatters between surfaces, and changes far less with the grid on each of them."""
    scene = replace(ROUGH, motion=Indent(depth=1e-4), elastomer=Elastic(modulus=1e6))
    asked = Ensemble("rest", "at rest", scene, (FORCE,), (32, 64), 5, 4, (1000,), 20)
    found = {task: task.solve() for task in asked.untimed}
    costs = dict.fromkeys(("processor", "wall", "memory"), 1.0)
    for rung in asked.timed:
        assert isinstance(rung, Rung)
        found[rung] = Outcome((row_of(0.0, measures=costs),))
    standing = asked.judged(found).standings["force"]
    first = surfaces.plain(standing)[0]
    assert abs(first.bias.value) < 0.1 * first.draws[0].scatter.value
    assert surfaces.corrected(standing)[0].draws[1].scatter.value < 0.1 * first.draws[0].scatter.value


@pytest.mark.parametrize(
    "how", [{}, {"fails": lambda *_: True, "timed_fails": lambda *_: True}], ids=["solved", "failed"]
)
def test_figures_are_drawn_of_whatever_came_with_their_tables(how, tmp_path):
    found = [contest(), made(**how)]
    drawn = publish.draw(tmp_path, workprecision_models, found)
    assert "Rough ones" in drawn.caption
    drawn = publish.draw(tmp_path, workprecision_surfaces, found[1:])
    assert "nan" not in drawn.caption
    written = {path.name for path in tmp_path.glob("*.csv") if not path.stem.endswith("-drawn")}
    assert written == {
        "workprecision-models-answers.csv",
        "workprecision-models-rungs.csv",
        "workprecision-models-ways.csv",
        "workprecision-surfaces.csv",
        "workprecision-surfaces-recipes.csv",
    }
    for each in ("failed", "reason", "memory", "scatter_low"):
        assert each in (tmp_path / "workprecision-surfaces.csv").read_text().splitlines()[0].split(",")


def test_without_data_there_is_no_figure():
    assert workprecision_models.figure([]) is None
    assert workprecision_surfaces.figure([]) is None


def test_panels_have_letters_beyond_the_alphabet():
    assert [lettering.letter(k) for k in (0, 25, 26, 52)] == ["a", "z", "aa", "ba"]
