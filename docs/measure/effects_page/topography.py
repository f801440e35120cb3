"""A sphere with the roughness of one map: in three dimensions, and as lines drawn from it in two ways.

The map is synthetic: a piece cut from a surface drawn at random, on a plane that is not level, as an instrument
would give it. It stands in for a measured one.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache

import numpy as np

from bem3d import BEM
from bem3d.surface import RoughSurface
from compare.solving.outcome import Outcome
from compare.solving.task import SceneTask as Task
from compare.solving.task import Task as AnyTask
from mdr1d import MDR
from scene import Indent, Kelvin, Scene, SelfAffine, Slide, Sphere, Topography
from scene.scales import elastic_contact

from .chapter import Chapter, Rows
from .figures import topography as drawing
from .means import Estimate, between, estimate, ratio, written

NAME = "topography"
BODY = Scene(Sphere(radius=10e-3), Kelvin(modulus=1e6, relaxation_time=1e-3), Indent(depth=1e-4))
# Pixels a side of the piece that is cut out, and of the surface that it is cut from; side of a pixel [m].
PIXELS, SURFACE, PIXEL = 128, 320, 31.25e-6
SHORTEST = 125e-6  # kept [m]: four pixels
LOAD = 1.0  # [N]
DEPTHS = (0.25, 0.5, 1.0, 2.0)  # over that of BODY
SPEEDS = (0.03, 0.3, 3.0)  # [m/s]
PLACES, LINES = 8, 100
SMOOTH, SURFACES, MAPPED, ROWS = "smooth, 3D", "map, 3D", "line by π q C2D", "rows of the map"
SOLVERS = {
    SMOOTH: BEM(points=128),
    SURFACES: BEM(points=128),
    MAPPED: MDR(points=2000),
    ROWS: MDR(points=2000, spectrum="line-scan"),
}


@dataclass(frozen=True)
class Answer:
    """One quantity of one contact, in one of the ways.

    quantity : "force" [N] at x, a depth [m], or "friction" [1] at x, a speed [m/s]
    """

    quantity: str
    x: float
    way: str
    value: Estimate


@cache
def patch() -> Topography:
    """The map."""
    side = SURFACE * PIXEL
    rough = SelfAffine(
        hurst=0.8, rms_height=8e-6, longest=side, rolloff=2e-3, shortest=4 * PIXEL, seed=11, amplitudes="gaussian"
    )
    at = np.arange(PIXELS) * PIXEL
    heights = RoughSurface.of(rough, rough.q_max(PIXEL)).heights(at, at)
    tilted = heights + 2e-3 * at[None, :] - 1e-3 * at[:, None]
    return Topography(heights=tilted, pixel=(PIXEL, PIXEL), shortest_kept=SHORTEST)


def tasks() -> list[Task]:
    """Every contact in every way; the places, lines and rows of one are one task."""
    return [_task(way, motion) for motion in _motions() for way in SOLVERS]


def _motions():
    depth = BODY.motion.depth
    return *(Indent(depth=factor * depth) for factor in DEPTHS), *(Slide(speed=v, load=LOAD) for v in SPEEDS)


def _task(way, motion):
    scene = replace(BODY, motion=motion)
    seeds = {SMOOTH: (), SURFACES: range(PLACES)}.get(way, range(1, LINES + 1))
    scenes = tuple(replace(scene, roughness=replace(patch(), seed=seed)) for seed in seeds) or (scene,)
    return Task(SOLVERS[way], scenes, work=len(scenes) * (1e6 if SOLVERS[way].name == "BEM" else 1e4))


def answers(outcomes: Mapping[AnyTask, Outcome]) -> list[Answer]:
    """Means over places, lines and rows; failed ones are left out."""
    found = []
    for motion in _motions():
        slides = motion.speed > 0
        for way in SOLVERS:
            rows = outcomes[_task(way, motion)].rows
            values = [row.friction_coefficient if slides else row.normal_force for row in rows]
            quantity, x = ("friction", motion.speed) if slides else ("force", motion.depth)
            found.append(Answer(quantity, x, way, estimate(values)))
    return found


def chapter(outcomes: Mapping[AnyTask, Outcome]) -> Chapter:
    """What becomes of force and friction in each way."""
    found = answers(outcomes)
    drawn = [_sheet(each) for each in found]
    return Chapter(
        {"Force at a depth, friction under a load": _table(found)},
        {drawing.NAME: drawing.figure(drawn)},
        {drawing.NAME: drawn},
    )


def _ratio(found, three: Answer, way):
    """One dimension over three."""
    one = next(each for each in found if (each.quantity, each.x, each.way) == (three.quantity, three.x, way))
    return ratio(one.value, three.value)


def _table(found) -> Rows:
    rows = []
    for three in (each for each in found if each.way == SURFACES):
        at = f"{three.x * 1e6:.0f} µm" if three.quantity == "force" else f"{three.x:g} m/s"
        same = {each.way: each for each in found if (each.quantity, each.x) == (three.quantity, three.x)}
        unit = "N" if three.quantity == "force" else ""
        rows.append(
            {"": f"{three.quantity} at {at}"}
            | {way: written(each.value, unit) for way, each in same.items()}
            | {f"{way}, over 3D": between(_ratio(found, three, way)) for way in (MAPPED, ROWS)}
        )
    return rows


def _sheet(each: Answer):
    smooth = elastic_contact(replace(BODY, motion=Indent(depth=each.x))).load if each.quantity == "force" else 1.0
    low, high = each.value.found.interval()
    return {
        "quantity": each.quantity,
        "x": each.x,
        "way": each.way,
        "mean": each.value.mean,
        "low": low,
        "high": high,
        "count": each.value.count,
        "unit": smooth,
    }
