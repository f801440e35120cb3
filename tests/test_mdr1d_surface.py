"""The rough line: its spectrum, its heights, and what of it depends on the grid."""

from dataclasses import replace
from math import pi, sqrt

import numpy as np
import pytest

from mdr1d import amplitudes, draw
from scene import SelfAffine

ROUGH = SelfAffine(hurst=0.4, rms_height=5e-5, longest=1e-2, shortest=5e-5)
ROUNDING = 1e-12


@pytest.mark.parametrize("hurst", [0.0, 0.4, 0.8, 1.0])
@pytest.mark.parametrize("shortest", [None, 5e-5, 4.7e-5])
def test_the_rms_height_is_exact_on_every_grid(hurst, shortest):
    rough = replace(ROUGH, hurst=hurst, shortest=shortest)
    for nodes in (427, 428, 5000):
        surface = draw(rough, nodes)
        assert surface.rms_height == pytest.approx(5e-5, rel=ROUNDING)
        assert surface.heights.size == nodes
        assert surface.period == pytest.approx(1e-2, rel=ROUNDING)


@pytest.mark.parametrize("hurst", [0.0, 0.4, 0.8, 1.0])
@pytest.mark.parametrize("shortest", [None, 5e-5])
def test_the_rms_slope_is_that_of_the_spectrum(hurst, shortest):
    rough = replace(ROUGH, hurst=hurst, shortest=shortest)
    surface = draw(rough, 5000)
    # The waves sit at the centres of their cells, where q^2 is below its mean over the cell; the first is half.
    assert surface.rms_slope_spectral == pytest.approx(rough.rms_slope(2 * pi / surface.shortest), rel=0.03)


def test_finite_differences_reach_the_spectral_slope_on_a_fine_grid():
    fine, coarse = draw(ROUGH, 200_000), draw(ROUGH, 1600)
    assert fine.rms_slope == pytest.approx(fine.rms_slope_spectral, rel=1e-4)
    # Eight points on the shortest wave: it loses 1 - sinc(1/8) = 2.6 %, all others less.
    assert 0.974 < coarse.rms_slope / coarse.rms_slope_spectral < 0.995
    # At the Nyquist cut-off the last wave alone loses 1 - 2/pi.
    nyquist = draw(replace(ROUGH, shortest=None), 5000)
    assert 0.83 < nyquist.rms_slope / nyquist.rms_slope_spectral < 0.89


@pytest.mark.parametrize("hurst", [0.0, 0.4, 1.0])
def test_the_periodogram_follows_the_density(hurst):
    rough = replace(ROUGH, hurst=hurst)
    power = np.abs(np.fft.rfft(draw(rough, 3000).heights, norm="forward")) ** 2
    k = np.arange(power.size)
    q = k * rough.q_min
    inner = (k >= 5) & (k <= 195)
    expected = rough.density_1d(q[inner], rough.q_max(0.0)) * rough.q_min
    # Two-sided power; a cell's mean exceeds its mid-point value by p (p - 1) / (24 k^2) for q^p: 2 % at k = 5.
    np.testing.assert_allclose(power[inner], expected, rtol=0.021)
    outside = (k == 0) | (k > 200)
    assert power[outside].max() <= ROUNDING * power[inner].min()


def test_the_same_seed_and_cut_off_give_the_same_surface_on_every_grid():
    coarse, fine = draw(ROUGH, 500), draw(ROUGH, 4000)
    np.testing.assert_allclose(fine.heights[::8], coarse.heights, atol=ROUNDING * 1e-2)


def test_a_later_cut_off_adds_waves_and_keeps_the_phases_of_the_others():
    near, far = draw(ROUGH, 1000), draw(replace(ROUGH, shortest=2.5e-5), 1000)
    a, b = (np.fft.rfft(s.heights)[1:190] for s in (near, far))
    np.testing.assert_allclose(np.angle(a / b), 0.0, atol=1e-9)


def test_seeds_differ_and_repeat():
    first, again, other = (draw(replace(ROUGH, seed=s), 1000).heights for s in (1, 1, 2))
    np.testing.assert_array_equal(first, again)
    # Two independent draws: correlation of the order of one over the root of the few strong waves.
    assert abs(np.corrcoef(first, other)[0, 1]) < 0.9


def test_heights_are_symmetric_over_many_draws():
    heights = np.array([draw(replace(ROUGH, seed=s), 400).heights for s in range(300)])
    skewness = np.mean(heights**3) / np.mean(heights**2) ** 1.5
    # 300 draws of some ten independent heights each.
    assert abs(skewness) < 4 * sqrt(15 / 3000)
    np.testing.assert_allclose(heights.mean(axis=0), 0.0, atol=5 * 5e-5 / sqrt(300))


def test_the_spectrum_ends_at_its_cut_off_without_loss_between_two_waves():
    for bandwidth in (2.0, 2.4, 2.6, 2.999, 3.0, 3 - 1e-15, 1000.7):
        waves = amplitudes(ROUGH, bandwidth)
        assert waves.size == int(bandwidth + 1e-9)
        assert np.all(waves > 0)
        assert sqrt(np.sum(waves**2) / 2) == pytest.approx(5e-5, rel=ROUNDING)
