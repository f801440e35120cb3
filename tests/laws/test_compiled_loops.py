"""What numba makes of a loop is what Python makes of it: the same scenes, compiled and as plain Python.

Run with NUMBA_DISABLE_JIT=1, this process is the plain one; so the loops are seen when coverage is measured.
"""

import errno
import json
import math
import os
import subprocess
import sys

import numpy as np
import pytest

from bem3d import BEM
from mdr1d import MDR
from mdr1d.ensemble import solve_profiles
from scene import (
    Cone,
    Cylinder,
    Elastic,
    Indent,
    Kelvin,
    KelvinChain,
    Plane,
    Program,
    Prony,
    Scene,
    SelfAffine,
    Slide,
    Sphere,
    Stage,
    StandardLinearSolid,
    loops,
)

PLAIN = os.environ.get("NUMBA_DISABLE_JIT") == "1"
# Sums in another order, and products contracted or not, over some hundred terms; a load is met to 1e-13.
ROUNDING = 1e-9

SPHERE, CONE = Sphere(radius=1e-2), Cone(angle=0.1)
ROUGH = SelfAffine(hurst=0.5, rms_height=2e-5, longest=5e-3, shortest=5e-4, seed=3)
KELVIN = Kelvin(modulus=1e6, relaxation_time=1e-3)
STANDARD = StandardLinearSolid(rubbery_modulus=1e6, glassy_modulus=1e7, relaxation_time=1e-3)
PRONY = Prony(equilibrium_modulus=1e6, moduli=(2e6, 5e6), relaxation_times=(1e-2, 1e-4))
CHAIN = KelvinChain(instantaneous_compliance=0.0, compliances=(5e-7, 5e-7), retardation_times=(1e-3, 1e-2))
IN_AND_BACK = (
    Stage(duration=5e-3, depth=3e-5),
    Stage(duration=2e-2, speed=0.05),
    Stage(duration=1e-2, speed=-0.05),
    Stage(duration=2e-3, amplitude=5e-6, frequency=50.0),
    Stage(duration=2e-3, depth=0.0),
)
LOADED = (Stage(duration=5e-3, load=1.0), Stage(duration=1e-2, speed=0.1), Stage(duration=5e-3, load=0.2))

LINES = {
    f"{type(solid).__name__}, {k}": Scene(CONE if k % 2 else SPHERE, solid, motion, ROUGH if (j + k) % 2 else None)
    for j, solid in enumerate((Elastic(modulus=1e6), KELVIN, STANDARD, PRONY, CHAIN))
    for k, motion in enumerate(
        (
            Indent(depth=3e-5),
            Slide(speed=0.1, load=1.0),
            Slide(speed=0.5, depth=4e-5),
            Program(stages=IN_AND_BACK),
            Program(stages=LOADED),
        )
    )
}
PLANES = {
    "sliding": Scene(SPHERE, KELVIN, Slide(speed=0.1, load=1.0)),
    "at rest": Scene(CONE, Elastic(modulus=1e6), Indent(depth=5e-5)),
    "line": Scene(Cylinder(radius=1e-2), STANDARD, Slide(speed=0.1, line_load=100.0)),
    "cell": Scene(
        Plane(),
        STANDARD,
        Slide(speed=0.1, pressure=1e4),
        SelfAffine(hurst=0.5, rms_height=1e-6, longest=1e-3, shortest=2.5e-4, seed=1),
    ),
}


def answers():
    """Forces, depth and friction by scene, as JSON can hold them."""
    found = {name: _numbers(MDR(points=100, steps=10).solve(scene)) for name, scene in LINES.items()}
    # Solved closely, as rounding decides about the last pixels of an edge.
    found |= {name: _numbers(BEM(points=16, tolerance=1e-10).solve(scene)) for name, scene in PLANES.items()}
    many = solve_profiles(
        [Scene(SPHERE, KELVIN, Slide(speed=v, load=1.0), ROUGH) for v in (0.01, 1.0)], [400, 400], [1, 2]
    )
    found["ensemble"] = [float(value) for value in np.ravel([many.friction, many.depth, many.length])]
    return found


def _numbers(result):
    return [result.normal_force, result.depth, result.friction_force]


def test_compiled_loops_answer_as_plain_python_does():
    """Tolerance: see ROUNDING. The other process differs in nothing but NUMBA_DISABLE_JIT."""
    other = subprocess.run(
        [sys.executable, __file__],
        env=os.environ | {"NUMBA_DISABLE_JIT": "0" if PLAIN else "1"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert other.returncode == 0, other.stderr
    here, there = answers(), json.loads(other.stdout)
    assert here.keys() == there.keys()
    for name, values in here.items():
        assert np.isfinite(values).all(), name
        size = max(map(abs, values)) * ROUNDING * math.sqrt(np.finfo(float).eps)
        assert values == pytest.approx(there[name], rel=ROUNDING, abs=size), name


@pytest.mark.skipif(PLAIN, reason="nothing is compiled")
@pytest.mark.parametrize(
    "function", [eval("lambda x: 2 * x"), lambda x: 2 * x], ids=["no folder for it", "a full disk"]
)
def test_code_that_cannot_be_kept_serves_its_process_and_that_is_said_once(monkeypatch, function):
    def full(*_):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr("numba.core.caching.IndexDataCacheFile.save", full)
    loops._say.cache_clear()
    with pytest.warns(UserWarning, match="compiled code cannot be kept") as caught:
        answers = [loops.compiled()(function)(1.5) for _ in range(2)]
    assert (answers, len(caught)) == ([3.0, 3.0], 1)


if __name__ == "__main__":
    print(json.dumps(answers()))
