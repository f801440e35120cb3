"""A contact that starts where its neighbours were: the same answer, in fewer transforms."""

from dataclasses import replace

import numpy as np
import pytest
from sliding import KELVIN as SOLID

from bem3d import BEM, WarmStart
from scene import Cylinder, EmptyContact, Indent, Plane, Scene, SelfAffine, Slide, Sphere

ROUGH = SelfAffine(hurst=0.5, rms_height=1e-5, longest=2e-3, shortest=4e-4, seed=3)
SLIDING = Scene(Sphere(radius=1e-2), SOLID, Slide(speed=0.05, load=0.5), ROUGH)
CELL = Scene(Plane(), SOLID, Indent(pressure=2e4), replace(ROUGH, shortest=2e-4))


def at(speed, load=0.5):
    return replace(SLIDING, motion=Slide(speed=speed, load=load))


def assert_alike(found, alone):
    """Within what the tolerance leaves: a pixel at the edge may or may not press."""
    assert found.settings == alone.settings
    np.testing.assert_allclose(found.depth, alone.depth, rtol=1e-4)
    np.testing.assert_allclose(found.normal_force, alone.normal_force, rtol=1e-4)
    np.testing.assert_allclose(found.friction_force, alone.friction_force, rtol=1e-3)
    np.testing.assert_allclose(found.measures["contact_points"], alone.measures["contact_points"], rtol=0.01)


def smooth(load):
    return replace(at(0.05, load), roughness=None)


@pytest.mark.parametrize(
    "scenes",
    [
        [at(speed) for speed in (0.0, 0.01, 0.02)],
        [at(speed) for speed in (5.0, 0.01, 500.0)],
        [at(0.05, load=50.0), SLIDING, replace(SLIDING, indenter=Sphere(radius=1e-3)), SLIDING, CELL, SLIDING],
        [smooth(1e-9), smooth(50.0)],  # the next grid misses the first contact
    ],
    ids=["near", "far", "other bodies and loads", "small and large"],
)
def test_whatever_was_solved_before_the_answer_is_that_of_a_solve_alone(scenes):
    warm_start, solver = WarmStart(), BEM(points=64)
    for scene in scenes:
        assert_alike(solver.solve(scene, warm_start), solver.solve(scene))


def pairs(*answers):
    """Transform pairs, in those of the finest grid."""
    finest = max(each.settings["points"] for each in answers)
    return sum(each.measures["transform_pairs"] * (each.settings["points"] / finest) ** 2 for each in answers)


def test_a_scene_is_placed_once_and_its_coarse_contact_starts_the_fine_one():
    warm_start, grids = WarmStart(), (BEM(points=64), BEM(points=128))
    found, alone = [each.solve(SLIDING, warm_start) for each in grids], [each.solve(SLIDING) for each in grids]
    for one, other in zip(found, alone, strict=True):
        assert_alike(one, other)
    assert found[0].measures["transform_pairs"] == alone[0].measures["transform_pairs"]
    assert pairs(found[1]) < 0.85 * pairs(alone[1])


def test_a_neighbour_starts_a_slow_contact_and_does_no_harm_to_a_fast_one():
    for slow, factor in ((True, 0.8), (False, 1.1)):
        warm_start, solver = WarmStart(), BEM(points=128)
        speeds = (0.02, 0.025) if slow else (0.1, 5.0)
        solver.solve(at(speeds[0]), warm_start)
        assert pairs(solver.solve(at(speeds[1]), warm_start)) < factor * pairs(solver.solve(at(speeds[1])))


def test_cells_lines_and_stated_windows_start_from_their_neighbours():
    for scene, solver in (
        (CELL, BEM(points=64)),
        (replace(CELL, motion=Slide(speed=0.1, pressure=2e4)), BEM(points=64)),
        (Scene(Cylinder(radius=1e-2), SOLID, Slide(speed=0.1, line_load=50.0)), BEM(points=64)),
        (SLIDING, BEM(points=64, extent=4e-3)),
    ):
        warm_start = WarmStart()
        replace(solver, points=32).solve(scene, warm_start)
        found, alone = solver.solve(scene, warm_start), solver.solve(scene)
        assert_alike(found, alone)
        assert found.measures["transform_pairs"] <= alone.measures["transform_pairs"]


def test_a_failed_solve_leaves_nothing_to_start_from():
    warm_start, solver = WarmStart(), BEM(points=64)
    with pytest.raises(EmptyContact):
        solver.solve(
            replace(SLIDING, motion=Indent(depth=1e-9), roughness=replace(ROUGH, rms_height=1e-7)), warm_start
        )
    assert warm_start.neighbour(64) is None
    found = solver.solve(SLIDING, warm_start)
    assert found.measures["transform_pairs"] == solver.solve(SLIDING).measures["transform_pairs"]
