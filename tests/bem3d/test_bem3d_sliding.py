"""Steady sliding in three dimensions against published solutions and the laws that any solution obeys."""

from dataclasses import replace

import numpy as np
import pytest

from bem3d import BEM
from bem3d.grid import Grid
from bem3d.motion.steady import Flow
from bem3d.response.convolution import FreeConvolution
from bem3d.response.engine import Engine
from bem3d.response.halfspace import HalfSpace
from bem3d.response.influence import flowing
from scene import (
    Elastic,
    Kelvin,
    Prony,
    Scene,
    SelfAffine,
    Slide,
    Sphere,
    StandardLinearSolid,
)

G, R, TAU = 1e6, 10e-3, 1e-3
D = 1e-4
A = np.sqrt(R * D)
HERTZ = 4 / 3 * 4 * G * np.sqrt(R) * D**1.5
PUBLISHED = 5e-3  # asked for: 0.5 % with 36 or more points across the contact
ROUGH = SelfAffine(hurst=0.2, rms_height=5e-5, longest=1e-2, shortest=1e-3, seed=2)


def across(points):
    """Solver with that many points over 2 a, on an extent that holds the geometric overlap 2 sqrt(2) a."""
    n = int(np.ceil(points * 3.2 / 2))
    return BEM(points=n, extent=2 * A * n / points)


def sphere_at(ratio, **other):
    """Kelvin sphere at depth a^2/R and v tau / a = ratio."""
    return Scene(Sphere(R), Kelvin(G, TAU), Slide(speed=ratio * A / TAU, depth=D), **other)


@pytest.mark.parametrize(("ratio", "force", "friction"), [(0.1, 1.0036, 0.0936), (10.0, 4.522, 0.652)])
def test_kelvin_sphere_reaches_the_reference_values(ratio, force, friction):
    result = across(36).solve(sphere_at(ratio))
    assert (result.normal_force / HERTZ, result.friction_coefficient * R / A) == pytest.approx(
        (force, friction), rel=PUBLISHED
    )


def test_lengths_of_a_flow_and_how_far_estimates_of_friction_count_in_it():
    grid, flow = Grid(8, 8.0), Flow(1.0, 0.0, np.array([0.5, 0.5]), np.array([1.0, 3.0]))
    assert (flow.lag_length, flow.memory) == (2.0, 2.5)  # (1 + 3)/2, and (1^2 + 3^2)/2 over it
    assert flow.compliance(2.0, 1.0) == pytest.approx(0.5 / (1 + 2j) + 0.5 / (1 + 6j))
    quarter, fluid = (Flow(1.0, 0.0, np.ones(1), np.array([length])) for length in (0.25, 1e9))
    assert quarter.slowness(grid) == 0.5
    assert replace(quarter, lengths=np.array([0.125])).slowness(grid) == pytest.approx(16 / 17)
    assert (fluid.lag(grid), fluid.collocation(grid)) == pytest.approx((1.0, 0.5))
    assert quarter.lag(grid) == pytest.approx(np.arctan(np.pi / 4) / (np.pi / 2))
    assert Flow.of(Elastic(G), 1.0).at_rest
    assert Flow.of(Kelvin(G, TAU), 0.0).lag(grid) == 0.0


@pytest.mark.parametrize(
    ("memory", "depth", "moment"),
    [(1e-4, 0.099824e-3, 0.045249e-3), (1e-3, 0.091508e-3, 0.157664e-3), (1e-2, 0.070553e-3, 0.041906e-3)],
)
def test_sphere_on_a_standard_linear_solid_agrees_with_two_other_codes(memory, depth, moment):
    # memory = v tau_c, tau_c = 2 tau_e; force control at 0.533333 N; a coarse grid is enough for the glass
    solid = StandardLinearSolid(G, 2 * G, TAU)
    scene = Scene(Sphere(R), solid, Slide(speed=memory / (2 * TAU), load=0.533333))
    result = BEM(points=48).solve(scene)
    assert result.depth == pytest.approx(depth, rel=3e-3)
    assert result.friction_coefficient * R == pytest.approx(moment, rel=5e-3)


def test_a_finer_tolerance_changes_the_answer_by_no_more_than_the_looser_one_states():
    scene = Scene(Sphere(R), Kelvin(G, TAU), Slide(speed=1.0, load=1.0), ROUGH)
    loose = BEM(points=64, extent=5e-3).solve(scene)
    tight = BEM(points=64, extent=5e-3, tolerance=1e-9).solve(scene)
    assert tight.residual <= 1e-9
    assert (loose.friction_coefficient, loose.depth) == pytest.approx(
        (tight.friction_coefficient, tight.depth), rel=1e-4
    )


@pytest.mark.parametrize("solid", [Kelvin(1e6, 1e-3), Prony(1e6, (3e6, 1e7), (1e-3, 1e-2))])
def test_what_a_pressure_loses_is_its_work_on_the_slope_of_its_displacement(solid):
    """By the product with its kernel; on a surface that repeats by closed forms of waves in full contact."""
    flow, grid = Flow.of(solid, 2.0), Grid(16, 16e-3)
    pressure = np.random.default_rng(1).random(grid.shape)
    shares, lengths = flow.shares, flow.in_pixels(grid)
    moved = FreeConvolution.of(flowing(18, 16, 0.0, shares, lengths, 0.0))(np.pad(pressure, ((0, 0), (1, 1))))
    rates = shares / lengths
    slope = FreeConvolution.of(flowing(16, 16, rates.sum(), -rates, lengths, 0.0))(pressure)
    expected = [np.sum(pressure * slope), np.sum(pressure * (moved[:, 2:] - moved[:, :-2]) / 2)]
    np.testing.assert_allclose(HalfSpace(flow, Engine()).lost(grid, pressure), expected, rtol=1e-10)
