"""Laws that need no closed form: scales, symmetries, balances, signs and limits."""

from collections.abc import Callable, Iterator
from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np

from scene import WLF, Indent, Scene, SelfAffine, Slide, Sphere, StandardLinearSolid

from ..stability.cases.ordinary import (
    DEPTH,
    ELASTIC,
    KELVIN,
    LOAD,
    MODULUS,
    PACE,
    RADIUS,
    SOLID,
    SPHERE,
    STIFFENING,
    TIME,
    moved,
    program,
    resting,
    sliding,
    stage,
)
from .forms import AMPLITUDE, WAVELENGTH, cell, wavy
from .law import EXACT, FRICTION, GRID, SAME, SPACE, Law, alike, exact, slug, stated, worst

KEPT, BOUNDED = "invariances", "limits"
POINTS = 32  # of a map
SAME_PIXELS = stated(1e-4, "a grid has its pixels at the same places of both surfaces; contact within 1e-5")
FORCES = ("normal_force", "friction_force")
# Factors on lengths, moduli and times.
SCALES = {"length": (1e3, 1.0, 1.0), "modulus": (1.0, 1e3, 1.0), "time": (1.0, 1.0, 1e3)}


def laws() -> Iterator[Law]:
    """All of them."""
    for each in (scales, symmetries, balances, signs, limits):
        yield from each()


def _family(kind: str, length: float, modulus: float, time: float) -> Scene:
    """A contact in units of length, modulus and time."""
    solid = StandardLinearSolid(MODULUS * modulus, STIFFENING * MODULUS * modulus, TIME * time)
    rough = SelfAffine(
        hurst=0.5,
        rms_height=DEPTH / 10 * length,
        longest=2 * RADIUS * length,
        shortest=RADIUS / 2 * length,
        seed=1,
    )
    slide = Slide(speed=PACE * length / time, depth=DEPTH * length)
    motion = Indent(depth=DEPTH * length) if "rest" in kind else slide
    return Scene(Sphere(SPHERE.radius * length), solid, motion, rough if "rough" in kind else None)


ROUGH_SLIDE = _family("rough", 1.0, 1.0, 1.0)


def scales() -> Iterator[Law]:
    """Forces go with the square of lengths and with moduli; times matter only beside one another."""
    for unit, factors in SCALES.items():
        for kind in ("at rest", "sliding", "rough"):
            pair = _family(kind, 1.0, 1.0, 1.0), _family(kind, *factors)
            form = alike(dict.fromkeys(FORCES, factors[0] ** 2 * factors[1]))
            said = f"Forces {kind}: the same in units a thousand times the {unit}"
            yield Law(f"scale.{unit}.{slug(kind)}", KEPT, said, pair, form, SAME)
    warm, form = WLF(temperature=310.0, reference=300.0, c1=8.86, c2=101.6), alike(dict.fromkeys(FORCES, 1.0))
    pair = sliding(warm.shift), replace(sliding(1.0), temperature=warm)
    said = "Forces of a warm solid are those of a cold one at the speed that is shifted"
    yield Law("scale.temperature", KEPT, said, pair, form, SAME)


def _map() -> np.ndarray:
    """Heights of a small periodic map, of waves of many directions that no symmetry relates."""
    along = 2 * np.pi * np.arange(POINTS) / POINTS
    y, x = np.meshgrid(along, along, indexing="ij")
    draw = np.random.default_rng(7)
    waves = ((i, j) for i in range(-3, 4) for j in range(4) if (i, j) != (0, 0))
    return AMPLITUDE / 6 * np.sum([np.cos(i * y + j * x + 6.3 * draw.random()) for i, j in waves], axis=0)


