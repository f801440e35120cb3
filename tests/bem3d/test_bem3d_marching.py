"""Marching in time: closed forms of indentation, the steady solver, the elastic one, and what a history keeps."""

from math import sqrt

import numpy as np
import pytest
from changing_motion import DEPTH, TAU, A, G, R, program

import bem3d.motion.timeline
from bem3d import BEM
from bem3d.grid import Grid
from bem3d.motion import marching
from bem3d.motion.marching import march
from bem3d.motion.material import Creep
from bem3d.motion.timeline import timeline
from bem3d.problem import Problem
from bem3d.response.engine import Engine
from compare.models.exact import indentation
from mdr1d import MDR
from scene import (
    Cylinder,
    Elastic,
    Kelvin,
    PowerLaw,
    Prony,
    Scene,
    Slide,
    Sphere,
    StandardLinearSolid,
)

# Plane-strain moduli are 4G: 1 relaxed and 5 at once, relaxing in 1 s at constant strain.
SOLID = StandardLinearSolid(0.25, 1.25, 1.0)
SPHERE = Sphere(1.0)
RAMP = program({"duration": 2.0, "depth": 0.2})
TOLERANCE = 1e-6  # of each contact: below all that is compared

PIXELS = 1e-3  # 64 points, 40 to 55 across the contact: errors are some 2e-4, and jump as single pixels join
EXTENT = 3.2 * A  # a body that yields late is touched up to sqrt(2) A ahead
KELVIN, GLASSY = Kelvin(G, TAU), StandardLinearSolid(G, 10 * G, TAU / 10)


def marched(indenter, solid, motion, steps, points=64, extent=1.5):
    problem = Problem(Scene(indenter, solid, motion.held), Engine())
    return march(problem, motion, Grid(points, extent, width=problem.width), TOLERANCE, steps)


def late(history):
    """The second half, in which the contact is well resolved."""
    return history.time > history.time[-1] / 2


def test_while_the_contact_grows_on_three_modes_its_force_is_that_of_lee_and_radok():
    solid = Prony(0.25, (0.3, 0.5, 0.2), (0.1, 1.0, 10.0))
    history = marched(SPHERE, solid, RAMP, 48)
    expected, _ = indentation.force_of_depth(SPHERE, solid, [0, 2], [0, 0.2], history.time)
    np.testing.assert_allclose(history.normal_force[late(history)], expected[late(history)], rtol=PIXELS)


@pytest.mark.parametrize("late_by", [0, pytest.param(1, marks=pytest.mark.slow)])
def test_the_force_is_of_second_order_in_the_step_and_of_first_if_met_at_its_end(late_by, monkeypatch):
    monkeypatch.setattr(bem3d.motion.timeline, "RAMP", 1)
    if late_by:
        monkeypatch.setattr(Creep, "collocation", lambda creep, step: step)
    errors = []
    for steps in (6, 12, 24):
        # 128 points: what the pixels add, 3e-5, is the same on all but for the growth of the contact by pixels
        history = marched(SPHERE, SOLID, RAMP, steps, points=128)
        expected, _ = indentation.force_of_depth(SPHERE, SOLID, [0, 2], [0, 0.2], history.time)
        errors.append((history.normal_force / expected - 1)[late(history)].mean())
    order = np.log2((errors[1] - errors[0]) / (errors[2] - errors[1]))
    assert order == pytest.approx(1.0, abs=0.4) if late_by else order > 1.7


def test_a_step_is_seen_in_its_middle_by_an_elastic_solid_and_later_by_a_kelvin_body():
    kelvin, short = Creep.of(KELVIN), 1e-2 * TAU
    assert Creep.of(Elastic(G)).collocation(2.0) == 1.0
    assert kelvin.collocation(short) / short == pytest.approx(0.5 + 1 / sqrt(12), rel=2e-3)  # and O(step/TAU)
    assert kelvin.collocation(1e-6 * TAU) / (1e-6 * TAU) == pytest.approx(0.5 + 1 / sqrt(12), rel=1e-3)
    solid = Creep.of(SOLID)  # compliances 1/5 at once and 4/5 in 5 s
    assert (solid.instantaneous, *solid.shares, *solid.times) == pytest.approx((0.2, 0.8, 5.0))
    assert (solid.compliance(5.0), kelvin.loss_in_steps(2 * TAU)) == pytest.approx(
        (1 - 0.8 * np.exp(-1), np.tanh(1))
    )


def test_a_depth_that_is_seen_late_in_its_step_is_told_of_the_middle():
    seen, middle = np.array([0.6, 1.6, 2.7]), np.array([0.5, 1.5, 2.5])
    found = marching._back(seen, 2 * seen, middle)
    np.testing.assert_allclose(found, [1.2, 3.0, 5.0])  # nothing is known before the first
    np.testing.assert_allclose(marching._back(seen, np.array([np.nan, 1.0, 2.1]), middle)[1], 1.0)


