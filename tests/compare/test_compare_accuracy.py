"""What an interval and an accuracy take is foretold from coarse surfaces, and is what they then take."""

from dataclasses import replace

import numpy as np
import pint
import pytest
import xarray
from small_cases import SLIDING
from test_compare_allocation import CASE
from test_compare_levels import answers
from typer.testing import CliRunner

import compare
from bem3d import BEM
from compare.cli.app import app
from compare.solving.amounts import share_of
from compare.solving.cost import MOST_DRAWS
from compare.solving.parameter_grid import DIFFERENCES, PILOT
from compare.statistics.intervals import student
from compare.statistics.levels import pooled
from compare.studies.accuracy import LONGEST, _affordable, _strata, forecast, settings, sufficient
from scene import Indent, Program, Stage
from scene.reading import InvalidInput

ROUGH = replace(CASE, roughness=replace(CASE.roughness, rms_height=2e-5))
# Surfaces that a scatter known from 32 of them asks for: of one standard deviation in four, its square in two.
ROUGHLY = 2.0


@pytest.fixture(scope="module")
def foretold():
    return forecast(ROUGH, 0.02)


@pytest.mark.usefixtures("in_this_process")
def test_a_sweep_solves_about_as_many_surfaces_as_were_foretold(foretold, tmp_path):
    found = compare.sweep(ROUGH, [ROUGH.motion.speed], interval="2%", output=tmp_path, report=False)
    for name, counts in foretold.surfaces.items():
        status = found["status"].sel(solver=name)
        solved = [(status.sel(grid=grid) == "solved").sum().item() for grid in ("fine", "coarse")]
        fine, coarse = counts.values()
        assert coarse > PILOT  # a pilot alone would be foretold by anything
        for one, other in zip(solved, (fine, fine + coarse), strict=True):
            assert one / ROUGHLY < other < one * ROUGHLY


def test_surfaces_rise_as_the_square_of_what_the_grid_leaves_to_their_scatter(foretold):
    halved = forecast(ROUGH, 0.015)
    for name, counts in foretold.surfaces.items():
        left, less = (each - foretold.halved[name] for each in (0.02, 0.015))
        few, many = (list(each.values())[-1] for each in (counts, halved.surfaces[name]))
        assert many / few == pytest.approx((left / less) ** 2, rel=8 / few)  # rounded up to a task of eight


def test_an_interval_that_no_number_of_surfaces_reaches_is_told_so():
    found = forecast(replace(ROUGH, bem=BEM(points=32)), 1e-4)
    assert max(found.surfaces["BEM"].values()) == MOST_DRAWS
    in_one, in_three = str(found).split(";")[:2]
    assert "too few" in in_one
    assert "more points: half of them change" in in_three


def test_a_pilot_of_great_grids_takes_hardly_longer():
    """Costs rise by 2**2.2 from grid to grid, as those of the solver."""
    for grids in range(1, 9):
        costs = [2e-3 * 2 ** (2.2 * k) for k in range(grids)][::-1]
        draws = _affordable(costs)
        assert len(draws) >= min(grids, 2)
        solved = [*costs[grids - len(draws) :], 0.0]
        spent = sum(count * sum(solved[k : k + 2]) for k, count in enumerate(draws))
        assert spent <= LONGEST
    assert _affordable([10.0, 1.0]) == (DIFFERENCES, DIFFERENCES)


def test_strata_that_were_solved_are_taken_as_they_are_and_finer_ones_scatter_like_the_finest():
    given = answers(np.random.default_rng(0), (8, 8, 32)).expand_dims(speed=[0.1])
    given = given.assign(depth_reached=given["normal_force"])
    assert_means(pooled(_strata(given, [0, 1, 2])), pooled(given))
    finer = _strata(given, [0, 0, 1, 2])["friction_force"].values
    first, second = (finer[k] - finer[k + 1] for k in (0, 1))
    np.testing.assert_array_equal(first[np.isfinite(first)], second[np.isfinite(second)])


def assert_means(one, other):
    for name in ("friction_force", "normal_force"):
        np.testing.assert_array_equal(
            one[name].mean("seed").values, other[name].mean("seed").values.reshape(2, 1, 2)
        )


