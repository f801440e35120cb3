"""The paper's side remarks: each against something that does not share its formula."""

from math import log, pi

import numpy as np
import pytest
from scipy.integrate import trapezoid

from compare.models.exact.indentation import force_of_depth
from mdr1d import equations, estimates
from scene import (
    Cone,
    PowerLaw,
    StandardLinearSolid,
)

# The paper's experiment: moduli [Pa], friction, speed [m/s], conductivity [W/(m K)].
STATIC, GLASSY, FRICTION, SPEED, CONDUCTIVITY = 3e6, 1.5e9, 0.5, 1e-2, 20.0
ROUNDING = 1e-13
# The numbers are stated with two digits.
STATED = 0.03


def heated(depth):
    return estimates.average_heating(FRICTION, STATIC, depth, SPEED, CONDUCTIVITY)


def test_the_paper_heats_at_one_newton_what_it_says_of_a_hundred():
    for load, radius, depth, rise in (
        (1.0, 50e-3, 4.3e-5, 0.064),
        (100.0, 50e-3, 0.92e-3, 1.4),
        (100.0, 25e-3, 1.16e-3, 1.74),
    ):
        found = equations.indentation_depth(load, STATIC, 1 / radius, 2)
        assert (found, heated(found)) == pytest.approx((depth, rise), rel=STATED)
    flash = estimates.flash_heating(FRICTION, GLASSY, 1e-7, SPEED, CONDUCTIVITY)
    assert flash == pytest.approx(0.075, rel=ROUNDING)


@pytest.mark.parametrize("n", [1.0, 100.0])
def test_the_average_heating_is_that_of_an_isothermal_disc_but_for_the_shape(n):
    load, c = 3.0, 0.4 * 1e3 ** (n - 1)
    radius, depth = equations.contact_radius(load, STATIC, c, n), equations.indentation_depth(load, STATIC, c, n)
    disc = FRICTION * load * SPEED / (4 * radius * CONDUCTIVITY)
    assert heated(depth) == pytest.approx(disc * (n + 1) / n, rel=1e-11)


TIMES, DEPTHS = (0.0, 1.0, 1.2, 3.0), (0.0, 1e-4, 1e-4, 0.0)


@pytest.mark.parametrize("shape", [Cone(angle=0.2), PowerLaw(coefficient=1e3, exponent=3.0)])
def test_the_radius_depends_on_the_depth_alone_until_the_indenter_is_withdrawn(shape):
    solid = StandardLinearSolid(rubbery_modulus=1e6, glassy_modulus=5e6, relaxation_time=1.0)
    for time, kept in ((0.2, True), (1.0, True), (1.2, True), (1.5, False), (2.0, False)):
        _, radius = force_of_depth(shape, solid, TIMES, DEPTHS, time)
        elastic = estimates.radius_at_depth(np.interp(time, TIMES, DEPTHS), shape.mdr_coefficient, shape.exponent)
        assert radius[0] == pytest.approx(elastic, rel=1e-10) if kept else radius[0] < 0.99 * elastic


def test_a_sphere_slips_throughout_at_one_and_a_half_times_friction_times_depth():
    assert estimates.largest_displacement(FRICTION, 1e-4) == pytest.approx(1.5 * FRICTION * 1e-4, rel=ROUNDING)


@pytest.mark.parametrize("n", [1.0, 3.0])
def test_at_the_layer_force_the_contact_is_as_wide_as_the_layer_is_thick(n):
    force = estimates.layer_force(STATIC, 1e-2, 20.0, n)
    assert 2 * equations.contact_radius(force, STATIC, 20.0, n) == pytest.approx(1e-2, rel=ROUNDING)
    # The paper's forty newtons.
    assert estimates.layer_force(STATIC, 10e-3, 1 / 50e-3, 2) == pytest.approx(40.0, rel=ROUNDING)


def thin_layer_force(depth, base, n):
    """Force [N] of c r^n, c = 1, on a thin layer of unit thickness: springs, or a film that is squeezed."""
    if base == "compressible layer":
        radius = depth ** (1 / n)
        r = np.linspace(0, radius, 20001)
        return trapezoid(2 * pi * r * (depth - r**n), r)
    # r p' = -int_0^r (d - f) r dr; the film lets go where p' = 0.
    radius = (depth * (n + 2) / 2) ** (1 / n)
    r = np.linspace(0, radius, 20001)
    return trapezoid(pi * r * (depth * r**2 / 2 - r ** (n + 2) / (n + 2)), r)


@pytest.mark.parametrize("n", [1.0, 2.0])
@pytest.mark.parametrize("base", estimates.STIFFENING)
def test_the_exponents_of_stiffness_are_those_of_the_force(base, n):
    depths = np.array([1e-3, 1e-2])
    if base == "half-space":
        loads = np.array([1.0, 10.0])
        growth = log(10) / np.diff(np.log(equations.indentation_depth(loads, 1.0, 1.0, n)))[0]
    else:
        forces = np.array([thin_layer_force(depth, base, n) for depth in depths])
        growth = np.diff(np.log(forces))[0] / log(10)
    # k ~ F/d; equal grids make the quadrature scale too.
    assert estimates.stiffness_exponent(n, base) == pytest.approx(1 - 1 / growth, rel=1e-10)
