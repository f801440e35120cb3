"""The share S of its friction in full contact that a rough plane keeps in partial contact: measured, and fitted.

python docs/measure/planes.py       solves what is not solved yet, writes results/law/planes.csv, and fits S
python docs/measure/planes.py fit   fits S to that table: compare/models/law/share.csv, misfits in results/law
"""

import sys
from collections import namedtuple
from dataclasses import replace
from itertools import pairwise
from math import nan, pi

import numpy as np
import pandas
from design import RADIUS, SPEED, between, solid_at
from pandas import DataFrame
from scipy.optimize import least_squares
from scipy.stats import qmc
from tables import RESULTS, friction, solved, stored, task

from bem3d import BEM
from bem3d.heights import heights
from compare.models.exact import full_contact
from compare.models.law.bands import Bands, FullContact
from compare.models.law.parts import FITTED, Share, coefficients, waves
from scene import Plane, Scene, SelfAffine, Slide

TABLE = RESULTS / "law/planes.csv"
PLANES, SEED, SURFACE_SEEDS = 250, 36_001, 1000
HELD_OUT = 5  # every fifth plane is held out
BREADTHS = 4.0, 32.0  # longest over shortest wave
# Planes of many waves a side, as a contact of the paper has them: rolled off at 1.5 to 20 times the shortest wave,
# so that they are alike at each place.
WIDE, WIDE_SEED, WIDE_BREADTH, WIDE_ROLLOFFS = 48, 36_002, 64.0, (1.5, 20.0)
# Pressures over the rms pressure in full contact, one of each range, and numbers of surfaces, few waves a side and
# many: few spots touch under light ones, and scatter.
RANGES = ((5e-3, 3e-2), (16, 4)), ((3e-2, 0.15), (8, 3)), ((0.15, 0.6), (6, 2)), ((0.6, 3.0), (4, 2))
# Points a wave; on every fourth plane the finer tells what the coarser is off by, which hardly differs between
# surfaces.
COARSE, FINE, CHECKED, CHECKS = 16, 32, 2, 4
DRAWN, DIMENSIONS = 512, 12  # places of a sequence; the first are taken
FLOOR = 0.02  # of the misfit of a plane, below which one counts no more than another
PLACES = 5e-3, 0.015, 0.03, 0.07, 0.15, 0.3, 0.6, 1.2, 3.0


# One plane under one pressure: its number, its first surface, see `tasks`, friction of these waves in full
# contact, an area [Pa], and rms pressure [Pa], and numbers of these waves, see `share.waves`.
PlaneContact = namedtuple("PlaneContact", "number scene tasks friction pressure waves")


def tasks(scene, count, checked):
    """All surfaces coarse; to be checked also a few of them coarse and fine."""
    rough = scene.roughness
    for points, draws in ((COARSE, count), *[(COARSE, CHECKED), (FINE, CHECKED)] * checked):
        side = 2 * round(points * rough.longest / rough.shortest / 2)
        yield task(BEM(points=side), scene, draws)


def contacts():
    """All planes under all pressures, of a Sobol sequence."""
    few, many = (qmc.Sobol(DIMENSIONS, seed=seed).random(DRAWN).tolist() for seed in (SEED, WIDE_SEED))
    for number, place in enumerate([*few[:PLANES], *many[:WIDE]]):
        wide = number >= PLANES
        hurst, breadth, rolled, rolloff, kind, *others, speed, at, shift = place
        ratio = WIDE_BREADTH if wide else between(BREADTHS, breadth)
        shortest, rolloffs = RADIUS / ratio, WIDE_ROLLOFFS if wide else (1.05, ratio)
        rough = SelfAffine(
            hurst=hurst,
            rms_height=1e-7,
            longest=RADIUS,
            shortest=shortest,
            rolloff=shortest * between(rolloffs, rolloff) if wide or rolled < 0.5 else None,
            seed=SURFACE_SEEDS * number,
        )
        kind = 0.8 * kind + 0.2 * (kind > 0.9)
        solid = solid_at(kind, *others, 0.88 * speed, shortest / (2 * pi))
        scene = Scene(Plane(), solid, Slide(speed=SPEED, pressure=1.0), rough)
        full = heights(scene, 2 * round(4 * ratio)).height, (RADIUS, RADIUS), solid, SPEED
        lost, pressure = full_contact.friction(*full), float(full_contact.pressure(*full).std())
        numbers = waves(FullContact.of(Bands.of(rough), solid, SPEED))
        for index, (ends, counts) in enumerate(RANGES):
            x = between(ends, (at + shift * index) % 1)
            pressed = replace(scene, motion=Slide(speed=SPEED, pressure=x * pressure))
            asked = tuple(tasks(pressed, counts[wide], number % CHECKS == 0 and not wide))
            yield PlaneContact(number, pressed, asked, lost, pressure, numbers)


