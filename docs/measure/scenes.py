"""Friction of random scenes in three dimensions, against which laws of friction are held.

python docs/measure/scenes.py [WORKERS]   solves what is not solved yet, and writes results/law/scenes-*.csv
"""

import sys
from collections.abc import Iterator
from dataclasses import dataclass
from math import inf
from pathlib import Path

import numpy as np
from campaign import friction, solved
from tables import stored

from bem3d import BEM
from compare.solving.outcome import Outcome
from compare.solving.task import SceneTask, draws_of
from compare.studies.trust.design import drawn_points, scene_at
from mdr1d import MDR
from scene import Scene, Slide

PAGE = Path(__file__).parents[1] / "results" / "law" / "scenes.md"
# Number of scenes and seed of each set: to choose between forms of the law, and to judge the one that was chosen.
SETS = {"tried": (240, 36_100), "fresh": (640, 36_200)}
# The least number of surfaces: four times as many on the coarsest grid.
SURFACES, PROFILES, SURFACE_SEEDS = 16, 40, 1000
POINTS, PIXELS = (128, 192, 256, 384, 512, 640), 12  # a side; to the shortest wave


@dataclass(frozen=True)
class RandomScene:
    """A scene that slides on roughness, and its tasks."""

    set: str
    number: int
    scene: Scene

    @property
    def first(self) -> SceneTask:
        """Its first surface, for the side of its window."""
        return SceneTask(BEM(points=POINTS[0]), (self.scene,))

    @property
    def line(self) -> SceneTask:
        """Its profiles."""
        return SceneTask(MDR(points=4000), draws_of(self.scene, PROFILES), work=1e-2)

    def space(self, first: Outcome) -> SceneTask:
        """Its surfaces, on points that resolve the shortest wave in the window of the first."""
        needed = PIXELS * first.rows[0].settings.get("extent", inf) / self.scene.roughness.shortest
        points = next((points for points in POINTS if points >= needed), POINTS[-1])
        surfaces = max(SURFACES, round(4 * SURFACES * (POINTS[0] / points) ** 2))
        return SceneTask(BEM(points=points), draws_of(self.scene, surfaces), work=float(surfaces * points**2))


def scenes(name: str) -> Iterator[RandomScene]:
    """Scenes of a set, one after the other."""
    count, seed = SETS[name]
    found = 0
    for number, point in enumerate(drawn_points(seed)):
        scene = scene_at(point, SURFACE_SEEDS * number)
        if scene.roughness is not None and isinstance(scene.motion, Slide) and found < count:
            found += 1
            yield RandomScene(name, number, scene)


def row(scene: RandomScene, space: Outcome, line: Outcome) -> dict:
    """Friction in 3D with its standard error, relative, and in 1D."""
    surfaces, profiles = friction(space.rows), friction(line.rows)
    return {
        "scene": scene.number,
        "friction": float(surfaces.value),
        "error": float(surfaces.error / abs(surfaces.value)),
        "load": float(np.nanmean([each.normal_force for each in space.rows])),
        "depth": float(np.nanmean([each.depth for each in space.rows])),
        "area": float(np.nanmean([each.measures.get("contact_area", 0.0) for each in space.rows])),
        "surfaces": sum(each.reason is None for each in space.rows),
        "points": space.rows[0].settings.get("points", 0),
        "line": float(profiles.value),
    }


def main(workers: int | None = None, *names: str) -> None:
    """Solve what is not solved yet, and write what was found."""
    for name in names or SETS:
        found = list(scenes(name))
        first = solved(PAGE, [each.first for each in found], workers)
        spaces = {each: each.space(first[each.first]) for each in found}
        outcomes = solved(PAGE, [task for each in found for task in (spaces[each], each.line)], workers)
        told = [row(each, outcomes[spaces[each]], outcomes[each.line]) for each in found]
        stored(PAGE.with_name(f"scenes-{name}.csv"), told)


if __name__ == "__main__":
    main(*(int(each) if each.isdecimal() else each for each in sys.argv[1:]))
