"""Marching in time: closed forms of indentation, the steady solver, the elastic one, and what a history keeps."""

from math import pi, sqrt

import numpy as np
import pytest

import bem3d.timeline
from bem3d import BEM, marching
from bem3d.engine import Engine
from bem3d.grid import Grid
from bem3d.marching import march
from bem3d.material import Creep
from bem3d.problem import Problem
from bem3d.timeline import timeline
from bem3d.upstream import Endless, Sheet
from compare.models.exact import indentation
from mdr1d import MDR
from scene import (
    Cone,
    CrossedWaves,
    Cylinder,
    Elastic,
    Kelvin,
    PowerLaw,
    Program,
    Prony,
    Scene,
    Slide,
    SolveError,
    Sphere,
    Stage,
    StandardLinearSolid,
)

# Plane-strain moduli are 4G: 1 relaxed and 5 at once, relaxing in 1 s at constant strain.
SOLID = StandardLinearSolid(0.25, 1.25, 1.0)
SPHERE = Sphere(1.0)
RAMP = Program(stages=(Stage(duration=2.0, depth=0.2),))
TOLERANCE = 1e-6  # of each contact: below all that is compared

PIXELS = 1e-3  # 64 points, 40 to 55 across the contact: errors are some 2e-4, and jump as single pixels join
R, G, A, TAU = 1e-2, 1e6, 1e-3, 1e-3  # sliding sphere, contact radius A at rest
EXTENT = 3.2 * A  # a body that yields late is touched up to sqrt(2) A ahead
ACCURACY = 2e-3  # of answers in a window that is found: of 64 points and some 50 steps
KELVIN, GLASSY = Kelvin(G, TAU), StandardLinearSolid(G, 10 * G, TAU / 10)
CREEPING = StandardLinearSolid(G, 5 * G, TAU)  # in 5 TAU


def marched(indenter, solid, program, steps, points=64, extent=1.5, roughness=None):
    problem = Problem(Scene(indenter, solid, program.held, roughness), Engine())
    return march(problem, program, Grid(points, extent, width=problem.width), TOLERANCE, steps)


def late(history):
    """The second half, in which the contact is well resolved."""
    return history.time > history.time[-1] / 2


# Sphere, cone; their windows under a depth of 0.2, and a load with the window under it.
@pytest.mark.parametrize(
    ("indenter", "extent", "load", "under"),
    [(Sphere(1.0), 1.5, 0.12, 1.2), (Cone(pi / 4), 0.4, 0.02, 0.35)],
    ids=["sphere", "cone"],
)
def test_a_ramp_follows_lee_and_radok_and_unloading_to_separation_ting(indenter, extent, load, under):
    program = Program(stages=(*RAMP.stages, Stage(duration=2.0, depth=0.0)))
    history = marched(indenter, SOLID, program, 160, extent=extent)
    expected, _ = indentation.force_of_depth(indenter, SOLID, [0, 2, 4], [0, 0.2, 0], history.time)
    # against the greatest force: near separation the contact is a few pixels
    np.testing.assert_allclose(history.normal_force, expected, atol=PIXELS * expected.max())
    apart = history.time > 3.3
    assert np.all(expected[apart] == 0)
    assert np.all(history.normal_force[apart] == 0)
    assert np.all(history.gap > 0)
    history = marched(indenter, SOLID, Program(stages=(Stage(duration=2.0, load=load),)), 32, extent=under)
    expected = indentation.loading_depth(indenter, SOLID, [0, 2], [0, load], history.time)
    np.testing.assert_allclose(history.depth[late(history)], expected[late(history)], rtol=PIXELS)


def test_while_the_contact_grows_on_three_modes_its_force_is_that_of_lee_and_radok():
    solid = Prony(0.25, (0.3, 0.5, 0.2), (0.1, 1.0, 10.0))
    history = marched(SPHERE, solid, RAMP, 48)
    expected = indentation.loading_force(SPHERE, solid, [0, 2], [0, 0.2], history.time)
    np.testing.assert_allclose(history.normal_force[late(history)], expected[late(history)], rtol=PIXELS)


@pytest.mark.parametrize("late_by", [0, pytest.param(1, marks=pytest.mark.slow)])
def test_the_force_is_of_second_order_in_the_step_and_of_first_if_met_at_its_end(late_by, monkeypatch):
    monkeypatch.setattr(bem3d.timeline, "RAMP", 1)
    if late_by:
        monkeypatch.setattr(Creep, "collocation", lambda creep, step: step)
    errors = []
    for steps in (6, 12, 24):
        # 128 points: what the pixels add, 3e-5, is the same on all but for the growth of the contact by pixels
        history = marched(SPHERE, SOLID, RAMP, steps, points=128)
        expected = indentation.loading_force(SPHERE, SOLID, [0, 2], [0, 0.2], history.time)
        errors.append((history.normal_force / expected - 1)[late(history)].mean())
    order = np.log2((errors[1] - errors[0]) / (errors[2] - errors[1]))
    assert order == pytest.approx(1.0, abs=0.4) if late_by else order > 1.7


