"""Other conventions in which moduli are stated: in tension, or as shares of the instantaneous modulus."""

from dataclasses import fields
from math import fsum
from typing import Annotated, Any

import numpy as np
from pydantic import TypeAdapter, ValidationError

from ..files.stated import filled
from ..files.tablefile import Column, read_columns
from ..quantities import BARE, MODULUS, SECOND, YOUNGS, Positive, argument
from .viscoelastic import INCOMPRESSIBLE, PoissonRatio

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

    A validator before those of the fields. Raises ValueError where one is stated both ways, or is no number.
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
            raise ValueError(f"{tensile} beside {name}: give one of them")
        take = YOUNGS.row if name.endswith("moduli") else YOUNGS.value
        moduli = np.array(argument(tensile, found.pop(tensile), take))
        found[name] = (moduli / (2 * (1 + ratio))).tolist()
    return found


def absolute(cls: type, stated: dict[str, Any]) -> dict[str, Any]:
    """Fields of a Prony series, with moduli in shear in place of normalised ones.

    G_k = g_k G_0, at rest G_0 (1 - sum_k g_k), whichever of instantaneous_modulus, G_0, and equilibrium_modulus is
    stated. A validator before those of the fields. Raises ValueError where the terms leave nothing at rest, or
    contradict one another, and where one is no number.
    """
    found = in_shear(cls, filled(stated, lambda table, form: read_columns(table, TERMS, form)), INSTANT)
    for name, field in (("tau", "relaxation_times"), ("g", "moduli")):
        if name in found and field in found:
            raise ValueError(f"{name} beside {field}: give one of them")
    if "tau" in found:
        found["relaxation_times"] = found.pop("tau")
    if "g" not in found:
        if INSTANT in found:
            raise ValueError(f"{INSTANT} goes with g, shares of it, which is missing: moduli go with {RELAXED}")
        return found
    if (INSTANT in found) == (RELAXED in found):
        raise ValueError(f"g are shares of a modulus: give one of {INSTANT} and {RELAXED}")
    shares = argument("g", found.pop("g"), BARE.row)
    if not (min(shares, default=1.0) > 0 and (rest := 1 - fsum(shares)) > 0):
        raise ValueError(f"g: the sum {fsum(shares):g} leaves no modulus at rest: each above 0, their sum below 1")
    stated_as = INSTANT if INSTANT in found else RELAXED
    modulus = argument(stated_as, found.pop(stated_as), MODULUS.value)
    at_once = modulus if stated_as == INSTANT else modulus / rest
    return found | {RELAXED: at_once * rest, "moduli": [share * at_once for share in shares]}
