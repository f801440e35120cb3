"""A map is read in its one form as it is, or refused; missing heights are refused, or filled in with a note."""

import contextlib
import pickle
import sys
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pandas
import pint
import pytest
import xarray
from hypothesis import assume, given
from hypothesis import strategies as st
from maps import noise, refused
from numpy.polynomial.polynomial import polyval2d
from scipy.io import savemat
from strategies import examples

import scene.files.heightfile
from scene import Measured, Profile, Scene, Topography
from scene.files.reading import InvalidInput, read
from scene.surfaces.heightmap import DEGREES, levelled
from scene.surfaces.missing import filled, sentinels

DIGITS = 1e-12  # what texts with 15 digits keep
NAN = np.nan
PIXEL = (2e-6, 3e-6)
UM = {"unit": "um", "pixel": PIXEL}
SQUARE = noise((9, 9))
SEPARATORS = {"\t": "tab", ";": "semicolon", ",": "comma", " ": "blanks"}


def text(numbers, separator=";", decimal="."):
    lines = (separator.join("" if np.isnan(n) else f"{n:.15e}" for n in row) for row in np.atleast_2d(numbers))
    return "\n".join(lines).replace(".", decimal) + "\n"


def points(heights, pixel=(2.0, 3.0), seed=None, keep=None):
    """x, y, z [um] of a map in mixed order, 1 um from the origin."""
    rows, columns = np.indices(heights.shape)
    every = np.column_stack([1 + columns.ravel() * pixel[0], 1 + rows.ravel() * pixel[1], heights.ravel()])
    every = every if keep is None else every[keep]
    return every if seed is None else np.random.default_rng(seed).permutation(every)


def written(tmp_path, content, name="map.txt"):
    path = tmp_path / name
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return path


GWYDDION = "# Channel: Height\n# Width: 14.00 µm\n# Height: 15.00 µm\n# Value units: m\n"
NUMBERED = {"columns": {"x": 1, "y": 2, "z": 3}}
IN_UM = dict.fromkeys("xyz", "um")


def cell(text):
    return lambda rows, k, j: [*rows[:k], [*rows[k][:j], text, *rows[k][j + 1 :]], *rows[k + 1 :]]


def above(make):
    return lambda rows, k, j: [make(range(len(rows[0]))), *rows]


def each_row(change):
    return lambda rows, k, j: [change(row, at == k, at) for at, row in enumerate(rows)]


# Of lines and the cells of their rows: what texts have besides a rectangle of numbers, and where it goes.
DAMAGES = {
    "nothing": lambda rows, k, j: rows,
    "a comment with a unit": above(lambda columns: ["# Value units: nm"]),
    "words above": above(lambda columns: ["Height Sensor (nm)"]),
    "a heading": above(lambda columns: [f"z{at} [nm]" for at in columns]),
    "a first row of places": above(lambda columns: [f"{0.5 * at}" for at in columns]),
    "axes": lambda rows, k, j: [
        ["", *map(str, range(len(rows[0])))],
        *([f"{0.5 * at}", *row] for at, row in enumerate(rows)),
    ],
    "a first column of numbers": each_row(lambda row, here, at: [str(at), *row]),
    "a blank line": lambda rows, k, j: [*rows[:-1], [], rows[-1]],
    "a cell more": each_row(lambda row, here, at: [*row, *["1"] * here]),
    "a cell less": each_row(lambda row, here, at: row[here:]),
    "a hole": cell(""),
    "nan": cell("-NaN"),
    "a word": cell("***"),
    "digits with marks": cell("1_000"),
    "thousands": each_row(lambda row, here, at: [f"{float(each):,.1f}" for each in row]),
    "another map": lambda rows, k, j: [*rows, ["# Channel: Phase"], *rows],
    "an end of each row": each_row(lambda row, here, at: [*row, ""]),
}
ABOVE = {"a comment with a unit", "words above", "a heading", "axes", "a first row of places"}
READ = {"nothing", "nan", "an end of each row"}  # with nothing stated but the unit and the pixel


