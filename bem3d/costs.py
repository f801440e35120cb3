"""Measured operator applications of steady contacts by points a side, for plans."""

import csv
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from scene import Scene
from scene.scales import elastic_contact

from .motion.steady import Flow

MEASURED = Path(__file__).with_name("costs.csv")
BANDS = ("rest", "slow", "middle", "fast")
SLOW, FAST = 0.1, 10.0  # memory over the shortest length of the contact, between which it slides at middle speed


def band(scene: Scene) -> str:
    """Class of speed of a scene, by the length of its memory over the shortest length of its contact."""
    flow, rough = Flow.of(scene.solid, scene.motion.speed), scene.roughness
    if flow.at_rest:
        return "rest"
    smooth = rough is None or rough.flat
    shortest: Any = elastic_contact(scene).radius if smooth else rough.shortest
    memory = flow.memory / shortest
    return "slow" if memory < SLOW else "middle" if memory < FAST else "fast"


def body(scene: Scene) -> str:
    """Kind of body, smooth or rough, for which applications were measured."""
    return "smooth" if scene.roughness is None or scene.roughness.flat else "rough"


def typical(scene: Scene, points: int) -> float:
    """Applications of such a body at such a speed on a square of `points` a side."""
    return _between(measured()[body(scene), band(scene)], points)


@cache
def measured() -> Mapping[tuple[str, str], np.ndarray]:
    """Points a side and median applications (2, grids), by body and band."""
    grids: dict[tuple[str, str], list[tuple[float, float]]] = {}
    with MEASURED.open(encoding="utf-8", newline="") as file:
        for row in csv.DictReader(file):
            grids.setdefault((row["body"], row["band"]), []).append((float(row["points"]), float(row["value"])))
    return {kind: np.array(sorted(pairs)).T for kind, pairs in grids.items()}


def _between(grids, points):
    """Applications between two grids, by a power of the points."""
    x, y = np.log(grids)
    k = int(np.clip(np.searchsorted(x, np.log(points)), 1, len(x) - 1))
    slope = (y[k] - y[k - 1]) / (x[k] - x[k - 1])
    return float(np.exp(y[k] + slope * (np.log(points) - x[k])))
