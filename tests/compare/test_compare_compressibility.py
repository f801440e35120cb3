"""Compressibility: the Poisson ratio enters E* = 2 G/(1 - nu) and nothing else, of every solid in every motion."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from invented_answers import FEW, eq_19, obeying

from bem3d import BEM
from compare.studies.comparison.laws import laws
from mdr1d import MDR
from scene import Program, Scene, Sphere, Stage, StandardLinearSolid

# Iterations on numbers that differ by rounding.
SCALED = {"MDR": 1e-11, "BEM": 1e-8}

G, TIME = 1e6, 1e-3
SOLID = StandardLinearSolid(G, 20 * G, TIME)


FORCES = {
    "pressure",
    "line_force",
    "normal_force",
    "friction_force",
    "friction_by_work",
    "work",
    "dissipated",
    "stored",
}


def compare(found, wanted, rtol, force=1.0):
    """Lengths, shares and friction coefficient as they were, forces times a factor."""
    for name, field in wanted.fields.items():
        expected = field * (force if name in FORCES else 1.0)
        known = np.isfinite(expected)
        scale = np.abs(expected[known]).max()
        np.testing.assert_allclose(found.fields[name][known], expected[known], rtol=0, atol=rtol * scale)


@cache
def solved(solver, scene):
    """Answer of the incompressible solid, which stands behind every ratio."""
    return solver.solve(scene)


def softened(scene, nu, stiffness=1.0):
    """The scene with another Poisson ratio, and its shear modulus times some stiffness."""
    return replace(scene, elastomer=StandardLinearSolid(G * stiffness, 20 * G * stiffness, TIME, nu))


@pytest.mark.parametrize(
    "solver", [MDR(points=400, steps=24), BEM(points=32, steps=24)], ids=lambda solver: solver.name
)
@pytest.mark.parametrize("nu", [-0.9, 0.4])
@pytest.mark.parametrize(("pressed_by", "value"), [("load", 0.1), ("depth", 3e-5)])
def test_creep_relaxation_and_a_start_from_rest_scale_alike(solver, nu, pressed_by, value):
    first = Stage(duration=0.1 * TIME, **{pressed_by: value})
    program = Program(stages=(first, Stage(duration=3 * TIME), Stage(duration=1.5 * TIME, speed=0.3)))
    scene = Scene(Sphere(radius=1e-2), SOLID, program)
    wanted = solved(solver, scene)
    compare(solver.solve(softened(scene, nu, (1 - nu) / 0.5)), wanted, SCALED[solver.name])
    if pressed_by == "depth":
        compare(solver.solve(softened(scene, nu)), wanted, SCALED[solver.name], force=0.5 / (1 - nu))


def test_the_laws_of_the_paper_take_the_plane_strain_modulus_for_storage_and_loss():
    curve, answers = FEW.curves["rough"], obeying(eq_19, FEW)("MDR")

    def ruled(nu):
        return laws(replace(curve, scene=softened(curve.scene, nu, (1 - nu) / 0.5)), answers)

    wanted, found = ruled(0.5), ruled(0.0)
    for name in ("xi", "shifts", "slowest_loss", "loss_exponent", "exponent", "plateau"):
        np.testing.assert_allclose(getattr(found, name), getattr(wanted, name), rtol=1e-9, err_msg=name)
