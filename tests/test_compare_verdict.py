"""Every number of a judgement against one worked out by hand, from outcomes that were made up and never solved."""

from dataclasses import replace
from math import hypot, isnan, log, sqrt

import numpy as np
import pytest

from bem3d import BEM
from compare.cases import Case, Study
from compare.metrics import select
from compare.outcome import Outcome, Row
from compare.study import points, tasks
from compare.sweep import Swept
from compare.verdict import judge, load_curves
from mdr1d import MDR
from scene import Kelvin, SelfAffine, Slide, Sphere
from scene.scales import elastic_contact

CASE = Case(
    indenter=Sphere(radius=1e-2),
    elastomer=Kelvin(modulus=1e6, relaxation_time=1e-3),
    motion=Slide(speed=0.1, load=1.0),
    roughness=SelfAffine(hurst=0.8, rms_height=5e-6, longest=1e-2, shortest=2e-3, seed=5),
    study=Study(
        speeds=(0.1, 1.0),
        pressing=(0.2, 0.5, 1.0, 2.0, 5.0),
        load_speeds=(0.1, 0.2, 0.3),
        depths=(0.5, 1.0, 2.0),
        surfaces=3,
        profiles=3,
    ),
    bem=BEM(points=32),
    mdr=MDR(points=1000),
)
# Friction of the rough and of the smooth body, up to the law that both follow.
ROUGH = {"MDR": 0.12, "BEM": 0.2}
SMOOTH = {"MDR": 0.0199, "BEM": 0.01}
# Three surfaces differ from their mean by -1, 0 and 1 of these: a standard deviation, relative.
SCATTER = {"MDR": 0.02, "BEM": 0.05}
# The pixel halved takes this off 3D friction: of the coarse value, relative.
REFINED = 0.04
# Rough force by depth, 1D over 3D less 1, and deviation of one 3D surface: largest, most significant, neither.
DEVIATION = {0.5: (-0.30, 0.60), 1.0: (-0.05, 0.01), 2.0: (-0.02, 0.03)}
# The same of the smooth bodies, and how far 3D is from the closed form.
SMOOTH_DEVIATION = {0.5: (0.001, 3e-4), 1.0: (-0.003, 1e-4), 2.0: (0.002, 2e-4)}
# Spread of the two estimates of 3D friction at each speed.
SPREAD = {0.1: 0.01, 1.0: 0.03}
RMS_SLOPE = 0.2
ROUNDING = 1e-9
SURFACES = 3


def law(load, speed):
    """Factor of friction: a function of F v^-1.5 alone, as by Eq. 23 for a sphere; 1 at the scene's own point."""
    x = log(load) - 1.5 * log(speed / 0.1)
    return np.exp(-0.3 * x - 0.05 * x**2)


def made_up(solver, scene):
    """One row of known numbers."""
    name, motion = solver.name, scene.motion
    smooth = scene.roughness is None
    nth = 0 if smooth else scene.roughness.seed - 6
    if motion.speed == 0:
        contact = elastic_contact(scene)
        factor = round(motion.depth / elastic_contact(CASE.scene).depth, 6)
        deviation, other = (SMOOTH_DEVIATION if smooth else DEVIATION)[factor]
        force = contact.load * {"exact": 1, "BEM": 1 + other * (1 if smooth else nth), "MDR": 1 + deviation}[name]
        if smooth and name == "MDR":
            force *= 1 + other
        return Row(force, motion.depth, 0.0, seconds=1.0)
    friction = SMOOTH[name] if smooth else ROUGH[name] * law(motion.load, motion.speed) * (1 + SCATTER[name] * nth)
    if getattr(solver, "points", 0) == 2 * CASE.bem.points:
        friction *= 1 - REFINED
    force = friction * motion.load
    measures = {"rms_slope": RMS_SLOPE}
    if name == "BEM":
        half = SPREAD.get(motion.speed, 0.0) / 2
        measures |= {"friction_by_traction": force * (1 + half), "friction_by_loss": force * (1 - half)}
    return Row(motion.load, 1e-4, force, 0.0, 1.0, 1.0, measures)


def judged(case=CASE):
    found = points(case)
    outcomes = {t: Outcome(tuple(made_up(t.solver, scene) for scene in t.scenes)) for t in tasks(found)}
    return judge(case, found, Swept(outcomes, len(outcomes), 0, 1.0))


@pytest.fixture(scope="module")
def judgement():
    return judged()


def number(judgement, start):
    (found,) = (n for n in (*judgement.numbers, *judgement.checks) if n.name.startswith(start))
    return found


def scatter(solver):
    return SCATTER[solver] / sqrt(SURFACES)


GRID = 1 / (1 - REFINED) - 1


