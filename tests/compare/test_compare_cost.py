"""A study is counted before a task of it is built, every count has a bound, much is done on a yes alone."""

from dataclasses import replace
from math import inf

import pytest
import xarray
from small_cases import CURVE, HEAD, SCENE, SHARED, TABLES

from bem3d import BEM
from compare.library.case import Case, share_of
from compare.library.lookup import case_of
from compare.solving import cost as costs
from compare.solving.cost import DAY, MANY_CONTACTS, MOST_CONTACTS, Cost, seconds_per_work, work_of
from compare.studies.comparison import asked as questions
from compare.studies.comparison.study_file import study_of
from compare.studies.paper.study import Paper
from compare.studies.pipeline import run
from compare.studies.study import Study
from mdr1d import MDR
from scene import Indent, Program, Prony, Refused, Stage
from scene.files.reading import InvalidInput, read

SERIES = '[[series]]\nname = "one"\n'


class Costly(Study):
    """A study of a cost, whose tasks must not be built."""

    def __init__(self, contacts, work):
        self.taken = Cost(contacts, work)

    def cost(self):
        return self.taken

    def batches(self):
        raise AssertionError("tasks were built")


def test_what_is_counted_is_what_is_built():
    assert CURVE.cost == Cost.of(CURVE.tasks())
    assert CURVE.cost.contacts == 3 * 2 * 2 * (3 + 2)  # speeds, loads, grids, draws
    smooth = replace(CURVE, scene=replace(CURVE.scene, roughness=None))
    assert smooth.cost.contacts == 3 * 2 * 2 * 2 == Cost.of(smooth.tasks()).contacts


@pytest.mark.parametrize("asked", [questions.run("quick-start"), Paper(3)])
def test_of_a_whole_study_it_is_an_upper_bound_as_curves_share_contacts(asked):
    built = Cost.of(task for batch in asked.batches() for task in batch.tasks)
    assert built.contacts <= asked.cost().contacts <= 1.3 * built.contacts
    assert built.work <= asked.cost().work * (1 + 1e-12) <= 1.3 * built.work


@pytest.mark.parametrize(
    ("contacts", "days", "message"),
    [
        (10, 2.1, r"more than a day \(workers = 2\)"),
        (MANY_CONTACTS + 1, 0.1, "more than 300,000 contacts"),
    ],
)
def test_what_takes_long_is_begun_on_a_yes_alone(tmp_path, contacts, days, message):
    asked = Costly(contacts, days * DAY / seconds_per_work())
    with pytest.raises(Refused, match=f"{contacts:,} contacts .* h of processor time.*{message}.*--yes"):
        run(asked, tmp_path / "out", workers=2)
    assert not (tmp_path / "out").exists()
    with pytest.raises(AssertionError, match="tasks were built"):
        run(asked, tmp_path / "out", workers=2, yes=True)


def test_work_is_a_number_of_scene_and_settings_that_grows_with_what_is_solved():
    smooth, rough = (case_of(name) for name in ("standard-solid", "quick-start"))
    program = case_of("there-and-back").scene
    many = replace(smooth.scene, elastomer=Prony(1e6, (1e6,) * 16, tuple(1e-5 * 2.0**k for k in range(16))))
    rest = replace(smooth.scene, motion=Indent(load=1.0))
    for solver in (MDR(points=5000), BEM(points=128)):
        finer = replace(solver, points=8 * solver.points)
        assert 1 < work_of(finer, rough.scene) / work_of(solver, rough.scene) <= 64
        counts = [work_of(solver, scene) for scene in (rest, smooth.scene, many, program)]
        assert counts == sorted(set(counts))
    assert work_of(MDR(), rough.scene) > 2 * work_of(MDR(), replace(rough.scene, roughness=None))
    # in time by its steps, where there are any to be counted
    steps = MDR().plan(program).steps
    assert work_of(MDR(), program) == pytest.approx(2 * 5 * steps * MDR().points, rel=1e-2)
    hopeless = replace(program, motion=Program(stages=(Stage(duration=1e9, speed=1.0, load=1.0),)))
    assert 0 < work_of(MDR(), hopeless) < inf


class Solved:
    """A solver that takes 0.63 s."""

    seconds = 0.63

    def solve(self, scene):
        return self


@pytest.mark.parametrize("kept", [b"", b"1e-6\n", b"nan", b"-1e-6", b"1e9", b"import os", b"\xff", b"9" * 10**5])
def test_seconds_are_measured_once_and_kept_and_no_file_of_a_stranger_breaks_them(tmp_path, monkeypatch, kept):
    file = tmp_path / "crosscheck" / "seconds-per-work.txt"
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.setattr(costs, "CALIBRATING", (Solved(), None))
    if kept:
        file.parent.mkdir()
        file.write_bytes(kept)
    assert seconds_per_work.__wrapped__() == pytest.approx(1e-6)
    monkeypatch.setattr(costs, "CALIBRATING", (None, None))
    assert seconds_per_work.__wrapped__() == pytest.approx(1e-6)  # from the file
    monkeypatch.setattr(costs, "CALIBRATING", (Solved(), None))
    monkeypatch.setenv("XDG_CACHE_HOME", str(file))  # where nothing can be kept
    assert seconds_per_work.__wrapped__() == pytest.approx(1e-6)


def test_more_than_memory_holds_is_begun_on_no_yes(tmp_path):
    with pytest.raises(Refused, match="at most 2,000,000 contacts"):
        run(Costly(MOST_CONTACTS + 1, 0.0), tmp_path, yes=True)


@pytest.mark.parametrize("count", [0, 10_001, 10**30])
def test_draws_of_a_scene_have_a_bound_that_is_said(tmp_path, count):
    (tmp_path / "scene.toml").write_text(SCENE + f"[study]\nsurfaces = {count}\n")
    with pytest.raises(InvalidInput, match=rf"study\.surfaces = {count}: Input should be .* (10000|1)$"):
        read(tmp_path / "scene.toml", Case)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("surfaces = 2", "surfaces = 10001", "surfaces = 10001: Input should be .* 10000"),
        ("count = 4", f"count = {10**30}", rf"loads\.count = {10**30}: .* 1000"),
        ('["50 mm/s", 0.1, 0.2]', str([*range(1, 1002)]), "speeds.*at most 1000"),
    ],
)
def test_draws_ranges_and_lists_of_a_study_have_a_bound_that_is_said(old, new, message):
    with pytest.raises(InvalidInput, match=message):
        study_of(HEAD + SHARED.replace(old, new) + TABLES + SERIES, "study.toml")


def test_so_have_threads():
    with pytest.raises(ValueError, match="less than or equal to 1024"):
        BEM(threads=10**9)


@pytest.mark.parametrize("given", ["2%", " 2 % ", "0.02", xarray.DataArray(0.02)])
def test_shares_are_numbers_and_texts(given):
    assert share_of("interval", given) == pytest.approx(0.02, rel=1e-15)
