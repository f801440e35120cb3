"""Numbers that follow from averages over surfaces lie in their intervals as often as stated."""

from dataclasses import dataclass
from math import inf, sqrt

import numpy as np
import pytest

from compare.statistics.intervals import Estimated, RmsMisfit
from compare.statistics.jackknife import MOST_GROUPS, Replicates, groups, resample

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


@pytest.mark.parametrize("surfaces", [20, 53, 200])
def test_surfaces_are_left_out_one_by_one_or_in_groups_equal_or_not_without_bias(surfaces):
    rng = np.random.default_rng(2)
    parts = groups(np.zeros(surfaces, int))
    assert len(parts) == MOST_GROUPS
    np.testing.assert_array_equal(np.concatenate([each.surfaces for each in parts]), np.arange(surfaces))
    squares = [
        resample(mean, Columns(rng.normal(size=(2, surfaces))))["mean"].estimated.error ** 2 for _ in range(DRAWS)
    ]
    # Each is chi square over its 19 degrees of freedom: the mean is off by sqrt(2 / 19 / DRAWS), here thrice.
    assert np.mean(squares) * surfaces == pytest.approx(1.0, abs=3 * sqrt(2 / 19 / DRAWS))


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
    for _ in range(DRAWS):
        samples, length = vectors(rng, MODES[modes], surfaces, size)
        found = size_of(samples)
        low, high = found.interval()
        truth = length / sqrt(samples.shape[1])
        kept += low <= truth <= high
        squares.append(found.square - truth**2)
        # Where there is less than scatter explains it is nil for all that is known.
        assert found.square > 0 or (found.value, low) == (0.0, 0.0) < (0.0, high)
    assert kept >= LEAST * DRAWS
    # What scatter adds is taken out: three standard errors of the mean.
    assert abs(np.mean(squares)) <= 3 * np.std(squares) / sqrt(DRAWS)
    assert size or np.mean(np.array(squares) < 0) > 0.3


def test_a_size_scales_and_forgets_the_sign():
    samples, _ = vectors(np.random.default_rng(9), MODES["three"], 5, 2.0)
    one, other = size_of(samples), size_of(-3 * samples)
    assert other.interval() == pytest.approx(3 * np.array(one.interval()), rel=1e-9)
    assert other.value == pytest.approx(3 * one.value, rel=1e-9)


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


@pytest.mark.parametrize(
    ("squares", "apart"), [((-1e-4, -4e-4), 0.01), ((0.01, 0.04), 0.1), ((0.01, np.nan), np.nan)]
)
def test_sizes_are_apart_by_what_their_squares_are_those_of_nil_too(squares, apart):
    # scatter explains both of the first, and yet one grid is not the other
    fine, coarse = (RmsMisfit(square, 1e-3, 0.0, 4.0, 9) for square in squares)
    assert fine.apart(coarse) == pytest.approx(apart, nan_ok=True)
