"""Linear rheology, stated once as moduli in shear; stiffness against indentation follows from the Poisson ratio.

Time convention exp(i omega t): G(omega) = G'(omega) + i G''(omega), both >= 0 for omega >= 0.
"""

from typing import Annotated, Literal

import numpy as np
from pydantic import Field, model_validator
from pydantic.dataclasses import dataclass

from .quantities import CLOSED, Finite, Positive

PoissonRatio = Annotated[Finite, Field(gt=-1, le=0.5)]


class Linear:
    """What every elastomer offers, derived from its retardation modes."""

    poisson_ratio: float

    def retardation(self):
        """Creep modes: instantaneous compliance [1/Pa], compliances (K,) [1/Pa], times (K,) [s].

        J(t) = J_0 + sum_k J_k (1 - exp(-t/lambda_k)).
        """
        raise NotImplementedError

    def creep_compliance(self, t):
        """J(t) [1/Pa] in shear for t >= 0 [s], any shape."""
        instantaneous, compliances, times = self.retardation()
        return instantaneous - np.expm1(-np.asarray(t, float)[..., None] / times) @ compliances

    def complex_modulus(self, omega):
        """G(omega) [Pa] in shear, complex, for angular frequencies [rad/s] of any shape."""
        instantaneous, compliances, times = self.retardation()
        omega = np.asarray(omega, float)[..., None]
        return 1 / (instantaneous + (1 / (1 + 1j * omega * times)) @ compliances)

    @property
    def static_modulus(self) -> float:
        """Shear modulus [Pa] once everything has relaxed, G(omega = 0)."""
        instantaneous, compliances, _ = self.retardation()
        return float(1 / (instantaneous + compliances.sum()))

    @property
    def indentation_modulus(self) -> float:
        """Relaxed E* = E/(1 - nu^2) = 2G/(1 - nu) [Pa]; 4G at nu = 1/2."""
        return 2 * self.static_modulus / (1 - self.poisson_ratio)


@dataclass(frozen=True, config=CLOSED)
class Elastic(Linear):
    """Elastic solid. modulus: shear modulus [Pa]."""

    modulus: Positive
    poisson_ratio: PoissonRatio = 0.5
    type: Literal["elastic"] = Field(default="elastic", repr=False)

    def retardation(self):
        return 1 / self.modulus, np.empty(0), np.empty(0)


@dataclass(frozen=True, config=CLOSED)
class Kelvin(Linear):
    """Kelvin-Voigt solid, G(omega) = modulus * (1 + i omega relaxation_time).

    modulus : static shear modulus [Pa]
    relaxation_time : viscosity over modulus [s]
    """

    modulus: Positive
    relaxation_time: Positive
    poisson_ratio: PoissonRatio = 0.5
    type: Literal["kelvin"] = Field(default="kelvin", repr=False)

    def retardation(self):
        return 0.0, np.array([1 / self.modulus]), np.array([self.relaxation_time])


@dataclass(frozen=True, config=CLOSED)
class StandardLinearSolid(Linear):
    """Standard linear solid, G(t) = rubbery + (glassy - rubbery) exp(-t / relaxation_time).

    rubbery_modulus, glassy_modulus : shear moduli [Pa], rubbery < glassy
    relaxation_time : of the modulus at constant strain [s]; the retardation time is longer by glassy / rubbery
    """

    rubbery_modulus: Positive
    glassy_modulus: Positive
    relaxation_time: Positive
    poisson_ratio: PoissonRatio = 0.5
    type: Literal["standard-linear-solid"] = Field(default="standard-linear-solid", repr=False)

    @model_validator(mode="after")
    def _stiffens_with_frequency(self):
        if not self.rubbery_modulus < self.glassy_modulus:
            raise ValueError(
                f"glassy_modulus = {self.glassy_modulus:g} must exceed rubbery_modulus = {self.rubbery_modulus:g}"
            )
        return self

    def retardation(self):
        rubbery, glassy = self.rubbery_modulus, self.glassy_modulus
        delayed = (glassy - rubbery) / (glassy * rubbery)
        return 1 / glassy, np.array([delayed]), np.array([self.relaxation_time * glassy / rubbery])


@dataclass(frozen=True, config=CLOSED)
class Prony(Linear):
    """Generalized Maxwell solid, G(t) = equilibrium_modulus + sum_k moduli[k] exp(-t / relaxation_times[k]).

    equilibrium_modulus : shear modulus at rest [Pa]
    moduli, relaxation_times : of each Maxwell branch [Pa], [s]; one or more, equally many
    """

    equilibrium_modulus: Positive
    moduli: Annotated[tuple[Positive, ...], Field(min_length=1)]
    relaxation_times: Annotated[tuple[Positive, ...], Field(min_length=1)]
    poisson_ratio: PoissonRatio = 0.5
    type: Literal["prony"] = Field(default="prony", repr=False)

    @model_validator(mode="after")
    def _one_time_a_modulus(self):
        if len(self.moduli) != len(self.relaxation_times):
            raise ValueError(
                f"relaxation_times has {len(self.relaxation_times)} values, moduli has {len(self.moduli)}: "
                "each modulus needs one relaxation time"
            )
        return self

    def retardation(self):
        """Creep modes as poles and zeros of the same rational function, by a symmetric eigenvalue problem.

        With internal strains q_k' = (eps - q_k)/tau_k and sigma = G_g eps - sum G_k q_k, creep at constant sigma
        is q' = -S q + ... with S = D^(1/2) (1 - g g^T) D^(1/2), D = diag(1/tau_k), g_k = sqrt(G_k/G_g).
        Its eigenvalues are the retardation rates, accurate to rounding of the fastest one: modes slower by
        more than 12 decades lose their digits.
        """
        moduli, times = np.array(self.moduli), np.array(self.relaxation_times)
        glassy = self.equilibrium_modulus + moduli.sum()
        rates = 1 / times
        share = np.sqrt(moduli / glassy * rates)
        eigenvalues, vectors = np.linalg.eigh(np.diag(rates) - np.outer(share, share))
        compliances = (share @ vectors) ** 2 / (glassy * eigenvalues)
        return 1 / glassy, compliances, 1 / eigenvalues


Elastomer = Annotated[Elastic | Kelvin | StandardLinearSolid | Prony, Field(discriminator="type")]
