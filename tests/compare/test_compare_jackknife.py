"""Numbers that follow from averages over surfaces lie in their intervals as often as stated."""

from dataclasses import dataclass
from math import inf, sqrt

import numpy as np
import pytest

from compare.statistics.intervals import Estimated, RmsMisfit
from compare.statistics.jackknife import MOST_GROUPS, Replicates, groups, mean_ratio, resample

DRAWS = 250
# Least coverage of an interval of 95 %: 2 % lost to first-order theory, and three deviations of as many draws.
LEAST = 0.93 - 3 * sqrt(0.93 * 0.07 / DRAWS)


@dataclass(frozen=True)
class Columns:
    """Two quantities on the same surfaces (2, surfaces)."""

    values: np.ndarray

    @property
    def groups(self):
        return groups(np.zeros(self.values.shape[1], int))

    def without(self, group):
        return Columns(np.delete(self.values, group.surfaces, axis=1))


def mean(part):
    return {"mean": part.values[0].mean()}


def ratio(part):
    above, below = part.values.mean(axis=1)
    return {"ratio": above / below}


def scattered(rng, surfaces):
    """Two correlated positive quantities whose means are in the ratio 2."""
    shared, own = rng.normal(size=surfaces), rng.normal(size=(2, surfaces))
    logs = 0.2 * shared + 0.15 * own
    return Columns(np.array([[2.0], [1.0]]) * np.exp(logs))


def test_the_error_of_a_mean_is_its_standard_error():
    sample = scattered(np.random.default_rng(0), 7)
    found = resample(mean, sample)["mean"].estimated
    first = sample.values[0]
    assert found.error == pytest.approx(first.std(ddof=1) / sqrt(7), rel=1e-12)
    assert found.dof == 6
    assert mean_ratio(np.append(first, np.nan)).error == pytest.approx(found.error, rel=1e-12)


@pytest.mark.parametrize("surfaces", [20, 53, 200])
def test_many_surfaces_are_left_out_in_groups_equal_or_not_without_bias(surfaces):
    rng = np.random.default_rng(2)
    parts = groups(np.zeros(surfaces, int))
    assert len(parts) == MOST_GROUPS
    np.testing.assert_array_equal(np.concatenate([each.surfaces for each in parts]), np.arange(surfaces))
    squares = [
        resample(mean, Columns(rng.normal(size=(2, surfaces))))["mean"].estimated.error ** 2 for _ in range(DRAWS)
    ]
    # Each is chi square over its 19 degrees of freedom: the mean is off by sqrt(2 / 19 / DRAWS), here thrice.
    assert np.mean(squares) * surfaces == pytest.approx(1.0, abs=3 * sqrt(2 / 19 / DRAWS))


def test_one_surface_gives_a_value_and_no_error():
    found = resample(ratio, scattered(np.random.default_rng(4), 1))["ratio"]
    assert np.isfinite(found.estimated.value)
    assert np.isnan(found.estimated.error)
    assert np.all(np.isnan(found.estimated.interval()))
    assert np.isnan(found.rms.value)
    assert np.all(np.isnan(found.rms.interval()))


def test_what_knows_no_surface_is_exact():
    assert Estimated(0.7).interval() == (0.7, 0.7)
    found = Replicates.first_order(np.array([3.0, 4.0]), np.empty((0, 2)))
    assert found.estimated.dof == inf
    np.testing.assert_array_equal(found.estimated.error, 0.0)
    assert found.rms.interval() == pytest.approx((sqrt(12.5), sqrt(12.5)), rel=1e-15)


def test_a_statistic_that_fails_without_a_surface_has_no_error():
    def fragile(part):
        return {"": part.values[0].mean() if 3.0 in part.values else np.nan}

    found = resample(fragile, Columns(np.array([[1.0, 3.0, 2.0], [1.0, 1.0, 1.0]])))[""]
    assert np.isnan(found.estimated.error)
    assert np.isnan(found.rms.value)


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
    for _ in range(DRAWS):
        samples, length = vectors(rng, MODES[modes], surfaces, size)
        found = size_of(samples)
        low, high = found.interval()
        truth = length / sqrt(samples.shape[1])
        kept += low <= truth <= high
        squares.append(found.square - truth**2)
    assert kept >= LEAST * DRAWS
    # What scatter adds is taken out: three standard errors of the mean.
    assert abs(np.mean(squares)) <= 3 * np.std(squares) / sqrt(DRAWS)


def test_a_size_scales_and_forgets_the_sign():
    samples, _ = vectors(np.random.default_rng(9), MODES["three"], 5, 2.0)
    one, other = size_of(samples), size_of(-3 * samples)
    assert other.interval() == pytest.approx(3 * np.array(one.interval()), rel=1e-9)
    assert other.value == pytest.approx(3 * one.value, rel=1e-9)


def test_a_size_is_nil_for_all_that_is_known_where_there_is_less_than_the_scatter_explains():
    rng = np.random.default_rng(12)
    seen = []
    for _ in range(DRAWS):
        samples, _ = vectors(rng, MODES["thirty"], 10, 0.0)
        found = size_of(samples)
        seen.append(found.square)
        if found.square < 0:
            assert (found.value, found.interval()[0]) == (0.0, 0.0)
            assert found.interval()[1] > 0
    assert np.mean(np.array(seen) < 0) > 0.3


@pytest.mark.parametrize("dof", [4, 40])
def test_a_misfit_of_points_with_one_pooled_scatter_is_in_its_interval_as_often_as_stated(dof):
    rng, truth = np.random.default_rng(13), np.array([0.5, 0.0, 0.0, -0.5] * 5)
    kept = dict.fromkeys((True, False), 0)
    for _ in range(DRAWS):
        scatter = 0.2 * sqrt(rng.chisquare(dof) / dof)
        value = truth + 0.2 * rng.normal(size=truth.size)
        for right in kept:
            error = scatter * (1.0 if right else 0.5)
            low, high = Replicates(value, error * np.eye(truth.size), dof).rms.interval()
            kept[right] += low <= sqrt(0.125) <= high
    assert kept[True] >= LEAST * DRAWS
    assert kept[False] < LEAST * DRAWS


def test_sizes_of_nil_are_apart_by_what_their_squares_are():
    # scatter explains both, and yet one grid is not the other
    fine, coarse = (RmsMisfit(square, 1e-3, 0.0, 4.0, 9) for square in (-1e-4, -4e-4))
    assert fine.value == coarse.value == 0
    assert fine.apart(coarse) == pytest.approx(0.01)
    large, larger = (RmsMisfit(square, 1e-3, 0.0, 4.0, 9) for square in (0.01, 0.04))
    assert large.apart(larger) == pytest.approx(larger.value - large.value)
    assert np.isnan(large.apart(RmsMisfit()))
    assert Estimated(1.0, 0.1, 9).apart(Estimated(3.0, 0.5, 9)) == 2.0
