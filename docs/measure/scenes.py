"""Friction of random scenes in three dimensions, against which laws of friction are held.

python docs/measure/scenes.py   solves what is not solved yet, and writes results/law/scenes-*.csv
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import inf
from pathlib import Path

import design
from design import drawn_points, scene_at, within
from tables import friction, solved, stored

from bem3d import BEM
from compare.models.law.parts import LawParts
from compare.solving.task import Outcome, SceneTask, draws_of
from mdr1d import MDR
from scene import Scene, Slide

PAGE = Path(__file__).parents[1] / "results" / "law" / "scenes.md"
# Number of scenes and seed of each set: drawn evenly, and two in three of them where the bare law is far off.
SETS = {"fresh": (640, 36_200), "regions": (240, 53_100)}
FAST, BLUNT, EVENLY = REGIONS = "spheres on a fast Kelvin solid", "blunt bodies", "drawn evenly"
# The first of these: v tau over the shortest wave, and h0/d; the second: n, and p/p_rms.
PASSED, HEIGHT, POWERS, PRESSURES = (15.0, 300.0), (0.04, 0.3), (6.0, 12.0), (0.9, 4.0)
PASSES = 4  # of the height that a pressure asks for: the contact depends on it little
# The least number of surfaces: four times as many on the coarsest grid.
SURFACES, PROFILES, SURFACE_SEEDS = 16, 40, 1000
POINTS, PIXELS = (128, 192, 256, 384, 512, 640), 12  # a side; to the shortest wave


@dataclass(frozen=True)
class RandomScene:
    """A scene that slides on roughness, its region, and its tasks."""

    number: int
    region: str
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
    for number, drawn in enumerate(drawn_points(seed).tolist()):
        point = design.Point(*drawn)
        region, periods = EVENLY, design.PERIODS
        if name == "regions":
            region, periods = REGIONS[number % len(REGIONS)], design.ALL_PERIODS
        scene = scene_at(place(region, point), SURFACE_SEEDS * number, periods)
        if region == BLUNT:
            scene = pressed(scene, design.between(PRESSURES, point.height))
        if scene.roughness is not None and isinstance(scene.motion, Slide) and found < count:
            found += 1
            yield RandomScene(number, region, scene)


def place(region: str, point: design.Point) -> design.Point:
    """Point of the cube moved to a region."""
    if region == EVENLY:
        return point
    moved = design.rough_and_sliding(point)
    if region == BLUNT:
        shape = design.ROUND + (1 - design.ROUND) * point.shape
        return moved._replace(shape=shape, exponent=within(point.exponent, design.EXPONENTS, POWERS))
    height, speed = within(point.height, design.HEIGHTS, HEIGHT), within(point.speed, design.SPEEDS, PASSED)
    return moved._replace(
        shape=(design.CONES + design.ROUND) / 2, kind=0.1, height=height, speed=design.SLIDING * speed
    )


def pressed(scene: Scene, ratio: float) -> Scene:
    """The scene with roughness so high that p/p_rms is a ratio, or as high as the body is deep."""
    for _ in range(PASSES):
        rough = scene.roughness
        height = min(rough.rms_height * LawParts.of(scene).x / ratio, design.DEPTH * design.HEIGHTS[1])
        scene = replace(scene, roughness=replace(rough, rms_height=height))
    return scene


def row(scene: RandomScene, space: Outcome, line: Outcome) -> dict:
    """Friction in 3D with its standard error, relative, and in 1D."""
    surfaces, profiles = friction(space.rows), friction(line.rows)
    error = surfaces.error / abs(surfaces.value)
    found = {"friction": surfaces.value, "error": error, "line": profiles.value}
    return {"scene": scene.number} | {name: float(value) for name, value in found.items()}


def main() -> None:
    """Solve what is not solved yet, and write what was found."""
    for name in SETS:
        found = list(scenes(name))
        first = solved(PAGE, [each.first for each in found])
        spaces = {each: each.space(first[each.first]) for each in found}
        outcomes = solved(PAGE, [task for each in found for task in (spaces[each], each.line)])
        rows = [row(each, outcomes[spaces[each]], outcomes[each.line]) for each in found]
        stored(PAGE.with_name(f"scenes-{name}.csv"), rows)


if __name__ == "__main__":
    main()
