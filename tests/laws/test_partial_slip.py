"""Contacts drawn along the surface in both dimensionalities: what is absent costs nothing, and proportion."""

from dataclasses import replace

import numpy as np
import pytest
from pulled import LOAD, MU, ROUGH, SPHERE, G, body

from bem3d import BEM
from bem3d.contact import stickslip
from bem3d.response import cerruti
from mdr1d import MDR, tangential
from scene import (
    Coulomb,
    Indent,
    Kelvin,
    Scene,
    Slide,
)

STICKS = Coulomb(MU)
# What a solver calls the size of a contact, where it touches, and what a pull adds.
SIZE = {"MDR": "length", "BEM": "area"}
TOUCHES = {"MDR": "contact", "BEM": "pressure"}
ADDED = {"MDR": ("tangential_line_force", "slip"), "BEM": ("traction_x", "slip_x")}
solvers = pytest.mark.parametrize("solver", [MDR(), BEM(points=48)])


@pytest.fixture
def untouched(monkeypatch):
    """Tangential kernels and products of three dimensions must not be built."""
    for name in ("free", "periodic", "preconditioner"):
        monkeypatch.delattr(cerruti, name)
    monkeypatch.delattr(stickslip, "solve")


def identical(one, other):
    """Answers are one to the last digit, but for what a pull adds."""
    for name, field in one.fields.items():
        np.testing.assert_array_equal(field, other.fields[name])
    for name in ("depth", "operator_applications", "residual"):
        assert getattr(one, name) == getattr(other, name)


@solvers
@pytest.mark.parametrize("motion", [Indent(load=LOAD), Slide(speed=0.1, load=LOAD)])
def test_friction_without_a_pull_builds_nothing_and_changes_no_field(solver, motion, untouched, monkeypatch):
    monkeypatch.delattr(tangential, "Springs")
    plain = Scene(SPHERE, Kelvin(G, 1e-3), motion, ROUGH)
    one, other = (solver.solve(each) for each in (plain, replace(plain, interface=STICKS)))
    identical(one, other)
    parts = (one.friction_force, MU * one.normal_force if motion.speed else 0.0)
    assert other.friction_force == sum(parts)
    if motion.speed:
        assert tuple(other.measures[f"friction_in_{where}"] for where in ("elastomer", "interface")) == parts
        assert min(parts) > 0


@solvers
@pytest.mark.parametrize("drawn", [{"force": 0.0}, {"displacement": 0.0}])
def test_a_pull_of_nothing_is_the_contact_at_rest(solver, drawn, untouched):
    asked = body(roughness=ROUGH, **drawn)
    one, other = (solver.solve(each) for each in (replace(asked, motion=Indent(load=LOAD), interface=None), asked))
    identical(one, other)
    assert other.friction_force == 0
    assert not any(other.fields[name].any() for name in ADDED[solver.name])
    size = one.measures[f"contact_{SIZE[solver.name]}"]
    assert other.measures[f"slip_{SIZE[solver.name]}"] == pytest.approx(0.0, abs=1e-12 * size)


@solvers
def test_without_friction_all_slips_at_once(solver, untouched):
    answer = solver.solve(body(coefficient=0.0, displacement=1e-6))
    assert answer.friction_force == answer.measures[f"stick_{SIZE[solver.name]}"] == 0
    _, slip = ADDED[solver.name]
    assert (answer.fields[slip][answer.fields[TOUCHES[solver.name]] > 0] == 1e-6).all()
