"""Boundary elements on the waves of a grid, and the law for the others."""

from dataclasses import replace
from math import exp, inf

import numpy as np
import pytest

from bem3d import BEM
from bem3d.surface import RoughSurface
from compare import FrictionLaw, run
from compare.library.case import Variations
from compare.library.lookup import case_of
from compare.models.law.extended import LEARNED, ExtendedBEM, excess, without
from compare.models.law.parts import LawParts
from scene import (
    Indent,
    InvalidInput,
    Plane,
    Scene,
    SelfAffine,
    Slide,
    Spectrum,
    Sphere,
    StandardLinearSolid,
    Topography,
)

SOLID = StandardLinearSolid(1e6, 1e8, 1e-5)
ROUGH = SelfAffine(hurst=0.8, rms_height=5e-6, longest=1e-3, shortest=1e-4, seed=3)
SCENE = Scene(Sphere(10e-3), SOLID, Slide(speed=0.1, load=1.0), ROUGH)


def table(rough, **given):
    q = np.geomspace(rough.q_min, rough.q_max(0.0), 60) * (1 - 1e-12)
    q[0] = rough.q_min
    return Spectrum(q=q, C2D=rough.density_2d(q, rough.q_max(0.0)), convention="persson", seed=rough.seed, **given)


@pytest.mark.parametrize("motion", [Slide(speed=0.1, load=1.0), Slide(speed=0.1, depth=1e-4)])
def test_friction_is_that_of_the_waves_kept_and_what_the_law_says_of_the_others(motion):
    scene = replace(SCENE, motion=motion)
    found = ExtendedBEM(points=160).solve(scene)
    kept, measures = without(scene, found.measures["shortest_kept"]), found.measures
    bem = BEM(points=160).solve(kept)
    assert measures["friction_kept"] == bem.friction_coefficient
    under = [replace(each, motion=Slide(speed=0.1, load=bem.normal_force)) for each in (scene, kept)]
    whole, own = map(LawParts.of, under)  # one octave apart at most
    added = (whole.friction_coefficient - own.friction_coefficient) * exp(-excess(whole, SOLID))
    assert measures["friction_added"] == pytest.approx(added, rel=1e-12)
    assert found.friction_coefficient == pytest.approx(bem.friction_coefficient + added, rel=1e-12)
    assert (found.normal_force, found.depth) == (bem.normal_force, bem.depth)
    assert 0 < measures["slope_kept"] < 1


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::scene.Doubtful")
def test_a_run_of_waves_that_hardly_any_grid_holds_ends_with_an_answer(tmp_path):
    rough = replace(ROUGH, longest=3e-4, shortest=1e-6)
    few = Variations(speeds=(0.03, 0.1), pressing=(1.0, 2.0), load_speeds=(0.1,), depths=(1.0,), interval=0.5)
    found = run(replace(case_of(replace(SCENE, roughness=rough)), study=few), output=tmp_path, workers=1)
    assert not found.unsolved.failed
    # coarse grids keep no wave, and the infinite length has no mean
    assert np.isinf(found.answers["scene/own"]["shortest_kept"].sel(model="ExtendedBEM")).any()


def test_points_are_doubled_until_the_interval_is_as_narrow_as_wanted():
    scene = replace(SCENE, roughness=replace(ROUGH, shortest=5e-5))
    few, more = (ExtendedBEM(points=each).solve(scene) for each in (64, 128))
    wide, narrow = (each.measures["friction_high"] / each.friction_coefficient - 1 for each in (few, more))
    assert narrow < 0.95 * wide
    for accuracy, expected in (((narrow + wide) / 2, more), (1.01 * wide, few)):
        found = ExtendedBEM(points=64, accuracy=accuracy).solve(scene)
        assert (found.friction_force, found.measures) == (expected.friction_force, expected.measures)
    with pytest.raises(InvalidInput, match="accuracy = 2"):
        ExtendedBEM(accuracy=2.0)


def test_waves_that_are_left_to_the_law_take_no_friction_away():
    fast = replace(SCENE, motion=Slide(speed=100.0, load=1.0), roughness=replace(ROUGH, shortest=5e-5))
    found = ExtendedBEM(points=64).solve(fast)
    kept = without(fast, found.measures["shortest_kept"])
    whole, own = (LawParts.of(each).friction_coefficient for each in (fast, kept))
    assert whole < own
    assert found.measures["friction_added"] == 0.0
    assert found.friction_coefficient == found.measures["friction_kept"]


