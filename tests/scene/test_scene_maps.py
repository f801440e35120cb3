"""A map is the same in every layout that instruments write; what is missing is refused, or filled in and told."""

import pickle
from dataclasses import replace
from io import StringIO
from types import SimpleNamespace

import numpy as np
import pandas
import pytest
import xarray
from hypothesis import given
from hypothesis import strategies as st
from maps import noise, says
from pydantic import TypeAdapter
from scipy.io import savemat
from strategies import examples

from compare.studies.topography.study import Map
from scene import Measured, Scene, Topography
from scene.form import DEGREES, levelled
from scene.missing import NEIGHBOURS, filled, outliers, sentinels
from scene.reading import InvalidInput, read

DIGITS = 1e-12  # what layouts with 15 digits keep
NAN = np.nan


def text(numbers, separator=";", decimal="."):
    lines = (separator.join("" if np.isnan(n) else f"{n:.15e}" for n in row) for row in np.atleast_2d(numbers))
    return "\n".join(lines).replace(".", decimal) + "\n"


def points(heights, pixel, seed=None, keep=None):
    """x, y, z [um] of a map in mixed order, 1 um from the origin."""
    rows, columns = np.indices(heights.shape)
    every = np.column_stack([1 + columns.ravel() * pixel[0], 1 + rows.ravel() * pixel[1], heights.ravel()])
    every = every if keep is None else every[keep]
    return every if seed is None else np.random.default_rng(seed).permutation(every)


def with_axes(heights, pixel, corner=""):
    x, y = (3 + np.arange(count) * side for count, side in zip(heights.shape[::-1], pixel, strict=True))
    rows = [";".join([corner, *(f"{each:.15e}" for each in x)])]
    rows += [";".join(f"{n:.15e}" for n in (at, *row)) for at, row in zip(y, heights, strict=True)]
    return "\n".join(rows)


def gwyddion(heights, pixel, channel="Height"):
    size = heights.shape[1] * pixel[0], heights.shape[0] * pixel[1]
    head = f"# Channel: {channel}\n# Width: {size[0]:.15g} µm\n# Height: {size[1]:.15g} µm\n# Value units: um\n"
    return head + text(heights, "\t")


def scan_lines(heights, pixel):
    lines = np.split(points(heights, pixel), heights.shape[0])
    return "x [um] y [um] z [um]\n" + "\n".join(text(each, " ") for each in lines)


ROWS = {"unit": "um", "pixel": "stated"}
UM = {"unit": "um"}
# A text of heights and a pixel in um, and what it does not state.
LAYOUTS = {
    "rows": (lambda h, p: text(h), ROWS),
    "decimal commas and tabs": (lambda h, p: text(h, "\t", ","), ROWS),
    "Gwyddion": (gwyddion, {}),
    "Gwyddion in German": (
        lambda h, p: (
            gwyddion(h, p)
            .replace("Channel", "Kanal")
            .replace("Width", "Breite")
            .replace("# Height", "# Höhe")
            .replace("Value units", "Werteinheiten")
        ),
        {},
    ),
    "a confocal microscope": (
        lambda h, p: (
            f'"X pixel size","{1e3 * p[0]}","nm"\n"Y pixel size","{p[1]}","um"\n"Unit","um"\n"Height"\n'
            + text(h, ",")
        ),
        {},
    ),
    "a quoted heading of all": (lambda h, p: '"Height Sensor(nm)"\n' + text(1e3 * h, "\t"), {"pixel": "stated"}),
    "a unit in brackets": (
        lambda h, p: f"Pixel width (µm) = {p[0]}\nPixel height (µm) = {p[1]}\n\n" + text(h),
        UM,
    ),
    "headings with a unit": (
        lambda h, p: ";".join(f"z{k} [um]" for k in range(h.shape[1])) + "\n" + text(h),
        {"pixel": "stated"},
    ),
    "axes with a unit": (lambda h, p: with_axes(h * 1e3, p, "y [um]"), {"unit": "nm"}),
    "falling axes": (lambda h, p: with_axes(h[::-1, ::-1], (-p[0], -p[1])), UM),
    "points in any order": (lambda h, p: "x;y;z\n" + text(points(h, p, seed=1)), UM),
    "points with units": (
        lambda h, p: "z [nm]\tx [um]\ty [um]\n" + text(points(h * 1e3, p)[:, [2, 0, 1]], "\t"),
        {},
    ),
    "scan lines": (scan_lines, {}),
}


