"""Laws that need no closed form: scales, symmetries, balances, signs and limits."""

from collections.abc import Callable, Iterator
from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np

from scene import WLF, Indent, Scene, SelfAffine, Slide

from .closed_forms import AMPLITUDE, WAVELENGTH, cell, wavy
from .law import (
    EXACT,
    FORCES,
    FRICTION,
    GRID,
    INVARIANCE,
    LIMIT,
    SAME,
    SPACE,
    Law,
    alike,
    exact,
    slug,
    stated,
    worst,
)
from .ordinary import (
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
    family,
    moved,
    program,
    resting,
    sliding,
    stage,
)

POINTS = 32  # of a map
PRESSURE = MODULUS * AMPLITUDE / WAVELENGTH * 4  # on a map
SAME_PIXELS = stated(1e-4, "a grid has its pixels at the same places of both surfaces; contact within 1e-5")
# Factors on lengths, moduli and times.
SCALES = {"length": (1e3, 1.0, 1.0), "modulus": (1.0, 1e3, 1.0), "time": (1.0, 1.0, 1e3)}


def laws() -> Iterator[Law]:
    """All of them."""
    for each in (scales, symmetries, balances, signs, limits):
        yield from each()


ROUGH_SLIDE, ROUGH_REST = family("rough"), family("rough at rest")


