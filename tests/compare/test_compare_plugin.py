"""The plugin for pytest, in projects of a test or two: what it keeps, and what it says."""

import re
import tomllib

import pytest
from imports import ROOT
from small_cases import SLIDING

from bem3d import BEM
from compare.studies.checks.accuracy import Accuracy, findings
from mdr1d import MDR
from scene.files.reading import InvalidInput

pytest_plugins = ["pytester"]
SCENE = """
[indenter]
type = "sphere"
radius = 0.01
[elastomer]
type = "kelvin"
modulus = 1e6
relaxation_time = 1e-3
[motion]
type = "slide"
speed = 0.1
load = 1.0
"""
ROUGH = """
[roughness]
type = "self-affine"
hurst = 0.8
rms_height = 1e-6
longest = 1e-2
shortest = 1e-3
seed = 5
"""
# Models whose numbers are stated: their friction scatters by surface, and their grid errs by a share over points.
MODELS = """
from dataclasses import dataclass
from pathlib import Path

from scene import Result

@dataclass(frozen=True)
class Stated:
    name: str
    friction: float = 0.1
    scatter: float = 0.0
    grid: float = 0.0
    points: int = 100

    def solve(self, scene):
        with Path("solved.txt").open("a") as file:
            file.write(f"{self.name}\\n")
        seed = getattr(scene.roughness, "seed", 0)
        mu = self.friction * (1 + self.scatter * (-1) ** seed) * (1 + 100 * self.grid / self.points)
        return Result(scene, self.name, {}, scene.motion.load, self.friction * 1e-3, mu * scene.motion.load)

def pair(ratio=1.0, **others):
    return [Stated("one", 0.1 * ratio, **others), Stated("two")]
"""


@pytest.fixture(scope="module")
def imported(tmp_path_factory):
    """What a check imports, here: what a project imports in this process is forgotten with it."""
    study = Accuracy.of(SLIDING, {"depth": 0.5}, models=[MDR(points=512), BEM(points=32)], surfaces=2, profiles=2)
    (found,) = findings(study, tmp_path_factory.mktemp("imported"))
    assert found.value == pytest.approx(1.0, abs=0.2)


@pytest.fixture
def project(pytester, imported):
    """A project with a scene, the models, and tests that are given; runs it and returns the result."""
    pytester.makepyfile(models=MODELS)
    pytester.makefile(".toml", seal=SCENE, rough=SCENE + ROUGH)

    def run(*tests, options=()):
        body = "\n".join(f"def test_{k}(mdr_accuracy):\n    mdr_accuracy.{test}" for k, test in enumerate(tests))
        pytester.makepyfile(test_mine=f"from models import pair\n{body}")
        # hypothesis imports itself at the end of a session, which takes seconds
        return pytester.runpytest_inprocess("-p", "no:hypothesispytest", *options)

    return run


def text(result):
    return " ".join(result.stdout.str().split())


def test_a_check_passes_only_if_the_whole_interval_lies_inside(project):
    of = 'check("seal.toml", models=pair({}), friction={})'
    project(of.format("1.04", 0.05), of.format("1.06", 0.07)).assert_outcomes(passed=2)
    # the error of the grid is 0.02 here: it makes the interval of 1.04 as wide
    result = project(
        of.format("1.06", 0.05), of.format("1.04, grid=0.01", 0.07), of.format("1.04, grid=0.03", 0.06)
    )
    result.assert_outcomes(passed=1, failed=2)
    output = text(result)
    assert "seal: friction one/two: fails, expected 1 ± 0.05, found 1.06" in output
    assert re.search(
        r"seal: friction one/two: undecided, expected 1 ± 0.06, found 1.071 \(1.04\d* to 1.1\d*\)", output
    )
    assert "a finer grid would decide it" in output


def test_an_undecided_check_says_how_many_surfaces_would_decide_it(project):
    asked = 'check("rough.toml", models=pair(1.0, scatter=0.1), friction=0.05, surfaces={})'
    result = project(asked.format(4), asked.format(400))
    result.assert_outcomes(passed=1, failed=1)
    assert re.search(r"undecided, .* some \d+ more surfaces, .* would decide it", text(result))


