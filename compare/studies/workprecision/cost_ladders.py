"""Ladders along one cost at a time, in both dimensionalities: points, modes, steps, speed and contact.

There is no truth here and no error: the tolerance stays, and time, memory and operator applications are counted.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from bem3d import BEM
from mdr1d import MDR
from scene import Elastic, Indent, Kelvin, Plane, Program, Prony, Scene, SelfAffine, Slide, Sphere, Stage

from .convergence import Ladder
from .scenes import FULL, QUICK
from .timed_solve import TimedSolve

# Relaxed shear modulus [Pa], retardation time [s], radius [m], and that of the smooth contact at rest [m].
MODULUS, MEMORY, RADIUS, REACH = 1e6, 1e-3, 10e-3, 1e-3
SPHERE, KELVIN, LOAD = Sphere(RADIUS), Kelvin(MODULUS, MEMORY), 16 / 3 * MODULUS * REACH**3 / RADIUS
# Of the sphere: the same at any number of points, with four of them a wave on the coarsest grid.
ROUGH = SelfAffine(hurst=0.2, rms_height=5e-5, longest=10e-3, shortest=0.5e-3, seed=1)
# Of the plane: its shortest wave is so many pixels, so that finer grids carry more waves.
SLOPE, PIXELS_A_WAVE = 0.1, 8
PRESSURE = 0.035  # of the plane on all grids, over E* and its rms slope
# Stiffening of the Prony series over all its modes, and decades that their times span.
STIFFENING, DECADES, MODES = 9.0, 6, (1, 2, 4, 8, 16, 30)
GRIDS = {
    "quick": (128, 192, 256, 384, 512),
    "standard": (64, 128, 192, 256, 384, 512),
    "full": (64, 128, 256, 384, 512, 768, 1024, 1536, 2048),
}
LARGEST_ROUGH, LARGEST_SLIDING = 1024, 1536  # points a side that are solved within a minute
LINES = {
    "quick": (1000, 5000, 20000, 10**5),
    "standard": (1000, 5000, 20000, 10**5),
    "full": (1000, 5000, 20000, 10**5, 2 * 10**5, 5 * 10**5, 10**6),
}


@dataclass(frozen=True)
class Axis:
    """What costs are asked against. label : in figures; measure : of the answer, if it is not the value set"""

    label: str
    measure: str = ""


AXES: Mapping[str, Axis] = {
    "points": Axis("points along a line"),
    "modes": Axis("modes of relaxation"),
    "steps": Axis("steps in time", "time_steps"),
    "speed": Axis("v τ / a"),
    "contact": Axis("real contact over the cell", "contact_fraction"),
}


def ladders(size: str) -> dict[str, Ladder]:
    """Everything that is measured, by name."""
    return _points_3d(size) | _points_1d(size) | _modes(size) | _steps(size) | _speeds(size) | _contact(size)


def plane(points: int, pressure: float) -> Scene:
    """A rough cell under a mean pressure over E* and its rms slope; its waves end at PIXELS_A_WAVE."""
    shortest = PIXELS_A_WAVE / points
    unit = SelfAffine(hurst=0.8, rms_height=1.0, longest=1.0, rolloff=0.25, shortest=shortest, seed=1)
    rough = replace(unit, rms_height=SLOPE / unit.rms_slope(unit.q_max(1 / points)))
    return Scene(Plane(), Elastic(0.25), Indent(pressure=pressure * SLOPE), rough)  # E* = 4 G = 1


def _points_3d(size):
    grids = GRIDS[size]
    rough, moving = (tuple(n for n in grids if n <= most) for most in (LARGEST_ROUGH, LARGEST_SLIDING))
    at_rest, sliding = (
        Scene(SPHERE, KELVIN, motion) for motion in (Indent(load=LOAD), Slide(speed=REACH / MEMORY, load=LOAD))
    )
    found = {"plane": _with_products("rough plane, at rest", grids, [plane(n, PRESSURE) for n in grids])}
    if size != QUICK:
        found["rest"] = _same("smooth sphere, at rest", grids, at_rest)
        found["rest-rough"] = _same("rough sphere, at rest", rough, replace(at_rest, roughness=ROUGH))
    found["slide"] = _same("smooth sphere, sliding", moving, sliding)
    if size != QUICK:
        found["slide-rough"] = _same("rough sphere, sliding", rough, replace(sliding, roughness=ROUGH))
    return found


def _same(label, grids, scene):
    return _with_products(label, grids, [scene] * len(grids))


def _with_products(label, grids: Sequence[int], scenes: Sequence[Scene]):
    each = zip(grids, scenes, strict=True)
    solves = tuple(TimedSolve.of(BEM(points=n), scene, products=True) for n, scene in each)
    return Ladder(label, "points", tuple(map(float, grids)), solves)


def _points_1d(size):
    solvers = [MDR(points=n) for n in LINES[size]]
    scene = Scene(SPHERE, KELVIN, Slide(speed=REACH / MEMORY, load=LOAD))
    bodies = {"mdr-rough": ("rough sphere, sliding", replace(scene, roughness=ROUGH))}
    if size != QUICK:
        bodies["mdr"] = "smooth sphere, sliding", scene
    return {
        name: Ladder.through(label, body, solvers, "points", LINES[size]) for name, (label, body) in bodies.items()
    }


def _modes(size):
    """Steady solves and marches of solids with more and more modes over the same decades."""
    if size == QUICK:
        return {}
    sliding, pressing = Slide(speed=REACH / MEMORY, load=LOAD), pressed(MEMORY)
    return {
        "modes-march": _series("3D, marched", BEM(points=256, steps=20), pressing),
        "modes-slide": _series("3D, steady sliding", BEM(points=128), sliding),
        "modes-mdr-slide": _series("1D, steady sliding", MDR(points=10**5), sliding),
        "modes-mdr-march": _series("1D, marched", MDR(points=1000, steps=100), pressing),
    }


def _series(label, solver, motion):
    solves = tuple(TimedSolve.of(solver, Scene(SPHERE, prony(count), motion)) for count in MODES)
    return Ladder(label, "modes", tuple(map(float, MODES)), solves)


def prony(count: int) -> Prony:
    """A solid of so many modes, spread evenly over DECADES around MEMORY, with STIFFENING in all."""
    reach = DECADES / 2 * (1 - 1 / count)
    times = MEMORY * np.logspace(-reach, reach, count)
    return Prony(MODULUS, (STIFFENING * MODULUS / count,) * count, tuple(map(float, times)))


def pressed(duration: float) -> Program:
    """A load that grows to LOAD in a time [s]."""
    return Program(stages=(Stage(duration=duration, load=LOAD),))


def _steps(size):
    counts = (25, 100, 400) if size == QUICK else (25, 50, 100, 200, 400, 800)
    scene = Scene(SPHERE, prony(1), pressed(MEMORY))
    found = {"steps-march": Ladder.of("3D, marched", scene, BEM(points=64), "steps", counts)}
    if size != QUICK:
        found["steps-mdr"] = Ladder.of("1D, marched", scene, MDR(points=1000), "steps", counts)
    return found


def _speeds(size):
    quick = size == QUICK
    ratios = tuple(10.0**k for k in ((-3, 0, 3) if quick else range(-4, 5)))
    found = {"speed": _moved("3D, smooth", ratios, BEM(points=128 if quick else 256), None)}
    if not quick:
        found["speed-rough"] = _moved("3D, rough", ratios, BEM(points=256), ROUGH)
        found["speed-mdr"] = _moved("1D, rough", ratios[::2], MDR(points=10**4), ROUGH)
    return found


def _moved(label, ratios, solver, rough):
    scenes = [Scene(SPHERE, KELVIN, Slide(speed=r * REACH / MEMORY, load=LOAD), rough) for r in ratios]
    return Ladder(label, "speed", ratios, tuple(TimedSolve.of(solver, scene) for scene in scenes))


def _contact(size):
    pressures = (5e-3, 0.282, 1.23)
    if size != QUICK:
        pressures = (5e-4, 5e-3, PRESSURE, 0.12, 0.282, 0.5, 0.749, 1.23, 1.61)
    grid = 512 if size == FULL else 256
    # The one that the ladder of points has too is the same task.
    solves = tuple(
        TimedSolve.of(BEM(points=grid), plane(grid, each), products=each == PRESSURE) for each in pressures
    )
    return {"contact": Ladder("rough plane, at rest", "contact", pressures, solves)}
