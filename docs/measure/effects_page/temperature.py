"""Rubber at other temperatures than that at which it was measured, and contacts that their own friction heats."""

from collections.abc import Mapping, Sequence

import numpy as np

from compare.solving.outcome import Outcome
from compare.solving.task import SceneTask as Task
from compare.solving.task import Task as AnyTask

from .chapter import Chapter, Rows
from .figures import temperature as drawing
from .warmcontacts import (
    CONDUCTIVITIES,
    CONTACTS,
    FEEDBACKS,
    ROOM,
    RUBBING,
    SOLVERS,
    Point,
    every,
    points,
)

NAME = "temperature"


def tasks() -> list[Task]:
    """Every contact in both dimensionalities."""
    return every()


def chapter(outcomes: Mapping[AnyTask, Outcome]) -> Chapter:
    """What temperature and heat do to friction in both dimensionalities."""
    found = points(outcomes)
    rows = [vars(point) | {"reduced_speed": point.reduced_speed} for point in found]
    return Chapter(
        {"Heat in numbers": _numbers(found), "Estimates": _experiment(found)},
        {drawing.NAME: drawing.figure(rows)},
        {drawing.NAME: rows},
    )


def _numbers(found: Sequence[Point]) -> Rows:
    """How well temperatures fall onto one curve, how many are steady, and where the answer jumps."""
    cold, warm = (_several(found, feedback) for feedback in ("", "average"))
    return [
        {
            "": dimension,
            "steady temperatures": f"{len(steady(found, dimension))}",
            "the answer jumps": _jump(cold[dimension], warm[dimension]),
        }
        for dimension in SOLVERS
    ]


def steady(found: Sequence[Point], dimension: str) -> list[float]:
    """Rises of temperature [K] that friction itself makes, by straight lines between those that were solved."""
    part = [point for point in found if (point.panel, point.dimension) == ("warmer", dimension)]
    x = np.array([point.temperature - ROOM for point in part])
    excess = np.array([point.average_heating for point in part]) - x
    (crossed,) = np.nonzero(np.sign(excess[1:]) != np.sign(excess[:-1]))
    share = excess[crossed] / (excess[crossed] - excess[crossed + 1])
    return [float(rise) for rise in x[crossed] + share * (x[crossed + 1] - x[crossed])]


def _heated(found, dimension, conductivity):
    """Contact -> feedback -> point of the experiment."""
    part = [p for p in found if (p.panel, p.dimension, p.conductivity) == ("experiment", dimension, conductivity)]
    return {
        contact: {point.feedback: point for point in part if (point.load, point.speed) == contact}
        for contact in CONTACTS
    }


def _several(found, feedback):
    """Dimension -> points over the speed."""
    part = [point for point in found if (point.panel, point.feedback) == ("speed", feedback)]
    return {name: [point for point in part if point.dimension == name] for name in SOLVERS}


def _change(contact, feedback):
    """Of the loss inside the rubber with feedback [%]."""
    rubbed = RUBBING.coefficient
    return 100 * ((contact[feedback].friction - rubbed) / (contact[""].friction - rubbed) - 1)


def _jump(cold, warm):
    """Between which speeds the temperature falls most from one to the next, and friction with it."""
    rises = np.array([point.average_heating for point in warm])
    last = int(np.argmin(np.diff(np.log(rises))))
    before, after = warm[last], warm[last + 1]
    return (
        f"between {before.speed:.2g} and {after.speed:.2g} m/s from {before.average_heating:.0f} K "
        f"to {after.average_heating:.1f} K, and friction from {before.friction:.3f} to {after.friction:.3f} "
        f"(without heat {cold[last].friction:.3f} and {cold[last + 1].friction:.3f})"
    )


def _experiment(found: Sequence[Point]) -> Rows:
    """A row a contact, both dimensionalities."""
    rows = []
    for name, conductivity in CONDUCTIVITIES.items():
        both = {dimension: _heated(found, dimension, conductivity) for dimension in SOLVERS}
        for contact in CONTACTS:
            load, speed = contact
            row = {
                "indenter": f"{name}, {conductivity:g} W/(m K)",
                "F_N, N": f"{load:g}",
                "v, mm/s": f"{speed * 1e3:g}",
            }
            for dimension, heated in both.items():
                cold, average, flash = (heated[contact][feedback or ""] for feedback in FEEDBACKS)
                changes = (float(f"{_change(heated[contact], each):.2g}") for each in FEEDBACKS[1:])
                row |= {
                    f"average, K, {dimension}": f"{cold.average_heating:.3g} ({average.average_heating:.3g})",
                    f"flash, K, {dimension}": f"{cold.flash_heating:.3g} ({flash.flash_heating:.3g})",
                    f"loss inside, %, {dimension}": ", ".join(f"{change:+g}" for change in changes),
                }
            rows.append(row)
    return rows
