"""Absent is absent: of an effect that a scene does not ask for, not a line is run."""

import os
import subprocess
import sys
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from pathlib import Path

import pytest
from planned import STANDARD as SOLID

from bem3d import BEM
from mdr1d import MDR
from scene import Indent, Program, Scene, SelfAffine, Slide, Sphere, Stage

ROOT = Path(__file__).parents[2]
SOLVERS = {"BEM": BEM(points=32, extent=3e-3, steps=4), "MDR": MDR(points=200, steps=4)}
every_solver = pytest.mark.parametrize("solver", SOLVERS.values())
ROUGH = SelfAffine(hurst=0.8, rms_height=2e-6, longest=2e-3, shortest=0.4e-3, seed=1)
FORWARD = Stage(duration=1e-3, speed=0.1)
PLAIN = {
    "rest": Scene(Sphere(10e-3), SOLID, Indent(load=0.5)),
    "slide": Scene(Sphere(10e-3), SOLID, Slide(speed=0.1, load=0.5)),
    "rough": Scene(Sphere(10e-3), SOLID, Slide(speed=0.1, load=0.5), ROUGH),
    "program": Scene(Sphere(10e-3), SOLID, Program(stages=(Stage(duration=1e-3, load=0.5), FORWARD))),
}
# What an effect is made of, files and functions.
MODULES = {
    "layer": {"bem3d/response/layer.py", "bem3d/response/layerwaves.py"},
    "temperature": {"scene/effects/temperature.py"},
    "heating": {"scene/effects/terms.py", "scene/scene.py temperature_rise"},
    "tangential": {
        "scene/effects/terms.py",
        "bem3d/contact/shear.py",
        "bem3d/response/cerruti.py",
        "bem3d/contact/stickslip.py",
        "mdr1d/tangential.py",
    },
    "topography": {
        "scene/surfaces/topography.py _waves",
        "scene/surfaces/heightmap.py",
        "bem3d/topography.py",
        "mdr1d/topography.py",
    },
    "measured body": {"scene/surfaces/measured.py", "scene/surfaces/heightmap.py"},
    "measured file": {"scene/files/heightfile.py"},
    "oscillation": {"scene/motion.py Oscillation.at"},
}
# What only effects, numbers with units, figures, results on disk or the judge need, and costs much to load.
LIBRARIES = {"scipy.interpolate", "SurfaceTopography", "pint", "matplotlib", "xarray", "h5py", "compare"}
OF_SCENES = {*LIBRARIES, "h5netcdf", "scipy.special", "scipy.optimize", "scipy.fft"}
# Classes that follow a wake for an indenter that comes back.
RETURNING = {"bem3d/motion/upstream.py Returning.__init__", "mdr1d/marching.py _Returning.__init__"}


def package(solver):
    return type(solver).__module__.split(".")[0]


@dataclass
class Called:
    """Files of ours from which a function was called, and functions, by file and name."""

    files: set[str] = field(default_factory=set)
    functions: set[str] = field(default_factory=set)

    @property
    def all(self) -> set[str]:
        """Files and functions."""
        return self.files | self.functions


@contextmanager
def watched():
    """All that is called meanwhile, known at the end."""
    codes, called = set(), Called()

    def note(frame, event, _):
        if event == "call":
            codes.add(frame.f_code)

    before = sys.getprofile()
    sys.setprofile(note)
    try:
        yield called
    finally:
        sys.setprofile(before)
        for code in codes:
            if code.co_filename.startswith(str(ROOT)):
                file = Path(code.co_filename).relative_to(ROOT).as_posix()
                called.files.add(file)
                called.functions.add(f"{file} {code.co_qualname}")


@every_solver
@pytest.mark.parametrize("name", PLAIN)
def test_of_effects_that_are_absent_not_a_function_is_called(solver, name):
    with watched() as called:
        solver.solve(PLAIN[name])
    assert f"{package(solver)}/solver.py" in called.files
    for effect, modules in MODULES.items():
        assert not called.all & modules, effect


def test_what_an_effect_is_made_of_is_there():
    assert all((ROOT / each.partition(" ")[0]).is_file() for modules in MODULES.values() for each in modules)


ALONE = """
import sys
import scene, scene.effects.terms
print(*sorted(set(sys.modules) & {of_scenes}), "| after scene")
from test_effects_absent import PLAIN, SOLVERS
for solver in SOLVERS.values():
    for plain in PLAIN.values():
        solver.solve(plain)
print(*sorted(set(sys.modules) & {libraries}), "| after plain contacts")
solver = SOLVERS["BEM"]
solver.solve(scene.Scene(*list(PLAIN["rest"].parts.values()), layer=scene.Layer(thickness=2e-3)))
print(*sorted(set(sys.modules) & {libraries}), "| after a layer")
"""


def test_of_effects_that_are_absent_no_library_is_loaded():
    program = ALONE.format(of_scenes=OF_SCENES, libraries=LIBRARIES)
    here = os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)}
    finished = subprocess.run(
        [sys.executable, "-c", program], cwd=ROOT / "tests", env=here, capture_output=True, text=True, check=True
    )
    assert finished.stdout.splitlines() == [
        "| after scene",
        "| after plain contacts",
        "scipy.interpolate | after a layer",
    ]


@every_solver
def test_what_is_steady_is_not_marched_and_what_rests_does_not_flow(solver):
    with watched() as called:
        solver.solve(PLAIN["rest"])
    modules = ("marching", "material", "upstream", "timeline", "stepping")
    later = {f"{package(solver)}/{module}.py" for module in modules}
    drawn = {"bem3d/surface.py", "scene/surfaces/selfaffine.py"}
    flowing = {"bem3d/response/memory.py march", "bem3d/contact/krylov.py gmres", "mdr1d/steady.py sweep_modes"}
    assert not called.files & (later | drawn)
    assert not called.functions & flowing
    with watched() as called:
        solver.solve(PLAIN["rough"])
    assert not called.files & later
    assert called.files & drawn
    assert called.functions & flowing


@every_solver
def test_a_program_that_does_not_turn_back_keeps_nothing_of_what_it_leaves_behind(solver):
    forward = PLAIN["program"]
    back = replace(FORWARD, speed=-0.1)
    returning = replace(forward, motion=replace(forward.motion, stages=(*forward.motion.stages, back)))
    for scene, kept in ((forward, False), (returning, True)):
        with watched() as called:
            solver.solve(scene)
        assert bool(called.functions & RETURNING) == kept
