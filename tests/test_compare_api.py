"""What the command does, from Python: the same numbers, nothing printed, and results that show themselves."""

import ast
import json
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure

import compare
from bem3d import BEM
from compare.cases import Case
from compare.cases import Study as Varied
from compare.manifest import manifests
from compare.quantity import Quantity
from compare.redrawing import job_of, redraw
from compare.study import Task
from compare.written import as_json, from_json
from mdr1d import MDR
from scene import Elastic, Indent, Kelvin, Measured, Refused, Scene, SelfAffine, Slide, Sphere, Topography, markup
from scene.reading import InvalidInput

SLIDING = Scene(
    indenter=Sphere(radius=1e-2),
    elastomer=Kelvin(modulus=1e6, relaxation_time=1e-3),
    motion=Slide(speed=0.1, load=1.0),
    roughness=SelfAffine(hurst=0.2, rms_height=1e-6, longest=1e-2, shortest=1e-3, seed=5),
)
TINY = Case(
    title="A <rough> sphere & more",
    indenter=SLIDING.indenter,
    elastomer=SLIDING.elastomer,
    motion=SLIDING.motion,
    roughness=SLIDING.roughness,
    study=Varied(
        speeds=(0.1, 1.0), pressing=(0.5, 2.0), load_speeds=(0.1,), depths=(1.0,), surfaces=2, profiles=2
    ),
    bem=BEM(points=32),
    mdr=MDR(points=500),
)
CONE = """
indenter = {type = "cone", angle = 0.2}
elastomer = {type = "kelvin", modulus = 1e6, relaxation_time = 1e-3}
motion = {type = "slide", speed = 0.1, load = 1.0}
"""


