"""Costs measured along ladders, the laws they follow, and what those say of sizes that no one has waited for."""

import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import nan
from pathlib import Path

import numpy as np

from ..outcome import Outcome
from ..store import Store, Task
from . import forecast
from .bill import Bill
from .contest import Ladder
from .costladders import AXES, ladders
from .rung import Rung


@dataclass(frozen=True)
class Costed:
    """All ladders measured, by name, and what follows from their laws."""

    bills: Mapping[str, Bill]
    forecasts: tuple[forecast.Forecast, ...]


@dataclass(frozen=True)
class CostStudy:
    """What costs are asked of the solvers.

    name : of the command and of files; title, about : for people
    """

    name: str
    title: str
    about: str

    def untimed(self, size: str) -> list[Task]:
        """As of Inquiry: there is nothing to measure against."""
        return []

    def timed(self, size: str) -> list[Rung]:
        """As of Inquiry."""
        return list(dict.fromkeys(rung for ladder in ladders(size).values() for rung in ladder.rungs))

    def judge(self, size: str, outcomes: Mapping[Task, Outcome]) -> Costed:
        """Bills and forecasts."""
        bills = {name: billed(ladder, outcomes) for name, ladder in ladders(size).items()}
        return Costed(bills, tuple(forecast.forecasts(bills)))

    def advice(self, costed: Costed) -> str:
        """A paragraph that a reader can act on."""
        return forecast.advice(costed.bills, costed.forecasts)


COSTS = CostStudy(
    name="costs",
    title="What a solve costs",
    about="Time, memory and operator applications of both solvers against points, modes, steps, speed and "
    "contact; the powers they follow, and what those say of larger sizes.",
)


def billed(ladder: Ladder, outcomes: Mapping[Task, Outcome]) -> Bill:
    """A ladder measured."""
    rows = [outcomes[rung].rows[0] for rung in ladder.rungs]

    def measured(name):
        return np.array([row.measures.get(name, nan) for row in rows])

    axis = AXES[ladder.setting]
    applications = np.array([row.applications for row in rows])
    products = measured("transform_pairs")
    return Bill(
        ladder=ladder,
        x=np.array(ladder.values, float) if axis.measure is None else measured(axis.measure),
        processor=measured("processor"),
        wall=measured("wall"),
        memory=measured("memory"),
        repeats=measured("repeats"),
        applications=applications,
        products=products,
        limit=applications * measured("padded_product") + (products - applications) * measured("plain_product"),
        stored=_stored(ladder.rungs, outcomes),
        reasons=tuple(row.reason for row in rows),
    )


def _stored(rungs: Sequence[Rung], outcomes):
    """Bytes that each answer takes in a store, its fields left out."""
    with tempfile.TemporaryDirectory() as folder:
        store, sizes = Store(Path(folder)), []
        for rung in rungs:
            store.put(rung, Outcome(outcomes[rung].rows))
            sizes.append(sum(path.stat().st_size for path in Path(folder).glob("*.nc")))
        return np.diff([0, *sizes]).astype(float)
