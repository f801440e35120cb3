"""Programs as a scene's motion: what the solver makes of them, from the window to the result."""

import numpy as np
import pytest

from bem3d import BEM
from compare.exact import Exact, indentation
from scene import (
    CrossedWaves,
    Cylinder,
    Elastic,
    EmptyContact,
    Indent,
    Kelvin,
    Plane,
    Program,
    Scene,
    Slide,
    SolveError,
    Sphere,
    Stage,
    StandardLinearSolid,
)

R, G, TAU = 1e-2, 1e6, 1e-3
SOLID = StandardLinearSolid(rubbery_modulus=G, glassy_modulus=5 * G, relaxation_time=TAU)
DEPTH = 1e-4
ACCURACY = 2e-3  # of 64 points and some 50 steps


def ramped(*stages):
    return Program(stages=stages)


def test_a_held_depth_relaxes_as_lee_and_radok_say():
    program = ramped(Stage(duration=TAU, depth=DEPTH), Stage(duration=3 * TAU))
    result = BEM(points=64, steps=80).solve(Scene(Sphere(R), SOLID, program))
    times, force = result.fields["time"], result.fields["normal_force"]
    expected = indentation.loading_force(Sphere(R), SOLID, [0, TAU, 4 * TAU], [0, DEPTH, DEPTH], times)
    late = times > 0.3 * TAU  # some pixels in contact
    np.testing.assert_allclose(force[late], expected[late], rtol=5 * ACCURACY)
    assert result.normal_force == pytest.approx(expected[-1], rel=ACCURACY)
    assert result.normal_force == force[-1]
    assert result.measures["time_steps"] == len(times) >= 80
    assert result.fields["pressure"].shape == (64, 64)


def test_starting_to_slide_ends_in_the_steady_answer_in_a_window_that_holds_both():
    slide = Slide(speed=0.5 * np.sqrt(R * DEPTH) / TAU, load=1.0)
    steady = BEM(points=48).solve(Scene(Sphere(R), SOLID, slide))
    program = ramped(Stage(duration=TAU, load=1.0), Stage(duration=40 * TAU, speed=slide.speed))
    result = BEM(points=48, steps=20).solve(Scene(Sphere(R), SOLID, program))
    assert result.friction_coefficient == pytest.approx(steady.friction_coefficient, rel=ACCURACY)
    assert result.depth == pytest.approx(steady.depth, rel=ACCURACY)
    assert result.measures["friction_by_work"] == pytest.approx(result.friction_force, rel=2e-2)
    speeds = result.fields["speed"]
    assert speeds[0] == 0
    assert speeds[-1] == pytest.approx(slide.speed, rel=1e-9)


def test_after_separation_nothing_is_pressed_and_that_is_no_error():
    program = ramped(Stage(duration=TAU, load=1.0), Stage(duration=TAU, load=0.0), Stage(duration=TAU))
    result = BEM(points=32, steps=30).solve(Scene(Sphere(R), SOLID, program))
    assert result.normal_force == result.friction_force == 0
    assert np.isnan(result.depth)
    assert np.isnan(result.friction_coefficient)
    assert result.fields["normal_force"].max() == pytest.approx(1.0, rel=0.1)


def test_an_elastic_solid_has_no_history():
    program = ramped(Stage(duration=1.0, depth=2 * DEPTH), Stage(duration=1.0, depth=DEPTH))
    result = BEM(points=64, steps=20).solve(Scene(Sphere(R), Elastic(G), program))
    half = len(result.fields["time"]) // 2
    going, coming = result.fields["normal_force"][:half], result.fields["normal_force"][half:]
    depths = result.fields["depth"]
    np.testing.assert_allclose(np.interp(depths[half + 1 :], depths[:half], going), coming[1:], rtol=2e-2)
    at_rest = BEM(points=64).solve(Scene(Sphere(R), Elastic(G), Indent(depth=depths[-1])))
    assert result.normal_force == pytest.approx(at_rest.normal_force, rel=5 * ACCURACY)


