"""The table of laws: solvers keep it, a model that is wrong fails the laws that name what is wrong."""

from dataclasses import dataclass, replace
from math import isfinite, nan
from pathlib import Path

import numpy as np
import pandas
import pytest
from imports import ROOT
from small_cases import TINY

import compare
from bem3d import BEM
from compare.models.table import model_of
from compare.report.page import Findings
from compare.solving.task import Outcome, Row
from compare.statistics.finding import FAILS, HOLDS, REPORTED, UNDECIDED
from compare.studies.checks import stored
from compare.studies.checks.hardcase import SIZES
from compare.studies.checks.law import GROUPS, STORED
from compare.studies.checks.study import LEFT_OUT, SHOWN, Checks, Examination, Regress, table
from mdr1d import MDR
from scene import Indent, Refused, Result, SolveError
from scene.files.reading import InvalidInput
from scene.indenter import Axisymmetric
from scene.scales import elastic_contact

COARSE, LINE = BEM(points=64, tolerance=1e-7), MDR(points=1000)
QUICK = SIZES["quick"]
# Laws of a few contacts each, of every group that a smooth sphere has.
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
    "rises.load",
    "seed",
    "rest.elastic-at-nu-0.3",
    "friction.opposes",
    "friction.lossless",
    "order.sphere",
)
# Of bodies, waves, lines and motions that no other quick test holds.
MORE = {
    *("cone.force", "r^4.depth", "sphere.area", "crossed.fraction.0.3", "line.depth", "line.hunter.1"),
    *("full.wave.0.1", "mindlin.sphere.0.5", "history.withdrawn.cone", "history.creep"),
}
# Hard cases that cost little, one of each kind of law; the command and the slow tests examine all.
SAMPLE = {
    *("speed-to-zero", "all-but-no-glass-1d", "peaks", "force-rises-with-depth", "shapes-beyond-sense"),
    *("other-units", "stages-without-end", "height-zero", "named-and-general", "times-and-speeds-without-end"),
}


def asked():
    """Every law with each model that pytest asks."""
    for law in table().values():
        if law.group == STORED:
            models, quick = [LINE], law.id.split(".")[0] in ("foundation", "withdrawal", "law")
        elif law.solvers:
            models, quick = [build(QUICK) for build in law.solvers], law.id in SAMPLE
        else:
            models = [model for model in (LINE, COARSE) if model_of(model).dimension in law.kinds]
            quick = law.id in FEW or law.id in MORE
        marks = () if quick else pytest.mark.slow
        for number, model in enumerate(models):
            yield pytest.param(Examination.of(law, model), marks=marks, id=f"{law.id}-{model.name}-{number}")


@pytest.mark.parametrize("task", list(asked()))
def test_a_law_is_kept(task):
    # bounds are those of each law, with where they come from
    (row,) = task.solve().rows
    assert row.reason is None
    assert abs(row.measures["misfit"] - task.law.expected) <= row.measures["bound"], task.law.bound.source


def test_laws_have_names_of_their_own_groups_and_sources():
    laws = table().values()
    assert {law.group for law in laws} == set(GROUPS)
    assert table().keys() >= SAMPLE
    assert KNOWN.keys() == {law.id for law in laws if law.group == STORED}
    assert all(law.bound.source and law.sentence and law.sentence[-1] != "." for law in laws)
    sentences = [law.sentence for law in laws if not law.id.startswith("hard.")]
    assert len(set(sentences)) == len(sentences)


def test_the_stored_scorecard_has_each_law_in_the_words_of_today():
    found = pandas.read_csv(ROOT / "docs" / "results" / "verify.csv")
    known = {(f"verify.{law.id}", law.sentence, law.group) for law in table().values()}
    assert {*zip(found["claim"], found["sentence"], found["where"], strict=True)} <= known


DRAW = np.random.default_rng(1)


def lost(result):
    """No answer."""
    raise SolveError("it went astray")


def scaled(number, by):
    """A result with a number of it times a factor."""
    return lambda it: replace(it, **{number: by * getattr(it, number)})


