"""Closed forms of contacts against their own definitions: integrals, limits, and the figures of others."""

from math import inf, pi, sqrt

import numpy as np
import pytest

from compare.models.exact import foundation, full_contact, indentation, line_contact, waves
from scene import Cone, Kelvin, PowerLaw, Prony, Sphere, StandardLinearSolid

# Sums and powers of a few numbers.
RADIUS, RELAXED, LOAD = 50e-3, 1e6, 300.0
SOLID = StandardLinearSolid(rubbery_modulus=0.25, glassy_modulus=1.25, relaxation_time=1.0)
RUBBER = Kelvin(modulus=0.25, relaxation_time=0.3)
CHAIN = Prony(
    equilibrium_modulus=1.0, moduli=(2.0, 5.0, 40.0), relaxation_times=(30.0, 0.5, 2e-3), poisson_ratio=0.4
)


def cylinder(f, memory, load=LOAD):
    """The contact with E_g = (1 + f) E_r at a memory in units of the relaxed half-width."""
    slow, _ = line_contact.hertz(RADIUS, RELAXED, load)
    return line_contact.sliding(RADIUS, RELAXED, (1 + f) * RELAXED, 1.0, memory * slow, load), slow


def test_peak_pressures_are_those_of_a_published_program():
    """Combined radius 50 mm, E_g = 1905 MPa, f = 1, 600 N/mm; memories in mm, pressures in MPa to its 4 digits."""
    for memory, peak in ((0, 60.32), (9, 78.74), (45, 84.72), (2000, 85.31)):
        contact = line_contact.sliding(50e-3, 952.5e6, 1905e6, 1.0, memory * 1e-3, 600e3)
        angle = pi * np.linspace(0, 1, 4002)[1:-1] ** 6  # drawn to the leading edge, where a soft solid peaks
        found = contact.pressure(contact.centre - contact.half_width * np.cos(angle)).max()
        assert found / 1e6 == pytest.approx(peak, rel=1.5e-4)


# A rule drawn to the leading edge.
V, WEIGHTS = np.polynomial.legendre.leggauss(1500)


@pytest.mark.parametrize("f", [0.0, 0.5, 9.0, 1e3, 1e9])
@pytest.mark.parametrize("memory", [0.0, 1e-6, 0.03, 1.0, 20.0, 1e6])
def test_line_pressure_carries_the_load_and_its_moment_is_the_friction(f, memory):
    contact, slow = cylinder(f, memory)
    angle = pi * ((V + 1) / 2) ** 6
    x = contact.centre - contact.half_width * np.cos(angle)
    dx = contact.half_width * np.sin(angle) * WEIGHTS / 2 * 6 * ((V + 1) / 2) ** 5 * pi
    p = contact._pressure_at(angle)
    assert np.all(p >= -1e-12 * p.max())
    assert p @ dx == pytest.approx(LOAD, rel=1e-11)
    # The moment of a nearly even pressure is a difference.
    assert -(p * x) @ dx / (LOAD * RADIUS) == pytest.approx(
        contact.friction_coefficient, rel=1e-10, abs=1e-12 * slow / RADIUS
    )


def test_a_kelvin_cylinder_is_the_limit_of_stiff_glass():
    kelvin, _ = cylinder(inf, 0.7)
    stiff, _ = cylinder(1e10, 0.7)
    assert stiff.friction_coefficient == pytest.approx(kelvin.friction_coefficient, rel=1e-8)
    assert stiff.edges == pytest.approx(kelvin.edges, rel=1e-8)
    x = kelvin.centre + kelvin.half_width * np.array([-0.5, 0.0, 0.9])
    assert stiff.pressure(x) == pytest.approx(kelvin.pressure(x), rel=1e-8)
    assert kelvin.pressure(np.array([-1.0, 1.0])).tolist() == [0, 0]


