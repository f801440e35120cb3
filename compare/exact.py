"""Closed forms, one function each, and `Exact`: the smooth contact at rest behind the protocol of a solver.

Shapes enter as the MDR image of a body of revolution, g(x) = coefficient * |x|**exponent.
"""

import time
from math import pi

import numpy as np
from pydantic.dataclasses import dataclass

from scene import WLF, Arrhenius, Coulomb, Elastic, Heating, Indent, Result, Scene, Slide
from scene.indenter import Axisymmetric
from scene.protocol import refuse
from scene.quantities import CLOSED
from scene.scales import elastic_contact
from scene.terms import Term, terms_of
from scene.viscoelastic import Linear


def mean_lag(elastomer):
    """Lag [s] by which a slowly driven elastomer trails its relaxed answer: sum_k J_k lambda_k / J(infinity).

    The relaxation time of a Kelvin body; retardation less relaxation time of a standard linear solid.

    >>> from scene import StandardLinearSolid
    >>> mean_lag(StandardLinearSolid(rubbery_modulus=1.0, glassy_modulus=4.0, relaxation_time=2.0))
    6.0
    """
    instantaneous, compliances, times = elastomer.retardation()
    return float(compliances @ times / (instantaneous + compliances.sum()))


def slow_friction_3d(speed, radius, lag, indentation_modulus, coefficient, exponent):
    """Friction force [N] of a smooth body of revolution sliding slowly on a viscoelastic half-space.

    F_x -> v tau E* int_0^a g'^2 dx, to first order in v tau / a, with tau the mean lag [s] and the contact radius
    a [m]: mu = v tau / R for a sphere, (pi/2) tan(theta) v tau / a for a cone.
    """
    n = exponent
    slope_squared = (n * coefficient) ** 2 * radius ** (2 * n - 1) / (2 * n - 1)
    return speed * lag * indentation_modulus * slope_squared


def slow_friction_1d(speed, radius, lag, indentation_modulus, coefficient, exponent):
    """The same friction force [N] in the MDR, Eq. 10: F_x -> 4 G tau v int_{-a}^{a} g'^2 dx with 4G = E*.

    Exactly twice slow_friction_3d.
    """
    return 2 * slow_friction_3d(speed, radius, lag, indentation_modulus, coefficient, exponent)


def slow_friction_by_curvature(speed, lag, load, curvature):
    """Friction force [N] of any contact that slides slowly on a viscoelastic half-space, smooth or rough.

    F_x -> v tau int p d2z/dx2 dA, to first order in the speed v, with the mean lag tau [s] and the pressure p at
    rest: the displacement w = A p trails by tau, so that F_x = -v tau int p d2w/dx2 dA, and in contact w + z is
    constant. Of a body of revolution it is slow_friction_3d.

    load : normal force [N]; curvature : mean of d2z/dx2 weighted with p [1/m], `curvature_by_pressure` of BEM
    """
    return speed * lag * load * curvature


def slow_friction_by_slope(speed, lag, indentation_modulus, rms_slope, length):
    """The same friction force [N] in the MDR, smooth or rough: F_x -> E* tau v int g'^2 dx over the real contact.

    Eq. 10 with 4G = E*. rms_slope, length : of the profile over the contact at rest [1], and its length [m];
    `rms_slope_contact` and `contact_length` of MDR at rest
    """
    return speed * lag * indentation_modulus * rms_slope**2 * length


def loss_exponent(elastomer, wave_number, speeds):
    """beta of G'' ~ omega^beta, from the lowest to the highest of some speeds [m/s] at a wave number [rad/m]."""
    slow, fast = min(speeds), max(speeds)
    loss = elastomer.complex_modulus(wave_number * np.array([slow, fast])).imag
    return float(np.log(loss[1] / loss[0]) / np.log(fast / slow))


def edge_slope(indenter, radius):
    """Slope dz/dr [1] of the body of revolution at a radius [m]: the natural unit of its friction coefficient."""
    return indenter.coefficient * indenter.exponent * radius ** (indenter.exponent - 1)


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
TERMS = dict.fromkeys((Axisymmetric, Linear, Indent, Slide, WLF, Arrhenius, Heating), Term) | {Coulomb: Unmoved}


@dataclass(frozen=True, config=CLOSED)
class Exact:
    """Galin-Sneddon: smooth bodies of revolution at rest, or sliding on an elastic solid, which is the same."""

    @property
    def name(self) -> str:
        return "exact"

    def refusals(self, scene: Scene) -> list[str]:
        """Why there is no closed form for the scene, one sentence each."""
        reasons = [reason for term in terms_of(TERMS, scene) for reason in term.refusals(scene)]
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
        pressure = _pressure(scene, contact.radius, r)
        return Result(
            scene=scene,
            solver=self.name,
            settings={},
            normal_force=contact.load,
            depth=contact.depth,
            friction_force=0.0,
            residual=0.0,
            applications=0.0,
            seconds=time.process_time() - start,
            measures={"contact_area": pi * contact.radius**2, "contact_length": 2 * contact.radius},
            fields={"r": r, "pressure": pressure},
        )


def _pressure(scene, radius, r):
    """Substituting x^2 = r^2 + s^2 leaves the smooth integrand g'(x)/x, for Gauss-Legendre in s = r sinh(u)."""
    shape = scene.indenter
    n, c = shape.exponent, shape.mdr_coefficient
    nodes, weights = np.polynomial.legendre.leggauss(40)
    top = np.arccosh(radius / r)[:, None]
    x = r[:, None] * np.cosh(top * (nodes + 1) / 2)
    return scene.solid.indentation_modulus / pi * np.sum(weights * top / 2 * n * c * x ** (n - 1), axis=1)
