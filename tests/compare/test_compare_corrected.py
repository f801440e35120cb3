"""The corrected 1D model: means over profiles over the ratio of the trust map, and no answer where it has none."""

from dataclasses import replace
from math import isnan, log, nan

import numpy as np
import pytest
from drawn_scenes import PAPER

from compare import CorrectedMDR
from compare.solving import vocabulary
from compare.solving.task import SceneTask, draws_of
from compare.statistics.intervals import student
from compare.trustmap import corrected
from compare.trustmap.verdict import Advice, Correction, trust
from mdr1d import MDR
from scene import (
    Elastic,
    EmptyContact,
    Indent,
    Plane,
    Refused,
    SelfAffine,
    Slide,
    SolveError,
)

WAVES = SelfAffine(hurst=0.5, rms_height=1e-5, longest=4e-3, shortest=4e-4, seed=3)
ROUGH = replace(PAPER, roughness=WAVES)
AT_DEPTH = replace(ROUGH, motion=Slide(speed=0.1, depth=1.5e-4))
by_load_and_depth = pytest.mark.parametrize("scene", [ROUGH, AT_DEPTH], ids=["load", "depth"])
FEW = CorrectedMDR(MDR(points=1000), profiles=8)
# Sums in another order.
ROUNDING = 1e-12
WORTH = Correction("MDR", 2.0, 1.9, 2.1, 1.5, 2.5, "multiply", "Made up.")


@pytest.fixture
def worth(monkeypatch):
    """A map that predicts a ratio of two of everything, and counts how often it is asked."""
    asked = []

    def predicted(scene):
        asked.append(scene)
        friction = WORTH if getattr(scene.motion, "speed", 0.0) else None
        return Advice(friction, *_free(scene, WORTH), None, {}, ())

    monkeypatch.setattr(corrected, "trust", predicted)
    return asked


def _free(scene, worth):
    """Correction of depth and of force: of the one that is not prescribed."""
    return (worth, None) if scene.motion.load is not None else (None, worth)


def rms(values):
    return np.sqrt(np.mean(np.square(values)))


def profiles_of(scene, solver=FEW):
    """Results of each profile."""
    return [solver.mdr.solve(each) for each in draws_of(scene, solver.profiles)]


@by_load_and_depth
def test_what_is_prescribed_stays_and_all_else_is_its_mean_over_the_ratio(scene):
    found, drawn, corrections = FEW.solve(scene), profiles_of(scene), trust(scene).of_model("MDR")
    given, free, name = (
        ("normal_force", "depth", "depth") if scene is ROUGH else ("depth", "normal_force", "force")
    )
    assert getattr(found, given) == scene.motion.greatest
    assert set(corrections) == {"friction", name}

    def mean(number):
        return np.mean([getattr(each, number) for each in drawn])

    ratios = {
        "friction": mean("friction_force") / mean("normal_force") / found.friction_coefficient,
        name: mean(free) / getattr(found, free),
    }
    for quantity, ratio in ratios.items():
        assert ratio == pytest.approx(corrections[quantity].ratio, rel=ROUNDING)
        assert found.measures[f"{quantity}_ratio"] == corrections[quantity].ratio


def test_at_rest_and_in_an_elastic_solid_there_is_no_friction():
    for scene in (replace(ROUGH, motion=Indent(load=1.0)), replace(ROUGH, elastomer=Elastic(modulus=1e6))):
        found = FEW.solve(scene)
        assert found.friction_force == 0.0
        assert found.depth > 0
        assert not any(name.startswith("friction") for name in found.measures)


def test_an_interval_holds_its_value_and_is_wider_for_fewer_profiles_and_for_one_surface(worth):
    widths = []
    for count in (2, 8, 32):
        found = replace(FEW, profiles=count).solve(ROUGH)
        value, ends = found.friction_coefficient, found.measures
        low, high, surface_low, surface_high = (
            ends[f"friction_{end}"] for end in ("low", "high", "surface_low", "surface_high")
        )
        assert surface_low < low < value < high < surface_high
        widths.append(log(high / low))
    assert widths == sorted(widths, reverse=True)
    # Never narrower than the interval of the map.
    assert widths[-1] > log(WORTH.high / WORTH.low)
    assert isnan(replace(FEW, profiles=1).solve(ROUGH).measures["friction_low"])


def test_where_one_surface_says_nothing_its_interval_has_no_ends_and_the_mean_s_has(monkeypatch):
    silent = Advice(replace(WORTH, surface_low=nan, surface_high=nan), WORTH, None, None, {}, ())
    monkeypatch.setattr(corrected, "trust", lambda scene: silent)
    ends = FEW.solve(ROUGH).measures
    assert isnan(ends["friction_surface_low"] + ends["friction_surface_high"])
    assert ends["friction_low"] < ends["friction_high"]