@pytest.mark.slow
def test_the_error_falls_with_the_pixel_faster_than_in_proportion():
    def error(points):
        history = marched(SPHERE, SOLID, RAMP, 64, points=points)
        expected = indentation.loading_force(SPHERE, SOLID, [0, 2], [0, 0.2], history.time)
        return np.abs(history.normal_force / expected - 1)[late(history)].mean()

    coarse, fine = error(24), error(96)
    assert fine < coarse / 6  # 4 at first order, 16 at second


def test_a_step_is_seen_in_its_middle_by_an_elastic_solid_and_later_by_a_kelvin_body():
    kelvin, short = Creep.of(KELVIN), 1e-2 * TAU
    assert Creep.of(Elastic(G)).collocation(2.0) == 1.0
    assert kelvin.collocation(short) / short == pytest.approx(0.5 + 1 / sqrt(12), rel=2e-3)  # and O(step/TAU)
    assert kelvin.collocation(1e-6 * TAU) / (1e-6 * TAU) == pytest.approx(0.5 + 1 / sqrt(12), rel=1e-3)
    solid = Creep.of(SOLID)  # compliances 1/5 at once and 4/5 in 5 s
    assert (solid.instantaneous, *solid.shares, *solid.times) == pytest.approx((0.2, 0.8, 5.0))
    assert solid.compliance(5.0) == pytest.approx(1 - 0.8 * np.exp(-1))
    assert kelvin.loss_in_steps(2 * TAU) == pytest.approx(np.tanh(1))


def test_a_depth_that_is_seen_late_in_its_step_is_told_of_the_middle():
    seen, middle = np.array([0.6, 1.6, 2.7]), np.array([0.5, 1.5, 2.5])
    found = marching._back(seen, 2 * seen, middle)
    np.testing.assert_allclose(found, [1.2, 3.0, 5.0])  # nothing is known before the first
    np.testing.assert_allclose(marching._back(seen, np.array([np.nan, 1.0, 2.1]), middle)[1], 1.0)


def started(solid, ratio, points, memories=5.0):
    """From rest to a speed of ratio A / TAU, at the depth of A; and the steady solver's answer."""
    speed, depth = ratio * A / TAU, A**2 / R
    steady = BEM(points, EXTENT).solve(Scene(Sphere(R), solid, Slide(speed=speed, depth=depth)))
    run = Stage(duration=1.5 * EXTENT / speed + memories * TAU, speed=speed)
    program = Program(stages=(Stage(duration=TAU / 100, depth=depth), run))
    return marched(Sphere(R), solid, program, 2, points, EXTENT), steady


@pytest.mark.parametrize(
    ("solid", "ratio", "points", "force", "friction"),
    [
        (GLASSY, 1.0, 48, 5e-4, 2e-3),
        (KELVIN, 10.0, 32, 1.5e-3, 4e-3),
        pytest.param(KELVIN, 0.1, 48, 5e-4, 5e-3, marks=pytest.mark.slow),
    ],
    ids=str,
)
def test_a_start_from_rest_ends_in_the_steady_contact(solid, ratio, points, force, friction):
    # two discretisations: in the indenter's frame, and on material pixels held for a step
    history, steady = started(solid, ratio, points)
    mu = history.friction_by_traction / history.normal_force
    assert history.normal_force[-3] == pytest.approx(steady.normal_force, rel=force)
    assert mu[-3] == pytest.approx(steady.friction_coefficient, rel=friction)
    assert history.friction_by_work[-3] == pytest.approx(history.friction_by_traction[-3], rel=0.02)
    assert mu[0] == pytest.approx(0.0, abs=1e-9)


def test_what_lies_upstream_must_not_be_left_out(monkeypatch):
    monkeypatch.setattr(marching, "Endless", lambda window, path, half_space: Endless(window, 0.0, half_space))
    history, steady = started(KELVIN, 1.0, 32)
    assert abs(history.normal_force[-3] / steady.normal_force - 1) > 0.05


