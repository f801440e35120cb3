"""The digest of code, which names stored answers and workers, has every file that an answer depends on."""

import ast
import json
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path
from shutil import copytree

import pytest

from compare.models.table import THEORIES, Models, model_of
from compare.solving import digest
from compare.solving.digest import code_digest, key, shipped
from compare.solving.task import SceneTask
from scene import Indent, Kelvin, Scene, SelfAffine, Slide, Sphere

ROOT = Path(__file__).parents[2]
OURS = ("scene", "mdr1d", "bem3d", "compare")
MODELS = ("mdr", "bem", *THEORIES, "corrected", "exact")
SCENE = Scene(Sphere(radius=1e-2), Kelvin(modulus=1e6, relaxation_time=1e-3), Indent(load=1.0))
ROUGH = Scene(
    SCENE.indenter,
    SCENE.elastomer,
    Slide(speed=0.1, load=1.0),
    SelfAffine(hurst=0.8, rms_height=5e-7, longest=4e-3, shortest=1e-3, seed=1),
)
PACKAGES = sorted({name for model in MODELS for name in SceneTask(model_of(model).solver, (SCENE,)).packages})
# Code that carries questions and answers and computes none: how tasks are run, and types of settings.
CARRYING = ("compare.solving", "compare.library")
# Prints the data of ours that each model is the first to open while it solves.
OPENING = """
import json, sys
from pathlib import Path
opened = []
sys.addaudithook(lambda event, given: opened.append(str(given[0])) if event == "open" else None)
from test_compare_digest import MODELS, OURS, ROOT, ROUGH, SCENE
from compare.models.table import model_of
CODE = (".py", ".pyc", ".pyi", ".nbi", ".nbc")
for model in MODELS:
    solver = model_of(model).solver
    solver.solve(SCENE if model == "exact" else ROUGH)
    paths = {Path(each) for each in opened if Path(each).suffix not in CODE and Path(each).is_file()}
    opened.clear()
    print(json.dumps([model, *(str(each) for each in paths if any(ROOT / own in each.parents for own in OURS))]))
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
    for name in (
        "__pycache__/a.py",
        ".a.csv.swp",
        "a.csv~",
        "#a.csv#",
        "a.csv.orig",
        "a.py.rej",
        "a.bak",
        ".b/a.py",
    ):
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
    places = [str(ROOT), str(Path(__file__).parent)]
    program = f"import sys; sys.path[:0] = {places}\n{OPENING}"
    ended = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True, cwd=ROOT)
    seen = set()
    for model, *opened in map(json.loads, ended.stdout.splitlines()):
        packages = SceneTask(model_of(model).solver, (SCENE,)).packages
        files = {path for package in packages for path in shipped(folder(package)).values()}
        assert {*map(Path, opened)} <= files, model
        seen |= {Path(each).name for each in opened}
    assert {"friction_error.csv", "share.csv", "fitted.json"} <= seen


def imported(module):
    """Modules of ours that a module imports, by its source."""
    spec = find_spec(module)
    parent = module if spec.submodule_search_locations else spec.parent
    found = set()
    for node in ast.walk(ast.parse(Path(spec.origin).read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            found |= {each.name for each in node.names}
        elif isinstance(node, ast.ImportFrom):
            base = parent.split(".")[: len(parent.split(".")) - node.level + 1] if node.level else []
            name = ".".join([*base, *filter(None, [node.module])])
            inner = {f"{name}.{each.name}" for each in node.names}
            found |= {name} | (inner if name.partition(".")[0] in OURS else set())
    return {each for each in found if each.partition(".")[0] in OURS and exists(each)}


def exists(module):
    """Whether a name is that of a module."""
    path = ROOT.joinpath(*module.split("."))
    return path.with_suffix(".py").exists() or (path / "__init__.py").exists()


@pytest.mark.parametrize("model", MODELS)
def test_every_module_that_a_model_imports_is_in_its_packages(model):
    solver = model_of(model).solver
    packages = (*SceneTask(solver, (SCENE,)).packages, *CARRYING)
    within = tuple(f"{package}." for package in packages)
    left, seen = [type(solver).__module__], set()
    while left:
        if (module := left.pop()) not in seen:
            seen.add(module)
            left += [] if f"{module}.".startswith(tuple(f"{each}." for each in CARRYING)) else imported(module)
    assert [each for each in sorted(seen) if not f"{each}.".startswith(within)] == []


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
    space, line = (SceneTask(model_of(f"derived:{name}").solver, (SCENE,)) for name in ("Space", "Line"))
    assert space.packages == ("scene", "derived", "bem3d")
    assert {*SceneTask(model_of("corrected").solver, (SCENE,)).packages, "derived"} == {*line.packages}