@by_load_and_depth
def test_the_part_of_the_profiles_in_an_interval_is_what_means_of_them_scatter_by(scene, monkeypatch):
    """60 means of eight, the ratio exact; allowed: three deviations of an rms of 60 numbers, 3/sqrt(2 * 59)."""
    exact = replace(WORTH, low=WORTH.ratio, high=WORTH.ratio)
    monkeypatch.setattr(corrected, "trust", lambda _: Advice(exact, *_free(scene, exact), None, {}, ()))
    seeds = (replace(scene.roughness, seed=FEW.profiles * k) for k in range(60))
    found = [FEW.solve(replace(scene, roughness=each)) for each in seeds]
    logarithms = np.log([each.friction_coefficient for each in found])
    halves = [log(each.measures["friction_high"] / each.friction_coefficient) for each in found]
    assert rms(halves) / student(0.95, FEW.profiles - 1) == pytest.approx(logarithms.std(ddof=1), rel=0.28)


def test_a_profile_that_touches_nothing_counts_as_a_force_of_zero(worth):
    barely = replace(ROUGH, motion=Indent(depth=1e-6), roughness=replace(WAVES, rms_height=2e-6))
    rows = SceneTask(FEW.mdr, draws_of(barely, FEW.profiles)).solve().rows
    forces = [row.normal_force for row in rows]
    assert 0 < sum(force == 0 for force in forces) < len(forces)
    assert FEW.solve(barely).normal_force == pytest.approx(np.mean(forces) / WORTH.ratio, rel=ROUNDING)
    clear = replace(barely.roughness, seed=barely.roughness.seed + forces.index(0.0))
    with pytest.raises(EmptyContact, match="none of 1 profiles"):
        replace(FEW, profiles=1).solve(replace(barely, roughness=clear))


def test_off_the_map_there_is_no_answer_but_the_reason():
    steep = replace(ROUGH, roughness=replace(WAVES, shortest=2e-6))
    with pytest.raises(SolveError, match=r"Off the map: .*a/λ_c"):
        CorrectedMDR().solve(steep)


@pytest.mark.parametrize(
    "scene",
    [
        replace(ROUGH, indenter=Plane(), motion=Slide(speed=0.1, pressure=1e3)),
        replace(ROUGH, roughness=replace(WAVES, shortest=None)),
        replace(ROUGH, roughness=replace(WAVES, shortest=1e-7)),
    ],
    ids=["never measured", "no cut-off", "not resolved"],
)
def test_what_is_refused_is_refused_before_anything_is_solved(scene, worth):
    assert FEW.refusals(scene)
    with pytest.raises(Refused):
        FEW.solve(scene)
    assert not worth


def test_a_mean_without_every_profile_is_an_error(worth):
    with pytest.raises(SolveError, match="8 of 8 profiles"):
        replace(FEW, mdr=MDR(points=1000, extent=1.1e-3)).solve(ROUGH)


def test_a_mean_depth_below_zero_is_not_known_and_friction_is(worth):
    high = replace(ROUGH, motion=Slide(speed=0.1, load=1e-3), roughness=replace(WAVES, rms_height=1e-4))
    found = FEW.solve(high)
    drawn = profiles_of(high)
    assert sum(each.depth for each in drawn) < 0
    assert isnan(found.depth)
    assert isnan(found.measures["depth_low"])
    assert found.friction_coefficient == pytest.approx(
        sum(each.friction_force for each in drawn) / sum(each.normal_force for each in drawn) / 2, rel=ROUNDING
    )
    with pytest.raises(SolveError, match="no ratio corrects it"):
        FEW.solve(replace(high, motion=Indent(load=1e-3)))


def test_costs_are_those_of_every_profile():
    first, drawn = FEW.solve(ROUGH), profiles_of(ROUGH)
    assert first.operator_applications == sum(each.operator_applications for each in drawn)
    assert first.residual == max(each.residual for each in drawn)
    assert first.settings["profiles"] == FEW.profiles
    assert FEW.solve(replace(ROUGH, roughness=None)).settings["profiles"] == 1


def test_every_measure_has_a_unit_and_a_meaning():
    units = {"friction": "1", "depth": "m", "force": "N"}
    for scene in (ROUGH, AT_DEPTH):
        for name in FEW.solve(scene).measures:
            entry = vocabulary.entry(name)
            assert entry.unit == ("1" if name.endswith("_ratio") else units[name.partition("_")[0]])
            assert ("Of a single surface" in entry.text) == ("surface" in name)
