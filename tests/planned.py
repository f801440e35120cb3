"""What plans of both solvers are asked about, and what a solve holds."""

import tracemalloc
from dataclasses import replace

import numpy as np

from scene import (
    Coulomb,
    Elastic,
    Indent,
    Kelvin,
    Program,
    Prony,
    Scene,
    Shear,
    Slide,
    Sphere,
    Stage,
    StandardLinearSolid,
)

KELVIN = Kelvin(1e6, 1e-3)
STANDARD = StandardLinearSolid(rubbery_modulus=1e6, glassy_modulus=10e6, relaxation_time=1e-3)
PRONY = Prony(1e6, (1e6, 2e6, 3e6), (1e-4, 1e-3, 1e-2))
SPHERE, LOAD = Sphere(radius=10e-3), 0.5
STAGES = Program(stages=(Stage(duration=1e-3, load=LOAD), Stage(duration=1e-3, speed=0.2)))
SCENES = {
    "rest": Scene(SPHERE, KELVIN, Indent(load=LOAD)),
    "elastic": Scene(SPHERE, Elastic(1e6), Slide(speed=1.0, load=LOAD)),
    "slide": Scene(SPHERE, KELVIN, Slide(speed=1.0, load=LOAD)),
    "modes": Scene(SPHERE, PRONY, Slide(speed=1.0, load=LOAD)),
    "program": Scene(SPHERE, STANDARD, STAGES),
}
DRAWN, STICKS = Shear(load=LOAD, displacement=1e-5), Coulomb(0.3)
SCENES |= {
    "interface": replace(SCENES["slide"], interface=STICKS),
    "shear": replace(SCENES["rest"], motion=DRAWN, interface=STICKS),
}
BOWL = np.add.outer(*[((np.arange(32) - 15.5) * 1e-4) ** 2 / 20e-3] * 2)
FACTOR = 1.5  # the formulas count arrays; copies within an expression come and go
EFFECTS = {"roughness", "layer", "temperature", "heating", "interface"}


def held_by(of, scene):
    """What it returns, and the most memory that was held meanwhile."""
    tracemalloc.start()
    try:
        return of(scene), tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


def all_of_a_scene(plan, scene):
    """Whether what is simulated and what is left out are all of a scene."""
    absent = EFFECTS - set(scene.parts)
    return (
        list(plan.terms) == list(scene.parts)
        and absent <= set(plan.left_out)
        and not set(plan.terms) & set(plan.left_out)
    )
