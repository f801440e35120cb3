"""The law of friction and its rivals against random scenes in three dimensions: the table of results/law.md.

python docs/measure/law.py         compares them with results/law/scenes-*.csv
python docs/measure/law.py solve   solves these scenes first, as far as they are not solved yet
"""

import sys
from collections import namedtuple
from dataclasses import replace
from itertools import chain

import design
import numpy as np
import pandas
from contact import resolving
from design import drawn_points, scene_at, within
from pandas import DataFrame
from tables import RESULTS, errors_of, fill, friction, share_of, solved, stored, table, task

from bem3d import BEM
from compare import FrictionLaw, Persson
from compare.models.law.parts import LawParts
from compare.trustmap.model import NORMAL
from mdr1d import MDR
from scene import Slide
from scene.scales import elastic_contact

PAGE, ERRORS, SCENES = (RESULTS / name for name in ("law.md", "law/errors.csv", "law/scenes"))
# Points and seed of each set: drawn evenly, and two in three of them where the bare law is far off. 640 and 240 of
# them slide on roughness.
SETS = {"fresh": (801, 36_200), "regions": (254, 53_100)}
FAST, BLUNT, EVENLY = REGIONS = "spheres on a fast Kelvin solid", "blunt bodies", "drawn evenly"
# The first of these: v tau over the shortest wave, and h0/d; the second: n, and p/p_rms.
PASSED, HEIGHT, POWERS, PRESSURES = (15.0, 300.0), (0.04, 0.3), (6.0, 12.0), (0.9, 4.0)
PASSES = 4  # of the height that a pressure asks for: the contact depends on it little
# The least number of surfaces: four times as many on the coarsest grid.
SURFACES, PROFILES = 16, 40
POINTS, PIXELS = (128, 192, 256, 384, 512, 640), 12  # a side; to the shortest wave


# Rows of the table, by the scenes that each is about.
ROWS = {
    "h₀ ≤ 0.1 d": "outside == 0 and height <= 0.1",
    "h₀ > 0.1 d": "outside == 0 and height > 0.1",
    "x < 0.1": "outside == 0 and x < 0.1",
    f"{FAST}, v τ/λ_s 15 to 300": f"outside == 0 and region == {FAST!r}",
    f"{BLUNT}, n > 6, p/p_rms 0.9 to 4": f"outside == 0 and region == {BLUNT!r}",
    "all": "outside == 0",
    "off the map": "outside == 1",
}
MODELS = {"bare": "bare law", "law": "3D law", "persson": "Persson", "line": "MDR"}


# A scene that slides on roughness, and its region.
RandomScene = namedtuple("RandomScene", "number region scene")


def surfaces(scene, first):
    """Surfaces of a scene, on points that resolve the shortest wave in the window of the first."""
    points = resolving(first.rows[0], scene.roughness.shortest, POINTS, PIXELS)
    return task(BEM(points=points), scene, max(SURFACES, round(4 * SURFACES * (POINTS[0] / points) ** 2)))


def scenes(name):
    """Scenes of a set, one after the other."""
    count, seed = SETS[name]
    regions, periods = ([EVENLY], design.PERIODS) if name == "fresh" else (REGIONS, design.ALL_PERIODS)
    for number, drawn in enumerate(drawn_points(seed)[:count].tolist()):
        point = design.Point(*drawn)
        region = regions[number % len(regions)]
        scene = scene_at(place(region, point), design.SEEDS * number, periods)
        if region == BLUNT:
            scene = pressed(scene, design.between(PRESSURES, point.height))
        if scene.roughness is not None and isinstance(scene.motion, Slide):
            yield RandomScene(number, region, scene)


def place(region, point):
    """Point of the cube moved to a region."""
    if region == EVENLY:
        return point
    if region == BLUNT:
        return design.blunt(point, POWERS, design.HEIGHTS)
    height, speed = within(point.height, design.HEIGHTS, HEIGHT), within(point.speed, design.SPEEDS, PASSED)
    return design.rough_and_sliding(point)._replace(
        shape=(design.CONES + design.ROUND) / 2, kind=0.1, height=height, speed=design.SLIDING * speed
    )


