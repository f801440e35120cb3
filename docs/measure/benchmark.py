"""Measures the 3D solver beside its peers, tamaas and ContactMechanics, and writes results/benchmark.md.

python docs/measure/benchmark.py [--largest N] [--quick] [--output FILE]

The peers come with the extra `peers`; without one its rows say so. Every run is alone in a process of one thread.
"""

import argparse
import importlib.metadata
import os
import platform
import sys
import time
from dataclasses import replace
from datetime import date
from itertools import chain, product
from math import sqrt
from pathlib import Path
from unittest.mock import patch

import numpy as np
from codes import CODES, MOST, by_tamaas, unhelped
from scipy.optimize import brentq
from tables import table
from timing import alone, least, pair

from bem3d import BEM, Trail, contact
from compare.studies.claims.catalogue import SIZES as STUDY_SIZES
from compare.studies.claims.catalogue import STUDIES
from scene import (
    Elastic,
    Fractional,
    Indent,
    Kelvin,
    Plane,
    Prony,
    Refused,
    Scene,
    SelfAffine,
    Slide,
    SolveError,
    Sphere,
    StandardLinearSolid,
)

ELASTIC = Elastic(0.25)  # E* = 4G = 1
SLOPE, PRESSURE = 0.1, 0.0035
WANTED = 1e-6  # complementarity error that every code is to reach
PENETRATION = 1e-3  # over the standard deviation of the heights: more is no solution, though the error be small
TOLERANCES = (1e-5, 5e-6, 2e-6, 1e-6, 5e-7, 2e-7, 1e-7)  # tried in turn, each code by its own measure
REPEATED, REPEATS = 512, 3  # up to this size the least of so many runs counts
SPHERE, DEPTH, SIDE = Sphere(1.0), 0.02, 0.4  # the contact is 0.28 across
ROUGH = SelfAffine(hurst=0.8, rms_height=4e-4, longest=1.0, rolloff=0.25, shortest=8e-3, seed=1)
UNANSWERED = (Refused, SolveError)
DRAWN = 60  # scenes
THREADED, OVERHEADS = 5, 5  # runs
PAPER = Sphere(10e-3), SelfAffine(hurst=0.2, rms_height=5e-5, longest=1e-2, shortest=5e-4, seed=1)


def rough_plane(n: int, hurst: float = 0.8, seed: int = 1) -> SelfAffine:
    """The surface of the comparison: shortest wave of 8 pixels, roll-off at a quarter of the cell."""
    of = {"hurst": hurst, "longest": 1.0, "rolloff": 0.25, "shortest": 8 / n, "seed": seed}
    unit = SelfAffine(rms_height=1.0, **of)
    return SelfAffine(rms_height=SLOPE / unit.rms_slope(unit.q_max(1 / n)), **of)


def cell(n: int, pressure: float, **surface: float) -> tuple[Scene, BEM]:
    """A rough cell under a mean pressure over E*."""
    return Scene(Plane(), ELASTIC, Indent(pressure=pressure), rough_plane(n, **surface)), BEM(points=n)


def sphere(n: int, **pressed: float) -> tuple[Scene, BEM]:
    """A rough sphere on a free surface, on a given square."""
    return Scene(SPHERE, ELASTIC, Indent(**pressed), ROUGH), BEM(points=n, extent=SIDE)


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
    row["pair"] = pair(solver.points * (1 if solver.extent is None else 2))
    return row


COLUMNS = "code|iterations|transform pairs|error|in contact|processor s|in pairs|of ours"


def side_by_side(label: str, scene: Scene, solver: BEM, codes=CODES):
    """Rows of a table, one a code."""
    own = None
    for name, code in codes.items():
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


def sizes(largest: int) -> list[int]:
    """256, 512 and so on to the largest asked for."""
    return [n for n in (128, 256, 512, 1024, 2048, 4096) if min(256, largest) <= n <= largest]


def rough_cells(largest: int) -> str:
    """The comparison of the peers by size."""
    return table(
        f"points|{COLUMNS}", (row for n in sizes(largest) for row in side_by_side(f"{n}²", *cell(n, PRESSURE)))
    )


