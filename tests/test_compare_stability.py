"""The collection of hard cases: every law holds, and every law can be broken.

That a case can fail is shown by perturbing what the solvers answer, one perturbation a kind of law, and seeing the
cases of that law break.
"""

from dataclasses import replace
from math import nan

import numpy as np
import pytest

from bem3d import BEM, contact
from compare.outcome import Outcome, Row
from compare.stability import report
from compare.stability.collection import CASES
from compare.stability.examination import Examination, checks
from compare.stability.hardcase import SMALL, Check, Refusal, refusal
from compare.store import Store, key
from mdr1d import MDR


@pytest.mark.parametrize("name", CASES)
def test_every_hard_case_is_solved_within_its_law_or_refused_as_it_should(name):
    # tolerances are those of each law, with where they come from
    found = tuple(CASES[name].examine(SMALL))
    assert found
    broken = [
        f"{check.what}: {check.found:g} > {check.allowed:g} {check.message or ''}"
        for check in found
        if not check.holds
    ]
    assert not broken


def test_there_are_as_many_cases_as_promised_each_with_its_own_words():
    assert len(CASES) >= 75
    for words in ("name", "about"):
        assert len({getattr(case, words) for case in CASES.values()}) == len(CASES)
    assert all(case.law and case.name == case.name.lower() for case in CASES.values())


def _perturbed(monkeypatch, change):
    """Both solvers answer what a change makes of their answers."""
    for solver in (MDR, BEM):
        honest = solver.solve
        monkeypatch.setattr(solver, "solve", lambda self, scene, honest=honest: change(honest(self, scene)))


def _scaled_force(answer):
    return replace(answer, normal_force=1.05 * answer.normal_force, friction_force=-1.05 * answer.friction_force)


def _lifted(answer):
    return replace(answer, depth=0.99 * answer.depth)


def _slightly_off(answer):
    return replace(answer, normal_force=answer.normal_force * (1 + 1e-12 * np.log(abs(answer.normal_force))))


def _by_the_words(answer):
    return replace(answer, normal_force=answer.normal_force * (1 + 1e-3 * len(repr(answer.scene))))


@pytest.mark.parametrize(
    ("change", "names"),
    [
        (_scaled_force, ("speed-to-zero", "kelvin-to-speed-1e9-1d", "friction-never-drives", "needle")),
        (
            _lifted,
            ("prime-squares", "kelvin-to-speed-1e9-3d", "hurst-zero-and-one", "held-for-ages", "tip-of-a-cone"),
        ),
        (_slightly_off, ("nanometres", "kilometres", "pascals-to-exapascals", "all-units-at-once")),
        (_by_the_words, ("equal-times", "relaxation-time-to-zero", "named-and-general", "speed-to-infinity")),
    ],
)
def test_a_wrong_answer_breaks_the_law(monkeypatch, change, names):
    _perturbed(monkeypatch, change)
    for name in names:
        assert not all(check.holds for check in CASES[name].examine(SMALL)), name


def test_an_answer_where_a_refusal_is_due_breaks_the_case(monkeypatch):
    class Answered:
        normal_force = depth = friction_force = 1.0

    monkeypatch.setattr(BEM, "solve", lambda self, scene: Answered())
    for name in ("gap-to-nothing", "load-to-nothing", "beyond-the-window"):
        assert not all(check.holds for check in CASES[name].examine(SMALL)), name


def test_sets_that_cycle_break_the_case_if_they_are_not_joined(monkeypatch):
    monkeypatch.setattr(contact, "PATIENCE", 10**9)
    with pytest.raises(contact.NotConverged, match="violation"):
        tuple(CASES["contact-set-cycles"].examine(SMALL))


def test_nan_never_holds():
    assert not Check("nothing", nan, 1.0).holds
    assert not Refusal("nothing", "(answered)", nan).holds


def test_a_refusal_asks_for_the_right_error_and_for_every_name():
    def ask():
        raise ValueError("load = 3 N")

    assert refusal("", ValueError, ("load", "3"), ask).holds
    assert not refusal("", ValueError, ("depth",), ask).holds
    assert not refusal("", KeyError, ("load",), ask).holds
    assert not refusal("", ValueError, (), lambda: 1.0).holds


def test_what_a_case_finds_comes_back_from_the_store_as_it_was(tmp_path):
    store = Store(tmp_path)
    for name in ("speed-zero", "no-shapes"):
        task = Examination(name, "small")
        assert store.get(task) is None
        outcome = task.solve()
        store.put(task, outcome)
        again = checks(store.get(task))
        assert again == checks(outcome)
        assert report.record(name, store.get(task)) == report.record(name, outcome)


def test_small_and_large_are_different_tasks():
    assert key(Examination("speed-zero", "small")) != key(Examination("speed-zero", "large"))


def test_a_case_that_raises_is_broken_and_says_why(monkeypatch):
    def broken(self, scene):
        raise ArithmeticError("no digits left")

    monkeypatch.setattr(MDR, "solve", broken)
    outcome = Examination("speed-zero", "small").solve()
    found = report.record("speed-zero", outcome)
    assert found.verdict == report.BROKEN
    assert "ArithmeticError: no digits left" in found.message
    assert "no digits left" in report.markdown([found])


@pytest.mark.parametrize(
    ("said", "told"),
    [
        ("/a/folder/scene.toml, line 1: speed", "scene.toml, line 1: speed"),
        ("no such file: '/var/folders/x/scene.toml'", "no such file: 'scene.toml'"),
        ("take less than v tau/a = 1 m/s", "take less than v tau/a = 1 m/s"),
    ],
)
def test_a_message_names_files_without_the_folder_of_the_day(said, told):
    assert report.record("no-shapes", Outcome((Row(reason=said),))).message == told


def test_verdicts_tell_solved_from_refused():
    held, refused = (
        report.record(name, Examination(name, "small").solve()) for name in ("speed-zero", "no-shapes")
    )
    assert (held.verdict, refused.verdict) == (report.HELD, report.REFUSED)
    page = report.markdown([held, refused])
    assert "## Motion" in page
    assert "## Shapes" in page
    assert report.HELD in page
    assert report.REFUSED in page
