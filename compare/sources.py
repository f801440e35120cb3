"""Which points of a judgement each of its numbers was computed from."""

from collections.abc import Callable, Iterable, Mapping, Sequence

import numpy as np

from . import metrics
from .glossary import of_number
from .metrics import Record
from .verdict import DIMENSIONS, Number


def behind(number: Number, table: Sequence[Record]) -> list[int]:
    """Rows of the table, from 1, that a number was computed from. Raises Unknown."""
    chosen = {id(record) for record in CHOICES[of_number(number.name).id](number, table)}
    return [row for row, record in enumerate(table, 1) if id(record) in chosen]


def _slow(_, table) -> Iterable[Record]:
    above, below = min(metrics.pairs(table, "smooth"), key=lambda pair: pair[0].speed)
    return [above, below, *_grids(table, below)]


def _own(_, table) -> Iterable[Record]:
    above, below = metrics.pairs(table, "own")[0]
    return [above, below, *_grids(table, below)]


def _force_depth(smooth: bool) -> Callable[[Number, Sequence[Record]], Iterable[Record]]:
    return lambda _, table: [each for each in table if each.kind == "force-depth" and each.smooth == smooth]


def _curves(_, table) -> Iterable[Record]:
    return [each for each in table if each.kind == "load" and each.solver in DIMENSIONS]


def _collapse(number, table) -> Iterable[Record]:
    return [each for each in _curves(number, table) if number.name.endswith(DIMENSIONS[each.solver])]


def _halved(_, table) -> Iterable[Record]:
    own = metrics.select(table, "own", "BEM")
    return [*own, *(each for record in own for each in _grids(table, record))]


def _speeds(_, table) -> Iterable[Record]:
    return metrics.select(table, "speed", "BEM")


CHOICES: Mapping[str, Callable[[Number, Sequence[Record]], Iterable[Record]]] = {
    "friction-ratio-slow": _slow,
    "friction-ratio-own": _own,
    "force-deviation-smooth": _force_depth(smooth=True),
    "force-deviation-rough": _force_depth(smooth=False),
    "misfit-predicted": _curves,
    "collapse": _collapse,
    "pixel-halved": _halved,
    "friction-spread": _speeds,
}


def _grids(table, record) -> list[Record]:
    """The same point on the coarse and on the fine grid."""
    return [each for each in table if each.kind in ("coarse", "refined") and _same_place(each, record)]


def _same_place(one: Record, other: Record) -> bool:
    """What was prescribed is the same, and so is what was not."""
    return np.array_equal(_place(one), _place(other), equal_nan=True)


def _place(record: Record) -> np.ndarray:
    return np.array((record.smooth, record.speed, record.load, record.depth), dtype=float)