def other_surfaces(largest: int) -> str:
    """The same comparison on surfaces of other Hurst exponents and seeds."""
    n = min(512, largest)
    codes = {name: code for name, code in CODES.items() if name != "ContactMechanics"}

    def rows():
        for hurst, seed in product((0.2, 0.5, 0.8), (2, 3)):
            yield from side_by_side(f"{hurst:g}, {seed}", *cell(n, PRESSURE, hurst=hurst, seed=seed), codes)

    return f"{n}² points.\n\n" + table(f"H, seed|{COLUMNS}", rows())


def largest_cell(largest: int) -> str:
    """The largest cell that is measured, by this solver alone."""
    n = min(4096, 2 * largest)
    return table(f"points|{COLUMNS}", side_by_side(f"{n}²", *cell(n, PRESSURE), dict([next(iter(CODES.items()))])))


def wall(scene: Scene, solver: BEM, threads: tuple[int, ...]) -> list[float]:
    """Least seconds of wall time of a solve by number of threads, measured in turn."""
    solver.solve(scene)  # compiles
    seconds = {count: [] for count in threads}
    for _, count in product(range(THREADED), threads):
        started = time.perf_counter()
        replace(solver, threads=count).solve(scene)
        seconds[count].append(time.perf_counter() - started)
    return [min(each) for each in seconds.values()]


def threads(largest: int) -> str:
    """What a second thread of the transforms brings."""

    def rows():
        for n in (n for n in (512, 1024, 2048) if n <= max(largest, 512)):
            one, two = alone(wall, *cell(n, PRESSURE), (1, 2))
            yield f"{n}²", f"{one:.3g}", f"{two:.3g}", f"{one / two:.2f}"

    return table("points|s, one thread|s, two|times as fast", rows())


