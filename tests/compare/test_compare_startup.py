"""What each command imports before it does anything: start-up is counted in modules, not in seconds.

Help, versions and lists are asked for again and again, and by shells that complete words.
"""

import json
import os
import subprocess
import sys

import pytest

SCENE = """
indenter = {type = "sphere", radius = 1e-2}
elastomer = {type = "kelvin", modulus = 1e6, relaxation_time = 1e-3}
motion = {type = "slide", speed = 0.1, load = 1.0}
"""
# Prints what is imported after each step.
PROGRAM = """
import contextlib, io, json, sys


def command(*arguments):
    from compare.cli.app import app
    with contextlib.redirect_stdout(io.StringIO()):
        try:
            app(list(arguments))
        except SystemExit as end:
            assert not end.code, arguments


for step in json.loads(sys.argv[1]):
    exec(step)
    print(json.dumps(sorted(sys.modules)))
"""
ON_DISK = {"xarray", "h5netcdf", "h5py"}
DRAWING = {"matplotlib", "jinja2"}
SOLVING = {"numba", "scipy", "ducc0", "pyfftw", "bem3d", "mdr1d"}
HEAVY = {"numpy", "pydantic", "pandas", "pint", "distributed", "dask", "scene", *ON_DISK, *DRAWING, *SOLVING}
LISTED = HEAVY - {"pydantic"}
SEARCHES = {"scipy.optimize", "scipy.integrate", "scipy.stats", "scipy.interpolate"}
PLANNED = {"pint", "pandas", "distributed", "dask", *ON_DISK, *DRAWING, *SEARCHES}
# Each step, what is there after it, and packages and modules that are not, in one process: from light to heavy.
STEPS = [
    ("import compare; dir(compare)", "compare", HEAVY | {"compare.cli.app", "compare.commands"}),
    ("from compare.library.ready import ready; assert ready()", "compare.library.ready", HEAVY),
    ("command('--help')", "typer", HEAVY),
    ("command('scenes')", "compare.library.ready", LISTED),
    (
        "command('plan', 'scene.toml')",
        "bem3d",
        PLANNED | {"compare.solving.runner", "compare.solving.store", "compare.studies.pipeline"},
    ),
    ("command('trust', 'scene.toml')", "compare.trustmap.shipped", PLANNED | {"compare.solving.runner"}),
]


def modules(folder, *steps):
    """Names of the modules that are there after each step of a fresh process."""
    (folder / "scene.toml").write_text(SCENE)
    ended = subprocess.run(
        [sys.executable, "-c", PROGRAM, json.dumps(steps)],
        cwd=folder,
        capture_output=True,
        text=True,
        env=os.environ | {"PYTHONWARNINGS": "error"},
    )
    assert ended.returncode == 0, ended.stderr
    return [set(json.loads(line)) for line in ended.stdout.splitlines()]


@pytest.fixture(scope="module")
def walked(tmp_path_factory):
    steps = [step for step, *_ in STEPS]
    return dict(zip(steps, modules(tmp_path_factory.mktemp("here"), *steps), strict=True))


@pytest.mark.parametrize(("step", "there", "unneeded"), STEPS, ids=[step for step, *_ in STEPS])
def test_nothing_is_imported_before_it_is_needed(walked, step, there, unneeded):
    assert there in walked[step]  # the reader of modules sees what is there
    assert not walked[step] & unneeded


def test_a_scene_imports_no_units_no_suggestions_and_no_results_on_disk(tmp_path):
    (found,) = modules(tmp_path, "import scene, bem3d, mdr1d")
    assert "scene" in found
    assert not found & {"pint", "matplotlib", "compare", *ON_DISK}
