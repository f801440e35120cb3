"""Equations of the paper against the one-dimensional simulation: numbers of docs/results/paper.md.

python docs/measure/equations.py   takes some minutes
"""

from dataclasses import replace
from math import ceil, pi, radians, sin

import numpy as np
import pandas
from pandas import DataFrame
from tables import RESULTS, cells, fill, stored, table

from compare.solving.task import draws_of
from compare.statistics.jackknife import mean_ratio
from mdr1d import MDR
from mdr1d import equations as eq
from scene import Cone, Fractional, Indent, Kelvin, Scene, SelfAffine, Slide, Sphere
from scene.scales import elastic_contact

PAGE, MEASURED = RESULTS / "paper.md", RESULTS / "paper/equations.csv"
G, TAU, PROFILES = 1e6, 1e-3, 20
KELVIN = Kelvin(G, TAU)
# Bodies with their loads, on the roughness of Fig. 4, which its grid cuts off, and on one of the slope 0.1.
CONE, SHALLOW = (Cone(radians(10)), 10.0), (Sphere(1.0), 2.0)
FIG_4, FIG_4_POINTS = SelfAffine(hurst=0.4, rms_height=5e-5, longest=1e-2), 5000
FINE = SelfAffine(hurst=0.4, rms_height=1e-6, longest=5e-4, shortest=1e-5)
FAST, SPEED = 100.0, 1e-2  # xi on the plateau; speed on power laws [m/s]


def solved(contact, solid, rough, speed=0.0, profiles=PROFILES):
    """Depth, friction and rms slope on the profiles of seeds 0, 1, ..., on a grid that holds the contact."""
    body, load = contact
    scene = Scene(body, solid, Slide(speed=speed, load=load) if speed else Indent(load=load), rough)
    smooth = elastic_contact(scene)
    points = FIG_4_POINTS if rough.shortest is None else 16 * round(rough.longest / rough.shortest)
    # A peak of the profile stands 5 rms heights high at most.
    periods = ceil(2 * smooth.radius * (1 + 5 * rough.rms_height / smooth.depth) / rough.longest)
    solver = MDR(points=points * periods, extent=rough.longest * periods)
    found = map(solver.solve, draws_of(scene, profiles))
    return DataFrame(
        {"depth": each.depth, "friction": each.friction_coefficient, "slope": each.measures["rms_slope"]}
        for each in found
    )


def steep(rough, slope):
    """The roughness with another spectral rms slope."""
    return replace(rough, rms_height=rough.rms_height * slope / rough.rms_slope(rough.q_max(0.0)))


def shape(body):
    """What equations take of a body."""
    return body.mdr_coefficient, body.exponent


def sliding(contact, rough, xi):
    """Rms slope at rest, and answers at the speed [m/s] that makes xi, on a Kelvin solid."""
    body, load = contact
    slope = solved(contact, KELVIN, rough, profiles=1)["slope"][0]
    speed = xi / eq.similarity_variable(load, G, TAU, 1.0, slope, *shape(body))
    return slope, speed, solved(contact, KELVIN, rough, speed)


def at_rest():
    """Eq. 16: depth, on roughness as high as the body is deep."""
    body, load = SHALLOW
    depth = eq.indentation_depth(load, G, *shape(body))
    found = solved(SHALLOW, KELVIN, replace(FINE, longest=2e-2, shortest=1e-4, rms_height=depth))
    yield "16", "depth, h₀ = d", depth, found["depth"]


def low_speed():
    """Eqs. 10 and 12 at xi = 0.01, on steep and on shallow roughness."""
    body, load = CONE
    for height in (5e-5, 1e-6):
        slope, speed, found = sliding(CONE, replace(FIG_4, rms_height=height), 0.01)
        both = np.hypot(found["slope"], eq.macroscopic_slope(load, G, *shape(body)))
        for name, each in (("12, 17", found["slope"]), ("10", both)):
            formula = eq.low_speed_friction(load, G, TAU, speed, each, *shape(body))
            yield name, f"slow cone, rms slope {slope:.2g}", formula, found["friction"]


def plateau():
    """Eq. 14 at xi = 100, on the roughness of Fig. 4 and on one whose shortest wave the grid resolves."""
    for contact, rough in ((CONE, FIG_4), (SHALLOW, steep(replace(FINE, longest=2e-2, shortest=1e-4), 0.1))):
        slope, _, found = sliding(contact, rough, FAST)
        name = f"fast {contact[0].type}, rms slope {slope:.2g}"
        yield "14", name, eq.plateau(found["slope"]), found["friction"]


def power_laws():
    """Eq. 22 at xi = 1, on solids whose loss is a power of the frequency."""
    (body, load), rough = SHALLOW, steep(FINE, 0.1)
    q_max = rough.q_max(0.0)
    # Eq. 21 is in proportion to the loss: xi = 1 where it is the plateau.
    unit = eq.one_frequency_friction(load, G, lambda _: G, q_max, SPEED, 0.1, *shape(body))
    share = float(eq.plateau(0.1) / unit)
    band = {"lowest_frequency": SPEED, "highest_frequency": 300 * q_max * SPEED}
    for beta in (1.0, 0.2):
        time = (share / sin(pi * beta / 2)) ** (1 / beta) / (q_max * SPEED)
        power = Fractional(modulus=G, relaxation_time=time, exponent=beta, **band) if beta < 1 else None
        found = solved(SHALLOW, power or Kelvin(G, time), rough, SPEED)
        law = power.law if power else Kelvin(G, time).complex_modulus
        expected = eq.general_friction(
            load, G, lambda omega, law=law: law(omega).imag, q_max, SPEED, found["slope"], *shape(body)
        )
        yield "22", f"loss ω^{beta:g}, ξ = 1", expected, found["friction"]


def rows():
    """Equation, contact, and formula over simulation with its standard error over the profiles."""
    for measure in (at_rest, low_speed, plateau, power_laws):
        for equation, contact, formula, simulated in measure():
            over = mean_ratio(formula, simulated)
            yield {"equation": equation, "contact": contact, "over": float(over.value), "error": float(over.error)}


def parts():
    """Text between two comments of the page, by the name of the comment."""
    shown = cells("{equation}|{contact}|{over:.3g} ± {error:.1g}", pandas.read_csv(MEASURED))
    return {"equations": table("Eq.|contact|formula over simulation", shown)}


def main():
    """Measure, and write the numbers and the part of the page."""
    stored(MEASURED, rows())
    fill(PAGE, parts())


if __name__ == "__main__":
    main()