def test_what_comes_into_the_window_is_what_the_contact_did_there():
    # a patch of pressure, held until all has relaxed: the columns that come in have its elastic displacement
    grid = Grid(32, 32.0)
    problem = Problem(Scene(Sphere(R), KELVIN, Program(stages=(Stage(duration=1, depth=1),)).held), Engine())
    around = Endless(Sheet(grid, 1), 40.0, lambda at: lambda p: problem.medium.operator(at)(p) * at.pixel)
    pressure = np.zeros((32, 32))
    pressure[8:26, 4:28] = 1 + np.arange(24)
    around.creep(pressure, np.zeros(1), np.ones(1))
    around.follow(12.0, 0.0)
    wide = np.zeros((64, 64))
    wide[16:48, 32:] = pressure  # the window is the right half: 12 columns more to the left come in
    expected = problem.medium.operator(Grid(64, 64.0))(wide)[16:48, 20:32]
    np.testing.assert_allclose(around.window.fields[0, :, :12], expected, rtol=2e-3)


@pytest.mark.slow
def test_the_contact_does_not_drift_in_steady_sliding():
    depth, speed = A**2 / R, 0.3 * A / TAU
    stages = Stage(duration=TAU, depth=depth), Stage(duration=400 * EXTENT / 24 / speed, speed=speed)
    history = marched(Sphere(R), KELVIN, Program(stages=stages), 2, 24, EXTENT)
    assert len(history.time) > 400
    np.testing.assert_allclose(history.normal_force[-200:-2], history.normal_force[-200], rtol=10 * TOLERANCE)


@pytest.mark.slow
def test_after_recovery_the_second_cycle_is_the_first_and_before_it_is_not():
    for recovery, steps in ((18 * TAU, 320), (TAU / 4, 72)):
        cycle = Stage(duration=TAU, depth=1e-4), Stage(duration=TAU, depth=0.0), Stage(duration=recovery)
        history = marched(Sphere(R), GLASSY, Program(stages=cycle * 2), steps, 32, EXTENT)
        first, second = np.split(history.normal_force, 2)
        # exp(-18) is left, and contacts are solved to 1e-6
        assert (np.abs(second - first).max() < 1e-5 * first.max()) == (recovery > TAU)


def test_a_load_taken_away_leaves_no_depth_and_that_is_no_error():
    program = Program(stages=(Stage(duration=TAU, load=1.0), Stage(duration=TAU, load=0.0), Stage(duration=TAU)))
    result = BEM(points=32, steps=30).solve(Scene(Sphere(R), GLASSY, program))
    force, depth = result.fields["normal_force"], result.fields["depth"]
    np.testing.assert_allclose(force, program.prescribed(result.fields["time"]), atol=1e-12)
    assert np.array_equal(np.isnan(depth), force == 0)
    assert result.normal_force == result.friction_force == 0
    assert np.isnan(result.depth)
    assert np.isnan(result.friction_coefficient)


def test_steps_are_pixels_of_path_or_fractions_and_end_with_the_stages():
    stages = Stage(duration=1.0, depth=1.0), Stage(duration=1.03, speed=2.0), Stage(duration=0.5, speed=0.01)
    times = timeline(Program(stages=stages), pixel=0.1, steps=10)
    assert set(np.cumsum([0.0, 1.0, 1.03, 0.5])) <= set(times)
    first, last = np.searchsorted(times, [1.0, 2.03])
    np.testing.assert_allclose(np.diff(times[first : last + 1]), [*[0.05] * 19, 0.04, 0.04])
    assert np.diff(timeline(Program(stages=stages), pixel=0.1, steps=1000)).max() < 2.54e-3


def test_after_a_ramp_steps_grow_by_a_quarter_to_those_of_the_hold():
    ramp = Program(stages=(Stage(duration=0.01, depth=1.0), Stage(duration=10.0)))
    growth = np.diff(np.log(np.diff(timeline(ramp, pixel=1.0, steps=10))))
    np.testing.assert_allclose(growth[:19], 0.0, atol=1e-9)
    np.testing.assert_allclose(growth[20:-5], np.log(1.25))
    assert np.diff(timeline(ramp, pixel=1.0, steps=10)).max() < 1.001


def test_a_contact_that_reaches_the_edge_is_an_error():
    with pytest.raises(SolveError, match=r"reaches the edge of extent = 0\.5 m; take a larger extent"):
        marched(SPHERE, SOLID, RAMP, 8, 32, extent=0.5)


