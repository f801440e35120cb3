"""Many surfaces on coarse grids and few on finer ones have the mean of the finest, in intervals that hold it."""

from math import sqrt

import numpy as np
import pytest
import xarray

from compare.solving.control_variates import ALIKE, controlled
from compare.statistics.intervals import student
from compare.statistics.jackknife import DrawSet, friction, mean_ratio, resample, strata_of, welch
from compare.statistics.multilevel import pooled

COUNTS = 4, 8, 60


def answers(rng, counts=COUNTS, variation=0.2, correlation=None):
    """Friction and load of surfaces that share their scatter between points, of mean 1 on the fine grid.

    correlation : correlation of a moment, among seven, with the logarithm of friction; None without moments
    """
    stratum = np.repeat(range(len(counts)), counts)
    spread = sqrt(np.log1p(variation**2))
    shared = rng.normal(size=stratum.size)
    normal = 0.8 * shared + 0.6 * rng.normal(size=(2, stratum.size))
    surface = np.exp(spread * normal - spread**2 / 2)
    force = np.exp(0.05 * shared - 0.05**2 / 2) * np.ones((len(counts), 2, 1))
    grids = [
        surface * (1 - 0.003 * k) * (1 + 0.02 * k * rng.normal(size=surface.shape)) for k in range(len(counts))
    ]
    on = np.arange(len(counts))[:, None]
    asked = ((stratum == on) | (stratum == on - 1))[:, None]
    dims = "level", "load", "surface"
    coordinates = {
        "level": ["fine", "coarse", "coarser"],
        "surface": range(stratum.size),
        "stratum": ("surface", stratum),
    }
    found = {
        "friction_force": (dims, np.where(asked, grids, np.nan)),
        "normal_force": (dims, np.where(asked, force, np.nan)),
    }
    if correlation is not None:
        moments = rng.normal(size=(*normal.shape, 7))
        moments[..., 2] = correlation * normal + sqrt(1 - correlation**2) * moments[..., 2]
        moments[..., stratum < len(counts) - 1, :] = np.nan
        found["control_variates"] = ("load", "surface", "variate"), moments
    return xarray.Dataset(found, coordinates, {"solver": "BEM"})


def test_draws_of_one_grid_are_the_sum_of_the_differences_of_all_grids():
    given = answers(np.random.default_rng(0))
    values, stratum = given["friction_force"].values, given["stratum"].values
    coarse = values[2][:, stratum == 2], (values[1] - values[2])[:, stratum == 1]
    parts = *coarse, (values[0] - values[1])[:, stratum == 0]
    found = pooled(given)["friction_force"]
    for grid, some in (("coarse", coarse), ("fine", parts)):
        here = mean_ratio(found.sel(level=grid).values, 1.0, stratum)
        np.testing.assert_allclose(here.value, sum(each.mean(axis=1) for each in some), rtol=1e-12)
        variance = sum(each.var(axis=1, ddof=1) / each.shape[1] for each in some)
        np.testing.assert_allclose(here.error, np.sqrt(variance), rtol=1e-12)


def test_draws_without_strata_stay_as_they_are():
    given = answers(np.random.default_rng(0)).drop_vars("stratum")
    assert pooled(given) is given


def test_values_are_less_what_a_regression_through_all_others_tells_of_them():
    rng = np.random.default_rng(2)
    moments = rng.normal(size=(3, 40, 7))
    values = 1 + moments[..., 0] + 0.3 * rng.normal(size=(3, 40))
    values[1, 5] = np.nan
    found = controlled(values, moments)
    for given, some, made in zip(values, moments, found, strict=True):
        known = np.flatnonzero(np.isfinite(given))
        for one in known:
            others = known[known != one]
            plane = np.linalg.lstsq(np.c_[np.ones(others.size), some[others]], given[others], rcond=None)[0]
            assert made[one] == pytest.approx(given[one] - some[one] @ plane[1:], rel=1e-9, abs=1e-9)
    assert np.flatnonzero(np.isnan(found)).tolist() == [45]


