"""What is said of a measured map is so: of surfaces whose spectrum is known, and beside another program."""

from dataclasses import replace
from math import pi, sqrt

import numpy as np
import pytest
from effects_page import topography as study
from effects_page.asked import effects
from scipy.ndimage import gaussian_filter
from scipy.stats import binom
from typer.testing import CliRunner

from bem3d.grid import Grid
from bem3d.surface import RoughSurface
from compare.__main__ import app
from compare.figures import effect_topography, topography
from compare.outcome import Outcome, Row
from compare.powerlaw import fit
from compare.store import key
from compare.topography import describe, described, mapped, rings_of, rows_of
from scene import SelfAffine, Topography

L = 4e-3
ROUGH = SelfAffine(hurst=0.8, rms_height=2e-6, longest=L, shortest=L / 48, rolloff=L / 4, amplitudes="gaussian")
ROUNDING = 1e-9


def sampled(rough, points=128, piece=None, **other):
    """One period of a surface as a map, or a piece of it."""
    grid = Grid(points, rough.longest)
    heights = RoughSurface.of(rough, rough.q_max(0.0)).heights(grid.x, grid.y)[:piece, :piece]
    stated = {"pixel": grid.pixel, "peaks": "down", "level": "mean", "repeat": "periodic"}
    return Topography(heights=heights, **(stated | other))


def test_a_surface_is_described_as_it_was_drawn():
    surface = RoughSurface.of(ROUGH, ROUGH.q_max(0.0))
    found = describe(sampled(ROUGH))
    assert found.rms_height == pytest.approx(surface.rms_height, rel=ROUNDING)
    assert found.rms_slope_spectral == pytest.approx(surface.rms_slope, rel=ROUNDING)
    # differences of neighbours show sin(q p / 2) / (q p / 2) of a wave: of the shortest, 2.7 pixels, 0.78
    assert 0.78 * found.rms_slope_spectral < found.rms_slope < found.rms_slope_spectral
    finer = describe(sampled(ROUGH, 512))
    assert finer.rms_slope == pytest.approx(finer.rms_slope_spectral, rel=0.02)
    assert found.warnings == []


@pytest.mark.parametrize("repeat", ["periodic", "mirror"])
def test_the_spectrum_is_two_sided(repeat):
    # the integral over all rings is the mean square, but for the rest of rings with few waves
    map_ = sampled(ROUGH, repeat=repeat)
    rings = rings_of(map_)
    waves = map_.waves
    counted = np.sum(rings.density * rings.waves) * 2 * waves.step_x * waves.step_y
    assert counted == pytest.approx(map_.rms_height**2, rel=0.01)
    rows = rows_of(map_)
    line = 2 * np.sum(rows.density) * rows.q[0]
    own_mean = map_.relief.mean(axis=1).var()
    assert line + own_mean == pytest.approx(map_.rms_height**2, rel=ROUNDING)


def test_the_spectrum_is_that_of_the_surface():
    # of amplitudes that do not scatter: what is left is the lattice
    fixed = replace(ROUGH, amplitudes="fixed")
    rings = rings_of(sampled(fixed))
    middle = slice(6, -1)
    expected = fixed.density_2d(rings.q, fixed.q_max(0.0))
    np.testing.assert_allclose(rings.density[middle], expected[middle], rtol=0.1)
    assert rings.edges[-1] == pytest.approx(2 * pi * 48 / L, rel=0.02)
    assert not rings.whole
    np.testing.assert_allclose(
        mapped(rings)[middle], fixed.density_1d(rings.q, fixed.q_max(0.0))[middle], rtol=0.1
    )


def test_rows_are_line_scans():
    fixed = replace(ROUGH, amplitudes="fixed")
    rows = rows_of(sampled(fixed))
    below = rows.q < 0.9 * fixed.q_max(0.0)
    expected = fixed.density_line_scan(rows.q[below], fixed.q_max(0.0))
    np.testing.assert_allclose(rows.density[:48][below[:48]][6:], expected[6:], rtol=0.15)


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


# Of 40 intervals of 95 % as many or fewer hold with a chance of 1e-3.
HOLD = int(binom.ppf(1e-3, 40, 0.95))


@pytest.mark.parametrize("hurst", [0.2, 0.8])
@pytest.mark.parametrize("piece", [None, 64])
def test_intervals_hold_the_hurst_exponent_as_often_as_they_say(hurst, piece):
    # whole periods, and pieces that do not repeat, mirrored and levelled as a measured map would be
    stated = {} if piece is None else {"repeat": "mirror", "level": "tilt", "piece": piece}
    laws = [describe(sampled(replace(ROUGH, hurst=hurst, seed=seed), **stated)).law for seed in range(40)]
    assert sum(law.low <= hurst <= law.high for law in laws) >= HOLD
    # and say something: of a piece of 64 pixels with a cut-off inside, little
    assert np.median([law.high - law.low for law in laws]) < (0.2 if piece is None else 0.4)


