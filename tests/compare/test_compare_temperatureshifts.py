"""Repeats within a tolerance, and shifts from temperature to temperature: what was planted is found."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from compare.studies.mastercurve.measuredcurves import MeasuredCurves, curves_of, isotherms, pooled
from compare.studies.mastercurve.temperatureshifts import POWERS, found

C1, C2, REFERENCE = 8.86, 101.6, 293.15
KELVINS = np.array([273.15, 283.15, 293.15, 303.15, 313.15])
TOLERANCE = 0.05


def wlf(kelvins):
    above = np.asarray(kelvins) - REFERENCE
    return -np.log(10) * C1 * above / (C2 + above)


def knee(x):
    return -0.6 * np.log1p(3 * np.exp(x))


def bent(x):
    """Within reach of the polynomial."""
    return -0.3 * x - 0.03 * x**2


def measured(
    law=knee, shift=wlf, noise=0.02, jitter=0.003, repeats=3, kelvins=KELVINS, seed=0, speeds=(1e-3, 0.1)
):
    """Friction, load, speed and temperature: Q(F (v a_T)^-1/2), a row a measurement."""
    rng = np.random.default_rng(seed)
    grid = np.meshgrid(kelvins, np.geomspace(*speeds, 5), np.geomspace(1, 30, 4), range(repeats), indexing="ij")
    warm, v, load = (each.ravel() for each in grid[:3])
    v, load = (each * (1 + jitter * rng.normal(size=each.size)) for each in (v, load))
    friction = np.exp(law(np.log(load) - 0.5 * (np.log(v / 0.01) + shift(warm))))
    return friction * (1 + noise * rng.normal(size=friction.size)), load, v, warm


def shifts(*columns):
    points = pooled(*columns, TOLERANCE)
    return found(isotherms(points), points.loads, points.dof)


@given(
    st.lists(st.floats(1e-3, 1e3), min_size=1, max_size=60),
    st.sampled_from([0.0, 1e-3, 0.05, 0.5]),
    st.integers(0, 5),
)
@settings(deadline=None, max_examples=60)
def test_loads_that_are_one_lie_within_the_tolerance_and_each_measurement_is_in_one_point(loads, tolerance, more):
    loads = np.array(loads + loads[:more])
    points = pooled(np.ones(loads.size), loads, np.ones(loads.size), None, tolerance).points
    assert points["repeats"].sum() == loads.size
    assert points["load"].is_monotonic_increasing
    # No fewer than as many stretches as cover them, each as wide as the tolerance.
    stretches, end = 0, -np.inf
    for load in np.sort(loads):
        if load > end:
            stretches, end = stretches + 1, load * (1 + tolerance)
    assert len(points) >= stretches
    assert points["load"].is_unique
    assert points["load"].between(loads.min(), loads.max()).all()


def test_a_sweep_without_gaps_is_never_chained():
    loads = np.geomspace(1, 100, 5000)
    points = pooled(loads**-0.3, loads, np.ones(5000), None, TOLERANCE)
    assert np.log(100) / np.log1p(TOLERANCE) <= len(points.points) <= 2.2 * np.log(100) / np.log1p(TOLERANCE)
    # Friction follows the load within a point, which is no scatter; one parabola is the law of these rows.
    assert points.scatter < 1e-6
    np.testing.assert_allclose(points.points["friction"] * points.points["load"] ** 0.3, 1, rtol=1e-6)


def test_shifts_within_reach_of_the_polynomial_are_exact_without_scatter():
    law_shifts = shifts(*measured(bent, noise=0.0, jitter=0.0))
    np.testing.assert_allclose(law_shifts.shifts.value, wlf(KELVINS), atol=1e-8)


@pytest.mark.parametrize("noise", [0.0, 0.001, 0.01])
def test_shifts_are_in_their_intervals_whatever_the_scatter(noise):
    """Both shapes of the curve and some seeds; allowed: three deviations of their number from 93 %."""
    held = []
    for law in (knee, bent):
        for seed in range(1 if noise == 0 else 8):
            law_shifts = shifts(*measured(law, noise=noise, jitter=0.0, seed=seed))
            low, high = law_shifts.shifts.interval()
            true = wlf(KELVINS) - wlf(KELVINS[2])
            held.append(np.mean((low - 1e-8 <= true) & (true <= high + 1e-8)))
    assert np.mean(held) >= 0.93 - 3 * np.sqrt(0.93 * 0.07 / len(held)), held


def test_the_error_of_shifts_is_in_the_exponent_of_the_speed():
    points = pooled(*measured(kelvins=KELVINS[1:4]), TOLERANCE)
    each = isotherms(points)
    data = curves_of(points, found(each, points.loads, points.dof))
    assert isinstance(data, MeasuredCurves)
    assert list(data.speeds) == sorted(data.speeds)

    def slope(part):
        return {"": np.log(part.speeds[-1] / part.speeds[0])}

    assert data.resampled(slope)[""].estimated.error > 0.01
    assert replace(data, levers=None).resampled(slope)[""].estimated.error == 0


def test_temperatures_whose_loads_are_too_far_apart_are_refused():
    friction, load, speed, warm = measured()
    with pytest.raises(ValueError, match="less than 25% of their loads"):
        shifts(friction, np.where(warm > 300, 100 * load, load), speed, warm)


def test_of_powers_of_speed_and_load_no_shift_is_told():
    law_shifts = shifts(*measured(lambda x: -0.3 * x))
    assert law_shifts.inseparable == POWERS
    assert not shifts(*measured()).inseparable
