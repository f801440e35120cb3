"""Spectra of measured maps: of surfaces with known spectra, and compared with another program."""

import re
from dataclasses import replace
from math import pi

import numpy as np
import pytest
from drawn_again import from_files
from maps import sampled
from scipy.ndimage import gaussian_filter
from scipy.stats import binom

import compare
from bem3d.surface import RoughSurface
from compare.studies.topography import figure as plots
from compare.studies.topography import spectra
from compare.studies.topography.powerlaw import fit
from compare.studies.topography.spectra import describe, mapped, rings_of, rows_of
from compare.studies.topography.study import Map
from scene import SelfAffine, Topography
from scene.files.reading import InvalidInput

L = 4e-3
ROUGH = SelfAffine(hurst=0.8, rms_height=2e-6, longest=L, shortest=L / 48, rolloff=L / 4, amplitudes="gaussian")
ROUNDING = 1e-9


def test_a_surface_is_described_as_it_was_drawn():
    surface = RoughSurface.of(ROUGH, ROUGH.q_max(0.0))
    found = describe(sampled(ROUGH))
    wanted = surface.rms_height, surface.rms_slope
    assert (found.rms_height, found.rms_slope) == pytest.approx(wanted, rel=ROUNDING)
    assert found.warnings == []


@pytest.mark.parametrize(("repeat", "points"), [("periodic", 127), ("mirror", 128)])
def test_the_spectrum_is_two_sided(repeat, points):
    # the integral over all rings is the mean square, but for the rest of rings with few waves
    map_ = sampled(ROUGH, points, repeat=repeat)
    rings, waves, square = rings_of(map_), map_.waves, map_.rms_height**2
    counted = np.sum(rings.density * rings.waves) * 2 * waves.step_x * waves.step_y
    assert counted == pytest.approx(square, rel=0.01)
    rows = rows_of(map_)
    line = 2 * np.sum(rows.density) * rows.q[0]
    own_mean = map_.relief.mean(axis=1).var()
    assert line + own_mean == pytest.approx(square, rel=ROUNDING)


def test_spectra_of_rings_and_rows_are_those_of_the_surface():
    # of amplitudes that do not scatter: what is left is the lattice
    fixed = replace(ROUGH, amplitudes="fixed")
    map_, highest = sampled(fixed), fixed.q_max(0.0)
    rings, rows = rings_of(map_), rows_of(map_)
    assert rings.edges[-1] == pytest.approx(2 * pi * 48 / L, rel=0.02)
    assert not rings.whole
    middle = slice(6, -1)
    for found, density, within in (
        (rings.density, fixed.density_2d(rings.q, highest), 0.1),
        (mapped(rings), fixed.density_1d(rings.q, highest), 0.1),
        (rows.density[:44], fixed.density_line_scan(rows.q[:44], highest), 0.15),
    ):
        np.testing.assert_allclose(found[middle], density[middle], rtol=within)


def test_one_wave_is_all_in_one_ring():
    x = np.arange(64) / 64
    map_ = Topography(
        heights=np.tile(np.cos(2 * pi * 8 * x), (64, 1)), pixel=1 / 64, level="mean", repeat="periodic"
    )
    rings = rings_of(map_)
    assert rings.q == pytest.approx([16 * pi])
    assert rings.waves.tolist() == [1]
    assert rings.density[0] * 2 * (2 * pi) ** 2 == pytest.approx(0.5)
    found = describe(map_)
    assert found.law is None
    assert "too few rings" in found.warnings[0]
    assert "isotropic" in found.warnings[1]


# As many of 40 intervals of 95 % or fewer hold with a chance of 1e-3.
HOLD = int(binom.ppf(1e-3, 40, 0.95))


@pytest.mark.parametrize(
    ("hurst", "piece"),
    [(0.8, 64), *(pytest.param(*each, marks=pytest.mark.slow) for each in ((0.2, 64), (0.2, None), (0.8, None)))],
)
def test_intervals_hold_the_hurst_exponent_as_often_as_they_say(hurst, piece):
    # whole periods, and pieces that do not repeat, mirrored and levelled as a measured map would be
    stated = {} if piece is None else {"repeat": "mirror", "level": "tilt", "piece": piece}
    laws = [describe(sampled(replace(ROUGH, hurst=hurst, seed=seed), **stated)).law for seed in range(40)]
    assert sum(law.low <= hurst <= law.high for law in laws) >= HOLD
    # and say something: of a piece of 64 pixels with a cut-off inside, little
    assert np.median([law.high - law.low for law in laws]) < (0.2 if piece is None else 0.4)


def test_a_wrong_exponent_is_outside_and_roll_off_and_cut_off_are_found_where_they_are():
    found, q = describe(sampled(ROUGH)), np.array([2, 20, 40]) * pi / L
    law, plain = found.law, describe(sampled(replace(ROUGH, rolloff=None, amplitudes="fixed"))).law
    assert law.hurst == pytest.approx(ROUGH.hurst, abs=0.05)
    assert ROUGH.hurst - 0.2 < law.low < law.hurst < law.high < ROUGH.hurst + 0.2
    np.testing.assert_allclose(law.density(q), ROUGH.density_2d(q, ROUGH.q_max(0.0)), rtol=0.3)
    assert law.longest == pytest.approx(L / 4, rel=0.35)
    assert law.shortest == pytest.approx(L / 48, rel=0.05)
    assert (law.rolloff, plain.rolloff, plain.cutoff) == (True, False, False)
    assert found.band.endswith("below a roll-off to a cut-off")


