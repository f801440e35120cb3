"""Line contacts against Hertz, Hunter's closed form and the pressures of a published program."""

import numpy as np
import pytest

from bem3d import BEM
from compare.models.exact import line_contact
from scene import Cylinder, Elastic, Indent, Kelvin, Scene, Slide, StandardLinearSolid
from scene.scales import elastic_contact

R, MODULUS, TAU, LOAD = 10e-3, 4e6, 1e-3, 10.0
HALF_WIDTH, _ = line_contact.hertz(R, MODULUS, LOAD)
ACCURACY = 1e-3  # with 100 points across; measured: 7e-4 at worst


def solid(stiffening):
    """f = E_g/E_r - 1 and the retardation time TAU."""
    if np.isinf(stiffening):
        return Kelvin(MODULUS / 4, TAU)
    return StandardLinearSolid(
        rubbery_modulus=MODULUS / 4,
        glassy_modulus=MODULUS / 4 * (1 + stiffening),
        relaxation_time=TAU / (1 + stiffening),
    )


def sliding(stiffening, ratio):
    """At v tau_c over the relaxed half-width."""
    return Scene(Cylinder(R), solid(stiffening), Slide(speed=ratio * HALF_WIDTH / TAU, line_load=LOAD))


def test_at_rest_it_is_hertz_and_converges():
    scene = Scene(Cylinder(R), Elastic(MODULUS / 4), Indent(line_load=LOAD))
    exact = elastic_contact(scene)
    errors = []
    for points in (32, 128, 512):
        result = BEM(points=points, tolerance=1e-9).solve(scene)
        assert result.normal_force == pytest.approx(LOAD, rel=1e-12)
        assert result.friction_force == 0
        assert result.measures["contact_area"] / 2 == pytest.approx(HALF_WIDTH, abs=1.1 * result.measures["pixel"])
        errors.append(abs(result.depth / exact.depth - 1))
    assert errors[2] < errors[0] / 16**1.5  # the edge is known to a pixel
    assert errors[2] < 1e-6


@pytest.mark.parametrize("ratio", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize("stiffening", [1.0, 1e3, np.inf])
def test_sliding_is_hunters(stiffening, ratio):
    scene = sliding(stiffening, ratio)
    glassy = np.inf if np.isinf(stiffening) else MODULUS * (1 + stiffening)
    exact = line_contact.sliding(R, MODULUS, glassy, TAU, scene.motion.speed, LOAD)
    result = BEM(points=128).solve(scene)
    # of a slow contact the friction is a difference of nearly symmetric pressures
    assert result.friction_coefficient == pytest.approx(exact.friction_coefficient, rel=ACCURACY + 1e-5 / ratio)
    assert result.measures["contact_area"] / 2 == pytest.approx(exact.half_width, abs=2 * result.measures["pixel"])


def test_friction_converges_with_the_pixel():
    scene = sliding(9.0, 1.0)
    exact = line_contact.sliding(R, MODULUS, 10 * MODULUS, TAU, scene.motion.speed, LOAD).friction_coefficient
    errors = [abs(BEM(points=n).solve(scene).friction_coefficient / exact - 1) for n in (32, 128, 512)]
    assert errors[2] < errors[0] / 8
    assert errors[2] < 1e-4


def test_the_three_estimates_of_friction_agree():
    measures = BEM(points=256).solve(sliding(9.0, 1.0)).measures
    one, two, three = (measures[f"friction_by_{name}"] for name in ("traction", "loss", "work"))
    assert one == pytest.approx(two, rel=1e-3)
    assert two == pytest.approx(three, rel=1e-3)
    assert one != two != three


def test_a_line_is_solved_in_double_whatever_the_precision_asked_for():
    scene = sliding(np.inf, 1.0)
    single, double = (BEM(points=64, precision=p).solve(scene) for p in ("single", "double"))
    assert single.friction_coefficient == double.friction_coefficient
    assert single.settings["precision"] == "double"
