"""Roughness measured along a line: the surface fitted to it, how surely, and lines read as files have them."""

from dataclasses import replace
from functools import cache
from math import pi

import numpy as np
import pytest
import xarray
from maps import noise, refused

import mdr1d
from bem3d import BEM
from compare.trustmap.verdict import FITTED, trust
from mdr1d import MDR
from scene import Kelvin, Profile, Refused, Scene, SelfAffine, Slide, Sphere
from scene.surfaces import linescan
from scene.surfaces.heightmap import taken_off
from scene.surfaces.topography import MOST_WAVES

SPACING = 2e-6
ROUGH = SelfAffine(hurst=0.7, rms_height=2e-6, longest=8e-3, rolloff=2e-4, shortest=2e-5)
ROUNDING = 1e-12


@cache
def amplitudes(rough, count, spacing):
    """Root mean squares of the waves of a periodic line scan of a surface on `count` points."""
    q = 2 * pi / (count * spacing) * np.arange(1, count // 2 + 1)
    power = np.zeros(len(q))
    for seen in (q, 2 * pi / spacing - q):  # waves that the spacing folds
        seen = np.where(seen < rough.q_max(0.0), seen, 0.999 * rough.q_max(0.0))
        power += np.where(seen < 0.999 * rough.q_max(0.0), rough.density_line_scan(seen, rough.q_max(0.0)), 0.0)
    return np.sqrt(power * q[0] / 2)


def line(rough=ROUGH, points=512, spacing=SPACING, seed=1):
    """Piece of a Gaussian line with the spectrum of a line scan of a surface, eight times as long before."""
    count, draw = 8 * points, np.random.default_rng(seed)
    waves = amplitudes(rough, count, spacing)
    waves = waves * (draw.standard_normal(len(waves)) + 1j * draw.standard_normal(len(waves)))
    return np.fft.irfft(np.append(0.0, waves), count, norm="forward")[:points]


HEIGHTS = line()
PROFILE = Profile(heights=HEIGHTS, spacing=SPACING)
SLIDING = Scene(Sphere(1e-2), Kelvin(1e6, 1e-3), Slide(speed=0.01, load=0.2), PROFILE)


def held(rough, points, lines):
    """Share of lines whose intervals hold hurst, rms height and rms slope of the waves that a line can have."""
    longest, highest = points * SPACING, min(rough.q_max(0.0), pi / SPACING)
    known = replace(rough, longest=min(longest, rough.longest), rolloff=rough.rolloff)
    known = replace(
        known, rms_height=rough.rms_height * rough.share(known.q_min, highest, rough.q_max(0.0)) ** 0.5
    )
    truth = {"hurst": rough.hurst, "rms_height": known.rms_height, "rms_slope": known.rms_slope(highest)}
    laws = [linescan.fit(line(rough, points, seed=seed), SPACING) for seed in range(lines)]
    return {
        name: np.mean([getattr(law, name).low <= true <= getattr(law, name).high for law in laws])
        for name, true in truth.items()
    }


@pytest.mark.parametrize("hurst", [0.3, 0.9])
def test_intervals_of_a_line_hold_the_surface_that_it_was_cut_from(hurst):
    # of 12 lines an interval of 95 % holds less than 9 in one set of 400
    rates = held(replace(ROUGH, hurst=hurst), 256, lines=12)
    assert min(rates.values()) >= 0.75, rates


@pytest.mark.slow
@pytest.mark.parametrize(("hurst", "rolloff"), [(0.2, None), (0.8, 4e-4)])
def test_intervals_hold_at_the_rate_that_is_told(hurst, rolloff):
    rates = held(replace(ROUGH, hurst=hurst, rolloff=rolloff), 1024, lines=200)
    assert min(rates.values()) >= 0.9, rates


def test_waves_beyond_the_cut_off_have_the_slope_of_a_tapered_periodogram():
    heights = HEIGHTS + 3e-8 * noise(len(HEIGHTS))
    law, at = linescan.fit(heights, SPACING), np.arange(len(heights))
    level = heights - np.polyval(np.polyfit(at, heights, 1), at)
    waves = np.arange(len(heights) // 2 + 1)
    slopes = np.abs(waves * np.fft.rfft(level * np.hanning(len(level)))) ** 2
    beyond = slopes[waves > law.length / law.shortest.value]
    assert law.beyond == pytest.approx(beyond.sum() / slopes.sum(), rel=0.15)


def test_what_a_line_sees_of_a_falling_spectrum_is_the_line_scan_of_that_surface():
    rough, q = (
        SelfAffine(hurst=0.6, rms_height=1.0, longest=2 * pi, shortest=2 * pi / 100),
        np.array([5.0, 20, 80]),
    )
    expected = rough.density_line_scan(q, 100.0) / rough.density_2d(1.0, 100.0)
    found = 2 * (linescan._tail(0.6, q, q) - linescan._tail(0.6, q, 100.0))
    assert found == pytest.approx(expected, rel=1e-9)


def test_a_line_with_regular_grooves_does_not_follow_the_law():
    grooves = HEIGHTS.std() * np.sin(2 * np.pi * np.arange(len(HEIGHTS)) / 20)
    follow = [linescan.fit(HEIGHTS + share * grooves, SPACING).follows for share in (0, 0.1, 0.5)]
    assert follow == [True, True, False]


@pytest.mark.parametrize("factor", [1e-40, 1e40])
def test_the_fit_scales_with_heights_and_lengths(factor):
    law, other = PROFILE.law, Profile(heights=factor * HEIGHTS, spacing=SPACING / 3).law
    assert other.hurst.value == law.hurst.value
    assert (other.rms_height.value, other.rms_slope.value, other.rolloff.high) == pytest.approx(
        (factor * law.rms_height.value, 3 * factor * law.rms_slope.value, law.rolloff.high / 3), rel=1e-9
    )


def test_the_surface_is_that_of_the_law_up_to_the_length_of_the_line():
    fitted, law = PROFILE.fitted, PROFILE.law
    assert fitted.longest == len(HEIGHTS) * SPACING
    assert fitted.rms_slope(fitted.q_max(0.0)) == pytest.approx(law.rms_slope.value, rel=ROUNDING)
    kept = replace(PROFILE, shortest_kept=5e-5)
    # the same surface without its short waves
    q = np.array([5e4, 1e5])
    assert kept.fitted.density_2d(q, kept.q_max(0.0)) == pytest.approx(fitted.density_2d(q, PROFILE.q_max(0.0)))
    assert (kept.shortest, kept.law) == (pytest.approx(5e-5), law)


@pytest.mark.parametrize("solver", [MDR(points=600), MDR(points=600, shape="as-given"), BEM(points=128)])
def test_solvers_answer_a_line_as_its_fitted_surface(solver):
    scene = replace(SLIDING, roughness=replace(PROFILE, shortest_kept=6e-5, seed=2))
    answer = solver.solve(scene)
    fitted = solver.solve(replace(scene, roughness=scene.roughness.fitted))
    assert (answer.friction_force, answer.depth) == (fitted.friction_force, fitted.depth)
    assert answer.measures == fitted.measures


@pytest.mark.parametrize("seed", [0, 5])
@pytest.mark.parametrize("points", [96, 97])
def test_a_line_scan_is_the_measured_line_at_its_points(seed, points):
    profile = Profile(heights=HEIGHTS[:points], spacing=SPACING, seed=seed)
    whole = np.append(profile.relief, profile.relief[::-1])
    for fine in (1, 3):
        found = mdr1d.draw(profile, fine * len(whole), "line-scan").heights[::fine]
        shifts = [
            k for k in range(points) if np.allclose(found, np.roll(whole, -k), rtol=0, atol=1e-12 * whole.max())
        ]
        assert len(shifts) == 1
        assert seed or shifts == [points // 2]


def test_peaks_of_an_instrument_point_towards_the_elastomer():
    assert PROFILE.relief == pytest.approx(-replace(PROFILE, peaks="down").relief)
    assert np.argmin(PROFILE.relief) == np.argmax(taken_off(HEIGHTS, 1))


@pytest.mark.parametrize(("level", "degree"), [("mean", 0), ("tilt", 1), ("curvature", 2), ("cubic", 3)])
def test_a_form_is_taken_off(level, degree):
    form = np.polynomial.Polynomial([3e-6, *[1e-6] * degree])(np.linspace(-1, 1, 100))
    flat = Profile(heights=form, spacing=SPACING, level=level)
    assert flat.flat
    assert flat.fitted.flat
    with_form = Profile(heights=HEIGHTS[:100] + form, spacing=SPACING, level=level)
    alone = Profile(heights=HEIGHTS[:100], spacing=SPACING, level=level)
    assert with_form.relief == pytest.approx(alone.relief, abs=1e-12 * np.ptp(HEIGHTS))


def test_what_is_told_has_the_hurst_exponent_and_whether_there_is_a_roll_off():
    assert f"{PROFILE.law.hurst.low:.3g}" in " ".join(PROFILE.notes)
    short = Profile(heights=line(replace(ROUGH, rolloff=None), seed=2), spacing=SPACING)
    assert "no roll-off" in " ".join(short.notes)


def test_trust_judges_the_fitted_surface_and_says_so():
    scene = replace(SLIDING, motion=Slide(speed=0.01, load=2.0))
    found, fitted = trust(scene), trust(replace(scene, roughness=PROFILE.fitted))
    assert found.groups == fitted.groups
    assert all(FITTED in worth.reason for worth in found.corrections.values())
    assert [each.ratio for each in found.corrections.values()] == pytest.approx(
        [each.ratio for each in fitted.corrections.values()], nan_ok=True
    )


def test_a_line_with_more_waves_than_fit_is_refused_with_what_to_state():
    heights = np.cumsum(noise(3 * MOST_WAVES, 1))
    scene = replace(SLIDING, roughness=Profile(heights=1e-9 * heights, spacing=SPACING))
    with pytest.raises(Refused, match="shortest_kept = ") as refused:
        BEM(points=64).solve(scene)
    kept = float(str(refused.value).partition("shortest_kept = ")[2].split()[0])
    scene = replace(scene, roughness=replace(scene.roughness, shortest_kept=kept))
    assert not any("fit in memory" in reason for reason in BEM(points=64).refusals(scene))


REGULAR = np.sin(2 * pi * np.arange(512) / 16.3)


@pytest.mark.parametrize(
    ("message", "stated"),
    [
        ("type = .wave", {"heights": REGULAR}),
        ("20 points", {"heights": HEIGHTS[:20]}),
        ("heights.0. = inf: 1 of 512 heights .0.195 %. missing", {"heights": [np.inf, *HEIGHTS[1:]]}),
        ("shortest_kept = 1e-06", {"shortest_kept": 1e-6}),
        ("roll-off", {"shortest_kept": 5e-4}),
        ("shape .8, 8.: a line is one row of heights", {"heights": np.ones((8, 8))}),
        ("one row of heights", {"heights": HEIGHTS[None]}),
        ("dimensions of heights = ", {"heights": xarray.DataArray(np.ones((8, 8)), dims=("y", "x"))}),
        ("column .z. has no unit.*state units = .z", {"heights": {"z": HEIGHTS}}),
    ],
)
def test_what_is_no_line_is_refused_with_the_reason(message, stated):
    refused(message, Profile, **{"heights": HEIGHTS, "spacing": SPACING} | stated)


def labelled():
    """Heights in nm at places in mm."""
    return xarray.DataArray(
        1e9 * HEIGHTS,
        {"x": ("x", 1e3 * SPACING * np.arange(512), {"units": "mm"})},
        "x",
        name="z",
        attrs={"units": "nm"},
    )


def saved(write, name):
    def given(folder):
        write(folder / name)
        return {"file": folder / name}

    return given


GIVEN = {
    "xarray": lambda _: {"heights": labelled()},
    "a Dataset": lambda _: {"heights": labelled().to_dataset()},
    "arrays, falling": lambda _: {
        "heights": {"z [um]": HEIGHTS[::-1] * 1e6, "x [um]": 1e6 * SPACING * np.arange(512)[::-1]}
    },
    "NetCDF": saved(lambda path: labelled().to_netcdf(path), "line.nc"),
    "npy": lambda folder: saved(lambda path: np.save(path, 1e6 * HEIGHTS), "line.npy")(folder) | UM,
}


@pytest.mark.parametrize("kind", GIVEN)
def test_a_line_is_the_same_in_every_array_and_library(tmp_path, kind):
    profile = Profile(**GIVEN[kind](tmp_path))
    assert profile.spacing == pytest.approx(SPACING, rel=1e-9)
    assert profile.heights.heights == pytest.approx(HEIGHTS, rel=1e-12)


def column(separator=";", decimal=".", places=True):
    rows = [[f"{1e3 * SPACING * k:.6f}"] * places + [f"{1e6 * z:.9f}"] for k, z in enumerate(HEIGHTS)]
    return "".join(f"{separator.join(row)}\n" for row in rows).replace(".", decimal)


IN_MM_AND_UM = {"units": {"x": "mm", "z": "um"}}
UM = {"unit": "um", "spacing": "2 um"}
# Texts of a line and what is stated of them.
TEXTS = [
    ("X [mm];Z [µm]\n" + column(";", ","), {}),
    ("# stylus tip 2 um, heights in nm\nposition\theight\nmm\tum\n" + column("\t"), {}),
    ("x y1\n" + column(" "), {"columns": {"z": "y1"}, **IN_MM_AND_UM}),  # a graph of Gwyddion
    ("Profile 1\nx;z\n" + column() + "\nmean;0\n", {"skip": 1, "rows": 512, **IN_MM_AND_UM}),
    (column(), {"columns": {"x": 1, "z": 2}, **IN_MM_AND_UM}),
    ("z\n" + column(places=False), UM),
    ("# stylus tip 2 nm\n" + column(places=False), UM),
    (column(decimal=",", places=False), UM | {"decimal": ","}),
]


@pytest.mark.parametrize(("content", "stated"), TEXTS)
def test_a_line_is_the_same_in_every_text_that_is_read(tmp_path, content, stated):
    (tmp_path / "line.csv").write_text(content, encoding="utf-16")
    profile = Profile(file=tmp_path / "line.csv", **stated)
    assert profile.spacing == pytest.approx(SPACING, rel=1e-6)
    assert profile.heights.heights == pytest.approx(HEIGHTS, abs=1e-14)
    if "unit" not in stated:
        refused("leave spacing out", Profile, file=tmp_path / "line.csv", **stated, spacing="2.1 um")
        refused("must agree|state one of", Profile, file=tmp_path / "line.csv", **stated, unit="nm")


@pytest.mark.parametrize(
    ("content", "stated", "message"),
    [
        ("# heights in um\n" + column(places=False), {}, "line.txt does not state its unit"),
        (column(places=False), {"unit": "um"}, "does not state its spacing: state it, as spacing ="),
        ("z [um]\n" + column(places=False), {}, "does not state its spacing"),
        (column(), UM, "2 columns of numbers alone: of points state columns = {x = 1, z = 2}"),
        ("x [mm];z [um]\n" + column().replace("0.004000", "0.0042", 1), {}, "line 4: x = 4.2e-06 is off by more"),
        ("x [mm];z [um]\n" + column() + "0;1\n", {}, "x = 0 is not one step from the one before"),
    ],
)
def test_a_text_that_is_no_line_is_refused_with_what_to_state(tmp_path, content, stated, message):
    (tmp_path / "line.txt").write_text(content)
    refused(message, Profile, file=tmp_path / "line.txt", **stated)
