"""Measures both solvers against references that no one here wrote, and writes docs/results/accuracy.md.

python docs/measure/accuracy.py
"""

from collections.abc import Callable
from math import pi, radians, sqrt, tan
from pathlib import Path

import accuracy_1d
import accuracy_3d
from tables import order, table

from bem3d import BEM
from mdr1d import MDR
from scene import Cone, Elastic, Indent, Kelvin, Scene, SelfAffine, Slide, Sphere, StandardLinearSolid

G, R, THETA, TAU, DEPTH = 1e6, 10e-3, radians(10), 1e-3, 1e-4
RADIUS = sqrt(R * DEPTH)
HERTZ = 4 / 3 * 4 * G * sqrt(R) * DEPTH**1.5
POINTS = (16, 23, 32, 45, 64, 91, 128, 181, 256)


HEAD = """# Accuracy

Measured by `python docs/measure/accuracy.py`, which writes this page.

![Errors of the force fall with the square of the points](accuracy.png)

Relative error of the force over the points: at rest against Hertz and Sneddon (a), pressed in and drawn back
against Lee and Radok, and Ting (b). A cone in 1D has rounding alone. Drawn by
`python docs/measure/pictures.py` from the tables below."""


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
            for points in (18, 36, 72, 144):
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


def slow_sphere() -> str:
    """Smooth Kelvin sphere as the speed tends to zero: one dimension against three."""

    def rows():
        for ratio in (1.0, 0.3, 0.1, 0.03, 0.01):
            scene = Scene(Sphere(R), Kelvin(G, TAU), Slide(speed=ratio * RADIUS / TAU, load=HERTZ))
            one, three = (solver.solve(scene).friction_coefficient for solver in (MDR(), BEM(points=256)))
            unit = ratio * RADIUS / R
            yield f"{ratio:g}", f"{one / unit:.4f}", f"{three / unit:.4f}", f"{one / three:.3f}"

    return table("v τ/a|1D: μR/(vτ)|3D: μR/(vτ)|ratio", rows())


def rough() -> str:
    """One rough sphere of the paper's kind on finer and finer grids."""
    surface = SelfAffine(hurst=0.2, rms_height=5e-5, longest=1e-2, shortest=5e-4, seed=1)

    def rows():
        for speed, load in ((0.01, 10.0), (0.1, 1.0), (1.0, 10.0), (10.0, 10.0)):
            scene = Scene(Sphere(R), Kelvin(G, TAU), Slide(speed=speed, load=load), surface)
            grids = (64, 128, 256, 512)
            found = [BEM(points=n, extent=7e-3).solve(scene).friction_coefficient for n in grids]
            yield (
                f"{speed:g}",
                f"{load:g}",
                *(f"{mu / found[-1] - 1:+.2%}" for mu in found[:-1]),
                f"{found[-1]:.5f}",
            )

    waves = "|".join(f"{0.5e-3 / 7e-3 * n:.0f} points a wave" for n in (64, 128, 256))
    return table(f"speed, m/s|load, N|{waves}|μ on 37 points a wave", rows())


SECTIONS: dict[str, tuple[str, Callable[[], str]]] = {
    "At rest: Hertz and Sneddon": (
        "Relative error of the force at a given depth, by points across the contact. The order is fitted over "
        "all of 16 to 256 points: the edge of a 3D contact moves by whole pixels, so single errors scatter. "
        "1D is exact for a profile that is linear between nodes, of which a cone with a node at its tip is "
        "one.",
        at_rest,
    ),
    "Steady sliding of a Kelvin sphere": (
        "3D at the depth a²/R. The references are converged values of other schemes, to the digits they were "
        "given in.",
        kelvin,
    ),
    "Steady sliding on a standard linear solid": (
        "3D at F = 0.533333 N, R = 10 mm, G from 1 to 2 MPa. The references are two independent codes, good "
        "to 1e-4 in μR and 1e-6 mm in depth.",
        standard_linear,
    ),
    "The slow smooth sphere: one dimension against three": (
        "At the load of the static contact. The limits are 2 in 1D and 1 in 3D (theory, Eq. 8): the ratio "
        "tends to 2.",
        slow_sphere,
    ),
    "A rough sphere on finer grids": (
        "3D, one surface, H = 0.2, h₀ = 50 µm, waves from 10 mm to 0.5 mm, on 7 mm: friction against that of the "
        "finest grid. At low speed a rough sphere has an independent reference too, vτ times the curvature of the "
        "surface averaged with the pressure at rest, which the tests hold; at other speeds there is none.",
        rough,
    ),
}


def main() -> None:
    """Measure everything and write the page."""
    parts = [HEAD]
    for title, (text, measure) in (SECTIONS | accuracy_1d.SECTIONS | accuracy_3d.SECTIONS).items():
        parts.append(f"## {title}\n\n{text}\n\n{measure()}")
        print(parts[-1], "\n", flush=True)
    (Path(__file__).parents[1] / "results" / "accuracy.md").write_text("\n\n".join(parts) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
