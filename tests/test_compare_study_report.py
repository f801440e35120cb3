"""The page of a study holds every claim with its verdict and both errors, and no link on it leads nowhere."""

import base64
import csv
import json
from collections import Counter
from dataclasses import replace
from html.parser import HTMLParser
from urllib.parse import unquote

import numpy as np
import pytest
from test_compare_study_figures import (
    SURFACES,
    finding,
    findings,
    judged,
    resting,
    sliding,
    spoiled,
    study,
)

from compare.studies import report, tableau, wording
from compare.studies.series import FINE, ROUGH, Key
from compare.sweep import Swept

SWEPT = Swept({}, 10, 2, 3.0)
TITLE = "Rough <sphere> & more"


class Page(HTMLParser):
    """Text, identifiers, links and images; whether every element is closed."""

    def __init__(self, text):
        super().__init__()
        self.ids, self.links, self.saved, self.images, self.text, self.open = [], [], [], [], "", []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attributes):
        assert tag not in ("link", "iframe")
        found = dict(attributes)
        self.ids += [found["id"]] if "id" in found else []
        if "download" in found:
            self.saved.append(found["href"])
        elif "href" in found:
            self.links.append(found["href"])
        self.images += [found["src"]] if "src" in found else []
        if tag not in ("meta", "img", "br"):
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        if not {"style", "script"} & set(self.open):
            self.text += data

    @property
    def words(self):
        return " ".join(self.text.split())


def two_series():
    """One slides and lost a solve, one is at rest; one claim is on both together."""
    solved = spoiled(sliding(), Key("BEM", ROUGH, FINE), np.s_[1, 2, 3])
    solved = replace(
        solved, series=replace(solved.series, name="The Sphere", title=TITLE, note="A note & a half.")
    )
    whole = (finding("of all series", "3D", 1.2, figure="study-family"),)
    return study(judged(solved, shifted=False), resting(), whole=whole)


@pytest.fixture(scope="module")
def whole():
    return two_series()


@pytest.fixture(scope="module")
def folder(whole, tmp_path_factory):
    folder = tmp_path_factory.mktemp("study")
    assert report.write_study(folder, whole, SWEPT) == folder / "study.html"
    return folder


@pytest.fixture(scope="module")
def page(folder):
    return Page((folder / "study.html").read_text(encoding="utf-8"))


def test_no_link_leads_nowhere_and_every_file_is_inside(folder, page):
    assert len(page.ids) == len(set(page.ids))
    assert {link[1:] for link in page.links} <= set(page.ids)
    assert all(link.startswith("#") for link in page.links)
    assert {"figure-the-sphere-study-levels", "figure-rest-study-depth"} <= {link[1:] for link in page.links} | {
        each for each in page.ids if each.startswith("figure-rest")
    }
    inside = {unquote(link.removeprefix("data:text/csv;charset=utf-8,")) for link in page.saved}
    beside = {path.read_text(encoding="utf-8") for path in folder.rglob("*.csv")}
    assert inside == beside


def test_a_finding_links_to_its_row_its_figure_and_its_numbers(whole, page):
    links = Counter(page.links)
    levels = sum(each.figure == "study-levels" for each in findings())
    # at rest no such figure is drawn: its findings lead to the table of its points
    assert links["#figure-the-sphere-study-levels"] == levels
    assert links["#data-the-sphere-study-levels"] == levels + 1
    assert "#data-rest-study-levels" not in links
    every = len(tableau.every(whole))
    assert all(links[f"#data-findings.{row}"] == 1 for row in range(1, every + 1))


def test_every_claim_stands_with_its_verdict_and_both_errors(whole, page):
    for each in tableau.every(whole):
        assert each.claim in page.words
        assert each.text in page.words
        assert wording.written(each) in page.words
        assert wording.errors(each) in page.words
        assert each.undecidable in page.words
    # once in the table of its series, and in the overview for every group of series that met it
    groups = len(
        {
            (each.claim, each.dimension, each.verdict)
            for column in tableau.columns(whole)
            for each in column.findings
        }
    )
    found = sum(page.words.count(f"{verdict} (data)") for verdict in tableau.VERDICTS)
    # that of all series has no figure, and points are those of a series
    assert "figure-study-family" not in page.ids
    assert found == len(tableau.every(whole)) - len(whole.findings)
    assert sum(page.words.count(f"{verdict} {n} of ") for verdict in tableau.VERDICTS for n in (1, 2)) == groups


def test_the_number_of_verdicts_is_counted_and_what_chance_makes_of_it(whole, page):
    verdicts = Counter(each.verdict for each in tableau.every(whole))
    assert f"{verdicts.total()} verdicts are on this page: holds {verdicts['holds']}" in page.words
    decided = verdicts["holds"] + verdicts["fails"]
    assert f"of the {decided} that are decided, {0.05 * decided:.1f} at most" in page.words


def test_titles_and_reasons_are_text_never_markup(folder, page):
    assert page.words.startswith("A <question> & more? Skip to the summary A <question> & more? About.")
    for said in (TITLE, "A note & a half.", "it would not <converge>", "nothing known <b>", "no <overlap>"):
        assert said in page.words
    assert "<converge>" not in (folder / "study.html").read_text(encoding="utf-8")
    assert not page.open