def along(scene: Scene, speeds, points: int) -> dict:
    """Pairs on the fine grid and processor seconds of a point, on half the points and on all: alone and on a path.

    The change of friction is that between both, the largest.
    """
    grids, trail = (BEM(points=points // 2), BEM(points=points)), Trail()
    spent, changed = {"alone": np.zeros(2), "on a path": np.zeros(2)}, 0.0
    for grid in grids:
        grid.solve(replace(scene, motion=replace(scene.motion, speed=speeds[0])))  # compiles
    for speed, grid in product(speeds, grids):
        slid, found = replace(scene, motion=replace(scene.motion, speed=speed)), {}
        for way, extra in (("alone", ()), ("on a path", (trail,))):
            started = time.process_time()
            found[way] = grid.solve(slid, *extra)
            share = found[way].measures["transform_pairs"] * (grid.points / points) ** 2
            spent[way] += share, time.process_time() - started
        one, other = (each.friction_coefficient for each in found.values())
        changed = max(changed, abs(other / one - 1))
    return {"changed": changed} | {way: each / len(speeds) for way, each in spent.items()}


def paths(largest: int) -> str:
    """What a point of `study collapse` costs alone, and on the path that solves it."""
    size = STUDY_SIZES["standard"]

    def rows():
        for series in (each for each in STUDIES["collapse"].series(size) if each.prescribed == "load"):
            for points in (n for n in (128, 256, 512) if n <= max(256, largest)):
                load = series.values[len(series.values) // 2]
                scene = replace(series.scene, motion=Slide(speed=1.0, load=load))
                found = alone(along, scene, series.speeds, points)
                (pairs, seconds), (fewer, less) = found["alone"], found["on a path"]
                yield (
                    series.name,
                    f"{points}²",
                    *(f"{value:.0f}" for value in (pairs, fewer)),
                    *(f"{value:.3g}" for value in (seconds, less)),
                    f"{less / seconds:.2f}",
                    f"{found['changed']:.1e}",
                )

    return table(
        "body|points|pairs alone|on a path|processor s alone|on a path|of a solve alone|largest change of μ",
        rows(),
    )


def pressure_for(n: int, fraction: float) -> float:
    """Mean pressure over E* at which so much of a rough cell touches."""

    def excess(pressure):
        return cell(n, pressure)[1].solve(cell(n, pressure)[0]).measures["contact_fraction"] - fraction

    return float(brentq(excess, 0.05 * SLOPE, 2.5 * SLOPE, xtol=1e-3 * SLOPE, rtol=1e-4))


def other_loads(largest: int) -> str:
    """From a few asperities to almost full contact."""
    n = min(512, largest)

    def rows():
        for pressure in (1e-6, 1e-5, 1e-4):
            yield from side_by_side(f"{pressure:.0e}", *cell(n, pressure))
        for fraction in (0.5, 0.9, 0.99, 0.999):
            pressure = alone(pressure_for, n, fraction)
            yield from side_by_side(f"{pressure:.3g}", *cell(n, pressure))

    return table(f"mean pressure / E*|{COLUMNS}", rows())


def free_spheres(largest: int) -> str:
    """A rough sphere on a free surface, at given load and depth."""
    n = min(512, largest)
    free = {name: code for name, code in CODES.items() if name != "tamaas"}
    force = 4 / 3 * DEPTH**1.5

    def rows():
        yield from side_by_side("load", *sphere(n, load=force), free)
        guess = {"ContactMechanics, its own first guess": unhelped}
        yield from side_by_side("depth", *sphere(n, depth=DEPTH), free | guess)

    return table(f"given|{COLUMNS}", rows())


def iteration(scene: Scene, solver: BEM) -> tuple:
    """Products with operator and preconditioner on the finest grid: counts, milliseconds of one.

    Then the processor time of the solve there over that of its products, and of the whole solve over that of all
    its products, each as if on the finest grid.
    """
    runs, wholes, solve = [], [], contact.solve

    def timed(operator, *arguments, **settings):
        started = time.process_time()
        answer = solve(operator, *arguments, **settings)
        runs.append((time.process_time() - started, operator, settings["precondition"]))
        return answer

    solver.solve(scene)  # compiles
    for _ in range(OVERHEADS if solver.points <= 1024 else 1):
        with patch.object(contact, "solve", timed):
            whole = solver.solve(scene)
        wholes.append(whole.seconds)
        finest = min([run for run in runs if run[1].shape == runs[-1][1].shape], key=lambda run: run[0])
    seconds, operator, inverse = finest
    counts = operator.operator_applications, inverse.operator_applications
    plane, out = np.ones(operator.shape), np.empty(operator.shape)

    def cost(product):
        return least(lambda: product(plane, out=out), solver.points)

    each = cost(operator), cost(inverse)
    everywhere = whole.operator_applications, whole.measures["transform_pairs"] - whole.operator_applications
    over = [of / np.dot(count, each) for of, count in ((seconds, counts), (min(wholes), everywhere))]
    return *counts, *(1e3 * one for one in each), *over


def overhead(largest: int) -> str:
    """What an iteration costs beside its transforms."""
    sliding = Slide(speed=sqrt(SPHERE.radius * DEPTH) / 1e-3, depth=DEPTH)

    def rows():
        for n in sizes(largest):
            cases = {
                "rough cell": cell(n, PRESSURE),
                "rough sphere": sphere(n, depth=DEPTH),
                "rough sphere sliding, v τ = a": (
                    Scene(SPHERE, Kelvin(0.25, 1e-3), sliding, ROUGH),
                    BEM(points=n, extent=SIDE),
                ),
            }
            for name, case in cases.items():
                if n > 1024 and name != "rough cell":
                    continue
                try:
                    row = alone(iteration, *case)
                except UNANSWERED as reason:
                    yield f"{n}²", name, str(reason), *[""] * 5
                    continue
                yield (
                    f"{n}²",
                    name,
                    *(f"{count}" for count in row[:2]),
                    *(f"{value:.2f}" for value in row[2:]),
                )

    return table(
        "points|contact|operator products|preconditioner products|ms of one|ms of one|iteration / its products|"
        "whole solve / its products",
        rows(),
    )


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


def steady_sliding(largest: int) -> str:
    """Kelvin sphere, smooth and rough, by speed."""
    n, (indenter, rough), tau, depth = min(512, largest), PAPER, 1e-3, 1e-4
    a, load = sqrt(indenter.radius * depth), 4 / 3 * 4e6 * sqrt(indenter.radius) * depth**1.5

    def rows():
        for name, roughness in (("smooth", None), ("rough", rough)):
            for decade in range(-4, 5):
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


SOLIDS_DRAWN = ("Kelvin", "standard linear", "Prony", "fractional")


def drawn_sliding(seed: int) -> tuple[str, Scene]:
    """A sliding sphere at random: its solid, and the scene. The ranges stand in the text of the section."""
    rng = np.random.default_rng([20261123, seed])
    kind, tau, radius = rng.choice(SOLIDS_DRAWN, p=[0.4, 0.3, 0.15, 0.15]), 1e-3, 1e-2
    if kind == "Kelvin":
        solid = Kelvin(1e6, tau)
    elif kind == "standard linear":
        solid = StandardLinearSolid(1e6, 1e6 * 10 ** rng.uniform(0.3, 4), tau)
    elif kind == "Prony":
        times = tau * np.array([1, 10 ** rng.uniform(-2, -1), 10 ** rng.uniform(1, 2)])
        solid = Prony(1e6, tuple(1e6 * 10 ** rng.uniform(-0.5, 2, 3)), tuple(times))
    else:
        solid = Fractional(
            modulus=1e6,
            relaxation_time=tau,
            exponent=rng.uniform(0.2, 0.9),
            lowest_frequency=0.1,
            highest_frequency=1e6,
        )
    a = 1e-3 * rng.uniform(0.3, 1.2)
    depth, speed = a * a / radius, a * 10 ** rng.uniform(np.log10(3e-4), 3) / tau
    rough = None
    if rng.random() >= 0.3:
        shortest = a / rng.uniform(1, 8)
        longest = max(a * rng.uniform(1.5, 5), 3 * shortest)
        rough = SelfAffine(
            hurst=rng.uniform(0, 1),
            rms_height=depth * 10 ** rng.uniform(-2, -0.3),
            longest=longest,
            shortest=shortest,
            rolloff=longest * rng.uniform(0.6, 1) if rng.random() < 0.5 else None,
            seed=int(rng.integers(10**6)),
        )
    load = 4 / 3 * solid.indentation_modulus * a**3 / radius
    motion = Slide(speed=speed, load=load) if rng.random() < 0.7 else Slide(speed=speed, depth=depth)
    return kind, Scene(Sphere(radius), solid, motion, rough)


def sliding_drawn(largest: int) -> str:
    """Transform pairs of scenes drawn at random, by solid: failures count as the worst."""

    def rows():
        for n in (n for n in (256, 512) if n <= max(largest, 256)):
            pairs = {kind: [] for kind in SOLIDS_DRAWN}
            for seed in range(DRAWN):
                kind, scene = drawn_sliding(seed)
                row = slid(BEM(points=n), scene)
                pairs[kind].append(row.get("transform_pairs", np.inf))
            for kind, found in [*pairs.items(), ("all", [*chain.from_iterable(pairs.values())])]:
                yield f"{n}²", kind, str(len(found)), f"{np.median(found):.0f}", f"{max(found):.0f}"

    return table("points|solid|scenes|transform pairs, median|worst", rows())


SECTIONS = {
    "Rough cells": (
        f"Self-affine, H = 0.8, rms gradient {SLOPE}, roll-off at a quarter of the cell, shortest wave 8 pixels; "
        f"mean pressure {PRESSURE} E*. Aims at 1024² and 2048²: at most 110 and 130 pairs, tamaas at "
        "least 8 and 15 times as long.",
        rough_cells,
    ),
    "Other loads": (
        "The same surface from a few asperities to almost full contact. Where too few points touch for forces to "
        "be more than a guess, this solver refuses.",
        other_loads,
    ),
    "Free surface": (
        f"A rough sphere, R = 1, depth {DEPTH} or the force of Hertz there, on {SIDE} x {SIDE}: in pairs of "
        "the padded grid, twice as many points a side. At a depth ContactMechanics is given the overlap as a "
        "first guess of the forces; on some surfaces it does not converge from its own.",
        free_spheres,
    ),
    "Other surfaces": (
        "As the rough cells, of other Hurst exponents and seeds: nothing was tuned to them.",
        other_surfaces,
    ),
    "The largest cell": ("As the rough cells; once.", largest_cell),
    "Threads": (
        "Wall time of the rough cells by the threads of the transforms, the least of "
        f"{THREADED} runs in turn, whole solves. Aim: at least 1.7 times as fast from 1024² on.",
        threads,
    ),
    "Overhead": (
        "Processor time of the solve on the finest grid, started from the next coarser one, over that of its "
        "products with operator and preconditioner (transforms, symbol, zero padding), each timed alone in the "
        f"same process, both the least, of {OVERHEADS} solves up to 1024². The whole solve has the surface, the "
        "kernels, coarser grids and what is lost besides. Aims for it: 1.5 at rest, 1.8 in sliding at 512².",
        overhead,
    ),
    "Steady sliding": (
        "Kelvin sphere at the load of Hertz for the contact radius a, in the window that the solver finds, which "
        "is included; no peer solves this. R = 10 mm, a = 1 mm; rough: H = 0.2, h₀ = 50 µm, waves from 10 mm to "
        "0.5 mm. Disagreement: of the estimates of friction, over the force.",
        steady_sliding,
    ),
    "Sliding, drawn at random": (
        f"{DRAWN} spheres: v τ from 3·10⁻⁴ to 10³ a; Kelvin, standard linear (glassy over rubbery modulus 2 to "
        "10⁴), Prony of three modes, fractional; 30 % smooth, else H from 0 to 1, rms height 0.01 to 0.5 of the "
        "depth, a over shortest wave 1 to 8, half of them with a roll-off; a load in 70 %, a depth in 30 %. Aims: "
        "at most 80 pairs in the median, 200 in the worst, no growth beyond 512².",
        sliding_drawn,
    ),
    "Paths": (
        "A point of `study collapse` at the size standard: rough bodies at 12 speeds under one load, on half the "
        "points and on all, each solve alone or along a path (see [sweeps](../howto/sweeps.md)). Pairs are those "
        "of the fine grid. Aim: a third of a solve alone.",
        paths,
    ),
}

HEAD = """# Benchmark

Measured by `python docs/measure/benchmark.py`, which writes this page. {machine}

![Processor time of this solver and of its peers](benchmark.png)

Processor time of this solver and of its peers until each has the same error: on finer and finer rough cells (a),
and at other loads (b). Drawn by `python docs/measure/pictures.py` from the tables below.

Every run is alone in a process of one thread. Processor time is that of the solve: ours from the scene to the
result, with the surface drawn and all coarser grids; of the peers, of the solve alone, once set up. Up to
{repeated}² the least of {repeats} runs counts. Every code gets the first tolerance of {tolerances} with
which its error is at most {wanted:g}; a peer is given up after {most} iterations.

- iterations: of a peer, its own count; of ours, operator applications, in equivalents of the finest grid
- transform pairs: products in Fourier space, of ours with operator and preconditioner; tamaas does not count them
- error: sum|p gap| / (sum(p) standard deviation of the heights), the peers' measure of complementarity
- in pairs: processor time over that of one rfft2 and irfft2 of the same size by pyfftw (planned with MEASURE),
  measured in the same process
- of ours: processor time over ours"""


def machine() -> str:
    """What it ran on, without names of places."""
    cpu = next(
        (
            line.split(":")[1].strip()
            for line in Path("/proc/cpuinfo").read_text().splitlines()
            if line.startswith("model name")
        ),
        platform.machine(),
    )
    versions = []
    for name in ("numpy", "scipy", "numba", "ducc0", "pyfftw", "tamaas", "ContactMechanics"):
        try:
            versions.append(f"{name} {importlib.metadata.version(name)}")
        except importlib.metadata.PackageNotFoundError:
            versions.append(f"no {name}")
    load = os.getloadavg()[0]
    return (
        f"{date.today()}, {cpu}, {os.cpu_count()} cores (load at the start {load:.1f}), Python "
        f"{platform.python_version()}, {', '.join(versions)}."
    )


def main() -> None:
    """Measure everything and write the page."""
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--largest", type=int, default=2048, help="points a side, 128 to 4096")
    arguments.add_argument("--quick", action="store_true", help="128 points a side, to see that it runs")
    arguments.add_argument("--only", nargs="*", help="words in the titles of the sections wanted")
    arguments.add_argument("--output", type=Path, default=Path(__file__).parents[1] / "results" / "benchmark.md")
    given = arguments.parse_args()
    parts = [
        HEAD.format(
            machine=machine(),
            repeated=REPEATED,
            repeats=REPEATS,
            tolerances=", ".join(f"{one:g}" for one in TOLERANCES),
            wanted=WANTED,
            most=MOST,
        )
    ]
    for title, (text, measure) in SECTIONS.items():
        if given.only and not any(word.lower() in title.lower() for word in given.only):
            continue
        parts.append(f"## {title}\n\n{text}\n\n{measure(128 if given.quick else given.largest)}")
        print(parts[-1], "\n", flush=True)
    given.output.write_text("\n\n".join(parts) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
