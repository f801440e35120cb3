"""Products are plain sums, whatever the grid, the library and the precision."""

import numpy as np
import pytest

from bem3d import BEM
from bem3d.grid import Grid
from bem3d.response import cerruti, influence
from bem3d.response.convolution import FreeConvolution, PeriodicFilter
from bem3d.response.engine import Engine
from scene import Cylinder, Kelvin, Plane, Scene, SelfAffine, Slide, Sphere

ROUNDING = 1e-12
SINGLE = 2e-6  # of the largest value: 2^-23 summed over a transform
ROUGH = SelfAffine(hurst=0.8, rms_height=2e-6, longest=1e-3, shortest=1e-4, seed=1)
CELL = Scene(Plane(), Kelvin(1e6, 1e-3), Slide(speed=0.01, pressure=2e4), ROUGH)
BODY = Scene(Sphere(1e-2), Kelvin(1e6, 1e-3), Slide(speed=0.1, load=0.1))


def products(engine):
    """A convolution in flow and a filter, on sides that are even, odd and prime, and pairs of planes."""
    for ny, nx in ((16, 16), (17, 12), (1, 31)):
        yield (ny, nx), FreeConvolution.of(influence.retarded(nx, ny, 3.0, 0.25), engine)
        yield (ny, nx), PeriodicFilter((ny, nx), lambda q_y, q_x: (1 + q_y**2) / (1 + 1j * q_x), engine)
    for points in (16, 17):
        for kind in (cerruti.free, cerruti.periodic):
            yield (2, points, points), kind(Grid(points, 1.0), 0.3, engine)


@pytest.mark.parametrize(
    ("other", "accuracy"),
    [
        (Engine("fftw"), ROUNDING),
        (Engine("ducc0", threads=2), ROUNDING),
        (Engine("ducc0", precision="single"), SINGLE),
        (Engine("fftw", threads=2, precision="single"), SINGLE),
    ],
)
def test_every_library_gives_the_same_products(other, accuracy):
    rng = np.random.default_rng(0)
    for (shape, product), (_, another) in zip(products(Engine()), products(other), strict=True):
        plane, out = rng.standard_normal(shape), np.empty(shape)
        expected = product(plane)
        np.testing.assert_allclose(another(plane), expected, rtol=0, atol=accuracy * np.abs(expected).max())
        for each in (another, product):
            assert each(plane, out) is out
        np.testing.assert_array_equal(out, expected)


def test_padded_sizes_are_even_products_of_small_primes_and_close():
    for least in (1, 7, 31, 97, 1021, 2039):
        size = Engine().good_size(least)
        assert least <= size <= 1.2 * least + 2
        assert size % 2 == 0
        for factor in (2, 3, 5):
            while size % factor == 0:
                size //= factor
        assert size == 1


@pytest.mark.parametrize("scene", [CELL, BODY], ids=["cell", "body"])
def test_single_precision_keeps_five_digits_of_friction(scene):
    double, single = (BEM(points=64, precision=precision).solve(scene) for precision in ("double", "single"))
    assert single.friction_coefficient == pytest.approx(double.friction_coefficient, rel=1e-4)
    assert single.depth == pytest.approx(double.depth, rel=1e-5)
    assert single.friction_coefficient != double.friction_coefficient


def test_a_line_is_solved_in_double_whatever_the_precision_asked_for():
    scene = Scene(Cylinder(1e-2), BODY.elastomer, Slide(speed=0.1, line_load=100.0))
    single, double = (BEM(points=64, precision=precision).solve(scene) for precision in ("single", "double"))
    assert single.friction_coefficient == double.friction_coefficient
    assert single.settings["precision"] == "double"


@pytest.mark.parametrize("even", [False, True])
@pytest.mark.parametrize("shape", [(8, 8), (7, 11), (13, 6), (1, 5)])
def test_product_equals_the_direct_sum_without_wrapping_around(shape, even):
    rng, nx = np.random.default_rng(1), shape[1]
    kernel, pressure = rng.random((shape[0], 2 * nx)), rng.random(shape)
    if even:
        kernel[:, 1:nx] = kernel[:, :nx:-1]
    row, column = (index.ravel() for index in np.indices(shape))
    matrix = kernel[abs(row[:, None] - row), nx + column[:, None] - column]
    expected, convolution = (matrix @ pressure.ravel()).reshape(shape), FreeConvolution.of(kernel)
    np.testing.assert_allclose(convolution(pressure), expected, rtol=ROUNDING)
    np.testing.assert_allclose(convolution(2 * pressure), 2 * expected, rtol=ROUNDING)
    assert convolution.operator_applications == 2


def test_periodic_filter_multiplies_each_wave_by_its_symbol():
    (y, x), q_y, q_x = np.mgrid[:12, :10], -4 * np.pi / 12, 6 * np.pi / 10
    wave = np.cos(q_x * x + q_y * y)
    filtered = PeriodicFilter((12, 10), lambda q_y, q_x: q_x**2 + q_y**2 + 0j)(wave)
    np.testing.assert_allclose(filtered, (q_y**2 + q_x**2) * wave, atol=ROUNDING)
