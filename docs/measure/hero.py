"""The figure of the README: a rough contact in three dimensions and in one, and friction against load in both.

The contact is the steep sphere of docs/results/law.md, in the regime of the paper. It is solved each time, in
seconds; friction is read from hero.csv, and solved again, in minutes, where that is deleted. The master curve in
three dimensions is drawn of steep sphere and cone, from law/steep.csv.
"""

import shutil
from dataclasses import replace
from io import BytesIO
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from PIL import Image
from tables import RESULTS, friction, solved, stored, task

import compare
from bem3d import BEM
from compare.figures import contact, style
from compare.figures.curves import intervals
from compare.figures.shades import SPEED, between
from compare.report.csvfiles import read
from compare.studies.comparison.study_file import STUDIES
from mdr1d import MDR, equations
from scene import Kelvin, Scene, Slide, Sphere

PAGE, NUMBERS, STEEP_CONTACTS = (RESULTS / name for name in ("hero.png", "hero.csv", "law/steep.csv"))
STEEP = STUDIES["regime"].series("full")[0]
SCENE = replace(STEEP.scene, roughness=replace(STEEP.scene.roughness, seed=0))
LEAST, *_, MOST = STEEP.values
LOADS, SPEEDS = np.geomspace(LEAST, MOST, 4), (1e-4, 2e-4, 4e-4, 8e-4)
LINE, SPACE = MDR(points=5000), BEM(points=480)
DRAWS = {LINE: 30, SPACE: 3}
SHOWN = replace(SCENE, motion=Slide(speed=4e-4, load=0.4))
# The contact of the picture of `crosscheck draw`, draw.png.
SLIDING = Scene(Sphere(10e-3), Kelvin(1e6, 1e-3), Slide(speed=1.0, load=1.0))
SPAN, WIDTH = 1.6e-3, 1440  # of the springs, to either side [m]; of the file, in pixels


def main():
    """Solve what is missing, draw, and write the figure."""
    if not NUMBERS.exists():
        stored(NUMBERS, measured())
    fields = {solver.name: solver.solve(SHOWN).fields for solver in (LINE, SPACE)}
    with style.applied():
        shown = contact.plot(SHOWN, contact.view(SHOWN, SPACE, fields))
        drawing = figure(shown, read(NUMBERS), read(STEEP_CONTACTS))
        image = BytesIO()
        drawing.savefig(image, dpi=WIDTH / drawing.get_figwidth())
    Image.open(image).convert("RGB").save(PAGE, optimize=True)
    with TemporaryDirectory() as folder:
        compare.draw(SLIDING, output=folder, workers=1)
        shutil.copy(Path(folder) / "contact.png", PAGE.with_name("draw.png"))


def figure(plot, numbers, steep):
    """(a) Contact in 3D, (b) row of springs, (c), (d) friction of both over the shifted load, (e) master curve."""
    drawing = style.canvas("double", 4.6)
    upper, lower = drawing.subfigures(2, 1, height_ratios=(1.25, 1))
    left, right = upper.subplots(1, 2, width_ratios=(1, 1.6))
    space, row = (plot.tables[contact.SECTIONS[solver]] for solver in ("BEM", "MDR"))
    contact.pressure_map(left, plot.tables[contact.PRESSURE], space["x"], plot.options["aside"])
    left.set_title("(a) 3D: pressure")
    contact.section(right, row, "MDR", (-SPAN, SPAN), contact.heights_of([row]), 45)
    right.set_title("(b) 1D: springs")
    above, below, last = lower.subplots(1, 3)
    for axes, solver, title in ((above, "MDR", "(c) 1D: one curve"), (below, "BEM", "(d) 3D: no such curve")):
        against_load(axes, numbers[numbers["solver"] == solver], solver)
        axes.set(title=title, xlabel="load $F_N\\,p(v)$ [N]", ylabel="friction coefficient μ [1]")
    below.text(0.012, 9e-4, "Eq. 17", fontsize=style.small(), ha="center", va="top")
    above.text(1.5, 2e-2, "dashed: Eq. 17", fontsize=style.small(), ha="right")
    for speed, chosen in numbers[numbers["solver"] == "BEM"].groupby("speed"):
        end = chosen.iloc[-1]
        text = f"{1e3 * speed:g}{' mm/s' * (speed == SPEEDS[-1])}"
        note(below, text, (shifted(end["load"], speed), end["friction"]), (5, 1))
    master_curve(last, steep)
    return drawing