@pytest.mark.parametrize("solid", [RUBBER, SOLID, CHAIN])
def test_full_contact_of_waves_is_that_of_their_heights(solid):
    x, y = np.arange(48) / 48 * 0.3, np.arange(32)[:, None] / 32 * 0.3
    q, height, speed = 2 * pi / 0.3, 1e-3, 0.2
    wave = height * np.cos(q * x) * np.ones_like(y)
    parameters = (height, 0.3, solid, speed)
    pressure = full_contact.pressure(wave, (0.3, 0.3), solid, speed)
    expected = full_contact.wave_pressure(*parameters, x) * np.ones_like(y)
    np.testing.assert_allclose(pressure, expected, atol=1e-11 * np.abs(expected).max())
    angles = np.linspace(0, 0.3, 10001)
    assert -full_contact.wave_pressure(*parameters, angles).min() == pytest.approx(
        full_contact.wave_closure(*parameters), rel=1e-6
    )
    assert full_contact.crossed_closure(*parameters) == sqrt(2) * full_contact.wave_closure(*parameters)


@pytest.mark.parametrize(
    "shape",
    [
        Sphere(radius=0.3),
        Cone(angle=0.4),
        PowerLaw(coefficient=2.0, exponent=1.5),
        PowerLaw(coefficient=9, exponent=30),
    ],
)
def test_a_held_contact_relaxes_as_the_modulus_and_a_held_load_creeps_as_the_compliance(shape):
    """After a step of a millionth of the shortest time."""
    n, kc = shape.exponent, shape.mdr_coefficient
    b = 2 * n / (n + 1) * kc ** (-1 / n)
    later = np.array([1e-3, 0.1, 2.0, 100.0])
    force, _ = indentation.force_of_depth(shape, CHAIN, [0, 1e-9, 100], [0, 0.1, 0.1], later)
    modulus = 2 / 0.6 * CHAIN.relaxation_modulus(later)
    assert force == pytest.approx(b * modulus * 0.1 ** ((n + 1) / n), rel=1e-6)
    depth = indentation.loading_depth(shape, CHAIN, [0, 1e-9, 100], [0, 7.0, 7.0], later)
    compliance = 0.6 / 2 * CHAIN.creep_compliance(later)
    assert depth == pytest.approx((7.0 * compliance / b) ** (n / (n + 1)), rel=1e-6)


SPHERE = Sphere(radius=1.0)


@pytest.mark.parametrize(
    ("form", "given", "named"),
    [
        (line_contact.sliding, (1.0, 2.0, 1.0, 1.0, 1.0, 1.0), "glassy_modulus"),
        (waves.wave_mean_gap, (1.1,), "0 to 1"),
        (full_contact.friction, (np.zeros((8, 8)), (1.0, 0.0), RUBBER, 1.0), "sides"),
        (indentation.force_of_depth, (SPHERE, SOLID, [0, 1, 2, 3], [0, 2, 1, 2], 1.0), "one top"),
        (indentation.loading_depth, (SPHERE, SOLID, [0, 1, 1.01], [0, 1, 0], [0.9, 1.0, 1.01]), "depth falls"),
        (foundation.sliding_forces, (PowerLaw(coefficient=1.0, exponent=3.0), RUBBER, 1.0, 1.0), "closed form"),
    ],
)
def test_what_has_no_closed_form_is_named(form, given, named):
    with pytest.raises(ValueError, match=named):
        form(*given)


def test_dashpot_of_a_kelvin_body_adds_its_rate():
    """F = B E* (d^m + tau d(d^m)/dt) while the contact grows."""
    force, _ = indentation.force_of_depth(Sphere(radius=1.0), RUBBER, [0, 2.0], [0, 0.2], [0.5, 2.0])
    d = np.array([0.05, 0.2])
    assert force == pytest.approx(4 / 3 * (d**1.5 + 0.3 * 1.5 * np.sqrt(d) * 0.1), rel=1e-12)
