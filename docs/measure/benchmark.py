"""Time of the 3D solver and of its peers, tamaas and ContactMechanics: for docs/results/workprecision.md.

python docs/measure/benchmark.py

The peers come with the extra `peers`. Every run is alone in a process of one thread.
"""

import multiprocessing
import os
import tempfile
import time
import warnings
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pandas
from tables import fill, stored, table

from bem3d import BEM, heights
from scene import Elastic, Indent, Plane, Scene, SelfAffine

PAGE = Path(__file__).parents[1] / "results" / "workprecision.md"
MEASURED = PAGE.with_suffix("") / "benchmark.csv"
GRIDS = 1024, 2048  # points a side
ELASTIC = Elastic(0.25)  # E* = 4G = 1
SLOPE, PRESSURE = 0.1, 0.0035
WANTED = 1e-6  # complementarity error that every code is to reach
TOLERANCES = (1e-5, 5e-6, 2e-6, 1e-6, 5e-7, 2e-7, 1e-7)  # tried in turn, each code by its own measure
MOST = 1000  # iterations allowed to a peer


def rough_plane(n: int) -> SelfAffine:
    """The surface of the comparison: shortest wave of 8 pixels, roll-off at a quarter of the cell."""
    of = {"hurst": 0.8, "longest": 1.0, "rolloff": 0.25, "shortest": 8 / n, "seed": 1}
    unit = SelfAffine(rms_height=1.0, **of)
    return SelfAffine(rms_height=SLOPE / unit.rms_slope(unit.q_max(1 / n)), **of)


def cell(n: int, pressure: float = PRESSURE) -> tuple[Scene, BEM]:
    """A rough cell under a mean pressure over E*."""
    return Scene(Plane(), ELASTIC, Indent(pressure=pressure), rough_plane(n)), BEM(points=n)


def alone(function, *arguments):
    """The value of a call in a process of its own, on one thread."""
    for name in ("OMP", "OPENBLAS", "MKL", "NUMBA"):
        os.environ[f"{name}_NUM_THREADS"] = "1"
    with ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn")) as process:
        return process.submit(function, *arguments).result()


def heights_of(scene: Scene, solver: BEM) -> np.ndarray:
    """What a peer is given: z on the points of our grid."""
    return heights(scene, solver.points, solver.extent or 1.0).height


def outcome(heights, tolerance, pressure, gap, **more) -> dict:
    """Row of one run; the error is sum|p gap| over sum(p) and the standard deviation of all heights."""
    error = float(np.sum(np.abs(pressure * gap)) / (pressure.sum() * heights.std()))
    touching = float(np.mean(pressure > 0))
    return {"tolerance": tolerance, "error": error, "touching": touching} | more


def by_us(scene: Scene, solver: BEM, tolerance: float) -> dict:
    """From the scene to the result: drawing the surface and the coarser grids are included."""
    result = BEM(points=solver.points, tolerance=tolerance).solve(scene)
    return outcome(
        heights_of(scene, solver),
        tolerance,
        result.fields["pressure"],
        result.fields["gap"],
        seconds=result.seconds,
        iterations=result.operator_applications,
    )


def by_tamaas(scene: Scene, solver: BEM, tolerance: float) -> dict:
    """Polonsky and Keer's conjugate gradients; the solve alone. The tolerance is the error itself."""
    import tamaas

    tamaas.initialize(1)
    n, heights = solver.points, heights_of(scene, solver)
    model = tamaas.ModelFactory.createModel(tamaas.model_type.basic_2d, [1.0, 1.0], [n, n])
    model.E, model.nu = 1.0, 0.0
    peer = tamaas.PolonskyKeerRey(model, np.ascontiguousarray(-heights), tolerance)
    peer.max_iter, peer.dump_freq = MOST, 1
    with printed() as lines:
        started = time.process_time()
        peer.solve(scene.motion.pressure)
        seconds = time.process_time() - started
    counts = [int(line.split()[0]) for line in lines if line.split()[:1] and line.split()[0].isdigit()]
    return outcome(heights, tolerance, model.traction, model["gap"], seconds=seconds, iterations=max(counts))


@contextmanager
def printed():
    """What a compiled library prints meanwhile, as lines, once it is over."""
    lines: list[str] = []
    with tempfile.TemporaryFile("w+", encoding="utf-8", errors="replace") as file:
        kept = [(number, os.dup(number)) for number in (1, 2)]
        for number, _ in kept:
            os.dup2(file.fileno(), number)
        try:
            yield lines
        finally:
            for number, copy in kept:
                os.dup2(copy, number)
                os.close(copy)
            file.seek(0)
            lines += file.read().splitlines()


def by_contact_mechanics(scene: Scene, solver: BEM, tolerance: float) -> dict:
    """Numbers of a solve by ContactMechanics, by the same method; the time of the solve alone."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        import ContactMechanics
        from SurfaceTopography import Topography
    n, heights = solver.points, heights_of(scene, solver)
    substrate = ContactMechanics.PeriodicFFTElasticHalfSpace((n, n), 1.0, (1.0, 1.0))
    system = ContactMechanics.Systems.NonSmoothContactSystem(substrate, Topography(-heights, (1.0, 1.0)))
    started = time.process_time()
    found = system.minimize_proxy(
        pentol=tolerance * heights.std(), maxiter=MOST, external_force=scene.motion.pressure
    )
    seconds = time.process_time() - started
    gap = found.x[:n, :n] + heights - found.offset
    return outcome(heights, tolerance, found.jac, gap, seconds=seconds, iterations=found.nit)


CODES = {"this": by_us, "tamaas": by_tamaas, "ContactMechanics": by_contact_mechanics}


def measured(code, scene: Scene, solver: BEM) -> dict:
    """The first tolerance with which a code reaches the error wanted; if it stalls, its last try."""
    code(*cell(64, 0.01), 1e-3)  # compiles, imports
    for tolerance in TOLERANCES[TOLERANCES.index(WANTED) if code is by_tamaas else 0 :]:
        row = code(scene, solver, tolerance)
        if row["error"] <= WANTED or row["iterations"] >= MOST:
            break
    return row


def rows() -> Iterator[dict]:
    """A row for each grid and code."""
    for n in GRIDS:
        for name, code in CODES.items():
            yield {"points": n, "code": name} | alone(measured, code, *cell(n))


def parts() -> dict[str, str]:
    """Text between two comments of the page, by the name of the comment."""
    found = pandas.read_csv(MEASURED)
    own = found[found["code"] == "this"].set_index("points")["seconds"]
    times = found["seconds"] / found["points"].map(own)
    shown = (
        (f"{row.points}²", row.code, f"{row.iterations}", f"{row.error:.1e}", f"{row.seconds:.3g}", f"{over:.1f}")
        for row, over in zip(found.itertuples(), times, strict=True)
    )
    return {"benchmark": table("points|code|iterations|error|processor time [s]|over this", shown)}


def main() -> None:
    """Measure, and write the numbers and the part of the page."""
    stored(MEASURED, rows())
    fill(PAGE, parts())


if __name__ == "__main__":
    main()