@given(
    seed=st.integers(0, 10**6),
    shape=st.tuples(st.integers(9, 12), st.integers(9, 12)),  # any six may be even
    damage=st.sampled_from(sorted(DAMAGES)),
    marks=st.tuples(st.sampled_from(sorted(SEPARATORS)), st.sampled_from(".,")),
    digits=st.integers(0, 3),
    stated=st.fixed_dictionaries(
        {},
        optional={
            "skip": st.integers(0, 2),
            "rows": st.integers(7, 12),
            "decimal": st.sampled_from(".,"),
            "separator": st.sampled_from(sorted(SEPARATORS.values())),
        },
    ),
)
@examples(200)
def test_a_rectangle_is_read_as_it_stands_or_refused(tmp_path_factory, seed, shape, damage, marks, digits, stated):
    (separator, decimal), heights = marks, np.round(1000 * noise(shape, seed), digits)
    assume(marks != (",", ",") or stated.get("decimal") != ".")  # which is not so, and read as it is stated
    k, j = seed % (shape[0] - 1), seed % shape[1]
    rows = DAMAGES[damage]([[f"{each:.{digits}f}" for each in row] for row in heights], k, j)
    lines = [separator.join(row).replace(".", decimal) for row in rows]
    path = written(tmp_path_factory.getbasetemp(), "\n".join(lines) + "\n", "rectangle.txt")
    try:
        found = Topography(file=path, pixel=1e-6, unit="m", missing="fill", **stated).heights.heights
    except InvalidInput:
        commas = marks == (" ", ",") or (separator == "," and (decimal == "," or digits == 0))
        assert damage not in READ or stated or commas
        return
    begin = stated.get("skip", 0) - (damage in ABOVE)
    assert begin >= 0
    kept = slice(begin, begin + stated.get("rows", shape[0]))
    if damage in ("a hole", "nan"):
        heights[k, j] = NAN
    assert found.shape == heights[kept].shape
    assert np.all((found == heights[kept]) | np.isnan(heights[kept]))


def labelled(heights, pixel, **attributes):
    coords = {
        name: (name, np.arange(count) * side, attributes)
        for name, count, side in zip("yx", heights.shape, pixel[::-1], strict=True)
    }
    return xarray.DataArray(heights, coords, ("y", "x"), attrs=attributes)


def in_netcdf(path, heights, *turned, **attributes):
    labelled(heights, (2.0, 3.0), **attributes).transpose(*turned).to_dataset(name="z").to_netcdf(path)
    return path


def saved(array):
    def save(path):
        np.savez(path, array) if path.suffix == ".npz" else np.save(path, array)
        return path

    return save


def archive(path, **arrays):
    np.savez(path, **arrays)
    return path


UM_OF_PINT = pint.UnitRegistry()("um")
# Of heights in um, and a folder: what a map of them is given as.
GIVEN = {
    "an array": lambda h, at: {"heights": h, **UM},
    "an array with a unit": lambda h, at: {"heights": h * UM_OF_PINT, "pixel": PIXEL},
    "a masked array": lambda h, at: {"heights": np.ma.masked_invalid(h), **UM},
    "xarray": lambda h, at: {"heights": labelled(h, (2.0, 3.0), units="um")},
    "xarray, turned and falling": lambda h, at: {"heights": labelled(h, (2.0, 3.0), units="um").T[::-1, ::-1]},
    "points": lambda h, at: {"heights": pandas.DataFrame(points(h), columns=["x (um)", "y (um)", "z (um)"])},
    "arrays by name": lambda h, at: {
        "heights": dict(zip("xyz", points(h, seed=2).T, strict=True)),
        "units": IN_UM,
    },
    "npy": lambda h, at: {"file": saved(h)(at / "a.npy"), **UM},
    "npz of several": lambda h, at: {"file": archive(at / "a.npz", z=h, u=0 * h), "channel": "z", **UM},
    "NetCDF": lambda h, at: {"file": in_netcdf(at / "a.nc", h, "x", "y", unit="um")},
    "NetCDF without units": lambda h, at: {"file": in_netcdf(at / "a.nc", h), **UM},
    "blanks and decimal commas": lambda h, at: {"file": written(at, text(h, " ", ",")), **UM, "decimal": ","},
    "Gwyddion": lambda h, at: {
        "file": written(at, GWYDDION + text(1e-6 * h, "\t")),
        "skip": 4,
        "unit": "m",
        "pixel": ("2 um", "3 um"),
    },
    "the second of two": lambda h, at: {
        "file": written(at, GWYDDION + text(0 * h) + GWYDDION + text(h) + "\n" + GWYDDION),
        "skip": 13,
        "rows": 5,
        **UM,
    },
    "points in any order": lambda h, at: {
        "file": written(at, "# um? nm\nx [um];y [um];Height [nm]\n" + text(points(1e3 * h, seed=1)))
    },
    "points without a heading": lambda h, at: {
        "file": written(at, text(points(h), ",")),
        **NUMBERED,
        "units": IN_UM,
    },
    "points and a unit": lambda h, at: {"file": written(at, "x [um];y [um];z\n" + text(points(h))), **UM},
}


