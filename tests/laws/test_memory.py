"""A solve that needs more memory than it would get is refused before it begins, by plan and solve alike."""

import subprocess
import sys
from dataclasses import dataclass, replace

import numpy as np
import pytest
from maps import refused
from sliding import ORDINARY as SCENE

import scene.surfaces.topography
from bem3d import BEM
from compare.solving.runner import sweep
from compare.solving.store import Store
from compare.solving.task import SceneTask
from mdr1d import MDR
from scene import OutOfMemory, Plane, Refused, SelfAffine, Slide, Topography, protocol
from scene.protocol import memory, numeric_guard, refuse
from scene.surfaces.topography import MOST_WAVES

# Waves whose amplitudes no machine can hold, although each grid alone would fit.
BROAD = SelfAffine(hurst=0.8, rms_height=1e-6, longest=100.0, shortest=1e-4)


@pytest.mark.parametrize(("solver", "least"), [(BEM(points=128), 4e6), (MDR(points=10**6), 7e7)])
def test_plan_and_solve_refuse_with_both_figures_what_the_machine_has_not(monkeypatch, solver, least):
    needed = solver.plan(SCENE).memory
    assert needed > least
    monkeypatch.setattr(protocol, "memory", lambda: needed - 1)
    reasons = set()
    for ask in (solver.plan, solver.solve, lambda scene: refuse(solver, scene)):
        with pytest.raises(
            Refused, match=r"it needs .*MB of memory, and only .*MB are available: use fewer points"
        ) as caught:
            ask(SCENE)
        reasons.add(str(caught.value))
    assert len(reasons) == 1
    monkeypatch.setattr(protocol, "memory", lambda: needed)
    assert solver.plan(SCENE).memory == needed


def test_what_no_machine_holds_has_no_plan_either():
    for ask in (BEM().plan, BEM().solve):
        refused(r"it needs 2.*e\+05 GB of memory", ask, replace(SCENE, roughness=BROAD), error=Refused)


@pytest.mark.parametrize("solver", [BEM(points=32), MDR(), MDR(spectrum="line-scan")], ids=str)
def test_more_waves_of_a_map_than_fit_are_refused_before_they_are_built(solver, monkeypatch):
    monkeypatch.setattr(scene.surfaces.topography, "_waves", lambda *_: pytest.fail("waves were built"))
    rough = replace(SCENE, roughness=Topography(heights=np.eye(4, MOST_WAVES + 2), pixel=1e-6))
    plane = replace(rough, indenter=Plane(), motion=Slide(speed=0.1, pressure=1e4))
    refused = f"roughness = Topography has {MOST_WAVES + 1} waves a side, {MOST_WAVES} fit in memory: take a part"
    for asked in (rough, plane) if solver.name == "BEM" else (rough,):
        for ask in (solver.solve, solver.plan):
            with pytest.raises(Refused, match=refused):
                ask(asked)


@pytest.mark.skipif(sys.platform == "win32", reason="there is no ulimit")
def test_a_limit_of_the_process_is_what_it_has():
    limit = min(memory(), 3 * 10**9) // 4096 * 4096
    code = (
        f"import resource; resource.setrlimit(resource.RLIMIT_AS, ({limit}, {limit}))\n"
        "from scene.protocol import memory; print(memory())"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert int(run.stdout) == limit


def test_memory_that_runs_out_is_told_as_memory_and_no_mistake_of_the_scene():
    with (
        pytest.raises(OutOfMemory, match=r"memory ran out \(Unable to allocate.*take fewer points"),
        numeric_guard(),
    ):
        np.empty(2**60 // 8)
    with pytest.raises(OutOfMemory, match="no size is known"), numeric_guard():
        raise MemoryError


@dataclass(frozen=True)
class Hungry:
    """A solver that takes more than there is."""

    name = "hungry"

    def refusals(self, scene):
        return []

    def solve(self, scene):
        with numeric_guard():
            np.empty(2**60 // 8)


def test_it_is_never_stored_as_an_answer(tmp_path, in_this_process):
    task, store = SceneTask(Hungry(), (SCENE,)), Store(tmp_path)
    swept = sweep([task], store, workers=1)
    assert swept.faults[task].startswith("OutOfMemory: memory ran out")
    assert store.get(task) is None
