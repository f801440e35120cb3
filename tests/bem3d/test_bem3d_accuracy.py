"""Settings for a wanted accuracy: points are doubled until two halvings of the pixel confirm what is wanted."""

import warnings
from dataclasses import replace

import numpy as np
import pytest
from changing_motion import program
from maps import refused
from planned import BOWL
from sliding import KELVIN

from bem3d import BEM, for_accuracy
from bem3d.accuracy import FIRST, LOOSEST, MOST, SHARE, Choice, Unconfirmed, apart, changes, error
from bem3d.costs import BANDS, SLOW, band, measured, typical
from scene import (
    WLF,
    Coulomb,
    CrossedWaves,
    Cylinder,
    Elastic,
    Heating,
    Indent,
    Kelvin,
    KelvinChain,
    Layer,
    Measured,
    Plane,
    PowerLaw,
    Prony,
    Scene,
    SelfAffine,
    Shear,
    Slide,
    SolveError,
    Sphere,
)
from scene.scales import elastic_contact

R, TAU, LOAD = 10e-3, 1e-3, 1.0
BLUNT = PowerLaw(coefficient=1e-4 / 1e-3**30, exponent=30)
SMOOTH = Scene(Sphere(radius=R), KELVIN, Slide(speed=0.5, load=LOAD))
WAVES = SelfAffine(hurst=0.8, rms_height=2e-6, longest=1e-3, shortest=1e-4, seed=1)
PLANE = Scene(Plane(), KELVIN, Slide(speed=0.1, pressure=2e4), WAVES)
HEATED = replace(
    SMOOTH,
    temperature=WLF(temperature=301, reference=300, c1=10, c2=100),
    heating=Heating(conductivity=1.0, feedback="average"),
)
PROGRAM = program({"duration": 1.0, "load": 1.0})
CROSSED = CrossedWaves(amplitude=1e-6, wavelength=1e-3)
ROUGH = SelfAffine(hurst=0.4, rms_height=1e-5, longest=5e-3, shortest=4e-4, seed=7)


@pytest.mark.parametrize("order", [0.5, 0.7, 1.0, 1.5, 2.0])
def test_an_error_that_falls_as_a_power_of_the_points_is_not_understated(order):
    solved = BEM(points=32).solve(SMOOTH)
    answers = [replace(solved, friction_force=solved.normal_force * (1 + 0.3 * n**-order)) for n in (32, 64, 128)]
    truth = abs(1 / answers[-1].friction_coefficient - 1)
    shown = error(*changes(SMOOTH, "friction", answers))
    assert (
        truth * (1 - 1e-9) <= shown <= 3.1 * truth
    )  # three times it at order two, where no higher one is believed


def test_a_change_that_is_small_by_chance_does_not_confirm():
    assert error(1e-9, 0.04) == 0.01
    assert error(0.02, 0.01) > 0.02  # nor one that grows
    assert error(0.0, 0.0) == 0.0
    assert error(np.inf, np.inf) == np.inf


