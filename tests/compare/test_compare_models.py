"""Any model is judged: one of a user's own, by its object or its name, against a reference of choice."""

import re
import subprocess
import sys
from dataclasses import dataclass, replace

import pytest
from imports import ROOT
from processes import ask
from small_cases import SLIDING

import compare
from bem3d import BEM
from compare.library.lookup import case_of
from compare.models.table import Model, Models
from compare.solving.task import SceneTask
from compare.statistics.finding import FAILS, HOLDS
from mdr1d import MDR
from scene import Doubtful, Refused, Result, Scene, SelfAffine, SolveError
from scene.files.reading import InvalidInput
from scene.scales import elastic_contact

pytestmark = pytest.mark.usefixtures("in_this_process")

PAGE = ROOT / "docs" / "howto" / "models.md"
SCENE = replace(SLIDING, roughness=None)
SMOOTH = replace(case_of(SCENE), bem=BEM(points=32), mdr=MDR(points=400))
ROUGH = replace(
    SMOOTH,
    roughness=SelfAffine(hurst=0.8, rms_height=2e-6, longest=5e-3, shortest=1e-3, seed=3),
    bem=BEM(points=48),
)


@dataclass(frozen=True)
class Stiff:
    """The smooth body at rest, its force times a factor, with a measure of a name."""

    factor: float = 1.0
    measure: str = "rms_slope"
    name = "Stiff"

    def solve(self, scene: Scene) -> Result:
        contact, measures = elastic_contact(scene), {self.measure: 1.0}
        force = self.factor * contact.load
        return Result(scene, self.name, {}, force, contact.depth, 0.01 * contact.load, measures=measures)


def called(name, label="a model"):
    return dataclass(frozen=True)(type("Called", (Stiff,), {"name": name, "label": label}))()


@pytest.mark.parametrize("measure", ["speed", "status", "depth_reached", "seconds"])
def test_a_measure_that_has_the_name_of_something_else_is_no_answer(measure):
    (row,) = SceneTask(Stiff(measure=measure), (SCENE,)).solve().rows
    assert repr(measure) in row.reason
    (row,) = SceneTask(Stiff(), (SCENE,)).solve().rows
    assert (row.reason, row.measures) == (None, {"rms_slope": 1.0})


@dataclass(frozen=True)
class Gridded(Stiff):
    points: int = 64
    name = "Gridded"


@dataclass(frozen=True)
class Averaging(Stiff):
    name, draws = "Averaging", "none"


@dataclass(frozen=True)
class Failing(Stiff):
    error: str = "refused"
    name = "Failing"

    def solve(self, scene: Scene) -> Result:
        raise Refused("too steep") if self.error == "refused" else SolveError("too steep")


def found(report, claim, dimension):
    rows = report.findings[(report.findings["claim"] == claim) & (report.findings["model"] == dimension)]
    return rows["value"].tolist(), rows["verdict"].tolist()


def of_the_pair(report):
    """Every number that was found without the model of this file, as text."""
    pair = report.findings[~report.findings["model"].str.contains("Stiff")]
    return pair[["claim", "where", "model", "value", "low", "high", "verdict"]].to_csv(index=False)


@pytest.fixture(scope="module")
def judged(tmp_path_factory):
    folder = tmp_path_factory.mktemp("models")
    return compare.run(SMOOTH, folder, models=["mdr", "bem", Stiff(1.1)], report=False)


def test_a_model_is_judged_against_the_reference_by_the_claims_of_the_others(judged):
    values, verdicts = found(judged, "force.ratio.smooth", "Stiff/3D")
    assert values == pytest.approx([0.1] * len(values), abs=0.01)
    assert set(verdicts) == {FAILS}
    assert set(found(judged, "force.ratio.smooth", "1D/3D")[1]) == {HOLDS}
    sentences = {each.claim.sentence for each in judged.judged}
    assert "The force on the smooth body at the same depth is the same in Stiff and 3D" in sentences


def test_the_numbers_of_the_default_pair_do_not_move(judged, tmp_path):
    alone = compare.run(SMOOTH, tmp_path, report=False)
    assert {each.solver.name for each in alone.study.series[0].models} == {"MDR", "BEM"}
    assert of_the_pair(alone) == of_the_pair(judged)


def test_every_model_has_its_curve_in_every_figure_of_a_run(judged):
    assert len(judged.figures) >= 4
    for name in judged.figures:
        assert judged.figures[name].axes


def test_another_reference_turns_the_ratio_around(judged, tmp_path):
    turned = compare.run(SMOOTH, tmp_path, models=[MDR(points=400), BEM(points=32)], reference="mdr", report=False)
    (slow,), _ = found(turned, "friction.ratio.smooth-slow", "3D/1D")
    (straight,), _ = found(judged, "friction.ratio.smooth-slow", "1D/3D")
    assert slow == pytest.approx(1 / straight, rel=1e-12)
    (claim,) = (each.claim for each in turned.judged if each.claim.id == "friction.ratio.smooth-slow")
    assert claim.expected == 0.5


