"""Temperature and frictional heating in both dimensionalities: laws that hold whatever the solver."""

from dataclasses import replace
from math import exp, sqrt

import numpy as np
import pytest
from scipy.optimize import bisect

from bem3d import BEM
from mdr1d import MDR
from scene import (
    WLF,
    Arrhenius,
    Coulomb,
    Heating,
    Indent,
    Kelvin,
    KelvinChain,
    Program,
    Result,
    Scene,
    SelfAffine,
    Slide,
    Sphere,
    Stage,
    StandardLinearSolid,
)
from scene.effects.temperature import GAS_CONSTANT

SOLVERS = (MDR(points=400), BEM(points=32))
names = pytest.mark.parametrize("solver", SOLVERS, ids=lambda solver: solver.name)
# Modes found anew from shifted times, and what iterations make of such a difference.
SUPERPOSED = {"MDR": 1e-10, "BEM": 1e-8}

RADIUS, RUBBERY, TIME, REFERENCE = 50e-3, 3e6, 1e-4, 296.0
STANDARD = StandardLinearSolid(RUBBERY, 100 * RUBBERY, TIME)
ROUGH = SelfAffine(hurst=0.8, rms_height=2e-6, longest=8e-3, shortest=2e-3, seed=2)
LAW = WLF(temperature=310.0, reference=REFERENCE, c1=7.2, c2=124.6)
COLD = Arrhenius(temperature=280.0, reference=REFERENCE, activation_energy=60e3)
PLAIN = Scene(Sphere(radius=RADIUS), STANDARD, Slide(speed=0.1, load=10.0))
WARM = replace(PLAIN, temperature=LAW)
SOLIDS = {
    "standard": STANDARD,
    "kelvin": Kelvin(RUBBERY, TIME),
    "chain": KelvinChain(0.1 / RUBBERY, (0.5 / RUBBERY, 0.4 / RUBBERY), (TIME, 30 * TIME)),
}


def numbers(result: Result):
    """All that a result says of the contact, in one array."""
    forces = [result.normal_force, result.friction_force, result.depth]
    return np.concatenate([forces, *(np.ravel(field) for field in result.fields.values())])


def same(found, wanted, rtol):
    """Numbers equal to so much of the largest of their kind."""
    for name in ("normal_force", "friction_force", "depth"):
        assert getattr(found, name) == pytest.approx(getattr(wanted, name), rel=rtol)
    for name, field in wanted.fields.items():
        np.testing.assert_allclose(found.fields[name], field, rtol=0, atol=rtol * np.abs(field).max())


@names
@pytest.mark.parametrize(("name", "law"), [*((name, LAW) for name in SOLIDS), ("rough", COLD)], ids=str)
def test_a_warmer_contact_is_one_at_the_reference_that_slides_more_slowly(solver, name, law):
    plain = replace(PLAIN, roughness=ROUGH) if name == "rough" else replace(PLAIN, elastomer=SOLIDS[name])
    slow = replace(plain, motion=replace(PLAIN.motion, speed=0.1 * law.shift))
    found = solver.solve(replace(plain, temperature=law))
    same(found, solver.solve(slow), SUPERPOSED[solver.name])
    # it matters
    there = solver.solve(plain)
    assert abs(found.friction_coefficient / there.friction_coefficient - 1) > 0.05


@names
def test_a_history_of_a_warmer_contact_is_a_longer_one_at_the_reference(solver):
    def program(factor):
        return Program(
            stages=(
                Stage(duration=3e-3 / factor, load=10.0),
                Stage(duration=2.3e-3 / factor, speed=0.5 * factor),
                Stage(duration=1e-3 / factor, load=4.0, speed=0.1 * factor),
            )
        )

    solver = replace(solver, steps=24)
    found = solver.solve(replace(WARM, motion=program(1.0)))
    wanted = solver.solve(replace(PLAIN, motion=program(LAW.shift)))
    factors = {"time": 1 / LAW.shift, "speed": LAW.shift}
    for name in found.fields:
        one, other = found.fields[name] * factors.get(name, 1.0), wanted.fields[name]
        kept = np.isfinite(other)
        np.testing.assert_array_equal(np.isfinite(one), kept)
        scale = np.abs(other[kept]).max()
        np.testing.assert_allclose(one[kept], other[kept], rtol=0, atol=1e-7 * scale, err_msg=name)


