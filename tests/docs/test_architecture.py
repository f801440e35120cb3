"""The house as drawn: data walks one way, each library has one door, and no room uses one above it."""

from collections import defaultdict
from graphlib import CycleError, TopologicalSorter

import pytest
from imports import FILES, PACKAGES, ROOT, imported, module, used

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
    {"solving", "statistics", "figures", "report", "models", "trustmap", "library"},
)
MOST_ROOMS = 11
JUDGE = [path for path in FILES if path.relative_to(ROOT).parts[0] == "compare"]


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


@pytest.fixture(scope="module")
def rooms():
    """Rooms of the judge that each of them uses besides itself."""
    graph = defaultdict(set)
    for path in JUDGE:
        graph[room(path)] |= {room(other) for other in used(path) if other in JUDGE} - {room(path)}
    return graph


def test_no_room_of_the_judge_uses_one_above_it(rooms):
    assert not circle(rooms)


def test_nothing_but_the_commands_uses_a_study_and_a_study_what_one_of_a_user_may(rooms):
    assert {name for name, uses in rooms.items() if STUDIES in uses} <= {"commands", "__init__", "checks"}
    assert rooms[STUDIES] <= FOR_STUDIES


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