# What is wrong with a model, by what it makes of a result, or of a scene before.
RESULTS = {
    "friction of the wrong sign": scaled("friction_force", -1),
    "a force that is two percent too high": scaled("normal_force", 1.02),
    "friction in 1D": scaled("friction_force", 2),
    "another answer at every call": lambda it: scaled("normal_force", 1 + 1e-12 * DRAW.random())(it),
    "a pascal too much over a square centimetre": lambda it: replace(it, normal_force=it.normal_force + 1e-4),
    "an error that no finer grid takes away": scaled("normal_force", 1.005),
    "no measures": lambda it: replace(it, measures={}),
    "no answer": lost,
    "a depth that is too small": scaled("depth", 0.99),
    # by rounding, and differently in each scene
    "rounding by the scene": lambda it: scaled("normal_force", 1 + 1e-12 * np.log(it.normal_force))(it),
    "force by the words of the scene": lambda it: scaled("normal_force", 1 + 1e-3 * len(repr(it.scene)))(it),
}
SCENES = {
    "roughness is not looked at": {"roughness": None},
    "friction of the interface is not looked at": {"interface": None},
}
INCOMPRESSIBLE = "Poisson's ratio is not looked at"


@dataclass(frozen=True)
class Broken:
    """A model that answers as another one but for one thing, without refusals of its own."""

    wrong: str
    points: int = 64
    name = "broken"

    def solve(self, scene):
        taken = replace(scene, **SCENES.get(self.wrong, {}))
        if self.wrong == INCOMPRESSIBLE:
            taken = replace(taken, elastomer=replace(taken.elastomer, poisson_ratio=0.5))
        return RESULTS.get(self.wrong, lambda it: it)(replace(COARSE, points=self.points).solve(taken))


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
    study = Checks.verify(model)
    study = replace(study, tasks=[task for task in study.tasks if names is None or task.law_id in names])
    answers = study.answers({task: task.solve() for batch in study.batches() for task in batch.tasks})
    return study, {each.claim.id.removeprefix("verify."): each for each in study.judge(answers).findings}


def failed(findings):
    return {name for name, each in findings.items() if each.verdict == FAILS}


