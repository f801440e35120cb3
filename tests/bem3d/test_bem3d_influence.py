"""The kernels are integrals of 1/r; whatever computes them must agree with quadrature of the definition."""

from itertools import pairwise
from math import asinh

import numpy as np
import pytest
from scipy.integrate import quad

from bem3d.response import influence

KERNEL = 1e-9  # of the kernel's peak: the quadrature here; against panels in extended precision it is 1e-11
ROUNDING = 1e-12


def love(x, y):
    """Displacement by unit pressure on the unit pixel: Johnson, Contact Mechanics (1985), Eq. 3.25."""

    def corner(x, y):
        return x * asinh(y / abs(x)) + y * asinh(x / abs(y)) if x and y else 0.0

    return sum(s * t * corner(x + s / 2, y + t / 2) for s in (1, -1) for t in (1, -1)) / np.pi


def test_the_elastic_kernel_of_a_pixel_on_itself_is_loves():
    """Those on others are the sum of Cerruti's, see test_bem3d_tangential_kernels.py."""
    assert influence.elastic(6, 6)[0, 6] == pytest.approx(4 * np.log(1 + np.sqrt(2)) / np.pi, rel=ROUNDING)


@pytest.mark.parametrize("length", [0.01, 1.0, 1e3])
def test_retarded_kernel_is_the_elastic_one_remembered_along_the_flow(length):
    shift = 0.5 * np.tanh(length)
    kernel = influence.retarded(16, 16, length, shift)

    def remembered(t, x, j):
        return np.exp(-t) * love(x - length * t, j)

    for i, j in ((-15, 0), (-2, 1), (0, 0), (1, 0), (1, 1), (9, 3), (15, 15)):
        x = i + shift
        kinks = [k / length for k in (x - 0.5, x + 0.5) if 0 < k / length < 40]
        breaks = sorted({0.0, *np.geomspace(min(1.0, 1 / length) * 1e-3, 40, 12), *kinks})
        expected = sum(
            quad(remembered, *piece, args=(x, j), epsabs=1e-11, epsrel=1e-11, limit=200)[0]
            for piece in pairwise(breaks)
        )
        assert kernel[j, 16 + i] == pytest.approx(expected, abs=KERNEL * kernel.max())


LENGTHS = np.geomspace(1e-4, 1e7, 12)
SHARES = np.linspace(1.0, 2.0, 12) / 18


def graded(start, end, kinks):
    """Gauss panels that halve towards every kink."""
    steps = 2.0 ** np.arange(-70, 50)
    cuts = np.concatenate([[start, end], *(k + sign * steps for k in kinks for sign in (1, -1)), list(kinks)])
    cuts = np.unique(cuts[(cuts >= start) & (cuts <= end)])
    x, w = np.polynomial.legendre.leggauss(16)
    half = np.diff(cuts)[:, None] / 2
    return (cuts[:-1, None] + half * (x + 1)).ravel(), (half * w).ravel()


def remembered_line(x, length):
    """Mean of ln|u| over the pixel at x - s, remembered: mean over s by panels, mean over the pixel as well."""
    s, weights = graded(0.0, 45 * length, [0.0, *(k for k in (x - 0.5, x + 0.5) if k > 0)])
    return np.sum(weights * mean_log(x - s) * np.exp(-s / length) / length)


def mean_log(x):
    def primitive(u):
        return u * np.log(np.where(u == 0, 1, np.abs(u)))

    far = np.abs(x) > 50
    safe = np.where(far, 0.0, x)
    distant = np.log(np.abs(np.where(far, x, 1.0))) - 1 / (24 * np.where(far, x, 1.0) ** 2)
    return np.where(far, distant, primitive(safe + 0.5) - primitive(safe - 0.5) - 1)


@pytest.mark.parametrize(("length", "shift"), [(1e-9, 0.0), (0.3, 0.5), (30.0, 0.2), (1e9, 0.5)])
def test_the_first_column_of_the_retarded_kernel_is_there_at_every_memory(length, shift):
    """Far upstream a pixel is a point: 1/r remembered, with the pixel's moment."""
    n = 24
    kernel = influence.retarded(n, n, length, shift)
    s, weights = graded(0.0, 45 * length, [0.0])
    r = np.hypot(shift - n - s, 5)
    # The next moment of the pixel is 0.01/r^4 of its load.
    expected = np.sum(weights * (1 / r + 1 / (24 * r**3)) * np.exp(-s / length) / length) / np.pi
    assert kernel[5, 0] == pytest.approx(expected, rel=1e-7)


def test_a_solid_is_the_sum_of_its_modes():
    expected = 0.25 * influence.elastic(48, 40, 0.2)
    for share, length in zip(SHARES, LENGTHS, strict=True):
        expected = expected + share * influence.retarded(48, 40, length, 0.2)
    kernel = influence.flowing(48, 40, 0.25, SHARES, LENGTHS, 0.2)
    np.testing.assert_allclose(kernel, expected, rtol=ROUNDING)


def test_exact_and_distant_forms_meet():
    distant, origin = np.array([101.0, -150.0]), np.zeros((1, 1))
    far = influence.by_pixel(distant, origin, 60)[0]
    near = influence.by_pixel(np.append(distant, 0.0), origin, 60)[0, :2]  # one column near: all exact
    assert np.any(near != far)
    np.testing.assert_allclose(near, far, rtol=1e-8)


@pytest.mark.parametrize("length", [1e-9, 0.6, 9.0, 11.0, 1e6])
@pytest.mark.parametrize("shift", [0.0, 0.3])
def test_line_kernel_is_the_logarithm_remembered_along_the_flow(length, shift):
    n, datum = 12, 7.0
    elastic = influence.line(n, datum, shift)
    kernel = influence.line_flowing(n, 0.3, [0.7], [length], shift, datum)
    assert elastic.shape == kernel.shape == (1, 2 * n)
    for i in (-12, -2, -1, 0, 1, 2, 11):
        x = i + shift
        assert elastic[0, n + i] == pytest.approx(-2 / np.pi * (mean_log(x) - np.log(datum)), rel=ROUNDING)
        expected = 0.3 * mean_log(x) + 0.7 * remembered_line(x, length) - np.log(datum)
        assert kernel[0, n + i] == pytest.approx(-2 / np.pi * expected, abs=1e-11)


@pytest.mark.parametrize(
    "kernel", [influence.elastic(150, 120), influence.line(150, 3.0)], ids=["elastic", "line"]
)
def test_kernels_without_memory_of_direction_are_even_to_the_last_digit(kernel):
    np.testing.assert_array_equal(kernel[:, 151:], kernel[:, 149:0:-1])
