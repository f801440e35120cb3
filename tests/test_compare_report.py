"""The report of a small case solved here: numbers, figures, tables and a page that stands alone."""

import base64
import csv
import json
import re
from dataclasses import replace
from html.parser import HTMLParser

import matplotlib
import numpy as np
import pytest
from matplotlib.figure import Figure

from bem3d import BEM
from compare import metrics, report
from compare.cases import Case, Study
from compare.figures import style
from compare.outcome import Outcome, Row
from compare.study import points, tasks
from compare.sweep import Swept
from compare.verdict import judge
from compare.wording import plus_minus
from mdr1d import MDR
from scene import (
    Cone,
    Indent,
    Kelvin,
    KelvinChain,
    PowerLaw,
    Prony,
    SelfAffine,
    Slide,
    Sphere,
    StandardLinearSolid,
)

CASE = Case(
    title="A <small> case & more",
    notes=("smaller than the paper's",),
    indenter=Sphere(radius=1e-2),
    elastomer=Kelvin(modulus=1e6, relaxation_time=1e-3),
    motion=Slide(speed=0.1, load=1.0),
    roughness=SelfAffine(hurst=0.8, rms_height=5e-6, longest=1e-2, shortest=2e-3, seed=5),
    study=Study(
        speeds=(0.1, 1.0),
        pressing=(0.2, 0.5, 1.0, 2.0),
        load_speeds=(0.1, 0.3),
        depths=(0.5, 1.0),
        surfaces=2,
        profiles=3,
    ),
    bem=BEM(points=32),
    mdr=MDR(points=1000),
)
# 32 points a side: 13 pixels from the middle of the contact to its edge at v tau = 0.01 a.
LIMIT_ON_A_SMALL_GRID = 0.05


def solved(case, spoil=lambda task, outcome: outcome):
    found = points(case)
    outcomes = {task: spoil(task, task.solve()) for task in tasks(found)}
    swept = Swept(outcomes, len(outcomes), 0, 1.0)
    return judge(case, found, swept), swept


@pytest.fixture(scope="module")
def judged():
    return solved(CASE)


@pytest.fixture(scope="module")
def folder(judged, tmp_path_factory):
    folder = tmp_path_factory.mktemp("report")
    judgement, swept = judged
    report.write_report(folder, {"small case": judgement}, swept)
    return folder


