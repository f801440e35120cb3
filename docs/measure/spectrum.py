"""Bodies of Fig. 1 with every wave of the paper's spectrum: writes docs/results/spectrum.md, .csv and the figure.

What has been solved once is in docs/results/spectrum/solved; from nothing it takes an hour and 8 GB of memory.
"""

from dataclasses import dataclass, replace
from math import nan, pi
from pathlib import Path

import numpy as np
from campaign import solved
from matplotlib.patches import Circle
from pandas import DataFrame
from tables import limit, replaced, table

from bem3d import BEM, refined
from compare.report.csvfiles import text, write_text
from compare.report.plots import style
from compare.solving.task import SceneTask, draws_of
from compare.studies.paper import parameters
from mdr1d import MDR
from scene import Result, Scene
from scene.scales import elastic_contact

PAGE = Path(__file__).parents[1] / "results" / "spectrum.md"
ONE, PROFILES = 11000, 20  # points of the line, and profiles
GRIDS, TIMES = (2048, 4096), (2, 4)  # solved on all pixels; pixels of the last of them refined so many times
SHAPES = "sphere", "cone"
SIDES = 3.6e-3, 0.3e-3, 0.012e-3  # of the panels of the figure [m]
HEADER = (
    "|points|pixels a wave|friction|by traction|by loss|depth [µm]|real over nominal contact|points in contact|"
    "processor time [s]"
)


@dataclass(frozen=True)
class Refined:
    """A grid, and the points in contact refined `times` below it."""

    solver: BEM
    times: int
    name = "BEM"
    packages = "bem3d", "scene"

    @property
    def points(self) -> int:
        """Points along a side that as fine a grid would have."""
        return self.times * self.solver.points

    def solve(self, scene: Scene) -> Result:
        """Contact on the grid, then refined."""
        return refined(self.solver, self.solver.solve(scene), self.times)


def main() -> None:
    """Solve what is not solved yet, and write the page, its table and its figure."""
    tasks = {shape: _tasks(shape) for shape in SHAPES}
    # The finest takes 8 GB: one at a time.
    outcomes = solved(PAGE, [task for each in tasks.values() for task in each], workers=1)
    rows = [_row(shape, task, outcomes[task].rows) for shape, each in tasks.items() for task in each]
    frame = DataFrame(rows)
    write_text(PAGE.with_suffix(".csv"), text(frame))
    for shape in SHAPES:
        own = frame[frame["shape"] == shape]
        replaced(PAGE, shape, table(HEADER, map(_line, own.itertuples())) + "\n\n" + sentence(shape, own))
    finest = tasks["sphere"][-2]
    with style.applied():
        drawing = _figure(finest.scenes[0], outcomes[finest])
        drawing.savefig(PAGE.with_suffix(".png"), dpi=200)


def _tasks(shape):
    """Contacts in three dimensions, from coarse to fine, and in one."""
    scene = parameters.contact(shape)
    shortest = 2 * parameters.LENGTH / parameters.POINTS
    scene = replace(scene, roughness=replace(scene.roughness, shortest=shortest))
    first = replace(scene, roughness=replace(scene.roughness, seed=1))
    solvers = [
        *(BEM(points=points) for points in GRIDS),
        *(Refined(BEM(points=GRIDS[-1]), each) for each in TIMES),
    ]
    kept = [SceneTask(each, (scene,), keeps_fields=isinstance(each, Refined)) for each in solvers]
    return [*kept, SceneTask(MDR(points=ONE), draws_of(first, PROFILES))]


