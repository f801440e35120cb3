"""Moduli and compliances of every elastomer, derived from one statement of its modes; other ways to state them.

Time convention exp(i omega t): G(omega) = G'(omega) + i G''(omega), both >= 0 for omega >= 0.
"""

from dataclasses import fields
from functools import lru_cache
from math import fsum
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
from pydantic import Field, TypeAdapter, ValidationError

from ..files.stated import filled, taken
from ..files.tablefile import Column, read_columns
from ..quantities import BARE, MODULUS, SECOND, YOUNGS, Finite, Positive
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
        """Dashpot parallel to the Maxwell modes [Pa s]: G(omega) -> i omega viscosity at high frequency.

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


_RATIO = TypeAdapter(PoissonRatio)
INSTANT, RELAXED = "instantaneous_modulus", "equilibrium_modulus"
# Columns of a table of terms.
TERMS = (
    Column("relaxation_times", ("tau", "relaxation time"), (SECOND,), needed=True),
    Column("moduli", ("G",), (MODULUS,)),
    Column("youngs_moduli", ("E",), (MODULUS,)),
    Column("g", ()),
)


YOUNG: dict[str, Any] = TypeAdapter(Annotated[Positive, YOUNGS]).json_schema()  # in JSON schema


def in_tension(field: str) -> str:
    """Name under which a modulus in shear may be stated in tension, as rubbery_youngs_modulus."""
    return field.replace("modul", "youngs_modul")


def in_shear(cls: type, stated: dict[str, Any], *others: str) -> dict[str, Any]:
    """Fields of a solid, with moduli in shear, G = E / (2 (1 + nu)), in place of those in tension.

    others : names that may be stated in shear besides the fields of the class

    A validator before those of the fields. Raises ValueError where one is stated both ways, and
    ValidationError, with its name, where one is no number.
    """
    try:
        ratio = _RATIO.validate_python(stated.get("poisson_ratio", INCOMPRESSIBLE))
    except ValidationError:  # of a field, which says so itself
        ratio = INCOMPRESSIBLE
    found = dict(stated)
    for name in (*(each.name for each in fields(cls)), *others):
        if (tensile := in_tension(name)) == name or tensile not in stated:
            continue
        if name in stated:
            raise ValueError(f"{tensile} and {name}: give one of them")
        take = YOUNGS.row if name.endswith("moduli") else YOUNGS.value
        moduli = np.array(taken(tensile, stated, take))
        found[name] = (moduli / (2 * (1 + ratio))).tolist()
        del found[tensile]
    return found


def absolute(cls: type, stated: dict[str, Any]) -> dict[str, Any]:
    """Fields of a Prony series, with moduli in shear in place of normalised ones.

    G_k = g_k G_0, at rest G_0 (1 - sum_k g_k), whichever of instantaneous_modulus, G_0, and equilibrium_modulus is
    stated. A validator before those of the fields. Raises ValueError where the terms leave nothing at rest, or
    contradict one another, and ValidationError where one is no number.
    """
    found = in_shear(cls, filled(stated, lambda table, form: read_columns(table, TERMS, form)), INSTANT)
    for name, field in (("tau", "relaxation_times"), ("g", "moduli")):
        if name in found and field in found:
            raise ValueError(f"{name} and {field}: give one of them")
    if "tau" in found:
        found["relaxation_times"] = found.pop("tau")
    if "g" not in found:
        if INSTANT in found:
            raise ValueError(f"{INSTANT} goes with g, shares of it, which is missing: moduli go with {RELAXED}")
        return found
    if (INSTANT in found) == (RELAXED in found):
        raise ValueError(f"g are shares of a modulus: give one of {INSTANT} and {RELAXED}")
    shares = taken("g", found, BARE.row)
    if not (min(shares, default=1.0) > 0 and (rest := 1 - fsum(shares)) > 0):
        raise ValueError(f"g: the sum {fsum(shares):g} leaves no modulus at rest: each above 0, their sum below 1")
    stated_as = INSTANT if INSTANT in found else RELAXED
    modulus = taken(stated_as, found, MODULUS.value)
    at_once = modulus if stated_as == INSTANT else modulus / rest
    left = {name: value for name, value in found.items() if name not in ("g", INSTANT)}
    return left | {RELAXED: at_once * rest, "moduli": [share * at_once for share in shares]}