@pytest.mark.parametrize("layout", LAYOUTS)
@given(seed=st.integers(0, 10**6), rows=st.integers(4, 12), columns=st.integers(4, 12))
@examples(5)
def test_a_map_is_the_same_in_every_layout(tmp_path_factory, layout, seed, rows, columns):
    heights, (write, stated) = noise((rows, columns), seed), LAYOUTS[layout]
    pixel = tuple(np.random.default_rng(seed).uniform(0.1, 3.0, 2).round(3))
    path = tmp_path_factory.getbasetemp() / "map.txt"
    path.write_text(write(heights, pixel))
    stated = {
        name: tuple(1e-6 * each for each in pixel) if name == "pixel" else each for name, each in stated.items()
    }
    found = Topography(file=path, **stated)
    np.testing.assert_allclose(found.heights.heights, 1e-6 * heights, rtol=DIGITS, atol=1e-18)
    np.testing.assert_allclose(found.pixel, np.multiply(1e-6, pixel), rtol=1e-9)


def labelled(heights, pixel, **attributes):
    coords = {
        name: (name, np.arange(count) * side, attributes)
        for name, count, side in zip("yx", heights.shape, pixel[::-1], strict=True)
    }
    return xarray.DataArray(heights, coords, ("y", "x"), attrs=attributes)


def pivoted(heights, pixel):
    axes = zip(("y [um]", "x [um]"), heights.shape, pixel[::-1], strict=True)
    y, x = (pandas.Index(np.arange(count) * side * 1e6, name=name) for name, count, side in axes)
    return pandas.DataFrame(heights, y, x)


PIXEL = (2e-6, 3e-6)
ARRAYS = {
    "um": lambda h: {"heights": 1e6 * h, "pixel": PIXEL, "unit": "um"},
    "a pivoted DataFrame": lambda h: {"heights": pivoted(h, PIXEL)},
    "xarray in um": lambda h: {"heights": labelled(1e6 * h, (2.0, 3.0), units="um")},
    "a Dataset": lambda h: {
        "heights": xarray.Dataset({"a": labelled(h, PIXEL), "b": labelled(0 * h, PIXEL)}),
        "channel": "a",
    },
    "points in um": lambda h: {
        "heights": pandas.DataFrame(points(1e6 * h, (2.0, 3.0)), columns=["x (um)", "y (um)", "z (um)"])
    },
}


@pytest.mark.parametrize("kind", ARRAYS)
def test_a_map_is_the_same_in_every_library(kind):
    heights = 1e-6 * noise((5, 7))
    found = Topography(**ARRAYS[kind](heights))
    np.testing.assert_allclose(found.heights.heights, heights, rtol=DIGITS)
    np.testing.assert_allclose(found.pixel, PIXEL, rtol=1e-9)
    given = ARRAYS[kind](heights)
    described = Map.of(given.pop("heights"), **given).description
    assert described.rms_height == pytest.approx(levelled(heights, "tilt").std())


def written(tmp_path, content, name="map.txt"):
    path = tmp_path / name
    path.write_text(content)
    return path


def test_channels_are_never_joined(tmp_path):
    height, phase = noise((5, 6)), noise((5, 6), seed=1)
    file = written(
        tmp_path,
        gwyddion(height, (1, 1)) + "\n" + gwyddion(phase, (1, 1), "Phase").replace("units: um", "units: deg"),
    )
    with pytest.raises(InvalidInput, match=r"has 2 channels, 'Height', 'Phase': choose one, channel = 'Height'"):
        Topography(file=file)
    np.testing.assert_allclose(Topography(file=file, channel="height").heights.heights, 1e-6 * height, rtol=DIGITS)
    with pytest.raises(InvalidInput, match=r"has values in 'deg': a unit of length is needed"):
        Topography(file=file, channel="Phase")
    with pytest.raises(InvalidInput, match=r"channel = 'Error': .* has 'Height', 'Phase'"):
        Topography(file=file, channel="Error")
    # blocks without names are numbered
    file = written(tmp_path, text(height) + "\n" + text(phase))
    with pytest.raises(InvalidInput, match=r"has 2 channels, '1', '2'"):
        Topography(file=file, unit="um", pixel=1e-6)
    found = Topography(file=file, unit="um", pixel=1e-6, channel="2")
    np.testing.assert_allclose(found.heights.heights, 1e-6 * phase, rtol=DIGITS)
    np.save(tmp_path / "map.npy", height)
    with pytest.raises(InvalidInput, match=r"channel = 'front': .*map.npy holds one array, leave channel out"):
        Topography(file=tmp_path / "map.npy", channel="front", unit="um", pixel=1e-6)
    np.savez(tmp_path / "map.npz", front=height, back=phase)
    with pytest.raises(InvalidInput, match=r'no array heights; choose one of them, channel = "front"'):
        Topography(file=tmp_path / "map.npz", unit="um", pixel=1e-6)
    found = Topography(file=tmp_path / "map.npz", unit="um", pixel=1e-6, channel="back")
    np.testing.assert_allclose(found.heights.heights, 1e-6 * phase)