@pytest.mark.parametrize("error", ["refused", "failed"])
def test_a_model_that_answers_nothing_is_told_and_takes_no_other_with_it(error, tmp_path):
    models = ["bem", Failing(error=error)]
    with pytest.warns(Doubtful, match="too steep"):
        report = compare.sweep(SMOOTH, [0.1], draws=1, output=tmp_path, models=models, report=False)
    reason = "refused: too steep" if error == "refused" else "too steep"
    assert reason in report["reason"].sel(model="Failing").values
    assert report["friction_force"].sel(model="BEM", level="fine").notnull().all()


@pytest.mark.parametrize(
    ("models", "reference", "message"),
    [
        (["bem", BEM()], None, "two have one name"),
        (["bem"], None, "at least two"),
        (["bem", "mdr"], "exact", "reference = 'exact': one of BEM, MDR"),
        (["bem", replace(Stiff(), factor=object())], None, "numbers, texts"),
        (["bem", Gridded(points=2**63)], None, f"its `points` = {2**63}: a whole number from 1 to {2**63 - 1}"),
        *((["bem", called(name)], None, "its `name` is") for name in ("", "a/b", "\ud800", 3)),
        (["bem", called("a", r"$\frac$")], None, "its `label` is"),
    ],
)
def test_a_mistake_is_named_before_anything_is_solved(models, reference, message, tmp_path):
    with pytest.raises(InvalidInput, match=re.escape(message)):
        compare.run(SMOOTH, tmp_path / "none", models=models, reference=reference)
    assert not (tmp_path / "none").exists()


def test_what_a_model_leaves_out_has_its_default():
    (left,) = Models.of([Stiff(), "bem"]).judged
    assert left == Model(Stiff(), "Stiff", "surfaces")
    assert not left.has_grid
    assert Models.of([Stiff(), "mdr"]).reference == "MDR"


def test_a_model_without_draws_has_no_scatter_of_its_own(tmp_path):
    models = ["bem", Averaging(), "corrected"]
    found = compare.sweep(ROUGH, [0.1], draws=3, output=tmp_path, models=models, report=False)
    wide = found["friction_coefficient_high"] - found["friction_coefficient_low"]
    assert wide.sel(model="Averaging").item() == 0
    assert wide.sel(model="BEM").item() > 0
    assert found["normal_force"].sel(model="Averaging", level="fine", surface=ROUGH.roughness.seed).notnull().all()


def test_the_source_of_a_class_that_no_module_has_is_in_the_key():
    @dataclass(frozen=True)
    class Local(Stiff):
        def solve(self, scene):
            return super().solve(scene)

    task = SceneTask(Local(), (SCENE,))
    assert not task.portable
    assert "def solve(self, scene):" in task.question["source"]
    assert SceneTask(Stiff(), (SCENE,)).portable


@pytest.mark.slow
def test_the_class_of_a_script_is_solved_in_its_process(tmp_path):
    page = PAGE.read_text(encoding="utf-8")
    model, asked = re.findall(r"```python\n(.*?)```", page, re.DOTALL)
    script = tmp_path / "script.py"
    script.write_text(f"{model}\n{asked}    print(report)\n    print(friction)\n")
    finished = subprocess.run([sys.executable, script], cwd=tmp_path, capture_output=True, text=True, check=True)
    assert "is the same in smooth limit and 3D" in finished.stdout


STRANGER = {
    "study": """
title = "Three models"
models = ["mdr", "bem", "stranger:Model"]
speeds = [0.01, 0.1]
loads = [0.5, 1.0, 2.0]
surfaces = 2
profiles = 4
indenter = {type = "sphere", radius = "10 mm"}
elastomer = {type = "kelvin", modulus = "1 MPa", relaxation_time = "1 ms"}
roughness = {type = "self-affine", hurst = 0.5, rms_height = "5 um", longest = "2 mm", shortest = "0.5 mm"}
bem = {points = 64}
mdr = {points = 500}
[[series]]
name = "sphere"
""",
    "scene": """
models = ["mdr", "bem", "stranger:Model"]
indenter = {type = "sphere", radius = "10 mm"}
elastomer = {type = "kelvin", modulus = "1 MPa", relaxation_time = "1 ms"}
motion = {type = "slide", speed = "0.1 m/s", load = "1 N"}
""",
}


@pytest.mark.parametrize(("command", "kind"), [("plan", "scene"), ("run", "scene"), ("study", "study")])
def test_a_file_that_names_a_module_is_refused_and_nothing_of_it_is_imported(command, kind, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(tmp_path)
    (tmp_path / f"{kind}.toml").write_text(STRANGER[kind])
    (tmp_path / "stranger.py").write_text("open('ran', 'w')")
    answer = ask(command, f"{kind}.toml")
    assert answer.exit_code == 2
    assert f"{kind}.toml: models.2 = 'stranger:Model': a file may name models of this and" in answer.stderr
    assert {each.name for each in tmp_path.iterdir()} == {f"{kind}.toml", "stranger.py"}


def test_the_working_folder_is_the_last_place_where_a_model_is_looked_for(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "path", list(sys.path))
    (tmp_path / "own_stiff.py").write_text("from bem3d import BEM\nclass Own(BEM): name = 'Own'\n")
    Models.of(["bem", "law"])
    assert str(tmp_path) not in sys.path
    Models.of(["bem", "own_stiff:Own"])
    assert sys.path[-1] == str(tmp_path)
