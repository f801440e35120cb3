"""Killed at any instant, a folder has one run whole or says that it has none; no runs are mixed."""

import json
import multiprocessing
import os
import signal
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import partial
from itertools import count

import pytest
import xarray
from matplotlib.figure import Figure
from pandas import DataFrame

import compare
from compare.figures.plot import Plot
from compare.report.page import Table
from compare.solving.folders import LOCK
from compare.statistics.finding import Claim, Finding
from compare.studies.study import Judgement, Study
from scene.files.reading import InvalidInput


def blank(tables):
    return Figure(figsize=(0.1, 0.1), layout="tight")


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
    """Whether a run was killed before it had taken `step` steps in its folder."""

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
    """The word of the results, which has to be the word of the page."""
    word = str(compare.load(folder)["a"]["word"].values)
    assert json.loads((folder / "manifest.json").read_text())["title"] == word
    assert f"<title>{word}</title>" in (folder / "report.html").read_text()
    return word


def test_a_new_scene_takes_the_place_of_all_that_the_one_before_it_left_and_of_nothing_else(tmp_path):
    assert written("one", tmp_path) == of("one", "report.html")
    mine = {"one/notes.txt", "one/mine.csv", "mine.pdf", "figures/one/picture.pdf", "two.md"}
    mine |= {".hidden", ".crosscheck-notes.part.csv", "mine.part"}
    for name in (*mine, ".crosscheck-0123456789abcdef.part"):  # the last half written by a killed run
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
def test_killed_at_a_step_a_run_leaves_the_old_scene_or_says_that_it_did_not_end_and_the_next_clears_all(tmp_path):
    states, stride = Counter(), 7
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


def test_while_a_run_holds_a_folder_others_are_refused_before_they_change_anything(tmp_path):
    below = tmp_path / "page"
    written("one", below, report=False)
    before, refused = {path: path.stat().st_mtime_ns for path in below.iterdir()}, []

    class Below(Word):
        place = "page"

        def judge(self, answers):
            with ThreadPoolExecutor(1) as another:
                another.submit(ask).result()
            ask()
            return super().judge(answers)

    def ask():
        solve = partial(compare.solve, Below("two"))
        for other, folder in ((partial(written, "two"), below), (solve, tmp_path)):
            with pytest.raises(InvalidInput, match=f"{folder}: another run holds this folder"):
                other(folder)
            refused.append(other)
        assert {path: path.stat().st_mtime_ns for path in below.iterdir()} == before

    compare.solve(Below("three"), tmp_path, report=False)
    assert len(refused) == 4
    assert written("four", below, report=False) == of("four") - {"four/picture.png"}
