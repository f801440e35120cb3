"""Page of a study: the answer from all findings, figures of their tables alone, every point, and what failed."""

from collections import Counter
from dataclasses import replace

import numpy as np
import pytest
import xarray
from drawn_again import from_files
from invented_answers import FEW, SERIES, cut, eq_19, obeying, other, spoiled

from compare.figures.plot import Plot
from compare.report.page import Findings, Section, Table
from compare.solving.curve import tasks_of
from compare.solving.task import Outcome, Row
from compare.statistics.finding import REPORTED, UNDECIDED
from compare.studies.comparison.claims import SHORT
from compare.studies.comparison.comparison import Comparison
from scene import Indent, Program, Stage


def by_depth(name, title, motion, speeds, values):
    """The sphere under prescribed depths."""
    scene = replace(SERIES.scene, motion=motion)
    series = replace(SERIES, name=name, title=title, scene=scene, speeds=speeds, values=values)
    return obeying(lambda load, speed: eq_19(load * 1e4, speed), series)


def of(whole, title="A <question> & more?"):
    """A study of some series, and its answers."""
    asked = Comparison(tuple(each.series for each in whole), "study", title, "About.", "mine-quick")
    curves = {each.series.path(name): found for each in whole for name, found in each.curves.items()}
    return asked, xarray.DataTree.from_dict(curves)


@pytest.fixture(scope="module")
def study():
    """Four series, one with a failed solve: what was found of them, and their page."""
    sliding = cut(obeying(eq_19), speeds=6, values=5)
    depths, program = (5e-5, 2e-4, 1e-3), Program(stages=(Stage(duration=1.0, depth=1e-4),))
    asked, answers = of(
        [
            spoiled(sliding, np.s_[0, 2, 1], reason="it would not <converge>"),
            other(sliding, "smoother", rms_height=2.5e-5),
            by_depth("rest", "At rest", Indent(depth=1e-4), (), depths),
            by_depth("pressed", "Pressed in", program, (0.1, 1.0), depths),
        ]
    )
    judged = asked.judge(answers)
    return judged.findings, judged.page(asked.title, answers)


def test_the_answer_is_a_line_a_claim_with_every_verdict_and_number_of_places(study):
    findings, page = study
    (table,) = page.opening
    frame = table.frame.set_index("claim")
    assert frame.index.is_unique
    for short in frame.index:
        own = [each for each in findings if SHORT.get(each.claim.id) == short]
        for verdict in {each.verdict for each in own if each.verdict != REPORTED}:
            assert verdict in frame.loc[short, "verdict"]
    undecided = [each for each in findings if each.verdict == UNDECIDED]
    assert any("Undecided: " in each for each in page.answer) == bool(undecided)


def test_every_finding_stands_on_the_page_once(study):
    findings, page = study
    shown = [found for block in page.every(Findings) for found in block.findings]
    assert sorted(map(_place, shown)) == sorted(map(_place, findings))


def _place(found):
    return found.claim.id, found.dimension, found.where


def test_a_page_has_the_figures_and_tables_of_what_was_asked(study):
    _, page = study
    plots = {plot.name: plot for plot in page.every(Plot)}
    assert {"sphere/collapse", "sphere/friction-speed", "rest/force-depth"} <= set(plots)
    assert "rest/friction-speed" not in plots
    assert all(5 < len(plot.caption.split()) <= 60 for plot in plots.values())
    assert from_files(plots["pressed/force-depth"]).axes
    tables = {table.name: table.frame for table in page.every(Table)}
    assert len(tables["sphere/points"]) == 2 * 2 * (1 + 6) * 5
    assert tables["sphere/failures"]["reason"].tolist() == ["it would not <converge>"]
    assert "smoother/failures" not in tables


def test_a_series_of_which_nothing_was_solved_has_a_page_that_says_so():
    series = replace(SERIES, speeds=SERIES.speeds[:2], values=SERIES.values[:2])
    study = Comparison((series,), "study", "Empty", "About.")
    outcomes = {task: Outcome((Row(reason="no"),) * task.count) for task in tasks_of(study.grids())}
    answers = study.answers(outcomes)
    page = study.judge(answers).page(study.title, answers)
    assert (list(page.answer), page.opening) == ([], [])
    (section,) = (block for block in page.blocks if isinstance(block, Section) and block.title == series.title)
    assert any("No claim can be judged" in getattr(block, "text", "") for block in section.blocks)
    assert answers["sphere"].attrs["title"] == SERIES.title


def test_all_studies_are_one_comparison_and_each_has_its_own_families():
    first = obeying(eq_19, FEW)
    both = [first, other(first, "smoother", rms_height=2.5e-5)]
    whole = [
        replace(each, series=replace(each.series, name=f"{study}/{each.series.name}"))
        for study in ("mine", "second")
        for each in both
    ]
    asked, answers = of(whole)
    judged = asked.judge(answers)
    places = Counter(each.where.partition("/")[0] for each in judged.findings)
    assert places["mine"] == places["second"]
    assert {each.where for each in judged.findings if each.claim.id.startswith("eq18")} == {
        "mine/every sphere",
        "second/every sphere",
    }
    assert {"mine/sphere/collapse", "second/smoother/collapse"} <= {plot.name for plot in judged.plots}
