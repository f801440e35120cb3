"""The command as a person runs it: in a process of its own, from a file to a report."""

import inspect
import json
import os
import re
import signal
import subprocess
import sys
from io import BytesIO, TextIOWrapper

import pytest
from processes import ask, finish, start, stored_so_far, wait_for
from small_cases import SCENE, SMALL
from typer.testing import CliRunner

import compare
from compare.cli.app import app, print_in_any_encoding, say
from compare.library.ready import ready
from compare.solving.store import Store

# Solvers with a fault.
FAULTY = """
from bem3d import BEM
from compare.cli.app import main
from mdr1d import MDR


def solve(solver, scene):
    raise ZeroDivisionError("a fault")


BEM.solve = MDR.solve = solve
if __name__ == "__main__":
    main()
"""


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "tiny.toml").write_text(SCENE + SMALL)
    return tmp_path


@pytest.mark.slow
def test_an_interrupted_run_resumes_and_ends_in_a_report(folder):
    process = start(folder, "run", "tiny.toml", "--workers", "1")
    report = folder / "crosscheck-report"
    solved = report / "solved"
    wait_for(lambda: stored_so_far(solved) >= 3)
    # As from a keyboard: every process of the run gets it.
    os.killpg(process.pid, signal.SIGINT)
    status, _, complained = finish(process)
    assert status == 130
    assert "resumes" in complained
    assert "Traceback" not in complained
    kept = len(Store(solved))

    status, shown, page = finish(start(folder, "run", "tiny.toml", "--workers", "2"))
    assert (status, "tasks solved" in shown) == (0, False)
    assert kept >= 3
    assert f", {kept} reused" in page
    assert str(report / "report.html") in shown
    assert {path.suffix for path in (report / "tiny").iterdir()} == {".png", ".csv"}

    assert finish(start(folder, "run", "tiny.toml", "--no-report", "-q")) == (0, "", "")


@pytest.mark.slow
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


@pytest.mark.slow
@pytest.mark.parametrize(("number", "status"), [(signal.SIGTERM, 130), (signal.SIGHUP, 130), (signal.SIGKILL, -9)])
def test_no_worker_outlives_its_parent(folder, number, status):
    process = start(folder, "run", "tiny.toml", "--workers", "2")
    wait_for(lambda: stored_so_far(folder / "crosscheck-report" / "solved") > 0)
    process.send_signal(number)
    # The output ends when the last process that holds it has ended.
    assert finish(process)[0] == status


COMMANDS = {each.name: inspect.signature(each.callback).parameters for each in app.registered_commands}


@pytest.mark.parametrize("name", COMMANDS)
def test_a_command_has_the_arguments_and_defaults_of_its_function_and_says_what_each_is(name):
    python = inspect.signature(getattr(compare, name)).parameters
    if "options" in python:
        python = {**inspect.signature(compare.solve).parameters, **python}
    own = COMMANDS[name].keys() - {"quiet", "verbose", "json"}
    assert all(COMMANDS[name][each].default == python[each].default for each in own)
    assert python.keys() - own <= {"progress", "quantities", "options", "study", "output", "executor"}
    page = " ".join(ask(name, "--help").output.split())
    helps = [each.annotation.__metadata__[0].help for each in COMMANDS[name].values()]
    assert all(" ".join(each.split()) in page for each in helps)  # brackets included


@pytest.mark.parametrize(
    ("typed", "names"),
    [
        ("crosscheck run qui", ["quick-start", "quiet.toml"]),
        ("crosscheck study steep-a", ["steep-all-speeds", "steep-and-slow"]),
    ],
)
def test_a_shell_completes_names_and_values(typed, names, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "quiet.toml").touch()
    asked = {"_CROSSCHECK_COMPLETE": "complete_bash", "COMP_WORDS": typed, "COMP_CWORD": str(typed.count(" "))}
    assert CliRunner().invoke(app, [], env=asked, prog_name="crosscheck").output.split() == names


