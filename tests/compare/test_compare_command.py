"""The command as a person runs it: in a process of its own, from a file to a report."""

import inspect
import json
import os
import re
import signal
from io import BytesIO, TextIOWrapper

import pandas
import pytest
from processes import finish, start, wait_for
from scene_files import SCENE, SMALL
from typer.testing import CliRunner

import compare
from compare import commands
from compare.cli.app import app
from compare.cli.console import print_in_any_encoding, say
from compare.library.ready import ready
from compare.solving.store import Store
from compare.statistics.finding import COLUMNS

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
    solved = folder / "crosscheck-report" / "solved"
    wait_for(lambda: len(Store(solved)) >= 3)
    os.killpg(process.pid, signal.SIGSTOP)
    (folder / "other.toml").write_text((SCENE + SMALL).replace("0.1", "0.2"))
    status, said, complained = finish(start(folder, "run", "other.toml"))
    assert (status, said) == (2, "")
    assert complained.startswith("crosscheck: crosscheck-report: another run holds this folder")
    os.killpg(process.pid, signal.SIGCONT)
    # As from a keyboard: every process of the run gets it.
    os.killpg(process.pid, signal.SIGINT)
    status, _, complained = finish(process)
    assert status == 130
    assert "resumes" in complained
    assert "Traceback" not in complained
    kept = len(Store(solved))

    status, said, told = finish(start(folder, "run", "tiny.toml", "--workers", "2"))
    assert (status, "tasks solved" in said) == (0, False)
    now, reused = map(int, re.search(r"(\d+) tasks solved, (\d+) reused", told).groups())
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
    wait_for(lambda: len(Store(folder / "crosscheck-report" / "solved")) > 0)
    process.send_signal(number)
    # The output ends when the last process that holds it has ended.
    assert finish(process)[0] == status


def ask(*arguments):
    """In this process, for what solves nothing."""
    return CliRunner().invoke(app, list(map(str, arguments)))


COMMANDS = {each.name: inspect.signature(each.callback).parameters for each in app.registered_commands}
PYTHON_ONLY = {"progress", "quantities", "options"}
PRINTED = {"quiet", "verbose", "json"}


@pytest.mark.parametrize("name", COMMANDS)
def test_a_command_has_the_arguments_and_defaults_of_its_function_and_says_what_each_is(name):
    function = inspect.signature(getattr(compare, name)).parameters
    shared = commands.Options.__annotations__ if "options" in function else ()
    solve = inspect.signature(compare.solve).parameters
    python = {
        **{each: solve[each].default for each in shared},
        **{each: function[each].default for each in function},
    }
    asked = {each: parameter.default for each, parameter in COMMANDS[name].items()}
    assert {each: asked[each] for each in asked.keys() - PRINTED} == {
        each: python[each] for each in python.keys() - PYTHON_ONLY
    }
    told = " ".join(ask(name, "--help").output.split())
    helps = [part.help for each in COMMANDS[name].values() for part in each.annotation.__metadata__[:1]]
    assert all(each and " ".join(each.split()) in told for each in helps)  # brackets included


def complete(*words):
    """What a shell is given for the last word."""
    asked = {
        "_CROSSCHECK_COMPLETE": "complete_bash",
        "COMP_WORDS": " ".join(["crosscheck", *words]),
        "COMP_CWORD": str(len(words)),
    }
    return CliRunner().invoke(app, [], env=asked, prog_name="crosscheck").output.split()


def test_a_shell_completes_names_and_values(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "quiet.toml").touch()
    for command in ("run", "plan", "trust", "draw"):
        assert complete(command, "qui") == ["quick-start", "quiet.toml"]
    assert complete("study", "steep-") == ["steep-all-speeds", "steep-and-slow", "steep-on-fine-grids"]
    assert complete("new", "quick") == ["quick-start"]
    assert complete("workprecision", "su") == ["surfaces"]
    assert complete("redraw", "folder", "--journal", "el") == ["elsevier"]
    assert complete("run", "quick-start", "--figure-f") == ["--figure-format"]


@pytest.mark.parametrize("kind", ["scene", "study"])
def test_the_schema_is_printed_or_written(tmp_path, kind):
    printed = ask("schema", kind)
    assert printed.exit_code == 0
    path = tmp_path / "schema.json"
    assert ask("schema", kind, "--output", path).exit_code == 0
    assert json.loads(path.read_text()) == json.loads(printed.output)
    assert "$schema" in json.loads(printed.output)


