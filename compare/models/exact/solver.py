"""`Exact`: the smooth contact at rest, Galin and Sneddon, behind the protocol of a solver."""

import time
from math import pi
from typing import Any, ClassVar

import numpy as np
from pydantic.dataclasses import dataclass

from scene import Coulomb, Elastic, Heating, Indent, Result, Scene, Slide
from scene.effects.temperature import TemperatureLaw
from scene.indenter import Axisymmetric
from scene.protocol import refuse
from scene.quantities import CLOSED
from scene.scales import elastic_contact
from scene.solids.viscoelastic import Linear
from scene.terms import Term, refused_parts


class Unmoved(Term):
    """Friction in the interface of a contact that nothing pulls at."""

    def refusals(self, scene: Scene) -> list[str]:
        if isinstance(scene.motion, Slide):
            return [
                "interface = Coulomb: friction of the interface is not in the closed form; use Indent, or leave "
                "interface out"
            ]
        return []


# Nothing is warmed where nothing loses energy.
TERMS = dict.fromkeys((Axisymmetric, Linear, Indent, Slide, TemperatureLaw, Heating), Term) | {Coulomb: Unmoved}


@dataclass(frozen=True, config=CLOSED)
class Exact:
    """Galin-Sneddon: smooth bodies of revolution at rest, or sliding on an elastic solid, which is the same."""

    label: ClassVar[str] = "closed form"
    draws: ClassVar[str] = "none"
    packages: ClassVar[tuple[str, ...]] = ("compare.models.exact",)  # whose code the answer depends on

    @property
    def name(self) -> str:
        return "exact"

    def refusals(self, scene: Scene) -> list[str]:
        """Reasons why there is no closed form for the scene, one sentence each."""
        reasons = refused_parts(TERMS, scene)
        if not reasons and scene.motion.speed > 0 and not isinstance(scene.elastomer, Elastic):
            reasons.append(
                f"sliding at speed = {scene.motion.speed:g} m/s on a viscoelastic solid has no closed form"
            )
        return reasons

    def solve(self, scene: Scene) -> Result:
        """The smooth relaxed contact, its pressure p = (E*/pi) int_r^a g'/sqrt(x^2 - r^2) dx. Raises Refused.

        Result.fields: r [m], pressure [Pa].
        """
        refuse(self, scene)
        start = time.process_time()
        contact = elastic_contact(scene)
        r = np.linspace(0, contact.radius, 101)[1:]
        pressure = smooth_pressure(scene.indenter, scene.solid.indentation_modulus, contact.radius, r)
        return Result(
            scene=scene,
            solver=self.name,
            settings={},
            normal_force=contact.load,
            depth=contact.depth,
            friction_force=0.0,
            residual=0.0,
            operator_applications=0.0,
            seconds=time.process_time() - start,
            measures={"contact_area": pi * contact.radius**2, "contact_length": 2 * contact.radius},
            fields={"r": r, "pressure": pressure},
        )


def smooth_pressure(shape: Any, modulus: float, radius: float, r: np.ndarray) -> np.ndarray:
    """Pressure [Pa] (N,) under a body of revolution, (E*/pi) int_r^a g'/sqrt(x^2 - r^2) dx, at 0 < r < a [m].

    modulus : E* [Pa]; radius : a, of the contact [m]

    Substituting x^2 = r^2 + s^2 leaves the smooth integrand g'(x)/x, for Gauss-Legendre in s = r sinh(u).
    """
    n, c = shape.exponent, shape.mdr_coefficient
    nodes, weights = np.polynomial.legendre.leggauss(40)
    top = np.arccosh(radius / r)[:, None]
    x = r[:, None] * np.cosh(top * (nodes + 1) / 2)
    return modulus / pi * np.sum(weights * top / 2 * n * c * x ** (n - 1), axis=1)
