"""Errors of both solvers against closed forms and other codes: numbers and figure of docs/results/accuracy.md.

python docs/measure/accuracy.py

`crosscheck verify` holds more closed forms: histories, sliding in one dimension, waves pressed flat, full contact.
"""

from itertools import product
from math import pi, radians, sqrt, tan

import numpy as np
import pandas
from tables import RESULTS, cells, fill, order, stored, table

from bem3d import BEM
from compare.figures import style
from mdr1d import MDR
from scene import Cone, Elastic, Indent, Scene, Slide, Sphere, StandardLinearSolid

PAGE = RESULTS / "accuracy.md"
G, R, THETA, TAU, DEPTH = 1e6, 10e-3, radians(10), 1e-3, 1e-4
RADIUS = sqrt(R * DEPTH)
HERTZ = 4 / 3 * 4 * G * sqrt(R) * DEPTH**1.5
POINTS = (16, 23, 32, 45, 64, 91, 128, 181, 256)
REST, SLIDING = RESULTS / "accuracy/rest.csv", RESULTS / "accuracy/sliding.csv"
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
    for (name, (indenter, force, a)), solver, n in product(forms.items(), (MDR, BEM), POINTS):
        found = around(solver, a, n).solve(Scene(indenter, Elastic(G), Indent(depth=DEPTH)))
        error = abs(found.normal_force / force - 1)
        yield {"shape": name, "solver": solver.__name__, "points": n, "error": error}


def sliding():
    """Depth and friction times radius [m] of a sphere in steady sliding under a load, in 3D."""
    for memory in PUBLISHED:
        motion = Slide(speed=memory / (2 * TAU), load=0.533333)
        result = BEM(points=192).solve(Scene(Sphere(R), StandardLinearSolid(G, 2 * G, TAU), motion))
        yield {"memory": memory, "depth": result.depth, "moment": result.friction_coefficient * R}


def parts():
    """Text between two comments of the page, by the name of the comment."""
    memory = "v τ_c, mm|depth, mm|μR, mm|against other codes: depth|μR"
    shown = "{memory:g}|{depth:.6f}|{moment:.6f}|{depth_off:+.3%}|{moment_off:+.3%}"
    rest, slid = map(pandas.read_csv, (REST, SLIDING))
    off = slid[["depth", "moment"]] / np.array([*PUBLISHED.values()]) - 1
    return {
        "rest": table("shape|solver|16 points|64 points|256 points|observed order", _at_rest(rest)),
        "sliding": table(memory, cells(shown, (1e3 * slid).join(off.add_suffix("_off")))),
    }


def _at_rest(found):
    for (shape, solver), own in found.groupby(["shape", "solver"], sort=False):
        shown = own.set_index("points")["error"][[16, 64, 256]].map("{:.1e}".format)
        errors = own["error"]
        yield shape, solver, *shown, f"{order(own['points'], errors):.1f}" if errors.min() > 1e-13 else "exact"


def figure(rest):
    """Error of the force at rest over the points."""
    drawing = style.canvas("single", 2.5)
    axes, found = drawing.subplots(), rest[rest["error"] > 1e-13]
    for (shape, solver), own in found.groupby(["shape", "solver"], sort=False):
        filled = {} if shape.startswith("sphere") else {"markerfacecolor": style.paper()}
        axes.loglog(own["points"], own["error"], **style.look(solver, label=f"{shape}, {solver}", **filled))
    second = found["error"].iloc[0] * (POINTS[0] / np.array(POINTS)) ** 2
    axes.loglog(POINTS, second, label="second order", **style.line(0.4, 0.8, zorder=1))
    axes.set_xticks(POINTS[::2], map(str, POINTS[::2]))
    axes.minorticks_off()
    axes.legend()
    axes.set(xlabel="points across the contact [1]", ylabel="relative error of the force [1]")
    return drawing


def main():
    """Measure, and write the numbers, the figure and the parts of the page."""
    stored(REST, at_rest())
    stored(SLIDING, sliding())
    with style.applied():
        figure(pandas.read_csv(REST)).savefig(PAGE.with_suffix(".png"), dpi=200)
    fill(PAGE, parts())


if __name__ == "__main__":
    main()