def test_what_a_file_states_may_be_stated_again_and_not_otherwise(tmp_path):
    file = written(tmp_path, gwyddion(noise((4, 5)), (2.0, 3.0)))
    found, again = Topography(file=file), Topography(file=file, pixel=("2 um", "3 um"), unit="um")
    assert again.heights == found.heights
    assert again.pixel == pytest.approx(found.pixel, rel=1e-12)
    for wrong, said in (
        ({"pixel": "2 um"}, "states its own, 2e-06 x 3e-06 m, leave pixel out"),
        ({"unit": "nm"}, "states its own, um, leave unit out"),
    ):
        with pytest.raises(InvalidInput, match=said):
            Topography(file=file, **wrong)


WRONG = {
    "a profile": ("1\n2\n3\n4\n5\n", 'line 1: 1 column of numbers, .* the type = "profile"'),
    "points on a line": (
        text(np.column_stack([np.arange(9), np.ones(9), noise(9)])),
        'all y are 1.*type = "profile"',
    ),
    "points on a diagonal": (text(np.repeat(np.arange(30.0), 3).reshape(30, 3)), "30 points on 30 x 30 places"),
    "points that are counted, and no heading": (
        text(np.column_stack([np.arange(30), points(noise((6, 5)), (1, 2))])),
        "columns 2 and 3 are places on a lattice: write a heading",
    ),
    "a line that is neither": (
        with_axes(noise((5, 5)), (1, 1), "[um]"),
        r"line 1: '\[um\];3.*is neither a row of",
    ),
    "uneven axes": (
        with_axes(noise((5, 5)), (1, 1), "y").replace("5.0000", "5.3000", 1),
        "first row .*: coordinates = 5.3 is on no lattice",
    ),
    "axes that contradict": (
        "Width: 10 um\n" + with_axes(noise((5, 5)), (1, 1), "y [um]"),
        "states pixels of 2e-06 m, and its axes lie 1e-06 m",
    ),
    "scattered points": (text(noise((200, 3))), "is on no lattice"),
    "a point off its place": (
        text(points(noise((5, 5)), (1, 1)) + np.where(np.arange(75) == 33, 0.2, 0).reshape(25, 3)),
        "line 12: x = 2.2",
    ),
    "a place twice": (
        text(np.vstack([points(noise((5, 5)), (1, 1)), [2, 3, 0.5]])),
        "line 26: a second height at x = 2, y = 3",
    ),
    "no place": ("x;y;z\n" + text([[1, NAN, 2], *points(noise((5, 5)), (1, 1))]), "line 2: a point needs x and y"),
    "a first row of numbers that count": (
        text(np.vstack([np.arange(8), noise((6, 8))])),
        "line 1: the first row, 0, 1, 2 .* as coordinates",
    ),
    "a side twice": (
        "X axis\nSpacing: 1 um\nY axis\nSpacing: 2 um\n\n" + text(noise((5, 5))),
        "'Spacing: 2 um' is another spacing than above",
    ),
    "units in a sentence": ("data in mm\n" + text(noise((5, 5))), "unit = 'um': .*map.txt speaks of mm above"),
    "sides that contradict": (
        "Width: 10 um\nPixel size: 3 um\n\n" + text(noise((5, 5))),
        "pixels of 3e-06 m and a size of 1e-05 m",
    ),
    "a unit of nothing": ("Width: 10 ell\n\n" + text(noise((5, 5))), "'Width: 10 ell'"),
}