def scales() -> Iterator[Law]:
    """Forces go with the square of lengths and with moduli; times matter only beside one another."""
    for unit, factors in SCALES.items():
        for kind in ("at rest", "sliding", "rough"):
            pair = family(kind), family(kind, *factors)
            form = alike(dict.fromkeys(FORCES, factors[0] ** 2 * factors[1]))
            said = f"Forces {kind}: the same in units a thousand times the {unit}"
            yield Law(f"scale.{unit}.{slug(kind)}", INVARIANCE, said, pair, form, SAME)
    warm, form = WLF(temperature=310.0, reference=300.0, c1=8.86, c2=101.6), alike(dict.fromkeys(FORCES, 1.0))
    pair = sliding(warm.shift), replace(sliding(1.0), temperature=warm)
    said = "Forces of a warm solid are those of a cold one at the speed that is shifted"
    yield Law("scale.temperature", INVARIANCE, said, pair, form, SAME)


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
    same = {
        "mirror-along": (heights[:, ::-1], False, "mirrored along the motion, at rest"),
        "mirror-across": (heights[::-1], True, "mirrored across the motion, sliding"),
        "turn": (heights.T, False, "turned by 90 degrees, at rest"),
        "shift": (np.roll(heights, POINTS // 4, axis=(0, 1)), False, "shifted by a quarter, at rest"),
        "raise": (heights + 3 * AMPLITUDE, False, "raised, at rest"),
    }
    for name, (other, slides, words) in same.items():
        speed = PACE * WAVELENGTH / RADIUS if slides else 0.0
        scenes = tuple(wavy(PRESSURE, cell(each), SOLID, speed) for each in (heights, other))
        form = alike({"depth": 1.0} | ({"friction_force": 1.0} if slides else {}))
        said = f"A surface {words}: the same mean gap{' and friction' if slides else ''}"
        # Moved by a quarter, the pixels of some grids lie elsewhere on the surface.
        bound = GRID if name == "shift" else SAME_PIXELS
        yield Law(f"symmetry.{name}", INVARIANCE, said, scenes, form, bound, SPACE, drawn=True)
    to_and_fro = tuple(program(stage(TIME, depth=DEPTH), stage(TIME, speed=speed)) for speed in (PACE, -PACE))
    said = "Friction backwards is friction forwards with the other sign"
    form = alike({"normal_force": 1.0, "friction_force": -1.0})
    yield Law("symmetry.reversal", INVARIANCE, said, to_and_fro, form, FRICTION)


def balances() -> Iterator[Law]:
    """Equal questions have equal answers, and the load that goes in comes out."""
    for name, scene in (("rest", ROUGH_REST), ("sliding", ROUGH_SLIDE)):
        said = f"Asked twice, a rough contact has the same answer: {name}"
        form = alike(dict.fromkeys((*FORCES, "depth"), 1.0))
        yield Law(f"same.{name}", INVARIANCE, said, (scene, scene), form, EXACT)

    def one(answers):
        return float(answers[0]["normal_force"] == answers[1]["normal_force"])

    rough: Any = ROUGH_REST.roughness
    other = replace(ROUGH_REST, roughness=replace(rough, seed=2))
    bound, said = stated(0.0, "two surfaces have the same force by no accident"), "Another seed is another surface"
    yield Law("seed", INVARIANCE, said, (ROUGH_REST, other), one, bound)
    bound = stated(1e-6, "a load is a sum over pixels, and met as well as any")
    loads = {
        "rest": resting(motion=Indent(load=LOAD)),
        "sliding": moved(sliding(1.0), depth=None, load=LOAD),
        "rough": replace(ROUGH_SLIDE, motion=Slide(speed=PACE, load=LOAD)),
    }
    for name, scene in loads.items():
        said = f"The load that goes in comes out, {name}"
        yield exact(f"load.{name}", said, scene, bound, group=INVARIANCE, normal_force=LOAD)
    said, force = "The pressure on a cell comes out as force", PRESSURE * WAVELENGTH**2
    scene = wavy(PRESSURE, cell(_map()))
    yield exact("load.plane", said, scene, bound, SPACE, INVARIANCE, normal_force=force)


def _falls(name: str) -> Callable:
    """Greatest fall of a number from an answer to the next, over the last."""

    def misfit(answers):
        values = [answer[name] for answer in answers]
        return worst(max(before - after, 0.0) / abs(values[-1]) for before, after in pairwise(values))

    return misfit


def _drives(answers):
    return worst(max(-answer["friction_coefficient"], 0.0) for answer in answers)


def signs() -> Iterator[Law]:
    """What never falls and what is never below zero."""
    depths = [DEPTH * (1 + 0.05 * k) for k in range(5)]
    paces = [10.0**k for k in range(-4, 5, 2)]
    wide = [10.0**k for k in (-9, -7, -5, *range(-4, 5, 2), 5, 7, 9)]
    falls, opposes = _falls("normal_force"), "Friction never drives, at any speed"
    rough = tuple(replace(ROUGH_SLIDE, motion=Slide(speed=pace * PACE, load=LOAD)) for pace in paces)
    rows: tuple[tuple[str, str, Any, Callable, Any], ...] = (
        ("rises.depth", "Force rises with depth", [resting(motion=Indent(depth=d)) for d in depths], falls, SAME),
        (
            "rises.rough",
            "Force of a rough body rises with depth",
            [replace(ROUGH_SLIDE, motion=Indent(depth=depth)) for depth in depths],
            falls,
            SAME,
        ),
        (
            "rises.load",
            "Depth rises with load",
            [resting(motion=Indent(load=part * LOAD)) for part in (1.0, 1.1, 1.2, 1.3)],
            _falls("depth"),
            SAME,
        ),
        ("rises.speed", "Force at a depth rises with speed", [sliding(pace) for pace in paces], falls, GRID),
        ("friction.opposes", opposes, [moved(sliding(v), depth=None, load=LOAD) for v in wide], _drives, EXACT),
        ("friction.opposes.rough", "Friction of a rough body never drives", rough, _drives, EXACT),
    )
    for id, said, scenes, misfit, bound in rows:
        yield Law(id, INVARIANCE, said, tuple(scenes), misfit, bound)

    def driven(answers):
        return abs(answers[0]["friction_coefficient"])

    lossless = resting(motion=Slide(speed=PACE, load=LOAD))
    yield Law("friction.lossless", INVARIANCE, "An elastic solid has no friction", (lossless,), driven, SAME)


def limits() -> Iterator[Law]:
    """Between rubber and glass; friction in proportion to slow speeds, and to the inverse of fast ones."""
    soft, hard = resting(), resting(elastomer=replace(ELASTIC, modulus=STIFFENING * MODULUS))
    scenes = (soft, *(sliding(pace) for pace in (1e-3, 0.1, 1.0, 10.0, 1e3)), hard)
    said = "Force at a depth lies between that of rubber and that of glass"
    yield Law("limit.between", LIMIT, said, scenes, outside, GRID)
    for name, body in (("sphere", None), ("rough", ROUGH_SLIDE.roughness)):
        pair = tuple(Scene(SPHERE, KELVIN, Slide(speed=pace * PACE, load=LOAD), body) for pace in (1e-5, 1e-4))
        said = f"Friction of a slow {name} body is in proportion to the speed"
        bound = FRICTION.and_(1e-2, "v tau over the shortest wave, ten times")
        yield Law(f"limit.slow.{name}", LIMIT, said, pair, alike({"friction_force": 10.0}), bound)
    fast = tuple(sliding(pace) for pace in (1e4, 1e5))
    said = "Friction of a fast body on a standard linear solid goes with the inverse of the speed"
    bound = FRICTION.and_(3e-3, "30 a/(v tau), what relaxes in passing")
    yield Law("limit.fast", LIMIT, said, fast, alike({"friction_force": 0.1}), bound)
    smooth = resting(motion=Indent(load=LOAD))
    faint = SelfAffine(hurst=0.5, rms_height=DEPTH / 1e4, longest=2 * RADIUS, shortest=RADIUS / 2, seed=1)
    said = "Faint roughness changes the depth by no more than its heights"
    bound = GRID.and_(4e-4, "four rms heights over the depth")
    pair = smooth, replace(smooth, roughness=faint)
    yield Law("limit.smooth", LIMIT, said, pair, alike({"depth": 1.0}), bound)


def outside(answers) -> float:
    """By how much, relative, forces between the first and the last answer lie outside of theirs."""
    low, *between, high = (answer["normal_force"] for answer in answers)
    return worst(max(low / force - 1, force / high - 1, 0.0) for force in between)