def test_a_choice_is_the_first_grid_that_confirms_and_its_answer_that_of_its_settings():
    choice = for_accuracy(SMOOTH, friction=0.01)
    points = choice.solver.points
    assert choice.solver.tolerance == pytest.approx(SHARE * 0.01)
    answers = [
        replace(choice.solver, points=n).solve(SMOOTH) for n in (points // 8, points // 4, points // 2, points)
    ]
    assert answers[-1].friction_force == choice.result.friction_force
    assert choice.confirmed
    assert choice.error["friction"] == error(*changes(SMOOTH, "friction", answers)) <= 0.01
    before = error(*changes(SMOOTH, "friction", answers[:-1])) if points > 4 * FIRST else np.inf
    assert before > 0.01


SLIDE = Slide(speed=0.5, load=LOAD)
# Contacts whose errors were once confirmed, and were 1.8 to 34 %: blunt ones, and of modes far apart.
FOOLING = {
    "blunt": (replace(SMOOTH, indenter=BLUNT, motion=Slide(speed=0.03, load=LOAD)), 0.03),
    "long and short": (replace(SMOOTH, elastomer=Prony(1e6, (5e6, 2e7), (1.0, 1e-5)), motion=SLIDE), 0.01),
    "eons apart": (replace(SMOOTH, elastomer=Prony(1e6, (1.89e7, 2.22e7), (77.8, 1.18e-5)), motion=SLIDE), 0.003),
    "chain": (replace(SMOOTH, elastomer=KelvinChain(1e-8, (4.5e-7, 5.5e-7), (20.7, 3.1e-5)), motion=SLIDE), 0.01),
}


@pytest.mark.slow
@pytest.mark.parametrize("name", FOOLING)
def test_what_is_confirmed_is_kept(name):
    scene, wanted = FOOLING[name]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", Unconfirmed)
        choice = for_accuracy(scene, friction=wanted)
    finer = replace(choice.solver, points=4 * choice.solver.points, tolerance=1e-5).solve(scene)
    assert not choice.confirmed or apart(scene, "friction", choice.result, finer) <= wanted
    assert choice.confirmed or choice.solver.points >= 4 * FIRST


def test_other_settings_are_kept_and_units_do_not_matter():
    chosen = for_accuracy(SMOOTH, friction=0.01, threads=2, extent=4e-3).solver
    assert (chosen.threads, chosen.extent) == (2, 4e-3)
    scaled = Scene(Sphere(radius=1e6 * R), Kelvin(modulus=1.0, relaxation_time=TAU), Slide(speed=5e5, load=1e6))
    assert for_accuracy(scaled, friction=0.01).solver == for_accuracy(SMOOTH, friction=0.01).solver


def test_what_is_not_confirmed_is_a_warning_and_said_in_the_answer():
    with pytest.warns(Unconfirmed, match=r"points a side do not confirm .*: friction by .*, wanted 1e-06"):
        choice = for_accuracy(SMOOTH, friction=1e-6)
    assert not choice.confirmed
    # By the order it shows, the most would not do: it is given up early.
    assert choice.solver.points < MOST


def test_an_answer_is_kept_where_finer_grids_have_none(monkeypatch):
    solve = BEM.solve

    def failing(solver, scene):
        if solver.points > 2 * FIRST:
            raise SolveError("no converged contact")
        return solve(solver, scene)

    monkeypatch.setattr(BEM, "solve", failing)
    with pytest.warns(Unconfirmed, match="friction by inf"):
        choice = for_accuracy(SMOOTH, friction=0.01)
    assert (choice.solver.points, choice.result.settings["points"]) == (2 * FIRST, 2 * FIRST)


def test_where_no_grid_has_an_answer_the_reason_is_raised():
    finest = replace(ROUGH, shortest=1e-6)
    with pytest.raises(SolveError, match="state a longer shortest"):
        for_accuracy(replace(SMOOTH, roughness=finest, motion=Indent(load=LOAD)), depth=0.1)


def test_how_fast_a_scene_slides_is_told_by_memory_over_the_shortest_length():
    radius = elastic_contact(SMOOTH).radius
    for over, expected in ((0.0, "rest"), (SLOW / 2, "slow"), (1.0, "middle"), (20.0, "fast")):
        assert band(replace(SMOOTH, motion=Slide(speed=over * radius / TAU, load=LOAD))) == expected
    assert band(replace(SMOOTH, elastomer=Elastic(1e6))) == "rest"
    shortest = replace(ROUGH, shortest=1e-2 * radius)
    assert band(replace(SMOOTH, roughness=shortest, motion=Slide(speed=0.5 * radius / TAU, load=LOAD))) == "fast"


def test_costs_are_measured_of_every_body_and_speed_and_joined_by_a_power():
    assert set(measured()) == {(body, each) for body in ("smooth", "rough") for each in BANDS}
    points, counted = measured()["smooth", "middle"]
    assert (typical(SMOOTH, points[2]), typical(SMOOTH, np.sqrt(points[1] * points[2]))) == pytest.approx(
        (counted[2], np.sqrt(counted[1] * counted[2]))
    )


@pytest.mark.parametrize(
    ("scene", "wanted"),
    [
        (replace(SMOOTH, motion=Slide(speed=0.5, depth=1e-4)), {"load": 0.01}),
        (replace(SMOOTH, motion=Indent(load=LOAD), roughness=ROUGH), {"depth": 0.1}),
        # whose first grids cannot carry the waves
        (replace(SMOOTH, motion=Indent(depth=1e-4), roughness=replace(ROUGH, shortest=1e-4)), {"load": 0.2}),
        (Scene(Cylinder(radius=R), KELVIN, Slide(speed=0.5, line_load=100.0)), {"friction": 0.03}),
        (PLANE, {"friction": 0.1}),
        (Scene(Plane(), KELVIN, Slide(speed=0.1, gap=2e-9), CROSSED), {"friction": 0.1}),
        (replace(SMOOTH, roughness=replace(ROUGH, rms_height=0.0, shortest=None)), {"friction": 0.1}),
    ],
)
def test_every_kind_of_contact_is_promised_and_confirmed(scene, wanted):
    choice = for_accuracy(scene, **wanted)
    assert choice.confirmed
    assert choice.result.normal_force > 0
    ((name, most),) = wanted.items()
    assert 0 <= choice.error[name] <= most


def test_a_wide_error_asks_for_no_looser_tolerance_than_a_solver_takes():
    assert for_accuracy(SMOOTH, friction=0.9).solver.tolerance == LOOSEST
    assert BEM(tolerance=LOOSEST)


def test_two_answers_without_friction_are_alike_and_one_is_not():
    some = BEM(points=32).solve(SMOOTH)
    assert not Choice(BEM(), some, {"friction": 0.1}, {"friction": float("nan")}).confirmed
    none = replace(some, friction_force=0.0)
    assert apart(SMOOTH, "friction", none, none) == 0
    assert apart(SMOOTH, "friction", some, none) == np.inf


@pytest.mark.parametrize(
    ("scene", "wanted", "message"),
    [
        (SMOOTH, {}, "an error has to be wanted, of depth or friction"),
        (SMOOTH, {"load": 0.01}, "load = 0.01: of this scene errors are promised of depth or friction"),
        (SMOOTH, {"friction": 0.0}, "friction = 0.0: a relative error between 0 and 1"),
        (SMOOTH, {"friction": "1 %"}, "friction = '1 %': a relative error between 0 and 1"),
        (SMOOTH, {"friction": True}, "friction = True"),
        (SMOOTH, {"friction": 0.01, "points": 64}, "points = 64: it is chosen by the wanted errors"),
        (SMOOTH, {"friction": 1e-4, "precision": "single"}, "in single precision at least 0.0003"),
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
        (replace(SMOOTH, indenter=Measured(heights=-BOWL, pixel=1e-4)), {"depth": 0.1}, "indenter = Measured"),
        (HEATED, {"friction": 0.1}, r"heating\.feedback = 'average'"),
    ],
)
def test_what_cannot_be_promised_is_said(scene, wanted, message):
    refused(message, for_accuracy, scene, error=ValueError, **wanted)
