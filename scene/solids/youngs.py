"""Young's moduli in place of shear moduli: E = 2 G (1 + nu), by the Poisson ratio that the solid states."""

from collections.abc import Iterable, Mapping
from dataclasses import fields
from functools import lru_cache
from math import inf, nextafter
from typing import Annotated, Any

from pydantic import ConfigDict, TypeAdapter, ValidationError, create_model

from ..quantities import CLOSED, ROW, TENSILE_COMPLIANCE, YOUNGS, NonNegative, Positive, by_name
from .viscoelastic import INCOMPRESSIBLE, PoissonRatio

YoungsModulus = Annotated[Positive, YOUNGS]
_KINDS: Mapping[str, Any] = {
    "youngs_modulus": YoungsModulus,
    "youngs_moduli": Annotated[tuple[YoungsModulus, ...], ROW],
    "tensile_compliance": Annotated[NonNegative, TENSILE_COMPLIANCE],
    "tensile_compliances": Annotated[tuple[Annotated[Positive, TENSILE_COMPLIANCE], ...], ROW],
}
_RATIO = TypeAdapter(PoissonRatio)


def in_tension(field: str) -> str:
    """Name under which a modulus or compliance in shear may be stated in tension, as rubbery_youngs_modulus."""
    named = field.replace("modulus", "youngs_modulus").replace("moduli", "youngs_moduli")
    return named.replace("compliance", "tensile_compliance")


def shear_modulus(modulus: float, poisson_ratio: float) -> float:
    """G = E / (2 (1 + nu)) [Pa]; of the numbers within its rounding the shortest, as 1e6 of 2.98e6 at 0.49."""
    return _shortest(modulus / (2 * (1 + poisson_ratio)))


def in_shear(cls: type, given: Any, *others: str) -> Any:
    """Fields of a solid, with moduli and compliances in shear in place of those in tension.

    others : names that may be stated in shear beside the fields of the class

    A validator before those of the fields. Raises ValueError where one is stated both ways, and ValidationError,
    with its name, where one is no number of its kind.
    """
    stated = by_name(given)
    pairs = _pairs(cls, others)
    if stated is None or pairs.keys().isdisjoint(stated):
        return given
    kinds = {name: next(kind for end, kind in _KINDS.items() if name.endswith(end)) for name in pairs}
    tensile = some_of(kinds, stated)
    for name in tensile:
        if pairs[name] in stated:
            raise ValueError(f"{name} beside {pairs[name]}: give one of them")
    try:
        ratio = _RATIO.validate_python(stated.get("poisson_ratio", INCOMPRESSIBLE))
    except ValidationError:  # of a field, which says so itself
        ratio = INCOMPRESSIBLE
    left = {name: value for name, value in stated.items() if name not in tensile}
    return left | {pairs[name]: _each(name, value, ratio) for name, value in tensile.items()}


def some_of(types: Mapping[str, Any], stated: Mapping[str, Any]) -> dict[str, Any]:
    """Values of what is stated that have one of these names, each as its type.

    Raises ValidationError, in which a value has its name, as one of a field has.
    """
    found = {name: stated[name] for name in types if name in stated}
    whole: Any = create_model("Stated", **{name: (types[name], ...) for name in found})  # type: ignore[call-overload]
    return dict(whole(**found))


def or_in_tension(schema: dict[str, Any]) -> None:
    """In JSON schema: Young's moduli and tensile compliances in place of those in shear."""
    properties, needed = schema["properties"], schema.get("required", [])
    for name in _both_ways(list(properties)):
        other = in_tension(name)
        properties[other] = _bare(properties[name]) | {"description": f"in tension, in place of {name}"}
        if name in needed:
            needed.remove(name)
            schema.setdefault("allOf", []).append({"oneOf": [{"required": [name]}, {"required": [other]}]})


STATED = ConfigDict(**CLOSED, json_schema_extra=or_in_tension)


def _bare(schema):
    """A schema without what is said of its parts."""
    if isinstance(schema, list):
        return [_bare(each) for each in schema]
    if not isinstance(schema, dict):
        return schema
    return {name: _bare(each) for name, each in schema.items() if name not in ("description", "examples", "title")}


@lru_cache(maxsize=16)
def _pairs(cls, others):
    """Names in shear by those in tension."""
    return {in_tension(name): name for name in _both_ways([*(each.name for each in fields(cls)), *others])}


def _both_ways(names: Iterable[str]) -> list[str]:
    return [name for name in names if in_tension(name) != name]


def _each(name, value, ratio):
    if isinstance(value, tuple):
        return tuple(_each(name, each, ratio) for each in value)
    return shear_modulus(value, ratio) if "youngs" in name else _shortest(value * 2 * (1 + ratio))


def _shortest(found):
    near = (found, nextafter(found, 0), nextafter(found, inf))
    return min(near, key=lambda each: len(repr(each))) if 1e-300 < found < 1e300 else found
