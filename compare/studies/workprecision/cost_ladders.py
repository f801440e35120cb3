"""Ladders along one cost at a time, in both dimensionalities: points, modes, steps, speed and contact.

There is no truth here and no error: the tolerance stays, and time, memory and operator applications are counted.
"""

from collections.abc import Mapping
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
# Roughness of the sphere: the same at any number of points, with four a wave on the coarsest grid.
ROUGH = SelfAffine(hurst=0.2, rms_height=5e-5, longest=10e-3, shortest=0.5e-3, seed=1)
# Rms slope of the plane, and pixels to its shortest wave, so that finer grids carry more waves.
SLOPE, PIXELS_A_WAVE = 0.1, 8
PRESSURE = 0.035  # of the plane on all grids, over E* and its rms slope
# Stiffening of the Prony series over all its modes, and decades that their times span.
STIFFENING, DECADES, MODES = 9.0, 6, (1, 2, 4, 8, 16, 30)
GRIDS = {
    "quick": (128, 192, 256, 384, 512),
    "standard": (64, 128, 192, 256, 384, 512),
    "full": (64, 128, 256, 384, 512, 768, 1024, 1536, 2048),
}
# Ladders of the size "quick".
QUICKLY = ("plane", "slide", "mdr-rough", "steps-march", "speed", "contact")
LARGEST_ROUGH, LARGEST_SLIDING = 1024, 1536  # points a side that are solved within a minute
LINES = {
    "quick": (1000, 5000, 20000, 10**5),
    "standard": (1000, 5000, 20000, 10**5),
    "full": (1000, 5000, 20000, 10**5, 2 * 10**5, 5 * 10**5, 10**6),
}


@dataclass(frozen=True)
class Axis:
    """Axis of costs. label : in figures; measure : of the answer, if it is not the value set"""

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
    quick, grids, lines = size == QUICK, GRIDS[size], LINES[size]
    coarse, moving = (tuple(n for n in grids if n <= most) for most in (LARGEST_ROUGH, LARGEST_SLIDING))
    rest, slide = Scene(SPHERE, KELVIN, Indent(load=LOAD)), slid(1.0)
    rough_rest, rough_slide = replace(rest, roughness=ROUGH), slid(1.0, ROUGH)
    steps = (25, 100, 400) if quick else (25, 50, 100, 200, 400, 800)
    ratios = tuple(10.0**k for k in ((-3, 0, 3) if quick else range(-4, 5)))
    pressures = (5e-3, 0.282, 1.23) if quick else (5e-4, 5e-3, PRESSURE, 0.12, 0.282, 0.5, 0.749, 1.23, 1.61)
    grid = 512 if size == FULL else 256
    moved, plain = BEM(points=128 if quick else 256), BEM(points=grid)
    march = _modes(pressed(MEMORY))
    found = {
        "plane": _by_grid("rough plane, at rest", grids, lambda n: plane(n, PRESSURE)),
        "rest": _by_grid("smooth sphere, at rest", grids, lambda n: rest),
        "rest-rough": _by_grid("rough sphere, at rest", coarse, lambda n: rough_rest),
        "slide": _by_grid("smooth sphere, sliding", moving, lambda n: slide),
        "slide-rough": _by_grid("rough sphere, sliding", coarse, lambda n: rough_slide),
        "mdr-rough": Ladder.of("rough sphere, sliding", rough_slide, MDR(), "points", lines),
        "mdr": Ladder.of("smooth sphere, sliding", slide, MDR(), "points", lines),
        # Steady solves and marches of solids with more and more modes over the same decades.
        "modes-march": _by_scene("3D, marched", "modes", MODES, BEM(points=256, steps=20), march),
        "modes-slide": _by_scene("3D, steady sliding", "modes", MODES, BEM(points=128), _modes(slide.motion)),
        "modes-mdr-slide": _by_scene(
            "1D, steady sliding", "modes", MODES, MDR(points=10**5), _modes(slide.motion)
        ),
        "modes-mdr-march": _by_scene("1D, marched", "modes", MODES, MDR(points=1000, steps=100), march),
        "steps-march": Ladder.of("3D, marched", march(1), BEM(points=64), "steps", steps),
        "steps-mdr": Ladder.of("1D, marched", march(1), MDR(points=1000), "steps", steps),
        "speed": _by_scene("3D, smooth", "speed", ratios, moved, slid),
        "speed-rough": _by_scene("3D, rough", "speed", ratios, moved, lambda r: slid(r, ROUGH)),
        "speed-mdr": _by_scene("1D, rough", "speed", ratios[::2], MDR(points=10**4), lambda r: slid(r, ROUGH)),
        # The one that the ladder of points has too is the same task.
        "contact": Ladder.over(
            "rough plane, at rest",
            "contact",
            pressures,
            lambda each: TimedSolve.of(plain, plane(grid, each), products=each == PRESSURE),
        ),
    }
    return {name: each for name, each in found.items() if not quick or name in QUICKLY}


def slid(ratio: float, roughness: SelfAffine | None = None) -> Scene:
    """The sphere under LOAD, sliding at a ratio v tau / a."""
    return Scene(SPHERE, KELVIN, Slide(speed=ratio * REACH / MEMORY, load=LOAD), roughness)


def plane(points: int, pressure: float) -> Scene:
    """A rough cell under a mean pressure over E* and its rms slope; its waves end at PIXELS_A_WAVE."""
    shortest = PIXELS_A_WAVE / points
    unit = SelfAffine(hurst=0.8, rms_height=1.0, longest=1.0, rolloff=0.25, shortest=shortest, seed=1)
    rough = replace(unit, rms_height=SLOPE / unit.rms_slope(unit.q_max(1 / points)))
    return Scene(Plane(), Elastic(0.25), Indent(pressure=pressure * SLOPE), rough)  # E* = 4 G = 1


def prony(count: int) -> Prony:
    """A solid of so many modes, spread evenly over DECADES around MEMORY, with STIFFENING in all."""
    reach = DECADES / 2 * (1 - 1 / count)
    times = MEMORY * np.logspace(-reach, reach, count)
    return Prony(MODULUS, (STIFFENING * MODULUS / count,) * count, tuple(map(float, times)))


def pressed(duration: float) -> Program:
    """A load that grows to LOAD in a time [s]."""
    return Program(stages=(Stage(duration=duration, load=LOAD),))


def _by_grid(label, grids, scene):
    return Ladder.over(label, "points", grids, lambda n: TimedSolve.of(BEM(points=n), scene(n), products=True))


def _by_scene(label, setting, values, solver, scene):
    return Ladder.over(label, setting, values, lambda value: TimedSolve.of(solver, scene(value)))


def _modes(motion):
    return lambda count: Scene(SPHERE, prony(count), motion)