def test_noise_of_an_instrument_is_no_part_of_the_law():
    smooth = replace(ROUGH, hurst=0.9, rolloff=None, shortest=L / 63)
    map_ = sampled(smooth)
    clean = describe(map_).law
    noise = np.random.default_rng(0).normal(size=map_.heights.shape) * 0.03 * ROUGH.rms_height
    law = describe(replace(map_, heights=map_.heights.heights + noise)).law
    assert law.cutoff
    assert law.shortest > 1.5 * clean.shortest
    assert law.low <= 0.9 <= law.high


ROUGH_MAP = sampled(ROUGH)


@pytest.mark.parametrize(
    ("warned", "words"),
    [
        (
            replace(ROUGH_MAP, heights=gaussian_filter(ROUGH_MAP.heights.heights, 4, mode="wrap")),
            "it may be none|is none",
        ),
        (sampled(replace(ROUGH, rolloff=L / 10, shortest=L / 40)), "decades"),
        (sampled(ROUGH, pixel=(L / 128, L / 64)), "isotropic"),
    ],
)
def test_what_is_no_power_law_a_short_band_and_a_lopsided_map_are_warned_of(warned, words):
    assert re.search(words, "; ".join(describe(warned).warnings))


EDGES = {
    "a spike": np.where(np.arange(256).reshape(16, 16) == 40, 1.0, 0.0),
    "two heights": np.random.default_rng(0).integers(0, 2, (16, 16)).astype(np.uint8),
    "next to nothing on a plane": 1.0 + 1e-12 * np.random.default_rng(0).normal(size=(16, 16)),
    "the least pixels": np.random.default_rng(0).normal(size=(4, 4)),
}


@pytest.mark.parametrize("kind", EDGES)
@pytest.mark.parametrize(
    ("length", "pixel"), [(1e-49, 1e-50), (1e49, 1e-50), (1e-6, 1.0), (1e-49, (1e50, 5e49)), (1e49, (1e50, 5e49))]
)
def test_a_number_is_finite_or_has_its_reason(tmp_path, kind, length, pixel):
    heights = EDGES[kind].astype(float)
    heights *= length / np.abs(heights).max()
    study = Map.of(saved(tmp_path, heights), pixel=pixel, unit="m")
    found = study.description
    for each in study.judge(study.answers({})).findings:
        assert np.isfinite(each.value) or (each.claim.id in LAW and found.warnings)
    assert all(np.isfinite(each.density).all() for each in (found.rings, found.rows))


LAW = {"topography.hurst", "topography.longest", "topography.shortest"}


def test_a_law_takes_four_rings():
    three = np.array([1.0, 2.0, 4.0])
    with pytest.raises(ValueError, match="3 rings"):
        fit(three, three, three, np.array([0.5, 1.5, 3.0, 6.0]))


def test_the_band_of_a_law_has_a_third_of_the_rings():
    edges = np.geomspace(1.0, 2.0**15, 16)
    q = np.sqrt(edges[1:] * edges[:-1])
    law = fit(q, np.minimum(1.0, (q / q[12]) ** -3), np.full(15, 1e3), edges)  # it falls over three rings alone
    assert (law.longest, law.shortest) == pytest.approx((2 * pi / q[10], 2 * pi / edges[15]))


CHECKERS = np.indices((8, 8)).sum(axis=0) % 2


def saved(tmp_path, heights):
    path = tmp_path / "map.npy"
    np.save(path, heights)
    return path


def test_the_command_describes_a_map(tmp_path):
    map_ = sampled(ROUGH)
    path = tmp_path / "map.txt"
    np.savetxt(path, 1e6 * map_.heights.heights, "%.17e", header="heights in nm")
    stated = {"skip": 1, "unit": "um", "pixel": [map_.pixel[0]], "repeat": "periodic", "peaks": "down"}
    report = compare.topography(path, output=tmp_path / "out", **stated)
    expected = describe(replace(map_, heights=1e-6 * (1e6 * map_.heights.heights)))
    findings, law = report.findings.set_index("claim"), expected.law
    assert findings.loc["topography.rms-height", "value"] == expected.rms_height
    known = findings.loc["topography.hurst", ["value", "low", "high", "regime"]].tolist()
    assert known == [law.hurst, law.low, law.high, expected.band]
    np.testing.assert_array_equal(compare.load(tmp_path / "out")["rings"]["q"], expected.rings.q)


NOISE = np.random.default_rng(0).normal(size=(9, 9))
REPEATS = {"pixel": 1.0, "repeat": "periodic"}


@pytest.mark.parametrize(
    ("heights", "stated", "message"),
    [
        (NOISE, {"pixel": ["1", "2 um"]}, "there is no unit"),
        (np.ones((9, 9)), REPEATS, "heights are none once level"),
        (CHECKERS, REPEATS, "no wave of the map is shorter than"),
    ],
)
def test_a_mistake_is_named_in_a_line_and_leaves_no_folder(tmp_path, heights, stated, message):
    path = saved(tmp_path, heights)
    with pytest.raises(InvalidInput) as refused:
        compare.topography(path, output=tmp_path / "out", **({"unit": "m"} | stated))
    assert message in str(refused.value)
    assert heights is NOISE or str(path) in str(refused.value)
    assert "\n" not in str(refused.value)
    assert not (tmp_path / "out").exists()


def test_the_figure_is_a_function_of_its_csv_files():
    found = describe(sampled(ROUGH))
    for each, lines in ((found, 2), (replace(found, law=None), 1)):
        plot = plots.plot(each)
        left, right = from_files(plot).axes
        np.testing.assert_allclose(left.lines[0].get_ydata(), found.rings.density, rtol=1e-12)
        nothing = spectra.NOTHING * found.rows.density.max()
        np.testing.assert_allclose(right.lines[0].get_ydata(), found.rows.density, rtol=1e-12, atol=nothing)
        assert len(left.lines) == lines
        assert ("Hurst" in plot.caption) == (lines == 2)
