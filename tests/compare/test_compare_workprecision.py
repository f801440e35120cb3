"""Work and precision: times of solves, errors against a reference, times to an error, failures as failures."""

from dataclasses import replace
from math import inf, nan, sqrt

import numpy as np
import pytest
import xarray
from drawn_again import from_files
from drawn_scenes import KELVIN

from bem3d import BEM
from compare.library.case import Case
from compare.models.exact import Exact
from compare.models.table import Model
from compare.report.page import Table
from compare.solving.curve import SOLVED
from compare.studies.comparison.series import pilot
from compare.studies.workprecision import errors, ladder
from compare.studies.workprecision.errors import INTERVAL, Way
from compare.studies.workprecision.ladder import COARSEST, Ladder, TimedSolve
from compare.studies.workprecision.study import LEVELS, WorkPrecision
from compare.trustmap.corrected import CorrectedMDR
from mdr1d import MDR
from scene import Indent, Layer, Refused, SelfAffine, Slide, Sphere
from scene.scales import elastic_contact

SMOOTH = Case(
    indenter=Sphere(radius=1e-2), elastomer=KELVIN, motion=Slide(speed=0.1, load=1.0), bem=BEM(points=64)
)
ROUGH = replace(SMOOTH, roughness=SelfAffine(hurst=0.2, rms_height=1e-5, longest=1e-2, shortest=1e-3, seed=1))
TRUE, SCATTER, FLOOR = 0.1, 0.2, 0.5  # friction that is made, its scatter between surfaces, error of 1D
BIAS = (0.0, 0.0025, 0.01, 0.04)  # relative, of the made grids from fine to coarse, the first two of the reference
SECONDS = (nan, nan, 0.2, 0.05)
COUNTS = (*pilot(4)[:-1], COARSEST)
BEM_LADDER = Ladder.of(Model.of(BEM(points=128)), ROUGH.scene, True)


@pytest.fixture(autouse=True)
def briefly(monkeypatch):
    """Repeats of a timed solve that end at once."""
    monkeypatch.setattr(ladder, "REPEATED", 0.0)


def dataset(values, processor, points, strata=None):
    """Answers (level, surface) of a model at a load of 1 N; NaN failed, or was never asked."""
    values = np.asarray(values, float)
    failed = np.isnan(values) if strata is None else np.zeros(values.shape, bool)
    dims = "level", "surface"
    found = xarray.Dataset(
        {
            "friction_force": (dims, values),
            "normal_force": (dims, np.ones(values.shape)),
            "status": (dims, np.where(failed, "failed", SOLVED)),
            "reason": (dims, np.where(failed, "does not converge", "")),
            "processor": ("level", list(processor)),
        },
        {"points": ("level", list(points))},
    )
    return found if strata is None else found.assign_coords(stratum=("surface", strata))


def surfaces(seed=1):
    """Rough answers of 3D in strata: each surface its own friction, each grid its own bias."""
    random, strata = np.random.default_rng(seed), np.repeat(range(len(COUNTS)), COUNTS)
    own = TRUE * (1 + SCATTER * random.standard_normal(strata.size))
    values = own + TRUE * np.array(BIAS)[:, None] * (1 + 0.1 * random.standard_normal((len(BIAS), strata.size)))
    asked = [(strata == k) | (strata == k - 1) for k in range(len(COUNTS))]
    return dataset(np.where(asked, values, nan), SECONDS, (512, 256, 128, 64), strata)


def profiles(seed=2):
    random = np.random.default_rng(seed)
    return dataset([TRUE * (1 - FLOOR + SCATTER * random.standard_normal(1000))], [1e-3], [5000])


def truth(own):
    """What ways to friction are measured against."""
    return errors.reference(BEM_LADDER, own, "friction", nan)


def smooth(values):
    """Ways of 3D on one smooth body, with errors made to order on grids from fine to coarse."""
    own = dataset(np.array(values)[:, None], SECONDS[: len(values)], (512, 256, 128, 64))
    of = truth(own)
    return of, list(ways_of(own, of))


