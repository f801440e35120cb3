"""A measured map is what was measured: at its pixels, by its key, from its file; and what is none is named."""

import copy
import json
import pickle
import signal
import sys
import tracemalloc
import warnings
from contextlib import suppress
from dataclasses import replace
from math import pi
from zipfile import ZIP_DEFLATED, ZIP_LZMA, ZipFile

import numpy as np
import pytest
from maps import noise, says

import scene.heightfile
import scene.topography
from compare.library.case import Case
from compare.solving.task import SCENES
from scene import Elastic, Indent, Measured, Plane, Scene, SelfAffine, Sphere, Topography
from scene.heightfile import MOST_BYTES
from scene.reading import InvalidInput, read
from scene.sheet import LINE
from scene.waves import MOST_WAVES

ROUNDING = 1e-13  # of heights of order one, summed over some ten waves
SPLINE = 1e-12  # a paraboloid is a bicubic spline: what is left is rounding


def rough(heights=None, **other):
    heights = noise((6, 8)) if heights is None else heights
    return Topography(**{"heights": heights, "pixel": 1e-3, "peaks": "down", "level": "mean"} | other)


def summed(waves, x, y):
    along_y, along_x = (np.exp(1j * np.outer(at, q)) for at, q in ((y, waves.along_y), (x, waves.along_x)))
    return (along_y @ waves.amplitudes @ along_x.T).real


def places(topography):
    (rows, columns), (dx, dy) = topography.heights.shape, topography.pixel
    return (np.arange(columns) - (columns - 1) / 2) * dx, (np.arange(rows) - (rows - 1) / 2) * dy


