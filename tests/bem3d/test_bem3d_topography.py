"""Boundary elements on measured maps: the same answers as on the surface that was measured, or none."""

from dataclasses import replace
from math import pi

import numpy as np
import pytest
from maps import sampled

import scene.surfaces.topography
from bem3d import BEM, for_accuracy
from bem3d.engine import Engine
from bem3d.grid import Grid
from bem3d.problem import Problem
from bem3d.surface import RoughSurface
from scene import (
    Arrhenius,
    Coulomb,
    Indent,
    Kelvin,
    Layer,
    Measured,
    Plane,
    Program,
    Refused,
    Scene,
    SelfAffine,
    Shear,
    Slide,
    SolveError,
    Sphere,
    Stage,
    StandardLinearSolid,
    Topography,
)
from scene.scales import elastic_contact

L = 1e-3
ROUGH = SelfAffine(hurst=0.8, rms_height=2e-6, longest=L, shortest=L / 8, seed=1)
SOLID = StandardLinearSolid(1e6, 1e7, 1e-3)
ROUNDING = 1e-12  # of heights that differ by rounding, through a solve of the same steps
BALL = Sphere(1e-2)
PRESSED = Scene(Plane(), SOLID, Slide(speed=0.1, pressure=2e4), ROUGH)
SLIDING = Scene(BALL, SOLID, Slide(speed=0.1, load=0.1), replace(ROUGH, longest=4 * L, shortest=L / 2))


def same(one, other, rel):
    assert one.normal_force == pytest.approx(other.normal_force, rel=rel)
    assert one.depth == pytest.approx(other.depth, rel=rel)
    assert one.friction_force == pytest.approx(other.friction_force, rel=rel, abs=rel * one.normal_force)
    peak = one.fields["pressure"].max()
    np.testing.assert_allclose(one.fields["pressure"], other.fields["pressure"], atol=rel * peak)


# 17 pixels show eight waves and no more; of 64 the shorter ones are left out, to the rounding they have.
@pytest.mark.parametrize("map_", [{"points": 17}, {"points": 64, "shortest_kept": L / 8}])
@pytest.mark.parametrize("motion", [Slide(speed=0.1, pressure=2e4), Indent(gap=1e-6)])
def test_a_plane_with_the_map_of_a_surface_is_the_plane_with_that_surface(map_, motion):
    asked = replace(PRESSED, motion=motion)
    solver = BEM(points=64)
    one, other = (solver.solve(each) for each in (asked, replace(asked, roughness=sampled(ROUGH, **map_))))
    same(one, other, 1e-9 if motion.pressed_by == "gap" else ROUNDING)
    assert one.measures["rms_height"] == pytest.approx(other.measures["rms_height"], rel=ROUNDING)
    assert one.measures["rms_slope"] == pytest.approx(other.measures["rms_slope"], rel=ROUNDING)
    assert one.operator_applications == other.operator_applications


@pytest.mark.parametrize(
    ("effect", "rel"),
    [
        ({"motion": Indent(load=0.1)}, 1e-9),
        ({"motion": Slide(speed=0.1, depth=1e-5)}, 1e-9),
        ({"motion": Program(stages=(Stage(duration=1e-3, load=0.1), Stage(duration=1e-3, speed=0.2)))}, 1e-9),
        ({"layer": Layer(thickness=1e-3)}, 1e-8),
        ({"temperature": Arrhenius(temperature=310.0, reference=300.0, activation_energy=1e5)}, 1e-8),
        ({"motion": Shear(load=0.1, displacement=1e-6), "interface": Coulomb(coefficient=0.3)}, 1e-8),
    ],
    ids=str,
)
def test_a_sphere_with_the_map_of_a_surface_is_the_sphere_with_that_surface_beside_any_effect(effect, rel):
    asked, solver = replace(SLIDING, **effect), BEM(points=48, steps=8)
    one, other = (solver.solve(each) for each in (asked, replace(asked, roughness=sampled(asked.roughness, 17))))
    assert one.settings["extent"] == other.settings["extent"]
    same(one, other, rel)
    smooth = solver.solve(replace(asked, roughness=None))
    assert (one.normal_force, one.depth) != pytest.approx((smooth.normal_force, smooth.depth), rel=0.05)


def test_the_surface_of_a_map_is_the_map_and_a_seed_moves_it_by_whole_pixels():
    rng = np.random.default_rng(0)
    for repeat, seed in (("mirror", 0), ("periodic", 0), ("periodic", 5)):
        map_ = Topography(
            heights=rng.normal(size=(6, 9)), pixel=(1.0, 2.0), repeat=repeat, level="mean", seed=seed
        )
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
        # one transform over a period, or a product of matrices: the same sum
        side_x, side_y = map_.sides
        fine_x, fine_y = np.arange(60) * side_x / 60, np.arange(50) * side_y / 50
        apart = np.concatenate([fine_x, [0.1]])
        np.testing.assert_allclose(
            surface.heights(fine_x, fine_y), surface.heights(apart, fine_y)[:, :-1], atol=1e-13
        )