@pytest.mark.parametrize(
    ("indenter", "roughness", "value"),
    [
        (Cylinder(R), None, {"line_load": 100.0}),
        (Plane(), CrossedWaves(amplitude=1e-6, wavelength=1e-4), {"pressure": 1e5}),
    ],
)
def test_lines_and_planes_march_to_their_steady_answers(indenter, roughness, value):
    length = 1e-4 if roughness else 1e-3
    speed = length / TAU
    steady = BEM(points=64).solve(Scene(indenter, SOLID, Slide(speed=speed, **value), roughness))
    program = ramped(Stage(duration=TAU, **value), Stage(duration=15 * TAU, speed=speed))
    result = BEM(points=64, steps=20).solve(Scene(indenter, SOLID, program, roughness))
    assert result.normal_force == pytest.approx(steady.normal_force, rel=1e-9)
    assert result.friction_coefficient == pytest.approx(steady.friction_coefficient, rel=2e-2)


def test_solvers_without_a_clock_refuse_a_program_by_name():
    scene = Scene(Sphere(R), Kelvin(G, TAU), ramped(Stage(duration=1.0, load=1.0)))
    assert "Program" in "; ".join(Exact().refusals(scene))


RESTING = Kelvin(G, 1.0), StandardLinearSolid(G, 10 * G, 1.0)


@pytest.mark.parametrize(("ramp", "hold"), [(1e-4, 5.0), (1e-2, 5.0), (0.1, 5.0), (1.0, 200.0)])
@pytest.mark.parametrize("solid", RESTING, ids=["Kelvin", "10"])
def test_however_short_the_ramp_the_hold_after_it_is_right(solid, ramp, hold):
    # the force of a Kelvin body falls at once as the motion stops; the surface must not be thrown off by then
    program = ramped(Stage(duration=ramp, depth=DEPTH), Stage(duration=hold))
    fields = BEM(points=48).solve(Scene(Sphere(R), solid, program)).fields
    times, force = fields["time"], fields["normal_force"]
    expected = indentation.loading_force(Sphere(R), solid, [0, ramp, ramp + hold], [0, DEPTH, DEPTH], times)
    held = times > ramp
    np.testing.assert_allclose(force[held], expected[held], rtol=2e-2)


def test_a_program_that_ends_on_next_to_no_pixels_or_never_touches_is_an_error():
    ramp = ramped(Stage(duration=1.0, depth=DEPTH))
    with pytest.raises(SolveError, match="take more points"):
        BEM(points=64, extent=0.1).solve(Scene(Sphere(R), Elastic(G), ramp))
    with pytest.raises(EmptyContact, match="nothing touches in the whole program"):
        BEM(points=64, extent=1e3).solve(Scene(Sphere(R), Elastic(G), ramp))


def test_waves_shorter_than_two_pixels_are_an_error_in_a_program_too():
    scene = Scene(
        Sphere(R),
        Elastic(G),
        ramped(Stage(duration=1.0, load=0.5)),
        CrossedWaves(amplitude=2e-6, wavelength=2e-5),
    )
    with pytest.raises(SolveError, match="less than two pixels"):
        BEM(points=64, steps=10).solve(scene)


@pytest.mark.parametrize("points", [16, 33, 48])
def test_lowest_points_that_are_alike_are_no_trouble_to_start_from(points):
    line = Scene(Cylinder(R), SOLID, ramped(Stage(duration=1.0, line_load=300.0)))
    assert BEM(points=points).solve(line).normal_force == pytest.approx(300.0, rel=0.05)
    waves = CrossedWaves(amplitude=1e-6, wavelength=1e-3)
    with pytest.raises(SolveError, match="take more points"):
        BEM(points=points).solve(Scene(Plane(), Elastic(G), Indent(pressure=1.0), waves))