class Balanced(HTMLParser):
    """Tags that open and do not close, or the other way round."""

    VOID = frozenset({"img", "br", "meta", "link", "hr", "input", "col"})

    def __init__(self, text):
        super().__init__()
        self.open, self.crossed = [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.crossed.append(tag)


def shown(thing):
    """What a notebook shows: whole HTML without a word that its text could have smuggled in."""
    text = thing._repr_html_()
    parsed = Balanced(text)
    assert not parsed.open
    assert not parsed.crossed
    assert "<rough>" not in text
    return text


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("found")


@pytest.fixture(scope="module")
def found(folder):
    return compare.crosscheck({"tiny": TINY}, folder, workers=2)


def test_every_name_of_the_package_is_there_is_listed_and_hides_no_module(folder):
    there = {path.stem for path in Path(compare.__file__).parent.iterdir()}
    for name in compare.__all__:
        assert getattr(compare, name) is not None
        assert name in dir(compare)
        assert name not in there, f"compare.{name} would hide the module of that name"
        assert name in compare.__doc__
    assert set(compare._PLACES) == set(compare.__all__)
    with pytest.raises(AttributeError, match="no attribute 'crosschek'"):
        compare.crosschek  # noqa: B018


def test_a_run_prints_nothing_and_what_it_returns_says_what_the_command_prints(folder, found, capfd):
    again = compare.crosscheck({"tiny": TINY}, folder)
    assert capfd.readouterr() == ("", "")
    assert (again.swept.solved, again.swept.reused) == (0, found.swept.solved)
    (judgement,) = again.judged.values()
    assert all(f"  {number.name}: {number.written}" in str(again) for number in judgement.numbers)
    assert str(again.page.resolve()) in str(again)
    assert repr(again) == str(again)


def test_a_run_shows_itself_in_a_notebook(found):
    text = shown(found)
    assert "A &lt;rough&gt; sphere &amp; more" in text
    (judgement,) = found.judged.values()
    assert all(number.written in text for number in judgement.numbers)
    assert shown(judgement) in text
    assert len(repr(judgement)) < 3000  # a terminal is not flooded by its points and fields


def test_figures_are_drawn_when_they_are_taken_out_and_show_themselves(found):
    figures = found.figures
    assert {"tiny/contact", "tiny/friction-speed"} <= set(figures)
    drawing = figures["tiny/contact"]
    assert isinstance(drawing, Figure)
    assert drawing._repr_png_().startswith(b"\x89PNG")
    with pytest.raises(KeyError):
        figures["tiny/nothing"]
    assert "data:image/png;base64," in shown(figures)
    assert str(figures).startswith("Figures(tiny/contact, ")


def test_a_folder_says_what_wrote_it_and_of_what(folder, found):
    (manifest,) = manifests(folder)
    assert manifest.command == "run"
    assert job_of(manifest).cases == {"tiny": TINY}
    assert manifest.solved.resolve() == (folder / "solved").resolve()
    content = json.loads((folder / "manifest.json").read_text())
    assert {"versions", "platform", "tasks", "cases"} <= content.keys()
    assert str(folder) not in json.dumps(content)  # it may be moved


def test_figures_are_made_again_for_a_journal_without_solving(folder, found, monkeypatch):
    monkeypatch.setattr(Task, "solve", None)
    redrawn = redraw(folder, journal="elsevier")
    assert set(redrawn.names) == set(found.figures)
    assert not redrawn.aged
    assert (redrawn.folder / "tiny" / "contact.pdf").read_bytes() != (folder / "tiny" / "contact.pdf").read_bytes()
    plain = redraw(folder, output=folder / "plain")
    for name in plain.names:
        assert (folder / "plain" / f"{name}.pdf").read_bytes() == (folder / f"{name}.pdf").read_bytes()


@pytest.mark.slow
def test_a_folder_that_was_moved_is_drawn_again(folder, found, tmp_path):
    moved = tmp_path / "elsewhere"
    moved.mkdir()
    for path in folder.rglob("*"):
        if path.is_file() and "figures" not in path.parts:
            target = moved / path.relative_to(folder)
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_bytes(path.read_bytes())
    assert redraw(moved).names == redraw(folder).names


def test_what_is_missing_is_counted_and_what_cannot_be_drawn_is_named(folder, found, tmp_path):
    (tmp_path / "solved").mkdir()
    (tmp_path / "manifest.json").write_bytes((folder / "manifest.json").read_bytes())
    count = len(found.swept.outcomes)
    with pytest.raises(Refused, match=f"{count} of {count} tasks are not solved in "):
        redraw(tmp_path)
    with pytest.raises(InvalidInput, match="no journal 'elsevir'; did you mean elsevier"):
        redraw(folder, journal="elsevir")
    with pytest.raises(InvalidInput, match="no style"):
        redraw(folder, style="no-such-style")
    with pytest.raises(InvalidInput, match=r"no manifest\.json here"):
        redraw(folder / "tiny")
    with pytest.raises(InvalidInput, match="no such folder"):
        redraw(folder / "nowhere")
    for content in ("{", "[]", "{}", '{"command": "run", "arguments": {}, "solved": "solved", "versions": {}}'):
        (tmp_path / "manifest.json").write_text(content)
        with pytest.raises(InvalidInput, match="run the command again"):
            redraw(tmp_path)


def test_maps_of_heights_survive_the_manifest():
    heights = np.random.default_rng(1).normal(size=(6, 8)) * 1e-6
    rough = replace(TINY, roughness=Topography(heights=heights, pixel=1e-4))
    body = replace(
        TINY, indenter=Measured(heights=heights, pixel=1e-4), roughness=None, elastomer=Elastic(modulus=1e6),
        motion=Indent(load=1e-3),
    )  # fmt: skip
    for case in (TINY, rough, body):
        assert from_json(Case, json.loads(json.dumps(as_json(Case, case)))) == case


def test_a_plan_is_asked_of_a_scene_a_case_or_a_file(tmp_path):
    (tmp_path / "cone.toml").write_text(CONE)
    of_scene = compare.plan(SLIDING)
    assert of_scene.feasible
    assert {*of_scene} == {"MDR", "BEM"}
    assert str(compare.plan(TINY)["BEM"]) == str(TINY.bem.plan(SLIDING))
    assert "Cone(angle=0.2)" in shown(compare.plan(tmp_path / "cone.toml"))
    assert all(str(each) in str(of_scene) for each in of_scene.values())


def test_a_result_shows_every_number_with_its_unit_and_escapes_what_it_holds():
    result = MDR(points=300).solve(SLIDING)
    text = shown(result)
    for name in ("normal_force", "depth", "friction_coefficient", *result.measures, *result.fields):
        assert f">{name}<" in text
    assert ">N<" in text
    hostile = replace(result, settings={"points": "<script>"}, measures={"<b>": 1.0})
    assert "<script>" not in hostile._repr_html_()
    assert "<b>" not in hostile._repr_html_()


def test_a_long_table_says_how_much_it_leaves_out():
    assert "and 3 more" in markup.table([(k, k) for k in range(markup.LONGEST + 3)])
    assert "more" not in markup.table([(k, k) for k in range(markup.LONGEST)])


@pytest.mark.parametrize(
    ("given", "suggested"), [("quick-strat", "quick-start"), ("tiny.tml", "tiny.toml"), ("zzzzzz", None)]
)
def test_a_misspelt_name_or_path_gets_a_suggestion(tmp_path, monkeypatch, given, suggested):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "tiny.toml").write_text(CONE)
    with pytest.raises(InvalidInput) as mistake:
        compare.crosscheck(given)
    assert str(mistake.value).startswith(f"{given}: no such file, and no ready scene")
    assert ("did you mean" in str(mistake.value)) is (suggested is not None)
    if suggested:
        assert str(mistake.value).endswith(f"did you mean {suggested}?")
    assert not list(tmp_path.glob("crosscheck-*"))


