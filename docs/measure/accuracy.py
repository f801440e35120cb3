"""Errors of both solvers against closed forms and other codes: numbers and figure of docs/results/accuracy.md.

python docs/measure/accuracy.py

The tests hold more closed forms: sliding in one dimension, waves pressed flat, full contact.
"""

from math import pi, radians, sqrt, tan
from pathlib import Path

import numpy as np
import pandas
from tables import fill, order, stored, table

from bem3d import BEM
from compare.figures import style
from compare.models.exact import indentation
from mdr1d import MDR
from scene import Cone, Elastic, Indent, Program, Scene, Slide, Sphere, Stage, StandardLinearSolid

PAGE = Path(__file__).parents[1] / "results" / "accuracy.md"
G, R, THETA, TAU, DEPTH = 1e6, 10e-3, radians(10), 1e-3, 1e-4
RADIUS = sqrt(R * DEPTH)
HERTZ = 4 / 3 * 4 * G * sqrt(R) * DEPTH**1.5
MOMENTS = 1.0, 1.9, 2.2, 2.5  # in time [s]
POINTS = (16, 23, 32, 45, 64, 91, 128, 181, 256)
REST, SLIDING, TIME = (PAGE.with_suffix("") / f"{name}.csv" for name in ("rest", "sliding", "time"))
# Sphere on a standard linear solid under a load: v tau_c [m], depth [m] and mu R [m] of two other codes.
PUBLISHED = {1e-4: (99.824e-6, 45.249e-6), 1e-3: (91.508e-6, 157.664e-6), 1e-2: (70.553e-6, 41.906e-6)}


def around(solver, a, points):
    """The solver with points across a contact of radius a [m]; BEM gets half as many more around it."""
    count = int(1.5 * points) if solver is BEM else points
    return solver(points=count, extent=2 * a * count / points * (1.01 if solver is MDR else 1))


def at_rest():
    """Relative error of the force at a depth, against Hertz and Sneddon."""
    forms = {
        "sphere (Hertz)": (Sphere(R), HERTZ, RADIUS),
        "cone (Sneddon)": (Cone(THETA), 2 / pi * 4 * G * DEPTH**2 / tan(THETA), 2 / pi * DEPTH / tan(THETA)),
    }
    for name, (indenter, force, a) in forms.items():
        for solver in (MDR, BEM):
            scene = Scene(indenter, Elastic(G), Indent(depth=DEPTH))
            for n in POINTS:
                error = abs(around(solver, a, n).solve(scene).normal_force / force - 1)
                yield {"shape": name, "solver": solver.__name__, "points": n, "error": error}


def sliding():
    """Depth and friction times radius [m] of a sphere in steady sliding under a load, in 3D."""
    for memory in PUBLISHED:
        motion = Slide(speed=memory / (2 * TAU), load=0.533333)
        result = BEM(points=192).solve(Scene(Sphere(R), StandardLinearSolid(G, 2 * G, TAU), motion))
        yield {"memory": memory, "depth": result.depth, "moment": result.friction_coefficient * R}


def in_time():
    """Relative error of the force of a body pressed in and drawn back at a constant rate, in 3D."""
    elastomer, times, depths = StandardLinearSolid(0.25, 1.25, 1.0), [0.0, 2.0, 4.0], [0.0, 0.2, 0.0]
    program = Program(stages=(Stage(duration=2.0, depth=0.2), Stage(duration=2.0, depth=0.0)))
    for shape, extent in ((Sphere(1.0), 1.5), (Cone(np.pi / 4), 0.4)):
        for points, steps in ((64, 40), (128, 80), (256, 160)):
            fields = BEM(points=points, extent=extent, steps=steps).solve(Scene(shape, elastomer, program)).fields
            found = np.interp(MOMENTS, fields["time"], fields["normal_force"])
            exact, _ = indentation.force_of_depth(shape, elastomer, times, depths, np.array(MOMENTS))
            errors = dict(zip(map("{:g}".format, MOMENTS), found / exact - 1, strict=True))
            yield {"shape": shape.type, "points": points} | errors


def parts():
    """Text between two comments of the page, by the name of the comment."""
    rest, slid, timed = (pandas.read_csv(each) for each in (REST, SLIDING, TIME))
    memory, moments = "v τ_c, mm|depth, mm|μR, mm|against other codes: depth|μR", "shape|t = 1 s|1.9 s|2.2 s|2.5 s"
    finest = timed[timed["points"] == timed["points"].max()].drop(columns="points")
    rows = ((shape, *(f"{each:+.2%}" for each in errors)) for shape, *errors in finest.itertuples(index=False))
    return {
        "rest": table("shape|solver|16 points|64 points|256 points|observed order", _at_rest(rest)),
        "sliding": table(memory, _sliding(slid)),
        "time": table(moments, rows),
    }


def _at_rest(found):
    for (shape, solver), own in found.groupby(["shape", "solver"], sort=False):
        shown = own.set_index("points")["error"][[16, 64, 256]].map("{:.1e}".format)
        errors = own["error"]
        yield shape, solver, *shown, f"{order(own['points'], errors):.1f}" if errors.min() > 1e-13 else "exact"


def _sliding(found):
    for row, published in zip(found.itertuples(), PUBLISHED.values(), strict=True):
        pairs = zip((row.depth, row.moment), published, strict=True)
        own = f"{1e3 * row.memory:g}", f"{1e3 * row.depth:.6f}", f"{1e3 * row.moment:.6f}"
        yield *own, *(f"{value / other - 1:+.3%}" for value, other in pairs)


def figure(rest, timed):
    """Error of the force at rest and in time, over the points."""
    drawing = style.canvas("double", 2.5)
    left, right = panels = drawing.subplots(1, 2)
    rest = rest[rest["error"] > 1e-13].assign(body=rest["shape"].str.split().str[0])
    timed = timed.assign(
        body=timed["shape"], solver="BEM", error=timed.filter(regex=r"^[\d.]+$").abs().max(axis=1)
    )
    for axes, found, ticks in ((left, rest, (16, 32, 64, 128, 256)), (right, timed, (64, 128, 256))):
        for (body, solver), own in found.groupby(["body", "solver"], sort=False):
            filled = {} if body == "sphere" else {"markerfacecolor": style.paper()}
            axes.loglog(own["points"], own["error"], **style.look(solver, label=f"{body}, {solver}", **filled))
        second = found["error"].iloc[0] * (found["points"].iloc[0] / np.array(ticks, float)) ** 2
        axes.loglog(ticks, second, label="second order", **style.line(0.4, 0.8, zorder=1))
        axes.set_xticks(ticks, map(str, ticks))
        axes.minorticks_off()
        axes.legend()
    left.set(xlabel="points across the contact [1]", ylabel="relative error of the force [1]", title="at rest")
    right.set(xlabel="points a side of the window [1]", ylabel="worst error of the force [1]", title="in time")
    style.lettered(panels)
    return drawing


def main():
    """Measure, and write the numbers, the figure and the parts of the page."""
    for path, measure in ((REST, at_rest), (SLIDING, sliding), (TIME, in_time)):
        stored(path, measure())
    with style.applied():
        figure(pandas.read_csv(REST), pandas.read_csv(TIME)).savefig(PAGE.with_suffix(".png"), dpi=200)
    fill(PAGE, parts())


if __name__ == "__main__":
    main()
