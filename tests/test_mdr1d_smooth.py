"""Smooth indenters against closed forms, derived here and nowhere imported from the solver."""

from math import asin, pi, sin, sqrt, tan

import numpy as np
import pytest
from scipy.integrate import quad

from mdr1d import MDR
from scene import (
    Cone,
    Elastic,
    Indent,
    Kelvin,
    PowerLaw,
    Prony,
    Scene,
    Slide,
    SolveError,
    Sphere,
    StandardLinearSolid,
)

MODULUS = 1e6
STIFFNESS = 4 * MODULUS  # E* of an incompressible solid
TIME = 1e-3
RADIUS = 1e-2
ANGLE = 0.2
HALF = 1e-3  # static contact radius of the sliding cases

# A sum of some thousand terms of one sign, and a depth that is a difference of heights.
ROUNDING = 1e-12
# Measured 7e-8 at 5000 points; the error is (pixel / radius)^2 times a constant below one.
SECOND_ORDER_AT_5000 = 2e-7
# The contact edge falls anywhere within a pixel, so that the constant of the error, not its order, jumps about.
ORDER, ORDER_SPREAD = 2.0, 0.3


def sliding(shape, memory, depth):
    return Scene(shape, Kelvin(modulus=MODULUS, relaxation_time=TIME), Slide(speed=memory / TIME, depth=depth))


def sphere_forces(memory, a=HALF):
    """f = K (d - g - l g'), g = x^2/R, from -a to the trailing edge where it vanishes."""
    b = a**2 / (sqrt(a**2 + memory**2) + memory)

    def normal(x):
        return a**2 * x - x**3 / 3 - memory * x**2

    def moment(x):
        return a**2 * x**2 / 2 - x**4 / 4 - 2 * memory * x**3 / 3

    force = STIFFNESS / RADIUS * (normal(b) - normal(-a))
    return force, -2 * STIFFNESS / RADIUS**2 * (moment(b) - moment(-a))


def cone_forces(memory, a=HALF):
    """Whole leading flank, and of the trailing one what is left of it: a - l."""
    c = pi / 2 * tan(ANGLE)
    leading, trailing = a**2 / 2 + a * memory, max(a - memory, 0.0) ** 2 / 2
    return STIFFNESS * c * (leading + trailing), STIFFNESS * c**2 * (leading - trailing)


def orders(solve, exact):
    """Observed orders of the relative errors of normal and friction force, over all grids at once."""
    points = 2 ** np.arange(5, 13)
    found = [solve(int(n)) for n in points]
    pairs = np.array([(r.normal_force, r.friction_force) for r in found])
    errors = np.abs(pairs / np.array(exact) - 1)
    return -np.polyfit(np.log(points), np.log(errors), 1)[0]


@pytest.mark.parametrize("exponent", [1.0, 2.0, 3.5])
def test_the_profile_is_the_integral_of_the_transform(exponent):
    shape = PowerLaw(coefficient=0.7, exponent=exponent)
    for x in (0.3, 2.0):
        # r = x sin(t) takes the root out of the integrand.
        integral = quad(lambda t, x=x: 0.7 * exponent * (x * sin(t)) ** (exponent - 1), 0, asin(1.0))[0]
        # Quadrature asks for 1.5e-8 and gets far below.
        assert shape.mdr_coefficient * x**exponent == pytest.approx(x * integral, rel=1e-10)


def test_a_sphere_follows_hertz_by_load_and_by_depth():
    depth = 1e-4
    force = 4 / 3 * STIFFNESS * sqrt(RADIUS) * depth**1.5
    shape, elastomer = Sphere(radius=RADIUS), Elastic(modulus=MODULUS)
    by_depth = MDR().solve(Scene(shape, elastomer, Indent(depth=depth)))
    by_load = MDR().solve(Scene(shape, elastomer, Indent(load=force)))
    assert by_depth.normal_force == pytest.approx(force, rel=SECOND_ORDER_AT_5000)
    assert by_load.depth == pytest.approx(depth, rel=SECOND_ORDER_AT_5000)
    assert by_load.residual <= ROUNDING
    assert by_load.measures["stiffness"] == pytest.approx(2 * STIFFNESS * sqrt(RADIUS * depth), rel=1e-3)


