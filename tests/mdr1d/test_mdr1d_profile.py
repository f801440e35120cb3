"""Which line stands for the indenter, what is measured on it, and the limits of slow and fast sliding."""

import re
from dataclasses import replace
from math import sqrt

import numpy as np
import pytest
from sliding import CHAIN, KELVIN, PAPER, SERIES
from sliding import ROUGH as SCENE

from mdr1d import MDR, lay_out, map_profile, modes_of, sweep, sweep_modes
from mdr1d.profile import contact_extent, greatest_depth, unmapped
from scene import (
    Cone,
    Elastic,
    Indent,
    PowerLaw,
    Regime,
    Scene,
    SelfAffine,
    Slide,
    Sphere,
)
from scene.scales import elastic_contact

SHAPES = [Sphere(radius=1e-2), Cone(angle=0.2), PowerLaw(coefficient=0.5, exponent=1.3)]
ROUGH = SCENE.roughness
AS_GIVEN = MDR(shape="as-given")

# Sums of some thousand terms, and a load met to 1e-13 of itself or better.
ROUNDING = 1e-11


@pytest.mark.parametrize("shape", SHAPES)
def test_the_line_as_given_is_the_meridian_of_the_body(shape):
    smooth = replace(SCENE, indenter=shape, roughness=None)
    for scene, solver, factor in (
        (smooth, AS_GIVEN, 1.0),
        (smooth, MDR(), shape.mdr_coefficient / shape.coefficient),
    ):
        result = solver.solve(scene)
        x = result.fields["x"]
        np.testing.assert_allclose(result.fields["profile"], factor * shape.height(x, 0.0), rtol=ROUNDING)
        assert result.settings["shape"] == solver.shape


@pytest.mark.parametrize("spectrum", ["mapped", "line-scan"])
@pytest.mark.parametrize("shape", SHAPES)
def test_no_contact_is_deeper_or_wider_than_what_surely_holds_it(shape, spectrum):
    # Slow sliding comes closest to the bounds.
    solver = MDR(points=2000, shape="as-given", spectrum=spectrum)
    for load in (1e-6, 1.0, 100.0):
        for seed in range(2):
            rough = replace(ROUGH, seed=seed)
            scene = Scene(shape, KELVIN, Slide(speed=1e-9, load=load), rough)
            result = solver.solve(scene)
            line = unmapped(scene)
            surface = map_profile(line, lay_out(line, 2000, None, spectrum), spectrum).surface
            assert result.depth <= greatest_depth(line, surface)
            reach = np.abs(result.fields["x"][result.fields["contact"]]).max(initial=0.0)
            assert 2 * reach <= contact_extent(line, surface)


def shares(elastomer, speed):
    """Of the contact and of the load on leading flanks, mean over profiles."""
    scene = replace(SCENE, elastomer=elastomer, motion=Slide(speed=speed, load=1.0))
    found = [MDR().solve(replace(scene, roughness=replace(ROUGH, seed=s))).measures for s in range(5)]
    return np.mean([(m["one_sidedness"], m["load_on_leading_flanks"]) for m in found], axis=0)


def test_contact_on_a_kelvin_solid_becomes_one_sided_with_speed():
    found = np.array([shares(KELVIN, speed) for speed in (1e-6, 1e-2, 1e9)])
    rest = MDR().solve(replace(SCENE, roughness=None, motion=Slide(speed=0.0, depth=1e-4))).measures
    assert (rest["one_sidedness"], rest["load_on_leading_flanks"]) == pytest.approx((0.5, 0.5), abs=ROUNDING)
    # Slow spots are not symmetrical, five profiles of them nearly. Measured: 0.486 and 0.5000.
    np.testing.assert_allclose(found[0], 0.5, atol=0.05)
    assert np.all(np.diff(found, axis=0) > 0)
    # A trailing flank holds on over the depth over the memory and the slope.
    np.testing.assert_allclose(found[-1], 1.0, atol=1e-6)


def test_the_regime_is_that_of_the_line_which_is_solved():
    for solver, scene in ((MDR(), SCENE), (AS_GIVEN, unmapped(SCENE))):
        found, smooth = solver.solve(SCENE).measures, elastic_contact(scene)
        line = scene.indenter.mdr_coefficient, 2.0
        contact = smooth.radius, smooth.depth
        regime = Regime.of(line, contact, 5e-6, 4e-3, found["rms_slope"])
        for name in ("height_over_depth", "contact_over_period", "macro_over_rough"):
            assert found[name] == pytest.approx(getattr(regime, name), rel=ROUNDING)


@pytest.mark.parametrize("scene", [SCENE, PAPER])
def test_fast_friction_is_the_mean_square_slope_over_the_mean_slope_of_the_leading_flanks(scene):
    result = MDR().solve(replace(scene, motion=Slide(speed=1e12, load=1.0)))
    # A surface that never recovers is the highest that has passed: it rises on the flanks that it touches alone.
    profile, pixel = result.fields["profile"], result.settings["pixel"]
    reached = np.maximum.accumulate(np.maximum(result.depth - profile, 0.0))
    rise, slope = np.diff(reached), np.abs(np.diff(profile)) / pixel
    assert result.friction_coefficient == pytest.approx(slope @ rise / rise.sum(), rel=1e-6)