@pytest.mark.parametrize("kind", GIVEN)
def test_a_map_is_the_same_in_every_text_array_and_library(tmp_path, kind):
    heights = noise((5, 7))
    found = Topography(**GIVEN[kind](heights, tmp_path))
    np.testing.assert_allclose(found.heights.heights, 1e-6 * heights, rtol=DIGITS)
    np.testing.assert_allclose(found.pixel, PIXEL, rtol=1e-9)


class Trap:
    """Whose loading would be seen."""

    def __reduce__(self):
        return pytest.fail, ("code of a file was executed",)


BAD_ARRAYS = {
    "a pickle": (lambda path: path.write_bytes(pickle.dumps(Trap())), "cannot be read as an array: .*pickle"),
    "objects": (saved(np.full((5, 5), Trap(), object)), "cannot be read as an array: Object"),
    "truths": (saved(np.eye(5) > 0), "an array of type bool"),
    "half of an array": (lambda path: path.write_bytes(saved(SQUARE)(path).read_bytes()[:400]), "cannot be read"),
}


@pytest.mark.parametrize("kind", BAD_ARRAYS)
@pytest.mark.parametrize("ending", ["npy", "npz"])
def test_an_array_that_is_no_map_is_refused(tmp_path, kind, ending):
    write, message = BAD_ARRAYS[kind]
    write(tmp_path / f"a.{ending}")
    refused(message, file=tmp_path / f"a.{ending}", **UM)


def test_what_is_larger_than_is_read_is_not(tmp_path, monkeypatch):
    saved(SQUARE)(tmp_path / "b.npy")
    monkeypatch.setattr(scene.files.heightfile, "MOST_BYTES", 2**12)
    for name in ("a.npy", "a.csv", "a.sur"):
        refused("at most", file=written(tmp_path, bytes(2**12 + 1), name), **UM)
    monkeypatch.setattr(scene.files.heightfile, "MOST_PIXELS", 80)
    refused("pixels: at most 80", file=tmp_path / "b.npy", **UM)


AXES = np.vstack([np.arange(9.0), SQUARE])


def in_metres(places):
    return "x [m];y [m];z [m]\n" + text(places)


WRONG = {
    # content of a file, its statements, the message
    "no unit and no pixel": (
        text(SQUARE),
        {},
        'map.txt does not state its unit: state it, as unit = "um"',
    ),
    "a wrong unit": (
        text(SQUARE),
        {"unit": "mV", "pixel": 1.0},
        "unit = 'mV': a unit of length is needed",
    ),
    "Gwyddion": (
        GWYDDION + text(SQUARE),
        {},
        'map.txt, line 1, .* state skip = 4 .* unit = "um" and pixel',
    ),
    "a heading": ("a;b;c\n" + text(SQUARE[:, :3]), UM, "there is no column x .*columns = .* or skip"),
    "no pixel": (text(SQUARE), {"unit": "um"}, 'map.txt does not state its pixel: .* pixel = "1 um"'),
    "a line": (text(SQUARE[:, :1]), UM, "line 1: 1 columns of numbers alone"),
    "points without a heading": (text(points(SQUARE)), UM, "line 1: 3 columns .*state columns = {x = 1"),
    "whole numbers": (
        text(SQUARE, ",").replace(".", ","),
        UM,
        "commas may stand between .*state decimal",
    ),
    "points of unknown units": (text(points(SQUARE)), {**NUMBERED, "unit": "um"}, "state units = {x = "),
    "points that are counted": (
        text(np.column_stack([noise(81), points(SQUARE)])),
        UM,
        "columns 2 and 3 are places on a lattice: of points state columns = {x = 2, y = 3, z = 4}",
    ),
    "an axis above": (text(AXES), UM, "the first row, .* is evenly spaced as places are"),
    "an axis at the side": (text(AXES.T), UM, "the first column, .* is evenly spaced as places are"),
    "a channel of a text": (text(SQUARE), {**UM, "channel": "Height"}, "map.txt is one map; skip and rows choose"),
    "points on a line": ("x [m] y [m] z [m]\n1 1 1\n2 1 2\n", {}, 'all y are 1: .* type = "profile"'),
    "points on a diagonal": (
        in_metres(np.repeat(np.arange(30.0), 3).reshape(30, 3)),
        {},
        "30 points on 30 x 30 places",
    ),
    "scattered points": (
        in_metres(noise((99, 3))),
        {},
        "is off by more than 5 %",
    ),
    "a point off its place": (
        in_metres(points(SQUARE) + np.where(np.arange(243) == 33, 0.2, 0).reshape(81, 3)),
        {},
        "line 13: x = 5.2 is off by more than 5 % of a step",
    ),
    "a place twice": (
        in_metres(np.vstack([points(SQUARE), [3, 4, 0.5]])),
        {},
        "line 83: a second height at x = 3, y = 4",
    ),
    "no place": (
        in_metres(np.vstack([points(SQUARE), [NAN, 4, 0.5]])),
        {},
        "line 83, column 'x .m.': '' is no number",
    ),
}