def test_intervals_hold_the_exponent_about_as_often_as_they_say_and_not_always():
    # mirrored and levelled pieces, with and without a roll-off: of 200 intervals of 95 %, each end at 1e-3
    stated = {"repeat": "mirror", "level": "tilt", "piece": 64}
    laws = [
        describe(sampled(replace(ROUGH, hurst=0.5, rolloff=rolloff, seed=seed), **stated)).law
        for seed in range(100)
        for rolloff in (None, L / 4)
    ]
    held = sum(law.low <= 0.5 <= law.high for law in laws)
    assert binom.ppf(1e-3, 200, 0.95) <= held <= binom.ppf(1 - 1e-3, 200, 0.95)


def test_a_wrong_exponent_is_outside():
    law = describe(sampled(ROUGH)).law
    assert law.hurst == pytest.approx(ROUGH.hurst, abs=0.05)
    assert law.low < law.hurst < law.high
    q = np.array([2 * pi / L, 20 * pi / L, 40 * pi / L])
    expected = ROUGH.density_2d(q, ROUGH.q_max(0.0))
    np.testing.assert_allclose(law.density(q), expected, rtol=0.3)
    assert not law.low <= ROUGH.hurst - 0.2 <= law.high
    assert not law.low <= ROUGH.hurst + 0.2 <= law.high


def test_roll_off_and_cut_off_are_found_and_where_there_is_none_none():
    law = describe(sampled(ROUGH)).law
    assert law.rolloff
    assert law.longest == pytest.approx(L / 4, rel=0.35)
    assert law.shortest == pytest.approx(L / 48, rel=0.05)
    plain = describe(sampled(replace(ROUGH, rolloff=None, amplitudes="fixed"))).law
    assert not plain.rolloff
    assert not plain.cutoff
    assert "to a cut-off" in " ".join(described(describe(sampled(ROUGH))))


def test_noise_of_an_instrument_is_no_part_of_the_law():
    smooth = replace(ROUGH, hurst=0.9, rolloff=None, shortest=L / 63)
    map_ = sampled(smooth)
    clean = describe(map_).law
    noise = np.random.default_rng(0).normal(size=map_.heights.shape) * 0.03 * ROUGH.rms_height
    law = describe(replace(map_, heights=map_.heights.heights + noise)).law
    assert law.cutoff
    assert law.shortest > 1.5 * clean.shortest
    assert law.low <= 0.9 <= law.high


def test_what_is_no_power_law_is_said_to_be_none():
    map_ = sampled(ROUGH)
    blurred = replace(map_, heights=gaussian_filter(map_.heights.heights, 4, mode="wrap"))
    assert any("it may be none" in each or "is none" in each for each in describe(blurred).warnings)


def test_a_short_band_and_a_lopsided_map_are_warned_of():
    short = replace(ROUGH, rolloff=L / 10, shortest=L / 40)
    assert any("decades" in each for each in describe(sampled(short)).warnings)
    stretched = sampled(ROUGH, pixel=(L / 128, L / 64))
    assert any("isotropic" in each for each in describe(stretched).warnings)


def test_a_law_takes_four_rings():
    three = np.array([1.0, 2.0, 4.0])
    with pytest.raises(ValueError, match="3 rings"):
        fit(three, three, three, np.array([0.5, 1.5, 3.0, 6.0]))


def test_a_map_without_heights_is_not_described():
    with pytest.raises(ValueError, match="heights are none once level"):
        describe(Topography(heights=np.ones((9, 9)), pixel=1.0))


CHECKERS = np.indices((8, 8)).sum(axis=0) % 2
STRIPES = np.indices((8, 8))[0] % 2
THIN = np.random.default_rng(0).normal(size=(4, 400))


@pytest.mark.parametrize(
    ("heights", "pixel"),
    [(CHECKERS, 1.0), (STRIPES, 1.0), (THIN, (1.0, 900.0))],
    ids=["checkers", "stripes", "thin"],
)
def test_a_map_without_waves_in_all_directions_is_not_described(heights, pixel):
    with pytest.raises(
        ValueError, match=r"no wave of the map is shorter than .* of which it can have all directions"
    ):
        describe(Topography(heights=heights, pixel=pixel, repeat="periodic"))


