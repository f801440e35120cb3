"""Temperature of the elastomer: one factor on all its times (thermorheologically simple solids)."""

from dataclasses import dataclass as plain
from dataclasses import replace
from math import exp, log
from typing import TYPE_CHECKING, Annotated, Literal

import numpy as np
from pydantic import Field, model_validator
from pydantic.dataclasses import dataclass

from ..files.stated import FORM, alternatives, filled, restated
from ..files.tablefile import Column, read_columns
from ..quantities import (
    CLOSED,
    KELVIN,
    ROW,
    AbsoluteTemperature,
    MolarEnergy,
    Positive,
    TemperatureDifference,
)
from ..solids.modes import Relaxation, Retardation
from ..solids.viscoelastic import Linear

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


@plain(frozen=True)
class TemperatureLaw:
    """A law of the shift.

    temperature, reference : T of the scene and T_r, at which the elastomer is stated [K]
    """

    if TYPE_CHECKING:
        temperature: float
        reference: float

    @property
    def log_shift(self) -> float:
        """ln a_T."""
        raise NotImplementedError

    @property
    def shift(self) -> float:
        """a_T, by which all times are longer than at the reference; 1 there."""
        return exp(self.log_shift)

    @property
    def stiffer(self) -> float:
        """b_T, by which all moduli are higher than at the reference; 1 there."""
        return 1.0


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class WLF(TemperatureLaw):
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
class Arrhenius(TemperatureLaw):
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


TEMPERATURES = Column("temperatures", ("T", "temperature"), (KELVIN,), needed=True, unit_needed=True)
FACTORS = Column("a_T", ("shift factor",), needed=True), Column("b_T", ("vertical shift factor",))


def _columns(table, form):
    return read_columns(table, (TEMPERATURES, *FACTORS), form)


_OF_A_TABLE = alternatives("temperatures", "a_T", table={"type": "string"}, **FORM)


@dataclass(frozen=True, config=_OF_A_TABLE, kw_only=True)
class ShiftFactors(TemperatureLaw):
    """Measured shift factors: times are a_T times as long as where a_T is 1, and moduli b_T times as high.

    Between the temperatures ln a_T is linear in 1/T, and b_T in T.

    temperature, reference : T of the scene and T_r, at which the elastomer is stated [K], within the temperatures
    temperatures : at least two [K]
    a_T, b_T : at each of them [1]; a_T falls with the temperature; b_T is 1 where it is absent
    table : with the columns T, a_T and, if there is one, b_T, in place of these three; with
        columns, units, where, separator, decimal, encoding, skip, rows as `stated.TableFormat` has them
    """

    temperature: AbsoluteTemperature
    reference: AbsoluteTemperature
    temperatures: Annotated[tuple[AbsoluteTemperature, ...], ROW, Field(min_length=2)]
    a_T: Annotated[tuple[Positive, ...], ROW]  # noqa: N815 - as the field writes it
    b_T: Annotated[tuple[Positive, ...], ROW] | None = None  # noqa: N815
    type: Literal["shift-factors"] = Field(default="shift-factors", repr=False)

    _of_table = restated(lambda cls, stated: filled(stated, _columns))

    @model_validator(mode="after")
    def _fall(self):
        count = len(self.temperatures)
        if len(self.a_T) != count or len(self.b_T or self.a_T) != count:
            raise ValueError(f"a_T and b_T have to be given at each of the {count} temperatures")
        kelvin, factors = self._ordered(self.a_T)
        if not ((np.diff(kelvin) > 0) & (np.diff(factors) <= 0)).all():
            raise ValueError("a_T has to fall from each temperature to the next: times grow shorter")
        low, high = kelvin[[0, -1]]
        for name, given in (("temperature", self.temperature), ("reference", self.reference)):
            if not low <= given <= high:
                raise ValueError(f"{name} = {given:g} K: shift factors are known from {low:g} to {high:g} K")
        return _within_range(self)

    def _ordered(self, factors):
        """Temperatures that grow, and the factors there."""
        order = np.argsort(self.temperatures)
        return np.array([self.temperatures, factors])[:, order]

    @property
    def log_shift(self) -> float:
        """ln a_T from the reference to the temperature."""
        kelvin, factors = self._ordered(self.a_T)
        here, there = np.interp([-1 / self.temperature, -1 / self.reference], -1 / kelvin, np.log(factors))
        return float(here - there)

    @property
    def stiffer(self) -> float:
        """b_T at the temperature over b_T at the reference."""
        here, there = np.interp(
            [self.temperature, self.reference], *self._ordered(self.b_T or np.ones(len(self.temperatures)))
        )
        return float(here / there)


Temperature = Annotated[WLF | Arrhenius | ShiftFactors, Field(discriminator="type")]


@plain(frozen=True)
class Shifted(Linear):
    """A solid all of whose times are longer by one factor, and all moduli higher by another."""

    solid: Linear
    factor: float
    stiffer: float = 1.0

    @property
    def poisson_ratio(self) -> float:
        return self.solid.poisson_ratio

    @property
    def glassy_modulus(self) -> float:
        """Glassy modulus of the solid [Pa]."""
        return self.solid.glassy_modulus * self.stiffer

    def modes(self) -> Relaxation | Retardation:
        """Modes of the solid, in the form in which it states them. Raises OverflowError for times out of range."""
        stated = self.solid.modes()
        with np.errstate(over="ignore"):
            times = stated.times * self.factor
        if not ((times > 0) & (times < np.inf)).all():
            raise OverflowError(f"times longer by {self.factor:g} leave the range of numbers")
        # Two times may become one by rounding.
        if isinstance(stated, Retardation):
            return Retardation.of(stated.instantaneous / self.stiffer, stated.compliances / self.stiffer, times)
        shifted = Relaxation.of(stated.equilibrium * self.stiffer, stated.moduli * self.stiffer, times)
        return replace(shifted, viscosity=stated.viscosity * self.factor * self.stiffer)
