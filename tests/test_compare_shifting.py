"""Curves of friction on the same random surfaces: the shifts that they need are found, and no others."""

from dataclasses import replace
from math import sqrt

import numpy as np
import pytest

from compare.shifting import Samples, misfit_at, shift
from mdr1d.equations import interpolation

SPEEDS = 0.1 * 2.0 ** np.arange(5)
LOADS = np.geomspace(0.1, 10.0, 8)
CENTRED = np.log(SPEEDS) - np.log(SPEEDS).mean()
POWER = -1.5
# What the freest polynomial leaves of Eq. 19 over these loads, and the shifts with it.
FOLLOWED = 2e-3
# Of ln mu: what counts as one curve.
TOLERANCE = 0.03


def knee(x):
    """Eq. 19 for a cone at 0.1 m/s."""
    return np.log(interpolation(0.4 * np.exp(-x * 2 / 3)))


def cubic(x):
    """Within reach of the polynomial."""
    return -0.3 * x - 0.03 * x**2 + 0.001 * x**3


def line(x):
    return -0.3 * x


def laws(law, vertical=0.0, bend=0.0, power=POWER):
    """ln mu (speeds, loads) on curves shifted by power, raised by vertical, and tilted by bend, times ln v."""
    logs, x = np.log(SPEEDS)[:, None], np.log(LOADS)
    return law(x + power * logs) + vertical * logs + bend * (logs - logs[len(logs) // 2]) * x


def drawn(rng, exact, surfaces, scatter=0.05, own=0.005, loads=0.0):
    """Samples in which each surface multiplies friction by a smooth function of speed and load of this rms.

    own : scatter of each point by itself ; loads : scatter of ln load, one factor a surface
    """
    u, w = (np.linspace(-1, 1, count) for count in exact.shape)
    smooth = np.array(
        [np.ones_like(np.outer(u, w)), np.outer(u, 0 * w + 1), np.outer(0 * u + 1, w), np.outer(u, w)]
    )
    factor = 1 + scatter * np.tensordot(smooth, rng.normal(size=(4, surfaces)), axes=(0, 0)) / sqrt(16 / 9)
    factor = factor + own * rng.normal(size=factor.shape)
    load = np.broadcast_to(LOADS[:, None] * np.exp(loads * rng.normal(size=surfaces)), factor.shape)
    return Samples(SPEEDS, load, np.exp(exact)[..., None] * factor * load)


def smooth(exact):
    load = np.broadcast_to(LOADS, exact.shape)
    return Samples(SPEEDS, load, np.exp(exact) * load)


def has(interval, value, rounding=1e-9):
    low, high = interval
    return low - rounding <= value <= high + rounding


def test_a_horizontal_shift_of_eq_19_is_recovered_and_nothing_else():
    found = shift(smooth(laws(knee)))
    assert found.separable
    assert found.horizontal.exponent.value == pytest.approx(POWER, abs=5 * FOLLOWED)
    assert found.horizontal.misfit.value < FOLLOWED
    assert found.none.misfit.value > 0.3
    assert found.vertical.misfit.value > 0.1
    assert found.both.raised.value < 5 * FOLLOWED
    assert (found.collapses(TOLERANCE), found.level(TOLERANCE)) == ("holds", "holds")
    assert misfit_at(found, POWER * np.log(SPEEDS)).verdict(TOLERANCE) == "holds"


def test_a_vertical_shift_beside_it_is_caught_and_measured():
    found = shift(smooth(laws(knee, vertical=0.1)))
    assert found.both.vertical_exponent.value == pytest.approx(-0.1, abs=5 * FOLLOWED)
    assert found.both.exponent.value == pytest.approx(POWER, abs=10 * FOLLOWED)
    assert found.both.raised.value == pytest.approx(0.1 * CENTRED.std(), abs=5 * FOLLOWED)
    assert found.level(TOLERANCE) == "fails"
    assert misfit_at(found, POWER * np.log(SPEEDS)).verdict(TOLERANCE) == "fails"


def test_shifts_within_reach_of_the_polynomial_are_recovered_to_rounding():
    found = shift(smooth(laws(cubic, vertical=0.1)))
    assert found.both.horizontal.value == pytest.approx(POWER * np.log(SPEEDS / SPEEDS[2]), abs=1e-6)
    assert found.both.vertical.value == pytest.approx(-0.1 * np.log(SPEEDS / SPEEDS[2]), abs=1e-6)
    assert found.both.misfit.value < 1e-8
    assert found.degree == 4


def test_the_common_curve_is_that_of_the_middle_speed():
    found = shift(smooth(laws(cubic, vertical=0.1)))
    for each, lift, along in zip(
        found.curves, found.both.vertical.value, found.both.horizontal.value, strict=True
    ):
        assert found.both.curve(each.log_load + along) == pytest.approx(each.log_friction + lift, abs=1e-7)


def test_straight_lines_leave_both_shifts_undecided():
    for samples in (smooth(laws(line)), drawn(np.random.default_rng(0), laws(line), 10)):
        found = shift(samples)
        assert not found.separable
        assert found.both.reason is not None
        assert np.isnan(found.both.exponent.value)
        assert (found.collapses(1.0), found.level(1.0)) == ("undecided", "undecided")


def test_curves_that_share_no_stretch_can_fail_but_not_hold():
    found = shift(smooth(laws(cubic, power=-9.0)))
    assert found.horizontal.reason is not None
    assert np.isnan(found.horizontal.exponent.value)
    missed = found.horizontal.misfit.value
    assert missed == pytest.approx(found.horizontal.rms, rel=1e-9)
    assert (found.collapses(2 * missed), found.collapses(missed / 2)) == ("undecided", "fails")
    assert np.isnan(misfit_at(found, -9.0 * np.log(SPEEDS)).value)


def test_identical_curves_need_no_shift():
    found = shift(smooth(laws(cubic, power=0.0)))
    assert found.horizontal.horizontal.value == pytest.approx(np.zeros(5), abs=1e-8)
    assert found.none.misfit.value < 1e-8


def test_scatter_that_is_small_frees_the_curve_and_large_scatter_does_not():
    rng = np.random.default_rng(1)
    assert shift(drawn(rng, laws(knee), 10, scatter=0.01, own=0.001)).degree > 4
    assert shift(drawn(rng, laws(knee), 3, scatter=0.2, own=0.05)).degree == 4


def numbers(found):
    each = found.both
    return np.array(
        [each.exponent.value, each.exponent.error, each.vertical_exponent.value, *each.misfit.interval(), each.rms]
    )


# The fit settles to this, relative to its own error.
SETTLED = 1e-4


def test_units_of_load_friction_and_speed_and_the_order_of_surfaces_change_nothing():
    given = drawn(np.random.default_rng(2), laws(knee), 6, loads=0.1)
    expected = numbers(shift(given))
    for other in (
        Samples(3 * given.speeds, given.load, given.friction_force),
        Samples(given.speeds, 5 * given.load, 5 * given.friction_force),
        Samples(given.speeds, given.load, 7 * given.friction_force),
        Samples(given.speeds, given.load[..., ::-1], given.friction_force[..., ::-1]),
        Samples(given.speeds[::-1], given.load[::-1], given.friction_force[::-1]),
    ):
        assert numbers(shift(other)) == pytest.approx(expected, rel=SETTLED, abs=1e-6)


def test_every_surface_doubled_changes_no_value_and_narrows_errors():
    given = drawn(np.random.default_rng(3), laws(cubic), 6)
    twice = replace(given, load=np.tile(given.load, 2), friction_force=np.tile(given.friction_force, 2))
    one, two = shift(given).horizontal, shift(twice).horizontal
    assert two.exponent.value == pytest.approx(one.exponent.value, rel=1e-9)
    # (n - 1) / (2 n - 1) of the variance to first order.
    assert two.exponent.error / one.exponent.error == pytest.approx(sqrt(5 / 11), rel=0.05)


def test_errors_of_the_curves_are_standard_errors_of_the_ratio():
    given = drawn(np.random.default_rng(4), laws(knee), 8)
    mu = given.friction_force / given.load
    expected = mu.std(axis=2, ddof=1) / sqrt(8) / mu.mean(axis=2)
    found = shift(given)
    np.testing.assert_allclose([curve.error for curve in found.curves], expected, rtol=1e-9)


def test_points_and_surfaces_that_failed_are_left_out_and_counted():
    given = drawn(np.random.default_rng(5), laws(knee), 8)
    friction = given.friction_force.copy()
    friction[1, 2, :5] = np.nan
    friction[3, 3, 6] = np.nan
    friction[4, 7] = 0.0
    found = shift(replace(given, friction_force=friction))
    assert (found.points_left_out, found.surfaces_left_out) == (2, 1)
    assert [curve.log_load.size for curve in found.curves] == [8, 7, 8, 8, 7]
    assert np.isfinite(numbers(found)).all()


def test_a_point_without_friction_but_for_one_surface_has_no_logarithm_and_goes():
    given = drawn(np.random.default_rng(6), laws(knee), 6)
    friction = given.friction_force.copy()
    friction[0, 0, 1:] = 0.0
    assert shift(replace(given, friction_force=friction)).points_left_out == 1


def test_one_surface_gives_values_without_errors_and_two_give_wide_ones():
    given = drawn(np.random.default_rng(7), laws(knee), 2)
    two = shift(given)
    assert np.isfinite(two.horizontal.exponent.error)
    assert two.horizontal.exponent.freedom == 1
    one = shift(given.without(np.array([1])))
    assert np.isfinite(one.horizontal.exponent.value)
    assert np.isnan(one.horizontal.exponent.error)
    assert np.isnan(one.horizontal.misfit.value)
    assert one.horizontal.rms > 0
    assert (one.collapses(1.0), one.level(1.0)) == ("undecided", "undecided")


def test_two_speeds_or_three_loads_are_enough_and_fewer_points_are_refused():
    given = drawn(np.random.default_rng(8), laws(cubic), 5)
    two = shift(Samples(given.speeds[:2], given.load[:2], given.friction_force[:2]))
    assert has(two.horizontal.exponent.interval(), POWER)
    three = shift(Samples(given.speeds, given.load[:, ::3], given.friction_force[:, ::3]))
    assert has(three.horizontal.exponent.interval(), POWER)
    with pytest.raises(ValueError, match="too few points"):
        shift(Samples(given.speeds[:2], given.load[:2, ::3], given.friction_force[:2, ::3]))
    with pytest.raises(ValueError, match="1 speeds"):
        shift(Samples(given.speeds[:1], given.load[:1], given.friction_force[:1]))
    with pytest.raises(ValueError, match="no surface"):
        shift(replace(given, friction_force=np.full_like(given.friction_force, np.nan)))


# True size of the misfit once horizontal shifts are best.
TILTED = shift(smooth(laws(cubic, bend=0.1))).horizontal.misfit.value


def rates(law, repeats, surfaces, scatter, seed, vertical=0.0, bend=0.0):
    """Of repeats: how often each truth is in its interval, and how often a claim is rejected."""
    rng, counts = (
        np.random.default_rng(seed),
        dict.fromkeys(("misfit", "exponent", "predicted", "needed", "raised", "fails"), 0),
    )
    exact = laws(law, vertical=vertical, bend=bend)
    truth = TILTED if bend else 0.0
    for _ in range(repeats):
        found = shift(drawn(rng, exact, surfaces, scatter))
        counts["misfit"] += has(found.horizontal.misfit.interval(), truth, FOLLOWED)
        counts["exponent"] += has(found.horizontal.exponent.interval(), POWER, FOLLOWED)
        counts["predicted"] += misfit_at(found, POWER * np.log(SPEEDS)).interval()[0] <= FOLLOWED
        counts["needed"] += found.horizontal.mended.verdict(0.0) == "fails"
        counts["raised"] += found.level(0.0) == "fails"
        counts["fails"] += found.collapses(TOLERANCE) == "fails"
    return counts


def least(repeats, rate=0.93):
    """Of an interval of 95 %: what first-order theory may lose, 2 %, and three deviations of as many repeats."""
    return rate * repeats - 3 * sqrt(rate * (1 - rate) * repeats)


def check_that_the_right_law_is_kept(law, repeats, surfaces, scatter):
    found = rates(law, repeats, surfaces, scatter, seed=surfaces)
    for name in ("misfit", "exponent", "predicted"):
        assert found[name] >= least(repeats), (name, found)
    for name in ("needed", "raised", "fails"):
        assert found[name] <= repeats - least(repeats), (name, found)


def check_that_wrong_laws_are_rejected(repeats, surfaces):
    raised = rates(knee, repeats, surfaces, scatter=0.02, seed=1, vertical=0.1)
    assert raised["predicted"] <= 0.05 * repeats
    assert raised["needed"] >= 0.8 * repeats
    tilted = rates(cubic, repeats, surfaces, scatter=0.05, seed=2, bend=0.1)
    assert tilted["misfit"] >= least(repeats)
    assert tilted["predicted"] <= 0.05 * repeats
    assert tilted["fails"] >= 0.8 * repeats


@pytest.mark.slow
def test_the_right_law_is_kept_as_often_as_stated_however_points_share_their_scatter():
    check_that_the_right_law_is_kept(cubic, 200, 10, scatter=0.1)


def test_wrong_laws_are_rejected():
    check_that_wrong_laws_are_rejected(20, 10)


@pytest.mark.slow
@pytest.mark.parametrize("law", [cubic, knee])
@pytest.mark.parametrize("scatter", [0.05, 0.2])
@pytest.mark.parametrize("surfaces", [3, 10])
def test_the_right_law_is_kept_in_thousands_of_repeats(law, scatter, surfaces):
    check_that_the_right_law_is_kept(law, 2000, surfaces, scatter)


@pytest.mark.slow
def test_wrong_laws_are_rejected_in_hundreds_of_repeats():
    check_that_wrong_laws_are_rejected(500, 10)
