"""Smooth indenters against closed forms, derived here and nowhere imported from the solver."""

from math import pi, sqrt, tan

import pytest

from mdr1d import MDR
from scene import Cone, Elastic, Indent, Kelvin, Scene, Slide, SolveError, Sphere

MODULUS = 1e6
STIFFNESS = 4 * MODULUS  # E* of an incompressible solid
RADIUS = 1e-2
ANGLE = 0.2

# A sum of some thousand terms of one sign, and a depth that is a difference of heights.
ROUNDING = 1e-12
# Measured 7e-8 at 5000 points; the error is (pixel / radius)^2 times a constant below one.
SECOND_ORDER_AT_5000 = 2e-7


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


@pytest.mark.parametrize("ratio", [1e3, 1e12, 1e20, 1e30, 1e100])
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
