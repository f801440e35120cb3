"""The figure of the README: a rough contact in three dimensions and in one, and friction against load in both.

The contact is the steep sphere of docs/slow.md, in the regime of the paper. It is solved each time, in
seconds; friction is read from hero.csv, and solved again, in
minutes, where that is deleted.
"""

from collections.abc import Iterator
from dataclasses import replace
from io import BytesIO
from pathlib import Path

import numpy as np
import pandas
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from PIL import Image

from bem3d import BEM, Trail
from compare.csvfiles import read, text, write_text
from compare.plots import draw, style
from compare.studies.contacts import STEEP
from compare.studies.draw import datasets
from compare.task import draws_of
from compare.views import view
from mdr1d import MDR, equations
from scene import Slide

PAGE = Path(__file__).with_suffix(".png")
NUMBERS = PAGE.with_suffix(".csv")
SCENE, (LEAST, MOST) = STEEP["sphere"]
LOADS, SPEEDS = np.geomspace(LEAST, MOST, 4), (1e-4, 2e-4, 4e-4, 8e-4)
LINE, SPACE = MDR(points=5000), BEM(points=480)
DRAWS = {LINE: 30, SPACE: 3}
SHOWN = replace(SCENE, motion=Slide(speed=4e-4, load=0.4))
WIDTH, COLOURS = 1440, 200  # of the file, in pixels, and how many


def main() -> None:
    """Solve what is missing, draw, and write the figure."""
    if not NUMBERS.exists():
        write_text(NUMBERS, text(pandas.DataFrame(solved())))
    fields = {solver.name: solver.solve(SHOWN).fields for solver in (LINE, SPACE)}
    seen = view(SHOWN, SPACE, fields)
    with style.applied():
        drawing = figure(draw.plot(SHOWN, *datasets(seen, fields["MDR"])), read(NUMBERS))
        image = BytesIO()
        drawing.savefig(image, dpi=WIDTH / drawing.get_figwidth())
    Image.open(image).convert("RGB").quantize(COLOURS).save(PAGE, optimize=True)


def figure(plot, numbers: pandas.DataFrame) -> Figure:
    """(a) The surface in 3D, (b) the row of springs, (c) and (d) friction of both against the shifted load."""
    drawing = style.canvas("double", 3.3)
    left, middle, right = drawing.subfigures(1, 3, width_ratios=(1.5, 0.85, 1.1))
    tables, options = plot.tables, plot.options
    draw.surface(left, left.subplots(), tables[draw.SURFACE], options["enlarged"], options["highest"], 1, "(a) 3D")
    springs = middle.subplots()
    draw.row(springs, tables[draw.ROW], tables[draw.LINES], tables[draw.LINES]["x"].to_numpy()[[0, -1]])
    springs.set_title("(b) 1D: row of springs")
    above, below = right.subplots(2, 1, sharex=True, sharey=True)
    for axes, solver, title in ((above, "MDR", "(c) 1D: one curve"), (below, "BEM", "(d) 3D: no common curve")):
        against_load(axes, numbers[numbers["solver"] == solver], solver)
        axes.set_title(title)
    below.set_xlabel("load $F_N\\,p(v)$ [N]")
    return drawing


def against_load(axes: Axes, numbers: pandas.DataFrame, solver: str) -> None:
    """Friction at each speed against the load that Eq. 23 shifts to the lowest one."""
    exponent = equations.force_shift_exponent(1.0, SCENE.indenter.exponent)
    shades = style.shades(solver, len(SPEEDS))
    for speed, colour, form in zip(SPEEDS, shades, style.forms(), strict=False):
        chosen = numbers[numbers["speed"] == speed]
        shifted = chosen["load"] * (speed / SPEEDS[0]) ** exponent
        axes.loglog(shifted, chosen["friction"], color=colour, marker=form["marker"], linestyle="-")
        axes.text(shifted.iloc[0], chosen["friction"].iloc[0], f"{1e3 * speed:g}")
    axes.set_ylabel("friction μ")


def solved() -> Iterator[dict[str, float | str]]:
    """Mean friction over mean load of some rough surfaces, at each speed and load in each model."""
    for solver, draws in DRAWS.items():
        trails = [Trail() for _ in range(draws)]
        for load in LOADS:
            for speed in SPEEDS:
                scenes = draws_of(replace(SCENE, motion=Slide(speed=speed, load=float(load))), draws)
                results = [
                    solver.solve(scene, *([trail] if solver is SPACE else []))
                    for scene, trail in zip(scenes, trails, strict=True)
                ]
                force, friction = (
                    sum(getattr(each, name) for each in results) for name in ("normal_force", "friction_force")
                )
                print(solver.name, load, speed, friction / force, flush=True)
                yield {"solver": solver.name, "speed": speed, "load": load, "friction": friction / force}


if __name__ == "__main__":
    main()
