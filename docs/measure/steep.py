"""The law of friction in the regime of the paper: steep sphere and cone, from slow to the plateau, against 3D.

python docs/measure/steep.py   solves what is not solved yet, and writes results/law/steep.csv
"""

from dataclasses import replace
from math import pi

from tables import RESULTS, friction, solved, stored, task

from bem3d import BEM
from compare.statistics.intervals import student
from compare.studies.comparison.study_file import STUDIES
from compare.trustmap.friction_law import FrictionLaw
from scene import Slide

TABLE = RESULTS / "law/steep.csv"
SPEEDS = 0.06, 0.3, 1.0, 3.5, 12.0, 35.0, 100.0  # v tau q_s
# Points a side, 9 pixels to the shortest wave and more; surfaces, and those on twice the points too.
POINTS, SURFACES, FINER = 960, 4, 1
# What a grid leaves, over its change from twice the pixel: as an error of order two does. Where four times the
# points were solved it was 0.06 to 0.2.
LEFT = 1 / 3


def contacts():
    """Body, load [N], v tau q_s, scene: sphere and cone under the least and the greatest load, at each speed."""
    for series in STUDIES["regime"].series("full")[::3]:
        scene, (low, *_, high) = series.scene, series.values
        unit = scene.roughness.shortest / (2 * pi * scene.elastomer.relaxation_time)
        for speed in SPEEDS:
            for load in (low, high):
                yield series.name, load, speed, replace(scene, motion=Slide(speed=speed * unit, load=load))


def tasks(scene):
    """All surfaces; few of them; these on twice the points."""
    kinds = (POINTS, SURFACES), (POINTS, FINER), (2 * POINTS, FINER)
    return [task(BEM(points=points), scene, count) for points, count in kinds]


def main():
    """Solve what is not solved yet, and write friction in 3D, on ever finer grids, and by the law."""
    found = list(contacts())
    outcomes = solved(TABLE, [each for *_, scene in found for each in tasks(scene)])
    rows = (
        {"body": body, "load": load, "speed": speed}
        | shares(scene, *(outcomes[each].rows for each in tasks(scene)))
        for body, load, speed, scene in found
    )
    stored(TABLE, rows)


def shares(scene, *rows):
    """What the roughness adds, over that in full contact, with the ends of 95 %: the master curve."""
    mean, few, fine = map(friction, rows)
    change = fine.value / few.value - 1
    mu = mean.value * (1 + (1 + LEFT) * change)
    law = FrictionLaw().solve(scene)
    full, force = law.measures["full_contact_friction"], mu * law.normal_force
    added = force - law.measures["friction_of_shape"]
    # The scatter of surfaces, and as much as the grid was taken to leave.
    half = force * (student(0.95, SURFACES - 1) * (mean.error / mean.value) + LEFT * abs(change))
    return {
        "friction": mu,
        "x": law.measures["pressure_ratio"],
        "measured_share": added / full,
        "measured_share_low": (added - half) / full,
        "measured_share_high": (added + half) / full,
        "averaged_share": law.measures["friction_of_roughness"] / full,
    }


if __name__ == "__main__":
    main()
