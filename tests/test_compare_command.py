"""The command as a person runs it: in a process of its own, from a file to a report."""

import json
import os
import re
import signal
import subprocess
import sys
import time

import pytest
from test_compare_cases import SCENE

TINY = (
    SCENE
    + """
[study]
speeds = [0.1, 1.0]
pressing = [0.5, 1.0, 2.0, 4.0]
load_speeds = [0.1, 0.3]
depths = [0.5, 1.0]
surfaces = 2
profiles = 2
[bem]
points = 32
[mdr]
points = 1000
"""
)
# Two studies that ask for the same contacts, the second for more.
STUDIES = """
from dataclasses import replace

from bem3d import BEM
from compare.__main__ import main
from compare.studies.catalogue import STUDIES, Study, kelvin
from compare.studies.series import Series
from mdr1d import MDR


def study(presses):
    scene = kelvin("sphere")
    scene = replace(scene, roughness=replace(scene.roughness, shortest=2e-3, seed=1))
    solvers = {"bem": BEM(points=32), "mdr": MDR(points=500)}
    series = Series("s", "Sphere", scene, (0.05, 0.1), presses, surfaces=2, profiles=2, **solvers)
    return Study("Tiny", "A few contacts.", lambda size: [series])


if __name__ == "__main__":
    STUDIES.update(collapse=study((5.0, 10.0)), hurst=study((5.0, 10.0, 20.0)))
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
    wait_for(lambda: len(list(solved.glob("*.json"))) >= 3)
    # As from a keyboard: every process of the run gets it.
    os.killpg(process.pid, signal.SIGINT)
    status, _, complained = finish(process)
    assert status == 130
    assert "resumes" in complained
    assert "Traceback" not in complained
    kept = len(list(solved.glob("*.json")))

    status, said, complained = finish(start(folder, "run", "tiny.toml", "--workers", "2"))
    assert (status, complained) == (0, "")
    now, reused = map(int, re.search(r"(\d+) tasks solved, (\d+) reused", said).groups())
    assert reused == kept >= 3
    assert now > 0
    assert str(folder / "crosscheck-report" / "report.html") in said
    assert "tends to 2" in said
    assert "1D / 3D friction at the scene's own point" in said
    assert (folder / "crosscheck-report" / "tiny" / "collapse.pdf").exists()
    manifest = json.loads((folder / "crosscheck-report" / "manifest.json").read_text())
    assert manifest["tasks"] == {"solved": now, "reused": reused}


def test_the_paper_is_simulated_and_judged(folder):
    status, said, complained = finish(start(folder, "paper", "--profiles", "3", "--workers", "2"))
    assert (status, complained) == (0, "")
    assert "Eq. 17" in said
    page = folder / "crosscheck-paper" / "paper.html"
    assert str(page) in said
    assert (folder / "crosscheck-paper" / "paper-studies.pdf").exists()
    manifest = json.loads((folder / "crosscheck-paper" / "manifest.json").read_text())
    assert {claim["verdict"] for claim in manifest["claims"]} <= {"holds", "fails", "undecided"}
    text = page.read_text()
    assert all(f'id="{claim["figure"]}"' in text for claim in manifest["claims"])
    assert "seeds in the manifest" not in text  # it has none
    assert re.search(r"pydantic [\d.]+\. ", text)


def test_a_users_table_is_shifted(folder):
    rows = [
        f"{(load * speed**-1.5 + 1) ** -0.5},{load},{speed}" for speed in (1, 2, 4) for load in (1, 2, 3, 4, 5)
    ]
    (folder / "ball.csv").write_text("\n".join(rows))
    status, said, complained = finish(start(folder, "mastercurve", "ball.csv"))
    assert (status, complained) == (0, "")
    assert "undecided" in said  # single measurements have no scatter
    assert (folder / "mastercurve" / "shifted-curves-ball.pdf").exists()
    (folder / "ball.csv").write_text("1,2\n")
    status, _, complained = finish(start(folder, "mastercurve", "ball.csv"))
    assert status == 2
    assert "ball.csv, line 1: 2 columns" in complained


def counts(said):
    return tuple(map(int, re.search(r"(\d+) tasks solved, (\d+) reused", said).groups()))


def test_an_interrupted_study_resumes_and_another_shares_what_is_solved(folder):
    (folder / "studies.py").write_text(STUDIES)
    ask = {"program": ("studies.py", "study")}
    process = start(folder, "collapse", "--workers", "1", **ask)
    solved = folder / "crosscheck-study" / "solved"
    wait_for(lambda: len(list(solved.glob("*.json"))) >= 3)
    process.send_signal(signal.SIGTERM)
    status, _, complained = finish(process)
    assert (status, "resumes" in complained, "Traceback" in complained) == (130, True, False)
    kept = sorted(solved.glob("*.json"))
    kept[0].write_text("{")

    status, said, complained = finish(start(folder, "collapse", "--workers", "2", **ask))
    assert (status, complained) == (0, "")
    now, reused = counts(said)
    assert reused == len(kept) - 1  # all but the damaged one
    page = folder / "crosscheck-study" / "collapse-quick" / "study.html"
    assert str(page) in said
    assert "friction in 1D is that in 3D, smooth" in said
    assert "nan" not in said
    assert page.exists()
    assert counts(finish(start(folder, "collapse", **ask))[1]) == (0, now + reused)

    status, said, complained = finish(start(folder, "hurst", "--workers", "2", **ask))
    assert (status, complained) == (0, "")
    more, shared = counts(said)
    assert shared == now + reused
    assert more == shared // 2  # three presses for two
    assert page.exists()


def test_studies_are_listed_and_mistakes_are_said_before_anything_is_solved(folder):
    status, said, complained = finish(start(folder, "study"))
    assert (status, complained) == (0, "")
    assert max(map(len, said.splitlines())) < 80
    for name in ("collapse", "solids", "hurst", "parameters", "regime", "depth"):
        assert re.search(rf"^{name} +[A-Z]", said, re.MULTILINE)
    (folder / "file").touch()
    for arguments, message in (
        (["collaps"], "NAME = collaps: allowed are collapse, "),
        (["collapse", "--size", "big"], "--size = big: allowed are quick, "),
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
        (["workprecision", "models", "--size", "large"], "--size = large: allowed are quick, full"),
        (["stability", "--size", "full"], "--size = full: allowed are small, large"),
    ):
        status, said, complained = finish(start(folder, *arguments))
        assert (status, said) == (2, "")
        assert message in complained
        assert "Traceback" not in complained
    assert not list(folder.glob("crosscheck-*"))


@pytest.mark.parametrize(("number", "status"), [(signal.SIGTERM, 130), (signal.SIGHUP, 130), (signal.SIGKILL, -9)])
def test_no_worker_outlives_its_parent(folder, number, status):
    process = start(folder, "run", "tiny.toml", "--workers", "2")
    wait_for(lambda: any((folder / "crosscheck-report" / "solved").glob("*.json")))
    process.send_signal(number)
    # The output ends when the last process that holds it has ended.
    assert finish(process)[0] == status


def test_help_and_version_are_quick_and_load_nothing_heavy(folder):
    code = "import sys, compare.__main__; print({'numpy', 'scipy', 'matplotlib'} & set(sys.modules))"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True).stdout.strip() == "set()"
    status, said, _ = finish(start(folder, "--version"))
    assert status == 0
    assert re.fullmatch(r"\d+\.\d+\.\d+\n", said)
    status, said, _ = finish(start(folder, "--help"))
    assert status == 0
    assert "run" in said
