"""One draw of a rough surface carries exactly the spectrum that it was drawn from."""

from unittest import mock

import numpy as np
import pytest
from maps import squares_of_gaussians
from scipy.fft import irfft

from bem3d.surface import RoughSurface
from scene import SelfAffine
from scene.surfaces.topography import Waves

L = 10e-3
ROUNDING = 1e-10
LATTICE = 0.03  # relative, at H = 1: the longest waves are few and sit at the centres of their cells


def rough(**other):
    return SelfAffine(**{"hurst": 0.4, "rms_height": 5e-5, "longest": L, "shortest": L / 20, "seed": 7, **other})


def draw(roughness):
    return RoughSurface.draw(roughness, roughness.q_max(0.0))


def sampled(surface, n):
    axis = np.arange(n) * L / n
    return surface.heights(axis, axis)


@pytest.mark.parametrize("hurst", [0.0, 1.0])
def test_rms_height_over_a_period_is_exactly_that_of_the_spectrum(hurst):
    surface = draw(rough(hurst=hurst))
    heights = sampled(surface, 50)
    assert heights.mean() == pytest.approx(0, abs=5e-5 * ROUNDING)
    assert (heights.std(), surface.rms_height) == pytest.approx((5e-5, 5e-5), rel=ROUNDING)


@pytest.mark.parametrize("hurst", [0.0, 0.5, 1.0])
def test_rms_slope_follows_the_continuous_spectrum(hurst):
    r = rough(hurst=hurst, shortest=L / 60)
    assert draw(r).rms_slope == pytest.approx(r.rms_slope(r.q_max(0.0)), rel=LATTICE)


def test_the_longest_waves_have_the_power_of_their_cells():
    r, offsets = rough(), (np.arange(400) + 0.5) / 400 - 0.5
    power = np.abs(draw(r).amplitudes) ** 2

    def share(k_y, k_x):
        q = r.q_min * np.hypot(k_x + offsets[None, :], k_y + offsets[:, None])
        return power[len(power) // 2 + k_y, k_x] / r.density_2d(q, r.q_max(0.0)).mean()

    # of 64 points in a cell, where the density is cut off below the longest wave and where it is smooth
    for k, accuracy in (((0, 1), 0.05), ((1, 1), 0.05), ((0, 2), 2e-3)):
        assert share(*k) == pytest.approx(share(5, 6), rel=accuracy)


def test_gaussian_waves_keep_the_phases_and_scatter_about_the_fixed_ones():
    fixed, gaussian = draw(rough(shortest=L / 40)), draw(rough(shortest=L / 40, amplitudes="gaussian"))
    there = np.abs(fixed.amplitudes) > 0
    ratio = gaussian.amplitudes[there] / fixed.amplitudes[there]
    np.testing.assert_allclose(ratio.imag, 0.0, atol=ROUNDING)
    assert np.all(ratio.real > 0)
    squares_of_gaussians(ratio.real**2)


@pytest.mark.parametrize("amplitudes", ["fixed", "gaussian"])
def test_a_higher_cut_off_adds_detail_to_the_same_surface(amplitudes):
    # Ratio of Gaussian waves to fixed ones, as the rms height belongs to the whole spectrum.
    coarse, fine = (draw(rough(shortest=L / n, amplitudes=amplitudes)).amplitudes for n in (20, 40))
    bare = [np.abs(draw(rough(shortest=L / n)).amplitudes) for n in (20, 40)]
    top = coarse.shape[1] - 1
    same, inner = bare[0] > 0, np.s_[top : 3 * top + 1, : top + 1]
    np.testing.assert_allclose(
        fine[inner][same] / bare[1][inner][same], coarse[same] / bare[0][same], atol=ROUNDING
    )


@pytest.mark.parametrize("height", [1e-300, 1e180])
def test_heights_whose_squares_are_no_numbers_are_drawn_in_proportion_and_have_a_mean_square(height):
    surface, one = draw(rough(rms_height=height)), draw(rough(rms_height=1.0))
    np.testing.assert_allclose(surface.amplitudes / height, one.amplitudes, rtol=ROUNDING)
    assert (surface.rms_height, surface.rms_slope) == pytest.approx((height, height * one.rms_slope), rel=1e-12)


@pytest.mark.parametrize("points", [(16, 16), (8, 8), (6, 7), (5, 9)])
def test_on_a_period_one_transform_sums_the_waves_that_the_points_resolve_and_those_they_do_not(points):
    rng, (ny, nx) = np.random.default_rng(0), points
    amplitudes = rng.standard_normal((17, 12)) + 1j * rng.standard_normal((17, 12))
    surface = RoughSurface(Waves(2 * np.pi / 3, 2 * np.pi / 2, amplitudes))
    x, y = 0.3 + 3 / nx * np.arange(nx), 2 / ny * np.arange(ny) - 0.7
    alone = np.block([[surface.heights(x[[i]], y[[j]]) for i in range(nx)] for j in range(ny)])
    with mock.patch("bem3d.surface.irfft", wraps=irfft) as transform:
        np.testing.assert_allclose(surface.heights(x, y), alone, atol=1e-12 * np.abs(amplitudes).sum())
    assert transform.call_count == 1
