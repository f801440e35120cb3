"""What a case asks to be solved: each scene once, the same points in both dimensions."""

from collections import Counter
from dataclasses import replace

import pytest

from bem3d import BEM
from compare.cases import Case, Study
from compare.study import points, tasks
from mdr1d import MDR
from scene import Elastic, Indent, Kelvin, SelfAffine, Slide, Sphere

CASE = Case(
    indenter=Sphere(radius=1e-2),
    elastomer=Kelvin(modulus=1e6, relaxation_time=1e-3),
    motion=Slide(speed=0.1, load=1.0),
    roughness=SelfAffine(hurst=0.5, rms_height=1e-6, longest=1e-2, shortest=1e-3, seed=5),
    study=Study(speeds=(0.1, 1.0), pressing=(1.0, 2.0), load_speeds=(0.1, 1.0), surfaces=2, profiles=4),
    bem=BEM(points=32),
    mdr=MDR(points=500),
)


def kinds(case):
    return Counter((point.kind, point.solver) for point in points(case))


def test_every_curve_has_its_points_in_both_dimensions():
    found = kinds(CASE)
    for kind, count in {"own": 1, "speed": 2, "load": 4, "force-depth": 10, "smooth": 5}.items():
        assert found[kind, "MDR"] == found[kind, "BEM"] == count
    assert found["force-depth", "exact"] == 5
    assert found["refined", "BEM"] == found["coarse", "BEM"] == 2


def test_no_scene_is_solved_twice():
    found = points(CASE)
    asked = [(task.solver, scene) for task in tasks(found) for scene in task.scenes]
    assert len(asked) == len(set(asked))
    everywhere = {(task.solver, scene) for point in found for task in point.tasks for scene in task.scenes}
    assert everywhere == set(asked)
    # The scene's own point lies on both curves and is a picture.
    assert sum(CASE.scene == scene for solver, scene in asked if solver == CASE.bem) == 1


def test_one_task_holds_all_profiles_and_one_surface():
    for task in tasks(points(CASE)):
        rough = task.scenes[0].roughness is not None
        assert len(task.scenes) == (4 if rough and task.solver == CASE.mdr else 1)
        if rough:
            first = task.scenes[0].roughness.seed
            assert [scene.roughness.seed for scene in task.scenes] == list(range(first, first + len(task.scenes)))


def test_fields_are_kept_of_the_own_point_in_both_dimensions_and_of_nothing_else():
    kept = [task for task in tasks(points(CASE)) if task.keeps_fields]
    assert {task.solver for task in kept} == {CASE.mdr, CASE.bem}
    assert [task.scenes[0] for task in kept] == [CASE.scene, CASE.scene]


def test_a_refined_point_repeats_a_coarse_one_with_twice_the_points():
    found = points(CASE)
    coarse, refined = ([p.tasks for p in found if p.kind == kind] for kind in ("coarse", "refined"))
    for (one,), (two,) in zip(coarse, refined, strict=True):
        assert one.scenes == two.scenes
        assert (one.solver.points, two.solver.points) == (32, 64)


def test_a_surface_that_ends_at_the_grid_is_not_refined():
    rough = replace(CASE.roughness, shortest=None)
    refined = [p.scene.roughness for p in points(replace(CASE, roughness=rough)) if p.kind == "refined"]
    assert refined == [None]


@pytest.mark.parametrize(
    "change",
    [{"motion": Indent(load=1.0)}, {"elastomer": Elastic(modulus=1e6)}],
    ids=["at rest", "elastic"],
)
def test_without_friction_only_force_against_depth_is_left(change):
    assert {kind for kind, _ in kinds(replace(CASE, **change))} == {"own", "force-depth", "coarse", "refined"}


def test_a_smooth_case_asks_for_its_force_depth_curve_once():
    assert kinds(replace(CASE, roughness=None))["force-depth", "BEM"] == 5


def test_depth_stays_prescribed_where_the_scene_prescribes_it():
    deep = replace(CASE, motion=Slide(speed=0.1, depth=1e-4))
    pressed = {p.scene.motion.depth for p in points(deep) if p.kind == "load"}
    assert pressed == {1e-4, 2e-4}
    assert all(p.scene.motion.load is None for p in points(deep))