@pytest.mark.parametrize("kind", WRONG)
def test_what_is_no_rectangle_of_heights_is_refused_with_its_place(tmp_path, kind):
    content, said = WRONG[kind]
    with pytest.raises(InvalidInput, match=said) as error:
        Topography(file=written(tmp_path, content), unit="um", pixel="1 um")
    assert "map.txt" in says(error)


def test_a_plane_is_heights_and_no_axes(tmp_path):
    plane = np.add.outer(np.arange(8.0), 2 * np.arange(9.0))
    found = Topography(file=written(tmp_path, text(plane)), unit="m", pixel=1.0)
    np.testing.assert_allclose(found.heights.heights, plane)
    plane[0, 0] = NAN  # no corner of axes, but missing
    found = Topography(file=written(tmp_path, text(plane)), unit="m", pixel=1.0, missing="fill")
    assert found.heights.shape == (8, 9)
    np.testing.assert_allclose(found.heights.heights.ravel()[1:], plane.ravel()[1:])


def test_axes_that_count_state_no_pixel(tmp_path):
    heights, frame = noise((5, 6)), StringIO()
    pandas.DataFrame(heights).to_csv(frame)
    file = written(tmp_path, frame.getvalue(), "map.csv")
    with pytest.raises(InvalidInput, match=r"does not state the side of a pixel"):
        Topography(file=file, unit="um")
    found = Topography(file=file, unit="um", pixel="2 um")
    np.testing.assert_allclose(found.heights.heights, 1e-6 * heights, rtol=1e-9)


def test_a_point_that_is_missing_is_a_missing_height(tmp_path):
    heights = noise((9, 9))
    file = written(tmp_path, text(points(heights, (1, 1), keep=np.arange(81) != 40)))
    with pytest.raises(InvalidInput, match=r"heights\[4\]\[4\] = nan.* 1 pixel has no height, 1.23 % of 81"):
        Topography(file=file, unit="m")
    found = Topography(file=file, unit="m", missing="fill").heights.heights
    heights[4, 4] = (heights[3, 4] + heights[5, 4] + heights[4, 3] + heights[4, 5]) / 4
    np.testing.assert_allclose(found, heights, rtol=DIGITS)


def test_matrices_of_other_programs_have_their_rows_along_y(tmp_path):
    pytest.importorskip("SurfaceTopography")
    heights = noise((5, 6))
    savemat(tmp_path / "map.mat", {"z": heights})
    found = Topography(file=tmp_path / "map.mat", unit="um", pixel=("1 um", "2 um"))
    np.testing.assert_allclose(found.heights.heights, 1e-6 * heights)


@pytest.mark.parametrize("name", ["map.asc", "map.dat", "map.prn"])
def test_a_text_of_another_ending_is_read_as_a_text(tmp_path, name):
    pytest.importorskip("SurfaceTopography")
    heights = noise((5, 6))
    for content, stated in (
        (gwyddion(heights, (1, 2)), {}),
        (text(heights, ";", ","), {"unit": "um", "pixel": 1e-6}),
    ):
        found = Topography(file=written(tmp_path, content, name), **stated)
        np.testing.assert_allclose(found.heights.heights, 1e-6 * heights, rtol=DIGITS)


@pytest.mark.parametrize("mark", ["***", "-nan(ind)", "masked", "Missing", "#N/A"])
def test_what_instruments_write_for_no_height_is_missing(tmp_path, mark):
    heights = noise((6, 7))
    rows = text(heights).split(";")
    rows[9] = mark
    file = written(tmp_path, ";".join(rows))
    with pytest.raises(InvalidInput, match=r"1 pixel has no height, 2.38 % of 42"):
        Topography(file=file, unit="um", pixel=1e-6)


HOLES = {
    "NaN": lambda h, at: np.where(at, NAN, h),
    "masked": lambda h, at: np.ma.masked_array(h, at),
    "-9999": lambda h, at: np.where(at, -9999.0, h),
    "32767": lambda h, at: np.where(at, 32767.0, np.rint(1000 * h)),
    "1e38": lambda h, at: np.where(at, 1e38, h),
    "one number that no program writes": lambda h, at: np.where(at, 4321.0, h),
}


