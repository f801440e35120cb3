"""The sphere of Fig. 1 with every wave of the paper's spectrum: writes docs/spectrum.md and docs/spectrum.csv.

What has been solved once is in docs/spectrum/solved; from nothing it takes twenty minutes and 10 GB of memory.
"""

from dataclasses import replace
from math import nan, pi
from pathlib import Path

from pandas import DataFrame
from rich.console import Console
from tables import table

from bem3d import BEM
from compare.csvfiles import text, write_text
from compare.progress import Watched
from compare.runner import sweep
from compare.store import Store
from compare.studies.paper import parameters
from compare.task import SceneTask, draws_of
from mdr1d import MDR
from scene.scales import elastic_contact

PAGE = Path(__file__).with_suffix(".md")
# Points a side in three dimensions, two pixels a wave at least, and along the line; profiles.
FINER, ONE, PROFILES = (2100, 4096, 8192), 11000, 20
INTRODUCTION = """# The spectrum of the paper, once

The sphere of Fig. 1 with all waves of the paper's own spectrum, down to two of its pixels, 4 µm: 1 N, 0.1 m/s, one
surface. Its rms slope is far beyond any linear theory; the numbers say what the model makes of it. In 1D, means of
20 profiles. Written by `python docs/spectrum.py`.

"""
HEADER = "|points|friction|by traction, by loss|depth [µm]|real over nominal contact|rms slope|processor time [s]"


def main() -> None:
    """Solve what is not solved yet, and write the page and its table."""
    scene = parameters.contact("sphere")
    shortest = 2 * parameters.LENGTH / parameters.POINTS
    scene = replace(scene, roughness=replace(scene.roughness, shortest=shortest))
    first = replace(scene, roughness=replace(scene.roughness, seed=1))
    tasks = [SceneTask(BEM(points=points), (scene,)) for points in FINER]
    tasks.append(SceneTask(MDR(points=ONE), draws_of(first, PROFILES)))
    with Watched(Console()) as progress:
        # The finest takes 10 GB: one at a time.
        swept = sweep(tasks, Store(PAGE.with_suffix("") / "solved"), workers=1, progress=progress)
    rows = [_row(task, swept.outcomes[task].rows) for task in tasks]
    write_text(PAGE.with_suffix(".csv"), text(DataFrame(rows)))
    write_text(PAGE, INTRODUCTION + table(HEADER, map(_line, rows)) + "\n")


def _row(task, solved):
    """Means over surfaces or profiles."""
    nominal, mean = elastic_contact(task.scenes[0]).radius, DataFrame([row.measures for row in solved]).mean()
    three, count = isinstance(task.solver, BEM), len(solved)
    force = solved[0].normal_force
    return {
        "dimension": "3D" if three else "1D",
        "points": task.solver.points,
        "friction": sum(row.friction_coefficient for row in solved) / count,
        "depth": sum(row.depth for row in solved) / count,
        "contact": mean["contact_area"] / (pi * nominal**2) if three else mean["contact_length"] / (2 * nominal),
        "rms_slope": solved[0].measures["rms_slope"],
        "by_traction": mean["friction_by_traction"] / force if three else nan,
        "by_loss": mean["friction_by_loss"] / force if three else nan,
        "seconds": sum(row.seconds for row in solved),
    }


def _line(row):
    ways = f"{row['by_traction']:.2f}, {row['by_loss']:.2f}" if row["dimension"] == "3D" else ""
    numbers = (f"{row['points']}", f"{row['friction']:.2f}", ways, f"{1e6 * row['depth']:.1f}")
    return row["dimension"], *numbers, f"{row['contact']:.2%}", f"{row['rms_slope']:.2f}", f"{row['seconds']:.0f}"


if __name__ == "__main__":
    main()
