"""What each command imports before it does anything: start-up is counted in modules, not in seconds.

Help, versions and lists are asked for again and again, and by shells that complete words.
"""

import os
import subprocess
import sys

import pytest

HEAVY = {
    "numpy", "scipy", "matplotlib", "numba", "pydantic", "xarray", "h5netcdf", "h5py", "pandas", "pint", "ducc0",
    "pyfftw", "distributed", "dask", "jinja2",
}  # fmt: skip
SCENE = """
indenter = {type = "sphere", radius = 1e-2}
elastomer = {type = "kelvin", modulus = 1e6, relaxation_time = 1e-3}
motion = {type = "slide", speed = 0.1, load = 1.0}
"""
REPORT = """
import sys
from compare.cli import app
try:
    app(sys.argv[1:])
finally:
    print("modules:", *sys.modules, file=sys.stderr)
"""


def imported(folder, *arguments, code=REPORT):
    """Top-level packages that are there once a command has ended, and whether it ended well."""
    ended = subprocess.run(
        [sys.executable, "-c", code, *arguments],
        cwd=folder,
        capture_output=True,
        text=True,
        env=os.environ | {"PYTHONWARNINGS": "error"},
    )
    *_, told = ended.stderr.split("modules:")
    return {name.split(".")[0] for name in told.split()}, set(told.split()), ended.returncode


@pytest.mark.parametrize(
    ("arguments", "needed"),
    [(["--help"], set()), (["--version"], set()), (["run", "--help"], {"pydantic"}), (["list"], {"pydantic"})],
)
def test_help_and_version_import_nothing_heavy(tmp_path, arguments, needed):
    packages, _, status = imported(tmp_path, *arguments)
    assert status == 0
    assert "typer" in packages  # the reader of modules sees what is there
    assert not packages & (HEAVY - needed)


@pytest.mark.parametrize("code", ["import compare", "import compare; dir(compare)"])
def test_the_package_alone_imports_nothing_heavy(tmp_path, code):
    packages, modules, _ = imported(
        tmp_path, code=f"{code}; import sys; print('modules:', *sys.modules, file=sys.stderr)"
    )
    assert "compare" in packages
    assert not packages & (HEAVY | {"scene", "bem3d", "mdr1d"})
    assert {name for name in modules if name.startswith("compare.")} == set()


def test_a_plan_imports_no_figures_no_results_on_disk_and_no_units_that_it_does_not_meet(tmp_path):
    (tmp_path / "scene.toml").write_text(SCENE)
    packages, modules, status = imported(tmp_path, "plan", "scene.toml")
    assert status == 0
    assert "bem3d" in packages
    unneeded = {"matplotlib", "xarray", "h5netcdf", "h5py", "pandas", "pint", "distributed", "dask", "jinja2"}
    assert not packages & unneeded
    assert not {"compare.runner", "compare.store", "compare.pipeline"} & modules


@pytest.mark.parametrize("command", [["list"], ["new", "quick-start", "mine.toml"]])
def test_what_only_lists_and_copies_imports_no_solver(tmp_path, command):
    packages, modules, status = imported(tmp_path, *command)
    assert status == 0
    assert not packages & {"matplotlib", "xarray", "h5py", "pint", "numba", "scipy", "bem3d", "mdr1d"}
    assert "compare.library" in modules


def test_a_scene_imports_no_units_no_suggestions_and_no_results_on_disk(tmp_path):
    packages, modules, _ = imported(
        tmp_path, code="import scene, bem3d, mdr1d, sys; print('modules:', *sys.modules, file=sys.stderr)"
    )
    assert "scene" in packages
    assert not packages & {"xarray", "h5netcdf", "h5py", "pint", "matplotlib", "compare"}
    assert "compare" not in modules