@pytest.mark.parametrize(("content", "stated", "message"), WRONG.values(), ids=WRONG)
def test_what_is_not_in_the_one_form_is_refused_with_what_to_state(tmp_path, content, stated, message):
    refused(message, file=written(tmp_path, content), **stated)


@pytest.mark.parametrize("ending", [".png", ".tif", ".xlsx", ".stl"])
@pytest.mark.parametrize("part", [Topography, Measured, Profile])
def test_pictures_workbooks_and_meshes_are_refused_by_what_they_are(tmp_path, ending, part):
    refused(rf"a\{ending} is a picture, a workbook or a mesh", part, file=written(tmp_path, "", f"a{ending}"))


def test_what_is_stated_twice_agrees_or_is_refused(tmp_path):
    file = in_netcdf(tmp_path / "a.nc", SQUARE, units="um")
    table = written(tmp_path, "x [um];y [um];z [um]\n" + text(points(SQUARE)))
    found, array = Topography(file=file), labelled(SQUARE, PIXEL, units="m")
    assert Topography(file=file, pixel=("2 um", "3 um"), unit="um").heights == found.heights
    refused("a.nc states its own, 2e-06 x 3e-06 m: leave pixel out", file=file, pixel="2 um")
    refused("a.nc states its own, 1e-06 m: leave unit out", file=file, unit="nm")
    refused("states its own, 2e-06 x 3e-06 m: leave pixel out", file=table, pixel="1 um")
    refused("must agree", file=table, unit="nm")
    refused("heights is one map", heights=SQUARE, channel="a", **UM)
    refused("a.npz is no text and no table: leave out", file=saved(SQUARE)(tmp_path / "a.npz"), skip=3, **UM)
    refused("heights is no text and no table", heights=SQUARE, skip=2, **UM)
    refused("heights are in metres", heights=found.heights, pixel=1.0, unit="um")
    refused("heights are both stated", heights=SQUARE, file=file)
    refused(r"dimensions of heights = \('y', 'u'\)", heights=array.rename(x="u"))
    refused("is not one step from the one before it", heights=array[[0, 1, 3, 4, 5]])
    refused("coordinates of", heights=labelled(SQUARE, PIXEL, units="V"))
    refused("does not state its pixel", heights=labelled(SQUARE, PIXEL).assign_attrs(units="um"))


def test_a_plane_is_heights_and_no_axes(tmp_path):
    plane = np.add.outer(np.arange(8.0), 2 * np.arange(9.0))
    found = Topography(file=written(tmp_path, text(plane)), unit="m", pixel=1.0)
    np.testing.assert_allclose(found.heights.heights, plane)


def test_a_point_that_is_missing_is_a_missing_height(tmp_path):
    kept = points(SQUARE, (1, 1), keep=np.arange(81) != 40)
    file = written(tmp_path, in_metres(kept))
    refused(r"heights\[4\]\[4\] = nan: 1 of 81 heights \(1.23 %\) missing", file=file)
    found, known = Topography(file=file, missing="fill").heights.heights, SQUARE.copy()
    known[4, 4] = np.mean([known[3, 4], known[5, 4], known[4, 3], known[4, 5]])
    np.testing.assert_allclose(found, known, rtol=DIGITS)


