"""Time of the 3D solver and of its peers, tamaas and ContactMechanics: for docs/results/workprecision.md.

python docs/measure/benchmark.py

The peers come with the extra `peers`. Every run is alone in a process of one thread.
"""

import json
import os
import re
import subprocess
import sys
import time

import numpy as np
import pandas
from tables import RESULTS, cells, fill, stored, table

from bem3d import BEM, heights
from scene import Elastic, Indent, Plane, Scene, SelfAffine

PAGE, MEASURED = RESULTS / "workprecision.md", RESULTS / "workprecision/benchmark.csv"
GRIDS = 1024, 2048  # points a side
ELASTIC = Elastic(0.25)  # E* = 4G = 1
SLOPE, PRESSURE = 0.1, 0.0035
WANTED = 1e-6  # complementarity error that every code is to reach
TOLERANCES = (1e-5, 5e-6, 2e-6, 1e-6, 5e-7, 2e-7, 1e-7)  # tried in turn, each code by its own measure
MOST = 1000  # iterations allowed to a peer


def rough_plane(n):
    """The surface of the comparison: shortest wave of 8 pixels, roll-off at a quarter of the cell."""
    of = {"hurst": 0.8, "longest": 1.0, "rolloff": 0.25, "shortest": 8 / n, "seed": 1}
    unit = SelfAffine(rms_height=1.0, **of)
    return SelfAffine(rms_height=SLOPE / unit.rms_slope(unit.q_max(1 / n)), **of)


def cell(n, pressure=PRESSURE):
    """A rough cell under a mean pressure over E*."""
    return Scene(Plane(), ELASTIC, Indent(pressure=pressure), rough_plane(n)), BEM(points=n)


def heights_of(scene, solver):
    """What a peer is given: z on the points of our grid."""
    return heights(scene, solver.points, solver.extent or 1.0).height


def outcome(heights, pressure, gap, **more):
    """Row of one run; the error is sum|p gap| over sum(p) and the standard deviation of all heights."""
    return {"error": float(np.sum(np.abs(pressure * gap)) / (pressure.sum() * heights.std()))} | more


def by_us(scene, solver, tolerance):
    """From the scene to the result: drawing the surface and the coarser grids are included."""
    result = BEM(points=solver.points, tolerance=tolerance).solve(scene)
    costs = {"seconds": result.seconds, "iterations": result.operator_applications}
    return outcome(heights_of(scene, solver), result.fields["pressure"], result.fields["gap"], **costs)


def by_tamaas(scene, solver, tolerance):
    """Polonsky and Keer's conjugate gradients; the solve alone. The tolerance is the error itself."""
    import tamaas

    tamaas.initialize(1)
    n, heights = solver.points, heights_of(scene, solver)
    model = tamaas.ModelFactory.createModel(tamaas.model_type.basic_2d, [1.0, 1.0], [n, n])
    model.E, model.nu = 1.0, 0.0
    peer = tamaas.PolonskyKeerRey(model, np.ascontiguousarray(-heights), tolerance)
    peer.max_iter, peer.dump_freq = MOST, 1  # it prints each iteration
    started = time.process_time()
    peer.solve(scene.motion.pressure)
    return outcome(heights, model.traction, model["gap"], seconds=time.process_time() - started)


def by_contact_mechanics(scene, solver, tolerance):
    """Numbers of a solve by ContactMechanics, by the same method; the time of the solve alone."""
    import ContactMechanics
    from SurfaceTopography import Topography

    n, heights = solver.points, heights_of(scene, solver)
    substrate = ContactMechanics.PeriodicFFTElasticHalfSpace((n, n), 1.0, (1.0, 1.0))
    system = ContactMechanics.Systems.NonSmoothContactSystem(substrate, Topography(-heights, (1.0, 1.0)))
    limits = {"pentol": tolerance * heights.std(), "maxiter": MOST}
    started = time.process_time()
    found = system.minimize_proxy(external_force=scene.motion.pressure, **limits)
    costs = {"seconds": time.process_time() - started, "iterations": found.nit}
    return outcome(heights, found.jac, found.x[:n, :n] + heights - found.offset, **costs)


CODES = {"this": by_us, "tamaas": by_tamaas, "ContactMechanics": by_contact_mechanics}


def measured(name, n):
    """The first tolerance with which a code reaches the error wanted; if it stalls, its last try."""
    code = CODES[name]
    code(*cell(64, 0.01), 1e-3)  # compiles, imports
    for tolerance in TOLERANCES[TOLERANCES.index(WANTED) if code is by_tamaas else 0 :]:
        row = code(*cell(n), tolerance)
        if row["error"] <= WANTED or row.get("iterations", 0) >= MOST:
            break
    return row


def alone(name, n):
    """Row of a code on a grid, in a process of its own, on one thread."""
    threads = {f"{each}_NUM_THREADS": "1" for each in ("OMP", "OPENBLAS", "MKL", "NUMBA")}
    command = [sys.executable, __file__, name, str(n)]
    found = subprocess.run(command, env=os.environ | threads, capture_output=True, text=True, check=True)
    *_, count = re.findall(r"^ *(\d+) ", f"0 \n{found.stderr}", re.MULTILINE)  # that tamaas prints
    return {"points": n, "code": name, "iterations": int(count)} | json.loads(found.stdout.splitlines()[-1])


def parts():
    """Text between two comments of the page, by the name of the comment."""
    found = pandas.read_csv(MEASURED)
    found["over"] = found["seconds"] / found.groupby("points")["seconds"].transform("first")
    shown = cells("{points}²|{code}|{iterations}|{error:.1e}|{seconds:.3g}|{over:.1f}", found)
    return {"benchmark": table("points|code|iterations|error|processor time [s]|over this", shown)}


def main(name="", points=""):
    """Measure, and write the numbers and the part of the page; of one code, print its row."""
    if name:
        print(json.dumps(measured(name, int(points))))
        return
    stored(MEASURED, (alone(name, n) for n in GRIDS for name in CODES))
    fill(PAGE, parts())


if __name__ == "__main__":
    main(*sys.argv[1:])
