"""Measures both solvers against references that no one here wrote, and writes docs/results/accuracy.md.

python docs/measure/accuracy.py

The tests hold more closed forms: waves pressed flat, full contact, Ting's solution in one dimension.
"""

from math import pi, radians, sqrt, tan
from pathlib import Path

import numpy as np
from tables import order, table, write

from bem3d import BEM
from compare.models.exact import indentation
from compare.models.exact.foundation import sliding_forces
from mdr1d import MDR
from scene import Cone, Elastic, Indent, Kelvin, Program, Scene, Slide, Sphere, Stage, StandardLinearSolid

PAGE = Path(__file__).parents[1] / "results" / "accuracy.md"
G, R, THETA, TAU, DEPTH = 1e6, 10e-3, radians(10), 1e-3, 1e-4
RADIUS = sqrt(R * DEPTH)
HERTZ = 4 / 3 * 4 * G * sqrt(R) * DEPTH**1.5
POINTS = (16, 23, 32, 45, 64, 91, 128, 181, 256)
# In one dimension: nodes, half-width of the static contact [m], and solids.
NODES, HALF = (101, 201, 401, 801, 1601, 3201), 1e-3
SOLIDS = {"Kelvin": Kelvin(G, TAU), "standard linear, E_g/E_r = 10": StandardLinearSolid(G, 10 * G, TAU)}


def around(solver: type, a: float, points: int) -> BEM | MDR:
    """The solver with so many points across a contact of radius a [m]; BEM gets half as many more around it."""
    count = int(1.5 * points) if solver is BEM else points
    return solver(points=count, extent=2 * a * count / points * (1.01 if solver is MDR else 1))


def at_rest() -> str:
    """Force at a depth against Hertz and Sneddon."""
    forms = {
        "sphere (Hertz)": (Sphere(R), HERTZ, RADIUS),
        "cone (Sneddon)": (Cone(THETA), 2 / pi * 4 * G * DEPTH**2 / tan(THETA), 2 / pi * DEPTH / tan(THETA)),
    }

    def rows():
        for name, (indenter, force, a) in forms.items():
            for solver in (MDR, BEM):
                scene = Scene(indenter, Elastic(G), Indent(depth=DEPTH))
                errors = [abs(around(solver, a, n).solve(scene).normal_force / force - 1) for n in POINTS]
                shown = [f"{error:.1e}" for error in errors[::2]]
                fitted = f"{order(POINTS, errors):.1f}" if min(errors) > 1e-13 else "exact"
                yield (name, solver.__name__, *shown, fitted)

    return table("shape|solver|" + "|".join(f"{n} points" for n in POINTS[::2]) + "|observed order", rows())


def kelvin() -> str:
    """Kelvin sphere in steady sliding at depth a^2/R."""
    references = {0.1: (1.0036, 0.0936), 10.0: (4.522, 0.652)}

    def rows():
        for ratio, (force, friction) in references.items():
            scene = Scene(Sphere(R), Kelvin(G, TAU), Slide(speed=ratio * RADIUS / TAU, depth=DEPTH))
            for points in (36, 144):
                count = int(points * 1.6)
                result = BEM(points=count, extent=2 * RADIUS * count / points).solve(scene)
                over, mu = result.normal_force / HERTZ, result.friction_coefficient * R / RADIUS
                deviations = f"{over / force - 1:+.2%}", f"{mu / friction - 1:+.2%}"
                yield (
                    f"{ratio:g}",
                    f"{points}",
                    f"{over:.4f}",
                    f"{mu:.4f}",
                    *deviations,
                    f"{result.operator_applications:.0f}",
                )

    header = "v τ/a|points across 2a|F/F_Hertz|μR/a|against reference: F|μ|operator applications"
    return table(header, rows())


def standard_linear() -> str:
    """Sphere on a standard linear solid, force control, against two other codes."""
    published = {1e-4: (0.099824, 0.045249), 1e-3: (0.091508, 0.157664), 1e-2: (0.070553, 0.041906)}

    def rows():
        for memory, (depth, moment) in published.items():
            scene = Scene(
                Sphere(R), StandardLinearSolid(G, 2 * G, TAU), Slide(speed=memory / (2 * TAU), load=0.533333)
            )
            for points in (64, 192):
                result = BEM(points=points).solve(scene)
                found = result.depth * 1e3, result.friction_coefficient * R * 1e3
                deviations = f"{found[0] / depth - 1:+.3%}", f"{found[1] / moment - 1:+.3%}"
                yield f"{memory * 1e3:g}", f"{points}", f"{found[0]:.6f}", f"{found[1]:.6f}", *deviations

    return table("v τ_c, mm|points|depth, mm|μR, mm|against reference: depth|μR", rows())


def one_dimension() -> str:
    """Steady sliding against the closed forms of the foundation."""

    sphere = Sphere(R)
    depth = sphere.mdr_coefficient * HALF**sphere.exponent

    def rows():
        for name, solid in SOLIDS.items():
            for ratio in (0.1, 10.0):
                speed = ratio * HALF / TAU
                force, friction = sliding_forces(sphere, solid, speed, depth)
                scene = Scene(sphere, solid, Slide(speed=speed, depth=depth))
                found = [MDR(points=n, extent=2.2 * HALF).solve(scene) for n in NODES]
                of_force = [abs(each.normal_force / force - 1) for each in found]
                of_friction = [abs(each.friction_force / friction - 1) for each in found]
                yield name, f"{ratio:g}", *_errors(of_force), *_errors(of_friction)

    header = "solid|v τ/a|F_N, 100 points|800|order|F_x, 100 points|800|order"
    return table(header, rows())


def _errors(errors):
    return f"{errors[0]:.1e}", f"{errors[3]:.1e}", f"{order(NODES, errors):.1f}"


def indentations() -> str:
    """Force of a sphere and a cone pressed in and drawn back at a constant rate."""
    elastomer, times, depths = StandardLinearSolid(0.25, 1.25, 1.0), [0.0, 2.0, 4.0], [0.0, 0.2, 0.0]
    program = Program(stages=(Stage(duration=2.0, depth=0.2), Stage(duration=2.0, depth=0.0)))

    def rows():
        for shape, extent in ((Sphere(1.0), 1.5), (Cone(np.pi / 4), 0.4)):
            for points, steps in ((64, 40), (128, 80), (256, 160)):
                solver = BEM(points=points, extent=extent, steps=steps)
                fields = solver.solve(Scene(shape, elastomer, program)).fields
                errors = []
                for t in (1.0, 1.9, 2.2, 2.5):
                    found = np.interp(t, fields["time"], fields["normal_force"])
                    exact, _ = indentation.force_of_depth(shape, elastomer, times, depths, np.array([t]))
                    errors.append(f"{float(found / exact[0] - 1):+.2%}")
                yield shape.type, f"{points}", f"{steps}", *errors

    return table("shape|points|steps|t = 1, loading|1.9|2.2, unloading|2.5", rows())


SECTIONS = {
    "rest": at_rest,
    "kelvin": kelvin,
    "standard linear": standard_linear,
    "one dimension": one_dimension,
    "time": indentations,
}


if __name__ == "__main__":
    write(PAGE, SECTIONS)
