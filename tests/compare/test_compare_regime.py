"""The ratios of a point from their definitions, what scales them, and the words for many."""

from dataclasses import replace
from math import nan, pi, radians, tan

import numpy as np
import pytest

from bem3d import BEM
from compare.studies.comparison.laws import ratios, words
from mdr1d import MDR
from scene import (
    Cone,
    Cylinder,
    Elastic,
    Indent,
    Kelvin,
    KelvinChain,
    Plane,
    PowerLaw,
    Program,
    Scene,
    SelfAffine,
    Slide,
    Sphere,
    Stage,
    StandardLinearSolid,
    Wave,
)

ROUGH = SelfAffine(hurst=0.6, rms_height=2e-6, longest=8e-3, shortest=4e-4, seed=1)
KELVIN = Kelvin(modulus=1e6, relaxation_time=1e-3)
SCENE = Scene(Sphere(radius=2e-2), KELVIN, Slide(speed=0.05, load=2.0), ROUGH)
MEASURED = {"rms_slope": 0.1, "pixel": 1e-5}
AREA, LENGTH = MEASURED | {"contact_area": 1e-7}, MEASURED | {"contact_length": 2e-4}
# Sums and powers of a few numbers.
ROUNDING = 1e-12
LATTICE = 0.02


def test_ratios_of_a_sphere_are_those_of_hertz():
    a = (3 * 2.0 * 2e-2 / (4 * 4e6)) ** (1 / 3)
    d, q_s = a**2 / 2e-2, 2 * pi / 4e-4
    expected = {
        "depth_over_height": d / 2e-6,
        "shortest_in_contact": a * q_s,
        "pressure_over_slope": 2.0 / (pi * a**2) / (4e6 * 0.1),
        "memory_over_contact": 0.05 * 1e-3 / a,
        "memory_over_shortest": 0.05 * 1e-3 * q_s,
        "contact_fraction": 1e-7 / (pi * a**2),
        "contact_over_period": 2 * a / 8e-3,
        "macro_over_rough": 2 * a / 2e-2 / np.sqrt(3) / 0.1,
    }
    point = ratios(SCENE, AREA)
    assert {name: point[name] for name in expected} == pytest.approx(expected, rel=ROUNDING)
    assert ratios(SCENE, LENGTH)["contact_fraction"] == pytest.approx(1e-4 / a, rel=ROUNDING)


def test_the_pressure_of_a_cone_is_the_same_share_of_its_slope_under_any_load():
    # F_N / (pi a^2) = E* tan(theta) / 2
    for load in (1e-3, 1.0, 1e3):
        scene = replace(SCENE, indenter=Cone(angle=radians(5)), motion=Indent(load=load))
        point = ratios(scene, AREA)
        assert point["pressure_over_slope"] == pytest.approx(tan(radians(5)) / 2 / 0.1, rel=ROUNDING)
        assert point["memory_over_contact"] == point["memory_over_shortest"] == 0


@pytest.mark.parametrize("indenter", [Sphere(radius=2e-2), Cone(angle=0.1), PowerLaw(coefficient=50, exponent=3)])
def test_the_same_contact_has_the_same_ratios_however_it_is_pressed(indenter):
    pressed = replace(SCENE, indenter=indenter, motion=Slide(speed=0.05, load=2.0))
    at_load = ratios(pressed, AREA)
    depth = at_load["depth_over_height"] * ROUGH.rms_height
    at_depth = ratios(replace(pressed, motion=Slide(speed=0.05, depth=depth)), AREA)
    for name in ("shortest_in_contact", "pressure_over_slope", "memory_over_contact", "contact_fraction"):
        assert at_depth[name] == pytest.approx(at_load[name], rel=ROUNDING)


def test_the_time_is_that_by_which_the_solid_lags_and_not_its_longest():
    solid = StandardLinearSolid(rubbery_modulus=1e6, glassy_modulus=1e7, relaxation_time=1e-4)
    long = KelvinChain(instantaneous_compliance=0.0, compliances=(1e-6, 1e-12), retardation_times=(1e-3, 1e-1))
    q_s = 2 * pi / 4e-4
    for elastomer, lag in ((solid, 9e-4), (long, 1e-3 * (1 + 1e-4) / (1 + 1e-6)), (Elastic(modulus=1e6), 0.0)):
        point = ratios(replace(SCENE, elastomer=elastomer), AREA)
        assert point["memory_over_shortest"] == pytest.approx(0.05 * lag * q_s, rel=ROUNDING)


def test_without_a_shortest_wave_it_is_that_of_the_grid():
    open_ended = replace(SCENE, roughness=replace(ROUGH, shortest=None))
    whole, half = (ratios(open_ended, AREA | {"pixel": pixel})["shortest_in_contact"] for pixel in (1e-5, 5e-6))
    assert half == pytest.approx(2 * whole, rel=ROUNDING)


def test_answers_of_both_dimensions_have_what_it_takes():
    scene = replace(SCENE, roughness=replace(ROUGH, rms_height=4e-5))
    one, three = (ratios(scene, solver.solve(scene).measures) for solver in (MDR(), BEM(points=64)))
    # Both have the spectrum of 20 waves, each in cells of its own lattice.
    assert one["rms_slope"] == pytest.approx(three["rms_slope"], rel=LATTICE)
    assert one["shortest_in_contact"] == three["shortest_in_contact"]
    # Pressed to a third of E* times the slope, which all but fills a line and no area.
    assert 0.1 < three["contact_fraction"] < 0.6 < 0.8 < one["contact_fraction"] < 1.2


@pytest.mark.parametrize(
    "scene",
    [
        replace(SCENE, roughness=None),
        replace(SCENE, roughness=replace(ROUGH, rms_height=0.0)),
        replace(SCENE, motion=Program(stages=(Stage(duration=1.0, load=1.0),))),
        Scene(
            Cylinder(radius=1e-2), KELVIN, Slide(speed=1.0, line_load=1.0), Wave(amplitude=1e-6, wavelength=1e-3)
        ),
        Scene(Plane(), KELVIN, Slide(speed=1.0, pressure=1e4), ROUGH),
    ],
)
def test_what_has_no_such_ratios_is_refused(scene):
    with pytest.raises(ValueError, match="rough body of revolution"):
        ratios(scene, AREA)


def test_a_measure_that_is_missing_is_an_error_and_one_that_is_unknown_stays_so():
    with pytest.raises(KeyError, match="rms_slope"):
        ratios(SCENE, {"pixel": 1e-5, "contact_area": 1e-7})
    with pytest.raises(KeyError, match="contact_length"):
        ratios(SCENE, MEASURED)
    unknown = ratios(SCENE, AREA | {"rms_slope": nan})
    assert np.isnan(unknown["pressure_over_slope"])
    assert "p/(E* h')" not in words(unknown)
