"""Forecasts by the laws of cost: the largest grid, a machine's memory, and very many surfaces."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import isfinite, nan

import numpy as np

from ...solving.amounts import HOUR
from ...solving.parameter_grid import SOLVED
from ...statistics.costs import REPEATABLE, Law, NoLaw, held_out
from .cost_fit import MEMORY_FROM, CostFit

LARGEST = 16384  # points a side that the 3D solver takes at most
GIBIBYTE = 2.0**30
MEMORIES = (24, 64, 128)  # of machines [GiB]
SURFACES = 10**5
# Rough ladders that stand for an ensemble, with the points that it takes: some that were measured.
ENSEMBLES = {"plane": (256, 512), "slide-rough": (256, 512), "mdr-rough": (5000, 10**5)}


@dataclass(frozen=True)
class Forecast:
    """One number that a law gives, with its interval of 95 % for one more measurement, NaN where not known.

    ladder : name of what the law was fitted to; title : for people
    what : is forecast; kind : short name of that
    found : the same as measured, NaN where it was not
    reason : why there is none, empty where there is one
    """

    ladder: str
    title: str
    kind: str
    what: str
    unit: str
    value: float = nan
    low: float = nan
    high: float = nan
    found: float = nan
    reason: str = ""

    @property
    def held(self) -> bool | None:
        """Whether the number found lies in the interval; None where nothing was found, or nothing forecast."""
        if self.reason or not isfinite(self.found):
            return None
        return self.low <= self.found <= self.high

    @property
    def factor(self) -> float:
        """Factor by which the forecast missed what was found."""
        return max(self.found / self.value, self.value / self.found)


def forecasts(fits: Sequence[CostFit]) -> list[Forecast]:
    """Forecasts of all ladders of points: held-out points first, as they say how far to trust the others."""
    by_points = {each.name: each for each in fits if each.setting == "points"}
    checks = {name: _checks(each) for name, each in by_points.items()}
    found = [check for own in checks.values() for check in own.values()]
    for name, each in by_points.items():
        if each.dimension == "3D":
            found += _largest(each, checks[name])
    for name, points in ENSEMBLES.items():
        if name in by_points:
            found += _ensembles(by_points[name], points)
    return found


def _checks(each) -> dict[str, Forecast]:
    """The largest grid from those below it: its time, and its memory."""
    found = {}
    for what, unit, cost, size, least in (
        ("time", "s", "processor", 1.0, 0),
        ("memory", "GiB", "memory", GIBIBYTE, MEMORY_FROM),
    ):
        x, law, seen = held_out(each.known("x", least), each.known(cost, least) / size)
        found[what] = _of(
            law, x, each, f"held-out-{what}", f"{what} with {x:g} points, from fewer", unit, found=seen
        )
    return found


def _largest(each, checks) -> Iterator[Forecast]:
    """Forecast of the largest size; none from a law that has missed already by more than scatter."""
    time, memory = (
        _unless_missed(each.laws[cost], checks[what])
        for cost, what in (("processor", "time"), ("memory", "memory"))
    )
    yield _of(time, LARGEST, each, "largest-time", f"time with {LARGEST}² points", "s")
    yield _of(memory, LARGEST, each, "largest-memory", f"memory with {LARGEST}² points", "GiB", 1 / GIBIBYTE)
    for size in MEMORIES:
        told = each.name, each.title, f"points-in-{size}-gib", f"points a side that {size} GiB hold", "1"
        if isinstance(memory, NoLaw):
            yield Forecast(*told, reason=memory.reason)
        else:
            yield Forecast(*told, *memory.reach(size * GIBIBYTE))


def _unless_missed(law, check):
    if check.held is not False or check.factor <= 1 + REPEATABLE:
        return law
    return NoLaw(f"without its largest grid the law misses it by a factor of {check.factor:.2g}", nan, nan, nan)


def _ensembles(each, points) -> Iterator[Forecast]:
    """Time of one surface times their number: how that scatters between surfaces is not known."""
    for n in points:
        grid = f"{n} points" if each.dimension == "1D" else f"{n}² points"
        told = each.name, each.title, f"surfaces-{n}", f"{SURFACES} surfaces with {grid}", "core hours"
        measured = each.known("processor")[each.known("x") == n]
        if np.isfinite(measured).any():
            yield Forecast(*told, float(measured[0]) * SURFACES / HOUR)
        else:
            yield Forecast(*told, reason="not measured")
    rows = each.known("stored_bytes")[each.known("status") == SOLVED]
    if len(rows):
        low, middle, high = (float(SURFACES * f(rows) / GIBIBYTE) for f in (np.min, np.median, np.max))
        what = f"rows of {SURFACES} surfaces on disk"
        yield Forecast(each.name, each.title, "stored", what, "GiB", middle, low, high)


def _of(law: Law | NoLaw, x, each, kind, what, unit, times=1.0, found=nan):
    if isinstance(law, NoLaw):
        return Forecast(each.name, each.title, kind, what, unit, found=found, reason=law.reason)
    low, high = law.interval(x)
    return Forecast(each.name, each.title, kind, what, unit, times * law.at(x), times * low, times * high, found)
