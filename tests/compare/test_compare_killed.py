"""Killed at any instant, a study that is asked for again ends as if nothing had happened; no runs are mixed."""

import json
import multiprocessing
import os
import random
import signal
import threading
import time
from collections import Counter
from dataclasses import dataclass
from functools import partial
from itertools import count
from pathlib import Path

import marked_study
import pytest
import xarray
from matplotlib.figure import Figure
from pandas import DataFrame
from processes import PATIENCE, finish, start, wait_for
from stand_in_solver import exactly

import compare
from compare.figures.plot import Plot
from compare.report.page import Table
from compare.solving.folders import LOCK
from compare.solving.runner import sweep
from compare.solving.store import Store
from compare.statistics.finding import Claim, Finding
from compare.studies.study import Judgement, Study
from scene.files.reading import InvalidInput

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

    def stored(self):
        """Tasks with an answer. Every answer that is there is whole."""
        stored = self.store.stored(self.tasks)
        assert len(stored) == len(self.store)
        return [task for task in self.tasks if task in stored]

    def begun(self, tasks):
        """How often each solve of tasks began so far."""
        begun = Counter(self.marks.read_text().split() if self.marks.exists() else ())
        return [begun[name] for task in tasks for name in marked_study.names(task)]

    def kill(self, more, seconds):
        """Start it, kill all of it in the middle, and see that nothing stored is lost or was solved again.

        more, seconds : solves that begin before, and time after the last of them. Returns whether it had not ended
        """
        before = self.stored()
        solves, begun = self.begun(before), sum(self.begun(self.tasks))
        process = self.start()
        wait_for(lambda: sum(self.begun(self.tasks)) >= begun + more or process.poll() is not None)
        time.sleep(seconds)
        ended = process.poll()
        if ended is None:
            os.killpg(process.pid, signal.SIGKILL)
        process.communicate(timeout=PATIENCE)
        assert ended in (None, 0)
        assert set(before) <= set(self.stored())
        assert self.begun(before) == solves
        return ended is None

    def finish(self, expected):
        """Run it to its end, and compare with undisturbed answers."""
        before = self.stored()
        fresh = [task for task in self.tasks if task not in before]
        solves, begun = self.begun(before), self.begun(fresh)
        status, _, told = finish(self.start())
        assert status == 0
        assert self.stored() == self.tasks
        assert self.begun(before) == solves
        assert self.begun(fresh) == [times + 1 for times in begun]
        assert f"{len(fresh)} tasks solved, {len(before)} reused" in told
        for task in self.tasks:
            assert exactly(self.store.get(task)) == expected[task]
        assert {path.name for path in self.folder.rglob(".*") if path.is_file()} == {LOCK}
        manifest = self.store.folder.parent / "collapse-quick" / "manifest.json"
        assert json.loads(manifest.read_text())


@pytest.fixture(scope="module")
def expected(tmp_path_factory):
    """Answers of an undisturbed sweep, whose workers have one thread as those of the command."""
    folder = tmp_path_factory.mktemp("undisturbed")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("MARKS", str(folder / "marks"))
        outcomes = sweep(marked_study.tasks(), Store(folder), workers=1).outcomes
        return {task: exactly(outcome) for task, outcome in outcomes.items()}


