"""Motions in one dimension, compared with three."""

import numpy as np
import pytest
from changing_motion import DEPTH, TAU, A, G, R, harmonic, mirrored, program, slid, stiffness

from bem3d import BEM
from mdr1d import MDR
from scene import Elastic, Kelvin, Prony, Scene, Sphere, StandardLinearSolid

SOLID = StandardLinearSolid(G, 5 * G, TAU)
LINE, SPACE = MDR(points=1000), BEM(points=48, steps=60)


def solved(solver, solid, *stages):
    return solver.solve(Scene(Sphere(R), solid, program(*stages))).fields


# Misfits over the greatest force, in the mean and at most: 16 pixels span the radius; a dashpot that touches again
# jumps within a step of 1/40 period.
@pytest.mark.parametrize(
    ("solid", "mean", "most"),
    [(SOLID, 5e-4, 2e-3), pytest.param(Kelvin(G, TAU), 5e-3, 0.2, marks=pytest.mark.slow)],
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


KELVIN, ELASTIC, SERIES = Kelvin(G, TAU), Elastic(G), Prony(G, (2 * G, 20 * G), (TAU, 0.05 * TAU))
FORTH, BACK, FASTER = (slid(path * A, speed * A / TAU) for path, speed in ((1.2, 0.5), (-2.7, 0.5), (0.9, 1.0)))
FEW = {"MDR": MDR(points=200, extent=3.2 * A, steps=50), "BEM": BEM(points=32, steps=20)}
# Of a field over its greatest value: rounding of some hundred steps, and what an iteration makes of it.
MIRRORED = {"MDR": 1e-11, "BEM": 1e-9}


@pytest.mark.parametrize(
    ("name", "solid", "by"),
    [("MDR", ELASTIC, "load"), ("MDR", SERIES, "depth"), ("MDR", KELVIN, "load"), ("BEM", SOLID, "load")],
)
def test_in_a_mirror_friction_and_path_change_their_sign_and_nothing_else(name, solid, by):
    value = {"load": 0.5, "depth": DEPTH}[by]
    motion = program({"duration": TAU, by: value}, FORTH, BACK | {by: 0.8 * value}, FASTER)
    one, other = (FEW[name].solve(Scene(Sphere(R), solid, each)) for each in (motion, mirrored(motion)))
    for field, sign in {"normal_force": 1, "depth": 1, "friction_force": -1, "path": -1, "speed": -1}.items():
        wanted, found = one.fields[field], sign * other.fields[field]
        # of friction on an elastic solid rounding alone is left
        scale = np.nanmax(np.abs(one.fields["normal_force" if field == "friction_force" else field]))
        np.testing.assert_allclose(found, wanted, atol=MIRRORED[name] * scale, err_msg=field)
    if name == "BEM":
        pressure = one.fields["pressure"]
        np.testing.assert_allclose(other.fields["pressure"][:, ::-1], pressure, atol=1e-9 * pressure.max())


def response(solver, amplitude, omega, solid):
    """Ratio of the first harmonics of force and depth, about a depth held until all has relaxed [N/m], complex."""
    frequency, held = omega / (2 * np.pi), 20 * TAU
    periods = 2 + int(omega * TAU * (2 if solver.name == "MDR" else 1))  # the start is forgotten in some times
    swing = {"duration": periods / frequency, "amplitude": amplitude, "frequency": frequency}
    fields = solved(solver, solid, {"duration": TAU, "depth": DEPTH}, {"duration": held}, swing)
    start = TAU + held + (periods - 1) / frequency
    late = fields["time"] >= start * (1 - 1e-9)
    # the depth is a sine
    return harmonic(fields["time"][late] - start, fields["normal_force"][late], omega) / amplitude


SWUNG = {
    "MDR": MDR(points=650, extent=A / np.sqrt(0.1), steps=50),
    "BEM": BEM(points=48, extent=2.6e-3, steps=20, tolerance=1e-7),
}
# By the steps of a period, 200 in one dimension, at whose ends a mode much shorter is half a step late; and 40.
LATE = {"MDR": 5e-3, "BEM": 3e-3}


@pytest.mark.parametrize(
    ("name", "solid", "omega"),
    [
        ("MDR", SERIES, 0.2),
        ("BEM", SOLID, 1.0),
        ("BEM", KELVIN, 5.0),
        *(
            pytest.param(*each, marks=pytest.mark.slow)
            for each in (("MDR", SOLID, 5.0), ("BEM", SOLID, 5.0), ("BEM", KELVIN, 1.0), ("BEM", KELVIN, 0.2))
        ),
    ],
)
def test_a_small_oscillation_meets_the_complex_stiffness_of_a_contact_that_keeps_its_radius(name, solid, omega):
    # the radius of 18 pixels is known to half a percent, 205 in one dimension
    exact = stiffness(A, solid, omega / TAU)
    found = response(SWUNG[name], (1e-4 if name == "MDR" else 1e-3) * DEPTH, omega / TAU, solid)
    assert abs(found) == pytest.approx(abs(exact), rel=5e-3)
    assert np.angle(found / exact) == pytest.approx(0.0, abs=LATE[name])
    assert np.angle(exact) > 0.1
