"""Temperature of the elastomer: one factor on all its times (thermorheologically simple solids)."""

from dataclasses import dataclass as plain
from dataclasses import replace
from math import exp, log
from typing import Annotated, Literal

import numpy as np
from pydantic import Field, model_validator
from pydantic.dataclasses import dataclass

from .modes import Relaxation, Retardation
from .quantities import CLOSED, AbsoluteTemperature, MolarEnergy, Positive, TemperatureDifference
from .viscoelastic import Linear

GAS_CONSTANT = 8.314462618  # [J/(mol K)], CODATA 2018
# c1 [1] and c2 [K] at the glass transition as reference, means over many polymers (Williams, Landel and Ferry).
UNIVERSAL = {"c1": 17.44, "c2": 51.6}

COLDEST = 100.0  # [K] that is not doubted
_MOST = 700.0  # of |ln a_T|: beyond it the factor leaves the range of numbers


def _within_range(law):
    """Return the law as it is. Raises ValueError where its shift is no number."""
    if not abs(law.log_shift) < _MOST:
        raise ValueError(
            f"temperature = {law.temperature:g} K: times would be longer by exp({law.log_shift:.3g}), beyond the "
            f"range of numbers; give one closer to reference = {law.reference:g} K{_meant(law)}"
        )
    return law


def _meant(law):
    return f'; is "{law.temperature:g} degC" meant?' if law.temperature < COLDEST else ""


class _Law:
    """A law of the shift."""

    @property
    def log_shift(self) -> float:
        """ln a_T."""
        raise NotImplementedError

    @property
    def shift(self) -> float:
        """a_T, by which all times are longer than at the reference; 1 there."""
        return exp(self.log_shift)


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class WLF(_Law):
    """Williams, Landel and Ferry: log10 a_T = -c1 (T - T_r) / (c2 + T - T_r); J. Am. Chem. Soc. 77, 3701 (1955).

    temperature, reference : T of the scene and T_r, at which the elastomer is stated [K]
    c1, c2 : constants at T_r [1], [K]; T lies above T_r - c2, where times are infinite

    >>> from scene import WLF
    >>> round(WLF(temperature=310, reference=300, c1=8.86, c2=101.6).log_shift, 4)
    -1.828
    """

    temperature: AbsoluteTemperature
    reference: AbsoluteTemperature
    c1: Positive
    c2: TemperatureDifference
    type: Literal["wlf"] = Field(default="wlf", repr=False)

    @model_validator(mode="after")
    def _above_the_pole(self):
        if not self.temperature > self.reference - self.c2:
            raise ValueError(
                f"temperature = {self.temperature:g} K: the law ends at reference - c2 = "
                f"{self.reference - self.c2:g} K, it must be above{_meant(self)}"
            )
        return _within_range(self)

    @property
    def log_shift(self) -> float:
        """ln a_T."""
        above = self.temperature - self.reference
        return -log(10) * self.c1 * above / (self.c2 + above)


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class Arrhenius(_Law):
    """ln a_T = (activation_energy / R) (1/T - 1/T_r).

    temperature, reference : T of the scene and T_r, at which the elastomer is stated [K]
    activation_energy : [J/mol]
    """

    temperature: AbsoluteTemperature
    reference: AbsoluteTemperature
    activation_energy: MolarEnergy
    type: Literal["arrhenius"] = Field(default="arrhenius", repr=False)

    _in_range = model_validator(mode="after")(_within_range)

    @property
    def log_shift(self) -> float:
        """ln a_T."""
        return self.activation_energy / GAS_CONSTANT * (1 / self.temperature - 1 / self.reference)


Temperature = Annotated[WLF | Arrhenius, Field(discriminator="type")]


@plain(frozen=True)
class Shifted(Linear):
    """A solid all of whose times are longer by one factor; its moduli stay as they are."""

    solid: Linear
    factor: float

    @property
    def poisson_ratio(self) -> float:
        return self.solid.poisson_ratio

    @property
    def glassy_modulus(self) -> float:
        """Glassy modulus of the solid [Pa]."""
        return self.solid.glassy_modulus

    def modes(self) -> Relaxation | Retardation:
        """Modes of the solid, in the form in which it states them. Raises OverflowError for times out of range."""
        stated = self.solid.modes()
        with np.errstate(over="ignore"):
            times = stated.times * self.factor
        if not ((times > 0) & (times < np.inf)).all():
            raise OverflowError(f"times longer by {self.factor:g} leave the range of numbers")
        # Two times may become one by rounding.
        if isinstance(stated, Retardation):
            return Retardation.of(stated.instantaneous, stated.compliances, times)
        shifted = Relaxation.of(stated.equilibrium, stated.moduli, times)
        return replace(shifted, viscosity=stated.viscosity * self.factor)
