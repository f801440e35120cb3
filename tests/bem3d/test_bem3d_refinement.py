"""Contacts refined at the points of their spots: the answer equals the answer on a grid of as many points."""

from dataclasses import replace

import numpy as np
import pytest
from changing_motion import program
from maps import noise, refused

from bem3d import BEM, refined
from bem3d.terms import TERMS
from scene import (
    WLF,
    Cone,
    Coulomb,
    CrossedWaves,
    Cylinder,
    Heating,
    Indent,
    Kelvin,
    Layer,
    Measured,
    Plane,
    PowerLaw,
    Profile,
    Prony,
    Refused,
    Scene,
    SelfAffine,
    Shear,
    Slide,
    SolveError,
    Sphere,
    StandardLinearSolid,
    Topography,
)

ROUGH = SelfAffine(hurst=0.5, rms_height=3e-6, longest=10e-3, shortest=40e-6, seed=1)
SCENE = Scene(Sphere(10e-3), Kelvin(1e6, 1e-3), Slide(speed=0.1, load=0.002), ROUGH)
COARSE, FINE = (BEM(points=points, extent=0.6e-3, tolerance=1e-9) for points in (32, 64))
# Both are solved to the tolerance of the gap; forces and depths have at most two digits less.
ALIKE = 1e-6
GLASSY = StandardLinearSolid(rubbery_modulus=1e6, glassy_modulus=1e8, relaxation_time=1e-4)


# One of every part that a scene may have; all on the same window.
SMOOTH = replace(SCENE, roughness=None, motion=Slide(speed=0.05, load=5e-4))
COLD = WLF(temperature=300, reference=298, c1=8.86, c2=101.6)
WARM = replace(SMOOTH, elastomer=GLASSY, roughness=replace(ROUGH, rms_height=1e-7), temperature=COLD)
SIDE = np.linspace(-1, 1, 64) * 0.6e-3
BOWL = Measured(heights=np.hypot(SIDE, SIDE[:, None]) ** 2 / 2e-2, pixel=1.2e-3 / 63, peaks="down")
LINE = Profile(heights=2e-8 * noise(500, 1).cumsum(), spacing=2e-5, shortest_kept=1e-4, seed=1)
BUMPS = 1e-7 * noise((8, 8), 1)
ANSWERED = {
    "smooth": SMOOTH,
    "cone": replace(SMOOTH, indenter=Cone(0.05), motion=Slide(speed=0.05, load=0.002)),
    "blunt, fast": replace(
        SMOOTH, indenter=PowerLaw(coefficient=1e12, exponent=5), motion=Slide(speed=1, load=0.01)
    ),
    "rough": SCENE,
    "glassy, at a depth": replace(
        SCENE, indenter=Sphere(1e-3), elastomer=GLASSY, motion=Slide(speed=0.1, depth=5e-7)
    ),
    "rough to the pixel": replace(
        SCENE, roughness=replace(ROUGH, shortest=None, rms_height=3e-7), motion=Slide(speed=0.1, load=2e-4)
    ),
    "waves": replace(SMOOTH, roughness=CrossedWaves(amplitude=2e-7, wavelength=1e-4)),
    "map": replace(SMOOTH, roughness=Topography(heights=BUMPS, pixel=1e-4, repeat="periodic")),
    "measured line": replace(SMOOTH, roughness=LINE),
    "measured body": replace(SMOOTH, indenter=BOWL),
    "prony, at a depth": replace(
        SMOOTH,
        elastomer=Prony(1e6, (1e6, 3e6), (1e-4, 1e-2), poisson_ratio=0.4),
        motion=Slide(speed=0.05, depth=2e-6),
    ),
    "at rest": replace(SCENE, motion=Indent(load=0.002)),
    "layer": replace(SMOOTH, layer=Layer(thickness=3e-4)),
    "cold": replace(SCENE, temperature=COLD),
    "heating": replace(WARM, heating=Heating(conductivity=0.2)),
    "heating that acts back": replace(WARM, heating=Heating(conductivity=1e-3, feedback="flash")),
    "coulomb": replace(SCENE, interface=Coulomb(coefficient=0.3)),
    "shear, by a force": replace(
        SCENE,
        elastomer=Kelvin(1e6, 1e-3, poisson_ratio=0.3),
        interface=Coulomb(coefficient=0.5),
        motion=Shear(load=0.002, force=5e-4),
    ),
    "shear, uncoupled": replace(
        SMOOTH,
        elastomer=Kelvin(1e6, 1e-3, poisson_ratio=0.0),
        interface=Coulomb(coefficient=0.5),
        motion=Shear(load=5e-4, force=1e-4),
    ),
}
COUNTS = ("applications", "rounds", "transform_pairs", "seconds", "residual")  # the price, not the answer


