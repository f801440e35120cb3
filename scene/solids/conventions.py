"""Other conventions in which moduli are stated: in tension, or as shares of the instantaneous modulus."""

from dataclasses import fields
from functools import lru_cache
from math import fsum, inf, nextafter
from typing import Annotated, Any

from pydantic import ConfigDict, Field, TypeAdapter, ValidationError

from ..files.stated import filled, some_of
from ..files.tablefile import Column, read_columns
from ..quantities import (
    CLOSED,
    MODULUS,
    ROW,
    SECOND,
    TENSILE_COMPLIANCE,
    YOUNGS,
    Finite,
    NonNegative,
    Positive,
    ShearModulus,
    Time,
)
from .viscoelastic import INCOMPRESSIBLE, PoissonRatio

YoungsModulus = Annotated[Positive, YOUNGS]
_KINDS: dict[str, Any] = {
    "youngs_modulus": YoungsModulus,
    "youngs_moduli": Annotated[tuple[YoungsModulus, ...], ROW],
    "tensile_compliance": Annotated[NonNegative, TENSILE_COMPLIANCE],
    "tensile_compliances": Annotated[tuple[Annotated[Positive, TENSILE_COMPLIANCE], ...], ROW],
}
_RATIO = TypeAdapter(PoissonRatio)
INSTANT, RELAXED = "instantaneous_modulus", "equilibrium_modulus"
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


def in_tension(field: str) -> str:
    """Name under which a modulus or compliance in shear may be stated in tension, as rubbery_youngs_modulus."""
    return field.replace("modul", "youngs_modul").replace("compliance", "tensile_compliance")


def shear_modulus(modulus: float, poisson_ratio: float) -> float:
    """G = E / (2 (1 + nu)) [Pa]; of the numbers within its rounding the shortest, as 1e6 of 2.98e6 at 0.49."""
    return _shortest(modulus / (2 * (1 + poisson_ratio)))


def in_shear(cls: type, stated: dict[str, Any], *others: str) -> dict[str, Any]:
    """Fields of a solid, with moduli and compliances in shear in place of those in tension.

    others : names that may be stated in shear beside the fields of the class

    A validator before those of the fields. Raises ValueError where one is stated both ways, and ValidationError,
    with its name, where one is no number of its kind.
    """
    pairs = _pairs(cls, others)
    tensile = some_of(
        {
            name: next(kind for end, kind in _KINDS.items() if name.endswith(end))
            for name in pairs
            if name in stated
        },
        stated,
    )
    for name in tensile:
        if pairs[name] in stated:
            raise ValueError(f"{name} beside {pairs[name]}: give one of them")
    try:
        ratio = _RATIO.validate_python(stated.get("poisson_ratio", INCOMPRESSIBLE))
    except ValidationError:  # of a field, which says so itself
        ratio = INCOMPRESSIBLE
    left = {name: value for name, value in stated.items() if name not in tensile}
    return left | {pairs[name]: _each(name, value, ratio) for name, value in tensile.items()}


def absolute(cls: type, stated: dict[str, Any]) -> dict[str, Any]:
    """Fields of a Prony series, with moduli in shear in place of normalised ones.

    G_k = g_k G_0, at rest G_0 (1 - sum_k g_k), whichever of instantaneous_modulus, G_0, and equilibrium_modulus is
    stated. A validator before those of the fields. Raises ValueError where the terms leave nothing at rest, or
    contradict one another, and ValidationError, with its name, where one is no number of its kind.
    """
    stated = in_shear(cls, filled(stated, lambda table, form: read_columns(table, TERMS, form)), INSTANT)
    for name, field in (("tau", "relaxation_times"), ("g", "moduli")):
        if name in stated and field in stated:
            raise ValueError(f"{name} beside {field}: give one of them")
    if "g" not in stated and INSTANT in stated:
        raise ValueError(f"{INSTANT} goes with g, shares of it, which is missing: moduli go with {RELAXED}")
    if "g" not in stated:
        return {{"tau": "relaxation_times"}.get(name, name): value for name, value in stated.items()}
    if (INSTANT in stated) == (RELAXED in stated):
        raise ValueError(f"g are shares of a modulus: give one of {INSTANT} and {RELAXED}")
    found = some_of(_TYPES, stated)
    shares = found["g"]
    if len(shares) != len(times := found.get("tau", shares)):
        raise ValueError(f"tau has {len(times)} values, g has {len(shares)}: each share needs one time")
    if not (rest := 1 - fsum(shares)) > 0:
        raise ValueError(f"g: the sum {fsum(shares):g} leaves no modulus at rest, and must be below 1")
    at_once = found[INSTANT] if INSTANT in found else found[RELAXED] / rest
    made = {name: value for name, value in stated.items() if name not in found}
    made |= {"relaxation_times": found["tau"]} if "tau" in found else {}
    return made | {
        RELAXED: found.get(RELAXED, at_once * rest),
        "moduli": tuple(share * at_once for share in shares),
    }


def or_in_tension(schema: dict[str, Any]) -> None:
    """In JSON schema: Young's moduli and tensile compliances in place of those in shear."""
    properties, needed = schema["properties"], schema.get("required", [])
    for name in [each for each in properties if in_tension(each) != each]:
        other = in_tension(name)
        kind = _KINDS[next(end for end in _KINDS if other.endswith(end))]
        properties[other] = TypeAdapter(kind).json_schema() | {"description": f"in tension, in place of {name}"}
        if name in needed:
            needed.remove(name)
            schema.setdefault("allOf", []).append({"oneOf": [{"required": [name]}, {"required": [other]}]})


def _or_normalised(schema: dict[str, Any]) -> None:
    """In JSON schema: g, tau and the instantaneous modulus in place of those of the fields."""
    properties = schema["properties"]
    properties |= {
        "g": {"type": "array", "items": {"type": "number"}, "description": f"moduli over {INSTANT}"},
        "tau": properties["relaxation_times"] | {"description": "relaxation times that belong to g"},
        INSTANT: properties[RELAXED] | {"description": "shear modulus at t = 0, with g"},
    }
    or_in_tension(schema)
    # Which of so many stand together is checked where they are read.
    schema.pop("required", None)
    at_rest = (RELAXED, in_tension(RELAXED), INSTANT, in_tension(INSTANT))
    ways = at_rest, ("moduli", "youngs_moduli", "g", "table"), ("relaxation_times", "tau", "table")
    schema["allOf"] = [{"anyOf": [{"required": [name]} for name in names]} for names in ways]


STATED = ConfigDict(**CLOSED, json_schema_extra=or_in_tension)
NORMALISED = ConfigDict(**CLOSED, json_schema_extra=_or_normalised)


@lru_cache(maxsize=16)
def _pairs(cls, others):
    """Names in shear by those in tension."""
    names = (*(each.name for each in fields(cls)), *others)
    return {in_tension(name): name for name in names if in_tension(name) != name}


def _each(name, value, ratio):
    if isinstance(value, tuple):
        return tuple(_each(name, each, ratio) for each in value)
    return shear_modulus(value, ratio) if "youngs" in name else _shortest(value * 2 * (1 + ratio))


def _shortest(found):
    near = (found, nextafter(found, 0), nextafter(found, inf))
    return min(near, key=lambda each: len(repr(each))) if 1e-300 < found < 1e300 else found
