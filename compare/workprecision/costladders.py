"""What a solve costs against what it is asked for: ladders along one cost at a time, in both dimensionalities.

There is no truth here and no error: the tolerance stays, and time, memory and operator applications are counted.
"""

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from bem3d import BEM
from bem3d.engine import Engine
from mdr1d import MDR
from scene import (
    Elastic,
    Indent,
    Kelvin,
    Plane,
    Program,
    Prony,
    Scene,
    SelfAffine,
    Slide,
    Sphere,
    Stage,
)

from ..outcome import Outcome
from .contest import Ladder
from .rung import Rung

# Relaxed shear modulus [Pa], retardation time [s], radius [m], and that of the smooth contact at rest [m].
MODULUS, MEMORY, RADIUS, REACH = 1e6, 1e-3, 10e-3, 1e-3
SPHERE, KELVIN, LOAD = Sphere(RADIUS), Kelvin(MODULUS, MEMORY), 16 / 3 * MODULUS * REACH**3 / RADIUS
# Of the sphere: the same at any number of points, with four of them a wave on the coarsest grid.
ROUGH = SelfAffine(hurst=0.2, rms_height=5e-5, longest=10e-3, shortest=0.5e-3, seed=1)
# Of the plane: its shortest wave is so many pixels, so that finer grids carry more waves.
SLOPE, PIXELS_A_WAVE = 0.1, 8
# Stiffening of the Prony series over all its modes, and decades that their times span.
STIFFENING, DECADES, MODES = 9.0, 6, (1, 2, 4, 8, 16, 30)
PRODUCT_SECONDS, PRODUCT_REPEATS = 0.25, 3
LARGEST_SLIDING = 1536  # points a side that slide within a minute


@dataclass(frozen=True)
class Axis:
    """What costs are asked against. label : in figures; measure : of the answer, if it is not the value set."""

    label: str
    measure: str | None = None


AXES: Mapping[str, Axis] = {
    "points": Axis("points along a line"),
    "modes": Axis("modes of relaxation"),
    "steps": Axis("steps in time", "time_steps"),
    "speed": Axis("v τ / a"),
    "contact": Axis("real contact over the cell", "contact_fraction"),
}


@dataclass(frozen=True)
class Paired(Rung):
    """A rung that also measures, in its own process, what its solve cannot do without: products by transforms.

    Row.measures has besides plain_product and padded_product [s]: the least processor time of one product in
    Fourier space, transforms there and back, on the grid of the solve, as its preconditioner takes, and with the
    zeros that its operator needs on a free surface.
    """

    solver: BEM

    @property
    def packages(self) -> tuple[str, ...]:
        """As of Rung, and this module."""
        return *super().packages, __name__

    def solve(self) -> Outcome:
        """As of Rung, with the products; a failed solve has none."""
        outcome = super().solve()
        (found,) = outcome.rows
        if found.reason is not None:
            return outcome
        engine, points = self.solver.engine, self.solver.points
        plain = padded = product(engine, points, points)
        if not isinstance(self.scene.indenter, Plane):
            padded = product(engine, points, engine.good_size(2 * points - 1))
        measures = {**found.measures, "plain_product": plain, "padded_product": padded}
        return Outcome((replace(found, measures=measures),), outcome.fields)