def ways_of(own, of):
    return errors.ways("made", "friction", BEM_LADDER, own, of, of.biases)


def of_line(line, of):
    own = Ladder.of(Model.of(MDR()), ROUGH.scene)
    return next(errors.ways("made", "friction", own, line, of, errors.against(line, "friction", of)))


def way(bias=0.0, reach=0.0, processor=0.1, setup=0.0):
    numbers = {"bias": bias, "most": abs(bias) + reach, "scatter": 0.2, "processor": processor, "setup": setup}
    return Way("made", "friction", "BEM", "3D", "64 points", **numbers)


def test_a_timed_solve_has_the_answers_of_its_settings_and_what_they_took():
    settings = BEM(points=32), BEM(points=64, tolerance=1e-7)
    found = TimedSolve(settings[0], (SMOOTH.scene,), settings[1:]).solve().rows
    assert [row.friction_force for row in found] == [each.solve(SMOOTH.scene).friction_force for each in settings]
    assert all(
        row.measures["repeats"] >= 3 for row in found
    )  # quick solves are repeated, and the least time is taken
    assert all(min(row.measures["processor"], row.measures["wall"]) > 0 for row in found)


def test_a_setting_that_fails_is_nan_with_its_reason_beside_one_that_does_not():
    fine = replace(
        SMOOTH.scene, roughness=SelfAffine(hurst=0.5, rms_height=1e-6, longest=2e-3, shortest=1e-4, seed=1)
    )
    task = TimedSolve(BEM(points=16), (fine,), (BEM(points=128),))
    failed, solved = task.solve().rows
    assert "less than two pixels" in failed.reason
    assert np.isnan(failed.friction_force)
    assert solved.reason is None
    assert task.fits(task.failed("killed"))


def test_the_expected_error_is_that_of_means_of_normal_deviates():
    """The rms error of 4000 means of 25; allowed: four standard errors of such an rms, 4/sqrt(8000)."""
    found = 0.03 + 0.2 * np.random.default_rng(2).standard_normal((4000, 25)).mean(axis=1)
    assert way(bias=0.03).error(25) == pytest.approx(np.sqrt(np.mean(found**2)), rel=0.045)


@pytest.mark.parametrize("level", LEVELS)
def test_a_wanted_error_takes_as_many_surfaces_as_reach_it_and_no_more(level):
    one = way(bias=0.003, reach=0.001, setup=0.05)
    count, most = one.count(level), 0.004
    assert most**2 + 0.2**2 / count <= level**2 < most**2 + 0.2**2 / (count - 1)
    assert one.effort(level) == pytest.approx(0.05 + 0.1 * count)


@pytest.mark.parametrize(
    "bad", [{"bias": 0.02}, {"bias": 0.01, "reach": 0.011}, {"bias": nan}, {"processor": nan}]
)
def test_no_number_of_surfaces_passes_the_bias_nor_its_interval_and_what_failed_reaches_nothing(bad):
    assert way(**bad).effort(0.02) == inf


def test_a_finer_solution_knows_its_own_error_and_a_closed_form_has_none():
    of, found = smooth([0.1, 0.1002, 0.101, 0.104])
    assert of.value.value == pytest.approx(0.1, rel=1e-12)
    assert of.error == pytest.approx(0.002, rel=1e-9)
    assert [each.bias for each in found] == pytest.approx([0.01, 0.04], rel=1e-9)
    assert [each.most for each in found] == pytest.approx([0.012, 0.042], rel=1e-9)
    exact = Ladder.of(Model.of(Exact()), replace(SMOOTH, motion=Indent(load=1.0)).scene, True)
    of = errors.reference(exact, dataset([[0.1]], [nan], [0]), "friction", nan)
    assert (of.error, of.source, exact.timed) == (0.0, "closed form", [])


def test_the_finest_that_solves_is_the_reference_and_says_so():
    of, found = smooth([nan, nan, 0.1, 0.104])
    assert of.source == "3D on 128 points, as finer grids have no answer"
    assert of.error == pytest.approx(0.04)
    assert found[0].most == pytest.approx(0.04)
    alone, _ = smooth([nan, nan, 0.1, nan])
    assert np.isnan(alone.error)
    own = dataset(np.full((4, 1), nan), SECONDS, (512, 256, 128, 64))
    assert np.isnan(truth(own).error)


