"""The power-law solid: what its series states about range and error must be so."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.special import gamma

from scene import Fractional

SOLID = Fractional(modulus=1e6, relaxation_time=1e-3, exponent=0.3, lowest_frequency=1e-4, highest_frequency=1e8)
BETWEEN = 1.02  # the error is sampled at 32 frequencies a mode; other frequencies may find a little more


def power_law(solid, omega):
    return solid.modulus * (1 + (1j * omega * solid.relaxation_time) ** solid.exponent)


@pytest.mark.parametrize("exponent", [0.01, 0.99])
@pytest.mark.parametrize(("decades", "tolerance"), [(0.5, 1e-6), (4, 1e-1), (30, 1e-3)])
def test_storage_and_loss_follow_the_law_within_the_stated_error(exponent, decades, tolerance):
    highest = SOLID.lowest_frequency * 10**decades
    solid = replace(SOLID, exponent=exponent, highest_frequency=highest, tolerance=tolerance)
    omega = np.geomspace(solid.lowest_frequency, solid.highest_frequency, 2003)
    found, law = solid.complex_modulus(omega), power_law(solid, omega)
    worst = max(np.abs(found.real / law.real - 1).max(), np.abs(found.imag / law.imag - 1).max())
    assert solid.error <= tolerance
    assert worst <= BETWEEN * solid.error
    assert worst >= solid.error / 2


def test_relaxation_is_the_power_of_time_of_a_springpot():
    # G(t) = G (1 + (t/tau)^-beta / Gamma(1 - beta)), away from both ends of the range.
    t = np.geomspace(1e-6, 1e2, 9)
    expected = 1e6 * (1 + (t / 1e-3) ** -0.3 / gamma(0.7))
    np.testing.assert_allclose(replace(SOLID, tolerance=1e-6).relaxation_modulus(t), expected, rtol=1e-5)


def test_it_rests_at_its_modulus_and_ends_in_a_finite_glass():
    assert SOLID.static_modulus == 1e6
    top = np.abs(power_law(SOLID, SOLID.highest_frequency))
    assert top < SOLID.glassy_modulus < 10 * top
    assert SOLID.viscosity == 0


def test_below_the_range_loss_is_in_proportion_to_frequency_and_above_it_falls():
    slow = SOLID.complex_modulus(SOLID.lowest_frequency * np.array([1e-8, 1e-7])).imag
    assert slow[1] / slow[0] == pytest.approx(10, rel=1e-6)
    fast = SOLID.complex_modulus(SOLID.highest_frequency * np.array([1e7, 1e8])).imag
    assert fast[1] / fast[0] == pytest.approx(0.1, rel=1e-6)


def test_modes_are_few():
    # Trapezoidal rule: one mode a decade for each ln(10)/pi^2 of ln(1/error), and a handful at the ends.
    decades = 12
    for tolerance, most in ((1e-2, 2.2), (1e-3, 2.7), (1e-6, 4.5)):
        count = len(replace(SOLID, tolerance=tolerance).relaxation()[2])
        assert count <= most * decades
        assert count >= decades