def test_moments_that_tell_nothing_change_nothing():
    rng = np.random.default_rng(3)
    values, moments = rng.normal(size=40), rng.normal(size=(40, 3))
    alone = controlled(values, moments[:, :1])
    nothing = np.stack([moments[:, 0], np.zeros(40), np.full(40, 2.5), moments[:, 0]], axis=-1)
    np.testing.assert_allclose(controlled(values, nothing), alone, rtol=0, atol=ALIKE)
    np.testing.assert_array_equal(controlled(values, moments[:, :0]), values)
    np.testing.assert_array_equal(controlled(values[:3], moments[:3]), values[:3])
    assert np.isnan(controlled(np.full(9, np.nan), moments[:9])).all()


def test_moments_leave_less_scatter_of_coarse_surfaces_alone():
    rng = np.random.default_rng(5)
    given = answers(rng, (8, 8, 200), correlation=0.85)
    plain, found = pooled(given.drop_vars("control_variates")), pooled(given)
    assert set(found.variables) == set(plain.variables)
    strata = given["stratum"].values
    for grid in ("fine", "coarse"):
        one, other = (each["friction_force"].sel(level=grid).values for each in (plain, found))
        coarse = (each[:, strata == 2].var(axis=-1) for each in (other, one))
        assert np.all(np.divide(*coarse) <= 0.5)
        about = [each - each.mean(axis=-1, keepdims=True) for each in (one, other)]
        np.testing.assert_allclose(about[0][:, strata == 0], about[1][:, strata == 0], rtol=1e-9, atol=1e-12)


def test_one_difference_alone_tells_no_interval():
    found = pooled(answers(np.random.default_rng(1), (1, 4, 9))).sel(level="fine")
    assert np.isnan(found["friction_force"]).all()


def test_leaving_surfaces_out_of_all_grids_has_the_error_of_the_mean():
    """Of a ratio of means, by groups of each stratum; the mean of its squares is that to first order."""
    rng = np.random.default_rng(4)
    squares = []
    for _ in range(100):
        given = pooled(answers(rng)).sel(level="fine")
        found = resample(lambda sample: {"": friction(sample["BEM"])}, DrawSet({"BEM": given}))[""].estimated
        ratio = mean_ratio(given["friction_force"].values, given["normal_force"].values, strata_of(given))
        np.testing.assert_allclose(found.value, ratio.value, rtol=1e-12)
        squares.append(np.square(found.error / ratio.error))
    assert np.mean(squares) == pytest.approx(1.0, abs=0.05)


def test_degrees_of_freedom_are_those_of_welch():
    strata = [0] * 4 + [1] * 8
    shares, even = welch(np.repeat([[1.0], [0.5]], [4, 8], axis=0), strata)
    assert shares == {0: 0.5, 1: 0.5}
    assert even == pytest.approx(1 / (0.25 / 3 + 0.25 / 7))
    assert welch(np.repeat([[1.0], [0.0]], [4, 8], axis=0), strata)[1] == pytest.approx(3)
    assert welch(np.zeros((12, 1)), strata)[1] == pytest.approx(10)
    assert student(0.95, even)[0] > student(0.95, 10)


def test_a_difference_of_two_models_of_unequal_numbers_of_draws_has_the_error_of_both():
    rng = np.random.default_rng(5)
    values = {"BEM": rng.normal(size=4), "MDR": 0.5 * rng.normal(size=9)}
    draws = {
        name: xarray.Dataset({"normal_force": ("surface", each)}, attrs={"solver": name})
        for name, each in values.items()
    }
    means = resample(
        lambda part: {"": part["BEM"].normal_force.mean() - part["MDR"].normal_force.mean()}, DrawSet(draws)
    )
    squares = np.array([each.var(ddof=1) / each.size for each in values.values()])
    assert means[""].estimated.error == pytest.approx(sqrt(squares.sum()), rel=1e-12)
    assert means[""].estimated.dof == pytest.approx(squares.sum() ** 2 / np.sum(squares**2 / [3, 8]), rel=1e-12)
