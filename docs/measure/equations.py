"""Measures the equations of the paper against the one-dimensional simulation, and writes results/equations.md.

python docs/measure/equations.py
"""

from dataclasses import replace
from math import radians
from pathlib import Path

import equations_loss
import numpy as np
from ensembles import (
    broken,
    deviation,
    friction,
    mean_slope,
    measured,
    pixels,
    profile,
    solve,
    speed_at,
    steep,
)
from tables import table, write

from mdr1d import equations as eq
from scene import Cone, Indent, Kelvin, Scene, SelfAffine, Slide, Sphere

PAGE = Path(__file__).parents[1] / "results" / "equations.md"
G, TAU = 1e6, 1e-3
FIG_4 = SelfAffine(hurst=0.4, rms_height=5e-5, longest=1e-2)
FINE = SelfAffine(hurst=0.4, rms_height=1e-6, longest=2e-2, shortest=1e-4)
SETS = {
    "Fig. 4, cone": (Cone(radians(10)), 10.0, FIG_4),
    "Fig. 4, sphere": (Sphere(1e-2), 10.0, FIG_4),
    "shallow sphere": (Sphere(1.0), 2.0, steep(FINE, 0.1)),
}


def at_rest() -> str:
    """Eq. 16 of rough indenters."""

    def rows():
        for name, (shape, load, rough) in SETS.items():
            depth = eq.indentation_depth(load, G, *profile(shape))
            width = 2 * eq.contact_radius(load, G, *profile(shape))
            for share in (0.1, 1.0):
                line = replace(rough, rms_height=share * depth)
                found = solve(Scene(shape, Kelvin(G, TAU), Indent(load=load), line))
                depths = np.array([result.depth for result in found])
                yield (
                    name,
                    f"{share:g}",
                    deviation(depths, depth),
                    deviation(measured(found, "contact_length"), width),
                )

    return table("set|h₀/d|depth over d of Eq. 16|length of contact over 2a", rows())


def low_speed() -> str:
    """Eqs. 12 and 10 over the ranges of Fig. 3."""
    base = {"F_N": 10.0, "G": G, "h₀": 5e-5, "Δx": 2e-6, "H": 0.4, "θ": 10.0, "τ": TAU}
    ranges = {
        "F_N": (0.1, 10.0),
        "h₀": (1e-6, 1e-5, 1e-4),
        "H": (0.0, 0.5, 1.0),
        "θ": (5.0, 30.0, 75.0),
    }

    def rows():
        for name, value in ((name, value) for name, values in ranges.items() for value in values):
            case = base | {name: value}
            shape, load, modulus, time = Cone(radians(case["θ"])), case["F_N"], case["G"], case["τ"]
            rough = replace(FIG_4, rms_height=case["h₀"], hurst=case["H"])
            points = round(rough.longest / case["Δx"])
            slope = mean_slope(rough, points)
            speed = speed_at(0.01, shape, load, slope, modulus, time)
            scene = Scene(shape, Kelvin(modulus, time), Slide(speed=speed, load=load), rough)
            found = solve(scene, points)
            slopes = measured(found, "rms_slope")
            both = np.hypot(slopes, eq.macroscopic_slope(load, modulus, *profile(shape)))
            xi = eq.similarity_variable(load, modulus, time, speed, slopes, *profile(shape))
            dropped, kept = (
                eq.low_speed_friction(load, modulus, time, speed, s, *profile(shape)) for s in (slopes, both)
            )
            mu = friction(found)
            yield (
                f"{name} = {value:g}",
                f"{slope:.2g}",
                deviation(xi, eq.normalised_friction(mu, slopes, form="as_printed")),
                deviation(dropped, mu),
                deviation(kept, mu),
                broken(scene, slope),
            )

    return table("parameter|rms slope|Eq. 17 as printed|Eqs. 12, 17|Eq. 10|conditions not met", rows())


def _slopes(result):
    """Slopes of the pixels whose right node touches."""
    step = np.diff(result.fields["profile"]) / result.measures["pixel"]
    return step[result.fields["contact"][1:]]


def plateau() -> str:
    """Eqs. 14 and 15 at high speed."""

    def rows():
        for name, (shape, load, rough) in SETS.items():
            for hurst in (0.0, 0.8):
                line = replace(rough, hurst=hurst)
                line = line if rough.shortest is None else steep(line, 0.1)
                slope = mean_slope(line, pixels(line))
                speed = speed_at(100.0, shape, load, slope, G, TAU)
                found = solve(Scene(shape, Kelvin(G, TAU), Slide(speed=speed, load=load), line))
                mu, local = friction(found), measured(found, "rms_slope_contact")
                pixel = found[0].measures["pixel"]
                of_slopes, printed = (
                    np.array([eq.plateau_of_slopes(_slopes(result), pixel, form) for result in found])
                    for form in ("corrected", "as_printed")
                )
                yield (
                    name,
                    f"{hurst:g}",
                    deviation(eq.plateau(measured(found, "rms_slope")), mu),
                    deviation(of_slopes, mu),
                    deviation(printed, mu),
                    f"{np.mean(mu / local):.3f}",
                    f"{np.mean(local) / slope:.3f}",
                )

    header = "set|H|Eq. 14|Eq. 15|Eq. 15, last form as printed, SI|μ over rms slope in contact|that over rms slope"
    return table(header, rows())


SECTIONS = {
    "rest": at_rest,
    "low speed": low_speed,
    "plateau": plateau,
}


if __name__ == "__main__":
    write(PAGE, SECTIONS | equations_loss.SECTIONS)
