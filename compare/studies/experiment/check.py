"""The law on a layer against rough balls that BEM solves as they are, with waves that a grid holds."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import product
from typing import Any

import numpy as np
import xarray

from bem3d import BEM
from scene import Scene, SelfAffine
from scene.scales import elastic_contact

from ...solving.outcome import Outcome
from ...solving.task import SceneTask, Task, draws_of
from ...statistics.finding import UNKNOWN, Claim, Finding
from ...statistics.jackknife import mean_ratio
from .contact import RoughBall
from .setup import HALF_SPACE, LOSSY, SOLIDS, STIFF, THIN, Pair

LOAD, SPEED = 10.0, 0.01  # [N], [m/s]
LONGEST, SHORTEST, HURST, POINTS = 3, 12, 0.8, 320  # waves in a radius; points a side, twelve a wave
LOSSES, HEIGHTS, PAIRS = (LOSSY, "loss from 30 rad/s", STIFF), (0.01, 0.04), (THIN, HALF_SPACE)
OVER = "Ratio, with the interval of 95 % over surfaces; twelve waves in a radius, a layer as thick as 1.6 radii."
LAW, ROUGH, LAYER = (
    Claim(f"experiment.{id}", sentence, *claimed, OVER, dimension="3D")
    for id, sentence, claimed in (
        ("law", "Friction by the law over that of the rough ball solved on the layer", (1.0, 0.05)),
        ("law-of-roughness", "The same of what roughness adds to friction", (np.nan, np.nan)),
        ("law-on-layer", "That ratio on the layer over that on a half-space", (1.0, 0.05)),
    )
)
NAMES = "friction_force", "friction_of_shape", "friction_of_roughness"


def contact(solid: str, height: float, pair: Pair) -> tuple[Scene, SelfAffine]:
    """A smooth ball, and its roughness of a height over the depth: that of the half-space, on a layer too."""
    smooth = pair.scene(SOLIDS[solid], SPEED, LOAD)
    rest = elastic_contact(replace(smooth, layer=None))
    longest, shortest = rest.radius / LONGEST, rest.radius / SHORTEST
    return smooth, SelfAffine(
        rms_height=height * rest.depth, hurst=HURST, longest=longest, shortest=shortest, seed=1
    )


def tasks(surfaces: int, points: int) -> list[tuple[SceneTask, RoughBall]]:
    """The rough balls as they are and one by the law, on the layer and on the half-space in turn."""
    found = []
    for smooth, rough in (contact(*each) for each in product(LOSSES, HEIGHTS, PAIRS) if surfaces):
        drawn = draws_of(replace(smooth, roughness=rough), surfaces)
        found.append((SceneTask(BEM(points=POINTS), drawn, work=1e7), RoughBall(smooth, (rough,), points)))
    return found


def answers(checks: Sequence[tuple[SceneTask, RoughBall]], outcomes: Mapping[Task, Outcome]) -> xarray.Dataset:
    """Friction that is solved, of each surface, and its parts by the law."""
    solved = [[each.friction_force for each in outcomes[task].rows] for task, _ in checks]
    law = [outcomes[ball].rows[0].measures for _, ball in checks]
    numbers: list[Any] = [solved, *([each.get(name, np.nan) for each in law] for name in NAMES[1:])]
    dims = {"solid": list(LOSSES), "height": list(HEIGHTS), "pair": [each.title for each in PAIRS]}
    shape = tuple(map(len, (LOSSES, HEIGHTS, PAIRS)))
    values = [np.reshape(each, shape + np.shape(each)[1:]) for each in numbers]
    shaped = {name: ((*dims, "seed")[: each.ndim], each) for name, each in zip(NAMES, values, strict=True)}
    return xarray.Dataset(shaped, dims)


def findings(found: xarray.Dataset) -> Iterator[Finding]:
    """The law on the layer; of roughness alone; and as good there as on a half-space, on equal surfaces."""
    for solid, height in product(LOSSES, HEIGHTS):
        own = found.sel(solid=solid, height=height)
        (solved, plain), (ball, _), (rough, _) = (own[name].values for name in NAMES)
        law, one = own[NAMES[1]].values + own[NAMES[2]].values, np.ones_like(solved)
        numbers = (
            (LAW, law[0], solved, one),
            (ROUGH, rough, solved - ball, one),
            (LAYER, law[0] / law[1], solved, plain),
        )
        for claim, times, over, beneath in numbers:
            ratio = mean_ratio(over, beneath)
            low, high = (float(times / end) for end in ratio.interval()[::-1])
            where = f"{solid}, rms height {height:g} of the depth"
            yield Finding(claim, float(times / ratio.value), (low, high), 0.0, UNKNOWN, where, solved.size)
