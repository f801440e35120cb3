"""The house as drawn: data walks one way, each library has one door, and no room uses one above it."""

import ast
from functools import cache
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
PACKAGES = ("scene", "mdr1d", "bem3d", "compare")
# who may import whom; scene imports nothing else of ours, the solvers never each other or their judge
ARROWS = {
    "scene": {"scene"},
    "mdr1d": {"mdr1d", "scene"},
    "bem3d": {"bem3d", "scene"},
    "compare": set(PACKAGES),
}
DOORS = {
    "pyfftw": {"bem3d/engine.py"},
    "ducc0": {"bem3d/engine.py"},
    "cupy": {"bem3d/engine.py"},
    "numba": {"bem3d/kernels.py", "mdr1d/foundation.py"},  # one a package: neither solver imports the other
    "tomllib": {"scene/reading.py"},
    "SurfaceTopography": {"scene/heightfile.py"},
    "pint": {"scene/units.py"},
    "h5py": {"compare/results.py"},
    "distributed": {"compare/cluster.py"},
    "plotly": {"compare/interactive.py"},
    "meshio": {"compare/vtk.py"},
}
# Floors of the judge, from the ground up: a room imports rooms of its own floor and of those below.
FLOORS = (
    {"outcome", "vocabulary", "suggest", "amounts", "digits", "docstrings", "library"},
    {"task", "path", "cost", "finding", "exact", "page", "describe", "unsolved"},
    {"store", "workers", "statistics", "rectangle", "cases", "inputs", "hardcases", "quantity", "csvfiles"},
    {"plots", "cluster", "runner", "progress", "pages", "manifest", "redraw", "views", "film", "vtk"},
    {"interactive", "declaration", "results", "report", "pipeline", "animation", "tables"},
    {"studies", "planning", "json_schema"},
    {"commands", "completion", "console", "cli", "__init__", "__main__"},
)
FILES = sorted(path for package in PACKAGES for path in (ROOT / package).rglob("*.py"))
JUDGE = [path for path in FILES if path.relative_to(ROOT).parts[0] == "compare"]


@cache
def parsed(path):
    """Every node of a file, and those that are there for types alone."""
    nodes = list(ast.walk(ast.parse(path.read_text(encoding="utf-8"))))
    tests = [each for each in nodes if isinstance(each, ast.If) and isinstance(each.test, ast.Name)]
    guards = [each for each in tests if each.test.id == "TYPE_CHECKING"]
    return nodes, {id(below) for guard in guards for each in guard.body for below in ast.walk(each)}


@cache
def imported(path, types=True, root=ROOT):
    """Absolute names of what a file imports anywhere in it. types : those of annotations alone included"""
    nodes, for_types = parsed(path)
    names = set()
    for node in nodes:
        if id(node) in for_types and not types:
            continue
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            parts = path.relative_to(root).with_suffix("").parts
            base = ".".join(parts[: len(parts) - node.level]) if node.level else ""
            name = ".".join(filter(None, (base, node.module)))
            names |= {below if is_module(below := f"{name}.{alias.name}") else name for alias in node.names}
    return names


@cache
def is_module(name):
    place = ROOT.joinpath(*name.split("."))
    return place.with_suffix(".py").exists() or (place / "__init__.py").exists()


@cache
def rooms(path):
    """Modules of the judge that a file imports when it runs."""
    names = imported(path, types=False)
    return {each for each in JUDGE if module(each) in names} - {path, ROOT / "compare" / "__init__.py"}


def module(path):
    parts = path.relative_to(ROOT).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" and len(parts) > 2 else parts)


def floor(path):
    name = path.relative_to(ROOT / "compare").with_suffix("").parts[0]
    return next(number for number, names in enumerate(FLOORS) if name in names)


def against_the_arrows(path, root=ROOT):
    """Packages that a file imports and its own package may not."""
    ours = {name.split(".")[0] for name in imported(path, root=root)} & set(PACKAGES)
    return ours - ARROWS[path.relative_to(root).parts[0]]


def test_imports_follow_the_arrows():
    assert not {path: wrong for path in FILES if (wrong := against_the_arrows(path))}


def test_no_room_of_the_judge_uses_one_above_it():
    above = [
        f"{module(path)} uses {module(other)}"
        for path in JUDGE
        for other in rooms(path)
        if floor(other) > floor(path)
    ]
    assert not above


def test_no_rooms_of_the_judge_use_one_another_in_a_circle():
    try:
        TopologicalSorter({path: rooms(path) for path in JUDGE}).prepare()
    except CycleError as error:
        pytest.fail(" -> ".join(module(path) for path in error.args[1]))


@pytest.mark.parametrize("library", DOORS)
def test_each_library_has_one_door(library):
    users = {
        path.relative_to(ROOT).as_posix()
        for path in FILES
        if library in {name.split(".")[0] for name in imported(path)}
    }
    assert users == DOORS[library]


def test_figures_neither_solve_nor_save():
    for path in (ROOT / "compare" / "plots").glob("*.py"):
        assert not imported(path) & {"matplotlib.pyplot", "compare.runner", "compare.store", "compare.pipeline"}, (
            path
        )
        assert "savefig" not in path.read_text(encoding="utf-8") or path.name == "rendering.py", path


def test_the_arrows_can_be_broken(tmp_path):
    # the reader of imports sees absolute, relative and nested ones
    intruder = tmp_path / "mdr1d" / "intruder.py"
    intruder.parent.mkdir()
    intruder.write_text(
        "def f():\n    from bem3d import BEM\n    import compare.store\n    from .solver import MDR\n"
    )
    assert {"bem3d", "compare.store", "mdr1d.solver"} <= imported(intruder, root=tmp_path)
    assert against_the_arrows(intruder, tmp_path) == {"bem3d", "compare"}
