"""Temperature of the elastomer: one factor on all its times (thermorheologically simple solids)."""

from dataclasses import dataclass as plain
from math import exp, log
from typing import Annotated, Literal

from pydantic import Field, model_validator
from pydantic.dataclasses import dataclass

from .modes import Relaxation, Retardation
from .quantities import CLOSED, Positive
from .viscoelastic import Linear

GAS_CONSTANT = 8.314462618  # [J/(mol K)], CODATA 2018


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class WLF:
    """Williams, Landel and Ferry: log10 a_T = -c1 (T - T_r) / (c2 + T - T_r); J. Am. Chem. Soc. 77, 3701 (1955).

    temperature, reference : T of the scene and T_r, at which the elastomer is stated [K]
    c1, c2 : constants at T_r [1], [K]; T and T_r lie above T_r - c2, where times are infinite
    """

    temperature: Positive
    reference: Positive
    c1: Positive
    c2: Positive
    type: Literal["wlf"] = Field(default="wlf", repr=False)

    @model_validator(mode="after")
    def _above_the_pole(self):
        if not self.temperature > self.reference - self.c2:
            raise ValueError(
                f"temperature = {self.temperature:g} K: the law ends at reference - c2 = "
                f"{self.reference - self.c2:g} K, it must be above"
            )
        return self

    @property
    def shift(self) -> float:
        """a_T, by which all times are longer than at the reference."""
        above = self.temperature - self.reference
        return exp(-log(10) * self.c1 * above / (self.c2 + above))


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class Arrhenius:
    """ln a_T = (activation_energy / R) (1/T - 1/T_r).

    temperature, reference : T of the scene and T_r, at which the elastomer is stated [K]
    activation_energy : [J/mol]
    """

    temperature: Positive
    reference: Positive
    activation_energy: Positive
    type: Literal["arrhenius"] = Field(default="arrhenius", repr=False)

    @property
    def shift(self) -> float:
        """a_T, by which all times are longer than at the reference."""
        return exp(self.activation_energy / GAS_CONSTANT * (1 / self.temperature - 1 / self.reference))


Temperature = Annotated[WLF | Arrhenius, Field(discriminator="type")]


@plain(frozen=True)
class Shifted(Linear):
    """A solid all of whose times are longer by one factor."""

    solid: Linear
    factor: float

    @property
    def poisson_ratio(self) -> float:
        return self.solid.poisson_ratio

    @property
    def glassy_modulus(self) -> float:
        """That of the solid [Pa]."""
        return self.solid.glassy_modulus

    def modes(self) -> Relaxation | Retardation:
        """Those of the solid, in the form in which it states them."""
        stated = self.solid.modes()
        times = stated.times * self.factor
        times.setflags(write=False)
        if isinstance(stated, Relaxation):
            return Relaxation(stated.equilibrium, stated.moduli, times, stated.viscosity * self.factor)
        return Retardation(stated.instantaneous, stated.compliances, times)
