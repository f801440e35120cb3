"""Measures the 3D solver beside its peers, tamaas and ContactMechanics, for docs/results/benchmark.md.

python docs/measure/benchmark.py [cells] [loads] [sliding]

The peers come with the extra `peers`. Every run is alone in a process of one thread.
"""

import importlib.metadata
import multiprocessing
import os
import platform
import sys
import time
import timeit
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from datetime import date
from math import sqrt
from pathlib import Path

from codes import CODES, MOST, by_tamaas
from scipy.optimize import brentq
from tables import table, write

from bem3d import BEM
from scene import Elastic, Indent, Kelvin, Plane, Refused, Scene, SelfAffine, Slide, SolveError, Sphere

PAGE = Path(__file__).parents[1] / "results" / "benchmark.md"
GRIDS = 256, 512, 1024, 2048  # points a side
ELASTIC = Elastic(0.25)  # E* = 4G = 1
SLOPE, PRESSURE = 0.1, 0.0035
WANTED = 1e-6  # complementarity error that every code is to reach
PENETRATION = 1e-3  # over the standard deviation of the heights: more is no solution, though the error be small
TOLERANCES = (1e-5, 5e-6, 2e-6, 1e-6, 5e-7, 2e-7, 1e-7)  # tried in turn, each code by its own measure
REPEATED, REPEATS = 512, 3  # up to this size the least of so many runs counts
UNANSWERED = (Refused, SolveError)
PAPER = Sphere(10e-3), SelfAffine(hurst=0.2, rms_height=5e-5, longest=1e-2, shortest=5e-4, seed=1)


def rough_plane(n: int) -> SelfAffine:
    """The surface of the comparison: shortest wave of 8 pixels, roll-off at a quarter of the cell."""
    of = {"hurst": 0.8, "longest": 1.0, "rolloff": 0.25, "shortest": 8 / n, "seed": 1}
    unit = SelfAffine(rms_height=1.0, **of)
    return SelfAffine(rms_height=SLOPE / unit.rms_slope(unit.q_max(1 / n)), **of)


def cell(n: int, pressure: float) -> tuple[Scene, BEM]:
    """A rough cell under a mean pressure over E*."""
    return Scene(Plane(), ELASTIC, Indent(pressure=pressure), rough_plane(n)), BEM(points=n)


def alone(function, *arguments):
    """The value of a call in a process of its own, on one thread."""
    for name in ("OMP", "OPENBLAS", "MKL", "NUMBA"):
        os.environ[f"{name}_NUM_THREADS"] = "1"
    with ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn")) as process:
        return process.submit(function, *arguments).result()


