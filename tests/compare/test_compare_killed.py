"""Killed at any instant, a study that is asked for again ends as if nothing had happened."""

import json
import os
import random
import signal
import time
from collections import Counter
from dataclasses import replace
from pathlib import Path

import marked_study
import pytest
from processes import PATIENCE, finish, start

from compare.solving.store import Store

ROOT = Path(__file__).parents[2]
PATHS = os.pathsep.join([str(ROOT), str(ROOT / "tests")])


class Killed:
    """A folder with the study, run by the command in a process group of its own."""

    def __init__(self, folder):
        self.folder = folder
        self.marks = folder / "marks"
        self.tasks = marked_study.tasks()
        self.store = Store(folder / "crosscheck-study" / "solved")

    def start(self):
        program = ("-c", "import marked_study; marked_study.command()")
        environment = {"MARKS": str(self.marks), "PYTHONPATH": PATHS}
        return start(self.folder, "study", "collapse", "--workers", "2", program=program, **environment)

    def count(self):
        return len(self.store)

    def stored(self):
        """Tasks with an answer. Every line that is there is whole."""
        found = [task for task in self.tasks if self.store.get(task) is not None]
        assert len(found) == self.count()
        return found

    def begun(self):
        """Solves so far, by scene and solver."""
        return Counter(self.marks.read_text().split()) if self.marks.exists() else Counter()

    def begun_of(self, tasks, begun):
        return {task: [begun[name] for name in marked_study.names(task)] for task in tasks}

    def kill(self, when):
        """Start it, kill all of it at a moment, and see that nothing stored is lost or was solved again.

        when : condition that is asked for until it holds. Returns whether the study had not ended before.
        """
        before, begun = self.stored(), self.begun()
        process = self.start()
        deadline = time.monotonic() + PATIENCE
        while not when() and process.poll() is None and time.monotonic() < deadline:
            time.sleep(0.002)
        ended = process.poll()
        if ended is None:
            os.killpg(process.pid, signal.SIGKILL)
        process.communicate(timeout=PATIENCE)
        assert ended in (None, 0)
        assert set(before) <= set(self.stored())
        assert self.begun_of(before, self.begun()) == self.begun_of(before, begun)
        return ended is None

    def finish(self, expected):
        """Run it to its end, and compare with undisturbed answers."""
        before, begun = self.stored(), self.begun()
        status, said, complained = finish(self.start())
        assert (status, complained) == (0, "")
        solved = self.stored()
        assert solved == self.tasks
        assert self.begun_of(before, self.begun()) == self.begun_of(before, begun)
        fresh = [task for task in self.tasks if task not in before]
        counts = self.begun_of(fresh, begun), self.begun_of(fresh, self.begun())
        assert all(counts[1][task] == [count + 1 for count in counts[0][task]] for task in fresh)
        assert f"{len(fresh)} tasks solved, {len(before)} reused" in said
        for task in self.tasks:
            assert exactly(self.store.get(task)) == expected[task]
        assert not [path for path in self.folder.rglob(".*") if path.is_file()]
        manifest = self.store.folder.parent / "collapse-quick" / "manifest.json"
        assert json.loads(manifest.read_text())


def exactly(outcome):
    """All of its numbers, to the last digit, but for the seconds that were measured."""
    sorted_rows = [
        replace(row, seconds=0.0, measures=sorted(row.measures.items()), settings=sorted(row.settings.items()))
        for row in outcome.rows
    ]
    return repr(sorted_rows)


@pytest.fixture(scope="module")
def expected(tmp_path_factory):
    """Answers of an undisturbed solve of each task."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("MARKS", str(tmp_path_factory.mktemp("undisturbed") / "marks"))
        return {task: exactly(task.solve()) for task in marked_study.tasks()}


def moment(draw, study):
    """A condition: a random time after the start, or after some more answers are stored."""
    start, more = time.monotonic(), study.count() + draw.randint(1, len(study.tasks) // 4)
    if draw.random() < 0.3:
        wait = draw.uniform(0.0, 4.0)
        return lambda: time.monotonic() - start > wait
    late, seen = draw.uniform(0.0, 0.1), []

    def due():
        if study.count() >= more:
            seen.append(time.monotonic())
        return bool(seen) and time.monotonic() - seen[0] > late

    return due


@pytest.mark.slow
def test_killed_in_the_middle_a_study_ends_as_an_undisturbed_one(tmp_path, expected):
    study = Killed(tmp_path)
    assert study.kill(lambda: study.count() >= 3)
    study.finish(expected)


@pytest.mark.hours
def test_killed_at_fifty_moments_studies_end_as_undisturbed_ones(tmp_path, expected):
    draw, kills, studies, unstored = random.Random(50), 0, 0, 0
    while kills < 50:
        (tmp_path / str(studies)).mkdir()
        study = Killed(tmp_path / str(studies))
        studies += 1
        while kills < 50 and study.count() < len(study.tasks):
            kills += study.kill(moment(draw, study))
            unstored += study.count() == 0
        study.finish(expected)
    print(f"{kills} kills in {studies} studies of {len(study.tasks)} tasks, {unstored} before anything was stored")