def pressed(scene, ratio):
    """The scene with roughness so high that p/p_rms is a ratio, or as high as the body is deep."""
    for _ in range(PASSES):
        rough = scene.roughness
        height = min(rough.rms_height * LawParts.of(scene).x / ratio, design.DEPTH * design.HEIGHTS[1])
        scene = replace(scene, roughness=replace(rough, rms_height=height))
    return scene


def row(number, space, line):
    """Friction in 3D with its standard error, relative, and in 1D."""
    mean = friction(space.rows)
    found = {"scene": number, "friction": mean.value, "error": mean.error / abs(mean.value)}
    return found | {"line": friction(line.rows).value}


def errors():
    """ln(model / 3D) of each scene, where it lies, and whether the interval of the law holds it."""
    rows = []
    for name in SETS:
        known = pandas.read_csv(SCENES.with_name(f"scenes-{name}.csv"), index_col="scene")
        known = known[known["friction"] > 0]
        rows += [_errors(each, known.loc[each.number]) for each in scenes(name) if each.number in known.index]
    return DataFrame(rows)


def _errors(each, known):
    scene, found = each.scene, FrictionLaw().solve(each.scene)
    low, high = (np.log(found.measures[f"friction_{end}"]) for end in ("low", "high"))
    middle, true = np.log(found.friction_coefficient), np.log(known["friction"])
    # The truth has an error of its own, by which the interval is widened.
    spread, end = NORMAL * known["error"], low if true < middle else high
    answers = {
        "bare": found.measures["bare_friction"],
        "law": found.friction_coefficient,
        "persson": Persson().solve(scene).friction_coefficient if scene.motion.load is not None else np.nan,
        "line": known["line"],
    }
    return {
        "scene": each.number,
        "region": each.region,
        "height": scene.roughness.rms_height / elastic_contact(scene).depth,
        "x": found.measures["pressure_ratio"],
        "outside": found.measures["outside"],
        "half": (high - low) / 2,
        "held": float(abs(true - middle) <= np.hypot(end - middle, spread)),
        **{name: float(np.log(value) - true) if value > 0 else np.nan for name, value in answers.items()},
    }


def rows(found):
    """Number of scenes, error of each model in the median and at nine in ten, and coverage, by region."""
    for region, where in ROWS.items():
        own = found.query(where)
        yield region, str(len(own)), *(errors_of(own[name]) for name in MODELS), *_covered(own)


def _covered(own):
    """Half of the interval, and how many it holds; nothing where there are no intervals."""
    half = np.expm1(own["half"].median())
    return ("", "") if np.isnan(half) else (f"{100 * half:.2g} %", share_of(own["held"]))


def unseen():
    """Errors of the law that half and nine in ten of the unseen scenes stay below [%], and number of scenes."""
    off = 100 * np.abs(np.expm1(pandas.read_csv(ERRORS).query(ROWS["all"])["law"]))
    return *off.quantile([0.5, 0.9]), len(off)


def parts():
    """Text between two comments of the page, by the name of the comment."""
    found = pandas.read_csv(ERRORS)
    return {"errors": table("|scenes|" + "|".join(MODELS.values()) + "|± (95 %)|held", rows(found))}


def solve():
    """Solve the scenes that are not solved yet, and write what was found."""
    for name in SETS:
        found = {each.number: each.scene for each in scenes(name)}
        first = {number: task(BEM(points=POINTS[0]), scene) for number, scene in found.items()}
        windows = solved(SCENES, first.values())
        both = {
            number: (surfaces(scene, windows[first[number]]), task(MDR(points=4000), scene, PROFILES))
            for number, scene in found.items()
        }
        outcomes = solved(SCENES, chain(*both.values()))
        rows = (row(number, *map(outcomes.get, tasks)) for number, tasks in both.items())
        stored(SCENES.with_name(f"scenes-{name}.csv"), rows)


def main(first=""):
    """Write the errors, and the table of the page."""
    if first:
        solve()
    stored(ERRORS, errors())
    fill(PAGE, parts())


if __name__ == "__main__":
    main(*sys.argv[1:])