class Page(HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.images, self.links, self.text = [], [], ""
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name in ("href", "src", "srcset", "action", "data"):
                (self.images if tag == "img" else self.links).append(value)
        assert tag not in ("script", "link", "iframe")

    def handle_data(self, data):
        self.text += data


def number(judgement, start):
    return next(n for n in (*judgement.numbers, *judgement.checks) if n.name.startswith(start))


def test_the_smooth_ratio_at_low_speed_is_near_two_and_its_limit_is_said(judged, folder):
    found = number(judged[0], "1D / 3D friction of the smooth body")
    assert found.value == pytest.approx(2, abs=2 * LIMIT_ON_A_SMALL_GRID)
    assert 0 < found.error < LIMIT_ON_A_SMALL_GRID * 2
    assert "tends to 2" in Page((folder / "report.html").read_text()).text


def test_smooth_force_and_depth_agree(judged):
    # Hertz in 3D is good to some 1e-3 with 20 points across the contact, and the error says so.
    found = number(judged[0], "force at the same depth, 1D over 3D, smooth")
    assert abs(found.value) < 5e-3
    assert abs(found.value) == pytest.approx(found.error, rel=0.1)


def test_the_page_has_every_image_inside_and_links_nothing(folder):
    text = (folder / "report.html").read_text()
    page = Page(text)
    names = ["contact", "force-depth", "friction-speed", "friction-load", "collapse", "smooth-limit"]
    assert not page.links
    assert len(page.images) == len(names)
    for image, name in zip(page.images, names, strict=True):
        head, content = image.split(",", 1)
        assert head == "data:image/png;base64"
        assert base64.b64decode(content) == (folder / "small-case" / f"{name}.png").read_bytes()
    assert not re.search(r"https?://", text)


def test_the_page_says_what_was_asked_and_what_came_out(judged, folder):
    text = Page((folder / "report.html").read_text()).text
    assert CASE.title in text
    assert CASE.notes[0] in text
    assert "mean over 3 profiles (1D) and 2 surfaces (3D)" in text
    assert "bars are standard errors" in text
    for found in (*judged[0].numbers, *judged[0].checks):
        assert found.name in text
        assert found.written in text
    assert "No solve failed." in text


def test_figures_are_written_for_print_and_screen(folder):
    for path in (folder / "small-case").glob("*.pdf"):
        content = path.read_bytes()
        assert b"/Type0" in content  # fonttype 42 is embedded as such, never as outlines of type 3
        assert b"/Type3" not in content
        png = path.with_suffix(".png").read_bytes()
        width = int.from_bytes(png[16:20])
        assert width >= 200 * style.SINGLE


def test_tables_hold_the_numbers_of_the_judgement(judged, folder):
    table = judged[0].table
    for name, kind in (("force-depth", "force-depth"), ("friction-speed", "speed"), ("friction-load", "load")):
        with (folder / "small-case" / f"{name}.csv").open() as file:
            rows = list(csv.DictReader(file))
        records = [record for record in table if record.kind == kind]
        assert len(rows) == len(records) > 0
        for row, record in zip(rows, records, strict=True):
            assert row["solver"] == record.solver
            for column in ("normal_force", "depth_reached", "friction_coefficient"):
                expected = getattr(record, column)
                assert float(row[column]) == expected.mean
                assert float(row[f"{column}_error"]) == pytest.approx(expected.error, nan_ok=True, rel=0)


def test_the_manifest_accounts_for_everything_and_names_no_machine(judged, folder):
    manifest = json.loads((folder / "manifest.json").read_text())
    (case,) = manifest["cases"]
    assert case["seeds"] == {"MDR": [5, 6, 7], "BEM": [5, 6]}
    assert case["settings"]["BEM"]["points"] == 32
    assert manifest["tasks"] == {"solved": len(judged[1].outcomes), "reused": 0}
    assert case["failures"] == []
    assert case["processor_seconds"]["BEM"] > 0
    assert {"python", "numpy", "scipy", "mdr-bem-crosscheck"} <= manifest["versions"].keys()
    everything = json.dumps(manifest)
    assert str(folder) not in everything
    import platform

    assert not platform.node() or platform.node() not in everything


def test_drawing_changes_no_setting_of_the_caller(judged):
    before = dict(matplotlib.rcParams)
    for module in report.FIGURES:
        with style.applied():
            assert isinstance(module.figure(judged[0]), Figure)
    assert dict(matplotlib.rcParams) == before


def test_failures_are_listed_with_their_reason_and_left_out():
    def spoil(task, outcome):
        scene = task.scenes[0]
        if (
            task.solver.name == "BEM"
            and scene.roughness
            and scene.roughness.seed == 6
            and scene.motion.load == 2.0
        ):
            return Outcome((Row(reason="it would not converge <here>"),))
        return outcome

    judgement, swept = solved(CASE, spoil)
    assert len(judgement.failures) == 2
    page = report.page([report.Section("x", judgement)], swept)
    assert Page(page).text.count("it would not converge <here>") == 2
    spoiled = [r for r in metrics.select(judgement.table, "load", "BEM") if r.load == 2.0]
    assert [r.normal_force.count for r in spoiled] == [1, 1]


def test_one_surface_is_undecided_never_certain():
    judgement, _ = solved(replace(CASE, study=replace(CASE.study, surfaces=1)))
    assert "undecided" in number(judgement, "1D / 3D friction at the scene's own point").written
    assert "(scatter unknown)" in number(judgement, "misfit of the curves shifted as Eq. 23 predicts").written
    assert judgement.collapses["BEM"].verdict == "undecided"


def test_a_scene_at_rest_has_a_report_of_what_makes_sense(tmp_path):
    judgement, swept = solved(replace(CASE, motion=Indent(depth=1e-4), roughness=None))
    page = Page(report.write_report(tmp_path, {"rest": judgement}, swept).read_text())
    assert len(page.images) == 2
    assert "tends to 2" not in page.text
    assert [n.name for n in judgement.numbers] == ["force at the same depth, 1D over 3D, smooth: deviation"]
    assert [n.name for n in judgement.checks] == ["change of the 3D normal force with the pixel halved"]


def test_numbers_are_written_to_the_digits_of_their_error():
    assert plus_minus(1.23456, 0.0123) == "1.235 ± 0.012"
    assert plus_minus(0.0123, 0.0004, "%") == "1.230 ± 0.040 %"
    assert plus_minus(123.4, 25.0) == "123 ± 25"
    assert plus_minus(1.5, np.nan) == "1.5, error undecided"
    assert plus_minus(np.nan, 0.1) == "undecided"


def test_a_scene_is_written_in_words_with_units():
    for part, words in (
        (Sphere(radius=1e-2), "Sphere, radius 10 mm"),
        (Cone(angle=np.pi / 18), "Cone, angle 10°"),
        (CASE.elastomer, "Kelvin, modulus 1 MPa, relaxation time 1 ms, Poisson ratio 0.5"),
        (Slide(speed=0.1, load=1.0), "Slide at 0.1 m/s under 1 N"),
        (Indent(depth=1.5e-4), "Indent to 150 µm"),
    ):
        assert report.described(part) == words


def test_every_field_with_a_unit_has_it_on_the_page():
    for part in (
        *(CASE.indenter, CASE.elastomer, CASE.roughness, PowerLaw(coefficient=30.0, exponent=3.0)),
        StandardLinearSolid(rubbery_modulus=1e6, glassy_modulus=1e8, relaxation_time=1e-5),
        Prony(equilibrium_modulus=1e6, moduli=(1e6,), relaxation_times=(1e-3,)),
        KelvinChain(instantaneous_compliance=1e-7, compliances=(1e-6,), retardation_times=(1e-3,)),
    ):
        bare = {"coefficient", "exponent", "hurst", "seed", "amplitudes", "poisson_ratio", "type"}
        assert vars(part).keys() - bare <= report.PREFIXED.keys() | report.PLAIN.keys()


def test_a_name_in_any_latin_script_keeps_its_letters_in_a_path():
    assert report.slug("my scène ü") == "my-scene-u"
    assert report.slug("日本") == "case"
