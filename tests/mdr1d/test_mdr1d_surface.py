"""The rough line: its spectrum, its heights, and what of it depends on the grid."""

from dataclasses import replace
from math import sqrt

import numpy as np
import pytest
from maps import squares_of_gaussians

from bem3d.surface import RoughSurface
from mdr1d import amplitudes, draw
from mdr1d.surface import nodes_needed
from scene import SelfAffine

ROUGH = SelfAffine(hurst=0.4, rms_height=5e-5, longest=1e-2, shortest=5e-5)
ROUNDING = 1e-12
# Standard errors of a mean over random draws.
SIGMAS = 4


@pytest.mark.parametrize(("hurst", "shortest"), [(0.0, None), (0.4, 4.7e-5), (1.0, 5e-5)])
def test_the_rms_height_is_exact_on_every_grid(hurst, shortest):
    rough = replace(ROUGH, hurst=hurst, shortest=shortest)
    for nodes in (427, 428):
        surface = draw(rough, nodes)
        assert surface.rms_height == pytest.approx(5e-5, rel=ROUNDING)
        assert surface.heights.size == nodes
        assert surface.period == pytest.approx(1e-2, rel=ROUNDING)


@pytest.mark.parametrize("hurst", [0.0, 1.0])
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
    coarse, fine, other = draw(ROUGH, 500), draw(ROUGH, 4000), draw(replace(ROUGH, seed=1), 500)
    # Two independent draws: correlation of the order of 1 over the root of the number of strong waves, a few.
    assert abs(np.corrcoef(coarse.heights, other.heights)[0, 1]) < 0.9
    np.testing.assert_allclose(fine.heights[::8], coarse.heights, atol=ROUNDING * 1e-2)


def test_a_later_cut_off_adds_waves_and_keeps_the_phases_of_the_others_as_does_a_line_scan():
    near = np.fft.rfft(draw(ROUGH, 1000).heights)[1:190]
    for other in (draw(replace(ROUGH, shortest=2.5e-5), 1000), draw(ROUGH, 1000, "line-scan")):
        np.testing.assert_allclose(np.angle(near / np.fft.rfft(other.heights)[1:190]), 0.0, atol=1e-9)


def test_the_spectrum_ends_at_its_cut_off_without_loss_between_two_waves():
    for bandwidth in (2.0, 2.4, 2.6, 3 - 1e-15):
        waves = amplitudes(ROUGH, bandwidth)
        assert waves.size == int(bandwidth + 1e-9)
        assert np.all(waves > 0)
        assert sqrt(np.sum(waves**2) / 2) == pytest.approx(5e-5, rel=ROUNDING)


@pytest.mark.parametrize("spectrum", ["mapped", "line-scan"])
def test_gaussian_waves_keep_the_phases_and_have_rayleigh_moduli(spectrum):
    rough = replace(ROUGH, shortest=4e-6)
    fixed, gaussian = (draw(replace(rough, amplitudes=kind), 10_000, spectrum) for kind in ("fixed", "gaussian"))
    a, b = (np.fft.rfft(s.heights)[1:2400] for s in (fixed, gaussian))
    np.testing.assert_allclose(np.angle(b / a), 0.0, atol=1e-6)
    squares_of_gaussians((gaussian.amplitudes / fixed.amplitudes) ** 2)


def test_a_gaussian_wave_at_the_nyquist_wave_number_is_a_gaussian_height_of_its_variance():
    rough = replace(ROUGH, hurst=0.0, shortest=None, amplitudes="gaussian")
    heights = np.array([draw(replace(rough, seed=s), 10).heights for s in range(2000)])
    last = heights @ (-1.0) ** np.arange(10) / 10
    variance = amplitudes(rough, 5.0)[-1] ** 2 / 2
    assert np.mean(last**2) == pytest.approx(variance, rel=SIGMAS * sqrt(2 / 2000))
    assert np.mean(last**4) == pytest.approx(3 * variance**2, rel=SIGMAS * sqrt(96 / 9 / 2000))


@pytest.mark.parametrize(("hurst", "rolloff"), [(0.0, 2e-3), (0.8, None)])
def test_a_line_scan_lacks_the_height_of_what_is_longer_than_two_periods(hurst, rolloff):
    rough = replace(ROUGH, hurst=hurst, rolloff=rolloff)
    top = rough.q_max(0.0)
    surface = draw(rough, 2000, "line-scan")
    kept = rough.share_line_scan(rough.q_min / 2, top, top)
    assert surface.rms_height == pytest.approx(5e-5 * sqrt(kept), rel=ROUNDING)
    # A wave as long as the period loses a third: arcsin(1/2) of a quarter turn. Shorter ones lose less.
    assert 2 / 3 < kept < 1
    # Half the square of the full gradient; below 3/2 of the first wave the cell stands for it.
    assert surface.rms_slope_spectral == pytest.approx(rough.rms_slope(top) / sqrt(2), rel=0.03)


@pytest.mark.parametrize("hurst", [0.0, 0.8])
def test_a_line_scan_has_the_waves_of_a_cut_through_the_rough_surface(hurst):
    rough = replace(ROUGH, hurst=hurst)
    cut = np.sum(np.abs(RoughSurface.draw(rough, rough.q_max(0.0)).amplitudes) ** 2, axis=0)[1:]
    waves = amplitudes(rough, 200.0, "line-scan") ** 2
    # The lattice of the surface stands for a continuum. Measured: 2.6 % from k = 5 on, short of the cut-off.
    np.testing.assert_allclose(cut[4:190], waves[4:190], rtol=0.05)
    mapped = amplitudes(rough, 200.0) ** 2
    assert hurst == 0 or np.all(mapped[4:100] > 1.2 * cut[4:100])


def test_the_shortest_wave_asks_for_two_nodes():
    rough = SelfAffine(hurst=0.5, rms_height=1e-6, longest=1e-2, shortest=1e-4)
    assert nodes_needed(rough) == 200
    # 100/3 is rounded up, and a quotient that is whole but for rounding is not.
    assert nodes_needed(replace(rough, shortest=3e-4)) == 67
    assert nodes_needed(replace(rough, longest=0.3, shortest=0.1)) == 6