@pytest.mark.slow
def test_killed_at_twenty_moments_studies_end_as_undisturbed_ones(tmp_path, expected):
    draw, kills, studies = random.Random(20), 0, 0
    while kills < 20:
        (tmp_path / str(studies)).mkdir()
        study = Killed(tmp_path / str(studies))
        studies += 1
        while kills < 20 and len(study.stored()) < len(study.tasks):
            kills += study.kill(draw.randint(0, len(study.tasks) // 3), draw.uniform(0.0, 0.1))
        study.finish(expected)


def blank(tables):
    return Figure(figsize=(0.1, 0.1), layout="none")


@dataclass(frozen=True)
class Word(Study):
    """A study that solves nothing: title, findings, table, figure and results tell one word."""

    title: str

    def answers(self, outcomes):
        return xarray.DataTree.from_dict({"/a": xarray.Dataset({"word": self.title})})

    def judge(self, answers):
        table = DataFrame({"word": [self.title]})
        blocks = [Plot(f"{self.title}/picture", blank, {"points": table}, ""), Table(self.title, table)]
        return Judgement([Finding(Claim(self.title, self.title), 1.0)], [self.title], blocks)


def written(word, folder, **options):
    compare.solve(Word(word), folder, **options)
    return files(folder)


def files(folder):
    return {path.relative_to(folder).as_posix() for path in folder.rglob("*") if not path.is_dir()}


def of(word, *others):
    own = {f"{word}.csv", f"{word}/picture.png", f"{word}/points.csv", *others}
    return own | {LOCK, "findings.csv", "results.nc", "manifest.json"}


def killed(word, folder, step):
    """Whether a run was killed before it did so many things to its folder."""

    def to_its_death():
        steps = count(1)

        def dying(does):
            def done(*given, **named):
                if next(steps) == step:
                    os.kill(os.getpid(), signal.SIGKILL)
                return does(*given, **named)

            return done

        os.replace, os.unlink, os.rmdir = map(dying, (os.replace, os.unlink, os.rmdir))
        written(word, folder)

    process = multiprocessing.get_context("fork").Process(target=to_its_death)
    process.start()
    process.join()
    assert process.exitcode in (0, -signal.SIGKILL)
    return process.exitcode != 0


def titled(folder):
    """The word of the results, which is that of the page."""
    word = str(compare.load(folder)["a"]["word"].values)
    assert json.loads((folder / "manifest.json").read_text())["title"] == word
    assert f"<title>{word}</title>" in (folder / "report.html").read_text()
    return word


def test_a_new_scene_takes_the_place_of_all_that_the_one_before_it_left_and_of_nothing_else(tmp_path):
    assert written("one", tmp_path) == of("one", "report.html")
    mine = {"one/notes.txt", "one/mine.csv", "mine.pdf", "figures/one/picture.pdf", "two.md"}
    for name in mine:
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).touch()
    assert written("two", tmp_path) == of("two", "report.html") | mine
    assert written("three", tmp_path, report=False) == of("three") - {"three/picture.png"} | mine
    manifest = json.loads((tmp_path / "manifest.json").read_text())
    (tmp_path / "outside.csv").touch()
    forged = manifest | {
        "files": [*manifest["files"], "inside/outside.csv", "notes.txt", "a.csv", "notes.txt/b.csv"]
    }
    (tmp_path / "page/a.csv").mkdir(parents=True)
    (tmp_path / "page/inside").symlink_to(tmp_path)
    (tmp_path / "page/notes.txt").touch()
    (tmp_path / "page/manifest.json").write_text(json.dumps(forged))
    written("four", tmp_path / "page")
    assert (tmp_path / "outside.csv").exists()
    assert (tmp_path / "page/notes.txt").exists()


@pytest.mark.filterwarnings("ignore:This process:DeprecationWarning")
@pytest.mark.parametrize("stride", [7, pytest.param(3, marks=pytest.mark.slow)])
def test_killed_at_a_step_a_run_leaves_the_old_scene_or_says_that_it_did_not_end_and_the_next_clears_all(
    tmp_path, stride
):
    states = Counter()
    written("old", tmp_path)
    for step in count(1, stride):
        if not killed(f"new{step}", tmp_path, step):
            break
        whole = json.loads((tmp_path / "manifest.json").read_text()).get("finished", True)
        states[titled(tmp_path)[:3] if whole else "unfinished"] += 1
        for read in () if whole else (compare.load, compare.export):
            with pytest.raises(InvalidInput, match="has not come to its end, or was killed"):
                read(tmp_path)
        if step // stride % 3 == 2:
            assert written(f"old{step}", tmp_path) == of(f"old{step}", "report.html")
    assert titled(tmp_path) == f"new{step}"
    assert files(tmp_path) == of(f"new{step}", "report.html")
    assert states["old"] >= 1
    assert states["unfinished"] >= 20 / stride


def test_results_of_one_run_and_the_manifest_of_another_are_noticed(tmp_path):
    for word in ("one", "two"):
        written(word, tmp_path / word, report=False)
    (tmp_path / "one/results.nc").replace(tmp_path / "two/results.nc")
    with pytest.raises(InvalidInput, match=r"results\.nc: is of another run than manifest\.json beside it"):
        compare.load(tmp_path / "two")
    assert compare.load(tmp_path / "two/results.nc")["a"]["word"] == "one"


def test_while_a_run_holds_a_folder_others_are_refused_before_they_change_anything(tmp_path):
    below = tmp_path / "page"
    written("one", below, report=False)
    before, refused = {path: path.stat().st_mtime_ns for path in below.iterdir()}, []

    class Below(Word):
        place = "page"

        def judge(self, answers):
            another = threading.Thread(target=ask)
            another.start()
            another.join()
            ask()
            return super().judge(answers)

    def ask():
        for other in (compare.export, partial(compare.export, format="png"), partial(written, "two")):
            with pytest.raises(InvalidInput, match=f"{below}: another run holds this folder"):
                other(below)
            refused.append(other)
        with pytest.raises(InvalidInput, match=f"{tmp_path}: another run holds this folder"):
            compare.solve(Below("two"), tmp_path)
        assert {path: path.stat().st_mtime_ns for path in below.iterdir()} == before

    compare.solve(Below("three"), tmp_path, report=False)
    assert len(refused) == 6
    assert written("four", below, report=False) == of("four") - {"four/picture.png"}
