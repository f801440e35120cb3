"""Persson's theory as a model: its limits, the formula as published, planes in three dimensions, and the judge."""

from dataclasses import replace
from math import isnan, pi

import numpy as np
import pytest
from drawn_scenes import KELVIN as SOLID
from drawn_scenes import PAPER
from invented_answers import SERIES
from scipy.integrate import cumulative_trapezoid
from scipy.special import erf
from small_cases import TINY

import compare
from bem3d import BEM
from compare import Persson
from compare.models.exact.full_contact import complex_stiffness
from compare.models.law.bands import Bands, FullContact
from compare.models.table import QUANTITIES
from compare.studies.comparison.answers import with_theory
from compare.studies.comparison.rough import ROUGH
from scene import (
    Cylinder,
    Indent,
    Layer,
    Plane,
    Program,
    Refused,
    Scene,
    SelfAffine,
    Slide,
    Stage,
    Wave,
)

pytestmark = pytest.mark.usefixtures("in_this_process")

SURFACE = SelfAffine(hurst=0.8, rms_height=2e-6, longest=8e-3, shortest=1e-3, seed=3)
BODY = replace(PAPER, roughness=SURFACE)
# Bands are nodes of a quadrature, and a band touches as its middle does: against the same integral on 4000 waves.
QUADRATURE = 1e-3


def solved(**changed):
    return Persson().solve(replace(BODY, **changed))


def full_contact(speed, surface=SURFACE):
    return FullContact.of(Bands.of(surface), SOLID, speed)


def plane(ratio, speed=0.1, surface=SURFACE):
    """Under a pressure over the rms pressure of all waves in full contact."""
    pressure = ratio * float(full_contact(speed, surface).pressure[-1])
    return Scene(Plane(), SOLID, Slide(speed=speed, pressure=pressure), surface)


# Speed times the time of the solid and the lowest wave number: 0.06, 0.6 and 19.
@pytest.mark.parametrize(("ratio", "speed"), [(0.05, 1e-2), (0.5, 0.1), (2.0, 3.0), (20.0, 0.1)])
@pytest.mark.parametrize("gamma", [None, 0.5])
def test_the_integral_is_that_of_the_papers(ratio, speed, gamma):
    """mu = 1/2 int q^3 C P [S] int cos Im E*/p, P = erf(1/(2 sqrt G)), G = 1/8 int q^3 C int |E*/p|^2."""
    scene = plane(ratio, speed)
    pressure = scene.motion.pressure
    q = np.geomspace(SURFACE.q_min, SURFACE.q_max(0.0) * (1 - 1e-12), 4001)
    angle = np.linspace(0, pi / 2, 401)
    around = complex_stiffness(SOLID, speed * q[:, None] * np.cos(angle)) / pressure
    lost = 4 * np.trapezoid(np.cos(angle) * around.imag, angle, axis=1)
    squares = 4 * np.trapezoid(np.abs(around) ** 2, angle, axis=1)
    weight = q**3 * SURFACE.density_2d(q, SURFACE.q_max(0.0))
    grown = cumulative_trapezoid(weight * squares, q, initial=0) / 8
    with np.errstate(divide="ignore"):
        touching = erf(1 / (2 * np.sqrt(grown)))
    kept = touching * (1 if gamma is None else gamma + (1 - gamma) * touching**2)
    expected = np.trapezoid(weight * kept * lost, q) / 2
    found = Persson(gamma).solve(scene)
    assert found.friction_coefficient == pytest.approx(expected, rel=QUADRATURE)
    assert found.measures["contact_fraction"] == pytest.approx(touching[-1], rel=QUADRATURE)
    assert found.measures["pressure_ratio"] == pytest.approx(ratio, rel=1e-12)


def test_a_smooth_body_has_the_answer_of_three_dimensions():
    smooth = replace(BODY, roughness=None)
    found, known = Persson().solve(smooth), BEM(points=64).solve(smooth)
    for name in ("normal_force", "depth", "friction_force"):
        assert getattr(found, name) == pytest.approx(getattr(known, name), rel=1e-14)
    at_depth = replace(smooth, motion=Slide(speed=0.1, depth=1e-4))
    assert Persson().solve(at_depth).normal_force == BEM(points=64).solve(at_depth).normal_force


