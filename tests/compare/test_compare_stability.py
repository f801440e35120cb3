"""The collection of hard cases: every law holds, and every law can be broken.

That a case can fail is shown by perturbing what the solvers answer, one perturbation a kind of law.
"""

from dataclasses import replace
from math import nan

import numpy as np
import pytest

from bem3d import BEM, contact
from compare.report.page import Section, Table
from compare.solving.outcome import Outcome, Row
from compare.statistics.finding import FAILS, HOLDS
from compare.studies.stability.cases.collection import CASES
from compare.studies.stability.cases.examination import Examination
from compare.studies.stability.cases.hardcase import SIZES, Check, refusal
from compare.studies.stability.study import BROKEN, REFUSED, SOLVED, Stability
from mdr1d import MDR
from scene.reading import InvalidInput

QUICK = SIZES["quick"]
STUDY = Stability.of("quick")
# Found, allowed and message of each; a case that raises has a reason.
MADE_UP = {
    "speed-zero": Outcome((Row(seconds=1.0, measures={"found": 0.5, "allowed": 1.0}, settings={"what": "a"}),)),
    "no-shapes": Outcome((Row(measures={"found": 0.0, "allowed": 0.0}, settings={"what": "b", "message": "no"}),)),
    "needle": Outcome((Row(measures={"found": 2.0, "allowed": 1.0}, settings={"what": "c"}),)),
    "huge": Outcome((Row(reason="OSError: no such file: '/var/folders/x/scene.toml'"),)),
}


def judged(outcomes):
    """Answers and findings by the name of the case."""
    answers = STUDY.answers({Examination(name, "quick"): outcome for name, outcome in outcomes.items()})
    findings = STUDY.judge(answers).findings
    return answers, {each.claim.id.removeprefix("stability."): each for each in findings}


def broken(name):
    return [check for check in CASES[name].examine(QUICK) if not check.holds]


# One of each kind of law, which cost little; the command and the slow tests examine all.
SAMPLE = {
    *("speed-to-zero", "kelvin-to-speed-1e9-1d", "line-at-all-speeds", "hurst-zero-and-one"),
    *("ends-of-hurst-in-a-flow", "whole-domain", "nearly-full-contact", "force-rises-with-depth", "terraces"),
    *("glass-over-rubber-1e6-1d", "tables-of-no-solid", "nanometres", "prime-periods-in-full-contact"),
    *("lines-off-the-period", "nearly-a-flat-punch", "load-up-hold-up", "drawn-out", "no-programs"),
    *("contradictions", "history-of-1e-300-s", "contact-set-cycles", "flat-punch-of-ties", "height-zero"),
    *("tolerance-out-of-reach", "elastic-march", "settings-that-do-not-exist", "table-unsorted-and-doubled"),
}


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=() if name in SAMPLE else pytest.mark.slow) for name in CASES]
)
def test_every_hard_case_is_solved_within_its_law_or_refused_as_it_should(name):
    # tolerances are those of each law, with where they come from
    found = tuple(CASES[name].examine(QUICK))
    assert found
    assert not [check for check in found if not check.holds]


def test_every_case_has_its_own_words_and_the_sample_is_of_them():
    assert CASES.keys() >= SAMPLE
    assert len({case.about for case in CASES.values()}) == len(CASES)
    assert all(case.law and case.name == case.name.lower() for case in CASES.values())