def test_an_accuracy_names_points_tolerance_and_surfaces():
    found = settings(ROUGH, 0.05)
    assert found.choice.confirmed
    assert found.choice.solver == BEM.for_accuracy(ROUGH.scene, friction=0.05).solver
    assert found.surfaces > 10
    solver = found.choice.solver
    assert f"5 % of friction in 3D: {solver.points} points and a tolerance of 0.0017" in str(found)


@pytest.mark.parametrize("scatter", [0.01, 0.1, 1.0])
@pytest.mark.parametrize("half", [0.01, 0.1, 0.5])
def test_surfaces_that_suffice_are_the_fewest(scatter, half):
    count = sufficient(scatter, half)

    def reached(surfaces):
        return surfaces > 1 and student(0.95, surfaces - 1) * scatter <= half * surfaces**0.5

    assert reached(count)
    assert not reached(count - 1)


def test_at_rest_the_depth_is_averaged_or_the_load_whichever_is_not_prescribed():
    coarse = replace(ROUGH, bem=BEM(points=32))
    for motion, mean in (Indent(load=1.0), "depth"), (Indent(depth=1e-4), "force"):
        assert forecast(replace(coarse, motion=motion), 0.1).means == (mean,)
    assert settings(replace(coarse, motion=Indent(depth=1e-4)), 0.2).quantity == "load"


def test_a_solver_of_the_fewest_points_has_no_coarser_grid():
    fewest = replace(ROUGH, bem=BEM(points=16))
    assert list(forecast(fewest, 0.1).surfaces["BEM"]) == [16]


def test_a_smooth_body_has_no_surfaces():
    smooth = replace(ROUGH, roughness=None)
    assert forecast(smooth, 0.01) == "nothing is averaged: the body has no random surfaces"
    found = settings(smooth, 0.01)
    assert found.surfaces == 0
    assert found.seconds == found.choice.result.seconds
    assert "surfaces" not in str(found)


def test_what_cannot_be_foretold_says_why():
    moving = replace(ROUGH, motion=Program(stages=(Stage(duration=1e-3, load=1.0),)))
    for told in (forecast, settings):
        assert "motion = Program" in told(moving, 0.1)


def test_a_forecast_is_a_sentence(foretold):
    said = str(foretold)
    assert said.startswith("2 % of the mean depth and friction takes in 1D 8 profiles on 1024 points, ")
    assert "; in 3D 8 surfaces on 64 points, " in said
    assert said.endswith(" s of processor time")


def test_a_plan_tells_both_where_they_are_asked_for():
    answer = CliRunner().invoke(app, ["plan", "hertz", "--interval", "10%", "--accuracy", "0.1"])
    assert answer.exit_code == 0, answer.output
    assert "interval   nothing is averaged: the body has no random surfaces" in answer.output
    assert "accuracy   10 % of depth in 3D: 128 points and a tolerance of 0.0033, which leaves " in answer.output
    silent = compare.plan("hertz")
    assert silent.interval is None
    assert silent.accuracy is None


@pytest.mark.parametrize("name", ["interval", "accuracy"])
def test_a_share_that_is_none_is_refused_by_its_name(name):
    with pytest.raises(InvalidInput, match=rf"{name} = .*: a share above 0 and below 1, as 2% or 0\.02"):
        compare.plan(SLIDING, **{name: 1})


UNITS = pint.UnitRegistry()


@pytest.mark.parametrize(
    "given",
    [
        "2%",
        " 2 % ",
        "0.02",
        0.02,
        np.float64(0.02),
        np.array(0.02),
        UNITS.Quantity(0.02, ""),
        UNITS.Quantity(2, "percent"),
        xarray.DataArray(0.02),
        xarray.DataArray(2.0, attrs={"units": "%"}),
    ],
)
def test_shares_are_taken_from_text_and_other_libraries(given):
    assert share_of("interval", given) == pytest.approx(0.02, rel=1e-15)


@pytest.mark.parametrize(
    "given", [UNITS.Quantity(0.02, "m"), np.array([0.02, 0.03]), "two", None, 0.02j, np.True_]
)
def test_what_is_no_share_is_refused(given):
    with pytest.raises(InvalidInput, match="interval = "):
        share_of("interval", given)
