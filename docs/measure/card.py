"""The smooth body of the card, fitted to smooth spheres and cones that are solved in three dimensions.

python docs/measure/card.py   fits them, writes results/law/card.csv, and prints the numbers for law/card.py
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from pandas import DataFrame
from scenes import PAGE
from scipy.optimize import minimize
from tables import stored

from compare.models.law.card import BODIES, Body
from compare.models.law.nominal import NominalContact
from compare.models.law.smooth import SmoothContact
from compare.studies.trust.design import drawn_points, scene_at
from scene import Cone, Scene, Slide, Sphere
from scene.scales import elastic_contact

SEED = 36_300
SCENES = 400  # at most, of each shape: every second is fitted to, the others are held out
# Misfits below which one counts no more than another, and above which one counts no more than another.
FLOOR, MOST = 0.004, 0.3
ROUNDS = 50  # of the search for the three frequencies


def smooth_scenes(shape: type) -> Iterator[Scene]:
    """Smooth bodies of a shape that slide under a load, over the ranges of the trust map."""
    for number, point in enumerate(drawn_points(SEED)):
        scene = scene_at(point, number)
        if isinstance(scene.motion, Slide) and scene.motion.load and isinstance(scene.indenter, shape):
            yield replace(scene, roughness=None)


def solved(shape: type) -> list[tuple[Scene, float, float]]:
    """Scenes with friction coefficient and radius of the contact in three dimensions."""
    scenes = [scene for scene, _ in zip(smooth_scenes(shape), range(SCENES), strict=False)]
    return [(scene, (found := SmoothContact.of(scene)).friction_coefficient, found.radius) for scene in scenes]


def fitted(columns: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Coefficients of the least sum of sizes."""
    weight = np.ones(len(values))
    for _ in range(12):
        found = np.linalg.lstsq(columns * weight[:, None], values * weight, rcond=None)[0]
        weight = 1 / np.sqrt(np.maximum(abs(values - columns @ found), FLOOR))
    return found


def body_of(rows, frequencies, like: Body) -> tuple[Body, np.ndarray]:
    """Body of three frequencies, fitted to every second row; misfits (rows, 2) of ln radius and ln friction."""
    body = replace(like, **dict(zip(("stiff", "lossy", "later"), np.exp(frequencies).tolist(), strict=True)))
    columns, values = [], []
    for scene, friction, radius in rows:
        solid, speed, rest, n = scene.solid, scene.motion.speed, elastic_contact(scene), scene.indenter.exponent
        a = body.as_stiff(n, rest.radius, solid, speed)
        columns.append(body.losses(solid, speed, a))
        lost = NominalContact.smooth(n, a, rest.load).lost(solid, speed) / rest.load
        values.append(np.log([radius / a, friction / lost]))
    columns, values = np.array(columns), np.array(values)
    numbers = [fitted(columns[::2], each[::2]) for each in values.T]
    found = replace(body, radius=tuple(numbers[0].tolist()), friction=tuple(numbers[1].tolist()))
    return found, values - columns @ np.transpose(numbers)


def main() -> None:
    """Fit both shapes, and tell how far off they are where they were not fitted."""
    told = []
    for shape in (Sphere, Cone):
        rows, start = solved(shape), BODIES[shape]

        def missed(frequencies, rows=rows, start=start):
            return np.minimum(abs(body_of(rows, frequencies, start)[1][::2]), MOST).mean()

        best = minimize(
            missed,
            np.log([start.stiff, start.lossy, start.later]),
            method="Nelder-Mead",
            options={"maxiter": ROUNDS},
        )
        found, off = body_of(rows, best.x, start)
        for name, own in zip(("radius", "friction"), np.abs(off[1::2]).T, strict=True):
            ends = {"median": np.median(own), "nine in ten": np.quantile(own, 0.9)}
            told.append({"shape": shape.__name__, "of": name, **ends, "scenes": len(own)})
        print(found)
    table = DataFrame(told)
    stored(PAGE.with_name("card.csv"), table)
    print(table.to_string())


if __name__ == "__main__":
    main()