def started(solid, ratio, points):
    """From rest to a speed of ratio A / TAU, at the depth of A; and the steady solver's answer."""
    speed = ratio * A / TAU
    steady = BEM(points, EXTENT).solve(Scene(Sphere(R), solid, Slide(speed=speed, depth=DEPTH)))
    motion = program(
        {"duration": TAU / 100, "depth": DEPTH}, {"duration": 1.5 * EXTENT / speed + 5 * TAU, "speed": speed}
    )
    return marched(Sphere(R), solid, motion, 2, points, EXTENT), steady


@pytest.mark.parametrize(
    ("solid", "ratio", "points", "force", "friction"),
    [
        (GLASSY, 1.0, 48, 5e-4, 2e-3),
        pytest.param(KELVIN, 10.0, 32, 1.5e-3, 4e-3, marks=pytest.mark.slow),
        pytest.param(KELVIN, 0.1, 48, 5e-4, 5e-3, marks=pytest.mark.slow),
    ],
)
def test_a_start_from_rest_ends_in_the_steady_contact(solid, ratio, points, force, friction):
    # two discretisations: in the indenter's frame, and on material pixels held for a step
    history, steady = started(solid, ratio, points)
    mu = history.friction_by_traction / history.normal_force
    assert history.normal_force[-3] == pytest.approx(steady.normal_force, rel=force)
    assert mu[-3] == pytest.approx(steady.friction_coefficient, rel=friction)
    assert history.friction_by_work[-3] == pytest.approx(history.friction_by_traction[-3], rel=0.02)
    assert mu[0] == pytest.approx(0.0, abs=1e-9)


def test_a_load_taken_away_leaves_no_depth_and_that_is_no_error():
    motion = program({"duration": TAU, "load": 1.0}, {"duration": TAU, "load": 0.0}, {"duration": TAU})
    result = BEM(points=32, steps=30).solve(Scene(Sphere(R), GLASSY, motion))
    force, depth = result.fields["normal_force"], result.fields["depth"]
    np.testing.assert_allclose(force, motion.prescribed(result.fields["time"]), atol=1e-12)
    assert np.array_equal(np.isnan(depth), force == 0)
    assert result.normal_force == result.friction_force == 0
    assert np.isnan(result.depth)
    assert np.isnan(result.friction_coefficient)


def test_steps_are_pixels_of_path_or_fractions_and_end_with_the_stages():
    motion = program(
        {"duration": 1.0, "depth": 1.0}, {"duration": 1.03, "speed": 2.0}, {"duration": 0.5, "speed": 0.01}
    )
    times = timeline(motion, pixel=0.1, steps=10)
    assert set(np.cumsum([0.0, 1.0, 1.03, 0.5])) <= set(times)
    first, last = np.searchsorted(times, [1.0, 2.03])
    np.testing.assert_allclose(np.diff(times[first : last + 1]), [*[0.05] * 19, 0.04, 0.04])
    assert np.diff(timeline(motion, pixel=0.1, steps=1000)).max() < 2.54e-3


def test_after_a_ramp_steps_grow_by_a_quarter_to_those_of_the_hold():
    ramp = program({"duration": 0.01, "depth": 1.0}, {"duration": 10.0})
    growth = np.diff(np.log(np.diff(timeline(ramp, pixel=1.0, steps=10))))
    np.testing.assert_allclose(growth[:19], 0.0, atol=1e-9)
    np.testing.assert_allclose(growth[20:-5], np.log(1.25))
    assert np.diff(timeline(ramp, pixel=1.0, steps=10)).max() < 1.001


@pytest.mark.parametrize("points", [16, 33])
def test_lowest_points_that_are_alike_are_no_trouble_to_start_from(points):
    line = Scene(Cylinder(R), GLASSY, program({"duration": 1.0, "line_load": 300.0}))
    assert BEM(points=points).solve(line).normal_force == pytest.approx(300.0, rel=0.05)


@pytest.mark.parametrize("exponent", [40.0, 100.0])
def test_pressed_to_a_depth_a_blunt_body_has_the_force_of_one_dimension_at_every_step(exponent):
    # the corners of the window are 1e10 to 1e27 times as high as the indenter is pressed in
    motion = program({"duration": 2 * TAU, "depth": 5e-5}, {"duration": 2 * TAU, "depth": 1e-5})
    scene = Scene(PowerLaw(1e-4 / A**exponent, exponent), KELVIN, motion)
    found, known = (solver.solve(scene).fields for solver in (BEM(points=32, steps=50), MDR()))
    force = np.interp(found["time"], known["time"], known["normal_force"])
    assert force.max() > 0.5
    # 25 points across the contact, and a step of a fiftieth
    np.testing.assert_allclose(found["normal_force"], force, rtol=0, atol=0.01 * force.max())