@names
def test_estimates_are_read_off_one_solve_that_is_the_same(solver):
    rough = replace(WARM, roughness=ROUGH)
    plain, found = (solver.solve(each) for each in (rough, replace(rough, heating=Heating(conductivity=50.0))))
    np.testing.assert_array_equal(numbers(found), numbers(plain))
    assert (found.operator_applications, found.settings) == (plain.operator_applications, plain.settings)
    # Methods of the paper: 2 mu G0 d v/lambda, and G_inf and h0 in the place of G0 and d
    heat = 2 * plain.friction_coefficient * 0.1 / 50.0
    extra = {
        "average_heating": heat * RUBBERY * plain.depth,
        "flash_heating": heat * 100 * RUBBERY * plain.measures["rms_height"],
    }
    assert {name: found.measures[name] for name in extra} == pytest.approx(extra, rel=1e-13)
    assert found.measures.keys() == plain.measures.keys() | extra.keys()


@names
def test_feedback_without_speed_or_heat_is_the_answer_without_it(solver):
    for scene, conductivity in (
        (WARM, 1e15),
        (replace(WARM, motion=Slide(speed=0.0, load=10.0)), 1e-3),
        (replace(WARM, motion=Indent(depth=1e-4)), 1e-3),
    ):
        found = solver.solve(replace(scene, heating=Heating(conductivity=conductivity, feedback="average")))
        plain = solver.solve(scene)
        np.testing.assert_array_equal(numbers(found), numbers(plain))
        assert found.measures["heating_solves"] == 1
        assert found.operator_applications == plain.operator_applications


@names
def test_slow_friction_settles_where_a_closed_form_does(solver):
    speed, energy = 5e-3, 60e3
    slow = replace(
        PLAIN,
        elastomer=Kelvin(RUBBERY, TIME),
        motion=Slide(speed=speed, load=10.0),
        temperature=Arrhenius(temperature=290.0, reference=REFERENCE, activation_energy=energy),
    )
    depth = (3 * 10.0 / (16 * RUBBERY * sqrt(RADIUS))) ** (2 / 3)

    def friction(temperature):
        return (
            SLOW[solver.name]
            * speed
            * TIME
            / RADIUS
            * exp(energy / GAS_CONSTANT * (1 / temperature - 1 / REFERENCE))
        )

    # so little heat is conducted that 60 K are to be expected, and a third of that settles
    conductivity = 2 * friction(290.0) * RUBBERY * depth * speed / 60.0
    expected = bisect(
        lambda t: t - 290.0 - 2 * friction(t) * RUBBERY * depth * speed / conductivity, 290.0, 360.0, xtol=1e-9
    )
    answer = solver.solve(replace(slow, heating=Heating(conductivity=conductivity, feedback="average")))
    assert 10 < expected - 290 < 25
    # v tau/a is 3e-4; three dimensions have a pixel of a tenth of the radius
    assert answer.measures["temperature"] - 290 == pytest.approx(expected - 290, rel=0.01)
    assert answer.friction_coefficient == pytest.approx(friction(expected), rel=0.02)


# Slow sliding of a Kelvin sphere: mu = v tau a_T/R in three dimensions, twice that in one.
SLOW = {"MDR": 2.0, "BEM": 1.0}


@names
def test_friction_of_the_interface_heats_too(solver):
    rubbing = replace(WARM, interface=Coulomb(0.3))
    plain = solver.solve(rubbing)
    found = solver.solve(replace(rubbing, heating=Heating(conductivity=5.0, feedback="average")))
    there = solver.solve(replace(WARM, temperature=replace(LAW, temperature=found.measures["temperature"])))
    total = there.friction_coefficient + 0.3
    assert found.friction_coefficient == pytest.approx(total, rel=1e-12)
    rise = 2 * total * RUBBERY * there.depth * 0.1 / 5.0
    assert found.measures["average_heating"] == pytest.approx(rise, rel=1e-12)
    assert plain.friction_coefficient > 0.3
