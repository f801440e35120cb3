"""Settings for a wanted accuracy: the least that the measured ladder allows, and an answer that is confirmed."""

from dataclasses import replace

import numpy as np
import pytest

from bem3d import BEM
from bem3d.accuracy import BANDS, SLOW, Assured, Choice, Unconfirmed, apart, band, ladder, resolution
from scene import (
    Cylinder,
    Elastic,
    Indent,
    Kelvin,
    Program,
    Scene,
    SelfAffine,
    Slide,
    Sphere,
    Stage,
)
from scene.scales import elastic_contact

R, TAU, LOAD = 10e-3, 1e-3, 1.0
KELVIN = Kelvin(modulus=1e6, relaxation_time=TAU)
SMOOTH = Scene(Sphere(radius=R), KELVIN, Slide(speed=0.5, load=LOAD))
ROUGH = SelfAffine(hurst=0.4, rms_height=1e-5, longest=5e-3, shortest=4e-4, seed=7)


def test_the_ladder_has_errors_that_never_rise_with_the_resolution():
    known = ladder()
    for body in ("smooth", "rough"):
        for each in BANDS:
            assert (body, each, "seconds") in known
            for quantity in ("pressing", *(("friction",) if each != "rest" else ())):
                resolved, errors = known[body, each, quantity]
                assert resolved.size > 3
                assert np.all(np.diff(resolved) > 0)
                assert np.all(np.diff(errors) <= 0)
                assert np.all(errors > 0)
                assert errors[-1] < 0.01


@pytest.mark.parametrize("wanted", [0.1, 0.01, 0.003])
@pytest.mark.parametrize("roughness", [None, ROUGH])
def test_the_ladder_promises_what_is_wanted_and_the_answer_keeps_it(roughness, wanted):
    scene = replace(SMOOTH, roughness=roughness)
    choice = BEM.for_accuracy(scene, friction=wanted)
    assert 0 < choice.expected["friction"] <= wanted
    assert choice.seconds > 0
    answer = choice.solve()
    assert answer.confirmed
    # Another solve, with twice the points and a tolerance of its own.
    truth = BEM(points=2 * choice.solver.points, tolerance=1e-6).solve(scene)
    assert apart("friction", answer.result, truth) <= wanted


def test_smaller_errors_ask_for_more_points_and_a_tighter_tolerance():
    choices = [BEM.for_accuracy(SMOOTH, friction=wanted) for wanted in (0.1, 0.01, 0.001)]
    points, tolerances = zip(*((each.solver.points, each.solver.tolerance) for each in choices), strict=True)
    assert list(points) == sorted(points)
    assert points[0] < points[-1]
    assert list(tolerances) == sorted(tolerances, reverse=True)


def test_the_most_demanding_of_several_errors_decides():
    both = BEM.for_accuracy(SMOOTH, friction=0.003, depth=0.1).solver
    assert both == BEM.for_accuracy(SMOOTH, friction=0.003).solver
    assert both.points > BEM.for_accuracy(SMOOTH, depth=0.1).solver.points


def test_other_settings_are_kept():
    chosen = BEM.for_accuracy(SMOOTH, friction=0.01, threads=2, extent=4e-3).solver
    assert chosen.threads == 2
    assert chosen.extent == 4e-3


def test_units_do_not_matter():
    choice = BEM.for_accuracy(SMOOTH, friction=0.01)
    scaled = Scene(Sphere(radius=1e6 * R), Kelvin(modulus=1.0, relaxation_time=TAU), Slide(speed=5e5, load=1e6))
    assert BEM.for_accuracy(scaled, friction=0.01).solver == choice.solver


def test_a_promise_not_kept_is_a_warning_and_said_in_the_answer():
    bold = Choice(SMOOTH, BEM(points=32, tolerance=1e-3), {"friction": 1e-6}, {"friction": 1e-6}, 12.0, 0.1)
    with pytest.warns(Unconfirmed, match=r"friction by .*, wanted 1e-06; take more points"):
        assert not bold.solve().confirmed


def test_an_answer_without_a_number_is_not_confirmed():
    result = BEM(points=32).solve(SMOOTH)
    assert not Assured(result, {"friction": 0.1}, {"friction": float("nan")}).confirmed


def test_how_fast_a_scene_slides_is_told_by_memory_over_the_shortest_length():
    radius = elastic_contact(SMOOTH).radius
    for over, expected in ((0.0, "rest"), (SLOW / 2, "slow"), (1.0, "middle"), (20.0, "fast")):
        assert band(replace(SMOOTH, motion=Slide(speed=over * radius / TAU, load=LOAD))) == expected
    assert band(replace(SMOOTH, elastomer=Elastic(1e6))) == "rest"
    shortest = replace(ROUGH, shortest=1e-2 * radius)
    assert band(replace(SMOOTH, roughness=shortest, motion=Slide(speed=0.5 * radius / TAU, load=LOAD))) == "fast"


def test_many_fine_spots_are_resolved_by_the_wave_and_a_few_pixels_by_their_number():
    few = {"contact_points": 12.0, "points_per_shortest_wave": 7.0}
    many = few | {"contact_points": 5000.0}
    assert resolution(SMOOTH, {"contact_points": 5000.0}) == pytest.approx(79.8, abs=0.1)
    assert resolution(SMOOTH, many) == 7.0
    assert resolution(SMOOTH, few) == pytest.approx(3.9, abs=0.01)
    line = Scene(Cylinder(radius=R), KELVIN, Slide(speed=1.0, line_load=100.0))
    assert resolution(line, {"contact_points": 60.0}) == 60.0


@pytest.mark.parametrize(
    ("scene", "wanted", "said"),
    [
        (SMOOTH, {}, "an error has to be wanted, of depth or friction"),
        (SMOOTH, {"load": 0.01}, "load = 0.01: of this scene errors are promised of depth, friction"),
        (SMOOTH, {"friction": 0.0}, "friction = 0: a relative error between 0 and 1"),
        (SMOOTH, {"friction": -0.01}, "friction = -0.01"),
        (SMOOTH, {"friction": float("nan")}, "friction = nan"),
        (SMOOTH, {"friction": 1e-9}, "friction = 1e-09 is less than was measured"),
        (replace(SMOOTH, motion=Indent(load=1.0)), {"friction": 0.01}, "errors are promised of depth"),
        (replace(SMOOTH, elastomer=Elastic(1e6)), {"friction": 0.01}, "errors are promised of depth"),
        (
            replace(SMOOTH, roughness=replace(ROUGH, shortest=None)),
            {"friction": 0.01},
            "roughness.shortest = None",
        ),
        (
            replace(SMOOTH, motion=Program(stages=(Stage(duration=1.0, load=1.0),))),
            {"depth": 0.01},
            "motion = Program",
        ),
    ],
)
def test_what_cannot_be_promised_is_said(scene, wanted, said):
    with pytest.raises(ValueError, match=said):
        BEM.for_accuracy(scene, **wanted)