MISTAKES = {
    "run zzzzzz": "zzzzzz: no such file, and no ready scene\n",
    "run two-shapes": "is a ready study, and no scene: crosscheck study two-shapes",
    "run study.toml": "is a study, and no scene: crosscheck study study.toml",
    "run thin-layer": "crosscheck plan says what each solver makes of it",
    "run quick-start --output mine.toml": "crosscheck: --output mine.toml: mine.toml: is a file, and no folder",
    "study colapse": "NAME = colapse: allowed are collapse, ",
    "study collapse --size big": "'--size': Value error, 'big' is not one of 'quick', 'standard', 'full'",
    "run quick-start --workers few": "'--workers': 'few' is not a number",
    "run quick-start --workers 0": "workers = 0: a whole number from 1 to ",
    "run quick-start --figure-format gif": "figure_format = gif: allowed are png, ",
    "study mine.toml": "mine.toml: ",
    "workprecision model": "'name': Value error, 'model' is not one of 'models', ",
    "new quick-start mine.toml": "is there already, and nothing is overwritten",
    "redraw nowhere": "nowhere: no such folder",
    "redraw .": "no manifest.json here",
    "export . --to word": "'--to': Value error, 'word' is not one of 'csv', 'vtk'",
}


@pytest.mark.parametrize("said", MISTAKES)
def test_a_mistake_is_one_clear_line_and_status_2_before_anything_is_solved(tmp_path, monkeypatch, said):
    monkeypatch.chdir(tmp_path)
    texts = {
        "mine.toml": 'titel = "a mistake"\n',
        "scene.toml": ready()["quick-start"].text,
        "study.toml": ready()["two-shapes"].text,
    }
    for name, text in texts.items():
        (tmp_path / name).write_text(text)
    answer = ask(*said.split())
    assert answer.exit_code == 2, answer.exception
    assert MISTAKES[said] in answer.stderr
    assert "Traceback" not in answer.output
    assert not answer.stdout
    assert {path.name: path.read_text() for path in tmp_path.iterdir()} == texts


def printed(text, encoding, monkeypatch):
    """What a terminal of an encoding is sent of a text."""
    sent = BytesIO()
    monkeypatch.setattr("sys.stdout", TextIOWrapper(sent, encoding))
    print_in_any_encoding()
    say(text)
    return sent.getvalue().decode(encoding)


@pytest.mark.parametrize(
    ("encoding", "said"),
    [
        ("utf-8", "−2 ± 1 × 10⁻¹² Pa, λ ≤ 5 µm, 3 · 10¹⁰ h₀, 摩"),
        ("cp1252", r"-2 ± 1 × 10^-12 Pa, lambda <= 5 µm, 3 · 10¹\u2070 h0, \u6469"),
        ("latin-1", r"-2 ± 1 × 10^-12 Pa, lambda <= 5 µm, 3 · 10¹\u2070 h0, \u6469"),
        ("ascii", r"-2 +- 1 x 10^-12 Pa, lambda <= 5 um, 3 * 10^10 h0, \u6469"),
    ],
)
def test_letters_that_an_encoding_lacks_have_stand_ins_that_say_the_same_number(encoding, said, monkeypatch):
    assert printed("−2 ± 1 × 10⁻¹² Pa, λ ≤ 5 µm, 3 · 10¹⁰ h₀, 摩", encoding, monkeypatch) == f"{said}\n"
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


def test_in_python_without_docstrings_commands_run_as_ever(folder):
    status, said, complained = finish(start(folder, "scenes", PYTHONOPTIMIZE="2"))
    assert (status, complained) == (0, "")
    assert "quick-start" in said


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="there is no device that is always full")
@pytest.mark.parametrize("command", ["--help", "scenes"])
def test_output_onto_a_full_disk_is_one_line_and_status_1(folder, command):
    with open("/dev/full", "w", encoding="ascii") as full:
        status, _, complained = finish(start(folder, command, output=full))
    assert (status, complained) == (1, "crosscheck: standard output: No space left on device\n")


@pytest.mark.skipif(os.name == "nt", reason="Windows deletes no folder that is in use")
def test_a_folder_that_is_gone_is_one_line_and_status_2(tmp_path, monkeypatch):
    (tmp_path / "gone").mkdir()
    monkeypatch.chdir(tmp_path / "gone")
    (tmp_path / "gone").rmdir()
    answer = ask("run", "hertz", "--output", tmp_path / "elsewhere")
    assert (answer.exit_code, answer.output) == (2, "crosscheck: the folder in which it is called is gone\n")
    assert not [*tmp_path.iterdir()]


def test_a_fault_keeps_its_traceback(monkeypatch):
    def broken():
        raise ValueError("a fault")

    monkeypatch.setattr("compare.library.ready.ready", broken)
    answer = ask("new", "quick-start")
    assert isinstance(answer.exception, ValueError)
    assert answer.exit_code == 1
