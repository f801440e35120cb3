"""The report of a small case solved here: numbers, figures, tables and a page that stands alone."""

import base64
import csv
import io
import json
import re
from dataclasses import replace
from html.parser import HTMLParser
from urllib.parse import unquote

import matplotlib
import numpy as np
import pytest
from matplotlib.figure import Figure
from PIL import Image

from bem3d import BEM
from compare import glossary, illustration, metrics, report, sheets, sources
from compare.cases import Case, Study
from compare.figures import style
from compare.outcome import Outcome, Row
from compare.study import points, tasks
from compare.sweep import Swept
from compare.terms import TERMS
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
# Of 256 levels, in the mean: what 256 colours change of a picture.
UNSEEN = 1.0


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
    """Text, identifiers, pictures and links; downloads, which a page has inside, apart."""

    def __init__(self, text):
        super().__init__()
        self.ids, self.images, self.links, self.saved, self.text = [], [], [], {}, ""
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        found = dict(attributes)
        self.ids += [found["id"]] if "id" in found else []
        if tag == "img":
            self.images.append(found["src"])
        elif "download" in found:
            self.saved[len(self.saved)] = found["href"]
        elif "href" in found:
            self.links.append(found["href"])
        assert tag not in ("link", "iframe", "object")
        assert not {"srcset", "action", "data"} & found.keys()
        assert tag == "img" or "src" not in found

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


def pixels(content):
    return np.asarray(Image.open(io.BytesIO(content)).convert("RGB"), dtype=float)


def test_the_page_has_every_image_inside_and_links_nothing_but_itself(folder):
    text = (folder / "report.html").read_text(encoding="utf-8")
    page = Page(text)
    names = [module.NAME for module in report.FIGURES]
    assert len(page.ids) == len(set(page.ids))
    assert {link[1:] for link in page.links} <= set(page.ids)
    assert len(page.images) == len(names)
    for image, name in zip(page.images, names, strict=True):
        head, content = image.split(",", 1)
        assert head == "data:image/png;base64"
        beside = (folder / "small-case" / f"{name}.png").read_bytes()
        inside = base64.b64decode(content)
        assert np.abs(pixels(inside) - pixels(beside)).mean() < UNSEEN
        assert len(inside) < len(beside)
    assert not re.search(r"https?://", text)


def test_the_data_inside_is_that_beside_and_every_file_is_there(folder):
    saved = Page((folder / "report.html").read_text(encoding="utf-8")).saved.values()
    inside = {unquote(link.removeprefix("data:text/csv;charset=utf-8,")) for link in saved}
    beside = {path.read_text(encoding="utf-8") for path in folder.rglob("*.csv") if path.name != "numbers.csv"}
    assert inside == beside


def test_every_number_is_defined_on_the_page_and_leads_to_its_points(judged, folder):
    page = Page((folder / "report.html").read_text(encoding="utf-8"))
    numbers = (*judged[0].numbers, *judged[0].checks)
    for each in numbers:
        assert glossary.of_number(each.name).anchor in page.ids
        assert f"#{glossary.of_number(each.name).anchor}" in page.links
        for first, _ in sheets.runs(sources.behind(each, judged[0].table)):
            assert f"#data-small-case-points.{first}" in page.links


def test_a_number_is_computed_from_the_points_it_leads_to_and_no_others(judged):
    judgement, swept = judged
    found = points(CASE)
    numbers = (*judgement.numbers, *judgement.checks)
    assert len(numbers) == 9
    for each in numbers:
        rows = sources.behind(each, judgement.table)
        kept = [found[row - 1] for row in rows]
        alone = judge(CASE, kept, swept)
        again = [other for other in (*alone.numbers, *alone.checks) if other.name == each.name]
        assert [repr(other) for other in again] == [repr(each)]
        rest = judge(CASE, [point for point in found if point not in kept], swept)
        assert repr(each) not in map(repr, (*rest.numbers, *rest.checks))


def test_every_term_is_met_and_has_its_own_words():
    met = {glossary.of_column(column) for term in TERMS.values() for column in term.columns}
    assert met == {term for term in TERMS.values() if term.columns}
    for words in ("id", "name", "text"):
        assert len({getattr(term, words) for term in TERMS.values()}) == len(TERMS)
    claimed = [column for term in TERMS.values() for column in term.columns]
    assert len(claimed) == len(set(claimed))