def test_the_first_run_writes_a_file_beside_the_test_and_later_ones_hold_against_it(project, pytester):
    asked = 'regression("seal.toml", models=pair({}), tolerance=1e-3)'
    result = project(asked.format(1.5))
    result.assert_outcomes(failed=1)
    file = pytester.path / "test_mine" / "test_0.toml"
    assert f"{file} is written" in text(result).replace("\n", "")
    assert tomllib.loads(file.read_text())["values"] == {"seal.depth": 1.5, "seal.friction": 1.5}
    project(asked.format(1.5)).assert_outcomes(passed=1)
    project(asked.format(1.501)).assert_outcomes(passed=1)  # within the tolerance
    result = project(asked.format(1.6))
    result.assert_outcomes(failed=1)
    assert "seal: friction one/two: fails, expected 1.5 ± 0.0015, found 1.6" in text(result)
    assert "--mdr-regen stores them" in text(result)
    assert "1.6" not in file.read_text()
    result = project(asked.format(1.6), options=["--mdr-regen"])
    result.assert_outcomes(failed=1)
    assert tomllib.loads(file.read_text())["values"] == {"seal.depth": 1.6, "seal.friction": 1.6}
    project(asked.format(1.6), options=["--mdr-regen"]).assert_outcomes(passed=1)


def test_what_is_solved_is_kept_in_the_cache_or_for_the_session(project, pytester, monkeypatch):
    asked = 'check("seal.toml", models=pair(), friction=0.05, depth=0.05)'
    solved = pytester.path / "solved.txt"
    # workers of xdist have a store each
    for worker, options, count in (
        ("gw0", (), 4),
        ("gw1", (), 8),
        ("gw1", (), 8),
        ("gw1", ("-p", "no:cacheprovider"), 12),
    ):
        monkeypatch.setenv("PYTEST_XDIST_WORKER", worker)
        project(asked, asked, options=options).assert_outcomes(passed=2)
        assert len(solved.read_text().split()) == count  # two models, each on two grids
    stores = pytester.path / ".pytest_cache" / "d" / "crosscheck"
    assert {each.name for each in stores.iterdir()} == {"gw0", "gw1"}


def test_mistakes_are_named(project):
    result = project(
        'check("seal.toml", models=pair())',
        'check("seal.toml", models=pair(), force=0.1)',
        'check("absent.toml", friction=0.1)',
        'check("seal.toml", models=["mdr", "bemm"], friction=0.1)',
    )
    result.assert_outcomes(failed=4)
    for each in ("say how far from 1", "has depth and friction to compare", "no such file", "did you mean bem?"):
        assert each in text(result)


def test_models_are_named_and_their_settings_are_those_of_the_scene():
    found = Accuracy.of(SLIDING, {"friction": 0.1}, models=["mdr", "bem"])
    assert [each.solver for each in found.series[0].models] == [MDR(points=5000), BEM(points=128)]
    assert list(found.within) == ["friction_coefficient"]
    with pytest.raises(InvalidInput, match="at least two are compared"):
        Accuracy.of(SLIDING, {}, models=["mdr"])


INSTALLED = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["entry-points"]["pytest11"]
QUIET = """
import sys

def test_nothing_of_ours_is_imported(request):
    heavy = "scene", "mdr1d", "bem3d", "compare", "numpy"
    ours = {name for name in sys.modules if name.partition(".")[0] in heavy}
    assert ours == {"compare", "compare.studies", "compare.studies.checks", "compare.studies.checks.plugin"}
"""


@pytest.fixture
def installed(pytester, monkeypatch):
    """A project into which the plugin is installed as the package says; runs it in a process of its own."""
    written = "".join(f"{name} = {module}\n" for name, module in INSTALLED.items())
    folder = pytester.mkdir("installed") / "mine-1.dist-info"
    folder.mkdir()
    (folder / "METADATA").write_text("Metadata-Version: 2.1\nName: mine\nVersion: 1\n")
    (folder / "entry_points.txt").write_text(f"[pytest11]\n{written}")
    monkeypatch.setenv("PYTHONPATH", f"{folder.parent}:{ROOT}:{pytester.path}")
    return pytester.runpytest_subprocess


def test_installed_it_imports_nothing_before_a_fixture_is_used_and_can_be_taken_out(installed, pytester):
    pytester.makepyfile(QUIET)
    installed("-W", "error").assert_outcomes(passed=1)
    pytester.makepyfile("def test_mine(mdr_accuracy):\n    pass")
    result = installed("-p", "no:crosscheck")
    result.assert_outcomes(errors=1)
    assert "fixture 'mdr_accuracy' not found" in text(result)
