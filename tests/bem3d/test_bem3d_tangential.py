"""Contacts drawn along the surface: closed forms where there are any, and the conditions themselves everywhere."""

from dataclasses import replace

import numpy as np
import pytest
from pulled import LOAD, MU, ROUGH, G, body

from bem3d import BEM
from bem3d.contact import stickslip
from bem3d.grid import Grid
from bem3d.response import cerruti
from bem3d.response.engine import Engine
from scene import (
    Coulomb,
    CrossedWaves,
    Cylinder,
    Elastic,
    Indent,
    Plane,
    Scene,
    SelfAffine,
    Shear,
    SolveError,
)
from scene.scales import elastic_contact

CELL = SelfAffine(hurst=0.8, rms_height=2e-6, longest=1e-3, shortest=1.25e-4, seed=1)
WAVES = CrossedWaves(amplitude=1e-6, wavelength=1e-3)
TIGHT = 1e-9  # tolerance of solves that are compared with one another
FORCE = 0.6 * MU * LOAD
EXTENT = 3.6e-3  # of contacts of a radius of 1.4 mm


def plane(roughness=WAVES, nu=0.5, pressure=1e5, **drawn):
    return Scene(Plane(), Elastic(G, nu), Shear(pressure=pressure, **drawn), roughness, interface=Coulomb(MU))


def at_rest(scene, **pressed):
    """The same, not drawn."""
    motion = scene.motion
    return replace(scene, motion=Indent(**(pressed or {motion.pressed_by: motion.greatest})), interface=None)


# -- closed forms


@pytest.mark.parametrize("nu", [0.0, 0.5])
def test_what_sticks_everywhere_is_mindlins_disc_at_any_poisson_ratio(nu):
    scene = body(nu=nu, coefficient=1e6, displacement=1e-9)
    contact = elastic_contact(scene)
    stiffness = 8 * G * contact.radius / (2 - nu)  # Mindlin, J. Appl. Mech. 16, 259 (1949)
    errors = []
    for points in (48, 192):
        answer = BEM(points=points, extent=3 * contact.radius).solve(scene)
        errors.append(abs(answer.friction_force / (stiffness * 1e-9) - 1))
        assert answer.measures["slip_area"] == 0
    # tractions are infinite at the rim: first order in the pixel, whose size the rim is uncertain by
    assert errors[1] < 0.015
    assert errors[1] < errors[0] / 2


# -- laws of any contact


@pytest.mark.parametrize(
    ("asked", "share"),
    [
        (body(nu=0.0, roughness=ROUGH, force=FORCE), 0.6),
        (plane(CELL, nu=0.0, pressure=1e4, force=0.95 * MU * 1e-2), 0.95),
        (Scene(Cylinder(10e-3), Elastic(G), Shear(line_load=100.0, force=20 * MU), interface=Coulomb(MU)), 0.2),
    ],
    ids=["sphere", "plane", "line"],
)
def test_uncoupled_tractions_are_two_pressures_of_the_rough_body_itself(asked, share):
    # Jaeger and Ciavarella: exact on any grid where tractions displace as pressures do; another algorithm finds it
    solver = BEM(points=64, extent=None if asked.motion.pressed_by == "pressure" else EXTENT, tolerance=TIGHT)
    answer = solver.solve(asked)
    less = solver.solve(at_rest(asked, **{asked.motion.pressed_by: (1 - share) * asked.motion.greatest}))
    expected = MU * (answer.fields["pressure"] - less.fields["pressure"])
    # tolerances of both solves on pixels; the shortest waves amplify the gap by the number of points
    assert np.abs(answer.fields["traction_x"] - expected).max() < 1e-5 * expected.max()
    assert answer.measures["tangential_displacement"] == pytest.approx(MU * (answer.depth - less.depth), rel=1e-6)
    assert answer.measures["stick_area"] == pytest.approx(less.measures["contact_area"], rel=0.01)


@pytest.mark.parametrize("nu", [-0.8, 0.5])
def test_the_conditions_of_stick_and_slip_hold(nu):
    scene = body(nu=nu, roughness=ROUGH, force=FORCE)
    answer = BEM(points=40).solve(scene)
    fields, modulus, pixel = answer.fields, scene.solid.indentation_modulus, answer.measures["pixel"]
    traction, slip = (np.stack([fields[f"{name}_{axis}"] for axis in "xy"]) for name in ("traction", "slip"))
    drawn = answer.measures["tangential_displacement"]
    image = pixel * cerruti.free(Grid(40, 1.0), nu, Engine())(traction / modulus)
    touched = fields["pressure"] > 0
    expected = (np.array([drawn, 0.0])[:, None, None] - image) * touched
    assert np.abs(slip - expected).max() < 1e-9 * drawn
    size, limit = np.hypot(*traction), MU * fields["pressure"]
    assert (size <= limit * (1 + 1e-12)).all()
    sticking = touched & (size < limit * (1 - 1e-9))
    tolerance = answer.settings["tolerance"] * drawn
    assert np.hypot(*slip)[sticking].max() <= tolerance
    rest = touched & ~sticking
    # where it slips, along the traction on the indenter and forward
    assert np.abs(slip[0] * traction[1] - slip[1] * traction[0])[rest].max() <= tolerance * size.max()
    assert (slip * traction).sum(axis=0)[rest].min() >= -tolerance * size.max()
    assert 0 < answer.measures["stick_area"] < answer.measures["contact_area"]
    assert traction[0].sum() * pixel**2 == pytest.approx(answer.friction_force, rel=1e-12)
    assert answer.friction_force == pytest.approx(FORCE, rel=answer.settings["tolerance"])


