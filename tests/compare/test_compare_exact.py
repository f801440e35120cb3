"""Closed forms against integrals and derivatives that are written out here."""

from dataclasses import replace
from math import pi

import numpy as np
import pytest
from drawn_scenes import KELVIN as RUBBER

from compare.models import exact
from compare.models.exact import Exact, tangential
from scene import (
    Cone,
    Coulomb,
    Cylinder,
    Elastic,
    Fractional,
    Indent,
    PowerLaw,
    Refused,
    Scene,
    SelfAffine,
    Slide,
    Sphere,
)

ELASTIC = Elastic(modulus=1e6)
REST = Scene(Sphere(radius=1e-2), RUBBER, Indent(load=1.0))


@pytest.mark.parametrize("shape", [Sphere(radius=2e-2), Cone(angle=0.2), PowerLaw(coefficient=30.0, exponent=3.0)])
def test_pressure_carries_the_load(shape):
    answer = Exact().solve(Scene(shape, RUBBER, Indent(load=1.0)))
    r, p = answer.fields["r"], answer.fields["pressure"]
    middle = (p[1:] + p[:-1]) / 2
    # It falls to zero at the edge of the contact with an infinite slope: the midpoint sum pays for that.
    assert pi * np.sum(middle * np.diff(r**2)) == pytest.approx(1.0, rel=3e-3)
    assert np.all(p >= 0)


@pytest.mark.parametrize(
    ("changed", "named"),
    [
        ({"motion": Slide(speed=0.1, load=1.0)}, "speed = 0.1"),
        ({"roughness": SelfAffine(hurst=0.5, rms_height=1e-6, longest=1e-2)}, "roughness"),
        ({"indenter": Cylinder(radius=1e-2), "motion": Indent(line_load=1.0)}, "Cylinder"),
        *(
            ({"interface": Coulomb(0.3), "elastomer": ELASTIC, "motion": motion}, "friction of the interface")
            for motion in (Slide(speed=0.0, load=1.0), Slide(speed=0.1, load=1.0))
        ),
    ],
)
def test_what_has_no_closed_form_is_refused_by_name(changed, named):
    with pytest.raises(Refused, match=named):
        Exact().solve(replace(REST, **changed))


def test_what_is_elastic_slides_and_friction_in_the_interface_adds_nothing_at_rest():
    plain = replace(REST, elastomer=ELASTIC)
    assert not Exact().refusals(replace(plain, motion=Slide(speed=0.1, load=1.0)))
    answer = Exact().solve(replace(plain, interface=Coulomb(0.3)))
    assert (answer.depth, answer.friction_force) == (Exact().solve(plain).depth, 0.0)


def test_the_loss_exponent_of_a_power_law_is_its_power_and_that_of_a_kelvin_body_one():
    power = Fractional(
        modulus=1e6, relaxation_time=1e-3, exponent=0.3, lowest_frequency=1e-2, highest_frequency=1e7
    )
    powers = [
        exact.loss_exponent(RUBBER, wave_number, (0.00333, 0.03)) for wave_number in np.geomspace(1e3, 1e7, 60)
    ]
    assert powers == pytest.approx(np.ones(60), rel=1e-12)
    assert max(powers) == 1.0  # Eq. 23 takes no power above one, not even by rounding
    assert exact.loss_exponent(power, 1e4, (0.01, 0.1, 1.0)) == pytest.approx(0.3, abs=1e-3)


def test_the_first_pull_meets_the_stiffness_of_what_sticks():
    # dF/du at 0 of the superposition is the stiffness of Mindlin's disc: mu F_N (3/2) / u_max = 8 G a / (2 - nu)
    modulus, nu, radius, body, friction = 1e6, 0.3, 1e-3, 1e-2, 0.4
    load = 4 / 3 * (2 * modulus / (1 - nu)) * radius**3 / body
    u_max = tangential.full_slip_displacement(friction, radius**2 / body, nu)
    step = 1e-6
    slope = friction * load * tangential.force(step) / (step * u_max)
    assert slope == pytest.approx(8 * modulus * radius / (2 - nu), rel=step)


@pytest.mark.parametrize("wrong", [-0.1, 1.1, np.nan])
def test_fractions_outside_their_range_are_refused(wrong):
    with pytest.raises(ValueError, match="must lie from 0 to 1"):
        tangential.force(wrong)
