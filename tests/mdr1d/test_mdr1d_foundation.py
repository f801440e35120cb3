"""The sweep along a rough profile against a plain fine march, its limits, and contact within one interval."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from scipy.optimize import brentq

from mdr1d import MDR, lay_out, map_profile, sweep
from mdr1d.foundation import NOWHERE, _landing
from scene import Kelvin, Scene, SelfAffine, Slide, Sphere, StandardLinearSolid

MODULUS = 1e6
TIME = 1e-3
ROUGH = SelfAffine(hurst=0.6, rms_height=1e-5, longest=5e-4, shortest=5e-5, seed=4)
SCENE = Scene(
    Sphere(radius=1e-2), Kelvin(modulus=MODULUS, relaxation_time=TIME), Slide(speed=0.1, load=1.0), ROUGH
)
# The march finds the edges of contact to a part in 200 of a pixel.
MARCH = 2e-4
ROUNDING = 1e-11


def rough_profile(points=160, seed=4):
    scene = replace(SCENE, roughness=replace(ROUGH, seed=seed))
    body = map_profile(scene, lay_out(scene, points, 1.6e-3))
    return body.heights, body.pixel


def march(heights, pixel, memory, depth, parts=200):
    """u_i = max(d - g_i, e u_{i-1}) on a finer grid, forces by the midpoint rule: no events, no algebra."""
    count = heights.size
    fine = np.interp(np.arange((count - 1) * parts + 1) / parts, np.arange(count), heights)
    step = pixel / parts
    decay = np.exp(-step / memory) if memory else 0.0
    u, touches, before = np.empty(fine.size), np.empty(fine.size, bool), 0.0
    for i, here in enumerate(depth - fine):
        u[i] = max(here, decay * before, 0.0)
        touches[i] = here > 0 and here >= decay * before
        before = u[i]
    # f = K (u + l u') where both ends of a step touch; elsewhere the surface is free.
    pair = touches[1:] & touches[:-1]
    f = np.where(pair, (u[1:] + u[:-1]) / 2 + memory * np.diff(u) / step, 0.0)
    return f.sum() * step, -(f * np.diff(fine)).sum(), pair.sum() * step


# Beside the smooth contact radius of 0.3 mm: from none over a pixel to far above the contact.
@pytest.mark.parametrize(("memory", "approach"), [(0.0, 6e-5), (1e-5, 3e-5), (1e-4, 6e-5), (1e3, 3e-5)])
def test_the_sweep_agrees_with_a_fine_march(memory, approach):
    heights, pixel = rough_profile()
    depth = approach + heights.min()
    contact = sweep(heights, pixel, memory, depth)
    force, friction, length = march(heights, pixel, memory, depth)
    steepest = np.abs(np.diff(heights)).max() / pixel
    spots = np.count_nonzero(np.diff(contact.touching.astype(int)) == 1)
    assert spots >= 2
    # A step lost at the edge of a spot carries a force in proportion to the memory.
    edges = 20 * pixel / 200 * (memory * steepest + approach)
    assert contact.force == pytest.approx(force, rel=MARCH, abs=edges)
    assert contact.dissipation == pytest.approx(friction, rel=MARCH, abs=edges * steepest)
    assert contact.length == pytest.approx(length, abs=20 * pixel / 200)


def test_memories_far_below_a_pixel_and_far_above_the_contact_join_their_limits():
    heights, pixel = rough_profile()
    depth = heights.min() + 2e-5
    elastic, short, thin, thick, thicker = (
        sweep(heights, pixel, memory, depth) for memory in (0.0, 1e-300, 1e-15, 1e6, 1e9)
    )
    assert (short.force, short.length) == pytest.approx((elastic.force, elastic.length), rel=1e-6)
    assert thin.dissipation / 1e-15 == pytest.approx(elastic.slope_square, rel=1e-6)
    # A viscous fluid, whose forces are in proportion to the speed.
    assert (thick.force / 1e6, thick.dissipation / 1e6) == pytest.approx(
        (thicker.force / 1e9, thicker.dissipation / 1e9), rel=1e-6
    )


@pytest.mark.parametrize(("lift", "lands"), [(-1e-9, True), (1e-9, False)])
def test_contact_that_begins_and_ends_within_one_interval_is_found(lift, lands):
    # Lengths in pixels, l = 1, d = 1. The surface leaves a flank of slope 0.7 where f = 1 - g - l g' vanishes,
    # and meets the next, flatter flank although both nodes of that stay clear of it.
    steep = 0.7
    u = steep * np.exp(-(1 - (1 / steep - 1)))
    node = 1 - steep

    def least_clearance(slope):
        return slope * (1 + np.log(u / slope)) - node

    slope = brentq(least_clearance, 0.05, u) + lift
    assert 0 < np.log(u / slope) < 1
    assert u * np.exp(-1) > node - slope
    heights = np.array([2.0, 0.0, steep, steep + slope, 5.0])
    assert (sweep(heights, 1.0, 1.0, 1.0).last > 2) is lands


@pytest.mark.parametrize("roughness", [None, ROUGH])
@pytest.mark.parametrize("elastomer", [SCENE.elastomer, StandardLinearSolid(MODULUS, 10 * MODULUS, TIME)])
def test_the_depth_found_for_a_load_carries_that_load(elastomer, roughness):
    fixed, scene = MDR(extent=4e-3), replace(SCENE, elastomer=elastomer, roughness=roughness)
    for speed in (0.0, 0.1, 10.0):
        by_load = fixed.solve(replace(scene, motion=Slide(speed=speed, load=1.0)))
        by_depth = fixed.solve(replace(scene, motion=Slide(speed=speed, depth=by_load.depth)))
        assert by_depth.normal_force == pytest.approx(1.0, rel=ROUNDING)
        assert by_depth.friction_force == pytest.approx(by_load.friction_force, rel=ROUNDING)


@pytest.mark.parametrize("nodes", [2, 3, 64, 65, 66, 129, 200])
@pytest.mark.parametrize("memory", [0.0, 1e-5, 1e-3])
def test_a_line_that_touches_throughout_has_the_sums_over_its_nodes_however_many(nodes, memory):
    """Tolerance: rounding of as many terms. It pulls on every flank: slopes are small beside depth over memory."""
    pixel, depth = 1e-5, 1e-4
    heights = 1e-6 * np.random.default_rng(nodes).random(nodes) * min(1.0, pixel / max(memory, pixel))
    found = sweep(heights, pixel, memory, depth)
    slopes, means = np.diff(heights) / pixel, depth - (heights[1:] + heights[:-1]) / 2
    forces = pixel * (means - memory * slopes)
    # It comes undisturbed to the first node.
    assert found.touching[1:].all()
    assert (forces > 0).all()
    assert found.length == pytest.approx((nodes - 1) * pixel, rel=ROUNDING)
    assert found.force == pytest.approx(forces.sum(), rel=ROUNDING)
    assert found.traction == pytest.approx(-slopes @ forces, rel=ROUNDING, abs=ROUNDING * found.force)
    assert found.slope_square == pytest.approx(pixel * slopes @ slopes, rel=ROUNDING)
    np.testing.assert_allclose(found.pushed[:, 1], forces, rtol=ROUNDING)
    np.testing.assert_allclose(found.displacement[1:], (depth - heights)[1:], rtol=ROUNDING)


def test_nodes_between_those_of_a_line_change_nothing():
    """The flow past a line of straight pieces is exact on any nodes: tolerance rounding."""
    heights, pixel = rough_profile()
    finer = np.interp(np.arange(3 * heights.size - 2) / 3, np.arange(heights.size), heights)
    for memory in (0.0, 1e-7, 1e-5, 1e-3):
        depth = heights.min() + 3e-5
        coarse, fine = sweep(heights, pixel, memory, depth), sweep(finer, pixel / 3, memory, depth)
        assert np.count_nonzero(np.diff(coarse.touching.astype(int)) == 1) >= 2
        for name in ("force", "dissipation", "stiffness", "length", "first", "last"):
            assert getattr(fine, name) == pytest.approx(getattr(coarse, name), rel=1e-9), name


@pytest.mark.parametrize("memory", [0.03, 1.0, 40.0])
def test_a_free_surface_lands_where_it_meets_the_profile(memory):
    """Both are as high there, and nowhere before it is the profile the higher one."""
    rng, pixel, landed = np.random.default_rng(5), 0.7, 0
    for here, there, more in rng.uniform(-1, 1, (500, 3)):
        u, slope = max(here, 0.0) + abs(more), (here - there) / pixel
        t, height = _landing(here, there, slope, pixel, u, memory, np.exp(-pixel / memory))
        before = np.linspace(0.0, pixel if t == NOWHERE else t, 200)[:-1]
        assert (u * np.exp(-before / memory) >= here - slope * before - 1e-12).all()
        if t != NOWHERE and t > 0:
            landed += 1
            assert height == pytest.approx(u * np.exp(-t / memory), rel=1e-12)
            assert height == pytest.approx(here - slope * t, rel=1e-10, abs=1e-12)
    assert landed > 50


def greatest_pressed_before(answer):
    """Displacement [m] of a Kelvin foundation, u(x) = max(0, max_{y <= x} (d - g(y)) exp(-(x - y)/l)), l = v tau.

    Inside an interval, where the profile is linear, (d - g) + l g' = 0 may change its sign: a maximum.
    """
    scene, pixel = answer.scene, answer.measures["pixel"]
    memory, approach = (
        scene.motion.speed * scene.elastomer.relaxation_time,
        answer.depth - answer.fields["profile"],
    )
    decay, surface = np.exp(-pixel / memory), np.maximum(approach, 0.0)
    for i, (here, there) in enumerate(pairwise(approach)):
        reached, slope = [surface[i] * decay, there, 0.0], (there - here) / pixel
        if slope < 0 and 0 < (top := -memory - here / slope) < pixel:
            reached.append(-memory * slope * np.exp(-(pixel - top) / memory))
        surface[i + 1] = max(reached)
    return surface


@pytest.mark.parametrize("hurst", [0.0, 1.0])
@pytest.mark.parametrize("ratio", [1e-3, 1.0, 1e3])
def test_on_the_roughest_lines_displacement_is_the_greatest_of_what_was_pressed_before(hurst, ratio):
    radius, depth = 1e-3, 1e-4
    rough = SelfAffine(hurst=hurst, rms_height=depth, longest=2 * radius, shortest=radius / 2, seed=1)
    slide = Slide(speed=ratio * radius / TIME, depth=depth)
    answer = MDR(points=1000).solve(Scene(Sphere(radius**2 / depth), Kelvin(MODULUS, TIME), slide, rough))
    apart = np.abs(greatest_pressed_before(answer) - answer.fields["displacement"]).max()
    assert apart < 1e-12 * answer.depth  # rounding
