"""Lines of a measured map: the rule of the MDR as an exact sum over its waves, and rows that are its rows."""

from dataclasses import replace

import numpy as np
import pytest
from maps import noise, sampled
from sliding import ORDINARY as SLIDING

import mdr1d.topography
from bem3d.grid import Grid
from mdr1d import MDR, draw
from mdr1d.surface import band_of
from mdr1d.topography import amplitudes
from scene import Refused, SelfAffine, Topography

ROUGH = SelfAffine(hurst=0.8, rms_height=2e-6, longest=4e-3, shortest=0.25e-3, seed=3)
ROUNDING = 1e-12


def rough(shape, **other):
    return Topography(**{"heights": noise(shape, 1), "pixel": 1e-3, "level": "mean", "peaks": "down"} | other)


@pytest.mark.parametrize("repeat", ["mirror", "periodic"])
@pytest.mark.parametrize(("shape", "kept"), [((9, 9), None), ((8, 15), 2.5e-3), ((30, 6), None)])
def test_a_mapped_line_keeps_the_mean_square_of_the_map(repeat, shape, kept):
    map_ = rough(shape, repeat=repeat, shortest_kept=kept)
    found = amplitudes(map_)
    assert np.sum(found**2) / 2 == pytest.approx(map_.rms_height**2, rel=ROUNDING)
    line = draw(map_, 4 * len(found))
    assert line.period == pytest.approx(map_.period)
    assert line.rms_height == pytest.approx(map_.rms_height, rel=1e-9)


def test_a_mapped_line_has_each_wave_of_the_map_at_its_own_wave_number():
    # waves at (3, 4), (5, 0) and (0, 2) of a period: five, five and two of the line
    grid = Grid(32, 1.0)
    x, y = 2 * np.pi * grid.x, 2 * np.pi * grid.y[:, None]
    map_ = Topography(
        heights=3 * np.cos(3 * x + 4 * y) + 4 * np.sin(5 * x) + 2 * np.cos(2 * y),
        pixel=grid.pixel,
        level="mean",
        repeat="periodic",
    )
    found = amplitudes(map_)
    assert (found[4], found[1]) == pytest.approx((5.0, 2.0))
    assert np.abs(np.delete(found, [1, 4])).max() < 1e-12


@pytest.mark.parametrize("repeat", ["mirror", "periodic"])
@pytest.mark.parametrize("shape", [(8, 15), (9, 8)])
@pytest.mark.parametrize("seed", [0, 1, 7])
def test_a_scanned_line_is_a_row_of_the_map(repeat, shape, seed):
    map_ = rough(shape, repeat=repeat, seed=seed)
    rows, columns = shape
    across, up = map_.place
    row = map_.relief[rows // 2 + up]
    # twice as many nodes as pixels: the tip lies on a pixel of an odd number of columns, or between two
    nodes = 2 * columns * (2 if repeat == "mirror" else 1)
    line = draw(map_, nodes, "line-scan")
    pixels = np.arange(columns) - across - (columns - 1) / 2
    found = line.heights[np.round(2 * pixels).astype(int) % nodes]
    np.testing.assert_allclose(found, row - row.mean(), atol=1e-12)
    assert line.heights.mean() == pytest.approx(0.0, abs=ROUNDING)
    assert line.period == pytest.approx(map_.sides[0])


def test_on_as_many_nodes_as_pixels_a_row_is_whole():
    # the wave of two pixels included, which has one value at each node
    even = rough((9, 8), repeat="periodic")
    assert band_of(even, "line-scan").nodes == 8
    kept = rough((12, 12), repeat="periodic", shortest_kept=3e-3)
    assert band_of(kept, "line-scan").nodes == 8
    for each in (even, kept):
        coarse, fine = draw(each, 8, "line-scan").heights, draw(each, 16, "line-scan").heights
        np.testing.assert_allclose(coarse, fine[::2], atol=1e-12)


def test_seeds_are_lines_and_equal_seeds_are_equal():
    map_ = sampled(ROUGH, 64)
    for spectrum in ("mapped", "line-scan"):
        one, twin, other = (draw(replace(map_, seed=seed), 200, spectrum).heights for seed in (3, 3, 4))
        assert np.array_equal(one, twin)
        assert not np.allclose(one, other)


def test_measures_are_those_of_the_line():
    map_ = sampled(ROUGH, 64)
    answer = MDR(points=2000).solve(replace(SLIDING, roughness=map_))
    assert answer.measures["rms_height"] == pytest.approx(map_.rms_height, rel=1e-9)
    assert answer.settings["cutoff"] == "resolved"
    row = MDR(points=2000, spectrum="line-scan").solve(replace(SLIDING, roughness=map_))
    relief = map_.relief[32] - map_.relief[32].mean()
    assert row.measures["rms_height"] == pytest.approx(relief.std(), rel=1e-6)


def test_a_grid_too_coarse_for_a_map_is_refused():
    with pytest.raises(Refused, match="is not resolved"):
        MDR(points=16, extent=4e-3).solve(replace(SLIDING, roughness=sampled(ROUGH, 64)))


def test_amplitudes_are_summed_once_for_all_seeds(monkeypatch):
    calls = []
    summed = mdr1d.topography.amplitudes
    monkeypatch.setattr(mdr1d.topography, "amplitudes", lambda map_: calls.append(1) or summed(map_))
    map_ = rough((11, 13))
    for seed in range(5):
        draw(replace(map_, seed=seed), 128)
    assert len(calls) == 1
