"""Partial slip in closed form: what the forms say of one another, and that both solvers say it."""

import numpy as np
import pytest
from scipy.integrate import quad

from compare.models.exact import tangential

QUADRATURE = 1e-8
FRACTIONS = [0.0, 0.01, 0.5, 0.99, 1.0]


@pytest.mark.parametrize("fraction", FRACTIONS)
@pytest.mark.parametrize("exponent", [1.0, 2.0, 4.0])
def test_force_and_displacement_are_each_others_inverse(exponent, fraction):
    there = tangential.force(fraction, exponent)
    assert tangential.displacement(there, exponent) == pytest.approx(fraction, abs=1e-12)


@pytest.mark.parametrize("fraction", FRACTIONS)
def test_tractions_of_sphere_and_cylinder_add_up_to_the_force(fraction):
    round_stick, line_stick = tangential.stick_radius(fraction), tangential.line_stick_width(fraction)
    points = [min(round_stick, 1.0)], [min(line_stick, 1.0)]
    of_sphere, _ = quad(lambda r: 3 * r * tangential.hertz_traction(r, round_stick), 0, 1, points=points[0])
    of_line, _ = quad(lambda x: 4 / np.pi * tangential.hertz_traction(x, line_stick), 0, 1, points=points[1])
    assert of_sphere == pytest.approx(fraction, abs=QUADRATURE)
    assert of_line == pytest.approx(fraction, abs=QUADRATURE)


def test_the_first_pull_meets_the_stiffness_of_what_sticks():
    # dF/du at 0 of the superposition is that of Mindlin's disc: mu F_N (3/2) / u_max = 8 G a / (2 - nu)
    modulus, nu, radius, body, friction = 1e6, 0.3, 1e-3, 1e-2, 0.4
    load = 4 / 3 * (2 * modulus / (1 - nu)) * radius**3 / body
    u_max = tangential.full_slip_displacement(friction, radius**2 / body, nu)
    step = 1e-6
    slope = friction * load * tangential.force(step) / (step * u_max)
    assert slope == pytest.approx(tangential.no_slip_stiffness(modulus, nu, radius), rel=step)


def test_the_traction_of_what_sticks_adds_up_to_the_force():
    whole, _ = quad(lambda r: 2 * np.pi * r * tangential.no_slip_traction(2.0, 1.5, r), 0, 1.5)
    assert whole == pytest.approx(2.0, rel=QUADRATURE)


def test_a_wave_slips_everywhere_at_the_drop_of_its_mean_gap():
    assert tangential.wave_displacement(0.5, 0.0, 0.3, 2e-6) == 0
    most = tangential.wave_displacement(0.5, 1.0, 0.3, 2e-6)
    assert most == pytest.approx(0.5 * 2e-6 * (0.3 - 0.3 * np.log(0.3)), rel=1e-12)


@pytest.mark.parametrize("wrong", [-0.1, 1.1, np.nan])
def test_fractions_outside_their_range_are_refused(wrong):
    for form in (tangential.force, tangential.displacement, tangential.stick_radius, tangential.line_stick_width):
        with pytest.raises(ValueError, match="must lie from 0 to 1"):
            form(wrong)
