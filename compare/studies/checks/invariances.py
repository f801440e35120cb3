"""Laws that need no closed form: scales, symmetries, balances, signs and limits."""

from dataclasses import replace
from itertools import product

import numpy as np
from scipy.ndimage import gaussian_filter

from scene import WLF, Indent, Slide

from .closed_forms import AMPLITUDE, CELL, WAVELENGTH, cell, wavy
from .law import (
    EXACT,
    FORCES,
    FRICTION,
    GRID,
    INVARIANCE,
    LIMIT,
    SAME,
    SPACE,
    Misfit,
    alike,
    laws,
    stated,
    worst,
)
from .ordinary import (
    KELVIN,
    LOAD,
    MODULUS,
    PACE,
    RADIUS,
    ROUGH,
    SOLID,
    family,
    loaded,
    resting,
    sliding,
)

POINTS = 32  # of a map
PRESSURE = MODULUS * AMPLITUDE / WAVELENGTH * 4  # on a map
SAME_PIXELS = stated(1e-4, "a grid has its pixels at the same places of both surfaces; contact within 1e-5")
MET = stated(1e-6, "a load is a sum over pixels, and met as well as any")
FORCE = {"length": 1e6, "modulus": 1e3, "time": 1.0}  # in units of each that are a thousand times as large
ROUGH_REST = resting(elastomer=SOLID, roughness=ROUGH)
UNCHANGED = alike(depth=1.0, normal_force=1.0, friction_force=1.0)


@laws(SAME, group=INVARIANCE)
def scales():
    """Forces are the same in units a thousand times as large, and warm at the speed that is shifted."""
    for unit, kind in product(FORCE, ("at-rest", "sliding")):
        form = alike(**dict.fromkeys(FORCES, FORCE[unit]))
        yield f"scale.{unit}.{kind}", (family(kind), family(kind, **{unit: 1e3})), form
    warm = WLF(temperature=310.0, reference=300.0, c1=8.86, c2=101.6)
    pair = sliding(warm.shift), sliding(1.0, temperature=warm)
    yield "scale.temperature", pair, alike(normal_force=1.0, friction_force=1.0)


def _map() -> np.ndarray:
    """Heights of a small periodic map, of waves of many directions that no symmetry relates."""
    smoothed = gaussian_filter(np.random.default_rng(7).standard_normal((POINTS, POINTS)), 3.0, mode="wrap")
    return AMPLITUDE * smoothed / smoothed.std()


@laws(SAME_PIXELS, SPACE, INVARIANCE)
def symmetries():
    """Surface mirrored, turned, shifted or raised: the same mean gap, across the motion the same friction.

    The pressure on its cell comes out as force.
    """
    heights, gap = _map(), alike(depth=1.0)
    for name, other in {
        "mirror-along": heights[:, ::-1],
        "turn": heights.T,
        "shift": np.roll(heights, POINTS // 4, axis=(0, 1)),
        "raise": heights + 3 * AMPLITUDE,
    }.items():
        # Moved by a quarter, the pixels of some grids lie elsewhere on the surface.
        bound = GRID if name == "shift" else SAME_PIXELS
        yield f"symmetry.{name}", [wavy(PRESSURE, cell(each), SOLID) for each in (heights, other)], gap, bound
    speed = PACE * WAVELENGTH / RADIUS
    moved = [wavy(PRESSURE, cell(each), SOLID, speed) for each in (heights, heights[::-1])]
    yield "load.plane", wavy(PRESSURE, cell(heights)), {"normal_force": PRESSURE * CELL}, MET
    yield "symmetry.mirror-across", moved, alike(depth=1.0, friction_force=1.0)


@laws(EXACT, group=INVARIANCE)
def repeats():
    """Asked twice, a rough contact has the same answer; another seed is another surface."""
    yield "same.rest", (ROUGH_REST, ROUGH_REST), UNCHANGED
    yield "same.sliding", (sliding(1.0, roughness=ROUGH),) * 2, UNCHANGED
    other = replace(ROUGH_REST, roughness=replace(ROUGH, seed=2))
    yield "seed", (ROUGH_REST, other), lambda answers: float(UNCHANGED(answers) == 0.0)


def falls(name: str) -> Misfit:
    """Greatest fall of a number from an answer to the next, over the smallest."""

    def misfit(answers):
        values = np.array([answer[name] for answer in answers])
        return worst(-np.diff(values) / np.abs(values).min())

    return misfit


@laws(MET, group=INVARIANCE)
def loads():
    """The load that goes in comes out, and depth rises with load."""
    yield "load.rest", resting(motion=Indent(load=LOAD)), {"normal_force": LOAD}
    yield "load.sliding", loaded(1.0), {"normal_force": LOAD}
    yield "load.rough", loaded(1.0, roughness=ROUGH), {"normal_force": LOAD}
    heavier = [resting(motion=Indent(load=part * LOAD)) for part in (1.0, 1.1, 1.2, 1.3)]
    yield "rises.load", heavier, falls("depth"), SAME


@laws(EXACT, group=INVARIANCE)
def opposes():
    """Friction never drives, at any speed, and an elastic solid has none."""

    def drives(answers):
        return worst(max(-answer["friction_coefficient"], 0.0) for answer in answers)

    for name, rough in (("friction.opposes", None), ("friction.opposes.rough", ROUGH)):
        yield name, [loaded(10.0**k, roughness=rough) for k in (-9, -7, -5, *range(-4, 5, 2), 5, 7, 9)], drives
    yield "friction.lossless", resting(motion=Slide(speed=PACE, load=LOAD)), {"friction_coefficient": 0.0}, SAME


@laws(FRICTION.wider("0.01, v tau over the shortest wave, ten times", more=1e-2), group=LIMIT)
def slow_and_rough():
    """Friction of a rough body is in proportion to slow speeds."""
    pair = [loaded(pace, KELVIN, roughness=ROUGH) for pace in (1e-5, 1e-4)]
    yield "limit.slow.rough", pair, alike(friction_force=10.0)
