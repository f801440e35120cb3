"""The Fourier door: products on a free surface are plain sums, whatever the grid."""

import numpy as np
import pytest

from bem3d.convolution import FreeConvolution, PeriodicFilter, autocorrelation

ROUNDING = 1e-12


SHAPES = [(8, 8), (7, 11), (13, 6), (1, 5)]


@pytest.mark.parametrize("even", [False, True])
@pytest.mark.parametrize(("ny", "nx"), SHAPES)
def test_product_equals_the_direct_sum_without_wrapping_around(ny, nx, even):
    rng = np.random.default_rng(1)
    kernel, pressure = rng.random((ny, 2 * nx)), rng.random((ny, nx))
    if even:
        kernel[:, 1:nx] = kernel[:, :nx:-1]
    expected = np.zeros((ny, nx))
    for row in range(ny):
        for column in range(nx):
            for j in range(ny):
                for i in range(nx):
                    expected[row, column] += kernel[abs(row - j), nx + column - i] * pressure[j, i]
    convolution = FreeConvolution.of(kernel)
    np.testing.assert_allclose(convolution(pressure), expected, rtol=ROUNDING)
    np.testing.assert_allclose(convolution(2 * pressure), 2 * expected, rtol=ROUNDING)
    assert convolution.operator_applications == 2


@pytest.mark.parametrize(("ny", "nx"), SHAPES)
def test_autocorrelation_is_the_direct_sum_over_pairs_of_points(ny, nx):
    plane = np.random.default_rng(2).standard_normal((ny, nx))
    expected = np.zeros((ny, nx))
    for j in range(ny):
        for i in range(nx):
            here, aside, beyond = plane[: ny - j, : nx - i], plane[j:, i:], plane[j:, : nx - i]
            expected[j, i] = np.sum(here * aside) + (np.sum(plane[: ny - j, i:] * beyond) if j else 0.0)
    np.testing.assert_allclose(autocorrelation(plane), expected, atol=ROUNDING * nx * ny)


def test_periodic_filter_multiplies_each_wave_by_its_symbol():
    ny, nx = 12, 10
    y, x = np.mgrid[:ny, :nx]
    wave = np.cos(2 * np.pi * (3 * x / nx - 2 * y / ny))
    filtered = PeriodicFilter((ny, nx), lambda q_y, q_x: q_x**2 + q_y**2 + 0j)(wave)
    q2 = (2 * np.pi * 3 / nx) ** 2 + (2 * np.pi * 2 / ny) ** 2
    np.testing.assert_allclose(filtered, q2 * wave, atol=ROUNDING)
