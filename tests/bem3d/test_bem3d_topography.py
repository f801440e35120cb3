"""Boundary elements on measured maps: the same answers as on the surface that was measured, or none."""

from dataclasses import replace
from math import pi

import numpy as np
import pytest
from changing_motion import program
from maps import noise, refused, sampled
from planned import STANDARD as SOLID

from bem3d import BEM
from bem3d.grid import Grid
from bem3d.surface import RoughSurface
from scene import (
    Arrhenius,
    Coulomb,
    Indent,
    Layer,
    Measured,
    Plane,
    Refused,
    Scene,
    SelfAffine,
    Shear,
    Slide,
    SolveError,
    Sphere,
    Topography,
)
from scene.scales import elastic_contact

L = 1e-3
ROUGH = SelfAffine(hurst=0.8, rms_height=2e-6, longest=L, shortest=L / 8, seed=1)
ROUNDING = 1e-12  # of heights that differ by rounding, through a solve of the same steps
BALL = Sphere(1e-2)
PRESSED = Scene(Plane(), SOLID, Slide(speed=0.1, pressure=2e4), ROUGH)
SLIDING = Scene(BALL, SOLID, Slide(speed=0.1, load=0.1), replace(ROUGH, longest=4 * L, shortest=L / 2))


def same(one, other, rel):
    assert (one.normal_force, one.depth) == pytest.approx((other.normal_force, other.depth), rel=rel)
    assert one.friction_force == pytest.approx(other.friction_force, rel=rel, abs=rel * one.normal_force)
    peak = one.fields["pressure"].max()
    np.testing.assert_allclose(one.fields["pressure"], other.fields["pressure"], atol=rel * peak)


@pytest.mark.parametrize(
    ("effect", "rel"),
    [
        ({"indenter": Plane(), "motion": Slide(speed=0.1, pressure=2e4)}, ROUNDING),
        ({"indenter": Plane(), "motion": Indent(gap=1e-6)}, 1e-9),
        ({"motion": Indent(load=0.1)}, 1e-9),
        ({"motion": Slide(speed=0.1, depth=1e-5)}, 1e-9),
        ({"motion": program({"duration": 1e-3, "load": 0.1}, {"duration": 1e-3, "speed": 0.2})}, 1e-9),
        ({"layer": Layer(thickness=1e-3)}, 1e-8),
        ({"temperature": Arrhenius(temperature=310.0, reference=300.0, activation_energy=1e5)}, 1e-8),
        ({"motion": Shear(load=0.1, displacement=1e-6), "interface": Coulomb(coefficient=0.3)}, 1e-8),
    ],
    ids=str,
)
def test_the_map_of_a_surface_is_that_surface_beside_any_effect(effect, rel):
    # 17 pixels show eight waves and no more; of 64 the shorter ones are left out, to the rounding they have
    asked, solver = replace(SLIDING, **effect), BEM(points=48, steps=8)
    maps = (sampled(asked.roughness, 17), sampled(asked.roughness, 64, shortest_kept=asked.roughness.shortest))
    one, *others = (solver.solve(replace(asked, roughness=each)) for each in (asked.roughness, *maps))
    for other in others:
        assert one.settings == other.settings
        same(one, other, rel)
        for name in ("rms_height", "rms_slope"):
            assert one.measures[name] == pytest.approx(other.measures[name], rel=ROUNDING)


def test_the_surface_of_a_map_is_the_map_and_a_seed_moves_it_by_whole_pixels():
    for repeat, seed in (("mirror", 0), ("periodic", 0), ("periodic", 5)):
        map_ = Topography(heights=noise((6, 9), seed), pixel=(1.0, 2.0), repeat=repeat, level="mean", seed=seed)
        column, row = map_.place
        assert (column == row == 0) == (seed == 0)
        surface = RoughSurface.of(map_, map_.q_max(0.0))
        x, y = np.arange(9) - 4.0, 2 * (np.arange(6) - 2.5)
        np.testing.assert_allclose(
            surface.heights(x, y), np.roll(map_.relief, (-row, -column), (0, 1)), atol=1e-13
        )
        step = 1e-6
        differences = (surface.heights(x + step, y) - surface.heights(x - step, y)) / (2 * step)
        np.testing.assert_allclose(surface.slopes(x, y), differences, atol=1e-8)


def test_rectangles_are_roughness_but_no_cell():
    heights = 1e-6 * noise((12, 18))
    map_ = Topography(heights=heights, pixel=1e-4, repeat="periodic", shortest_kept=4e-4)
    answer = BEM(points=64).solve(replace(SLIDING, roughness=map_, motion=Indent(load=0.1)))
    assert answer.normal_force == pytest.approx(0.1)
    with pytest.raises(Refused, match="cell of a Plane is a square: take"):
        BEM(points=64).solve(replace(PRESSED, roughness=map_))