# Slow cases of an effect that a quick case covers too.
LONG = {"heating that acts back", "shear, uncoupled", "measured line"}


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=pytest.mark.slow if name in LONG else ()) for name in ANSWERED]
)
def test_whatever_a_scene_is_made_of_refined_answers_as_a_grid_of_as_many_points(name):
    scene = ANSWERED[name]
    given, whole = COARSE.solve(scene), FINE.solve(scene)
    found = refined(COARSE, given)
    assert found.scene == whole.scene
    assert found.settings == whole.settings
    for one in ("normal_force", "depth", "friction_force"):
        assert getattr(found, one) == pytest.approx(getattr(whole, one), rel=ALIKE, abs=1e-15), one
    other = "depth" if scene.motion.load else "normal_force"  # its value on the coarse grid would not do
    assert getattr(given, other) != pytest.approx(getattr(whole, other), rel=10 * ALIKE)
    assert found.measures.keys() == whole.measures.keys()
    for one in {each for each in whole.measures if not each.endswith(COUNTS)}:
        assert found.measures[one] == pytest.approx(whole.measures[one], rel=100 * ALIKE, abs=1e-15), one
    touched = whole.fields["pressure"] > 0
    y, x = np.meshgrid(whole.fields["y"], whole.fields["x"], indexing="ij")
    planes = {"x": x, "y": y} | {each: plane for each, plane in whole.fields.items() if np.ndim(plane) == 2}
    assert found.fields.keys() == planes.keys() - {"gap", "height"}
    for one, values in found.fields.items():
        np.testing.assert_allclose(values, planes[one][touched], rtol=0, atol=1e-4 * np.abs(values).max())


def test_pixels_a_quarter_as_wide_are_reached_in_two_steps():
    found, whole = refined(COARSE, COARSE.solve(SCENE), 4), replace(FINE, points=128).solve(SCENE)
    for one in ("depth", "friction_force"):
        assert getattr(found, one) == pytest.approx(getattr(whole, one), rel=ALIKE)
    assert found.measures["contact_points"] == whole.measures["contact_points"]


REFUSED = {
    "plane": replace(SCENE, indenter=Plane(), motion=Indent(pressure=1e4), roughness=replace(ROUGH, longest=1e-3)),
    "cylinder": replace(SMOOTH, indenter=Cylinder(1e-2), motion=Slide(speed=0.1, line_load=1.0)),
    "program": replace(SMOOTH, motion=program({"duration": 1e-3, "load": 0.01})),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_has_no_spots_of_its_own_is_refused_by_name(name):
    field = "motion" if name == "program" else "indenter"
    part = type(getattr(REFUSED[name], field)).__name__
    solver = BEM(points=64, steps=5)
    refused(f"{field} = {part}: .* take more points", refined, solver, solver.solve(REFUSED[name]), error=Refused)


def test_every_part_that_the_solver_has_a_term_for_is_refined_or_refused():
    parts = {type(part) for scene in [*ANSWERED.values(), *REFUSED.values()] for part in scene.parts.values()}
    assert [kind for kind in TERMS if not any(issubclass(part, kind) for part in parts)] == []


def test_what_cannot_be_refined_is_an_error():
    answer, solver = COARSE.solve(SCENE), BEM(points=256)
    smooth = replace(SCENE, roughness=None, motion=Slide(speed=0.1, load=0.1))
    refused("fit in a matrix", refined, solver, solver.solve(smooth), error=SolveError)
    shallow = dict(answer.fields) | {"gap": answer.fields["gap"] + np.float64(1.0)}
    refused("nothing is left in contact", refined, COARSE, replace(answer, fields=shallow), error=SolveError)
    with pytest.raises(SolveError, match="the answer to another one"):
        refined(COARSE, replace(answer, scene=replace(SCENE, motion=Slide(speed=0.3, load=0.002))))
    with pytest.raises(Refused, match=r"result\.fields: no pressure and gap on a grid"):
        refined(COARSE, refined(COARSE, answer))
    for times, message in ((0, "a power of two"), (3, "a power of two"), (2.0, "a whole number")):
        refused(message, refined, COARSE, answer, times, error=ValueError)
