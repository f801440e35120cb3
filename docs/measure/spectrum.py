"""Bodies of Fig. 1 with every wave of the paper's spectrum: for docs/results/answers.md.

What has been solved once is in docs/results/answers/spectrum/solved; from nothing it takes an hour and 8 GB of
memory.
"""

from dataclasses import dataclass, replace
from math import nan

import numpy as np
import pandas
from matplotlib.patches import Circle
from pandas import DataFrame
from tables import RESULTS, limit, solved, stored

from bem3d import BEM, refined
from compare.figures import style
from compare.solving.task import SceneTask, draws_of
from compare.studies.paper import parameters
from mdr1d import MDR
from scene.scales import elastic_contact

TABLE = RESULTS / "answers/spectrum.csv"
ONE, PROFILES = 11000, 20  # points of the line, and profiles
GRID, TIMES = 4096, (2, 4)  # points a side, all solved; factors by which points that touch are refined
SHAPES = "sphere", "cone"
ESTIMATES = ["by_traction", "by_loss"]
SIDES = 3.6e-3, 0.012e-3  # of the maps of the figure [m]


@dataclass(frozen=True)
class Refined:
    """A grid, and the points in contact refined `times` below it."""

    solver: BEM
    times: int
    name = "BEM"
    packages = "bem3d", "scene"

    @property
    def points(self):
        """Points along a side that as fine a grid would have."""
        return self.times * self.solver.points

    def solve(self, scene):
        """Contact on the grid, then refined."""
        return refined(self.solver, self.solver.solve(scene), self.times)


def main():
    """Solve what is not solved yet, and write the table and the figure."""
    tasks = {shape: _tasks(shape) for shape in SHAPES}
    # The finest takes 8 GB: one at a time.
    outcomes = solved(TABLE, [task for each in tasks.values() for task in each], workers=1)
    frame = DataFrame(_row(shape, task, outcomes[task].rows) for shape, each in tasks.items() for task in each)
    stored(TABLE, frame)
    finest = tasks["sphere"][-2]
    with style.applied():
        drawing = figure(frame, finest.scenes[0], outcomes[finest])
        drawing.savefig(TABLE.with_suffix(".png"), dpi=200)


def _tasks(shape):
    """Contacts in three dimensions, from coarse to fine, and in one."""
    scene = parameters.contact(shape)
    shortest = 2 * parameters.LENGTH / parameters.POINTS
    scene = replace(scene, roughness=replace(scene.roughness, shortest=shortest))
    first = replace(scene, roughness=replace(scene.roughness, seed=1))
    solvers = [BEM(points=GRID), *(Refined(BEM(points=GRID), each) for each in TIMES)]
    kept = [SceneTask(each, (scene,), keeps_fields=isinstance(each, Refined)) for each in solvers]
    return [*kept, SceneTask(MDR(points=ONE), draws_of(first, PROFILES))]


def _row(shape, task, rows):
    """Means over surfaces or profiles."""
    mean = DataFrame([row.measures | {"friction": row.friction_coefficient} for row in rows]).mean()
    three = task.solver.name == "BEM"
    return {
        "shape": shape,
        "dimension": "3D" if three else "1D",
        "points": task.solver.points,
        "pixels_a_wave": mean.get("points_per_shortest_wave", nan),
        "friction": mean["friction"],
        "rms_slope": mean.get("rms_slope", nan),
        **{name: mean[f"friction_{name}"] / rows[0].normal_force if three else nan for name in ESTIMATES},
    }


def sentences():
    """Friction of both bodies in 3D, between its estimates, and in 1D, from what is stored."""
    found, said = pandas.read_csv(TABLE), []
    for shape, own in found.groupby("shape", sort=False):
        three, (one,) = own[own["dimension"] == "3D"], own[own["dimension"] == "1D"]["friction"]
        (low, high), slope = ends(three), three["rms_slope"].iloc[0]
        said.append(
            f"Friction of the {shape} is {(low + high) / 2:.2f} ({low:.2f} to {high:.2f}) in 3D on this surface, "
            f"and {one:.2f} in 1D. The rms slope of {slope:.1f} is far beyond any linear theory."
        )
    return " ".join(said)