@pytest.mark.parametrize("kind", HOLES)
@pytest.mark.parametrize("part", [Topography, Measured])
def test_missing_heights_are_refused_with_count_and_share_or_filled_in_and_told(kind, part):
    heights, at = noise((20, 20)), np.zeros((20, 20), bool)
    at[3:5, 7], at[0, 0] = True, True
    stated = {"heights": HOLES[kind](heights, at), "pixel": 1e-6}
    with pytest.raises(InvalidInput, match=r'3 pixels (hold|have).*0.75 % of 400.*missing = "fill"'):
        part(**stated)
    found = part(**stated, missing="fill")
    given, kept = np.ma.getdata(stated["heights"]), found.heights.heights
    assert np.array_equal(kept[~at], given[~at])
    assert given[~at].min() <= kept[at].min() <= kept[at].max() <= given[~at].max()
    assert any("0.75 % of 400, and were filled in" in note for note in found.notes)
    # notes are told wherever the map goes, and make no other map of it
    for twin in (pickle.loads(pickle.dumps(found)), replace(found, shortest_kept=4e-6)):
        assert twin.notes == found.notes
    assert found == part(heights=kept, pixel=1e-6)
    assert TypeAdapter(part).dump_python(found, mode="json") == TypeAdapter(part).dump_python(
        part(heights=kept, pixel=1e-6), mode="json"
    )


class Reader:
    """As SurfaceTopography opens a file of two channels, of which the second is its own choice."""

    def __init__(self, peer, heights):
        maps = {"Front": heights, "Back": np.ma.masked_array(2 * heights, heights == heights.max())}
        self.channels = [SimpleNamespace(name=name, **self.channel(peer, each)) for name, each in maps.items()]
        self.default_channel = self.channels[1]

    def channel(self, peer, heights):
        map_ = peer.Topography(heights.T, (12.0, 20.0), unit="um")
        return {
            "nb_grid_pts": map_.nb_grid_pts,
            "physical_sizes": map_.physical_sizes,
            "topography": lambda physical_sizes: map_,
        }

    def __enter__(self):
        return self

    def __exit__(self, *_):
        pass


def test_channels_and_holes_of_other_files_are_those_of_their_reader(tmp_path, monkeypatch):
    peer, heights = pytest.importorskip("SurfaceTopography"), noise((5, 6))
    monkeypatch.setattr(peer, "open_topography", lambda _: Reader(peer, heights))
    file = written(tmp_path, "0", "map.sur")
    front = Topography(file=file, channel="Front")
    np.testing.assert_allclose(front.heights.heights, 1e-6 * heights, rtol=DIGITS)
    assert front.pixel == pytest.approx((2e-6, 4e-6))
    assert front.notes == ()
    with pytest.raises(InvalidInput, match=r"1 pixel has no height, 3.33 % of 30"):
        Topography(file=file)
    back = Topography(file=file, missing="fill")
    assert "its channel 'Back' is taken, of 'Front', 'Back'" in back.notes[0]
    least = heights < heights.max()
    np.testing.assert_allclose(back.heights.heights[least], 2e-6 * heights[least], rtol=DIGITS)
    with pytest.raises(InvalidInput, match=r"channel = 'Side': .*map.sur has 'Front', 'Back'"):
        Topography(file=file, channel="Side")


def test_no_more_than_a_twentieth_is_filled_in():
    heights = noise((20, 20))
    heights.ravel()[:20] = NAN
    assert (
        Topography(heights=heights, pixel=1.0, missing="fill").notes[0].startswith("20 pixels had no height, 5 %")
    )
    heights[5, 5] = NAN
    with pytest.raises(
        InvalidInput, match=r"21 pixels have no height, 5.25 % of 400, and at most 5 % are filled in"
    ):
        Topography(heights=heights, pixel=1.0, missing="fill")
    heights[:] = NAN
    with pytest.raises(InvalidInput, match=r"400 pixels have no height, 100 %"):
        Topography(heights=heights, pixel=1.0, missing="fill")


@pytest.mark.parametrize("height", [1e-9, 1.0, 1e40])
def test_what_is_far_off_nothing_is_no_missing_height(height):
    # peaks and pits that are rare and high, beside heights that are all alike, or few
    spike, binary, steps = np.zeros((9, 9)), np.indices((9, 9)).sum(axis=0) % 2, np.floor(noise((9, 9)))
    spike[3, 3] = 1.0
    bump = np.exp(-(np.hypot(*(np.indices((40, 40)) - 20.0)) ** 2) / 8)
    for heights in (spike, binary, steps, bump, 50 * bump + 0.3 * noise((40, 40)), np.exp(3 * noise((40, 40)))):
        assert sentinels(height * heights) == []
    # pixels of which one is missing at either end
    both = noise((9, 9))
    both[2, 2], both[3, 3] = -9999, 9999
    assert sentinels(both) == [-9999, 9999]


