"""A measured map is what was measured: at its pixels, by its key, in a scene file; and what is none is named."""

import json
import pickle
from dataclasses import replace
from functools import partial
from math import pi

import numpy as np
import pytest
from maps import noise, refused

import scene.surfaces.topography
from compare.library.case import Case
from compare.solving.task import SCENES
from scene import Elastic, Indent, Measured, Plane, Scene, SelfAffine, Sphere, Topography

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
def test_waves_pass_through_every_pixel_and_go_on_beyond_the_sides_as_stated(shape, repeat):
    map_ = rough(noise(shape), pixel=(1.0, 2.5), repeat=repeat)
    expected = map_.heights.heights - map_.heights.heights.mean()
    x, y = places(map_)
    here, beyond = (summed(map_.waves, x + far, y) for far in (0.0, map_.size[0]))
    np.testing.assert_allclose(here, expected, atol=10 * ROUNDING)
    np.testing.assert_allclose(beyond, here[:, ::-1] if repeat == "mirror" else here, atol=ROUNDING)
    amplitudes = map_.waves.amplitudes
    assert not amplitudes[: amplitudes.shape[0] // 2 + 1, 0].any()  # twins, and the mean: not even by rounding


def test_two_pixels_but_for_rounding_are_two_pixels():
    assert rough(shortest_kept=2e-3 * (1 - ROUNDING / 2)).shortest_kept < 2e-3


def test_mean_squares_of_the_waves_are_those_of_the_pixels():
    # a wave of two pixels counts half: an odd map has none, a mirrored one neither
    for map_ in (rough(noise((7, 9)), repeat="periodic"), rough(noise((6, 8)))):
        assert map_.rms_height == pytest.approx(map_.relief.std(), rel=ROUNDING)
    even = rough(np.tile([1.0, -1.0], (4, 2)), repeat="periodic")
    assert even.rms_height == pytest.approx(np.sqrt(0.5))


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
    assert (whole.rms_height, whole.waves.rms_slope) == pytest.approx(
        (np.sqrt(0.5), 2 * pi * np.sqrt(0.5)), rel=ROUNDING
    )
    found = whole.waves.rms_slope_x, whole.waves.rms_slope_y
    assert found == pytest.approx((2 * pi * np.sqrt(0.5), 0.0), abs=1e-12)
    assert Topography(**stated).level == Topography(**stated, repeat="mirror").level == "tilt"


def test_whether_there_are_heights_is_asked_without_a_wave(monkeypatch):
    monkeypatch.setattr(scene.surfaces.topography, "_waves", lambda *_: pytest.fail("waves were built"))
    plane = np.add.outer(np.arange(9.0), np.arange(9.0))
    for map_, flat in ((rough(noise((9, 9)), seed=3), False), (rough(plane, level="tilt"), True)):
        assert map_.flat == flat
        case = Case(indenter=Sphere(1e-2), elastomer=Elastic(1e6), motion=Indent(load=1.0), roughness=map_)
        assert (case.roughness is None) == flat
    refused("without roughness touches everywhere", Scene, Plane(), Elastic(1e6), Indent(pressure=1e4), map_)


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
    assert (kept.shortest, cut.along_x[-1]) == pytest.approx((6e-3, 2 * pi / 6e-3))
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
    scenes = [Scene(Sphere(1e-2), Elastic(1e6), Indent(load=1.0), rough(h)) for h in (heights, +heights, other)]
    keys = [json.dumps(SCENES.dump_python((each,), mode="json"), sort_keys=True) for each in scenes]
    assert keys[0] == keys[1] != keys[2]
    assert scenes[0] == scenes[1] != scenes[2]
    assert len(keys[0]) < 1000
    assert hash(scenes[0]) == hash(scenes[1])
    # the same numbers in another shape are another map
    assert rough(heights.reshape(20, 80)) != rough(heights)


def test_a_map_goes_to_a_worker_and_cannot_be_changed():
    given = noise((5, 5))
    map_ = rough(given)
    for each in (map_, pickle.loads(pickle.dumps(map_))):
        assert each == map_
        with pytest.raises(ValueError, match="read-only"):
            each.heights.heights[0, 0] = 1.0
        refused("WRITEABLE", each.heights.heights.setflags, error=ValueError, write=True)
    given[0, 0] = 7.0
    assert map_.heights.heights[0, 0] != 7.0


@pytest.mark.parametrize(
    ("wrong", "named"),
    [
        ({"heights": np.zeros(5)}, r"an array of shape \(5,\).*type = .profile"),
        ({"heights": np.zeros((3, 9))}, "at least 4 rows and columns"),
        ({"heights": [[1.0, 2.0], [1.0]]}, "unequal lengths"),
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
    ],
)
def test_what_is_no_map_is_named(wrong, named):
    refused(named, rough, **wrong)


def test_a_body_whose_map_is_a_plane_has_no_lowest_point():
    slope = np.add.outer(np.arange(6.0), np.arange(5.0))
    refused("has to have a lowest point", Measured, heights=np.ones((5, 5)), pixel=1e-3, level="none")
    refused("has to have a lowest point", Measured, heights=slope, pixel=1e-3, level="tilt")
    assert Measured(heights=slope, pixel=1e-3).side == pytest.approx(6e-3)


def test_a_body_has_its_own_roughness():
    body = Measured(heights=noise((5, 5)), pixel=1e-3)
    refused(
        "leave roughness out",
        Scene,
        body,
        Elastic(1e6),
        Indent(load=1.0),
        SelfAffine(hurst=0.5, rms_height=1e-6, longest=1e-2),
    )
    refused("does not press a Measured", Scene, body, Elastic(1e6), Indent(pressure=1e4))


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


def wave(k, j):
    """A wave of a mirrored map, with k half waves along x and j along y."""
    along_y, along_x = (np.cos(pi * m * (np.arange(n) + 0.5) / n) for m, n in ((j, 30), (k, 40)))
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
    body = partial(replace, Measured(heights=wave(4, 12), pixel=SIDES))
    refused(r"a plane without waves shorter than 0.0002 m", body, shortest_kept=2e-4)
    refused("from two pixels, 4e-05 m", body, shortest_kept=3.9e-5)
    refused("half of what repeats, 0.0004 m", body, shortest_kept=1.0)


@pytest.mark.parametrize("length", [1e-320, 1e-206, 0.99e-50, 1.01e50, 1e194, 1.7e308])
def test_lengths_whose_squares_are_no_numbers_are_named_with_what_is_allowed(length):
    both = length, length * 2.0 ** np.sign(1 - length)
    for wrong in ({"heights": length * np.eye(5)}, {"pixel": length}, {"pixel": both}):
        refused(r"from 1e-50 to 1e\+50 m", rough, **wrong)


@pytest.mark.parametrize("length", [1e-50, 1e-49, 1e49, 1e50])
def test_slopes_and_heights_are_the_same_at_the_least_and_the_greatest_lengths(length):
    """Where squares of heights are no numbers."""
    one, far = (rough(each * np.eye(5), pixel=each) for each in (1.0, length))
    assert (far.waves.rms_slope, far.rms_height) == pytest.approx(
        (one.waves.rms_slope, length * one.rms_height), rel=1e-12
    )
