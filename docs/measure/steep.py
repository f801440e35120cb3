"""The law of friction in the regime of the paper: steep sphere and cone, from slow to the plateau, against 3D.

python docs/measure/steep.py   solves what is not solved yet, and writes results/law/steep.csv
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import pi

import numpy as np
from planes import PAGE as PLANES
from tables import friction, solved, stored

from bem3d import BEM
from compare.solving.task import SceneTask, draws_of
from compare.statistics.intervals import student
from compare.studies.comparison.study_file import STUDIES
from compare.trustmap.friction_law import FrictionLaw
from scene import Scene, Slide

PAGE = PLANES.with_name("steep.md")
SPEEDS = 0.06, 0.3, 1.0, 3.5, 12.0, 35.0, 100.0  # v tau q_s
# Points a side, 9 pixels to the shortest wave and more; surfaces, and those on twice the points too.
POINTS, SURFACES, FINER = 960, 4, 1
# Contacts that are solved on four times the points, too; and what a grid leaves, over its change from twice the
# pixel: a third, as an error of order two does. Where four times the points were solved it is 0.06 to 0.2.
FINEST, LEFT = (("sphere", 0.9, 12.0), ("sphere", 0.9, 100.0)), 1 / 3


@dataclass(frozen=True)
class SteepContact:
    """One contact: body, load [N], v tau q_s, and its scene."""

    body: str
    load: float
    speed: float
    scene: Scene

    @property
    def tasks(self) -> tuple[SceneTask, ...]:
        """All surfaces; few of them; these on twice the points; on four times."""
        finest = SceneTask(BEM(points=4 * POINTS), draws_of(self.scene, FINER), work=16.0)
        return (
            SceneTask(BEM(points=POINTS), draws_of(self.scene, SURFACES), work=2.0),
            SceneTask(BEM(points=POINTS), draws_of(self.scene, FINER)),
            SceneTask(BEM(points=2 * POINTS), draws_of(self.scene, FINER), work=4.0),
            *([finest] if (self.body, self.load, self.speed) in FINEST else []),
        )


def contacts() -> Iterator[SteepContact]:
    """Sphere and cone under the least and the greatest load, at each speed."""
    for series in STUDIES["regime"].series("full")[::3]:
        body, scene, (low, *_, high) = series.name, series.scene, series.values
        unit = scene.roughness.shortest / (2 * pi * scene.elastomer.relaxation_time)
        for speed in SPEEDS:
            for load in (low, high):
                slides = Slide(speed=speed * unit, load=load)
                yield SteepContact(body, load, speed, replace(scene, motion=slides))


def main() -> None:
    """Solve what is not solved yet, and write friction in 3D, on ever finer grids, and by the law."""
    found = list(contacts())
    outcomes = solved(PAGE, [task for each in found for task in each.tasks])
    rows = []
    for each in found:
        mean, few, fine, *finest = (friction(outcomes[task].rows) for task in each.tasks)
        change = float(fine.value / few.value - 1)
        mu = float(mean.value) * (1 + (1 + LEFT) * change)
        law = FrictionLaw().solve(each.scene)
        full = law.measures["full_contact_friction"]
        # What the roughness adds, over that in full contact: the master curve.
        force, error = mu * law.normal_force, float(mean.error / mean.value)
        added = force - law.measures["friction_of_shape"]
        # Ends of 95 %: the surfaces, and as much as the grid was taken to leave.
        half = force * (student(0.95, SURFACES - 1) * error + LEFT * abs(change))
        rows.append(
            {
                "body": each.body,
                "load": each.load,
                "speed": each.speed,
                "friction": mu,
                "error": error,
                "finer": change,
                "finest": float(finest[0].value / fine.value - 1) if finest else np.nan,
                "law": law.measures["bare_friction"],
                "x": law.measures["pressure_ratio"],
                "measured_share": added / full,
                "measured_share_low": (added - half) / full,
                "measured_share_high": (added + half) / full,
                "averaged_share": law.measures["friction_of_roughness"] / full,
            }
        )
    stored(PAGE.with_suffix(".csv"), rows)


if __name__ == "__main__":
    main()
