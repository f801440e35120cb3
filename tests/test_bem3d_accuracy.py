"""Settings for a wanted accuracy: the least that the measured ladder allows, and an answer that is confirmed."""

import warnings
from dataclasses import replace

import numpy as np
import pytest

from bem3d import BEM
from bem3d.accuracy import BANDS, SLOW, Assured, Choice, Unconfirmed, apart, band, ladder, resolution, typical
from scene import (
    WLF,
    Coulomb,
    CrossedWaves,
    Cylinder,
    Elastic,
    Heating,
    Indent,
    Kelvin,
    Layer,
    Measured,
    Plane,
    Program,
    Scene,
    SelfAffine,
    Shear,
    Slide,
    Sphere,
    Stage,
)
from scene.scales import elastic_contact

R, TAU, LOAD = 10e-3, 1e-3, 1.0
KELVIN = Kelvin(modulus=1e6, relaxation_time=TAU)
SMOOTH = Scene(Sphere(radius=R), KELVIN, Slide(speed=0.5, load=LOAD))
WAVES = SelfAffine(hurst=0.8, rms_height=2e-6, longest=1e-3, shortest=1e-4, seed=1)
PLANE = Scene(Plane(), KELVIN, Slide(speed=0.1, pressure=2e4), WAVES)
HEATED = replace(
    SMOOTH,
    temperature=WLF(temperature=301, reference=300, c1=10, c2=100),
    heating=Heating(conductivity=1.0, feedback="average"),
)
BALL = -np.add.outer(*[((np.arange(32) - 15.5) * 1e-4) ** 2 / 20e-3] * 2)
PROGRAM = Program(stages=(Stage(duration=1.0, load=1.0),))
CROSSED = CrossedWaves(amplitude=1e-6, wavelength=1e-3)
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


@pytest.mark.parametrize(
    ("roughness", "wanted"),
    [(None, 0.01), (ROUGH, 0.1), *(pytest.param(each, 3e-3, marks=pytest.mark.slow) for each in (None, ROUGH))],
)
def test_the_ladder_promises_what_is_wanted_and_the_answer_keeps_it(roughness, wanted):
    scene = replace(SMOOTH, roughness=roughness)
    choice = BEM.for_accuracy(scene, friction=wanted)
    assert 0 < choice.expected["friction"] <= wanted
    assert choice.seconds > 0
    answer = choice.solve()
    assert answer.confirmed
    truth = BEM(points=3 * choice.solver.points, tolerance=1e-6).solve(scene)
    # A third of the pixel has two thirds of the error at least, where it falls with the first power.
    assert 1.5 * apart(scene, "friction", answer.result, truth) <= wanted


def test_smaller_errors_ask_for_more_points_and_a_tighter_tolerance_and_the_smallest_decides():
    loose, tight = (BEM.for_accuracy(SMOOTH, friction=wanted).solver for wanted in (0.1, 0.003))
    assert loose.points < tight.points
    assert loose.tolerance > tight.tolerance
    assert BEM.for_accuracy(SMOOTH, friction=0.003, depth=0.1).solver == tight


def test_a_choice_is_read_off_the_ladder():
    choice, (resolved, errors) = BEM.for_accuracy(SMOOTH, friction=0.01), ladder()["smooth", "middle", "friction"]
    passed = errors[resolved <= choice.resolution]
    # a tenth of the error is left to the tolerance, which leaves three times itself
    assert choice.solver.tolerance == pytest.approx(0.01 / 30)
    assert choice.expected["friction"] == pytest.approx(passed[-1] + 3 * choice.solver.tolerance)
    assert passed[-1] <= 0.9 * 0.01
    least = resolved[errors <= 0.9 * 0.01].min()
    assert least <= choice.resolution < 1.2 * least  # by sizes of quick transforms
    points, seconds = ladder()["smooth", "middle", "seconds"]
    assert typical(SMOOTH, points[2])["seconds"] == pytest.approx(seconds[2])
    between = np.sqrt(points[1] * points[2])
    assert typical(SMOOTH, between)["seconds"] == pytest.approx(np.sqrt(seconds[1] * seconds[2]))


def test_loose_errors_still_get_a_grid_that_carries_the_waves():
    fine = Scene(Sphere(radius=R), KELVIN, Indent(depth=1e-4), replace(ROUGH, rms_height=1e-6, shortest=1e-4))
    # Two points a wave are the fewest that the grid takes, and leave no room for a wider window.
    assert ladder()["rough", "rest", "pressing"][1].max() < 0.2
    assert BEM.for_accuracy(fine, load=0.2).resolution >= 2.5


def test_other_settings_are_kept_and_units_do_not_matter():
    chosen = BEM.for_accuracy(SMOOTH, friction=0.01, threads=2, extent=4e-3).solver
    assert (chosen.threads, chosen.extent) == (2, 4e-3)
    scaled = Scene(Sphere(radius=1e6 * R), Kelvin(modulus=1.0, relaxation_time=TAU), Slide(speed=5e5, load=1e6))
    assert BEM.for_accuracy(scaled, friction=0.01).solver == BEM.for_accuracy(SMOOTH, friction=0.01).solver