@pytest.mark.parametrize("shape", [(4, 4), (5, 8), (9, 6)])
@pytest.mark.parametrize("repeat", ["mirror", "periodic"])
def test_waves_pass_through_every_pixel(shape, repeat):
    map_ = rough(noise(shape), pixel=(1.0, 2.5), repeat=repeat)
    expected = map_.heights.heights - map_.heights.heights.mean()
    np.testing.assert_allclose(summed(map_.waves, *places(map_)), expected, atol=10 * ROUNDING)
    amplitudes = map_.waves.amplitudes
    assert not amplitudes[: amplitudes.shape[0] // 2 + 1, 0].any()  # twins, and the mean: not even by rounding


def test_two_pixels_but_for_rounding_are_two_pixels():
    assert rough(shortest_kept=2e-3 * (1 - ROUNDING / 2)).shortest_kept < 2e-3


@pytest.mark.parametrize("repeat", ["mirror", "periodic"])
def test_beyond_its_sides_a_map_goes_on_as_stated(repeat):
    map_ = rough(repeat=repeat)
    x, y = places(map_)
    beyond = summed(map_.waves, x + map_.size[0], y)
    here = summed(map_.waves, x, y)
    np.testing.assert_allclose(beyond, here[:, ::-1] if repeat == "mirror" else here, atol=ROUNDING)


def test_mean_squares_of_the_waves_are_those_of_the_pixels():
    # a wave of two pixels counts half: an odd map has none, a mirrored one neither
    for map_ in (rough(noise((7, 9)), repeat="periodic"), rough(noise((6, 8)))):
        assert map_.rms_height == pytest.approx(map_.relief.std(), rel=ROUNDING)
    even = rough(np.tile([1.0, -1.0], (4, 2)), repeat="periodic")
    assert even.rms_height == pytest.approx(np.sqrt(0.5))
    # also where squares of heights are no numbers
    one = rough()
    for height in (1e-49, 1e49):
        far = rough(height * noise((6, 8)))
        assert far.rms_height == pytest.approx(height * one.rms_height, rel=1e-12)
        assert far.waves.rms_slope == pytest.approx(height * one.waves.rms_slope, rel=1e-12)


def test_peaks_up_touch_first():
    up, down = (rough(noise((5, 5)), peaks=peaks) for peaks in ("up", "down"))
    np.testing.assert_allclose(up.relief, -down.relief, atol=ROUNDING)
    tip = np.zeros((5, 5))
    tip[2, 2] = 1.0
    assert rough(tip, peaks="up").relief.argmin() == 12
    assert Measured(heights=tip, pixel=1.0).height(0.0, 0.0) == pytest.approx(0.0, abs=SPLINE)
    assert Measured(heights=tip, pixel=1.0, peaks="down").height(0.0, 0.0) == pytest.approx(1.0)


def test_a_map_that_repeats_keeps_its_plane_and_one_that_is_mirrored_does_not():
    # a sine over its period has a plane that fits it best, and is falsified where that is taken off
    sine = np.tile(np.sin(2 * pi * np.arange(64) / 64), (64, 1))
    stated = {"heights": sine, "pixel": 1 / 64, "peaks": "down"}
    whole = Topography(**stated, repeat="periodic")
    assert whole.level == "mean"
    assert whole == Topography(**stated, repeat="periodic", level="mean")
    assert whole.rms_height == pytest.approx(np.sqrt(0.5), rel=ROUNDING)
    assert whole.waves.rms_slope == pytest.approx(2 * pi * np.sqrt(0.5), rel=ROUNDING)
    found = whole.waves.rms_slope_x, whole.waves.rms_slope_y
    assert found == pytest.approx((2 * pi * np.sqrt(0.5), 0.0), abs=1e-12)
    assert Topography(**stated).level == Topography(**stated, repeat="mirror").level == "tilt"
    with pytest.raises(InvalidInput, match='level = "tilt" with repeat = "periodic"'):
        replace(Topography(**stated), repeat="periodic")


def test_whether_there_are_heights_is_asked_without_a_wave(monkeypatch):
    monkeypatch.setattr(scene.topography, "_waves", lambda *_: pytest.fail("waves were built"))
    plane = np.add.outer(np.arange(9.0), np.arange(9.0))
    for map_, flat in ((rough(noise((9, 9)), seed=3), False), (rough(plane, level="tilt"), True)):
        assert map_.flat == flat
        case = Case(indenter=Sphere(1e-2), elastomer=Elastic(1e6), motion=Indent(load=1.0), roughness=map_)
        assert (case.roughness is None) == flat
    with pytest.raises(InvalidInput, match="without roughness touches everywhere"):
        Scene(Plane(), Elastic(1e6), Indent(pressure=1e4), map_)


def test_more_waves_than_fit_are_an_error_before_they_are_built(monkeypatch):
    heights = np.zeros((4, 2 * MOST_WAVES + 2))
    heights[0, 0] = 1.0

    def transformed(*_, **__):
        raise AssertionError("an array was made")

    crowded = Topography(heights=heights, pixel=1e-6, repeat="periodic")
    with monkeypatch.context() as patched:
        patched.setattr(np.fft, "rfft", transformed)
        with pytest.raises(ValueError, match=f"{MOST_WAVES + 1} waves a side, {MOST_WAVES} fit in memory"):
            _ = crowded.waves
    kept = replace(crowded, pixel=(1e-6, 1e-4), shortest_kept=2e-4)
    assert kept.waves.amplitudes.shape == (5, kept.tops[0] + 1)
    assert kept.tops[0] < MOST_WAVES / 40


@pytest.mark.parametrize("repeat", ["mirror", "periodic"])
def test_shorter_waves_than_kept_are_gone_and_longer_ones_are_as_they_were(repeat):
    whole = rough(noise((24, 24)), repeat=repeat)
    kept = replace(whole, shortest_kept=6e-3)
    cut, middle = kept.waves, whole.waves.amplitudes.shape[0] // 2
    (k, j) = kept.tops
    expected = whole.waves.amplitudes[middle - j : middle + j + 1, : k + 1]
    inside = cut.q <= 2 * pi / 6e-3 * (1 + 1e-9)
    assert np.array_equal(cut.amplitudes[inside], expected[inside])
    assert not cut.amplitudes[~inside].any()
    assert kept.shortest == pytest.approx(6e-3)
    assert cut.along_x[-1] == pytest.approx(2 * pi / 6e-3)
    assert whole.rms_height > 1.5 * kept.rms_height > 0


def test_seeds_are_pixels_of_the_map_and_none_is_its_middle():
    map_ = rough(noise((6, 8)), pixel=(1.0, 2.0))
    assert map_.place == (0, 0)
    found = np.array([replace(map_, seed=seed).place for seed in range(1, 400)])
    assert set(found[:, 0]) == set(range(-4, 4))
    assert set(found[:, 1]) == set(range(-3, 3))
    moved = replace(map_, seed=7)
    assert moved.shift == (moved.place[0] * 1.0, moved.place[1] * 2.0)
    assert moved.waves is map_.waves  # built once for all seeds


def test_a_key_changes_with_any_height_and_never_holds_them():
    heights = noise((40, 40))
    other = heights.copy()
    other[17, 3] = np.nextafter(other[17, 3], 1.0)
    scenes = [
        Scene(Sphere(1e-2), Elastic(1e6), Indent(load=1.0), rough(h)) for h in (heights, heights.copy(), other)
    ]
    keys = [json.dumps(SCENES.dump_python((scene,), mode="json"), sort_keys=True) for scene in scenes]
    assert keys[0] == keys[1] != keys[2]
    assert len(keys[0]) < 1000
    assert scenes[0] == scenes[1] != scenes[2]
    assert hash(scenes[0]) == hash(scenes[1])
    # the same numbers in another shape are another map
    assert rough(heights.reshape(20, 80)) != rough(heights)


def test_a_map_goes_to_a_worker_and_cannot_be_changed():
    map_ = rough()
    for twin in (pickle.loads(pickle.dumps(map_)), copy.deepcopy(map_)):
        assert twin == map_
        assert np.array_equal(twin.heights.heights, map_.heights.heights)
        for each in (map_, twin):
            with pytest.raises(ValueError, match="read-only"):
                each.heights.heights[0, 0] = 1.0
            with pytest.raises(ValueError, match="WRITEABLE"):
                each.heights.heights.setflags(write=True)
    given = noise((5, 5))
    kept = rough(given)
    given[0, 0] = 7.0
    assert kept.heights.heights[0, 0] != 7.0


@pytest.mark.parametrize(
    ("wrong", "named"),
    [
        ({"heights": np.zeros(5)}, r"shape \(5,\)"),
        ({"heights": np.zeros((3, 9))}, "at least 4 rows and columns"),
        ({"heights": [[1.0, 2.0], [1.0]]}, "unequal lengths"),
        ({"heights": np.where(np.eye(5) > 0, np.nan, 1.0)}, r"heights\[0\]\[0\] = nan: every pixel"),
        ({"heights": np.ma.masked_equal(np.eye(5), 1.0)}, "5 pixels have no height"),
        ({"heights": np.full((5, 5), 1j)}, "real numbers"),
        ({"heights": "a.npy"}, "or give file instead"),
        ({"pixel": 0.0}, "greater than 0"),
        ({"pixel": (1e-6, 1.0)}, "factor of 1000"),
        ({"pixel": (1e-6,) * 3}, "side of a pixel, greater than 0 .m., or two of them, along x and y"),
        ({"pixel": 10**400}, "or two of them"),
        ({"peaks": "sideways"}, "'up' or 'down'"),
        ({"level": "flat"}, "'mean', 'tilt', 'curvature' or 'cubic'"),
        ({"repeat": "never"}, "'mirror' or 'periodic'"),
        ({"repeat": "periodic", "level": "tilt"}, 'level = "tilt" with repeat = "periodic".*take level = "mean"'),
        ({"shortest_kept": 3e-3, "pixel": (1e-3, 2e-3)}, "from two pixels, 0.004 m"),
        ({"shortest_kept": 1.0}, "to half of what repeats"),
        ({"seed": -1}, "greater than or equal to 0"),
        ({"file": "a.npy"}, "beside heights"),
    ],
)
def test_what_is_no_map_is_named(wrong, named):
    with pytest.raises(InvalidInput, match=named):
        rough(**wrong)


def test_a_body_whose_map_is_a_plane_has_no_lowest_point():
    y, x = np.mgrid[0:1:6j, 0:1:5j]
    for heights, level in ((np.ones((5, 5)), "none"), (x + y, "tilt")):
        with pytest.raises(InvalidInput, match="has to have a lowest point"):
            Measured(heights=heights, pixel=1e-3, level=level)
    assert Measured(heights=x + y, pixel=1e-3).side == pytest.approx(6e-3)


def test_a_body_has_its_own_roughness():
    body = Measured(heights=noise((5, 5)), pixel=1e-3)
    with pytest.raises(InvalidInput, match="leave roughness out"):
        Scene(body, Elastic(1e6), Indent(load=1.0), SelfAffine(hurst=0.5, rms_height=1e-6, longest=1e-2))
    with pytest.raises(InvalidInput, match="does not press a Measured"):
        Scene(body, Elastic(1e6), Indent(pressure=1e4))


def test_between_the_pixels_a_measured_paraboloid_is_a_paraboloid():
    pixel, radius = (1e-5, 2e-5), 1e-2
    x, y = ((np.arange(count) - (count - 1) / 2) * side for count, side in ((41, pixel[0]), (31, pixel[1])))
    body = Measured(heights=-(x**2 + y[:, None] ** 2) / (2 * radius), pixel=pixel)
    at_x, at_y = np.linspace(-1.9e-4, 1.9e-4, 33), np.linspace(-2.9e-4, 2.9e-4, 21)[:, None]
    np.testing.assert_allclose(
        body.height(at_x, at_y), (at_x**2 + at_y**2) / (2 * radius), atol=SPLINE * body.height(1.0, 1.0)
    )
    np.testing.assert_allclose(body.slope(at_x, at_y), np.broadcast_to(at_x / radius, (21, 33)), atol=1e-12)
    # beyond the map nothing is known, and nothing touches
    assert body.height(3e-4, 0.0) == body.height(0.0, -1.0) == pytest.approx((2e-4**2 + 3e-4**2) / (2 * radius))
    assert body.slope(3e-4, 0.0) == 0.0
    rim = body.on_rim(np.array([0.0, 1.94e-4, 1.96e-4, -1.96e-4, 0.0]), np.array([0.0, 0.0, 0.0, 0.0, 2.95e-4]))
    assert rim.tolist() == [False, False, True, True, True]


SIDES = (1e-5, 2e-5)  # of pixels
FORM = dict(zip("xy", ((np.arange(n) - (n - 1) / 2) * side for n, side in ((40, 1e-5), (30, 2e-5))), strict=True))
PARABOLOID = 3.0 * FORM["x"] ** 2 + (2.0 * FORM["x"] - 1e-5 + 4.0 * FORM["y"][:, None]) * FORM["y"][:, None]


def wave(k, j, shape=(30, 40)):
    """Of a mirrored map, with so many half waves along x and along y."""
    along_y, along_x = (np.cos(pi * m * (np.arange(n) + 0.5) / n) for m, n in ((j, shape[0]), (k, shape[1])))
    return along_y[:, None] * along_x


@pytest.mark.parametrize("level", ["none", "tilt"])
@pytest.mark.parametrize("peaks", ["up", "down"])
def test_of_a_body_waves_shorter_than_kept_are_gone_and_longer_ones_and_the_form_are_as_they_were(level, peaks):
    # those of even k and j > 0 have no share in a paraboloid; of 40 and 30 pixels, k / 0.8 mm and j / 1.2 mm
    stated, sign = {"pixel": SIDES, "level": level, "peaks": peaks}, -1 if peaks == "up" else 1
    long, short = 1e-9 * wave(4, 6), 1e-9 * wave(4, 12)
    body = Measured(heights=sign * (PARABOLOID + long + short), **stated)
    known = Measured(heights=sign * (PARABOLOID + long), **stated)
    shortest = 1 / np.hypot(4 / 0.8e-3, 12 / 1.2e-3)
    for kept, same in ((0.999 * shortest, body), (1.001 * shortest, known)):
        found = replace(body, shortest_kept=kept)
        np.testing.assert_allclose(found.relief, same.relief, atol=10 * ROUNDING * body.relief.max())
        assert found.shortest == kept
        assert found.height(0.0, 0.0) == pytest.approx(same.height(0.0, 0.0), abs=SPLINE * body.relief.max())
    assert np.abs(body.relief - known.relief).max() > 0.5e-9


def test_a_body_of_short_waves_alone_is_a_plane_without_them():
    body = Measured(heights=wave(4, 12), pixel=SIDES)
    with pytest.raises(InvalidInput, match=r"a plane without waves shorter than 0.0002 m"):
        replace(body, shortest_kept=2e-4)
    for wrong, said in ((3.9e-5, "from two pixels, 4e-05 m"), (1.0, "half of what repeats, 0.0004 m")):
        with pytest.raises(InvalidInput, match=said):
            replace(body, shortest_kept=wrong)


def test_an_archive_states_its_pixel_in_the_unit_of_its_heights(tmp_path):
    heights, path = noise((5, 6)), tmp_path / "a.npz"
    np.savez(path, heights=heights, pixel=3.0)
    assert Topography(file=path, unit="nm").pixel == pytest.approx((3e-9, 3e-9))
    with pytest.raises(InvalidInput, match="states its own"):
        Topography(file=path, pixel=1e-6, unit="m")
    for pixel in (4e-6, [4e-6], [3e-6, 4e-6]):
        np.savez(path, heights=heights, pixel=pixel)
        assert Topography(file=path, unit="m") == Topography(heights=heights, pixel=(np.ravel(pixel)[0], 4e-6))
    for pixel, said in (
        (np.full(3, 1e-6), r"a pixel of shape \(3,\)"),
        ("a", "a pixel of shape .* and type <U1"),
        (np.nan, "pixel = nan: numbers greater than 0"),
        ([1e-6, 0.0], r"pixel = \[1e-06, 0.0\]: numbers greater than 0"),
    ):
        np.savez(path, heights=heights, pixel=pixel)
        with pytest.raises(InvalidInput, match=f"a.npz has {said}"):
            Topography(file=path, unit="m")
    np.savez(path, other=heights)
    with pytest.raises(InvalidInput, match="holds other, and no array heights"):
        Topography(file=path, pixel=1e-6, unit="m")


@pytest.mark.parametrize(
    ("name", "content", "stated", "named"),
    [
        ("a.csv", "1,2\n3,x\n", {"pixel": 1.0}, "line 2, column 2: 'x' is not a number"),
        ("a.txt", "# nothing\n", {"pixel": 1.0}, "there is no row of numbers in it"),
        ("a.csv", "1 2 3 4\n" * 4, {}, "give pixel"),
        ("a.npy", None, {"pixel": 1.0}, "no such file"),
        ("a.csv", "1 2 3 4\n" * 4, {"pixel": 1.0, "unit": ["m"]}, "one of m, mm, um, nm"),
        ("a.csv", "1 2 3 nan\n" * 4, {"pixel": 1.0}, r"a.csv': heights\[0\]\[3\] = nan: every pixel"),
    ],
)
def test_what_is_wrong_with_a_file_is_said_with_its_name(tmp_path, name, content, stated, named):
    path = tmp_path / name
    if content is not None:
        path.write_text(content)
    with pytest.raises(InvalidInput, match=named) as error:
        Topography(file=path, **({"unit": "m"} | stated))
    assert repr(name[-6:])[1:-1] in says(error) or "unit" in stated
    assert len(says(error)) < 1000


def array(shape, data=b"", descr="<f8", version=(1, 0), by_columns=False):
    """A .npy file whose header says so, whatever the data are."""
    header = f"{{'descr': {descr!r}, 'fortran_order': {by_columns}, 'shape': {shape}}}\n".encode()
    length = len(header).to_bytes(2 if version == (1, 0) else 4, "little")
    return b"\x93NUMPY" + bytes(version) + length + header + data


def archive(path, members, **other):
    with ZipFile(path, "w", ZIP_DEFLATED, **other) as file:
        for name, content in members:
            file.writestr(name, content)
    return path.read_bytes()


class Trap:
    """Whose loading would be seen."""

    def __reduce__(self):
        return pytest.fail, ("code of a file was executed",)


FITS = array((5, 6), noise((5, 6)).tobytes())
HEADERS = {
    "no magic": (b"hello" * 9, "magic string"),
    "a pickle": (pickle.dumps(Trap()), "magic string"),
    "an archive": (b"PK\x03\x04" * 9, "magic string|not a zip file"),
    "objects": (array((5, 5), pickle.dumps([Trap()]), "|O"), "an array of type object: heights are real numbers"),
    "truths": (array((5, 5), bytes(25), "|b1"), "an array of type bool"),
    "one number": (array((), bytes(8)), r"an array of shape \(\): a map has at least 4"),
    "nothing": (array((0, 5)), r"an array of shape \(0, 5\)"),
    "too few numbers": (FITS[:-1], r"239 bytes beside its header, and shape \(5, 6\) of float64 takes 240"),
    "too many pixels": (array((10**9, 10**9)), "1000000000 x 1000000000 pixels: at most 26214400"),
    "pixels beyond counting": (array((10**4000, 10**4000)), "pixels: at most 26214400"),
    "no version": (array((5, 6), bytes(240), version=(3, 0)), r"version \(3, 0\)"),
    "an endless header": (b"\x93NUMPY\2\0\xff\xff\xff\x7f", "its header is damaged"),
    "no header": (array("(" * 5000), "its header is damaged"),
    "no type": (array((5, 6), descr="\x1b[31m"), "its header is damaged"),
}


@pytest.mark.parametrize("kind", HEADERS)
@pytest.mark.parametrize("ending", ["npy", "npz"])
def test_an_array_that_is_no_map_is_refused_by_its_header(tmp_path, kind, ending):
    (content, said), path = HEADERS[kind], tmp_path / f"a.{ending}"
    path.write_bytes(content)
    if ending == "npz":
        archive(path, [("heights.npy", content)])
    with pytest.raises(InvalidInput, match=said) as error:
        Topography(file=path, pixel=1e-6, unit="m")
    assert f"a.{ending}" in says(error)
    assert says(error).isprintable()
    assert len(says(error)) < 1000


@pytest.mark.parametrize("dtype", ["<f8", ">f4", "<f2", "<i8", ">u2", "|i1"])
@pytest.mark.parametrize("by_columns", [False, True])
def test_numbers_of_any_real_type_and_order_are_read(tmp_path, dtype, by_columns):
    heights = (10 * np.abs(noise((5, 6)))).astype(dtype)
    order = "F" if by_columns else "C"
    for version in ((1, 0), (2, 0)):
        content = array((5, 6), heights.tobytes(order), dtype, version, by_columns)
        (tmp_path / "a.npy").write_bytes(content)
        archive(tmp_path / "a.npz", [("heights.npy", content)])
        for name in ("a.npy", "a.npz"):
            found = Topography(file=tmp_path / name, pixel=1.0, unit="nm")
            assert np.array_equal(found.heights.heights, 1e-9 * heights.astype(float))


def test_an_archive_is_refused_that_holds_no_heights_or_several_or_is_damaged(tmp_path):
    path = tmp_path / "a.npz"

    def refused(said, pixel=1e-6):
        with pytest.raises(InvalidInput, match=said) as error:
            Topography(file=path, pixel=pixel, unit="m")
        assert "a.npz" in says(error)
        assert says(error).isprintable()

    archive(path, [])
    refused("nothing, and no array heights")
    archive(path, [("../heights.npy", FITS), ("\x1b[31m", FITS)])
    refused("and no array heights")
    archive(path, [("pixel.npy", array((), np.float64(1.0).tobytes()))])
    refused("no array heights", None)
    with pytest.warns(UserWarning, match="Duplicate name"):
        archive(path, [("heights.npy", FITS), ("heights.npy", FITS)])
    refused("2 arrays heights")
    archive(path, [(f"{k}.npy", b"") for k in range(1001)])
    refused("more than 1000 files")
    with ZipFile(path, "w", ZIP_LZMA) as file:
        file.writestr("heights.npy", FITS)
    refused("compressed otherwise")
    whole = archive(path, [("heights.npy", FITS)])
    listed, encrypted = whole.rindex(b"PK\1\2"), bytearray(whole)
    encrypted[6] |= 1
    encrypted[listed + 8] |= 1
    path.write_bytes(encrypted)
    refused("encrypted")
    # A byte of the numbers, or of anything else, or an end too early: read as it was, or a line.
    for place in range(0, len(whole), 3):
        for damaged in (whole[:place] + bytes([whole[place] ^ 0x55]) + whole[place + 1 :], whole[:place]):
            path.write_bytes(damaged)
            with suppress(InvalidInput):
                assert Topography(file=path, pixel=1.0, unit="m") == Topography(heights=noise((5, 6)), pixel=1.0)


def test_what_would_unpack_to_more_than_its_header_says_is_not_unpacked(tmp_path, monkeypatch):
    path, lying = tmp_path / "a.npz", 2**26
    monkeypatch.setattr(scene.heightfile, "MOST_BYTES", 2**22)
    with ZipFile(path, "w", ZIP_DEFLATED) as file, file.open("heights.npy", "w") as member:
        member.write(array((5, 6)))
        for _ in range(lying // 2**24):
            member.write(bytes(2**24))
    tracemalloc.start()
    try:
        with pytest.raises(InvalidInput, match=f"{lying} bytes beside its header, and shape .* takes 240"):
            Topography(file=path, pixel=1e-6, unit="m")
        # and one that hides it
        content = path.read_bytes()
        sizes = [(len(array((5, 6))) + data).to_bytes(4, "little") for data in (lying, 240)]
        path.write_bytes(content.replace(*sizes))
        with pytest.raises(InvalidInput, match="CRC"):
            Topography(file=path, pixel=1e-6, unit="m")
        assert tracemalloc.get_traced_memory()[1] < lying / 4
    finally:
        tracemalloc.stop()


@pytest.mark.parametrize("name", ["a.npy", "a.npz", "a.csv", "a.sur"])
def test_larger_files_than_are_read_are_not_opened(tmp_path, name):
    path = tmp_path / name
    with path.open("wb") as file:
        file.truncate(MOST_BYTES + 1)
    with pytest.raises(InvalidInput, match=r"has .* MB, and at most .* MB are read"):
        Topography(file=path, pixel=1e-6, unit="m")


@pytest.mark.parametrize(
    ("content", "said"),
    [
        ("1," * (LINE // 2 + 1), f"line 1 has more than {LINE} letters"),
        ("1 2 3 4\n" + "5" * (LINE + 1), f"line 2 has more than {LINE} letters"),
        ("1,2,3,4\n1,2\n", "line 2: 2 columns, and other rows have 4"),
        ("1 2 3 " + "x" * 9999, "line 1, column 4: 'xxx.*is not a number"),
        ("1 2 3 4\n" * 41, "more than 160 numbers: no more are read"),
        ("\n" * 99, "more than 50 lines"),
        ("\0", "there is no row of numbers"),
        (";;;\n" * 5, "there is no row of numbers"),
    ],
)
def test_a_text_is_read_line_by_line_and_no_further_than_a_map_goes(tmp_path, monkeypatch, content, said):
    monkeypatch.setattr(scene.heightfile, "MOST_PIXELS", 160)
    monkeypatch.setattr(scene.sheet, "LINES", 50)
    path = tmp_path / "a.csv"
    path.write_text(content)
    with pytest.raises(InvalidInput, match=f"a.csv.*{said}") as error:
        Topography(file=path, pixel=1e-6, unit="m")
    assert says(error).isprintable()
    assert len(says(error)) < 1000


@pytest.mark.parametrize("given", ["heights", "pixel", "both pixels"])
def test_lengths_whose_squares_are_no_numbers_are_named_with_what_is_allowed(given):
    for length in (1e-320, 1e-206, 0.99e-50, 1.01e50, 1e194, 1.7e308):
        wrong = {"heights": length * np.eye(5)} if given == "heights" else {"pixel": length}
        if given == "both pixels":
            wrong = {"pixel": (length, 2 * length if length < 1 else length / 2)}
        with pytest.raises(InvalidInput, match=r"from 1e-50 to 1e\+50 m"):
            rough(**wrong)
    for length in (1e-50, 1e50):
        assert rough(length * np.eye(5), pixel=length).waves.rms_slope == pytest.approx(
            rough(np.eye(5), pixel=1.0).waves.rms_slope, rel=1e-12
        )
    assert rough(np.zeros((5, 5))).flat


def test_without_the_extra_other_files_ask_for_it(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "SurfaceTopography", None)
    path = tmp_path / "a.sur"
    path.write_bytes(b"0" * 100)
    with pytest.raises(InvalidInput, match=r"mdr-bem-crosscheck\[topography\]"):
        Topography(file=path)


@pytest.fixture
def surface_topography():
    return pytest.importorskip("SurfaceTopography")


@pytest.mark.parametrize(("unit", "metre"), [("nm", 1e-9), ("mm", 1e-3)])
def test_other_files_are_read_with_their_sizes_and_units(tmp_path, surface_topography, unit, metre):
    heights, path = noise((5, 6)), tmp_path / "a.nc"
    one = surface_topography.Topography(heights.T, (12.0, 20.0), unit=unit)
    one.to_netcdf(str(path))
    found = Topography(file=path)
    np.testing.assert_allclose(found.heights.heights, metre * heights, rtol=1e-12)
    assert found.pixel == pytest.approx((2 * metre, 4 * metre))
    with pytest.raises(InvalidInput, match="states its own"):
        Topography(file=path, pixel=1e-6)
    with pytest.raises(InvalidInput, match="states its own"):
        Topography(file=path, unit="um")
    # what is the same is no contradiction
    assert Topography(file=path, unit=unit, pixel=(2 * metre, 4 * metre)) == found


def test_a_file_that_states_no_unit_asks_for_it(tmp_path, surface_topography):
    path = tmp_path / "a.nc"
    surface_topography.Topography(noise((6, 5)), (12.0, 20.0)).to_netcdf(str(path))
    with pytest.raises(InvalidInput, match="give unit"):
        Topography(file=path)
    assert Topography(file=path, unit="um").pixel == pytest.approx((2e-6, 4e-6))


def test_a_map_of_more_pixels_than_are_read_is_refused_before_its_heights(
    tmp_path, surface_topography, monkeypatch
):
    path = tmp_path / "a.nc"
    surface_topography.Topography(noise((6, 5)), (12.0, 20.0), unit="um").to_netcdf(str(path))
    monkeypatch.setattr(scene.heightfile, "MOST_PIXELS", 29)
    monkeypatch.setattr(scene.heightfile.np, "array", lambda *_: pytest.fail("heights were read"))
    with pytest.raises(InvalidInput, match=r"a.nc cannot be read .*: 5 x 6 pixels: at most 29"):
        Topography(file=path)


def test_what_another_program_prints_and_warns_of_is_not_shown(tmp_path, surface_topography, monkeypatch, capfd):
    def fails(_):
        print("a line")
        warnings.warn("a warning", stacklevel=1)
        raise RuntimeError("\x1b[31mred" + "x" * 9999 + "\nand so on")

    monkeypatch.setattr(surface_topography, "open_topography", fails)
    path = tmp_path / "a.sur"
    path.write_bytes(b"0")
    with pytest.raises(InvalidInput) as error:
        Topography(file=path)
    assert says(error).isprintable()
    assert len(says(error)) < 1000
    assert "a.sur cannot be read by SurfaceTopography: " in says(error)
    assert "and so on" not in says(error)
    assert capfd.readouterr() == ("", "")
    (tmp_path / "a.sdf").write_bytes(b"")  # of no pixels, by one of its readers
    with pytest.raises(InvalidInput, match=r"a.sdf cannot be read by SurfaceTopography"):
        Topography(file=tmp_path / "a.sdf", pixel=1e-6)


def test_another_program_is_given_so_much_time_whatever_it_makes_of_its_end(
    tmp_path, surface_topography, monkeypatch
):
    handler = signal.getsignal(signal.SIGPROF)

    def slow(_):
        with suppress(Exception):
            for _ in range(10**9):
                pass
        pytest.fail("the end was heard of as any other mistake")

    monkeypatch.setattr(surface_topography, "open_topography", slow)
    monkeypatch.setattr(scene.heightfile, "SECONDS", 0.05)
    (tmp_path / "a.sur").write_bytes(b"0")
    with pytest.raises(InvalidInput, match=r"a.sur takes SurfaceTopography more than 0.05 s to read: .* .npy"):
        Topography(file=tmp_path / "a.sur")
    assert signal.getsignal(signal.SIGPROF) is handler
    assert signal.getitimer(signal.ITIMER_PROF) == (0.0, 0.0)


FILE = """
[indenter]
type = "sphere"
radius = 1e-2
[elastomer]
type = "elastic"
modulus = 1e6
[motion]
type = "indent"
load = 1.0
[roughness]
type = "topography"
file = "surface.npy"
"""


def test_a_scene_file_names_the_map_by_its_path(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    np.save("surface.npy", noise((5, 6)))
    (tmp_path / "scene.toml").write_text(FILE + "pixel = [1e-6, 2e-6]\nunit = 'um'\nseed = 3\n")
    found = read("scene.toml", Scene)
    assert found.roughness == Topography(heights=1e-6 * noise((5, 6)), pixel=(1e-6, 2e-6), seed=3)
    (tmp_path / "scene.toml").write_text(FILE)
    with pytest.raises(
        InvalidInput, match=r"roughness: surface.npy does not state the unit .* nor the side of a pixel"
    ):
        read("scene.toml", Scene)
    np.save("surface.npy", np.where(np.eye(5) > 0, -np.inf, 1.0))
    (tmp_path / "scene.toml").write_text(FILE + "pixel = 1e-6\nunit = 'um'\n")
    with pytest.raises(
        InvalidInput, match=r"^scene.toml: roughness: file = 'surface.npy': .*\[0\] = -inf: every[^\n]*$"
    ):
        read("scene.toml", Scene)
    (tmp_path / "scene.toml").write_text(FILE.replace("file", "heights = [[1.0]]\nzzz"))
    with pytest.raises(InvalidInput) as error:
        read("scene.toml", Scene)
    for named in ("roughness.heights", "roughness.pixel: missing", "roughness.zzz"):
        assert named in str(error.value)
