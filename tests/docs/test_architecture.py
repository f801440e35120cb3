"""The house as drawn: data walks one way, each library has one door, and no room uses one above it."""

import ast
from collections import defaultdict
from functools import cache
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PACKAGES = ("scene", "mdr1d", "bem3d", "compare")
# who may import whom; scene imports nothing else of ours, the solvers never each other or their judge
ARROWS = {
    "scene": {"scene"},
    "mdr1d": {"mdr1d", "scene"},
    "bem3d": {"bem3d", "scene"},
    "compare": set(PACKAGES),
}
DOORS = {  # files outside which a library is not imported, in whichever folder they stand
    "pyfftw": {"transforms"},
    "ducc0": {"transforms"},
    "numba": {"loops"},
    "tomllib": {"reading"},
    "SurfaceTopography": {"heightfile"},
    "pint": {"numeric_input"},
    "distributed": {"cluster"},
    "meshio": {"vtk"},
}
# What a study may use of the judge: what a user's own study may, and the studies that it builds on.
STUDIES, FOR_STUDIES = (
    "studies",
    {"solving", "statistics", "figures", "report", "models", "trustmap", "library", "studies"},
)
MOST_ROOMS = 11
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
def used(path):
    """Files of ours that a file imports when it runs."""
    names = imported(path, types=False)
    return {each for each in FILES if module(each) in names} - {path, ROOT / "compare" / "__init__.py"}


def module(path):
    parts = path.relative_to(ROOT).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" and len(parts) > 2 else parts)


def room(path):
    """First folder or file below the top of the judge."""
    return path.relative_to(ROOT / "compare").with_suffix("").parts[0]


def circle(graph):
    """One circle of a graph, in words; empty where there is none."""
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        return " -> ".join(map(str, error.args[1]))
    return ""


def against_the_arrows(path, root=ROOT):
    """Packages that a file imports and its own package may not."""
    ours = {name.split(".")[0] for name in imported(path, root=root)} & set(PACKAGES)
    return ours - ARROWS[path.relative_to(root).parts[0]]


def test_imports_follow_the_arrows():
    assert not {path: wrong for path in FILES if (wrong := against_the_arrows(path))}


@pytest.mark.parametrize("package", PACKAGES)
def test_no_files_of_a_package_use_one_another_in_a_circle(package):
    files = [path for path in FILES if path.relative_to(ROOT).parts[0] == package]
    doors = ROOT / package / "__init__.py"
    assert not circle({module(path): set(map(module, used(path) - {doors})) for path in files if path != doors})


def test_no_room_of_the_judge_uses_one_above_it():
    graph = defaultdict(set)
    for path in JUDGE:
        graph[room(path)] |= {room(other) for other in used(path) if other in JUDGE} - {room(path)}
    assert not circle(graph)


def test_nothing_but_the_commands_uses_a_study():
    users = {
        room(path)
        for path in JUDGE
        for other in used(path)
        if other in JUDGE and room(other) == STUDIES and room(path) != STUDIES
    }
    assert users <= {"commands", "__init__", "checks"}


def test_a_study_uses_what_a_study_of_a_user_may():
    used_by = {room(other) for path in JUDGE if room(path) == STUDIES for other in used(path) if other in JUDGE}
    assert used_by <= FOR_STUDIES


def test_the_judge_has_few_rooms():
    entries = {path.name for path in (ROOT / "compare").iterdir() if not path.name.startswith("__")}
    assert len(entries - {"py.typed"}) <= MOST_ROOMS


@pytest.mark.parametrize("library", DOORS)
def test_each_library_has_one_door(library):
    users = {path.stem for path in FILES if library in {name.split(".")[0] for name in imported(path)}}
    assert users == DOORS[library]


def test_figures_neither_solve_nor_save():
    drawing = [path for path in JUDGE if {"plots", "figure", "figures"} & set(path.with_suffix("").parts)]
    assert drawing
    for path in drawing:
        assert not imported(path) & {
            "matplotlib.pyplot",
            "compare.solving.runner",
            "compare.solving.store",
            "compare.studies.pipeline",
        }, path
        assert "savefig" not in path.read_text(encoding="utf-8") or path.name == "plot.py", path


def test_the_arrows_can_be_broken(tmp_path):
    # the reader of imports sees absolute, relative and nested ones
    intruder = tmp_path / "mdr1d" / "intruder.py"
    intruder.parent.mkdir()
    intruder.write_text(
        "def f():\n    from bem3d import BEM\n    import compare.solving.store\n    from .solver import MDR\n"
    )
    assert {"bem3d", "compare.solving.store", "mdr1d.solver"} <= imported(intruder, root=tmp_path)
    assert against_the_arrows(intruder, tmp_path) == {"bem3d", "compare"}