def test_at_rest_nothing_rubs_and_the_depth_of_a_rough_body_is_not_told():
    found = solved(motion=Indent(load=1.0))
    assert found.friction_force == 0
    assert isnan(found.depth)
    assert 0 < found.measures["contact_fraction"] < 1


def test_under_light_pressure_a_body_rubs_like_a_plane():
    """Where contact is proportional to the pressure it does not matter how that is spread."""
    surface = replace(SURFACE, rms_height=2e-2)
    found = solved(roughness=surface)
    flat = Persson().solve(plane(1e-4, BODY.motion.speed, surface))
    assert found.measures["pressure_ratio"] < 0.01
    roughness = found.measures["friction_of_roughness"] / found.normal_force
    assert roughness == pytest.approx(flat.friction_coefficient, rel=1e-4)


def test_in_full_contact_all_of_the_smooth_contact_rubs():
    surface = replace(SURFACE, rms_height=1e-10)
    measures = solved(roughness=surface).measures
    full = full_contact(BODY.motion.speed, surface).friction.sum()
    assert measures["friction_of_roughness"] == pytest.approx(full * measures["contact_area"], rel=1e-6)


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"motion": Slide(speed=0.1, depth=1e-4)}, "motion.depth = 0.0001: the theory makes no claim"),
        ({"roughness": replace(SURFACE, shortest=None)}, "roughness.shortest is absent"),
        ({"roughness": Wave(amplitude=1e-6, wavelength=1e-3)}, "roughness = Wave.*SelfAffine"),
        ({"indenter": Cylinder(radius=1e-2), "motion": Slide(speed=0.1, line_load=1.0)}, "indenter = Cylinder"),
        ({"motion": Program(stages=(Stage(duration=1.0, load=1.0),))}, "motion = Program.*Slide or Indent"),
        ({"layer": Layer(thickness=0.01)}, "layer = Layer"),
    ],
)
def test_what_the_theory_is_not_of_is_refused_by_name(changed, message):
    with pytest.raises(Refused, match=message):
        solved(**changed)


@pytest.mark.slow
def test_where_nobody_asks_for_it_the_theory_is_drawn_and_not_judged(tmp_path):
    by_default = compare.run({"tiny": TINY}, tmp_path, report=False)
    assert not by_default.findings["model"].str.contains("Persson").any()
    for name in ("friction-speed", "friction-load"):
        lines = [line.get_label() for line in by_default.figures[f"tiny/{name}"].axes[0].get_lines()]
        assert "Persson's theory" in lines


def test_a_series_asks_it_for_friction_under_a_load_alone():
    plain = replace(SERIES, scene=BODY)
    asked = replace(plain, asked=("mdr", "bem", Persson()))
    judged = {
        quantity: [each.name for each in asked.models.judged if quantity in each.answers]
        for quantity in QUANTITIES
    }
    assert judged == {"friction": ["MDR", "Persson"], "force": ["MDR"], "depth": ["MDR"]}
    at_depth = replace(asked, scene=replace(BODY, motion=Slide(speed=0.1, depth=1e-4)), values=(1e-4, 2e-4))
    assert set(at_depth.curves[ROUGH].levels) == {"MDR", "BEM"}
    at_rest = replace(asked, speeds=())
    assert set(at_rest.curves[ROUGH].levels) == {"MDR", "BEM"}
    assert set(plain.curves[ROUGH].levels) == {"MDR", "BEM", "Persson", "FrictionLaw"}
    assert set(plain.models.labels) == {"MDR", "BEM"}
    whole = plain.curves[ROUGH]
    alone = replace(whole, levels={name: whole.levels[name] for name in ("MDR", "BEM")})
    assert set(with_theory(alone).levels) == {"MDR", "BEM", "Persson"}  # as a run asks
