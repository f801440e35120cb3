"""Prony series as finite element codes state them: moduli relative to the instantaneous one."""

from math import fsum
from typing import Annotated, Any

from pydantic import ConfigDict, Field

from ..files.tablefile import Column, filled, read_columns
from ..quantities import CLOSED, MODULUS, ROW, SECOND, Finite, ShearModulus, Time, by_name
from .youngs import in_shear, in_tension, or_in_tension, some_of

INSTANT, RELAXED = "instantaneous_modulus", "equilibrium_modulus"
_MEANT = {"tau": "relaxation_times", "g": "moduli"}
_TYPES: dict[str, Any] = {
    "g": Annotated[tuple[Annotated[Finite, Field(gt=0, lt=1)], ...], ROW],
    "tau": Annotated[tuple[Time, ...], ROW],
    INSTANT: ShearModulus,
    RELAXED: ShearModulus,
}


# Columns of a table of terms.
TERMS = (
    Column("relaxation_times", ("tau", "relaxation time"), (SECOND,), needed=True),
    Column("moduli", ("G",), (MODULUS,)),
    Column("youngs_moduli", ("E",), (MODULUS,)),
    Column("g", ()),
)


def absolute(cls: type, given: Any) -> Any:
    """Fields of a Prony series, with moduli in shear in place of normalised ones.

    G_k = g_k G_0, at rest G_0 (1 - sum_k g_k), whichever of instantaneous_modulus, G_0, and equilibrium_modulus is
    stated. A validator before those of the fields. Raises ValueError where the terms leave nothing at rest, or
    contradict one another, and ValidationError, with its name, where one is no number of its kind.
    """
    if (stated := by_name(given)) is not None:
        given = filled(stated, lambda table, form: read_columns(table, TERMS, form).values)
    given = in_shear(cls, given, INSTANT)
    stated = by_name(given)
    if stated is None or stated.keys().isdisjoint(("g", "tau", INSTANT)):
        return given
    for name, field in _MEANT.items():
        if name in stated and field in stated:
            raise ValueError(f"{name} beside {field}: give one of them")
    if "g" not in stated and INSTANT in stated:
        raise ValueError(f"{INSTANT} goes with g, shares of it, which is missing: moduli go with {RELAXED}")
    if "g" in stated and (INSTANT in stated) == (RELAXED in stated):
        raise ValueError(f"g are shares of a modulus: give one of {INSTANT} and {RELAXED}")
    found = some_of(_TYPES, stated)
    made = {name: value for name, value in stated.items() if name not in found}
    if "tau" in found:
        made["relaxation_times"] = found["tau"]
    if "g" not in found:
        return made | {name: value for name, value in found.items() if name == RELAXED}
    shares = found["g"]
    if len(shares) != len(times := found.get("tau", shares)):
        raise ValueError(f"tau has {len(times)} values, g has {len(shares)}: each share needs one time")
    if not (rest := 1 - fsum(shares)) > 0:
        raise ValueError(f"g: the sum {fsum(shares):g} leaves no modulus at rest, and must be below 1")
    at_once = found[INSTANT] if INSTANT in found else found[RELAXED] / rest
    return made | {
        RELAXED: found.get(RELAXED, at_once * rest),
        "moduli": tuple(share * at_once for share in shares),
    }


def _or_normalised(schema: dict[str, Any]) -> None:
    """In JSON schema: g, tau and the instantaneous modulus in place of those of the fields."""
    properties = schema["properties"]
    number, times = properties[RELAXED], properties["relaxation_times"]
    properties |= {
        "g": {"type": "array", "items": {"type": "number"}, "description": f"moduli over {INSTANT}"},
        "tau": times | {"description": "relaxation times that belong to g"},
        INSTANT: number | {"title": "Instantaneous Modulus", "description": "shear modulus at t = 0, with g"},
    }
    or_in_tension(schema)
    # Which of so many stand together is checked where they are read.
    schema.pop("required", None)
    at_rest = (RELAXED, in_tension(RELAXED), INSTANT, in_tension(INSTANT))
    ways = at_rest, ("moduli", "youngs_moduli", "g", "table"), ("relaxation_times", "tau", "table")
    schema["allOf"] = [{"anyOf": [{"required": [name]} for name in names]} for names in ways]


NORMALISED = ConfigDict(**CLOSED, json_schema_extra=_or_normalised)
