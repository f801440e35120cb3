"""Heights in, fields out."""

import numpy as np
import pytest

from bem3d import press
from scene import Sphere
from scene.files.reading import InvalidInput

HEIGHT, MODULUS = 1e-6, 1e6
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


def test_a_flat_map_on_a_sphere_is_pressed_as_hertz_says():
    answer = press(np.zeros((32, 32)), 1e-5, MODULUS, Sphere(1e-2), load=0.01, points=128)
    assert answer.depth == pytest.approx((9 * 0.01**2 / (16 * MODULUS**2 * 1e-2)) ** (1 / 3), rel=2e-3)


@pytest.mark.parametrize("heights, pixel", [(WAVE[:16], 1e-6), (WAVE, (1e-6, 2e-6))])
def test_a_plane_of_no_square_map_is_refused(heights, pixel):
    with pytest.raises(InvalidInput, match="heights of .* x 32 pixels"):
        press(heights, pixel, MODULUS, pressure=1.0)
