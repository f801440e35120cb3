"""The window follows the contact, wherever it is; what cannot be trusted is an error that says how to mend it."""

import re
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from maps import refused

from bem3d import BEM
from bem3d.grid import Box, Grid
from bem3d.problem import Problem
from bem3d.response.engine import Engine
from bem3d.window import ATTEMPTS, check_resolved, fitted
from mdr1d import MDR
from scene import (
    Cone,
    Elastic,
    EmptyContact,
    Indent,
    Kelvin,
    PowerLaw,
    Scene,
    SelfAffine,
    Slide,
    SolveError,
    Sphere,
)

ROUGH = SelfAffine(hurst=0.2, rms_height=2e-4, longest=1e-2, shortest=5e-4, seed=2)
LIGHT = Scene(Sphere(1e-2), Elastic(1e6), Indent(load=1e-2), ROUGH)


def test_a_contact_that_reaches_the_rim_of_every_window_is_given_up(monkeypatch):
    asked = []
    monkeypatch.setattr(Grid, "on_rim", lambda *_: asked.append(1) or len(asked) < 2 * ATTEMPTS)
    fitted(Problem(replace(LIGHT, roughness=None), Engine()), 32)
    assert len(asked) == ATTEMPTS


# For the last two the window that is found first leaves asperities out.
@pytest.mark.parametrize(("seed", "load"), [(1, 1e-2), (2, 0.1), (3, 1.0), (9, 0.03), (35, 0.03)])
def test_fitted_window_leaves_no_asperity_out(seed, load):
    # the same pixels on a window far larger than any contact
    scene = replace(LIGHT, motion=Indent(load=load), roughness=replace(ROUGH, seed=seed))
    found = BEM(points=128).solve(scene)
    wide = 12e-3
    points = 2 * round(wide / (2 * max(found.measures["pixel"], wide / 512)))
    everything = BEM(points=points, extent=wide).solve(scene)
    assert found.depth == pytest.approx(everything.depth, abs=2e-3 * ROUGH.rms_height)


def test_a_grid_knows_its_points_their_boxes_and_values_in_between():
    grid = Grid(4, 8.0, (1.0, -2.0))
    inner, rim = np.zeros((4, 4), bool), np.zeros((4, 4), bool)
    inner[1, 1:3], rim[0, 1] = True, True
    assert grid.box(inner) == Box(-1, 3, -4, -2)
    assert grid.box(inner).padded(1).union(Box(0, 5, 0, 1)) == Box(-2, 5, -5, 1)
    assert (grid.on_rim(inner), grid.on_rim(rim), Grid(4, 8.0, width=3.0).on_rim(rim[:1])) == (False, True, False)
    # what is linear stays so, but for half a pixel at the rim; a contact stays as wide as it was
    fine = Grid(8, 8.0, (1.0, -2.0))
    plane = np.add.outer(2 * grid.y, grid.x)
    np.testing.assert_allclose(
        fine.resample(plane, grid)[1:-1, 1:-1], np.add.outer(2 * fine.y, fine.x)[1:-1, 1:-1]
    )
    assert list(np.flatnonzero(fine.resampled_contact(1.0 * inner, grid)[3])) == [2, 3, 4, 5]
    assert list(np.flatnonzero(fine.resampled_contact(1.0 * inner, grid)[:, 3])) == [2, 3]
    # and nothing is known to press beyond the other grid
    wider = Grid(8, 16.0, (1.0, -2.0)).resampled_contact(np.ones((4, 4)), grid)
    assert np.count_nonzero(wider) == 16


def test_nine_pixels_in_contact_are_enough_and_eight_are_not():
    touched = np.arange(16).reshape(4, 4) < 9
    check_resolved(Grid(4, 8.0), touched)
    touched[0, 0] = False
    with pytest.raises(SolveError, match="covers 8 of 4 x 4 points on extent = 8 m, 9 are needed"):
        check_resolved(Grid(4, 8.0), touched)


# A window is as wide as a coarser grid showed the contact: with its share of 48 points friction moves by this.
PIXELS = 3e-3


@pytest.mark.parametrize(("indenter", "exponent"), [(Sphere(1e-2), 2), (Cone(0.2), 1)])
def test_a_kelvin_solid_slid_ever_faster_keeps_the_law_of_a_fluid(indenter, exponent):
    """Where v tau >> a there is no length but a: F_N ~ v tau E* c a^n, so that mu ~ c a^(n-1) ~ v^(1/n - 1).

    A depth under a load has a logarithm besides: far upstream the surface creeps as 1/r, from v tau to a.
    """
    fast, fastest = 1e4, np.array([1e20, 1e35])

    def solved(speed):
        return BEM(points=48).solve(Scene(indenter, Kelvin(1e6, 1e-3), Slide(speed=speed, load=1.0)))

    known, found = solved(fast), [solved(speed) for speed in fastest]
    law = known.friction_coefficient * (fastest / fast) ** (1 / exponent - 1)
    np.testing.assert_allclose([answer.friction_coefficient for answer in found], law, rtol=PIXELS)
    assert all(answer.measures["points_across_contact"] > 0.6 * 48 for answer in (known, *found))
    creep = 1 / (np.pi * 4e6 * 1e-3) * np.log((fastest / fast) ** (1 + 1 / exponent))
    depths = np.array([answer.depth for answer in found]) * fastest
    np.testing.assert_allclose(depths, known.depth * fast + creep, rtol=1e-4)