def test_a_cone_follows_sneddon_to_rounding_on_any_grid():
    depth = 1e-4
    force = 2 / pi * STIFFNESS * depth**2 / tan(ANGLE)
    shape, elastomer = Cone(angle=ANGLE), Elastic(modulus=MODULUS)
    for points in (8, 9, 777):
        by_depth = MDR(points=points).solve(Scene(shape, elastomer, Indent(depth=depth)))
        by_load = MDR(points=points).solve(Scene(shape, elastomer, Indent(load=force)))
        assert by_depth.normal_force == pytest.approx(force, rel=ROUNDING)
        assert by_load.depth == pytest.approx(depth, rel=ROUNDING)


def test_a_compressible_solid_is_stiffer_by_its_poisson_ratio():
    shape, motion = Cone(angle=ANGLE), Indent(depth=1e-4)
    soft = MDR().solve(Scene(shape, Elastic(modulus=MODULUS, poisson_ratio=0.25), motion))
    full = MDR().solve(Scene(shape, Elastic(modulus=MODULUS), motion))
    assert soft.normal_force / full.normal_force == pytest.approx(0.5 / 0.75, rel=ROUNDING)


def test_the_error_on_a_sphere_is_of_second_order():
    depth = HALF**2 / RADIUS
    exact = 4 / 3 * STIFFNESS * sqrt(RADIUS) * depth**1.5
    scene = Scene(Sphere(radius=RADIUS), Elastic(modulus=MODULUS), Indent(depth=depth))
    points = 2 ** np.arange(5, 13)
    errors = [abs(MDR(points=int(n)).solve(scene).normal_force / exact - 1) for n in points]
    order = -np.polyfit(np.log(points), np.log(errors), 1)[0]
    assert order == pytest.approx(ORDER, abs=ORDER_SPREAD)


@pytest.mark.parametrize("ratio", [0.01, 0.3, 1.0, 10.0])
def test_the_error_on_a_sliding_sphere_is_of_second_order(ratio):
    scene = sliding(Sphere(radius=RADIUS), ratio * HALF, HALF**2 / RADIUS)
    found = orders(lambda n: MDR(points=n).solve(scene), sphere_forces(ratio * HALF))
    assert found == pytest.approx(ORDER, abs=ORDER_SPREAD)


@pytest.mark.parametrize("ratio", [1e-6, 1e-3, 0.1, 1.0, 10.0, 1e3, 1e6])
def test_a_sphere_slides_on_a_kelvin_solid_as_in_closed_form(ratio):
    result = MDR().solve(sliding(Sphere(radius=RADIUS), ratio * HALF, HALF**2 / RADIUS))
    force, friction = sphere_forces(ratio * HALF)
    assert result.normal_force == pytest.approx(force, rel=SECOND_ORDER_AT_5000)
    assert result.friction_force == pytest.approx(friction, rel=SECOND_ORDER_AT_5000)


@pytest.mark.parametrize("ratio", [1e-6, 1e-3, 0.3, 1.0, 2.0, 1e6])
def test_a_cone_slides_on_a_kelvin_solid_as_in_closed_form(ratio):
    result = MDR(points=1000).solve(sliding(Cone(angle=ANGLE), ratio * HALF, pi / 2 * tan(ANGLE) * HALF))
    force, friction = cone_forces(ratio * HALF)
    assert result.normal_force == pytest.approx(force, rel=ROUNDING)
    # The closed form is the difference of two equal flanks at low speed.
    assert result.friction_force == pytest.approx(friction, rel=1e-15 / min(ratio, 1) + ROUNDING)


def test_friction_starts_as_twice_the_relaxation_length_over_the_radius():
    memory = 1e-7 * HALF
    result = MDR().solve(sliding(Sphere(radius=RADIUS), memory, HALF**2 / RADIUS))
    # The next term of the series is 3/4 l/a.
    assert result.friction_coefficient == pytest.approx(2 * memory / RADIUS, rel=SECOND_ORDER_AT_5000)