def test_a_grid_too_coarse_for_a_map_is_refused():
    map_ = sampled(ROUGH, 100)
    would = r"points = 100 would do.*roughness.shortest_kept = 2.1e-05 would leave out"
    refused(would, BEM(points=96).solve, replace(PRESSED, roughness=map_), error=Refused)
    with pytest.raises(SolveError, match=r"indenter.shortest = 4e-05 m is less than two pixels"):
        BEM(points=32).solve(Scene(ball(200, 4e-3), SOLID, Indent(load=0.3)))
    # as fine as the map is fine enough, whatever the rounding of the period
    for points in (49, 50, 100):
        BEM(points=points).solve(replace(PRESSED, roughness=sampled(ROUGH, points)))


def ball(points, extent, middle=(0.0, 0.0), **other):
    grid = Grid(points, extent)
    x, y = grid.x - middle[0], grid.y[:, None] - middle[1]
    return Measured(heights=-(x**2 + y**2) / (2 * BALL.radius), pixel=grid.pixel, **other)


# A contact some 25 pixels in radius: the lowest pixel is not quite the apex, and windows are not the same.
@pytest.mark.parametrize(
    ("motion", "allowed"),
    [(Indent(load=0.3), 3e-3), (Indent(depth=1e-5), 1e-2), (Slide(speed=0.5, load=0.3), 5e-3)],
)
def test_a_measured_sphere_is_a_sphere(motion, allowed):
    asked, solver = Scene(BALL, SOLID, motion), BEM(points=96)
    known, found = solver.solve(asked), solver.solve(replace(asked, indenter=ball(97, 4e-3)))
    assert (found.normal_force, found.depth, found.friction_force) == pytest.approx(
        (known.normal_force, known.depth, known.friction_force), rel=allowed
    )
    assert found.measures["points_per_shortest_wave"] == pytest.approx(2 * (4e-3 / 97) / found.measures["pixel"])


def test_of_a_map_finer_than_the_grid_waves_are_left_out_as_the_refusal_says():
    fine, solver = ball(513, 4e-3), BEM(points=64, extent=2e-3)
    asked = Scene(fine, SOLID, Indent(load=0.3))
    known = solver.solve(replace(asked, indenter=BALL))
    rippled = replace(fine, heights=fine.heights.heights + 1e-7 * np.cos(pi * np.arange(513)))
    for body in (fine, rippled):
        with pytest.raises(Refused, match=r"indenter.shortest = .*; indenter.shortest_kept = ") as refused:
            solver.solve(replace(asked, indenter=body))
        kept = float(str(refused.value).partition("shortest_kept = ")[2].partition(" ")[0])
        found = solver.solve(replace(asked, indenter=replace(body, shortest_kept=kept)))
        # all that is left of the ripple is where its mirror images do not quite continue it
        assert found.depth == pytest.approx(known.depth, rel=1e-4)
        assert found.measures["contact_area"] == pytest.approx(known.measures["contact_area"], rel=1e-2)


def test_a_body_is_found_wherever_it_is_on_its_map():
    solver, load = BEM(points=96), Indent(load=0.05)
    answers = [
        solver.solve(Scene(ball(97, 4e-3, (at * 4e-3 / 97, -at * 4e-3 / 97)), SOLID, load)) for at in (0, 25)
    ]
    assert answers[1].settings["centre"] == pytest.approx((25 * 4e-3 / 97, -25 * 4e-3 / 97), abs=1e-4)
    assert answers[1].depth == pytest.approx(answers[0].depth, rel=5e-3)


def test_a_peak_too_thin_for_a_coarse_grid_is_found():
    # one pixel, far from the broad body: no point of the grids that place the window comes near it
    grid = Grid(201, 8e-3)
    x, y = grid.x, grid.y[:, None]
    heights = np.maximum(-((x + 1e-3) ** 2 + y**2) / (2 * BALL.radius), -5e-5)
    peak = np.argmin(np.abs(x - 3e-3))
    heights[100, peak] += 4e-5
    answer = BEM(points=256).solve(Scene(Measured(heights=heights, pixel=grid.pixel), SOLID, Indent(depth=3e-5)))
    at = answer.fields["x"][(answer.fields["pressure"] > 0).any(axis=0)]
    assert at.min() < -1e-3
    assert at.max() == pytest.approx(x[peak], abs=grid.pixel)


def test_a_contact_at_the_rim_of_a_map_is_an_error():
    body = ball(64, 1e-3)
    deep = elastic_contact(Scene(BALL, SOLID, Indent(depth=3e-5)))
    assert deep.radius > 0.5e-3
    for motion in (Indent(load=deep.load), program({"duration": 1.0, "load": deep.load})):
        with pytest.raises(SolveError, match=r"rim of the map, 0\.001 x 0\.001 m"):
            BEM(points=96, steps=4).solve(Scene(body, SOLID, motion))
    # and a stated extent does not help
    with pytest.raises(SolveError, match="rim of the map"):
        BEM(points=128, extent=1.2e-3).solve(Scene(body, SOLID, Indent(load=deep.load)))
    assert BEM(points=96).solve(Scene(body, SOLID, Indent(depth=1e-6))).normal_force > 0
