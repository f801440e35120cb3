"""Friction at low speed: in three dimensions the curvature under the static pressure, in one the squared slope."""

from dataclasses import replace
from functools import cache
from math import nan, pi, tan

import numpy as np
import pytest
from sliding import KELVIN

from bem3d import BEM
from bem3d.friction.estimates import Friction
from compare.models.exact import mean_lag, slow_friction_by_curvature, slow_friction_by_slope
from mdr1d import MDR
from scene import (
    Cone,
    CrossedWaves,
    Cylinder,
    Indent,
    KelvinChain,
    Plane,
    Scene,
    SelfAffine,
    Slide,
    Sphere,
    StandardLinearSolid,
)
from scene.scales import elastic_contact

G, TAU, R, THETA = 1e6, 1e-3, 1e-2, 0.1
SOLID = StandardLinearSolid(rubbery_modulus=G, glassy_modulus=5 * G, relaxation_time=TAU / 4)
ROUGH = SelfAffine(hurst=0.6, rms_height=1e-5, longest=5e-3, shortest=2.5e-4, seed=1)
# Sums of some ten thousand numbers.
ROUNDING = 1e-12
# Error of first order: a cone on 256 points.
TIP = 4e-3
# Error of slow friction on 256 points, which is half of that on 128.
GRID = 0.01


@cache
def curvature(scene, points):
    return BEM(points=points).solve(scene).measures["curvature_by_pressure"]


def slow(scene, loss):
    """The scene sliding so slowly that its shortest wave has a tangent of loss v tau q_s as given."""
    q_s = scene.roughness.q_max(nan)
    return replace(scene, motion=Slide(speed=loss / q_s / mean_lag(scene.elastomer), load=scene.motion.load))


@pytest.mark.parametrize("speed", [0.0, 10.0])
@pytest.mark.parametrize(
    ("indenter", "pressed"), [(Sphere(radius=R), {"load": 1.0}), (Cylinder(radius=R), {"line_load": 100.0})]
)
def test_a_sphere_and_a_cylinder_are_curved_alike_everywhere(indenter, pressed, speed):
    assert curvature(Scene(indenter, KELVIN, Slide(speed=speed, **pressed)), 64) == pytest.approx(
        1 / R, rel=ROUNDING
    )


def test_a_cone_is_curved_by_half_pi_tan_theta_over_a_to_first_order_in_the_pixel():
    scene = Scene(Cone(angle=THETA), KELVIN, Indent(load=1.0))
    expected = pi / 2 * tan(THETA) / elastic_contact(scene).radius
    errors = np.array([curvature(scene, points) / expected - 1 for points in (64, 128, 256)])
    assert abs(errors[-1]) < TIP
    np.testing.assert_allclose(np.log2(errors[:-1] / errors[1:]), 1.0, atol=0.05)


def test_slow_friction_is_the_curvature_under_the_pressure_at_rest_also_on_a_coarse_grid():
    scene = Scene(Cone(angle=THETA), SOLID, Indent(load=1.0), ROUGH)

    def solved(loss, points):
        slid = slow(scene, loss)
        law = slow_friction_by_curvature(slid.motion.speed, mean_lag(SOLID), 1.0, curvature(scene, 256))
        return law, BEM(points=points).solve(slid)

    ratios = [found.friction_force / law for law, found in (solved(loss, 256) for loss in (0.01, 1.0))]
    assert ratios[0] == pytest.approx(1.0, abs=GRID)
    assert ratios[1] < 1 - 2 * GRID  # a law for low speeds alone
    law, coarse = solved(1e-3, 64)
    forces = coarse.friction_force, coarse.measures["friction_by_loss"]
    error, of_loss = (abs(force / law - 1) for force in forces)
    assert error < of_loss / 2
    assert of_loss > 0.01
    # which the indicator of the error says
    assert coarse.measures["friction_disagreement"] > 3 * error * coarse.friction_coefficient


def test_a_faint_mode_of_long_memory_keeps_curvature_from_counting():
    # To first order in the speed its friction would be a hundred times the other mode's; it has almost none.
    faint = KelvinChain(
        instantaneous_compliance=0.1 / G, compliances=(1 / G, 1e-6 / G), retardation_times=(TAU, 1e8 * TAU)
    )
    scene = Scene(Sphere(radius=R), faint, Slide(speed=1e-6, load=1.0))
    found = BEM(points=64).solve(scene)
    assert found.measures["friction_by_curvature"] > 50 * found.friction_force
    without = replace(faint, compliances=(1 / G,), retardation_times=(TAU,))
    assert found.friction_force == pytest.approx(
        BEM(points=64).solve(replace(scene, elastomer=without)).friction_force, rel=0.1
    )


def test_without_an_edge_slow_friction_is_the_energy_lost():
    slid = Scene(Plane(), KELVIN, Slide(speed=1e-6, pressure=1e6), CrossedWaves(amplitude=1e-6, wavelength=1e-3))
    answer = BEM(points=32, tolerance=1e-9).solve(slid)
    assert answer.measures["contact_fraction"] == 1
    loss = answer.measures["friction_by_loss"]
    assert abs(answer.measures["friction_by_curvature"] / loss - 1) < ROUNDING  # to first order in the speed
    assert abs(answer.friction_force / loss - 1) < ROUNDING


@pytest.mark.parametrize(
    ("lag", "slowness", "most", "force"),
    [
        (0.0, 0.0, 0.5, 1.0),
        (0.0, 0.5, 0.25, 1.0625),
        (1.0, 0.0, 2.0, 3.0),
        (0.0, 1.0, 0.125, 1.125),
        (0.5, 0.0, 1.0, 2.0),
    ],
)
def test_estimates_join_and_disagree_as_far_as_they_count(lag, slowness, most, force):
    # The loss is 1, the traction 3, the work 1.5 and the curvature 1.125.
    estimates = {"by_traction": 3.0, "by_loss": 1.0, "by_work": 1.5, "by_curvature": 1.125, "mean_curvature": 0.0}
    found = Friction(**estimates, lag=lag, slowness=slowness)
    assert (found.disagreement, found.force) == (most, force)
    assert found.measures(2.0)["friction_disagreement"] == most / 2


def test_slow_friction_in_one_dimension_is_the_squared_slope_in_the_contact_at_rest():
    scene, speed = Scene(Sphere(radius=R), SOLID, Indent(load=1.0), ROUGH), 1e-9
    at_rest = MDR().solve(scene).measures
    slope, length = at_rest["rms_slope_contact"], at_rest["contact_length"]
    law = slow_friction_by_slope(speed, mean_lag(SOLID), SOLID.indentation_modulus, slope, length)
    found = MDR().solve(replace(scene, motion=Slide(speed=speed, load=1.0))).friction_force
    # A picometre of memory, on contacts of ten micrometres at least.
    assert found == pytest.approx(law, rel=1e-5, abs=0.0)
