"""Intervals of means hold the truth as often as stated, of skewed draws too; sizes have no negative end."""

from dataclasses import dataclass, replace
from math import inf, nan, sqrt

import numpy as np
import pytest
import xarray

from compare.solving.curve import FINE
from compare.statistics.frictioncurves import SimulatedCurves
from compare.statistics.intervals import Estimated, RmsMisfit, student
from compare.statistics.jackknife import (
    MOST_GROUPS,
    DrawSet,
    Replicates,
    compared,
    groups,
    left_out,
    mean_ratio,
    resample,
)
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


@dataclass(frozen=True)
class Columns:
    """Quantities on the same surfaces (..., surfaces)."""

    values: np.ndarray

    @property
    def groups(self):
        return groups(np.zeros(self.values.shape[-1], int))

    def without(self, group):
        return Columns(np.delete(self.values, group.surfaces, axis=-1))


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


@pytest.mark.parametrize("count", [20, 100])
def test_what_leaving_surfaces_out_gives_holds_as_often(count):
    """Ratio of two means of skewed draws, its logarithm, and a power of it; a hundred in groups."""

    def numbers(part):
        ratio = np.divide(*part.values.mean(axis=-1))
        return {"ratio": ratio, "logarithm": np.log(ratio), "root": np.sqrt(ratio)}

    draws = np.stack([drawn("lognormal", 1.0, count, 3), drawn("normal", 0.1, count, 4)])
    found = resample(numbers, Columns(draws))
    for name, each in found.items():
        assert held(each.estimated.interval(), 0.0 if name == "logarithm" else 1.0) >= least(0.92), name


def test_the_difference_of_two_independent_means_holds_as_often():
    one, other = mean_ratio(drawn("lognormal", 1.0, 20, 5)), mean_ratio(drawn("normal", 0.5, 8, 6))
    assert held(one.less(other).interval(), 0.0) >= least(0.92)


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
    force = compared(lambda sample: sample["a"]["normal_force"].mean("surface").values, sample, None)
    curves = SimulatedCurves(np.ones(1), np.ones((1, 1, 12)), values[None, None])
    friction = curves.replicates(1.0, values.mean() * curves.deviations()[:, 0]).estimated.interval()
    one_out = Replicates.without_one(values.mean(), left_out(values)).estimated
    for low, high in (force.at((0, 0)).interval(), np.array(friction) + values.mean() - 1, one_out.interval()):
        assert (low, high) == pytest.approx(expected, rel=1e-9)
    # A Dataset on one grid has no error of the grid, and so no end.
    assert np.isnan(interval(grids, "normal_force").ends[1]).all()


# By leaving surfaces out, and of sizes of several numbers.

REPEATS = 250
# Least coverage of an interval of 95 %: 2 % lost to first-order theory, and three deviations of as many draws.
LEAST = 0.93 - 3 * sqrt(0.93 * 0.07 / REPEATS)


def first(part):
    return {"mean": part.values[0].mean()}


@pytest.mark.parametrize("surfaces", [20, 53, 200])
def test_surfaces_are_left_out_one_by_one_or_in_groups_equal_or_not_without_bias(surfaces):
    rng = np.random.default_rng(2)
    parts = groups(np.zeros(surfaces, int))
    assert len(parts) == MOST_GROUPS
    np.testing.assert_array_equal(np.concatenate([each.surfaces for each in parts]), np.arange(surfaces))
    squares = [
        resample(first, Columns(rng.normal(size=(2, surfaces))))["mean"].estimated.error ** 2
        for _ in range(REPEATS)
    ]
    # Each is chi square over its 19 degrees of freedom: the mean is off by sqrt(2 / 19 / REPEATS), here thrice.
    assert np.mean(squares) * surfaces == pytest.approx(1.0, abs=3 * sqrt(2 / 19 / REPEATS))


