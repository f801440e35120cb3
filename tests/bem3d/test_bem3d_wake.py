"""The surface around a contact, as its pressure alone displaces it."""

import numpy as np
import pytest
from changing_motion import program
from drawn_scenes import KELVIN, LOAD, ROUGH, STANDARD, TAU, A, R
from drawn_scenes import SCENES as DRAWN

from bem3d import BEM
from bem3d.motion.wake import surroundings
from scene import (
    Indent,
    Layer,
    PowerLaw,
    Program,
    Scene,
    Slide,
    SolveError,
    Sphere,
)

SCENES = {
    "rough": Scene(Sphere(R), KELVIN, Slide(speed=0.5 * A / TAU, load=LOAD), ROUGH),
    "standard": Scene(Sphere(R), STANDARD, Slide(speed=A / TAU, depth=1e-4)),
    "layer": Scene(Sphere(R), KELVIN, Slide(speed=A / TAU, load=LOAD), layer=Layer(thickness=2e-3)),
    **{kind: DRAWN[kind] for kind in ("rest", "line", "plane")},
}
BEYOND = {"upstream": 0.5 * A, "downstream": 4 * A, "aside": 0.5 * A}


def solved(scene, **settings):
    solver = BEM(**{"points": 64, **settings})
    return solver, solver.solve(scene)


@pytest.mark.parametrize("name", SCENES)
def test_on_its_own_grid_the_surface_is_that_of_the_answer(name):
    # one convolution on two grids: to rounding of the transforms
    solver, result = solved(SCENES[name])
    around = surroundings(solver, SCENES[name], result.fields, **BEYOND)
    x, y = result.fields["x"], result.fields["y"]
    columns = np.searchsorted(around.x, x - 0.25 * (x[1] - x[0]))
    rows = np.searchsorted(around.y, y - 0.25 * (x[1] - x[0]))
    np.testing.assert_allclose(around.x[columns], x, rtol=0, atol=1e-9 * np.ptp(x))
    inside = np.ix_(rows, columns)
    np.testing.assert_allclose(
        around.gap[inside], result.fields["gap"], rtol=0, atol=1e-10 * np.ptp(result.fields["gap"])
    )
    assert around.depth == pytest.approx(result.depth, rel=1e-10)
    grows = name != "plane"
    assert (around.x[-1] > x[-1] + 3.9 * A) == grows
    assert (len(around.y) > len(y)) == (grows and name != "line")


def test_at_rest_the_surface_around_a_sphere_is_that_of_hertz():
    solver, result = solved(SCENES["rest"], points=128)
    around = surroundings(solver, SCENES["rest"], result.fields, **BEYOND)
    r = np.hypot(around.x[None, :], around.y[:, None])
    outside = r > 1.1 * A
    s = A / r[outside]
    # Johnson, Contact Mechanics (1985), Eq. 3.42a, with d = a^2/R
    expected = A**2 / (np.pi * R) * ((2 - s**-2) * np.arcsin(s) + np.sqrt(s**-2 - 1))
    # of the area, known to a pixel along the rim of 55 pixels of radius
    np.testing.assert_allclose(around.displacement[outside], expected, rtol=2e-3)


def test_single_precision_has_its_surface_too():
    solver, result = solved(SCENES["standard"], precision="single")
    assert surroundings(solver, SCENES["standard"], result.fields).depth == pytest.approx(result.depth, rel=1e-4)


def test_the_surface_at_the_end_of_a_program_is_where_the_gap_leaves_it():
    motion = program({"duration": TAU, "depth": 1e-4}, {"duration": TAU, "speed": 0.3})
    scene = Scene(Sphere(R), STANDARD, motion, ROUGH)
    solver, result = solved(scene, points=48, steps=40, frames=1)
    around = surroundings(solver, scene, result.fields, **BEYOND)
    # x is where the gap was measured: half a pixel off, slopes of 0.2 would show
    np.testing.assert_allclose(around.gap, result.fields["gap"], rtol=0, atol=1e-9 * result.depth)
    np.testing.assert_array_equal(around.displacement, result.fields["frame_displacement"][-1])
    assert result.fields["frame_shift"][-1] == 0


@pytest.mark.parametrize(
    "motion",
    [
        Indent(depth=5e-5),
        Slide(speed=1e-3, load=0.3),
        program({"duration": 2 * TAU, "depth": 5e-5}, {"duration": 2 * TAU, "speed": 0.2}),
    ],
)
def test_the_surface_is_known_however_high_the_indenter_is_at_the_corners(motion):
    # r^100 is 1e27 depths high there: compared with it, depth and displacement are less than rounding
    scene = Scene(PowerLaw(coefficient=1e-4 / (1e-3) ** 100, exponent=100), KELVIN, motion)
    solver, result = solved(scene, points=64 if isinstance(motion, Program | Indent) else 160, steps=20)
    around, pressed = surroundings(solver, scene, result.fields), result.fields["pressure"]
    assert np.ptp(around.indenter) > 1e20 * result.depth
    assert around.depth == pytest.approx(result.depth, rel=1e-3)
    assert around.displacement.min() > 0
    # at the edge of a flat punch the residual is a part of the depth
    np.testing.assert_allclose(around.gap[pressed > 0], 0, atol=1e-3 * result.depth)
    assert around.displacement.max() < 1.1 * result.depth
    if not isinstance(motion, Program):
        with pytest.raises(SolveError, match="the answer to another one"):
            surroundings(solver, scene, result.fields | {"pressure": 1.1 * pressed})