@pytest.mark.filterwarnings("ignore:Function/property:DeprecationWarning")
def test_another_program_finds_the_same_heights_slopes_and_spectrum():
    """SurfaceTopography has 4 pi^2 of our density, and averages over all waves of a ring with their opposites."""
    peer = pytest.importorskip("SurfaceTopography")
    map_ = sampled(ROUGH, 65)
    found = describe(map_)
    other = peer.Topography(map_.relief.T, map_.size, periodic=True)
    assert other.rms_height_from_area() == pytest.approx(found.rms_height, rel=ROUNDING)
    # theirs goes round the sides of what repeats
    round_ = np.sqrt(np.mean([np.mean((np.roll(map_.relief, -1, k) - map_.relief) ** 2) for k in (0, 1)]) * 2)
    assert other.rms_gradient() == pytest.approx(round_ / map_.pixel[0], rel=1e-6)
    assert found.rms_slope == pytest.approx(other.rms_gradient(), rel=0.02)
    q, radial, theirs = other.power_spectrum_from_area(return_map=True)
    waves = map_.waves
    j, k = np.indices(waves.amplitudes.shape) - np.array([32, 0])[:, None, None]
    there = (k > 0) | (j > 0)
    ours = np.abs(waves.amplitudes) ** 2 / 2 / (2 * waves.step_x * waves.step_y)
    np.testing.assert_allclose(ours[there], theirs[k, j][there] / (4 * pi**2), atol=1e-9 * ours.max())
    # rings of theirs are others: what they have in common is the law
    known = (~np.ma.getmaskarray(radial)) & (q > 10e3) & (q < 60e3)
    log_ours = np.interp(np.log(q[known]), np.log(found.rings.q), np.log(found.rings.density))
    np.testing.assert_allclose(log_ours, np.log(radial[known] / (4 * pi**2)), atol=0.3)
    assert np.mean(log_ours - np.log(radial[known] / (4 * pi**2))) == pytest.approx(0.0, abs=0.1)


def test_the_command_describes_a_map(tmp_path):
    map_ = sampled(ROUGH)
    np.save(tmp_path / "map.npy", 1e6 * map_.heights.heights)
    out = tmp_path / "out"
    asked = [str(tmp_path / "map.npy"), "--unit", "um", "--pixel", str(map_.pixel[0]), "--output", str(out)]
    stated = ["--repeat", "periodic", "--level", "mean", "--peaks", "down"]
    told = CliRunner().invoke(app, ["topography", *asked, *stated])
    assert told.exit_code == 0
    expected = described(describe(replace(map_, heights=1e-6 * (1e6 * map_.heights.heights))))
    for line in expected:
        assert line in told.output
    assert {path.name for path in out.iterdir()} == {
        "manifest.json",
        "topography-map.pdf",
        "topography-map.svg",
        "topography-map.png",
        "topography-map.csv",
        "topography-rows-map.csv",
        "topography-drawn-map.csv",
    }
    table = np.genfromtxt(out / "topography-map.csv", delimiter=",", names=True)
    np.testing.assert_allclose(table["density_2d"], rings_of(map_).density, rtol=1e-6)


@pytest.mark.parametrize(
    ("stated", "named"),
    [
        ([], "does not state the size of a pixel"),
        (["--pixel", "-1"], "greater than 0"),
        (["--pixel", "1", "--level", "cubic"], "'mean', 'tilt' or 'curvature'"),
        (["--pixel", "1", "--unit", "ell"], "crosscheck: unit = 'ell': one of m, mm, um, nm"),
        (["--pixel", "1", "--repeat", "periodic", "--level", "tilt"], 'level = "tilt" with repeat = "periodic"'),
        (["--pixel", "1", "--pixel", "1", "--pixel", "1"], "pixel = (1.0, 1.0, 1.0): Input should be the side of"),
    ],
)
def test_the_command_names_mistakes(tmp_path, stated, named):
    np.save(tmp_path / "map.npy", np.random.default_rng(0).normal(size=(9, 9)))
    told = CliRunner().invoke(app, ["topography", str(tmp_path / "map.npy"), *stated])
    assert told.exit_code == 2
    assert named in told.output
    flat = tmp_path / "flat.npy"
    np.save(flat, np.ones((9, 9)))
    told = CliRunner().invoke(app, ["topography", str(flat), "--pixel", "1"])
    assert told.exit_code == 2
    assert "heights are none" in told.output


