"""Equations of the paper against the one-dimensional simulation: numbers of docs/results/paper.md.

python docs/measure/equations.py   takes some minutes
"""

from collections.abc import Iterator
from dataclasses import replace
from math import ceil, pi, radians, sin
from pathlib import Path

import numpy as np
import pandas
from tables import fill, stored, table

from compare.statistics.jackknife import mean_ratio
from mdr1d import MDR
from mdr1d import equations as eq
from scene import Cone, Fractional, Indent, Kelvin, Result, Scene, SelfAffine, Slide, Sphere
from scene.scales import elastic_contact

PAGE = Path(__file__).parents[1] / "results" / "paper.md"
MEASURED = PAGE.with_suffix("") / "equations.csv"
G, TAU, PROFILES = 1e6, 1e-3, 20
# Bodies with their loads, on the roughness of Fig. 4, which its grid cuts off, and on one of the slope 0.1.
CONE, SHALLOW = (Cone(radians(10)), 10.0), (Sphere(1.0), 2.0)
FIG_4, FIG_4_POINTS = SelfAffine(hurst=0.4, rms_height=5e-5, longest=1e-2), 5000
FINE = SelfAffine(hurst=0.4, rms_height=1e-6, longest=5e-4, shortest=1e-5)
FAST, SPEED = 100.0, 1e-2  # xi on the plateau; speed on power laws [m/s]


def solved(scene: Scene) -> list[Result]:
    """The scene on the profiles of seeds 0, 1, ..., on a grid that holds the contact."""
    smooth, rough = elastic_contact(scene), scene.roughness
    points = FIG_4_POINTS if rough.shortest is None else 16 * round(rough.longest / rough.shortest)
    # A peak of the profile stands 5 rms heights high at most.
    periods = ceil(2 * smooth.radius * (1 + 5 * rough.rms_height / smooth.depth) / rough.longest)
    solver = MDR(points=points * periods, extent=rough.longest * periods)
    return [solver.solve(replace(scene, roughness=replace(rough, seed=seed))) for seed in range(PROFILES)]


def steep(rough: SelfAffine, slope: float) -> SelfAffine:
    """The roughness with another spectral rms slope."""
    return replace(rough, rms_height=rough.rms_height * slope / rough.rms_slope(rough.q_max(0.0)))


def at_rest() -> Iterator[tuple]:
    """Eq. 16: depth, on roughness as high as the body is deep."""
    body, load = SHALLOW
    depth = eq.indentation_depth(load, G, body.mdr_coefficient, body.exponent)
    rough = replace(FINE, longest=2e-2, shortest=1e-4, rms_height=depth)
    found = solved(Scene(body, Kelvin(G, TAU), Indent(load=load), rough))
    yield "16", "depth, h₀ = d", depth, np.array([each.depth for each in found])


def low_speed() -> Iterator[tuple]:
    """Eqs. 10 and 12 at xi = 0.01, on steep and on shallow roughness."""
    body, load = CONE
    given = load, G, TAU
    shape = body.mdr_coefficient, body.exponent
    for height in (5e-5, 1e-6):
        rough = replace(FIG_4, rms_height=height)
        slope = solved(Scene(body, Kelvin(G, TAU), Indent(load=load), rough))[0].measures["rms_slope"]
        speed = 0.01 / eq.similarity_variable(*given, 1.0, slope, *shape)
        found = solved(Scene(body, Kelvin(G, TAU), Slide(speed=speed, load=load), rough))
        slopes, mu = _measured(found, "rms_slope"), _friction(found)
        both = np.hypot(slopes, eq.macroscopic_slope(load, G, *shape))
        for name, each in (("12, 17", slopes), ("10", both)):
            yield name, f"slow cone, rms slope {slope:.2g}", eq.low_speed_friction(*given, speed, each, *shape), mu


def plateau() -> Iterator[tuple]:
    """Eq. 14 at xi = 100, on the roughness of Fig. 4 and on one whose shortest wave the grid resolves."""
    for (body, load), rough in ((CONE, FIG_4), (SHALLOW, steep(replace(FINE, longest=2e-2, shortest=1e-4), 0.1))):
        slope = solved(Scene(body, Kelvin(G, TAU), Indent(load=load), rough))[0].measures["rms_slope"]
        speed = FAST / eq.similarity_variable(load, G, TAU, 1.0, slope, body.mdr_coefficient, body.exponent)
        found = solved(Scene(body, Kelvin(G, TAU), Slide(speed=speed, load=load), rough))
        yield (
            "14",
            f"fast {body.type}, rms slope {slope:.2g}",
            eq.plateau(_measured(found, "rms_slope")),
            _friction(found),
        )


def power_laws() -> Iterator[tuple]:
    """Eq. 22 at xi = 1, on solids whose loss is a power of the frequency."""
    body, load = SHALLOW
    rough = steep(FINE, 0.1)
    q_max, shape = rough.q_max(0.0), (body.mdr_coefficient, body.exponent)
    # Eq. 21 is in proportion to the loss: xi = 1 where it is the plateau.
    unit = eq.one_frequency_friction(load, G, lambda _: G, q_max, SPEED, 0.1, *shape)
    share = float(eq.plateau(0.1) / unit)
    for beta in (1.0, 0.2):
        time = (share / sin(pi * beta / 2)) ** (1 / beta) / (q_max * SPEED)
        band = {"lowest_frequency": SPEED, "highest_frequency": 300 * q_max * SPEED}
        solid: Fractional | Kelvin = Kelvin(G, time)
        modulus = solid.complex_modulus
        if beta < 1:
            solid = Fractional(modulus=G, relaxation_time=time, exponent=beta, **band)
            modulus = solid.law
        found = solved(Scene(body, solid, Slide(speed=SPEED, load=load), rough))
        loss = (load, G, lambda omega, of=modulus: of(omega).imag, q_max, SPEED)
        expected = eq.general_friction(*loss, _measured(found, "rms_slope"), *shape)
        yield "22", f"loss ω^{beta:g}, ξ = 1", expected, _friction(found)


def _measured(results, name):
    return np.array([each.measures[name] for each in results])


def _friction(results):
    return np.array([each.friction_coefficient for each in results])


def rows() -> Iterator[dict]:
    """Equation, contact, and formula over simulation with its standard error over the profiles."""
    for measure in (at_rest, low_speed, plateau, power_laws):
        for equation, contact, formula, simulated in measure():
            over = mean_ratio(np.broadcast_to(formula, simulated.shape), simulated)
            yield {"equation": equation, "contact": contact, "over": float(over.value), "error": float(over.error)}


def parts() -> dict[str, str]:
    """Text between two comments of the page, by the name of the comment."""
    found = pandas.read_csv(MEASURED)
    shown = ((row.equation, row.contact, f"{row.over:.3g} ± {row.error:.1g}") for row in found.itertuples())
    return {"equations": table("Eq.|contact|formula over simulation", shown)}


def main() -> None:
    """Measure, and write the numbers and the part of the page."""
    stored(MEASURED, rows())
    fill(PAGE, parts())


if __name__ == "__main__":
    main()