def product(engine: Engine, points: int, padded: int) -> float:
    """Least processor seconds of one product of points x points with a symbol, padded to so many a side."""
    symbol = np.ones((padded // 2 + 1, padded // 2 + 1))
    multiply = engine.product(symbol, (points, points), (padded, padded))
    plane, out = np.ones((points, points)), np.empty((points, points))
    spent: list[float] = []
    while len(spent) < PRODUCT_REPEATS or sum(spent) < PRODUCT_SECONDS:
        started = time.process_time()
        multiply(plane, out=out)
        spent.append(time.process_time() - started)
    return min(spent)


def ladders(size: str) -> dict[str, Ladder]:
    """All that is measured, by name, at a size, "quick" or "full"."""
    full = size == "full"
    found = {**_points_3d(full), **_points_1d(full), **_modes(full), **_steps(full), **_speeds(full)}
    return found | {"contact": _contact(full)}


def plane(points: int, pressure: float) -> Scene:
    """A rough cell under a mean pressure over E* and its rms slope; its waves end at PIXELS_A_WAVE."""
    shortest = PIXELS_A_WAVE / points
    unit = SelfAffine(hurst=0.8, rms_height=1.0, longest=1.0, rolloff=0.25, shortest=shortest, seed=1)
    rough = replace(unit, rms_height=SLOPE / unit.rms_slope(unit.q_max(1 / points)))
    return Scene(Plane(), Elastic(0.25), Indent(pressure=pressure * SLOPE), rough)  # E* = 4 G = 1


def _points_3d(full):
    grids = (64, 128, 256, 384, 512, 768, 1024, 1536, 2048) if full else (128, 192, 256, 384, 512)
    rough, moving = (tuple(n for n in grids if n <= most) for most in (1024, LARGEST_SLIDING))
    at_rest, sliding = (
        Scene(SPHERE, KELVIN, motion) for motion in (Indent(load=LOAD), Slide(speed=REACH / MEMORY, load=LOAD))
    )
    found = {"plane": _paired("rough plane, at rest", grids, [plane(n, 0.035) for n in grids])}
    if full:
        found["rest"] = _same("smooth sphere, at rest", grids, at_rest)
        found["rest-rough"] = _same("rough sphere, at rest", rough, replace(at_rest, roughness=ROUGH))
    found["slide"] = _same("smooth sphere, sliding", moving, sliding)
    if full:
        found["slide-rough"] = _same("rough sphere, sliding", rough, replace(sliding, roughness=ROUGH))
    return found


def _same(label, grids, scene):
    return _paired(label, grids, [scene] * len(grids))


def _paired(label, grids: Sequence[int], scenes: Sequence[Scene]):
    rungs = tuple(Paired(BEM(points=n), scene, work=50 * n**2.2) for n, scene in zip(grids, scenes, strict=True))
    return Ladder(label, "points", tuple(map(float, grids)), rungs)


def _points_1d(full):
    most = (2 * 10**5, 5 * 10**5, 10**6) if full else ()
    points = (1000, 5000, 20000, 10**5, *most)
    solvers = [MDR(points=n) for n in points]
    scene = Scene(SPHERE, KELVIN, Slide(speed=REACH / MEMORY, load=LOAD))
    found = {
        "mdr-rough": Ladder.through(
            "rough sphere, sliding", replace(scene, roughness=ROUGH), solvers, "points", points
        )
    }
    if full:
        found["mdr"] = Ladder.through("smooth sphere, sliding", scene, solvers, "points", points)
    return found


def _modes(full):
    """Steady solves and marches of solids with more and more modes over the same decades."""
    if not full:
        return {}
    sliding, pressing = Slide(speed=REACH / MEMORY, load=LOAD), pressed(MEMORY)
    return {
        "modes-march": _series("3D, marched", BEM(points=256, steps=20), pressing),
        "modes-slide": _series("3D, steady sliding", BEM(points=128), sliding),
        "modes-mdr-slide": _series("1D, steady sliding", MDR(points=10**5), sliding),
        "modes-mdr-march": _series("1D, marched", MDR(points=1000, steps=100), pressing),
    }


def _series(label, solver, motion):
    rungs = tuple(Rung(solver, Scene(SPHERE, prony(count), motion)) for count in MODES)
    return Ladder(label, "modes", tuple(map(float, MODES)), rungs)


def prony(count: int) -> Prony:
    """So many modes, spread evenly over DECADES around MEMORY, with STIFFENING in all."""
    reach = DECADES / 2 * (1 - 1 / count)
    times = MEMORY * np.logspace(-reach, reach, count)
    return Prony(MODULUS, (STIFFENING * MODULUS / count,) * count, tuple(map(float, times)))


def pressed(duration: float) -> Program:
    """A load that grows to LOAD in a time [s]."""
    return Program(stages=(Stage(duration=duration, load=LOAD),))


def _steps(full):
    counts = (25, 50, 100, 200, 400, 800) if full else (25, 100, 400)
    scene = Scene(SPHERE, prony(1), pressed(MEMORY))
    found = {"steps-march": Ladder.of("3D, marched", scene, BEM(points=64), "steps", counts)}
    if full:
        found["steps-mdr"] = Ladder.of("1D, marched", scene, MDR(points=1000), "steps", counts)
    return found


def _speeds(full):
    ratios = tuple(10.0**k for k in (range(-4, 5) if full else (-3, 0, 3)))
    found = {"speed": _moved("3D, smooth", ratios, BEM(points=256 if full else 128), None)}
    if full:
        found["speed-rough"] = _moved("3D, rough", ratios, BEM(points=256), ROUGH)
        found["speed-mdr"] = _moved("1D, rough", ratios[::2], MDR(points=10**4), ROUGH)
    return found


def _moved(label, ratios, solver, rough):
    scenes = [Scene(SPHERE, KELVIN, Slide(speed=r * REACH / MEMORY, load=LOAD), rough) for r in ratios]
    return Ladder(label, "speed", ratios, tuple(Rung(solver, scene) for scene in scenes))


def _contact(full):
    pressures = (5e-4, 5e-3, 0.035, 0.12, 0.282, 0.5, 0.749, 1.23, 1.61) if full else (5e-3, 0.282, 1.23)
    grid = 512 if full else 256
    rungs = tuple(Rung(BEM(points=grid), plane(grid, pressure)) for pressure in pressures)
    return Ladder("rough plane, at rest", "contact", pressures, rungs)