def test_the_schema_is_printed_or_written(tmp_path):
    path, printed = tmp_path / "schema.json", ask("schema", "study").output
    assert ask("schema", "study", "--output", path).exit_code == 0
    assert json.loads(path.read_text()) == json.loads(printed) == compare.schema("study")


MISTAKES = {
    "run zzzzzz": "the working directory, and no ready scene\n",
    "run two-shapes": "is a ready study, and no scene: crosscheck study two-shapes",
    "run thin-layer": "crosscheck plan says what each solver makes of it",
    "run quick-start --output mine.toml": "crosscheck: --output mine.toml: mine.toml: is a file, and no folder",
    "study colapse": "NAME = colapse: allowed are collapse, ",
    "study collapse --size big": "'--size': Value error, 'big' is not one of 'quick', 'standard', 'full'",
    "run quick-start --workers few": "'--workers': 'few' is not a number",
    "run quick-start --workers 0": "workers = 0: a whole number from 1 to ",
    "study mine.toml": "mine.toml: ",
    "workprecision paper-spere": "did you mean paper-sphere?",
    "new quick-start mine.toml": "is there already, and nothing is overwritten",
    "run quick-start --models bem,nothing": "'nothing': no model of that name",
    "export nowhere --journal acs": "nowhere: no such folder",
    "export . --format png": "no manifest.json here",
    "export . --format vtk,word": "format = word: allowed are vtk, png, pdf, svg",
    "run twice.toml": "twice",
    "run cylinder.toml": "indenter = Cylinder",
    "run apart.toml": "far apart",
    "run large.toml": "of processor time",
}
TEXTS = {
    "mine.toml": 'titel = "a mistake"\n',
    "scene.toml": ready()["quick-start"].text,
    "study.toml": ready()["two-shapes"].text,
    "twice.toml": SCENE + "[study]\nspeeds = [0.1, 0.1]\n",
    "cylinder.toml": SCENE.replace('"sphere"', '"cylinder"').replace("load = 1.0", "line_load = 1.0"),
    "apart.toml": SCENE.replace("load = 1.0", "depth = 1e300"),
    "large.toml": SCENE + "[bem]\npoints = 4096\n[study]\nsurfaces = 1000\n",
}


@pytest.mark.parametrize("words", MISTAKES)
def test_a_mistake_is_one_clear_line_and_status_2_before_anything_is_solved(tmp_path, monkeypatch, words):
    monkeypatch.chdir(tmp_path)
    for name, text in TEXTS.items():
        (tmp_path / name).write_text(text)
    answer = ask(*words.split())
    assert answer.exit_code == 2, answer.exception
    assert MISTAKES[words] in answer.stderr
    assert "Traceback" not in answer.output
    assert not answer.stdout
    assert {path.name: path.read_text() for path in tmp_path.iterdir()} == TEXTS


def printed(text, encoding, monkeypatch):
    """What a terminal of an encoding is sent of a text."""
    sent = BytesIO()
    monkeypatch.setattr("sys.stdout", TextIOWrapper(sent, encoding))
    print_in_any_encoding()
    say(text)
    return sent.getvalue().decode(encoding)


@pytest.mark.parametrize(
    ("encoding", "shown"),
    [
        ("utf-8", "−2 ± 1 Pa, 5 µm, 10¹⁰ 摩"),
        ("cp1252", r"\u22122 ± 1 Pa, 5 µm, 10¹\u2070 \u6469"),
        ("ascii", r"\u22122 \xb1 1 Pa, 5 \xb5m, 10\xb9\u2070 \u6469"),
    ],
)
def test_letters_that_an_encoding_lacks_are_printed_as_escapes(encoding, shown, monkeypatch):
    assert printed("−2 ± 1 Pa, 5 µm, 10¹⁰ 摩", encoding, monkeypatch) == f"{shown}\n"
    every = "".join(map(chr, range(0x3000))) + "\ud800\U0001f600"
    assert len(printed(every, encoding, monkeypatch)) > 0x3000