def rows(found, outcomes):
    """Each plane under each pressure: where it lies, and the share with its standard error, relative."""
    for each in found:
        coarse, *checked = (outcomes[task].rows for task in each.tasks)
        rough, motion = each.scene.roughness, each.scene.motion
        mean = friction(coarse)  # friction over the load
        few, fine = (friction(rows).value for rows in checked) if checked else (1.0, nan)
        yield {
            "plane": each.number,
            "x": motion.pressure / each.pressure,
            "share": mean.value * motion.pressure / each.friction,
            "error": mean.error / mean.value,
            "gap": np.nanmean([row.measures.get("mean_gap", nan) for row in coarse]) / rough.rms_height,
            "friction_finer": fine / few - 1,
            **{name: value for name, value in each.waves.items() if name != "one"},
        }


def planes():
    """Planes with their share on ever finer grids: what those with a finer one differ by is alike for all."""
    found = pandas.read_csv(TABLE).assign(one=1.0)
    columns = np.stack([found["one"], found["lossy"], np.log(found["x"])], axis=1)
    finer = found["friction_finer"]
    change = columns @ np.linalg.lstsq(columns[finer.notna()], finer.dropna(), rcond=None)[0]
    # Halving the pixel once more changes half as much again, and so on.
    return found.assign(share=found["share"] * (1 + 2 * change))


def fitted(found, start):
    """Coefficients that fit most planes best: those that lie far off hardly count."""
    weight = 1 / np.hypot(found["error"], FLOOR).to_numpy()
    return least_squares(lambda values: weight * off(found, values), start, loss="cauchy").x


def off(found, values):
    """Logarithm of S of each plane, by values of the coefficients, over the measured share."""
    share = Share.summed(dict(zip(coefficients(), values, strict=True)), found)
    return np.log(share(found["x"].to_numpy()) / found["share"].to_numpy())


def misfits(found, values):
    """Misfit of planes held out by their pressure: median, nine in ten, and the standard error of the planes."""
    found = found.assign(misfit=np.abs(off(found, values)))
    for low, high in pairwise(PLACES):
        own = found[found["x"].between(low, high)]
        median, most = np.quantile(own["misfit"], (0.5, 0.9))
        row = {"from": low, "to": high, "planes": len(own), "median": median, "nine in ten": most}
        yield row | {"error": own["error"].median()}


def fit():
    """Fit S, and find its misfits on the planes held out."""
    found = planes()
    held = found["plane"] % HELD_OUT == 0
    best = fitted(found[~held], [*coefficients().values()])
    names = DataFrame([*coefficients()], columns=["to", "times"])
    stored(FITTED, names.assign(value=[f"{each:.4g}" for each in best]))
    stored(RESULTS / "law/share.csv", misfits(found[held], best))


def main(only=""):
    """Solve what is not solved yet, write what was found, and fit."""
    if not only:
        found = list(contacts())
        stored(TABLE, rows(found, solved(TABLE, [task for each in found for task in each.tasks])))
    fit()


if __name__ == "__main__":
    main(*sys.argv[1:])
