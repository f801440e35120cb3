"""Contests as tables: every rung with all of its errors and costs, and the orders observed."""

from collections.abc import Iterator, Sequence
from typing import Any

from .contest import Climbed, Judged, Quantity

# Of a solver, where it has them.
SETTINGS = ("points", "tolerance", "steps", "precision", "extent")


def rungs(found: Sequence[Judged]) -> list[dict[str, Any]]:
    """A row for each rung and quantity; relative errors, times [s], memory [bytes]."""
    return [row for judged, climbed, quantity in _curves(found) for row in _rungs(judged, climbed, quantity)]


def orders(found: Sequence[Judged]) -> list[dict[str, Any]]:
    """A row for each ladder and quantity; NaN where too few rungs show an error of their own."""
    rows = []
    for judged, climbed, quantity in _curves(found):
        order = judged.order(climbed, quantity.name)
        said = {"order": order.order, "standard_error": order.deviation, "rungs": order.count}
        rows.append({**_named(judged, climbed, quantity), "setting": climbed.ladder.setting, **said})
    return rows


def _curves(found) -> Iterator[tuple[Judged, Climbed, Quantity]]:
    for judged in found:
        for climbed in judged.climbed:
            for quantity in judged.contest.quantities:
                if quantity.name in judged.known:
                    yield judged, climbed, quantity


def _named(judged, climbed, quantity):
    return {
        "contest": judged.contest.name,
        "quantity": quantity.name,
        "solver": climbed.ladder.rungs[0].solver.name,
        "ladder": climbed.ladder.label,
    }


def _rungs(judged, climbed, quantity):
    known = judged.known[quantity.name]
    for k, (rung, value) in enumerate(zip(climbed.ladder.rungs, climbed.ladder.values, strict=True)):
        yield {
            **_named(judged, climbed, quantity),
            "setting": climbed.ladder.setting,
            "value": value,
            **{name: getattr(rung.solver, name, "") for name in SETTINGS},
            "relative_error": climbed.errors[quantity.name][k],
            "reference": judged.contest.truth.source,
            "reference_error": known.relative_error,
            "processor": climbed.processor[k],
            "wall": climbed.wall[k],
            "memory": climbed.memory[k],
            "applications": climbed.applications[k],
            "reason": climbed.reasons[k] or "",
        }