def test_a_map_without_heights_is_no_roughness():
    flat = Topography(heights=np.full((20, 20), 0.1), pixel=1e-4)
    smooth, bare = (BEM(points=32).solve(replace(SLIDING, roughness=each)) for each in (flat, None))
    same(smooth, bare, 0.0)
    assert smooth.operator_applications == bare.operator_applications


def test_the_map_is_built_once_for_all_grids(monkeypatch):
    calls = []
    build = scene.surfaces.topography._mirrored
    monkeypatch.setattr(scene.surfaces.topography, "_mirrored", lambda *given: calls.append(1) or build(*given))
    fresh = sampled(SLIDING.roughness, 19, repeat="mirror")
    for seed in (0, 1):
        BEM(points=48).solve(replace(SLIDING, roughness=replace(fresh, seed=seed)))
    assert len(calls) == 1


def test_rectangles_are_roughness_but_no_cell():
    heights = 1e-6 * np.random.default_rng(0).normal(size=(12, 18))
    map_ = Topography(heights=heights, pixel=1e-4, repeat="periodic", shortest_kept=4e-4)
    answer = BEM(points=64).solve(replace(SLIDING, roughness=map_, motion=Indent(load=0.1)))
    assert answer.normal_force == pytest.approx(0.1)
    with pytest.raises(Refused, match="cell of a Plane is a square: crop"):
        BEM(points=64).solve(replace(PRESSED, roughness=map_))


def test_a_grid_too_coarse_for_a_map_is_refused():
    map_ = sampled(ROUGH, 100)
    would = r"points = 100 would do.*roughness.shortest_kept = 2.1e-05 would leave out"
    with pytest.raises(Refused, match=would):
        BEM(points=96).solve(replace(PRESSED, roughness=map_))
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
    assert found.normal_force == pytest.approx(known.normal_force, rel=allowed)
    assert found.depth == pytest.approx(known.depth, rel=allowed)
    assert found.friction_force == pytest.approx(known.friction_force, rel=allowed)
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


def test_a_measured_sphere_in_time_is_a_sphere():
    program = Program(stages=(Stage(duration=1e-3, load=0.3), Stage(duration=2e-3, speed=0.5)))
    solver = BEM(points=64, steps=16)
    known, found = (solver.solve(Scene(body, SOLID, program)) for body in (BALL, ball(65, 4e-3)))
    np.testing.assert_allclose(found.fields["depth"], known.fields["depth"], rtol=2e-2)
    assert found.friction_force == pytest.approx(known.friction_force, rel=2e-2)


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
    for motion in (
        Indent(depth=deep.depth),
        Indent(load=deep.load),
        Slide(speed=0.1, load=4 * deep.load),
        Program(stages=(Stage(duration=1.0, load=deep.load),)),
    ):
        with pytest.raises(SolveError, match=r"rim of the map, 0\.001 x 0\.001 m"):
            BEM(points=96, steps=4).solve(Scene(body, SOLID, motion))
    # and a stated extent does not help
    with pytest.raises(SolveError, match="rim of the map"):
        BEM(points=128, extent=1.2e-3).solve(Scene(body, SOLID, Indent(load=deep.load)))
    assert BEM(points=96).solve(Scene(body, SOLID, Indent(depth=1e-6))).normal_force > 0


def test_a_body_that_is_not_reached_is_not_touched():
    # its lowest pixel lies on the axis, between the pixels of an even grid
    with pytest.raises(SolveError, match="between the centres of pixels"):
        BEM(points=64, extent=1e-3).solve(Scene(ball(65, 2e-3), SOLID, Indent(depth=1e-12)))


@pytest.mark.slow
def test_settings_for_a_map_keep_their_promise():
    rough = replace(SLIDING.roughness, shortest=L)
    asked = replace(SLIDING, roughness=sampled(rough, 9), elastomer=Kelvin(1e6, 1e-3))
    choice = for_accuracy(asked, friction=0.05)
    truth = BEM(points=256, tolerance=1e-6).solve(asked)
    assert choice.confirmed
    assert choice.result.friction_force == pytest.approx(truth.friction_force, rel=0.05)


def test_a_measured_body_puts_no_roughness_on_grids():
    problem = Problem(Scene(ball(64, 4e-3), SOLID, Indent(load=0.1)), Engine("ducc0", 1, "double"))
    grid = Grid(64, 1e-3)
    assert problem.surface(grid) is None
    assert problem.points_per_wave(grid) == pytest.approx(2 * (4e-3 / 64) / grid.pixel)
    assert Problem(Scene(BALL, SOLID, Indent(load=0.1)), problem.engine).shortest(grid) is None