def master_curve(axes, steep):
    """What roughness adds in 3D, over that in full contact, against the pressure; line, the law."""
    scale = between(steep["speed"])
    grey = style.line(0.6, 2.5, linestyle="-")
    for (body, own), marker in zip(steep.groupby("body", sort=False), style.SERIES_MARKERS, strict=False):
        mark = {"linestyle": "none", "marker": marker}
        for speed, chosen in own.groupby("speed"):
            axes.loglog(chosen["x"], chosen["averaged_share"], **grey, zorder=1)
            intervals(axes, chosen["x"], chosen, "measured_share", color=SPEED(scale(speed)), **mark)
        axes.plot([], [], color=style.grey(0.3), label=body, **mark)
    axes.plot([], [], label="law", **grey)
    axes.legend(fontsize=style.small(), loc="upper left")
    for row, speed, place in ((0, "slow", (0, -14)), (-1, "fast", (20, 0))):
        end = steep.sort_values("speed").iloc[row]
        note(axes, speed, (end["x"], end["measured_share"]), place)
    axes.set(xlabel="pressure / full contact [1]", ylabel="friction / full contact [1]", title="(e) 3D: the law")
    tell(axes, steep, "measured_share", 0.97, "right")


def against_load(axes, numbers, solver):
    """Friction at each speed against the load that Eq. 23 shifts to the lowest one; dashed, Eq. 17."""
    axes.set(xscale="log", yscale="log", xlim=(6e-3, 2.2), ylim=(5e-5, 6e-2))
    shades = style.shades(solver, len(SPEEDS))
    for speed, colour, marker in zip(SPEEDS, shades, style.SERIES_MARKERS, strict=False):
        chosen = numbers[numbers["speed"] == speed]
        intervals(axes, shifted(chosen["load"], speed), chosen, "friction", color=colour, marker=marker)
    loads = shifted(np.array([LEAST, MOST]), np.array([SPEEDS[-1], SPEEDS[0]]))
    slope, solid = SCENE.roughness.rms_slope(2 * np.pi / SCENE.roughness.shortest), SCENE.elastomer
    law = equations.low_speed_friction(
        loads, solid.modulus, solid.relaxation_time, SPEEDS[0], slope, SCENE.indenter.mdr_coefficient, 2
    )
    axes.plot(loads, law, **style.line(0.3, 0.7, linestyle=(0, (5, 3)), zorder=1))
    tell(axes, numbers, "friction")


def note(axes, text, place, offset):
    """Text next to a place of a panel."""
    axes.annotate(text, place, offset, fontsize=style.small(), textcoords="offset points", va="center")


def tell(axes, numbers, name, place=0.04, side="left"):
    """The widest interval of a panel in words: most bars are shorter than the markers."""
    most = ((numbers[f"{name}_high"] - numbers[f"{name}_low"]) / numbers[name]).max() / 2
    words = f"95 %: at most ±{100 * most:.0f} %"
    axes.text(place, 0.04, words, fontsize=style.small(), transform=axes.transAxes, ha=side)


def shifted(load, speed):
    """Load times p(v) of Eq. 23 in the limit of low speed, p = 1 at the lowest speed."""
    return load * (speed / SPEEDS[0]) ** equations.force_shift_exponent(1.0, SCENE.indenter.exponent)


def measured():
    """Mean friction over mean load of some rough surfaces, with its interval, at each speed and load by model."""
    tasks = {
        (solver, speed, load): task(solver, replace(SCENE, motion=Slide(speed=speed, load=load)), draws)
        for solver, draws in DRAWS.items()
        for load in LOADS.tolist()
        for speed in SPEEDS
    }
    outcomes = solved(PAGE, tasks.values())
    for (solver, speed, load), asked in tasks.items():
        row = {"solver": solver.name, "speed": speed, "load": load}
        yield row | friction(outcomes[asked].rows).columns("friction")


if __name__ == "__main__":
    main()
