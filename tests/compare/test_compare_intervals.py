"""Intervals of means hold the truth as often as stated, of skewed draws too; sizes have no negative end."""

from dataclasses import replace
from math import nan, sqrt

import numpy as np
import pytest
import xarray

from compare.solving.curve import FINE
from compare.statistics.frictioncurves import SimulatedCurves
from compare.statistics.intervals import Estimated, student
from compare.statistics.jackknife import DrawSet, compared, groups, mean_ratio, resample
from compare.statistics.means import interval

DRAWS = 10_000


def least(rate, draws=DRAWS):
    """Least share of a rate: four standard deviations of a binomial count."""
    return rate - 4 * sqrt(rate * (1 - rate) / draws)


def drawn(kind, variation, count, seed=1, draws=DRAWS):
    """Samples (draws, count) of mean one and a coefficient of variation."""
    normal, width = np.random.default_rng([seed, count]).normal(size=(draws, count)), np.log1p(variation**2) ** 0.5
    skewed = np.exp(width * normal - width**2 / 2)
    return {"normal": 1 + variation * normal, "lognormal": skewed, "mirrored": 2 - skewed}[kind]


def held(ends, truth=1.0):
    low, high = ends
    return np.mean((low <= truth) & (truth <= high))


@pytest.mark.parametrize("kind", ["normal", "lognormal", "mirrored"])
@pytest.mark.parametrize(
    ("variation", "counts", "rate"), [(0.2, (10, 20), 0.93), (0.5, (10, 20, 40), 0.93), (1.0, (20, 40), 0.92)]
)
def test_a_mean_of_skewed_draws_is_in_its_interval_as_often_as_stated(kind, variation, counts, rate):
    for count in counts:
        assert held(mean_ratio(drawn(kind, variation, count)).interval()) >= least(rate)


@pytest.mark.parametrize("count", [2, 3, 4, 5, 8, 10, 20, 50])
def test_the_interval_of_normal_draws_is_within_a_tenth_of_students(count):
    found = mean_ratio(drawn("normal", 0.5, count))
    low, high = found.interval()
    over = (high - low) / (2 * found.error * student(0.95, count - 1))
    assert 1 <= over.mean() + 1e-9 <= 1.1
    assert np.quantile(over, 0.95) <= 1.13
    assert held((low, high)) == pytest.approx(0.95, abs=least(0.95) - 0.95 + 0.02)


def test_draws_that_lie_alike_to_both_sides_have_students_interval():
    found = mean_ratio(np.array([1.0, 2.0, 3.0, nan]))
    # 4.30265 standard errors at two degrees of freedom, from a table of Student's distribution
    assert found.interval() == pytest.approx((2 - 4.30265 / sqrt(3), 2 + 4.30265 / sqrt(3)), rel=1e-5)


def test_mirrored_draws_have_the_mirrored_interval_and_the_longer_side_is_that_of_the_long_tail():
    low, high = mean_ratio(drawn("lognormal", 1.0, 12)).interval()
    lower, higher = mean_ratio(drawn("mirrored", 1.0, 12)).interval()
    np.testing.assert_allclose([2 - higher, 2 - lower], [low, high], rtol=1e-9)
    found = mean_ratio(np.array([1.0, 1.1, 1.2, 4.0]))
    low, high = found.interval()
    assert high - found.value > 1.3 * (found.value - low) > 0


@pytest.mark.parametrize("count", [20, 100])
def test_what_leaving_surfaces_out_gives_holds_as_often(count):
    """Ratio of two means of skewed draws, that of its logarithm, and a power of it; a hundred in groups."""

    class Draws:
        def __init__(self, above, below):
            self.above, self.below = above, below
            self.groups = groups(np.zeros(count, int))

        def without(self, group):
            return Draws(*(np.delete(each, group.surfaces, axis=1) for each in (self.above, self.below)))

    def numbers(part):
        ratio = part.above.mean(axis=1) / part.below.mean(axis=1)
        return {"ratio": ratio, "logarithm": np.log(ratio), "root": np.sqrt(ratio)}

    found = resample(numbers, Draws(drawn("lognormal", 1.0, count, 3), drawn("normal", 0.1, count, 4)))
    for name, each in found.items():
        assert held(each.estimated.interval(), 0.0 if name == "logarithm" else 1.0) >= least(0.92), name


def test_the_difference_of_two_independent_means_holds_as_often():
    one, other = mean_ratio(drawn("lognormal", 1.0, 20, 5)), mean_ratio(drawn("normal", 0.5, 8, 6))
    assert held(one.less(other).interval(), 0.0) >= least(0.92)
    back = other.less(one)
    np.testing.assert_allclose(
        np.sort(np.negative(back.interval()), axis=0), one.less(other).interval(), rtol=1e-9
    )


@pytest.mark.parametrize(("variation", "counts"), [(0.3, (3, 5, 10)), (1.0, (5, 10, 20, 50))])
def test_a_size_has_no_negative_end_and_is_in_its_interval_as_often_as_stated(variation, counts):
    for count in counts:
        found = mean_ratio(drawn("lognormal", variation, count))
        _, low, high = replace(found, size=True).ends
        assert (low > 0).all()
        assert held((low, high)) >= least(0.92)
    # which a mean that may be negative has at few draws
    assert (mean_ratio(drawn("lognormal", 1.0, 3)).interval()[0] < 0).any()


def test_a_size_of_nothing_or_negative_by_chance_is_nil_within_the_interval_of_what_scatters():
    numbers, errors = np.array([-0.018, -0.3, 0.02, 0.0, 1.0]), np.array([0.02, 0.02, 0.02, 0.0, nan])
    value, low, high = Estimated(numbers, errors, 7, size=True).ends
    assert value.tolist() == [0.0, 0.0, 0.02, 0.0, 1.0]
    assert low[[0, 1, 3]].tolist() == [0.0, 0.0, 0.0]
    assert high[[0, 3]] == pytest.approx([-0.018 + 0.02 * student(0.95, 7), 0.0])
    assert ((low <= value) & (value <= high))[:4].all()
    assert np.isnan([low[4], high[4]]).all()


def test_every_place_gives_the_same_interval_of_the_same_draws():
    values = drawn("lognormal", 1.0, 12)[0]
    expected = mean_ratio(values).interval()
    forces = {
        name: (("speed", "load", "surface"), values[None, None]) for name in ("normal_force", "friction_force")
    }
    grids = xarray.Dataset(forces, {"speed": [1.0], "load": [1.0]}).expand_dims(level=[FINE])
    sample = DrawSet({"a": grids.sel(level=FINE)})
    told = compared(lambda sample: sample["a"]["normal_force"].mean("surface").values, sample, None)
    curves = SimulatedCurves(np.ones(1), np.ones((1, 1, 12)), values[None, None])
    friction = curves.replicates(1.0, values.mean() * curves.deviations()[:, 0]).estimated.interval()
    for low, high in (
        told.at((0, 0)).interval(),
        np.array(friction) + values.mean() - 1,
    ):
        assert (low, high) == pytest.approx(expected, rel=1e-9)
    # A Dataset on one grid has no error of the grid, and so no end.
    assert np.isnan(interval(grids, "normal_force").ends[1]).all()
