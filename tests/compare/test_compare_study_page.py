"""Page of a study: the answer from all findings, figures of their tables alone, every point, and what failed."""

import re
from collections import Counter
from dataclasses import replace

import numpy as np
import pytest
import xarray
from invented_answers import FEW, SERIES, cut, eq_19, obeying, other, spoiled

from compare.figures import style
from compare.report import csvfiles
from compare.report.page import Findings, Plot, Section, Table
from compare.solving.outcome import Outcome, Row
from compare.solving.parameter_grid import tasks_of
from compare.statistics.finding import REPORTED
from compare.studies.claims.catalogue import STUDIES, ReadyStudy
from compare.studies.claims.series import Contacts
from compare.studies.claims.study import AllStudies, ClaimStudy
from scene import Indent, Program, Stage

NUMBER = re.compile(r"−?\d+(?:\.\d+)?")


def by_depth(name, title, motion, speeds, values):
    """The sphere under prescribed depths."""
    scene = replace(SERIES.scene, motion=motion)
    series = replace(SERIES, name=name, title=title, scene=scene, speeds=speeds, values=values)
    return obeying(lambda load, speed: eq_19(load * 1e4, speed), series)


def of(whole, title="A <question> & more?"):
    """A study of some series, and its answers."""
    answers = xarray.DataTree.from_dict({f"/{each.series.name}": each.answers[each.series.name] for each in whole})
    ready = ReadyStudy(title, "About.", lambda size: [each.series for each in whole])
    return ClaimStudy("mine", ready, "quick"), answers


@pytest.fixture(scope="module")
def study():
    """Four series, one with a failed solve, and a study of them with its answers."""
    sliding = cut(obeying(eq_19), speeds=6, values=5)
    depths, program = (5e-5, 2e-4, 1e-3), Program(stages=(Stage(duration=1.0, depth=1e-4),))
    return of(
        [
            spoiled(sliding, np.s_[0, 2, 1], reason="it would not <converge>"),
            other(sliding, "smoother", rms_height=2.5e-5),
            by_depth("rest", "At rest", Indent(depth=1e-4), (), depths),
            by_depth("pressed", "Pressed in", program, (0.1, 1.0), depths),
        ]
    )


@pytest.fixture(scope="module")
def page(study):
    asked, answers = study
    return asked.judge(answers).page(asked.title, answers)


def test_the_answer_has_a_statement_for_each_claim_and_every_verdict_of_it(study, page):
    asked, answers = study
    findings = [each for each in asked.judge(answers).findings if each.verdict != REPORTED]
    statements = dict.fromkeys(each.claim.sentence for each in findings)
    for text, sentence in zip(page.answer, statements, strict=True):
        assert f": {sentence}: " in text
        for each in findings:
            if each.claim.sentence == sentence:
                assert each.verdict in text.lower()


def test_every_finding_stands_on_the_page_once_and_leads_to_a_plot_that_is_there(study, page):
    asked, answers = study
    findings = asked.judge(answers).findings
    shown = [found for block in page.every(Findings) for found in block.findings]
    assert sorted(map(_place, shown)) == sorted(map(_place, findings))
    assert {each.plot for each in findings} <= {plot.name for plot in page.every(Plot)}
    (overview,) = (table for table in page.every(Table) if table.name == "overview")
    verdicts = Counter(each.verdict for each in findings)
    for name in ("holds", "fails", "undecided"):
        assert overview.frame[name].sum() == verdicts[name]


def _place(found):
    return found.claim.id, found.row["dimension"], found.where, found.plot


def test_figures_are_functions_of_their_tables_as_files_have_them(page, tmp_path):
    plots = {plot.name: plot for plot in page.every(Plot)}
    assert {"family", "sphere/collapse", "sphere/friction-speed", "sphere/slow-friction"} <= set(plots)
    assert {"rest/force-depth", "pressed/force-depth"} <= set(plots)
    assert "rest/friction-speed" not in plots
    for name, plot in plots.items():
        assert 5 < len(plot.caption.split()) <= 60, name
        if name not in ("family", "sphere/collapse", "pressed/force-depth"):
            continue  # drawn with all figures, from stored tables
        tables = {}
        for table, frame in plot.tables.items():
            (tmp_path / f"{table}.csv").write_text(csvfiles.text(frame), "utf-8")
            tables[table] = csvfiles.read(tmp_path / f"{table}.csv")
        with style.applied():
            assert plot.draw(tables, **plot.options).axes


def test_points_have_means_with_intervals_and_groups_and_failures_their_reason(study, page):
    asked, answers = study
    tables = {table.name: table.frame for table in page.every(Table)}
    points, contacts = tables["sphere/points"], Contacts(asked.series[0], answers)
    assert len(points) == 2 * 2 * (1 + 6) * 5
    rough = points[(points["dimension"] == "3D") & (points["body"] == "rough")]
    forces = (contacts("BEM")[name].mean("surface").values for name in ("friction_force", "normal_force"))
    ratio = np.divide(*forces)
    np.testing.assert_allclose(rough["friction_coefficient_mean"].to_numpy().reshape(7, 5), ratio, rtol=1e-12)
    assert (rough["normal_force_low"] <= rough["normal_force_mean"]).all()
    assert rough["memory_over_shortest"].iloc[-1] > 1
    assert rough["surfaces"].min() == SERIES.surfaces - 1
    (reason,) = tables["sphere/failed"]["reason"]
    assert reason == "it would not <converge>"
    assert "smoother/failed" not in tables


def test_a_series_of_which_nothing_was_solved_has_a_page_that_says_so():
    series = replace(SERIES, speeds=SERIES.speeds[:2], values=SERIES.values[:2])
    study = ClaimStudy("empty", ReadyStudy("Empty", "About.", lambda size: [series]), "quick")
    outcomes = {task: Outcome((Row(reason="no"),) * len(task.scenes)) for task in tasks_of(study.grids())}
    answers = study.answers(outcomes)
    page = study.judge(answers).page(study.title, answers)
    assert list(page.answer) == []
    (section,) = (block for block in page.blocks if isinstance(block, Section) and block.title.startswith("1."))
    assert any("No claim can be judged" in getattr(block, "text", "") for block in section.blocks)
    assert answers["sphere"].attrs["title"] == SERIES.title


def test_all_studies_are_one_question_and_the_answer_is_from_all_of_them(monkeypatch):
    first = obeying(eq_19, FEW)
    asked, answers = of([first, other(first, "smoother", rms_height=2.5e-5)])
    both = AllStudies((asked, replace(asked, name="second")))
    tree = xarray.DataTree.from_dict({"/mine": answers, "/second": answers.copy()})
    findings = both.judge(tree).findings
    places = Counter(each.where.partition(",")[0] for each in findings)
    assert places["mine"] == places["second"] == len(findings) / 2
    page = both.judge(tree).page(both.title, tree)
    assert len(page.answer) == len({each.claim.sentence for each in findings if each.verdict != REPORTED})
    assert {"mine/family", "second/family"} <= {plot.name for plot in page.every(Plot)}
    monkeypatch.setattr(AllStudies, "grids", lambda self: {})  # thousands of scenes
    assert [each.name for each in ClaimStudy.of("all").studies] == list(STUDIES)