def test_starting_to_slide_ends_in_the_steady_answer_in_a_window_that_holds_both():
    slide = Slide(speed=0.5 * A / TAU, load=1.0)
    steady = BEM(points=48).solve(Scene(Sphere(R), CREEPING, slide))
    program = Program(stages=(Stage(duration=TAU, load=1.0), Stage(duration=40 * TAU, speed=slide.speed)))
    result = BEM(points=48, steps=20).solve(Scene(Sphere(R), CREEPING, program))
    assert result.friction_coefficient == pytest.approx(steady.friction_coefficient, rel=ACCURACY)
    assert result.depth == pytest.approx(steady.depth, rel=ACCURACY)
    assert result.measures["friction_by_work"] == pytest.approx(result.friction_force, rel=2e-2)
    speeds = result.fields["speed"]
    assert speeds[0] == 0
    assert speeds[-1] == pytest.approx(slide.speed, rel=1e-9)


@pytest.mark.parametrize(
    ("solid", "ramp", "hold", "rtol"),
    [
        (CREEPING, TAU, 3 * TAU, ACCURACY),
        (Kelvin(G, 1.0), 1e-4, 5.0, 2e-2),
        (StandardLinearSolid(G, 10 * G, 1.0), 0.1, 5.0, 2e-2),
        pytest.param(StandardLinearSolid(G, 10 * G, 1.0), 1.0, 200.0, 2e-2, marks=pytest.mark.slow),
    ],
    ids=str,
)
def test_however_short_the_ramp_the_depth_held_after_it_relaxes_as_lee_and_radok_say(solid, ramp, hold, rtol):
    # the force of a Kelvin body falls at once as the motion stops; the surface must not be thrown off by then
    program = Program(stages=(Stage(duration=ramp, depth=1e-4), Stage(duration=hold)))
    fields = BEM(points=48).solve(Scene(Sphere(R), solid, program)).fields
    times, force = fields["time"], fields["normal_force"]
    expected = indentation.loading_force(Sphere(R), solid, [0, ramp, ramp + hold], [0, 1e-4, 1e-4], times)
    held = times > ramp
    np.testing.assert_allclose(force[held], expected[held], rtol=rtol)


@pytest.mark.parametrize(
    ("solver", "roughness", "said"),
    [
        (BEM(points=64, extent=0.1), None, "take more points"),
        (BEM(points=64), CrossedWaves(amplitude=2e-6, wavelength=2e-5), "less than two pixels"),
    ],
)
def test_what_a_grid_cannot_show_of_a_program_is_an_error(solver, roughness, said):
    ramp = Program(stages=(Stage(duration=1.0, depth=1e-4),))
    with pytest.raises(SolveError, match=said):
        solver.solve(Scene(Sphere(R), Elastic(G), ramp, roughness))


@pytest.mark.parametrize("points", [16, 33])
def test_lowest_points_that_are_alike_are_no_trouble_to_start_from(points):
    line = Scene(Cylinder(R), GLASSY, Program(stages=(Stage(duration=1.0, line_load=300.0),)))
    assert BEM(points=points).solve(line).normal_force == pytest.approx(300.0, rel=0.05)


@pytest.mark.parametrize("exponent", [40.0, 44.0, 100.0])
def test_pressed_to_a_depth_a_blunt_body_has_the_force_of_one_dimension_at_every_step(exponent):
    # the corners of the window are 1e10 to 1e27 times as high as the indenter is pressed in
    program = Program(stages=(Stage(duration=2 * TAU, depth=5e-5), Stage(duration=2 * TAU, depth=1e-5)))
    scene = Scene(PowerLaw(1e-4 / A**exponent, exponent), KELVIN, program)
    found, known = (solver.solve(scene).fields for solver in (BEM(points=32, steps=50), MDR()))
    force = np.interp(found["time"], known["time"], known["normal_force"])
    assert force.max() > 0.5
    # 25 points across the contact, and a step of a fiftieth
    np.testing.assert_allclose(found["normal_force"], force, rtol=0, atol=0.01 * force.max())


@pytest.mark.parametrize("back", [False, True], ids=["forwards", "and back"])
@pytest.mark.parametrize("pressed", [{"depth": 5e-5}, {"load": 0.3}], ids=["depth", "load"])
def test_a_blunt_body_slides_alike_in_a_window_of_twice_the_size(pressed, back):
    # at its corners the indenter is 1e56 depths high in place of 1e26: nothing of the contact depends on that
    stages = [Stage(duration=2 * TAU, **pressed), Stage(duration=4 * TAU, speed=0.2)]
    program = Program(stages=(*stages, Stage(duration=2 * TAU, speed=-0.2)) if back else tuple(stages))
    scene = Scene(PowerLaw(1e-4 / A**100, 100.0), KELVIN, program)
    near, far = (BEM(points=points, extent=points * 1e-4, steps=20).solve(scene) for points in (32, 64))
    for name in ("normal_force", "depth", "friction_force"):
        assert getattr(near, name) == pytest.approx(getattr(far, name), rel=1e-3)