def test_own_ratio_is_1d_over_3d_with_scatter_and_grid(judgement):
    found = number(judgement, "1D / 3D friction at the scene's own point")
    assert found.value == pytest.approx(0.12 / 0.2, rel=ROUNDING)
    relative = hypot(scatter("MDR"), scatter("BEM"), GRID)
    assert found.error == pytest.approx(found.value * relative, rel=ROUNDING)
    # The grid is of a size that its absence would show.
    assert hypot(scatter("MDR"), scatter("BEM")) < 0.7 * relative
    assert "3 profiles (1D), 3 surfaces (3D)" in found.text
    assert "twice the change" in found.text


def test_own_ratio_of_a_smooth_body_has_the_error_of_the_grid_alone():
    found = number(judged(replace(CASE, roughness=None)), "1D / 3D friction at the scene's own point")
    assert found.value == pytest.approx(1.99, rel=ROUNDING)
    assert found.error == pytest.approx(1.99 * GRID, rel=ROUNDING)


def test_slow_smooth_ratio_is_1d_over_3d_with_the_change_of_the_grid(judgement):
    found = number(judgement, "1D / 3D friction of the smooth body")
    assert found.value == pytest.approx(1.99, rel=ROUNDING)
    assert found.error == pytest.approx(1.99 * GRID, rel=ROUNDING)
    assert "v τ / a = 0.01;" in found.text


def test_force_number_is_the_most_significant_depth_not_the_largest(judgement):
    found = number(judgement, "force at the same depth, 1D over 3D, rough")
    # 1D has the same force on every profile: the error is that of 3D.
    error = 0.95 * 0.01 / sqrt(SURFACES)
    assert found.value == pytest.approx(-0.05, rel=ROUNDING)
    assert found.error == pytest.approx(error, rel=ROUNDING)
    assert f"of 3 depths, {0.05 / error:.1f} standard errors" in found.text
    assert f"at {elastic_contact(CASE.scene).depth * 1e6:.3g} µm" in found.text
    assert "3 comparisons" in found.text


def test_without_scatter_the_force_number_is_the_largest_and_undecided():
    found = number(
        judged(replace(CASE, study=replace(CASE.study, surfaces=1))), "force at the same depth, 1D over 3D, r"
    )
    # The one surface is the first of the three.
    assert found.value == pytest.approx(0.7 / (1 - 0.6) - 1, rel=ROUNDING)
    assert isnan(found.error)
    assert "error undecided" in found.written


def test_smooth_force_number_is_the_largest_against_the_closed_form(judgement):
    found = number(judgement, "force at the same depth, 1D over 3D, smooth")
    assert found.value == pytest.approx(-0.003, rel=1e-6)
    assert found.error == pytest.approx(1e-4, rel=1e-6)


@pytest.mark.parametrize(("solver", "dimension"), [("MDR", "1D"), ("BEM", "3D")])
def test_curves_made_to_collapse_as_eq_23_predicts_have_no_misfit(judgement, solver, dimension):
    headline = number(judgement, "misfit of the curves shifted as Eq. 23 predicts")
    assert f"{dimension} 0.0% (scatter {scatter(solver):.1%})" in headline.written
    for name in (headline.name, f"collapse by horizontal shifts, {dimension}"):
        found = number(judgement, name)
        if found is headline and solver != "BEM":
            continue
        # Means of three seeds around a polynomial of the second degree: the fit has the fourth.
        assert found.value < 1e-9
        assert found.error == pytest.approx(scatter(solver), rel=ROUNDING)
    assert judgement.collapses[solver].before.rms > 0.1


def test_errors_of_the_load_curves_are_those_of_ln_mu(judgement):
    curves = load_curves(judgement.table, "BEM")
    assert [curve.speed for curve in curves] == [0.1, 0.2, 0.3]
    for curve in curves:
        assert np.exp(curve.log_load) == pytest.approx(CASE.study.pressing)
        expected = [log(0.2 * law(load, curve.speed)) for load in CASE.study.pressing]
        assert curve.log_friction == pytest.approx(expected, rel=ROUNDING)
        assert curve.error == pytest.approx(np.full(5, scatter("BEM")), rel=ROUNDING)


def test_change_of_the_grid_is_against_the_finer_one(judgement):
    found = number(judgement, "change of the 3D friction coefficient with the pixel halved")
    assert found.value == pytest.approx(GRID, rel=ROUNDING)
    assert "32 against 64 points" in found.text
    assert "twice the change" in found.text


def test_the_largest_spread_of_both_estimates_is_named_with_its_speed(judgement):
    found = number(judgement, "spread of the two estimates of 3D friction")
    assert found.value == pytest.approx(0.03, rel=ROUNDING)
    assert found.written == "at most 3.00%"
    assert "at most 3.00% (at v = 1 m/s) over 2 speeds" in found.text
    assert all(isnan(record.friction_spread) for record in select(judgement.table, "speed", "MDR"))