def test_a_promise_not_kept_is_a_warning_and_said_in_the_answer():
    bold = Choice(SMOOTH, BEM(points=32, tolerance=1e-3), {"friction": 1e-6}, {"friction": 1e-6}, 12.0, 0.1)
    with pytest.warns(Unconfirmed, match=r"friction by .*, wanted 1e-06; take more points"):
        assert not bold.solve().confirmed


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
    ("scene", "wanted"),
    [
        (replace(SMOOTH, motion=Slide(speed=0.5, depth=1e-4)), {"load": 0.01}),
        (replace(SMOOTH, motion=Indent(load=LOAD), roughness=ROUGH), {"depth": 0.1}),
        (Scene(Cylinder(radius=R), KELVIN, Slide(speed=0.5, line_load=100.0)), {"friction": 0.03}),
        (replace(PLANE, roughness=replace(WAVES, shortest=1e-3 / 40)), {"friction": 0.1}),
        (Scene(Plane(), KELVIN, Slide(speed=0.1, gap=2e-9), CROSSED), {"friction": 0.1}),
        (replace(SMOOTH, roughness=replace(ROUGH, rms_height=0.0, shortest=None)), {"friction": 0.1}),
    ],
)
def test_every_kind_of_contact_is_promised_and_solved(scene, wanted):
    choice = BEM.for_accuracy(scene, **wanted)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", Unconfirmed)
        answer = choice.solve()
    assert answer.result.normal_force > 0
    assert choice.solver.points % 2 == 0
    ((name, error),) = wanted.items()
    assert 0 < choice.expected[name] <= error


def test_a_grid_whose_half_cannot_carry_the_waves_has_an_answer_that_is_not_confirmed():
    scene = replace(SMOOTH, motion=Indent(load=LOAD), roughness=replace(ROUGH, shortest=1e-4))
    # Three pixels a wave.
    bare = Choice(scene, BEM(points=108, extent=3.6e-3), {"depth": 0.1}, {"depth": 0.1}, 3.0, 0.1)
    with pytest.warns(Unconfirmed, match="depth by inf, wanted 0.1"):
        answer = bare.solve()
    assert answer.result.normal_force == pytest.approx(LOAD)
    assert not answer.confirmed


def test_two_answers_without_friction_are_alike_and_one_is_not():
    some = BEM(points=32).solve(SMOOTH)
    assert not Assured(some, {"friction": 0.1}, {"friction": float("nan")}).confirmed
    none = replace(some, friction_force=0.0)
    assert apart(SMOOTH, "friction", none, none) == 0
    assert apart(SMOOTH, "friction", some, none) == np.inf


@pytest.mark.parametrize(
    ("scene", "wanted", "said"),
    [
        (SMOOTH, {}, "an error has to be wanted, of depth or friction"),
        (SMOOTH, {"load": 0.01}, "load = 0.01: of this scene errors are promised of depth or friction"),
        (SMOOTH, {"friction": 0.0}, "friction = 0.0: a relative error between 0 and 1"),
        (SMOOTH, {"friction": float("nan")}, "friction = nan"),
        (SMOOTH, {"friction": "1 %"}, "friction = '1 %': a relative error between 0 and 1"),
        (SMOOTH, {"friction": True}, "friction = True"),
        (SMOOTH, {"friction": 0.01, "points": 64}, "points = 64: it is chosen by the wanted errors"),
        (SMOOTH, {"friction": 0.01, "tolerance": 1e-9}, "tolerance = 1e-09: it is chosen by the wanted errors"),
        (SMOOTH, {"friction": 1e-4, "precision": "single"}, "in single precision at least 0.0003"),
        (SMOOTH, {"friction": 1e-9}, "friction = 1e-09 is less than was measured"),
        (
            replace(SMOOTH, motion=Shear(load=1.0, force=0.1), interface=Coulomb(0.3)),
            {"friction": 0.01},
            "promised of depth; motion = Shear: errors of tangential forces were not measured",
        ),
        (replace(SMOOTH, motion=Indent(load=1.0)), {"friction": 0.01}, "errors are promised of depth"),
        (replace(SMOOTH, elastomer=Elastic(1e6)), {"friction": 0.01}, "errors are promised of depth"),
        (
            replace(SMOOTH, roughness=replace(ROUGH, shortest=None)),
            {"friction": 0.01},
            "shortest = None",
        ),
        (replace(SMOOTH, motion=PROGRAM), {"depth": 0.01}, "motion = Program"),
        (replace(SMOOTH, layer=Layer(thickness=1e-3)), {"friction": 0.1}, "layer = Layer"),
        (replace(SMOOTH, indenter=Measured(heights=BALL, pixel=1e-4)), {"depth": 0.1}, "indenter = Measured"),
        (HEATED, {"friction": 0.1}, r"heating\.feedback = 'average'"),
    ],
)
def test_what_cannot_be_promised_is_said(scene, wanted, said):
    with pytest.raises(ValueError, match=said):
        BEM.for_accuracy(scene, **wanted)