@pytest.mark.parametrize(
    ("change", "names"),
    [
        (lambda it: {"normal_force": 1.05 * it.normal_force}, ("kelvin-to-speed-1e9-1d", "needle")),
        (lambda it: {"friction_force": -it.friction_force}, ("speed-to-zero", "friction-never-drives")),
        (lambda it: {"depth": 0.99 * it.depth}, ("tip-of-a-cone",)),
        # by rounding, and differently in each scene
        (lambda it: {"normal_force": it.normal_force * (1 + 1e-12 * np.log(it.normal_force))}, ("nanometres",)),
        (lambda it: {"normal_force": it.normal_force * (1 + 1e-3 * len(repr(it.scene)))}, ("named-and-general",)),
    ],
)
def test_a_wrong_answer_breaks_the_law(monkeypatch, change, names):
    def wrong(answer):
        return replace(answer, **change(answer))

    for solver in (MDR, BEM):
        honest = solver.solve
        monkeypatch.setattr(solver, "solve", lambda self, scene, honest=honest: wrong(honest(self, scene)))
    assert [name for name in names if broken(name)] == list(names)


def test_an_answer_where_a_refusal_is_due_breaks_the_case(monkeypatch):
    class Answered:
        normal_force = depth = friction_force = 1.0

    monkeypatch.setattr(BEM, "solve", lambda self, scene: Answered())
    names = ["gap-to-nothing", "load-to-nothing", "beyond-the-window"]
    assert [name for name in names if broken(name)] == names


def test_sets_that_cycle_break_the_case_if_they_are_not_joined(monkeypatch):
    monkeypatch.setattr(contact, "PATIENCE", 10**9)
    with pytest.raises(contact.NotConverged, match="violation"):
        broken("contact-set-cycles")


def test_a_refusal_asks_for_the_right_error_and_for_every_word():
    def ask(load):
        raise ValueError(f"load = {load} N")

    assert refusal("", ValueError, "load | 3 N", ask, 3).holds
    assert not refusal("", ValueError, "depth", ask, load=3).holds
    assert not refusal("", KeyError, "load", ask, 3).holds
    assert not refusal("", ValueError, "", lambda: 1.0).holds
    assert not Check("nothing", nan, 1.0).holds


def test_a_case_that_raises_is_broken_and_says_why(monkeypatch):
    monkeypatch.setattr(MDR, "solve", lambda self, scene: 1 / 0)
    (found,) = judged({"speed-zero": Examination("speed-zero", "quick").solve()})[1].values()
    assert (found.verdict, found.reason) == (FAILS, "ZeroDivisionError: division by zero")


def test_there_is_a_task_for_every_case_and_those_that_broke_are_broken_each_with_the_reason():
    (batch,) = STUDY.batches()
    tasks = batch.tasks
    assert [task.case for task in tasks] == list(CASES)
    assert all(task.fits(task.failed("a fault")) for task in tasks)
    _, found = judged({task.case: task.failed("a fault") for task in tasks})
    assert {(each.verdict, each.reason) for each in found.values()} == {(FAILS, "a fault")}
    assert len(found) == len(CASES)


def test_findings_state_the_law_and_the_page_counts_them():
    answers, found = judged(MADE_UP)
    verdicts = {"speed-zero": HOLDS, "needle": FAILS, "no-shapes": HOLDS, "huge": FAILS}
    assert {name: each.verdict for name, each in found.items()} == verdicts
    assert STUDY.failed(list(found.values()))
    needle = found["needle"]
    assert (needle.value, needle.claim.tolerance, needle.claim.expected) == (2.0, 1.0, 0.0)
    assert np.isnan(needle.interval).all()
    page = STUDY.judge(answers).page(STUDY.title, answers)
    assert page.answer[0].startswith("2 of 4 hard cases keep their law")
    assert "needle is broken: found 2, allowed 1" in page.answer[1]
    assert "no such file: 'scene.toml'" in page.answer[2]  # without the folder of the day
    counts = next(page.every(Table)).frame
    assert counts[["cases", SOLVED, REFUSED, BROKEN]].sum().tolist() == [4, 1, 1, 2]
    assert [each.title for each in page.blocks if isinstance(each, Section)] == [
        "Motion",
        "Shapes",
        "Extremes",
        "Setting",
    ]


def test_there_is_no_other_size():
    with pytest.raises(InvalidInput, match="size = small: allowed are quick, standard, full"):
        Stability.of("small")
