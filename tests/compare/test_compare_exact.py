"""Closed forms against integrals and derivatives that are written out here."""

from dataclasses import replace
from math import pi

import numpy as np
import pytest

from compare.models import exact
from compare.models.exact import Exact, tangential
from scene import (
    Cone,
    Coulomb,
    Cylinder,
    Elastic,
    Fractional,
    Indent,
    Kelvin,
    PowerLaw,
    Refused,
    Scene,
    SelfAffine,
    Slide,
    Sphere,
)
from scene import StandardLinearSolid as Solid

SHAPES = [Sphere(radius=2e-2), Cone(angle=0.2), PowerLaw(coefficient=30.0, exponent=3.0)]
RUBBER = Kelvin(modulus=1e6, relaxation_time=1e-3)
# Sums and powers of a few numbers.
ROUNDING = 1e-12
# The pressure falls to zero at the edge of the contact with an infinite slope: the midpoint sum pays for that.
RING_SUM = 3e-3


@pytest.mark.parametrize("shape", SHAPES)
def test_pressure_carries_the_load(shape):
    answer = Exact().solve(Scene(shape, RUBBER, Indent(load=1.0)))
    r, p = answer.fields["r"], answer.fields["pressure"]
    middle = (p[1:] + p[:-1]) / 2
    assert pi * np.sum(middle * np.diff(r**2)) == pytest.approx(1.0, rel=RING_SUM)
    assert np.all(p >= 0)


def test_mean_lag_is_the_loss_at_low_frequency():
    solid = Solid(rubbery_modulus=1e6, glassy_modulus=1e8, relaxation_time=1e-5)
    omega = 1e-4 / 1e-3
    tangent = solid.complex_modulus(omega)
    assert exact.mean_lag(solid) == pytest.approx(tangent.imag / tangent.real / omega, rel=1e-6)
    assert exact.mean_lag(RUBBER) == pytest.approx(RUBBER.relaxation_time, rel=ROUNDING)


def test_what_has_no_closed_form_is_refused_by_name():
    rough = SelfAffine(hurst=0.5, rms_height=1e-6, longest=1e-2)
    for scene, word in (
        (Scene(Sphere(radius=1e-2), RUBBER, Slide(speed=0.1, load=1.0)), "speed = 0.1"),
        (Scene(Sphere(radius=1e-2), RUBBER, Indent(load=1.0), rough), "roughness"),
        (Scene(Cylinder(radius=1e-2), RUBBER, Indent(line_load=1.0)), "Cylinder"),
    ):
        with pytest.raises(Refused, match=word):
            Exact().solve(scene)
    assert not Exact().refusals(Scene(Sphere(radius=1e-2), Elastic(modulus=1e6), Slide(speed=0.1, load=1.0)))


def test_friction_in_the_interface_adds_nothing_at_rest_and_is_refused_in_sliding():
    plain = Scene(Sphere(radius=1e-2), Elastic(modulus=1e6), Indent(load=1.0))
    rubbing = replace(plain, interface=Coulomb(0.3))
    answer = Exact().solve(rubbing)
    assert (answer.depth, answer.friction_force) == (Exact().solve(plain).depth, 0.0)
    for speed in (0.0, 0.1):
        with pytest.raises(Refused, match="interface = Coulomb: friction of the interface is not in the closed"):
            Exact().solve(replace(rubbing, motion=Slide(speed=speed, load=1.0)))


def test_the_loss_exponent_of_a_power_law_is_its_power_and_that_of_a_kelvin_body_one():
    kelvin = Kelvin(modulus=1e6, relaxation_time=1e-3)
    power = Fractional(
        modulus=1e6, relaxation_time=1e-3, exponent=0.3, lowest_frequency=1e-2, highest_frequency=1e7
    )
    speeds = (0.01, 0.1, 1.0)
    powers = [
        exact.loss_exponent(kelvin, wave_number, (0.00333, 0.03)) for wave_number in np.geomspace(1e3, 1e7, 60)
    ]
    assert powers == pytest.approx(np.ones(60), rel=1e-12)
    assert max(powers) == 1.0  # of which Eq. 23 takes none that rounding has made more
    assert exact.loss_exponent(power, 1e4, speeds) == pytest.approx(0.3, abs=1e-3)


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
