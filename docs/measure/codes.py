"""The codes that the benchmark sets side by side: a scene and a tolerance in, a row of measures out."""

import os
import tempfile
import time
import warnings
from contextlib import contextmanager

import numpy as np

from bem3d import BEM, heights
from scene import Scene

MOST = 1000  # iterations allowed to a peer


def heights_of(scene: Scene, solver: BEM) -> np.ndarray:
    """What a peer is given: z on the points of our grid."""
    return heights(scene, solver.points, solver.extent or 1.0).height


def outcome(heights, tolerance, pressure, gap, **more) -> dict:
    """Row of one run; the error is sum|p gap| over sum(p) and the standard deviation of all heights."""
    error = float(np.sum(np.abs(pressure * gap)) / (pressure.sum() * heights.std()))
    penetration = -float(gap.min()) / heights.std()
    touching = float(np.mean(pressure > 0))
    return {"tolerance": tolerance, "error": error, "penetration": penetration, "touching": touching} | more


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
        pairs=result.measures["transform_pairs"],
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
    """Numbers of a solve by ContactMechanics, by the same method; its time is that of the solve alone."""
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
    counts = {"iterations": found.nit, "pairs": found.nfev}
    return outcome(heights, tolerance, found.jac, gap, seconds=seconds, **counts)


CODES = {"this": by_us, "tamaas": by_tamaas, "ContactMechanics": by_contact_mechanics}