def test_every_column_of_the_points_is_defined(judged):
    assert all(glossary.of_column(column) for column in judged[0].table[0].columns)
    assert glossary.of_column("normal_force_error") == glossary.of_column("normal_force")
    assert glossary.of_column("colour") is None
    with pytest.raises(glossary.Unknown):
        glossary.of_number("a number of no kind")


def test_a_cell_is_sorted_by_its_value_and_read_with_six_digits():
    assert sheets.Cell.of("0.12345678901234") == sheets.Cell("0.123457", "0.12345678901234", True)
    assert sheets.Cell.of("5000") == sheets.Cell("5000", "5000", True)
    assert sheets.Cell.of("nan") == sheets.Cell("–", "nan", True)
    assert sheets.Cell.of("") == sheets.Cell("–", "", True)
    assert sheets.Cell.of("own") == sheets.Cell("own", "own", False)
    assert sheets.Cell.of("inf").numeric


def test_rows_that_follow_one_another_are_named_by_their_ends():
    assert sheets.runs([3, 1, 2, 7]) == [(1, 3), (7, 7)]
    assert sheets.runs([]) == []


def test_a_picture_is_said_in_the_words_of_its_module():
    for module in report.FIGURES:
        said = illustration.seen(module)
        assert said.endswith(".")
        assert "None" not in said
        assert module.__doc__.splitlines()[0].rstrip(".") in said


def test_a_fragment_has_the_numbers_and_escapes_what_they_say(judged):
    page = Page(report.fragment(judged[0]))
    assert "A <small> case & more" in page.text
    for each in judged[0].numbers:
        assert each.written in page.text
    assert not page.ids + page.links + page.images


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


def test_failures_are_listed_with_their_reason_and_left_out(tmp_path):
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
    page = report.write_report(tmp_path, {"x": judgement}, swept).read_text(encoding="utf-8")
    assert Page(page).text.count("it would not converge <here>") == 2
    spoiled = [r for r in metrics.select(judgement.table, "load", "BEM") if r.load == 2.0]
    assert [r.normal_force.count for r in spoiled] == [1, 1]


def test_one_surface_is_undecided_never_certain():
    judgement, _ = solved(replace(CASE, study=replace(CASE.study, surfaces=1)))
    assert "undecided" in number(judgement, "1D / 3D friction at the scene's own point").written
    assert "(scatter unknown)" in number(judgement, "misfit of the curves shifted as Eq. 23 predicts").written
    assert judgement.collapses["BEM"].verdict == "undecided"


@pytest.mark.slow
def test_a_scene_at_rest_has_a_report_of_what_makes_sense(tmp_path):
    judgement, swept = solved(replace(CASE, motion=Indent(depth=1e-4), roughness=None))
    page = Page(report.write_report(tmp_path, {"rest": judgement}, swept).read_text())
    assert len(page.images) == 3  # the contact in two pictures, and force against depth
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
    for part, words in (
        (CASE.roughness, "rms height 5 µm, longest wave 10 mm, shortest wave 2 mm"),
        (PowerLaw(coefficient=30.0, exponent=3.0), "coefficient 30 m^(1-exponent), exponent 3"),
        (
            StandardLinearSolid(rubbery_modulus=1e6, glassy_modulus=1e8, relaxation_time=1e-5),
            "rubbery modulus 1 MPa, glassy modulus 100 MPa, relaxation time 10 µs",
        ),
        (
            Prony(equilibrium_modulus=1e6, moduli=(1e6, 2e7), relaxation_times=(1e-3, 1.0)),
            "moduli 1 MPa 20 MPa, relaxation times 1 ms 1 s",
        ),
        (
            KelvinChain(instantaneous_compliance=1e-7, compliances=(1e-6,), retardation_times=(1e-3,)),
            "instantaneous compliance 1e-07 1/Pa, compliances 1e-06 1/Pa, retardation times 1 ms",
        ),
    ):
        assert words in report.described(part)


def test_a_name_in_any_latin_script_keeps_its_letters_in_a_path():
    assert report.slug("my scène ü") == "my-scene-u"
    assert report.slug("日本") == "case"