def test_a_scene_that_nothing_compares_is_refused_before_anything_is_written(tmp_path):
    plane = replace(SLIDING, roughness=None, motion=Indent(load=1.0))
    from scene import Plane

    with pytest.raises(Refused, match="Plane"):
        compare.crosscheck(
            replace(plane, indenter=Plane(), motion=Indent(pressure=1e4), roughness=SLIDING.roughness),
            tmp_path / "no",
        )
    assert not (tmp_path / "no").exists()


QUANTITY = Quantity(
    name="my <cone>: friction",
    of="friction_coefficient",
    numerator=Task(MDR(points=300), (replace(SLIDING, roughness=None),)),
    denominator=1.0,
    tolerance=1e-6,
    reason="rounding",
    meaning="of one model",
)


def test_a_regression_says_what_moved_and_an_update_mends_it(tmp_path):
    baseline = tmp_path / "mine.toml"
    compare.update(baseline, [QUANTITY], folder=tmp_path / "solved")
    kept = compare.regress(baseline, [QUANTITY], folder=tmp_path)
    assert kept.judged.wrong == []
    assert "1 of 1 quantities" in str(kept)
    assert shown(kept)
    value = kept.judged[0].value
    baseline.write_text(baseline.read_text().replace(repr(float(f"{value:.10g}")), repr(1.1 * value)))
    moved = compare.regress(baseline, [QUANTITY], folder=tmp_path)
    assert [change.verdict for change in moved.judged.wrong] == ["moved"]
    assert "my &lt;cone&gt;: friction" in shown(moved)
    assert "moved" in str(moved)
    with pytest.raises(AssertionError, match="accuracy has moved"):
        compare.check(baseline, [QUANTITY], folder=tmp_path / "solved")


def test_measured_friction_that_does_not_collapse_has_no_exponent(tmp_path):
    # each speed bends in its own way, and the scatter of repeated measurements is small: no shift helps
    rows = [
        f"{(1 + load**power) ** -0.5 * scatter},{load},{speed}"
        for speed, power in ((1.0, 1.0), (2.0, 2.0), (4.0, 3.0))
        for load in np.geomspace(0.1, 10.0, 9)
        for scatter in (0.999, 1.0, 1.001)
    ]
    (tmp_path / "curves.csv").write_text("\n".join(rows))
    found = compare.shift(tmp_path / "curves.csv", tmp_path / "out")
    assert found.judged.collapse.verdict == "fails"
    assert "p = none, as these shifts do not bring the curves onto one" in str(found)
    assert np.isfinite(found.judged.collapse.exponent)  # which the fit has, and which means nothing
    assert (tmp_path / "out" / "shifted-curves-curves.pdf").exists()
    assert redraw(tmp_path / "out").names == ("shifted-curves-curves",)


def test_a_table_with_a_mistake_leaves_no_folder_behind(tmp_path):
    (tmp_path / "ball.csv").write_text("1,2\n")
    with pytest.raises(InvalidInput, match="line 1: 2 columns"):
        compare.shift(tmp_path / "ball.csv", tmp_path / "out")
    assert not (tmp_path / "out").exists()


def test_a_type_checker_sees_every_name_where_it_is():
    tree = ast.parse(Path(compare.__file__).read_text(encoding="utf-8"))
    (seen,) = (
        node for node in tree.body if isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING"
    )
    places = {alias.asname or alias.name: (node.module, alias.name) for node in seen.body for alias in node.names}
    assert places == compare._PLACES