def test_files_of_instruments_are_read_by_surface_topography(tmp_path, monkeypatch):
    pytest.importorskip("SurfaceTopography")
    heights, unknown = noise((5, 6)), written(tmp_path, "\0" * 99, "map.sur")
    # rows of matrices are along y
    savemat(tmp_path / "map.mat", {"z": heights})
    found = Topography(file=tmp_path / "map.mat", unit="um", pixel=("1 um", "2 um"))
    np.testing.assert_allclose(found.heights.heights, 1e-6 * heights)
    refused("map.sur cannot be read by SurfaceTopography", file=unknown)
    refused("it is a text", file=written(tmp_path, text(heights, "\t"), "map.sur"), **UM)
    monkeypatch.setitem(sys.modules, "SurfaceTopography", None)
    refused(r"mdr-bem-crosscheck\[topography\]", file=unknown)


class Reader(contextlib.nullcontext):
    """As SurfaceTopography opens a file of two channels of heights in um."""

    def __init__(self, peer, heights, unit="um"):
        super().__init__(self)
        self.channels = []
        for name, each in {"Front": heights, "Back": np.ma.masked_equal(2 * heights, 2 * heights.max())}.items():
            map_ = peer.Topography(each.T, (12.0, 20.0), unit=unit)
            sizes = {"nb_grid_pts": map_.nb_grid_pts, "physical_sizes": map_.physical_sizes}
            self.channels.append(SimpleNamespace(name=name, topography=lambda physical_sizes, m=map_: m, **sizes))


def test_channels_sizes_units_and_holes_of_other_files_are_those_of_their_reader(tmp_path, monkeypatch):
    peer, heights = pytest.importorskip("SurfaceTopography"), noise((5, 6))
    monkeypatch.setattr(peer, "open_topography", lambda _: Reader(peer, heights))
    file = written(tmp_path, "0", "map.sur")
    front, back = (Topography(file=file, channel=name, missing="fill") for name in ("Front", "Back"))
    np.testing.assert_allclose(front.heights.heights, 1e-6 * heights, rtol=DIGITS)
    assert front.pixel == pytest.approx((2e-6, 4e-6))
    least = heights < heights.max()
    np.testing.assert_allclose(back.heights.heights[least], 2e-6 * heights[least], rtol=DIGITS)
    refused(r"1 of 30 heights \(3.33 %\) missing", file=file, channel="Back")
    for channel in (None, "Side"):
        refused(f"map.sur .*: channel = {channel!r}: state one of 'Front', 'Back'", file=file, channel=channel)
    # a size without a unit is none
    monkeypatch.setattr(peer, "open_topography", lambda _: Reader(peer, heights, unit=None))
    refused("does not state its unit", file=file, channel="Front")
    assert Topography(file=file, channel="Front", **UM).pixel == PIXEL


HOLES = {
    "NaN": lambda h, at: np.where(at, NAN, h),
    "masked": lambda h, at: np.ma.masked_array(h, at),
    "-9999": lambda h, at: np.where(at, -9999.0, h),
    "32767": lambda h, at: np.where(at, 32767.0, np.rint(1000 * h)),
    "1e38": lambda h, at: np.where(at, 1e38, h),
    "one number that no program writes": lambda h, at: np.where(at, 43210.0, h),
}


PARTS = [(Topography, (20, 20), "pixel"), (Measured, (20, 20), "pixel"), (Profile, (400,), "spacing")]


@pytest.mark.parametrize("kind", HOLES)
@pytest.mark.parametrize(("part", "shape", "spacing"), PARTS)
def test_missing_heights_are_refused_with_count_and_share_or_filled_in_and_told(kind, part, shape, spacing):
    at = np.isin(np.arange(400), [0, 67, 87]).reshape(shape)
    stated = {"heights": HOLES[kind](noise(400).reshape(shape), at), spacing: 1e-6}
    refused(r'3 of 400 heights \(0.75 %\) (are|missing).*missing = "fill"', part, **stated)
    found = part(**stated, missing="fill")
    given, kept = np.ma.getdata(stated["heights"])[~at], found.heights.heights
    assert np.array_equal(kept[~at], given)
    assert given.min() <= kept[at].min() <= kept[at].max() <= given.max()
    assert "3 of 400 heights (0.75 %) were missing and are filled in" in found.notes
    # notes stay with the map wherever it goes, and make no other map of it
    for twin in (pickle.loads(pickle.dumps(found)), replace(found, peaks="down")):
        assert twin.notes == found.notes
    assert found == part(**stated | {"heights": kept})