def test_no_grid_is_better_than_finer_ones_as_it_may_be_by_chance():
    _, (fine, coarse) = smooth([0.1, 0.1001, 0.11, 0.1])
    assert coarse.bias == pytest.approx(0.0, abs=1e-12)
    assert coarse.most == fine.most > 0.1


def test_truth_and_floor_are_within_their_intervals_as_often_as_they_say():
    """Of 200 made ensembles; allowed: 95 % within three standard deviations of a binomial count, 4.6 %."""
    covered = []
    for seed in range(200):
        of = truth(surfaces(seed))
        low, high = of.value.interval()
        line = of_line(profiles(seed + 200), of)
        covered.append((low <= TRUE <= high, 2 * abs(line.bias) - line.most <= FLOOR <= line.most))
    scatter, floor = np.mean(covered, axis=0)
    assert scatter == pytest.approx(0.95, abs=0.046)
    assert floor >= 0.95 - 0.046


def test_the_bias_of_a_grid_is_found_far_below_the_scatter():
    """Only the grid differs: allowed is a tenth of what eight surfaces scatter by, a fifth with its interval."""
    of = truth(surfaces())
    found = list(ways_of(surfaces(), of))
    for each, expected in zip(found, BIAS[2:], strict=True):
        assert each.bias == pytest.approx(expected * TRUE / of.scale, abs=0.1 * SCATTER / sqrt(8))
        assert abs(each.bias) < each.most < abs(each.bias) + 0.2 * SCATTER / sqrt(8)
        assert each.scatter == pytest.approx(SCATTER, rel=0.5)


def test_a_mean_that_lacks_surfaces_is_no_truth():
    """Of 128 surfaces two are less than 2 %, three are more."""
    for lost, known in ((2, True), (3, False)):
        own = surfaces()
        own["status"][3, -lost:] = "failed"
        own["friction_force"][3, -lost:] = nan
        of = truth(own)
        assert np.isfinite(of.biases[3].value) == known


def test_corrected_by_the_true_ratio_1d_keeps_no_error_and_by_a_wrong_one_it_does():
    of = truth(surfaces())
    own = dataset([[TRUE]], [0.05], [0])
    for ratio, keeps in ((1 - FLOOR, 0.0), ((1 - FLOOR) * 4 / 3, 0.25)):
        asked = own.assign(friction_ratio=(("level", "surface"), [[ratio]]))
        found = of_line(errors.corrected(asked, profiles(), "friction"), of)
        assert found.most - 2 * of.error - 0.02 <= keeps <= found.most
        assert found.scatter == pytest.approx(SCATTER / ratio, rel=0.1)


def test_no_other_surfaces_on_the_grids_give_a_smaller_error_in_the_same_time():
    of = truth(surfaces())
    finest = next(ways_of(surfaces(), of))
    found = errors.sampled(finest, "friction", BEM_LADDER, surfaces(), of)
    values, strata = errors.values(surfaces(), "friction"), surfaces()["stratum"].values
    own = [np.std((values[2] - values[3])[strata == 2], ddof=1), np.std(values[3, strata == 3], ddof=1)]
    costs = np.array([0.25, 0.05])
    assert found.processor == pytest.approx(np.dot(pilot(2), costs))
    # Of least variance at a cost: surfaces of each stratum as scatter over the root of the cost.
    scatter = np.dot(own, np.sqrt(costs)) / of.scale / sqrt(10 * found.processor)
    assert found.error(10) == pytest.approx(np.hypot(found.bias, scatter), rel=1e-9)


def judged(case, **models):
    study = WorkPrecision.of({"made": case}, **models)
    outcomes = {task: task.solve() for batch in study.batches() for task in batch.tasks}
    found = study.judge(study.answers(outcomes))
    tables = {table.name: table.frame for table in found.page("", xarray.DataTree()).every(Table)}
    return study, found, found.plots[0].tables | tables