def _row(shape, task, rows):
    """Means over surfaces or profiles."""
    nominal, mean = elastic_contact(task.scenes[0]).radius, DataFrame([row.measures for row in rows]).mean()
    three, count = not isinstance(task.solver, MDR), len(rows)
    force = rows[0].normal_force
    return {
        "shape": shape,
        "dimension": "3D" if three else "1D",
        "points": task.solver.points,
        "pixels_a_wave": mean.get("points_per_shortest_wave", nan),
        "friction": sum(row.friction_coefficient for row in rows) / count,
        "depth": sum(row.depth for row in rows) / count,
        "contact": mean["contact_area"] / (pi * nominal**2) if three else mean["contact_length"] / (2 * nominal),
        "contact_points": mean.get("contact_points", nan),
        "rms_slope": mean.get("rms_slope", nan),
        "by_traction": mean["friction_by_traction"] / force if three else nan,
        "by_loss": mean["friction_by_loss"] / force if three else nan,
        "seconds": sum(row.seconds for row in rows),
    }


def _line(row):
    three = row.dimension == "3D"
    numbers = (
        f"{row.points}",
        f"{row.pixels_a_wave:.1f}" if three else "",
        f"{row.friction:.2f}",
        f"{row.by_traction:.2f}" if three else "",
        f"{row.by_loss:.2f}" if three else "",
        f"{1e6 * row.depth:.1f}",
        f"{row.contact:.3%}",
        f"{row.contact_points:.0f}" if three else "",
        f"{row.seconds:.0f}",
    )
    return row.dimension, *numbers


def sentence(shape: str, own: DataFrame) -> str:
    """Friction between what both estimates come to, and that in 1D."""
    three, (one,) = own[own["dimension"] == "3D"], own[own["dimension"] == "1D"].itertuples()
    last, limits = three.iloc[-1], [limit(three[name].to_numpy()) for name in ("by_traction", "by_loss")]
    known = [last["by_loss"], last["by_traction"], *(each for each in limits if np.isfinite(each))]
    low, high, slope = min(known), max(known), three["rms_slope"].iloc[0]
    return (
        f"Friction of the {shape} is {(low + high) / 2:.2f} ({low:.2f} to {high:.2f}) in 3D on this surface, and "
        f"{one.friction:.2f} in 1D. The rms slope of {slope:.1f} is far beyond any linear theory."
    )


def _figure(scene, outcome):
    """Real contact on the finest pixels at three magnifications."""
    x, y, pressure = (outcome.fields[name] for name in ("x", "y", "pressure"))
    pixel, radius = outcome.rows[0].measures["pixel"], elastic_contact(scene).radius
    # The point with most others within a spot, away from the rim.
    near = np.hypot(x[:, None] - x, y[:, None] - y) < SIDES[2] / 2
    middle = int(np.argmax(near.sum(axis=0) * (np.hypot(x, y) < radius / 2)))
    drawing = style.canvas("double", 2.6)
    for axes, letter, side in zip(drawing.subplots(1, 3), "abc", SIDES, strict=True):
        centre = (0.0, 0.0) if side == SIDES[0] else (x[middle], y[middle])
        unit, scale = ("mm", 1e3) if side == SIDES[0] else ("µm", 1e6)
        off = np.stack([x - centre[0], y - centre[1]])
        here = (np.abs(off) < side / 2).all(axis=0)
        # A pixel is drawn as large as it is, and no smaller than can be seen.
        area = max((pixel / side * 130) ** 2, 0.3)
        drawn = axes.scatter(
            *(scale * off[:, here]), s=area, c=pressure[here] / 1e6, marker="s", linewidths=0, cmap="viridis_r",
            vmin=0, vmax=np.percentile(pressure, 95) / 1e6,
        )  # fmt: skip
        if side == SIDES[0]:
            axes.add_patch(Circle((0, 0), scale * radius, fill=False, **style.line(0.4, 0.6)))
        half = scale * side / 2
        axes.set(xlim=(-half, half), ylim=(-half, half), aspect="equal")
        axes.set(xlabel=f"x [{unit}]", ylabel=f"y [{unit}]", title=f"({letter}) {scale * side:g} {unit} wide")
    drawing.colorbar(drawn, ax=drawing.axes, label="pressure [MPa]", extend="max")
    return drawing


if __name__ == "__main__":
    main()