def ends(three):
    """Interval of friction: both estimates on the finest grid, and the limits of those that show one."""
    known = [*three[ESTIMATES].iloc[-1], *map(limit, three[ESTIMATES].to_numpy().T)]
    return np.nanmin(known), np.nanmax(known)


def figure(frame, scene, outcome):
    """Real contact of a scene on the finest pixels, at two magnifications; friction on ever finer grids."""
    x, y, pressure = (outcome.fields[name] for name in ("x", "y", "pressure"))
    pixel, radius = outcome.rows[0].measures["pixel"], elastic_contact(scene).radius
    # The point with most others within a spot, away from the rim.
    near = np.hypot(x[:, None] - x, y[:, None] - y) < SIDES[1] / 2
    spot = np.argmax(near.sum(axis=0) * (np.hypot(x, y) < radius / 2))
    drawing = style.canvas("double", 3.0)
    left, right = drawing.subfigures(1, 2, width_ratios=(1.6, 1))
    whole, close = panels = left.subplots(1, 2)
    for axes, letter, side, middle, unit, scale in (
        (whole, "a", SIDES[0], (0.0, 0.0), "mm", 1e3),
        (close, "b", SIDES[1], (x[spot], y[spot]), "µm", 1e6),
    ):
        off = np.stack([x - middle[0], y - middle[1]])
        here = (np.abs(off) < side / 2).all(axis=0)
        # A pixel is drawn as large as it is, and no smaller than can be seen.
        area = max((pixel / side * 130) ** 2, 0.3)
        drawn = axes.scatter(
            *(scale * off[:, here]), s=area, c=pressure[here] / 1e9, marker="s", linewidths=0, cmap="viridis_r",
            vmin=0, vmax=np.percentile(pressure, 95) / 1e9,
        )  # fmt: skip
        half = scale * side / 2
        axes.set(xlim=(-half, half), ylim=(-half, half), aspect="equal")
        axes.set(xlabel=f"x [{unit}]", ylabel=f"y [{unit}]", title=f"({letter}) {scale * side:g} {unit} wide")
    whole.add_patch(Circle((0, 0), 1e3 * radius, fill=False, **style.line(0.4, 0.6)))
    whole.plot(1e3 * x[spot], 1e3 * y[spot], "o", color=style.ink(), markersize=8, markerfacecolor="none")
    place = {"location": "bottom", "aspect": 40, "shrink": 0.7, "extend": "max"}
    left.colorbar(drawn, ax=panels, label="pressure [GPa]", **place)
    _friction(right.subplots(), frame)
    return drawing


def _friction(axes, frame):
    """Both estimates over the pixels, the answer with its interval at right, and one dimension."""
    for (shape, own), marker in zip(frame.groupby("shape", sort=False), style.SERIES_MARKERS, strict=False):
        three, (one,) = own[own["dimension"] == "3D"], own[own["dimension"] == "1D"].itertuples()
        colour = style.colour("BEM")
        for name, line, inside in zip(ESTIMATES, ("-", "--"), (colour, style.paper()), strict=True):
            look = {"color": colour, "marker": marker, "markerfacecolor": inside}
            axes.plot(three["pixels_a_wave"], three[name], line, label=f"3D, {name.replace('_', ' ')}", **look)
        low, high = ends(three)
        answer = {"color": style.ink(), "marker": marker, "linestyle": "none", "label": "3D, answer"}
        axes.errorbar(30, (low + high) / 2, (high - low) / 2, **answer)
        axes.axhline(one.friction, **style.line(0, 0.7, color=style.colour("MDR"), linestyle=":"), label="1D")
        axes.text(60, one.friction + 0.15, shape, fontsize=style.small(), ha="right", color=style.colour("MDR"))
        axes.text(36, (low + high) / 2 - 0.2, shape, fontsize=style.small(), va="center")
    axes.set(
        xscale="log", xlim=(3.4, 64), ylim=(0, 18), xlabel="pixels a wave [1]", ylabel="friction coefficient [1]"
    )
    axes.set_title("(c) friction, finer and finer")
    style.decades(axes)
    style.legend(axes.figure, [axes], 2)


if __name__ == "__main__":
    main()
