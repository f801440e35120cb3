"""The digest of code, which names stored answers and workers, has every file that an answer depends on."""

import json
import subprocess
import sys
from dataclasses import replace
from importlib.util import find_spec
from pathlib import Path
from shutil import copytree

import pytest
from imports import ROOT, module, used
from small_cases import SLIDING

from compare.models.table import THEORIES, Models, model_of
from compare.solving import digest
from compare.solving.digest import code_digest, key, shipped
from compare.solving.task import SceneTask
from scene import Indent

MODELS = ("mdr", "bem", *THEORIES, "corrected", "exact")
SCENE = replace(SLIDING, motion=Indent(load=1.0), roughness=None)


def packages_of(model):
    return SceneTask(model_of(model).solver, (SCENE,)).packages


PACKAGES = sorted({name for model in MODELS for name in packages_of(model)})
# Code that carries questions and answers and computes none: how tasks are run, and types of settings.
CARRYING = ("compare.solving", "compare.library")
# Prints the data of ours that each model is the first to open while it solves.
OPENING = """
import json, sys
from pathlib import Path
opened = []
sys.addaudithook(lambda event, given: opened.append(str(given[0])) if event == "open" else None)
from imports import PACKAGES, ROOT
from test_compare_digest import MODELS, SCENE, SLIDING
from compare.models.table import model_of
CODE = (".py", ".pyc", ".pyi", ".nbi", ".nbc")
for model in MODELS:
    solver = model_of(model).solver
    solver.solve(SCENE if model == "exact" else SLIDING)
    paths = {Path(each) for each in opened if Path(each).suffix not in CODE and Path(each).is_file()}
    opened.clear()
    ours = {each for each in paths if any(ROOT / own in each.parents for own in PACKAGES)}
    print(json.dumps([model, *map(str, ours)]))
"""


def folder(package):
    """Folder of a package, or file of a module."""
    spec = find_spec(package)
    return Path((spec.submodule_search_locations or [spec.origin])[0])


@pytest.fixture
def forgetful():
    """Digests are read once a process; here whenever they are asked for."""

    def forget():
        digest._package_digest.cache_clear()
        digest._code_digest.cache_clear()

    forget()
    yield forget
    forget()


@pytest.mark.parametrize("package", PACKAGES)
def test_a_copy_has_the_same_digest_and_a_change_of_any_file_another(package, tmp_path):
    here = tmp_path / "copy"
    copytree(folder(package), here)
    first = code_digest(folder(package))
    for name in [
        "__pycache__/a.py",
        ".a.csv.swp",
        "a.csv~",
        "#a.csv#",
        "a.csv.orig",
        "a.py.rej",
        "a.bak",
        ".b/a.py",
    ]:
        (here / name).parent.mkdir(exist_ok=True)
        (here / name).write_text("left behind")
    assert code_digest(here) == first
    changed = {first}
    for path in shipped(here).values():
        content = path.read_bytes()
        path.write_bytes(content + b" ")
        changed.add(code_digest(here))
        path.write_bytes(content)
    assert len(changed) == len(shipped(here)) + 1
    (here / "new.npz").write_bytes(b"")
    changed.add(code_digest(here))
    (here / "new.npz").rename(here / "other.npz")
    changed.add(code_digest(here))
    assert len(changed) == len(shipped(here)) + 2


@pytest.mark.slow
def test_every_file_that_a_model_opens_is_in_the_digest_of_its_packages():
    places = [str(ROOT), str(ROOT / "tests"), str(Path(__file__).parent)]
    program = f"import sys; sys.path[:0] = {places}\n{OPENING}"
    ended = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True, cwd=ROOT)
    seen = set()
    for model, *opened in map(json.loads, ended.stdout.splitlines()):
        files = {path for package in packages_of(model) for path in shipped(folder(package)).values()}
        assert {*map(Path, opened)} <= files, model
        seen |= {Path(each).name for each in opened}
    assert {"friction_error.csv", "share.csv", "fitted.json"} <= seen


@pytest.mark.parametrize("model", MODELS)
def test_every_module_that_a_model_imports_is_in_its_packages(model):
    left, seen = [Path(find_spec(type(model_of(model).solver).__module__).origin)], set()
    while left:
        if (path := left.pop()) not in seen and not module(path).startswith(CARRYING):
            seen.add(path)
            left += used(path)
    within = tuple(f"{package}." for package in packages_of(model))
    assert [path for path in sorted(seen) if not f"{module(path)}.".startswith(within)] == []


OWN = """
from dataclasses import dataclass
from mdr1d import MDR

@dataclass(frozen=True)
class Own:
    name = "Own"
    def solve(self, scene):
        return MDR().solve(scene)
"""


@pytest.mark.parametrize("regular", [True, False], ids=["with __init__", "namespace"])
def test_answers_of_a_model_of_ones_own_end_with_a_change_of_any_file_of_its_package(
    tmp_path, monkeypatch, forgetful, regular
):
    name = f"nested_{'regular' if regular else 'namespace'}"
    files = [tmp_path / name / each for each in ("models/own.py", "laws/deep/law.py", "base.py", "laws/table.dat")]
    for path in files:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(OWN if path.name == "own.py" else "1")
    for path in {parent for each in files for parent in each.parents if tmp_path in parent.parents and regular}:
        (path / "__init__.py").write_text("")
    monkeypatch.syspath_prepend(tmp_path)
    task = SceneTask(next(iter(Models.of([f"{name}.models.own:Own", "bem"]))).solver, (SCENE,))
    keys = {key(task)}
    for number, path in enumerate(files, 2):
        path.write_text(f"{path.read_text()}\n# changed")
        forgetful()
        assert len(keys := keys | {key(task)}) == number


def test_a_model_that_derives_from_another_depends_on_the_packages_of_both(tmp_path, monkeypatch):
    source = "from bem3d import BEM\nfrom compare import CorrectedMDR\n"
    source += "class Space(BEM): pass\nclass Line(CorrectedMDR): pass\n"
    (tmp_path / "derived.py").write_text(source)
    monkeypatch.syspath_prepend(tmp_path)
    assert packages_of("derived:Space") == ("scene", "derived", "bem3d")
    assert {*packages_of("corrected"), "derived"} == {*packages_of("derived:Line")}
