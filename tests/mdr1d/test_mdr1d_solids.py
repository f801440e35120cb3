"""Limits of solids: relaxed at rest, fluid at speeds without end, and elements that amount to a Kelvin body."""

from dataclasses import replace
from math import sqrt

import numpy as np
import pytest
from sliding import CHAIN, KELVIN, ROUGH

from mdr1d import MDR
from scene import Elastic, Indent, Kelvin, KelvinChain, Prony, Scene, Slide, Sphere, StandardLinearSolid

TIME = KELVIN.relaxation_time
SOLID = StandardLinearSolid(rubbery_modulus=1e6, glassy_modulus=1e7, relaxation_time=TIME)
BROAD = Prony(1e6, tuple(np.geomspace(1e11, 1e5, 30)), tuple(np.geomspace(1e-11, 1e4, 30)))

# A force is a sum of thousands of terms; the load is met to 1e-13 or as well as the digits of the depth allow.
ROUNDING = 1e-9


def test_elements_that_amount_to_kelvin_take_its_sweep():
    chain = KelvinChain(instantaneous_compliance=0.0, compliances=(1e-6,), retardation_times=(TIME,))
    kelvin = MDR().solve(ROUGH).depth
    assert MDR().solve(replace(ROUGH, elastomer=chain)).depth == pytest.approx(kelvin, rel=ROUNDING)


def test_at_rest_the_relaxed_solid_alone_counts():
    elastic = MDR().solve(replace(ROUGH, elastomer=Elastic(modulus=1e6)))
    for solid in (KELVIN, SOLID, BROAD, CHAIN):
        for motion in (Indent(load=1.0), Slide(speed=0.0, load=1.0), Slide(speed=1e-30, load=1.0)):
            found = MDR().solve(replace(ROUGH, elastomer=solid, motion=motion))
            assert found.depth == pytest.approx(elastic.depth, rel=ROUNDING)


@pytest.mark.parametrize("ratio", [1e3, 1e12, 1e20, 1e30, 1e100])
def test_a_fast_contact_far_smaller_than_the_one_at_rest_has_its_own_grid(ratio):
    # a fluid: d = F/(K l), a = sqrt(R d), mu = int g'^2 / int |g'| = 4a/(3R) over the front half
    radius, memory = 1e-2, ratio * 1e-3
    scene = Scene(Sphere(radius=radius), Kelvin(modulus=1e6, relaxation_time=1e-3), Slide(speed=ratio, load=1.0))
    result = MDR(points=2000).solve(scene)
    assert result.measures["points_across_contact"] > 200
    expected = 4 / 3 * sqrt(1.0 / (4e6 * memory * radius))
    # elasticity adds terms of the order of the contact radius over the memory length
    assert result.friction_coefficient == pytest.approx(expected, rel=1e-6 + 1e-3 / memory)
