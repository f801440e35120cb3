"""Heights that another code is given are those on which this one has solved; heights in, fields out."""

from dataclasses import replace

import numpy as np
import pytest
from changing_motion import program
from maps import refused

from bem3d import BEM, heights, press
from scene import Cylinder, Elastic, Indent, Plane, Scene, SelfAffine, SolveError, Sphere

ROUGH = SelfAffine(hurst=0.8, rms_height=1e-6, longest=1e-3, shortest=1.25e-4, seed=3)
ELASTIC = Elastic(1e6)
BODY = Scene(Sphere(1e-2), ELASTIC, Indent(depth=1e-4), ROUGH)
SCENES = {
    "body": BODY,
    "plane": Scene(Plane(), ELASTIC, Indent(pressure=1e4), ROUGH),
    "line": Scene(Cylinder(1e-2), ELASTIC, Indent(line_load=100.0)),
    "program": replace(BODY, motion=program({"duration": 1.0, "depth": 1e-4})),
}


@pytest.mark.parametrize("name", SCENES)
def test_heights_are_those_of_a_result(name):
    answer = BEM(points=64, steps=3).solve(SCENES[name])
    extent = None if name == "plane" else answer.settings["extent"]
    found = heights(SCENES[name], 64, extent)
    if answer.settings["centre"] == (0.0, 0.0):
        np.testing.assert_array_equal(found.x, answer.fields["x"])
        np.testing.assert_array_equal(found.height, answer.fields["height"])
    assert found.height.shape == answer.fields["pressure"].shape == (len(found.y), len(found.x))
    assert found.height.dtype == float
    assert found.pixel == answer.measures["pixel"]


def test_a_grid_that_cannot_carry_the_waves_is_refused():
    refused("less than two pixels", heights, BODY, 64, error=SolveError, extent=1.0)


# Heights in, fields out.

HEIGHT, MODULUS, LOAD = 1e-6, 1e6, 1e-4
COSINE = np.cos(2 * np.pi * np.arange(32) / 32)
WAVE = HEIGHT * COSINE * np.ones((32, 1))
FULL = np.pi * MODULUS * HEIGHT / 32e-6  # pi E* h / wavelength: under this mean pressure a wave touches everywhere


def test_a_wave_under_more_than_its_pressure_of_full_contact_is_pressed_as_westergaard_says():
    answer = press(1e6 * WAVE, "1 um", "1 MPa", pressure=1.5 * FULL, unit="um", tolerance=1e-10)
    assert answer.measures["contact_fraction"] == 1
    pressure = answer.fields["pressure"]
    crest = np.argmax(pressure[0])
    np.testing.assert_allclose(pressure, FULL * (1.5 + np.roll(COSINE, crest)) * np.ones((32, 1)), rtol=1e-8)


def test_the_highest_point_touches_first():
    bump = np.zeros((32, 32))
    bump[20:24, 7:11] = HEIGHT
    pressure = press(bump, 1e-6, MODULUS, pressure=10.0).fields["pressure"]
    assert np.array_equal(pressure > 0, bump > 0)


def test_a_ball_is_pressed_as_hertz_says():
    x = 5e-6 * (np.arange(96) - 47.5)
    ball = (x**2 + x[:, None] ** 2) / 2e-2
    depth = (9 * LOAD**2 / (16 * MODULUS**2 * 1e-2)) ** (1 / 3)
    for given in ({"load": LOAD}, {"depth": depth}):
        answer = press(-ball, 5e-6, MODULUS, **given)
        assert (answer.depth, answer.normal_force) == pytest.approx((depth, LOAD), rel=2e-3)
        np.testing.assert_allclose(answer.fields["height"], ball, atol=1e-9)
