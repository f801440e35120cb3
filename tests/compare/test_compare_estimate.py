"""Answers of `trust` themselves: their intervals hold what BEM finds, and the way they were found is said."""

from dataclasses import replace
from math import isnan

import numpy as np
import pytest

from bem3d import BEM
from compare import FrictionLaw
from compare.library.case import Case
from compare.models.law.extended import without
from compare.models.law.parts import LawParts
from compare.studies.comparison.around import Around
from compare.trustmap.verdict import trust
from scene import Indent, Kelvin, Layer, Prony, Scene, SelfAffine, Slide, Sphere, Table, Tabulated

SOLID = Kelvin(1e6, 1e-3)
ROUGH = SelfAffine(hurst=0.7, rms_height=5e-6, longest=1e-3, shortest=1e-4, seed=2)
SCENE = Scene(Sphere(10e-3), SOLID, Slide(speed=0.1, load=1.0), ROUGH)
FINE = replace(ROUGH, shortest=1e-7)


def answers(scene):
    return {each.quantity: each for each in trust(scene).estimates}


@pytest.mark.parametrize(
    "motion",
    [Slide(speed=0.1, load=1.0), Slide(speed=0.01, load=0.1), Slide(speed=0.1, depth=5e-5), Indent(load=1.0)],
)
@pytest.mark.parametrize("rough", [ROUGH, None])
def test_intervals_hold_what_a_fine_grid_finds(motion, rough):
    scene = replace(SCENE, motion=motion, roughness=rough)
    solved, found = BEM(points=192).solve(scene), answers(scene)
    expected = {"force" if motion.pressed_by == "depth" else "depth"}
    expected |= {"friction"} if solved.friction_coefficient else set()
    truth = {"friction": solved.friction_coefficient, "depth": solved.depth, "force": solved.normal_force}
    assert set(found) == expected
    for name, each in found.items():
        room = 0.03 * each.value if rough and name == "friction" else 0.0  # a mean over surfaces, and one of them
        assert each.low - room <= truth[name] <= each.high + room, (name, each)


def test_friction_is_that_of_the_law_and_says_whether_the_map_knows_it():
    for scene, words in (
        (SCENE, "with the ratio of the trust map"),
        (replace(SCENE, roughness=FINE), "off the trust map"),
    ):
        found, law = answers(scene)["friction"], FrictionLaw().solve(scene)
        assert found.value == law.friction_coefficient
        assert (found.low, found.high) == (law.measures["friction_low"], law.measures["friction_high"])
        assert words in str(trust(scene))


def test_of_what_no_contact_was_tested_the_interval_is_wide_and_says_why():
    light = replace(SCENE, motion=Slide(speed=0.1, load=1e-9), roughness=FINE)
    found = answers(light)["friction"]
    assert found.high > 8 * found.low
    assert "no contact like it was tested" in found.way
    height = FINE.rms_height
    assert answers(light)["depth"].high - answers(light)["depth"].low == pytest.approx(6 * height)
    assert answers(replace(SCENE, layer=Layer(thickness=1e-3))) == {}


def test_beyond_full_contact_nothing_changes_and_the_interval_is_that_of_nearly_full_ones():
    full, nearly = (replace(SCENE, roughness=replace(FINE, rms_height=height)) for height in (1e-12, 1e-10))
    assert FrictionLaw().solve(full).measures["pressure_ratio"] > 20
    found, expected = (answers(scene)["friction"] for scene in (full, nearly))
    assert found.high / found.low == pytest.approx(expected.high / expected.low)


def test_a_spectrum_that_goes_on_to_waves_half_as_short_is_cut_back_to_itself():
    finer = without(SCENE, ROUGH.shortest / 2).roughness
    cut = without(replace(SCENE, roughness=finer), ROUGH.shortest).roughness
    assert finer.shortest == ROUGH.shortest / 2
    more, own = (LawParts.of(replace(SCENE, roughness=each)).friction_coefficient for each in (finer, ROUGH))
    assert trust(SCENE).finer == more / own - 1 > 0
    assert isnan(trust(replace(SCENE, roughness=None)).finer)
    assert cut.rms_height == pytest.approx(ROUGH.rms_height, rel=1e-12)


def test_waves_that_the_grid_cannot_hold_are_left_to_the_law():
    case = Case(indenter=SCENE.indenter, elastomer=SOLID, motion=SCENE.motion, roughness=ROUGH)

    def models(*given, **changed):
        return set(Around("own", replace(case, **changed), *given).models.labels)

    both = {"MDR", "BEM"}
    assert models() == both
    fine = Around("fine", replace(case, roughness=FINE))
    assert set(fine.models.labels) == {"FrictionLaw", fine.models.reference} == {"FrictionLaw", "ExtendedBEM"}
    assert any("left to the law" in each for each in fine.remarks)
    more = Around("more", replace(case, roughness=FINE, bem=BEM(points=512)))
    assert [each.models["ExtendedBEM"].solver.points for each in (fine, more)] == [256, 512]
    assert models(roughness=FINE, bem=BEM(extent=1e-5)) == both  # which says that the grid is too narrow
    assert models(("mdr", "law")) == {"MDR", "FrictionLaw"}


def test_beyond_a_table_of_moduli_friction_is_at_least_that_of_the_waves_it_covers():
    solid = Prony(equilibrium_modulus=4e5, moduli=(4e5, 2e6, 8e6), relaxation_times=(1e-2, 1e-4, 1e-6))
    truth = answers(replace(SCENE, elastomer=solid))["friction"]
    assert not truth.least
    frequency = np.geomspace(1.0, 1e3, 30)
    moduli = solid.complex_modulus(frequency)
    table = Table(tuple(frequency), tuple(moduli.real), tuple(moduli.imag))
    cut = Tabulated(
        table=table, frequency_unit="rad/s", kind="shear", equilibrium_modulus=solid.equilibrium_modulus
    )
    found = answers(replace(SCENE, elastomer=cut))["friction"]
    assert found.least
    assert str(found).startswith("friction at least ")
    assert found.value < truth.value
    assert not answers(replace(SCENE, elastomer=replace(cut, extrapolate=True)))["friction"].least
