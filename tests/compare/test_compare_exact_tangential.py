"""Partial slip in closed form: what the forms say of one another, and that both solvers say it."""

import numpy as np
import pytest

from compare.models.exact import tangential


def test_the_first_pull_meets_the_stiffness_of_what_sticks():
    # dF/du at 0 of the superposition is that of Mindlin's disc: mu F_N (3/2) / u_max = 8 G a / (2 - nu)
    modulus, nu, radius, body, friction = 1e6, 0.3, 1e-3, 1e-2, 0.4
    load = 4 / 3 * (2 * modulus / (1 - nu)) * radius**3 / body
    u_max = tangential.full_slip_displacement(friction, radius**2 / body, nu)
    step = 1e-6
    slope = friction * load * tangential.force(step) / (step * u_max)
    assert slope == pytest.approx(tangential.no_slip_stiffness(modulus, nu, radius), rel=step)


@pytest.mark.parametrize("wrong", [-0.1, 1.1, np.nan])
def test_fractions_outside_their_range_are_refused(wrong):
    for form in (tangential.force, tangential.displacement, tangential.stick_radius, tangential.line_stick_width):
        with pytest.raises(ValueError, match="must lie from 0 to 1"):
            form(wrong)
