"""Cerruti's kernels: means over pixels, waves, and products of two planes with a matrix of them."""

import numpy as np
import pytest
from maps import noise

from bem3d.grid import Grid
from bem3d.response import cerruti, influence
from bem3d.response.engine import Engine

ROUNDING = 1e-12
PEAK = 1e-12  # of the greatest value: what the form of distant pixels leaves out, 100 pixels away
NU = 0.3


@pytest.mark.parametrize(("j", "i"), [(0, 1), (2, 5), (99, 99), (100, 100), (3, 120), (150, 20)])
def test_kernels_are_means_over_pixels(j, i):
    node, weight = np.polynomial.legendre.leggauss(30)
    x, y, both = i + node[None, :] / 2, j + node[:, None] / 2, weight[None, :] * weight[:, None] / 4
    along, across = cerruti.kernels(160)
    for kernel, part in ((along, x * x), (across, x * y)):
        expected = (both * part / np.hypot(x, y) ** 3).sum() / np.pi
        assert kernel[j, i] == pytest.approx(expected, abs=PEAK)


def test_both_directions_together_are_loves_kernel():
    along, _ = cerruti.kernels(160)
    np.testing.assert_allclose(along + along.T, influence.elastic(160, 160)[:, 160:], atol=PEAK)


@pytest.mark.parametrize("points", [8, 9])
def test_a_free_product_is_the_sum_over_pairs_of_pixels(points):
    (along, across), c, given = cerruti.kernels(points), NU / (1 - NU), noise((2, points, points))
    expected = np.zeros_like(given)
    for j, i, row, column in np.ndindex(points, points, points, points):
        dy, dx = abs(row - j), abs(column - i)
        aside, mixed = along[dx, dy], c * across[dy, dx] * np.sign((row - j) * (column - i))
        matrix = np.array([[(1 + c) * along[dy, dx] + aside, mixed], [mixed, along[dy, dx] + (1 + c) * aside]])
        expected[:, row, column] += matrix @ given[:, j, i]
    product = cerruti.free(Grid(points, 1.0), NU, Engine())
    np.testing.assert_allclose(product(given), expected, atol=ROUNDING * np.abs(expected).max())
    assert product.operator_applications == 2


@pytest.mark.parametrize("points", [12, 15])
def test_a_wave_of_traction_displaces_along_its_crests_more_than_across(points):
    y, x = np.mgrid[:points, :points]
    q = 2 * np.pi / points * np.array([3, -2])
    wave = np.cos(q[0] * x + q[1] * y)
    product = cerruti.periodic(Grid(points, 1.0), NU, Engine())
    across, along = q / np.hypot(*q), np.array([-q[1], q[0]]) / np.hypot(*q)
    for direction, factor in ((across, 1.0), (along, 1 / (1 - NU))):
        expected = direction[:, None, None] * wave * factor * 2 / np.hypot(*q)
        np.testing.assert_allclose(product(direction[:, None, None] * wave), expected, atol=ROUNDING * 10)
    even = np.ones((2, points, points))
    np.testing.assert_allclose(product(even), 0.0, atol=ROUNDING)


def test_on_odd_grids_the_approximate_inverse_of_a_cell_is_exact():
    grid, given = Grid(15, 1.0), noise((2, 15, 15))
    given -= given.mean(axis=(1, 2), keepdims=True)
    image = cerruti.preconditioner(grid, NU, Engine())(cerruti.periodic(grid, NU, Engine())(given))
    np.testing.assert_allclose(image, given, atol=ROUNDING * 10)