def symmetries() -> Iterator[Law]:
    """A mirrored, turned, shifted or raised surface has the same mean gap and the same friction."""
    heights = _map()
    pressure = MODULUS * AMPLITUDE / WAVELENGTH * 4
    same = {
        "mirror-along": (heights[:, ::-1], False, "mirrored along the motion, at rest"),
        "mirror-across": (heights[::-1], True, "mirrored across the motion, sliding"),
        "turn": (heights.T, False, "turned by 90 degrees, at rest"),
        "shift": (np.roll(heights, POINTS // 4, axis=(0, 1)), False, "shifted by a quarter, at rest"),
        "raise": (heights + 3 * AMPLITUDE, False, "raised, at rest"),
    }
    for name, (other, slides, words) in same.items():
        scenes = tuple(
            wavy(pressure, cell(each), SOLID, PACE * WAVELENGTH / RADIUS if slides else 0.0)
            for each in (heights, other)
        )
        numbers = {"depth": 1.0} | ({"friction_force": 1.0} if slides else {})
        said = f"A surface {words}: the same mean gap{' and friction' if slides else ''}"
        # Moved by a quarter, the pixels of some grids lie elsewhere on the surface.
        bound = GRID if name == "shift" else SAME_PIXELS
        yield Law(f"symmetry.{name}", KEPT, said, scenes, alike(numbers), bound, SPACE, drawn=True)
    to_and_fro = tuple(program(stage(TIME, depth=DEPTH), stage(TIME, speed=speed)) for speed in (PACE, -PACE))
    said = "Friction backwards is friction forwards with the other sign"
    form = alike({"normal_force": 1.0, "friction_force": -1.0})
    yield Law("symmetry.reversal", KEPT, said, to_and_fro, form, FRICTION)


def balances() -> Iterator[Law]:
    """Equal questions have equal answers, and the load that goes in comes out."""
    for name, scene in (("rest", _family("rough at rest", 1.0, 1.0, 1.0)), ("sliding", ROUGH_SLIDE)):
        said = f"Asked twice, a rough contact has the same answer: {name}"
        form = alike(dict.fromkeys((*FORCES, "depth"), 1.0))
        yield Law(f"same.{name}", KEPT, said, (scene, scene), form, EXACT, twice=True)

    def one(answers):
        return float(answers[0]["normal_force"] == answers[1]["normal_force"])

    rough: Any = _family("rough at rest", 1.0, 1.0, 1.0)
    pair = rough, replace(rough, roughness=replace(rough.roughness, seed=2))
    bound, said = stated(0.0, "two surfaces have the same force by no accident"), "Another seed is another surface"
    yield Law("seed", KEPT, said, pair, one, bound)
    bound = stated(1e-6, "a load is a sum over pixels, and met as well as any")
    loads = {
        "rest": (resting(motion=Indent(load=LOAD)), LOAD),
        "sliding": (moved(sliding(1.0), depth=None, load=LOAD), LOAD),
        "rough": (replace(ROUGH_SLIDE, motion=Slide(speed=PACE, load=LOAD)), LOAD),
    }
    for name, (scene, load) in loads.items():
        said = f"The load that goes in comes out, {name}"
        yield exact(f"load.{name}", KEPT, said, scene, bound, normal_force=load)
    pressure = MODULUS * AMPLITUDE / WAVELENGTH * 4
    scene, force = wavy(pressure, cell(_map())), pressure * WAVELENGTH**2
    said = "The pressure on a cell comes out as force"
    yield exact("load.plane", KEPT, said, scene, bound, SPACE, True, normal_force=force)


def _falls(name: str) -> Callable:
    """Greatest fall of a number from an answer to the next, over the last."""

    def misfit(answers):
        values = [answer[name] for answer in answers]
        return worst(max(before - after, 0.0) / abs(values[-1]) for before, after in pairwise(values))

    return misfit


def signs() -> Iterator[Law]:
    """What never falls and what is never below zero."""
    depths = [DEPTH * (1 + 0.05 * k) for k in range(5)]
    scenes = tuple(resting(motion=Indent(depth=depth)) for depth in depths)
    yield Law("rises.depth", KEPT, "Force rises with depth", scenes, _falls("normal_force"), SAME)
    scenes = tuple(replace(ROUGH_SLIDE, motion=Indent(depth=depth)) for depth in depths)
    yield Law("rises.rough", KEPT, "Force of a rough body rises with depth", scenes, _falls("normal_force"), SAME)
    scenes = tuple(resting(motion=Indent(load=load)) for load in (LOAD, 1.1 * LOAD, 1.2 * LOAD, 1.3 * LOAD))
    yield Law("rises.load", KEPT, "Depth rises with load", scenes, _falls("depth"), SAME)
    paces = [10.0**k for k in range(-4, 5, 2)]
    scenes = tuple(sliding(pace) for pace in paces)
    yield Law("rises.speed", KEPT, "Force at a depth rises with speed", scenes, _falls("normal_force"), GRID)
    scenes = tuple(moved(sliding(pace), depth=None, load=LOAD) for pace in paces)

    def drives(answers):
        return worst(max(-answer["friction_coefficient"], 0.0) for answer in answers)

    yield Law("friction.opposes", KEPT, "Friction never drives, at any speed", scenes, drives, EXACT)
    rough = tuple(replace(ROUGH_SLIDE, motion=Slide(speed=pace * PACE, load=LOAD)) for pace in paces)
    yield Law("friction.opposes.rough", KEPT, "Friction of a rough body never drives", rough, drives, EXACT)

    def driven(answers):
        return abs(answers[0]["friction_coefficient"])

    lossless = resting(motion=Slide(speed=PACE, load=LOAD))
    yield Law("friction.lossless", KEPT, "An elastic solid has no friction", (lossless,), driven, SAME)


def limits() -> Iterator[Law]:
    """Between rubber and glass; friction in proportion to slow speeds, and to the inverse of fast ones."""
    soft, hard = resting(), resting(elastomer=replace(ELASTIC, modulus=STIFFENING * MODULUS))
    scenes = (soft, *(sliding(pace) for pace in (1e-3, 0.1, 1.0, 10.0, 1e3)), hard)

    def outside(answers):
        low, *between, high = (answer["normal_force"] for answer in answers)
        return worst(max(low / force - 1, force / high - 1, 0.0) for force in between)

    said = "Force at a depth lies between that of rubber and that of glass"
    yield Law("limit.between", BOUNDED, said, scenes, outside, GRID)
    for name, body in (("sphere", None), ("rough", ROUGH_SLIDE.roughness)):
        pair = tuple(Scene(SPHERE, KELVIN, Slide(speed=pace * PACE, load=LOAD), body) for pace in (1e-5, 1e-4))
        said = f"Friction of a slow {name} body is in proportion to the speed"
        bound = FRICTION.and_(1e-2, "v tau over the shortest wave, ten times")
        form = alike({"friction_force": 10.0})
        yield Law(f"limit.slow.{name}", BOUNDED, said, pair, form, bound)
    fast = tuple(sliding(pace) for pace in (1e4, 1e5))
    said = "Friction of a fast body on a standard linear solid goes with the inverse of the speed"
    form = alike({"friction_force": 0.1})
    bound = FRICTION.and_(3e-3, "30 a/(v tau), what relaxes in passing")
    yield Law("limit.fast", BOUNDED, said, fast, form, bound)
    smooth = resting(motion=Indent(load=LOAD))
    faint = SelfAffine(hurst=0.5, rms_height=DEPTH / 1e4, longest=2 * RADIUS, shortest=RADIUS / 2, seed=1)
    said = "Faint roughness changes the depth by no more than its heights"
    form = alike({"depth": 1.0})
    bound = GRID.and_(4e-4, "four rms heights over the depth")
    yield Law("limit.smooth", BOUNDED, said, (smooth, replace(smooth, roughness=faint)), form, bound)
