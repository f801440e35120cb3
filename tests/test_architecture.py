"""The house as drawn: data walks one way, and each library has one door."""

import ast
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
    "h5py": {"compare/netcdf.py"},
    "distributed": {"compare/pools/cluster.py"},
}
FILES = sorted(path for package in PACKAGES for path in (ROOT / package).rglob("*.py"))


def imported(path):
    """Absolute names of the modules that a file imports anywhere in it."""
    names = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            parts = path.relative_to(ROOT).with_suffix("").parts
            base = ".".join(parts[: len(parts) - node.level]) if node.level else ""
            names.add(".".join(filter(None, (base, node.module))))
    return names


@pytest.mark.parametrize("path", FILES, ids=lambda path: str(path.relative_to(ROOT)))
def test_imports_follow_the_arrows(path):
    package = path.relative_to(ROOT).parts[0]
    ours = {name.split(".")[0] for name in imported(path)} & set(PACKAGES)
    assert ours <= ARROWS[package], f"{path.name} of {package} imports {sorted(ours - ARROWS[package])}"


@pytest.mark.parametrize("library", DOORS)
def test_each_library_has_one_door(library):
    users = {
        path.relative_to(ROOT).as_posix()
        for path in FILES
        if library in {name.split(".")[0] for name in imported(path)}
    }
    assert users == DOORS[library]


def test_figures_neither_solve_nor_save():
    for path in (ROOT / "compare" / "figures").glob("*.py"):
        assert not imported(path) & {"mdr1d", "bem3d", "matplotlib.pyplot", "compare.study", "compare.sweep"}, path
        assert "savefig" not in path.read_text(encoding="utf-8"), path


def test_the_arrows_can_be_broken(tmp_path, monkeypatch):
    # the reader of imports sees absolute, relative and nested ones
    monkeypatch.setitem(globals(), "ROOT", tmp_path)
    intruder = tmp_path / "mdr1d" / "intruder.py"
    intruder.parent.mkdir()
    intruder.write_text(
        "def f():\n    from bem3d import BEM\n    import compare.store\n    from .solver import MDR\n"
    )
    assert imported(intruder) == {"bem3d", "compare.store", "mdr1d.solver"}
    with pytest.raises(AssertionError, match="intruder"):
        test_imports_follow_the_arrows(intruder)