@pytest.mark.parametrize(
    ("holes", "message"),
    [
        (20, None),
        (21, r"21 of 400 heights \(5.25 %\) missing: at most 5 % are filled in"),
        (400, r"400 of 400 heights \(100 %\) missing"),
    ],
)
def test_no_more_than_a_twentieth_is_filled_in(holes, message):
    heights = np.where(np.arange(400) < holes, NAN, noise(400)).reshape((20, 20))
    stated = {"heights": heights, "pixel": 1.0, "missing": "fill"}
    if message is None:
        assert Topography(**stated).notes[0].startswith("20 of 400 heights (5 %)")
    else:
        refused(message, **stated)


Y, X = np.mgrid[0:30, 0:40]
BUMP = np.exp(-(np.hypot(*(np.indices((40, 40)) - 20.0)) ** 2) / 8)
# Of programs: both ends are numbers that stand for none.
BOTH = np.where(np.eye(9) > 0, np.where(np.arange(9) < 4, -9999.0, 9999.0), SQUARE)


@pytest.mark.parametrize("height", [1e-9, 1.0, 1e40])
@pytest.mark.parametrize(
    "heights",
    [
        np.where(np.arange(81).reshape(9, 9) == 30, 1.0, 0.0),
        np.indices((9, 9)).sum(axis=0) % 2,
        np.floor(SQUARE),
        BUMP,
        50 * BUMP + 0.3 * noise((40, 40)),
        np.exp(3 * noise((40, 40))),
    ],
    ids=["a spike", "two heights", "steps", "a bump", "a bump on noise", "peaks"],
)
def test_heights_that_are_rare_high_or_all_alike_are_not_missing(height, heights):
    assert sentinels(height * heights) == []


def test_a_number_at_either_end_may_stand_for_none():
    assert sentinels(BOTH) == [-9999, 9999]


INSIDE = (X > 3) & (X < 6) & (Y > 3) & (Y < 7)


@pytest.mark.parametrize(
    ("surface", "hole", "pixel"),
    [
        *((each, INSIDE, (1, 1)) for each in (1 + 2 * X + 3 * Y, X * Y, X**2 - Y**2)),
        (7.0, (X < 3) & (Y < 2), (1, 2)),  # at a side nothing leaves
        (1 + 2 * X[0], INSIDE[5], (1, 1)),  # a line, on which a straight one is harmonic
    ],
)
def test_a_hole_in_a_surface_that_is_harmonic_on_any_lattice_is_filled_in_exactly(surface, hole, pixel):
    assert filled(np.where(hole, NAN, surface), pixel) == pytest.approx(surface)


@given(seed=st.integers(0, 10**6), rows=st.integers(4, 30), columns=st.integers(4, 30))
@examples(20)
def test_a_level_takes_off_all_forms_of_its_degree_and_nothing_else(seed, rows, columns):
    coefficients, orders = noise((4, 4), seed), np.indices((4, 4)).sum(axis=0)
    y, x = np.meshgrid(np.linspace(-1, 2, rows), np.linspace(0, 3, columns), indexing="ij")
    rest = levelled(noise((rows, columns), seed), "cubic")
    for level, degree in DEGREES.items():
        form = polyval2d(y, x, np.where(orders <= degree, coefficients, 0))
        rounding = 1e-13 * np.abs(form).max()
        assert np.abs(levelled(form, level)).max() <= rounding
        np.testing.assert_allclose(levelled(rest + form, level), rest, atol=rounding + 1e-14)
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


def test_a_scene_file_states_what_is_done_to_a_map(tmp_path):
    heights = noise((30, 30))
    heights[2, 2] = NAN
    written(tmp_path, text(heights), "map.csv")
    more = 'file = "map.csv"\nmissing = "fill"\n'
    found = read(written(tmp_path, FILE + more, "scene.toml"), Scene).roughness
    assert found.heights.shape == (30, 30)
    assert len(found.notes) == 1
    refused(
        r"missing = 'full': 'refuse' or 'fill'",
        read,
        written(tmp_path, FILE + more.replace('"fill"', '"full"'), "scene.toml"),
        Scene,
    )