@pytest.mark.parametrize("speed", [0.0, 1e-2, 1e2])
@pytest.mark.parametrize("load", [1e-30, 1e-10, 1e30])
@pytest.mark.parametrize("elastomer", [KELVIN, SERIES])
def test_any_load_is_met_in_a_few_sweeps(load, elastomer, speed):
    # Under a great load the grid is as wide as the contact, and still has the shortest wave in it.
    rough = None if load > 1 else ROUGH
    for seed in range(3):
        surface = rough and replace(rough, seed=seed, hurst=seed / 2)
        scene = Scene(Cone(angle=0.2), elastomer, Slide(speed=speed, load=load), surface)
        result = MDR(points=1000).solve(scene)
        assert result.residual <= 1e-10
        # Measured: 13 at most; a plain Newton's method takes a hundred.
        assert result.operator_applications <= 40


@pytest.mark.parametrize("approach", [1e-12, 1e-24])
@pytest.mark.parametrize("elastomer", [KELVIN, CHAIN])
def test_an_asperity_that_follows_its_equal_is_not_counted_again(elastomer, approach):
    # Inside so steep a shape all is flat: the lowest asperity comes twice, and finds the surface still down.
    rough = SelfAffine(hurst=1.0, rms_height=5e-7, longest=0.1, shortest=0.025, rolloff=0.099, seed=145622085)
    shape = PowerLaw(coefficient=0.5, exponent=40.0)
    body = map_profile(
        scene := Scene(shape, elastomer, Slide(speed=1e9, load=1.0), rough), lay_out(scene, 300, None)
    )
    heights = body.heights - body.lowest
    assert np.count_nonzero(heights < 1e-19) > 1
    modes = modes_of(elastomer)
    contact = sweep_modes(heights, body.pixel, modes, 1e9, approach)
    if elastomer is KELVIN:
        contact = sweep(heights, body.pixel, 1e9 * KELVIN.relaxation_time, approach)
    # The force is a convex function of the approach, from zero on: no less than in proportion to it.
    assert contact.stiffness * approach >= contact.force * (1 - ROUNDING)


def test_scenes_of_one_body_share_its_profile_and_no_result_changes_that_of_another():
    slow, fast = (replace(PAPER, motion=replace(PAPER.motion, speed=speed)) for speed in (1e-3, 1.0))
    grid = lay_out(slow, 1000, None)
    assert map_profile(slow, grid) is map_profile(fast, grid)
    other = replace(slow, roughness=replace(slow.roughness, seed=slow.roughness.seed + 1))
    assert not np.allclose(map_profile(other, grid).heights, map_profile(slow, grid).heights)
    before = MDR(points=1000).solve(slow)
    depth = before.depth
    for values in before.fields.values():
        values[:] = 0
    assert MDR(points=1000).solve(slow).depth == depth
    with pytest.raises(ValueError, match="read-only"):
        map_profile(slow, grid).heights[0] = 0.0


def test_points_and_waves_that_a_refusal_names_do_for_other_draws_too():
    rough = SelfAffine(hurst=0.5, rms_height=2e-5, longest=4e-3, shortest=2e-5)
    scene = Scene(Sphere(1e-2), Elastic(1e6), Indent(load=1.0), rough)
    (reason,) = MDR(points=100).refusals(scene)
    points = int(re.search(r"; points = (\d+) would leave room for other draws", reason)[1])
    shortest = float(re.search(r"roughness.shortest = ([\d.e-]+) would do", reason)[1])
    for seed in range(20):
        drawn = replace(rough, seed=seed)
        assert MDR(points=points).refusals(replace(scene, roughness=drawn)) == []
        assert MDR(points=100).refusals(replace(scene, roughness=replace(drawn, shortest=shortest))) == []


@pytest.mark.parametrize("ratio", [1e3, 1e12, 1e20, 1e30, 1e100])
def test_a_fast_contact_far_smaller_than_the_one_at_rest_has_its_own_grid(ratio):
    # a fluid: d = F/(K l), a = sqrt(R d), mu = int g'^2 / int |g'| = 4a/(3R) over the front half
    radius, memory = 1e-2, ratio * 1e-3
    scene = Scene(Sphere(radius=radius), KELVIN, Slide(speed=ratio, load=1.0))
    result = MDR(points=2000).solve(scene)
    assert result.measures["points_across_contact"] > 200
    expected = 4 / 3 * sqrt(1.0 / (4e6 * memory * radius))
    # elasticity adds terms of the order of the contact radius over the memory length
    assert result.friction_coefficient == pytest.approx(expected, rel=1e-6 + 1e-3 / memory)
