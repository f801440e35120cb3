"""Effects together: what holds of each alone holds of all that one scene may have at once."""

from dataclasses import replace

import numpy as np
import pytest
from planned import STANDARD

from bem3d import BEM
from mdr1d import MDR
from scene import (
    WLF,
    Coulomb,
    Elastic,
    Heating,
    Indent,
    Layer,
    Plane,
    Scene,
    SelfAffine,
    Slide,
    Sphere,
    Topography,
)

WARM = WLF(temperature=306.0, reference=300.0, c1=10.0, c2=100.0)
ROUGH = SelfAffine(hurst=0.8, rms_height=2e-6, longest=2e-3, shortest=0.4e-3, seed=1)
LOAD, STICKS = 0.5, 0.3
PLAIN = Scene(
    Sphere(radius=10e-3),
    STANDARD,
    Slide(speed=0.3, load=LOAD),
)
TOGETHER = replace(PLAIN, roughness=ROUGH, temperature=WARM, interface=Coulomb(STICKS))
# The table of 1D has no row for a layer, and heating is estimated for a half-space.
SOLVED = {
    "BEM, layer": (BEM(points=48), replace(TOGETHER, layer=Layer(thickness=2e-3))),
    "BEM, heated": (BEM(points=48), replace(TOGETHER, heating=Heating(conductivity=0.5, feedback="average"))),
    "MDR, heated": (MDR(points=1000), replace(TOGETHER, heating=Heating(conductivity=0.5, feedback="average"))),
}
solvers = pytest.mark.parametrize("solver", [BEM(points=48), MDR(points=1000)])
ROUNDING = 1e-9  # of the answers: iterations stop at the same places, and add rounding up


def numbers(answer):
    return np.array([answer.normal_force, answer.depth, answer.friction_force])


@solvers
def test_friction_of_the_interface_has_no_error_of_the_grid(solver):
    bare, rubbed = (solver.solve(replace(PLAIN, interface=each)) for each in (None, Coulomb(STICKS)))
    absolute = [each.measures["friction_error"] * each.friction_force for each in (bare, rubbed)]
    assert absolute[0] == pytest.approx(absolute[1], rel=1e-12)


@pytest.mark.parametrize(
    "solver", [BEM(points=48), *(MDR(points=500, extent=4e-3, spectrum=each) for each in ("mapped", "line-scan"))]
)
def test_a_map_without_heights_is_no_roughness(solver):
    flat = Topography(heights=np.full((20, 20), 0.1), pixel=1e-4)
    with_it, without = (solver.solve(replace(PLAIN, roughness=each)) for each in (flat, None))
    assert numbers(with_it) == pytest.approx(numbers(without), rel=ROUNDING)


@solvers
def test_where_nothing_is_lost_no_error_is_stated(solver):
    scenes = [replace(PLAIN, motion=Indent(load=LOAD)), replace(PLAIN, elastomer=Elastic(1e6))]
    plane = Scene(Plane(), PLAIN.elastomer, Indent(pressure=1e5), ROUGH)
    for scene in (*scenes, *([] if solver.refusals(plane) else [plane])):
        assert "friction_error" not in solver.solve(scene).measures


@solvers
def test_an_interface_at_speed_zero_is_that_of_ever_slower_sliding(solver):
    heated = replace(TOGETHER, heating=Heating(conductivity=0.5))
    slow, still = (solver.solve(replace(heated, motion=Slide(speed=speed, load=LOAD))) for speed in (1e-9, 0.0))
    assert still.friction_force == pytest.approx(STICKS * LOAD, rel=ROUNDING)
    # what the elastomer loses at 1e-9 m/s
    assert slow.friction_force == pytest.approx(still.friction_force, rel=1e-6)
    assert still.measures["friction_in_elastomer"] == pytest.approx(0.0, abs=1e-6 * LOAD)
    assert [still.measures[f"{which}_heating"] for which in ("average", "flash")] == [0, 0]
    assert slow.measures["average_heating"] > 0
    at_rest = replace(heated, motion=Indent(load=LOAD))
    assert solver.solve(at_rest).friction_force == solver.solve(replace(at_rest, interface=None)).friction_force


@pytest.mark.parametrize("name", SOLVED)
def test_each_effect_changes_an_answer_that_has_all_others(name):
    # the laws above can fail: no effect is lost when it is combined with another
    solver, scene = SOLVED[name]
    whole = numbers(solver.solve(scene))
    for effect in ("roughness", "layer", "temperature", "heating", "interface"):
        if effect not in scene.parts:
            continue
        left = {effect: None} if effect != "temperature" else {"temperature": None, "heating": None}
        assert np.abs(numbers(solver.solve(replace(scene, **left))) / whole - 1).max() > 1e-4, effect
