"""A scorecard finds what is wrong with a model, by the law that names it, and lets pass what is right."""

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pandas
import pytest

import compare
from bem3d import BEM
from compare.models.table import model_of
from compare.studies.verify.law import SECTIONS
from compare.studies.verify.study import LEFT_OUT, SHOWN, Verify, every_law
from mdr1d import MDR
from scene import Indent, Refused, Result, Scene, SolveError
from scene.indenter import Axisymmetric
from scene.reading import InvalidInput
from scene.scales import elastic_contact

COARSE = BEM(points=64, tolerance=1e-7)
# Laws of a few contacts each, of every section that a smooth sphere has.
FEW = (
    "sphere.force",
    "sphere.depth",
    "slow.sphere.kelvin",
    "slow.sphere.standard-linear",
    "coulomb",
    "scale.modulus.sliding",
    "same.rest",
    "same.sliding",
    "load.sliding",
    "rises.depth",
    "seed",
    "rest.elastic-at-nu-0.3",
    "friction.opposes",
    "friction.lossless",
    "limit.fast",
    "order.sphere",
)


def test_the_stored_scorecard_has_each_law_in_the_words_of_today():
    stored = pandas.read_csv(Path(__file__).parents[2] / "docs" / "results" / "verify.csv")
    said = {(f"verify.{law.id}", law.sentence) for law in every_law()}
    assert {*zip(stored["claim"], stored["sentence"], strict=True)} <= said


DRAW = np.random.default_rng(1)


def lost(result):
    """No answer."""
    raise SolveError("it went astray")


# What is wrong with a model, by what it makes of a result, or of a scene before.
RESULTS = {
    "friction of the wrong sign": lambda it: replace(it, friction_force=-it.friction_force),
    "a force that is two percent too high": lambda it: replace(it, normal_force=1.02 * it.normal_force),
    "friction of one dimension": lambda it: replace(it, friction_force=2 * it.friction_force),
    "another answer at every call": lambda it: replace(
        it, normal_force=it.normal_force * (1 + 1e-12 * DRAW.random())
    ),
    "a pascal too much over a square centimetre": lambda it: replace(it, normal_force=it.normal_force + 1e-4),
    "an error that no finer grid takes away": lambda it: replace(it, normal_force=1.005 * it.normal_force),
    "no measures": lambda it: replace(it, measures={}),
    "no answer": lost,
}
SCENES = {
    "roughness is not looked at": {"roughness": None},
    "friction of the interface is not looked at": {"interface": None},
}


@dataclass(frozen=True)
class Broken:
    """A model that answers as another one but for one thing, without refusals of its own."""

    wrong: str = ""
    points: int = 64
    name = "broken"

    def solve(self, scene):
        taken = replace(scene, **SCENES.get(self.wrong, {}))
        if self.wrong == INCOMPRESSIBLE:
            taken = replace(taken, elastomer=replace(taken.elastomer, poisson_ratio=0.5))
        return RESULTS.get(self.wrong, lambda it: it)(replace(COARSE, points=self.points).solve(taken))


INCOMPRESSIBLE = "Poisson's ratio is not looked at"


@dataclass(frozen=True)
class Hertz:
    """A model of a few lines: smooth bodies at rest, refused in `solve` where they are not."""

    name = "Hertz"
    draws = "none"

    def solve(self, scene):
        plain = isinstance(scene.motion, Indent) and isinstance(scene.indenter, Axisymmetric)
        if not plain or scene.parts.keys() - {"indenter", "elastomer", "motion"}:
            raise Refused("only smooth bodies of revolution at rest")
        contact = elastic_contact(scene)
        area = {"contact_area": np.pi * contact.radius**2}
        return Result(scene, self.name, {}, contact.load, contact.depth, 0.0, 0.0, 0.0, 0.0, measures=area)


def judged(model, names=FEW):
    """A study of some laws, or of all, and its findings by the names of the laws; solved here, without workers."""
    study = Verify.of(model, [law for law in every_law() if names is None or law.id in names])
    outcomes = {task: task.solve() for batch in study.batches() for task in batch.tasks}
    findings = study.judge(study.answers(outcomes)).findings
    return study, {each.claim.id.removeprefix("verify."): each for each in findings}


def failed(findings):
    return {name for name, each in findings.items() if each.verdict == "fails"}


@pytest.mark.parametrize(
    ("wrong", "laws"),
    [
        ("friction of the wrong sign", {"friction.opposes", "slow.sphere.kelvin", "slow.sphere.standard-linear"}),
        ("a force that is two percent too high", {"sphere.force", "load.sliding"}),
        ("friction of one dimension", {"slow.sphere.kelvin", "slow.sphere.standard-linear"}),
        ("another answer at every call", {"same.rest", "same.sliding"}),
        ("a pascal too much over a square centimetre", {"scale.modulus.sliding", "load.sliding"}),
        ("roughness is not looked at", {"seed"}),
        (INCOMPRESSIBLE, {"rest.elastic-at-nu-0.3"}),
        ("friction of the interface is not looked at", {"coulomb"}),
        ("an error that no finer grid takes away", {"order.sphere", "load.sliding"}),
    ],
)
def test_what_is_broken_fails_the_laws_that_name_it(wrong, laws):
    study, found = judged(Broken(wrong))
    assert laws <= failed(found)
    assert study.failed(found.values())
    # Nothing else fails but what the same number enters.
    touched = {"coulomb", "rest.elastic-at-nu-0.3"} | {
        name for name in FEW if name.split(".")[0] in ("sphere", "slow", "order", "limit")
    }
    assert failed(found) - laws <= touched