@pytest.mark.parametrize("values", [[[1.0], [1.0]], [[1.0, 3.0, 2.0], [1.0, 1.0, 1.0]]], ids=["one", "fragile"])
def test_one_surface_or_a_statistic_that_fails_without_one_has_a_value_and_no_error(values):
    found = resample(
        lambda part: {"": np.mean(part.values[0]) if 3.0 in part.values or values[0] == [1.0] else np.nan},
        Columns(np.array(values)),
    )[""]
    assert np.isfinite(found.estimated.value)
    assert np.isnan(
        [found.estimated.error, *found.estimated.interval(), found.rms.value, *found.rms.interval()]
    ).all()


def test_what_knows_no_surface_is_exact():
    assert Estimated(0.7).interval() == (0.7, 0.7)
    found = Replicates.first_order(np.array([3.0, 4.0]), np.empty((0, 2)))
    assert (found.estimated.dof, *found.estimated.error) == (inf, 0.0, 0.0)
    assert found.rms.interval() == pytest.approx((sqrt(12.5), sqrt(12.5)), rel=1e-15)


# Standard deviations of independent components of the scatter: one, a few alike, ever smaller ones, many.
MODES = {
    "one": [1.0, 0.0, 0.0],
    "three": [1.0, 1.0, 1.0, 0.0, 0.0],
    "falling": [*0.7 ** np.arange(8), 0.0, 0.0],
    "thirty": [1.0] * 30,
}


def vectors(rng, modes, surfaces, size):
    """A vector as long as size standard errors of it, along the first mode, on each surface (surfaces, N)."""
    modes = np.array(modes)
    length = size * np.linalg.norm(modes) / sqrt(surfaces)
    return length * np.eye(modes.size)[0] + modes * rng.normal(size=(surfaces, modes.size)), length


def size_of(samples, scatter=1.0):
    """scatter : factor that its deviations are wrong by."""
    middle = samples.mean(axis=0)
    return Replicates.first_order(middle, scatter * (samples - middle)).rms


@pytest.mark.parametrize("surfaces", [3, 10])
@pytest.mark.parametrize("size", [0.0, 3.0, 20.0])
@pytest.mark.parametrize("modes", MODES)
def test_a_size_is_in_its_interval_as_often_as_stated(modes, size, surfaces):
    rng, kept = np.random.default_rng(11), 0
    squares = []
    for _ in range(REPEATS):
        samples, length = vectors(rng, MODES[modes], surfaces, size)
        found = size_of(samples)
        low, high = found.interval()
        truth = length / sqrt(samples.shape[1])
        kept += low <= truth <= high
        squares.append(found.square - truth**2)
        # A square that is less than scatter explains is zero as far as is known.
        assert found.square > 0 or (found.value, low) == (0.0, 0.0) < (0.0, high)
    assert kept >= LEAST * REPEATS
    # What scatter adds is taken out: three standard errors of the mean.
    assert abs(np.mean(squares)) <= 3 * np.std(squares) / sqrt(REPEATS)
    assert size or np.mean(np.array(squares) < 0) > 0.3


@pytest.mark.parametrize("dof", [4, 40])
def test_a_misfit_of_points_with_one_pooled_scatter_is_in_its_interval_as_often_as_stated(dof):
    rng, truth, kept = np.random.default_rng(13), np.array([0.5, 0.0, 0.0, -0.5] * 5), 0
    for _ in range(REPEATS):
        scatter = 0.2 * sqrt(rng.chisquare(dof) / dof)
        value = truth + 0.2 * rng.normal(size=truth.size)
        low, high = Replicates(value, scatter * np.eye(truth.size), dof).rms.interval()
        kept += low <= sqrt(0.125) <= high
    assert kept >= LEAST * REPEATS


@pytest.mark.parametrize(
    ("squares", "apart"), [((-1e-4, -4e-4), 0.01), ((0.01, 0.04), 0.1), ((0.01, np.nan), np.nan)]
)
def test_sizes_are_apart_by_what_their_squares_are_those_of_nil_too(squares, apart):
    # scatter explains both of the first, and yet one grid is not the other
    fine, coarse = (RmsMisfit(square, 1e-3, 0.0, 4.0, 9) for square in squares)
    assert fine.apart(coarse) == pytest.approx(apart, nan_ok=True)
