"""Contacts on the same pixels share kernels and spectra; whatever was solved before, digits stay as they are."""

from dataclasses import replace

import numpy as np
import pytest
from sliding import KELVIN, ORDINARY

from bem3d import BEM, surface
from bem3d.grid import KEPT, SIZES, Grid, cached_on_small_grids
from bem3d.motion.steady import Flow
from bem3d.response import influence
from bem3d.response.engine import Engine
from bem3d.response.halfspace import HalfSpace
from scene import Cone, Elastic, Indent, Plane, Scene, SelfAffine, Slide, Sphere

ROUGH = SelfAffine(hurst=0.2, rms_height=5e-5, longest=1e-2, shortest=5e-4, seed=1)
SLIDING = replace(ORDINARY, roughness=ROUGH)
OTHERS = [
    replace(SLIDING, motion=Slide(speed=1.0, load=1.0)),
    replace(SLIDING, motion=Slide(speed=0.1, load=3.0)),
    replace(SLIDING, motion=Slide(speed=0.1, depth=2e-4)),
    replace(SLIDING, motion=Indent(load=1.0)),
    replace(SLIDING, indenter=Cone(0.1)),
    replace(SLIDING, elastomer=Elastic(1e6), motion=Indent(load=1.0)),
    replace(SLIDING, roughness=replace(ROUGH, amplitudes="gaussian")),
    replace(SLIDING, roughness=replace(ROUGH, rms_height=2e-5)),
    Scene(Plane(), KELVIN, Slide(speed=0.1, pressure=1e4), replace(ROUGH, shortest=2e-3)),
]


def of_seed(seed, scene):
    return replace(scene, roughness=replace(scene.roughness, seed=seed))


class Counted:
    """A function, and the arguments of its calls."""

    def __init__(self, function):
        self.function, self.calls = function, []

    def __call__(self, *args, **kwargs):
        self.calls.append(args)
        return self.function(*args, **kwargs)


def digits(scene, points):
    answer = BEM(points=points).solve(scene)
    forces = [answer.normal_force, answer.friction_force, answer.depth, answer.residual]
    found = *forces, *answer.measures.values(), *answer.fields.values()
    return b"".join(np.asarray(each).tobytes() for each in found)


@pytest.mark.parametrize("points", [32, 48])
def test_digits_do_not_depend_on_what_was_solved_before(points):
    scenes = [of_seed(seed, scene) for scene in (SLIDING, *OTHERS) for seed in (1, 2)]
    forwards = [digits(scene, points) for scene in scenes]
    assert [digits(scene, points) for scene in reversed(scenes)] == forwards[::-1]
    assert len(set(forwards)) == len(scenes) - 2  # an elastic and a relaxed solid at rest are one


def test_many_surfaces_of_a_body_take_few_kernels_and_one_spectrum(monkeypatch):
    kernels, spectra = Counted(influence.flowing), Counted(surface._cell_means)
    monkeypatch.setattr(influence, "flowing", kernels)
    monkeypatch.setattr(surface, "_cell_means", spectra)
    # A body of its own, so that nothing of it was kept before.
    alone = replace(SLIDING, indenter=Sphere(1.01e-2), roughness=replace(ROUGH, hurst=0.21))
    solver, counts = BEM(points=32), []
    for seed in range(20):
        solver.solve(of_seed(seed, alone))
        counts.append(len(kernels.calls))
    # Alone each would take as many as the first: to find the window, in it, beyond it, and for what is lost.
    assert counts[0] >= 5
    assert counts[-1] < 20 * counts[0] / 2
    assert len(spectra.calls) == 1
    for seed in range(20):
        solver.solve(of_seed(seed, alone))
    assert len(kernels.calls) == counts[-1]


def test_what_is_kept_is_told_apart_by_all_but_the_place_and_is_bounded():
    found = cached_on_small_grids(asked := Counted(lambda medium, grid: grid))
    flow = Flow.of(KELVIN, 0.1)
    medium, grid = HalfSpace(flow, Engine()), Grid(32, 4e-3, (1e-3, 0.0))
    again = HalfSpace(Flow.of(KELVIN, 0.1), Engine())
    assert found(medium, grid) is found(again, replace(grid, centre=(0.0, 2e-3)))
    assert len(asked.calls) == 1
    others = [
        (replace(medium, flow=Flow.of(KELVIN, np.nextafter(0.1, 1))), grid),
        (replace(medium, flow=Flow.of(KELVIN, 0.0)), grid),
        (replace(medium, engine=Engine(precision="single")), grid),
        (medium, replace(grid, extent=np.nextafter(4e-3, 1))),
        (medium, replace(grid, width=1.0)),
    ]
    for other in others:
        found(*other)
    assert len(asked.calls) == 1 + len(others)
    for k in range(KEPT // SIZES[0]):
        found(medium, replace(grid, extent=1.0 + k))
    before = len(asked.calls)
    found(medium, grid)
    assert len(asked.calls) == before + 1  # the last ones took its place
