"""The command as a person runs it: in a process of its own, from a file to a report."""

import json
import os
import re
import signal
import subprocess
import sys
import time

import pandas
import pytest
from test_compare_cases import SCENE
from typer.testing import CliRunner

from compare.cli import app
from compare.finding import COLUMNS
from compare.library import ready

TINY = (
    SCENE
    + """
[study]
speeds = [0.1, 1.0]
pressing = [0.5, 2.0]
load_speeds = [0.1]
depths = [1.0]
surfaces = 2
profiles = 2
[bem]
points = 32
[mdr]
points = 1000
"""
)
# Solvers with a fault.
FAULTY = """
from bem3d import BEM
from compare.cli import main
from mdr1d import MDR


def solve(solver, scene):
    raise ZeroDivisionError("a fault")


BEM.solve = MDR.solve = solve
if __name__ == "__main__":
    main()
"""
# A machine under load starts processes slowly.
PATIENCE = 120


def heed_signals():
    """Whoever runs the tests in the background ignores interrupts, and what is started inherits that."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_DFL)


def wait_for(condition):
    deadline = time.monotonic() + PATIENCE
    while not condition() and time.monotonic() < deadline:
        time.sleep(0.02)
    assert condition()


def start(folder, *arguments, program=("-m", "compare")):
    return subprocess.Popen(
        [sys.executable, *program, *arguments],
        cwd=folder,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
        preexec_fn=heed_signals,
        env=os.environ | {"PYTHONWARNINGS": "error"},
    )


def finish(process):
    said, complained = process.communicate(timeout=PATIENCE)
    return process.returncode, said, complained


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "tiny.toml").write_text(TINY)
    return tmp_path


def test_an_interrupted_run_resumes_and_ends_in_a_report(folder):
    process = start(folder, "run", "tiny.toml", "--workers", "1")
    solved = folder / "crosscheck-report" / "solved"
    wait_for(lambda: len(list(solved.glob("*.nc"))) >= 3)
    # As from a keyboard: every process of the run gets it.
    os.killpg(process.pid, signal.SIGINT)
    status, _, complained = finish(process)
    assert status == 130
    assert "resumes" in complained
    assert "Traceback" not in complained
    kept = len(list(solved.glob("*.nc")))

    status, said, complained = finish(start(folder, "run", "tiny.toml", "--workers", "2"))
    assert (status, complained) == (0, "")
    now, reused = map(int, re.search(r"(\d+) tasks solved, (\d+) reused", said).groups())
    assert reused == kept >= 3
    assert now > 0
    assert str(folder / "crosscheck-report" / "report.html") in said
    assert (folder / "crosscheck-report" / "tiny" / "friction-speed.png").exists()
    assert not list((folder / "crosscheck-report").rglob("*.pdf"))  # nobody asked for it
    findings = pandas.read_csv(folder / "crosscheck-report" / "findings.csv")
    assert list(findings.columns) == list(COLUMNS)

    status, said, complained = finish(start(folder, "run", "tiny.toml", "--no-report", "--json"))
    assert (status, complained) == (0, "")
    assert [each["claim"] for each in json.loads(said)["findings"]] == findings.claim.tolist()
    status, said, complained = finish(start(folder, "run", "tiny.toml", "--no-report", "-q"))
    assert (status, said, complained) == (0, "", "")


def test_a_users_table_is_shifted(folder):
    rows = [
        f"{(load * speed**-1.5 + 1) ** -0.5},{load},{speed}" for speed in (1, 2, 4) for load in (1, 2, 3, 4, 5)
    ]
    (folder / "ball.csv").write_text("\n".join(rows))
    status, said, complained = finish(start(folder, "mastercurve", "ball.csv"))
    assert (status, complained) == (0, "")
    assert "undecided" in said  # single measurements have no scatter
    assert list((folder / "mastercurve").glob("*.png"))
    (folder / "ball.csv").write_text("1,2\n")
    status, _, complained = finish(start(folder, "mastercurve", "ball.csv"))
    assert status == 2
    assert "ball.csv, line 1: 2 columns" in complained


def test_what_broke_is_told_with_its_reason_and_is_no_traceback_but_status_1(folder):
    (folder / "faulty.py").write_text(FAULTY)
    status, _, complained = finish(start(folder, "run", "tiny.toml", program=("faulty.py",)))
    assert status == 1
    broke, of = map(int, re.search(r"(\d+) of (\d+) tasks broke", complained).groups())
    traces = list((folder / "crosscheck-report" / "solved").glob("*.fault.txt"))
    assert len(traces) == broke <= of
    assert "ZeroDivisionError: a fault" in complained
    assert str(traces[0].parent) in complained
    assert "Traceback" not in complained


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["run", "two-shapes"], "is a ready study, and no scene: crosscheck study two-shapes"),
        (["run", "study.toml"], "is a study, and no scene: crosscheck study study.toml"),
        (["study", "hertz"], "is a ready scene, and no study: crosscheck run hertz"),
        (["study", "thin-layer"], "is a ready scene, and no study: crosscheck plan thin-layer"),
        (["study", "scene.toml"], "is a scene, and no study: crosscheck run scene.toml"),
        (["run", "."], "is a folder, and no scene"),
        (["run", "scene.toml", "--output", "scene.toml"], "scene.toml: is a file, and no folder"),
        (["run", "thin-layer"], "crosscheck plan says what each solver makes of it"),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, list) else "",
)
def test_what_is_asked_of_the_wrong_command_is_told_of_the_right_one(tmp_path, monkeypatch, arguments, message):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "scene.toml").write_text(ready()["quick-start"].text)
    (tmp_path / "study.toml").write_text(ready()["two-shapes"].text)
    answer = ask(*arguments)
    assert (answer.exit_code, "Traceback" in answer.output) == (2, False)
    assert message in answer.stderr


def test_studies_are_listed_and_mistakes_are_said_before_anything_is_solved(folder):
    status, said, complained = finish(start(folder, "study"))
    assert (status, complained) == (0, "")
    assert max(map(len, said.splitlines())) < 80
    for name in ("collapse", "solids", "hurst", "parameters", "regime", "depth"):
        assert re.search(rf"^{name} +[A-Z]", said, re.MULTILINE)
    (folder / "file").touch()
    for arguments, message in (
        (["collaps"], "NAME = collaps: allowed are collapse, "),
        (["collapse", "--size", "big"], "size = big: allowed are quick, "),
        (["collapse", "--output", "file"], "crosscheck: --output file: "),
    ):
        status, said, complained = finish(start(folder, "study", *arguments))
        assert (status, said) == (2, "")
        assert message in complained
        assert "Traceback" not in complained
    assert not (folder / "crosscheck-study").exists()


def test_what_accuracy_costs_is_listed_and_mistakes_are_said_before_anything_is_solved(folder):
    status, said, complained = finish(start(folder, "workprecision"))
    assert (status, complained) == (0, "")
    assert max(map(len, said.splitlines())) < 100
    for name in ("models", "surfaces", "mdr", "elastic", "sliding", "marching", "precision", "extent", "costs"):
        assert re.search(rf"^{name} +[A-Z]", said, re.MULTILINE)
    for arguments, message in (
        (["workprecision", "model"], "NAME = model: allowed are models, "),
        (["workprecision", "models", "--size", "large"], "size = large: allowed are quick, standard, full"),
        (["stability", "--size", "small"], "size = small: allowed are quick, standard, full"),
    ):
        status, said, complained = finish(start(folder, *arguments))
        assert (status, said) == (2, "")
        assert message in complained
        assert "Traceback" not in complained
    assert not list(folder.glob("crosscheck-*"))


@pytest.mark.parametrize(("number", "status"), [(signal.SIGTERM, 130), (signal.SIGHUP, 130), (signal.SIGKILL, -9)])
def test_no_worker_outlives_its_parent(folder, number, status):
    process = start(folder, "run", "tiny.toml", "--workers", "2")
    wait_for(lambda: any((folder / "crosscheck-report" / "solved").glob("*.nc")))
    process.send_signal(number)
    # The output ends when the last process that holds it has ended.
    assert finish(process)[0] == status


def ask(*arguments):
    """In this process, for what solves nothing."""
    return CliRunner().invoke(app, list(map(str, arguments)))


def test_ready_scenes_and_studies_are_listed_copied_and_never_overwrite(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    listed = ask("list")
    assert listed.exit_code == 0
    for name in ready():
        assert re.search(rf"^{name} +[A-Z]", listed.output, re.MULTILINE)
    copied = ask("new", "quick-start")
    assert copied.exit_code == 0
    assert "crosscheck run quick-start.toml" in copied.output
    assert (tmp_path / "quick-start.toml").read_text() == ready()["quick-start"].text
    (tmp_path / "quick-start.toml").write_text("mine")
    again = ask("new", "quick-start")
    assert again.exit_code == 2
    assert "is there already, and nothing is overwritten" in again.stderr
    assert (tmp_path / "quick-start.toml").read_text() == "mine"
    compared, alone = listed.output.split("Scenes that nothing compares, crosscheck plan NAME:")
    assert "\nhertz " in compared
    assert "\nthin-layer " in alone
    assert "crosscheck plan thin-layer.toml" in ask("new", "thin-layer").output
    unknown = ask("new", "quick-strat")
    assert unknown.exit_code == 2
    assert unknown.stderr.strip().endswith("did you mean quick-start?")


@pytest.mark.parametrize("kind", ["scene", "study"])
def test_the_schema_is_printed_or_written(tmp_path, kind):
    printed = ask("schema", kind)
    assert printed.exit_code == 0
    path = tmp_path / "schema.json"
    assert ask("schema", kind, "--output", path).exit_code == 0
    assert json.loads(path.read_text()) == json.loads(printed.output)
    assert "$schema" in json.loads(printed.output)
    assert ask("schema", "scenes").exit_code == 2


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["run", "nowhere.toml"], "nowhere.toml: no such file, and no ready scene"),
        (["plan", "quick-strat"], "did you mean quick-start?"),
        (["study", "colapse"], "NAME = colapse: allowed are collapse, "),
        (["study", "mine.toml"], "mine.toml: "),
        (["figures", "nowhere"], "nowhere: no such folder"),
        (["figures", "."], "no manifest.json here"),
        (["export", ".", "--to", "word"], "to = word: allowed are csv, latex"),
        (["export", "nowhere"], "nowhere"),
        (["mastercurve", "nowhere.csv"], "nowhere.csv"),
        (["topography", "nowhere.npy"], "nowhere.npy"),
        (["regress", "--baseline", "nowhere.toml"], "nowhere.toml"),
        (["animate", "nowhere.toml"], "nowhere.toml"),
        (["animate", "quick-start", "--output", "film.avi"], "film.avi"),
        (["run", "quick-start", "--output", "mine.toml"], "--output mine.toml: "),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, list) else "",
)
def test_a_mistake_is_one_clear_line_and_status_2(tmp_path, monkeypatch, arguments, message):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mine.toml").write_text('titel = "a mistake"\n')
    answer = ask(*arguments)
    assert answer.exit_code == 2, answer.exception
    assert message in answer.stderr
    assert "Traceback" not in answer.output
    assert [path.name for path in tmp_path.iterdir()] == ["mine.toml"]


def test_a_fault_keeps_its_traceback(monkeypatch):
    def broken():
        raise ValueError("a fault")

    monkeypatch.setattr("compare.library.ready", broken)
    answer = ask("new", "quick-start")
    assert isinstance(answer.exception, ValueError)
    assert answer.exit_code == 1