@pytest.mark.parametrize("model", [COARSE, Broken(), MDR(points=1000)], ids=["BEM", "without refusals", "MDR"])
def test_what_is_right_holds_all_of_them(model):
    study, found = judged(model)
    assert failed(found) == set()
    assert not study.failed(found.values())


def test_a_model_of_a_few_lines_holds_its_laws_and_leaves_out_what_it_refuses():
    study, found = judged(Hertz(), None)
    assert failed(found) == set()
    held = {name for name, each in found.items() if each.verdict == "holds"}
    assert {"sphere.force", "cone.depth", "sphere.area", "rises.load"} <= held
    assert found["coulomb"].reason == f"{LEFT_OUT}: only smooth bodies of revolution at rest"
    assert found["wave.gap.0.5"].reason == f"{LEFT_OUT}: the model draws no surfaces"
    assert found["order.sphere"].reason.endswith("no field points to refine")
    assert "sphere.length" not in found  # of one dimension
    told = study._answer(list(found.values()))[0]
    assert told.startswith(f"Hertz as a model in 3D: {len(held)} of {len(found)} laws hold, 0 fail")


def test_a_measure_that_a_model_does_not_give_is_left_out():
    _, found = judged(Broken("no measures"), ("sphere.area", "sphere.force"))
    area = found["sphere.area"]
    assert (area.verdict, area.reason) == ("reported", f"{LEFT_OUT}: the model does not give contact_area")
    assert found["sphere.force"].verdict == "holds"


def test_a_solve_without_an_answer_fails_its_law():
    study, found = judged(Broken("no answer"), ("sphere.force",))
    assert found["sphere.force"].verdict == "fails"
    assert found["sphere.force"].reason == "no answer: it went astray"
    assert "sphere.force fails" in study._answer(list(found.values()))[1]


def test_laws_have_names_of_their_own_sources_and_sections():
    for dimension in ("1D", "3D"):
        laws = [law for law in every_law() if dimension in law.kinds]
        names = [law.id for law in laws]
        assert len(set(names)) == len(names)
        assert {law.section for law in laws} == set(SECTIONS)
        assert 60 <= len(laws) <= 120
        assert all(law.bound.source and law.sentence[-1] != "." for law in laws)
        assert all(isinstance(scene, Scene) for law in laws for scene in law.scenes)


def test_a_page_has_few_laws_and_its_tables_have_all(tmp_path):
    report = compare.verify(MDR(points=500), tmp_path, workers=1)
    tables = dict(report.page.tables())
    sections = tables["sections"]
    assert sections[["holds", "fails", LEFT_OUT]].to_numpy().sum() == len(tables["laws"]) == len(report.findings)
    shown = sum(len(tables.get(each.replace(" ", "-"), ())) for each in sections["section"])
    assert 0 < shown <= SHOWN
    assert len(tables["work-precision"]) == 18
    assert (tmp_path / "verify.png").exists()
    assert not report.failed
    again = compare.verify(MDR(points=500), tmp_path, workers=1, report=False)
    assert (again.swept.solved, again.swept.reused) == (0, report.swept.solved)


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        ("mdr2", "no model of that name"),
        ("no_such_module:Model", "No module named 'no_such_module'"),
        ("bem3d:Nothing", "has no attribute 'Nothing'"),
        ("scene:Scene", "cannot be made without settings"),
        ("scene.motion:UNITS", "frozen dataclass"),
        ("bem3d:Trail", "frozen dataclass"),
    ],
)
def test_what_is_no_model_is_told_in_a_line(asked, said):
    with pytest.raises(InvalidInput, match=said) as told:
        model_of(asked)
    assert "\n" not in str(told.value)


def test_models_are_found_by_name_as_class_and_as_object():
    assert model_of("MDR") == model_of("mdr1d:MDR") == model_of(MDR) == model_of(MDR())
    assert model_of(COARSE).solver is COARSE
    assert [model_of(each).dimension for each in (MDR(), BEM(), Hertz())] == ["1D", "3D", "3D"]
    assert [model_of(each).draws for each in (MDR(), BEM(), Hertz())] == ["profiles", "surfaces", "none"]


@pytest.mark.slow
def test_bem_holds_all_of_its_laws(tmp_path):
    report = compare.verify(BEM(points=128), tmp_path, report=False)
    assert set(report.findings["verdict"]) == {"holds"}