def rectangle(rough):
    """A map of the roughness, of sides that are not alike."""
    x, y = (2.5e-5 * np.arange(count) for count in (48, 64))
    return Topography(heights=RoughSurface.of(rough, rough.q_max(0.0)).heights(x, y), pixel=2.5e-5)


@pytest.mark.parametrize("rough", [ROUGH, replace(ROUGH, rolloff=2e-4), table(ROUGH), rectangle(ROUGH)])
def test_friction_with_few_of_the_waves_is_near_that_with_all_and_within_its_interval(rough):
    scene = replace(SCENE, roughness=rough)
    found, every = ExtendedBEM(points=160).solve(scene), BEM(points=640).solve(scene).friction_coefficient
    low, kept, high = (found.measures[f"friction_{name}"] for name in ("low", "kept", "high"))
    assert kept < 0.95 * every
    assert low < every < high < 1.3 * low
    # Four surfaces with a roll-off are off by -1 to 10 %: the interval alone bounds them.
    assert getattr(rough, "rolloff", None) or found.friction_coefficient == pytest.approx(every, rel=0.04)


def test_the_waves_that_are_kept_stand_as_they_were():
    fewer = without(SCENE, 3e-4).roughness
    q = np.array([ROUGH.q_min * 1.5, 2 * np.pi / 3.1e-4])
    np.testing.assert_allclose(
        fewer.density_2d(q, fewer.q_max(0.0)), ROUGH.density_2d(q, ROUGH.q_max(0.0)), rtol=1e-12
    )
    assert fewer.seed == ROUGH.seed


def test_surfaces_finer_than_any_grid_and_coarser_than_few_points():
    fine = replace(ROUGH, shortest=1e-8)
    coarse, finer = (ExtendedBEM(points=each).solve(replace(SCENE, roughness=fine)) for each in (160, 320))
    assert coarse.friction_coefficient == pytest.approx(finer.friction_coefficient, rel=0.05)


def test_where_no_wave_is_kept_it_is_the_law_with_its_interval():
    scene = replace(SCENE, roughness=replace(ROUGH, longest=2e-4, shortest=1e-8))
    none, law = (each.solve(scene) for each in (ExtendedBEM(points=64), FrictionLaw()))
    smooth = BEM(points=64).solve(replace(scene, roughness=None))
    assert (none.measures["shortest_kept"], none.measures["friction_kept"]) == (inf, smooth.friction_coefficient)
    assert law.measures["outside"]
    for name in ("friction_low", "friction_high"):
        relative = law.measures[name] / law.friction_coefficient
        assert none.measures[name] / none.friction_coefficient == pytest.approx(relative, rel=1e-12)


def test_the_correction_is_that_of_light_contacts_and_stays_where_it_was_learned():
    heavy, light = (LawParts.of(replace(SCENE, motion=Slide(speed=0.1, load=load))) for load in (1e6, 1e-2))
    assert abs(excess(heavy, SOLID)) < 0.1 * abs(excess(light, SOLID))
    steep = replace(light, waves=replace(light.waves, harder=1e3))
    assert excess(steep, SOLID) == LEARNED[1]


def test_planes_are_solved_on_their_longest_waves():
    fine = replace(ROUGH, longest=4e-4, shortest=2e-5)
    scene = Scene(Plane(), SOLID, Slide(speed=0.1, pressure=1e5), fine)
    found, every = ExtendedBEM(points=64).solve(scene), BEM(points=256).solve(scene)
    assert found.measures["shortest_kept"] == pytest.approx(8 * fine.longest / 64)
    assert found.measures["friction_low"] < every.friction_coefficient < found.measures["friction_high"]


@pytest.mark.parametrize("changed", [{}, {"roughness": None}, {"motion": Indent(load=1.0)}])
def test_where_the_grid_holds_every_wave_and_without_friction_of_waves_the_answer_is_that_of_bem(changed):
    scene = replace(SCENE, **changed)
    found, bem = (solver.solve(scene) for solver in (ExtendedBEM(points=512), BEM(points=512)))
    assert (found.friction_force, found.measures) == (bem.friction_force, bem.measures)
