"""Macroscopic shapes: heights, slopes and the one-dimensional image."""

from math import pi, tan

import numpy as np
import pytest

from scene import Cone, Cylinder, Elastic, Indent, PowerLaw, Scene, Slide, Sphere
from scene.scales import elastic_contact

ROUNDING = 1e-13
R, ANGLE = 1e-2, 0.2
AXISYMMETRIC = [Sphere(R), Cone(ANGLE), PowerLaw(2e3, 3.5)]
every_shape = pytest.mark.parametrize("shape", AXISYMMETRIC)
X, Y = np.meshgrid(np.linspace(-1e-3, 1e-3, 8), np.linspace(-2e-3, 1e-3, 6))


def test_heights_are_those_of_the_named_bodies():
    r = np.hypot(X, Y)
    np.testing.assert_allclose(Sphere(R).height(X, Y), r**2 / (2 * R), rtol=ROUNDING)
    np.testing.assert_allclose(Cone(ANGLE).height(X, Y), r * tan(ANGLE), rtol=ROUNDING)
    np.testing.assert_allclose(PowerLaw(2e3, 3.5).height(X, Y), 2e3 * r**3.5, rtol=ROUNDING)
    np.testing.assert_allclose(Cylinder(R).height(X, Y), X**2 / (2 * R), rtol=ROUNDING)


@pytest.mark.parametrize("shape", [*AXISYMMETRIC, Cylinder(R)])
def test_the_slope_is_the_derivative_of_the_height_along_x(shape):
    step = 1e-9
    difference = (shape.height(X + step, Y) - shape.height(X - step, Y)) / (2 * step)
    # A central difference: rounding of heights over the step, and its square.
    np.testing.assert_allclose(shape.slope(X, Y), difference, rtol=1e-5, atol=1e-8)


@every_shape
def test_at_the_tip_height_and_slope_vanish_and_no_number_is_lost(shape):
    assert shape.height(0.0, 0.0) == shape.slope(0.0, 0.0) == shape.slope(0.0, 1e-3) == 0


@every_shape
def test_the_radius_at_a_height_is_where_that_height_is_reached(shape):
    heights = np.geomspace(1e-9, 1e-3, 5)
    np.testing.assert_allclose(shape.height(shape.radius_at(heights), 0.0), heights, rtol=1e-12)


@every_shape
def test_the_one_dimensional_image_is_the_abel_integral_of_the_slope(shape):
    # g(x) = |x| int_0^|x| z'(r)/sqrt(x^2 - r^2) dr; with r = x sin(t) an integrand without a singularity.
    nodes, weights = np.polynomial.legendre.leggauss(60)
    x = 7e-4
    radii = x * np.sin(pi / 4 * (nodes + 1))
    integral = x * pi / 4 * weights @ shape.slope(radii, 0.0)
    assert shape.mdr_coefficient * x**shape.exponent == pytest.approx(integral, rel=1e-6)


@every_shape
def test_the_smooth_contact_at_a_load_is_the_one_at_its_depth_and_stiffness_is_that_of_a_punch(shape):
    solid = Elastic(1e6)
    by_load = elastic_contact(Scene(shape, solid, Indent(load=1.0)))
    by_depth = elastic_contact(Scene(shape, solid, Slide(speed=1.0, depth=by_load.depth)))
    assert (by_depth.load, by_depth.radius) == pytest.approx((1.0, by_load.radius), rel=1e-12)
    # dF/dd = 2 E* a for every body of revolution.
    loads = [
        elastic_contact(Scene(shape, solid, Indent(depth=by_load.depth * f))).load for f in (1 - 1e-5, 1 + 1e-5)
    ]
    stiffness = (loads[1] - loads[0]) / (2e-5 * by_load.depth)
    assert stiffness == pytest.approx(2 * solid.indentation_modulus * by_load.radius, rel=1e-8)