def test_two_components_tend_to_one_as_the_coupling_vanishes():
    one, two = (BEM(points=48).solve(body(nu=nu, displacement=2e-5)) for nu in (0.0, 1e-9))
    assert two.friction_force == pytest.approx(one.friction_force, rel=1e-5)
    assert "traction_y" in two.fields
    assert "traction_y" not in one.fields
    assert np.abs(two.fields["traction_y"]).max() < 1e-6 * two.fields["traction_x"].max()


@pytest.mark.parametrize(("nu", "short"), [(0.5, 2e-3), (0.5, 1.2e-3), (0.5, 1e-8), (-0.9, 1e-6)])
def test_a_force_just_short_of_all_that_friction_holds_has_its_displacement_too(nu, short):
    # with nothing left to stick, tractions that point aside in part make up for what is short
    solver = BEM(points=48, tolerance=TIGHT)
    answer = solver.solve(body(nu=nu, force=(1 - short) * MU * LOAD))
    drawn = answer.measures["tangential_displacement"]
    back = solver.solve(body(nu=nu, displacement=drawn))
    # what the tolerance leaves of the force, and twice that
    assert 1 - back.friction_force / (MU * LOAD) == pytest.approx(short, rel=1e-4, abs=2 * TIGHT)
    assert (answer.measures["stick_area"] == 0) == (short < 1.5e-3)
    size = np.hypot(answer.fields["traction_x"], answer.fields["traction_y"])
    assert (size <= MU * answer.fields["pressure"] * (1 + 1e-9)).all()


@pytest.mark.parametrize(("nu", "drawn", "precision"), [(0.0, 1.0, "double"), (0.5, 1e200, "single")])
def test_all_slips_in_the_end_and_friction_holds_no_more(nu, drawn, precision):
    answer = BEM(points=48, precision=precision).solve(body(nu=nu, displacement=drawn))
    assert answer.measures["stick_area"] == 0
    assert answer.measures["tangential_displacement"] == drawn
    size = np.hypot(answer.fields["traction_x"], answer.fields.get("traction_y", 0.0))
    np.testing.assert_allclose(size, MU * answer.fields["pressure"], rtol=1e-9)
    slip = answer.fields["slip_x"][answer.fields["pressure"] > 0]
    np.testing.assert_allclose(slip, drawn, rtol=1e-4 if nu == 0 else 1e-12)
    # tractions that point aside as long as the slip is finite: not here
    assert answer.friction_force == pytest.approx(MU * LOAD, rel=1e-6 if nu == 0 else 1e-9)


@pytest.mark.parametrize("nu", [0.0, 0.5])
def test_next_to_nothing_displaces_in_proportion(nu):
    solver, stiffness = BEM(points=48), []
    for drawn in (1e-300, 1e-163, 1e-12):
        answer = solver.solve(body(nu=nu, displacement=drawn))
        stiffness.append(answer.friction_force / drawn)
        assert answer.measures["tangential_residual"] > 0
        back = solver.solve(body(nu=nu, force=answer.friction_force))
        # to tolerance
        assert back.measures["tangential_displacement"] == pytest.approx(drawn, rel=1e-4)
    # what 1e-12 m makes slip at the rim
    assert stiffness == pytest.approx(stiffness[:1] * 3, rel=1e-6)


def test_the_mean_slip_of_a_cell_is_how_far_it_was_drawn():
    # displacements have no mean there
    answer = BEM(points=64).solve(plane(displacement=2e-8))
    assert answer.measures["contact_fraction"] == 1
    assert answer.fields["slip_x"].mean() == pytest.approx(2e-8, rel=1e-4)
    assert 0 < answer.measures["slip_area"] < answer.measures["contact_area"]


def test_the_pressure_is_that_of_the_contact_at_rest():
    scene = body(roughness=ROUGH, displacement=2e-5)
    one, other = BEM(points=48).solve(at_rest(scene)), BEM(points=48).solve(scene)
    np.testing.assert_array_equal(one.fields["pressure"], other.fields["pressure"])
    assert other.operator_applications == pytest.approx(
        one.operator_applications + other.measures["tangential_applications"]
    )
    assert other.friction_force > 0.1 * MU * LOAD


# -- what cannot be


def test_tractions_that_do_not_converge_are_an_error(monkeypatch):
    monkeypatch.setattr(stickslip, "ROUNDS", 1)
    with pytest.raises(SolveError, match="no converged tractions on 48 x 48 points: after 1 sets of slip"):
        BEM(points=48).solve(body(displacement=3e-5))


# -- how it is computed


def test_tractions_that_fit_one_another_but_not_the_force_are_no_answer():
    # separate springs, all alike: any even traction meets every condition except the one on the force
    def springs(planes):
        return 2.0 * planes

    limits, start = np.ones((4, 5)), np.full((1, 4, 5), 0.1)
    found = stickslip.solve(springs, lambda planes: planes / 2, limits, start, 1e-9, force=0.5 * limits.size)
    np.testing.assert_allclose(found.traction, 0.5, rtol=1e-9)
    assert found.displacement == pytest.approx(1.0, rel=1e-9)


@pytest.mark.parametrize(("drawn", "most"), [({"force": FORCE}, 120), ({"displacement": 3e-5}, 80)])
def test_tractions_take_a_few_times_the_products_of_the_pressure(drawn, most):
    answer = BEM(points=128).solve(body(roughness=ROUGH, **drawn))
    tangential = answer.measures["tangential_applications"]
    # 108 and 70 of single planes were measured, a product of two components counting twice; the pressure takes
    # 22. Without the slipping points of the coarse grid it is 130 and 90
    assert tangential < most