def test_the_page_says_what_cannot_be_matched_with_the_slopes_measured(page):
    assert "What cannot be matched between the dimensionalities" in page.words
    assert "C_1D = π q C_2D" in page.words
    assert "1: 1D 0.3, 3D 0.3" in page.words
    for kind in ("The rms slope.", "The roughness itself.", "Real contact.", "The number of draws."):
        assert kind in page.words


def test_the_page_says_where_the_points_of_each_dimensionality_lie(whole, page):
    for each in whole.series:
        for solver, dimension in (("MDR", "1D"), ("BEM", "3D")):
            assert f"{dimension}: {report.points.regime(each.solved, solver).words}" in page.words


def test_images_are_inside_and_beside(folder, page):
    assert len(page.images) > 5
    shapes = sorted(path.read_bytes()[16:24] for path in folder.rglob("*.png"))
    inside = [image.split(",", 1) for image in page.images]
    assert {head for head, _ in inside} == {"data:image/png;base64"}
    # the same pictures with fewer colours: of the same width and height
    assert sorted(base64.b64decode(content)[16:24] for _, content in inside) == shapes


def rows(path):
    with path.open(encoding="utf-8") as file:
        return list(csv.DictReader(file))


def test_the_table_of_findings_has_all_of_them(whole, folder):
    found = rows(folder / "findings.csv")
    assert [row["claim"] for row in found] == [each.claim for each in tableau.every(whole)]
    assert [row["verdict"] for row in found] == [each.verdict for each in tableau.every(whole)]
    assert {row["series"] for row in found} == {"The Sphere", "rest", "all series"}


def test_the_table_of_points_has_every_point_with_its_regime(whole, folder):
    found = rows(folder / "the-sphere" / "points.csv")
    solved = whole.series[0].solved
    assert len(found) == sum(answers.depth[..., 0].size for answers in solved.answers.values())
    rough = [row for row in found if (row["dimension"], row["body"]) == ("3D", "rough")]
    mu = np.array([float(row["friction_coefficient"]) for row in rough])
    np.testing.assert_allclose(mu, solved("BEM").friction.ravel(), rtol=1e-12)
    spoilt = [row for row in rough if int(row["surfaces"]) < SURFACES["BEM"]]
    assert [float(row["prescribed_load"]) for row in spoilt] == [solved.series.presses[2]]
    regime = whole.series[0].laws["BEM"].regime
    for name in ("shortest_in_contact", "memory_over_shortest", "contact_fraction"):
        np.testing.assert_allclose([float(row[name]) for row in rough], getattr(regime, name), rtol=1e-12)
    smooth = [row for row in found if row["body"] == "smooth"]
    assert {row["friction_coefficient_error"] for row in smooth} == {"0.0"}
    assert {row["memory_over_shortest"] for row in smooth} == {"nan"}


def test_failed_solves_are_listed_with_their_reason(folder, page):
    (failed,) = rows(folder / "the-sphere" / "failed.csv")
    assert failed["reason"] == "it would not <converge>"
    assert "1 solves failed and are left out" in page.words
    assert page.words.count("No solve failed.") == 1
    assert not (folder / "rest" / "failed.csv").exists()


def test_the_manifest_accounts_for_everything(whole, folder):
    manifest = json.loads((folder / "manifest.json").read_text(encoding="utf-8"))
    assert manifest["tasks"] == {"solved": 10, "reused": 2}
    assert len(manifest["findings"]) == len(tableau.every(whole))
    first, second = manifest["series"]
    assert first["seeds"] == {"MDR": list(range(1, 9)), "BEM": [1, 2, 3, 4]}
    assert first["settings"]["BEM"]["points"] == 64
    assert len(first["failures"]) == 1
    assert second["speeds"] == []
    assert str(folder) not in json.dumps(manifest)


def test_one_series_alone_links_verdicts_without_counting_series(tmp_path):
    data = study(replace(resting(), findings=findings()[:1]))
    page = Page(report.write_study(tmp_path, data, SWEPT).read_text(encoding="utf-8"))
    assert "holds 1 of 1" not in page.words
    assert "#series-rest" in page.links
    assert "All series together" in page.words  # the figure of verdicts


def test_a_study_without_findings_says_so(tmp_path):
    data = study(replace(resting(), findings=()))
    page = Page(report.write_study(tmp_path, data, SWEPT).read_text(encoding="utf-8"))
    assert "0 verdicts are on this page" in page.words
    assert "No claim is asked of this series." in page.words


def test_numbers_that_are_not_known_are_said_to_be():
    assert wording.written(finding("x", "1D", np.nan)) == "not measured"
    assert wording.written(finding("x", "1D", 1.0, grid=np.nan)) == "1, interval unknown"
    assert wording.written(finding("x", "1D", 1.0)) == "1 (0.98 to 1.02)"
    assert wording.errors(finding("x", "1D", 1.0)) == "4 draws, scatter 0.99 to 1.01, grid ± 0.01"
    assert wording.errors(finding("x", "1D", 1.0, surfaces=0)) == "no roughness, grid ± 0.01"
    assert wording.errors(finding("x", "1D", 1.0, half=np.nan, grid=np.nan)).endswith(
        "scatter unknown, grid unknown"
    )
