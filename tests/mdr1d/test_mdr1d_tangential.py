"""Foundations drawn along the surface: springs that friction holds, against closed forms and themselves."""

from dataclasses import replace

import numpy as np
import pytest
from pulled import LOAD, MU, ROUGH, SPHERE, G, body

from compare.models.exact import tangential as closed
from mdr1d import MDR, estimates
from scene import (
    Cone,
    Indent,
    PowerLaw,
)

SHAPES = {"sphere": SPHERE, "cone": Cone(0.1), "fourth power": PowerLaw(1e6, 4)}
SECOND_ORDER = 2e-7  # what a polygon of 5000 points is short of the shape
ROUNDING = 1e-12
SHARES = (1e-6, 0.5, 0.999)


def at_rest(of, **pressed):
    return replace(of, motion=Indent(**(pressed or {"load": LOAD})), interface=None)


@pytest.mark.parametrize("share", SHARES)
@pytest.mark.parametrize(("shape", "nu"), [("sphere", 0.5), ("cone", 0.0), ("fourth power", 0.3)])
def test_a_smooth_body_is_that_of_cattaneo_and_mindlin(shape, nu, share):
    indenter = SHAPES[shape]
    depth = MDR().solve(at_rest(body(indenter, nu, displacement=0.0))).depth
    drawn = share * closed.full_slip_displacement(MU, depth, nu)
    answer = MDR().solve(body(indenter, nu, displacement=drawn))
    force = MU * LOAD * closed.force(share, indenter.exponent)
    assert answer.friction_force == pytest.approx(force, rel=SECOND_ORDER)
    assert force == pytest.approx(
        estimates.partial_slip_force(drawn, MU, LOAD, depth, indenter.exponent, nu), rel=ROUNDING / share
    )
    stick = answer.measures["stick_length"] / answer.measures["contact_length"]
    # a length is of first order near the tip, where a polygon is blunt
    assert stick == pytest.approx((1 - share) ** (1 / indenter.exponent), abs=1e-3)


@pytest.mark.parametrize("share", SHARES)
@pytest.mark.parametrize("roughness", [None, ROUGH])
def test_a_force_is_met_to_rounding_and_its_displacement_leads_back_to_it(roughness, share):
    force = share * MU * LOAD
    answer = MDR().solve(body(roughness=roughness, force=force))
    assert answer.friction_force == pytest.approx(force, rel=ROUNDING)
    drawn = answer.measures["tangential_displacement"]
    back = MDR().solve(body(roughness=roughness, displacement=drawn))
    assert back.friction_force == pytest.approx(force, rel=ROUNDING)


@pytest.mark.parametrize(("share", "seed"), [(0.2, 1), (0.9, 2)])
def test_a_rough_line_is_the_difference_of_two_contacts_of_its_own(seed, share):
    # F_x = mu (F_a - F_c), u = mu (E*/G*) (d_a - d_c): another algorithm finds the contacts
    rough = replace(ROUGH, seed=seed)
    answer = MDR().solve(body(roughness=rough, nu=0.3, force=share * MU * LOAD))
    drawn = answer.measures["tangential_displacement"]
    grid = MDR(points=answer.settings["points"], extent=answer.settings["extent"])
    less = grid.solve(at_rest(answer.scene, load=(1 - share) * LOAD))
    assert drawn == pytest.approx(MU * closed.stiffness_ratio(0.3) * (answer.depth - less.depth), rel=1e-9)
    assert answer.measures["stick_length"] == pytest.approx(less.measures["contact_length"], rel=1e-6)


@pytest.mark.parametrize("roughness", [None, ROUGH])
def test_springs_add_up_and_none_carries_more_than_friction_holds(roughness):
    answer = MDR().solve(body(roughness=roughness, force=0.5 * MU * LOAD))
    springs, held = answer.fields["tangential_line_force"], MU * answer.fields["line_force"]
    assert springs.sum() * answer.measures["pixel"] == pytest.approx(answer.friction_force, rel=ROUNDING)
    assert (springs <= held + ROUNDING * held.max()).all()
    stiff = 4 * G / (2 - 0.5) * answer.measures["tangential_displacement"]
    assert springs.max() <= stiff * (1 + ROUNDING)
    measures = answer.measures
    assert measures["stick_length"] + measures["slip_length"] == pytest.approx(measures["contact_length"])
    sticks = MU * 4 * G * answer.fields["displacement"] > stiff
    assert np.array_equal(answer.fields["slip"] > 0, answer.fields["contact"] & ~sticks)


def test_all_slips_in_the_end_and_friction_holds_no_more():
    answer = MDR().solve(body(roughness=ROUGH, displacement=1.0))
    assert answer.measures["stick_length"] == 0
    assert answer.friction_force == pytest.approx(MU * answer.normal_force, rel=ROUNDING)
