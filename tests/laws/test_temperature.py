"""Temperature and frictional heating in both dimensionalities: laws that hold whatever the solver."""

from dataclasses import replace

import numpy as np
import pytest

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
    Result,
    Scene,
    SelfAffine,
    Slide,
    Sphere,
    StandardLinearSolid,
)

SOLVERS = (MDR(points=400), BEM(points=32))
names = pytest.mark.parametrize("solver", SOLVERS)
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
@pytest.mark.parametrize(("name", "law"), [*((name, LAW) for name in SOLIDS), ("rough", COLD)])
def test_a_warmer_contact_is_one_at_the_reference_that_slides_more_slowly(solver, name, law):
    plain = replace(PLAIN, roughness=ROUGH) if name == "rough" else replace(PLAIN, elastomer=SOLIDS[name])
    slow = replace(plain, motion=replace(PLAIN.motion, speed=0.1 * law.shift))
    found = solver.solve(replace(plain, temperature=law))
    same(found, solver.solve(slow), SUPERPOSED[solver.name])
    # it matters
    there = solver.solve(plain)
    assert abs(found.friction_coefficient / there.friction_coefficient - 1) > 0.05


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