def test_friction_of_a_cone_starts_linear_and_ends_at_its_slope():
    slope, depth = tan(ANGLE), pi / 2 * tan(ANGLE) * HALF
    slow = MDR().solve(sliding(Cone(angle=ANGLE), 1e-7 * HALF, depth))
    assert slow.friction_coefficient == pytest.approx(pi * slope * 1e-7, rel=1e-6)
    for ratio in (1.0, 1.5, 1e9):
        fast = MDR().solve(sliding(Cone(angle=ANGLE), ratio * HALF, depth))
        assert fast.friction_coefficient == pytest.approx(pi * slope / 2, rel=ROUNDING)


def test_elastic_sliding_has_no_friction():
    for shape in (Sphere(radius=RADIUS), Cone(angle=ANGLE), PowerLaw(coefficient=1e3, exponent=3.5)):
        result = MDR().solve(Scene(shape, Elastic(modulus=MODULUS), Slide(speed=3.0, load=1.0)))
        assert abs(result.friction_coefficient) <= ROUNDING
        assert abs(result.measures["friction_by_traction"]) <= ROUNDING


def test_at_rest_every_elastomer_is_its_relaxed_elastic_solid():
    kinds = (
        Kelvin(modulus=MODULUS, relaxation_time=TIME),
        StandardLinearSolid(rubbery_modulus=MODULUS, glassy_modulus=9e6, relaxation_time=TIME),
        Prony(equilibrium_modulus=MODULUS, moduli=(1e6, 3e7), relaxation_times=(1e-4, 1e-2)),
    )
    elastic = MDR().solve(Scene(Sphere(radius=RADIUS), Elastic(modulus=MODULUS), Indent(load=1.0)))
    for elastomer in kinds:
        for motion in (Indent(load=1.0), Slide(speed=0.0, load=1.0)):
            result = MDR().solve(Scene(Sphere(radius=RADIUS), elastomer, motion))
            assert result.depth == pytest.approx(elastic.depth, rel=ROUNDING)
            assert result.friction_force == pytest.approx(0.0, abs=ROUNDING)


def test_a_steep_power_law_approaches_the_flat_punch():
    shape = PowerLaw(coefficient=1e296, exponent=100.0)
    result = MDR().solve(Scene(shape, Elastic(modulus=MODULUS), Indent(depth=1e-4)))
    radius = (1e-4 / shape.mdr_coefficient) ** 0.01
    # The law itself: 2n/(n+1) E* a d; one pixel is a sizeable part of such an edge.
    assert result.normal_force == pytest.approx(200 / 101 * STIFFNESS * radius * 1e-4, rel=1e-3)


@pytest.mark.parametrize("ratio", [1e3, 1e6, 1e9, 1e12])
def test_a_fast_contact_far_smaller_than_the_one_at_rest_has_its_own_grid(ratio):
    # a fluid: d = F/(K l), a = sqrt(R d), mu = int g'^2 / int |g'| = 4a/(3R) over the front half
    radius, memory = 1e-2, ratio * 1e-3
    scene = Scene(Sphere(radius=radius), Kelvin(modulus=1e6, relaxation_time=1e-3), Slide(speed=ratio, load=1.0))
    result = MDR(points=2000).solve(scene)
    assert result.measures["points_across_contact"] > 200
    expected = 4 / 3 * sqrt(1.0 / (4e6 * memory * radius))
    # elasticity adds terms of the order of the contact radius over the memory length
    assert result.friction_coefficient == pytest.approx(expected, rel=1e-6 + 1e-3 / memory)


def test_a_smooth_contact_on_a_stated_extent_too_wide_for_it_is_an_error():
    scene = Scene(Sphere(radius=1e-2), Elastic(modulus=1e6), Indent(load=1e-9))
    with pytest.raises(SolveError, match="take more points"):
        MDR(points=100, extent=1e-2).solve(scene)
