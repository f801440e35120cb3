"""Contact at rest on a free half-space against closed forms of Hertz, Sneddon and Galin."""

from itertools import pairwise

import numpy as np
import pytest

from bem3d import BEM
from scene import Cone, Elastic, EmptyContact, Indent, PowerLaw, Scene, SolveError, Sphere

G, R, THETA = 1e6, 10e-3, np.radians(10)
E_STAR = 4 * G
FORCE = 1e-3  # asked for: 0.1 % of the force at 64 points across the contact
D = 1e-4

CLOSED = {
    "sphere": (Sphere(R), 4 / 3 * E_STAR * np.sqrt(R) * D**1.5, np.sqrt(R * D)),
    "cone": (Cone(THETA), 2 / np.pi * E_STAR * D**2 / np.tan(THETA), 2 / np.pi * D / np.tan(THETA)),
    # z = c r^4: d = (8/3) c a^4, F = (8/5) E* d a
    "fourth power": (PowerLaw(1e6, 4), 1.6 * E_STAR * D * (D * 3 / 8e6) ** 0.25, (D * 3 / 8e6) ** 0.25),
}


def pressed(indenter, points, a, **motion):
    """At `points` across the contact of radius a."""
    n = int(1.5 * points)
    return BEM(points=n, extent=2 * a * n / points).solve(Scene(indenter, Elastic(G), Indent(**motion)))


@pytest.mark.parametrize("shape", CLOSED)
def test_force_depth_and_area_at_64_points_across_the_contact(shape):
    indenter, force, a = CLOSED[shape]
    by_depth, by_load = pressed(indenter, 64, a, depth=D), pressed(indenter, 64, a, load=force)
    assert by_depth.normal_force == pytest.approx(force, rel=FORCE)
    assert by_depth.residual <= 1e-5
    # the rim is known to a pixel: 4/64 of the area
    assert by_depth.measures["contact_area"] == pytest.approx(np.pi * a**2, rel=0.04)
    assert by_load.depth == pytest.approx(D, rel=FORCE)
    assert by_load.normal_force == pytest.approx(force, rel=1e-12)


@pytest.mark.parametrize("shape", ["sphere", "cone"])
def test_force_converges_at_order_three_halves_or_better(shape):
    # the contact edge moves by whole pixels, so errors scatter: the order is fitted over a factor of 16
    indenter, force, a = CLOSED[shape]
    points = np.array([16, 23, 32, 45, 64, 91, 128, 181, 256])
    errors = [abs(pressed(indenter, int(n), a, depth=D).normal_force / force - 1) for n in points]
    order = -np.polyfit(np.log(points), np.log(errors), 1)[0]
    assert 1.5 < order < 3, f"observed order {order:.2f}"


def test_the_extent_follows_from_the_scene():
    indenter, force, _ = CLOSED["sphere"]
    result = BEM(points=96).solve(Scene(indenter, Elastic(G), Indent(depth=D)))
    assert 64 < result.measures["points_across_contact"] < 96
    assert result.normal_force == pytest.approx(force, rel=FORCE)


def test_a_smooth_contact_between_the_centres_of_pixels_is_an_error_and_not_an_empty_one():
    scene = Scene(Sphere(R), Elastic(G), Indent(depth=D))
    with pytest.raises(SolveError, match="between the centres of pixels") as error:
        BEM(points=16, extent=1.0).solve(scene)
    assert not isinstance(error.value, EmptyContact)
    # and on the way from a coarse grid, which sees nothing of it, to a fine one it is none
    pixel = 4e-3 / 192
    found = BEM(points=192, extent=4e-3).solve(Scene(Sphere(R), Elastic(G), Indent(depth=(2.5 * pixel) ** 2 / R)))
    assert found.measures["contact_points"] >= 9


def test_applications_of_a_smooth_solve_hardly_grow_with_the_grid():
    """By a fifth at most with each doubling, where plain conjugate gradients take sqrt(2) times as many."""
    scene = Scene(Sphere(R), Elastic(G), Indent(depth=D))
    counts = [BEM(points=n).solve(scene).operator_applications for n in (64, 128, 256, 512)]
    assert all(after <= 1.2 * before for before, after in pairwise(counts)), counts
