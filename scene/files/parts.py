"""Parts of a scene in words: each in a line, or by its fields with their units."""

from collections.abc import Iterator, Mapping
from dataclasses import MISSING, Field, fields, is_dataclass
from typing import Any, get_args, get_type_hints

from ..motion import UNITS, Program
from ..quantities import Unit

FEW = 4  # of a part's values or stages, that are said one by one


def rows(parts: Mapping[str, Any]) -> Iterator[tuple[str, str, str]]:
    """Names, values and units: the kind of each part, and below it its fields, those that are absent left out."""
    for name, part in parts.items():
        yield name, type(part).__name__, ""
        for each in fields(part):
            value, unit = getattr(part, each.name), unit_of(type(part), each.name) or ""
            if each.repr and value is not None:
                yield f"{name}.{each.name}", value if isinstance(value, str) else said(value), unit


def said(part: Any) -> str:
    """A part of a scene in a line: its type, and of its fields those that say something."""
    match part:
        case Program() if len(part.stages) > FEW:
            return _summed_up(part)
        case tuple() if len(part) > FEW and all(isinstance(value, float) for value in part):
            return f"{len(part)} from {min(part):g} to {max(part):g}"
        case tuple():
            return f"({', '.join(map(said, part))})"
    if not is_dataclass(part):
        return f"{part:g}" if isinstance(part, float) else repr(part)
    stated = (each for each in fields(part) if each.repr and not _usual(each, getattr(part, each.name)))
    return f"{type(part).__name__}({', '.join(f'{e.name}={said(getattr(part, e.name))}' for e in stated)})"


def _summed_up(program):
    """A program of many stages."""
    speeds = [stage.speed for stage in program.stages]
    swings = sum(stage.oscillation is not None for stage in program.stages)
    return (
        f"Program({len(speeds)} stages{f', {swings} of them oscillating' if swings else ''}, "
        f"{program.duration:g} s, path {program.length:g} m, speed {min(speeds):g} to {max(speeds):g} m/s, "
        f"{program.pressed_by} up to {program.greatest:g} {UNITS[program.pressed_by]})"
    )


def _usual(declared: Field, value: Any) -> bool:
    default = declared.default
    return default is not MISSING and type(value) is type(default) and value == default


def unit_of(cls: type, field: str) -> str | None:
    """Symbol of the unit of a field of a dataclass, of each entry where there are several; None without one.

    Raises KeyError where there is no such field.
    """
    parts = [get_type_hints(cls, include_extras=True)[field]]
    for part in parts:  # which grows by the arguments of each
        if isinstance(part, Unit):
            return part.symbol
        parts += get_args(part)
    return None