def test_a_hole_in_a_harmonic_surface_is_filled_in_with_it():
    # a product of cosine and cosh: to the error of second differences, a quarter on half the pixel
    errors = []
    for count in (20, 40):
        x, y = (np.arange(count) + 0.5) / count, ((np.arange(2 * count) + 0.5) / (2 * count))[:, None]
        surface = np.cos(2 * x) * np.cosh(2 * y)
        hole = (np.abs(x - 0.5) < 0.1) & (np.abs(y - 0.5) < 0.1)
        found = filled(np.where(hole, NAN, surface), (1 / count, 0.5 / count))
        errors.append(np.abs(found - surface).max())
    assert errors[1] == pytest.approx(errors[0] / 4, rel=0.25)
    assert errors[1] < 1e-5
    # planes and xy are harmonic on any lattice, and at a side nothing leaves
    x, y = np.meshgrid(np.arange(12.0), np.arange(10.0))
    for surface in (1 + 2 * x + 3 * y, x * y, x**2 - y**2):
        assert filled(np.where((x > 3) & (x < 6) & (y > 3) & (y < 7), NAN, surface), (1, 1)) == pytest.approx(
            surface
        )
    assert filled(np.where((x < 3) & (y < 2), NAN, 7.0), (1, 2)) == pytest.approx(7.0)


def test_outliers_are_found_on_request_and_counted():
    y, x = np.mgrid[0:30, 0:40]
    smooth = np.sin(x / 8) + np.cos(y / 6) + 0.02 * noise((30, 40))
    spikes = np.zeros((30, 40), bool)
    spikes[[3, 14, 0], [5, 20, 39]] = True
    heights = smooth + np.where(spikes, 1.0, 0.0)
    assert np.array_equal(outliers(heights, 15.0), spikes)
    assert Topography(heights=heights, pixel=1e-3).notes == ()
    found = Topography(heights=heights, pixel=1e-3, outliers=15)
    said = "3 pixels were more than 15 robust standard deviations off the median around, 0.25 % of 1200"
    assert found.notes == (f"{said}, and filled in",)
    assert np.abs(found.heights.heights - smooth).max() < 0.1
    assert np.array_equal(found.heights.heights[~spikes], heights[~spikes])
    # of normal noise 0.27 % lie beyond three deviations, up to twice that as the median has noise of its own
    normal = noise((300, 300))
    beyond = outliers(normal, 3.0).mean()
    assert 0.0027 < beyond < 0.0054
    with pytest.raises(InvalidInput, match=rf"more than half of the heights are the median of the {NEIGHBOURS} x"):
        Topography(heights=np.where(spikes, 1.0, 0.0), pixel=1e-3, outliers=10)
    for wrong in (2.9, NAN, "ten", True):
        with pytest.raises(
            InvalidInput, match=r"outliers = .*a number of standard deviations|outliers = .*number"
        ):
            Topography(heights=heights, pixel=1e-3, outliers=wrong)
    with pytest.raises(InvalidInput, match=r"0.0833 % of 1200: missing"):
        Topography(heights=np.where(np.arange(1200).reshape(30, 40) == 77, NAN, heights), pixel=1e-3, outliers=10)


def test_a_crop_is_the_map_of_what_it_keeps():
    heights = noise((20, 30))
    whole = {"heights": heights, "pixel": (2e-6, 3e-6)}
    kept = {"heights": heights[3:13, 5:20], "pixel": (2e-6, 3e-6)}
    crop = ["10 um", "40 um", "9 um", "39 um"]
    for level in DEGREES:
        found = Topography(**whole, crop=crop, level=level)
        assert found == Topography(**kept, level=level)
        np.testing.assert_array_equal(found.relief, Topography(**kept, level=level).relief)
    assert found.notes == ("cropped to 15 x 10 of 30 x 20 pixels",)
    assert Measured(**whole, crop=np.array([10e-6, 40e-6, 9e-6, 39e-6])) == Measured(**kept)
    assert replace(Topography(**whole), crop=crop).heights.shape == (10, 15)
    # what is cut away may be missing
    heights[0, 0] = NAN
    assert Topography(**whole | {"heights": heights}, crop=crop) == Topography(**kept)
    for wrong in (
        [5, 20, 3, 13],
        ["40 um", "10 um", "9 um", "39 um"],
        "10 um",
        [NAN] * 4,
    ):
        with pytest.raises(
            InvalidInput,
            match=r"crop = .*(x from, x to, y from, y to as lengths, 0 to 6e-05 m|a list|a length)",
        ):
            Topography(**whole, crop=wrong)