@pytest.mark.parametrize(
    ("wrong", "laws"),
    [
        ("friction of the wrong sign", {"friction.opposes", "slow.sphere.kelvin", "slow.sphere.standard-linear"}),
        ("a force that is two percent too high", {"sphere.force", "load.sliding"}),
        ("friction in 1D", {"slow.sphere.kelvin", "slow.sphere.standard-linear"}),
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


@pytest.mark.parametrize(
    ("wrong", "names"),
    [
        ("a force that is two percent too high", ("all-but-no-glass-1d", "shapes-beyond-sense")),
        ("friction of the wrong sign", ("speed-to-zero",)),
        ("a depth that is too small", ("peaks",)),
        ("rounding by the scene", ("other-units",)),
        ("force by the words of the scene", ("named-and-general",)),
    ],
)
def test_a_wrong_answer_breaks_the_hard_case(monkeypatch, wrong, names):
    for solver in (MDR, BEM):
        honest = solver.solve
        monkeypatch.setattr(solver, "solve", lambda self, scene, of=honest: RESULTS[wrong](of(self, scene)))
    for name in names:
        (row,) = Examination.of(table()[name], table()[name].solvers[0](QUICK)).solve().rows
        assert not row.measures["misfit"] <= row.measures["bound"]


def test_a_model_of_a_few_lines_holds_its_laws_and_leaves_out_what_it_refuses():
    study, found = judged(Hertz(), None)
    assert failed(found) == set()
    held = {name for name, each in found.items() if each.verdict == HOLDS}
    assert {"sphere.force", "cone.depth", "sphere.area", "rises.load"} <= held
    assert found["coulomb"].reason == f"{LEFT_OUT}: only smooth bodies of revolution at rest"
    assert found["wave.gap.0.5"].reason == f"{LEFT_OUT}: the model draws no surfaces"
    assert found["order.sphere"].reason.endswith("cannot be asked on a part of its points")
    assert "sphere.length" not in found  # of one dimension
    assert f"{len(held)} of {len(found)} laws hold, 0 fail" in study.answer(list(found.values()))[0]


def test_a_measure_that_a_model_does_not_give_is_left_out_and_a_solve_without_an_answer_fails():
    _, found = judged(Broken("no measures"), ("sphere.area", "sphere.force"))
    area = found["sphere.area"]
    assert (area.verdict, area.reason) == (REPORTED, f"{LEFT_OUT}: the model does not give contact_area")
    assert found["sphere.force"].verdict == HOLDS
    study, found = judged(Broken("no answer"), ("sphere.force",))
    assert (found["sphere.force"].verdict, found["sphere.force"].reason) == (FAILS, "no answer: it went astray")
    assert "sphere.force fails" in study.answer(list(found.values()))[1]


def test_a_page_has_few_laws_and_its_tables_have_all(tmp_path, in_this_process):
    report = compare.verify(MDR(points=500), tmp_path, workers=1)
    (shown,) = report.page.every(Findings)
    assert len(shown.findings) == SHOWN < len(pandas.read_csv(tmp_path / "findings.csv")) == len(report.findings)
    assert not report.failed


def test_hard_cases_are_asked_of_both_solvers_and_those_that_broke_have_failed_each_with_the_reason():
    study = Checks.stability("quick")
    (batch,) = study.batches()
    assert {task.solver.name for task in batch.tasks} == {"MDR", "BEM"}
    assert {task.law_id for task in batch.tasks} == {law.id for law in table().values() if law.solvers}
    outcomes = {task: task.failed("refused: a fault") for task in batch.tasks}
    for task, misfit in zip(batch.tasks, (2.0, 0.0), strict=False):
        outcomes[task] = Outcome((Row(measures={"misfit": misfit, "bound": 1.0}),))
    found = study.judge(study.answers(outcomes)).findings
    assert [each.verdict for each in found[:3]] == [FAILS, HOLDS, FAILS]
    assert [each.reason for each in found[:3]] == ["", "", "no answer: refused: a fault"]
    assert study.answer(found)[0].startswith(f"Hard cases: 1 of {len(found)} laws hold")
    assert "stability.speed-zero fails (MDR, 1000 points): misfit 2, allowed 1" in study.answer(found)[1]
    with pytest.raises(InvalidInput, match="size = small: allowed are quick, standard, full"):
        Checks.stability("small")


# Stored numbers.


def held(values, found, update=False, path=Path("mine.toml")):
    """Study of stored values and its findings by id; found : ratios by id, the others are as they are stored."""
    study = replace(Regress.of(), values=values, update=update, path=path)
    rows = {
        task: Row(measures={"misfit": number, "bound": nan}) if isfinite(number) else Row(reason="it went astray")
        for task in study.tasks
        for number in [found.get(task.law_id, KNOWN[task.law_id])]
    }
    answers = study.answers({task: Outcome((row,)) for task, row in rows.items()})
    findings = study.judge(answers).findings
    return study, {each.claim.id.removeprefix("regress."): each for each in findings}


KNOWN = stored.read_values(stored.SHIPPED)
REST, FIG_4 = "rest.cone.force", "law.cone.1.friction"


@pytest.mark.parametrize(("moved_by", "verdict"), [(0, HOLDS), (0.99, HOLDS), (1.01, FAILS), (-1.01, FAILS)])
def test_a_stored_number_may_move_by_its_tolerance_and_no_further(moved_by, verdict):
    study, found = held(KNOWN, {REST: KNOWN[REST] * (1 + moved_by * stored.tolerance(REST)[0])})
    assert {each.verdict for id, each in found.items() if id != REST} == {HOLDS}
    assert (found[REST].verdict, found[REST].claim.expected) == (verdict, KNOWN[REST])
    assert study.failed(found.values()) == (verdict == FAILS)


def test_what_is_new_or_without_an_answer_is_told_and_the_file_changes_only_where_it_must(tmp_path):
    path = tmp_path / "mine.toml"
    before = {id: value for id, value in KNOWN.items() if id != FIG_4} | {"rest.sphere.force": 0.5}
    ratios = {REST: nan, "rest.quartic.force": KNOWN["rest.quartic.force"] * (1 + 1e-7)}
    stored.write_values(path, before)
    study, found = held(before, ratios, True, path)
    assert (found[FIG_4].verdict, found[FIG_4].reason) == (UNDECIDED, f"{stored.NEW}: {KNOWN[FIG_4]:.10g}")
    assert (found[REST].verdict, found[REST].reason) == (UNDECIDED, "no answer: it went astray")
    assert study.failed(found.values())  # what went astray cannot be stored
    study.store(list(found.values()))
    assert stored.read_values(path) == KNOWN  # a number within its tolerance stays as it was
    changed = path.stat().st_mtime_ns
    study, found = held(KNOWN, ratios, True, path)
    study.store(list(found.values()))
    assert path.stat().st_mtime_ns == changed


def test_the_command_holds_a_scene_of_ones_own_against_a_file_of_ones_own(tmp_path, in_this_process):
    scene, file = replace(TINY, roughness=None, mdr=MDR(points=512)), tmp_path / "mine.toml"

    def failed(**given):
        return compare.regress(file, scene=scene, output=tmp_path / "out", workers=1, report=False, **given).failed

    assert not failed(update=True)
    values = stored.read_values(file)
    assert values.keys() == {f"{TINY.title}.friction", f"{TINY.title}.depth"}
    assert not failed()
    stored.write_values(file, {id: 1.01 * value for id, value in values.items()})
    assert failed()
    with pytest.raises(InvalidInput, match="need a file, name one"):
        compare.regress(scene=scene)


def test_a_broken_file_is_named_and_one_is_begun_only_where_that_is_asked_for(tmp_path):
    path = tmp_path / "baseline.toml"
    assert Regress.of(path, update=True).values == {}
    with pytest.raises(InvalidInput, match=r"baseline\.toml: no such file"):
        Regress.of(path)
    for text, complaint in (("", "values: missing"), ("[values]\nforce = nan", "values.force = nan")):
        path.write_text(text)
        with pytest.raises(InvalidInput, match=rf"baseline\.toml: {complaint}"):
            Regress.of(path, update=True)


@pytest.mark.parametrize(
    ("part", "limit", "bound"),
    [
        # 2, 1 of theory, Eq. 8; the paper's own bound on its law; within what a grid of 128 points leaves
        (r"slide\.(cone|sphere)\..*\.1e-2\.friction", 2, 0.015),
        (r"withdrawal\.", 1, 1e-5),
        (r"foundation\.", 1, 1e-5),
        (r"law\.", 1, 0.05),
        (r"rest\.(cone|sphere|quartic)\.", 1, 1e-4),
    ],
)
def test_the_stored_values_are_what_theory_says_where_it_says_something(part, limit, bound):
    values = pandas.Series(KNOWN).filter(regex=f"^{part}")
    assert len(values) > 2
    assert values.tolist() == pytest.approx([limit] * len(values), rel=bound)


@pytest.mark.parametrize(
    ("asked", "message"),
    [
        ("mdr2", "no model of that name"),
        ("no_such_module:Model", "No module named 'no_such_module'"),
        ("bem3d:Nothing", "has no attribute 'Nothing'"),
        ("scene:Scene", "cannot be made without settings"),
        ("scene.motion:UNITS", "frozen dataclass"),
        ("bem3d:WarmStart", "frozen dataclass"),
    ],
)
def test_what_is_no_model_is_told_in_a_line(asked, message):
    with pytest.raises(InvalidInput, match=message) as caught:
        model_of(asked)
    assert "\n" not in str(caught.value)


def test_models_are_found_by_name_as_class_and_as_object():
    assert model_of("MDR") == model_of("mdr1d:MDR") == model_of(MDR) == model_of(MDR())
    found = [model_of(each) for each in (MDR(), BEM(), Hertz())]
    known = [(each.dimension, each.draws) for each in found]
    assert known == [("1D", "profiles"), ("3D", "surfaces"), ("3D", "none")]
