"""Solids stated by their springs and dashpots, and the list of all that a scene may be made of."""

from typing import Annotated, Literal

from pydantic import Field, model_validator
from pydantic.dataclasses import dataclass

from ..files.stated import FORM, alternatives, restated
from ..quantities import CLOSED, ROW, Compliance, ComplianceOrZero, ShearModulus, Time
from .fractional import Fractional
from .modes import Relaxation, Retardation
from .tabulated import Tabulated
from .viscoelastic import INSTANT, RELAXED, YOUNG, Linear, PoissonRatio, Solid, absolute, in_shear, in_tension

MOST_MODES = 200  # of a solid: no measurement tells more apart
_SOME = Field(min_length=1, max_length=MOST_MODES)
ShearModuli = Annotated[tuple[ShearModulus, ...], ROW, _SOME]
Compliances = Annotated[tuple[Compliance, ...], ROW, _SOME]
Times = Annotated[tuple[Time, ...], ROW, _SOME]


@dataclass(frozen=True, config=alternatives("modulus", youngs_modulus=YOUNG))
class Elastic(Solid):
    """Elastic solid. modulus: shear modulus [Pa]."""

    modulus: ShearModulus
    poisson_ratio: PoissonRatio = 0.5
    type: Literal["elastic"] = Field(default="elastic", repr=False)

    _in_tension = restated(in_shear)

    def modes(self) -> Relaxation:
        return Relaxation.of(self.modulus)


@dataclass(frozen=True, config=alternatives("modulus", youngs_modulus=YOUNG))
class Kelvin(Solid):
    """Kelvin-Voigt solid, G(omega) = modulus * (1 + i omega relaxation_time).

    modulus : static shear modulus [Pa]
    relaxation_time : viscosity over modulus [s]
    """

    modulus: ShearModulus
    relaxation_time: Time
    poisson_ratio: PoissonRatio = 0.5
    type: Literal["kelvin"] = Field(default="kelvin", repr=False)

    _in_tension = restated(in_shear)

    def modes(self) -> Retardation:
        return Retardation.of(0.0, (1 / self.modulus,), (self.relaxation_time,))


@dataclass(
    frozen=True,
    config=alternatives(
        "rubbery_modulus", "glassy_modulus", rubbery_youngs_modulus=YOUNG, glassy_youngs_modulus=YOUNG
    ),
)
class StandardLinearSolid(Linear):
    """Standard linear solid, G(t) = rubbery + (glassy - rubbery) exp(-t / relaxation_time).

    rubbery_modulus, glassy_modulus : shear moduli [Pa], rubbery < glassy
    relaxation_time : of the modulus at constant strain [s]; the retardation time is longer by glassy / rubbery

    >>> from scene import StandardLinearSolid
    >>> solid = StandardLinearSolid(rubbery_modulus=1e6, glassy_modulus=1e7, relaxation_time=1e-3)
    >>> print(f"{solid.complex_modulus(1e3):.2e} Pa")
    5.50e+06+4.50e+06j Pa
    """

    rubbery_modulus: ShearModulus
    glassy_modulus: ShearModulus
    relaxation_time: Time
    poisson_ratio: PoissonRatio = 0.5
    type: Literal["standard-linear-solid"] = Field(default="standard-linear-solid", repr=False)

    _in_tension = restated(in_shear)

    @model_validator(mode="after")
    def _stiffens_with_frequency(self):
        if not self.rubbery_modulus < self.glassy_modulus:
            raise ValueError(
                f"glassy_modulus = {self.glassy_modulus:g} must exceed rubbery_modulus = {self.rubbery_modulus:g}"
            )
        return self

    def modes(self) -> Relaxation:
        rubbery = self.rubbery_modulus
        return Relaxation.of(rubbery, (self.glassy_modulus - rubbery,), (self.relaxation_time,))


_OF_PRONY = alternatives(
    *(RELAXED, "moduli", "relaxation_times"),
    **dict.fromkeys((INSTANT, in_tension(INSTANT), in_tension(RELAXED)), YOUNG),
    **{name: {"type": "array"} for name in ("youngs_moduli", "g", "tau")},
    table={"type": "string"},
    **FORM,
)


@dataclass(frozen=True, config=_OF_PRONY)
class Prony(Solid):
    """Generalized Maxwell solid, G(t) = equilibrium_modulus + sum_k moduli[k] exp(-t / relaxation_times[k]).

    equilibrium_modulus : shear modulus at rest [Pa]
    moduli, relaxation_times : of each Maxwell branch [Pa], [s]; 1 to 200, equally many
    table : with the columns tau, and G, E or g, in place of these two; with columns, units, where, separator,
        decimal, encoding, skip, rows as `stated.TableFormat` has them
    """

    equilibrium_modulus: ShearModulus
    moduli: ShearModuli
    relaxation_times: Times
    poisson_ratio: PoissonRatio = 0.5
    type: Literal["prony"] = Field(default="prony", repr=False)

    _stated_otherwise = restated(absolute)

    @model_validator(mode="after")
    def _one_time_a_modulus(self):
        _one_each("modulus", "relaxation time", moduli=self.moduli, relaxation_times=self.relaxation_times)
        return self

    def modes(self) -> Relaxation:
        return Relaxation.of(self.equilibrium_modulus, self.moduli, self.relaxation_times)


@dataclass(frozen=True, config=CLOSED)
class KelvinChain(Solid):
    """Kelvin elements in series with a spring: a Prony series in retardation form,

    J(t) = instantaneous_compliance + sum_k compliances[k] (1 - exp(-t / retardation_times[k])).

    instantaneous_compliance : in shear [1/Pa], >= 0; at 0 the glassy modulus is infinite, as for Kelvin
    compliances, retardation_times : of each element [1/Pa], [s]; 1 to 200, equally many
    """

    instantaneous_compliance: ComplianceOrZero
    compliances: Compliances
    retardation_times: Times
    poisson_ratio: PoissonRatio = 0.5
    type: Literal["kelvin-chain"] = Field(default="kelvin-chain", repr=False)

    @model_validator(mode="after")
    def _one_time_a_compliance(self):
        _one_each(
            "compliance",
            "retardation time",
            compliances=self.compliances,
            retardation_times=self.retardation_times,
        )
        return self

    def modes(self) -> Retardation:
        return Retardation.of(self.instantaneous_compliance, self.compliances, self.retardation_times)


def _one_each(amount, time, **fields):
    (first, amounts), (second, times) = fields.items()
    if len(amounts) != len(times):
        raise ValueError(
            f"{second} has {len(times)} values, {first} has {len(amounts)}: each {amount} needs one {time}"
        )


Elastomer = Annotated[
    Elastic | Kelvin | StandardLinearSolid | Prony | KelvinChain | Fractional | Tabulated,
    Field(discriminator="type"),
]