@given(seed=st.integers(0, 10**6), rows=st.integers(4, 30), columns=st.integers(4, 30))
@examples(20)
def test_a_level_takes_off_all_forms_of_its_degree_and_nothing_else(seed, rows, columns):
    coefficients = noise((4, 4), seed)
    y, x = np.linspace(-1, 2, rows)[:, None], np.linspace(0, 3, columns)
    rest = levelled(noise((rows, columns), seed), "cubic")
    for level, degree in DEGREES.items():
        terms = [(i, j) for i in range(degree + 1) for j in range(degree + 1 - i)]
        form = sum(coefficients[i, j] * y**i * x**j for i, j in terms) + 0 * x * y
        assert np.abs(levelled(form, level)).max() <= 1e-13 * np.abs(form).max()
        np.testing.assert_allclose(levelled(rest + form, level), rest, atol=1e-13 * np.abs(form).max() + 1e-14)
        above = y ** (degree + 1) + x ** (degree + 1)
        assert min(rows, columns) < degree + 2 or np.abs(levelled(above, level)).max() > 1e-3


FILE = """
indenter = { type = "sphere", radius = 1e-2 }
elastomer = { type = "elastic", modulus = 1e6 }
motion = { type = "indent", load = 1.0 }
[roughness]
type = "topography"
pixel = "1 um"
unit = "um"
"""


def test_a_scene_file_states_what_is_done_to_a_map(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    heights = noise((30, 30))
    heights[2, 2] = NAN
    np.savetxt("map.csv", heights, delimiter=";")
    more = 'file = "map.csv"\nmissing = "fill"\noutliers = 6\nlevel = "cubic"\n'
    more += 'crop = ["0 um", "20 um", "0 um", "10 um"]\n'
    (tmp_path / "scene.toml").write_text(FILE + more)
    found = read("scene.toml", Scene).roughness
    assert found.heights.shape == (10, 20)
    assert len(found.notes) == 3
    (tmp_path / "scene.toml").write_text(FILE + more.replace('"fill"', '"full"'))
    with pytest.raises(InvalidInput, match=r"missing = 'full': 'refuse' or 'fill'"):
        read("scene.toml", Scene)


def test_a_file_that_is_not_there_is_named_with_the_folder_in_which_it_was_sought(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for written_, said in (
        ("maps/a.csv", f"maps/a.csv: no such file in {tmp_path}, the working directory"),
        (f"{tmp_path}/a.csv", f"{tmp_path}/a.csv: no such file"),
        (
            "C:\\new\\table.csv",
            "no such file: a backslash in double quotes .* single quotes, or with forward slashes",
        ),
        ("C:\\Users\\map.csv", "is not valid TOML: .* a path with backslashes stands in single quotes"),
    ):
        (tmp_path / "scene.toml").write_text(FILE + f'file = "{written_}"\n')
        with pytest.raises(InvalidInput, match=said):
            read("scene.toml", Scene)


def test_a_page_tells_what_was_done_to_a_map():
    heights = np.ma.masked_array(noise((30, 30)), np.arange(900).reshape(30, 30) == 77)
    stated = {"pixel": "1 um", "unit": "um", "missing": "fill", "crop": ["0 um", "20 um", "0 um", "20 um"]}
    study = Map.of(heights, shortest_kept="4 um", **stated)
    filled_in = "1 pixel had no height, 0.25 % of 400, and was filled in"
    assert {"cropped to 20 x 20 of 30 x 30 pixels", filled_in} < set(study.lines())
    assert filled_in in study.notes  # which stand before the answer
    assert study.title == "Topography of MaskedArray"
    with pytest.raises(InvalidInput, match=r'missing = "fill"'):
        Map.of(heights, pixel="1 um")