SMOOTH = Scene(Sphere(1e-2), Elastic(1e6), Indent(load=1.0))


def test_without_a_shortest_wave_the_grid_cuts_the_spectrum_off_and_the_result_says_so():
    result = BEM(points=64).solve(replace(LIGHT, motion=Indent(load=1.0), roughness=replace(ROUGH, shortest=None)))
    assert result.settings["cutoff"] == "nyquist"
    assert result.measures["points_per_shortest_wave"] == pytest.approx(2)
    assert BEM(points=64).solve(replace(LIGHT, motion=Indent(load=1.0))).settings["cutoff"] == "resolved"


def drawn_contacts(count, seed):
    """Rough spheres, cones and blunt bodies at rest and sliding, whose waves 16 to 64 points hardly carry."""
    rng = np.random.default_rng(seed)
    for _ in range(count):
        body = (Sphere(1e-2), Cone(0.1), PowerLaw(1e6, 4.0))[rng.integers(3)]
        motion = (Indent(load=1.0), Slide(speed=10 ** rng.uniform(-3, 1), load=1.0), Slide(speed=0.1, depth=1e-4))
        rough = SelfAffine(
            hurst=0.7,
            rms_height=10 ** rng.uniform(-6, -4),
            longest=4e-3,
            shortest=10 ** rng.uniform(-4, -3),
            seed=int(rng.integers(100)),
        )
        scene = Scene(body, Kelvin(1e6, 1e-3), motion[rng.integers(3)], rough)
        yield BEM(points=int(rng.choice([16, 32, 64]))), scene


def test_what_is_foreseen_is_what_a_solve_would_fail_by():
    foreseen = 0
    for solver, scene in drawn_contacts(40, seed=1):
        if reasons := solver.foreseen(scene):
            foreseen += 1
            assert "less than two pixels" in reasons[0]
            refused(re.escape(reasons[0]), solver.solve, scene, error=SolveError)
        else:
            try:
                solver.solve(scene)
            except SolveError as error:  # for another reason, or in a window that peaks outside have made wider
                foreseen += "less than two pixels" not in str(error)
    assert foreseen > 10


@pytest.mark.parametrize(
    ("solver", "message"),
    [(BEM(points=64), "edge of extent"), (MDR(points=500), "the contact leaves the grid")],
)
def test_an_extent_that_a_contact_leaves_is_foreseen_with_one_that_holds_it(solver, message):
    near = replace(solver, extent=2e-3)
    for scene in (SMOOTH, replace(SMOOTH, roughness=replace(ROUGH, rms_height=2e-5))):
        (reason,) = near.foreseen(scene)
        refused(message, near.solve, scene, error=SolveError)
        extent, points = re.search(r"extent = ([\d.e-]+) holds it, with points = (\d+)", reason).groups()
        wider = replace(solver, points=int(points), extent=float(extent))
        assert wider.foreseen(scene) == []
        assert wider.solve(scene).normal_force == pytest.approx(1.0)
        assert solver.foreseen(scene) == []


DEEP = replace(SMOOTH, motion=Indent(depth=1e-4))


def test_a_smooth_contact_between_the_centres_of_pixels_is_an_error_and_not_an_empty_one():
    with pytest.raises(SolveError, match="between the centres of pixels") as error:
        BEM(points=16, extent=1.0).solve(DEEP)
    assert not isinstance(error.value, EmptyContact)
    # and on the way from a coarse grid, which sees nothing of it, to a fine one it is none
    pixel = 4e-3 / 192
    found = BEM(points=192, extent=4e-3).solve(replace(DEEP, motion=Indent(depth=(2.5 * pixel) ** 2 / 1e-2)))
    assert found.measures["contact_points"] >= 9


def test_applications_of_a_smooth_solve_hardly_grow_with_the_grid():
    """By a fifth at most with each doubling, where plain conjugate gradients take sqrt(2) times as many."""
    counts = [BEM(points=n).solve(DEEP).operator_applications for n in (64, 128, 256)]
    assert all(after <= 1.2 * before for before, after in pairwise(counts)), counts
