"""Motions in one dimension beside three."""

import numpy as np
import pytest

from bem3d import BEM
from mdr1d import MDR
from scene import Kelvin, Program, Scene, Sphere, Stage, StandardLinearSolid

R, G, A, TAU = 1e-2, 1e6, 1e-3, 1e-3
DEPTH = A**2 / R
SOLID = StandardLinearSolid(G, 5 * G, TAU)
PRESSED = Stage(duration=TAU, load=1.0)
LINE, SPACE = MDR(points=1000), BEM(points=48, steps=60)


def solved(solver, solid, *stages):
    return solver.solve(Scene(Sphere(R), solid, Program(stages=tuple(Stage(**stage) for stage in stages)))).fields


# Misfits over the greatest force, in the mean and at most: 16 pixels span the radius; a dashpot that touches again
# jumps within a step of 1/40 period.
@pytest.mark.parametrize(
    ("solid", "mean", "most"),
    [(SOLID, 5e-4, 2e-3), pytest.param(Kelvin(G, TAU), 5e-3, 0.2, marks=pytest.mark.slow)],
    ids=str,
)
def test_however_large_an_oscillation_of_the_depth_one_dimension_has_the_force_of_three(solid, mean, most):
    # nothing slides: one dimension is exact, through separation too; a third of the depth, lifted fast
    stages = (
        {"duration": TAU, "depth": DEPTH},
        {"duration": 2 * TAU, "amplitude": 0.3 * DEPTH, "frequency": 1 / TAU},
        {"duration": TAU, "depth": 0.5 * DEPTH, "amplitude": 0.3 * DEPTH, "frequency": 2 / TAU},
    )
    one, three = (solved(solver, solid, *stages) for solver in (LINE, SPACE))
    expected = np.interp(three["time"], one["time"], one["normal_force"])
    late = three["time"] > 0.5 * TAU
    off = np.abs(three["normal_force"] - expected)[late] / expected.max()
    assert off.mean() < mean
    assert off.max() < most
    assert expected[late].min() < 0.05 * expected.max()


@pytest.mark.parametrize(("solver", "times"), [(LINE, 2.0), (SPACE, 1.0)])
def test_coming_down_at_an_angle_on_a_quick_solid_friction_is_its_lag_over_the_radius(solver, times):
    lag, speed = 1e-3 * TAU, A / TAU
    down = {"duration": 3 * TAU, "depth": DEPTH, "speed": speed}
    fields = solved(solver, Kelvin(G, lag), down)
    late = fields["time"] > TAU
    mu = fields["friction_force"][late] / fields["normal_force"][late]
    # of first order in lag over the time to come down, 1e-3; mu by traction on 10 to 16 pixels of radius
    assert np.median(mu) == pytest.approx(times * lag * speed / R, rel=5e-2)
