"""Many contacts solved at once have the same answers as contacts solved alone."""

from dataclasses import replace
from math import radians

import numpy as np
import pytest
from maps import refused
from sliding import KELVIN as SOLID

from mdr1d import MDR
from mdr1d.ensemble import solve_profiles
from scene import (
    Cone,
    Indent,
    PowerLaw,
    Scene,
    SelfAffine,
    Slide,
    SolveError,
    Sphere,
    StandardLinearSolid,
)

ROUGH = SelfAffine(hurst=0.4, rms_height=5e-5, longest=1e-2)
CONE = Scene(Cone(angle=radians(10)), SOLID, Slide(speed=1e-2, load=10.0), ROUGH)
SPHERE = replace(CONE, indenter=Sphere(radius=1e-2))
POINTS = 1000
# Both meet the load to 1e-10; friction follows the load in proportion or less.
MET = 1e-9


def one_at_a_time(scene, points, seed):
    """On a grid of three periods, which a wide contact needs."""
    seeded = replace(scene, roughness=replace(scene.roughness, seed=seed))
    return MDR(points=3 * points, extent=3 * scene.roughness.longest).solve(seeded)


def moved(scene, **motion):
    return replace(scene, motion=replace(scene.motion, **motion))


SCENES = {
    "slow": CONE,
    "fast": moved(CONE, speed=10.0),
    "at rest": moved(CONE, speed=0.0),
    "light": moved(CONE, load=1e-3),
    "wider than the period": moved(CONE, load=60.0),
    "sphere": SPHERE,
    "power law": replace(CONE, indenter=PowerLaw(coefficient=1e4, exponent=3.5)),
    "resolved": replace(CONE, roughness=replace(ROUGH, shortest=1e-4, amplitudes="gaussian")),
    "smoothest": replace(CONE, roughness=replace(ROUGH, hurst=1.0)),
    "roughest": replace(CONE, roughness=replace(ROUGH, hurst=0.0)),
}


def test_every_answer_is_that_of_the_solver():
    points = [POINTS, POINTS, 500, *[900] * (len(SCENES) - 3)]
    answers = solve_profiles(list(SCENES.values()), points, seeds=(3, 8))
    for i, scene in enumerate(SCENES.values()):
        for column, seed in enumerate((3, 8)):
            alone = one_at_a_time(scene, points[i], seed)
            assert answers.friction[i, column] == pytest.approx(alone.friction_coefficient, rel=MET, abs=MET)
            assert answers.depth[i, column] == pytest.approx(alone.depth, rel=MET)
            assert answers.length[i, column] == pytest.approx(alone.measures["contact_length"], rel=1e-7)
            assert answers.rms_slope[i, column] == pytest.approx(alone.measures["rms_slope"], rel=1e-12)


def test_neighbours_along_a_parameter_save_sweeps():
    scenes = [moved(CONE, load=float(load)) for load in np.geomspace(1.0, 10.0, 20)]
    answers = solve_profiles(scenes, [5000] * 20, seeds=range(3))
    # From the sure start alone each takes five.
    assert answers.sweeps[1:].mean() <= 4.5
    assert answers.sweeps.min() >= 1


@pytest.mark.parametrize("height", [0.0, 1e-12])
@pytest.mark.parametrize("points", [8, POINTS])
def test_a_contact_smoother_than_its_chords_is_found_too(points, height):
    scene = replace(SPHERE, roughness=replace(ROUGH, rms_height=height))
    scenes = [moved(scene, load=load) for load in (1e-9, 1.0, 60.0)]
    answers = solve_profiles(scenes, [points] * len(scenes), seeds=(1,))
    for i, each in enumerate(scenes):
        alone = one_at_a_time(each, points, 1)
        assert (answers.friction[i, 0], answers.depth[i, 0]) == pytest.approx(
            (alone.friction_coefficient, alone.depth), rel=MET
        )


def test_where_nothing_is_found_there_is_no_number():
    lost = [moved(CONE, load=5e-324), moved(CONE, speed=1e308), CONE]
    lost[1] = replace(lost[1], elastomer=replace(SOLID, relaxation_time=1e3))
    answers = solve_profiles(lost, [POINTS] * 3, seeds=(1,))
    for column in vars(answers).values():
        assert np.isnan(column[:2]).all()
    assert answers.friction[2, 0] == pytest.approx(one_at_a_time(CONE, POINTS, 1).friction_coefficient, rel=MET)


def test_numbers_too_far_apart_say_so():
    with pytest.raises(SolveError):
        solve_profiles([replace(CONE, elastomer=replace(SOLID, modulus=1e-300))], [POINTS], seeds=(1,))
    wide = replace(SPHERE, roughness=replace(ROUGH, rms_height=1e10))
    with pytest.raises(SolveError, match=r"contact may take \d\.\de\+09 pixels of 1e-05 m, more than 67108864"):
        solve_profiles([wide], [POINTS], seeds=(1,))


@pytest.mark.parametrize(("points", "shortest", "least"), [(3, None, 4), (199, 1e-4, 200)])
def test_roughness_that_is_not_resolved_is_refused(points, shortest, least):
    scene = replace(CONE, roughness=replace(ROUGH, shortest=shortest))
    with pytest.raises(ValueError, match=rf"points = {points} .* at least {least}"):
        solve_profiles([scene], [points], seeds=(1,))


@pytest.mark.parametrize(
    "scene",
    [
        replace(CONE, motion=Slide(speed=1.0, depth=1e-4)),
        replace(CONE, motion=Indent(load=1.0)),
        replace(CONE, roughness=None),
        replace(CONE, elastomer=StandardLinearSolid(1e6, 1e7, 1e-3)),
    ],
)
def test_other_scenes_are_refused_by_name(scene):
    refused("take MDR for any other scene", solve_profiles, [scene], [POINTS], error=ValueError, seeds=(1,))