@pytest.mark.parametrize("command", ["plan", "trust"])
def test_nothing_that_a_file_says_controls_a_terminal(tmp_path, command):
    path = tmp_path / "\x1b[31m.toml"
    for text in (ready()["quick-start"].text, "[motion]\n", '"\\u001b[31m" = "\\u0007"\n'):
        path.write_text(re.sub("^title = .*", r'title = "\\u001b]0;\\u0007[red]"', text, flags=re.MULTILINE))
        answer = ask(command, path)
        assert answer.exit_code in (0, 2)
        assert all(line.isprintable() for line in answer.output.split("\n"))


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="there is no device that is always full")
@pytest.mark.parametrize("command", ["--help", "scenes"])
def test_output_onto_a_full_disk_is_one_line_and_status_1(folder, command):
    with open("/dev/full", "w", encoding="ascii") as full:
        status, _, complained = finish(start(folder, command, output=full))
    assert (status, complained) == (1, "crosscheck: standard output: No space left on device\n")


def test_a_fault_keeps_its_traceback(monkeypatch):
    def broken():
        raise ValueError("a fault")

    monkeypatch.setattr("compare.library.ready.ready", broken)
    answer = ask("new", "quick-start")
    assert isinstance(answer.exception, ValueError)
    assert answer.exit_code == 1


# What each command imports before it does anything: start-up is counted in modules, not in seconds. Help,
# versions and lists are asked for again and again, and by shells that complete words.
# Prints what is imported after each step.
PROGRAM = """
import contextlib, io, json, sys


def command(*arguments):
    from compare.cli.app import app
    with contextlib.redirect_stdout(io.StringIO()):
        try:
            app(list(arguments))
        except SystemExit as end:
            if end.code:
                raise


for step in json.loads(sys.argv[1]):
    exec(step)
    print(json.dumps(sorted(sys.modules)))
"""
HEAVY = {
    *("numpy", "pydantic", "pandas", "pint", "distributed", "dask", "scene"),
    *("xarray", "h5netcdf", "h5py"),  # on disk
    *("matplotlib", "jinja2"),  # drawing
    *("numba", "scipy", "ducc0", "pyfftw", "bem3d", "mdr1d"),  # solving
}
LISTED = HEAVY - {"pydantic"}
# The contacts of a run are in the same module as their judges, which need pandas, xarray and scipy.
PLANNED = {"pint", "distributed", "h5netcdf", "h5py", "matplotlib", "scipy.integrate", "scipy.interpolate"}
# Each step, what is there after it, and packages and modules that are not, in one process: from light to heavy.
STEPS = [
    ("import compare; dir(compare)", "compare", HEAVY | {"compare.cli.app", "compare.commands"}),
    ("from compare.library.ready import ready; ready()", "compare.library.ready", HEAVY),
    ("command('--help')", "typer", HEAVY),
    ("command('scenes')", "compare.library.ready", LISTED),
    (
        "command('plan', 'scene.toml')",
        "bem3d",
        PLANNED | {"compare.solving.runner", "compare.solving.store", "compare.studies.pipeline"},
    ),
    ("command('trust', 'scene.toml')", "compare.trustmap.table", PLANNED | {"compare.solving.runner"}),
]


@pytest.fixture(scope="module")
def walked(tmp_path_factory):
    """Names of the modules that are there after each step of a fresh process, of a Python without docstrings."""
    steps, folder = [step for step, *_ in STEPS], tmp_path_factory.mktemp("here")
    (folder / "scene.toml").write_text(SCENE)
    ended = subprocess.run(
        [sys.executable, "-c", PROGRAM, json.dumps(steps)],
        cwd=folder,
        capture_output=True,
        text=True,
        env=os.environ | {"PYTHONWARNINGS": "error", "PYTHONOPTIMIZE": "2"},
    )
    assert ended.returncode == 0, ended.stderr
    return {step: set(json.loads(line)) for step, line in zip(steps, ended.stdout.splitlines(), strict=True)}


@pytest.mark.parametrize(("step", "there", "unneeded"), STEPS)
def test_nothing_is_imported_before_it_is_needed(walked, step, there, unneeded):
    assert there in walked[step]  # the reader of modules sees what is there
    assert not walked[step] & unneeded
