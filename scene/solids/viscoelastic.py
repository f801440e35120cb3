"""Moduli and compliances of every elastomer, derived from one statement of its modes.

Time convention exp(i omega t): G(omega) = G'(omega) + i G''(omega), both >= 0 for omega >= 0.
"""

from functools import lru_cache
from typing import TYPE_CHECKING, Annotated, Any

from pydantic import Field

from ..quantities import Finite
from .modes import Relaxation, Retardation

PoissonRatio = Annotated[Finite, Field(gt=-1, le=0.5)]
INCOMPRESSIBLE = 0.5  # Poisson ratio of a solid that states none


class Linear:
    """A linear viscoelastic solid, stated in shear; stiffness against indentation follows from the Poisson ratio.

    A solid is frozen and states `modes` in one of the two forms; the other is converted exactly, once.
    """

    if TYPE_CHECKING:

        @property
        def poisson_ratio(self) -> float: ...

        @property
        def glassy_modulus(self) -> float: ...

    def modes(self) -> Relaxation | Retardation:
        """The one statement from which everything else is derived."""
        raise NotImplementedError

    def at_reference(self, law: Any) -> "Linear":
        """The solid at the reference of a law of temperature, where its table has several; else itself."""
        return self

    def relaxation(self):
        """Maxwell modes: equilibrium modulus [Pa], moduli (K,) [Pa], times (K,) [s] ascending.

        G(t) = G_0 + sum_k G_k exp(-t/tau_k) + viscosity delta(t).
        """
        form, _ = _forms(self)
        return form.equilibrium, form.moduli, form.times

    def retardation(self):
        """Creep modes: instantaneous compliance [1/Pa], compliances (K,) [1/Pa], times (K,) [s] ascending.

        J(t) = J_0 + sum_k J_k (1 - exp(-t/lambda_k)).
        """
        _, form = _forms(self)
        return form.instantaneous, form.compliances, form.times

    @property
    def viscosity(self) -> float:
        """Dashpot beside the Maxwell modes [Pa s]: G(omega) -> i omega viscosity at high frequency.

        Zero for every solid with a finite glassy modulus.
        """
        return _forms(self)[0].viscosity

    def relaxation_modulus(self, t):
        """G(t) [Pa] in shear for t >= 0 [s], any shape; with a dashpot infinite at t = 0."""
        return _forms(self)[0].modulus(t)

    def creep_compliance(self, t):
        """J(t) [1/Pa] in shear for t >= 0 [s], any shape."""
        return _forms(self)[1].compliance(t)

    def complex_modulus(self, omega):
        """G(omega) [Pa] in shear, complex, for angular frequencies [rad/s] of any shape."""
        return _forms(self)[0].complex_modulus(omega)

    @property
    def static_modulus(self) -> float:
        """Shear modulus [Pa] once everything has relaxed, G(omega = 0)."""
        return _forms(self)[0].equilibrium

    @property
    def indentation_modulus(self) -> float:
        """Relaxed E* = E/(1 - nu^2) = 2G/(1 - nu) [Pa]; 4G at nu = 1/2."""
        return 2 * self.static_modulus / (1 - self.poisson_ratio)


class Solid(Linear):
    """A solid that does not state its glassy modulus as a field."""

    @property
    def glassy_modulus(self) -> float:
        """Shear modulus [Pa] against a sudden strain, G(t = 0); infinite with a dashpot."""
        return _forms(self)[0].glassy


@lru_cache(maxsize=256)
def _forms(solid: Linear) -> tuple[Relaxation, Retardation]:
    stated = solid.modes()
    if isinstance(stated, Relaxation):
        return stated, stated.retardation()
    return stated.relaxation(), stated
