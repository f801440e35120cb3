"""The kernels are integrals of 1/r; whatever computes them must agree with quadrature of the definition."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import dblquad, quad

from bem3d import influence

KERNEL = 3e-5  # of the kernel's peak: local Gauss rule with a logarithmic edge inside, 2e-5 at worst
ROUNDING = 1e-12


def love(x, y):
    """Displacement by unit pressure on the unit pixel, one integral of 1/(pi r) analytic, one numerical."""

    def along_x(v):
        return np.arcsinh((x + 0.5) / v) - np.arcsinh((x - 0.5) / v) if v else np.inf

    edges = sorted({y - 0.5, y + 0.5, *(p for p in (0.0,) if abs(y) < 0.5)})
    return sum(quad(lambda v: along_x(abs(v)), *piece, epsabs=1e-13)[0] for piece in pairwise(edges)) / np.pi


def test_elastic_kernel_is_the_integral_of_one_over_r():
    kernel = influence.elastic(6, 6)
    assert kernel[0, 6] == pytest.approx(4 * np.log(1 + np.sqrt(2)) / np.pi, rel=ROUNDING)
    for i, j in ((1, 1), (-3, 2), (5, 0)):
        assert kernel[j, 6 + i] == pytest.approx(
            dblquad(lambda v, u: 1 / np.hypot(u, v), i - 0.5, i + 0.5, j - 0.5, j + 0.5, epsabs=1e-12)[0] / np.pi,
            rel=1e-9,
        )


@pytest.mark.parametrize("length", [0.01, 0.3, 1.0, 10.0, 1e3, 1e5])
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
            quad(remembered, *piece, args=(x, j), epsabs=1e-10, limit=200)[0] for piece in pairwise(breaks)
        )
        assert kernel[j, 16 + i] == pytest.approx(expected, abs=KERNEL * kernel.max())


def test_retarded_kernel_tends_to_the_elastic_one_when_the_memory_is_short():
    elastic = influence.elastic(16, 16)
    retarded = influence.retarded(16, 16, 1e-8, 0.0)
    np.testing.assert_allclose(retarded, elastic, rtol=1e-6)


def test_far_downstream_a_short_memory_only_delays_the_elastic_kernel_by_its_length():
    length = 0.5
    delayed = influence.retarded(40, 4, length, 0.0)[0, 40 + 30]
    assert delayed == pytest.approx(1 / np.pi / (30 - length), rel=2e-3)