def pair(n: int) -> float:
    """Least processor seconds of one rfft2 and irfft2 of n x n by pyfftw, planned with MEASURE, one thread."""
    import pyfftw

    points, waves = pyfftw.zeros_aligned((n, n)), pyfftw.zeros_aligned((n, n // 2 + 1), complex)
    axes = {"axes": (0, 1), "flags": ("FFTW_MEASURE", "FFTW_DESTROY_INPUT")}
    forward = pyfftw.FFTW(points, waves, **axes)
    backward = pyfftw.FFTW(waves, points, direction="FFTW_BACKWARD", **axes)
    points[:] = 1.0
    both = timeit.Timer(lambda: (forward.execute(), backward.execute()), timer=time.process_time)
    return min(both.repeat(30, number=1))


def measured(code, scene: Scene, solver: BEM) -> dict:
    """The first tolerance with which a code reaches the error wanted; if it stalls, its last try."""
    try:
        code(*cell(64, 0.01), 1e-3)  # compiles, imports
    except ImportError:
        return {"reason": "not installed"}
    for tolerance in TOLERANCES[TOLERANCES.index(WANTED) if code is by_tamaas else 0 :]:
        try:
            row = code(scene, solver, tolerance)
        except UNANSWERED as reason:
            return {"reason": str(reason)}
        if row["error"] <= WANTED or row["iterations"] >= MOST:
            break
    repeats = REPEATS - 1 if solver.points <= REPEATED and row["iterations"] < MOST else 0
    again = [code(scene, solver, row["tolerance"])["seconds"] for _ in range(repeats)]
    row["seconds"] = min([row["seconds"], *again])
    row["pair"] = pair(solver.points)
    return row


COLUMNS = "code|iterations|transform pairs|error|in contact|processor s|in pairs|of ours"


def side_by_side(label: str, scene: Scene, solver: BEM):
    """Rows of a table, one a code."""
    own = None
    for name, code in CODES.items():
        row = alone(measured, code, scene, solver)
        own = own or row
        yield label, name, *shown(row, own)
        print(label, name, row, flush=True, file=sys.stderr)


def shown(row, own):
    """The cells of a row; a code that stalls or refuses says so."""
    if "reason" in row:
        return row["reason"], *[""] * 6
    wrong = " (stalls)" if row["error"] > WANTED else " (penetrates)" if row["penetration"] > PENETRATION else ""
    return (
        f"{row['iterations']:.0f}{wrong}",
        f"{row['pairs']:.0f}" if "pairs" in row else "",
        f"{row['error']:.1e}",
        f"{row['touching']:.3%}",
        f"{row['seconds']:.3g}",
        f"{row['seconds'] / row['pair']:.0f}",
        f"{row['seconds'] / own['seconds']:.1f}" if "seconds" in own else "",
    )


def rough_cells() -> str:
    """The comparison of the peers by size."""
    return table(f"points|{COLUMNS}", (row for n in GRIDS for row in side_by_side(f"{n}²", *cell(n, PRESSURE))))


def pressure_for(n: int, fraction: float) -> float:
    """Mean pressure over E* at which so much of a rough cell touches."""

    def excess(pressure):
        return cell(n, pressure)[1].solve(cell(n, pressure)[0]).measures["contact_fraction"] - fraction

    return float(brentq(excess, 0.05 * SLOPE, 2.5 * SLOPE, xtol=1e-3 * SLOPE, rtol=1e-4))


def other_loads() -> str:
    """From a few asperities to almost full contact."""
    n = GRIDS[1]

    def rows():
        for pressure in (1e-6, 1e-4):
            yield from side_by_side(f"{pressure:.0e}", *cell(n, pressure))
        for fraction in (0.5, 0.99):
            pressure = alone(pressure_for, n, fraction)
            yield from side_by_side(f"{pressure:.3g}", *cell(n, pressure))

    return table(f"mean pressure / E*|{COLUMNS}", rows())


def slid(solver: BEM, scene: Scene) -> dict:
    """One steady sliding solve."""
    try:
        BEM(points=32).solve(replace(scene, roughness=None))  # compiles
        result = solver.solve(scene)
    except UNANSWERED as reason:
        return {"reason": str(reason)}
    names = ("rounds", "transform_pairs", "friction_disagreement")
    return {
        "operator_applications": result.operator_applications,
        "seconds": result.seconds,
        "friction": result.friction_coefficient,
    } | {name: result.measures[name] for name in names}


def steady_sliding() -> str:
    """Kelvin sphere, smooth and rough, by speed."""
    n, (indenter, rough), tau, depth = GRIDS[1], PAPER, 1e-3, 1e-4
    a, load = sqrt(indenter.radius * depth), 4 / 3 * 4e6 * sqrt(indenter.radius) * depth**1.5

    def rows():
        for name, roughness in (("smooth", None), ("rough", rough)):
            for decade in range(-4, 5, 2):
                motion = Slide(speed=10.0**decade * a / tau, load=load)
                row = alone(slid, BEM(points=n), Scene(indenter, Kelvin(1e6, tau), motion, roughness))
                print(name, decade, row, flush=True, file=sys.stderr)
                if "reason" in row:
                    yield name, f"1e{decade}", row["reason"], *[""] * 5
                    continue
                yield (
                    name,
                    f"1e{decade}",
                    f"{row['rounds']:.0f}",
                    f"{row['operator_applications']:.0f}",
                    f"{row['transform_pairs']:.0f}",
                    f"{row['seconds']:.3g}",
                    f"{row['friction']:.5g}",
                    f"{row['friction_disagreement']:.1e}",
                )

    return table(
        "sphere|v τ/a|rounds|operator applications|products in all|processor s|μ|disagreement of μ", rows()
    )


def machine() -> str:
    """Day, processor and versions, without names of places."""
    lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    cpu = next(line for line in lines if line.startswith("model name"))
    names = "numpy", "scipy", "numba", "ducc0", "pyfftw", "tamaas", "ContactMechanics"
    versions = ", ".join(f"{name} {importlib.metadata.version(name)}" for name in names)
    cores = f"{os.cpu_count()} cores (load at the start {os.getloadavg()[0]:.1f})"
    return f"{date.today()}, {cpu.split(': ')[1]}, {cores}, Python {platform.python_version()}, {versions}."


SECTIONS = {
    "machine": machine,
    "cells": rough_cells,
    "loads": other_loads,
    "sliding": steady_sliding,
}

if __name__ == "__main__":
    write(PAGE, {name: SECTIONS[name] for name in sys.argv[1:] or SECTIONS})
