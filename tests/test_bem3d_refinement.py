"""Contacts refined at the points of their spots: the answer is that of a grid of as many points."""

from dataclasses import replace

import numpy as np
import pytest

from bem3d import BEM, refined
from scene import Cone, Indent, Kelvin, Plane, Scene, SelfAffine, Slide, SolveError, Sphere, StandardLinearSolid

ROUGH = SelfAffine(hurst=0.5, rms_height=3e-6, longest=10e-3, shortest=40e-6, seed=1)
SCENE = Scene(Sphere(10e-3), Kelvin(1e6, 1e-3), Slide(speed=0.1, load=0.002), ROUGH)
COARSE, FINE = (BEM(points=points, extent=0.6e-3, tolerance=1e-8) for points in (64, 128))
# Both are solved to the tolerance of the gap, of which forces and depths keep two digits less at most.
ALIKE = 1e-6
GLASSY = StandardLinearSolid(rubbery_modulus=1e6, glassy_modulus=1e8, relaxation_time=1e-4)


@pytest.mark.parametrize(
    "scene",
    [
        SCENE,
        replace(SCENE, motion=Slide(speed=1e-3, load=0.002)),
        replace(SCENE, motion=Indent(load=0.002)),
        replace(SCENE, indenter=Sphere(1e-3), elastomer=GLASSY, motion=Slide(speed=0.1, depth=5e-7)),
        replace(SCENE, indenter=Cone(0.05), motion=Slide(speed=0.1, load=0.001)),
    ],
    ids=["fast", "slow", "at rest", "glassy, at a depth", "cone"],
)
def test_a_refined_contact_is_that_of_a_grid_of_as_many_points(scene):
    coarse, whole = COARSE.solve(scene), FINE.solve(scene)
    found = refined(COARSE, coarse)
    for name in ("normal_force", "depth", "friction_force"):
        assert getattr(found, name) == pytest.approx(getattr(whole, name), rel=ALIKE, abs=1e-15)
    other = "depth" if scene.motion.load else "normal_force"  # that of the coarse grid would not do
    assert getattr(coarse, other) != pytest.approx(getattr(whole, other), rel=100 * ALIKE)
    for name in ("friction_by_loss", "friction_by_curvature", "curvature_by_pressure"):
        assert found.measures[name] == pytest.approx(whole.measures[name], rel=ALIKE, abs=1e-15)
    assert found.measures["contact_points"] == whole.measures["contact_points"]
    assert found.fields["pressure"].sum() == pytest.approx(whole.fields["pressure"].sum(), rel=ALIKE)


def test_what_cannot_be_refined_is_refused():
    flat = replace(SCENE, indenter=Plane(), motion=Indent(pressure=1e4), roughness=replace(ROUGH, longest=1e-3))
    answer = BEM(points=64).solve(flat)
    with pytest.raises(SolveError, match="only steady contacts on a free surface"):
        refined(BEM(points=64), answer)
    smooth = replace(SCENE, roughness=None, motion=Slide(speed=0.1, load=0.1))
    solver = BEM(points=256)
    with pytest.raises(SolveError, match="fit in a matrix"):
        refined(solver, solver.solve(smooth))
    answer = COARSE.solve(SCENE)
    shallow = dict(answer.fields) | {"gap": answer.fields["gap"] + np.float64(1.0)}
    with pytest.raises(SolveError, match="nothing is left in contact"):
        refined(COARSE, replace(answer, fields=shallow))