@pytest.mark.parametrize(
    ("heights", "said"),
    [
        (
            np.where(np.eye(9) > 0, np.nan, 1.0),
            "file = '{}': heights[0][0] = nan: every pixel needs a finite height",
        ),
        (np.full((9, 9), 1j), "file = '{}': an array of type complex128: heights are real numbers [m]"),
        (np.full((9, 9), "1"), "file = '{}': an array of type <U1: heights are real numbers [m]"),
        (np.eye(3), "file = '{}': an array of shape (3, 3): a map has at least 4 rows and columns"),
        (np.zeros((9, 9, 9)), "file = '{}': an array of shape (9, 9, 9)"),
        (CHECKERS, "{}: no wave of the map is shorter"),
    ],
    ids=["nan", "complex", "text", "small", "solid", "checkers"],
)
def test_the_command_says_in_a_line_what_is_wrong_with_a_map(tmp_path, heights, said):
    path = tmp_path / "map.npy"
    np.save(path, heights)
    told = CliRunner().invoke(app, ["topography", str(path), "--pixel", "1", "--repeat", "periodic"])
    assert told.exit_code == 2
    assert told.output.startswith(f"crosscheck: {said.format(path)}")
    assert told.output.count("\n") == 1


@pytest.mark.parametrize(("repeat", "level"), [("periodic", "mean"), ("mirror", "tilt")])
def test_without_a_level_the_command_takes_that_of_what_repeats(tmp_path, repeat, level):
    np.save(tmp_path / "map.npy", sampled(ROUGH, 32).heights.heights)
    asked = [str(tmp_path / "map.npy"), "--pixel", "1", "--repeat", repeat, "--output", str(tmp_path / "out")]
    told = CliRunner().invoke(app, ["topography", *asked])
    assert told.exit_code == 0
    assert f'level: "{level}" taken off; repeat: "{repeat}"' in told.output


def test_the_measured_surface_of_the_page_is_the_drawn_one():
    # costs of both are compared: the same surface, not one with a plane taken off its period
    asked = {each.title: each.scene.roughness for each in effects()}
    map_, drawn = asked["measured topography"], asked["roughness"]
    surface = RoughSurface.of(drawn, drawn.q_max(0.0))
    assert map_.rms_height == pytest.approx(surface.rms_height, rel=ROUNDING)
    assert map_.waves.rms_slope == pytest.approx(surface.rms_slope, rel=ROUNDING)


def test_the_figure_has_what_it_is_drawn_from():
    found = describe(sampled(ROUGH))
    drawing = topography.figure(found)
    left, right = drawing.axes
    np.testing.assert_array_equal(left.lines[0].get_ydata(), found.rings.density)
    np.testing.assert_array_equal(right.lines[0].get_ydata(), found.rows.density)
    assert "Hurst" in topography.caption(found)
    sheet = topography.sheets(found)
    assert sheet["topography"]["waves"].sum() == found.rings.waves.sum()
    none = replace(found, law=None)
    assert "Hurst" not in topography.caption(none)
    assert len(topography.figure(none).axes[0].lines) == 1


def outcomes(force=1.0, friction=0.1):
    """Answers as if solved: each way a little off the others, by the seed."""
    found = {}
    for task in study.tasks():
        slides = task.scenes[0].motion.speed > 0
        way = 1.0 if task.solver.name == "BEM" else 0.8
        found[task] = Outcome(
            tuple(
                Row(normal_force=way * force * (1 + 0.01 * k), friction_force=way * friction if slides else 0.0)
                for k, _ in enumerate(task.scenes)
            )
        )
    return found


def test_the_study_asks_every_way_of_every_contact():
    asked = study.tasks()
    contacts = len(study.DEPTHS) + len(study.SPEEDS)
    assert len(asked) == len({key(task) for task in asked}) == 4 * contacts
    assert {len(task.scenes) for task in asked} == {1, study.PLACES, study.LINES}
    for task in asked:
        assert not task.solver.refusals(task.scenes[0])


def test_the_chapter_is_computed_from_the_answers():
    chapter = study.chapter(outcomes())
    rows = chapter.data[effect_topography.NAME]
    one = next(row for row in rows if row["way"] == study.SURFACES and row["quantity"] == "force")
    values = 1 + 0.01 * np.arange(study.PLACES)
    assert one["mean"] == pytest.approx(values.mean())
    # Student's t of seven freedoms, 2.365
    assert one["half_interval"] == pytest.approx(2.3646 * values.std(ddof=1) / sqrt(study.PLACES), rel=1e-4)
    table = chapter.tables["Force at a depth, friction under a load"]
    assert len(table) == len(study.DEPTHS) + len(study.SPEEDS)
    assert "synthetic" in chapter.text
    other = study.chapter(outcomes(force=2.0)).tables["Force at a depth, friction under a load"]
    assert other[0][study.SURFACES] != table[0][study.SURFACES]
    assert len(chapter.figures[effect_topography.NAME].axes) == 2