def test_a_page_has_errors_and_times_of_what_solves_and_the_reasons_of_what_does_not():
    """A thin layer, which 1D refuses, with a model that is off the map."""
    study, found, tables = judged(replace(SMOOTH, layer=Layer(thickness=1e-3), bem=BEM(points=32)))
    ways = tables["workprecision-ways"]
    solved = ways[ways["bias"].notna()]
    assert set(solved["model"]) == {"BEM"}
    fine, coarse = (BEM(points=n).solve(study.cases["made"].scene).friction_coefficient for n in (128, 32))
    (bias,) = solved.loc[solved["quantity"] == "friction", "bias"]
    assert bias == pytest.approx(coarse / fine - 1, abs=2e-5)  # of other first guesses
    assert {"1D", "1D corrected", "3D law", "Persson"} == set(tables["workprecision-failures"]["model"])
    assert "measured against 3D on 128 points" in found.answer[0]
    assert [each.claim.unit for each in found.findings] == ["s"] * 2 * len(LEVELS)
    assert list(tables["workprecision-times"]["model"]) == ["3D", "3D"]


def test_a_rough_scene_has_means_over_surfaces_and_the_curve_of_intervals(monkeypatch):
    monkeypatch.setattr(ladder, "COARSEST", 16)
    monkeypatch.setattr(ladder, "PROFILES", 50)
    spent, timed = {BEM: 0.2, MDR: 1e-3, CorrectedMDR: 0.3}, ladder._timed

    def stated(solver, scene):
        found = timed(solver, scene)
        return replace(found, measures=found.measures | {"processor": spent[type(solver)]})

    monkeypatch.setattr(ladder, "_timed", stated)  # as times of a busy machine differ
    _, found, tables = judged(replace(ROUGH, bem=BEM(points=64)), models=[MDR(points=500), CorrectedMDR()])
    models = list(tables["workprecision-times"]["model"])
    assert [each for each in models if models.count(each) == 2] == models
    assert set(models) == {"1D", "1D corrected", "3D", "3D, interval"}
    ways = tables["workprecision-ways"]
    assert (ways.loc[ways["settings"] == INTERVAL, "scatter"] > 0).all()
    setup = 0.3 - CorrectedMDR().profiles * 1e-3
    assert ways.loc[ways["model"] == "CorrectedMDR", "setup"].tolist() == pytest.approx([setup, setup])
    assert from_files(found.plots[0]).axes


def test_errors_at_rest_are_those_of_the_closed_form():
    case = replace(SMOOTH, motion=Indent(load=1.0))
    _, _, tables = judged(case, models=["mdr", "bem"])
    ways = tables["workprecision-ways"].set_index("settings")
    for solver in (BEM(points=32), MDR(points=625)):
        error = solver.solve(case.scene).depth / elastic_contact(case.scene).depth - 1
        assert ways.loc[f"{solver.points} points", "bias"] == pytest.approx(error, abs=1e-12)


def test_a_scene_that_nothing_can_be_measured_against_is_refused():
    waves = SelfAffine(hurst=0.5, rms_height=1e-9, longest=1e-2, shortest=1e-6, seed=1)
    made = replace(SMOOTH, roughness=waves)
    with pytest.raises(Refused, match="made: 3D, which others are measured against, refuses it"):
        WorkPrecision.of({"made": replace(made, layer=Layer(thickness=1e-2))})
    study = WorkPrecision.of({"made": made})
    assert study.ladders["made"][0].model.name == "ExtendedBEM"


def test_nothing_solved_is_a_page_without_a_figure():
    study = WorkPrecision.of({"made": SMOOTH}, models=["mdr"])
    outcomes = {task: task.failed("does not converge") for batch in study.batches() for task in batch.tasks}
    found = study.judge(study.answers(outcomes))
    assert found.plots == ()
    assert "measured against nothing, as no grid has an answer" in found.answer[0]
    assert {each.reason for each in found.findings} == {"not known"}
    (table,) = found.page("", xarray.DataTree()).every(Table)
    assert set(table.frame["reason"]) == {"does not converge"}
